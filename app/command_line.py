"""Parts shared by all commands: parser, option types, messages, progress bar, stop signals."""

from __future__ import annotations

import argparse
import io
import json
import math
import os
import signal
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, Protocol, TextIO

from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect, nan_to_none
from carpus.core.model.errors import CameraUnknown
from carpus.core.model.names import describe_known_names, find_similar_name

if TYPE_CHECKING:
    from carpus.core.model.errors import CarpusFault


_STOP_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


def reopen_closed_streams() -> None:
    """Open closed standard streams on the null device.

    The next file that is opened would otherwise get the number of a closed stream, and messages would be written into
    it.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdin, sys.stdout, sys.stderr = (stream or io.StringIO() for stream in (sys.stdin, sys.stdout, sys.stderr))


def flush_stream(stream: TextIO) -> OSError | None:
    """Flush ``stream``; return the error if that is impossible.

    An unwritable stream is redirected to the null device: the interpreter would flush it again at exit and end with
    120.
    """
    try:
        stream.flush()
    except OSError as cause:
        with suppress(OSError):  # a stream that is no file
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)
        return cause
    return None


def print_message(sentence: str, prefix: str = "carpus") -> None:
    """Print one line on standard error, if that can be written."""
    with suppress(OSError):  # it waits in the stream, and comes once there is room
        print(f"{prefix}: {sentence}", file=sys.stderr, flush=True)


def print_fault(fault: CarpusFault) -> None:
    """Print one line about a fault that does not end the command."""
    from carpus.core.model.fault_text import format_fault_line

    print_message(format_fault_line(fault))


def print_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table for people, numbers to the right."""
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    for row in (head, *rows):
        cells = (
            f"{cell:>{width}}" if cell[:1].isdigit() or cell[:1] == "-" else f"{cell:{width}}"
            for cell, width in zip(row, widths, strict=True)
        )
        print("  ".join(cells).rstrip())


def print_json(content: Any) -> None:
    """Print values for programs: unknown numbers are null."""
    print(json.dumps(nan_to_none(content), indent=2, ensure_ascii=False))


def report_usage_error(command: str, sentence: str) -> int:
    """Print one line about wrong usage that argparse cannot see; return exit code 2."""
    print_message(sentence, f"carpus {command}")
    return 2


class ShowProgress(Protocol):
    """Callback with the number done, the total (None if unknown) and a note."""

    def __call__(self, done: int, total: int | None, note: str = "") -> None: ...


@contextmanager
def progress_bar(what: str, unit: str = "frame") -> Iterator[ShowProgress]:
    """Show a progress bar on a terminal."""
    from tqdm import tqdm  # as long to load as a tenth of the tracker

    note_now = ""
    with tqdm(desc=what, unit=unit, leave=False, disable=not sys.stderr.isatty()) as drawn:

        def show(done: int, total: int | None, note: str = "") -> None:
            nonlocal note_now
            drawn.total = total
            if note != note_now:
                note_now = note
                drawn.set_postfix_str(note, refresh=False)
            drawn.update(done - drawn.n)

        yield show


def handle_stop_signals(action: Callable[[], object]) -> None:
    """Call ``action`` when the program is asked to stop.

    Signals that were ignored at the start stay ignored (nohup, background jobs).
    """
    for name in _STOP_SIGNALS:
        number = getattr(signal, name, None)  # Windows knows no SIGHUP
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda *_: action())


class CommandParser(argparse.ArgumentParser):
    """Parser that reports wrong usage in one line and suggests the nearest known name."""

    def __init__(self, *args: Any, **options: Any) -> None:
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **options)

    def error(self, message: str) -> NoReturn:
        said = " ".join(message.removeprefix("argument ").split()).rstrip(".")
        ends = "" if said.endswith("?") else "."
        self.exit(2, f"{self.prog}: {said}{ends} “{self.prog} --help” shows how.\n")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            names = [str(name) for name in action.choices]
            if action.dest == "command":
                meant = find_similar_name(str(value), names)
                also = f". Did you mean “{meant}”?" if meant else f"; {describe_known_names(str(value), names)}"
                raise argparse.ArgumentError(None, f"Unknown command “{value}”{also}")
            raise argparse.ArgumentError(action, f"Unknown name “{value}”; {describe_known_names(str(value), names)}")

    def reject_unknown(self, extra: Sequence[str]) -> NoReturn:
        """Exit with 2 because of arguments that belong to no option."""
        word = extra[0]
        meant = find_similar_name(word.partition("=")[0], self._option_string_actions) if word.startswith("-") else None
        also = f"; did you mean “{meant}”?" if meant else ""
        self.error(f"nothing here is called “{word}”{also}")


def parse_table_form(text: str) -> TableDialect:
    """Return the table form of a region; an unknown region is wrong usage."""
    from carpus.ui.kit.table_file import regional_table_form

    try:
        return regional_table_form(text)
    except ValueError as cause:
        raise argparse.ArgumentTypeError(str(cause)) from cause


def add_region_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--region``, the form in which tables are written."""
    parser.add_argument(
        "--region",
        type=parse_table_form,
        dest="form",
        default=MACHINE_DIALECT,
        metavar="REGION",
        help="write tables for a spreadsheet of this region, for example de_DE, it_IT or en_GB, with its separator and "
        "decimal sign (default: commas and decimal points, for other programs)",
    )


def add_examples(parser: argparse.ArgumentParser, *lines: str) -> None:
    """Show lines that can be typed at the end of the help."""
    parser.epilog = "\n\n".join(filter(None, (parser.epilog, "Example:\n" + textwrap.indent("\n".join(lines), "  "))))


def number_type(low: float = -math.inf, high: float = math.inf, unit: str = "") -> Callable[[str], float]:
    """Return an argparse type for a number from ``low`` to ``high``."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            between = f" from {low:g} to {high:g}" if math.isfinite(high) else ""
            raise argparse.ArgumentTypeError(f"“{text}” is no number{between}{unit and f' {unit}'}")
        return value

    return read


def count_type(low: int, high: int) -> Callable[[str], int]:
    """Return an argparse type for a whole number from ``low`` to ``high``."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = low - 1
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"“{text}” is no whole number from {low} to {high}")
        return value

    return read


def describe_wrong_suffix(path: Path, suffixes: Sequence[str]) -> str:
    """Return what is wrong with the name of a file to write that ends in another format; empty if nothing.

    >>> describe_wrong_suffix(Path("a.csv"), (".pdf",)), describe_wrong_suffix(Path("P-1"), (".pdf",))
    ('“a.csv” ends in .csv, and what is written is .pdf', '')
    """
    suffix = path.suffix.lower()
    if suffix in ("", *suffixes) or suffix[1:].isdigit():
        return ""
    return f"“{path}” ends in {suffix}, and what is written is {' or '.join(suffixes)}"


def output_type(*suffixes: str) -> Callable[[str], Path]:
    """Return an argparse type for a file to write: a name of another format is wrong usage."""

    def read(text: str) -> Path:
        if wrong := describe_wrong_suffix(Path(text), suffixes):
            raise argparse.ArgumentTypeError(wrong)
        return Path(text)

    return read


def parse_camera_address(text: str) -> str:
    """Check ``KIND`` or ``KIND:WHICH`` of a live camera; an unknown kind is wrong usage."""
    from carpus.core.capture.devices.cameras import validate_address

    try:
        validate_address(text)
    except CameraUnknown as fault:
        raise argparse.ArgumentTypeError(f"no kind of camera is called “{text}”; {fault.detail}") from None
    return text


def describe_camera_kinds() -> str:
    """Return what the address of a live camera is made of."""
    from carpus.core.capture.devices.cameras import CAMERAS

    return f"KIND is {', '.join(CAMERAS)}; WHICH is the serial number, or the OpenNI2 address"

"""What commands have in common: how wrong usage is told, and values are read; standard output and error, told of where
they cannot be written, with a progress bar for people; what asks the program to stop (Ctrl+C, a shutdown, a closed
terminal)."""

from __future__ import annotations

import argparse
import io
import math
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, NoReturn, Protocol, TextIO

from carpus.core.capture.devices.cameras import CAMERAS, validate_address
from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect
from carpus.core.model.errors import CameraUnknown
from carpus.core.model.names import describe_known_names, find_similar_name
from carpus.core.model.rounding import format_rounded

if TYPE_CHECKING:
    from carpus.core.model.errors import CarpusFault


_STOP_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")
SUMMARY_AFTER_S = 10.0
"""What took as long is told at its end in one line, with how fast it went."""


def reopen_closed_streams() -> None:
    """A stream closed by whoever started us would give its number to the next file, and messages would go there."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdin, sys.stdout, sys.stderr = (stream or io.StringIO() for stream in (sys.stdin, sys.stdout, sys.stderr))


def flush_stream(stream: TextIO) -> OSError | None:
    """Write out what ``stream`` still holds; returns why that is impossible.

    What it holds then goes nowhere: the interpreter would try again at its end, and end in 120.
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
    """One line on standard error, where that can be written."""
    with suppress(OSError):  # it waits in the stream, and comes once there is room
        print(f"{prefix}: {sentence}", file=sys.stderr, flush=True)


def print_fault(fault: CarpusFault) -> None:
    """One line of what a source tells and does not raise."""
    from carpus.core.model.fault_text import format_fault_line

    print_message(format_fault_line(fault))


def report_usage_error(command: str, sentence: str) -> int:
    """Wrong usage that no option shows by itself: one line, and the exit code."""
    print_message(sentence, f"carpus {command}")
    return 2


class ShowProgress(Protocol):
    """Draws that ``done`` of ``total`` are done (None where nobody knows), with a ``note`` behind it."""

    def __call__(self, done: int, total: int | None, note: str = "") -> None: ...


@contextmanager
def progress_bar(what: str, unit: str = "frame") -> Iterator[ShowProgress]:
    """A bar with how fast it goes and the time left, which goes when the work is over; nothing where stderr is no
    terminal. Of work that took long one line stays, of any."""
    from tqdm import tqdm  # as long to load as a tenth of the tracker

    begin_s = time.monotonic()
    last, note_now = 0, ""
    with tqdm(desc=what, unit=unit, leave=False, disable=not sys.stderr.isatty()) as drawn:

        def show(done: int, total: int | None, note: str = "") -> None:
            nonlocal last, note_now
            drawn.total, last = total, done
            if note != note_now:
                note_now = note
                drawn.set_postfix_str(note, refresh=False)
            drawn.update(done - drawn.n)

        yield show
    seconds = time.monotonic() - begin_s
    if last and seconds >= SUMMARY_AFTER_S:
        behind = f", {note_now}" if note_now else ""
        print_message(f"{what}, {last} {unit}s in {format_rounded(seconds)} s, {last / seconds:.3g} a second{behind}")


def handle_stop_signals(action: Callable[[], object]) -> None:
    """From now on whatever asks to stop makes ``action`` happen.

    What the program was told to ignore by whoever started it (nohup, a job in the background) it goes on ignoring.
    """
    for name in _STOP_SIGNALS:
        number = getattr(signal, name, None)  # Windows knows no SIGHUP
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda *_: action())


class CommandParser(argparse.ArgumentParser):
    """Tells wrong usage in one line and ends in 2; an unknown name or option comes with what was probably meant."""

    def __init__(self, *args: Any, **options: Any) -> None:
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **options)

    def error(self, message: str) -> NoReturn:
        """End with one line on stderr."""
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
            raise argparse.ArgumentError(action, f"no “{value}” is known; {describe_known_names(str(value), names)}")

    def reject_unknown(self, extra: Sequence[str]) -> NoReturn:
        """End because of words that no option asked for."""
        word = extra[0]
        meant = find_similar_name(word.partition("=")[0], self._option_string_actions) if word.startswith("-") else None
        also = f"; did you mean “{meant}”?" if meant else ""
        self.error(f"nothing here is called “{word}”{also}")


def parse_table_form(text: str) -> TableDialect:
    """The form of tables of a region; a region that there is not is wrong usage."""
    from carpus.ui.kit.table_file import regional_table_form

    try:
        return regional_table_form(text)
    except ValueError as cause:
        raise argparse.ArgumentTypeError(str(cause)) from cause


def add_region_option(parser: argparse.ArgumentParser) -> None:
    """The option in whose form tables are written."""
    parser.add_argument(
        "--region",
        type=parse_table_form,
        dest="form",
        default=MACHINE_DIALECT,
        metavar="REGION",
        help="tables for a spreadsheet of this region, as de_DE, it_IT or en_GB: its separator and decimal sign, UTF-8 "
        "with a mark; else for programs, with comma and point",
    )


def number_type(low: float = -math.inf, high: float = math.inf, unit: str = "") -> Callable[[str], float]:
    """Reads a number from ``low`` to ``high``; anything else is wrong usage."""

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
    """Reads a whole number from ``low`` to ``high``; anything else is wrong usage."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = low - 1
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"“{text}” is no whole number from {low} to {high}")
        return value

    return read


def parse_camera_address(text: str) -> str:
    """``KIND`` or ``KIND:WHICH`` of a live camera; an unknown kind is wrong usage."""
    try:
        validate_address(text)
    except CameraUnknown as fault:
        raise argparse.ArgumentTypeError(f"no kind of camera is called “{text}”; {fault.detail}") from None
    return text


CAMERA_HELP = f"KIND is {', '.join(CAMERAS)}; WHICH its serial number, or OpenNI2's address"

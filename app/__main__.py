"""The ``carpus`` command line: subcommands, exit codes, and failures as one line on stderr."""

from __future__ import annotations

import os

# One BLAS thread, set before NumPy loads: two thread pools in one process make small steps 1000 times slower.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import signal
from contextlib import suppress

# Ctrl+C while all this loads ends the program as the system does, without a traceback; what comes then main settles.
_INTERRUPTED = signal.getsignal(signal.SIGINT)
if _INTERRUPTED is signal.default_int_handler:
    with suppress(ValueError):  # loaded by a thread
        signal.signal(signal.SIGINT, signal.SIG_DFL)

import sys
import textwrap
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import NoReturn

from carpus.app.command_line import (
    CommandParser,
    flush_stream,
    handle_stop_signals,
    print_message,
    reopen_closed_streams,
)
from carpus.app.commands import COMMANDS, MODULES
from carpus.core.model.errors import CarpusFault, DiskFull
from carpus.core.platform.durable import DISK_FULL_ERRNOS
from carpus.core.platform.version import PURPOSE, __version__

EXIT_DONE, EXIT_FAILED = 0, 1

if _INTERRUPTED is signal.default_int_handler:
    with suppress(ValueError):
        signal.signal(signal.SIGINT, _INTERRUPTED)


def build_parser(asked: Sequence[str]) -> CommandParser:
    """Return the parser of the command line; only the requested command is imported."""
    out = CommandParser(
        prog="carpus",
        description="Carpus tracks blue paper markers on a hand with a depth camera, for hand rehabilitation.\n\n"
        + "\n".join(f"  {word:<9} {meaning}" for word, meaning in PURPOSE)
        + "\n\nWithout a command, Carpus opens its window.",
        epilog="For research and education. Not a medical device.",
    )
    out.add_argument("--version", action="version", version=f"carpus {__version__}")
    out.add_argument(
        "--gdt",
        metavar="FILE",
        type=Path,
        help="open the window with the patient of a GDT file from the clinic software",
    )
    subparsers = out.add_subparsers(dest="command", metavar="COMMAND")
    for name, words in COMMANDS.items():
        sub = subparsers.add_parser(name, help=words, description=textwrap.fill(words, 100))
        if name == next((word for word in asked if not word.startswith("-")), None):
            key = name.replace("-", "_")
            module = import_module(f"carpus.app.commands.{MODULES.get(name, key)}")
            getattr(module, f"add_{key}_arguments")(sub)
            sub.set_defaults(run=getattr(module, f"run_{key}"), parser=sub)
    return out


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code.

    Returns
    -------
    int
        0 done, 1 could not be done (one line on stderr says why). Wrong usage exits with 2.
    """
    asked = sys.argv[1:] if argv is None else argv
    if _is_session_file(asked):
        asked = ["review", *asked]
    os.umask(0o077)  # whatever is written is about a patient: for its owner only
    reopen_closed_streams()
    handle_stop_signals(_raise_interrupt)
    code = EXIT_DONE
    words: str | None = None
    usage: SystemExit | None = None
    try:
        code = _run(asked)
    except SystemExit as ended:  # argparse has spoken: help, the version or wrong usage
        usage = ended
    except Exception as cause:
        if os.environ.get("CARPUS_DEBUG") and not isinstance(cause, CarpusFault | OSError):
            raise
        code, words = EXIT_FAILED, _describe_failure(cause)
    except KeyboardInterrupt:
        code, words = EXIT_FAILED, "stopped."
    # Before the code is decided: what was printed may still wait to be written.
    cut = flush_stream(sys.stdout)
    if cut is not None and code == EXIT_DONE:
        code, words, usage = EXIT_FAILED, _describe_failure(cut), None
    if words is not None:
        print_message(words)
    flush_stream(sys.stderr)
    if usage is not None:
        raise usage
    return code


def _is_session_file(asked: Sequence[str]) -> bool:
    """Tell a session file in place of a command: the system passes one on a double-click."""
    name = next(iter(asked), "")
    return name.lower().endswith(".h5") and not name.startswith("-") and name not in COMMANDS


def _run(asked: Sequence[str]) -> int:
    top = build_parser(asked)
    arguments, extra = top.parse_known_args(asked)
    if extra:
        getattr(arguments, "parser", top).reject_unknown(extra)
    if arguments.command is None:
        from carpus.app.commands import desktop

        return desktop.open_window(None, is_demo=False, file=arguments.gdt and arguments.gdt.absolute())
    return int(arguments.run(arguments))


def _describe_failure(cause: Exception) -> str | None:
    """Return one sentence about a failure, None if the reader of the output went away."""
    if isinstance(cause, CarpusFault):
        from carpus.core.model.fault_text import format_fault_line

        return format_fault_line(cause)
    if isinstance(cause, BrokenPipeError):
        return None  # the reader of our output went away (`carpus info FILE | head`)
    if isinstance(cause, OSError):
        if cause.errno in DISK_FULL_ERRNOS:
            return _describe_failure(DiskFull(cause.filename or "", cause.strerror or ""))
        subject = "" if cause.filename is None else f" {cause.filename}"
        reason = cause.strerror or cause
        return f"no access to{subject or ' a file'} ({reason}). Check the file and the free space on its disk."
    # A fault of the program itself: still one line, with what a developer needs to find it.
    where = cause.__traceback__
    while where is not None and where.tb_next is not None:
        where = where.tb_next
    place = f"{Path(where.tb_frame.f_code.co_filename).name}:{where.tb_lineno}" if where else "unknown place"
    return (
        f"an unexpected error occurred ({type(cause).__name__}: {cause}, {place}). "
        "Please report it; CARPUS_DEBUG=1 shows more."
    )


def _raise_interrupt() -> NoReturn:
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())

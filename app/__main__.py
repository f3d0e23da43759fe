"""``carpus`` on the command line: one subcommand per job, exit codes, one place where faults become words."""

from __future__ import annotations

import os

# One BLAS thread, set before NumPy loads: two thread pools in one process make small steps 1000 times slower.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import argparse
import io
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import NoReturn

from app import __version__
from app.commands import COMMANDS, not_yet
from app.commands.not_yet import NOT_YET
from core.errors import CarpusFault

EXIT_DONE, EXIT_COULD_NOT = 0, 1


def parser(asked: Sequence[str]) -> argparse.ArgumentParser:
    """The command line; only the command that is asked for brings its options."""
    out = argparse.ArgumentParser(
        prog="carpus",
        description="Hand rehabilitation: tracks blue paper markers on a hand. Without a command: the desktop.",
        epilog="For research and education. Not a medical device.",
    )
    out.add_argument("--version", action="version", version=f"carpus {__version__}")
    subparsers = out.add_subparsers(dest="command", metavar="COMMAND")
    for name, words in (COMMANDS | NOT_YET).items():
        sub = subparsers.add_parser(name, help=words, description=words)
        if name == next((word for word in asked if not word.startswith("-")), None):
            command = not_yet if name in NOT_YET else import_module(f"app.commands.{name}")
            command.add_arguments(sub)
            sub.set_defaults(run=command.run)
    return out


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; 0 done, 1 could not be done (one line on stderr), 2 wrong usage."""
    asked = sys.argv[1:] if argv is None else argv
    if asked and asked[0] in NOT_YET and not {"-h", "--help"} & set(asked):
        asked = asked[:1]  # whatever follows cannot be judged yet
    _open_closed_streams()
    _stop_on_signals()
    try:
        arguments = parser(asked).parse_args(asked)
        if arguments.command is None:
            from app.commands import desktop

            return desktop.run(arguments)
        return int(arguments.run(arguments))
    except CarpusFault as fault:
        from core.words import one_sentence

        print(f"carpus: {one_sentence(fault)}", file=sys.stderr)
    except KeyboardInterrupt:
        print("carpus: stopped.", file=sys.stderr)
    except BrokenPipeError:
        # The reader of our output went away (`carpus info FILE | head`); nobody is left to tell.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as cause:
        subject = "" if cause.filename is None else f" {cause.filename}"
        print(
            f"carpus: the system refuses{subject} ({cause.strerror or cause}); check the file and the room on its "
            "disk.",
            file=sys.stderr,
        )
    except Exception as cause:
        # A fault of the program itself: still one line, with what a developer needs to find it.
        where = cause.__traceback__
        while where is not None and where.tb_next is not None:
            where = where.tb_next
        place = f"{Path(where.tb_frame.f_code.co_filename).name}:{where.tb_lineno}" if where else "unknown place"
        if os.environ.get("CARPUS_DEBUG"):
            raise
        print(
            f"carpus: something unforeseen happened ({type(cause).__name__}: {cause}, {place}). Your files are as they "
            "were. Please report it; CARPUS_DEBUG=1 shows more.",
            file=sys.stderr,
        )
    return EXIT_COULD_NOT


def _open_closed_streams() -> None:
    """A stream closed by whoever started us would give its number to the next file, and messages would go there."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdin, sys.stdout, sys.stderr = (stream or io.StringIO() for stream in (sys.stdin, sys.stdout, sys.stderr))


def _stop_on_signals() -> None:
    """A shutdown or a closed terminal stops as Ctrl+C does: what runs is finished or tidied away. The window has its
    own way."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _interrupt)


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())

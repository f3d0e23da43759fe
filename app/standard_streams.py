"""Standard output and error as commands need them: there, told of where they cannot be written, with a progress bar for
people and notices; and what asks the program to stop (Ctrl+C, a shutdown, a closed terminal)."""

from __future__ import annotations

import io
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Protocol, TextIO

if TYPE_CHECKING:
    from carpus.core.errors import CarpusFault

_STOPS = ("SIGINT", "SIGTERM", "SIGHUP")
SPEAK_AFTER_S = 10.0
"""What took as long is told at its end in one line, with how fast it went."""


def open_closed() -> None:
    """A stream closed by whoever started us would give its number to the next file, and messages would go there."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdin, sys.stdout, sys.stderr = (stream or io.StringIO() for stream in (sys.stdin, sys.stdout, sys.stderr))


def flushed(stream: TextIO) -> OSError | None:
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


def say(sentence: str) -> None:
    """One line on standard error, where that can be written."""
    with suppress(OSError):
        print(f"carpus: {sentence}", file=sys.stderr)
    flushed(sys.stderr)


def tell(fault: CarpusFault) -> None:
    """One line of what a source tells and does not raise."""
    from carpus.core.words import one_sentence

    print(f"carpus: {one_sentence(fault)}", file=sys.stderr)


class ShowProgress(Protocol):
    """Draws that ``done`` of ``total`` are done (None where nobody knows), with a ``note`` behind it."""

    def __call__(self, done: int, total: int | None, note: str = "") -> None: ...


@contextmanager
def bar(what: str, unit: str = "frame") -> Iterator[ShowProgress]:
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
    if last and seconds >= SPEAK_AFTER_S:
        behind = f", {note_now}" if note_now else ""
        print(
            f"carpus: {what}, {last} {unit}s in {seconds:.0f} s, {last / seconds:.3g} a second{behind}", file=sys.stderr
        )


def on_stop(action: Callable[[], object]) -> None:
    """From now on whatever asks to stop makes ``action`` happen.

    What the program was told to ignore by whoever started it (nohup, a job in the background) it goes on ignoring.
    """
    for name in _STOPS:
        number = getattr(signal, name, None)  # Windows knows no SIGHUP
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda *_: action())

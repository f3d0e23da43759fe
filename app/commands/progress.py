"""What a command says on stderr while it works: a progress bar for people, and notices."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from carpus.app.commands.patient_progress import EXAMPLE, add_arguments, run
from carpus.core.errors import CarpusFault
from carpus.core.words import one_sentence

__all__ = ["EXAMPLE", "add_arguments", "bar", "run", "tell"]
"""The module has the name of a command: `carpus progress` finds its own here."""

SPEAK_AFTER_S = 10.0
"""What took as long is told at its end in one line, with how fast it went."""


def tell(fault: CarpusFault) -> None:
    """One line of what a source tells and does not raise."""
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

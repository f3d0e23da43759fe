"""What a command says on stderr while it works: a progress bar for people, and notices."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tqdm import tqdm

from carpus.app.commands.patient_progress import EXAMPLE, add_arguments, run
from carpus.core.errors import CarpusFault
from carpus.core.words import one_sentence

__all__ = ["EXAMPLE", "add_arguments", "bar", "run", "tell"]
"""The module has the name of a command: `carpus progress` finds its own here."""

SPEAK_EVERY_S = 10.0
"""Where stderr is no terminal a line as often says that the work goes on."""


def tell(fault: CarpusFault) -> None:
    """One line of what a source tells and does not raise."""
    print(f"carpus: {one_sentence(fault)}", file=sys.stderr)


@contextmanager
def bar(what: str, unit: str = "frame") -> Iterator[Callable[[int, int | None], None]]:
    """A function (done, total) that draws; the bar goes when the work is over. A line now and then for no terminal."""
    is_terminal = sys.stderr.isatty()
    spoken_s = time.monotonic()
    with tqdm(desc=what, unit=unit, leave=False, disable=not is_terminal) as drawn:

        def show(done: int, total: int | None) -> None:
            nonlocal spoken_s
            if not is_terminal:
                if time.monotonic() - spoken_s >= SPEAK_EVERY_S:
                    spoken_s = time.monotonic()
                    print(f"carpus: {what}, {done}{f' of {total}' if total else ''}", file=sys.stderr, flush=True)
                return
            drawn.total = total
            drawn.update(done - drawn.n)

        yield show

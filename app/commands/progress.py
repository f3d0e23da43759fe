"""What a command says on stderr while it works: a progress bar for people, and notices."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tqdm import tqdm

from core.errors import CarpusFault
from core.words import one_sentence


def tell(fault: CarpusFault) -> None:
    """One line of what a source tells and does not raise."""
    print(f"carpus: {one_sentence(fault)}", file=sys.stderr)


@contextmanager
def bar(what: str) -> Iterator[Callable[[int, int | None], None]]:
    """A function (done, total) that draws; the bar goes when the work is over. Silent when stderr is no terminal."""
    with tqdm(desc=what, unit="frame", leave=False, disable=not sys.stderr.isatty()) as drawn:

        def show(done: int, total: int | None) -> None:
            drawn.total = total
            drawn.update(done - drawn.n)

        yield show

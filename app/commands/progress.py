"""A progress bar for people; silent when stderr is not a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tqdm import tqdm


@contextmanager
def bar(what: str) -> Iterator[Callable[[int, int | None], None]]:
    """A function (done, total) that draws; the bar goes when the work is over."""
    with tqdm(desc=what, unit="frame", leave=False, disable=not sys.stderr.isatty()) as drawn:

        def show(done: int, total: int | None) -> None:
            drawn.total = total
            drawn.update(done - drawn.n)

        yield show

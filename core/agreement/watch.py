"""Long work that tells how far it is, and that can be stopped on the way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


class Stopped(Exception):
    """Somebody stopped the work before it was done; nothing was written."""


@dataclass(frozen=True, slots=True)
class WorkWatch:
    """``progress`` hears (percent, 100); ``cancelled`` is asked each time, and ends the work by :class:`Stopped`."""

    progress: Callable[[int, int], None] = lambda _done, _total: None
    cancelled: Callable[[], bool] = lambda: False

    def at(self, share: float) -> None:
        """So much of all is done."""
        if self.cancelled():
            raise Stopped
        self.progress(round(100.0 * share), 100)


UNWATCHED = WorkWatch()

"""Opens a source beside the window's thread and lets it go; what nobody wants any more is closed again."""

from __future__ import annotations

import threading
from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from carpus.core.records.set_up import SetUp
from carpus.ui.background import Background
from carpus.ui.now_open import NowOpen, OpenSource, SourceChoice

Progress = Callable[[int, int], None]
"""Called with pictures done and pictures in all."""
OpenIt = Callable[[SourceChoice, SetUp, Progress], OpenSource]
"""Waits for camera, disk or renderer, so it is called in the background."""


class NobodyWaitsError(Exception):
    """Ends a long opening or drawing from inside."""


class Opener(QObject):
    """``opening`` carries the :class:`SourceChoice`; then come ``progressed``, with pictures done and in all, and
    ``opened`` or ``failed``, with a fault. ``closing``: the source that runs is let go."""

    opening = Signal(object)
    opened = Signal()
    failed = Signal(object)
    progressed = Signal(int, int)
    closing = Signal()

    def __init__(
        self, open_it: OpenIt, now: NowOpen, background: Background, not_closed: Callable[[Exception], None],
        parent: QObject,
    ) -> None:  # fmt: skip
        super().__init__(parent)
        self._open_it, self._now, self._others, self._not_closed = open_it, now, background, not_closed
        self._background = Background()  # whatever else is to be done waits for no camera
        self._ending = threading.Event()
        self._ready: list[OpenSource] = []
        self._number = 0
        self._last_percent = -1

    def open(self, choice: SourceChoice) -> None:
        """Begin for the set-up that is chosen; one of the two answers comes unless it is cancelled."""
        set_up = self._now.set_up
        assert set_up is not None
        self._now.choice = choice
        self._number += 1
        number = self._number
        self._last_percent = -1
        self.opening.emit(choice)
        self._background.run(
            lambda: self._ready.append(self._open_it(choice, set_up, self._progress)),
            lambda _: self._take(number),
            lambda fault: self._fail(number, fault),
        )

    def close_source(self) -> None:
        """Let camera or recording go, also one that is still being opened."""
        self._number += 1
        source, self._now.source = self._now.source, None
        if source is not None:
            self.closing.emit()
            self._others.run(source.measuring.close, lambda _: None, self._not_closed)

    def end(self) -> None:
        """The program ends: wait for what was being opened, and close it."""
        self._number += 1
        self._ending.set()
        self._background.wait()
        while self._ready:
            self._ready.pop().measuring.close()

    def _progress(self, done: int, total: int) -> None:
        """Called from the background for every picture; the window hears of each percent."""
        if self._ending.is_set():
            raise NobodyWaitsError
        percent = 100 * done // max(total, 1)
        if percent != self._last_percent:
            self._last_percent = percent
            self.progressed.emit(done, total)

    def _take(self, number: int) -> None:
        source = self._ready.pop(0)
        if number == self._number:
            self._now.source = source
            self.opened.emit()
        else:
            self._background.run(source.measuring.close, lambda _: None, lambda _: None)

    def _fail(self, number: int, fault: Exception) -> None:
        if number == self._number and not isinstance(fault, NobodyWaitsError):
            self.failed.emit(fault)

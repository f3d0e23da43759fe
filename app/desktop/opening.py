"""Opens a source beside the window's thread; tells how far it is; what nobody wants any more is closed again."""

from __future__ import annotations

import threading

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.sources import NobodyWaitsError, Sources
from carpus.core.records.set_up import SetUp
from carpus.ui.background import Background
from carpus.ui.now_open import OpenSource
from carpus.ui.setup.choice import SourceChoice


class Opener(QObject):
    """``opened`` carries the :class:`OpenSource`, ``failed`` a fault, ``progressed`` pictures done and in all."""

    opened = Signal(object)
    failed = Signal(object)
    progressed = Signal(int, int)

    def __init__(self, sources: Sources) -> None:
        super().__init__()
        self._sources = sources
        self._background = Background()
        self._ending = threading.Event()
        self._ready: list[OpenSource] = []
        self._number = 0
        self._last_percent = -1

    def open(self, choice: SourceChoice, set_up: SetUp) -> None:
        """Begin; one of the two answers comes unless it is cancelled."""
        self._number += 1
        number = self._number
        self._last_percent = -1
        self._background.run(
            lambda: self._ready.append(self._sources.open(choice, set_up, self._progress)),
            lambda _: self._take(number),
            lambda fault: self._fail(number, fault),
        )

    def cancel(self) -> None:
        """Nobody waits any more: a source that still comes is closed."""
        self._number += 1

    def close(self) -> None:
        """End at once, as when the program ends."""
        self.cancel()
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
            self.opened.emit(source)
        else:
            self._background.run(source.measuring.close, lambda _: None, lambda _: None)

    def _fail(self, number: int, fault: Exception) -> None:
        if number == self._number and not isinstance(fault, NobodyWaitsError):
            self.failed.emit(fault)

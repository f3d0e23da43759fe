"""Looks now and then whether a camera is plugged in."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Signal

LOOK_EVERY_MS = 2000


class CameraWatch(QObject):
    """``looked`` carries what was seen, each time."""

    looked = Signal(bool)

    def __init__(self, parent: QObject, is_there: Callable[[], bool]) -> None:
        super().__init__(parent)
        self._is_there = is_there
        self.there = False
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)

    def start(self) -> None:
        """Look now, and go on looking."""
        self._timer.start()
        self.look()

    def stop(self) -> None:
        """Look no more."""
        self._timer.stop()

    def look(self) -> None:
        """Look once."""
        self.there = self._is_there()
        self.looked.emit(self.there)

"""Looks now and then whether a camera is plugged in, and which."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Signal

LOOK_EVERY_MS = 2000


class CameraWatch(QObject):
    """``looked`` carries what was seen, each time: whether one is there, and its name, empty where nobody knows.

    ``name`` answers with the name, None where none is there.
    """

    looked = Signal(bool, str)

    def __init__(self, parent: QObject, name: Callable[[], str | None]) -> None:
        super().__init__(parent)
        self._name = name
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
        name = self._name()
        self.there = name is not None
        self.looked.emit(self.there, name or "")

"""Where one is in a recording, and whether time runs there."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal

PLAY_EVERY_MS = 40


class Playing(QObject):
    """``moved`` carries the new time, ``changed`` whether it plays."""

    moved = Signal(float)
    changed = Signal(bool)

    def __init__(self, owner: QObject) -> None:
        super().__init__(owner)
        self.time_s = 0.0
        self.end_s = -1.0
        """How long there is something to play; below 0 there is nothing yet."""
        self.factor = 1.0
        self._timer = QTimer(self)
        self._timer.setInterval(PLAY_EVERY_MS)
        self._timer.timeout.connect(self._go_on)

    def open(self, end_s: float) -> None:
        """Stop; from now on it is another recording, -1 while that is read."""
        self.stop()
        self.end_s = end_s

    def seek(self, time_s: float) -> None:
        if self.end_s >= 0.0:
            self.time_s = min(max(time_s, 0.0), self.end_s)
            self.moved.emit(self.time_s)

    def toggle(self) -> None:
        """Play from here, from the start where it was over, or stop."""
        if self._timer.isActive():
            self.stop()
        elif self.end_s >= 0.0:
            if self.time_s >= self.end_s - 1e-3:
                self.seek(0.0)
            self._timer.start()
            self.changed.emit(True)

    def stop(self) -> None:
        self._timer.stop()
        self.changed.emit(False)

    def _go_on(self) -> None:
        self.seek(self.time_s + 0.001 * PLAY_EVERY_MS * self.factor)
        if self.time_s >= self.end_s - 1e-6:
            self.stop()

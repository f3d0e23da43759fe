"""How long nobody has touched key, mouse or screen."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QTimer, Signal
from PySide6.QtGui import QWindow
from PySide6.QtWidgets import QWidget

SIGNS_OF_LIFE = (
    QEvent.Type.KeyPress, QEvent.Type.MouseMove, QEvent.Type.MouseButtonPress, QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
)  # fmt: skip


class Idle(QObject):
    """``passed`` once after so many milliseconds without a sign of life in the window."""

    passed = Signal()

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._watched: QObject | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.passed)

    @property
    def left_ms(self) -> int:
        """Until it passes; -1 when nobody waits."""
        return self._timer.remainingTime()

    def wait(self, milliseconds: int) -> None:
        """From now on; 0 for never."""
        self._timer.stop()
        handle: QWindow | None = self._window.windowHandle()  # none before the window was made
        # What the system sends the window, and nothing else: the many events within it pass nobody's hand.
        if milliseconds and handle is not None and handle is not self._watched:
            handle.installEventFilter(self)
            self._watched = handle
        if milliseconds:
            self._timer.start(milliseconds)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in SIGNS_OF_LIFE and self._timer.isActive():
            self._timer.start()
        return False

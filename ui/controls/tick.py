"""Something that is wanted or not."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent

from carpus.ui.controls.button import Button
from carpus.ui.theme import Theme


class Tick(Button):
    """A plus, and a check once it is wanted. Enter is not its own: ``accepted``."""

    accepted = Signal()

    def __init__(self, theme: Theme, words: str) -> None:
        super().__init__(theme, words, "quiet", icon="plus", height_px=38)
        self.setCheckable(True)
        self.toggled.connect(lambda on: self.set_face(words, icon="check" if on else "plus"))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.accepted.emit()
        else:
            super().keyPressEvent(event)

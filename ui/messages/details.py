"""Subject area and code of a fault, and what IT support needs, shown and copied on request."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget

from carpus.core.words import Words
from carpus.ui.controls.button import Button
from carpus.ui.controls.layouts import STRETCH, in_column, in_line
from carpus.ui.controls.text import REGULAR, Text
from carpus.ui.theme import Theme

BREAK = "\u200b"
"""Where a long name may go on in the next line; it takes no room."""


class FaultDetails(QWidget):
    """A line with area and code; “Details” opens what a clinician need not read."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._words = Words("", "", "")
        self.code = Text(theme, "", 14, REGULAR, "text2")
        self.toggle = Button(theme, self.tr("Details"), "quiet", height_px=36)
        self.copy = Button(theme, self.tr("Copy"), "quiet", height_px=36)
        self.text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        head = in_line(self.code, STRETCH, self.copy, self.toggle, gap=8)
        self.setLayout(in_column(head, self.text, gap=4))
        self.toggle.setCheckable(True)
        self.toggle.toggled.connect(self._show_text)
        self.copy.clicked.connect(lambda: QApplication.clipboard().setText(self.full_text()))

    def show_words(self, words: Words) -> None:
        """Take the facts of a fault; the line is hidden for a message that has no code."""
        self._words = words
        self.setVisible(bool(words.code))
        self.code.setText(f"{words.title} · {words.code}")
        self.text.setText("\n".join(part.replace("/", f"/{BREAK}").replace("_", f"_{BREAK}") for part in words.details))
        self.toggle.setVisible(bool(words.details))
        self.toggle.setChecked(False)
        self._show_text(False)

    def full_text(self) -> str:
        """All that IT support needs, as plain text."""
        return "\n".join((f"{self._words.code} {self._words.happened}", *self._words.details))

    def _show_text(self, is_open: bool) -> None:
        self.text.setVisible(is_open)
        self.copy.setVisible(is_open)

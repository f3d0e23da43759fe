"""Subject and code of a fault with details for IT support, to be copied."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget

from carpus.core.model.fault_text import MessageText
from carpus.ui.kit.button import Button
from carpus.ui.kit.layouts import STRETCH, column_layout, row_layout
from carpus.ui.kit.text import REGULAR, Text
from carpus.ui.kit.theme import Theme

LINE_BREAK_HINT = "\u200b"
"""Zero-width space that lets a long name break."""


class FaultDetails(QWidget):
    """Row with subject and code of a fault; “Details” shows what only support needs."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._words = MessageText("", "", "")
        self.code = Text(theme, "", 14, REGULAR, "text2")
        self.toggle_button = Button(theme, self.tr("Details"), "quiet", height_px=36)
        self.copy_button = Button(theme, self.tr("Copy"), "quiet", height_px=36)
        self.text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        head = row_layout(self.code, STRETCH, self.copy_button, self.toggle_button, gap=8)
        self.setLayout(column_layout(head, self.text, gap=4))
        self.toggle_button.setCheckable(True)
        self.toggle_button.toggled.connect(self._show_text)
        self.copy_button.clicked.connect(lambda: QApplication.clipboard().setText(self.full_text()))

    def show_words(self, words: MessageText) -> None:
        """Show the facts of a fault; hide the row for a message without a code."""
        self._words = words
        self.setVisible(bool(words.code))
        self.code.setText(f"{words.title} · {words.code}")
        self.text.setText(
            "\n".join(
                part.replace("/", f"/{LINE_BREAK_HINT}").replace("_", f"_{LINE_BREAK_HINT}") for part in words.details
            )
        )
        self.toggle_button.setVisible(bool(words.details))
        self.toggle_button.setChecked(False)
        self._show_text(False)

    def full_text(self) -> str:
        """Return everything that IT support needs, as plain text."""
        return "\n".join((f"{self._words.code} {self._words.summary}", *self._words.details))

    def _show_text(self, is_open: bool) -> None:
        self.text.setVisible(is_open)
        self.copy_button.setVisible(is_open)

"""A line under the top bar that stays as long as something must not be forgotten: simulated, or doubtful."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QWidget

from carpus.ui.controls.text import MEDIUM, StateText, Text
from carpus.ui.theme import MARGIN_PX, Theme


class Sign(QWidget):
    """Amber, with a triangle; hidden while there is nothing to say."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        icon = StateText(theme, icon_px=18)
        self._words = Text(theme, "", 14, MEDIUM, wrap=True)
        row = QHBoxLayout(self)
        row.setContentsMargins(MARGIN_PX, 5, MARGIN_PX, 5)
        row.setSpacing(10)
        row.addWidget(icon)
        icon.show_state("warn", "")  # in its place by now: shown before, it would be a window of its own for a moment
        row.addWidget(self._words, 1)
        theme.changed.connect(self.update)
        self.show_lines(())

    @property
    def text(self) -> str:
        """What it says, empty while it is hidden."""
        return self._words.text()

    def show_lines(self, lines: Sequence[str]) -> None:
        """Say these sentences, or hide."""
        words = " ".join(lines)
        self._words.setText(words)
        self.setAccessibleName(words)
        self.setVisible(bool(words))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), self._theme.color("warn_soft"))
        painter.fillRect(0, self.height() - 1, self.width(), 1, self._theme.color("warn"))

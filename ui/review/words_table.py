"""A table of words in columns: heads over rows, as wide as its words ask for."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QGridLayout, QWidget

from carpus.ui.controls.card import Line
from carpus.ui.controls.text import MEDIUM, REGULAR, Text, caption
from carpus.ui.theme import Theme


class WordsTable(QWidget):
    """The first column names the row."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.rows: tuple[tuple[str, ...], ...] = ()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(10)
        self._grid.setVerticalSpacing(4)

    def show_rows(self, heads: Sequence[str], rows: Sequence[tuple[str, ...]]) -> None:
        """Replace all rows."""
        while (item := self._grid.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        self.rows = tuple(rows)
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column)
            self._grid.setColumnStretch(column, 1)
        for number, row in enumerate(rows):
            self._grid.addWidget(Line(self._theme), 2 * number + 1, 0, 1, len(heads))
            for column, cell in enumerate(row):
                text = Text(self._theme, cell, 14, REGULAR if column else MEDIUM, wrap=True)
                self._grid.addWidget(text, 2 * number + 2, column)
        spoken = ("; ".join(f"{head} {cell}" for head, cell in zip(heads, row, strict=True) if cell) for row in rows)
        self.setAccessibleName(". ".join(spoken))

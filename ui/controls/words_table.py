"""A table of words in columns: heads over rows, as wide as its words ask for."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QWidget

from carpus.ui.controls.card import Line
from carpus.ui.controls.layouts import empty, in_grid
from carpus.ui.controls.text import MEDIUM, REGULAR, Text, caption
from carpus.ui.theme import Theme

LEAST_LETTERS, MOST_LETTERS = 6, 28
"""Columns share the width as their longest words do, within these."""


class WordsTable(QWidget):
    """The first column names the row."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.rows: tuple[tuple[str, ...], ...] = ()
        self._grid = in_grid(10, 4, margins=(0, 0, 0, 0), within=self)

    def show_rows(self, heads: Sequence[str], rows: Sequence[tuple[str, ...]]) -> None:
        empty(self._grid)
        self.rows = tuple(rows)
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column)
            words = max((line for cells in (heads, *rows) for line in cells[column].split("\n")), key=len, default="")
            self._grid.setColumnStretch(column, min(max(len(words), LEAST_LETTERS), MOST_LETTERS))
        for number, row in enumerate(rows):
            self._grid.addWidget(Line(self._theme), 2 * number + 1, 0, 1, len(heads))
            for column, cell in enumerate(row):
                shown = Text(self._theme, cell, 14, REGULAR if column else MEDIUM, wrap=True)
                self._grid.addWidget(shown, 2 * number + 2, column)
        spoken = ("; ".join(f"{head} {cell}" for head, cell in zip(heads, row, strict=True) if cell) for row in rows)
        self.setAccessibleName(". ".join(spoken))

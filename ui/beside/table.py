"""The table of two sessions: one row for each movement."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QWidget

from carpus.ui.beside.rows import BesideRow
from carpus.ui.controls.card import Line
from carpus.ui.controls.layouts import empty, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text, caption, named_by_color
from carpus.ui.theme import Theme

STRETCH = (20, 17, 17, 13, 8, 34)
RIGHT = (3, 4)
"""Columns whose figures end at the right."""


class BesideTable(QWidget):
    """Rows of texts in columns."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.rows: tuple[BesideRow, ...] = ()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(16)
        self._grid.setVerticalSpacing(5)
        for column, stretch in enumerate(STRETCH):
            self._grid.setColumnStretch(column, stretch)

    def show_rows(self, heads: Sequence[str], rows: Sequence[BesideRow]) -> None:
        """Replace all rows."""
        empty(self._grid)
        self.rows = tuple(rows)
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column, self._side(column))
        for number, row in enumerate(rows):
            self._grid.addWidget(Line(self._theme), 2 * number + 1, 0, 1, len(STRETCH))
            self._add_row(2 * number + 2, row)
        self.setAccessibleName("; ".join(f"{row.movement} {row.first} {row.second} {row.words}" for row in rows))

    @staticmethod
    def _side(column: int) -> Qt.AlignmentFlag:
        across = Qt.AlignmentFlag.AlignRight if column in RIGHT else Qt.AlignmentFlag(0)
        return across | Qt.AlignmentFlag.AlignVCenter

    def _add_row(self, line: int, row: BesideRow) -> None:
        theme = self._theme
        weak = "text" if row.strong else "text2"
        said = SEMIBOLD if row.strong else REGULAR
        cells: tuple[QWidget, ...] = (
            named_by_color(theme, row.movement, row.token),
            Text(theme, row.first, 16, SEMIBOLD, wrap=True),
            Text(theme, row.second, 16, SEMIBOLD, wrap=True),
            Text(theme, row.difference, 14, said, weak),
            Text(theme, row.error, 14, REGULAR, "text2"),
            _Said(theme, row),
        )
        for column, cell in enumerate(cells):
            self._grid.addWidget(cell, line, column, self._side(column) if column in RIGHT else Qt.AlignmentFlag(0))


class _Said(QWidget):
    def __init__(self, theme: Theme, row: BesideRow) -> None:
        super().__init__()
        line = in_line(
            (Sign(theme, row.state), 0, Qt.AlignmentFlag.AlignVCenter), gap=8, margins=(0, 0, 0, 0), within=self
        )
        strong = SEMIBOLD if row.strong else REGULAR
        line.addWidget(Text(theme, row.words, 14, strong, "text" if row.strong else "text2", wrap=True), 1)

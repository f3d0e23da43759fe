"""The table of words and values, the same on a screen and on paper; Qt lays it out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from carpus.ui.controls.card import Fill, Line
from carpus.ui.controls.layouts import empty, in_column, in_grid, in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, PlainText, Sign
from carpus.ui.theme import Theme
from carpus.ui.words.table import Cell, TableColumn, cell_words

MAX_LETTERS = 26
"""A longer text asks for no wider column: it goes on in the next line."""
BAR, DASH = (0.35, 1.0), (0.85, 0.28)
"""Width and height, in sizes of the words, of the mark of a curve: before the name of a row, and of a column."""
SMALLEST = 0.7
"""Share of its usual size in which a table can still be read."""

_HEAD = TableColumn(MEDIUM, "text2")


class Table(QWidget):
    """Heads over rows with a line between them. Columns share the width as their words ask for; where that is more than
    there is, all words are smaller."""

    def __init__(
        self, theme: Theme, size: float = 14, head_size: float = 12, gap: float = 12, pitch: float = 5
    ) -> None:
        """``gap`` lies between two columns, ``pitch`` above and below each line."""
        super().__init__()
        self._theme, self._size, self._head_size, self._gap, self._pitch = theme, size, head_size, gap, pitch
        self._grid = in_grid(theme.px(gap), 0, margins=(0, 0, 0, 0), within=self)
        self._columns: tuple[TableColumn, ...] = ()
        self._heads: tuple[Cell, ...] = ()
        self.rows: tuple[tuple[Cell, ...], ...] = ()
        self._share = self._share_asked = 1.0
        self._needed_px, self._follows_width = 0, True
        theme.changed.connect(self._begin)

    def show_rows(
        self,
        columns: Sequence[TableColumn],
        heads: Sequence[str | Cell],
        rows: Sequence[Sequence[str | Cell]],
        *,
        spoken: Sequence[str] = (),
    ) -> None:
        """Replace what is shown; columns without head and words are left out."""
        lines = [*([heads] if heads else []), *rows]
        used = [at for at in range(len(columns)) if any(cell_words(line[at]) for line in lines)]
        self._columns = tuple(columns[at] for at in used)
        self._heads = tuple(_to_cell(heads[at], _HEAD) for at in used) if heads else ()
        self.rows = tuple(tuple(_to_cell(row[at], columns[at]) for at in used) for row in rows)
        said = spoken or ["; ".join(f"{cell.text} {cell.below}".strip() for cell in row) for row in self.rows]
        self.setAccessibleName(". ".join(said))
        self._begin()

    def fit_once(self, width_px: int) -> None:
        """Make all words smaller where they would be wider than that; the size then stays, whatever room there is."""
        self._follows_width = False
        self._fit(width_px)

    def _fit(self, width_px: int) -> None:
        share = max(min(1.0, width_px / max(self._needed_px, 1)), SMALLEST)
        share = math.floor(50.0 * share) / 50.0
        if share == self._share_asked:
            return
        self._share_asked = share
        self._build(share)
        while share > SMALLEST and self._grid.minimumSize().width() > width_px:  # fonts come in whole pixels
            share -= 0.02
            self._build(share)

    def resizeEvent(self, event: QResizeEvent) -> None:
        if self._follows_width:
            self._fit(self.width())

    def minimumSizeHint(self) -> QSize:
        hint = super().minimumSizeHint()
        return QSize(min(hint.width(), math.ceil(SMALLEST * self._needed_px)), hint.height())

    def _begin(self) -> None:
        self._share_asked = 1.0
        self._build(1.0)
        self._needed_px = self._grid.minimumSize().width()
        if self.isVisible():
            self._fit(self.width())

    def _build(self, share: float) -> None:
        """Lay everything out in that share of the usual size."""
        empty(self._grid)
        self._share = share
        self._grid.setHorizontalSpacing(self._theme.px(share * self._gap))
        for row in range(self._grid.rowCount()):
            self._grid.setRowMinimumHeight(row, 0)
        widest = [1] * max(len(self._columns), self._grid.columnCount())
        for place, head in enumerate(self._heads):
            column = replace(self._columns[place], wraps=True, scale=self._head_size / self._size)
            widest[place] = self._add(head, column, 0, place, DASH)
        for number, cells in enumerate(self.rows, 1):
            self._add_line(2 * number - 1)
            for place, cell in enumerate(cells):
                widest[place] = max(widest[place], self._add(cell, self._columns[place], 2 * number, place, BAR))
        if self.rows:
            self._add_line(2 * len(self.rows) + 1)
        for place, width in enumerate(widest):
            self._grid.setColumnStretch(place, width if place < len(self._columns) else 0)
        self.updateGeometry()

    def _add_line(self, row: int) -> None:
        line = Line(self._theme)
        self._grid.addWidget(line, row, 0, 1, len(self._columns), Qt.AlignmentFlag.AlignVCenter)
        line.show()
        self._grid.setRowMinimumHeight(row, self._theme.px(2 * self._share * self._pitch))

    def _add(self, cell: Cell, column: TableColumn, row: int, place: int, mark: tuple[float, float]) -> int:
        """Put a cell into the grid; the width that its words ask for."""
        size = self._share * self._size * column.scale
        side = Qt.AlignmentFlag.AlignRight if column.ends else Qt.AlignmentFlag.AlignLeft
        shown = PlainText(self._theme, cell.text, size, cell.weight, cell.token, wrap=column.wraps)
        shown.setAlignment(Qt.AlignmentFlag.AlignVCenter | side)
        letters = max((len(line) for line in cell.text.split("\n")), default=0)
        width: float = max(shown.fontMetrics().horizontalAdvance(line) for line in cell.text.split("\n"))
        if column.wraps:
            if column.least:
                shown.setMinimumWidth(int(width * min(1.0, column.least / max(letters, 1))))
            width *= min(1.0, MAX_LETTERS / max(letters, 1))
        whole: QWidget = shown
        if cell.below:
            below = PlainText(self._theme, cell.below, 0.85 * size, REGULAR, "text2", wrap=column.wraps)
            width = max(width, below.fontMetrics().horizontalAdvance(cell.below) if not column.wraps else 0)
            whole = QWidget()
            in_column(shown, below, gap=0, margins=(0, 0, 0, 0), within=whole)
        before: QWidget | None = Sign(self._theme, cell.sign, room_px=(20, 20)) if cell.sign else None
        if cell.mark:
            before = Fill(self._theme, cell.mark)
            before.setFixedSize(*(self._theme.px(size * share) for share in mark))
        if before is not None:
            marked, gap = QWidget(), self._theme.px(0.5 * size)
            centred = (before, 0, Qt.AlignmentFlag.AlignVCenter)
            in_line(centred, (whole, 1), gap=gap, margins=(0, 0, 0, 0), within=marked)
            width, whole = width + before.width() + gap, marked
        self._grid.addWidget(whole, row, place)
        whole.show()  # at once: the room for it is asked before Qt would come to it
        return int(width)


def _to_cell(cell: str | Cell, column: TableColumn) -> Cell:
    return cell if isinstance(cell, Cell) else Cell(cell, column.weight, column.token)

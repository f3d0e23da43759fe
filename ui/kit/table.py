"""Table widget, the same on screen and paper, and its content."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QListView, QWidget

from carpus.ui.kit.card import ColorFill, Separator
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import clear_layout, column_layout, grid_layout, row_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, ElidedText, Icon, PlainText
from carpus.ui.kit.theme import Theme

VERDICT_TOKENS = {"improved": "good", "worse": "bad", "warn": "warn"}


@dataclass(frozen=True, slots=True)
class Cell:
    """Text of a table with its appearance.

    ``subtext`` is a smaller line below it; before it stands the colour ``mark_token`` of a curve or the icon of a
    ``state``.
    """

    text: str
    weight: int = REGULAR
    token: str = "text"
    subtext: str = ""
    mark_token: str = ""
    state: State | None = None


@dataclass(frozen=True, slots=True)
class TableColumn:
    """Appearance of a column; text wraps once it has ``min_letters`` characters, ``scale`` is that of the font."""

    weight: int = REGULAR
    token: str = "text"
    is_right_aligned: bool = False
    is_wrapped: bool = True
    min_letters: int = 0
    scale: float = 1.0


TableRow = tuple[str | Cell, ...]


class TableContent(NamedTuple):
    """Columns, head and rows of a table; a column without any text is not shown."""

    columns: tuple[TableColumn, ...]
    heads: TableRow
    rows: tuple[TableRow, ...]


def cell_text(cell: str | Cell) -> str:
    """Return the text of a cell."""
    return cell if isinstance(cell, str) else cell.text


# A longer text does not widen its column: it wraps.
MAX_LETTERS = 26
# Width and height of a curve's colour mark in sizes of the text, before a row and in the head.
ROW_MARK, HEAD_MARK = (0.35, 1.0), (0.85, 0.28)
# Smallest scale at which a table can be read.
MIN_SCALE = 0.7

_HEAD = TableColumn(MEDIUM, "text2")


class Table(QWidget):
    """Table whose columns share the width by their texts; the font shrinks if there is too little."""

    def __init__(
        self, theme: Theme, size: float = 14, head_size: float = 12, gap: float = 12, pitch: float = 5
    ) -> None:
        """Set font sizes, the ``gap`` between columns, and the ``pitch`` above and below each line."""
        super().__init__()
        self._theme, self._size, self._head_size, self._gap, self._pitch = theme, size, head_size, gap, pitch
        self._grid = grid_layout(theme.px(gap), 0, margins=(0, 0, 0, 0), parent=self)
        self._columns: tuple[TableColumn, ...] = ()
        self._heads: tuple[Cell, ...] = ()
        self.rows: tuple[tuple[Cell, ...], ...] = ()
        self._scale = self._requested_scale = 1.0
        self._full_width_px, self._fitted_px, self._follows_width = 0, 0, True
        theme.changed.connect(self._rebuild)

    def show_rows(
        self,
        columns: Sequence[TableColumn],
        heads: Sequence[str | Cell],
        rows: Sequence[Sequence[str | Cell]],
        *,
        accessible_rows: Sequence[str] = (),
    ) -> None:
        """Replace the content; columns without text are omitted."""
        lines = [*([heads] if heads else []), *rows]
        used = [at for at in range(len(columns)) if any(cell_text(line[at]) for line in lines)]
        self._columns = tuple(columns[at] for at in used)
        self._heads = tuple(_to_cell(heads[at], _HEAD) for at in used) if heads else ()
        self.rows = tuple(tuple(_to_cell(row[at], columns[at]) for at in used) for row in rows)
        said = accessible_rows or [
            "; ".join(f"{cell.text} {cell.subtext}".strip() for cell in row) for row in self.rows
        ]
        self.setAccessibleName(". ".join(said))
        self._rebuild()

    def fit_width(self, width_px: int) -> None:
        """Shrink the font to a width once; it then stays, whatever room there is."""
        self._follows_width, self._fitted_px = False, width_px
        self._fit(width_px)

    def row_ends_px(self) -> list[int]:
        """Return where the head ends, then every row, at the width that the table was fitted to."""
        self._grid.setGeometry(QRect(0, 0, self._fitted_px, self._grid.heightForWidth(self._fitted_px)))
        return [self._grid.cellRect(2 * row, 0).bottom() for row in range(len(self.rows) + 1)]

    def _fit(self, width_px: int) -> None:
        share = max(min(1.0, width_px / max(self._full_width_px, 1)), MIN_SCALE)
        share = math.floor(50.0 * share) / 50.0
        if share == self._requested_scale:
            return
        self._requested_scale = share
        self._build(share)
        while share > MIN_SCALE and self._grid.minimumSize().width() > width_px:  # fonts come in whole pixels
            share -= 0.02
            self._build(share)

    def resizeEvent(self, event: QResizeEvent) -> None:
        if self._follows_width:
            self._fit(self.width())

    def minimumSizeHint(self) -> QSize:
        hint = super().minimumSizeHint()
        return QSize(min(hint.width(), math.ceil(MIN_SCALE * self._full_width_px)), hint.height())

    def _rebuild(self) -> None:
        self._requested_scale = 1.0
        self._build(1.0)
        self._full_width_px = self._grid.minimumSize().width()
        if self.isVisible():
            self._fit(self.width())

    def _build(self, share: float) -> None:
        clear_layout(self._grid)
        self._scale = share
        self._grid.setHorizontalSpacing(self._theme.px(share * self._gap))
        for row in range(self._grid.rowCount()):
            self._grid.setRowMinimumHeight(row, 0)
        widest = [1] * max(len(self._columns), self._grid.columnCount())
        for place, head in enumerate(self._heads):
            column = replace(self._columns[place], is_wrapped=True, scale=self._head_size / self._size)
            widest[place] = self._add(head, column, 0, place, HEAD_MARK)
        for number, cells in enumerate(self.rows, 1):
            self._add_line(2 * number - 1)
            for place, cell in enumerate(cells):
                widest[place] = max(widest[place], self._add(cell, self._columns[place], 2 * number, place, ROW_MARK))
        if self.rows:
            self._add_line(2 * len(self.rows) + 1)
        for place, width in enumerate(widest):
            self._grid.setColumnStretch(place, width if place < len(self._columns) else 0)
        self.updateGeometry()

    def _add_line(self, row: int) -> None:
        line = Separator(self._theme)
        self._grid.addWidget(line, row, 0, 1, len(self._columns), Qt.AlignmentFlag.AlignVCenter)
        line.show()
        self._grid.setRowMinimumHeight(row, self._theme.px(2 * self._scale * self._pitch))

    def _add(self, cell: Cell, column: TableColumn, row: int, place: int, mark: tuple[float, float]) -> int:
        """Add a cell to the grid and return the width its text asks for."""
        size = self._scale * self._size * column.scale
        side = Qt.AlignmentFlag.AlignRight if column.is_right_aligned else Qt.AlignmentFlag.AlignLeft
        shown = PlainText(self._theme, cell.text, size, cell.weight, cell.token, wrap=column.is_wrapped)
        shown.setAlignment(Qt.AlignmentFlag.AlignVCenter | side)
        letters = max((len(line) for line in cell.text.split("\n")), default=0)
        width: float = max(shown.fontMetrics().horizontalAdvance(line) for line in cell.text.split("\n"))
        if column.is_wrapped:
            if column.min_letters:
                shown.setMinimumWidth(int(width * min(1.0, column.min_letters / max(letters, 1))))
            width *= min(1.0, MAX_LETTERS / max(letters, 1))
        whole: QWidget = shown
        if cell.subtext:
            below = PlainText(self._theme, cell.subtext, 0.85 * size, REGULAR, "text2", wrap=column.is_wrapped)
            width = max(width, below.fontMetrics().horizontalAdvance(cell.subtext) if not column.is_wrapped else 0)
            whole = QWidget()
            column_layout(shown, below, gap=0, margins=(0, 0, 0, 0), parent=whole)
        before: QWidget | None = Icon(self._theme, cell.state, box_px=(20, 20)) if cell.state else None
        if cell.mark_token:
            before = ColorFill(self._theme, cell.mark_token)
            before.setFixedSize(*(self._theme.px(size * share) for share in mark))
        if before is not None:
            marked, gap = QWidget(), self._theme.px(0.5 * size)
            centred = (before, 0, Qt.AlignmentFlag.AlignVCenter)
            row_layout(centred, (whole, 1), gap=gap, margins=(0, 0, 0, 0), parent=marked)
            width, whole = width + before.width() + gap, marked
        self._grid.addWidget(whole, row, place)
        whole.show()  # at once: the room for it is asked before Qt would come to it
        return int(width)


def _to_cell(cell: str | Cell, column: TableColumn) -> Cell:
    return cell if isinstance(cell, Cell) else Cell(cell, column.weight, column.token)


class ListHeader(QWidget):
    """Column headings above a list that paints its own rows; they stay above them next to a scroll bar too."""

    def __init__(
        self,
        theme: Theme,
        rows: QListView,
        names: Sequence[str],
        place: Callable[[float, Theme, float], Sequence[tuple[float, float]]],
    ) -> None:
        """Take the ends of the columns from ``place``, by width, theme and width of the last heading."""
        super().__init__()
        self._theme, self._rows, self._place = theme, rows, place
        self._names = [ElidedText(theme, name, 12, MEDIUM, "text2") for name in names]
        for name in self._names:
            name.setParent(self)
        rows.verticalScrollBar().rangeChanged.connect(lambda *_: self._update_columns())
        theme.on_change(self, lambda: self.setFixedHeight(theme.px(28)))
        theme.changed.connect(self._update_columns)

    def _update_columns(self) -> None:
        bar = self._rows.verticalScrollBar()
        width = self.width() - (bar.sizeHint().width() if bar.maximum() else 0)
        last_px = self._names[-1].fontMetrics().horizontalAdvance(self._names[-1].text()) + 2
        for name, (left, right) in zip(self._names, self._place(width, self._theme, last_px), strict=True):
            name.setGeometry(round(left), 0, max(round(right) - round(left), 0), self.height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._update_columns()

"""The rows of the tables as cells, for the screen and for paper."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from carpus.ui.controls.table import VERDICT_TOKENS, Cell, TableColumn
from carpus.ui.figures import TOKENS
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.words.fingers import COLUMNS, FingerRow
from carpus.ui.words.further import FurtherRow
from carpus.ui.words.ranges import TableRow

_VALUE = TableColumn(ends=True, wraps=False)
_REFERENCE = TableColumn(token="text2", ends=True, wraps=False)
_CHANGE = TableColumn(MEDIUM, "text2", least=15)
RANGE_COLUMNS = (
    TableColumn(MEDIUM), TableColumn(SEMIBOLD, wraps=False, scale=1.1), _VALUE, _VALUE, _REFERENCE, _VALUE, _CHANGE,
)  # fmt: skip
"""Movement, today, best, other hand, reference, last time, change."""
FINGER_COLUMNS = (
    TableColumn(MEDIUM, wraps=False), *[TableColumn(wraps=False)] * 6, TableColumn(wraps=False, scale=0.95),
    replace(_CHANGE, scale=0.9),
)  # fmt: skip
"""Finger, five values, share of the total, last time, change."""
FURTHER_COLUMNS = (TableColumn(token="text2"), TableColumn(SEMIBOLD), TableColumn(ends=True, wraps=False)) * 2
"""Name, today and last time, twice."""


def range_cells(row: TableRow, *, is_short: bool = False) -> tuple[str | Cell, ...]:
    """A movement, or the heads; ``is_short`` for little room."""
    words = row.short_change or row.change if is_short else row.change
    change = Cell(words, MEDIUM, VERDICT_TOKENS[row.verdict]) if row.verdict in VERDICT_TOKENS else words
    name = Cell(row.movement, MEDIUM, mark=row.token) if row.token else row.movement
    return (name, row.today, row.best, row.other_hand, row.usual, row.last, change)


def finger_heads(heads: Sequence[str]) -> list[str | Cell]:
    """Heads over the values with the colour of each joint's curve, none over the finger's name."""
    cells: list[str | Cell] = [""]
    for head, row in zip(heads, (*COLUMNS, *[None] * len(heads)), strict=False):
        mark = TOKENS[row] if row in ("knuckle", "middle", "end", "tam") else ""
        cells.append(Cell(head, MEDIUM, "text2", mark=mark) if mark else head)
    return cells


def finger_cells(row: FingerRow) -> tuple[str | Cell, ...]:
    """A finger: each value over the ends that it went to."""
    cells = [
        Cell(cell.shown, SEMIBOLD, below=cell.small) if cell.small else Cell(cell.shown, REGULAR, "text2")
        for cell in row.cells
    ]
    share = Cell(row.share.main, SEMIBOLD, below=row.share.small) if row.share.small else ""
    change = Cell(row.change, MEDIUM, VERDICT_TOKENS.get(row.verdict, "text2"))
    return (row.name, *cells, share, row.last, change)


def further_cells(rows: Sequence[FurtherRow], across: int) -> list[list[str | Cell]]:
    """So many measures to a line, each with its value and last time's."""
    cells: list[list[str | Cell]] = [[row.name, row.today, row.last] for row in rows]
    while len(cells) % across:
        cells.append(["", "", ""])
    return [[cell for one in cells[start : start + across] for cell in one] for start in range(0, len(cells), across)]

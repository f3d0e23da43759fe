"""Content and appearance of a table, without a widget."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from carpus.ui.kit.fonts import REGULAR
from carpus.ui.kit.icons import State

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

"""A table as words: cells with a look of their own under heads, and how its columns look. A widget lays it out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from carpus.ui.kit.fonts import REGULAR
from carpus.ui.kit.icons import State

VERDICT_TOKENS = {"improved": "good", "worse": "bad", "warn": "warn"}


@dataclass(frozen=True, slots=True)
class Cell:
    """Words with a look of their own, a smaller line ``subtext`` them, and before them the ``mark_token`` of their
    curve or a
    state's ``state``."""

    text: str
    weight: int = REGULAR
    token: str = "text"
    subtext: str = ""
    mark_token: str = ""
    state: State | None = None


@dataclass(frozen=True, slots=True)
class TableColumn:
    """How the cells of a column look: ``is_right_aligned`` where they end at its right edge, ``is_wrapped`` where
    words go on in the
    next line once they have so many letters as ``min_letters``, ``scale`` of the table's size."""

    weight: int = REGULAR
    token: str = "text"
    is_right_aligned: bool = False
    is_wrapped: bool = True
    min_letters: int = 0
    scale: float = 1.0


TableRow = tuple[str | Cell, ...]


class TableContent(NamedTuple):
    """All of a table; a column without words has an empty head and is not shown."""

    columns: tuple[TableColumn, ...]
    heads: TableRow
    rows: tuple[TableRow, ...]


def cell_text(cell: str | Cell) -> str:
    """Return the words of a cell, whatever it looks like."""
    return cell if isinstance(cell, str) else cell.text

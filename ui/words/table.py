"""A table as words: cells with a look of their own under heads, and how its columns look. A widget lays it out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from carpus.ui.fonts import REGULAR
from carpus.ui.icons import State

VERDICT_TOKENS = {"improved": "good", "worse": "bad", "warn": "warn"}


@dataclass(frozen=True, slots=True)
class Cell:
    """Words with a look of their own, a smaller line ``below`` them, and before them the ``mark`` of their curve or a
    state's ``sign``."""

    text: str
    weight: int = REGULAR
    token: str = "text"
    below: str = ""
    mark: str = ""
    sign: State | None = None


@dataclass(frozen=True, slots=True)
class TableColumn:
    """How the cells of a column look: ``ends`` where they end at its right edge, ``wraps`` where words go on in the
    next line once they have so many letters as ``least``, ``scale`` of the table's size."""

    weight: int = REGULAR
    token: str = "text"
    ends: bool = False
    wraps: bool = True
    least: int = 0
    scale: float = 1.0


TableLine = tuple[str | Cell, ...]


class TableWords(NamedTuple):
    """All of a table; a column without words has an empty head and is not shown."""

    columns: tuple[TableColumn, ...]
    heads: TableLine
    rows: tuple[TableLine, ...]


def cell_words(cell: str | Cell) -> str:
    """Return the words of a cell, whatever it looks like."""
    return cell if isinstance(cell, str) else cell.text

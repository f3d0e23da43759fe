"""A table that a person saves where they were asked, as comma-separated values for a spreadsheet."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from itertools import count
from pathlib import Path

from carpus.core.formats.new_output import new_bytes, plain_cell


def table_text(head: Sequence[str], rows: Iterable[Iterable[object]]) -> str:
    """All of it; no cell is calculated by a spreadsheet that opens it."""
    text = io.StringIO()
    table = csv.writer(text)
    table.writerow(head)
    table.writerows([plain_cell(str(cell)) for cell in row] for row in rows)
    return text.getvalue()


def save_private(path: Path, content: bytes) -> None:
    """Write a file that nobody else may read, in place of what is there. Raises :class:`DiskFull` or
    :class:`OutputNotWritable`; then what was there stays."""
    with new_bytes(path, replaces=True) as file:
        file.write(content)


def save_table(path: Path, head: Sequence[str], rows: Iterable[Iterable[object]]) -> None:
    """Write a table; as :func:`save_private`."""
    save_private(path, table_text(head, rows).encode("utf-8"))


def named_beside(path: Path, ending: str, *, replaces: bool) -> Path:
    """The name of a second table beside the first, of which alone a person was asked: one that is there is replaced
    only where the first is."""
    names = (f"{path.stem}{ending}{'' if number == 1 else f'-{number}'}{path.suffix}" for number in count(1))
    places = (path.with_name(name) for name in names)
    return next(place for place in places if replaces or not place.exists())

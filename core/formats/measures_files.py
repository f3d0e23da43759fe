"""The measures of many sessions as one table: CSV, or Parquet with the extra ``carpus[tables]``."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any

from carpus.core.errors import ExtraMissing, OutputExists
from carpus.core.formats.new_output import FOR_PROGRAMS, TableForm, cell, new_bytes, new_table, plain_cell
from carpus.core.results.measures_table import SessionFigure

PARQUET = ".parquet"
ROWS_AT_ONCE = 10_000
HEAD = tuple(field.name for field in fields(SessionFigure))


def check_place(path: Path) -> None:
    """Raise now what :func:`measures_file` would raise of a place after hours of work: a table of measures is replaced,
    anything else is somebody else's."""
    parquet = _parquet()[1] if path.suffix.lower() == PARQUET else None
    if not path.exists():
        return
    try:
        if parquet is not None:
            head = tuple(parquet.read_schema(path).names)
        else:
            with path.open(newline="", encoding="utf-8") as file:
                head = tuple(next(csv.reader(file), ()))
    except (OSError, ValueError, csv.Error) as cause:  # pyarrow's own are of these
        raise OutputExists(path) from cause
    if head != HEAD:
        raise OutputExists(path)


def _parquet() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as cause:
        raise ExtraMissing("pyarrow") from cause
    return pyarrow, parquet


@contextmanager
def measures_file(path: Path, *, replaces: bool = False) -> Iterator[Callable[[Sequence[SessionFigure]], None]]:
    """A table that takes rows as they come and holds few of them in memory, by the ending of its name ``.parquet`` or
    else CSV; it has its name when all is written.

    Raises :class:`OutputExists`, :class:`OutputNotWritable`, or :class:`ExtraMissing` without pyarrow.
    """
    if path.suffix.lower() != PARQUET:
        with new_bytes(path, replaces=replaces) as file:
            text = io.TextIOWrapper(file, "utf-8", newline="")
            table = csv.writer(text, lineterminator="\n")
            table.writerow(HEAD)
            yield lambda rows: table.writerows(csv_rows(rows))
            text.detach()
        return
    pyarrow, parquet = _parquet()
    by_kind = {"str": pyarrow.string(), "float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_()}
    schema = pyarrow.schema([(field.name, by_kind[str(field.type)]) for field in fields(SessionFigure)])
    waiting: list[SessionFigure] = []
    with new_bytes(path, replaces=replaces) as file, parquet.ParquetWriter(file, schema) as writer:

        def store() -> None:
            columns = list(zip(*map(astuple, waiting), strict=True))
            arrays = [pyarrow.array(values, kind.type) for values, kind in zip(columns, schema, strict=True)]
            writer.write_table(pyarrow.table(arrays, schema=schema))
            waiting.clear()

        def take(rows: Sequence[SessionFigure]) -> None:
            waiting.extend(rows)
            if len(waiting) >= ROWS_AT_ONCE:
                store()

        yield take
        if waiting:
            store()


def write_measures(rows: Sequence[SessionFigure], path: Path, form: TableForm = FOR_PROGRAMS) -> Path:
    """Write the whole table, as :func:`measures_file`; ``form`` of a CSV."""
    if path.suffix.lower() != PARQUET:
        return new_table(path, HEAD, csv_rows(rows), form)
    with measures_file(path) as take:
        take(rows)
    return path


def csv_rows(rows: Sequence[SessionFigure]) -> list[list[str]]:
    """Every row as texts: unknown is empty, numbers to six digits that count."""
    return [[plain_cell(cell(value)) for value in astuple(row)] for row in rows]

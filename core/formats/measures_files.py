"""Table of the measures of many sessions: CSV, or Parquet with the extra ``carpus[research]``."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any

from carpus.core.formats.output_files import (
    MACHINE_DIALECT,
    TableDialect,
    escape_formula,
    format_cell,
    open_new_file,
    write_new_table,
)
from carpus.core.model.errors import ExtraMissing, OutputExists
from carpus.core.results.measures_table import MeasureRow

PARQUET = ".parquet"
BATCH_ROWS = 10_000
MEASURES_HEADER = tuple(field.name for field in fields(MeasureRow))


def check_measures_path(path: Path, columns: Sequence[str] = ()) -> None:
    """Raise before hours of work what :func:`open_measures_file` would raise for a path.

    A table of measures with these further columns may be replaced, any other file may not.
    """
    parquet = _import_pyarrow()[1] if path.suffix.lower() == PARQUET else None
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
    if head != (*MEASURES_HEADER, *columns):
        raise OutputExists(path)


def _import_pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as cause:
        raise ExtraMissing("pyarrow") from cause
    return pyarrow, parquet


@contextmanager
def open_measures_file(
    path: Path, columns: Sequence[str] = (), *, overwrite: bool = False
) -> Iterator[Callable[[Sequence[MeasureRow], Sequence[str]], None]]:
    """Open a table (Parquet by its ending, else CSV) that takes rows as they come, with texts of further columns.

    The file gets its name when it is complete. Raises :class:`OutputExists`, :class:`OutputNotWritable`, or
    :class:`ExtraMissing` without pyarrow.
    """
    if path.suffix.lower() != PARQUET:
        with open_new_file(path, overwrite=overwrite) as file:
            text = io.TextIOWrapper(file, "utf-8", newline="")
            table = csv.writer(text, lineterminator="\n")
            table.writerow((*MEASURES_HEADER, *columns))
            yield lambda rows, facts: table.writerows([*row, *map(escape_formula, facts)] for row in to_csv_rows(rows))
            text.detach()
        return
    pyarrow, parquet = _import_pyarrow()
    by_kind = {"str": pyarrow.string(), "float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_()}
    kinds = [(field.name, by_kind[str(field.type)]) for field in fields(MeasureRow)]
    schema = pyarrow.schema([*kinds, *((name, pyarrow.string()) for name in columns)])
    waiting: list[tuple[Any, ...]] = []
    with open_new_file(path, overwrite=overwrite) as file, parquet.ParquetWriter(file, schema) as writer:

        def write_batch() -> None:
            values = zip(*waiting, strict=True)
            arrays = [pyarrow.array(each, kind.type) for each, kind in zip(values, schema, strict=True)]
            writer.write_table(pyarrow.table(arrays, schema=schema))
            waiting.clear()

        def add_rows(rows: Sequence[MeasureRow], facts: Sequence[str]) -> None:
            waiting.extend((*astuple(row), *facts) for row in rows)
            if len(waiting) >= BATCH_ROWS:
                write_batch()

        yield add_rows
        if waiting:
            write_batch()


def write_measures(rows: Sequence[MeasureRow], path: Path, dialect: TableDialect = MACHINE_DIALECT) -> Path:
    """Write a whole table; ``dialect`` is that of a CSV."""
    if path.suffix.lower() != PARQUET:
        return write_new_table(path, MEASURES_HEADER, to_csv_rows(rows), dialect)
    with open_measures_file(path) as take:
        take(rows, ())
    return path


def to_csv_rows(rows: Sequence[MeasureRow]) -> list[list[str]]:
    """Convert rows to texts: unknown is empty, numbers have six significant digits."""
    return [[escape_formula(format_cell(value)) for value in astuple(row)] for row in rows]

"""The measures of many sessions as one table: CSV, or Parquet with the extra ``carpus[tables]``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any

from carpus.core.errors import ExtraMissing, OutputExists
from carpus.core.formats.csv_tables import plain_text
from carpus.core.formats.new_output import new_bytes, new_table
from carpus.core.output.measures_table import MeasureRow

PARQUET = ".parquet"
HEAD = tuple(field.name for field in fields(MeasureRow))


def check_place(path: Path) -> None:
    """Raise now what :func:`write_measures` would raise of a place after hours of work."""
    if path.exists():
        raise OutputExists(path)
    if path.suffix.lower() == PARQUET:
        _parquet()


def _parquet() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as cause:
        raise ExtraMissing("tables", "pyarrow") from cause
    return pyarrow, parquet


def write_measures(rows: Sequence[MeasureRow], path: Path) -> Path:
    """Write the table by the ending of its name, ``.parquet`` or else CSV.

    Raises :class:`OutputExists`, :class:`OutputNotWritable`, or :class:`ExtraMissing` without pyarrow.
    """
    if path.suffix.lower() != PARQUET:
        return new_table(path, HEAD, csv_rows(rows))
    pyarrow, parquet = _parquet()
    by_kind = {"str": pyarrow.string(), "float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_()}
    schema = pyarrow.schema([(field.name, by_kind[str(field.type)]) for field in fields(MeasureRow)])
    columns = list(zip(*map(astuple, rows), strict=True)) or [()] * len(HEAD)
    arrays = [pyarrow.array(values, kind.type) for values, kind in zip(columns, schema, strict=True)]
    table = pyarrow.table(arrays, schema=schema)
    with new_bytes(path) as file:
        parquet.write_table(table, file)
    return path


def csv_rows(rows: Sequence[MeasureRow]) -> list[list[str]]:
    """Every row as texts: unknown is empty, numbers to six digits that count."""
    return [[_cell(value) for value in astuple(row)] for row in rows]


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    return plain_text(str(value))

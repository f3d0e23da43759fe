"""New files that are complete or absent, and never replace another."""

from __future__ import annotations

import csv
import errno
import io
import json
import math
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from carpus.core.model.errors import OutputExists, OutputNotWritable
from carpus.core.platform.durable import open_private, publish, write_fault

PART_SUFFIX = ".half"
_FORMULA_STARTS = tuple("=+-@\t\r\n")
_NUMBER_PATTERN = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


@contextmanager
def open_new_file(path: Path, *, overwrite: bool = False) -> Iterator[IO[bytes]]:
    """Open a file that gets its name when it is complete; ``overwrite`` replaces an existing one.

    Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; nothing half-done stays.
    """
    if path.exists() and not overwrite:
        raise OutputExists(path)
    half = path.with_name(path.name + PART_SUFFIX)
    try:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            half.unlink(missing_ok=True)  # of a run that was killed
            with open(half, "xb", opener=open_private) as file:
                yield file
            if overwrite:
                half.replace(path)
            else:
                publish(half, path)
        except OSError as cause:
            raise write_fault(path, cause) from cause
    finally:
        with suppress(OSError):  # a disk that can only be read says so of what is not there too
            half.unlink(missing_ok=True)


def require_folder(path: Path) -> None:
    """Raise :class:`OutputNotWritable` if a named file's folder is missing: its name may be misspelt."""
    if not path.parent.is_dir():
        raise OutputNotWritable(path, os.strerror(errno.ENOENT))


def write_new_text(path: Path, text: str, *, overwrite: bool = False) -> Path:
    """Write a text as a new file with line feeds."""
    with open_new_file(path, overwrite=overwrite) as file:
        file.write(text.encode("utf-8"))
    return path


def write_new_json(path: Path, content: Any, *, overwrite: bool = False) -> Path:
    """Write standard JSON as a new file: unknown numbers are null, never NaN."""
    return write_new_text(
        path, json.dumps(nan_to_none(content), indent=2, ensure_ascii=False) + "\n", overwrite=overwrite
    )


@dataclass(frozen=True, slots=True)
class TableDialect:
    """Dialect of a text table; ``has_bom`` lets a spreadsheet recognise UTF-8."""

    separator: str = ","
    decimal: str = "."
    has_bom: bool = False

    def to_cell(self, text: str) -> str:
        """Return a cell that a spreadsheet does not calculate, numbers with the decimal sign.

        >>> TableDialect(";", ",").to_cell("-1.5"), TableDialect(";", ",").to_cell("=1+2")
        ('-1,5', "'=1+2")
        """
        text = escape_formula(text)
        return text.replace(".", self.decimal) if self.decimal != "." and _NUMBER_PATTERN.fullmatch(text) else text


MACHINE_DIALECT = TableDialect()
TAB_DIALECT = TableDialect("\t")


def write_new_table(
    path: Path, head: Sequence[str], rows: Iterable[Iterable[str]], dialect: TableDialect = MACHINE_DIALECT, *,
    overwrite: bool = False,
) -> Path:  # fmt: skip
    """Write a table as a new file; ``head`` may be empty. No cell is a formula."""
    with open_new_file(path, overwrite=overwrite) as file:
        text = io.TextIOWrapper(file, "utf-8-sig" if dialect.has_bom else "utf-8", newline="")
        write_rows(text, head, rows, dialect)
        text.detach()
    return path


def write_rows(
    text: IO[str], head: Sequence[str], rows: Iterable[Iterable[str]], dialect: TableDialect = MACHINE_DIALECT
) -> None:
    """Write a table into a text; ``head`` may be empty."""
    table = csv.writer(text, delimiter=dialect.separator, lineterminator="\n")
    if head:
        table.writerow(head)
    table.writerows([dialect.to_cell(cell) for cell in row] for row in rows)


def escape_formula(text: str) -> str:
    """Return a text that a spreadsheet shows and does not calculate; numbers stay.

    >>> escape_formula("=1+2"), escape_formula("fist"), escape_formula("-1.5e3")
    ("'=1+2", 'fist', '-1.5e3')
    """
    return text if text[:1] not in _FORMULA_STARTS or not text or _NUMBER_PATTERN.fullmatch(text) else f"'{text}"


def format_cell(value: Any) -> str:
    """Format a value of a table: unknown is empty, numbers have six significant digits."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    return str(value)


def nan_to_none(value: Any) -> Any:
    """Replace numbers that are not finite by None, and NumPy's values by plain ones.

    >>> nan_to_none({"a": [1.0, float("nan")]})
    {'a': [1.0, None]}
    """
    if isinstance(value, Mapping):
        return {str(name): nan_to_none(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [nan_to_none(one) for one in value]
    if hasattr(value, "tolist"):
        return nan_to_none(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value

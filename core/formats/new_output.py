"""A new file that is whole or not there, and never takes the place of another."""

from __future__ import annotations

import csv
import errno
import json
import math
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Protocol

from carpus.core.durable import private, write_fault
from carpus.core.errors import OutputExists, OutputNotWritable

HALF = ".half"
_CALCULATED = tuple("=+-@\t\r\n")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


class SupportsWrite(Protocol):
    """What :mod:`csv` writes to."""

    def write(self, text: str, /) -> int: ...


@contextmanager
def new_bytes(path: Path, *, replaces: bool = False) -> Iterator[IO[bytes]]:
    """A file to write, which gets its name only when all of it is written; ``replaces`` the one that has it.

    Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; nothing half-done stays.
    """
    if path.exists() and not replaces:
        raise OutputExists(path)
    half = path.with_name(path.name + HALF)
    try:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            half.unlink(missing_ok=True)  # of a run that was killed
            with open(half, "xb", opener=private) as file:
                yield file
            if replaces:
                half.replace(path)
            else:
                _named(half, path)
        except FileExistsError as cause:
            raise OutputExists(path) from cause
        except OSError as cause:
            raise write_fault(path, cause) from cause
    finally:
        with suppress(OSError):  # a disk that can only be read says so of what is not there too
            half.unlink(missing_ok=True)


def look_for_folder(path: Path) -> None:
    """Where a person names one file its folder is there; none is made: its name may be misspelt.

    Raises :class:`OutputNotWritable`.
    """
    if not path.parent.is_dir():
        raise OutputNotWritable(path, os.strerror(errno.ENOENT))


def new_text(path: Path, text: str, *, replaces: bool = False) -> Path:
    """Write a text as a new file, lines ended by a line feed alone."""
    with new_bytes(path, replaces=replaces) as file:
        file.write(text.encode("utf-8"))
    return path


def new_json(path: Path, content: Any, *, replaces: bool = False) -> Path:
    """Write JSON that every reader takes: what is not known is null, never NaN."""
    return new_text(path, json.dumps(without_nan(content), indent=2, ensure_ascii=False) + "\n", replaces=replaces)


@dataclass(frozen=True, slots=True)
class TableForm:
    """How a table of texts is written. ``has_mark``: begins with the byte order mark, by which a spreadsheet knows
    UTF-8."""

    separator: str = ","
    decimal: str = "."
    has_mark: bool = False

    def to_cell(self, text: str) -> str:
        """A cell as a spreadsheet shows it and does not calculate it, numbers with the form's decimal sign.

        >>> TableForm(";", ",").to_cell("-1.5"), TableForm(";", ",").to_cell("=1+2")
        ('-1,5', "'=1+2")
        """
        text = plain_cell(text)
        return text.replace(".", self.decimal) if self.decimal != "." and _NUMBER.fullmatch(text) else text


FOR_PROGRAMS = TableForm()
"""The same in every country."""
TABS = TableForm("\t")


def new_table(
    path: Path, head: Sequence[str], rows: Iterable[Iterable[str]], form: TableForm = FOR_PROGRAMS, *,
    replaces: bool = False,
) -> Path:  # fmt: skip
    """Write a table row by row; ``head`` may be empty. No cell is calculated by a spreadsheet that opens it."""
    with new_bytes(path, replaces=replaces) as file:
        text = _Encoded(file)
        if form.has_mark:
            text.write("\ufeff")
        write_rows(text, head, rows, form)
    return path


def write_rows(
    text: SupportsWrite, head: Sequence[str], rows: Iterable[Iterable[str]], form: TableForm = FOR_PROGRAMS
) -> None:
    """Write a table into a text; ``head`` may be empty."""
    table = csv.writer(text, delimiter=form.separator, lineterminator="\n")
    if head:
        table.writerow(head)
    table.writerows([form.to_cell(cell) for cell in row] for row in rows)


def plain_cell(text: str) -> str:
    """A cell that a spreadsheet shows and does not calculate; numbers are left as they are.

    >>> plain_cell("=1+2"), plain_cell("fist"), plain_cell("-1.5e3")
    ("'=1+2", 'fist', '-1.5e3')
    """
    return text if text[:1] not in _CALCULATED or not text or _NUMBER.fullmatch(text) else f"'{text}"


def cell(value: Any) -> str:
    """A value as a table has it: unknown is empty, numbers to six digits that count."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    return str(value)


def without_nan(value: Any) -> Any:
    """The same with None for every number that is not finite, and plain numbers for NumPy's.

    >>> without_nan({"a": [1.0, float("nan")]})
    {'a': [1.0, None]}
    """
    if isinstance(value, Mapping):
        return {str(name): without_nan(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(one) for one in value]
    if hasattr(value, "tolist"):
        return without_nan(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value


class _Encoded:
    """What :mod:`csv` writes to, over a file of bytes."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file

    def write(self, text: str) -> int:
        return self._file.write(text.encode("utf-8"))


def _named(half: Path, path: Path) -> None:
    """The name in one step that does not replace; on file systems without links by a look before."""
    try:
        os.link(half, path)
    except FileExistsError:
        raise
    except OSError:
        if path.exists():
            raise FileExistsError(path) from None
        half.rename(path)

"""Reader of people's tables: any separator, decimal sign and encoding, lines before the header, units in names."""

from __future__ import annotations

import csv
import io
import math
import re
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import numpy as np

from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray

MAX_BYTES = 1 << 30
MAX_HEADER_LINE = 200
_SEPARATORS = ";\t,"
_EMPTY_CELLS = ("", "-", "–", "—", "nan", "na", "n/a", "null")
_PLAIN_CHARACTERS = str.maketrans("\N{MINUS SIGN}\N{EN DASH}", "--", " \N{NO-BREAK SPACE}\N{NARROW NO-BREAK SPACE}")
_UNIT_PATTERN = re.compile(r"^(.*?)\s*[(\[]\s*([^()\[\]]*)\s*[)\]]$")
_CLOCK_PATTERN = re.compile(r"^(?:(\d+):)?(\d{1,2}):(\d{1,2}(?:[.,]\d+)?)$")


@dataclass(frozen=True, slots=True)
class TextTable:
    """Cells as texts; ``names`` are unique, ``line_numbers`` are those of the rows in the file."""

    names: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    line_numbers: tuple[int, ...]

    def column(self, name: str) -> list[str]:
        """Return the cells of a column."""
        at = self.names.index(name)
        return [row[at] for row in self.rows]

    def row(self, at: int) -> dict[str, str]:
        """Return a row's cells by the names in lower case."""
        return {name.lower(): cell for name, cell in zip(self.names, self.rows[at], strict=True)}


def read_text(path: Path) -> str:
    """Read a text in UTF-8, UTF-16 or else Windows-1252. Raises :class:`ReferenceUnreadable`."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise ReferenceUnreadable(path, phrase("larger than 1 GB"))
        content = path.read_bytes()
    except OSError as cause:
        raise ReferenceUnreadable(path, cause.strerror or "") from cause
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    zero = content[:400].count(0)
    if zero > len(content[:400]) // 4:  # UTF-16 without its mark
        return content.decode("utf-16-le" if content[1:2] == b"\0" else "utf-16-be", errors="replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def read_table(path: Path, known_names: Collection[str]) -> TextTable:
    """Read the table of a file. Raises :class:`ReferenceUnreadable`.

    Its header is the line with one of ``known_names`` (lower case, without unit), else the one followed by the most
    rows of numbers.
    """
    text = read_text(path)
    separators = _SEPARATORS
    separator_line = re.match(r"\s*\"?sep=(.)\"?[^\n]*\n", text, re.IGNORECASE)
    if separator_line:
        separators, text = separator_line[1], "\n" + text[separator_line.end() :]
    found = [_find_table(text, separator, known_names) for separator in separators]
    best = max((one for one in found if one is not None), key=lambda one: one[0], default=None)
    if best is None:
        raise ReferenceUnreadable(path, phrase("no table"))
    return best[1]


def _find_table(
    text: str, separator: str, known_names: Collection[str]
) -> tuple[tuple[bool, int, int], TextTable] | None:
    """Find the table for one separator and its score, None if there is none."""
    reader = csv.reader(io.StringIO(text), delimiter=separator, skipinitialspace=True)
    try:
        lines = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except csv.Error:
        return None
    lines = [(number, cells) for number, cells in lines if any(cells) and not cells[0].startswith("#")]
    best: tuple[tuple[bool, int, int], int] | None = None
    for k, (_, cells) in enumerate(lines[:MAX_HEADER_LINE]):
        named = [cell for cell in cells if cell]
        if len(named) < 2 or any(math.isfinite(parse_number(cell)) for cell in named) or k + 1 == len(lines):
            continue
        follow = 0
        for _, row in lines[k + 1 : k + 1 + MAX_HEADER_LINE]:
            if len(row) < len(named) or not any(math.isfinite(parse_number(cell)) for cell in row):
                break
            follow += 1
        score = (any(split_unit(cell)[0].lower() in known_names for cell in named), follow, len(named))
        if best is None or score > best[0]:
            best = score, k
    if best is None or not (best[0][0] or best[0][1]):
        return None
    score, k = best
    width = max(place for place, cell in enumerate(lines[k][1], 1) if cell)
    head = [cell or f"column {place}" for place, cell in enumerate(lines[k][1][:width], 1)]
    count, place_of = Counter(head), Counter[str]()
    for place, name in enumerate(head):
        if count[name] > 1:
            place_of[name] += 1
            head[place] = f"{name} #{place_of[name]}"
    rows = [tuple((cells + [""] * width)[:width]) for _, cells in lines[k + 1 :]]
    return score, TextTable(tuple(head), tuple(rows), tuple(number for number, _ in lines[k + 1 :]))


def split_unit(name: str) -> tuple[str, str]:
    """Split a column's name and its unit in brackets (empty for none); ``#2`` of equal names is removed.

    >>> split_unit("Flexion (°)"), split_unit("time [ms]"), split_unit("flexion #2")
    (('Flexion', '°'), ('time', 'ms'), ('flexion', ''))
    """
    name = re.sub(r" #\d+$", "", name)
    found = _UNIT_PATTERN.match(name)
    return (found[1], found[2].strip().lower()) if found and found[1] else (name, "")


def parse_number(text: str | None) -> float:
    """Parse a number as people write it, else NaN: decimal comma or point, any minus, a degree sign.

    >>> parse_number("−0,5"), parse_number("1.234,5"), parse_number("1,234.5"), parse_number("45°")
    (-0.5, 1234.5, 1234.5, 45.0)
    """
    plain = (text or "").strip().translate(_PLAIN_CHARACTERS).rstrip("°")
    if "," in plain:
        point = plain.rfind(".") > plain.rfind(",")
        plain = plain.replace(",", "") if point else plain.replace(".", "").replace(",", ".")
    try:
        value = float(plain)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) and "_" not in plain else math.nan


def is_non_numeric(text: str) -> bool:
    """Return whether a cell holds something that is neither a number nor a mark for none."""
    return text.strip().lower() not in _EMPTY_CELLS and not math.isfinite(parse_number(text))


def parse_cell(cell: str) -> float:
    """Parse a number, NaN for an empty cell. Raises ValueError for anything else."""
    if is_non_numeric(cell):
        raise ValueError(f"“{cell[:20]}” is no number")
    return parse_number(cell)


def check_times(time_s: FloatArray, path: Path) -> FloatArray:
    """Return times (K,) that increase. Raises :class:`ReferenceUnreadable` for others."""
    if not np.isfinite(time_s).all() or (np.diff(time_s) <= 0.0).any():
        raise ReferenceUnreadable(path, phrase("times out of order"))
    return time_s


def parse_times(cells: Sequence[str]) -> tuple[list[float], bool]:
    """Parse times (K,), NaN for none, and return whether they were clock times.

    Clock times (h:mm:ss.f, mm:ss.f) and dates with one become seconds, also past midnight.
    """
    numbers = [parse_number(cell) for cell in cells]
    if sum(map(math.isfinite, numbers)) * 2 >= len(numbers):
        return numbers, False
    times: list[float] = []
    day_s, before_s = 0.0, -math.inf
    for cell in cells:
        time_s = _clock_s(cell.strip())
        if time_s + day_s < before_s - 12 * 3600.0:
            day_s += 24 * 3600.0
        times.append(time_s + day_s)
        before_s = times[-1] if math.isfinite(times[-1]) else before_s
    return times, True


def _clock_s(text: str) -> float:
    found = _CLOCK_PATTERN.match(text)
    if found:
        return 3600.0 * int(found[1] or 0) + 60.0 * int(found[2]) + float(found[3].replace(",", "."))
    try:
        return datetime.fromisoformat(text.replace(",", ".")).timestamp() if ":" in text else math.nan
    except (ValueError, OverflowError, OSError):
        return math.nan

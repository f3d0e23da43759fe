"""Reader of OpenSim's texts: TRC (points) and MOT or STO (columns over time)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from carpus.core.formats.c3d_read import PointTrack, zeros_to_nan
from carpus.core.formats.table_read import is_non_numeric, parse_number, read_text
from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray

_METRES = {"mm": 1e-3, "m": 1.0, "cm": 1e-2}


@dataclass(frozen=True, slots=True)
class TimeTable:
    """Named columns over ``time_s`` (K,), NaN for none; ``in_degrees`` is None if the file does not say."""

    time_s: FloatArray
    values: dict[str, FloatArray]
    in_degrees: bool | None


def read_trc(path: Path) -> PointTrack:
    """Read the points of a TRC file. Raises :class:`ReferenceUnreadable`."""
    lines = read_text(path).splitlines()
    if len(lines) < 6 or not lines[0].startswith("PathFileType"):
        raise ReferenceUnreadable(path, "no TRC")
    tab = "\t" if "\t" in lines[0] else ","
    head = dict(zip(lines[1].split(tab), lines[2].split(tab), strict=False))
    unit = head.get("Units", "mm").strip().lower()
    if unit not in _METRES:
        raise ReferenceUnreadable(path, phrase("unit {unit}", unit=unit))
    names = [name.strip() for name in lines[3].split(tab)[2:] if name.strip()]
    rows = [line.split(tab) for line in lines[5:] if line.strip(f"{tab} ")]
    width = 2 + 3 * len(names)
    if not names or not rows:
        raise ReferenceUnreadable(path, phrase("no points"))
    try:
        table = np.array([[_parse_cell(cell) for cell in (row + [""] * width)[:width]] for row in rows])
    except ValueError as cause:
        raise ReferenceUnreadable(path, str(cause)) from cause
    place_m = table[:, 2:].reshape(len(rows), len(names), 3) * _METRES[unit]
    return PointTrack(_check_times(table[:, 1], path), tuple(names), zeros_to_nan(place_m), unit)


def read_mot(path: Path) -> TimeTable:
    """Read the columns of a MOT or STO file. Raises :class:`ReferenceUnreadable`."""
    lines = read_text(path).splitlines()
    ends = [k for k, line in enumerate(lines) if line.strip(", ").lower() == "endheader"]
    if not ends or ends[0] + 1 >= len(lines):
        raise ReferenceUnreadable(path, phrase("not MOT: the header has no end"))
    header = dict(line.lower().replace(" ", "").rstrip(",").split("=", 1) for line in lines[: ends[0]] if "=" in line)
    tab = "," if "," in lines[ends[0] + 1] else None  # None: any white space
    names = lines[ends[0] + 1].split(tab)
    rows = [line.split(tab) for line in lines[ends[0] + 2 :] if line.strip(", ")]
    try:
        table = np.array([[_parse_cell(cell) for cell in row] for row in rows])
    except ValueError as cause:
        raise ReferenceUnreadable(path, phrase("rows of different length, or not numbers")) from cause
    if table.ndim != 2 or table.shape[1] != len(names) or names[0].lower() != "time":
        raise ReferenceUnreadable(path, phrase("columns do not match their names"))
    columns = {name: table[:, k] for k, name in enumerate(names) if k}
    in_degrees = header.get("indegrees")
    return TimeTable(
        _check_times(table[:, 0], path), columns, None if in_degrees is None else in_degrees.startswith("y")
    )


def _parse_cell(cell: str) -> float:
    """Parse a number, NaN for an empty cell. Raises ValueError for anything else."""
    if is_non_numeric(cell):
        raise ValueError(f"“{cell[:20]}” is no number")
    return parse_number(cell)


def _check_times(time_s: FloatArray, path: Path) -> FloatArray:
    if not np.isfinite(time_s).all() or (np.diff(time_s) <= 0.0).any():
        raise ReferenceUnreadable(path, phrase("times out of order"))
    return time_s

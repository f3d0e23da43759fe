"""Another measurement of the same movement: points, angles over time, or single readings."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np

from carpus.core.errors import ReferenceUnreadable
from carpus.core.formats.c3d_read import read_c3d
from carpus.core.formats.opensim_read import Columns, read_mot, read_trc, text_of
from carpus.core.hand.protocols import SITES, WRIST_ANGLES, joint_angle_names
from carpus.core.phrase import phrase
from carpus.core.results.seen import best_motion
from carpus.core.session.reader import read_session
from carpus.core.types import FloatArray

POINT_FILES, ANGLE_FILES, TABLE_FILES = (".c3d", ".trc"), (".mot", ".sto"), (".csv", ".tsv", ".txt")
SESSION_FILES = (".h5", ".part")
TIME_NAMES = ("time_s", "timestamp_s", "time", "since_start_s", "t")
ANGLE_NAMES = (*WRIST_ANGLES, *joint_angle_names(True))
DIRECTIONS = {
    "flexion": ("flexion", 1.0),
    "extension": ("flexion", -1.0),
    "radial": ("deviation", 1.0),
    "ulnar": ("deviation", -1.0),
    "supination": ("pronosupination", 1.0),
    "pronation": ("pronosupination", -1.0),
}
"""What a goniometer's list calls the two ways of each angle."""


@dataclass(frozen=True, slots=True)
class GoniometerReading:
    """One reading of a goniometer, radians with the signs of Carpus; ``time_s`` after the first picture, NaN where it
    is of the whole session's range in the way of ``movement``."""

    angle: str
    movement: str
    value_rad: float
    time_s: float


@dataclass(frozen=True, slots=True)
class Reference:
    """``kind`` in words; times from the reference's own clock. Either ``angles_rad`` over ``time_s``, or ``points_m``
    by marker (K, 3), or ``readings``. ``unused`` says what was left aside, and why."""

    path: Path
    kind: str
    time_s: FloatArray = field(default_factory=lambda: np.empty(0))
    angles_rad: Mapping[str, FloatArray] = field(default_factory=dict)
    points_m: Mapping[str, FloatArray] = field(default_factory=dict)
    readings: tuple[GoniometerReading, ...] = ()
    unused: tuple[str, ...] = ()
    same_clock: bool = False
    """Whether its times are those of the session's own pictures."""


@dataclass(frozen=True, slots=True)
class ReferenceOutline:
    """What a reference is made of: ``names`` of its markers or columns, and ``found`` ours to theirs by their names
    (``time`` among them), before anybody says which is which."""

    path: Path
    kind: Literal["points", "angles", "readings", "session"]
    names: tuple[str, ...] = ()
    found: Mapping[str, str] = field(default_factory=dict)


def outline_of(path: Path) -> ReferenceOutline:
    """The outline of a reference. Raises :class:`ReferenceUnreadable`."""
    suffix = path.suffix.lower()
    if suffix in POINT_FILES:
        track = read_c3d(path) if suffix == ".c3d" else read_trc(path)
        there = {_plain(name): name for name in track.names}
        return ReferenceOutline(path, "points", track.names, {name: there[name] for name in SITES if name in there})
    if suffix in TABLE_FILES:
        _, head, low = _rows_of(path)
        if _is_list(low):
            return ReferenceOutline(path, "readings")
        time = {"time": _time_name(low)} if _time_name(low) else {}
        return ReferenceOutline(path, "angles", tuple(head), time | _found(head))
    if suffix in ANGLE_FILES:
        values = read_mot(path).values
        return ReferenceOutline(path, "angles", tuple(values), {"time": "time"} | _found(values))
    if suffix in SESSION_FILES:
        return ReferenceOutline(path, "session")
    raise ReferenceUnreadable(path, phrase("no reader for {value}", value=suffix or "a file without an ending"))


def _found(columns: Iterable[str]) -> dict[str, str]:
    named = {name: _column(name, {}, columns)[0] for name in ANGLE_NAMES}
    return {name: column for name, column in named.items() if column}


def read_reference(
    path: Path,
    columns: Mapping[str, str] | None = None,
    markers: Mapping[str, str] | None = None,
    radians: bool | None = None,
    smoothed: bool = False,
) -> Reference:
    """A reference by its ending. ``columns`` angle (or ``time``) to column, a minus before it turns the sign;
    ``markers`` ours to theirs; ``radians`` overrules what the file says; ``smoothed``: of a
    session the smoother's result where there is one, else the filter's. Raises :class:`ReferenceUnreadable`, and for a
    session what reading it raises."""
    suffix = path.suffix.lower()
    if suffix in POINT_FILES:
        return _of_points(path, suffix, markers or {})
    if suffix in ANGLE_FILES:
        return _of_angles(
            path, phrase("angles by {format}", format=suffix[1:].upper()), read_mot(path), columns or {}, radians
        )
    if suffix in TABLE_FILES:
        return _of_table(path, columns or {}, radians)
    if suffix in SESSION_FILES:
        return _of_session(path, smoothed)
    raise ReferenceUnreadable(path, phrase("no reader for {value}", value=suffix or "a file without an ending"))


def _of_session(path: Path, smoothed: bool) -> Reference:
    session = read_session(path)
    motion = best_motion(session) if smoothed else session.motion
    names = (*WRIST_ANGLES, *session.header.joint_names)
    values = np.column_stack((motion.angles_rad, motion.joint_angles_rad))
    words = f"session {session.header.session_id}" + (", simulated" if session.header.simulated else "")
    return Reference(
        path, words, session.timestamp_s, {name: values[:, k] for k, name in enumerate(names)}, same_clock=True
    )


def _of_points(path: Path, suffix: str, markers: Mapping[str, str]) -> Reference:
    track = read_c3d(path) if suffix == ".c3d" else read_trc(path)
    there = {_plain(name): k for k, name in enumerate(track.names)}
    points = {}
    for name in SITES:
        wanted = _plain(markers.get(name, name))
        if wanted in there:
            points[name] = track.place_m[:, there[wanted]]
        elif name in markers:
            raise ReferenceUnreadable(path, phrase("it has no marker {markers}", markers=markers[name]))
    used = {_plain(markers.get(name, name)) for name in points}
    left = [name for name in track.names if _plain(name) not in used]
    unused = _left(phrase("markers"), left, phrase("none of the discs by their names"))
    return Reference(
        path, phrase("points by {format}", format=suffix[1:].upper()), track.time_s, points_m=points, unused=unused
    )


def _plain(name: str) -> str:
    """A marker without the subject before it, in large letters."""
    return name.split(":")[-1].strip().upper()


def _of_angles(path: Path, kind: str, table: Columns, columns: Mapping[str, str], radians: bool | None) -> Reference:
    in_radians = radians if radians is not None else table.in_degrees is False
    found, used = {}, set()
    for name in ANGLE_NAMES:
        column, sign = _column(name, columns, table.values)
        if not column and name in columns:
            raise ReferenceUnreadable(path, phrase("it has no column {value}", value=columns[name].lstrip("-")))
        if column:
            used.add(column)
            values = sign * table.values[column]
            found[name] = values if in_radians else np.radians(values)
    left = [name for name in table.values if name not in used]
    return Reference(
        path, kind, table.time_s, found, unused=_left(phrase("columns"), left, phrase("no angles by their names"))
    )


def _left(what: str, names: Sequence[str], why: str) -> tuple[str, ...]:
    if not names:
        return ()
    shown = phrase("{names}", names=", ".join(names[:4]))
    if len(names) > 4:
        shown = phrase("{names} and {count} more", names=shown, count=len(names) - 4)
    return (phrase("{what} {names}: {why}", what=what, names=shown, why=why),)


def _column(name: str, columns: Mapping[str, str], there: Iterable[str]) -> tuple[str, float]:
    """The column of an angle, and its sign; empty where there is none."""
    if name in columns:
        wanted = columns[name]
        return (
            (wanted.lstrip("-"), -1.0 if wanted.startswith("-") else 1.0) if wanted.lstrip("-") in there else ("", 1.0)
        )
    own = {f"{name}{end}" for end in ("", "_deg", "_rad", "_r", "_l")} | {
        f"wrist_{name}{end}" for end in ("", "_r", "_l")
    }
    lower = {one.lower() for one in own}
    return next((column for column in there if column.lower() in lower), ""), 1.0


def _rows_of(path: Path) -> tuple[list[dict[str, str]], list[str], dict[str, str]]:
    """Rows of a table, its head, and the head by names in small letters."""
    text = text_of(path)
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    if len(lines) < 2:
        raise ReferenceUnreadable(path, phrase("it holds no table"))
    separator = max("\t;,", key=lines[0].count)
    rows = list(csv.DictReader(io.StringIO("\n".join(lines)), delimiter=separator))
    head = [name for name in rows[0] if name]
    return rows, head, {name.strip().lower(): name for name in head}


def _time_name(low: Mapping[str, str]) -> str:
    return next((low[name] for name in TIME_NAMES if name in low), "")


def _is_list(low: Mapping[str, str]) -> bool:
    return "angle" in low or "movement" in low


def _of_table(path: Path, columns: Mapping[str, str], radians: bool | None) -> Reference:
    rows, head, low = _rows_of(path)
    if _is_list(low):
        return _of_readings(path, rows, low)
    time_name = columns.get("time") or _time_name(low)
    if time_name not in head:
        raise ReferenceUnreadable(path, phrase("it has no column of times; say which it is"))
    time_s = np.array([_number(row[time_name]) for row in rows])
    known = np.isfinite(time_s)
    if known.sum() < 2 or (np.diff(time_s[known]) <= 0.0).any():
        raise ReferenceUnreadable(path, phrase("its times do not rise"))
    values = {}
    for name in head:
        if name != time_name:
            column = np.array([_number(row[name]) for row in rows])[known]
            if np.isfinite(column).any():
                values[name] = column
    if radians is None and any(name.lower().endswith("_rad") for name in values):
        radians = not any(name.lower().endswith("_deg") for name in values)
    return _of_angles(path, phrase("angles by table"), Columns(time_s[known], values, None), columns, radians)


def _of_readings(path: Path, rows: list[dict[str, str]], low: Mapping[str, str]) -> Reference:
    """A goniometer's list: ``angle`` or ``movement``, ``reading_deg``, and ``time_s`` where it was noted."""
    value_name = next(
        (low[n] for n in ("reading_deg", "value_deg", "deg", "reading", "value", "angle_deg") if n in low), ""
    )
    time_name = _time_name(low)
    if not value_name:
        raise ReferenceUnreadable(path, phrase("it has no column reading_deg"))
    readings, unused = [], []
    for k, row in enumerate(rows, start=2):
        said = (row.get(low.get("movement", ""), "") or row.get(low.get("angle", ""), "") or "").strip()
        value = _number(row[value_name])
        name = next((one for one in ANGLE_NAMES if one.lower() == said.lower()), "")
        movement, sign = said.lower(), 1.0
        if movement in DIRECTIONS and (name in ("", "flexion")):
            name, sign = DIRECTIONS[movement]
        if not name or not math.isfinite(value):
            unused.append(f"line {k}: " + ("no reading" if name else f"no angle is called {said or 'nothing'}"))
            continue
        time_s = _number(row[time_name]) if time_name else math.nan
        readings.append(GoniometerReading(name, movement, sign * math.radians(value), time_s))
    if not readings:
        raise ReferenceUnreadable(path, phrase("it holds no reading"))
    return Reference(path, phrase("goniometer list"), readings=tuple(readings), unused=tuple(unused))


def _number(text: str | None) -> float:
    """A number as people write it; a comma may stand for the point."""
    try:
        return float((text or "").strip().replace(",", "."))
    except ValueError:
        return math.nan

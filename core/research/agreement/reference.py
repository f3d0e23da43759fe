"""Readers of a reference measurement: points, angles over time, or single readings."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from carpus.core.formats.c3d import read_c3d
from carpus.core.formats.mot import TimeTable, read_mot
from carpus.core.formats.table_read import TextTable, is_non_numeric, parse_number, parse_times, read_table, split_unit
from carpus.core.formats.trc import read_trc
from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.hand.forearm_rotation import pronosupination_from_palm_down
from carpus.core.model.hand.protocols import SITES, WRIST_ANGLES, joint_angle_names
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray, Side
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.reader import read_session

POINT_FILES, ANGLE_FILES, TABLE_FILES = (".c3d", ".trc"), (".mot", ".sto"), (".csv", ".tsv", ".txt")
TIME_NAMES = (
    *("time_s", "timestamp_s", "time", "since_start_s", "t", "time_ms", "timestamp_ms", "timestamp"),
    *("zeit", "tempo"),
)
SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "msec": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6, "min": 60.0}
TIME_UNITS_BY_STEP = ((500.0, 1e-6, "µs"), (0.5, 1e-3, "ms"))
"""Unit of times without one, by their least step between two rows."""
SIDE_PATTERN = re.compile(
    r"^(?:(r|right|rechts|re|destra|dx)|(l|left|links|li|sinistra|sx))[:_ .]|"
    r"[_ .](?:(r|right|rechts|re|destra|dx)|(l|left|links|li|sinistra|sx))$",
    re.IGNORECASE,
)
"""Side in the names of markers and columns."""
MAX_LISTED = 24
ANGLE_NAMES = (*WRIST_ANGLES, *joint_angle_names(True))
MOVEMENTS = {
    "flexion": ("flexion", 1.0),
    "extension": ("flexion", -1.0),
    "radial": ("deviation", 1.0),
    "ulnar": ("deviation", -1.0),
    "supination": ("pronosupination", 1.0),
    "pronation": ("pronosupination", -1.0),
}
"""Movements of a goniometer list with their angle and sign."""
KNOWN_NAMES = frozenset((*TIME_NAMES, "angle", "movement", *(name.lower() for name in ANGLE_NAMES)))


@dataclass(frozen=True, slots=True)
class GoniometerReading:
    """Goniometer reading, rad, with the signs of Carpus.

    ``time_s`` counts from the first frame, NaN for the range of the whole session. ``pronosupination`` is from the palm
    down, as in every file, also if it was read from thumb up.
    """

    angle: str
    movement: str
    value_rad: float
    time_s: float


@dataclass(frozen=True, slots=True)
class Reference:
    """Reference measurement: ``angles_rad`` over ``time_s``, or ``points_m`` (K, 3) by marker, or ``readings``.

    ``unused`` lists what was not used, and why.
    """

    path: Path
    kind: str
    time_s: FloatArray = field(default_factory=lambda: np.empty(0))
    angles_rad: Mapping[str, FloatArray] = field(default_factory=dict)
    points_m: Mapping[str, FloatArray] = field(default_factory=dict)
    readings: tuple[GoniometerReading, ...] = ()
    unused: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    """All markers or columns."""
    remarks: tuple[str, ...] = ()
    """Assumptions made in reading it."""
    same_clock: bool = False
    """True if its times are those of the session's frames."""


def read_reference(
    path: Path,
    columns: Mapping[str, str] | None = None,
    markers: Mapping[str, str] | None = None,
    radians: bool | None = None,
    smoothed: bool = False,
    hand: Side | None = None,
) -> Reference:
    """Read a reference by its file name extension. Raises :class:`ReferenceUnreadable`.

    Parameters
    ----------
    path
        file
    columns
        angle (or ``time``) to column; a minus before the column turns the sign
    markers
        our marker names to those of the file
    radians
        overrules the file's unit
    smoothed
        of a session the smoother's result if there is one
    hand
        side to use if the file has both hands
    """
    suffix = path.suffix.lower()
    if suffix in POINT_FILES:
        return _from_points(path, suffix, markers or {}, hand)
    if suffix in ANGLE_FILES:
        kind = phrase("angles from {format}", format=suffix[1:].upper())
        return _from_angles(path, kind, read_mot(path), columns or {}, radians, hand)
    if suffix in TABLE_FILES:
        return _from_table(path, columns or {}, radians, hand)
    if suffix == ".h5":
        return _from_session(path, smoothed)
    raise ReferenceUnreadable(path, phrase("unknown file format {value}", value=suffix or "a file without an ending"))


def _from_session(path: Path, smoothed: bool) -> Reference:
    session = read_session(path)
    motion = motion_estimate(session) if smoothed else session.motion
    names = (*WRIST_ANGLES, *session.header.joint_names)
    values = np.column_stack((motion.angles_rad, motion.joint_angles_rad))
    words = f"session {session.header.session_id}" + (", simulated" if session.header.is_simulated else "")
    angles = {name: values[:, k] for k, name in enumerate(names)}
    return Reference(path, words, session.timestamp_s, angles, same_clock=True)


def _from_points(path: Path, suffix: str, markers: Mapping[str, str], hand: Side | None) -> Reference:
    track = read_c3d(path) if suffix == ".c3d" else read_trc(path)
    by_whole, by_plain = defaultdict[str, list[int]](list), defaultdict[str, list[int]](list)
    for k, name in enumerate(track.names):
        by_whole[name.strip().upper()].append(k)
        by_plain[name.split(":")[-1].strip().upper()].append(k)  # without the subject
    taken: dict[str, int] = {}
    for name in SITES:
        wanted = markers.get(name, name).strip().upper()
        found = by_whole[wanted] or by_plain[wanted]
        if found:
            taken[name] = _select_hand(path, wanted, found, track.names, hand)
        elif name in markers:
            facts = {"wanted": markers[name], "names": list_names(track.names)}
            raise ReferenceUnreadable(path, phrase("no marker {wanted}, only {names}", **facts))
    taken = {name: k for name, k in taken.items() if np.isfinite(track.position_m[:, k]).any()}
    others = [name for k, name in enumerate(track.names) if k not in taken.values()]
    reason = phrase("unknown marker name, marker of the other hand, or never visible")
    unused = _list_unused(phrase("markers"), others, reason)
    return Reference(
        path, phrase("points from {format}", format=suffix[1:].upper()), track.time_s,
        points_m={name: track.position_m[:, k] for name, k in taken.items()}, unused=unused, names=track.names,
        remarks=_hand_remarks([track.names[k] for name, k in taken.items() if name not in markers], track.names, hand),
    )  # fmt: skip


def _select_hand(path: Path, wanted: str, candidates: Sequence[int], names: Sequence[str], hand: Side | None) -> int:
    """Return the candidate of the hand. Raises :class:`ReferenceUnreadable` unless there is one."""
    if len(candidates) == 1:
        return candidates[0]
    of_hand = [k for k in candidates if _parse_side(names[k]) == hand]
    if hand is None or len(of_hand) != 1:
        facts = {"several": list_names([names[k] for k in candidates]), "wanted": wanted}
        raise ReferenceUnreadable(path, phrase("{several} found for {wanted}: state which one applies", **facts))
    return of_hand[0]


def _parse_side(name: str) -> Side | None:
    found = SIDE_PATTERN.search(split_unit(name)[0])
    return None if found is None else "right" if found[1] or found[3] else "left"


def _hand_remarks(used_names: Sequence[str], names: Sequence[str], hand: Side | None) -> tuple[str, ...]:
    """Return a remark if the names tell which hand was used, or that it is the other one."""
    others = [name for name in used_names if hand is not None and _parse_side(name) not in (None, hand)]
    if others:
        return (phrase("{names}: their names belong to the other hand", names=list_names(others)),)
    if hand is not None and any(map(_parse_side, used_names)) and {"left", "right"} <= set(map(_parse_side, names)):
        return (phrase("the reference contains both hands: {names} are used", names=list_names(used_names)),)
    return ()


def list_names(names: Sequence[str]) -> str:
    """Return names as a list that fits a sentence."""
    if not names:
        return phrase("nothing")
    shown = ", ".join(names[:MAX_LISTED])
    if len(names) > MAX_LISTED:
        return phrase("{names} and {count} more", names=shown, count=len(names) - MAX_LISTED)
    return shown


def _from_angles(
    path: Path, kind: str, table: TimeTable, columns: Mapping[str, str], radians: bool | None, hand: Side | None
) -> Reference:
    in_radians = radians if radians is not None else table.in_degrees is False
    names = list(table.values)
    found, taken = {}, set[str]()
    for name in ANGLE_NAMES:
        wanted = columns.get(name, "")
        sign = -1.0 if wanted.startswith("-") and wanted not in names else 1.0
        wanted = wanted if sign > 0.0 else wanted[1:]
        if wanted:
            candidates = [one for one in names if one.lower() == wanted.lower()]
            candidates = candidates or [one for one in names if split_unit(one)[0].lower() == wanted.lower()]
            if not candidates:
                facts = {"wanted": wanted, "names": list_names(names)}
                raise ReferenceUnreadable(path, phrase("no column {wanted}, only {names}", **facts))
        else:
            candidates = _find_columns(name, names)
        if candidates:
            column = names[_select_hand(path, wanted or name, [names.index(one) for one in candidates], names, hand)]
            taken.add(column)
            values = sign * table.values[column]
            found[name] = values if in_radians else np.radians(values)
    others = [name for name in names if name not in taken]
    unused = _list_unused(phrase("columns"), others, phrase("unknown angle name, or angle of the other hand"))
    given = {column.removeprefix("-") for column in columns.values()}
    remarks = _hand_remarks([column for column in names if column in taken and column not in given], names, hand)
    return Reference(path, kind, table.time_s, found, unused=unused, names=tuple(names), remarks=remarks)


def _list_unused(kind: str, names: Sequence[str], reason: str) -> tuple[str, ...]:
    if not names:
        return ()
    shown = phrase("{names}", names=", ".join(names[:4]))
    if len(names) > 4:
        shown = phrase("{names} and {count} more", names=shown, count=len(names) - 4)
    return (phrase("{what} {names}: {why}", what=kind, names=shown, why=reason),)


def _find_columns(name: str, columns: Iterable[str]) -> list[str]:
    """Return the columns of an angle, whatever their side and unit."""
    own = {f"{before}{name}{end}".lower() for before in ("", "wrist_") for end in ("", "_deg", "_rad")}
    return [column for column in columns if SIDE_PATTERN.sub("", split_unit(column)[0]).lower() in own]


def _find_time_column(table: TextTable) -> str:
    by_base = {split_unit(name)[0].lower(): name for name in reversed(table.names)}
    return next((by_base[name] for name in TIME_NAMES if name in by_base), "")


def _from_table(path: Path, columns: Mapping[str, str], radians: bool | None, hand: Side | None) -> Reference:
    given = (split_unit(name.removeprefix("-"))[0].lower() for name in columns.values())
    table = read_table(path, {*KNOWN_NAMES, *given})
    if {"angle", "movement"} & {split_unit(name)[0].lower() for name in table.names}:
        return _from_readings(path, table)
    time_name = columns.get("time") or _find_time_column(table)
    time_name = next((name for name in table.names if time_name in (name, split_unit(name)[0])), time_name)
    if time_name not in table.names:
        listed = list_names(table.names)
        raise ReferenceUnreadable(path, phrase("no time column: state which of {names} it is", names=listed))
    time_s, remarks = _parse_times(path, time_name, table.column(time_name))
    # A row with the time of the row before is excluded.
    known = np.flatnonzero(np.isfinite(time_s))
    rises = np.append(True, np.diff(time_s[known]) > 0.0) if len(known) else np.empty(0, bool)
    if len(known) < 2 or (np.diff(time_s[known]) < 0.0).any():
        raise ReferenceUnreadable(path, phrase("times out of order"))
    if not rises.all():
        remarks.append(
            phrase("rows with the time of the previous row were excluded ({count})", count=int((~rises).sum()))
        )
    known = known[rises]
    values = {}
    for name in table.names:
        cells = table.column(name)
        if name != time_name:
            column = np.array([parse_number(cells[k]) for k in known])
            if np.isfinite(column).any():
                values[name] = column
            is_angle = np.isfinite(column).any() or any(_find_columns(angle, (name,)) for angle in ANGLE_NAMES)
            if is_angle and (bad := _number_remark(name, cells, table.line_numbers)):
                remarks.append(bad)
    if radians is None and any(_has_unit(name, "rad") for name in values):
        radians = not any(_has_unit(name, "deg") for name in values)
    table_values = TimeTable(time_s[known], values, None)
    found = _from_angles(path, phrase("angles from a table"), table_values, columns, radians, hand)
    return replace(found, remarks=(*found.remarks, *remarks))


def _has_unit(name: str, unit: str) -> bool:
    return name.lower().endswith(f"_{unit}") or split_unit(name)[1] == unit


def _number_remark(name: str, cells: Sequence[str], line: Sequence[int]) -> str:
    """Return a remark on the cells that are no number, empty if all are."""
    bad = [(number, cell) for number, cell in zip(line, cells, strict=True) if is_non_numeric(cell)]
    if not bad:
        return ""
    return phrase(
        "{name}: cells that are not numbers were excluded ({count}), the first is “{cell}” in line {line}",
        name=name, count=len(bad), cell=bad[0][1][:20], line=bad[0][0],
    )  # fmt: skip


def _parse_times(path: Path, name: str, cells: Sequence[str]) -> tuple[FloatArray, list[str]]:
    """Return times (K,) in seconds by the column's name or its step, with remarks."""
    times, are_clocks = parse_times(cells)
    time_s, base = np.array(times), split_unit(name)
    known = time_s[np.isfinite(time_s)]
    if len(known) < len(cells) / 2:
        raise ReferenceUnreadable(path, phrase("the cells of {name} are not times", name=name))
    if are_clocks:
        return time_s, []
    unit = base[1] or base[0].lower().rpartition("_")[2]
    if unit in SECONDS:
        return time_s * SECONDS[unit], []
    step = float(np.median(np.diff(known))) if len(known) > 1 else 0.0
    for least, scale, named in TIME_UNITS_BY_STEP:
        if step >= least:
            facts = {"name": name, "unit": named, "step": f"{step:g}"}
            return time_s * scale, [phrase("{name}: read as {unit}, because there is a row every {step}", **facts)]
    return time_s, []


def _from_readings(path: Path, table: TextTable) -> Reference:
    """Read a goniometer list: ``angle`` or ``movement``, ``reading_deg``, optional ``time_s``."""
    low = {split_unit(name)[0].lower(): name.lower() for name in reversed(table.names)}
    value_names = ("reading_deg", "value_deg", "deg", "reading", "value", "angle_deg")
    value_name = next((low[name] for name in value_names if name in low), "")
    time_name = _find_time_column(table)
    if not value_name:
        listed = list_names(table.names)
        raise ReferenceUnreadable(path, phrase("no column reading_deg, only {names}", names=listed))
    times_s = parse_times(table.column(time_name))[0] if time_name else [math.nan] * len(table.rows)
    scale = SECONDS.get(split_unit(time_name)[1] or time_name.lower().rpartition("_")[2], 1.0)
    readings, unused = [], []
    for k, line in enumerate(table.line_numbers):
        row = table.row(k)
        text = (row.get(low.get("movement", ""), "") or row.get(low.get("angle", ""), "")).strip()
        value = parse_number(row[value_name])
        name = next((one for one in ANGLE_NAMES if one.lower() == text.lower()), "")
        movement, sign = text.lower(), 1.0
        if movement in MOVEMENTS and (name in ("", "flexion")):
            name, sign = MOVEMENTS[movement]
        if not name or not math.isfinite(value):
            unused.append(
                phrase("line {line}: “{cell}” is not a reading", line=line, cell=row[value_name])
                if name
                else phrase("line {line}: there is no angle called {said}", line=line, said=text or phrase("nothing"))
            )
            continue
        value_rad = sign * math.radians(value)
        if movement in ("supination", "pronation"):
            value_rad = float(pronosupination_from_palm_down(np.array(value_rad)))
        readings.append(GoniometerReading(name, movement, value_rad, scale * times_s[k]))
    if not readings:
        raise ReferenceUnreadable(path, phrase("no readings"))
    return Reference(path, phrase("goniometer list"), readings=tuple(readings), unused=tuple(unused))

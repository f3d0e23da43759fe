"""MOT of OpenSim: angles of a session, and columns of other programs (MOT or STO).

Written are wrist and joint angles in degrees at uniform times; unknown is NaN. ``NAME.mot`` has the filter's result,
``NAME.smoothed.mot`` the smoother's. Columns end with the side as in OpenSim: ``wrist_flexion_r``, ``mcp2_flexion_l``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from carpus.core.formats.export_item import ANGLE_DEFINITIONS, ExportItem
from carpus.core.formats.measures_table import positive_direction
from carpus.core.formats.output_files import write_new_json, write_new_text
from carpus.core.formats.table_read import check_times, parse_cell, read_text
from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray
from carpus.core.session.values import Motion, Session


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.mot``, ``NAME.smoothed.mot`` if there is one, and ``NAME.mot.json``; return their paths."""
    session, even = take.session, take.times
    out = []
    for motion, name in ((session.motion, take.name), (session.smoothed, f"{take.name}.smoothed")):
        if motion is not None:
            lines = (f"{line}\n" for line in _lines(take, motion, name))
            out.append(write_new_text(folder / f"{name}.mot", "".join(lines)))
    about = {
        "columns": column_names(session),
        "angles": ANGLE_DEFINITIONS,
        "positive": {
            column: positive_direction(name)
            for column, name in zip(column_names(session), _angle_names(session), strict=True)
        },
        "estimate": {path.name: "smoother" if path.name.endswith(".smoothed.mot") else "filter" for path in out},
        "sampling": f"even, {even.rate_hz:.6g} a second, on the line between two pictures; NaN across a gap",
        "time_zero_timestamp_s": even.start_s,
        "missing": "NaN",
        "provenance": take.provenance,
    }
    return [*out, write_new_json(folder / f"{take.name}.mot.json", about)]


def column_names(session: Session) -> list[str]:
    """Return the angles' names in OpenSim, in file order."""
    side = session.header.hand[0]
    return [f"{'wrist_' if name in WRIST_ANGLES else ''}{name.lower()}_{side}" for name in _angle_names(session)]


def _angle_names(session: Session) -> tuple[str, ...]:
    return (*WRIST_ANGLES, *session.header.joint_names)


def _lines(take: ExportItem, motion: Motion, name: str) -> Iterator[str]:
    session, even = take.session, take.times
    labels = column_names(session)
    yield name
    yield "version=1"
    yield f"nRows={len(even)}"
    yield f"nColumns={1 + len(labels)}"
    yield "inDegrees=yes"
    yield ""
    yield f"Carpus {take.provenance['made_by']['version']}, session {session.header.session_id}."
    yield f"Angles by the {'filter' if motion is session.motion else 'smoother'}: {ANGLE_DEFINITIONS}."
    yield "The line with 'inDegrees' says that rotational values are in degrees."
    yield ""
    yield "endheader"
    yield "\t".join(("time", *labels))
    both = (motion.angles_rad, motion.joint_angles_rad)
    angles = np.degrees(np.column_stack([even.interpolate(values, is_angular=True) for values in both]))
    for time_s, row in zip(even.elapsed_s.tolist(), angles.tolist(), strict=True):
        yield f"{time_s:.6f}\t" + "\t".join("NaN" if value != value else f"{value:.6f}" for value in row)


@dataclass(frozen=True, slots=True)
class TimeTable:
    """Named columns over ``time_s`` (K,), NaN for none; ``in_degrees`` is None if the file does not say."""

    time_s: FloatArray
    values: dict[str, FloatArray]
    in_degrees: bool | None


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
        table = np.array([[parse_cell(cell) for cell in row] for row in rows])
    except ValueError as cause:
        raise ReferenceUnreadable(path, phrase("rows of different length, or not numbers")) from cause
    if table.ndim != 2 or table.shape[1] != len(names) or names[0].lower() != "time":
        raise ReferenceUnreadable(path, phrase("columns do not match their names"))
    columns = {name: table[:, k] for k, name in enumerate(names) if k}
    in_degrees = header.get("indegrees")
    return TimeTable(
        check_times(table[:, 0], path), columns, None if in_degrees is None else in_degrees.startswith("y")
    )

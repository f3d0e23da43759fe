"""MOT for OpenSim: wrist and joint angles in degrees at uniform times; unknown is NaN.

``NAME.mot`` has the filter's result, ``NAME.smoothed.mot`` the smoother's. Columns end with the side as in OpenSim:
``wrist_flexion_r``, ``mcp2_flexion_l``.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from carpus.core.formats.export_item import ANGLE_DEFINITIONS, ExportItem
from carpus.core.formats.output_files import open_new_file, write_new_json
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.measures_table import positive_direction
from carpus.core.session.values import Motion, Session


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.mot``, ``NAME.smoothed.mot`` if there is one, and ``NAME.mot.json``; return their paths."""
    session, even = take.session, take.times
    out = []
    for motion, name in ((session.motion, take.name), (session.smoothed, f"{take.name}.smoothed")):
        if motion is not None:
            path = folder / f"{name}.mot"
            with open_new_file(path) as file:
                for line in _lines(take, motion, name):
                    file.write(line.encode() + b"\n")
            out.append(path)
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
    angles = np.degrees(np.column_stack([even.interpolate(values, is_angular=True) for values in _angles(motion)]))
    for time_s, row in zip(even.elapsed_s.tolist(), angles.tolist(), strict=True):
        yield f"{time_s:.6f}\t" + "\t".join("NaN" if value != value else f"{value:.6f}" for value in row)


def _angles(motion: Motion) -> tuple[np.ndarray, np.ndarray]:
    return motion.angles_rad, motion.joint_angles_rad

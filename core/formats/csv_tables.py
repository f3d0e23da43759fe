"""CSV: tidy tables with a unit in each column's name, and a page that explains every column.

``NAME.wrist.csv`` one row a picture; ``NAME.joints.csv`` one row a picture and joint angle; ``NAME.markers.csv`` one
row a picture and marker; ``NAME.events.csv``; ``NAME.measures.csv`` one row a figure; ``NAME.by-hand.csv`` where
somebody measured by hand that day; ``NAME.csv.json``. What is not known is empty.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.by_hand.table import COLUMNS, rows_of
from carpus.core.formats.new_output import new_json, new_table
from carpus.core.formats.take import ANGLES_MEAN, CAMERA_AXES, W0_AXES, Take, measured, number
from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.output.measures_table import MeasureRow, measure_rows
from carpus.core.output.motion_table import motion_columns
from carpus.core.session.values import Session
from carpus.core.types import TrackStatus

STATUS = "tracked: at least 3 palm markers measured; predicted: fewer; lost: nothing known; doubtful: contradicted"
WRIST_COLUMNS = {
    "timestamp_s": "time of the picture as in the recording",
    "status": STATUS,
    "deviation_deg flexion_deg pronosupination_deg": f"angles by the filter, as they came; {ANGLES_MEAN}",
    "..._sd_deg": "their standard deviations, calibration included",
    "smoothed_...": "by the smoother, which knows the whole recording; missing where it did not run",
    "position_..._mm velocity_..._mm_s": f"of the WRIST disc, {W0_AXES}; of the smoother where it ran",
    "angular_velocity_..._deg_s": "of the hand, in its own axes W2; of the smoother where it ran",
    "zyz_... zyz_..._sd_deg": "the wrist paper's ZYZ angles; empty where they mean nothing",
    "isb_..._deg": "the same angles in the order of the ISB: flexion first, then deviation, then turning",
    "joint_..._mm": f"centres of the joints and tips, {W0_AXES}; of the smoother where it ran",
}
JOINT_COLUMNS = {
    "timestamp_s": "time of the picture as in the recording",
    "status": STATUS,
    "joint": "name of the joint angle",
    "angle_deg": f"by the filter, as it came; {ANGLES_MEAN}",
    "sd_deg": "its standard deviation",
    "velocity_deg_s": "rate of the angle by the filter",
    "measured_share": "share of direct measurement in the last second, 0 to 1",
    "smoothed_angle_deg": "by the smoother; empty where it did not run",
    "smoothed_sd_deg": "its standard deviation",
    "smoothed_velocity_deg_s": "rate of the angle by the smoother",
}
MARKER_COLUMNS = {
    "timestamp_s": "time of the picture as in the recording",
    "status": STATUS,
    "marker": "name of the paper disc",
    "measured": "1 where the disc was seen in this picture, else 0",
    "x_mm": f"centre of the disc as the model has it, {CAMERA_AXES}; known for hidden discs too unless lost",
    "y_mm": "as x_mm",
    "z_mm": "as x_mm",
    "u_px": "centre of the blob taken for it, to the right in the picture",
    "v_px": "the same, downwards",
    "depth_mm": "depth of that blob along the camera's z",
    "doubted": "1 where what is seen contradicts what is stated of it, else 0",
    "joint_x_mm": f"centre of the joint under the disc, or the tip, by the filter, {W0_AXES}",
    "joint_y_mm": "as joint_x_mm",
    "joint_z_mm": "as joint_x_mm",
}
EVENT_COLUMNS = {
    "timestamp_s": "on the clock of the pictures",
    "since_start_s": "after the first picture",
    "kind": "repetition, note, pause, camera_lost, ...",
    "text": "words that go with it",
}


Column = np.ndarray
Table = dict[str, Column]
"""Columns of equal length by their names: numbers, NaN where not known, or texts."""


def write(take: Take, folder: Path) -> list[Path]:
    """Write the tables; the files written."""
    out = []
    said = {"wrist": WRIST_COLUMNS, "joints": JOINT_COLUMNS, "markers": MARKER_COLUMNS, "events": EVENT_COLUMNS}
    for name, table in tables(take.session).items():
        out.append(new_table(folder / f"{take.name}.{name}.csv", list(table), _rows(table)))
    measures = (tuple(_cell(value) for value in astuple(row)) for row in measure_rows(take.figures, take.name))
    head = [field.name for field in fields(MeasureRow)]
    out.append(new_table(folder / f"{take.name}.measures.csv", head, measures))
    if take.by_hand:
        rows = ([_cell(text) for text in row] for row in rows_of(take.by_hand))
        out.append(new_table(folder / f"{take.name}.by-hand.csv", list(COLUMNS), rows))
        said["by-hand"] = COLUMNS
    content = {
        "provenance": take.provenance,
        "missing": "empty",
        "tables": {path.name: said.get(path.name.split(".")[-2], _MEASURES_SAID) for path in out},
    }
    return [*out, new_json(folder / f"{take.name}.csv.json", content)]


def tables(session: Session) -> dict[str, Table]:
    """Wrist, joints (of the whole hand), markers and events as columns."""
    out = {"wrist": _wrist(session)}
    if session.header.joint_names:
        out["joints"] = _joints(session)
    return out | {"markers": _markers(session), "events": _events(session)}


def _wrist(session: Session) -> Table:
    out: Table = {"timestamp_s": session.timestamp_s, "status": _statuses(session)}
    for motion, prefix in ((session.motion, ""), (session.smoothed, "smoothed_")):
        if motion is not None:
            for values, suffix in ((motion.angles_rad, "deg"), (motion.angles_sd_rad, "sd_deg")):
                for k, name in enumerate(WRIST_ANGLES):
                    out[f"{prefix}{name}_{suffix}"] = np.degrees(values[:, k])
    return out | {column.name: column.values for column in motion_columns(session)}


def _joints(session: Session) -> Table:
    names, motion, smoothed = session.header.joint_names, session.motion, session.smoothed
    share = session.quality.measured_share
    unknown = np.full_like(motion.joint_angles_rad, math.nan)
    out = _of_each(session, names) | {
        "joint": np.tile(np.array(names), len(session)),
        "angle_deg": np.degrees(motion.joint_angles_rad),
        "sd_deg": np.degrees(motion.joint_angles_sd_rad),
        "velocity_deg_s": np.degrees(motion.joint_velocity_rad_s),
        "measured_share": share if share.shape == unknown.shape else unknown,
        "smoothed_angle_deg": np.degrees(smoothed.joint_angles_rad) if smoothed else unknown,
        "smoothed_sd_deg": np.degrees(smoothed.joint_angles_sd_rad) if smoothed else unknown,
        "smoothed_velocity_deg_s": np.degrees(smoothed.joint_velocity_rad_s) if smoothed else unknown,
    }
    return {name: values.ravel() for name, values in out.items()}


def _markers(session: Session) -> Table:
    names, markers = session.header.protocol.markers, session.markers
    joints = session.motion.joint_position_m
    if joints.shape[1] != len(names):
        joints = np.full((len(session), len(names), 3), math.nan)
    out = _of_each(session, names) | {
        "marker": np.tile(np.array(names), len(session)),
        "measured": measured(session).astype(np.int64),
        **{f"{axis}_mm": 1e3 * markers.position_cam_m[..., k] for k, axis in enumerate("xyz")},
        "u_px": markers.measured_px[..., 0],
        "v_px": markers.measured_px[..., 1],
        "depth_mm": 1e3 * markers.measured_depth_m,
        "doubted": markers.doubted.astype(np.int64),
        **{f"joint_{axis}_mm": 1e3 * joints[..., k] for k, axis in enumerate("xyz")},
    }
    return {name: values.ravel() for name, values in out.items()}


def _of_each(session: Session, names: Sequence[str]) -> Table:
    """Time and status of each picture, once for each of the names."""
    return {
        "timestamp_s": np.repeat(session.timestamp_s, len(names)),
        "status": np.repeat(_statuses(session), len(names)),
    }


def _events(session: Session) -> Table:
    time_s = np.array([event.time_s for event in session.events], dtype=np.float64)
    return {
        "timestamp_s": time_s,
        "since_start_s": time_s - (session.timestamp_s[0] if len(session) else math.nan),
        "kind": np.array([event.kind for event in session.events], dtype=np.str_),
        "text": np.array([event.text for event in session.events], dtype=np.str_),
    }


def _statuses(session: Session) -> Column:
    words = np.array([status.name.lower() for status in sorted(TrackStatus)])
    return np.asarray(words[np.asarray(session.status)])


def _rows(table: Table) -> Iterator[tuple[str, ...]]:
    """Every row as texts: times to the microsecond, other numbers to a thousandth."""

    def texts(name: str, values: Column) -> list[str]:
        if values.dtype.kind == "f":
            digits = 6 if name in ("timestamp_s", "since_start_s") else 3
            return [number(value, digits) for value in values.tolist()]
        return [plain_text(str(value)) for value in values.tolist()]

    count = max((len(values) for values in table.values()), default=0)
    for begin in range(0, count, _AT_ONCE):
        some = {name: values[begin : begin + _AT_ONCE] for name, values in table.items()}
        yield from zip(*(texts(name, values) for name, values in some.items()), strict=True)


_AT_ONCE = 8192
_MEASURES_SAID = {"": "one row a figure; mean, sd, best and measurement_sd in the unit of the row"}


def _cell(value: Any) -> str:
    """Unknown is empty; numbers to six digits that count."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    return plain_text(str(value))


def plain_text(text: str) -> str:
    """A text that a spreadsheet shows and does not calculate.

    >>> plain_text("=1+2"), plain_text("fist")
    ("'=1+2", 'fist')
    """
    return f"'{text}" if text[:1] in tuple("=+-@\t\r\n") and text else text

"""CSV: tidy tables with a unit in each column's name, and a JSON that explains every column.

Tables are in the form of a person's region for a spreadsheet or, with ``.for-programs`` before ``.csv``, the same
everywhere. One row per frame in ``NAME.wrist.csv``, per frame and joint angle in ``NAME.joints.csv``, per frame and
marker in ``NAME.markers.csv``; also ``events``, ``repetitions``, ``measures``, and ``by-hand`` if there are manual
measurements of that day. Columns of estimates begin with ``filter_`` or ``smoother_``. Unknown is empty.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import fields
from pathlib import Path

import numpy as np

from carpus.core.formats.export_item import (
    ANGLE_DEFINITIONS,
    CAMERA_AXES,
    W0_AXES,
    ExportItem,
    format_number,
    is_measured,
)
from carpus.core.formats.measures_table import (
    MEASURE_COLUMNS,
    MEASURES_HEADER,
    build_measure_rows,
    positive_direction,
    to_csv_rows,
)
from carpus.core.formats.output_files import MACHINE_DIALECT, format_cell, write_new_json, write_new_table
from carpus.core.measures.manual_measurements import COLUMNS, to_rows
from carpus.core.model.hand.exercises import PRONOSUPINATION
from carpus.core.model.hand.forearm_rotation import (
    is_counted_from_thumb_up,
    supination_from_thumb_up,
    to_clinical_wrist_angles,
)
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import TrackStatus
from carpus.core.results.motion_curves import motion_columns
from carpus.core.results.repetition_rows import trained_angle_name
from carpus.core.results.session_results import SessionResults
from carpus.core.session.values import Motion, RepetitionRow, Session

STATUS = "tracked: at least 3 palm markers measured; predicted: fewer; lost: nothing known; doubtful: contradicted"
ESTIMATES = (
    "filter_: as it came, frame by frame; smoother_: with the whole recording known, missing where it did not run"
)
WRIST_COLUMNS = {
    "timestamp_s": "time of the picture as in the recording",
    "status": STATUS,
    "filter_... smoother_...": ESTIMATES,
    "..._deviation_deg ..._flexion_deg ..._pronosupination_deg": ANGLE_DEFINITIONS,
    "..._supination_from_thumb_up_deg ..._rotation_from_start_deg": "tables for a spreadsheet have one of these in the "
    "place of pronosupination: supination, 0 is thumb up, or beside another movement the rotation from the start",
    "..._sd_deg": "their standard deviations, calibration included",
    "..._position_..._mm ..._velocity_..._mm_s": f"of the WRIST disc, {W0_AXES}",
    "..._angular_velocity_..._deg_s": "of the hand, in its own axes W2",
    "..._zyz_..._deg ..._zyz_..._sd_deg": "the wrist paper's ZYZ angles of the hand in W0, right-handed about its axes "
    "on both hands, not clinical; empty where they mean nothing",
    "..._isb_..._deg": "the same angles in the order of the ISB: flexion first, then deviation, then turning; signs as "
    "above: + flexion, + radial, + supination (the ISB's own are + ulnar, + pronation)",
    "..._joint_..._mm": f"centres of the joints and tips, {W0_AXES}",
}
JOINT_COLUMNS = {
    "timestamp_s": "time of the picture as in the recording",
    "status": STATUS,
    "joint": "name of the joint angle",
    "positive": "what a larger angle means; so in every column of the row",
    "filter_angle_deg": "by the filter, as it came; 0 is the straight chain",
    "filter_sd_deg": "its standard deviation",
    "filter_velocity_deg_s": "rate of the angle by the filter",
    "measured_share": "share of direct measurement in the last second, 0 to 1",
    "smoother_angle_deg": "by the smoother; empty where it did not run",
    "smoother_sd_deg": "its standard deviation",
    "smoother_velocity_deg_s": "rate of the angle by the smoother",
}
MARKER_COLUMNS = {
    "timestamp_s": "time of the picture as in the recording",
    "status": STATUS,
    "marker": "name of the paper disc",
    "measured": "1 where the disc was seen in this picture, else 0",
    "filter_x_mm": f"centre of the disc by the filter, {CAMERA_AXES}; known for hidden discs too unless lost",
    "filter_y_mm": "as filter_x_mm",
    "filter_z_mm": "as filter_x_mm",
    "u_px": "measured: centre of the blob taken for it, to the right in the picture",
    "v_px": "the same, downwards",
    "depth_mm": "measured: depth of that blob along the camera's z",
    "doubted": "1 where what is seen contradicts what is stated of it, else 0",
    "filter_joint_x_mm": f"centre of the joint under the disc, or the tip, by the filter, {W0_AXES}",
    "filter_joint_y_mm": "as filter_joint_x_mm",
    "filter_joint_z_mm": "as filter_joint_x_mm",
}
REPETITION_COLUMNS = {
    "repetition": "number, from 1, as the review counts",
    "angle": "name of the trained angle",
    "positive": "what a larger angle means",
    "estimate": "filter or smoother: of whose angle it was measured",
    "start_s": "after the first picture: when it left its first turning place, or passed the middle of a motion to "
    "both sides",
    "peak_s": "when it was furthest on its way there, the middle of a hold",
    "end_s": "when it reached its last turning place, or passed that middle again",
    "angle_deg": "at the peak, counted as in the table of the wrist",
    "arc_deg": "from its smallest angle to its largest, without what noise adds",
    "arc_sd_deg": "standard deviation of the arc by the tracker",
    "peak_speed_deg_s": "of its quickest stroke",
    "peak_speed_sd_deg_s": "what noise leaves in it",
    "movement_time_s": "on its way, pauses included, holds in the turning places not; empty where that of one stroke "
    "is not known",
    "sparc": "smoothness, mean of its strokes, pauses included; nearer to 0 is smoother",
    "movement_units": "peaks of speed of all its strokes",
    "pauses": "how often it stood still within a stroke",
    "pause_time_s": "for how long in all",
    "at_least": "yes where the arc is a lower bound: the angle was hidden where it may have gone further, else no",
    "counted": "yes where it counts, else no",
    "reason": "why it does not: hidden, not seen well enough; cut_by_start, cut_by_gap, cut_by_end, when the recording "
    "began or ended in it or the hand was gone; or what a person wrote",
}
EVENT_COLUMNS = {
    "timestamp_s": "on the clock of the pictures",
    "since_start_s": "after the first picture",
    "kind": "note, pain, pause, camera_lost, ...",
    "text": "words that go with it",
}


Column = np.ndarray
Table = dict[str, Column]
"""Columns of equal length by name: numbers, NaN if unknown, or texts."""


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write the tables; return their paths."""
    out = []
    end = ".for-programs.csv" if take.dialect == MACHINE_DIALECT else ".csv"
    explanations = {
        "wrist": WRIST_COLUMNS, "joints": JOINT_COLUMNS, "markers": MARKER_COLUMNS, "events": EVENT_COLUMNS,
        "repetitions": REPETITION_COLUMNS, "measures": MEASURE_COLUMNS,
    }  # fmt: skip
    all_tables = build_tables(take.session) | {"repetitions": build_repetition_table(take.session, take.results)}
    if take.dialect != MACHINE_DIALECT:
        all_tables = _with_clinical_rotation(all_tables, take)
    for name, table in all_tables.items():
        out.append(write_new_table(folder / f"{take.name}.{name}{end}", list(table), _text_rows(table), take.dialect))
    measures = to_csv_rows(build_measure_rows(take.results, take.name))
    out.append(write_new_table(folder / f"{take.name}.measures{end}", MEASURES_HEADER, measures, take.dialect))
    if take.manual_measurements:
        rows = ([format_cell(text) for text in row] for row in to_rows(take.manual_measurements))
        out.append(write_new_table(folder / f"{take.name}.by-hand{end}", list(COLUMNS), rows, take.dialect))
        explanations["by-hand"] = COLUMNS
    content = {
        "provenance": take.provenance,
        "missing": "empty",
        "separator": take.dialect.separator,
        "decimal": take.dialect.decimal,
        "tables": {path.name: explanations[path.name.removesuffix(end).split(".")[-1]] for path in out},
    }
    return [*out, write_new_json(folder / f"{take.name}.csv.json", content)]


CLINICAL_ROTATION_NAMES = {True: "supination_from_thumb_up", False: "rotation_from_start"}
"""Name of ``pronosupination`` counted as clinicians do, by whether it is from thumb up."""


def _with_clinical_rotation(all_tables: dict[str, Table], take: ExportItem) -> dict[str, Table]:
    """Return the tables with the forearm's rotation as clinicians count it, under another name."""
    exercise, start_rad = take.results.exercise, take.session.calibration.start_angles_rad
    thumb_up = is_counted_from_thumb_up(exercise)
    out = dict(all_tables)
    out["wrist"] = {}
    for name, values in all_tables["wrist"].items():
        named = name.replace("pronosupination", CLINICAL_ROTATION_NAMES[thumb_up])
        if named != name and not name.endswith("_sd_deg"):
            angles = np.radians(np.column_stack((values, values, values)))
            values = np.degrees(to_clinical_wrist_angles(angles, exercise, start_rad)[:, PRONOSUPINATION])
        out["wrist"][named] = values
    if trained_angle_name(take.session) == WRIST_ANGLES[PRONOSUPINATION]:
        rows = all_tables["repetitions"]
        count = len(rows["angle_deg"])
        out["repetitions"] = rows | {
            "angle": np.array([CLINICAL_ROTATION_NAMES[True]] * count, dtype=np.str_),
            "positive": np.array(["supinated, 0 is thumb up"] * count, dtype=np.str_),
            "angle_deg": np.degrees(supination_from_thumb_up(np.radians(rows["angle_deg"]))),
        }
    return out


def build_tables(session: Session) -> dict[str, Table]:
    """Build the tables of wrist, joints (of the whole hand), markers and events."""
    out = {"wrist": _wrist_table(session)}
    if session.header.joint_names:
        out["joints"] = _joint_table(session)
    return out | {"markers": _marker_table(session), "events": _event_table(session)}


def _wrist_table(session: Session) -> Table:
    out: Table = {"timestamp_s": session.timestamp_s, "status": _status_names(session)}
    for motion, estimate in ((session.motion, "filter"), (session.smoothed, "smoother")):
        if motion is not None:
            for values, suffix in ((motion.angles_rad, "deg"), (motion.angles_sd_rad, "sd_deg")):
                for k, name in enumerate(WRIST_ANGLES):
                    out[f"{estimate}_{name}_{suffix}"] = np.degrees(values[:, k])
            out |= {f"{estimate}_{name}": values for name, values in motion_columns(session, motion).items()}
    return out


def _joint_table(session: Session) -> Table:
    names, smoothed = session.header.joint_names, session.smoothed
    share = session.quality.measured_share
    unknown = np.full_like(session.motion.joint_angles_rad, math.nan)
    out = _repeat_for_names(session, names) | {
        "joint": np.tile(np.array(names), len(session)),
        "positive": np.tile(np.array([positive_direction(name) for name in names]), len(session)),
        **_joint_columns("filter", session.motion),
        "measured_share": share if share.shape == unknown.shape else unknown,
        **(_joint_columns("smoother", smoothed) if smoothed else dict.fromkeys(_SMOOTHER_JOINTS, unknown)),
    }
    return {name: values.ravel() for name, values in out.items()}


_SMOOTHER_JOINTS = ("smoother_angle_deg", "smoother_sd_deg", "smoother_velocity_deg_s")


def _joint_columns(estimate: str, motion: Motion) -> Table:
    return {
        f"{estimate}_angle_deg": np.degrees(motion.joint_angles_rad),
        f"{estimate}_sd_deg": np.degrees(motion.joint_angles_sd_rad),
        f"{estimate}_velocity_deg_s": np.degrees(motion.joint_velocity_rad_s),
    }


def build_repetition_table(session: Session, figures: SessionResults) -> Table:
    """Build the table of repetitions with a person's choices: degrees and seconds."""
    rows = [one.row for one in figures.repetitions]
    angle = trained_angle_name(session)
    turned = {name: f"{name.removesuffix('_rad')}_deg" for name in ("angle_rad", "arc_rad", "arc_sd_rad")}
    turned |= {f"peak_speed{part}_rad_s": f"peak_speed{part}_deg_s" for part in ("", "_sd")}
    out: Table = {
        "repetition": np.arange(1, len(rows) + 1),
        "angle": np.array([angle] * len(rows), dtype=np.str_),
        "positive": np.array([positive_direction(angle)] * len(rows), dtype=np.str_),
        "estimate": np.array(["smoother" if figures.is_smoothed else "filter"] * len(rows), dtype=np.str_),
    }
    for field in fields(RepetitionRow):
        values = [getattr(row, field.name) for row in rows]
        if field.name in turned:
            out[turned[field.name]] = np.degrees(np.array(values, dtype=np.float64))
        elif field.name in ("at_least", "counted"):
            out[field.name] = np.array(values, dtype=np.bool_)
        else:
            name = "pause_time_s" if field.name == "pause_s" else field.name
            out[name] = np.array(values, dtype=np.str_ if field.name == "reason" else np.float64)
    return out


def _marker_table(session: Session) -> Table:
    names, markers = session.header.protocol.markers, session.markers
    joints = session.motion.joint_position_m
    if joints.shape[1] != len(names):
        joints = np.full((len(session), len(names), 3), math.nan)
    out = _repeat_for_names(session, names) | {
        "marker": np.tile(np.array(names), len(session)),
        "measured": is_measured(session).astype(np.int64),
        **{f"filter_{axis}_mm": 1e3 * markers.position_cam_m[..., k] for k, axis in enumerate("xyz")},
        "u_px": markers.measured_px[..., 0],
        "v_px": markers.measured_px[..., 1],
        "depth_mm": 1e3 * markers.measured_depth_m,
        "doubted": markers.doubted.astype(np.int64),
        **{f"filter_joint_{axis}_mm": 1e3 * joints[..., k] for k, axis in enumerate("xyz")},
    }
    return {name: values.ravel() for name, values in out.items()}


def _repeat_for_names(session: Session, names: Sequence[str]) -> Table:
    """Return time and status of each frame, once for each name."""
    return {
        "timestamp_s": np.repeat(session.timestamp_s, len(names)),
        "status": np.repeat(_status_names(session), len(names)),
    }


def _event_table(session: Session) -> Table:
    time_s = np.array([event.time_s for event in session.events], dtype=np.float64)
    return {
        "timestamp_s": time_s,
        "since_start_s": time_s - (session.timestamp_s[0] if len(session) else math.nan),
        "kind": np.array([event.kind for event in session.events], dtype=np.str_),
        "text": np.array([event.text for event in session.events], dtype=np.str_),
    }


def _status_names(session: Session) -> Column:
    words = np.array([status.name.lower() for status in sorted(TrackStatus)])
    return np.asarray(words[np.asarray(session.status)])


def _text_rows(table: Table) -> Iterator[tuple[str, ...]]:
    """Yield rows as texts: times to the microsecond, other numbers to a thousandth."""

    def format_column(name: str, values: Column) -> list[str]:
        if values.dtype.kind == "f":
            digits = 6 if name in ("timestamp_s", "since_start_s") else 3
            return [format_number(value, digits) for value in values.tolist()]
        return [format_cell(value) for value in values.tolist()]

    count = max((len(values) for values in table.values()), default=0)
    for begin in range(0, count, _BATCH_ROWS):
        some = {name: values[begin : begin + _BATCH_ROWS] for name, values in table.items()}
        yield from zip(*(format_column(name, values) for name, values in some.items()), strict=True)


_BATCH_ROWS = 8192

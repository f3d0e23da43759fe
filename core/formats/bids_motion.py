"""BIDS-Motion (BIDS 1.11): one data set for all sessions, one row per frame with its own time.

Positions in metres and camera axes, orientation and velocity of the hand in W0, angles and their standard deviations in
degrees; unknown is ``n/a``. Frames themselves are not part of BIDS-Motion.
"""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.formats.export_item import (
    ANGLE_DEFINITIONS,
    CAMERA_AXES,
    W0_AXES,
    ExportItem,
    format_number,
    frame_rate_hz,
    is_measured,
)
from carpus.core.formats.export_provenance import DAY_ZERO
from carpus.core.formats.output_files import TAB_DIALECT, write_new_json, write_new_table, write_new_text
from carpus.core.model.errors import OutputExists
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import FloatArray
from carpus.core.session.values import Session

BIDS_VERSION = "1.11.0"
OWN_FOLDER = "bids"
"""The data set's folder beside other formats: nothing else may lie in it."""
TRACKSYS = "carpus"
MISSING = "n/a"
DESCRIPTION = "dataset_description.json"


class BidsChannel(NamedTuple):
    """Column of ``_motion.tsv`` and row of ``_channels.tsv``."""

    name: str
    component: str
    type: str
    tracked_point: str
    units: str
    reference_frame: str
    description: str
    values: FloatArray
    digits: int = 6


def check(folder: Path) -> None:
    """Raise :class:`OutputExists` if there is a data set, or what a killed export left of one.

    Its tables would have to be changed, and a session might be in it twice.
    """
    if (folder / DESCRIPTION).exists():
        raise OutputExists(folder / DESCRIPTION)
    for left in folder.glob(f"sub-*/ses-*/motion/*_tracksys-{TRACKSYS}_*"):
        raise OutputExists(left.parents[2])


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write the files of one session; :func:`complete` adds those of the data set."""
    session = take.session
    subject, day = f"sub-{subject_label(session.header.subject_id)}", f"ses-{session_label(take)}"
    task = task_label(session.header.exercise)
    place = folder / subject / day / "motion"
    run = 1
    while any(place.glob(f"*_task-{task}_tracksys-{TRACKSYS}_acq-{session.header.hand}_run-{run}_motion.tsv")):
        run += 1
    stem = f"{subject}_{day}_task-{task}_tracksys-{TRACKSYS}_acq-{session.header.hand}_run-{run}"
    found = list_channels(session)
    table = np.column_stack([channel.values for channel in found])
    digits = [channel.digits for channel in found]
    rows = ([format_number(v, d) or MISSING for v, d in zip(row, digits, strict=True)] for row in table.tolist())
    out = [
        write_new_table(place / f"{stem}_motion.tsv", (), rows, TAB_DIALECT),
        write_new_json(place / f"{stem}_motion.json", _motion_metadata(take, found, task)),
        write_new_table(
            place / f"{stem}_channels.tsv",
            ("name", "component", "type", "tracked_point", "units", "reference_frame", "description"),
            (channel[:7] for channel in found),
            TAB_DIALECT,
        ),
        write_new_json(place / f"{stem}_channels.json", _REFERENCE_FRAMES),
    ]
    start_s = float(session.timestamp_s[0]) if len(session) else 0.0
    events = [(e.time_s - start_s, math.nan, e.kind, e.text, math.nan, math.nan, MISSING) for e in session.events]
    events += [
        (row.start_s, row.end_s - row.start_s, "repetition", str(n), row.peak_s, math.degrees(row.arc_rad),
         "yes" if row.counted else f"no: {row.reason.replace('_', ' ')}")
        for n, row in enumerate((one.row for one in take.results.repetitions), 1)
    ]  # fmt: skip
    lines = (
        [_event_cell(value) for value in event] for event in sorted(events, key=lambda e: (math.isnan(e[0]), e[0]))
    )
    head = ("onset", "duration", "trial_type", "value", "peak", "arc", "counted")
    out.append(write_new_table(place / f"{stem}_events.tsv", head, lines, TAB_DIALECT))
    out.append(write_new_json(place / f"{stem}_events.json", _EVENTS))
    scans = place.parent / f"{subject}_{day}_scans.tsv"
    line = f"motion/{stem}_motion.tsv\t{_acquisition_time(take)}\n"
    if scans.exists():  # made by this export: the folder held no data set before
        with scans.open("a", encoding="utf-8", newline="") as file:
            file.write(line)
    else:
        out.append(write_new_text(scans, f"filename\tacq_time\n{line}"))
    return out


def complete(folder: Path, written: Sequence[Mapping[str, Any]]) -> list[Path]:
    """Write the files of the data set from the sessions' provenances."""
    people: dict[str, Mapping[str, Any]] = {}
    for one in written:
        people.setdefault(subject_label(one["of"]["subject_id"]), one["of"])
    rows = [
        (f"sub-{label}", _text_cell(of["subject_id"]), "yes" if of["simulated"] else "no")
        for label, of in sorted(people.items())
    ]
    made_by = written[0]["made_by"]
    return [
        write_new_json(
            folder / DESCRIPTION,
            {
                "Name": "Movements of the hand, measured by Carpus",
                "BIDSVersion": BIDS_VERSION,
                "DatasetType": "raw",
                "License": "not given",
                "Authors": ["not given"],
                "GeneratedBy": [{"Name": "Carpus", "Version": made_by["version"], "Description": made_by["revision"]}],
                "SourceDatasets": [],
            },
        ),
        write_new_text(folder / "README", _README),
        write_new_table(folder / "participants.tsv", ("participant_id", "pseudonym", "simulated"), rows, TAB_DIALECT),
        write_new_json(
            folder / "participants.json",
            {
                "participant_id": {"Description": "letters and digits of the pseudonym"},
                "pseudonym": {"Description": "pseudonym as the clinic writes it; who it is stays with the clinic"},
                "simulated": {
                    "Description": "whether a simulated hand was measured: nobody's movement",
                    "Levels": {"yes": "simulated", "no": "a person"},
                },
            },
        ),
    ]


def list_channels(session: Session) -> list[BidsChannel]:
    """Return all columns: time, status, markers, hand, angles and their standard deviations."""
    motion, header = session.motion, session.header
    count = len(session)
    start_s = session.timestamp_s[0] if count else 0.0
    out = [
        BidsChannel("latency", MISSING, "LATENCY", MISSING, "s", MISSING, "after the first picture",
                session.timestamp_s - start_s),
        BidsChannel("status", MISSING, "MISC", MISSING, MISSING, MISSING, "0 tracked, 1 predicted, 2 lost, 3 doubtful",
                np.asarray(session.status, dtype=np.float64), 0),
    ]  # fmt: skip

    def add_vector(kind: str, point: str, units: str, frame: str, description: str, values: FloatArray) -> None:
        for axis, letter in enumerate("xyz"):
            name = f"{point}_{kind}_{letter}"
            out.append(BidsChannel(name, letter, kind, point, units, frame, description, values[:, axis]))

    for m, marker in enumerate(header.protocol.markers):
        place_m = session.markers.position_cam_m[:, m]
        add_vector("POS", marker, "m", "camera", "centre of the paper disc", place_m)
        seen = is_measured(session)[:, m].astype(np.float64)
        out.append(
            BidsChannel(f"{marker}_seen", MISSING, "MISC", marker, MISSING, MISSING, "1 seen in this picture, else 0",
                    seen, 0)
        )  # fmt: skip
    known = np.isfinite(motion.rotation_w2_w0).all(axis=(-2, -1))
    turn = np.full((count, 4), np.nan)
    if known.any():
        turn[known] = Rotation.from_matrix(motion.rotation_w2_w0[known]).as_quat(canonical=True)
    for k, letter in zip((3, 0, 1, 2), "wxyz", strict=True):
        out.append(
            BidsChannel(f"HAND_ORNT_quat_{letter}", f"quat_{letter}", "ORNT", "HAND", MISSING, "w0",
                    "rotation of W2 in W0", turn[:, k], 8)
        )  # fmt: skip
    add_vector("VEL", "HAND", "m/s", "w0", "velocity of the WRIST disc", motion.velocity_m_s)
    add_vector("GYRO", "HAND", "rad/s", "w2", "angular velocity of the hand", motion.angular_velocity_rad_s)
    names = [f"wrist_{name}" for name in WRIST_ANGLES] + list(header.joint_names)
    angles = np.degrees(np.column_stack((motion.angles_rad, motion.joint_angles_rad)))
    sds = np.degrees(np.column_stack((motion.angles_sd_rad, motion.joint_angles_sd_rad)))
    for k, name in enumerate(names):
        point = "HAND" if k < len(WRIST_ANGLES) else name.split("_")[0]
        out.append(BidsChannel(name, MISSING, "JNTANG", point, "deg", "joints", "angle, by the filter", angles[:, k]))
        out.append(
            BidsChannel(f"{name}_sd", MISSING, "MISC", point, "deg", "joints", "its standard deviation", sds[:, k])
        )
    return out


def subject_label(subject_id: str) -> str:
    """Return a pseudonym in letters and digits, with a suffix if more than a space is lost.

    >>> subject_label("Linden 42"), subject_label("Linden-42"), subject_label("")
    ('Linden42', 'Linden4287a6', 'unknown')
    """
    plain = re.fullmatch(r"[A-Za-z]+ [0-9]+|[A-Za-z0-9]*", subject_id)
    told_apart = "" if plain else hashlib.sha256(subject_id.encode()).hexdigest()[:4]
    return _label(subject_id) + told_apart or "unknown"


def session_label(take: ExportItem) -> str:
    """Return day and time of the recording; de-identified, the day since the first session."""
    moment = _acquisition_time(take)
    if moment == MISSING:
        return f"id{_label(take.session.header.session_id)[:8]}"
    when = datetime.fromisoformat(moment)
    if take.provenance["deidentified"]:
        return f"day{(when - DAY_ZERO.replace(tzinfo=None)).days:04d}"
    return when.strftime("%Y%m%dT%H%M%S")


def task_label(exercise: str) -> str:
    """Return an exercise as a BIDS task.

    >>> task_label("WRIST_FE"), task_label("")
    ('wristFe', 'free')
    """
    words = [word for word in re.split(r"[^A-Za-z0-9]+", exercise.lower()) if word]
    return "".join([*words[:1], *(word.capitalize() for word in words[1:])]) or "free"


def _label(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9]", "", text)


def _text_cell(text: str) -> str:
    return " ".join(text.split()) or MISSING


def _event_cell(value: float | str) -> str:
    return _text_cell(value) if isinstance(value, str) else format_number(value, 6) or MISSING


def _acquisition_time(take: ExportItem) -> str:
    """Return when the hand moved by the clinic's clock, without zone."""
    recorded = take.session.header.recorded
    return datetime.fromisoformat(recorded).strftime("%Y-%m-%dT%H:%M:%S") if recorded else MISSING


def _motion_metadata(take: ExportItem, found: Sequence[BidsChannel], task: str) -> dict[str, Any]:
    session = take.session
    counts = {
        kind: sum(channel.type == kind for channel in found)
        for kind in ("ACCEL", "ANGACCEL", "GYRO", "JNTANG", "LATENCY", "MAGN", "MISC", "ORNT", "POS", "VEL")
    }
    span_s = float(session.timestamp_s[-1] - session.timestamp_s[0]) if len(session) > 1 else 0.0
    source = take.provenance["camera"]["source"]
    out: dict[str, Any] = {
        "TaskName": task,
        "TaskDescription": f"exercise {session.header.exercise or 'not given'}, {session.header.hand} hand",
        "SamplingFrequency": frame_rate_hz(session),
        "SamplingFrequencyEffective": (len(session) - 1) / span_s if span_s else MISSING,
        "TrackingSystemName": "Carpus: paper discs on a hand, one camera of colour and depth",
        "Manufacturer": str(source.get("vendor", "not known")),
        "ManufacturersModelName": str(source.get("sensor", source.get("name", "not known"))),
        "SoftwareVersions": session.header.software_version,
        "SubjectArtefactDescription": "the skin glides below the discs",
        "MissingValues": MISSING,
        "MotionChannelCount": len(found),
        "TrackedPointsCount": len({channel.tracked_point for channel in found} - {MISSING}),
        "Angles": ANGLE_DEFINITIONS,
        "Provenance": take.provenance,
    }
    # The name of one count differs between the versions of the standard.
    return out | {f"{kind}ChannelCount": count for kind, count in counts.items()} | {"MiscChannelCount": counts["MISC"]}


_REFERENCE_FRAMES = {
    "reference_frame": {
        "Description": "what a channel's values are told in",
        "Levels": {
            "camera": {"SpatialAxes": "RDF", "RotationRule": "right-hand", "RotationOrder": MISSING,
                       "Description": CAMERA_AXES},
            "w0": {"SpatialAxes": "FLU", "RotationRule": "right-hand", "RotationOrder": MISSING,
                   "Description": f"{W0_AXES}; letters as for a right hand whose back is up"},
            "w2": {"SpatialAxes": "FLU", "RotationRule": "right-hand", "RotationOrder": MISSING,
                   "Description": "the hand's own axes as they move, built as W0"},
            "joints": {"SpatialAxes": MISSING, "RotationRule": "right-hand", "RotationOrder": "XYZ",
                       "Description": ANGLE_DEFINITIONS},
        },
    }
}  # fmt: skip
_EVENTS = {
    "onset": {"Description": "after the first picture", "Units": "s"},
    "duration": {
        "Description": "of a repetition, from leaving its first turning place to reaching its last",
        "Units": "s",
    },
    "trial_type": {"Description": "kind of the event: repetition, note, pause, camera_lost, ..."},
    "value": {"Description": "words that go with it; of a repetition its number"},
    "peak": {
        "Description": "when a repetition was furthest on its way there, after the first picture",
        "Units": "s",
    },
    "arc": {"Description": "of a repetition of the trained angle", "Units": "deg"},
    "counted": {"Description": "whether a repetition counts, and if not why"},
}
_README = """Movements of hands, measured by Carpus
======================================

Blue paper discs on the skin, one camera of colour and depth that looks down, a Kalman filter: wrist and finger angles
with their standard deviations. Each `_motion.json` says which program, revision, settings, camera and recording its
numbers come from; each `_channels.json` says the axes. Subjects are pseudonyms.

For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not replace, the
judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment.
"""

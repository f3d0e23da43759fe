"""The whole hand against simulated truth: its rows, and one recording of a row tracked."""

from __future__ import annotations

import tempfile
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.clicks import read_clicks
from carpus.core.calibration.settings import CalibrationSettings
from carpus.core.capture.files.tum import TumFolder
from carpus.core.hand.kinematics import DIP_PER_PIP
from carpus.core.hand.protocols import HAND21, joint_angle_names
from carpus.core.pipeline.track import TrackSettings, from_neutral, learnt_from, learnt_in, track_recording
from carpus.core.session.reader import read_session
from carpus.core.session.values import Motion, motion_of
from carpus.core.simulation.recording import CLICKS_FILE, cached_recording
from carpus.core.simulation.sensor import depth_scale
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import FloatArray, Moment, TrackedFrame, TrackStatus
from tests.accuracy.carpus import measured_hand
from tests.accuracy.readings import Reading, reading_of
from tests.accuracy.runs import Mode, degrees_between, longest_s
from tests.accuracy.sequences import detected_sequence, scored_frames, true_names, wrongly_taken
from tests.rendered import truth_in
from tests.simulation.measurements import MeasurementSequence, measurement_sequence

REPORT_SEEDS = 2_000_000
"""Seeds of the table start here. Settings are chosen on others, so that the table stays a test."""
SECONDS = 8.0
_NEXT_SEED = 50
BENT_RAD = np.radians(60.0)
"""Abduction is compared where the joint is flexed less than this: further on it hardly moves anything."""
EXERCISES = ("fist", "fingers", "abduction", "thumb", "reach_grasp")
TROUBLE: dict[str, Any] = {"false_blobs": 3.0, "hidden_share": 0.1}

ANGLES = joint_angle_names(dip_free=True)
"""All rows are compared in the 21 angles; where the end joints are coupled these follow the middle joints."""
JOINT_GROUPS: dict[str, tuple[str, ...]] = {
    "MCP flexion": tuple(f"MCP{k}_flexion" for k in (2, 3, 4, 5)),
    "PIP flexion": tuple(f"PIP{k}_flexion" for k in (2, 3, 4, 5)),
    "DIP flexion": tuple(f"DIP{k}_flexion" for k in (2, 3, 4, 5)),
    "abduction": tuple(f"MCP{k}_abduction" for k in (2, 3, 4, 5)),
    "thumb MCP": ("MCP1_flexion",),
    "thumb IP": ("IP1_flexion",),
    "thumb CMC": ("CMC1_extension", "CMC1_abduction", "MCP1_abduction"),
}
WRIST = ("deviation", "flexion", "pro/sup")


@dataclass(frozen=True, slots=True)
class HandScenario:
    """One row: ``motions`` taken in turn by the seeds; ``options`` of the recording; ``tracker`` settings.

    ``limits`` name the column of targets it is held to, None where it only informs; ``weight`` recordings for every
    two asked for; ``pictures``: also by rendered pictures.
    """

    name: str
    motions: tuple[str, ...]
    options: dict[str, Any] = field(default_factory=dict)
    tracker: TrackerSettings = field(default_factory=TrackerSettings)
    limits: str | None = None
    weight: int = 1
    pictures: bool = False

    def spec(self, number: int, first: int = REPORT_SEEDS) -> RecordingSpec:
        """The recording of a number, sides in turn."""
        own = sum(ord(letter) * 31**i for i, letter in enumerate(self.name)) % 4000
        seed = first + 100 * own + number
        usual = {
            "seed": seed,
            "seconds": SECONDS,
            "hand": "left" if (number // len(self.motions)) % 2 else "right",
            "protocol": HAND21.name,
            "motion": self.motions[number % len(self.motions)],
        }
        return RecordingSpec(**{**usual, **TROUBLE, **self.options})


_FREE = TrackerSettings(dip="free")
_IN_JOINTS = TrackerSettings(fingers=replace(TrackerSettings().fingers, skin_offsets=False))

ROWS = (
    HandScenario("discs on the skin", EXERCISES, limits="skin", weight=4, pictures=True),
    HandScenario("discs in the joints", EXERCISES, {"skin_offsets": False}, _IN_JOINTS, limits="joints", weight=2),
    HandScenario("end joints free", ("hook", "fist", "fingers"), {"dip": "free"}, _FREE, limits="skin", weight=2),
    HandScenario("end joints free, taken as coupled", ("hook",), {"dip": "free"}),
    HandScenario("discs on the skin, taken as in the joints", EXERCISES, {}, _IN_JOINTS),
    HandScenario("child, 135 mm", EXERCISES, {"hand_length_mm": 135.0}),
    HandScenario("10 false blobs", EXERCISES, {"false_blobs": 10.0}),
    HandScenario("30 % hidden", EXERCISES, {"hidden_share": 0.3}),
    HandScenario("leaves and returns", ("fist", "fingers"), {"leaves_picture": True, "seconds": 12.0}),
    HandScenario("object passes", ("fist", "abduction"), {"object_passes": True}),
    HandScenario("colour only (experimental)", EXERCISES, {}, TrackerSettings(use_depth=False)),
)


@dataclass(frozen=True, slots=True)
class HandRun:
    """One recording of a row.

    Errors and stated standard deviations of ``joint`` and ``smoothed`` (N, 21) and of the wrist (N, 3), degrees;
    ``seen`` (N, 21) the discs at and past the joint were there to be seen; ``compared`` (N, 21) where the angle means
    something; ``disc_mm`` errors of the discs that were seen, after the unit's depth scale; ``status`` (N,);
    measurements ``taken`` and ``wrong``, ``longest_wrong_s`` on end; ``missed`` of ``shown`` discs; ``ms`` of CPU time
    a frame; what a therapist reads live off wrist and joints, the latter while seen.
    """

    scenario: str
    motion: str
    seed: int
    mode: Mode
    joint_deg: FloatArray
    joint_sd_deg: FloatArray
    smoothed_deg: FloatArray
    smoothed_sd_deg: FloatArray
    wrist_deg: FloatArray
    wrist_sd_deg: FloatArray
    seen: NDArray[np.bool_]
    compared: NDArray[np.bool_]
    disc_mm: FloatArray
    status: NDArray[np.int64]
    taken: int
    wrong: int
    longest_wrong_s: float
    missed: int
    shown: int
    ms: float
    wrist_reading: Reading
    joint_reading: Reading


def with_end_joints(joints: FloatArray) -> FloatArray:
    """All 21 angles (N, 21), or standard deviations, of 17 or 21."""
    if joints.shape[1] == len(ANGLES):
        return joints
    finger = joints[:, 5:].reshape(-1, 4, 3)
    whole = np.concatenate((finger, DIP_PER_PIP * finger[..., 2:]), axis=-1)
    return np.concatenate((joints[:, :5], whole.reshape(-1, 16)), axis=1)


def seen_joints(present: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether the disc at each of the 21 joints and the next one past it are there, from ``present`` (N, 21 discs)."""
    at = np.array([HAND21.markers.index(name.split("_")[0]) for name in ANGLES])
    return np.asarray(present[:, at] & present[:, at + 1])


def run_on_blobs(row: HandScenario, spec: RecordingSpec) -> HandRun:
    """Track simulated measurements as :func:`core.pipeline.track.track_recording` does those of pictures.

    A hand of which a disc cannot be seen at the start could not be clicked: another takes its place.
    """
    sequence = measurement_sequence(spec)
    while (true_names(sequence.marker[0], len(HAND21.markers)) < 0).any():
        spec = replace(spec, seed=spec.seed + _NEXT_SEED)
        sequence = measurement_sequence(spec)
    truth, times = sequence.truth, sequence.truth.timestamp_s
    hand, neutral_ends_s = measured_hand(sequence, CalibrationSettings())
    assert hand.calibration is not None
    learnt = learnt_from(hand.noise, neutral_ends_s, row.tracker)
    tracker = Tracker(hand.calibration, truth.camera, learnt.applied(row.tracker))
    frames: list[TrackedFrame] = []
    begin = time.process_time()
    for i in from_neutral(range(len(times)), tracker, neutral_ends_s, lambda row: float(times[row])):
        dropped = int(truth.dropped_before[i])
        frames.append(tracker.step(i, float(times[i]), sequence.detections[i], dropped))
    ms = 1e3 * (time.process_time() - begin) / len(times)
    measured_px = np.array([frame.marker_measured_px for frame in frames])
    disc_m = np.array([frame.marker_position_cam_m for frame in frames])
    status = np.array([frame.status for frame in frames])
    live, back = _of_rows(frames), _of_rows(tracker.smoothed())
    return _scored(row, "blobs", sequence, neutral_ends_s, live, back, measured_px, disc_m, status, ms)


def run_on_pictures(row: HandScenario, spec: RecordingSpec) -> HandRun:
    """Track a rendered recording through the whole of Carpus, from folder to session file."""
    folder = cached_recording(spec)
    truth, clicks = truth_in(spec, folder), read_clicks(folder / CLICKS_FILE)
    with tempfile.TemporaryDirectory() as place:
        output = Path(place) / "session.h5"
        begin = time.process_time()
        settings = TrackSettings(tracker=row.tracker)
        track_recording(TumFolder(folder), clicks, output, settings, software_version="accuracy")
        ms = 1e3 * (time.process_time() - begin) / len(truth.timestamp_s)
        session = read_session(output)
        sequence = detected_sequence(truth, output)
    learnt = learnt_in(session.header.parameters)
    assert learnt is not None
    assert session.smoothed is not None
    live, back = _of_motion(session.motion), _of_motion(session.smoothed)
    marker = session.markers
    return _scored(
        row,
        "pictures",
        sequence,
        learnt.neutral_ends_s,
        live,
        back,
        marker.measured_px,
        marker.position_cam_m,
        session.status.astype(np.int64),
        ms,
    )


_Series = tuple[FloatArray, FloatArray, FloatArray, FloatArray]
"""Joint angles (N, J), their sds, wrist angles (N, 3), their sds; radians."""


def _of_rows(rows: list[TrackedFrame] | list[Moment]) -> _Series:
    return _of_motion(motion_of(rows))


def _of_motion(motion: Motion) -> _Series:
    return motion.joint_angles_rad, motion.joint_angles_sd_rad, motion.angles_rad, motion.angles_sd_rad


def _scored(
    row: HandScenario,
    mode: Mode,
    sequence: MeasurementSequence,
    begin_s: float,
    live: _Series,
    back: _Series,
    measured_px: FloatArray,
    disc_m: FloatArray,
    status: NDArray[np.int64],
    ms: float,
) -> HandRun:
    truth = sequence.truth
    kept = scored_frames(truth, begin_s)
    rows = np.flatnonzero(kept)
    wrong = wrongly_taken(
        measured_px[kept],
        MeasurementSequence(
            truth, tuple(sequence.detections[i] for i in rows), tuple(sequence.marker[i] for i in rows)
        ),
    )
    present = np.array([np.isin(np.arange(len(HAND21.markers)), names) for names in sequence.marker])[kept]
    taken = np.isfinite(measured_px[kept][..., 0])
    off_m = disc_m[kept] / depth_scale(truth.spec) - truth.disc_position_cam_m[kept]
    disc_mm = 1e3 * np.linalg.norm(off_m, axis=-1)[present]
    joint_true = with_end_joints(truth.joint_angles_rad)
    joint_deg = degrees_between(with_end_joints(live[0]), joint_true)[kept]
    joint_sd_deg = np.degrees(with_end_joints(live[1]))[kept]
    wrist_deg, wrist_sd_deg = degrees_between(live[2], truth.angles_rad)[kept], np.degrees(live[3])[kept]
    seen, compared = seen_joints(present), readable(joint_true)[kept]
    missed, shown = int((present & ~taken).sum()), int(present.sum())
    return HandRun(
        row.name,
        truth.spec.motion,
        truth.spec.seed,
        mode,
        joint_deg,
        joint_sd_deg,
        degrees_between(with_end_joints(back[0]), joint_true)[kept],
        np.degrees(with_end_joints(back[1]))[kept],
        wrist_deg,
        wrist_sd_deg,
        seen,
        compared,
        disc_mm[np.isfinite(disc_mm)],
        status[kept],
        int(taken.sum()),
        int(wrong.sum()),
        longest_s(wrong, truth.timestamp_s[kept]),
        missed,
        shown,
        ms,
        reading_of(truth, kept, truth.angles_rad, wrist_deg, wrist_sd_deg, unused=missed, shown=shown),
        reading_of(
            truth,
            kept,
            joint_true,
            np.where(seen & compared, joint_deg, np.nan),
            joint_sd_deg,
            unused=missed,
            shown=shown,
        ),
    )


def readable(joint_true: FloatArray) -> NDArray[np.bool_]:
    """Abduction of a bent finger turns it about itself: no camera and no examiner can read it."""
    out = np.ones(joint_true.shape, dtype=bool)
    for k in (2, 3, 4, 5):
        out[:, ANGLES.index(f"MCP{k}_abduction")] = joint_true[:, ANGLES.index(f"MCP{k}_flexion")] < BENT_RAD
    return out


def tracked(status: NDArray[np.int64]) -> float:
    """Share of frames that were tracked."""
    return float(np.mean(status == TrackStatus.TRACKED))

"""The whole hand against simulated truth: its rows, and one recording of a row tracked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import HAND21, joint_angle_names
from carpus.core.model.types import FloatArray
from carpus.core.pipeline.track import TrackSettings
from carpus.core.session.values import Motion, stack_states
from carpus.core.simulation.recording import render_cached
from carpus.core.simulation.sensor import depth_scale
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.filter.settings import TrackerSettings
from tests.accuracy.carpus import (
    calibrate_tracker,
    detect_sequence,
    measure_session,
    names_taken,
    select_scored_frames,
    step_tracker,
    true_names,
)
from tests.accuracy.jobs import side_by_side
from tests.accuracy.pages import rule_table
from tests.accuracy.readings import WRIST_COLUMNS, Reading, ReadRow, compute_reading, find_moves_rad, mean, rms
from tests.accuracy.scores import Mode, degrees_between, longest_s
from tests.rendered import read_truth
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
    measurements ``taken`` and ``wrong``, ``longest_wrong_s`` on end; ``missed`` of ``shown`` discs; what a therapist
    reads live off wrist and joints, the latter while seen.
    """

    scenario: str
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
    wrist_reading: Reading
    joint_reading: Reading


def with_end_joints(joints: FloatArray) -> FloatArray:
    """All 21 angles (N, 21), or standard deviations, of 17 or 21."""
    if joints.shape[1] == len(ANGLES):
        return joints
    finger = joints[:, 5:].reshape(-1, 4, 3)
    whole = np.concatenate((finger, DIP_PER_PIP * finger[..., 2:]), axis=-1)
    return np.concatenate((joints[:, :5], whole.reshape(-1, 16)), axis=1)


def find_seen_joints(present: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether the disc at each of the 21 joints and the next one past it are there, from ``present`` (N, 21 discs)."""
    at = np.array([HAND21.markers.index(name.split("_")[0]) for name in ANGLES])
    return np.asarray(present[:, at] & present[:, at + 1])


def clickable_sequence(spec: RecordingSpec) -> MeasurementSequence:
    """Measurements of a recording. A hand of which a disc cannot be seen at the start could not be clicked: another
    takes its place."""
    sequence = measurement_sequence(spec)
    while (true_names(sequence.marker[0], len(spec.marker_protocol.markers)) < 0).any():
        spec = replace(spec, seed=spec.seed + _NEXT_SEED)
        sequence = measurement_sequence(spec)
    return sequence


def run_on_blobs(row: HandScenario, spec: RecordingSpec) -> HandRun:
    """Track simulated measurements."""
    sequence = clickable_sequence(spec)
    tracker, neutral_ends_s = calibrate_tracker(sequence, row.tracker)
    frames, _ = step_tracker(tracker, sequence, neutral_ends_s)
    measured_px = np.array([frame.marker_measured_px for frame in frames])
    disc_m = np.array([frame.marker_position_cam_m for frame in frames])
    status = np.array([frame.status for frame in frames])
    motions = stack_states(frames), stack_states(tracker.smooth())
    return _score_run(row, "blobs", sequence, neutral_ends_s, *motions, measured_px, disc_m, status)


def run_on_pictures(row: HandScenario, spec: RecordingSpec) -> HandRun:
    """Track a rendered recording through the whole of Carpus, from folder to session file."""
    folder = render_cached(spec)
    found = measure_session(folder, TrackSettings(tracker=row.tracker))
    sequence, session = detect_sequence(read_truth(spec, folder), found), found.session
    assert session.smoothed is not None
    return _score_run(
        row, "pictures", sequence, found.neutral_ends_s, session.motion, session.smoothed, session.markers.measured_px,
        session.markers.position_cam_m, session.status.astype(np.int64),
    )  # fmt: skip


def _score_run(
    row: HandScenario,
    mode: Mode,
    sequence: MeasurementSequence,
    begin_s: float,
    live: Motion,
    back: Motion,
    measured_px: FloatArray,
    disc_m: FloatArray,
    status: NDArray[np.int64],
) -> HandRun:
    truth = sequence.truth
    kept = select_scored_frames(truth, begin_s)
    names = names_taken(measured_px, sequence.detections, sequence.marker, kept)
    off_m = disc_m[kept] / depth_scale(truth.spec) - truth.marker_position_cam_m[kept]
    disc_mm = 1e3 * np.linalg.norm(off_m, axis=-1)[names.present]
    joint_true = with_end_joints(truth.joint_angles_rad)
    joint_deg, smoothed_deg = (
        degrees_between(with_end_joints(one.joint_angles_rad), joint_true)[kept] for one in (live, back)
    )
    joint_sd_deg, smoothed_sd_deg = (np.degrees(with_end_joints(one.joint_angles_sd_rad))[kept] for one in (live, back))
    wrist_deg = degrees_between(live.angles_rad, truth.angles_rad)[kept]
    wrist_sd_deg = np.degrees(live.angles_sd_rad)[kept]
    seen, compared = find_seen_joints(names.present), readable(joint_true)[kept]
    time_s = truth.time_s[kept]
    moves_rad = find_moves_rad(truth, time_s)
    discs = {"unused": names.missed, "shown": names.shown}
    joints_seen_deg = np.where(seen & compared, joint_deg, np.nan)
    return HandRun(
        row.name,
        mode,
        joint_deg,
        joint_sd_deg,
        smoothed_deg,
        smoothed_sd_deg,
        wrist_deg,
        wrist_sd_deg,
        seen,
        compared,
        disc_mm[np.isfinite(disc_mm)],
        status[kept],
        int(names.taken.sum()),
        int(names.wrong.sum()),
        longest_s(names.wrong, truth.timestamp_s[kept]),
        names.missed,
        names.shown,
        compute_reading(time_s, moves_rad, truth.angles_rad, kept, wrist_deg, wrist_sd_deg, **discs),
        compute_reading(time_s, moves_rad, joint_true, kept, joints_seen_deg, joint_sd_deg, **discs),
    )


def readable(joint_true: FloatArray) -> NDArray[np.bool_]:
    """Abduction of a bent finger turns it about itself: no camera and no examiner can read it."""
    out = np.ones(joint_true.shape, dtype=bool)
    for k in (2, 3, 4, 5):
        out[:, ANGLES.index(f"MCP{k}_abduction")] = joint_true[:, ANGLES.index(f"MCP{k}_flexion")] < BENT_RAD
    return out


MOST_RMSE_DEG = {
    "joints": {"MCP flexion": 2.5, "PIP flexion": 3.0, "DIP flexion": 3.0},
    "skin": {"MCP flexion": 3.5, "PIP flexion": 4.0, "DIP flexion": 4.0},
}
MOST_RMSE_ALWAYS = {"thumb MCP": 3.0, "thumb IP": 4.0, "abduction": 2.0}
READ_JOINTS = ("MCP flexion", "PIP flexion", "thumb CMC")
"""Groups of joints of which the therapist's columns are told."""


@dataclass(frozen=True, slots=True)
class Figures:
    """One group of angles over runs, degrees: RMSE, mean stated sd and share within two sds, of what was seen and of
    what was hidden, and of all; ``back`` RMSE of what was seen when looking back."""

    rmse: float
    sd: float
    inside: float
    hidden_inside: float
    all_inside: float
    back: float
    back_inside: float

    @property
    def sd_over_rmse(self) -> float:
        return self.sd / self.rmse


def run_hand_job(job: tuple[HandScenario, int, Mode]) -> HandRun:
    """The recording of a row and number tracked."""
    row, number, mode = job
    with threadpool_limits(1):
        return (run_on_blobs if mode == "blobs" else run_on_pictures)(row, row.spec(number))


def run_hands(rows: Sequence[HandScenario], seeds: int, pictures: int, processes: int) -> list[HandRun]:
    """As :func:`tests.accuracy.jobs.make_jobs`: pictures where a row wants them, else simulated measurements."""
    jobs: list[tuple[HandScenario, int, Mode]] = []
    jobs += [(row, i, "pictures") for row in rows if row.pictures for i in range(pictures)]
    by_blobs = [row for row in rows if not (row.pictures and pictures)]
    jobs += [(row, i, "blobs") for row in by_blobs for i in range(max(1, seeds * row.weight // 2))]
    return side_by_side(run_hand_job, jobs, processes)


def figures(runs: Sequence[HandRun], group: str) -> Figures:
    """The figures of one group of joints."""
    columns = [ANGLES.index(name) for name in JOINT_GROUPS[group]]

    def pooled(values: Sequence[FloatArray]) -> FloatArray:
        return np.concatenate([value[:, columns].ravel() for value in values])

    seen = pooled([run.seen for run in runs]).astype(bool)
    compared = pooled([run.compared for run in runs]).astype(bool)
    error, sd = pooled([run.joint_deg for run in runs]), pooled([run.joint_sd_deg for run in runs])
    back, back_sd = pooled([run.smoothed_deg for run in runs]), pooled([run.smoothed_sd_deg for run in runs])
    known = compared & np.isfinite(error) & np.isfinite(back)
    shown, hidden = known & seen, known & ~seen
    inside, back_inside = np.abs(error) <= 2.0 * sd, np.abs(back) <= 2.0 * back_sd
    return Figures(
        rms(error[shown]),
        mean(sd[shown]),
        mean(inside[shown]),
        mean(inside[hidden]),
        mean(inside[known]),
        rms(back[shown]),
        mean(back_inside[known]),
    )


def wrist_rmse(runs: Sequence[HandRun]) -> FloatArray:
    """RMSE (3,) of the wrist's angles, degrees."""
    error = np.concatenate([run.wrist_deg for run in runs])
    return np.asarray(np.sqrt(np.nanmean(error**2, axis=0)))


def disc_mm(runs: Sequence[HandRun]) -> FloatArray:
    """Median and 95th percentile of the discs' errors."""
    return np.asarray(np.percentile(np.concatenate([run.disc_mm for run in runs]), (50.0, 95.0)))


def _by_row(
    runs: Sequence[HandRun], rows: Sequence[HandScenario]
) -> Iterator[tuple[HandScenario, Mode, list[HandRun]]]:
    for row in rows:
        for mode in ("blobs", "pictures"):
            mine = [run for run in runs if run.scenario == row.name and run.mode == mode]
            if mine:
                yield row, mode, mine


def markdown(runs: Sequence[HandRun], rows: Sequence[HandScenario]) -> str:
    """One line for every row: RMSE of joints while seen, hidden ones with what was said of them."""
    head = [
        "row",
        "recordings",
        *JOINT_GROUPS,
        "hidden joints: RMSE, stated sd",
        "within 2 sd, %",
        "wrist",
        "discs, mm",
    ]
    lines = [head]
    for row, mode, mine in _by_row(runs, rows):
        found = [figures(mine, group) for group in JOINT_GROUPS]
        hidden = [np.concatenate([_hidden(value, run) for run, value in pairs]) for pairs in (
            [(run, run.joint_deg) for run in mine], [(run, run.joint_sd_deg) for run in mine]
        )]  # fmt: skip
        cells = [row.name if mode == "blobs" else f"{row.name} (pictures)", str(len(mine))]
        cells += [f"{f.rmse:.1f}" for f in found]
        cells.append(f"{rms(hidden[0]):.0f}, {mean(hidden[1]):.0f}")
        cells.append(f"{100 * min(f.all_inside for f in found):.0f} to {100 * max(f.all_inside for f in found):.0f}")
        cells.append(" / ".join(f"{v:.1f}" for v in wrist_rmse(mine)))
        cells.append(" / ".join(f"{v:.1f}" for v in disc_mm(mine)))
        lines.append(cells)
    return rule_table(lines)


def _hidden(values: FloatArray, run: HandRun) -> FloatArray:
    return np.asarray(values[~run.seen & np.isfinite(run.joint_deg)])


def read_rows(runs: Sequence[HandRun], rows: Sequence[HandScenario]) -> list[ReadRow]:
    """What a therapist reads, wrist and joints of every row."""
    groups = {name: tuple(ANGLES.index(one) for one in JOINT_GROUPS[name]) for name in READ_JOINTS}
    out = []
    for row, mode, mine in _by_row(runs, rows):
        name = f"21 discs, {row.name}" + ("" if mode == "blobs" else " (pictures)")
        out.append(ReadRow(f"{name}: wrist", WRIST_COLUMNS, tuple(run.wrist_reading for run in mine)))
        out.append(ReadRow(f"{name}: joints", groups, tuple(run.joint_reading for run in mine)))
    return out

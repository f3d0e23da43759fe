"""The rows of the papers' own method: the same recordings as Carpus has, by :mod:`core.research.papers`.

Twice: as written, with the palm's discs in one plane, and with the palm as measured, to see how much of it is the arch.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from carpus.core.calibration.settings import CalibrationSettings
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.research.papers.hand_model import PalmModel, PaperSettings, calibrate_as_written
from carpus.core.research.papers.tracker import PaperTracker
from carpus.core.session.values import stack_states
from carpus.core.simulation.spec import RecordingSpec
from tests.accuracy.carpus import measured_hand, stepped
from tests.accuracy.hand21 import ANGLES, JOINT_GROUPS, HandScenario, clickable_sequence, seen_joints, with_end_joints
from tests.accuracy.hand21 import ROWS as HAND
from tests.accuracy.jobs import BLOB_SECONDS, side_by_side
from tests.accuracy.pages import ruled
from tests.accuracy.readings import Reading, read_figures, reading_of, unused_share
from tests.accuracy.runs import degrees_between, longest_s
from tests.accuracy.scenarios import TROUBLE, WRIST, Scenario
from tests.accuracy.sequences import longest_untracked_s, names_taken, scored_frames
from tests.accuracy.soft import SOFT_HAND, SOFT_WRIST
from tests.simulation.measurements import MeasurementSequence

PALMS: dict[PalmModel, str] = {"flat": "as written", "measured": "palm as measured"}
_TROUBLES = ("no false blobs", "10 false blobs", "30 % hidden", "leaves and returns")
_HANDS = ("discs on the skin", "discs in the joints", "10 false blobs", "30 % hidden", "leaves and returns")

WRIST_ROWS: tuple[Scenario, ...] = (*WRIST, *(row for row in TROUBLE if row.name in _TROUBLES), *SOFT_WRIST)
HAND_ROWS: tuple[HandScenario, ...] = (*(row for row in HAND if row.name in _HANDS), *SOFT_HAND)


@dataclass(frozen=True, slots=True)
class PaperJob:
    """One recording of one row."""

    row: str
    spec: RecordingSpec


@dataclass(frozen=True, slots=True)
class PaperRun:
    """What the papers' filter made of a recording.

    ``wrist`` angles as read, and ``joints`` (21) while seen, None where there are none; ``status`` (N,); ``taken``
    measurements, ``wrong`` of them another thing's, for ``longest_wrong_s`` on end; ``longest_untracked_s`` though
    enough discs showed; ``ms`` of CPU time a frame.
    """

    row: str
    palm: PalmModel
    wrist: Reading
    joints: Reading | None
    status: NDArray[np.int64]
    taken: int
    wrong: int
    longest_wrong_s: float
    longest_untracked_s: float
    ms: float


def paper_jobs(wrist: Sequence[Scenario], hand: Sequence[HandScenario], seeds: int) -> list[PaperJob]:
    """``seeds`` recordings of every row, the first of those that Carpus has there."""
    jobs = [PaperJob(row.name, row.spec(seed, BLOB_SECONDS)) for row in wrist for seed in row.seeds(seeds)[:seeds]]
    return jobs + [PaperJob(row.name, row.spec(number)) for row in hand for number in range(seeds)]


def paper_runs(job: PaperJob) -> list[PaperRun]:
    """Track one recording by every model of the palm."""
    sequence = clickable_sequence(job.spec)
    return [_run(job.row, sequence, palm) for palm in PALMS]


def _run(row: str, sequence: MeasurementSequence, palm: PalmModel) -> PaperRun:
    truth = sequence.truth
    hand, neutral_ends_s = measured_hand(sequence, CalibrationSettings())
    assert hand.calibration is not None
    settings = PaperSettings(palm=palm)
    tracker = PaperTracker(calibrate_as_written(hand.calibration, truth.camera, palm), truth.camera, settings)
    frames, ms = stepped(tracker, sequence, neutral_ends_s)
    kept, motion = scored_frames(truth, neutral_ends_s), stack_states(frames)
    measured_px = np.array([frame.marker_measured_px for frame in frames])
    names = names_taken(measured_px, sequence.detections, sequence.marker, kept)
    status = np.array([frame.status for frame in frames])

    def read(true_rad: FloatArray, found: FloatArray, sd: FloatArray, compared: NDArray[np.bool_] | None) -> Reading:
        error, sd_deg = degrees_between(found, true_rad)[kept], np.degrees(sd)[kept]
        error = error if compared is None else np.where(compared, error, np.nan)
        return reading_of(truth, kept, true_rad, error, sd_deg, unused=names.missed, shown=names.shown)

    joints = None
    if truth.spec.marker_protocol.has_fingers:
        every = (truth.joint_angles_rad, motion.joint_angles_rad, motion.joint_angles_sd_rad)
        joints = read(*map(with_end_joints, every), seen_joints(names.present))
    return PaperRun(
        row,
        palm,
        read(truth.angles_rad, motion.angles_rad, motion.angles_sd_rad, None),
        joints,
        status[kept],
        int(names.taken.sum()),
        int(names.wrong.sum()),
        longest_s(names.wrong, truth.timestamp_s[kept]),
        longest_untracked_s(sequence, status == TrackStatus.TRACKED),
        ms,
    )


def all_paper_runs(jobs: Sequence[PaperJob], processes: int) -> list[PaperRun]:
    """Runs of all jobs, in their order."""
    return [run for runs in side_by_side(_one_thread, jobs, processes) for run in runs]


def _one_thread(job: PaperJob) -> list[PaperRun]:
    with threadpool_limits(1):
        return paper_runs(job)


HEAD = [
    "papers' method", "palm", "recordings", "wrist RMSE", "95th percentile", "within 2 sd, %", "range, mean error",
    "range, worst error", "joints RMSE", "tracked / predicted / lost, %", "unused, %", "wrong, %", "longest swap, s",
    "back after, s", "ms",
]  # fmt: skip


def lines_of(runs: Sequence[PaperRun]) -> Iterator[list[str]]:
    """The cells of every line, in the order of the rows."""
    for row, has_fingers in dict.fromkeys((run.row, run.joints is not None) for run in runs):
        here = [run for run in runs if run.row == row and (run.joints is not None) == has_fingers]
        for palm, words in PALMS.items():
            mine = [run for run in here if run.palm == palm]
            if mine:
                yield [f"{row}, whole hand" if has_fingers else row, words, str(len(mine)), *_figures(mine)]


def _figures(runs: Sequence[PaperRun]) -> Iterator[str]:
    """Pooled over all frames of all runs in which anything is stated."""
    wrist = [read_figures([run.wrist for run in runs], (column,)) for column in range(3)]
    yield _cells([f.rmse for f in wrist])
    yield _cells([f.p95 for f in wrist])
    yield _cells([100 * f.inside for f in wrist], 0)
    yield _cells([f.range_mean for f in wrist], 0)
    yield _cells([f.range_worst for f in wrist], 0)
    joints = [run.joints for run in runs if run.joints is not None]
    groups = [[ANGLES.index(name) for name in names] for names in JOINT_GROUPS.values()]
    yield _cells([read_figures(joints, columns).rmse for columns in groups], 0) if joints else "-"
    status = np.concatenate([run.status for run in runs])
    states = (TrackStatus.TRACKED, TrackStatus.PREDICTED, TrackStatus.LOST)
    yield _cells([100 * float(np.mean(status == state)) for state in states], 0)
    yield f"{100 * unused_share([run.wrist for run in runs]):.1f}"
    yield f"{100 * sum(run.wrong for run in runs) / max(1, sum(run.taken for run in runs)):.1f}"
    yield f"{max(run.longest_wrong_s for run in runs):.1f}"
    yield f"{max(run.longest_untracked_s for run in runs):.1f}"
    yield f"{np.mean([run.ms for run in runs]):.2f}"


def _cells(values: Sequence[float], digits: int = 1) -> str:
    return " / ".join("-" if np.isnan(value) else f"{value:.{digits}f}" for value in values)


def report(only: str, seeds: int, processes: int) -> str:
    """Run the rows whose name holds ``only``, half as many recordings each as Carpus has there, and tell."""
    wrist = [row for row in WRIST_ROWS if only.lower() in row.name.lower()]
    hand = [row for row in HAND_ROWS if only.lower() in row.name.lower()]
    if not wrist and not hand:
        return ""
    lines = list(lines_of(all_paper_runs(paper_jobs(wrist, hand, max(1, seeds // 2)), processes)))
    return ruled([HEAD, *lines])

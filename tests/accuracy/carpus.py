"""Carpus on simulated measurements and on rendered pictures, and the true names of both."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.calibrate import CalibrationSettings, MeasuredHand, capture_neutral_pose, measure_hand
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.calibration.result import Calibration
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CalibrationImpossible
from carpus.core.model.types import Detections, FloatArray, TrackedFrame, TrackStatus
from carpus.core.pipeline.track import (
    HandTracker,
    TrackSettings,
    noise_from_json,
    noise_from_neutral,
    restart_at_neutral,
    track_recording,
)
from carpus.core.session.reader import read_detections, read_session
from carpus.core.session.values import Motion, Session, stack_states
from carpus.core.simulation.recording import CLICKS_FILE, sample_clicks
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import Truth
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.accuracy.readings import compute_reading, find_moves_rad
from tests.accuracy.scenarios import Scenario
from tests.accuracy.scores import CARPUS, Estimate, Mode, Run, degrees_between, longest_s
from tests.rendered import read_truth
from tests.simulation.measurements import MeasurementSequence


def measure_still_hand(sequence: MeasurementSequence, settings: CalibrationSettings) -> tuple[MeasuredHand, float]:
    """The hand as Carpus measures it on the still first frames, and when the last of those was."""
    truth = sequence.truth
    clicks = sample_clicks(truth)
    names = true_names(sequence.marker[0], len(clicks.pixel))
    capture = capture_neutral_pose(zip(truth.timestamp_s.tolist(), sequence.detections, strict=True), names, settings)
    hand = measure_hand(clicks, capture, truth.camera, settings)
    return hand, float(truth.timestamp_s[capture.frame_count - 1])


def calibrate_tracker(sequence: MeasurementSequence, settings: TrackerSettings | None = None) -> tuple[Tracker, float]:
    """A tracker of the hand that has learnt from the still frames how much the measurements scatter, and when those
    end."""
    settings = settings or TrackerSettings()
    hand, neutral_ends_s = measure_still_hand(sequence, CalibrationSettings())
    if hand.calibration is None:
        raise CalibrationImpossible(str(sequence.truth.spec.seed))
    learnt = noise_from_neutral(hand.noise, neutral_ends_s, settings)
    return Tracker(hand.calibration, sequence.truth.camera, learnt.adapt_settings(settings)), neutral_ends_s


def step_tracker(
    tracker: HandTracker, sequence: MeasurementSequence, neutral_ends_s: float
) -> tuple[list[TrackedFrame], float]:
    """The frames of measurements, tracked as :func:`core.pipeline.track.track_recording` does those of pictures, and
    the CPU milliseconds of one."""
    truth, begin = sequence.truth, time.process_time()
    times_s, dropped = truth.timestamp_s.tolist(), truth.dropped_before.tolist()
    frames = [
        tracker.step(i, times_s[i], sequence.detections[i], dropped[i])
        for i in restart_at_neutral(range(len(times_s)), tracker, neutral_ends_s, lambda row: times_s[row])
    ]
    return frames, 1e3 * (time.process_time() - begin) / len(times_s)


@dataclass(frozen=True, slots=True)
class Measured:
    """A recording tracked through the whole of Carpus, from folder to session file: what the session holds, the blobs
    of its frames, when the neutral pose ended."""

    session: Session
    blobs: tuple[Detections, ...]
    neutral_ends_s: float


def measure_session(folder: Path, settings: TrackSettings | None = None) -> Measured:
    """Track a rendered recording."""
    source, clicks = TumFolder(folder), read_clicks(folder / CLICKS_FILE)
    with tempfile.TemporaryDirectory() as place:
        output = Path(place) / "session.h5"
        track_recording(source, clicks, output, settings or TrackSettings())
        session, table = read_session(output), read_detections(output)
    learnt = noise_from_json(session.header.parameters)
    assert learnt is not None
    count = len(session.status)
    return Measured(session, tuple(table.get_frame(i) for i in range(count)), learnt.neutral_ends_s)


def detect_sequence(truth: Truth, measured: Measured) -> MeasurementSequence:
    """The blobs that were found in a simulated recording, named by the truth."""
    labels = (label_blobs(b, truth.marker_px[i], truth.visible_share[i]) for i, b in enumerate(measured.blobs))
    return MeasurementSequence(truth, measured.blobs, tuple(labels))


def run_on_blobs(scenario: Scenario, sequence: MeasurementSequence) -> tuple[Run, float]:
    """Track and smooth measurements; also when the neutral pose ends: only frames after it are scored."""
    tracker, neutral_ends_s = calibrate_tracker(sequence)
    frames, _ = step_tracker(tracker, sequence, neutral_ends_s)
    status = np.array([frame.status for frame in frames])
    measured_px = np.array([frame.marker_measured_px for frame in frames])
    motions = stack_states(frames), stack_states(tracker.smooth())
    return _score_run(scenario.name, "blobs", sequence, neutral_ends_s, *motions, measured_px, status), neutral_ends_s


def run_on_pictures(name: str, spec: RecordingSpec, folder: Path) -> tuple[Run, MeasurementSequence, float]:
    """Track a rendered recording through the whole of Carpus.

    Also the blobs that were found, by their true names, and when the neutral pose ended.
    """
    found = measure_session(folder)
    sequence, session = detect_sequence(read_truth(spec, folder), found), found.session
    assert session.smoothed is not None
    run = _score_run(
        name, "pictures", sequence, found.neutral_ends_s, session.motion, session.smoothed,
        session.markers.measured_px, session.status.astype(np.int64),
    )  # fmt: skip
    return run, sequence, found.neutral_ends_s


def _score_run(
    name: str,
    mode: Mode,
    sequence: MeasurementSequence,
    begin_s: float,
    live: Motion,
    back: Motion,
    measured_px: FloatArray,
    status: NDArray[np.int64],
) -> Run:
    truth = sequence.truth
    scored = select_scored_frames(truth, begin_s)
    time_s = truth.time_s[scored]
    names = names_taken(measured_px, sequence.detections, sequence.marker, scored)
    causal, smoothed = (
        Estimate(degrees_between(one.angles_rad, truth.angles_rad)[scored], np.degrees(one.angles_sd_rad)[scored])
        for one in (live, back)
    )
    return Run(
        name,
        truth.spec.seed,
        mode,
        CARPUS,
        causal,
        smoothed,
        status[scored],
        int(names.taken.sum()),
        int(names.wrong.sum()),
        longest_s(names.wrong, truth.timestamp_s[scored]),
        longest_untracked_s(sequence, status == TrackStatus.TRACKED),
        compute_reading(
            time_s,
            find_moves_rad(truth, time_s),
            truth.angles_rad,
            scored,
            causal.error_deg,
            causal.sd_deg,
            unused=names.missed,
            shown=names.shown,
        ),
    )


OWN_PX = 6.0
"""A blob's middle further than this from a disc's is not that disc's, even half covered."""
LEAST_SEEN = 0.1
LEAST_DISCS = 3
ENOUGH_DISCS = 4
"""So many discs of the palm are enough to find it anew."""


def true_names(labels: NDArray[np.int64], markers: int) -> NDArray[np.int64]:
    """Blob of every marker (M,) from the marker of every blob (D,); -1 for none."""
    taken = np.full(markers, -1, dtype=np.int64)
    real = np.flatnonzero(labels >= 0)
    taken[labels[real]] = real
    return taken


def label_blobs(blobs: Detections, disc_px: FloatArray, visible_share: FloatArray) -> NDArray[np.int64]:
    """Marker of every blob (D,), -1 for none: the disc (M, 2) whose middle is nearest, each disc's nearest blob."""
    gap = np.linalg.norm(blobs.pixel[:, None] - disc_px[None], axis=-1)
    gap = np.where((gap < OWN_PX) & (visible_share > LEAST_SEEN), gap, np.inf)
    labels = np.full(len(blobs), -1, dtype=np.int64)
    for marker in range(disc_px.shape[0]):
        if len(blobs) and np.isfinite(gap[:, marker].min()):
            blob = int(gap[:, marker].argmin())
            if gap[blob].argmin() == marker:
                labels[blob] = marker
    return labels


def enough_inside(palm_px: FloatArray, camera: Camera) -> NDArray[np.bool_]:
    """Frames (N,) with three discs of the palm (N, 6, 2) inside the picture: without, nothing can be known."""
    inside = ((palm_px >= 0.0) & (palm_px <= [camera.width_px - 1, camera.height_px - 1])).all(axis=-1)
    return np.asarray(inside.sum(axis=1) >= LEAST_DISCS)


def select_scored_frames(truth: Truth, begin_s: float) -> NDArray[np.bool_]:
    """Frames (N,) after ``begin_s`` in which something can be known."""
    palm_px = truth.marker_px[:, list(truth.spec.marker_protocol.palm)]
    return np.asarray((truth.timestamp_s > begin_s) & enough_inside(palm_px, truth.camera))


def longest_untracked_s(sequence: MeasurementSequence, tracked: NDArray[np.bool_]) -> float:
    """Longest time on end that the hand was not tracked (N,) though the blobs of four discs of its palm were there."""
    palm = np.array(sequence.truth.spec.marker_protocol.palm)
    could = np.array([np.isin(palm, names).sum() >= ENOUGH_DISCS for names in sequence.marker])
    longest, since = 0.0, None
    for now_s, missed in zip(sequence.truth.timestamp_s, could & ~tracked, strict=True):
        if since is not None:
            longest = max(longest, float(now_s - since))
        since = (now_s if since is None else since) if missed else None
    return longest


def split_measurements(sequence: MeasurementSequence) -> tuple[FloatArray, FloatArray]:
    """Measured pixels and depths (N, M, 3) by true name, NaN where not seen, and their errors."""
    truth = sequence.truth
    true = np.concatenate((truth.marker_px, truth.marker_position_cam_m[..., 2:]), axis=-1)
    measured = np.full(true.shape, np.nan)
    for i, (blobs, labels) in enumerate(zip(sequence.detections, sequence.marker, strict=True)):
        names = true_names(labels, true.shape[1])
        seen = np.flatnonzero(names >= 0)
        measured[i, seen, :2] = blobs.pixel[names[seen]]
        measured[i, seen, 2] = blobs.depth_m[names[seen]]
    return measured, measured - true


@dataclass(frozen=True, slots=True)
class NamesTaken:
    """Of F frames and M markers (F, M): there to be seen, measured, measured by another thing's blob."""

    present: NDArray[np.bool_]
    taken: NDArray[np.bool_]
    wrong: NDArray[np.bool_]

    @property
    def missed(self) -> int:
        """Discs that were there and not taken."""
        return int((self.present & ~self.taken).sum())

    @property
    def shown(self) -> int:
        return int(self.present.sum())


def names_taken(
    measured_px: FloatArray, blobs: Sequence[Detections], labels: Sequence[NDArray[np.int64]], frames: NDArray[np.bool_]
) -> NamesTaken:
    """What was taken in the scored ``frames`` (N,), by the pixels (N, M, 2) of the measurements, NaN for none, and the
    true markers of every frame's blobs."""
    rows = np.flatnonzero(frames)
    taken = np.isfinite(measured_px[rows, :, 0])
    present = np.array([np.isin(np.arange(taken.shape[1]), labels[i]) for i in rows])
    wrong = np.zeros(taken.shape, dtype=bool)
    for k, marker in np.argwhere(taken):
        i = rows[k]
        wrong[k, marker] = (
            labels[i][int(np.abs(blobs[i].pixel - measured_px[i, marker]).sum(axis=1).argmin())] != marker
        )
    return NamesTaken(present, taken, wrong)


def calibrate_sequence(seen: MeasurementSequence) -> Calibration:
    """What the calibration knows of the hand."""
    hand, _ = measure_still_hand(seen, CalibrationSettings())
    assert hand.calibration is not None
    return hand.calibration


def build_tracker(seen: MeasurementSequence) -> Tracker:
    """A tracker of that hand, with the settings as they are."""
    return Tracker(calibrate_sequence(seen), seen.truth.camera, TrackerSettings())

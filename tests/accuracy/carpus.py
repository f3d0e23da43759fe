"""Carpus on simulated measurements and on rendered pictures."""

from __future__ import annotations

import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.calibrate import CalibrationSettings, MeasuredHand, capture_neutral_pose, measure_hand
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
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
from tests.accuracy.readings import compute_reading
from tests.accuracy.scenarios import Scenario
from tests.accuracy.scores import CARPUS, Estimate, Mode, Run, degrees_between, longest_s
from tests.accuracy.sequences import label_blobs, longest_untracked_s, names_taken, select_scored_frames, true_names
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
            truth, scored, truth.angles_rad, causal.error_deg, causal.sd_deg, unused=names.missed, shown=names.shown
        ),
    )

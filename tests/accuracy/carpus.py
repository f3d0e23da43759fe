"""Carpus on simulated measurements and on rendered pictures."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.calibrate import MeasuredHand, measure_hand, still_capture
from carpus.core.calibration.clicks import read_clicks
from carpus.core.calibration.settings import CalibrationSettings
from carpus.core.capture.files.tum import TumFolder
from carpus.core.errors import CalibrationImpossible
from carpus.core.pipeline.track import TrackSettings, from_neutral, learnt_from, learnt_in, track_recording
from carpus.core.session.reader import read_session
from carpus.core.session.values import Motion, motion_of
from carpus.core.simulation.recording import CLICKS_FILE, cached_recording, clicks_of
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import FloatArray, TrackedFrame, TrackStatus
from tests.accuracy.readings import Reading, reading_of
from tests.accuracy.runs import CARPUS, Estimate, Run, degrees_between, longest_s
from tests.accuracy.scenarios import Scenario
from tests.accuracy.sequences import detected_sequence, longest_untracked_s, scored_frames, true_names, wrongly_taken
from tests.accuracy.speeds import stroke_speeds
from tests.rendered import truth_in
from tests.simulation.measurements import MeasurementSequence


def measured_hand(sequence: MeasurementSequence, settings: CalibrationSettings) -> tuple[MeasuredHand, float]:
    """The hand as Carpus measures it on the still first frames, and when the last of those was."""
    truth = sequence.truth
    clicks = clicks_of(truth)
    names = true_names(sequence.marker[0], len(clicks.pixel))
    capture = still_capture(zip(truth.timestamp_s.tolist(), sequence.detections, strict=True), names, settings)
    hand = measure_hand(clicks, capture, truth.camera, settings)
    return hand, float(truth.timestamp_s[capture.frames - 1])


def run_on_blobs(
    scenario: Scenario,
    sequence: MeasurementSequence,
    settings: TrackerSettings | None = None,
    method: str = CARPUS,
) -> tuple[Run, float]:
    """Track and smooth measurements as :func:`core.pipeline.track.track_recording` does those of pictures.

    Also when the neutral pose ends: only frames after it are scored.
    """
    settings = TrackerSettings() if settings is None else settings
    truth = sequence.truth
    hand, neutral_ends_s = measured_hand(sequence, CalibrationSettings())
    if hand.calibration is None:
        raise CalibrationImpossible(scenario.name, str(truth.spec.seed))
    learnt = learnt_from(hand.noise, neutral_ends_s, settings)
    tracker = Tracker(hand.calibration, truth.camera, learnt.applied(settings))
    frames: list[TrackedFrame] = []
    times = truth.timestamp_s
    begin = time.process_time()
    for i in from_neutral(range(len(times)), tracker, neutral_ends_s, lambda row: float(times[row])):
        dropped = int(truth.dropped_before[i])
        frames.append(tracker.step(i, float(times[i]), sequence.detections[i], dropped))
    ms = 1e3 * (time.process_time() - begin) / len(times)
    scored = scored_frames(truth, neutral_ends_s)
    status = np.array([frame.status for frame in frames])
    smoothed = motion_of(tracker.smoothed())
    measured_px = np.array([frame.marker_measured_px for frame in frames])[scored]
    part = _part(sequence, scored)
    wrong = wrongly_taken(measured_px, part)
    live = _estimate(motion_of(frames), truth.angles_rad, scored)
    return Run(
        scenario.name,
        truth.spec.seed,
        "blobs",
        method,
        live,
        _estimate(smoothed, truth.angles_rad, scored),
        status[scored],
        int(np.isfinite(measured_px[..., 0]).sum()),
        int(wrong.sum()),
        longest_s(wrong, times[scored]),
        longest_untracked_s(sequence, status == TrackStatus.TRACKED),
        ms,
        stroke_speeds(truth, scored, smoothed),
        _reading(part, scored, live, measured_px),
    ), neutral_ends_s


def run_on_pictures(
    scenario: Scenario, seed: int, seconds: float, settings: TrackSettings | None = None
) -> tuple[Run, MeasurementSequence, float, Path]:
    """Track a rendered recording through the whole of Carpus, from folder to session file.

    Also the blobs that were found, by their true names, when the neutral pose ended, and the recording's folder.
    """
    spec = scenario.spec(seed, seconds)
    folder = cached_recording(spec)
    truth = truth_in(spec, folder)
    source = TumFolder(folder)
    clicks = read_clicks(folder / CLICKS_FILE)
    with tempfile.TemporaryDirectory() as place:
        output = Path(place) / "session.h5"
        begin = time.process_time()
        track_recording(source, clicks, output, settings or TrackSettings(), software_version="accuracy")
        ms = 1e3 * (time.process_time() - begin) / len(truth.timestamp_s)
        session = read_session(output)
        sequence = detected_sequence(truth, output)
    learnt = learnt_in(session.header.parameters)
    assert learnt is not None
    scored = scored_frames(truth, learnt.neutral_ends_s)
    measured_px = session.markers.measured_px[scored]
    part = _part(sequence, scored)
    wrong = wrongly_taken(measured_px, part)
    live = _estimate(session.motion, truth.angles_rad, scored)
    assert session.smoothed is not None
    run = Run(
        scenario.name,
        seed,
        "pictures",
        CARPUS,
        live,
        _estimate(session.smoothed, truth.angles_rad, scored),
        session.status[scored].astype(np.int64),
        int(np.isfinite(measured_px[..., 0]).sum()),
        int(wrong.sum()),
        longest_s(wrong, truth.timestamp_s[scored]),
        longest_untracked_s(sequence, session.status == TrackStatus.TRACKED),
        ms,
        stroke_speeds(truth, scored, session.smoothed),
        _reading(part, scored, live, measured_px),
    )
    return run, sequence, learnt.neutral_ends_s, folder


def _part(sequence: MeasurementSequence, rows: NDArray[np.bool_]) -> MeasurementSequence:
    """The blobs and names of some frames; the truth stays whole."""
    kept = np.flatnonzero(rows)
    return MeasurementSequence(
        sequence.truth, tuple(sequence.detections[i] for i in kept), tuple(sequence.marker[i] for i in kept)
    )


def _reading(part: MeasurementSequence, scored: NDArray[np.bool_], live: Estimate, measured_px: FloatArray) -> Reading:
    """What a therapist reads live off the wrist; ``part`` and ``measured_px`` are of the scored frames alone."""
    truth = part.truth
    present = np.array([np.isin(np.arange(measured_px.shape[1]), names) for names in part.marker])
    unused = present & ~np.isfinite(measured_px[..., 0])
    return reading_of(
        truth, scored, truth.angles_rad, live.error_deg, live.sd_deg, unused=int(unused.sum()), shown=int(present.sum())
    )


def _estimate(motion: Motion, true_rad: FloatArray, scored: NDArray[np.bool_]) -> Estimate:
    error_deg, sd_deg = degrees_between(motion.angles_rad, true_rad), np.degrees(motion.angles_sd_rad)
    return Estimate(error_deg[scored], sd_deg[scored])

"""The main job without a screen: a stored recording and its clicks to a complete session file."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from core.calibration.calibrate import CalibrationOutcome, StillNoise, calibrate, require_calibration
from core.calibration.result import Calibration, Clicks, Verdict
from core.calibration.settings import CalibrationSettings
from core.capture.source import FrameSource, SourceInfo
from core.detection.detector import Detector
from core.detection.settings import DetectionSettings
from core.errors import OutputExists, RecordingEmpty
from core.pipeline.frame_walk import FrameWalk
from core.session.reader import read_detections, read_session
from core.session.values import motion_of, new_header
from core.session.writer import SessionWriter
from core.tracking.settings import TrackerSettings
from core.tracking.tracker import Tracker
from core.types import FloatArray, Frame, TrackedFrame, TrackStatus

Progress = Callable[[int, int | None], None]
"""Called with frames done and frames in all (None when unknown)."""


@dataclass(frozen=True, slots=True)
class TrackSettings:
    """Everything that decides how a recording becomes a session."""

    detection: DetectionSettings = field(default_factory=DetectionSettings)
    calibration: CalibrationSettings = field(default_factory=CalibrationSettings)
    tracker: TrackerSettings = field(default_factory=TrackerSettings)
    smooth: bool = True


@dataclass(frozen=True, slots=True)
class TrackReport:
    """What came of it: frames by status, range (min, max) of each wrist angle over tracked frames in radians."""

    output: Path
    frames: int
    tracked: int
    predicted: int
    lost: int
    verdict: Verdict
    angle_range_rad: FloatArray


def parameters_json(settings: TrackSettings, source: Mapping[str, Any]) -> str:
    """All settings and the facts of the source, as stored in the session."""
    return json.dumps({"settings": asdict(settings), "source": dict(source)}, sort_keys=True)


def source_facts(info: SourceInfo) -> dict[str, Any]:
    """What a session says about where its pictures came from."""
    return {
        "name": info.name,
        "nominal_fps": info.nominal_fps,
        "intrinsics": info.camera.origin,
        **info.settings,
    }


DEPTH_RATIO = (0.5, 2.0)
"""How far the still hand may correct what is said of the depths' noise; a still hand can lock to one step."""


def learnt(settings: TrackerSettings, still: StillNoise) -> TrackerSettings:
    """Tracker settings with the measurement noise that the still hand showed, where it was still long enough."""
    noise = settings.noise
    if np.isfinite(still.pixel_sd_px):
        noise = replace(noise, pixel_sd_px=float(np.hypot(still.pixel_sd_px, noise.pixel_model_sd_px)))
    if np.isfinite(still.depth_ratio):
        noise = replace(noise, depth_ratio=float(np.clip(still.depth_ratio, *DEPTH_RATIO)))
    return replace(settings, noise=noise)


def build_walk(
    outcome: CalibrationOutcome, info: SourceInfo, settings: TrackSettings, keep_history: bool = True
) -> FrameWalk:
    """Detector and tracker for a calibrated hand; raises what :func:`require_calibration` does."""
    calibration = require_calibration(outcome)
    detector = Detector(outcome.appearance, info.camera, settings.detection)
    tracker = Tracker(calibration, info.camera, learnt(settings.tracker, outcome.noise), keep_history=keep_history)
    return FrameWalk(detector, tracker)


def track_recording(
    source: FrameSource,
    clicks: Clicks,
    output: Path,
    settings: TrackSettings,
    *,
    software_version: str,
    subject_id: str = "",
    exercise: str = "",
    start_angles_rad: FloatArray | None = None,
    progress: Progress | None = None,
    on_verdict: Callable[[Verdict], None] | None = None,
) -> TrackReport:
    """Track a recording from its first frame to its last into ``output``; smooth it if asked.

    A poor verdict is handed to ``on_verdict`` and tracking goes on; a click with no blob or no depth raises.
    When a picture cannot be read, nothing half-done is left behind.
    """
    if output.exists():
        raise OutputExists(output)
    frames = source.frames()
    opening = _opening(frames, settings.calibration.still_s)
    if not opening:
        raise RecordingEmpty(source.info.name)
    outcome = calibrate(clicks, opening, source.info.camera, settings.calibration, settings.detection, start_angles_rad)
    calibration = require_calibration(outcome)
    if on_verdict is not None and not outcome.verdict.is_good:
        on_verdict(outcome.verdict)
    walk = build_walk(outcome, source.info, settings, keep_history=settings.smooth)
    neutral_ends_s = opening[outcome.capture_frames - 1].timestamp_s

    def tracked() -> Iterator[TrackedFrame]:
        begun = False
        for frame in chain(opening, frames):
            if not begun and frame.timestamp_s > neutral_ends_s:
                # The still frames made the calibration; counted twice they would make it too sure of itself.
                walk.tracker.begin_at_neutral()
                begun = True
            yield walk(frame)

    header = new_header(
        hand=clicks.side,
        protocol=clicks.protocol,
        software_version=software_version,
        subject_id=subject_id,
        exercise=exercise,
        parameters=parameters_json(settings, source_facts(source.info)),
        dip_free=settings.tracker.dip == "free",
    )
    writer = SessionWriter.create(output, header, source.info.camera, calibration)
    return _written(
        writer, tracked(), walk.tracker, outcome.verdict, settings.smooth, source.info.frame_count, progress
    )


def retrack_session(
    origin: Path,
    output: Path,
    settings: TrackSettings,
    *,
    software_version: str,
    progress: Progress | None = None,
) -> TrackReport:
    """Filter a stored session again from its detections, with its own calibration; the old file is not touched."""
    if output.exists():
        raise OutputExists(output)
    session = read_session(origin)
    table = read_detections(origin)
    calibration: Calibration = session.calibration
    tracker = Tracker(calibration, session.camera, settings.tracker, keep_history=settings.smooth)

    def tracked() -> Iterator[TrackedFrame]:
        for row, time_s in enumerate(session.timestamp_s):
            dropped = int(session.quality.dropped_before[row])
            yield tracker.step(row, float(time_s), table.of_frame(row), dropped)

    header = new_header(
        hand=session.header.hand,
        protocol=session.header.protocol,
        software_version=software_version,
        subject_id=session.header.subject_id,
        exercise=session.header.exercise,
        parameters=parameters_json(settings, {"session": session.header.session_id, "from": "detections"}),
        origin=session.header.session_id,
        dip_free=settings.tracker.dip == "free",
    )
    writer = SessionWriter.create(output, header, session.camera, calibration)
    return _written(
        writer, tracked(), tracker, calibration.verdict, settings.smooth, len(session.timestamp_s), progress
    )


def _opening(frames: Iterator[Frame], still_s: float) -> list[Frame]:
    """The first frames, as far as the neutral capture may reach, and the one that shows it is over."""
    opening: list[Frame] = []
    for frame in frames:
        opening.append(frame)
        if frame.timestamp_s - opening[0].timestamp_s > still_s:
            break
    return opening


def _written(
    writer: SessionWriter,
    tracked: Iterator[TrackedFrame],
    tracker: Tracker,
    verdict: Verdict,
    smooth: bool,
    total: int | None,
    progress: Progress | None,
) -> TrackReport:
    counts = dict.fromkeys(TrackStatus, 0)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    try:
        done = 0
        for frame in tracked:
            writer.append(frame)
            counts[frame.status] += 1
            if frame.status is TrackStatus.TRACKED:
                low, high = np.minimum(low, frame.angles_rad), np.maximum(high, frame.angles_rad)
            done += 1
            if progress is not None:
                progress(done, total)
        if smooth:
            writer.write_smoothed(motion_of(tracker.smoothed()))
        writer.close()
    except BaseException:
        # The recording is still there: a session cut short would only be taken for a whole one.
        writer.discard()
        raise
    reach = np.stack((low, high))
    return TrackReport(
        writer.path,
        done,
        counts[TrackStatus.TRACKED],
        counts[TrackStatus.PREDICTED],
        counts[TrackStatus.LOST],
        verdict,
        np.where(np.isfinite(reach), reach, np.nan),
    )

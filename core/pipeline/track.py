"""Tracking of stored recordings without a screen: from clicks and frames to a complete session file.

Each frame goes from blobs to labelled markers, state estimate and angles.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field, fields, replace
from itertools import chain
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from carpus.core.calibration.calibrate import (
    CalibrationOutcome,
    CalibrationSettings,
    MeasurementNoise,
    calibrate_hand,
    require_calibration,
)
from carpus.core.calibration.neutral_pose import with_w0_from_markers
from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.capture.files.image_codec import decode_color, decode_depth
from carpus.core.capture.files.raw import LazyFrame, RawRecording
from carpus.core.capture.source import FrameSource, RecordingDate, SourceInfo, compute_recording_id, find_recording_date
from carpus.core.detection.appearance import DetectionSettings
from carpus.core.detection.detector import Detector
from carpus.core.detection.surface_samples import compute_read_region, sample_fingers, sample_surface
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import ASSUMED
from carpus.core.model.errors import FrameDamaged, OutputExists, RecordingEmpty
from carpus.core.model.phrase import phrase
from carpus.core.model.types import (
    SIMULATED,
    Detections,
    FloatArray,
    Frame,
    KinematicState,
    TrackedFrame,
    TrackStatus,
)
from carpus.core.pipeline.live import Listener
from carpus.core.platform.provenance import sha256_of_file, sha256_of_recording, sha256_of_settings, source_revision
from carpus.core.session.checks import check_calibration
from carpus.core.session.reader import has_raw, raw_depth_unit_m, read_detections, read_raw, read_session
from carpus.core.session.values import SET_UP, Event, Session, new_header, stack_states
from carpus.core.session.writer import SessionWriter
from carpus.core.tracking.filter.predicted_measurement import PredictedMeasurement
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker

AnyFrame = Frame | LazyFrame
"""A frame, or one whose images are decoded when needed."""


PIXEL_MODEL_SD_PX = 0.08
"""Error of a marker's centre that a still hand does not show: shading, blur, the lens."""
DEPTH_RATIOS = (0.5, 2.0)
"""Accepted range of the depth noise ratio, since a still hand can lock to one step of depth."""


class HandTracker(Protocol):
    """Tracker of one calibrated hand; :class:`Tracker`, or a filter for research."""

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Set the hand back to its neutral pose."""

    def predict_measurement(self, timestamp_s: float) -> PredictedMeasurement | None:
        """Predict the measurement at a time; None to search the whole image."""

    def is_search_incomplete(self, blobs: Detections) -> bool:
        """Return whether the whole image has to be searched after all."""

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Track one frame by its blobs."""


AnyTracker = TypeVar("AnyTracker", bound=HandTracker)


class FramePipeline(Generic[AnyTracker]):
    """Detector and tracker of one calibrated hand; to be called with each frame in order."""

    def __init__(self, detector: Detector, tracker: AnyTracker) -> None:
        self.detector = detector
        self.tracker = tracker

    def __call__(self, given: AnyFrame) -> TrackedFrame:
        """Track one frame; without a prediction the whole image is searched."""
        expected = self.tracker.predict_measurement(given.timestamp_s)
        region = part = None
        if expected is not None:
            region = self.detector.compute_search_region(expected.pixel, expected.covariance_px2, expected.depth_m)
            if not isinstance(given, Frame):  # a live picture is whole already
                part = compute_read_region(region, expected.dorsal_px, expected.finger_px)
        frame = given.decode(part)
        blobs = self.detector.detect(frame, region)
        if region is not None and self.tracker.is_search_incomplete(blobs):
            frame = given.decode(None)
            blobs = self.detector.detect(frame, None)
        if expected is not None:
            blobs = blobs.with_readings(
                sample_surface(frame, expected.dorsal_px),
                sample_fingers(frame, expected.finger_px),
            )
        return self.tracker.step(frame.index, frame.timestamp_s, blobs, frame.dropped_before)


SMOOTHING_FAILED = "not_looked_back"
"""Event of a session whose smoothing failed."""
LIVE_LABEL = "spot_said"
"""Event of a label that was given while Carpus 0.2.0 measured; it is not applied again."""


def session_notes(session: Session) -> list[Event]:
    """Return the events of a session, without those of its processing."""
    return [event for event in session.events if event.kind not in (SMOOTHING_FAILED, LIVE_LABEL)]


class SessionFrames:
    """Stored images of a session as a :class:`core.capture.source.FrameSource`, with its times."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._unit_m = raw_depth_unit_m(session.path)
        self.info = SourceInfo(
            name=session.header.session_id,
            camera=session.camera,
            has_depth=True,
            frame_count=len(session),
            nominal_fps=30.0,
            settings={"format": "session"} | ({SIMULATED: "yes"} if session.header.is_simulated else {}),
            recording_id=session.header.recording_id,
            recorded=session.header.recorded,
        )

    def frames(self) -> Iterator[Frame]:
        """Yield the frames in order; raises :class:`FrameDamaged` if one cannot be decoded."""
        session = self._session
        for row, images in enumerate(read_raw(session.path)):
            color = decode_color(images.color)
            if color is None:
                raise FrameDamaged(session.path, phrase("colour frame {row}", row=row))
            depth = decode_depth(images.depth) if images.depth else None
            time_s, dropped = float(session.timestamp_s[row]), int(session.quality.dropped_before[row])
            yield Frame(row, time_s, color, depth, self._unit_m, max(dropped, 0))

    def close(self) -> None:
        """Do nothing: no file is open between two passes."""


T = TypeVar("T")

Progress = Callable[[int, int | None], None]
"""Called with the frames done and the frames in all (None if unknown)."""
SmoothFunction = Callable[[], list[KinematicState]]


@dataclass(frozen=True, slots=True)
class TrackSettings:
    """All settings that decide how a recording becomes a session.

    A filter for research has a class of its own with one more section.
    """

    detection: DetectionSettings = field(default_factory=DetectionSettings)
    calibration: CalibrationSettings = field(default_factory=CalibrationSettings)
    tracker: TrackerSettings = field(default_factory=TrackerSettings)
    smooth: bool = True

    @property
    def dip_free(self) -> bool:
        """Whether the DIP joints are tracked independently."""
        return self.tracker.dip == "free"

    @property
    def uses_depth(self) -> bool:
        """Whether depth is used in tracking."""
        return self.tracker.use_depth

    def build_tracker(
        self, calibration: Calibration, camera: Camera, noise: NeutralNoise
    ) -> tuple[HandTracker, SmoothFunction | None]:
        """Return the tracker of a calibrated hand, and its smoother if wanted."""
        tracker = Tracker(calibration, camera, noise.adapt_settings(self.tracker), keep_history=self.smooth)
        return tracker, tracker.smooth if self.smooth else None

    def adapt_calibration(self, calibration: Calibration, camera: Camera) -> Calibration:
        """Return a new calibration as this filter needs it."""
        return calibration

    def adapt_stored_calibration(self, session: Session) -> Calibration:
        """Return the calibration of a session, of whatever filter, as this filter needs it."""
        is_other = is_of_other_filter(session.header.parameters)
        return with_w0_from_markers(session.calibration) if is_other else session.calibration


@dataclass(frozen=True, slots=True)
class TrackReport:
    """Number of frames by status."""

    output: Path
    frames: int
    tracked: int
    predicted: int
    lost: int
    doubtful: int
    verdict: Verdict


@dataclass(frozen=True, slots=True)
class NeutralNoise:
    """Noise estimated at the neutral pose.

    Attributes
    ----------
    pixel_sd_px, depth_noise_ratio : float
        Standard deviation of a marker's centre; depth noise relative to the sensor's model.
    neutral_ends_s : float
        End of the neutral pose on the recording's clock.
    disc_radius_m : float
        Radius of the markers.
    """

    pixel_sd_px: float
    depth_noise_ratio: float
    neutral_ends_s: float
    disc_radius_m: float = 0.006

    def adapt_settings(self, settings: TrackerSettings) -> TrackerSettings:
        """Return tracker settings with this noise and marker radius."""
        noise = replace(settings.noise, pixel_sd_px=self.pixel_sd_px, depth_noise_ratio=self.depth_noise_ratio)
        return replace(settings, noise=noise, marker_radius_m=self.disc_radius_m)


def format_parameters(
    settings: TrackSettings, source: Mapping[str, Any], noise: NeutralNoise, set_up: Mapping[str, Any] | None = None
) -> str:
    """Return settings, neutral noise, source, targets and revision as JSON."""
    chosen = asdict(settings)
    content: dict[str, Any] = {"settings": chosen, "learnt": asdict(noise), "source": dict(source)}
    content["provenance"] = {"revision": source_revision(), "settings_sha256": sha256_of_settings(chosen)}
    if set_up:
        content[SET_UP] = dict(set_up)
    return json.dumps(content, sort_keys=True)


def noise_from_json(parameters: str) -> NeutralNoise | None:
    """Return the neutral noise stored in a session's parameters; None if there is none."""
    try:
        return NeutralNoise(**json.loads(parameters)["learnt"])
    except (KeyError, TypeError, ValueError):
        return None


def is_of_other_filter(parameters: str) -> bool:
    """Return whether a filter for research tracked a session: its settings have a section of their own."""
    try:
        stored: Mapping[str, Any] = json.loads(parameters)["settings"]
        own_names = {one.name for one in fields(TrackSettings)}
        return any(isinstance(value, Mapping) for name, value in stored.items() if name not in own_names)
    except (AttributeError, KeyError, TypeError, ValueError):
        return False


def describe_source(info: SourceInfo) -> dict[str, Any]:
    """Return what a session stores of its source."""
    sensor = info.camera.sensor
    return {
        "name": info.name,
        "nominal_fps": info.nominal_fps,
        "intrinsics": info.camera.origin,
        "depth_sensor": sensor.name if sensor.origin != ASSUMED else f"{sensor.name} (assumed)",
        **info.settings,
    }


def noise_from_neutral(still: MeasurementNoise, neutral_ends_s: float, settings: TrackerSettings) -> NeutralNoise:
    """Return the noise and marker radius at the neutral pose, or the settings' if they are unknown."""
    noise = settings.noise
    pixel_sd_px, depth_noise_ratio = noise.pixel_sd_px, noise.depth_noise_ratio
    if np.isfinite(still.pixel_sd_px):
        pixel_sd_px = float(np.hypot(still.pixel_sd_px, PIXEL_MODEL_SD_PX))
    if np.isfinite(still.depth_noise_ratio):
        depth_noise_ratio = float(np.clip(still.depth_noise_ratio, *DEPTH_RATIOS))
    radius_m = still.marker_radius_m if np.isfinite(still.marker_radius_m) else settings.marker_radius_m
    return NeutralNoise(pixel_sd_px, depth_noise_ratio, neutral_ends_s, radius_m)


def build_pipeline(
    outcome: CalibrationOutcome, camera: Camera, settings: TrackSettings, noise: NeutralNoise, keep_history: bool = True
) -> FramePipeline[Tracker]:
    """Build detector and tracker for a calibrated hand; raises what :func:`require_calibration` does."""
    calibration = require_calibration(outcome)
    detector = Detector(outcome.appearance, camera, settings.detection)
    tracker = Tracker(calibration, camera, noise.adapt_settings(settings.tracker), keep_history=keep_history)
    return FramePipeline(detector, tracker)


_MAX_NEUTRAL_GAP_S = 0.25
"""The hand is still at the neutral pose so soon after the still frames."""


def restart_at_neutral(
    frames: Iterable[T], tracker: HandTracker, neutral_ends_s: float, time_of: Callable[[T], float]
) -> Iterator[T]:
    """Yield the frames; before the first after the calibration the tracker is set back to the neutral pose.

    The still frames made the calibration; counted twice they would make it overconfident. If the first frame comes
    later, the hand may have moved meanwhile.
    """
    start, is_first = False, True
    for frame in frames:
        if not start and (late_s := time_of(frame) - neutral_ends_s) > 0.0:
            if is_first and _MAX_NEUTRAL_GAP_S < late_s < math.inf:
                tracker.begin_at_neutral(neutral_ends_s)
            else:
                tracker.begin_at_neutral()
            start = True
        is_first = False
        yield frame


@dataclass(frozen=True, slots=True)
class TrackingStart:
    """Stored recording ready to be tracked.

    Attributes
    ----------
    first_frame : Frame
        First frame of the recording.
    frames : iterator
        All frames from the first on.
    pipeline : FramePipeline
        Detector and tracker.
    smooth : callable, optional
        Returns the smoothed states.
    """

    first_frame: Frame
    frames: Iterator[AnyFrame]
    pipeline: FramePipeline[HandTracker]
    smooth: SmoothFunction | None
    calibration: Calibration
    noise: NeutralNoise


def start_tracking(
    source: FrameSource,
    clicks: Clicks,
    settings: TrackSettings,
    start_angles_rad: FloatArray | None = None,
    on_verdict: Callable[[Verdict], None] | None = None,
) -> TrackingStart:
    """Calibrate from the first frames and build the tracker.

    A poor verdict is passed to ``on_verdict``.

    Raises
    ------
    CarpusFault
        A click has no blob or no depth.
    RecordingEmpty
        There is no frame.
    """
    frames: Iterator[AnyFrame] = source.lazy_frames() if isinstance(source, RawRecording) else source.frames()
    camera = source.info.camera
    opening: list[Frame] = []
    for given in frames:  # as far as the neutral pose may reach, and one more
        opening.append(frame := given.decode(None))
        if frame.timestamp_s - opening[0].timestamp_s > settings.calibration.still_s:
            break
    if not opening:
        raise RecordingEmpty(source.info.name)
    outcome = calibrate_hand(clicks, opening, camera, settings.calibration, settings.detection, start_angles_rad)
    if on_verdict is not None and not outcome.verdict.is_good:
        on_verdict(outcome.verdict)  # also before a fault: it may say why a click has no depth
    calibration = settings.adapt_calibration(require_calibration(outcome), camera)
    ends_s = opening[outcome.capture_frames - 1].timestamp_s
    noise = noise_from_neutral(outcome.noise, ends_s, settings.tracker)
    tracker, smooth = settings.build_tracker(calibration, camera, noise)
    detector = Detector(outcome.appearance, camera, settings.detection)
    pipeline = FramePipeline(detector, tracker)
    ordered = restart_at_neutral(chain(opening, frames), tracker, ends_s, lambda frame: frame.timestamp_s)
    return TrackingStart(opening[0], ordered, pipeline, smooth, calibration, noise)


def track_recording(
    source: FrameSource,
    clicks: Clicks,
    output: Path,
    settings: TrackSettings,
    *,
    subject_id: str = "",
    exercise: str = "",
    start_angles_rad: FloatArray | None = None,
    progress: Progress | None = None,
    on_verdict: Callable[[Verdict], None] | None = None,
    origin: str = "",
    set_up: Mapping[str, Any] | None = None,
    recorded: RecordingDate | None = None,
    path: Path | None = None,
    on_date: Callable[[RecordingDate | None], None] | None = None,
    listener: Listener | None = None,
    notes: Iterable[Event] = (),
) -> TrackReport:
    """Track a recording from its first frame to its last into ``output``; smooth it if wanted.

    A poor verdict is passed to ``on_verdict`` and tracking goes on; a click with no blob or no depth raises. After a
    fault there is no output.

    Parameters
    ----------
    source : FrameSource
        The recording.
    clicks : Clicks
        Markers in the first frame.
    output : Path
        New session file.
    settings : TrackSettings
        Settings of detection, calibration and tracking.
    subject_id, exercise, origin, set_up
        Entries of the session's header and parameters.
    start_angles_rad : ndarray, shape (3,), optional
        Wrist angles of the neutral pose.
    progress : callable, optional
        Receives the frames done and in all.
    on_verdict : callable, optional
        Receives a poor calibration verdict.
    recorded : RecordingDate, optional
        Date of the recording if known; else that of the recording or, last, of ``path``.
    path : Path, optional
        File or folder of the recording.
    on_date : callable, optional
        Receives the date that is used.
    listener : Listener, optional
        Receives every tracked frame.
    notes : iterable of Event
        Events of an earlier result that the session takes over.
    """
    if output.exists():
        raise OutputExists(output)
    start = start_tracking(source, clicks, settings, start_angles_rad, on_verdict)
    if recorded is None:
        recorded = find_recording_date(source.info, start.first_frame.timestamp_s, path)
    if on_date is not None:
        on_date(recorded)
    facts = describe_source(source.info) | ({"recorded_by": recorded.source} if recorded else {})
    if path is not None:
        with suppress(OSError):  # a missing image is reported when it is read
            facts["sha256"] = sha256_of_recording(path)
    header = new_header(
        hand=clicks.side,
        protocol=clicks.protocol,
        subject_id=subject_id,
        exercise=exercise,
        parameters=format_parameters(settings, facts, start.noise, set_up),
        origin=origin,
        dip_free=settings.dip_free,
        recorded=recorded.time if recorded else "",
        recording_id=compute_recording_id(source.info, start.first_frame),
    )
    writer = SessionWriter.create(output, header, source.info.camera, start.calibration)

    def track_frames() -> Iterator[TrackedFrame]:
        for frame in start.frames:
            tracked = start.pipeline(frame)
            if listener is not None:
                listener.on_frame(tracked)
            yield tracked

    count, verdict = source.info.frame_count, start.calibration.verdict
    return write_tracked(writer, track_frames(), start.smooth, verdict, count, progress, notes)


def retrack_session(
    origin: Path,
    output: Path,
    settings: TrackSettings,
    *,
    progress: Progress | None = None,
    on_verdict: Callable[[Verdict], None] | None = None,
) -> TrackReport:
    """Track a session again, from its stored images if there are any, else from its detections.

    From detections the session's calibration and neutral noise are used again, so that equal settings give equal
    angles. Notes are taken over. The old file is not changed; the new one names it as its origin.
    """
    if output.exists():
        raise OutputExists(output)
    session = read_session(origin)
    old = session.header
    if has_raw(origin):
        return track_recording(
            SessionFrames(session),
            session.calibration.clicks,
            output,
            settings,
            subject_id=old.subject_id,
            exercise=old.exercise,
            start_angles_rad=session.calibration.start_angles_rad,
            progress=progress,
            on_verdict=on_verdict,
            origin=old.session_id,
            set_up=old.set_up,
            recorded=RecordingDate(old.recorded, "recording"),
            path=origin,
            notes=session_notes(session),
        )
    table = read_detections(origin)
    noise = session_noise(session, settings)
    check_calibration(origin, session.calibration)
    calibration = settings.adapt_stored_calibration(session)
    tracker, smooth = settings.build_tracker(calibration, session.camera, noise)
    tracked = retrack_frames(session, tracker, noise, table.get_frame)
    facts = {"sha256": sha256_of_file(origin)}
    writer = create_retrack_writer(session, output, settings, noise, calibration, facts)
    return write_tracked(writer, tracked, smooth, calibration.verdict, len(session), progress, session_notes(session))


def retrack_frames(
    session: Session, tracker: HandTracker, noise: NeutralNoise, detections_of: Callable[[int], Detections]
) -> Iterator[TrackedFrame]:
    """Track the stored detections of each row of a session."""
    times_s = session.timestamp_s.tolist()
    for row in restart_at_neutral(range(len(session)), tracker, noise.neutral_ends_s, times_s.__getitem__):
        blobs = detections_of(row)
        yield tracker.step(row, times_s[row], blobs, max(int(session.quality.dropped_before[row]), 0))


def session_noise(session: Session, settings: TrackSettings) -> NeutralNoise:
    """Return the neutral noise of a session, or that of the settings."""
    return noise_from_json(session.header.parameters) or noise_from_neutral(
        MeasurementNoise(), -np.inf, settings.tracker
    )


def create_retrack_writer(
    session: Session,
    output: Path,
    settings: TrackSettings,
    noise: NeutralNoise,
    calibration: Calibration,
    facts: Mapping[str, str],
) -> SessionWriter:
    """Create the file of another result of a session's recording, made from its detections."""
    old = session.header
    source = {"session": old.session_id, "from": "detections", **facts}
    source |= {SIMULATED: "yes"} if old.is_simulated else {}
    header = new_header(
        hand=old.hand,
        protocol=old.protocol,
        subject_id=old.subject_id,
        exercise=old.exercise,
        parameters=format_parameters(settings, source, noise, old.set_up),
        origin=old.session_id,
        dip_free=settings.dip_free,
        recorded=old.recorded,
        recording_id=old.recording_id,
    )
    return SessionWriter.create(output, header, session.camera, calibration)


def write_tracked(
    writer: SessionWriter,
    frames: Iterator[TrackedFrame],
    smooth: SmoothFunction | None,
    verdict: Verdict,
    total: int | None,
    progress: Progress | None,
    notes: Iterable[Event],
) -> TrackReport:
    """Store tracked frames, notes, the smoother's result if wanted, and the repetitions.

    After a fault there is no output.
    """
    counts = dict.fromkeys(TrackStatus, 0)
    done = 0
    with writer:
        for frame in frames:
            writer.append(frame)
            counts[frame.status] += 1
            done += 1
            if progress is not None:
                progress(done, total)
        for note in notes:
            writer.add_event(note.time_s, note.kind, note.text)
        if smooth is not None and done:  # of no frame there is nothing to look back at
            writer.write_motion(stack_states(smooth()))
        if done:
            from carpus.core.results.repetition_rows import compute_repetitions  # keeps the start fast

            writer.write_repetitions(compute_repetitions(writer.read_session()))
    return TrackReport(
        writer.path,
        done,
        counts[TrackStatus.TRACKED],
        counts[TrackStatus.PREDICTED],
        counts[TrackStatus.LOST],
        counts[TrackStatus.DOUBTFUL],
        verdict,
    )

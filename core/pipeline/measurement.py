"""Measurement of a patient: tracking started from a calibration, recorded, smoothed and stored."""

from __future__ import annotations

import logging
import shutil
import threading
import uuid
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import cv2
import numpy as np

from carpus.core.calibration.calibrate import CalibrationOutcome
from carpus.core.calibration.result import Calibration
from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.source import SourceInfo, compute_recording_id, find_recording_date, is_simulated
from carpus.core.model import errors
from carpus.core.model.camera import Camera
from carpus.core.model.dates import to_iso
from carpus.core.model.errors import CarpusFault
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.hand.forearm_rotation import from_clinical_targets_deg
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import ByteImage, FloatArray, Frame, Region, TrackedFrame, TrackStatus
from carpus.core.pipeline.live import Listener, LiveSession
from carpus.core.pipeline.smoothing import SmoothingProcess, TrackedHand
from carpus.core.pipeline.track import (
    SMOOTHING_FAILED,
    FramePipeline,
    NeutralNoise,
    TrackSettings,
    build_pipeline,
    describe_source,
    format_parameters,
    noise_from_neutral,
)
from carpus.core.records.new_sessions import SessionIntake
from carpus.core.records.recordings import SessionDraft
from carpus.core.records.session_setup import MARKERS_SUFFIX, SessionSetup
from carpus.core.session.file_layout import ROWS_AT_ONCE
from carpus.core.session.journal import SUFFIX as JOURNAL_SUFFIX
from carpus.core.session.journal import RecordingJournal
from carpus.core.session.reader import READING_PROCESS
from carpus.core.session.values import Motion, new_header
from carpus.core.tracking.tracker import FilterSteps, Tracker

log = logging.getLogger(__name__)

_MARGIN_SHARE = 0.6
"""Margin of the marker image as a share of the markers' box."""
MIN_FREE_BYTES = 100_000_000
"""Free space needed to start: five minutes of a whole hand's rows, or ten seconds of images."""


_CROP_MARGIN_SHARE = {False: 1.5, True: 0.6}
"""Margin around the markers as a share of their box: for the palm alone up to the fingertips and beyond, for the whole
hand about a hand's breadth.
"""
_MIN_CROP_MARGIN_PX = 48.0
_STALE_S = 0.5
"""A hand seen longer ago may have left the region."""
_MAX_REGIONS = 2048
"""More than a minute of regions: longer than a frame waits for a slow disk."""


class HandRegions:
    """Image regions of the hand over time, for raw recordings of the hand and its surroundings alone.

    Updated by the tracking thread, read by the writing thread.
    """

    def __init__(self, camera: Camera, protocol: MarkerProtocol) -> None:
        self._camera, self._protocol = camera, protocol
        self._regions: deque[tuple[float, Region | None]] = deque(maxlen=_MAX_REGIONS)

    def update(self, tracked: TrackedFrame) -> None:
        self._regions.append((tracked.timestamp_s, compute_hand_region(tracked, self._camera, self._protocol)))

    def find_region(self, time_s: float) -> Region | None:
        """Return the region of the hand at a time; None if the hand is lost or was not tracked recently."""
        for known_s, area in reversed(self._regions.copy()):
            if known_s <= time_s:
                return area if time_s - known_s <= _STALE_S else None
        return None

    def crop(self, frame: Frame) -> Frame:
        """Return a frame without what lies outside the region of the hand at its time."""
        return mask_outside(frame, self.find_region(frame.timestamp_s))


def compute_hand_region(tracked: TrackedFrame, camera: Camera, protocol: MarkerProtocol) -> Region | None:
    """Return the image region of the hand and its surroundings; None if the hand is lost."""
    places = tracked.marker_position_cam_m
    known_m = places[np.isfinite(places).all(axis=1)]
    if tracked.status is TrackStatus.LOST or len(known_m) < len(protocol.palm) or (known_m[:, 2] < 0.1).any():
        return None
    pixel = camera.distort(camera.project(known_m))
    seen = tracked.marker_measured_px[np.isfinite(tracked.marker_measured_px).all(axis=1)]
    pixel = np.concatenate((pixel, seen))
    low, high = pixel.min(axis=0), pixel.max(axis=0)
    reach = max(_CROP_MARGIN_SHARE[protocol.has_fingers] * float((high - low).max()), _MIN_CROP_MARGIN_PX)
    left, top = np.clip(low - reach, 0.0, [camera.width_px, camera.height_px]).astype(int).tolist()
    right, bottom = np.clip(np.ceil(high + reach), 0.0, [camera.width_px, camera.height_px]).astype(int).tolist()
    return Region(left, top, right, bottom) if right - left > 1 and bottom - top > 1 else None


def mask_outside(frame: Frame, region: Region | None) -> Frame:
    """Return the frame with black colours and no depth outside the region."""
    if region is None:
        return frame
    part = np.s_[region.top : region.bottom, region.left : region.right]
    color = np.zeros_like(frame.color_rgb)
    color[part] = frame.color_rgb[part]
    depth = None
    if frame.depth_raw is not None:
        depth = np.zeros_like(frame.depth_raw)
        depth[part] = frame.depth_raw[part]
    return replace(frame, color_rgb=color, depth_raw=depth)


class LivePipeline:
    """Tracker of the live session, started at the neutral pose; passes filter steps on to the smoother."""

    def __init__(self, pipeline: FramePipeline[Tracker], neutral_ends_s: float) -> None:
        self._pipeline = pipeline
        self._neutral_ends_s = neutral_ends_s
        self._has_started = False
        self.on_steps: Callable[[FilterSteps], None] | None = None
        """Called in the tracking thread with the filter steps of every frame; must not wait."""
        self.on_frame: Callable[[TrackedFrame], None] | None = None
        """Called in the tracking thread with every tracked frame; must not wait."""

    def __call__(self, frame: Frame) -> TrackedFrame:
        tracker = self._pipeline.tracker
        if not self._has_started and frame.timestamp_s > self._neutral_ends_s:
            # The still frames made the calibration; counted twice they would make it too sure of itself.
            tracker.begin_at_neutral()
            self._has_started = True
        tracked = self._pipeline(frame)
        if self.on_frame is not None:
            self.on_frame(tracked)
        steps, on_steps = tracker.pop_steps(), self.on_steps
        if on_steps is not None:
            on_steps(steps)
        return tracked


class RecordedSession:
    """Session being recorded: its journal, the smoothing in progress, and at the end its file."""

    def __init__(self, journal: RecordingJournal, smoothing: SmoothingProcess | None) -> None:
        self._journal, self._smoothing = journal, smoothing
        self._draft: SessionDraft | None = None
        self._draft_rows = 0.0
        self._times_s: list[float] = []
        self._early_events: list[tuple[str, str]] = []
        self.path = journal.path.with_suffix(".h5")

    def append(self, tracked: TrackedFrame) -> None:
        self._times_s.append(tracked.timestamp_s)
        self._journal.append(tracked)
        if self._smoothing is not None and self._smoothing.has_results:
            self._add_smoothed(self._smoothing.pop_smoothed(self._pending_times_s()))
        for kind, text in self._early_events:
            self._journal.add_event(tracked.timestamp_s, kind, text)
        self._early_events.clear()
        if len(self._times_s) - self._draft_rows >= ROWS_AT_ONCE:
            self._draft_rows = len(self._times_s)
            try:
                self._update_draft()
            except CarpusFault:  # retried at the end: the rows are in the journal
                self._draft_rows = np.inf  # all over again it would hold up the journal

    def add_event(self, time_s: float, kind: str, text: str) -> None:
        """Add an event; before the first frame it waits for the first row, since there is no time yet."""
        if np.isfinite(time_s):
            self._journal.add_event(time_s, kind, text)
        else:
            self._early_events.append((kind, text))

    def prepare(self) -> None:
        """Write all rows into the session file while the rest is smoothed; no more rows come."""
        self._journal.flush()
        with suppress(CarpusFault):
            self._update_draft(is_final=True)

    def _update_draft(self, *, is_final: bool = False) -> None:
        """Write the journal's rows into the session file, so that little is left to do at the end."""
        draft, self._draft = self._draft or SessionDraft(self._journal.path), None
        try:
            draft.read()
            if is_final:
                draft.flush()
            self._draft = draft
        finally:
            if self._draft is None:
                draft.discard()

    def close(self) -> None:
        """Finish the session file and remove the journal; a session without frames is discarded."""
        if not self._times_s:
            self.discard()
            raise errors.RecordingEmpty(self.path.name)
        if self._smoothing is not None:
            try:
                self._add_smoothed(self._smoothing.finish(self._pending_times_s()))
            except errors.SmoothingFailed as fault:
                log.warning("%s", format_fault_line(errors.SmoothingFailed(self.path, fault.detail)))
                self._journal.add_event(self._times_s[-1], SMOOTHING_FAILED, fault.detail)
        self._journal.flush()
        draft = self._draft or SessionDraft(self._journal.path)
        try:
            draft.read()
            if draft.frame_count != len(self._times_s):  # else the journal would go with what is only in it
                raise errors.OutputNotWritable(self.path.parent, phrase("the saved data differ from the recorded data"))
            self.path = draft.finish() or self.path
        finally:
            draft.discard()
        self._journal.discard()

    def _add_smoothed(self, motion: Motion | None) -> None:
        if motion is not None:
            self._journal.add_smoothed(motion)

    def _pending_times_s(self) -> list[float]:
        """Return the times of the frames that are not smoothed yet."""
        return self._times_s[self._journal.smoother_row_count :]

    def abandon(self) -> None:
        self._cancel()
        self._journal.abandon()

    def discard(self) -> None:
        self._cancel()
        self._journal.discard()

    def _cancel(self) -> None:
        if self._smoothing is not None:
            self._smoothing.cancel()
        if self._draft is not None:
            self._draft.discard()


class MeasurementController:
    """Controller of a running source: from calibration to stored sessions, as many as wanted.

    Parameters
    ----------
    recording : Path, optional
        Stored recording to play, None for a camera. It plays from its first frame when recording starts.
    on_tracking_started, on_recording_started : callable
        Called when tracking or a recording has started.
    on_exercise_changed : callable
        Called when the same hand does another exercise.
    listener : callable
        Returns a listener of tracked frames for a calibration, or None.
    """

    def __init__(
        self,
        session: LiveSession,
        info: SourceInfo,
        set_up: SessionSetup,
        settings: TrackSettings,
        new_sessions: SessionIntake,
        *,
        recording: Path | None = None,
        on_tracking_started: Callable[[], None] = lambda: None,
        on_recording_started: Callable[[], None] = lambda: None,
        on_exercise_changed: Callable[[SessionSetup], None] = lambda _: None,
        listener: Callable[[Calibration], Listener | None] = lambda _: None,
    ) -> None:
        self._listener = listener
        self.feed, self._info, self._set_up, self._settings = session, info, set_up, settings
        self._new_sessions, self._recording, self.is_playback = new_sessions, recording, recording is not None
        self._on_tracking_started, self._on_recording_started, self._on_exercise_changed = (
            on_tracking_started,
            on_recording_started,
            on_exercise_changed,
        )
        self._played = False
        self._identity: tuple[str, str] | None = None
        self._pipeline: LivePipeline | None = None
        self._noise: NeutralNoise | None = None
        self.calibration: Calibration | None = None
        self._marker_image_rgb: ByteImage | None = None

    @property
    def camera(self) -> Camera:
        return self._info.camera

    @property
    def is_simulated(self) -> bool:
        """Whether the hand is simulated."""
        return is_simulated(self._info)

    def start_tracking(self, outcome: CalibrationOutcome, frames: Sequence[Frame]) -> None:
        """Track from a calibration and the frames that it was made from, the clicked one first."""
        if self._recording is not None:
            recorded = find_recording_date(self._info, frames[0].timestamp_s, self._recording)
            self._identity = recorded.time if recorded else "", compute_recording_id(self._info, frames[0])
        used = frames[: max(outcome.capture_frames, 1)]
        neutral_ends_s = max(frame.timestamp_s for frame in used)
        self._noise = noise_from_neutral(outcome.noise, neutral_ends_s, self._settings.tracker)
        pipeline = build_pipeline(outcome, self.camera, self._settings, self._noise, keep_history=self._settings.smooth)
        self._pipeline = LivePipeline(pipeline, neutral_ends_s)
        self.calibration = outcome.calibration
        self._marker_image_rgb = _crop_markers(frames[0].color_rgb, outcome.pixel)
        try:
            self.feed.set_listener(self._listener(self.calibration) if self.calibration is not None else None)
        except errors.ExtraMissing as fault:
            self.feed.handle_notice(fault)
        self.feed.start_tracking(self._pipeline)
        self._on_tracking_started()

    def set_exercise(self, set_up: SessionSetup) -> None:
        """Set the next exercise of the same hand with the same markers; not while a recording runs."""
        assert not self.feed.is_recording
        assert set_up.protocol == self._set_up.protocol
        self._set_up = set_up
        self._on_exercise_changed(set_up)

    def start_recording(self) -> None:
        """Open the session file, and a raw recording beside it if wanted; waits for the disk."""
        calibration, pipeline, noise = self.calibration, self._pipeline, self._noise
        assert calibration is not None
        assert pipeline is not None
        assert noise is not None
        path = self._new_sessions.new_path(self._set_up)
        free = shutil.disk_usage(path.parent).free
        if free < MIN_FREE_BYTES:
            free_mb, least_mb = format_rounded(free / 1e6), format_rounded(MIN_FREE_BYTES / 1e6)
            reason = phrase("{free} MB free, {least_free_bytes} MB are needed", free=free_mb, least_free_bytes=least_mb)
            raise errors.DiskFull(path.parent, reason)
        now = datetime.now().astimezone()
        recorded, identity = self._identity or (to_iso(now), str(uuid.uuid4()))
        header = new_header(
            hand=calibration.clicks.side,
            protocol=calibration.clicks.protocol,
            subject_id=self._set_up.subject_id,
            exercise=self._set_up.exercise.id,
            parameters=self._format_parameters(noise),
            dip_free=self._settings.tracker.dip == "free",
            now=now,
            recorded=recorded,
            recording_id=identity,
        )
        info = replace(self._info, recorded=recorded, recording_id=identity)
        smoothing, finish_smoothing = None, lambda: None
        if self._settings.smooth:
            smoothing = SmoothingProcess(
                TrackedHand(calibration, self.camera, noise.adapt_settings(self._settings.tracker))
            )
            pipeline.on_steps, wait_for_smoothing = smoothing.add_steps, smoothing.join

            def finish_smoothing() -> None:
                pipeline.on_steps = None  # the hand is followed meanwhile: what comes now is not of the recording
                wait_for_smoothing()

        journal_path, patient_id = path.with_suffix(JOURNAL_SUFFIX), self._set_up.patient_id
        try:
            self.feed.start_recording(
                lambda: RecordedSession(
                    RecordingJournal(journal_path, header, self.camera, calibration, patient_id), smoothing
                ),
                self._frame_writer_opener(path.with_suffix(RAW_SUFFIX), info) if self._set_up.stores_frames else None,
                finish_smoothing,
            )
        except BaseException:
            pipeline.on_steps = None
            if smoothing is not None:
                smoothing.cancel()
            raise
        # Asked for the outline when the recording ends, for which a person waits.
        threading.Thread(target=READING_PROCESS.start, name="reading", daemon=True).start()
        if self.is_playback and not self._played:
            self._played = True
            self.feed.start()
        self._on_recording_started()

    def _frame_writer_opener(self, path: Path, info: SourceInfo) -> Callable[[], RawWriter]:
        """Return a function that opens a raw recording of the hand and its surroundings."""
        assert self._pipeline is not None
        hand = HandRegions(self.camera, self._set_up.protocol)
        self._pipeline.on_frame = hand.update
        return lambda: RawWriter(path, info, crop=hand.crop)

    def _format_parameters(self, noise: NeutralNoise) -> str:
        """Return all settings as JSON, with the targets of the exercise."""
        read = self._set_up.target_positive_deg, self._set_up.target_negative_deg
        aims = from_clinical_targets_deg(read, self._set_up.exercise)
        set_up = {
            "repetitions": self._set_up.repetitions,
            "targets_deg": [aim if np.isfinite(aim) else None for aim in aims],
        }
        course = self._set_up.set_run
        if course is not None:
            set_up["set"] = {
                "run": course.run_id,
                "part": course.part_index + 1,
                "of": len(course.parts),
                "seconds": course.part.seconds,
            }
        return format_parameters(self._settings, describe_source(self._info), noise, set_up)

    def stop_recording(self) -> str:
        """Store everything and return the session id; a fault is raised after stored data are finished."""
        try:
            path = self.feed.stop_recording()
        except errors.RecordingEmpty:
            raise
        except Exception:
            self._new_sessions.recover_interrupted()
            raise
        finally:
            if self._pipeline is not None:
                self._pipeline.on_steps = self._pipeline.on_frame = None
        if self._marker_image_rgb is not None:
            bgr = cv2.cvtColor(self._marker_image_rgb, cv2.COLOR_RGB2BGR)
            is_encoded, data = cv2.imencode(".jpg", bgr)
            image_path = path.with_suffix(MARKERS_SUFFIX)
            with suppress(OSError):  # the session is complete without this image
                if is_encoded:
                    image_path.touch(mode=0o600)
                    image_path.write_bytes(data.tobytes())
        return self._new_sessions.register(self._set_up, path)

    def close(self) -> None:
        """Close the source; a running recording is finished."""
        self.feed.stop()
        self.feed.set_listener(None)


def _crop_markers(color_rgb: ByteImage, pixel: FloatArray) -> ByteImage | None:
    """Return the image around the markers for the patient card, without the room."""
    known_px = pixel[np.isfinite(pixel).all(axis=1)]
    if not len(known_px):
        return None
    low, high = known_px.min(axis=0), known_px.max(axis=0)
    margin = _MARGIN_SHARE * float((high - low).max())
    left, top = (int(max(0.0, value - margin)) for value in low)
    right, bottom = (int(value + margin) + 1 for value in high)
    return np.ascontiguousarray(color_rgb[top:bottom, left:right])

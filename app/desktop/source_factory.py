"""Opens the chosen source: live camera, stored recording, or the practice patient."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

from carpus.app.desktop.maintenance_cameras import open_chosen_camera
from carpus.app.desktop.practice import PracticeRenderer, practice_play_count
from carpus.app.settings import Settings
from carpus.app.sources import open_recording
from carpus.core.calibration.hand_calibrator import CalibrationFrames, HandCalibrator
from carpus.core.calibration.result import Calibration
from carpus.core.capture.playback_sources import PacedSource, PracticeSource
from carpus.core.capture.source import FrameSource, is_simulated
from carpus.core.model.errors import CarpusFault, RecordingEmpty, RegistrationAssumed
from carpus.core.model.types import Frame
from carpus.core.pipeline.live import Listener, LiveSession
from carpus.core.pipeline.measurement import MeasurementController
from carpus.core.pipeline.track import TrackSettings
from carpus.core.records.new_sessions import SessionIntake
from carpus.core.records.recordings import spool_folder
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.shell.current_selection import OpenSource, SourceChoice
from carpus.ui.shell.source_opener import Progress

RECENT_FRAMES = 16
"""Half a second: the neutral pose is averaged over at most these frames."""


class SourceFactory:
    """Opens all kinds of sources; ``speed`` above 1 plays stored recordings faster."""

    def __init__(
        self,
        settings: Settings,
        new_sessions: SessionIntake,
        render_practice: Callable[[SessionSetup, Progress], tuple[FrameSource, float]],
        speed: float = 1.0,
        render_practice_start: Callable[[SessionSetup], tuple[FrameSource, float] | None] = lambda _: None,
    ) -> None:
        self._settings, self._new_sessions, self._speed = settings, new_sessions, speed
        self._render_practice, self._render_practice_start = render_practice, render_practice_start
        self.is_streaming: Callable[[], bool] = lambda: settings.stream.on
        """Returns whether live values are sent to other programs; asked when tracking starts."""

    def open(self, choice: SourceChoice, set_up: SessionSetup, progress: Progress) -> OpenSource:
        """Open the chosen source; waits for camera, disk or renderer, so it runs in the background."""
        # The first calibration and the first repetition need them: half a second each in which nothing would answer.
        import_module("scipy.optimize")
        import_module("scipy.signal")
        if choice.kind == "file":
            faults: list[CarpusFault] = []
            source = open_recording(
                Path(choice.path),
                registered=choice.is_depth_registered,
                leave_out_damaged=True,
                data_folder=self._settings.data_folder,
                notice=faults.append,
            )
            # read the first frames of a recording, for the neutral pose. Raises :class:`RecordingEmpty`
            still_s = self._settings.track.calibration.still_s
            opening: list[Frame] = []
            for frame in source.frames():
                if opening and frame.timestamp_s - opening[0].timestamp_s > still_s:
                    break
                opening.append(frame)
            if not opening:
                raise RecordingEmpty(source.info.name)
            session = self._create_session(PacedSource(source, self._speed), source_waits=True)
            asks = any(isinstance(fault, RegistrationAssumed) for fault in faults)
            for fault in () if asks else faults:
                session.handle_notice(fault)
            pictures = CalibrationFrames(False, lambda: opening[0], lambda: opening)  # clicks are on the very first
            return self._build_open_source(session, source, set_up, pictures, asks, recording=Path(choice.path))
        return self._open_camera(set_up) if choice.kind == "camera" else self._open_practice(set_up, progress)

    def _open_camera(self, set_up: SessionSetup) -> OpenSource:
        faults: list[CarpusFault] = []
        handlers: list[Callable[[CarpusFault], None]] = [faults.append]
        camera, source = open_chosen_camera(self._settings, lambda fault: handlers[-1](fault))
        session = self._create_session(source)
        handlers.append(session.handle_notice)
        for fault in faults:
            session.handle_notice(fault)
        session.start()
        frames = _live_frames(session)
        # From the calibration on, the markers must keep their colours.
        return self._build_open_source(session, source, set_up, frames, on_tracking_started=camera.lock_exposure)

    def _open_practice(self, set_up: SessionSetup, progress: Progress) -> OpenSource:
        """Open the still hand at once; the movements are rendered meanwhile."""
        course = set_up.set_run
        parts = [] if course is None else [part.exercise for part in course.parts]
        set_ups = {one.id: replace(set_up, exercise=one) for one in (set_up.exercise, *parts)}
        begun = self._render_practice_start(set_up)
        take, still_s = begun or self._render_practice(set_up, progress)
        patient = PracticeSource(
            take, still_s, is_still_only=begun is not None, movement_count=practice_play_count(set_up)
        )
        session = self._create_session(PacedSource(patient, self._speed))
        drawn = {} if begun else {set_up.exercise.id: take}
        drawing = PracticeRenderer(patient, self._render_practice, set_ups, drawn, progress, session.handle_notice)
        drawing.start()
        session.start()

        opened = self._build_open_source(
            session,
            take,
            set_up,
            _live_frames(session),
            on_recording_started=patient.start_movement,
            on_exercise_changed=lambda chosen: drawing.choose(chosen.exercise.id),
        )
        return replace(opened, is_hand_resting=lambda: not patient.can_move)

    def _track_settings(self, set_up: SessionSetup) -> TrackSettings:
        """Return the tracking settings with the set-up's choice for the DIP joints."""
        track = self._settings.track
        return replace(track, tracker=replace(track.tracker, dip="free")) if set_up.is_dip_free else track

    def _create_session(self, source: FrameSource, *, source_waits: bool = False) -> LiveSession:
        place = spool_folder(self._settings.data_folder)  # made with the first recording
        there = next((one for one in (place, *place.parents) if one.is_dir()), None)
        settings = replace(self._settings.live, folder=there)
        return LiveSession(source, settings, is_file=source_waits)

    def _build_open_source(
        self,
        session: LiveSession,
        source: FrameSource,
        set_up: SessionSetup,
        pictures: CalibrationFrames,
        asks: bool = False,
        **options: Any,
    ) -> OpenSource:
        """Build the open source; other arguments go to :class:`MeasurementController`."""
        track = self._track_settings(set_up)

        def listener(calibration: Calibration) -> Listener | None:
            if not self.is_streaming():
                return None
            from carpus.core.pipeline.lsl_stream import SampleStream

            rate_hz, dip_free = session.info.nominal_fps, self._track_settings(set_up).tracker.dip == "free"
            return SampleStream(calibration.clicks, rate_hz, dip_free=dip_free)

        measuring = MeasurementController(
            session, source.info, set_up, track, self._new_sessions,
            listener=listener, **options,
        )  # fmt: skip
        calibrator = HandCalibrator(
            pictures,
            source.info.camera,
            set_up.side,
            set_up.protocol,
            track.detection,
            track.calibration,
            measuring.start_tracking,
            self._new_sessions.last_hand_length_mm(set_up, simulated=is_simulated(source.info)),
            self._new_sessions.last_straight_fingers(set_up),
        )
        return OpenSource(calibrator, measuring, asks)


def _live_frames(session: LiveSession) -> CalibrationFrames:
    """Return the frames of a live session, newest first: the hand was still up to now."""
    return CalibrationFrames(True, session.current_frame, lambda: session.recent_frames(RECENT_FRAMES)[::-1])

"""Opens the source that was chosen: live camera, stored recording, or the practice patient, whose still hand takes a
second to draw and whose movement is drawn while a person looks and clicks; and the clicks on its picture to a
calibration."""

from __future__ import annotations

import contextlib
import math
import os
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from carpus import __version__
from carpus.app.settings import Settings
from carpus.app.sources import open_recording
from carpus.core.calibration.calibrate import CalibrationOutcome, calibrate, compared_with_last_time
from carpus.core.calibration.candidates import disc_at, marker_candidates, snapped
from carpus.core.calibration.naming import propose_names
from carpus.core.calibration.result import ALL_STRAIGHT, Calibration, Clicks
from carpus.core.camera import Camera
from carpus.core.capture.calibrated import with_given_name, with_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.capture.devices.cameras import open_camera
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.paced import PacedSource, PracticeSource
from carpus.core.capture.source import FrameSource, is_simulated
from carpus.core.detection.appearance import expected_radius_px
from carpus.core.errors import CarpusFault, RecordingEmpty, RegistrationAssumed
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.pipeline.live import Listener, LiveSession
from carpus.core.pipeline.measuring import SourceMeasuring
from carpus.core.pipeline.track import TrackSettings
from carpus.core.records.new_sessions import NewSessions
from carpus.core.records.set_up import PRACTICE_REPETITIONS, SetUp
from carpus.core.simulation.hand_motion import STILL_S
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.types import Detections, FloatArray, Frame, Side
from carpus.ui.now_open import OpenSource, SourceChoice
from carpus.ui.opening import NobodyWaitsError, Progress
from carpus.ui.ports import FoundMarker, Judged, ProposedMarker, VerdictLimits

_SPEED_HZ, _RANGE_SHARE, _SECONDS = 0.4, 0.8, 9.0
_OTHERWISE: dict[str, dict[str, Any]] = {
    "opposition": {"seconds": 11.5, "repetitions": 4, "range_share": 1.0},
    "reach_grasp": {"speed_hz": 0.3, "repetitions": 2, "range_share": 0.6},
}
"""A touch of each finger, which falls short of none; reaches that so few pictures can follow."""
_FPS = 15.0
"""Few pictures: they are drawn before the first report can be made. A real camera has 30 a second."""
_TILT_DEG, _HAND_TILT_DEG = 4.0, {"right": 11.0, "left": 8.0}
"""The thumb's discs face sideways: for them the thumb side is turned up, as far as the verdict allows."""
_READ_AHEAD = 8


def practice_spec(set_up: SetUp) -> RecordingSpec:
    """A short take: three repetitions, now and then a hidden marker, a false blue spot."""
    exercise = set_up.exercise
    usual = RecordingSpec(
        seed=5,
        hand=set_up.side,
        protocol=set_up.protocol.name,
        motion=exercise.motion,
        seconds=_SECONDS,
        fps=_FPS,
        speed_hz=_SPEED_HZ,
        repetitions=PRACTICE_REPETITIONS,
        range_share=_RANGE_SHARE,
        hand_length_mm=188.0,
        skin_tone=1,
        light="bright",
        sleeve="grey",
        distance_m=0.64,
        yaw_deg=3.0,
        tilt_deg=_HAND_TILT_DEG[set_up.side] if set_up.protocol.has_fingers else _TILT_DEG,
        hidden_share=0.02,
    )
    return replace(usual, **_OTHERWISE.get(exercise.motion, {}))


def practice_times(set_up: SetUp) -> int:
    """How often the take is played until the patient has done what is asked."""
    return max(1, math.ceil(set_up.repetitions / (practice_spec(set_up).repetitions or 1)))


def practice_take(set_up: SetUp, progress: Callable[[int, int], None]) -> tuple[FrameSource, float]:
    """The take as a source, and how long it is still at its start."""
    from carpus.core.simulation.recording import cached_recording

    folder = cached_recording(practice_spec(set_up), progress, workers=os.cpu_count() or 1)
    return TumFolder(folder, read_ahead=_READ_AHEAD), STILL_S - 1.0 / _FPS


def practice_beginning(set_up: SetUp) -> tuple[FrameSource, float] | None:
    """The same hand in the same place, as long as it is still; None where the whole take was drawn before."""
    from carpus.core.simulation.recording import FirstPictures, is_cached

    if is_cached(practice_spec(set_up)):
        return None
    return FirstPictures(practice_spec(set_up), STILL_S), STILL_S - 1.0 / _FPS


SAME_DISC_PX = 3.0
"""Nearer than this two places are the same disc."""

Begin = Callable[[CalibrationOutcome, Sequence[Frame]], None]
"""Called with the chosen outcome and the pictures it was made from, the clicked one first."""


@dataclass(frozen=True, slots=True)
class Pictures:
    """Where the calibration's pictures come from; ``still``: the picture to click on, then its neighbours in time."""

    is_live: bool
    newest: Callable[[], Frame | None]
    still: Callable[[], Sequence[Frame]]


class HandCalibrator:
    """One calibration, from the held picture to the start of tracking.

    ``last_length_mm`` of the same hand in an earlier session, NaN for none.
    """

    def __init__(
        self,
        pictures: Pictures,
        camera: Camera,
        side: Side,
        protocol: MarkerProtocol,
        settings: TrackSettings,
        begin: Begin,
        last_length_mm: float = float("nan"),
        last_straight_fingers: tuple[bool, ...] = ALL_STRAIGHT,
    ) -> None:
        self._last_straight_fingers = last_straight_fingers
        self._pictures, self._camera, self._settings, self._begin = pictures, camera, settings, begin
        self._side, self._protocol, self._last_length_mm = side, protocol, last_length_mm
        self._held: Sequence[Frame] = ()
        self._candidates = Detections.none()
        self._outcomes: list[tuple[CalibrationOutcome, Sequence[Frame]]] = []

    @property
    def side(self) -> Side:
        return self._side

    @property
    def protocol(self) -> MarkerProtocol:
        return self._protocol

    @property
    def limits(self) -> VerdictLimits:
        limits = self._settings.calibration
        return VerdictLimits(
            limits.least_distance_m, limits.most_tilt_deg, limits.most_residual_mm, limits.hand_length_mm
        )

    @property
    def last_straight_fingers(self) -> tuple[bool, ...]:
        """What was said of this hand last time, thumb to little."""
        return self._last_straight_fingers

    @property
    def is_live(self) -> bool:
        return self._pictures.is_live

    def newest_frame(self) -> Frame | None:
        return self._pictures.newest()

    def hold(self) -> Frame:
        """Fix the picture, and find all blue discs on it, so that clicks snap at once."""
        self._held = tuple(self._pictures.still())
        settings = self._settings
        self._candidates = marker_candidates(
            self._held[0], self._camera, settings.detection, settings.calibration.candidates
        )
        return self._held[0]

    def discs_seen(self) -> int:
        """How many spots of the held picture look like discs of paper."""
        return len(self._candidates)

    def discs_px(self) -> FloatArray:
        return self._candidates.pixel

    def hand_area(self) -> FloatArray | None:
        """Box of the blue discs: corners (2, 2); None when hardly any is seen."""
        if len(self._candidates) < len(self._protocol.palm):
            return None
        return np.stack((self._candidates.pixel.min(axis=0), self._candidates.pixel.max(axis=0)))

    def marker_at(self, pixel: FloatArray) -> FoundMarker | None:
        if not self._held:
            return None
        frame, detection = self._held[0], self._settings.detection
        radius_px = expected_radius_px(frame, pixel, self._camera, detection)
        found = snapped(self._candidates, pixel, radius_px, detection)
        if not len(found):
            found = disc_at(frame, pixel, self._camera, detection, self._settings.calibration.candidates)
        if not len(found):
            return None
        return FoundMarker(found.pixel[0], _width_px(found, 0))

    def propose(self, named: Mapping[str, FloatArray]) -> Mapping[str, ProposedMarker]:
        """Names for the discs found when the picture was held."""
        blobs, markers = self._candidates, self._protocol.markers
        known: dict[int, int] = {}
        for name, pixel in named.items():
            distance = np.linalg.norm(blobs.pixel - pixel, axis=1)
            if distance.size and distance.min() < SAME_DISC_PX:
                known[markers.index(name)] = int(distance.argmin())
        found = propose_names(blobs, self._camera, self._side, self._protocol, self._settings.calibration.naming, known)
        return {
            name: ProposedMarker(blobs.pixel[blob], _width_px(blobs, blob), bool(is_sure))
            for name, blob, is_sure in zip(markers, found.blob.tolist(), found.is_sure, strict=True)
            if blob >= 0 and name not in named
        }

    def judge(self, clicks: Clicks, start_angles_rad: FloatArray) -> Judged:
        """Measure and judge; called in the background."""
        held, settings = self._held, self._settings
        outcome = calibrate(clicks, held, self._camera, settings.calibration, settings.detection, start_angles_rad)
        outcome = compared_with_last_time(outcome, self._last_length_mm, self._settings.calibration)
        self._outcomes.append((outcome, held))
        return Judged(outcome.verdict, outcome.calibration)

    def begin(self, calibration: Calibration) -> None:
        """Start tracking from one of the calibrations judged here."""
        outcome, held = next(pair for pair in reversed(self._outcomes) if pair[0].calibration is calibration)
        self._begin(outcome, held)


def _width_px(blobs: Detections, number: int) -> float:
    """Width of a round disc of a blob's area."""
    return 2.0 * float(np.sqrt(blobs.area_px[number] / np.pi))


RECENT_FRAMES = 16
"""Half a second: what the neutral pose is averaged over at most."""


class Sources:
    """Knows all kinds of sources. ``speed`` above 1 plays what is stored faster than it was."""

    def __init__(
        self,
        settings: Settings,
        places: NewSessions,
        practice_take: Callable[[SetUp, Progress], tuple[FrameSource, float]],
        speed: float = 1.0,
        practice_beginning: Callable[[SetUp], tuple[FrameSource, float] | None] = lambda _: None,
    ) -> None:
        self._settings, self._places, self._practice_take, self._speed = settings, places, practice_take, speed
        self._practice_beginning = practice_beginning
        self.streams: Callable[[], bool] = lambda: settings.stream.on
        """Whether live values go out to other programs; asked whenever tracking begins."""

    def open(self, choice: SourceChoice, set_up: SetUp, progress: Progress) -> OpenSource:
        """Open the chosen source; waits for camera, disk or renderer, so it is called in the background."""
        # The first calibration and the first repetition need them: half a second each in which nothing would answer.
        import_module("scipy.optimize")
        import_module("scipy.signal")
        if choice.kind == "file":
            return self._recording(choice, set_up)
        return self._camera(set_up) if choice.kind == "camera" else self._practice(set_up, progress)

    def _camera(self, set_up: SetUp) -> OpenSource:
        told: list[CarpusFault] = []
        heard: list[Callable[[CarpusFault], None]] = [told.append]
        named = self._settings.camera.intrinsics
        camera = read_camera_info(Path(named).expanduser()).camera if named else None
        live = open_camera(self._settings.camera.uri, camera=camera, notice=lambda fault: heard[-1](fault))
        folder = self._settings.data_folder
        source = with_stored_calibration(with_given_name(live, folder), folder)
        session = self._session(source)
        heard.append(session.notice)
        for fault in told:
            session.notice(fault)
        session.start()
        # From the calibration on, the markers must keep their colours.
        return self._opened(session, source, set_up, _of_the_moment(session), on_begin=live.lock_exposure)

    def _practice(self, set_up: SetUp, progress: Progress) -> OpenSource:
        """The still hand at once; what it does in each exercise is drawn beside it, in the order of the course."""
        course = set_up.course
        parts = [] if course is None else [part.exercise for part in course.parts]
        set_ups = {one.id: replace(set_up, exercise=one) for one in (set_up.exercise, *parts)}
        begun = self._practice_beginning(set_up)
        take, still_s = begun or self._practice_take(set_up, progress)
        patient = PracticeSource(take, still_s, begins_only=begun is not None, times=practice_times(set_up))
        session = self._session(PacedSource(patient, self._speed))
        drawn = {} if begun else {set_up.exercise.id: take}
        drawing = TakesDrawn(patient, self._practice_take, set_ups, drawn, progress, session.notice)
        drawing.start()
        session.start()

        opened = self._opened(
            session,
            take,
            set_up,
            _of_the_moment(session),
            on_recording=patient.let_go,
            on_chosen=lambda chosen: drawing.choose(chosen.exercise.id),
        )
        return replace(opened, rests=lambda: not patient.can_move)

    def _recording(self, choice: SourceChoice, set_up: SetUp) -> OpenSource:
        told: list[CarpusFault] = []
        source = open_recording(
            Path(choice.path),
            registered=choice.registered,
            leave_out_damaged=True,
            data_folder=self._settings.data_folder,
            notice=told.append,
        )
        opening = opening_frames(source, self._settings.track.calibration.still_s)
        session = self._session(PacedSource(source, self._speed), source_waits=True)
        asks = any(isinstance(fault, RegistrationAssumed) for fault in told)
        for fault in () if asks else told:
            session.notice(fault)
        pictures = Pictures(False, lambda: opening[0], lambda: opening)  # clicks are on the very first
        return self._opened(session, source, set_up, pictures, asks, recording=Path(choice.path))

    def _track(self, set_up: SetUp) -> TrackSettings:
        """The settings with what this set-up says of the end joints."""
        track = self._settings.track
        return replace(track, tracker=replace(track.tracker, dip="free")) if set_up.ends_free else track

    def _listener(self, session: LiveSession, set_up: SetUp) -> Callable[[Calibration], Listener | None]:
        def listener(calibration: Calibration) -> Listener | None:
            if not self.streams():
                return None
            from carpus.core.pipeline.stream import SampleStream

            rate_hz, dip_free = session.info.nominal_fps, self._track(set_up).tracker.dip == "free"
            return SampleStream.of_hand(calibration.clicks, rate_hz, dip_free=dip_free)

        return listener

    def _session(self, source: FrameSource, *, source_waits: bool = False) -> LiveSession:
        settings = replace(self._settings.live, folder=self._settings.data_folder)
        return LiveSession(source, settings, source_waits=source_waits)

    def _opened(
        self,
        session: LiveSession,
        source: FrameSource,
        set_up: SetUp,
        pictures: Pictures,
        asks: bool = False,
        **told: Any,
    ) -> OpenSource:
        """What is opened, with what else :class:`SourceMeasuring` is ``told`` of it."""
        track = self._track(set_up)
        measuring = SourceMeasuring(
            session, source.info, set_up, track, self._places, software_version=__version__,
            listener=self._listener(session, set_up), **told,
        )  # fmt: skip
        calibrator = HandCalibrator(
            pictures,
            source.info.camera,
            set_up.side,
            set_up.protocol,
            track,
            measuring.begin,
            self._places.last_hand_length_mm(set_up, simulated=is_simulated(source.info)),
            self._places.last_straight_fingers(set_up),
        )
        return OpenSource(calibrator, measuring, asks)


def _of_the_moment(session: LiveSession) -> Pictures:
    """The newest picture, and those before it going back: the hand has been still up to now."""
    return Pictures(True, session.newest_frame, lambda: session.recent_frames(RECENT_FRAMES)[::-1])


class TakesDrawn:
    """Draws the practice patient's takes one after the other, in a thread of its own that ends with the patient."""

    def __init__(
        self,
        patient: PracticeSource,
        draw: Callable[[SetUp, Progress], tuple[FrameSource, float]],
        set_ups: Mapping[str, SetUp],
        drawn: Mapping[str, FrameSource],
        progress: Progress,
        tell: Callable[[Exception], None],
    ) -> None:
        self._patient, self._draw, self._set_ups = patient, draw, set_ups
        self._progress, self._tell = progress, tell
        self._drawn = dict(drawn)
        self._chosen = next(iter(set_ups))
        self._turn = threading.Lock()

    def start(self) -> None:
        """Begin with what is not there yet."""
        if len(self._drawn) < len(self._set_ups):
            # No daemon: one that still draws while the program ends would be cut off in the middle, which aborts it.
            threading.Thread(target=self._run, name="practice takes", daemon=False).start()

    def choose(self, exercise: str) -> None:
        """The exercise that the patient does next, as soon as it is drawn."""
        with self._turn:
            self._chosen = exercise
            self._patient.play_next(self._drawn.get(exercise))

    def _run(self) -> None:
        self._patient.shown.wait()  # the first picture before all others: drawing takes every core
        try:
            for name, set_up in self._set_ups.items():
                if name in self._drawn:
                    continue
                self._on_the_way(0, 1)
                take, _ = self._draw(set_up, self._on_the_way)
                with self._turn:
                    self._drawn[name] = take
                    if name == self._chosen:
                        self._patient.play_next(take)
        except NobodyWaitsError:
            return
        except CarpusFault as fault:
            self._tell(fault)

    def _on_the_way(self, done: int, total: int) -> None:
        if self._patient.is_closed:
            raise NobodyWaitsError
        self._progress(done, total)


def opening_frames(source: FrameSource, still_s: float) -> list[Frame]:
    """The first frames of a recording, as far as the neutral pose may reach. Raises :class:`RecordingEmpty`."""
    opening: list[Frame] = []
    with _closing(source.frames()) as frames:
        for frame in frames:
            if opening and frame.timestamp_s - opening[0].timestamp_s > still_s:
                break
            opening.append(frame)
    if not opening:
        raise RecordingEmpty(source.info.name)
    return opening


@contextlib.contextmanager
def _closing(frames: Iterator[Frame]) -> Iterator[Iterator[Frame]]:
    """A walk that gives its files back here, although it is not walked to its end."""
    try:
        yield frames
    finally:
        close = getattr(frames, "close", None)
        if close is not None:
            close()

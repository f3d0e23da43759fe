"""An open source with a patient before it: tracking begun from a calibration, recorded, smoothed and stored."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import fields
from pathlib import Path
from typing import Protocol

import cv2
import numpy as np

from app import __version__
from core.calibration.calibrate import CalibrationOutcome
from core.calibration.result import Calibration
from core.camera import Camera
from core.capture.raw import SUFFIX as RAW_SUFFIX
from core.capture.raw import RawWriter
from core.capture.source import SourceInfo
from core.errors import RecordingEmpty
from core.pipeline.frame_walk import FrameWalk
from core.pipeline.live import LiveSession
from core.pipeline.track import Learnt, TrackSettings, build_walk, learnt_from, parameters_json, source_facts
from core.session.values import Motion, motion_of, new_header
from core.session.writer import SessionWriter
from core.types import ByteImage, FloatArray, Frame, TrackedFrame
from ui.ports import SetUp

MARKERS_SUFFIX = ".markers.jpg"
_AROUND_HAND = 0.6
"""The picture of the markers reaches this share of their box beyond it."""


SMOOTHING_PIECE_S, SMOOTHING_LAG_S = 25.0, 5.0


class SessionPlaces(Protocol):
    """Where sessions go, and who hears of a finished one."""

    def new_path(self, set_up: SetUp) -> Path: ...

    def entered(self, set_up: SetUp, path: Path) -> str:
        """Take a finished file into the register; the session's identity."""
        ...

    def cut_short(self) -> None:
        """Finish what a fault left behind, as far as possible."""
        ...


class LiveWalk:
    """One frame's walk in the live session. Keeps what the smoother needs only while something is recorded."""

    def __init__(self, walk: FrameWalk, neutral_ends_s: float) -> None:
        self._walk = walk
        self._neutral_ends_s = neutral_ends_s
        self._begun = False
        self.keeping = False

    def __call__(self, frame: Frame) -> TrackedFrame:
        """Track one frame; in the tracking thread."""
        tracker = self._walk.tracker
        if not self._begun and frame.timestamp_s > self._neutral_ends_s:
            # The still frames made the calibration; counted twice they would make it too sure of itself.
            tracker.begin_at_neutral()
            self._begun = True
        if not self.keeping:
            tracker.forget()
        return self._walk(frame)

    def smoothed(self, timestamp_s: Sequence[float], forget_before_s: float) -> Motion | None:
        """The smoother's result at the times of some rows; None where one of them was not kept.

        What is older than ``forget_before_s`` is given up. Called from one other thread.
        """
        tracker = self._walk.tracker
        moments = tracker.smoothed()
        steps = tracker.history[: len(moments)]
        at = {step.timestamp_s: moment for step, moment in zip(steps, moments, strict=True)}
        tracker.forget(forget_before_s)
        if any(time_s not in at for time_s in timestamp_s):
            return None
        return motion_of([at[time_s] for time_s in timestamp_s])


class SmoothedSession:
    """A session file that is smoothed as it grows, so that neither memory nor the end grow.

    A thread of its own does that: whoever writes rows must not wait, or a kill would lose what waits with it. Now and
    then the rows are smoothed whose future is known for ``SMOOTHING_LAG_S``; by then what comes later
    changes nothing that matters.
    """

    def __init__(self, writer: SessionWriter, walk: LiveWalk | None) -> None:
        self._writer, self._walk = writer, walk
        self._rows = 0
        self._waiting_s: list[float] = []
        self._smoothing = ThreadPoolExecutor(1, thread_name_prefix="smoothing")
        self._pieces: list[Future[Motion | None]] = []
        self._early: list[tuple[str, str]] = []

    @property
    def path(self) -> Path:
        """Where the finished file will be."""
        return self._writer.path

    def append(self, tracked: TrackedFrame) -> None:
        """One row."""
        self._writer.append(tracked)
        for kind, text in self._early:
            self._writer.add_event(tracked.timestamp_s, kind, text)
        self._early.clear()
        self._rows += 1
        self._waiting_s.append(tracked.timestamp_s)
        if tracked.timestamp_s - self._waiting_s[0] > SMOOTHING_PIECE_S + SMOOTHING_LAG_S:
            self._smooth(tracked.timestamp_s - SMOOTHING_LAG_S)

    def add_event(self, time_s: float, kind: str, text: str) -> None:
        """One event; before the first picture there is no time to put it at, so it waits for the first row."""
        if np.isfinite(time_s):
            self._writer.add_event(time_s, kind, text)
        else:
            self._early.append((kind, text))

    def close(self) -> None:
        """Smooth the rest and finish; a session without a single frame is none."""
        if not self._rows:
            self.discard()
            raise RecordingEmpty(self.path.name)
        self._writer.flush()
        self._smooth(np.inf)
        found = [piece.result() for piece in self._pieces]
        pieces = [piece for piece in found if piece is not None]
        if pieces and len(pieces) == len(found):
            self._writer.write_smoothed(_joined(pieces))
        self._smoothing.shutdown()
        self._writer.close()

    def _smooth(self, until_s: float) -> None:
        if self._walk is None:
            return
        count = bisect_left(self._waiting_s, until_s)
        if count:
            piece = self._smoothing.submit(self._walk.smoothed, self._waiting_s[:count], until_s)
            self._pieces.append(piece)
            del self._waiting_s[:count]

    def abandon(self) -> None:
        """Stop after a fault; what is on the disk stays."""
        self._smoothing.shutdown(cancel_futures=True)
        self._writer.abandon()

    def discard(self) -> None:
        """Remove the file again."""
        self._smoothing.shutdown(cancel_futures=True)
        self._writer.discard()


class SourceMeasuring:
    """A running source: from the chosen calibration to stored sessions, as many as wanted.

    ``starts_with_recording``: a stored recording plays from its first picture when recording starts, so that none
    is missed; a camera has been running since it was opened. ``on_begin`` is called when tracking begins,
    ``on_recording`` when a recording has begun.
    """

    def __init__(
        self,
        session: LiveSession,
        info: SourceInfo,
        set_up: SetUp,
        settings: TrackSettings,
        places: SessionPlaces,
        *,
        starts_with_recording: bool = False,
        on_begin: Callable[[], None] = lambda: None,
        on_recording: Callable[[], None] = lambda: None,
    ) -> None:
        self._session, self._info, self._set_up, self._settings = session, info, set_up, settings
        self._places, self._starts_with_recording = places, starts_with_recording
        self._on_begin, self._on_recording = on_begin, on_recording
        self._played = False
        self._walk: LiveWalk | None = None
        self._learnt: Learnt | None = None
        self._calibration: Calibration | None = None
        self._markers_rgb: ByteImage | None = None

    @property
    def feed(self) -> LiveSession:
        """What the screen pulls."""
        return self._session

    @property
    def camera(self) -> Camera:
        """Intrinsics of the pictures."""
        return self._info.camera

    @property
    def calibration(self) -> Calibration | None:
        """The calibration tracked from, None before."""
        return self._calibration

    @property
    def starts_with_recording(self) -> bool:
        """Whether the source is a stored recording, which is recorded from its first picture to its last."""
        return self._starts_with_recording

    def begin(self, outcome: CalibrationOutcome, held: Sequence[Frame]) -> None:
        """Track from a calibration; ``held`` are the pictures it was made from, the clicked one first."""
        used = held[: max(outcome.capture_frames, 1)]
        neutral_ends_s = max(frame.timestamp_s for frame in used)
        self._learnt = learnt_from(outcome.noise, neutral_ends_s, self._settings.tracker)
        walk = build_walk(outcome, self.camera, self._settings, self._learnt, keep_history=self._settings.smooth)
        self._walk = LiveWalk(walk, neutral_ends_s)
        self._calibration = outcome.calibration
        self._markers_rgb = _around_hand(held[0].color_rgb, outcome.pixel)
        self._session.begin_tracking(self._walk)
        self._on_begin()

    def start_recording(self) -> None:
        """Open the session file, and a raw recording beside it if wanted; waits for the disk."""
        calibration, walk, learnt = self._calibration, self._walk, self._learnt
        assert calibration is not None
        assert walk is not None
        assert learnt is not None
        path = self._places.new_path(self._set_up)
        header = new_header(
            hand=calibration.clicks.side,
            protocol=calibration.clicks.protocol,
            software_version=__version__,
            subject_id=self._set_up.pseudonym,
            exercise=self._set_up.exercise.id,
            parameters=parameters_json(self._settings, source_facts(self._info), learnt),
            dip_free=self._settings.tracker.dip == "free",
        )
        # Looking back at a whole hand takes more time than a running session has; tracking the session again does it.
        smooths = self._settings.smooth and not calibration.clicks.protocol.has_fingers
        smoothing = walk if smooths else None
        walk.keeping = smooths
        try:
            self._session.start_recording(
                lambda: SmoothedSession(SessionWriter.create(path, header, self.camera, calibration), smoothing),
                (lambda: RawWriter(path.with_suffix(RAW_SUFFIX), self._info)) if self._set_up.keep_pictures else None,
            )
        except BaseException:
            walk.keeping = False
            raise
        if self._starts_with_recording and not self._played:
            self._played = True
            self._session.start()
        self._on_recording()

    def stop_recording(self) -> str:
        """Store everything; the session's identity. A fault is raised once what reached the disk is finished."""
        try:
            path = self._session.stop_recording()
        except RecordingEmpty:
            raise
        except Exception:
            self._places.cut_short()
            raise
        finally:
            if self._walk is not None:
                self._walk.keeping = False
        if self._markers_rgb is not None:
            _keep_picture(path.with_suffix(MARKERS_SUFFIX), self._markers_rgb)
        return self._places.entered(self._set_up, path)

    def close(self) -> None:
        """End the source; a running recording is finished."""
        self._session.stop()


def _joined(pieces: Sequence[Motion]) -> Motion:
    names = [field.name for field in fields(Motion)]
    return Motion(**{name: np.concatenate([getattr(piece, name) for piece in pieces]) for name in names})


def _around_hand(color_rgb: ByteImage, pixel: FloatArray) -> ByteImage | None:
    """The picture about the markers, for the patient's card: the hand and nothing of the room."""
    known = pixel[np.isfinite(pixel).all(axis=1)]
    if not len(known):
        return None
    low, high = known.min(axis=0), known.max(axis=0)
    margin = _AROUND_HAND * float((high - low).max())
    left, top = (int(max(0.0, value - margin)) for value in low)
    right, bottom = (int(value + margin) + 1 for value in high)
    return np.ascontiguousarray(color_rgb[top:bottom, left:right])


def _keep_picture(path: Path, color_rgb: ByteImage) -> None:
    """A small picture beside the session; without it nothing is lost, so nothing is told."""
    done, data = cv2.imencode(".jpg", cv2.cvtColor(color_rgb, cv2.COLOR_RGB2BGR))
    if done:
        with suppress(OSError):
            path.touch(mode=0o600)
            path.write_bytes(data.tobytes())

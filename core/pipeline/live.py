"""The live session: capture, tracking and writing, each in its own thread; the engine behind the window.

::

    source -> [capture] --+--> newest picture, last 20 pictures          (screen, calibration)
                          +--> NeverDrop  -> [pictures]  raw pictures    (before anything may be lost)
                          +--> NeverDrop  -> [tracking] --+--> newest view, last 12 s   (screen, pulled by its timer)
                                                          +--> NeverDrop -> [writing]   session file

Consumers start first; a stop runs from the source to the sinks and drains. A busy computer falls behind and loses
nothing: what is recorded waits for the tracker in memory, and the end of a recording waits until it is worked through.
One catch at the top of each thread turns any exception into an event. Nothing here waits for the screen.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Protocol, Self

import numpy as np

from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.errors import CameraLost, CameraReturned
from carpus.core.pipeline.around_hand import PictureSink
from carpus.core.pipeline.backlog import Backlog, Captured, Pipeline, room_for
from carpus.core.pipeline.channels import Newest
from carpus.core.pipeline.live_values import LiveCounters, LiveEvent, LiveEventKind, LiveSettings, TrackedView
from carpus.core.pipeline.recording import LiveRecording, Note, SessionSink, free_bytes
from carpus.core.types import Frame, TrackedFrame

log = logging.getLogger(__name__)

_LOOK_S = 0.005
_FRAME_PATIENCE_S = 0.25
"""A stop waits this long for the capture thread to come back with a frame before it closes the source under it."""


KEPT_FRAMES = 20
"""The newest, for a calibration that begins."""
HISTORY_S = 12.0
"""Of tracked frames, for curves."""
ROW_BYTES, PICTURE_BYTES = 4_000, 100_000
"""On the disk by experience, for the time that is left."""
STOP_PATIENCE_S = 10.0
"""So long a camera may take to give up its last picture."""


class Listener(Protocol):
    """Who hears every tracked frame and every event at once; called in the threads they come from, must not wait."""

    def push(self, frame: TrackedFrame) -> None: ...

    def event(self, time_s: float, kind: str) -> None: ...


class LiveSession:
    """Runs a source; previews, tracks and records it. All methods may be called from any thread.

    Nothing but :meth:`start_recording`, :meth:`stop_recording` and :meth:`stop` waits for anything, and these wait for
    the disk only. The session owns its source and closes it; where the source does not come back with a frame, it is
    closed from the stopping thread, and its ``frames()`` must end then. With ``source_waits`` the source is a file:
    reading waits for tracking, tracking waits for the disk, and no frame is lost on the way.
    """

    def __init__(
        self, source: FrameSource, settings: LiveSettings | None = None, *, source_waits: bool = False
    ) -> None:
        self._source = source
        self._settings = settings or LiveSettings()
        fps = source.info.nominal_fps if source.info.nominal_fps > 0.0 else 30.0
        self._lock = threading.Lock()
        self._stopping = threading.Event()
        self._backlog = Backlog(self._settings.tracking_waiting, fps, waits=source_waits)
        self._newest_frame: Newest[Frame] = Newest()
        self._newest_view: Newest[TrackedView] = Newest()
        self._recent: deque[Frame] = deque(maxlen=KEPT_FRAMES)
        self._history: deque[TrackedFrame] = deque(maxlen=math.ceil(1.25 * fps * HISTORY_S))
        self._events: deque[LiveEvent] = deque(maxlen=1000)
        self._arrivals: deque[float] = deque(maxlen=math.ceil(2.0 * fps) + 1)
        self._latencies: deque[float] = deque(maxlen=math.ceil(10.0 * fps))
        self._captured = self._tracked = self._missing = 0
        self._pipeline: Pipeline | None = None
        self._listener: Listener | None = None
        self._recording: LiveRecording | None = None
        self._capture_thread = threading.Thread(target=self._capture, name="capture", daemon=True)
        self._tracking_thread = threading.Thread(target=self._track, name="tracking", daemon=True)

    # --- life ---------------------------------------------------------------------------------
    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    @property
    def info(self) -> SourceInfo:
        return self._source.info

    def start(self) -> None:
        """Starts the threads, consumers first. A session is started once."""
        self._tracking_thread.start()
        self._capture_thread.start()

    def stop(self) -> None:
        """Ends everything from source to sink: what was captured is tracked, what was tracked is stored.

        A running recording is finished; a fault of it is told as an event. May be called twice.
        """
        self._stopping.set()
        if self._capture_thread.is_alive():
            self._capture_thread.join(timeout=_FRAME_PATIENCE_S)
            if self._capture_thread.is_alive():
                self._source.close()  # a source that waits for a camera or for its next frame ends now
                self._capture_thread.join(timeout=STOP_PATIENCE_S)
            if self._capture_thread.is_alive():
                self._tell("thread_stuck")
        with suppress(Exception):  # already told by the recorder
            if self.recording:
                self.stop_recording()
        self.end_tracking()
        self._backlog.close()
        if self._tracking_thread.is_alive():
            self._tracking_thread.join()
        self._source.close()

    @property
    def running(self) -> bool:
        return self._capture_thread.is_alive()

    # --- pictures -----------------------------------------------------------------------------
    def newest_frame(self) -> Frame | None:
        return self._newest_frame.look()

    def recent_frames(self, count: int) -> list[Frame]:
        """The last pictures, oldest first, at most ``count`` and at most about 20."""
        with self._lock:
            return list(self._recent)[-count:] if count > 0 else []

    # --- tracking -----------------------------------------------------------------------------
    def begin_tracking(self, pipeline: Pipeline) -> None:
        """From the next captured frame on, ``pipeline`` turns frames into tracked frames, in the tracking thread.

        One before it ends; curves and view start anew. Frames lost on the way are in the ``dropped_before`` of the
        frame that it is given.
        """
        with self._lock:
            self._pipeline = pipeline
            self._history.clear()
            self._newest_view.clear()
            self._backlog.clear()

    def end_tracking(self) -> None:
        """No further frame is tracked; the pictures go on."""
        with self._lock:
            self._pipeline = None

    def listen(self, listener: Listener | None) -> None:
        """Hand every tracked frame and event on from now; None for nobody. One that raises hears nothing more."""
        self._listener = listener

    @property
    def tracking(self) -> bool:
        return self._pipeline is not None

    def newest(self) -> TrackedView | None:
        """The newest tracked frame with its picture; older ones that were not looked at are gone."""
        return self._newest_view.look()

    def tracked_since(self, index: int) -> list[TrackedFrame]:
        """Tracked frames with an index above ``index``, oldest first, over the last 12 s or more."""
        with self._lock:
            return [tracked for tracked in self._history if tracked.index > index]

    # --- recording ----------------------------------------------------------------------------
    def start_recording(
        self,
        open_session: Callable[[], SessionSink],
        open_pictures: Callable[[], PictureSink] | None = None,
        at_end: Callable[[], None] = lambda: None,
    ) -> None:
        """Opens the session file (and a raw recording) and stores everything captured from now on.

        Both are opened, filled and closed in threads of their own, closed after ``at_end`` has come back. Raises what
        kept a file from opening; then nothing is recorded.
        """
        if self.recording or self._backlog.ends_recording:
            raise RuntimeError("a recording runs already")
        frame, settings = self._newest_frame.look(), self._settings
        self._backlog.room = room_for(frame, settings.tracking_waiting)
        recording = LiveRecording(
            open_session,
            open_pictures,
            settings,
            room_for(frame, settings.pictures_waiting),
            self._tell,
            waits=self._backlog.waits,
            at_end=at_end,
        )
        recording.start()
        with self._lock:
            self._recording = recording

    def pause_recording(self) -> None:
        """Stores nothing until :meth:`resume_recording`; the pause is noted in the file."""
        recording = self._recording
        if recording is not None and not recording.paused:
            self.add_event("pause", "")
            recording.paused = True

    def resume_recording(self) -> None:
        recording = self._recording
        if recording is not None and recording.paused:
            recording.paused = False
            self.add_event("resume", "")

    def add_event(self, kind: str, text: str = "", at_s: float = math.nan) -> bool:
        """Notes something in the running recording, at a time or at the newest frame's; False when there is none."""
        recording, now_s = self._recording, at_s if math.isfinite(at_s) else self._now_s()
        self._hear(lambda listener: listener.event(now_s, kind))
        return recording is not None and recording.rows.put(Note(now_s, kind, text))

    def tell(self, kind: str, at_s: float) -> None:
        """Says to who listens what is no event of the file: a repetition, which the finished file has in its table."""
        self._hear(lambda listener: listener.event(at_s, kind))

    def stop_recording(self) -> Path:
        """Waits until all that was captured is tracked and stored and the files are closed; the session file's path.

        :meth:`counters` tell how long the tracking takes. Raises the fault that ended the recording early (what reached
        the disk is kept).
        """
        backlog = self._backlog
        with self._lock:
            recording = self._recording
            if recording is None:
                raise RuntimeError("no recording runs")
            backlog.ends_recording = True  # from now on no frame is recorded
            last = backlog.handed  # a file hands over more meanwhile, which is waited for by nobody
        try:
            while recording.rows.fault is None and backlog.is_behind(last) and self._pipeline is not None:
                time.sleep(_LOOK_S)
            with self._lock:
                self._recording = None
            return recording.finish()
        finally:
            backlog.ends_recording = False

    @property
    def recording(self) -> bool:
        """Whether a recording was started and not yet stopped; also after a fault ended it."""
        return self._recording is not None

    @property
    def recorded_from(self) -> int | None:
        """Index of the first frame of the running recording, None until it is captured."""
        recording = self._recording
        return None if recording is None else recording.first_index

    @property
    def paused(self) -> bool:
        recording = self._recording
        return recording is not None and recording.paused

    # --- what is told -------------------------------------------------------------------------
    def notice(self, fault: Exception) -> None:
        """For sources that tell something while they go on: the camera lost or back, pictures left out."""
        kind: LiveEventKind = "notice"
        if isinstance(fault, CameraLost):
            kind = "camera_lost"
        elif isinstance(fault, CameraReturned):
            kind = "camera_back"
        self._tell(kind, fault)
        if kind != "notice":
            self.add_event(kind, str(getattr(fault, "detail", "")))

    def drain_events(self) -> list[LiveEvent]:
        drained = []
        with suppress(IndexError):
            while True:
                drained.append(self._events.popleft())
        return drained

    def counters(self) -> LiveCounters:
        with self._lock:
            latencies = np.array(self._latencies)
            arrivals = [at_s for at_s in self._arrivals if at_s > time.monotonic() - 2.0]
            recording = self._recording
            captured, tracked, missing = self._captured, self._tracked, self._missing
        p50, p95 = np.percentile(latencies, (50.0, 95.0)) if len(latencies) else (math.nan, math.nan)
        span_s = arrivals[-1] - arrivals[0] if len(arrivals) > 1 else 0.0
        fps = (len(arrivals) - 1) / span_s if span_s > 0.0 else 0.0
        rows, pictures = (recording.rows, recording.pictures) if recording else (None, None)
        free = recording.disk_free if recording else free_bytes(self._settings.folder)
        frame_bytes = ROW_BYTES + (PICTURE_BYTES if pictures else 0)
        return LiveCounters(
            captured=captured,
            tracked=tracked,
            dropped=self._backlog.left_out,
            missing=missing,
            fps=fps,
            latency_p50_ms=1e3 * float(p50),
            latency_p95_ms=1e3 * float(p95),
            waiting_tracking=len(self._backlog),
            catching_up_s=self._backlog.behind_s,
            rows_written=rows.written if rows else 0,
            pictures_written=pictures.written if pictures else 0,
            recording=recording is not None,
            paused=recording is not None and recording.paused,
            disk_free_bytes=free,
            disk_minutes_left=math.nan if free is None else free / (frame_bytes * (fps or 30.0)) / 60.0,
        )

    # --- the threads --------------------------------------------------------------------------
    def _capture(self) -> None:
        frames: Iterator[Frame] | None = None
        try:
            frames = self._source.frames()
            for frame in frames:
                if self._stopping.is_set():
                    break
                self._take(frame)
            else:
                # A file has ended when its last frame is tracked: who then stops the recording loses none.
                while self._backlog.waits and self._backlog.is_behind() and not self._stopping.wait(_LOOK_S):
                    pass
                if not self._stopping.is_set():
                    self._tell("source_ended")
        except Exception as cause:  # the one catch at the top of this thread
            if not self._stopping.is_set():
                self._tell("source_failed", cause)
        finally:
            close = getattr(frames, "close", None)  # a generator gives its files back here, in its own thread
            if close is not None:
                close()

    def _take(self, frame: Frame) -> None:
        at_s = time.monotonic()
        with self._lock:
            recording, pipeline = self._recording, self._pipeline
            if recording is not None and (recording.paused or self._backlog.ends_recording):
                recording = None
            if pipeline is not None:  # told with the recording: who stops it waits for this frame too
                self._backlog.expect()
            self._recent.append(frame)
            self._arrivals.append(at_s)
            self._captured += 1
            self._missing += frame.dropped_before
            if recording is not None and recording.first_index is None:
                recording.first_index = frame.index
        if recording is not None and recording.pictures is not None:
            recording.pictures.put(frame)
        self._newest_frame.put(frame)
        if pipeline is not None:
            self._backlog.put(Captured(frame, at_s, pipeline, recording))

    def _track(self) -> None:
        for captured in self._backlog:
            try:
                # Else captured for a pipeline that has ended, or waiting for a recording that has failed.
                if captured.pipeline is self._pipeline and not self._backlog.is_of_the_past(captured):
                    self._track_one(captured)
            except Exception as cause:  # the one catch at the top of this thread
                with self._lock:
                    if self._pipeline is captured.pipeline:
                        self._pipeline = None
                self._tell("tracking_failed", cause)

    def _track_one(self, captured: Captured) -> None:
        frame = captured.frame
        tracked = captured.pipeline(frame)
        with self._lock:
            if self._pipeline is not captured.pipeline:
                return
            self._history.append(tracked)
            self._tracked += 1
            self._latencies.append(time.monotonic() - captured.at_s)
            self._newest_view.put(TrackedView(frame, tracked, captured.at_s))
        if captured.recording is not None:
            captured.recording.rows.put(tracked)
        self._hear(lambda listener: listener.push(tracked))

    # --- small things -------------------------------------------------------------------------
    def _hear(self, say: Callable[[Listener], None]) -> None:
        listener = self._listener
        if listener is None:
            return
        try:
            say(listener)
        except Exception:  # whoever listens must not end the measuring
            log.warning("the live stream ended", exc_info=True)
            self._listener = None

    def _tell(self, kind: LiveEventKind, cause: Exception | None = None, value: float = math.nan) -> None:
        if cause is not None:
            log.warning("%s", kind, exc_info=cause)
        self._events.append(LiveEvent(kind, self._now_s(), cause, value))

    def _now_s(self) -> float:
        """Time of the newest frame, in the recording's own time."""
        frame = self._newest_frame.look()
        return math.nan if frame is None else frame.timestamp_s

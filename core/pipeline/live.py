"""The live session: capture, tracking and writing, each in its own thread; the engine behind the window.

::

    source -> [capture] --+--> current frame, last 20 frames             (screen, calibration)
                          +--> BoundedQueue -> [pictures]  raw recording (before anything may be lost)
                          +--> BoundedQueue -> [tracking] --+--> current view, last 12 s   (screen, by its timer)
                                                            +--> BoundedQueue -> [writing]   session file

Consumers start first; a stop runs from the source to the sinks and drains the queues. A busy computer falls behind
and loses nothing: recorded frames wait for the tracker in memory, and the end of a recording waits for them. One
handler at the top of each thread turns any exception into an event. Nothing here waits for the screen.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple, Protocol, Self

from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.model.errors import CameraLost, CameraReturned
from carpus.core.model.types import Frame, TrackedFrame
from carpus.core.pipeline.live_values import LiveCounters, LiveEvent, LiveEventKind, LiveSettings, TrackedView
from carpus.core.pipeline.queues import BoundedQueue, Mailbox, QueueClosedError, QueueFullError
from carpus.core.pipeline.recording import LiveRecording, QueuedEvent, SessionSink, read_free_bytes

log = logging.getLogger(__name__)

_POLL_S = 0.005
_STOP_GRACE_S = 0.25
"""A stop waits this long for a frame before it closes the source under the capture thread."""


RECENT_FRAMES = 20
"""Frames kept for a calibration."""
HISTORY_S = 12.0
"""Tracked frames kept for curves."""
ROW_BYTES, FRAME_BYTES = 4_000, 100_000
"""Typical size on disk, for the estimate of the remaining time."""
STOP_TIMEOUT_S = 10.0
"""Time that a camera may take for its last frame."""
MAX_PREVIEW_WAITING = 16
"""Frames that may wait while nothing is recorded: half a second, so that the preview stays current."""
FOLLOW_INTERVAL_S = 0.08
"""The hand is tracked at least this often: after a second without frames, fingers may be confused."""
MAX_MEMORY_SHARE = 0.5
"""Largest share of the memory free at the start of a recording that waiting frames may use."""


class Listener(Protocol):
    """Receiver of every tracked frame and event, called in the threads they come from; must not wait."""

    def on_frame(self, frame: TrackedFrame) -> None: ...

    def on_event(self, time_s: float, kind: str) -> None: ...


Pipeline = Callable[[Frame], TrackedFrame]


class QueuedFrame(NamedTuple):
    """Frame with the tracker and the recording that were current when it was captured.

    ``recording`` is None if the frame is not recorded.
    """

    frame: Frame
    captured_at_s: float
    pipeline: Pipeline
    recording: LiveRecording | None


class Backlog(BoundedQueue[QueuedFrame]):
    """Frames waiting for the tracker, in order of capture.

    ``capacity`` recorded frames may wait, of others only those of the last half second. A frame without room is dropped
    and counted in the next one; with ``is_blocking`` the caller waits instead. While a recording is being finished
    (``is_finishing_recording``), new frames are dropped without being counted; once no recorded frame waits, as many
    are tracked as it takes to follow the hand.
    """

    def __init__(self, capacity: int, fps: float, *, is_blocking: bool) -> None:
        super().__init__(min(MAX_PREVIEW_WAITING, capacity) if is_blocking else capacity, is_blocking=is_blocking)
        self.is_finishing_recording = False
        self.dropped_count = 0
        self._lock = threading.Lock()
        self.submission_count = self._processed_count = self._dropped_before = 0
        self._last_queued_s = -math.inf
        self._processed_at_s: deque[float] = deque(maxlen=math.ceil(2.0 * fps))

    def __iter__(self) -> Iterator[QueuedFrame]:
        """Yield each frame to the tracking thread; it counts as processed when the next one is requested."""
        for captured in super().__iter__():
            yield captured
            with self._lock:
                self._processed_count += 1
                self._processed_at_s.append(time.monotonic())

    @property
    def lag_s(self) -> float:
        """Time that the tracker needs for the waiting frames at its recent speed; NaN if unknown."""
        waiting = len(self)
        with self._lock:
            count, work_s = len(self._processed_at_s), math.nan
            if count > 1:
                work_s = self._processed_at_s[-1] - self._processed_at_s[0]
        return waiting * work_s / max(count - 1, 1) if waiting else 0.0

    def has_pending(self, count: int | None = None) -> bool:
        """Return whether any of the first ``count`` frames waits or is being processed."""
        with self._lock:
            return self._processed_count < (
                self.submission_count if count is None else min(count, self.submission_count)
            )

    def announce(self) -> None:
        """Announce a frame, so that whoever waits for the tracker waits for this one too."""
        with self._lock:
            self.submission_count += 1

    def submit(self, queued: QueuedFrame) -> None:
        """Queue an announced frame, or drop it."""
        frame, room = queued.frame, self.capacity
        if self._dropped_before:
            frame = replace(frame, dropped_before=frame.dropped_before + self._dropped_before)
        if queued.recording is None and not self.is_blocking:
            room = min(MAX_PREVIEW_WAITING, room)
            if self.is_finishing_recording:
                room = int(frame.timestamp_s - self._last_queued_s >= FOLLOW_INTERVAL_S)
        try:
            if not self.is_blocking and len(self) >= room:
                raise QueueFullError
            self.push(queued._replace(frame=frame))
            self._dropped_before, self._last_queued_s = 0, frame.timestamp_s
            return
        except QueueFullError:
            if not self.is_finishing_recording:
                self.dropped_count += 1
                self._dropped_before = frame.dropped_before + 1
        except QueueClosedError:
            pass  # the session ended while a file waited for the tracker
        with self._lock:
            self.submission_count -= 1

    def is_stale(self, queued: QueuedFrame) -> bool:
        """Return whether a frame waited for a failed recording and the queue is long.

        Such frames are skipped, so that the preview stays current and the next recording finds room.
        """
        failed = queued.recording is not None and queued.recording.row_recorder.fault is not None
        return failed and not self.is_blocking and len(self) >= MAX_PREVIEW_WAITING

    def clear(self) -> None:
        """Drop all waiting frames, as another tracker starts."""
        taken = len(self.drain())
        with self._lock:
            self._processed_count += taken
        self._dropped_before = 0


def compute_capacity(frame: Frame | None, limit: int) -> int:
    """Return how many frames like this one may wait: ``limit``, or what the share of the free memory holds."""
    free = read_free_memory_bytes()
    if frame is None or free is None:
        return limit
    frame_bytes = frame.color_rgb.nbytes + (0 if frame.depth_raw is None else frame.depth_raw.nbytes)
    return min(limit, max(MAX_PREVIEW_WAITING, int(MAX_MEMORY_SHARE * free) // frame_bytes))


def read_free_memory_bytes() -> int | None:
    """Return the memory available without swapping; None if the system does not state it."""
    with suppress(OSError):
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return 1024 * int(line.split()[1])
    return None


class LiveSession:
    """Runs a source: previews, tracks and records it. All methods may be called from any thread.

    Only :meth:`start_recording`, :meth:`stop_recording` and :meth:`stop` wait, and only for the disk. The session owns
    its source and closes it, if need be from the stopping thread, upon which ``frames()`` must end. With ``is_file``
    the source is a file: reading waits for tracking, tracking waits for the disk, and no frame is lost.
    """

    def __init__(self, source: FrameSource, settings: LiveSettings | None = None, *, is_file: bool = False) -> None:
        self._source = source
        self._settings = settings or LiveSettings()
        fps = source.info.nominal_fps if source.info.nominal_fps > 0.0 else 30.0
        self._lock = threading.Lock()
        self._stopping = threading.Event()
        self._backlog = Backlog(self._settings.max_waiting_frames, fps, is_blocking=is_file)
        self._frame_mailbox: Mailbox[Frame] = Mailbox()
        self._view_mailbox: Mailbox[TrackedView] = Mailbox()
        self._recent_frames: deque[Frame] = deque(maxlen=RECENT_FRAMES)
        self._history: deque[TrackedFrame] = deque(maxlen=math.ceil(1.25 * fps * HISTORY_S))
        self._events: deque[LiveEvent] = deque(maxlen=1000)
        self._arrivals: deque[float] = deque(maxlen=math.ceil(2.0 * fps) + 1)
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

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    def info(self) -> SourceInfo:
        return self._source.info

    def start(self) -> None:
        """Start the threads, consumers first; may be called once."""
        self._tracking_thread.start()
        self._capture_thread.start()

    def stop(self) -> None:
        """Stop from source to sink: captured frames are tracked, tracked frames are stored.

        A running recording is finished; its fault is reported as an event. May be called twice.
        """
        self._stopping.set()
        if self._capture_thread.is_alive():
            self._capture_thread.join(timeout=_STOP_GRACE_S)
            if self._capture_thread.is_alive():
                self._source.close()  # a source that waits for a camera or for its next frame ends now
                self._capture_thread.join(timeout=STOP_TIMEOUT_S)
            if self._capture_thread.is_alive():
                self._report_event("thread_stuck")
        with suppress(Exception):  # reported by the recorder
            if self.is_recording:
                self.stop_recording()
        with self._lock:
            self._pipeline = None
        self._backlog.close()
        if self._tracking_thread.is_alive():
            self._tracking_thread.join()
        self._source.close()

    # --- pictures -----------------------------------------------------------------------------
    def current_frame(self) -> Frame | None:
        return self._frame_mailbox.peek()

    def recent_frames(self, count: int) -> list[Frame]:
        """Return at most ``count`` of the last frames (about 20), oldest first."""
        with self._lock:
            return list(self._recent_frames)[-count:] if count > 0 else []

    # --- tracking -----------------------------------------------------------------------------
    def start_tracking(self, pipeline: Pipeline) -> None:
        """Track frames by ``pipeline``, in the tracking thread, from the next one on.

        The previous tracking ends; curves and view start again. Frames lost on the way are counted in
        ``dropped_before``.
        """
        with self._lock:
            self._pipeline = pipeline
            self._history.clear()
            self._view_mailbox.clear()
            self._backlog.clear()

    def set_listener(self, listener: Listener | None) -> None:
        """Set who receives every tracked frame and event; a listener that raises is removed."""
        self._listener = listener

    def current_view(self) -> TrackedView | None:
        """Return the last tracked frame with its image."""
        return self._view_mailbox.peek()

    def frames_since(self, index: int) -> list[TrackedFrame]:
        """Return tracked frames with an index above ``index``, oldest first, of the last 12 s or more."""
        with self._lock:
            return [tracked for tracked in self._history if tracked.index > index]

    # --- recording ----------------------------------------------------------------------------
    def start_recording(
        self,
        open_session: Callable[[], SessionSink],
        open_frames: Callable[[], RawWriter] | None = None,
        before_close: Callable[[], None] = lambda: None,
    ) -> None:
        """Open the session file (and a raw recording) and store all frames from now on.

        Both are written in threads of their own, and closed after ``before_close`` has returned. If a file cannot be
        opened its fault is raised and nothing is recorded.
        """
        if self.is_recording or self._backlog.is_finishing_recording:
            raise RuntimeError("a recording runs already")
        frame, settings = self._frame_mailbox.peek(), self._settings
        if not self._backlog.is_blocking:
            self._backlog.capacity = compute_capacity(frame, settings.max_waiting_frames)
        recording = LiveRecording(
            open_session,
            open_frames,
            settings,
            compute_capacity(frame, settings.max_waiting_images),
            self._report_event,
            is_blocking=self._backlog.is_blocking,
            before_close=before_close,
        )
        recording.start()
        with self._lock:
            self._recording = recording

    def pause_recording(self) -> None:
        """Store nothing until :meth:`resume_recording`; the pause is noted in the file."""
        recording = self._recording
        if recording is not None and not recording.is_paused:
            self.add_event("pause", "")
            recording.is_paused = True

    def resume_recording(self) -> None:
        recording = self._recording
        if recording is not None and recording.is_paused:
            recording.is_paused = False
            self.add_event("resume", "")

    def add_event(self, kind: str, text: str = "", time_s: float = math.nan) -> bool:
        """Add an event to the recording, by default at the current frame; return False if there is none."""
        recording, now_s = self._recording, time_s if math.isfinite(time_s) else self._current_time_s()
        self._notify(lambda listener: listener.on_event(now_s, kind))
        return recording is not None and recording.row_recorder.submit(QueuedEvent(now_s, kind, text))

    def notify_listener(self, kind: str, time_s: float) -> None:
        """Notify the listener of an event that is not stored as such, such as a repetition."""
        self._notify(lambda listener: listener.on_event(time_s, kind))

    def stop_recording(self) -> Path:
        """Wait until all captured frames are tracked and stored; return the path of the session file.

        :meth:`counters` state the remaining time. Raises the fault that ended the recording early; data on the disk are
        kept.
        """
        backlog = self._backlog
        with self._lock:
            recording = self._recording
            if recording is None:
                raise RuntimeError("no recording runs")
            backlog.is_finishing_recording = True  # from now on no frame is recorded
            last = backlog.submission_count  # a file submits more meanwhile, for which nothing waits
        try:
            while recording.row_recorder.fault is None and backlog.has_pending(last) and self._pipeline is not None:
                time.sleep(_POLL_S)
            with self._lock:
                self._recording = None
            return recording.finish()
        finally:
            backlog.is_finishing_recording = False

    @property
    def is_recording(self) -> bool:
        """Whether a recording was started and not yet stopped; also after a fault ended it."""
        return self._recording is not None

    @property
    def first_recorded_index(self) -> int | None:
        """Index of the first recorded frame; None until it is captured."""
        recording = self._recording
        return None if recording is None else recording.first_frame_index

    @property
    def is_paused(self) -> bool:
        recording = self._recording
        return recording is not None and recording.is_paused

    # --- events and counters ------------------------------------------------------------------
    def handle_notice(self, fault: Exception) -> None:
        """Report a notice of the source: camera lost or returned, images skipped."""
        kind: LiveEventKind = "notice"
        if isinstance(fault, CameraLost):
            kind = "camera_lost"
        elif isinstance(fault, CameraReturned):
            kind = "camera_back"
        self._report_event(kind, fault)
        if kind != "notice":
            self.add_event(kind, str(getattr(fault, "detail", "")))

    def drain_events(self) -> list[LiveEvent]:
        return [self._events.popleft() for _ in range(len(self._events))]

    def counters(self) -> LiveCounters:
        with self._lock:
            arrivals = [at_s for at_s in self._arrivals if at_s > time.monotonic() - 2.0]
            recording = self._recording
            captured, tracked, missing = self._captured, self._tracked, self._missing
        span_s = arrivals[-1] - arrivals[0] if len(arrivals) > 1 else 0.0
        fps = (len(arrivals) - 1) / span_s if span_s > 0.0 else 0.0
        free = recording.disk_free_bytes if recording else read_free_bytes(self._settings.folder)
        frame_bytes = ROW_BYTES + (FRAME_BYTES if recording and recording.frame_recorder else 0)
        return LiveCounters(
            captured=captured,
            tracked=tracked,
            dropped=self._backlog.dropped_count,
            missing=missing,
            fps=fps,
            frames_waiting=len(self._backlog),
            tracking_lag_s=self._backlog.lag_s,
            is_recording=recording is not None,
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
                at_s = time.monotonic()
                with self._lock:
                    recording, pipeline = self._recording, self._pipeline
                    if recording is not None and (recording.is_paused or self._backlog.is_finishing_recording):
                        recording = None
                    if pipeline is not None:  # announced under the lock, so that a stop waits for this frame too
                        self._backlog.announce()
                    self._recent_frames.append(frame)
                    self._arrivals.append(at_s)
                    self._captured += 1
                    self._missing += frame.dropped_before
                    if recording is not None and recording.first_frame_index is None:
                        recording.first_frame_index = frame.index
                if recording is not None and recording.frame_recorder is not None:
                    recording.frame_recorder.submit(frame)
                self._frame_mailbox.post(frame)
                if pipeline is not None:
                    self._backlog.submit(QueuedFrame(frame, at_s, pipeline, recording))
            else:
                # A file has ended when its last frame is tracked: who then stops the recording loses none.
                while self._backlog.is_blocking and self._backlog.has_pending() and not self._stopping.wait(_POLL_S):
                    pass
                if not self._stopping.is_set():
                    self._report_event("source_ended")
        except Exception as cause:  # the one catch at the top of this thread
            if not self._stopping.is_set():
                self._report_event("source_failed", cause)
        finally:
            close = getattr(frames, "close", None)  # a generator gives its files back here, in its own thread
            if close is not None:
                close()

    def _track(self) -> None:
        for captured in self._backlog:
            try:
                # Else captured for a pipeline that has ended, or waiting for a recording that has failed.
                if captured.pipeline is self._pipeline and not self._backlog.is_stale(captured):
                    self._track_one(captured)
            except Exception as cause:  # the one catch at the top of this thread
                with self._lock:
                    if self._pipeline is captured.pipeline:
                        self._pipeline = None
                self._report_event("tracking_failed", cause)

    def _track_one(self, captured: QueuedFrame) -> None:
        frame = captured.frame
        tracked = captured.pipeline(frame)
        with self._lock:
            if self._pipeline is not captured.pipeline:
                return
            self._history.append(tracked)
            self._tracked += 1
            self._view_mailbox.post(TrackedView(frame, tracked, captured.captured_at_s))
        if captured.recording is not None:
            captured.recording.row_recorder.submit(tracked)
        self._notify(lambda listener: listener.on_frame(tracked))

    # --- small things -------------------------------------------------------------------------
    def _notify(self, callback: Callable[[Listener], None]) -> None:
        listener = self._listener
        if listener is None:
            return
        try:
            callback(listener)
        except Exception:  # a listener must not end the measurement
            log.warning("the live stream ended", exc_info=True)
            self._listener = None

    def _report_event(self, kind: LiveEventKind, cause: Exception | None = None, value: float = math.nan) -> None:
        if cause is not None:
            log.warning("%s", kind, exc_info=cause)
        self._events.append(LiveEvent(kind, self._current_time_s(), cause, value))

    def _current_time_s(self) -> float:
        """Return the time of the current frame, on the recording's clock."""
        frame = self._frame_mailbox.peek()
        return math.nan if frame is None else frame.timestamp_s

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
import shutil
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import NamedTuple, Protocol, Self

import numpy as np

from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.errors import CameraLost, CameraReturned
from carpus.core.pipeline.around_hand import PictureSink
from carpus.core.pipeline.channels import ChannelClosed, ChannelFull, NeverDrop, Newest, Waits
from carpus.core.pipeline.live_values import LiveCounters, LiveEvent, LiveEventKind, TrackedView
from carpus.core.pipeline.recorder import Patience, Recorder, Sink
from carpus.core.types import Frame, TrackedFrame

log = logging.getLogger(__name__)

PREVIEW_WAITING = 16
"""Pictures that wait for the tracker while nothing is recorded: half a second. What is seen is to be of now."""
FREE_SHARE = 0.5
"""No more than this part of the memory that is free when a recording begins is for pictures that wait."""
_LOOK_S = 0.005
_FRAME_PATIENCE_S = 0.25
"""A stop waits this long for the capture thread to come back with a frame before it closes the source under it."""

Pipeline = Callable[[Frame], TrackedFrame]


class SessionSink(Sink, Protocol):
    """The session file in the making."""

    def append(self, tracked: TrackedFrame) -> None: ...

    def add_event(self, time_s: float, kind: str, text: str) -> None: ...

    def go_on_elsewhere(self) -> SessionSink:
        """Another file with what this one, which hangs in the disk, has taken and not stored."""
        ...


class Listener(Protocol):
    """Who hears every tracked frame and every event at once; called in the threads they come from, must not wait."""

    def push(self, frame: TrackedFrame) -> None: ...

    def event(self, time_s: float, kind: str) -> None: ...


@dataclass(frozen=True, slots=True)
class LiveSettings:
    """Bounds of the live session.

    ``tracking_waiting`` recorded frames that may wait for the tracker before new ones are left out: a minute of a
    camera at twice the work that the computer can do, as they came, 1.5 GB of 640x480, fewer where the computer has
    not twice as much memory free. ``pictures_waiting`` may wait for the disk before the raw recording ends; the newest
    are the same as those above, so the two share their memory.
    ``rows_waiting`` as many results, beside those that wait for the tracker, before the recording ends (30 s);
    ``history_s`` of tracked frames kept for curves; ``row_bytes`` and ``picture_bytes`` on the disk by experience, for
    the time that is left; a warning comes once below ``low_disk_bytes``. ``folder`` is where sessions will go, for the
    room on the disk before a recording runs. A disk that neither stores nor refuses is told after ``told_stall_s``, and
    the recording goes on elsewhere after ``moved_stall_s``; the pictures at once.
    """

    tracking_waiting: int = 960
    rows_waiting: int = 900
    pictures_waiting: int = 960
    recent_frames: int = 20
    history_s: float = 12.0
    row_bytes: int = 4_000
    picture_bytes: int = 100_000
    low_disk_bytes: int = 1_000_000_000
    stop_patience_s: float = 10.0
    folder: Path | None = None
    told_stall_s: float = 3.0
    moved_stall_s: float = 8.0

    def __post_init__(self) -> None:
        for name in ("tracking_waiting", "rows_waiting", "pictures_waiting", "recent_frames", "history_s"):
            if not 0 < getattr(self, name) <= 1_000_000:
                raise ValueError(f"{name} {getattr(self, name)} is not between 0 and 1000000")


class _Captured(NamedTuple):
    """A frame on its way to the tracker, and to the recording, that were current when it was captured; ``rows`` None
    where it is not recorded."""

    frame: Frame
    at_s: float
    pipeline: Pipeline
    rows: Recorder[SessionSink, TrackedFrame | _Note] | None


class _Note(NamedTuple):
    """An event on its way to the session file."""

    time_s: float
    kind: str
    text: str


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
        self._source_waits = source_waits
        self._to_tracking: NeverDrop[_Captured] | Waits[_Captured] = (
            Waits(min(PREVIEW_WAITING, self._settings.tracking_waiting))
            if source_waits
            else NeverDrop(self._settings.tracking_waiting)
        )
        self._newest_frame: Newest[Frame] = Newest()
        self._newest_view: Newest[TrackedView] = Newest()
        self._recent: deque[Frame] = deque(maxlen=self._settings.recent_frames)
        self._history: deque[TrackedFrame] = deque(maxlen=math.ceil(1.25 * fps * self._settings.history_s))
        self._events: deque[LiveEvent] = deque(maxlen=1000)
        self._arrivals: deque[float] = deque(maxlen=math.ceil(2.0 * fps) + 1)
        self._latencies: deque[float] = deque(maxlen=math.ceil(10.0 * fps))
        self._room = self._settings.tracking_waiting
        self._captured = self._tracked = self._missing = 0
        self._handed = self._worked = self._left_out = self._left_out_before = 0
        self._worked_at: deque[float] = deque(maxlen=math.ceil(2.0 * fps))
        self._pipeline: Pipeline | None = None
        self._listener: Listener | None = None
        self._rows: Recorder[SessionSink, TrackedFrame | _Note] | None = None
        self._pictures: Recorder[PictureSink, Frame] | None = None
        self._paused = self._catching_up = False
        self._disk_warned = False
        self._disk_free: int | None = None
        self._row_count = 0
        self._recorded_from: int | None = None
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
        """Facts of the source."""
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
                self._capture_thread.join(timeout=self._settings.stop_patience_s)
            if self._capture_thread.is_alive():
                self._tell("thread_stuck")
        with suppress(Exception):  # already told by the recorder
            if self.recording:
                self.stop_recording()
        self.end_tracking()
        self._to_tracking.close()
        if self._tracking_thread.is_alive():
            self._tracking_thread.join()
        self._source.close()

    @property
    def running(self) -> bool:
        """Whether the source still delivers."""
        return self._capture_thread.is_alive()

    # --- pictures -----------------------------------------------------------------------------
    def newest_frame(self) -> Frame | None:
        """The newest picture, before and during tracking."""
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
            self._worked += len(self._to_tracking.taken())
            self._left_out_before = 0

    def end_tracking(self) -> None:
        """No further frame is tracked; the pictures go on."""
        with self._lock:
            self._pipeline = None

    def listen(self, listener: Listener | None) -> None:
        """Hand every tracked frame and event on from now; None for nobody. One that raises hears nothing more."""
        self._listener = listener

    @property
    def tracking(self) -> bool:
        """Whether frames are being tracked."""
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
    ) -> None:
        """Opens the session file (and a raw recording) and stores everything captured from now on.

        Both are opened, filled and closed in threads of their own. Raises what kept a file from opening; then nothing
        is recorded.
        """
        if self.recording:
            raise RuntimeError("a recording runs already")
        settings = self._settings
        self._room = _room_for(self._newest_frame.look(), settings.tracking_waiting)
        self._row_count, self._disk_warned, self._disk_free = 0, False, None
        rows: Recorder[SessionSink, TrackedFrame | _Note] = Recorder(
            "writing",
            open_session,
            self._write_row,
            settings.rows_waiting + (0 if self._source_waits else settings.tracking_waiting),
            lambda cause: self._tell("recording_failed", cause),
            waits=self._source_waits,
            patience=Patience(
                self.notice, lambda sink, _: sink.go_on_elsewhere(), settings.told_stall_s, settings.moved_stall_s
            ),
        )
        rows.start()
        pictures = None if open_pictures is None else self._recorder_of_pictures(open_pictures)
        if pictures is not None:
            try:
                pictures.start()
            except Exception:
                rows.discard()
                raise
        with self._lock:
            self._rows, self._pictures = rows, pictures
            self._recorded_from = None
            self._paused = False

    def _recorder_of_pictures(self, open_pictures: Callable[[], PictureSink]) -> Recorder[PictureSink, Frame]:
        settings = self._settings
        return Recorder(
            "pictures",
            open_pictures,
            lambda sink, frame: sink.append_frame(frame),
            _room_for(self._newest_frame.look(), settings.pictures_waiting),
            lambda cause: self._tell("pictures_failed", cause),
            waits=self._source_waits,
            patience=Patience(
                self.notice,
                lambda sink, frame: sink.go_on_elsewhere(frame),
                settings.told_stall_s,
                min(settings.told_stall_s, settings.moved_stall_s),  # no more than these have room to wait for
            ),
        )

    def pause_recording(self) -> None:
        """Stores nothing until :meth:`resume_recording`; the pause is noted in the file."""
        if self.recording and not self._paused:
            self.add_event("pause", "")
            self._paused = True

    def resume_recording(self) -> None:
        """Goes on storing."""
        if self.recording and self._paused:
            self._paused = False
            self.add_event("resume", "")

    def add_event(self, kind: str, text: str = "", at_s: float = math.nan) -> bool:
        """Notes something in the running recording, at a time or at the newest frame's; False when there is none."""
        rows, now_s = self._rows, at_s if math.isfinite(at_s) else self._now_s()
        self._hear(lambda listener: listener.event(now_s, kind))
        return rows is not None and rows.put(_Note(now_s, kind, text))

    def tell(self, kind: str, at_s: float) -> None:
        """Says to who listens what is no event of the file: a repetition, which the finished file has in its table."""
        self._hear(lambda listener: listener.event(at_s, kind))

    def stop_recording(self) -> Path:
        """Waits until all that was captured is tracked and stored and the files are closed; the session file's path.

        :meth:`counters` tell how long the tracking takes. Raises the fault that ended the recording early (what reached
        the disk is kept).
        """
        with self._lock:
            rows, self._catching_up = self._rows, True  # from now on no frame is recorded
            last = self._handed  # a file hands over more meanwhile, which is waited for by nobody
        try:
            while rows is not None and rows.fault is None and self._is_behind(last) and self._pipeline is not None:
                time.sleep(_LOOK_S)
        finally:
            with self._lock:
                pictures = self._pictures
                self._rows = self._pictures = None
                self._paused = self._catching_up = False
        if rows is None:
            raise RuntimeError("no recording runs")
        try:
            return rows.finish()
        finally:
            if pictures is not None:
                with suppress(Exception):  # told as pictures_failed
                    pictures.finish()

    @property
    def recording(self) -> bool:
        """Whether a recording was started and not yet stopped; also after a fault ended it."""
        return self._rows is not None

    @property
    def recorded_from(self) -> int | None:
        """Index of the first frame of the running recording, None until it is captured."""
        return self._recorded_from if self.recording else None

    @property
    def paused(self) -> bool:
        """Whether the recording is paused."""
        return self._paused

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
        """Everything told since the last call, oldest first."""
        drained = []
        with suppress(IndexError):
            while True:
                drained.append(self._events.popleft())
        return drained

    def counters(self) -> LiveCounters:
        """Figures of the moment; cheap enough for a timer."""
        with self._lock:
            latencies = np.array(self._latencies)
            arrivals = [at_s for at_s in self._arrivals if at_s > time.monotonic() - 2.0]
            rows, pictures = self._rows, self._pictures
            captured, tracked, missing = self._captured, self._tracked, self._missing
            worked_at = list(self._worked_at)
        p50, p95 = np.percentile(latencies, (50.0, 95.0)) if len(latencies) else (math.nan, math.nan)
        waiting = len(self._to_tracking)
        work_s = worked_at[-1] - worked_at[0] if len(worked_at) > 1 else math.nan
        span_s = arrivals[-1] - arrivals[0] if len(arrivals) > 1 else 0.0
        fps = (len(arrivals) - 1) / span_s if span_s > 0.0 else 0.0
        free = self._disk_free if rows else _free_bytes(self._settings.folder)
        return LiveCounters(
            captured=captured,
            tracked=tracked,
            dropped=self._left_out,
            missing=missing,
            fps=fps,
            latency_p50_ms=1e3 * float(p50),
            latency_p95_ms=1e3 * float(p95),
            waiting_tracking=waiting,
            catching_up_s=waiting * work_s / max(len(worked_at) - 1, 1) if waiting else 0.0,
            waiting_writing=rows.waiting if rows else 0,
            waiting_pictures=pictures.waiting if pictures else 0,
            rows_written=rows.written if rows else 0,
            pictures_written=pictures.written if pictures else 0,
            recording=rows is not None,
            paused=self._paused,
            recording_path=rows.path if rows else None,
            disk_free_bytes=free,
            disk_minutes_left=math.nan if free is None else free / self._bytes_per_s(fps, pictures is not None) / 60.0,
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
                self._let_tracking_come_up()
                if not self._stopping.is_set():
                    self._tell("source_ended")
        except Exception as cause:  # the one catch at the top of this thread
            if not self._stopping.is_set():
                self._tell("source_failed", cause)
        finally:
            close = getattr(frames, "close", None)  # a generator gives its files back here, in its own thread
            if close is not None:
                close()

    def _let_tracking_come_up(self) -> None:
        """A file has ended when its last frame is tracked: who then stops the recording loses none."""
        while self._source_waits and self._is_behind() and not self._stopping.wait(_LOOK_S):
            pass

    def _is_behind(self, last: int | None = None) -> bool:
        """Whether a frame waits or is worked on, of the first ``last`` handed over."""
        with self._lock:
            return self._worked < (self._handed if last is None else min(last, self._handed))

    def _take(self, frame: Frame) -> None:
        at_s = time.monotonic()
        with self._lock:
            recorded = not (self._paused or self._catching_up)
            rows, pictures = (self._rows, self._pictures) if recorded else (None, None)
            pipeline = self._pipeline
            self._handed += pipeline is not None  # told with the rows: who stops the recording waits for this frame too
            self._recent.append(frame)
            self._arrivals.append(at_s)
            self._captured += 1
            self._missing += frame.dropped_before
            if rows is not None and self._recorded_from is None:
                self._recorded_from = frame.index
        if pictures is not None:
            pictures.put(frame)
        self._newest_frame.put(frame)
        if pipeline is not None:
            self._hand_over(_Captured(frame, at_s, pipeline, rows))

    def _hand_over(self, captured: _Captured) -> None:
        """To the tracker; without room the frame is left out, and counted in the next one. Of what is not recorded only
        the last half second waits, and nothing while the end of a recording does."""
        frame = captured.frame
        if self._left_out_before:
            frame = replace(frame, dropped_before=frame.dropped_before + self._left_out_before)
        room = self._room
        if captured.rows is None and not self._source_waits:
            room = 0 if self._catching_up else min(PREVIEW_WAITING, room)
        try:
            if not self._source_waits and len(self._to_tracking) >= room:
                raise ChannelFull
            self._to_tracking.put(captured._replace(frame=frame))
            self._left_out_before = 0
            return
        except ChannelFull:
            self._left_out += not self._catching_up
            self._left_out_before = frame.dropped_before + 1
        except ChannelClosed:
            pass  # the session ended while a file waited for the tracker
        with self._lock:
            self._handed -= 1

    def _track(self) -> None:
        for captured in self._to_tracking:
            try:
                # Else captured for a pipeline that has ended, or waiting for a recording that has failed.
                if captured.pipeline is self._pipeline and not self._is_of_the_past(captured):
                    self._track_one(captured)
            except Exception as cause:  # the one catch at the top of this thread
                with self._lock:
                    if self._pipeline is captured.pipeline:
                        self._pipeline = None
                self._tell("tracking_failed", cause)
            finally:
                with self._lock:
                    self._worked += 1
                    self._worked_at.append(time.monotonic())

    def _is_of_the_past(self, captured: _Captured) -> bool:
        """Whether a frame waited for a recording that has failed: what is seen is to be of now, and the next recording
        to find room."""
        rows = captured.rows
        failed = rows is not None and rows.fault is not None
        return failed and not self._source_waits and len(self._to_tracking) >= PREVIEW_WAITING

    def _track_one(self, captured: _Captured) -> None:
        frame = captured.frame
        tracked = captured.pipeline(frame)
        with self._lock:
            if self._pipeline is not captured.pipeline:
                return
            self._history.append(tracked)
            self._tracked += 1
            self._latencies.append(time.monotonic() - captured.at_s)
            self._newest_view.put(TrackedView(frame, tracked, captured.at_s))
        if captured.rows is not None:
            captured.rows.put(tracked)
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

    def _bytes_per_s(self, fps: float, with_pictures: bool) -> float:
        frame_bytes = self._settings.row_bytes + (self._settings.picture_bytes if with_pictures else 0)
        return frame_bytes * (fps if fps > 0.0 else 30.0)

    def _write_row(self, sink: SessionSink, item: TrackedFrame | _Note) -> None:
        """In the writing thread, which alone may be held up by a slow disk; looks at the room left now and then."""
        if isinstance(item, _Note):
            sink.add_event(item.time_s, item.kind, item.text)
        else:
            sink.append(item)
        if self._row_count % 30 == 0:
            self._disk_free = _free_bytes(sink.path.parent)
            low = self._disk_free is not None and self._disk_free < self._settings.low_disk_bytes
            if low and not self._disk_warned:
                self._disk_warned = True
                self._tell("disk_low", value=float(self._disk_free or 0))
        self._row_count += 1


def _room_for(frame: Frame | None, most: int) -> int:
    """How many pictures like this one may wait in memory: ``most``, or what the share of the free memory holds."""
    free = free_memory_bytes()
    if frame is None or free is None:
        return most
    frame_bytes = frame.color_rgb.nbytes + (0 if frame.depth_raw is None else frame.depth_raw.nbytes)
    return min(most, max(PREVIEW_WAITING, int(FREE_SHARE * free) // frame_bytes))


def free_memory_bytes() -> int | None:
    """Memory that programs may still take without others being swapped out; None where the system does not tell."""
    with suppress(OSError):
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return 1024 * int(line.split()[1])
    return None


def _free_bytes(folder: Path | None) -> int | None:
    """Room on the disk of a folder, None when unknown."""
    if folder is None:
        return None
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None

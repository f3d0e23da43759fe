"""A running recording of the live session: the session file and, if wanted, the raw recording."""

from __future__ import annotations

import math
import shutil
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Generic, NamedTuple, Protocol, TypeVar

from carpus.core.capture.files.raw import RawWriter
from carpus.core.model.errors import DiskTooSlow
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Frame, TrackedFrame
from carpus.core.pipeline.live_values import LiveEventKind, LiveSettings
from carpus.core.pipeline.queues import BoundedQueue, QueueClosedError, QueueFullError

Item = TypeVar("Item")


class Sink(Protocol):
    """File being written by the recording thread."""

    @property
    def path(self) -> Path:
        """Path of the finished file."""

    def close(self) -> None:
        """Finish the file."""

    def abandon(self) -> None:
        """Stop after a fault; stored data are kept."""

    def discard(self) -> None:
        """Remove the file: nothing was recorded."""


SinkT = TypeVar("SinkT", bound=Sink)


class Recorder(Generic[SinkT, Item]):
    """Opens, fills and closes one sink in its own thread, so that a slow disk blocks nothing else.

    Parameters
    ----------
    write : callable
        Stores one item in the sink.
    capacity : int
        Items that may wait. If more come, :class:`DiskTooSlow` ends the recording: waiting items are still written and
        the file is closed.
    on_fault : callable
        Called once with the exception that ended the recording, from any thread.
    is_blocking : bool
        The producer waits for the disk instead.
    """

    def __init__(
        self,
        name: str,
        open_sink: Callable[[], SinkT],
        write: Callable[[SinkT, Item], None],
        capacity: int,
        on_fault: Callable[[Exception], None],
        *,
        is_blocking: bool = False,
    ) -> None:
        self._open_sink = open_sink
        self._write = write
        self._on_fault = on_fault
        self._queue: BoundedQueue[Item] = BoundedQueue(capacity, is_blocking=is_blocking)
        self._opened = threading.Event()
        self._lock = threading.Lock()
        self.fault: Exception | None = None
        self.path: Path | None = None
        self.write_count = 0
        self._is_discarded = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    @property
    def queue_length(self) -> int:
        return len(self._queue)

    def start(self) -> None:
        """Start the thread and wait until the file is open; raises its fault."""
        self._thread.start()
        self._opened.wait()
        if self.path is None and self.fault is not None:
            self._thread.join()
            raise self.fault

    def submit(self, item: Item) -> bool:
        """Queue one item; return False if the recording has ended."""
        try:
            self._queue.push(item)
        except QueueClosedError:
            return False
        except QueueFullError:
            self._queue.close()
            self._fail(
                DiskTooSlow(self.path or "", phrase("{capacity} rows not yet written", capacity=self._queue.capacity))
            )
            return False
        return True

    def finish(self) -> Path:
        """Wait until all items are stored and the file is closed; raises the fault that ended it early."""
        self._queue.close()
        self._thread.join()
        if self.fault is not None:
            raise self.fault
        assert self.path is not None
        return self.path

    def discard(self) -> None:
        """End a recording that never began and remove its file."""
        self._is_discarded = True
        self._queue.close()
        self._thread.join()

    def _run(self) -> None:
        sink: SinkT | None = None
        try:
            sink = self._open_sink()
            self.path = sink.path
            self._opened.set()
            for item in self._queue:
                self._write(sink, item)
                self.write_count += 1
            if self._is_discarded:
                sink.discard()
            else:
                sink.close()
                self.path = sink.path
        except Exception as cause:  # the one catch at the top of this thread
            self._queue.close()
            if sink is None:
                self.fault = cause  # raised by start()
            else:
                self._fail(cause)
                with suppress(Exception):  # the first fault is the one to tell
                    sink.abandon()
        finally:
            self._opened.set()

    def _fail(self, cause: Exception) -> None:
        with self._lock:
            first = self.fault is None
            if first:
                self.fault = cause
        if first:
            self._on_fault(cause)


_DISK_CHECK_ROWS = 30


class SessionSink(Sink, Protocol):
    """Session file being written."""

    def append(self, tracked: TrackedFrame) -> None: ...

    def add_event(self, time_s: float, kind: str, text: str) -> None: ...

    def prepare(self) -> None:
        """Write all rows to the disk and into the session file; no more come."""


class QueuedEvent(NamedTuple):
    """Event waiting to be stored in the session file."""

    time_s: float
    kind: str
    text: str


class LiveEventHandler(Protocol):
    """Receiver of rare events for the user."""

    def __call__(self, kind: LiveEventKind, cause: Exception | None = None, value: float = math.nan) -> None: ...


class LiveRecording:
    """Session file and raw recording, each opened, filled and closed in a thread of its own.

    ``on_event`` receives the fault that ends one of them early, and once that the disk is nearly full. With
    ``is_blocking`` the producer waits for the disk. ``before_close`` waits for the smoothing, while the writing thread
    writes the rows that are there.
    """

    def __init__(
        self,
        open_session: Callable[[], SessionSink],
        open_frames: Callable[[], RawWriter] | None,
        settings: LiveSettings,
        max_frames_waiting: int,
        on_event: LiveEventHandler,
        *,
        is_blocking: bool,
        before_close: Callable[[], None] = lambda: None,
    ) -> None:
        self.is_paused, self._before_close = False, before_close
        self.first_frame_index: int | None = None
        """Index of the first recorded frame, None until it is captured."""
        self.disk_free_bytes: int | None = None
        """Free space when a row was last written."""
        self._low_disk_bytes, self._on_event, self._has_warned = settings.low_disk_bytes, on_event, False
        self.row_recorder: Recorder[SessionSink, TrackedFrame | QueuedEvent | None] = Recorder(
            "writing",
            open_session,
            self._write_row,
            settings.max_waiting_rows + (0 if is_blocking else settings.max_waiting_frames),
            lambda cause: on_event("recording_failed", cause),
            is_blocking=is_blocking,
        )
        self.frame_recorder: Recorder[RawWriter, Frame] | None = None
        if open_frames is not None:
            self.frame_recorder = Recorder(
                "pictures",
                open_frames,
                lambda sink, frame: sink.append_frame(frame),
                max_frames_waiting,
                lambda cause: on_event("pictures_failed", cause),
                is_blocking=is_blocking,
            )

    def start(self) -> None:
        """Wait until the files are open; if one cannot be opened its fault is raised and none is left."""
        self.row_recorder.start()
        if self.frame_recorder is not None:
            try:
                self.frame_recorder.start()
            except Exception:
                self.row_recorder.discard()
                raise

    def finish(self) -> Path:
        """Wait until all is stored and return the session file; raises the fault that ended it early."""
        if self.row_recorder.fault is None:
            self.row_recorder.submit(None)
            self._before_close()
        try:
            return self.row_recorder.finish()
        finally:
            if self.frame_recorder is not None:
                with suppress(Exception):  # reported as pictures_failed
                    self.frame_recorder.finish()

    def _write_row(self, sink: SessionSink, item: TrackedFrame | QueuedEvent | None) -> None:
        """Write one item (writing thread only); None means no more rows. Checks the free space now and then."""
        if item is None:
            sink.prepare()
        elif isinstance(item, QueuedEvent):
            sink.add_event(item.time_s, item.kind, item.text)
        else:
            sink.append(item)
        if self.row_recorder.write_count % _DISK_CHECK_ROWS == 0:
            free = self.disk_free_bytes = read_free_bytes(sink.path.parent)
            if free is not None and free < self._low_disk_bytes and not self._has_warned:
                self._has_warned = True
                self._on_event("disk_low", value=float(free))


def read_free_bytes(folder: Path | None) -> int | None:
    """Return the free space on the disk of a folder, None if unknown."""
    if folder is None:
        return None
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None

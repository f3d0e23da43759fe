"""A running recording of the live session: the session file and, if wanted, the raw recording."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple, Protocol

from carpus.core.model.types import Frame, TrackedFrame
from carpus.core.pipeline.hand_crop import FrameSink
from carpus.core.pipeline.live_values import LiveEventKind, LiveSettings
from carpus.core.pipeline.recorder import Recorder, Sink

_DISK_CHECK_ROWS = 30


class SessionSink(Sink, Protocol):
    """Session file being written."""

    def append(self, tracked: TrackedFrame) -> None: ...

    def add_event(self, time_s: float, kind: str, text: str) -> None: ...

    def prepare(self) -> None:
        """Write all rows to the disk and into the session file; no more come."""
        ...


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
        open_frames: Callable[[], FrameSink] | None,
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
        self.frame_recorder: Recorder[FrameSink, Frame] | None = None
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
            self.disk_free_bytes = read_free_bytes(sink.path.parent)
            if (
                self.disk_free_bytes is not None
                and self.disk_free_bytes < self._low_disk_bytes
                and not self._has_warned
            ):
                self._has_warned = True
                self._on_event("disk_low", value=float(self.disk_free_bytes))


def read_free_bytes(folder: Path | None) -> int | None:
    """Return the free space on the disk of a folder, None if unknown."""
    if folder is None:
        return None
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None

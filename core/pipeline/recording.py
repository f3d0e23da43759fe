"""A running recording of the live session: its session and, if wanted, its raw pictures."""

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
    """The session file in the making."""

    def append(self, tracked: TrackedFrame) -> None: ...

    def add_event(self, time_s: float, kind: str, text: str) -> None: ...

    def prepare(self) -> None:
        """No more rows come: all to the disk, and into what they become."""
        ...


class QueuedEvent(NamedTuple):
    """An event on its way to the session file."""

    time_s: float
    kind: str
    text: str


class LiveEventHandler(Protocol):
    """Says something rare to the person who measures."""

    def __call__(self, kind: LiveEventKind, cause: Exception | None = None, value: float = math.nan) -> None: ...


class LiveRecording:
    """The session file and the raw pictures, each opened, filled and closed in a thread of its own.

    ``on_event`` hears what ends one of them early, and once that there is little room left. With ``is_blocking``
    whoever puts
    waits for the disk. ``before_close`` waits for what a finished file holds besides, beside the writing thread,
    which writes
    what is there meanwhile.
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
        """Index of the first frame that is recorded, None until it is captured."""
        self.disk_free_bytes: int | None = None
        """Bytes, as last looked at while a row was written."""
        self._low_disk_bytes, self._on_event, self._has_warned = settings.low_disk_bytes, on_event, False
        self.row_recorder: Recorder[SessionSink, TrackedFrame | QueuedEvent | None] = Recorder(
            "writing",
            open_session,
            self._write_row,
            settings.rows_waiting + (0 if is_blocking else settings.tracking_waiting),
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
        """Waits until the files are open. Raises what kept one from opening; then none is left behind."""
        self.row_recorder.start()
        if self.frame_recorder is not None:
            try:
                self.frame_recorder.start()
            except Exception:
                self.row_recorder.discard()
                raise

    def finish(self) -> Path:
        """Waits until all is stored; the session file. Raises the fault that ended it early."""
        if self.row_recorder.fault is None:
            self.row_recorder.submit(None)
            self._before_close()
        try:
            return self.row_recorder.finish()
        finally:
            if self.frame_recorder is not None:
                with suppress(Exception):  # told as pictures_failed
                    self.frame_recorder.finish()

    def _write_row(self, sink: SessionSink, item: TrackedFrame | QueuedEvent | None) -> None:
        """In the writing thread, which alone may be held up by a slow disk; looks at the room left now and then. None:
        no more rows come."""
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
    """Room on the disk of a folder, None when unknown."""
    if folder is None:
        return None
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None

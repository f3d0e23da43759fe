"""A running recording of the live session: its session and, if wanted, its raw pictures."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple, Protocol

from carpus.core.pipeline.around_hand import PictureSink
from carpus.core.pipeline.live_values import LiveEventKind, LiveSettings
from carpus.core.pipeline.recorder import Recorder, Sink
from carpus.core.types import Frame, TrackedFrame

_LOOK_EVERY_ROWS = 30


class SessionSink(Sink, Protocol):
    """The session file in the making."""

    def append(self, tracked: TrackedFrame) -> None: ...

    def add_event(self, time_s: float, kind: str, text: str) -> None: ...

    def prepare(self) -> None:
        """No more rows come: all to the disk, and into what they become."""
        ...


class Note(NamedTuple):
    """An event on its way to the session file."""

    time_s: float
    kind: str
    text: str


class Tell(Protocol):
    """Says something rare to the person who measures."""

    def __call__(self, kind: LiveEventKind, cause: Exception | None = None, value: float = math.nan) -> None: ...


class LiveRecording:
    """The session file and the raw pictures, each opened, filled and closed in a thread of its own.

    ``tell`` hears what ends one of them early, and once that there is little room left. With ``waits`` whoever puts
    waits for the disk. ``at_end`` waits for what a finished file holds besides, beside the writing thread, which writes
    what is there meanwhile.
    """

    def __init__(
        self,
        open_session: Callable[[], SessionSink],
        open_pictures: Callable[[], PictureSink] | None,
        settings: LiveSettings,
        pictures_waiting: int,
        tell: Tell,
        *,
        waits: bool,
        at_end: Callable[[], None] = lambda: None,
    ) -> None:
        self.paused, self._at_end = False, at_end
        self.first_index: int | None = None
        """Index of the first frame that is recorded, None until it is captured."""
        self.disk_free: int | None = None
        """Bytes, as last looked at while a row was written."""
        self._low_disk_bytes, self._tell, self._disk_warned = settings.low_disk_bytes, tell, False
        self.rows: Recorder[SessionSink, TrackedFrame | Note | None] = Recorder(
            "writing",
            open_session,
            self._write_row,
            settings.rows_waiting + (0 if waits else settings.tracking_waiting),
            lambda cause: tell("recording_failed", cause),
            waits=waits,
        )
        self.pictures: Recorder[PictureSink, Frame] | None = None
        if open_pictures is not None:
            self.pictures = Recorder(
                "pictures",
                open_pictures,
                lambda sink, frame: sink.append_frame(frame),
                pictures_waiting,
                lambda cause: tell("pictures_failed", cause),
                waits=waits,
            )

    def start(self) -> None:
        """Waits until the files are open. Raises what kept one from opening; then none is left behind."""
        self.rows.start()
        if self.pictures is not None:
            try:
                self.pictures.start()
            except Exception:
                self.rows.discard()
                raise

    def finish(self) -> Path:
        """Waits until all is stored; the session file. Raises the fault that ended it early."""
        if self.rows.fault is None:
            self.rows.put(None)
            self._at_end()
        try:
            return self.rows.finish()
        finally:
            if self.pictures is not None:
                with suppress(Exception):  # told as pictures_failed
                    self.pictures.finish()

    def _write_row(self, sink: SessionSink, item: TrackedFrame | Note | None) -> None:
        """In the writing thread, which alone may be held up by a slow disk; looks at the room left now and then. None:
        no more rows come."""
        if item is None:
            sink.prepare()
        elif isinstance(item, Note):
            sink.add_event(item.time_s, item.kind, item.text)
        else:
            sink.append(item)
        if self.rows.written % _LOOK_EVERY_ROWS == 0:
            self.disk_free = free_bytes(sink.path.parent)
            if self.disk_free is not None and self.disk_free < self._low_disk_bytes and not self._disk_warned:
                self._disk_warned = True
                self._tell("disk_low", value=float(self.disk_free))


def free_bytes(folder: Path | None) -> int | None:
    """Room on the disk of a folder, None when unknown."""
    if folder is None:
        return None
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None

"""A stored or simulated source played in real time: frames come at their own times, as from a camera."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from dataclasses import replace

from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.types import Frame


class PacedSource:
    """Hands each frame of another source out when its time has come, counted from the first one.

    A frame that is late goes out at once; none is left out. ``speed`` 2 plays twice as fast. :meth:`close` ends a
    wait, so a stop never takes longer than a frame takes to read.
    """

    def __init__(self, source: FrameSource, speed: float = 1.0) -> None:
        if not speed > 0.0:
            raise ValueError("speed must be above 0")
        self._source = source
        self._speed = speed
        self._closed = threading.Event()
        self._playing = threading.Lock()

    @property
    def info(self) -> SourceInfo:
        """Facts of the source behind, at the rate that is played."""
        info = self._source.info
        return replace(info, nominal_fps=info.nominal_fps * self._speed)

    def frames(self) -> Iterator[Frame]:
        """Frames from the first on, each at its time; ends early when closed."""
        try:
            with self._playing:
                started_s: float | None = None
                for frame in self._source.frames():
                    if started_s is None:
                        started_s = time.monotonic() - frame.timestamp_s / self._speed
                    due_s = started_s + frame.timestamp_s / self._speed
                    if self._closed.wait(max(0.0, due_s - time.monotonic())):
                        return
                    yield frame
        finally:
            if self._closed.is_set():
                self._source.close()

    def close(self) -> None:
        """Ends the playing and closes the source behind; may be called twice and from another thread.

        While frames are being read by another thread, that thread closes the source on its way out.
        """
        self._closed.set()
        if self._playing.acquire(blocking=False):
            self._playing.release()
            self._source.close()

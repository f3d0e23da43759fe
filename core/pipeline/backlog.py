"""Frames waiting for the tracker."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from carpus.core.model.types import Frame, TrackedFrame
from carpus.core.pipeline.queues import BlockingQueue, BoundedQueue, QueueClosedError, QueueFullError
from carpus.core.pipeline.recording import LiveRecording

MAX_PREVIEW_WAITING = 16
"""Frames that may wait while nothing is recorded: half a second, so that the preview stays current."""
FOLLOW_INTERVAL_S = 0.08
"""The hand is tracked at least this often: after a second without frames, fingers may be confused."""
MAX_MEMORY_SHARE = 0.5
"""Largest share of the memory free at the start of a recording that waiting frames may use."""

Pipeline = Callable[[Frame], TrackedFrame]


class QueuedFrame(NamedTuple):
    """Frame with the tracker and the recording that were current when it was captured.

    ``recording`` is None if the frame is not recorded.
    """

    frame: Frame
    captured_at_s: float
    pipeline: Pipeline
    recording: LiveRecording | None


class Backlog:
    """Frames waiting for the tracker, in order of capture.

    ``capacity`` recorded frames may wait, of others only those of the last half second. A frame without room is dropped
    and counted in the next one; with ``is_blocking`` the caller waits instead. While a recording is being finished
    (``is_finishing_recording``), new frames are dropped without being counted; once no recorded frame waits, as many
    are tracked as it takes to follow the hand.
    """

    def __init__(self, capacity: int, fps: float, *, is_blocking: bool) -> None:
        self.capacity = capacity
        self.is_finishing_recording = False
        self.dropped_count = 0
        self.is_blocking = is_blocking
        self._queue: BoundedQueue[QueuedFrame] | BlockingQueue[QueuedFrame] = (
            BlockingQueue(min(MAX_PREVIEW_WAITING, capacity)) if is_blocking else BoundedQueue(capacity)
        )
        self._lock = threading.Lock()
        self.submission_count = self._processed_count = self._dropped_before = 0
        self._last_queued_s = -math.inf
        self._processed_at_s: deque[float] = deque(maxlen=math.ceil(2.0 * fps))

    def __len__(self) -> int:
        """Return the number of waiting frames."""
        return len(self._queue)

    def __iter__(self) -> Iterator[QueuedFrame]:
        """Yield each frame to the tracking thread; it counts as processed when the next one is requested."""
        for captured in self._queue:
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
            self._queue.push(queued._replace(frame=frame))
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
        taken = len(self._queue.drain())
        with self._lock:
            self._processed_count += taken
        self._dropped_before = 0

    def close(self) -> None:
        """Accept no more frames; waiting ones are still processed. May be called twice."""
        self._queue.close()


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

"""Frames on their way to the tracker: how many may wait, which are left out, how far the tracker is behind."""

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
"""Pictures that wait for the tracker while nothing is recorded: half a second. What is seen is to be of now."""
FOLLOW_INTERVAL_S = 0.08
"""A hand is followed by a picture in so long: after a second without any, fingers may be taken for one another."""
MAX_MEMORY_SHARE = 0.5
"""No more than this part of the memory that is free when a recording begins is for pictures that wait."""

Pipeline = Callable[[Frame], TrackedFrame]


class QueuedFrame(NamedTuple):
    """A frame on its way to the tracker, and to the recording, that were current when it was captured; ``recording``
    None where it is not recorded."""

    frame: Frame
    captured_at_s: float
    pipeline: Pipeline
    recording: LiveRecording | None


class Backlog:
    """Frames that wait for the tracker, in the order in which they were captured.

    Of what is recorded ``capacity`` may wait. Of what is not only the last half second does. A frame without room is
    left
    out, and counted in the next one. With ``is_blocking`` whoever puts waits instead. A person waits while all that was
    recorded is tracked and stored (``is_finishing_recording``): then what comes is left out, and missed by nobody,
    but for as
    much as it takes to follow the hand, once nothing recorded waits.
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
        self._submission_count = self._processed_count = self._dropped_before = 0
        self._last_queued_s = -math.inf
        self._processed_at_s: deque[float] = deque(maxlen=math.ceil(2.0 * fps))

    def __len__(self) -> int:
        """Frames that wait now."""
        return len(self._queue)

    def __iter__(self) -> Iterator[QueuedFrame]:
        """For the tracker's thread: each frame in turn, worked through when the next one is asked for."""
        for captured in self._queue:
            yield captured
            with self._lock:
                self._processed_count += 1
                self._processed_at_s.append(time.monotonic())

    @property
    def submission_count(self) -> int:
        """Frames handed over or about to be."""
        return self._submission_count

    @property
    def lag_s(self) -> float:
        """How long the tracker takes for what waits, as fast as it has been lately; NaN where it has not been seen."""
        waiting = len(self)
        with self._lock:
            count, work_s = len(self._processed_at_s), math.nan
            if count > 1:
                work_s = self._processed_at_s[-1] - self._processed_at_s[0]
        return waiting * work_s / max(count - 1, 1) if waiting else 0.0

    def has_pending(self, count: int | None = None) -> bool:
        """Whether a frame waits or is worked on, of the first ``count`` handed over."""
        with self._lock:
            return self._processed_count < (
                self._submission_count if count is None else min(count, self._submission_count)
            )

    def announce(self) -> None:
        """A frame is about to be put: who waits until the tracker is through waits for this one too."""
        with self._lock:
            self._submission_count += 1

    def submit(self, queued: QueuedFrame) -> None:
        """Hand over a frame that was expected, or leave it out."""
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
            self._submission_count -= 1

    def is_stale(self, queued: QueuedFrame) -> bool:
        """Whether a frame waited for a recording that has failed: what is seen is to be of now, and the next recording
        to find room."""
        failed = queued.recording is not None and queued.recording.row_recorder.fault is not None
        return failed and not self.is_blocking and len(self) >= MAX_PREVIEW_WAITING

    def clear(self) -> None:
        """Nothing that waits is worked through any more, as another pipeline begins."""
        taken = len(self._queue.drain())
        with self._lock:
            self._processed_count += taken
        self._dropped_before = 0

    def close(self) -> None:
        """No more frames come; those that wait are still worked through. May be called twice."""
        self._queue.close()


def compute_capacity(frame: Frame | None, limit: int) -> int:
    """How many pictures like this one may wait in memory: ``limit``, or what the share of the free memory holds."""
    free = read_free_memory_bytes()
    if frame is None or free is None:
        return limit
    frame_bytes = frame.color_rgb.nbytes + (0 if frame.depth_raw is None else frame.depth_raw.nbytes)
    return min(limit, max(MAX_PREVIEW_WAITING, int(MAX_MEMORY_SHARE * free) // frame_bytes))


def read_free_memory_bytes() -> int | None:
    """Memory that programs may still take without others being swapped out; None where the system does not tell."""
    with suppress(OSError):
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return 1024 * int(line.split()[1])
    return None

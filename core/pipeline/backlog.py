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

from carpus.core.pipeline.channels import ChannelClosed, ChannelFull, NeverDrop, Waits
from carpus.core.pipeline.recording import LiveRecording
from carpus.core.types import Frame, TrackedFrame

PREVIEW_WAITING = 16
"""Pictures that wait for the tracker while nothing is recorded: half a second. What is seen is to be of now."""
FOLLOWS_S = 0.08
"""A hand is followed by a picture in so long: after a second without any, fingers may be taken for one another."""
FREE_SHARE = 0.5
"""No more than this part of the memory that is free when a recording begins is for pictures that wait."""

Pipeline = Callable[[Frame], TrackedFrame]


class Captured(NamedTuple):
    """A frame on its way to the tracker, and to the recording, that were current when it was captured; ``recording``
    None where it is not recorded."""

    frame: Frame
    at_s: float
    pipeline: Pipeline
    recording: LiveRecording | None


class Backlog:
    """Frames that wait for the tracker, in the order in which they were captured.

    Of what is recorded ``room`` may wait. Of what is not only the last half second does. A frame without room is left
    out, and counted in the next one. With ``waits`` whoever puts waits instead. A person waits while all that was
    recorded is tracked and stored (``ends_recording``): then what comes is left out, and missed by nobody, but for as
    much as it takes to follow the hand, once nothing recorded waits.
    """

    def __init__(self, room: int, fps: float, *, waits: bool) -> None:
        self.room = room
        self.ends_recording = False
        self.left_out = 0
        self.waits = waits
        self._channel: NeverDrop[Captured] | Waits[Captured] = (
            Waits(min(PREVIEW_WAITING, room)) if waits else NeverDrop(room)
        )
        self._lock = threading.Lock()
        self._handed = self._worked = self._left_out_before = 0
        self._followed_s = -math.inf
        self._worked_at: deque[float] = deque(maxlen=math.ceil(2.0 * fps))

    def __len__(self) -> int:
        """Frames that wait now."""
        return len(self._channel)

    def __iter__(self) -> Iterator[Captured]:
        """For the tracker's thread: each frame in turn, worked through when the next one is asked for."""
        for captured in self._channel:
            yield captured
            with self._lock:
                self._worked += 1
                self._worked_at.append(time.monotonic())

    @property
    def handed(self) -> int:
        """Frames handed over or about to be."""
        return self._handed

    @property
    def behind_s(self) -> float:
        """How long the tracker takes for what waits, as fast as it has been lately; NaN where it has not been seen."""
        waiting = len(self)
        with self._lock:
            count, work_s = len(self._worked_at), math.nan
            if count > 1:
                work_s = self._worked_at[-1] - self._worked_at[0]
        return waiting * work_s / max(count - 1, 1) if waiting else 0.0

    def is_behind(self, last: int | None = None) -> bool:
        """Whether a frame waits or is worked on, of the first ``last`` handed over."""
        with self._lock:
            return self._worked < (self._handed if last is None else min(last, self._handed))

    def expect(self) -> None:
        """A frame is about to be put: who waits until the tracker is through waits for this one too."""
        with self._lock:
            self._handed += 1

    def put(self, captured: Captured) -> None:
        """Hand over a frame that was expected, or leave it out."""
        frame, room = captured.frame, self.room
        if self._left_out_before:
            frame = replace(frame, dropped_before=frame.dropped_before + self._left_out_before)
        if captured.recording is None and not self.waits:
            room = min(PREVIEW_WAITING, room)
            if self.ends_recording:
                room = int(frame.timestamp_s - self._followed_s >= FOLLOWS_S)
        try:
            if not self.waits and len(self) >= room:
                raise ChannelFull
            self._channel.put(captured._replace(frame=frame))
            self._left_out_before, self._followed_s = 0, frame.timestamp_s
            return
        except ChannelFull:
            if not self.ends_recording:
                self.left_out += 1
                self._left_out_before = frame.dropped_before + 1
        except ChannelClosed:
            pass  # the session ended while a file waited for the tracker
        with self._lock:
            self._handed -= 1

    def is_of_the_past(self, captured: Captured) -> bool:
        """Whether a frame waited for a recording that has failed: what is seen is to be of now, and the next recording
        to find room."""
        failed = captured.recording is not None and captured.recording.rows.fault is not None
        return failed and not self.waits and len(self) >= PREVIEW_WAITING

    def clear(self) -> None:
        """Nothing that waits is worked through any more, as another pipeline begins."""
        taken = len(self._channel.taken())
        with self._lock:
            self._worked += taken
        self._left_out_before = 0

    def close(self) -> None:
        """No more frames come; those that wait are still worked through. May be called twice."""
        self._channel.close()


def room_for(frame: Frame | None, most: int) -> int:
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

"""A stored take played as a camera would send a practice patient: at rest until told to move."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain

from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.types import Frame


class PracticeSource:
    """Frames without end, not paced, times rising by themselves.

    The take begins with a hand that is still for ``still_s``: these pictures come again and again, forwards and
    backwards, until :meth:`let_go`. Then the take is played through once, and the hand rests until let go again.
    """

    def __init__(self, take: FrameSource, still_s: float, others: Sequence[FrameSource] = ()) -> None:
        """``others`` are further takes of the same hand, for :meth:`play_next`; closed with this."""
        self._take, self._others = take, others
        self._still_s = still_s
        self._next: FrameSource | None = None
        self._free = threading.Event()
        self._closed = threading.Event()

    @property
    def info(self) -> SourceInfo:
        """Facts of the take; its number of frames is unknown, as a camera's is."""
        return replace(self._take.info, frame_count=None)

    def let_go(self) -> None:
        """The hand moves once from now on, or goes on if it moves already; may be called from another thread."""
        self._free.set()

    def play_next(self, take: FrameSource) -> None:
        """Another take of the same hand at the same place, from the next :meth:`let_go` on; from another thread."""
        self._next = take

    def frames(self) -> Iterator[Frame]:
        """Frames until :meth:`close`."""
        take = self._take.frames()
        still: list[Frame] = []
        for first_moving in take:
            if still and first_moving.timestamp_s - still[0].timestamp_s > self._still_s:
                break
            still.append(first_moving)
        else:
            first_moving = still[-1]
        period_s = 1.0 / self._take.info.nominal_fps
        clock_s, index = still[0].timestamp_s - period_s, 0

        def timed(frame: Frame, step_s: float) -> Frame:
            nonlocal clock_s, index
            clock_s, index = clock_s + step_s, index + 1
            return replace(frame, index=index - 1, timestamp_s=clock_s)

        rest, last_s = _to_and_fro(still), first_moving.timestamp_s - period_s
        moving: Iterator[Frame] = chain([first_moving], take)
        playing = self._take
        while True:
            while not self._free.is_set():
                yield timed(replace(next(rest), dropped_before=0), period_s)
            following, self._next = self._next, None
            if following is not None:
                moving, last_s = following.frames(), still[0].timestamp_s - period_s
                playing = following
            for frame in moving:
                if self._closed.is_set():
                    return
                yield timed(frame, frame.timestamp_s - last_s)
                last_s = frame.timestamp_s
            self._free.clear()
            if self._closed.is_set():
                return
            moving, last_s = playing.frames(), still[0].timestamp_s - period_s

    def close(self) -> None:
        """End; may be called twice and from another thread."""
        self._closed.set()
        self._free.set()
        for take in (self._take, *self._others):
            take.close()


def _to_and_fro(frames: list[Frame]) -> Iterator[Frame]:
    while True:
        yield from frames
        yield from frames[-2:0:-1]

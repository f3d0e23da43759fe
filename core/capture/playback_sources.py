"""Stored sources played like a camera: in real time, or as a simulated hand that moves on command."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from carpus.core.capture.source import FrameSource, SourceInfo
from carpus.core.model.types import Frame


class PacedSource:
    """Source whose frames are released in real time, counted from the first one.

    A late frame is released at once; none is skipped. ``speed`` 2 plays twice as fast. :meth:`close` ends a wait.
    """

    def __init__(self, source: FrameSource, speed: float = 1.0) -> None:
        self._source = source
        self._speed = speed
        self._closed = threading.Event()
        self._playing = threading.Lock()

    @property
    def info(self) -> SourceInfo:
        """Facts of the source, with the rate at which it is played."""
        info = self._source.info
        return replace(info, nominal_fps=info.nominal_fps * self._speed)

    def frames(self) -> Iterator[Frame]:
        """Yield frames from the first on, each at its time; ends early when closed."""
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
        """End playing and close the source; may be called twice and from another thread.

        While another thread reads frames, that thread closes the source on its way out.
        """
        self._closed.set()
        if self._playing.acquire(blocking=False):
            self._playing.release()
            self._source.close()


class PracticeSource:
    """Endless source of frames of a simulated hand, not paced, with rising times.

    The recording starts with a still hand for ``still_s``: these frames are repeated, forwards and backwards, until
    :meth:`start_movement`. Then the movement is played, and the hand rests until the next start.
    """

    def __init__(
        self, recording: FrameSource, still_s: float, *, is_still_only: bool = False, movement_count: int = 1
    ) -> None:
        """Play a recording whose movement is repeated ``movement_count`` times at each start.

        With ``is_still_only`` the recording is the still hand alone, which rests until :meth:`set_next_recording`.
        """
        self._movement_count = movement_count
        self._recording, self._recordings, self._is_still_only = recording, [recording], is_still_only
        self._still_s = still_s
        self._next_recording: FrameSource | None = None
        self._movement_requested, self._closed, self._can_move = threading.Event(), threading.Event(), threading.Event()
        self.still_hand_shown = threading.Event()
        """Set when every frame of the still hand was released."""
        if not is_still_only:
            self._can_move.set()

    @property
    def can_move(self) -> bool:
        """Whether frames of the next movement are available."""
        return self._can_move.is_set()

    @property
    def is_closed(self) -> bool:
        return self._closed.is_set()

    @property
    def info(self) -> SourceInfo:
        """Facts of the recording; the number of frames is unknown, as for a camera."""
        return replace(self._recording.info, frame_count=None)

    def start_movement(self) -> None:
        """Move the hand once, or continue if it moves already; may be called from another thread."""
        self._movement_requested.set()

    def set_next_recording(self, recording: FrameSource | None) -> None:
        """Set another recording of the same hand and place for the next :meth:`start_movement`.

        None: it is still to come, and the hand rests until then. May be called from another thread.
        """
        self._next_recording = recording
        if recording is None:
            self._can_move.clear()
            return
        self._recordings.append(recording)
        self._can_move.set()

    def frames(self) -> Iterator[Frame]:
        take = self._recording.frames()
        still = [next(take)]
        period_s = 1.0 / self._recording.info.nominal_fps
        clock_s, index = still[0].timestamp_s - period_s, 0
        rest, moving, last_s = self._play_still_hand(take, still), take, clock_s
        if not self._is_still_only:
            first_moving = still[0]
            for first_moving in take:
                if first_moving.timestamp_s - still[0].timestamp_s > self._still_s:
                    break
                still.append(first_moving)
            rest, moving, last_s = (
                _loop_back_and_forth(still),
                chain([first_moving], take),
                first_moving.timestamp_s - period_s,
            )
            self.still_hand_shown.set()

        def retime(frame: Frame, step_s: float) -> Frame:
            nonlocal clock_s, index
            clock_s, index = clock_s + step_s, index + 1
            return replace(frame, index=index - 1, timestamp_s=clock_s)

        playing = self._recording
        while True:
            while not (
                self._movement_requested.is_set() and self._can_move.is_set() and self.still_hand_shown.is_set()
            ):
                yield retime(replace(next(rest), dropped_before=0), period_s)
            following, self._next_recording = self._next_recording, None
            if following is not None:
                moving, last_s = following.frames(), still[0].timestamp_s - period_s
                playing = following
            for _ in range(self._movement_count):
                for frame in moving:
                    if self._closed.is_set():
                        return
                    yield retime(frame, frame.timestamp_s - last_s)
                    last_s = frame.timestamp_s
                moving, last_s = playing.frames(), still[0].timestamp_s - period_s
            self._movement_requested.clear()
            if self._closed.is_set():
                return

    def _play_still_hand(self, take: Iterator[Frame], still: list[Frame]) -> Iterator[Frame]:
        """Yield the frames of the still hand as they come, collected in ``still``, then back and forth."""
        yield still[0]
        for frame in take:
            still.append(frame)
            yield frame
        self.still_hand_shown.set()
        yield from _loop_back_and_forth(still)

    def close(self) -> None:
        """End; may be called twice and from another thread."""
        for event in (self._closed, self._movement_requested, self._can_move, self.still_hand_shown):
            event.set()
        for take in self._recordings:
            take.close()


def _loop_back_and_forth(frames: list[Frame]) -> Iterator[Frame]:
    while True:
        yield from frames
        yield from frames[-2:0:-1]

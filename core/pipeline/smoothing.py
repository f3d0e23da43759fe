"""Smoothing of a session while it is recorded, in chunks, and the process that does it.

In the process that tracks, draws and stores, the smoother would hold the interpreter's lock, and frames would be lost.
"""

from __future__ import annotations

import math
import threading
from bisect import bisect_right
from collections import deque
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from multiprocessing.connection import Connection

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.errors import SmoothingFailed
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray
from carpus.core.platform.child_process import KILL_TIMEOUT_S, ChildProcess, lower_priority
from carpus.core.session.values import Motion, stack_states
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import FilterSteps, Tracker

CHUNK_S, LAG_S = 8.0, 3.0
"""Length of a chunk, and of the data after it that are needed first. In simulated recordings of 40 s this comes as near
to the truth as smoothing the whole, and at a stop at most 11 s are left.
"""


@dataclass(frozen=True, slots=True)
class TrackedHand:
    """Calibration, camera and settings of the tracker whose steps are smoothed."""

    calibration: Calibration
    camera: Camera
    settings: TrackerSettings


@dataclass(frozen=True, slots=True)
class SmoothedChunk:
    """Consecutive smoothed frames: times (n,) and n rows of motion."""

    timestamp_s: FloatArray
    motion: Motion


class ChunkedSmoother:
    """Smoother of a tracker's filter steps in chunks.

    ``chunk_s`` and ``lag_s`` as :data:`CHUNK_S` and :data:`LAG_S`.
    """

    def __init__(self, hand: TrackedHand, chunk_s: float = CHUNK_S, lag_s: float = LAG_S) -> None:
        self._record = Tracker(hand.calibration, hand.camera, hand.settings).record
        self._chunk_s, self._lag_s = chunk_s, lag_s

    def add_steps(self, steps: FilterSteps) -> Sequence[SmoothedChunk]:
        """Add the filter steps of a frame; return the chunk that is complete, if any."""
        record = self._record
        record.append_steps(steps)
        if not record.history:
            return ()
        newest_s = record.history[-1].timestamp_s
        if newest_s - record.history[0].timestamp_s <= self._chunk_s + self._lag_s:
            return ()
        until_s = newest_s - self._lag_s
        chunk = self._smooth_until(until_s)
        record.discard_before(until_s)
        return chunk

    def finish(self) -> Sequence[SmoothedChunk]:
        """Return the remaining frames, smoothed."""
        return self._smooth_until(math.inf)

    def _smooth_until(self, until_s: float) -> Sequence[SmoothedChunk]:
        times_s = np.array([step.timestamp_s for step in self._record.history])
        count = int(np.searchsorted(times_s, until_s))
        moments = self._record.smooth()[:count]
        return (SmoothedChunk(times_s[:count], stack_states(moments)),) if moments else ()


SEND_EVERY_S = 0.5
FRAMES_PER_MESSAGE = 15
"""Pickling their steps holds the interpreter's lock for less than a millisecond."""
MAX_WAITING = 3600
"""Frames (30 MB of steps) that may wait for a slow or stuck process before smoothing fails."""
ANSWER_TIMEOUT_S = 60.0
"""A busy computer may take long to start a process."""
FINISH_TIMEOUT_S = 30.0
"""Time that a finished recording waits for the rest: a second's work for the last 11 s, more on a busy computer."""


class SmoothingProcess:
    """Smooths one recording while it grows, in a process of its own.

    A thread starts the process and talks to it; nothing else waits for either. A failure is raised by :meth:`finish`
    alone.
    """

    def __init__(self, hand: TrackedHand, *, chunk_s: float = CHUNK_S, lag_s: float = LAG_S) -> None:
        self._hand, self._chunk_s, self._lag_s = hand, chunk_s, lag_s
        self._waiting: deque[FilterSteps] = deque()
        self._chunks: deque[SmoothedChunk] = deque()
        self._has_started = False
        self._failure = ""
        self._is_ending = threading.Event()
        self._child: ChildProcess | None = None
        self._thread = threading.Thread(target=self._run, name="looking-back", daemon=True)
        self._thread.start()

    @property
    def pid(self) -> int | None:
        """Process id, None before it runs."""
        return None if self._child is None else self._child.pid

    def add_steps(self, steps: FilterSteps) -> None:
        """Add the filter steps of some frames, in order; never waits and never fails."""
        if len(self._waiting) >= MAX_WAITING:
            self._fail(f"{MAX_WAITING} frames behind")
        if self._failure:
            return
        # The process goes on from its own steps; what was believed of the fingers is large and wanted once.
        self._waiting.append(replace(steps, finger_start=None) if self._has_started else steps)
        self._has_started = True

    def pop_smoothed(self, timestamp_s: Sequence[float]) -> Motion | None:
        """Return the motion of the first of the given frames that are smoothed by now; None if none is.

        What is returned is forgotten; frames that are not asked for are skipped.
        """
        chunks: list[SmoothedChunk] = []
        while self._chunks and timestamp_s and self._chunks[0].timestamp_s[-1] <= timestamp_s[-1]:
            chunks.append(self._chunks.popleft())
        if not chunks:
            return None
        try:
            return _select_motion(chunks, timestamp_s[: bisect_right(timestamp_s, chunks[-1].timestamp_s[-1])])
        except SmoothingFailed as fault:
            self._fail(str(fault.detail))
            return None

    def finish(self, timestamp_s: Sequence[float]) -> Motion | None:
        """Wait for the rest and return the motion at the given times; None for no frames.

        Raises :class:`SmoothingFailed` if it is not complete after :data:`FINISH_TIMEOUT_S`.
        """
        self.join()
        if self._failure:
            raise SmoothingFailed(detail=self._failure)
        return _select_motion(self._chunks, timestamp_s)

    def join(self) -> None:
        """Wait at most :data:`FINISH_TIMEOUT_S` until all steps are smoothed."""
        self._is_ending.set()
        self._thread.join(FINISH_TIMEOUT_S)
        self._abort(f"not done {FINISH_TIMEOUT_S:g} s after the end")

    @property
    def has_results(self) -> bool:
        """Whether there are results that :meth:`pop_smoothed` has not returned yet."""
        return bool(self._chunks)

    def cancel(self) -> None:
        self._is_ending.set()
        self._abort("not wanted")

    def _abort(self, reason: str) -> None:
        if self._thread.is_alive():
            self._fail(reason)
            self._thread.join(KILL_TIMEOUT_S)

    def _fail(self, reason: str) -> None:
        self._failure = self._failure or reason
        self._waiting.clear()
        if self._child is not None:
            self._child.kill()

    # --- the thread ---------------------------------------------------------------------------------------
    def _run(self) -> None:
        try:
            self._child = ChildProcess(run_smoother, self._hand, self._chunk_s, self._lag_s, name="smoothing")
            link = self._child.link
            while not self._is_ending.wait(SEND_EVERY_S):
                while self._waiting and not (self._failure or self._is_ending.is_set()):
                    self._send_steps(link)
            link.send(None)
            while self._waiting and not self._failure:
                self._send_steps(link)
            link.send(None)
            self._receive_chunks(link)
        except (EOFError, BrokenPipeError, ConnectionResetError):
            self._fail("" if self._child is None else self._child.describe_exit())
        except Exception as cause:  # the one catch at the top of this thread
            self._fail(f"{type(cause).__name__}: {cause}")
        finally:
            if self._child is not None:
                self._child.end()

    def _send_steps(self, link: Connection) -> None:
        count = min(len(self._waiting), FRAMES_PER_MESSAGE)
        link.send([self._waiting.popleft() for _ in range(count)])
        self._receive_chunks(link)

    def _receive_chunks(self, link: Connection) -> None:
        if not link.poll(ANSWER_TIMEOUT_S):
            raise TimeoutError(f"no answer for {ANSWER_TIMEOUT_S:g} s")
        answer: list[SmoothedChunk] | str = link.recv()
        if isinstance(answer, str):
            raise RuntimeError(answer)
        self._chunks += answer


def _select_motion(chunks: Iterable[SmoothedChunk], timestamp_s: Sequence[float]) -> Motion | None:
    if not timestamp_s:
        return None
    known_s = np.concatenate([np.empty(0), *(chunk.timestamp_s for chunk in chunks)])
    missing = ~np.isin(timestamp_s, known_s)
    if missing.any():
        raise SmoothingFailed(detail=phrase("{np} frames missing", np=np.count_nonzero(missing)))
    rows = np.searchsorted(known_s, timestamp_s)
    return Motion(
        **{
            field.name: np.concatenate([getattr(chunk.motion, field.name) for chunk in chunks])[rows]
            for field in fields(Motion)
        }
    )


# --- in the child -----------------------------------------------------------------------------------------
def run_smoother(link: Connection, hand: TrackedHand, chunk_s: float, lag_s: float) -> None:
    """Smooth lists of filter steps in the child process.

    Lists come while a recording runs, then at its end the rest; both end with None. After each list the complete chunks
    are sent (often none), after the last None the rest; a text instead is the reason of a failure.
    """
    try:
        chunks = ChunkedSmoother(hand, chunk_s, lag_s)
        with ThreadPoolExecutor(1, initializer=lower_priority) as meanwhile:
            meanwhile.submit(_answer_steps, link, chunks).result()
        _answer_steps(link, chunks)  # a person waits now: this thread has normal priority
        link.send(chunks.finish())
    except Exception as cause:  # reported to the owner, not printed
        with suppress(OSError):  # the owner may have died, which may be the cause
            link.send(f"{type(cause).__name__}: {cause}")


def _answer_steps(link: Connection, smoother: ChunkedSmoother) -> None:
    """Answer lists of steps until None comes."""
    for frames in iter(link.recv, None):
        link.send([chunk for steps in frames for chunk in smoother.add_steps(steps)])

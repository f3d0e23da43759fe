"""Looking back at a session while it grows, piece by piece, so that neither memory nor the end grow with it; and the
owner's end of the process that does it, which is handed the steps.

In the process that tracks, draws and stores it would hold the interpreter's lock, and frames would be lost.
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
from carpus.core.camera import Camera
from carpus.core.child_process import KILLED_S, ChildProcess, lower_priority
from carpus.core.errors import NotLookedBack
from carpus.core.phrase import phrase
from carpus.core.session.values import Motion, motion_of
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.smoother_record import KeptSteps
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import FloatArray

PIECE_S, LAG_S = 8.0, 3.0
"""So much is looked back at in one go, once so much that follows is known. In simulated recordings of 40 s that comes
as near to the truth as looking back at all of it, and a stop finds 11 s at most still to be looked back at."""


@dataclass(frozen=True, slots=True)
class TrackedHand:
    """What the tracker whose steps are looked back at was made of."""

    calibration: Calibration
    camera: Camera
    settings: TrackerSettings


@dataclass(frozen=True, slots=True)
class Piece:
    """Frames in a row, looked back at: times (n,) and n rows of motion."""

    timestamp_s: FloatArray
    motion: Motion


class PieceByPiece:
    """Takes the steps of a tracker in order and gives them back, looked back at.

    ``piece_s`` and ``lag_s`` as :data:`PIECE_S` and :data:`LAG_S`.
    """

    def __init__(self, hand: TrackedHand, piece_s: float = PIECE_S, lag_s: float = LAG_S) -> None:
        self._record = Tracker(hand.calibration, hand.camera, hand.settings).record
        self._piece_s, self._lag_s = piece_s, lag_s

    def take(self, kept: KeptSteps) -> Sequence[Piece]:
        """Take the steps of a frame; the piece that is due, if any."""
        record = self._record
        record.take_over(kept)
        if not record.history:
            return ()
        newest_s = record.history[-1].timestamp_s
        if newest_s - record.history[0].timestamp_s <= self._piece_s + self._lag_s:
            return ()
        until_s = newest_s - self._lag_s
        piece = self._looked_back(until_s)
        record.forget(until_s)
        return piece

    def rest(self) -> Sequence[Piece]:
        """All that is left, at the end."""
        return self._looked_back(math.inf)

    def _looked_back(self, until_s: float) -> Sequence[Piece]:
        times_s = np.array([step.timestamp_s for step in self._record.history])
        count = int(np.searchsorted(times_s, until_s))
        moments = self._record.smoothed()[:count]
        return (Piece(times_s[:count], motion_of(moments)),) if moments else ()


SEND_EVERY_S = 0.5
FRAMES_AT_ONCE = 15
"""To pack their steps holds the interpreter's lock for less than a millisecond."""
MOST_WAITING = 3600
"""Frames (30 MB of steps) that may wait for a process that is slow or stuck, before it is given up."""
ANSWER_S = 60.0
"""A loaded computer may take long to start a process."""
END_S = 30.0
"""A finished recording waits so long for what is left to look back at: the last 11 s, a second's work, or more where a
busy computer is behind."""


class LookingBack:
    """Looks back at one recording while it grows, in a process of its own.

    A thread starts the process and talks to it; nobody else waits for either. Whatever goes wrong there is told by
    :meth:`finish` alone.
    """

    def __init__(self, hand: TrackedHand, *, piece_s: float = PIECE_S, lag_s: float = LAG_S) -> None:
        self._hand, self._piece_s, self._lag_s = hand, piece_s, lag_s
        self._waiting: deque[KeptSteps] = deque()
        self._pieces: deque[Piece] = deque()
        self._begun = False
        self._trouble = ""
        self._ending = threading.Event()
        self._child: ChildProcess | None = None
        self._thread = threading.Thread(target=self._run, name="looking-back", daemon=True)
        self._thread.start()

    @property
    def pid(self) -> int | None:
        """The process's number, None before it runs."""
        return None if self._child is None else self._child.pid

    def take(self, kept: KeptSteps) -> None:
        """Take the steps of some frames, in order; never waits and never fails."""
        if len(self._waiting) >= MOST_WAITING:
            self._give_up(f"{MOST_WAITING} frames behind")
        if self._trouble:
            return
        # The process goes on from its own steps; what was believed of the fingers is large and wanted once.
        self._waiting.append(replace(kept, finger_start=None) if self._begun else kept)
        self._begun = True

    def ready(self, timestamp_s: Sequence[float]) -> Motion | None:
        """The motion at some frames' times, in order, as far as it is known by now: rows for the first of them, None
        for none yet. What is given here is forgotten; frames that are not asked for are left out."""
        pieces: list[Piece] = []
        while self._pieces and timestamp_s and self._pieces[0].timestamp_s[-1] <= timestamp_s[-1]:
            pieces.append(self._pieces.popleft())
        if not pieces:
            return None
        try:
            return _motion_at(pieces, timestamp_s[: bisect_right(timestamp_s, pieces[-1].timestamp_s[-1])])
        except NotLookedBack as fault:
            self._give_up(str(fault.detail))
            return None

    def finish(self, timestamp_s: Sequence[float]) -> Motion | None:
        """The motion at the times of all frames that :meth:`ready` has not given, in order; waits for what is left.
        None for no frames.

        Raises :class:`NotLookedBack` where it is not all there after :data:`END_S`.
        """
        self.wait()
        if self._trouble:
            raise NotLookedBack(detail=self._trouble)
        return _motion_at(self._pieces, timestamp_s)

    def wait(self) -> None:
        """Until all that was taken is looked back at, :data:`END_S` at most; then it is given up."""
        self._ending.set()
        self._thread.join(END_S)
        self._end(f"not done {END_S:g} s after the end")

    @property
    def has_more(self) -> bool:
        """Whether something came that :meth:`ready` has not given yet."""
        return bool(self._pieces)

    def cancel(self) -> None:
        self._ending.set()
        self._end("not wanted")

    def _end(self, why: str) -> None:
        if self._thread.is_alive():
            self._give_up(why)
            self._thread.join(KILLED_S)

    def _give_up(self, why: str) -> None:
        self._trouble = self._trouble or why
        self._waiting.clear()
        self._kill()

    def _kill(self) -> None:
        if self._child is not None:
            self._child.kill()

    # --- the thread ---------------------------------------------------------------------------------------
    def _run(self) -> None:
        try:
            self._child = ChildProcess(look_back, self._hand, self._piece_s, self._lag_s, name="smoothing")
            self._talk(self._child.link)
        except (EOFError, BrokenPipeError, ConnectionResetError):
            self._give_up("" if self._child is None else self._child.describe_death())
        except Exception as cause:  # the one catch at the top of this thread
            self._give_up(f"{type(cause).__name__}: {cause}")
        finally:
            if self._child is not None:
                self._child.end()

    def _talk(self, link: Connection) -> None:
        while not self._ending.wait(SEND_EVERY_S):
            while self._waiting and not (self._trouble or self._ending.is_set()):
                self._hand_on(link)
        link.send(None)
        while self._waiting and not self._trouble:
            self._hand_on(link)
        link.send(None)
        self._hear(link)

    def _hand_on(self, link: Connection) -> None:
        count = min(len(self._waiting), FRAMES_AT_ONCE)
        link.send([self._waiting.popleft() for _ in range(count)])
        self._hear(link)

    def _hear(self, link: Connection) -> None:
        if not link.poll(ANSWER_S):
            raise TimeoutError(f"no answer for {ANSWER_S:g} s")
        answer: list[Piece] | str = link.recv()
        if isinstance(answer, str):
            raise RuntimeError(answer)
        self._pieces += answer


def _motion_at(pieces: Iterable[Piece], timestamp_s: Sequence[float]) -> Motion | None:
    if not timestamp_s:
        return None
    known_s = np.concatenate([np.empty(0), *(piece.timestamp_s for piece in pieces)])
    missing = ~np.isin(timestamp_s, known_s)
    if missing.any():
        raise NotLookedBack(detail=phrase("{np} frames missing", np=np.count_nonzero(missing)))
    rows = np.searchsorted(known_s, timestamp_s)
    return Motion(
        **{
            field.name: np.concatenate([getattr(piece.motion, field.name) for piece in pieces])[rows]
            for field in fields(Motion)
        }
    )


# --- in the child -----------------------------------------------------------------------------------------
def look_back(link: Connection, hand: TrackedHand, piece_s: float, lag_s: float) -> None:
    """Look back at lists of steps, as often as they come while a recording runs, then at those that are left.

    Both end with None. After each list the pieces that came due are sent (often none), after the last None the rest; a
    text in their place says why it cannot go on.
    """
    try:
        pieces = PieceByPiece(hand, piece_s, lag_s)
        with ThreadPoolExecutor(1, initializer=lower_priority) as meanwhile:
            meanwhile.submit(_take, link, pieces).result()
        _take(link, pieces)  # somebody waits now: this thread gives way to nobody
        link.send(pieces.rest())
    except Exception as cause:  # the one catch of this process: told, not printed
        with suppress(OSError):  # the owner may be gone, which may be the cause
            link.send(f"{type(cause).__name__}: {cause}")


def _take(link: Connection, pieces: PieceByPiece) -> None:
    """Answer lists of steps until None comes."""
    for frames in iter(link.recv, None):
        link.send([piece for kept in frames for piece in pieces.take(kept)])

"""Looking back at a session while it grows, piece by piece, so that neither memory nor the end grow with it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
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

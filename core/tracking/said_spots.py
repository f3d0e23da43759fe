"""Spots of which a person has said something while measuring.

A spot is followed from picture to picture, so that what was said of it goes on holding while it moves, and for a while
after it went out of sight.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from carpus.core.types import BoolArray, FloatArray

STEP_PX = 8.0
"""A spot is followed from picture to picture no further than this."""
BACK_WITHIN_PX = 12.0
"""So near to where it was, in the picture or beside its marker, a spot that comes back is the same."""
HOLDS_S = 60.0
"""For so long a spot that is no disc stays one: then it is asked about again, if there is still something to ask."""
KEPT_PICTURES = 60


class RecentSpots:
    """The spots of the last pictures: what was said of one, a moment ago, is found in the newest."""

    def __init__(self) -> None:
        self._pictures: deque[tuple[int, FloatArray]] = deque(maxlen=KEPT_PICTURES)

    def keep(self, index: int, pixel: FloatArray) -> None:
        """Remember the spots (D, 2) of a picture."""
        self._pictures.append((index, pixel))

    def now_px(self, index: int, place_px: FloatArray) -> FloatArray | None:
        """Where the spot that lay at ``place_px`` (2,) in picture ``index`` lies in the newest; None when lost."""
        place = np.asarray(place_px, dtype=np.float64)
        for number, pixel in self._pictures:
            if number < index or not len(pixel):
                continue
            away = np.linalg.norm(pixel - place, axis=1)
            if away.min() <= STEP_PX:
                place = pixel[int(away.argmin())]
        return place if len(self._pictures) and len(self._pictures[-1][1]) and self._is_seen(place) else None

    def _is_seen(self, place: FloatArray) -> bool:
        return bool(np.linalg.norm(self._pictures[-1][1] - place, axis=1).min() < 1e-6)


class NoDisc:
    """A spot that a person said is not a marker, row ``marker`` of the protocol."""

    def __init__(self, marker: int, place_px: FloatArray, beside_px: FloatArray, time_s: float) -> None:
        self.marker = marker
        self._place_px, self._beside_px, self._said_s = place_px, beside_px, time_s
        self._was_seen = True

    def holds(self, time_s: float) -> bool:
        """Whether what was said of it still counts."""
        return time_s - self._said_s <= HOLDS_S

    def find(self, pixel: FloatArray, expected_px: FloatArray, held: BoolArray) -> int:
        """Which of the spots (D, 2) it is, -1 for none. ``expected_px`` (M, 2) where the markers should be; those
        ``held`` (M,) a moment ago keep the spots that are nearer to them."""
        if not len(pixel):
            self._was_seen = False
            return -1
        marker_px = expected_px[self.marker]
        guesses = [self._place_px] if self._was_seen else [self._place_px, marker_px + self._beside_px]
        reach_px = STEP_PX if self._was_seen else BACK_WITHIN_PX
        away = np.min([np.linalg.norm(pixel - guess, axis=1) for guess in guesses if np.isfinite(guess).all()], axis=0)
        claims = expected_px[held & np.isfinite(expected_px).all(axis=1)]
        if len(claims):
            claimed = np.linalg.norm(pixel[:, None] - claims[None], axis=-1).min(axis=1)
            away = np.where(claimed < away, math.inf, away)
        best = int(away.argmin())
        self._was_seen = bool(away[best] <= reach_px)
        if not self._was_seen:
            return -1
        self._place_px = pixel[best]
        if np.isfinite(marker_px).all():
            self._beside_px = self._place_px - marker_px
        return best

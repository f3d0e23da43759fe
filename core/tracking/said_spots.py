"""Spots of which a person has said something while measuring.

A spot is followed from picture to picture, so that what was said of it goes on holding while it moves, and for a while
after it went out of sight.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from carpus.core.types import BoolArray, FloatArray


@dataclass(frozen=True, slots=True)
class SaidSettings:
    """What becomes of what a person says of spots.

    A spot is followed from picture to picture no further than ``step_px``; so near as ``back_within_px`` to where it
    was, in the picture or beside its marker, one that comes back is the same. One that is no disc stays so for
    ``holds_s``: then it is asked about again, if there is still something to ask. ``kept_pictures`` in which a spot
    that was spoken of is looked for; what was said waits ``answer_holds_s`` for a picture that shows it. A disc shown
    elsewhere may be as far as ``anywhere_m`` from where the one picture shows it: more than any depth errs.
    """

    step_px: float = 8.0
    back_within_px: float = 12.0
    holds_s: float = 60.0
    kept_pictures: int = 60
    answer_holds_s: float = 0.5
    anywhere_m: float = 0.02


class RecentSpots:
    """The spots of the last pictures: what was said of one, a moment ago, is found in the newest."""

    def __init__(self, settings: SaidSettings) -> None:
        self._step_px = settings.step_px
        self._pictures: deque[tuple[int, FloatArray]] = deque(maxlen=settings.kept_pictures)

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
            if away.min() <= self._step_px:
                place = pixel[int(away.argmin())]
        return place if len(self._pictures) and len(self._pictures[-1][1]) and self._is_seen(place) else None

    def _is_seen(self, place: FloatArray) -> bool:
        return bool(np.linalg.norm(self._pictures[-1][1] - place, axis=1).min() < 1e-6)


class NoDisc:
    """A spot that a person said is not a marker, row ``marker`` of the protocol."""

    def __init__(
        self, marker: int, place_px: FloatArray, beside_px: FloatArray, time_s: float, settings: SaidSettings
    ) -> None:
        self.marker, self._settings = marker, settings
        self._place_px, self._beside_px, self._said_s = place_px, beside_px, time_s
        self._was_seen = True

    def holds(self, time_s: float) -> bool:
        """Whether what was said of it still counts."""
        return time_s - self._said_s <= self._settings.holds_s

    def find(self, pixel: FloatArray, expected_px: FloatArray, held: BoolArray) -> int:
        """Which of the spots (D, 2) it is, -1 for none. ``expected_px`` (M, 2) where the markers should be; those
        ``held`` (M,) a moment ago keep the spots that are nearer to them."""
        if not len(pixel):
            self._was_seen = False
            return -1
        marker_px = expected_px[self.marker]
        guesses = [self._place_px] if self._was_seen else [self._place_px, marker_px + self._beside_px]
        reach_px = self._settings.step_px if self._was_seen else self._settings.back_within_px
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

"""A session's rows on evenly spaced times, for formats that know no other: nothing is made up across a gap."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.session.values import Session
from carpus.core.types import FloatArray

USUAL_RATE_HZ = 30.0
NEAR_WHOLE = 0.01
"""A rate as near to a whole number is that number: cameras keep theirs, their time stamps waver."""
LONGEST_STEP = 1.75
"""In steps of the rate: what lies between two rows that are further apart was not recorded."""
OWN_STEP = 0.5
"""In steps of the rate: a picture stands for the even time that is nearest to its own."""
SAME_TIME = 1e-3
"""In steps of the rate: as near to a row, a time is that row's."""


@dataclass(frozen=True, slots=True)
class EvenTimes:
    """K times ``start_s + k / rate_hz``. ``before`` and ``after`` (K,) rows they lie between, -1 in a gap; ``share``
    (K,) of the way from one to the other."""

    start_s: float
    rate_hz: float
    before: np.ndarray
    after: np.ndarray
    share: FloatArray

    def __len__(self) -> int:
        return len(self.share)

    @property
    def since_start_s(self) -> FloatArray:
        """The times (K,) after the first frame."""
        return np.arange(len(self)) / self.rate_hz

    @property
    def nearest(self) -> np.ndarray:
        """The row (K,) that a value which cannot be averaged is taken from, -1 in a gap."""
        return np.where(self.share <= 0.5, self.before, self.after)

    def of(self, values: FloatArray, angular: bool = False) -> FloatArray:
        """``values`` (N, ...) at the times (K, ...), on the straight line between two rows, or the nearest where
        the other is not known; NaN in a gap. ``angular`` takes the short way round the circle, radians."""
        if not len(values):
            return np.full((len(self), *values.shape[1:]), np.nan)
        first, second = values[self.before], values[self.after]
        step = np.where((self.before == self.after).reshape(-1, *(1,) * (values.ndim - 1)), 0.0, second - first)
        if angular:
            step = np.remainder(step + math.pi, 2.0 * math.pi) - math.pi
        share = self.share.reshape(-1, *(1,) * (values.ndim - 1))
        out = first + share * step
        # Where the row further away is lost: the nearest row's, which is not half a step away.
        out = np.where(np.isfinite(out), out, np.where(share > 0.5, second, first))
        out[self.before < 0] = np.nan
        return np.asarray(out, dtype=np.float64)


def rate_of(session: Session) -> float:
    """Frames a second of the camera, those that are missing counted."""
    count = len(session)
    if count < 2:
        return USUAL_RATE_HZ
    steps = count - 1 + int(np.maximum(session.quality.dropped_before[1:], 0).sum())
    rate = steps / float(session.timestamp_s[-1] - session.timestamp_s[0])
    whole = round(rate)
    return float(whole) if whole and abs(rate - whole) <= NEAR_WHOLE * whole else rate


def even_times(timestamp_s: FloatArray, rate_hz: float) -> EvenTimes:
    """From the first to the last of strictly rising times (N,).

    Time stamps waver about the camera's even ones, so the even times are laid through their middle: a recording
    without gaps has as many of them as pictures. The outermost may lie up to half a step outside.
    """
    count = len(timestamp_s)
    if not count:
        none = np.empty(0, dtype=np.int64)
        return EvenTimes(math.nan, rate_hz, none, none, np.empty(0))
    start_s = float(timestamp_s[0])
    place = (timestamp_s - start_s) * rate_hz  # in steps, so that nothing is lost of times that count from 1970
    middle = float(np.median(place - np.rint(place)))
    wanted = middle + np.arange(math.floor(place[-1] - middle + 0.5) + 1, dtype=np.float64)
    start_s += middle / rate_hz
    if count == 1:
        none = np.zeros(1, dtype=np.int64)
        return EvenTimes(start_s, rate_hz, none, none, np.zeros(1))
    after = np.clip(np.searchsorted(place, wanted - SAME_TIME), 1, count - 1)
    before = after - 1
    for row in (before, after):  # a time on a row is that row's, whatever lies beside it
        on_row = np.abs(place[row] - wanted) <= SAME_TIME
        before, after = np.where(on_row, row, before), np.where(on_row, row, after)
    span = np.where(before == after, 1.0, place[after] - place[before])
    share = np.where(before == after, 0.0, (wanted - place[before]) / span)
    gap = (span > LONGEST_STEP) & (share >= 0.0) & (share <= 1.0)
    # At the edges of a gap a time that is some row's own, up to how the stamps waver, has that row: it was recorded.
    leaving, coming = gap & (share * span <= OWN_STEP), gap & ((1.0 - share) * span <= OWN_STEP)
    after, before = np.where(leaving, before, after), np.where(coming, after, before)
    missing = gap & ~leaving & ~coming
    share = np.where(leaving | coming, 0.0, share)
    return EvenTimes(start_s, rate_hz, np.where(missing, -1, before), np.where(missing, -1, after), share)

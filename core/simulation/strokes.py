"""Minimum-jerk strokes: how a person moves from one posture to the next."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.types import FloatArray


def minimum_jerk(share: FloatArray) -> FloatArray:
    """Share of the way covered after a share of the time, both 0 to 1 (Flash and Hogan 1985).

    >>> float(minimum_jerk(np.array(0.5)))
    0.5
    """
    s = np.clip(share, 0.0, 1.0)
    return np.asarray(s * s * s * (10.0 + s * (6.0 * s - 15.0)))


@dataclass(frozen=True, slots=True)
class StrokePath:
    """Postures ``value`` (K, C) reached at ``time_s`` (K,), strictly rising, joined by minimum-jerk strokes.

    Two equal postures in a row are a hold; before the first and after the last the posture stays.
    """

    time_s: FloatArray
    value: FloatArray

    def at(self, time_s: FloatArray) -> FloatArray:
        """Posture (N, C) at times (N,)."""
        if len(self.time_s) == 1:
            return np.repeat(self.value, len(time_s), axis=0)
        k = np.clip(np.searchsorted(self.time_s, time_s, side="right") - 1, 0, len(self.time_s) - 2)
        share = (time_s - self.time_s[k]) / (self.time_s[k + 1] - self.time_s[k])
        return np.asarray(self.value[k] + minimum_jerk(share)[:, None] * (self.value[k + 1] - self.value[k]))


class StrokeWriter:
    """Builds a :class:`StrokePath` stroke by stroke from a starting posture (C,)."""

    def __init__(self, start: FloatArray, still_s: float) -> None:
        self._time_s = [0.0, still_s]
        self._value = [start, start]

    @property
    def time_s(self) -> float:
        """End of the last stroke."""
        return self._time_s[-1]

    @property
    def posture(self) -> FloatArray:
        """Posture at the end of the last stroke."""
        return self._value[-1]

    def move(self, target: FloatArray, duration_s: float) -> None:
        """One stroke to a posture (C,)."""
        self._time_s.append(self.time_s + max(duration_s, 1e-3))
        self._value.append(np.asarray(target, dtype=np.float64))

    def hold(self, duration_s: float) -> None:
        """Stay."""
        if duration_s > 0.0:
            self.move(self.posture, duration_s)

    def path(self) -> StrokePath:
        return StrokePath(np.array(self._time_s), np.array(self._value))

"""How a recording begins with no hand at the keyboard: counted down after the key, or by itself over a still hand."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from carpus.core.types import FloatArray

COUNT_S = 3.0
STILL_S, STILL_DEG = 1.5, 4.0
"""A hand lies still whose angles have stayed within this for so long: less than the smallest movement, more than the
tracker's noise."""
TWITCH_DEG = 2.0 * STILL_DEG
"""A hand that goes so far while it is counted down does not lie still any more."""


class Beginning:
    """``waits`` for a hand that lies still, or counts down; all by the time of the pictures, in seconds."""

    def __init__(self) -> None:
        self.waits = False
        self._begins_s = math.nan
        self._watches = False
        self._lately: deque[tuple[float, FloatArray]] = deque()

    def stop(self) -> None:
        """Neither waits nor counts."""
        self.waits, self._begins_s = False, math.nan
        self._lately.clear()

    def wait(self) -> None:
        """From now on wait for a hand that lies still."""
        self.stop()
        self.waits = True

    def count(self, now_s: float) -> None:
        """Count down from now, whatever the hand does."""
        self.stop()
        self._begins_s, self._watches = now_s + COUNT_S, False

    @property
    def counts(self) -> bool:
        """Whether it is counted down."""
        return math.isfinite(self._begins_s)

    def left_s(self, now_s: float) -> int:
        """Whole seconds that are still counted, 0 where nothing is."""
        return max(1, math.ceil(self._begins_s - now_s)) if self.counts else 0

    def take(self, angles_deg: FloatArray | None, now_s: float) -> bool:
        """One look at the hand, its angles or None where it is not surely seen; whether the recording begins now.

        Angles that are not known (NaN) are not looked at.
        """
        if self.counts and not self._watches:
            begins = now_s >= self._begins_s
        elif self.waits or self.counts:
            moved_deg = self._moved_deg(angles_deg, now_s)
            if self.counts and not moved_deg <= TWITCH_DEG:
                self.wait()
            elif self.waits and moved_deg <= STILL_DEG and now_s - self._lately[0][0] >= 0.9 * STILL_S:
                self.waits, self._begins_s, self._watches = False, now_s + COUNT_S, True
            begins = self.counts and now_s >= self._begins_s
        else:
            return False
        if begins:
            self.stop()
        return begins

    def _moved_deg(self, angles_deg: FloatArray | None, now_s: float) -> float:
        """By how much the angles differed lately; infinite where the hand was not seen."""
        if angles_deg is None or not np.isfinite(angles_deg).any():
            self._lately.clear()
            return math.inf
        self._lately.append((now_s, angles_deg))
        while now_s - self._lately[0][0] > STILL_S:
            self._lately.popleft()
        seen = np.array([angles for _, angles in self._lately])
        return float(np.nanmax(seen.max(axis=0) - seen.min(axis=0)))

"""Ways made of minimum-jerk sub-movements and pauses."""

from __future__ import annotations

import numpy as np

from carpus.core.model.types import FloatArray

RATE = 30.0
Part = tuple[float, float]
"""Degrees and seconds of one sub-movement; nought degrees are a pause."""


def way(parts: list[Part]) -> FloatArray:
    """Minimum-jerk sub-movements one after the other, degrees, without the end."""
    out, at = [], 0.0
    for arc, duration_s in parts:
        tau = np.arange(round(duration_s * RATE)) / round(duration_s * RATE)
        out.append(at + arc * (10 * tau**3 - 15 * tau**4 + 6 * tau**5))
        at += arc
    return np.concatenate(out)


def make_repetitions(parts: list[Part], hold_s: float = 1.0) -> FloatArray:
    """A repetition between two holds, radians."""
    arc, hold = sum(part[0] for part in parts), np.ones(round(hold_s * RATE))
    out = way(parts)
    return np.radians(np.concatenate((0.0 * hold, out, arc * hold, (arc - out), 0.0 * hold)))

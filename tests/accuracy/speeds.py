"""Peak speeds of single strokes, true and tracked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray
from carpus.core.session.values import Motion
from carpus.core.simulation.truth import Truth

_MOVING_SHARE = 0.2
"""A stroke lasts while the speed is above this share of the recording's highest."""
_LEAST_TURNING_RAD_S, _LEAST_MOVING_M_S = 0.5, 0.2
_LEAST_FRAMES = 5


@dataclass(frozen=True, slots=True)
class StrokeSpeeds:
    """Relative errors of each stroke's peak angular (S,) and linear (L,) speed as seen looking back."""

    turning: FloatArray
    moving: FloatArray


def stroke_speeds(truth: Truth, scored: NDArray[np.bool_], smoothed: Motion) -> StrokeSpeeds:
    """Errors of all strokes of a recording's scored frames (N,)."""
    return StrokeSpeeds(
        _errors(truth.angular_velocity_rad_s, smoothed.angular_velocity_rad_s, scored, _LEAST_TURNING_RAD_S),
        _errors(truth.velocity_m_s, smoothed.velocity_m_s, scored, _LEAST_MOVING_M_S),
    )


def _errors(true: FloatArray, found: FloatArray, scored: NDArray[np.bool_], least: float) -> FloatArray:
    true_speed, speed = np.linalg.norm(true, axis=1), np.linalg.norm(found, axis=1)
    highest = true_speed.max(where=scored, initial=0.0)
    moving = (true_speed > max(_MOVING_SHARE * highest, 0.5 * least)) & scored
    edges = np.flatnonzero(np.diff(np.concatenate(([False], moving, [False])).astype(np.int8)))
    out = []
    for begin, end in edges.reshape(-1, 2):
        peak = true_speed[begin:end].max()
        # A stroke cut off by the ends of what is scored has no peak of its own.
        whole = begin > 0 and end < len(moving) and scored[begin - 1] and scored[end]
        if whole and end - begin >= _LEAST_FRAMES and peak >= least and np.isfinite(speed[begin:end]).all():
            out.append(speed[begin:end].max() / peak - 1.0)
    return np.array(out)

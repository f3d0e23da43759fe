"""Looking back: every frame's belief in the light of all that came after (unscented RTS, linear prediction).

Rauch, Tung and Striebel's recursion on the tangent space of the filter's state. Where the track was lost and
begun anew the two stretches are smoothed each by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.tracking.motion import MotionNoise, predict, transition
from core.tracking.state import Belief, StateLayout


@dataclass(frozen=True, slots=True)
class FilterStep:
    """One step of the filter: the corrected belief (None when lost), how it was predicted, when.

    ``noise_scale`` of the process noise that led to it; ``linked`` False where the track began anew.
    """

    timestamp_s: float
    belief: Belief | None
    noise_scale: float
    linked: bool


def smooth(steps: Sequence[FilterStep], noise: MotionNoise, layout: StateLayout) -> list[Belief | None]:
    """Smoothed belief of every step; None where the hand was lost."""
    out: list[Belief | None] = [step.belief for step in steps]
    for k in range(len(steps) - 2, -1, -1):
        now, later, after = steps[k].belief, out[k + 1], steps[k + 1]
        dt_s = after.timestamp_s - steps[k].timestamp_s
        if now is None or later is None or not after.linked or dt_s <= 0.0:
            continue
        forward = transition(now, dt_s, layout)
        predicted = predict(now, noise.scaled(after.noise_scale), dt_s, layout)
        gain = np.linalg.solve(predicted.covariance, forward @ now.covariance).T
        error = gain @ predicted.error_to(later, layout)
        covariance = now.covariance + gain @ (later.covariance - predicted.covariance) @ gain.T
        out[k] = now.moved(error, layout, 0.5 * (covariance + covariance.T))
    return out

"""Looking back at the palm: every frame's belief in the light of all that came after (linear prediction).

Rauch, Tung and Striebel's recursion on the tangent space of the filter's state. Where the track was lost and
begun anew the two stretches are smoothed each by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.tracking.kernel import looked_back
from carpus.core.tracking.motion import PalmMotion, palm_step
from carpus.core.tracking.palm_state import PalmBelief
from carpus.core.types import FloatArray


@dataclass(frozen=True, slots=True)
class FilterStep:
    """One step of the filter: the corrected belief (None when lost), how it was predicted, when.

    ``noise_scale`` of the process noise that led to it; ``linked`` False where the track began anew; ``unseen`` (3, 3)
    turns that nothing had shown before the step.
    """

    timestamp_s: float
    belief: PalmBelief | None
    noise_scale: float
    linked: bool
    unseen: FloatArray | None = None


def smooth(steps: Sequence[FilterStep], motion: PalmMotion) -> list[PalmBelief | None]:
    """Smoothed belief of every step; None where the hand was lost."""
    out: list[PalmBelief | None] = [step.belief for step in steps]
    for k in range(len(steps) - 2, -1, -1):
        now, later, after = steps[k].belief, out[k + 1], steps[k + 1]
        dt_s = after.timestamp_s - steps[k].timestamp_s
        if now is None or later is None or not after.linked or dt_s <= 0.0:
            continue
        step = palm_step(now.rate_rad_s, replace(motion, scales=np.array([after.noise_scale])), dt_s, after.unseen)
        apart = step.carries(now, dt_s).error_to(later)
        correction, covariance = looked_back(
            now.covariance[None], step.forward[None], step.noise, apart[None], later.covariance[None]
        )
        out[k] = now.moved(correction[0], covariance[0])
    return out

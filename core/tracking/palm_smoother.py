"""Looking back at the palm, on the tangent space of the filter's state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.tracking.motion import PalmMotion, palm_step
from carpus.core.tracking.palm_state import PalmBelief
from carpus.core.tracking.smoother import Passage, Smoother
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


@dataclass(frozen=True, slots=True)
class PalmWalk:
    """The palm through the ``steps`` of its filter, moved as ``motion`` says."""

    steps: Sequence[FilterStep]
    motion: PalmMotion

    def __len__(self) -> int:
        return len(self.steps)

    def filtered(self, frame: int) -> PalmBelief | None:
        return self.steps[frame].belief

    def seconds_on(self, frame: int) -> float | None:
        after = self.steps[frame + 1] if frame + 1 < len(self.steps) else None
        return after.timestamp_s - self.steps[frame].timestamp_s if after is not None and after.linked else None

    def passage(self, frame: int, now: PalmBelief, later: PalmBelief, dt_s: float) -> Passage:
        after = self.steps[frame + 1]
        motion = replace(self.motion, scales=np.array([after.noise_scale]))
        step = palm_step(now.rate_rad_s, motion, dt_s, after.unseen)
        apart = step.carries(now, dt_s).error_to(later)
        return Passage(now.covariance[None], step.forward[None], step.noise, apart[None], later.covariance[None])

    def moved(self, now: PalmBelief, correction: FloatArray, covariance: FloatArray) -> PalmBelief:
        return now.moved(correction[0], covariance[0])


def smoothed_palm(steps: Sequence[FilterStep], motion: PalmMotion) -> list[PalmBelief | None]:
    """Smoothed belief of every step; None where the hand was lost."""
    return [belief for _, belief in Smoother(PalmWalk(steps, motion)).backwards()][::-1]

"""Smoothing: every frame's estimate in the light of all that came after (Rauch, Tung and Striebel); and that of the
palm, on the tangent space of the filter's state. Where a track was lost and begun anew, each stretch is smoothed by
itself.

Which mode the hand was in at each step is told by what came after as well (Kim 1994); the step back is then one of all
modes together. What the tissue has done stays in it: it is not taken to relax. Where tissue rests, its displacement and
what the depths have wrong of it come again in picture after picture: what is averaged over more of them is stated less
surely than if they were new, though never less surely than live.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Generic, Protocol, TypeVar

import numpy as np

from carpus.core.tracking.kernel import rts_step
from carpus.core.tracking.motion import PalmMotion, palm_transition
from carpus.core.tracking.palm_state import MOVING, SIZE, SOFT, TURN, PalmEstimate
from carpus.core.tracking.soft_tissue import NO_DIGITS, DigitSpeeds
from carpus.core.types import FloatArray

Estimate = TypeVar("Estimate")


@dataclass(frozen=True, slots=True)
class Passage:
    """From one frame of C chains to the next, about the earlier one's filtered mean: its ``covariance``, the step's
    ``forward`` and ``noise`` (C, n, n), how far the later smoothed mean lies from the predicted one, ``apart`` (C, n),
    and the ``later_covariance`` (C, n, n)."""

    covariance: FloatArray
    forward: FloatArray
    noise: FloatArray
    apart: FloatArray
    later_covariance: FloatArray


class Trajectory(Protocol[Estimate]):
    """Frames as a filter has left them, in order of time."""

    def __len__(self) -> int: ...

    def filtered(self, frame: int) -> Estimate | None:
        """What was believed after a frame; None where nothing was known."""

    def seconds_on(self, frame: int) -> float | None:
        """Time to the next frame; None where that one does not follow from this one."""

    def passage(self, frame: int, now: Estimate, later: Estimate, dt_s: float) -> Passage:
        """From the estimate of a frame to the smoothed one of the next."""

    def moved(self, now: Estimate, correction: FloatArray, covariance: FloatArray) -> Estimate:
        """An estimate moved by a ``correction`` (C, n), with another ``covariance`` (C, n, n)."""


class Smoother(Generic[Estimate]):
    """Smooths one trajectory."""

    def __init__(self, trajectory: Trajectory[Estimate]) -> None:
        self._trajectory = trajectory

    def backwards(self) -> Iterator[tuple[int, Estimate | None]]:
        """Every frame with its smoothed estimate, None where nothing was known; the last frame first."""
        later: Estimate | None = None
        for frame in reversed(range(len(self._trajectory))):
            later = self._before(frame, later)
            yield frame, later

    def _before(self, frame: int, later: Estimate | None) -> Estimate | None:
        """The smoothed estimate of a frame from that of the next."""
        now, dt_s = self._trajectory.filtered(frame), self._trajectory.seconds_on(frame)
        if now is None or later is None or dt_s is None:
            return now
        if dt_s <= 0.0:
            return later  # the same moment: nothing lies between
        passage = self._trajectory.passage(frame, now, later, dt_s)
        correction, covariance = rts_step(
            passage.covariance, passage.forward, passage.noise, passage.apart, passage.later_covariance
        )
        return self._trajectory.moved(now, correction, covariance)


@dataclass(frozen=True, slots=True)
class FilterStep:
    """One step of the filter: the corrected estimate (None when lost), how it was predicted, when.

    ``probability`` (K,) of the modes after it; ``linked`` False where the track began anew; ``unseen`` (3, 3)
    turns that nothing had shown before the step; ``digits`` how fast the thumb and fingers moved after it.
    """

    timestamp_s: float
    estimate: PalmEstimate | None
    probability: FloatArray
    linked: bool
    unseen: FloatArray | None = None
    digits: DigitSpeeds = NO_DIGITS


@dataclass(frozen=True, slots=True)
class PalmTrajectory:
    """The palm through the ``steps`` of its filter, moved as ``motion`` says."""

    steps: Sequence[FilterStep]
    motion: PalmMotion

    went_over: Sequence[FloatArray | None] = field(init=False, repr=False, compare=False)
    """Probability (K, K) that each step went from row to column mode, in the light of all that came after."""

    def __post_init__(self) -> None:
        out: list[FloatArray | None] = [None] * len(self.steps)
        later: FloatArray | None = None
        for frame in range(len(self.steps) - 1, -1, -1):
            now, dt_s = self.steps[frame], self.seconds_on(frame)
            if now.estimate is None or later is None or dt_s is None:
                later = now.probability
                continue
            switch = self.motion.switch(now.estimate.rate_rad_s, max(dt_s, 0.0), now.digits)
            joint = now.probability[:, None] * switch
            joint *= later / np.maximum(joint.sum(axis=0), 1e-300)
            out[frame], later = joint, joint.sum(axis=1)
        object.__setattr__(self, "went_over", out)

    def __len__(self) -> int:
        return len(self.steps)

    def filtered(self, frame: int) -> PalmEstimate | None:
        return self.steps[frame].estimate

    def seconds_on(self, frame: int) -> float | None:
        after = self.steps[frame + 1] if frame + 1 < len(self.steps) else None
        return after.timestamp_s - self.steps[frame].timestamp_s if after is not None and after.linked else None

    def passage(self, frame: int, now: PalmEstimate, later: PalmEstimate, dt_s: float) -> Passage:
        after = self.steps[frame + 1]
        digits = self.steps[frame].digits
        step = palm_transition(now.rate_rad_s, self.motion, dt_s, after.unseen, digits)
        joint = self.went_over[frame]
        assert joint is not None
        forward, noise = np.eye(SIZE), np.zeros((SIZE, SIZE))
        forward[MOVING, MOVING] = step.moving
        noise[MOVING, MOVING] = np.tensordot(joint.sum(axis=0), step.driven, 1)
        noise[SOFT, SOFT] = self.motion.tissue_noise(joint, step)
        apart = step.carries(now, dt_s).error_to(later)
        return Passage(now.covariance[None], forward[None], noise[None], apart[None], later.covariance[None])

    def moved(self, now: PalmEstimate, correction: FloatArray, covariance: FloatArray) -> PalmEstimate:
        return now.moved(correction[0], covariance[0])


def smoothed_palm(steps: Sequence[FilterStep], motion: PalmMotion) -> list[PalmEstimate | None]:
    """Smoothed estimate of every step; None where the hand was lost."""
    smoothed = [estimate for _, estimate in Smoother(PalmTrajectory(steps, motion)).backwards()][::-1]
    return [
        _stated(step.estimate, estimate, motion.tissue.widens) for step, estimate in zip(steps, smoothed, strict=True)
    ]


def _stated(live: PalmEstimate | None, smoothed: PalmEstimate | None, widens: float) -> PalmEstimate | None:
    """The smoothed estimate ``widens`` times as unsure, as long as its turn stays surer than the live one's."""
    if live is None or smoothed is None or smoothed is live:
        return smoothed
    gained = float(np.trace(live.covariance[TURN, TURN]) / np.trace(smoothed.covariance[TURN, TURN]))
    return replace(smoothed, covariance=min(widens, max(gained, 1.0)) * smoothed.covariance)

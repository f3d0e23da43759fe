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

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import rts_step
from carpus.core.tracking.filter.motion import PalmMotion, palm_transition
from carpus.core.tracking.filter.palm_state import RIGID_MOTION, SIZE, SOFT_TISSUE, TURN, PalmEstimate
from carpus.core.tracking.filter.soft_tissue import ZERO_SPEEDS, DigitSpeeds

Estimate = TypeVar("Estimate")


@dataclass(frozen=True, slots=True)
class SmootherTransition:
    """From one frame of C chains to the next, about the earlier one's filtered mean: its ``covariance``, the step's
    ``forward`` and ``noise`` (C, n, n), how far the later smoothed mean lies from the predicted one, ``difference``
    (C, n),
    and the ``later_covariance`` (C, n, n)."""

    covariance: FloatArray
    forward: FloatArray
    noise: FloatArray
    difference: FloatArray
    later_covariance: FloatArray


class Trajectory(Protocol[Estimate]):
    """Frames as a filter has left them, in order of time."""

    def __len__(self) -> int: ...

    def get_estimate(self, frame: int) -> Estimate | None:
        """What was believed after a frame; None where nothing was known."""

    def seconds_to_next(self, frame: int) -> float | None:
        """Time to the next frame; None where that one does not follow from this one."""

    def compute_transition(self, frame: int, filtered: Estimate, later: Estimate, dt_s: float) -> SmootherTransition:
        """From the estimate of a frame to the smoothed one of the next."""

    def apply_correction(self, filtered: Estimate, correction: FloatArray, covariance: FloatArray) -> Estimate:
        """An estimate moved by a ``correction`` (C, n), with another ``covariance`` (C, n, n)."""


class Smoother(Generic[Estimate]):
    """Smooths one trajectory."""

    def __init__(self, trajectory: Trajectory[Estimate]) -> None:
        self._trajectory = trajectory

    def iterate_backwards(self) -> Iterator[tuple[int, Estimate | None]]:
        """Every frame with its smoothed estimate, None where nothing was known; the last frame first."""
        later: Estimate | None = None
        for frame in reversed(range(len(self._trajectory))):
            later = self._smooth_frame(frame, later)
            yield frame, later

    def _smooth_frame(self, frame: int, later: Estimate | None) -> Estimate | None:
        """The smoothed estimate of a frame from that of the next."""
        now, dt_s = self._trajectory.get_estimate(frame), self._trajectory.seconds_to_next(frame)
        if now is None or later is None or dt_s is None:
            return now
        if dt_s <= 0.0:
            return later  # the same moment: nothing lies between
        passage = self._trajectory.compute_transition(frame, now, later, dt_s)
        correction, covariance = rts_step(
            passage.covariance, passage.forward, passage.noise, passage.difference, passage.later_covariance
        )
        return self._trajectory.apply_correction(now, correction, covariance)


@dataclass(frozen=True, slots=True)
class FilterStep:
    """One step of the filter: the corrected estimate (None when lost), how it was predicted, when.

    ``probability`` (K,) of the modes after it; ``is_linked`` False where the track began anew; ``unobserved_turns``
    (3, 3)
    turns that nothing had shown before the step; ``digit_speeds`` how fast the thumb and fingers moved after it.
    """

    timestamp_s: float
    estimate: PalmEstimate | None
    probability: FloatArray
    is_linked: bool
    unobserved_turns: FloatArray | None = None
    digit_speeds: DigitSpeeds = ZERO_SPEEDS


@dataclass(frozen=True, slots=True)
class PalmTrajectory:
    """The palm through the ``steps`` of its filter, moved as ``motion`` says."""

    steps: Sequence[FilterStep]
    motion: PalmMotion

    mode_transitions: Sequence[FloatArray | None] = field(init=False, repr=False, compare=False)
    """Probability (K, K) that each step went from row to column mode, in the light of all that came after."""

    def __post_init__(self) -> None:
        out: list[FloatArray | None] = [None] * len(self.steps)
        later: FloatArray | None = None
        for frame in range(len(self.steps) - 1, -1, -1):
            now, dt_s = self.steps[frame], self.seconds_to_next(frame)
            if now.estimate is None or later is None or dt_s is None:
                later = now.probability
                continue
            switch = self.motion.mode_transition_matrix(now.estimate.rate_rad_s, max(dt_s, 0.0), now.digit_speeds)
            joint = now.probability[:, None] * switch
            joint *= later / np.maximum(joint.sum(axis=0), 1e-300)
            out[frame], later = joint, joint.sum(axis=1)
        object.__setattr__(self, "mode_transitions", out)

    def __len__(self) -> int:
        return len(self.steps)

    def get_estimate(self, frame: int) -> PalmEstimate | None:
        return self.steps[frame].estimate

    def seconds_to_next(self, frame: int) -> float | None:
        after = self.steps[frame + 1] if frame + 1 < len(self.steps) else None
        return after.timestamp_s - self.steps[frame].timestamp_s if after is not None and after.is_linked else None

    def compute_transition(
        self, frame: int, filtered: PalmEstimate, later: PalmEstimate, dt_s: float
    ) -> SmootherTransition:
        after = self.steps[frame + 1]
        digits = self.steps[frame].digit_speeds
        step = palm_transition(filtered.rate_rad_s, self.motion, dt_s, after.unobserved_turns, digits)
        joint = self.mode_transitions[frame]
        assert joint is not None
        forward, noise = np.eye(SIZE), np.zeros((SIZE, SIZE))
        forward[RIGID_MOTION, RIGID_MOTION] = step.moving
        noise[RIGID_MOTION, RIGID_MOTION] = np.tensordot(joint.sum(axis=0), step.driven, 1)
        noise[SOFT_TISSUE, SOFT_TISSUE] = self.motion.tissue_noise(joint, step)
        apart = step.propagate(filtered, dt_s).compute_error(later)
        return SmootherTransition(
            filtered.covariance[None], forward[None], noise[None], apart[None], later.covariance[None]
        )

    def apply_correction(self, filtered: PalmEstimate, correction: FloatArray, covariance: FloatArray) -> PalmEstimate:
        return filtered.add_error(correction[0], covariance[0])


def smooth_palm(steps: Sequence[FilterStep], motion: PalmMotion) -> list[PalmEstimate | None]:
    """Smoothed estimate of every step; None where the hand was lost."""
    smoothed = [estimate for _, estimate in Smoother(PalmTrajectory(steps, motion)).iterate_backwards()][::-1]
    return [
        _inflate_covariance(step.estimate, estimate, motion.tissue.variance_factor)
        for step, estimate in zip(steps, smoothed, strict=True)
    ]


def _inflate_covariance(live: PalmEstimate | None, smoothed: PalmEstimate | None, widens: float) -> PalmEstimate | None:
    """The smoothed estimate ``widens`` times as unsure, as long as its turn stays surer than the live one's."""
    if live is None or smoothed is None or smoothed is live:
        return smoothed
    gained = float(np.trace(live.covariance[TURN, TURN]) / np.trace(smoothed.covariance[TURN, TURN]))
    return replace(smoothed, covariance=min(widens, max(gained, 1.0)) * smoothed.covariance)

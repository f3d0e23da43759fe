"""Smoothing of Rauch, Tung and Striebel, and that of the palm on the tangent space of its state.

Where a track was lost and initiated again, each stretch is smoothed by itself. Which mode the hand was in at each step
is told by what came after as well (Kim 1994); the step back is then one of all modes together. What the tissue has done
stays in it: it is not taken to relax. Where tissue rests, its displacement and what the depths have wrong of it come
again in frame after frame: what is averaged over more of them is stated less surely than if they were new, though never
less surely than live.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol, TypeVar

import numpy as np

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.motion import PalmMotion, palm_transition
from carpus.core.tracking.filter.palm_state import RIGID_MOTION, SIZE, SOFT_TISSUE, TURN, PalmEstimate
from carpus.core.tracking.filter.soft_tissue import ZERO_SPEEDS, DigitSpeeds

Estimate = TypeVar("Estimate")


@dataclass(frozen=True, slots=True)
class SmootherTransition:
    """The step from one frame of C chains to the next, about the earlier one's filtered mean.

    Its ``covariance``, the step's F ``forward`` and Q ``noise`` (C, n, n), the later smoothed mean less the predicted
    one, ``difference`` (C, n), and the ``later_covariance`` (C, n, n).
    """

    covariance: FloatArray
    forward: FloatArray
    noise: FloatArray
    difference: FloatArray
    later_covariance: FloatArray


class Trajectory(Protocol[Estimate]):
    """Filtered frames in order of time."""

    def __len__(self) -> int: ...

    def get_estimate(self, frame: int) -> Estimate | None:
        """Return the filtered estimate of a frame; None where nothing was known."""

    def seconds_to_next(self, frame: int) -> float | None:
        """Return the time to the next frame; None where that one does not follow from this one."""

    def compute_transition(self, frame: int, filtered: Estimate, later: Estimate, dt_s: float) -> SmootherTransition:
        """Return the step from the filtered estimate of a frame to the smoothed one of the next."""

    def apply_correction(self, filtered: Estimate, correction: FloatArray, covariance: FloatArray) -> Estimate:
        """Return an estimate moved by a correction (C, n), with another covariance (C, n, n)."""


def compute_rts_correction(step: SmootherTransition) -> tuple[FloatArray, FloatArray]:
    """Compute the correction (C, n) of the filtered mean and the smoothed covariance (C, n, n).

    One step back of the smoother of Rauch, Tung and Striebel.
    """
    across = step.forward @ step.covariance
    ahead = across @ np.swapaxes(step.forward, -1, -2) + step.noise
    gain = np.swapaxes(np.linalg.solve(ahead, across), -1, -2)
    smoothed = step.covariance + gain @ (step.later_covariance - ahead) @ np.swapaxes(gain, -1, -2)
    return (gain @ step.difference[..., None])[..., 0], 0.5 * (smoothed + np.swapaxes(smoothed, -1, -2))


def smooth_backwards(trajectory: Trajectory[Estimate]) -> Iterator[tuple[int, Estimate | None]]:
    """Iterate over every frame and its smoothed estimate (None for none), the last frame first."""
    later: Estimate | None = None
    for frame in reversed(range(len(trajectory))):
        filtered, dt_s = trajectory.get_estimate(frame), trajectory.seconds_to_next(frame)
        if filtered is None or later is None or dt_s is None:
            later = filtered
        elif dt_s > 0.0:  # otherwise the same moment: nothing lies between
            step = trajectory.compute_transition(frame, filtered, later, dt_s)
            correction, covariance = compute_rts_correction(step)
            later = trajectory.apply_correction(filtered, correction, covariance)
        yield frame, later


@dataclass(frozen=True, slots=True)
class FilterStep:
    """One step of the filter: the updated estimate (None when lost).

    ``probability`` (K,) of the modes after it; ``is_linked`` False where the track was initiated again;
    ``unobserved_turns`` (3, 3) before the step; ``digit_speeds`` after it.
    """

    timestamp_s: float
    estimate: PalmEstimate | None
    probability: FloatArray
    is_linked: bool
    unobserved_turns: FloatArray | None = None
    digit_speeds: DigitSpeeds = ZERO_SPEEDS


@dataclass(frozen=True, slots=True)
class PalmTrajectory:
    """The palm through the steps of its filter, with its motion model.

    ``mode_transitions`` (K, K): probability that each step went from row to column mode, by all frames.
    """

    steps: Sequence[FilterStep]
    motion: PalmMotion

    mode_transitions: Sequence[FloatArray | None] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        out: list[FloatArray | None] = [None] * len(self.steps)
        later: FloatArray | None = None
        for frame in range(len(self.steps) - 1, -1, -1):
            step, dt_s = self.steps[frame], self.seconds_to_next(frame)
            if step.estimate is None or later is None or dt_s is None:
                later = step.probability
                continue
            rate, speeds = step.estimate.rate_rad_s, step.digit_speeds
            ahead = palm_transition(rate, self.motion, max(dt_s, 0.0), None, speeds)
            joint = step.probability[:, None] * ahead.switch
            joint *= later / np.maximum(joint.sum(axis=0), 1e-300)
            out[frame], later = joint, joint.sum(axis=1)
        object.__setattr__(self, "mode_transitions", out)

    def __len__(self) -> int:
        return len(self.steps)

    def get_estimate(self, frame: int) -> PalmEstimate | None:
        return self.steps[frame].estimate

    def seconds_to_next(self, frame: int) -> float | None:
        if frame + 1 == len(self.steps) or not self.steps[frame + 1].is_linked:
            return None
        return self.steps[frame + 1].timestamp_s - self.steps[frame].timestamp_s

    def compute_transition(
        self, frame: int, filtered: PalmEstimate, later: PalmEstimate, dt_s: float
    ) -> SmootherTransition:
        turns, speeds = self.steps[frame + 1].unobserved_turns, self.steps[frame].digit_speeds
        step = palm_transition(filtered.rate_rad_s, self.motion, dt_s, turns, speeds)
        joint = self.mode_transitions[frame]
        assert joint is not None
        forward, noise = np.eye(SIZE), np.zeros((SIZE, SIZE))
        forward[RIGID_MOTION, RIGID_MOTION] = step.moving
        noise[RIGID_MOTION, RIGID_MOTION] = np.tensordot(joint.sum(axis=0), step.driven, 1)
        noise[SOFT_TISSUE, SOFT_TISSUE] = self.motion.tissue_noise(joint, step)
        difference = step.propagate(filtered, dt_s).compute_error(later)
        return SmootherTransition(
            filtered.covariance[None], forward[None], noise[None], difference[None], later.covariance[None]
        )

    def apply_correction(self, filtered: PalmEstimate, correction: FloatArray, covariance: FloatArray) -> PalmEstimate:
        return filtered.add_error(correction[0], covariance[0])


def smooth_palm(steps: Sequence[FilterStep], motion: PalmMotion) -> list[PalmEstimate | None]:
    """Return the smoothed estimate of every step; None where the hand was lost."""
    smoothed = [estimate for _, estimate in smooth_backwards(PalmTrajectory(steps, motion))][::-1]
    for k, (live, later) in enumerate(zip((step.estimate for step in steps), smoothed, strict=True)):
        if live is not None and later is not None and later is not live:
            # Inflated, as long as the turn stays surer than the live one's.
            gained = float(np.trace(live.covariance[TURN, TURN]) / np.trace(later.covariance[TURN, TURN]))
            factor = min(motion.tissue.variance_factor, max(gained, 1.0))
            smoothed[k] = replace(later, covariance=factor * later.covariance)
    return smoothed

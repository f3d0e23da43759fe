"""Smoothing of thumb and fingers: filtered again over the smoothed palm, then smoothed themselves.

The names of the blobs are those of the first pass. The smoother runs over joints, rates and anatomy, so what a movement
teaches of the bones also serves the frames before it. Where a finger was found anew only its anatomy is carried back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digit_images import propagate_palm_error
from carpus.core.tracking.digit_association import far_digits
from carpus.core.tracking.digit_filter import (
    ANATOMY,
    DIGIT_SIZE,
    RATES,
    DigitsLinearisation,
    digits_linearised,
    spread_points,
)
from carpus.core.tracking.digit_naming import PINNINGS
from carpus.core.tracking.digit_readout import Seat
from carpus.core.tracking.finger_depth import KnuckleBends, with_bends
from carpus.core.tracking.finger_model import RANGE_AFTER_S, FingerModel
from carpus.core.tracking.hand_geometry import CHAINS, SHOWS, SLOTS, JointMoment
from carpus.core.tracking.kernel import ModeMixture, corrected, partial_update
from carpus.core.tracking.palm_smoother import Passage, Smoother
from carpus.core.types import FloatArray

_LOWER = np.tril_indices(DIGIT_SIZE)


@dataclass(frozen=True, slots=True)
class FingerStep:
    """What one frame told: ``measured`` and ``variance`` (5, 9), ``shown`` (5, 3) discs named, ``postures`` of digits
    found anew; ``begins`` at the neutral pose; ``bends`` what depth said of knuckles."""

    timestamp_s: float
    measured: FloatArray
    variance: FloatArray
    shown: NDArray[np.bool_]
    postures: dict[int, FloatArray]
    begins: bool
    bends: KnuckleBends = field(default_factory=KnuckleBends.none)


@dataclass(frozen=True, slots=True)
class _Filtered:
    """One frame filtered again: ``mean`` (5, n) and the lower triangles of ``covariance`` (5, n (n + 1) / 2).

    ``scale`` (5,) of the process noise that led to it, ``unseen_s`` (5, 5) for how long each slot had not been shown,
    ``is_linked`` whether it follows from the frame before; ``anew`` (5,) digits of which only the anatomy does.
    """

    mean: FloatArray
    covariance: FloatArray
    scale: FloatArray
    unseen_s: FloatArray
    is_linked: bool
    anew: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class FingerStart:
    """What was believed after the frame before the first step, at its time; ``unseen_s`` (5, 5) as in the tracker."""

    estimates: ModeMixture
    unseen_s: FloatArray
    timestamp_s: float
    is_lost: bool


@dataclass(frozen=True, slots=True)
class SmoothedFingers:
    """The joints of every frame, None where the hand was lost, and what a later pass can go on from."""

    moments: list[JointMoment | None]
    filtered: list[_Filtered | None]
    steps: Sequence[FingerStep | None]

    def start_after(self, count: int, model: FingerModel) -> FingerStart | None:
        """What to go on from when the first ``count`` steps are forgotten; None where nothing is known."""
        known = [k for k in range(count) if self.filtered[k] is not None and self.steps[k] is not None]
        if not known:
            return None
        now, step = self.filtered[known[-1]], self.steps[known[-1]]
        assert now is not None
        assert step is not None
        shown = (SHOWS & step.shown[:, None, :]).any(axis=-1)
        return FingerStart(
            model.alike(now.mean, _whole(now.covariance)),
            np.where(shown, 0.0, now.unseen_s),
            step.timestamp_s,
            known[-1] != count - 1,
        )


@dataclass(frozen=True, slots=True)
class _DigitEstimate:
    """Gaussians of the digits: ``mean`` (5, n) and ``covariance`` (5, n, n)."""

    mean: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True)
class FingerTrajectory:
    """Thumb and fingers as ``filtered_again`` over the smoothed palm, by the ``steps`` of the first pass."""

    model: FingerModel
    steps: Sequence[FingerStep | None]
    filtered_again: Sequence[_Filtered | None]

    def __len__(self) -> int:
        return len(self.filtered_again)

    def filtered(self, frame: int) -> _DigitEstimate | None:
        now = self.filtered_again[frame]
        return None if now is None else _DigitEstimate(now.mean, _whole(now.covariance))

    def seconds_on(self, frame: int) -> float | None:
        if frame + 1 == len(self):
            return None
        now, after, later = self.steps[frame], self.steps[frame + 1], self.filtered_again[frame + 1]
        if now is None or after is None or later is None or not later.is_linked:
            return None
        return after.timestamp_s - now.timestamp_s

    def passage(self, frame: int, now: _DigitEstimate, later: _DigitEstimate, dt_s: float) -> Passage:
        after = self.filtered_again[frame + 1]
        assert after is not None
        forgetting = self.model.forgetting(now.mean, after.unseen_s, dt_s)
        forward, noise = self.model.motion.step(dt_s, after.scale, forgetting)
        moving = np.arange(RATES.stop)
        for chain in np.flatnonzero(after.anew):
            # Nothing of the joints passes through: only what the later frames say of the anatomy goes back.
            forward[chain][moving] = 0.0
            noise[chain][moving, moving] = 1.0
        apart = later.mean - (forward @ now.mean[..., None])[..., 0]
        return Passage(now.covariance, forward, noise, apart, later.covariance)

    def moved(self, now: _DigitEstimate, correction: FloatArray, covariance: FloatArray) -> _DigitEstimate:
        return _DigitEstimate(now.mean + correction, covariance)


def smoothed_fingers(
    model: FingerModel,
    steps: Sequence[FingerStep | None],
    seats: Sequence[Seat | None],
    start: FingerStart | None = None,
) -> SmoothedFingers:
    """The joints of every frame. ``seats`` are those of the smoothed palm; without ``start`` the first frame begins
    at the neutral pose."""
    filtered = _filtered(model, steps, seats, start)
    out: list[JointMoment | None] = [None] * len(steps)
    for frame, estimate in Smoother(FingerTrajectory(model, steps, filtered)).backwards():
        seat = seats[frame]
        if estimate is not None and seat is not None:
            linearised = _linearised(model, estimate.mean, estimate.covariance, seat)
            out[frame] = model.readout.read(estimate.mean, estimate.covariance, seat, linearised)
    return SmoothedFingers(out, filtered, steps)


def _linearised(model: FingerModel, mean: FloatArray, covariance: FloatArray, seat: Seat) -> DigitsLinearisation:
    spread = model.settings.spread
    points = spread_points(mean, covariance, seat.palm.disc_m[1:], spread)
    return digits_linearised(points, seat.view, spread)


def _filtered(
    model: FingerModel, steps: Sequence[FingerStep | None], seats: Sequence[Seat | None], start: FingerStart | None
) -> list[_Filtered | None]:
    out: list[_Filtered | None] = []
    estimates, unseen_s, time_s = model.at_neutral(), np.zeros((CHAINS, SLOTS)), float("nan")
    is_lost = False
    if start is not None:
        estimates, unseen_s, time_s, is_lost = start.estimates, start.unseen_s, start.timestamp_s, start.is_lost
    for step, seat in zip(steps, seats, strict=True):
        if step is None or seat is None:
            out.append(None)
            is_lost = True
            continue
        is_gap = step.timestamp_s - time_s >= RANGE_AFTER_S
        is_linked = not (step.begins or is_lost or is_gap)
        before_s = unseen_s
        if step.begins:
            estimates, unseen_s = model.at_neutral(), np.zeros((CHAINS, SLOTS))
        elif is_lost:
            estimates = model.anywhere(*estimates.merged())
            unseen_s = np.full((CHAINS, SLOTS), RANGE_AFTER_S)
        elif step.timestamp_s > time_s:
            estimates = model.predicted(estimates, unseen_s, step.timestamp_s - time_s)
        if step.postures:
            estimates = model.at_postures(estimates, step.postures)
        anew = np.isin(np.arange(CHAINS), list(step.postures))
        nearest, partial = estimates, partial_update(DIGIT_SIZE, ANATOMY, model.learning(seat))
        is_far = bool(step.postures) or bool(far_digits(estimates.merged()[1], step.shown).any())
        for _ in range(1 + (PINNINGS if is_far else 0)):
            linearised = _linearised(model, *nearest.merged(), seat)
            palm_part = propagate_palm_error(linearised, seat)
            nearest = corrected(estimates, linearised, step.measured, step.variance, palm_part, partial).mixture
        bent = with_bends(nearest, step.bends) if step.bends.is_any else nearest
        estimates, (mean, covariance), misread = model.within_reach(bent, estimates)
        scale = np.sqrt(estimates.probability @ model.scales**2)
        out.append(_Filtered(mean, covariance[:, _LOWER[0], _LOWER[1]], scale, before_s, is_linked, anew | misread))
        shown = (SHOWS & step.shown[:, None, :]).any(axis=-1)
        unseen_s = np.where(shown, 0.0, unseen_s + (step.timestamp_s - time_s if is_linked else 0.0))
        time_s, is_lost = step.timestamp_s, False
    return out


def _whole(triangle: FloatArray) -> FloatArray:
    """Symmetric matrices (5, n, n) from their lower triangles."""
    out = np.zeros((CHAINS, DIGIT_SIZE, DIGIT_SIZE))
    out[:, _LOWER[0], _LOWER[1]] = triangle
    out[:, _LOWER[1], _LOWER[0]] = triangle
    return out

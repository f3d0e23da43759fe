"""Smoothing of thumb and fingers: filtered again over the smoothed palm, then smoothed themselves.

The associations are those of the first pass. The smoother runs over joints, rates and anatomy, so what a movement
teaches of the bones also serves the frames before it. Where a finger was found again only its anatomy is carried back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.hand.anatomy_prior import Gaussian
from carpus.core.model.types import FloatArray
from carpus.core.tracking.digits.digit_association import EXTRA_LINEARISATIONS, find_far_digits
from carpus.core.tracking.digits.finger_model import DIFFUSION_S, FingerModel
from carpus.core.tracking.digits.knuckle_flexion import KnuckleFlexion, update_by_knuckle_flexion
from carpus.core.tracking.filter.digit_filter import (
    ANATOMY,
    DIGIT_SIZE,
    RATES,
    DigitBase,
    DigitLinearisation,
    draw_sigma_points,
    linearise_digits,
)
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_SLOTS, SLOT_MOVES_DISC, JointState
from carpus.core.tracking.filter.mixture_filter import ModeMixture, partial_update_shares, update_mixture
from carpus.core.tracking.smoother.palm_smoother import SmootherTransition, smooth_backwards

_LOWER = np.tril_indices(DIGIT_SIZE)


@dataclass(frozen=True, slots=True)
class FingerStep:
    """Measurements of one frame.

    ``measured`` and ``variance`` (5, 9), ``is_seen`` (5, 3) associated discs, ``postures`` of digits found again;
    ``starts_at_neutral``; ``knuckle_flexion`` by depth.
    """

    timestamp_s: float
    measured: FloatArray
    variance: FloatArray
    is_seen: NDArray[np.bool_]
    postures: dict[int, FloatArray]
    starts_at_neutral: bool
    knuckle_flexion: KnuckleFlexion = field(default_factory=KnuckleFlexion.none)


@dataclass(frozen=True, slots=True)
class _FilteredFrame:
    """One frame filtered again: ``mean`` (5, n) and lower triangles of ``covariance``.

    ``covariance`` (5, n (n + 1) / 2); ``scale`` (5,) of the process noise that led to it, ``unseen_s`` (5, 5) for how
    long each slot had not been shown, ``is_linked`` whether it follows from the frame before; ``is_restarted`` (5,)
    digits of which only the anatomy does.
    """

    mean: FloatArray
    covariance: FloatArray
    scale: FloatArray
    unseen_s: FloatArray
    is_linked: bool
    is_restarted: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class FingerStart:
    """The estimate after the frame before the first step; ``unseen_s`` (5, 5) as in the tracker."""

    estimates: ModeMixture
    unseen_s: FloatArray
    timestamp_s: float
    is_lost: bool


@dataclass(frozen=True, slots=True)
class SmoothedFingers:
    """The joints of every frame, None where the hand was lost, and what a later pass can go on from."""

    joint_states: list[JointState | None]
    filtered: list[_FilteredFrame | None]
    steps: Sequence[FingerStep | None]

    def start_for_next(self, count: int, model: FingerModel) -> FingerStart | None:
        """Return the start of a pass without the first ``count`` steps; None where nothing is known."""
        known = [k for k in range(count) if self.filtered[k] is not None and self.steps[k] is not None]
        if not known:
            return None
        filtered, step = self.filtered[known[-1]], self.steps[known[-1]]
        assert filtered is not None
        assert step is not None
        is_shown = (SLOT_MOVES_DISC & step.is_seen[:, None, :]).any(axis=-1)
        return FingerStart(
            ModeMixture.from_gaussian(filtered.mean, _to_symmetric(filtered.covariance), model.scales.size),
            np.where(is_shown, 0.0, filtered.unseen_s),
            step.timestamp_s,
            known[-1] != count - 1,
        )


@dataclass(frozen=True, slots=True)
class FingerTrajectory:
    """Thumb and fingers as filtered again over the smoothed palm, by the steps of the first pass."""

    model: FingerModel
    steps: Sequence[FingerStep | None]
    filtered_again: Sequence[_FilteredFrame | None]

    def __len__(self) -> int:
        return len(self.filtered_again)

    def get_estimate(self, frame: int) -> Gaussian | None:
        filtered = self.filtered_again[frame]
        return None if filtered is None else Gaussian(filtered.mean, _to_symmetric(filtered.covariance))

    def seconds_to_next(self, frame: int) -> float | None:
        if frame + 1 == len(self):
            return None
        step, next_step, later = self.steps[frame], self.steps[frame + 1], self.filtered_again[frame + 1]
        if step is None or next_step is None or later is None or not later.is_linked:
            return None
        return next_step.timestamp_s - step.timestamp_s

    def compute_transition(self, frame: int, filtered: Gaussian, later: Gaussian, dt_s: float) -> SmootherTransition:
        next_frame = self.filtered_again[frame + 1]
        assert next_frame is not None
        forgetting = self.model.compute_forgetting(filtered.mean, next_frame.unseen_s, dt_s)
        forward, noise = self.model.motion.compute_transition(dt_s, (next_frame.scale**2)[:, None], forgetting)
        moving = np.arange(RATES.stop)
        for chain in np.flatnonzero(next_frame.is_restarted):
            # Nothing of the joints passes through: only what the later frames say of the anatomy goes back.
            forward[chain][moving] = 0.0
            noise[chain, 0][moving, moving] = 1.0
        difference = later.mean - (forward @ filtered.mean[..., None])[..., 0]
        return SmootherTransition(filtered.covariance, forward, noise[:, 0], difference, later.covariance)

    def apply_correction(self, filtered: Gaussian, correction: FloatArray, covariance: FloatArray) -> Gaussian:
        return Gaussian(filtered.mean + correction, covariance)


def smooth_fingers(
    model: FingerModel,
    steps: Sequence[FingerStep | None],
    bases: Sequence[DigitBase | None],
    start: FingerStart | None = None,
) -> SmoothedFingers:
    """Return the joints of every frame.

    ``bases`` are the bases on the smoothed palm; without ``start`` the first frame begins at the neutral pose.
    """
    filtered = _filter_again(model, steps, bases, start)
    out: list[JointState | None] = [None] * len(steps)
    for frame, estimate in smooth_backwards(FingerTrajectory(model, steps, filtered)):
        base = bases[frame]
        if estimate is not None and base is not None:
            linearised = _linearise(model, estimate.mean, estimate.covariance, base)
            out[frame] = model.readout.read_joints(estimate.mean, estimate.covariance, base, linearised)
    return SmoothedFingers(out, filtered, steps)


def _linearise(model: FingerModel, mean: FloatArray, covariance: FloatArray, base: DigitBase) -> DigitLinearisation:
    scaling = model.settings.scaling
    points = draw_sigma_points(mean, covariance, base.palm.disc_m[1:], scaling)
    return linearise_digits(points, base.view, scaling)


def _filter_again(
    model: FingerModel, steps: Sequence[FingerStep | None], bases: Sequence[DigitBase | None], start: FingerStart | None
) -> list[_FilteredFrame | None]:
    out: list[_FilteredFrame | None] = []
    estimates, unseen_s, time_s = model.neutral_mixture(), np.zeros((N_DIGITS, N_SLOTS)), float("nan")
    is_lost = False
    if start is not None:
        estimates, unseen_s, time_s, is_lost = start.estimates, start.unseen_s, start.timestamp_s, start.is_lost
    for step, base in zip(steps, bases, strict=True):
        if step is None or base is None:
            out.append(None)
            is_lost = True
            continue
        is_gap = step.timestamp_s - time_s >= DIFFUSION_S
        is_linked = not (step.starts_at_neutral or is_lost or is_gap)
        unseen_before_s = unseen_s
        if step.starts_at_neutral:
            estimates, unseen_s = model.neutral_mixture(), np.zeros((N_DIGITS, N_SLOTS))
        elif is_lost:
            estimates = model.diffuse_mixture(*estimates.merge())
            unseen_s = np.full((N_DIGITS, N_SLOTS), DIFFUSION_S)
        elif step.timestamp_s > time_s:
            estimates = model.predict(estimates, unseen_s, step.timestamp_s - time_s)
        if step.postures:
            estimates = model.restart_at_postures(estimates, step.postures)
        is_restarted = np.isin(np.arange(N_DIGITS), list(step.postures))
        updated, partial = estimates, partial_update_shares(DIGIT_SIZE, ANATOMY, model.compute_learning_share(base))
        is_far = bool(step.postures) or bool(find_far_digits(estimates.merge()[1], step.is_seen).any())
        for _ in range(1 + (EXTRA_LINEARISATIONS if is_far else 0)):
            linearised = _linearise(model, *updated.merge(), base)
            palm_covariance = base.compute_image_covariance(linearised)
            update = update_mixture(estimates, linearised, step.measured, step.variance, palm_covariance, partial)
            updated = update.mixture
        if step.knuckle_flexion.is_any:
            updated = update_by_knuckle_flexion(updated, step.knuckle_flexion)
        estimates, (mean, covariance), misread = model.apply_joint_limits(updated, estimates)
        scale = np.sqrt(estimates.probability @ model.scales**2)
        out.append(
            _FilteredFrame(
                mean, covariance[:, _LOWER[0], _LOWER[1]], scale, unseen_before_s, is_linked, is_restarted | misread
            )
        )
        is_shown = (SLOT_MOVES_DISC & step.is_seen[:, None, :]).any(axis=-1)
        unseen_s = np.where(is_shown, 0.0, unseen_s + (step.timestamp_s - time_s if is_linked else 0.0))
        time_s, is_lost = step.timestamp_s, False
    return out


def _to_symmetric(triangle: FloatArray) -> FloatArray:
    """Return symmetric matrices (5, n, n) of their lower triangles."""
    out = np.zeros((N_DIGITS, DIGIT_SIZE, DIGIT_SIZE))
    out[:, _LOWER[0], _LOWER[1]] = triangle
    out[:, _LOWER[1], _LOWER[0]] = triangle
    return out

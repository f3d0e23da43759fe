"""Association of blobs with the discs of thumb and fingers, given the palm.

First every disc by itself, eq. (12) of the wrist paper resolved for all discs at once; a disc that is turned away or
was hidden a moment ago is less likely to be seen. Then digit by digit: where the discs of one are not jointly
compatible, all its associations are weighed jointly. A blob larger than its disc is one of two discs that the image
does not resolve, and measures both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digit_images import measure_assigned_discs
from carpus.core.compiled.digits import place_digits
from carpus.core.model.types import FloatArray
from carpus.core.tracking.association import association
from carpus.core.tracking.association.association import is_jointly_compatible
from carpus.core.tracking.filter.digit_filter import (
    ANATOMY,
    DIGIT_SIZE,
    LIMIT_SD_RAD,
    OBSERVED,
    DigitLinearisation,
    DigitView,
    compute_limit_excess,
)
from carpus.core.tracking.filter.hand_geometry import (
    CROWDED_PX,
    CROWDED_RADII,
    N_DIGITS,
    N_DISCS,
    N_SLOTS,
    SLOT_MOVES_DISC,
)
from carpus.core.tracking.filter.mixture_filter import ModeMixture, Update, partial_update_shares, update_mixture
from carpus.core.tracking.filter.predicted_measurement import CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE, Measurements
from carpus.core.tracking.filter.settings import TrackerSettings

HIDDEN_S, SHOWN_S = 0.4, 3.0  # so long a disc stays hidden or seen on average
STEEPEST_RAD, STEEPEST_SD_RAD = 1.22, 0.15  # the tilt at which discs vanish, give or take
MIN_SEEN, MAX_SEEN = 1e-4, 0.98  # between these the probability stays that a disc is to be seen
MIN_FACING = 0.15  # tilted discs show no less of themselves
LOGISTIC_PER_SD = 1.7  # slope of the logistic function that is nearest to the normal integral

# Slots (5, 5) that tilt the discs past them: a finger's flexions, and the thumb's at MCP and IP, not at CMC.
_TILTING = np.array([[0.0, 0.0, 1.0, 0.0, 1.0], *([0.0, 1.0, 1.0, 1.0, 0.0],) * (N_DIGITS - 1)])


def compute_tilts(
    normal: FloatArray, covariance: FloatArray, linearised: DigitLinearisation, view: DigitView
) -> tuple[FloatArray, FloatArray]:
    """Compute the tilt (5, 3) of the discs to the line of sight in rad, and its variance (5, 3).

    ``normal`` (5, 3, 3) of the discs in W; ``covariance`` (5, n, n) of the states, whose joints are taken to err
    independently.
    """
    centre = linearised.centre_m
    cosine = -np.vecdot(normal.reshape(-1, 3) @ view.rotation.T, centre.reshape(-1, 3)).reshape(N_DIGITS, N_DISCS)
    cosine /= np.sqrt(np.vecdot(centre, centre))
    variance = covariance.diagonal(axis1=1, axis2=2)[:, :N_SLOTS] * _TILTING
    return np.arccos(np.minimum(np.maximum(cosine, -1.0), 1.0)), np.cumsum(variance, axis=1)[:, -N_DISCS:]


def compute_visibility(visible: FloatArray, tilt: FloatArray, variance: FloatArray, dt_s: float) -> FloatArray:
    """Compute the probability (5, 3) that each disc is to be seen, which was ``visible`` (5, 3) ``dt_s`` ago.

    A disc stays hidden or seen for some time, and vanishes when it is turned away, by its ``tilt`` (5, 3) with
    ``variance`` (5, 3).
    """
    stays, comes = math.exp(-dt_s / SHOWN_S), -math.expm1(-dt_s / HIDDEN_S)
    past_sd = LOGISTIC_PER_SD * (tilt - STEEPEST_RAD) / np.sqrt(variance + STEEPEST_SD_RAD**2)
    facing = 1.0 / (1.0 + np.exp(np.minimum(np.maximum(past_sd, -30.0), 30.0)))
    by_time = visible * stays + (1.0 - visible) * comes
    return np.asarray(np.minimum(np.maximum(by_time * facing, MIN_SEEN), MAX_SEEN))


def compute_disc_scale(tilt: FloatArray, linearised: DigitLinearisation, view: DigitView) -> FloatArray:
    """Compute the pixels (5, 3) that each square metre of a disc with a ``tilt`` (5, 3) covers."""
    per_m = view.camera.fx_px / linearised.centre_m[..., 2]
    return np.asarray(np.maximum(np.cos(tilt), MIN_FACING) * per_m * per_m)


_SLOT = np.arange(N_SLOTS)
_LOG_2_PI = float(np.log(2.0 * np.pi))

SKIN_SD_PX = 0.1  # of a disc on a finger about where the model has it, besides the noise of its centre
MIN_VISIBLE_PROBABILITY = 0.5  # with less a disc was hidden a moment ago
EXPECTED_CLUTTER = 3.0  # other blobs in a frame
MAX_LINEAR_SD_RAD = math.radians(10.0)  # a joint predicted less surely may be far from where h was linearised
EXTRA_LINEARISATIONS = 2  # of h, of a digit found far from where it was predicted, about what its discs say
BEYOND_LIMIT_SD = 1.5  # so many standard deviations beyond its limits a joint surely is not
# Of a blob over its disc seen square that holds a neighbour's too: of single ones 99.9 % are smaller.
MIN_MERGED_AREA_RATIO = 1.25
# Where along such a blob either disc lies is unsure by this share of what lies between them and its centre.
MERGED_SD_SHARE = 0.5
MAX_CANDIDATES = 4  # blobs that each disc may be, where a digit is associated jointly
NO_DEPTH_PENALTY = 14.0  # in squared standard deviations, of a candidate without its depth


@dataclass(frozen=True, slots=True)
class DigitAssignment:
    """``assigned`` (5, 3) blob of every disc or -1, ``with_depth`` (5, 3) whether its depth is used."""

    assigned: NDArray[np.int64]
    with_depth: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class UpdatedDigits:
    """The digits updated by the associated blobs, whose measurements (5, 9) and ``variance`` (5, 9)."""

    assignment: DigitAssignment
    update: Update
    measured: FloatArray
    variance: FloatArray


@dataclass(frozen=True, slots=True)
class DigitScene:
    """One frame before the fingers are associated.

    ``state_covariance`` (5, n, n) of the digits; ``linearised`` h; ``image_covariance`` (5, 9, 9) of the discs' images,
    the palm's error included; ``palm_covariance`` that error alone; ``visible`` (5, 3) probability that each disc is to
    be seen; ``is_free`` (D,) blobs that are not the palm's; ``area_px`` (D,) of the blobs, ``whole_px`` (5, 3) of each
    disc where nothing hides it and ``disc_m2`` (5, 3) its area, NaN where not known yet; ``noise_factor`` (5, 9);
    ``learning_share`` of the information on the anatomy that is used; ``has_discs`` (5,) digits that carry discs at
    all.
    """

    state_covariance: FloatArray
    linearised: DigitLinearisation
    image_covariance: FloatArray
    palm_covariance: FloatArray
    visible: FloatArray
    blobs: Measurements
    is_free: NDArray[np.bool_]
    area_px: FloatArray
    whole_px: FloatArray
    disc_m2: FloatArray
    noise_factor: FloatArray
    resolution_px2: float
    view: DigitView
    learning_share: float
    has_discs: NDArray[np.bool_]


def associate_digits(estimates: ModeMixture, scene: DigitScene, settings: TrackerSettings) -> UpdatedDigits:
    """Associate and update all digits.

    First disc by disc; then again, jointly, the digits that are not jointly compatible. Discs where they cannot be lose
    their blobs.
    """
    assignment = _associate_separately(scene, settings)
    updated = update_digits(estimates, scene, assignment, settings)
    nis, dof = updated.update.nis.tolist(), updated.update.dof.tolist()
    doubtful = [r for r in range(N_DIGITS) if not is_jointly_compatible(nis[r], dof[r], settings.association)]
    if doubtful:
        assigned, with_depth = assignment.assigned.copy(), assignment.with_depth.copy()
        assigned[doubtful] = -1
        for chain in doubtful:
            rest = np.setdiff1d(np.flatnonzero(scene.is_free), assigned.ravel())
            assigned[chain], with_depth[chain] = _associate_digit_jointly(chain, scene, rest, settings)
        assignment = DigitAssignment(assigned, with_depth)
        updated = update_digits(estimates, scene, assignment, settings)

    is_assigned = assignment.assigned >= 0
    is_back = is_assigned & (scene.visible < MIN_VISIBLE_PROBABILITY)  # hidden a moment ago
    if not is_back.any() and not (is_assigned[0, 2] and not is_assigned[0, 1]):
        return updated
    is_removed = is_back
    if is_back.any():  # where the disc could not be seen, or where no finger reaches
        mean, covariance = updated.update.mixture.merge()
        _, normal, _, _ = place_digits(mean[:, OBSERVED], np.zeros((N_DIGITS, 3)))
        tilt, variance = compute_tilts(normal, covariance, scene.linearised, scene.view)
        is_hidden = tilt - STEEPEST_RAD > BEYOND_LIMIT_SD * np.sqrt(variance + STEEPEST_SD_RAD**2)
        is_removed = is_back & (is_hidden | is_beyond_limits(mean, covariance)[:, None])
    # Lone discs beyond the first on a digit that may be far off, for which any blob would do: those that come back
    # alone, and the end of the thumb, whose joints can bring it anywhere.
    is_lone = is_back & (is_assigned.sum(axis=1) == 1)[:, None]
    is_lone[:, 0] = False
    is_lone[0, 2] |= is_assigned[0, 2] & ~is_assigned[0, 1]
    if is_lone.any():
        is_removed = is_removed | (is_lone & find_far_digits(scene.state_covariance, is_assigned)[:, None])
    return remove_markers(is_removed, updated, estimates, scene, settings) if is_removed.any() else updated


def remove_markers(
    is_removed: NDArray[np.bool_],
    updated: UpdatedDigits,
    estimates: ModeMixture,
    scene: DigitScene,
    settings: TrackerSettings,
) -> UpdatedDigits:
    """Update the digits again without the blobs of some discs (5, 3)."""
    assigned = np.where(is_removed, -1, updated.assignment.assigned)
    assignment = DigitAssignment(assigned, updated.assignment.with_depth & ~is_removed)
    return update_digits(estimates, scene, assignment, settings)


def find_far_digits(covariance: FloatArray, is_assigned: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Find digits (5,) whose seen discs may put their joints far from where they were predicted.

    ``covariance`` (5, n, n), ``is_assigned`` (5, 3) discs that are seen.
    """
    shown = (SLOT_MOVES_DISC & is_assigned[:, None, :]).any(axis=-1)
    return np.asarray((shown & (covariance[:, _SLOT, _SLOT] > MAX_LINEAR_SD_RAD**2)).any(axis=1))


def is_beyond_limits(mean: FloatArray, covariance: FloatArray) -> NDArray[np.bool_]:
    """Return which digits (5,) are bent surely beyond their limits, by means and covariances."""
    sd = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)[:, :N_SLOTS] + LIMIT_SD_RAD**2)
    return np.asarray((np.abs(compute_limit_excess(mean[:, :N_SLOTS])) > BEYOND_LIMIT_SD * sd).any(axis=1))


def _associate_separately(scene: DigitScene, settings: TrackerSettings) -> DigitAssignment:
    if not len(scene.blobs):
        return DigitAssignment(np.full((N_DIGITS, N_DISCS), -1), np.zeros((N_DIGITS, N_DISCS), dtype=bool))
    own = settings.association
    own_covariance = scene.image_covariance.reshape(N_DIGITS, N_DISCS, 3, N_DISCS, 3).diagonal(axis1=1, axis2=3)
    by_disc, with_depth = association.log_odds(
        scene.linearised.value.reshape(-1, 3),
        np.moveaxis(own_covariance, -1, 1).reshape(-1, 3, 3),
        scene.blobs.value,
        scene.blobs.variance,
        scene.resolution_px2 / EXPECTED_CLUTTER,
        own,
    )
    # A marker's prior says how likely it is to be seen, which is known better here.
    log_seen = np.log(scene.visible / (1.0 - scene.visible)) - math.log(own.prior_marker / own.prior_clutter)
    log_seen[~scene.has_discs] = association.LOG_IMPOSSIBLE
    odds = by_disc + log_seen.reshape(-1, 1)
    odds[:, ~scene.is_free] = association.LOG_IMPOSSIBLE
    assigned = association.assign_blobs(odds)
    uses_depth = with_depth[np.arange(assigned.size), assigned] & (assigned >= 0)
    return DigitAssignment(assigned.reshape(N_DIGITS, N_DISCS), uses_depth.reshape(N_DIGITS, N_DISCS))


def measurements_from_assignment(
    scene: DigitScene, assignment: DigitAssignment, settings: TrackerSettings
) -> tuple[FloatArray, FloatArray]:
    """Return what the assigned blobs measure (5, 9), NaN where there is none, and its variance (5, 9)."""
    return measure_assigned_discs(
        scene,
        assignment,
        settings.noise.pixel_sd_px**2 + SKIN_SD_PX**2,
        settings.marker_radius_m,
        (CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE),
        (CROWDED_RADII, CROWDED_PX),
        (MIN_VISIBLE_PROBABILITY, MIN_MERGED_AREA_RATIO, MERGED_SD_SHARE),
    )


def update_digits(
    estimates: ModeMixture, scene: DigitScene, assignment: DigitAssignment, settings: TrackerSettings
) -> UpdatedDigits:
    """Update all digits by the assigned blobs."""
    measured, variance = measurements_from_assignment(scene, assignment, settings)
    partial = partial_update_shares(DIGIT_SIZE, ANATOMY, scene.learning_share)
    update = update_mixture(estimates, scene.linearised, measured, variance, scene.palm_covariance, partial)
    return UpdatedDigits(assignment, update, measured, variance)


def _associate_digit_jointly(
    chain: int, scene: DigitScene, blobs: NDArray[np.int64], settings: TrackerSettings
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Find the most probable association (3,) of one digit's discs with ``blobs``, and depths used."""
    if not blobs.size:
        return np.full(N_DISCS, -1, dtype=np.int64), np.zeros(N_DISCS, dtype=bool)
    value, spread = scene.linearised.value[chain], scene.image_covariance[chain]
    gate_squared = 2.0 * settings.association.gate_sd**2
    candidates: list[list[tuple[int, bool]]] = []  # blob, and whether its depth is used
    for disc in range(N_DISCS):
        rows = slice(3 * disc, 3 * disc + 3)
        difference = scene.blobs.value[blobs] - value[rows]
        variance = np.diagonal(spread[rows, rows]) + scene.blobs.variance[blobs]
        in_image = (difference[:, :2] ** 2 / variance[:, :2]).sum(axis=1)
        in_space = in_image + difference[:, 2] ** 2 / variance[:, 2]
        without_depth = in_image + NO_DEPTH_PENALTY
        nearest = np.argsort(np.fmin(in_space, without_depth))[:MAX_CANDIDATES]
        is_deep = in_space <= gate_squared
        near = [(int(blobs[i]), bool(is_deep[i])) for i in nearest if not in_image[i] > gate_squared]
        candidates.append([(-1, False), *near])
    branches = [
        one for one in product(*candidates) if len({b for b, _ in one if b >= 0}) == sum(b >= 0 for b, _ in one)
    ]
    assigned = np.array([[b for b, _ in one] for one in branches])
    depth = np.array([[d for _, d in one] for one in branches])
    is_assigned = assigned >= 0
    is_used = np.repeat(is_assigned[..., None], 3, axis=-1)
    is_used[..., 2] = depth
    is_used = is_used.reshape(-1, 9)
    blob = np.maximum(assigned, 0)
    variance = np.where(is_assigned[..., None], scene.blobs.variance[blob], 1.0).reshape(-1, 9)
    variance = np.where(is_used, variance * scene.noise_factor[chain], 1.0)
    measured = np.where(is_assigned[..., None], scene.blobs.value[blob], 0.0).reshape(-1, 9)
    unit = np.where(is_used, 1.0 / np.sqrt(variance), 0.0)
    s = spread * (unit[:, :, None] * unit[:, None, :]) + np.eye(9)
    innovation = np.where(is_used, measured - value, 0.0) * unit
    nis = np.einsum("wi,wi->w", innovation, np.linalg.solve(s, innovation[..., None])[..., 0])
    log_normal = -0.5 * (nis + np.linalg.slogdet(s)[1] + is_used.sum(axis=1) * _LOG_2_PI) + np.sum(
        np.log(np.where(is_used, unit, 1.0)), axis=1
    )
    log_visible = np.log(scene.visible[chain] / (1.0 - scene.visible[chain]))
    log_area = float(np.log(scene.resolution_px2 / EXPECTED_CLUTTER))
    log_range = float(np.log(settings.association.depth_range_m))
    log_outlier = np.where(np.isfinite(scene.blobs.value[blob, 2]), np.log(association.DEPTH_OUTLIER_PROBABILITY), 0.0)
    log_clutter = log_area + np.where(depth, log_range, log_outlier)
    score = log_normal + np.sum(np.where(is_assigned, log_visible + log_clutter, 0.0), axis=1)
    best = int(np.argmax(score))
    return assigned[best], depth[best]

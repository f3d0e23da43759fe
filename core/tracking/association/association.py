"""Association of blobs with markers: eq. (6) to (12) of the wrist paper, resolved jointly.

For every blob i and marker j the posterior p(a_i = j) is proportional to N(y_i; predicted, P) times a prior; for
clutter it is the density 1/RES (times 1/depth range where depth takes part) times a prior. The paper then takes the
best j for each blob alone; here the product over all blobs is maximised under the constraint that no marker and no blob
is used twice.

The discs are on one hand: where one is decides where the others can be. Judging each marker by itself, as (12) does,
forgets that, and after a surprise neighbours are swapped. Where the separate association is not jointly compatible, the
joint posterior of all associations is searched: a beam over the markers, each decision narrowing where the rest may be
(Neira and Tardos 2001, weighed by probability instead of a gate alone).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.association import compute_log_odds
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.predicted_measurement import (
    Measurements,
    PredictedMeasurement,
    UpdatedPalm,
    update_palm,
)
from carpus.core.tracking.filter.settings import AssociationSettings, MeasurementNoise, TrackerSettings

LOG_IMPOSSIBLE = -1e9  # log odds of an association outside the gate

MAX_OUTLIERS = 3  # measurements in a frame that are given the noise they show
DEPTH_OUTLIER_PROBABILITY = 1e-4  # that a blob's depth is of something else


@lru_cache(maxsize=8)
def log_densities(resolution_px2: float, settings: AssociationSettings) -> tuple[float, float, float]:
    """Return logs of densities: marker prior and clutter in the image, clutter in depth, depth outlier.

    The first two but for those of the normal density.
    """
    prior = settings.prior_marker / settings.prior_clutter * resolution_px2 / (2.0 * math.pi)
    by_depth = settings.depth_range_m / math.sqrt(2.0 * math.pi)
    return math.log(prior), math.log(by_depth), math.log(DEPTH_OUTLIER_PROBABILITY)


def log_odds(
    predicted: FloatArray,
    covariance: FloatArray,
    measured: FloatArray,
    noise_variance: FloatArray,
    resolution_px2: float,
    settings: AssociationSettings,
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Return the odds of every marker and blob, and whether the blob's depth is used; (M, D) each.

    The log of (12) for the marker over (12) for clutter, ``LOG_IMPOSSIBLE`` outside the gate. A depth that is not used
    is that of something before or behind the disc. Markers and blobs as in
    :func:`core.compiled.association.compute_log_odds`; ``resolution_px2`` area of the image, RES.
    """
    densities = log_densities(resolution_px2, settings)
    return compute_log_odds(
        predicted, covariance, measured, noise_variance, densities, settings.gate_sd**2, LOG_IMPOSSIBLE
    )


def assign_blobs(odds: FloatArray) -> NDArray[np.int64]:
    """Return the blob of every marker (M,), -1 for none: the assignment of greatest posterior.

    Leaving a blob to clutter costs nothing, so only positive odds are used.
    """
    gain = np.fmax(odds, 0.0)
    likeliest = [row.index(most) if (most := max(row, default=0.0)) > 0.0 else -1 for row in gain.tolist()]
    taken = [blob for blob in likeliest if blob >= 0]
    if len(set(taken)) == len(taken):  # no two markers would take the same blob
        return np.array(likeliest)
    from scipy.optimize import linear_sum_assignment  # a third of a second to load, and seldom needed

    rows, columns = linear_sum_assignment(gain, maximize=True)
    assigned = np.full(len(odds), -1)
    assigned[rows] = np.where(gain[rows, columns] > 0.0, columns, -1)
    return assigned


MAX_DOF, MAX_NEWTON_STEPS = 200, 40


@lru_cache(maxsize=4)
def chi2_quantiles(probability: float) -> tuple[float, ...]:
    """Return quantiles of chi squared by degrees of freedom.

    Newton's steps on the logarithm of the upper tail, which is a finite sum. (SciPy's are the same within 1e-14, and
    take as long to load as all of NumPy.)
    """
    if probability >= 1.0:
        return (np.inf,) * MAX_DOF
    dof = np.arange(1.0, MAX_DOF)
    is_odd = dof % 2.0
    powers = 0.5 * is_odd[:, None] + np.arange(MAX_DOF // 2)
    log_gamma = np.array([math.lgamma(0.5 * twice) for twice in range(1, 2 * MAX_DOF)])
    log_factor = np.where(powers < 0.5 * dof[:, None], -log_gamma[(2.0 * powers).astype(int) + 1], -np.inf)
    half = 0.5 * dof
    for _ in range(MAX_NEWTON_STEPS):
        above = np.exp(powers * np.log(half)[:, None] - half[:, None] + log_factor).sum(axis=1)
        above += is_odd * [math.erfc(math.sqrt(one)) for one in half]
        density = np.exp((0.5 * dof - 1.0) * np.log(half) - half - log_gamma[: dof.size])
        step = above * (np.log(above) - math.log1p(-probability)) / density
        half = np.maximum(half + step, 0.1 * half)
        if (np.abs(step) <= 1e-14 * half).all():
            break
    return (np.inf, *(2.0 * half).tolist())


def is_jointly_compatible(nis: float, dof: int, settings: AssociationSettings) -> bool:
    """Return whether the joint NIS of all markers is within its bound."""
    most = chi2_quantiles(settings.consistency_probability)
    return dof == 0 or nis <= most[min(dof, len(most) - 1)]


@dataclass(frozen=True, slots=True)
class JointAssociation:
    """An association of all markers.

    ``assigned`` (M,) blob of every marker or -1, ``with_depth`` (M,) whether its depth is used; ``log_posterior`` over
    that of calling every blob clutter.
    """

    assigned: NDArray[np.int64]
    with_depth: NDArray[np.bool_]
    log_posterior: float


@dataclass(frozen=True, slots=True)
class _Branches:
    """B associations of the first m markers, side by side.

    ``assigned`` and ``with_depth`` (B, m), ``score`` (B,), and the prediction given them, ``mean`` (B, 3M) and
    ``covariance`` (B, 3M, 3M).
    """

    assigned: NDArray[np.int64]
    with_depth: NDArray[np.bool_]
    score: FloatArray
    mean: FloatArray
    covariance: FloatArray


def associate_jointly(
    mean: FloatArray,
    covariance: FloatArray,
    measured: FloatArray,
    noise_variance: FloatArray,
    resolution_px2: float,
    settings: AssociationSettings,
) -> JointAssociation:
    """Find the most probable association of all blobs together.

    ``mean`` (3M,) and ``covariance`` (3M, 3M) of the predicted pixels and depths of all markers; ``measured`` (D, 3),
    depth NaN where unknown; ``noise_variance`` (D, 3).
    """
    markers = mean.size // 3
    prior = float(np.log(settings.prior_marker) - np.log(settings.prior_clutter))
    base = float(np.log(resolution_px2)) + prior
    # By the number of measured coordinates: clutter's depth is spread over a range; a depth that is left out was wrong.
    clutter = {
        3: np.full(len(measured), base + float(np.log(settings.depth_range_m))),
        2: base + np.where(np.isfinite(measured[:, 2]), np.log(DEPTH_OUTLIER_PROBABILITY), 0.0),
    }
    by_certainty = np.argsort(
        [np.linalg.det(covariance[3 * j : 3 * j + 2, 3 * j : 3 * j + 2]) for j in range(markers)], kind="stable"
    )
    none = np.empty((1, 0))
    branches = _Branches(none.astype(np.int64), none.astype(bool), np.zeros(1), mean[None], covariance[None])
    for marker in by_certainty:
        block = slice(3 * int(marker), 3 * int(marker) + 3)
        options = [branches.score[:, None]]
        difference = measured - branches.mean[:, None, block]
        own = branches.covariance[:, block, block]
        is_used = (branches.assigned[:, :, None] == np.arange(len(measured))).any(axis=1)
        for used in (3, 2):
            distance2, log_normal = _log_normal_density(
                difference[..., :used], own[:, :used, :used], noise_variance[:, :used]
            )
            possible = (distance2 <= settings.gate_sd**2) & ~is_used
            options.append(np.where(possible, branches.score[:, None] + log_normal + clutter[used], -np.inf))
        score = np.concatenate(options, axis=1)  # (B, 1 + 2 D): no blob, each with its depth, each without
        order = np.argsort(-score, axis=None, kind="stable")[: settings.beam_width]
        order = order[np.isfinite(score.ravel()[order])]
        parent, option = np.divmod(order, score.shape[1])
        branches = _extend_branches(branches, parent, option, score.ravel()[order], block, measured, noise_variance)
    best = int(np.argmax(branches.score))
    assigned = np.full(markers, -1, dtype=np.int64)
    with_depth = np.zeros(markers, dtype=bool)
    assigned[by_certainty] = branches.assigned[best]
    with_depth[by_certainty] = branches.with_depth[best]
    return JointAssociation(assigned, with_depth, float(branches.score[best]))


def _log_normal_density(
    difference: FloatArray, covariance: FloatArray, noise_variance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return squared distance (B, D) in standard deviations and log density.

    Of ``difference`` (B, D, k) under covariances (B, k, k) plus each blob's noise (D, k).
    """
    axes = np.arange(difference.shape[-1])
    s = np.repeat(covariance[:, None], len(noise_variance), axis=1)
    s[..., axes, axes] += noise_variance
    distance2 = np.sum(difference * np.linalg.solve(s, difference[..., None])[..., 0], axis=-1)
    return distance2, -0.5 * (distance2 + np.linalg.slogdet(s)[1] + axes.size * np.log(2 * np.pi))


def _extend_branches(
    branches: _Branches,
    parent: NDArray[np.int64],
    option: NDArray[np.int64],
    score: FloatArray,
    block: slice,
    measured: FloatArray,
    noise_variance: FloatArray,
) -> _Branches:
    """Extend the branches ``parent`` by one marker each and update the other markers' predictions."""
    blobs = len(measured)
    blob = np.where(option > 0, (option - 1) % max(blobs, 1), -1)
    with_depth = (option > 0) & (option <= blobs)
    mean, covariance = branches.mean[parent], branches.covariance[parent]
    if blobs:
        # A coordinate that takes no part has no covariance with anything and unit variance: its gain is nothing.
        used = np.repeat((blob >= 0)[:, None], 3, axis=1)
        used[:, 2] &= with_depth
        cross = np.where(used[..., None], covariance[:, block], 0.0)  # (B, 3, 3M)
        s = np.where(used[:, None], cross[..., block], 0.0)
        axes = np.arange(3)
        s[:, axes, axes] += np.where(used, noise_variance[blob], 1.0)
        gain = np.swapaxes(np.linalg.solve(s, cross), 1, 2)
        innovation = np.where(used, measured[blob] - mean[:, block], 0.0)
        mean = mean + (gain @ innovation[..., None])[..., 0]
        covariance = covariance - gain @ cross
    return _Branches(
        np.column_stack((branches.assigned[parent], blob)),
        np.column_stack((branches.with_depth[parent], with_depth)),
        score,
        mean,
        covariance,
    )


def associate_and_update(
    predicted: PredictedMeasurement,
    blobs: Measurements,
    min_assigned: int,
    resolution_px2: float,
    noise_factor: FloatArray,
    settings: TrackerSettings,
) -> UpdatedPalm:
    """Associate by (12), each marker by itself; where not jointly compatible, all jointly.

    Compatible: the joint NIS is within its bound, and ``min_assigned`` markers have a blob unless no blob is left.
    """
    mean, covariance = predicted.mean, predicted.covariance
    markers = len(mean)
    if not len(blobs):
        nothing = np.full(markers, -1, dtype=np.int64)
        return update_palm(predicted, blobs, nothing, nothing > 0, noise_factor)
    odds, uses_depth = log_odds(mean, covariance, blobs.value, blobs.variance, resolution_px2, settings.association)
    assigned = assign_blobs(odds)
    with_depth = uses_depth[np.arange(markers), assigned]
    assigned = _reject_wrong_depths(assigned, with_depth, blobs, mean[:, 2], settings.association)
    simple = update_palm(predicted, blobs, assigned, with_depth, noise_factor)
    count = np.count_nonzero(assigned >= 0)
    if (count >= min_assigned or count == len(blobs)) and is_jointly_compatible(
        simple.nis, simple.dof, settings.association
    ):
        return _inflate_outlier_noise(simple, predicted, blobs, with_depth, noise_factor, settings.noise)
    joint = _associate_by_mode(predicted, blobs, resolution_px2, settings)
    assigned = _reject_wrong_depths(joint.assigned, joint.with_depth, blobs, mean[:, 2], settings.association)
    updated = update_palm(predicted, blobs, assigned, joint.with_depth, noise_factor)
    return _inflate_outlier_noise(updated, predicted, blobs, joint.with_depth, noise_factor, settings.noise)


def _reject_wrong_depths(
    assigned: NDArray[np.int64],
    with_depth: NDArray[np.bool_],
    blobs: Measurements,
    depth_m: FloatArray,
    settings: AssociationSettings,
) -> NDArray[np.int64]:
    """Drop blobs at another depth than ``depth_m`` (M,), unless enough markers bear them out.

    What covers the hand may have blue on it: alone, a blob before or behind a disc's place is not that disc, and far
    before or behind it none is: the depths of a disc's rim and of what is beside it mix only where these lie near.
    """
    is_off_depth = (assigned >= 0) & ~with_depth
    if not is_off_depth.any():
        return assigned
    off_m = np.abs(blobs.value[assigned, 2] - depth_m)
    is_off_depth &= np.isfinite(off_m)
    if np.count_nonzero((assigned >= 0) & ~is_off_depth) >= settings.min_markers_at_depth:
        is_off_depth &= off_m > settings.max_depth_error_m
    return np.where(is_off_depth, -1, assigned)


def _associate_by_mode(
    predicted: PredictedMeasurement, blobs: Measurements, resolution_px2: float, settings: TrackerSettings
) -> JointAssociation:
    """Find the most probable joint association over all motion modes.

    While the hand rests the mixture of the modes is as narrow as the calm one; a start is seen by the lively one.
    """
    every = [
        associate_jointly(mean, covariance, blobs.value, blobs.variance, resolution_px2, settings.association)
        for mean, covariance in zip(*predicted.mode_predictions(), strict=True)
    ]
    score = [one.log_posterior for one in every] + np.log(predicted.mixture.probability[0])
    return every[int(np.argmax(score))]


def _inflate_outlier_noise(
    updated: UpdatedPalm,
    predicted: PredictedMeasurement,
    blobs: Measurements,
    with_depth: NDArray[np.bool_],
    noise_factor: FloatArray,
    noise: MeasurementNoise,
) -> UpdatedPalm:
    """Update again, the worst measurements given the noise that their residuals show, one by one.

    A disc half behind the rim is still that disc, but its centre is not where it seems.
    """
    factor = noise_factor
    for _ in range(MAX_OUTLIERS):
        marker, axis = divmod(int(np.abs(updated.residual).argmax()), 3)
        size = abs(float(updated.residual[marker, axis]))
        if size <= noise.outlier_sd:
            break
        factor = factor.copy()
        factor[marker, 2:] *= size**2 if axis == 2 else 1.0
        factor[marker, :2] *= 1.0 if axis == 2 else size**2
        updated = replace(
            update_palm(predicted, blobs, updated.assigned, with_depth, factor), raw_residual=updated.raw_residual
        )
    return updated

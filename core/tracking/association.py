"""Which blob is which marker: eq. (6) to (12) of the wrist paper, resolved jointly.

For every blob i and marker j the posterior p(a_i = j) is proportional to N(y_i; predicted, P) times a
prior; for clutter it is the density 1/RES (times 1/depth range where depth takes part) times a prior.
The paper then takes the best j for each blob alone; here the product over all blobs is maximised under
the constraint that no marker and no blob is used twice.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from core.types import FloatArray

IMPOSSIBLE = -1e9


@dataclass(frozen=True, slots=True)
class AssociationSettings:
    """Priors and densities of (12).

    ``prior_marker``: that a blob is one given marker; ``prior_clutter``: that it is none.
    ``gate_sd``: blobs further than this from a prediction (in standard deviations of the innovation) are
    never that marker. ``depth_range_m``: over which clutter's depth is spread.
    """

    prior_marker: float = 0.9
    prior_clutter: float = 0.1
    gate_sd: float = 5.0
    depth_range_m: float = 0.5


def _distance2(s: FloatArray, difference: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Squared Mahalanobis distances and log-determinants for symmetric (..., d, d), d = 2 or 3, closed form."""
    x, y = difference[..., 0], difference[..., 1]
    a, b, d = s[..., 0, 0], s[..., 0, 1], s[..., 1, 1]
    if s.shape[-1] == 2:
        det = a * d - b * b
        return (d * x * x - 2.0 * b * x * y + a * y * y) / det, np.log(det)
    z, c, e, f = difference[..., 2], s[..., 0, 2], s[..., 1, 2], s[..., 2, 2]
    aa, bb, cc = d * f - e * e, c * e - b * f, b * e - c * d
    dd, ee, ff = a * f - c * c, b * c - a * e, a * d - b * b
    det = a * aa + b * bb + c * cc
    square = aa * x * x + dd * y * y + ff * z * z + 2.0 * (bb * x * y + cc * x * z + ee * y * z)
    return square / det, np.log(det)


@dataclass(frozen=True, slots=True)
class LogOdds:
    """Log of (12) for marker j over (12) for clutter, (M, D); ``IMPOSSIBLE`` outside the gate.

    ``with_depth``: whether the blob's depth is believed; where not, it is the depth of something else.
    """

    value: FloatArray
    with_depth: NDArray[np.bool_]


def log_odds(
    predicted: FloatArray,
    covariance: FloatArray,
    measured: FloatArray,
    noise_variance: FloatArray,
    resolution_px2: float,
    depth_outlier: float,
    settings: AssociationSettings,
) -> LogOdds:
    """Odds of every marker and blob.

    ``predicted`` (M, 3) and ``covariance`` (M, 3, 3): pixel u, v and depth m; ``measured`` (D, 3), its depth
    NaN where unknown (then only the pixel counts, and clutter's density is 1/RES);
    ``noise_variance`` (D, 3). A disc whose depth is of something before or behind it is still that disc,
    with the chance ``depth_outlier``.
    """
    s = covariance[:, None] + np.zeros((1, measured.shape[0], 1, 1))
    axes = np.arange(3)
    s[..., axes, axes] += noise_variance
    difference = measured - predicted[:, None, :]
    has_depth = np.isfinite(measured[:, 2])
    prior = np.log(settings.prior_marker) - np.log(settings.prior_clutter)
    flat2, flat_log_det = _distance2(s[..., :2, :2], difference[..., :2])
    flat = prior + np.log(resolution_px2) - 0.5 * (flat2 + flat_log_det) - np.log(2.0 * np.pi)
    flat = np.where(has_depth, flat + np.log(depth_outlier), flat)
    gate2 = settings.gate_sd**2
    flat = np.where(flat2 <= gate2, flat, IMPOSSIBLE)
    if not has_depth.any():
        return LogOdds(flat, np.zeros(flat.shape, dtype=bool))
    full2, full_log_det = _distance2(s, np.where(has_depth[:, None], difference, 0.0))
    full = prior + np.log(resolution_px2 * settings.depth_range_m) - 0.5 * (full2 + full_log_det)
    full = full - 1.5 * np.log(2.0 * np.pi)
    full = np.where(has_depth & (full2 <= gate2), full, IMPOSSIBLE)
    return LogOdds(np.maximum(full, flat), full >= flat)


def posterior(odds: FloatArray) -> FloatArray:
    """p(a_i = j | y_i) of every blob, (D, M + 1), column 0 clutter; rows sum to one: eq. (12)."""
    stacked = np.concatenate((np.zeros((1, odds.shape[1])), odds), axis=0).T
    stacked = stacked - stacked.max(axis=1, keepdims=True)
    weight = np.exp(stacked)
    return np.asarray(weight / weight.sum(axis=1, keepdims=True))


def resolve(odds: FloatArray) -> NDArray[np.int64]:
    """Blob index of every marker (M,), -1 for none: the joint assignment of greatest posterior.

    Leaving a blob to clutter costs nothing, so only positive odds are taken.
    """
    m, d = odds.shape
    taken = np.full(m, -1, dtype=np.int64)
    if d == 0:
        return taken
    gain = np.maximum(odds, 0.0)
    rows, columns = linear_sum_assignment(gain, maximize=True)
    good = gain[rows, columns] > 0.0
    taken[rows[good]] = columns[good]
    return taken

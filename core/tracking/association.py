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


def _inverse_and_log_det(s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Inverse and log-determinant of symmetric (..., d, d), d = 2 or 3, in closed form."""
    if s.shape[-1] == 2:
        a, b, d = s[..., 0, 0], s[..., 0, 1], s[..., 1, 1]
        det = a * d - b * b
        inverse = np.stack((np.stack((d, -b), -1), np.stack((-b, a), -1)), -2) / det[..., None, None]
        return inverse, np.log(det)
    a, b, c = s[..., 0, 0], s[..., 0, 1], s[..., 0, 2]
    d, e, f = s[..., 1, 1], s[..., 1, 2], s[..., 2, 2]
    aa, bb, cc = d * f - e * e, c * e - b * f, b * e - c * d
    det = a * aa + b * bb + c * cc
    dd, ee, ff = a * f - c * c, b * c - a * e, a * d - b * b
    rows = (np.stack((aa, bb, cc), -1), np.stack((bb, dd, ee), -1), np.stack((cc, ee, ff), -1))
    return np.stack(rows, -2) / det[..., None, None], np.log(det)


def log_odds(
    predicted: FloatArray,
    covariance: FloatArray,
    measured: FloatArray,
    noise_variance: FloatArray,
    resolution_px2: float,
    settings: AssociationSettings,
) -> FloatArray:
    """Log of (12) for marker j over (12) for clutter, (M, D); ``IMPOSSIBLE`` outside the gate.

    ``predicted`` (M, 3) and ``covariance`` (M, 3, 3): pixel u, v and depth m; ``measured`` (D, 3), its depth
    NaN where unknown (then only the pixel counts, and clutter's density is 1/RES);
    ``noise_variance`` (D, 3).
    """
    out = np.full((predicted.shape[0], measured.shape[0]), IMPOSSIBLE)
    has_depth = np.isfinite(measured[:, 2])
    prior = np.log(settings.prior_marker) - np.log(settings.prior_clutter)
    for mask, d in ((has_depth, 3), (~has_depth, 2)):
        if not mask.any():
            continue
        s = covariance[:, None, :d, :d] + np.zeros((1, int(mask.sum()), 1, 1))
        axes = np.arange(d)
        s[..., axes, axes] += noise_variance[mask][None, :, :d]
        inverse, log_det = _inverse_and_log_det(s)
        difference = measured[mask][None, :, :d] - predicted[:, None, :d]
        distance2 = np.einsum("mdi,mdij,mdj->md", difference, inverse, difference)
        log_normal = -0.5 * (distance2 + log_det + d * np.log(2.0 * np.pi))
        log_clutter = -np.log(resolution_px2) - (np.log(settings.depth_range_m) if d == 3 else 0.0)
        odds = log_normal - log_clutter + prior
        out[:, mask] = np.where(distance2 <= settings.gate_sd**2, odds, IMPOSSIBLE)
    return out


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

"""Which blob is which marker: eq. (6) to (12) of the wrist paper, resolved jointly.

For every blob i and marker j the posterior p(a_i = j) is proportional to N(y_i; predicted, P) times a
prior; for clutter it is the density 1/RES (times 1/depth range where depth takes part) times a prior.
The paper then takes the best j for each blob alone; here the product over all blobs is maximised under
the constraint that no marker and no blob is used twice.
"""

from __future__ import annotations

import math
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
    count = len(predicted), len(measured)
    s = np.empty((*count, 3, 3))
    s[:] = covariance[:, None]
    s.reshape(*count, 9)[..., ::4] += noise_variance  # the diagonals
    # Innovations in units of their spread, depth last: the first two and their roots are those of the pixel alone.
    root = np.linalg.cholesky(s)
    u, v, z = (measured - predicted[:, None]).transpose(2, 0, 1)
    u = u / root[..., 0, 0]
    v = (v - root[..., 1, 0] * u) / root[..., 1, 1]
    z = (z - root[..., 2, 0] * u - root[..., 2, 1] * v) / root[..., 2, 2]
    flat2 = u * u + v * v
    full2 = flat2 + z * z
    log_root = np.log(root.reshape(*count, 9)[..., ::4])
    has_depth = np.isfinite(measured[:, 2])
    prior = math.log(settings.prior_marker / settings.prior_clutter * resolution_px2 / (2.0 * math.pi))
    flat = prior - 0.5 * flat2 - log_root[..., 0] - log_root[..., 1]
    full = flat + math.log(settings.depth_range_m / math.sqrt(2.0 * math.pi)) - 0.5 * z * z - log_root[..., 2]
    flat += math.log(depth_outlier) * has_depth
    gate2 = settings.gate_sd**2
    flat[flat2 > gate2] = IMPOSSIBLE
    full[~(full2 <= gate2)] = IMPOSSIBLE  # and where there is no depth
    return LogOdds(np.maximum(full, flat), has_depth & (full >= flat))


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

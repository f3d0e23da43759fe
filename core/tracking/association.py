"""Which blob is which marker: eq. (6) to (12) of the wrist paper, resolved jointly.

For every blob i and marker j the posterior p(a_i = j) is proportional to N(y_i; predicted, P) times a
prior; for clutter it is the density 1/RES (times 1/depth range where depth takes part) times a prior.
The paper then takes the best j for each blob alone; here the product over all blobs is maximised under
the constraint that no marker and no blob is used twice.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.assignment import linear_sum_assignment
from carpus.core.kernels.choice import in_c
from carpus.core.types import FloatArray

IMPOSSIBLE = -1e9


@dataclass(frozen=True, slots=True)
class AssociationSettings:
    """Priors and densities of (12).

    ``prior_marker``: that a blob is one given marker; ``prior_clutter``: that it is none.
    ``gate_sd``: blobs further than this from a prediction (in standard deviations of the innovation) are
    never that marker. ``depth_range_m``: over which clutter's depth is spread. ``least_company``: so many discs at
    their depth bear out another whose depth is something else's, unless that is more than ``apart_m`` off. ``beam``: so
    many ways to name all are followed side by side. A set of names is doubted when chance gives a smaller NIS with the
    probability ``consistent``.
    """

    prior_marker: float = 0.9
    prior_clutter: float = 0.1
    gate_sd: float = 5.0
    depth_range_m: float = 0.5
    least_company: int = 3
    apart_m: float = 0.03
    beam: int = 10
    consistent: float = 0.9995


@dataclass(frozen=True, slots=True)
class LogOdds:
    """Log of (12) for marker j over (12) for clutter, (M, D); ``IMPOSSIBLE`` outside the gate.

    ``with_depth``: whether the blob's depth is believed; where not, it is the depth of something else.
    """

    value: FloatArray
    with_depth: NDArray[np.bool_]


@lru_cache(maxsize=8)
def log_densities(
    resolution_px2: float, depth_outlier: float, settings: AssociationSettings
) -> tuple[float, float, float]:
    """Logs of a marker's prior and clutter's density in the picture, of clutter's in depth (both but for those of the
    normal density), and of the chance that a depth is of something else."""
    prior = settings.prior_marker / settings.prior_clutter * resolution_px2 / (2.0 * math.pi)
    by_depth = settings.depth_range_m / math.sqrt(2.0 * math.pi)
    return math.log(prior), math.log(by_depth), math.log(depth_outlier)


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
    prior, by_depth, by_outlier = log_densities(resolution_px2, depth_outlier, settings)
    gate2 = settings.gate_sd**2
    if (kernels := in_c()) is not None:
        shape = len(predicted), len(measured)
        value, with_depth = np.empty(shape), np.empty(shape, dtype=np.bool_)
        kernels.log_odds(
            *shape, predicted, covariance, measured, noise_variance, prior, by_depth, by_outlier, gate2,
            IMPOSSIBLE, value, with_depth,
        )  # fmt: skip
        return LogOdds(value, with_depth)
    # Innovations u, v, z and their variances s (each (M, D)) in turn given those before, the depth last: an L D L'
    # decomposition of the sum of covariance and noise, written out. The first two are those of the pixel alone.
    u, v, z = measured.T[:, None] - predicted.T[..., None]
    s_u, s_v, s_z = covariance.diagonal(axis1=1, axis2=2).T[..., None] + noise_variance.T[:, None]
    uv, uz, vz = covariance[:, :1, 1], covariance[:, :1, 2], covariance[:, 1:2, 2]
    v_by_u, z_by_u = uv / s_u, uz / s_u
    v = v - v_by_u * u
    s_v = s_v - v_by_u * uv
    vz = vz - v_by_u * uz
    z_by_v = vz / s_v
    z = z - z_by_u * u - z_by_v * v
    s_z = s_z - z_by_u * uz - z_by_v * vz
    flat2 = u * u / s_u + v * v / s_v
    z2 = z * z / s_z
    full2 = flat2 + z2
    has_depth = np.isfinite(measured[:, 2])
    flat = prior - 0.5 * (flat2 + np.log(s_u * s_v))
    full = flat + by_depth - 0.5 * (z2 + np.log(s_z))
    flat += by_outlier * has_depth
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
    assigned = [-1] * odds.shape[0]
    if odds.shape[1]:
        # Where the likeliest blobs of all markers are others, none better can be had.
        for marker, row in enumerate(odds.tolist()):
            likeliest = max(row)
            if likeliest > 0.0:
                assigned[marker] = row.index(likeliest)
        named = [blob for blob in assigned if blob >= 0]
        if len(set(named)) == len(named):
            return np.array(assigned, dtype=np.int64)
        assigned = [-1] * odds.shape[0]
        rows, columns = linear_sum_assignment(np.maximum(odds, 0.0), maximize=True)
        for marker, blob in zip(rows.tolist(), columns.tolist(), strict=True):
            if odds.item(marker, blob) > 0.0:
                assigned[marker] = blob
    return np.array(assigned, dtype=np.int64)

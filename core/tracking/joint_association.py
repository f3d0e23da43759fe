"""Association when the easy one does not hold together.

The discs are on one hand: where one is decides where the others can be. Judging each marker by itself, as
(12) does, forgets that, and after a surprise neighbours are taken for each other. Here the joint posterior
of all names is searched: a beam over the markers, each decision narrowing where the rest may be (the joint
compatibility of Neira and Tardos 2001, weighed by probability instead of a gate alone).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaincinv

from core.tracking.association import AssociationSettings
from core.types import FloatArray

BEAM = 10
CONSISTENT = 0.9995
"""A set of associations is doubted when chance gives a greater NIS less often than one in two thousand."""

_LIMITS = np.concatenate(([np.inf], 2.0 * gammaincinv(0.5 * np.arange(1, 200), CONSISTENT)))
"""Quantiles of chi squared by degrees of freedom."""


def holds_together(nis: float, dof: int) -> bool:
    """Whether the innovations of all markers together are what the filter foresaw."""
    return dof == 0 or nis <= float(_LIMITS[min(dof, _LIMITS.size - 1)])


@dataclass(frozen=True, slots=True)
class JointAssociation:
    """``taken`` (M,) blob of every marker or -1, ``with_depth`` (M,) whether its depth was believed;
    ``log_posterior`` over that of calling every blob clutter."""

    taken: NDArray[np.int64]
    with_depth: NDArray[np.bool_]
    log_posterior: float


@dataclass(frozen=True, slots=True)
class _Branch:
    taken: tuple[int, ...]
    with_depth: tuple[bool, ...]
    score: float
    mean: FloatArray
    covariance: FloatArray


def associate_jointly(
    mean: FloatArray,
    covariance: FloatArray,
    measured: FloatArray,
    noise_variance: FloatArray,
    resolution_px2: float,
    depth_outlier: float,
    settings: AssociationSettings,
    beam: int = BEAM,
) -> JointAssociation:
    """Most probable names of all blobs together.

    ``mean`` (3M,) and ``covariance`` (3M, 3M) of the predicted pixels and depths of all markers;
    ``measured`` (D, 3), depth NaN where unknown; ``noise_variance`` (D, 3).
    """
    markers = mean.size // 3
    prior = float(np.log(settings.prior_marker) - np.log(settings.prior_clutter))
    log_area, log_range = float(np.log(resolution_px2)), float(np.log(settings.depth_range_m))
    certain_first = np.argsort(
        [np.linalg.det(covariance[3 * j : 3 * j + 2, 3 * j : 3 * j + 2]) for j in range(markers)], kind="stable"
    )
    branches = [_Branch((), (), 0.0, mean, covariance)]
    for marker in certain_first:
        block = slice(3 * int(marker), 3 * int(marker) + 3)
        children: list[tuple[float, _Branch, int, int]] = []
        for branch in branches:
            children.append((branch.score, branch, -1, 0))
            difference = measured - branch.mean[block]
            own = branch.covariance[block, block]
            for depth_used in (3, 2):
                s = own[:depth_used, :depth_used] + np.zeros((measured.shape[0], 1, 1))
                axes = np.arange(depth_used)
                s[:, axes, axes] += noise_variance[:, :depth_used]
                d = difference[:, :depth_used]
                distance2 = np.einsum("di,di->d", d, np.linalg.solve(s, d[..., None])[..., 0])
                log_normal = -0.5 * (distance2 + np.linalg.slogdet(s)[1] + depth_used * np.log(2 * np.pi))
                odds = log_normal + log_area + prior
                if depth_used == 3:
                    odds = odds + log_range
                else:
                    odds = odds + np.where(np.isfinite(measured[:, 2]), np.log(depth_outlier), 0.0)
                for blob in np.flatnonzero(distance2 <= settings.gate_sd**2):
                    if blob not in branch.taken:
                        children.append((branch.score + float(odds[blob]), branch, int(blob), depth_used))
        children.sort(key=lambda child: -child[0])
        branches = [_grown(child, block, measured, noise_variance) for child in children[:beam]]
    best = max(branches, key=lambda branch: branch.score)
    taken = np.full(markers, -1, dtype=np.int64)
    with_depth = np.zeros(markers, dtype=bool)
    taken[certain_first] = best.taken
    with_depth[certain_first] = best.with_depth
    return JointAssociation(taken, with_depth, best.score)


def _grown(
    child: tuple[float, _Branch, int, int], block: slice, measured: FloatArray, noise_variance: FloatArray
) -> _Branch:
    """The branch with one more name, all other markers' predictions narrowed by it."""
    score, branch, blob, depth_used = child
    if blob < 0:
        return _Branch((*branch.taken, -1), (*branch.with_depth, False), score, branch.mean, branch.covariance)
    rows = slice(block.start, block.start + depth_used)
    s = branch.covariance[rows, rows] + np.diag(noise_variance[blob, :depth_used])
    gain = np.linalg.solve(s, branch.covariance[rows]).T
    mean = branch.mean + gain @ (measured[blob, :depth_used] - branch.mean[rows])
    covariance = branch.covariance - gain @ branch.covariance[rows]
    return _Branch((*branch.taken, blob), (*branch.with_depth, depth_used == 3), score, mean, covariance)

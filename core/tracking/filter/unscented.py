"""Sigma points and their weights (Wan and van der Merwe 2000; Kandepu et al. 2008).

The points of the palm are made in ``predict_palm_measurement`` of :mod:`core.compiled.palm`, those of the digits in
``compute_digit_sigma_points`` of :mod:`core.compiled.digits`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from carpus.core.model.types import FloatArray


@dataclass(frozen=True, slots=True)
class UnscentedParameters:
    """Scaling of the sigma points; with kappa 0 and alpha 1 they stand at sqrt(n) sigma."""

    alpha: float = 0.25
    beta: float = 2.0
    kappa: float = 0.0


@dataclass(frozen=True, slots=True)
class SigmaWeights:
    """``mean`` and ``covariance`` (2n+1,), the centre first; ``scale`` sqrt(n + lambda)."""

    mean: FloatArray
    covariance: FloatArray
    scale: float


@lru_cache(maxsize=64)
def compute_weights(dimension: int, scaling: UnscentedParameters) -> SigmaWeights:
    """Return the weights of the 2n+1 points of an n-dimensional Gaussian."""
    lam = scaling.alpha**2 * (dimension + scaling.kappa) - dimension
    total = dimension + lam
    mean = np.full(2 * dimension + 1, 0.5 / total)
    covariance = mean.copy()
    mean[0] = lam / total
    covariance[0] = mean[0] + 1.0 - scaling.alpha**2 + scaling.beta
    mean.setflags(write=False)
    covariance.setflags(write=False)
    return SigmaWeights(mean, covariance, float(np.sqrt(total)))


def compute_sigma_offsets(covariance: FloatArray, scale: float) -> FloatArray:
    """Return the offsets (..., 2n+1, n) of the sigma points for covariances (..., n, n).

    Raises
    ------
    numpy.linalg.LinAlgError
        When a covariance is not positive definite.
    """
    root = np.linalg.cholesky(covariance)
    columns = np.swapaxes(root, -1, -2) * scale
    n = covariance.shape[-1]
    out = np.zeros((*covariance.shape[:-2], 2 * n + 1, n))
    out[..., 1 : n + 1, :] = columns
    out[..., n + 1 :, :] = -columns
    return out

"""Mixtures of Gaussians, one of each mode of motion: what the filter asks of them in every frame.

Arrays lead with the chain (C) and the mode (K); n numbers each. A mixture is a ``ModeMixture`` of the filter.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from numpy.typing import NDArray


def merged(mixture: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Mean (C, n) and covariance (C, n, n) over the modes: the sum of w (P + a a'), a from the mean."""
    mean: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(mixture.mean)
    covariance: cython.const[cython.double][:, :, :, ::1] = np.ascontiguousarray(mixture.covariance)
    weight: cython.const[cython.double][:, ::1] = np.ascontiguousarray(mixture.probability)
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    if mixture.covariance.shape != (chains, modes, n, n) or mixture.probability.shape != (chains, modes):
        raise ValueError("mean, covariance and probability of a mixture are not of one size")
    out_mean, out_covariance = np.zeros((chains, n)), np.zeros((chains, n, n))
    middle: cython.double[:, ::1] = out_mean
    spread: cython.double[:, :, ::1] = out_covariance
    c: cython.Py_ssize_t
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    for c in range(chains):
        for k in range(modes):
            for i in range(n):
                middle[c, i] += weight[c, k] * mean[c, k, i]
        for i in range(n):
            for k in range(modes):
                w = weight[c, k]
                apart = w * (mean[c, k, i] - middle[c, i])
                for j in range(i + 1):
                    spread[c, i, j] += w * covariance[c, k, i, j] + apart * (mean[c, k, j] - middle[c, j])
            for j in range(i):
                spread[c, j, i] = spread[c, i, j]
    return out_mean, out_covariance

"""Odds that a blob is a marker, in NumPy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray


def compute_log_odds(
    predicted: FloatArray,
    covariance: FloatArray,
    measured: FloatArray,
    noise_variance: FloatArray,
    densities: tuple[float, float, float],
    gate2: float,
    impossible: float,
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Log of (12) for marker j over (12) for clutter (M, D), and whether the blob's depth is believed (M, D)."""
    prior, by_depth, by_outlier = densities
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
    flat[flat2 > gate2] = impossible
    full[~(full2 <= gate2)] = impossible  # and where there is no depth
    return np.maximum(full, flat), has_depth & (full >= flat)

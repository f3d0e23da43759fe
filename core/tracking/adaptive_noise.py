"""Adaptive R: each marker's measurement noise follows its residuals: a disc half behind the rim, a blurred picture."""

from __future__ import annotations

import math

import numpy as np

from carpus.core.kernels.choice import in_c
from carpus.core.tracking.settings import MeasurementNoise
from carpus.core.types import BoolArray, FloatArray


def adapted_factor(
    factor: FloatArray, residual: FloatArray, measured: BoolArray, dt_s: float, noise: MeasurementNoise
) -> FloatArray:
    """Variance factors (..., 3) of u, v and depth after one more frame with these residuals, in standard deviations;
    pixels u, v of a marker share theirs.

    Squared residuals should average one; the factor moves towards what makes them so over ``adapt_s``.
    """
    if dt_s <= 0.0:
        return factor
    weight = 1.0 - math.exp(-dt_s / noise.adapt_s)
    if (kernels := in_c()) is not None:
        out = np.empty(factor.shape)
        kernels.adapted_factors(
            factor.size // 3, factor, residual, measured, weight, noise.least_adapted, noise.most_adapted, out
        )
        return out
    squared = np.where(measured, np.minimum(residual**2, noise.most_adapted), 1.0)
    squared[..., :2] = 0.5 * (squared[..., :1] + squared[..., 1:2])
    grown = factor * (1.0 + weight * (squared - 1.0))
    return np.where(measured, np.clip(grown, noise.least_adapted, noise.most_adapted), factor)

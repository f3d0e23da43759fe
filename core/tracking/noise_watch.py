"""Lets each marker's measurement noise follow its residuals: a disc half behind the rim, a blurred picture."""

from __future__ import annotations

import math

import numpy as np

from core.tracking.naming import Corrected
from core.tracking.settings import MeasurementNoise
from core.types import FloatArray


def watched(factor: FloatArray, corrected: Corrected, dt_s: float, noise: MeasurementNoise) -> FloatArray:
    """The variance factors (M, 3) after one more frame; pixels u, v of a marker share theirs.

    Squared residuals should average one; the factor moves towards what makes them so over ``adapt_s``.
    """
    if corrected.rows.size == 0 or dt_s <= 0.0:
        return factor
    rows, weight = corrected.rows, 1.0 - math.exp(-dt_s / noise.adapt_s)
    squared = np.ones(factor.shape)
    squared.reshape(-1)[rows] = np.minimum(corrected.raw_residual**2, noise.most_adapted)
    squared[:, :2] = 0.5 * (squared[:, :1] + squared[:, 1:2])
    grown = factor * (1.0 + weight * (squared - 1.0))
    out = factor.copy()
    out.reshape(-1)[rows] = np.minimum(np.maximum(grown.reshape(-1)[rows], noise.least_adapted), noise.most_adapted)
    return out

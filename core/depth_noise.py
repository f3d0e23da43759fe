"""How sure a structured-light depth can be (clinical reference 7.2)."""

from __future__ import annotations

import numpy as np

from carpus.core.types import FloatArray

DISPARITY_NOISE_PER_M = 1.425e-3
"""Standard deviation of one depth reading over z^2 (Khoshelham and Elberink 2012)."""
PATTERN_PER_M = 0.5e-3
"""Part of it, over z^2, that stays as long as the surface stays: no averaging over time removes it."""


def reading_sd_m(depth_m: FloatArray) -> FloatArray:
    """Standard deviation (...) of one reading at depths (...)."""
    return np.asarray(DISPARITY_NOISE_PER_M * depth_m**2)


def pattern_sd_m(depth_m: FloatArray) -> FloatArray:
    """Standard deviation (...) of the part that stays."""
    return np.asarray(PATTERN_PER_M * depth_m**2)

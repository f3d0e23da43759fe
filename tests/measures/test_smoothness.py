"""Peaks of a speed, and where nothing may be said of its smoothness."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.measures.speed import count_speed_peaks, sparc
from carpus.core.model.types import FloatArray


def min_jerk_speed(duration_s: float, rate_hz: float) -> FloatArray:
    """Bell-shaped speed of one minimum-jerk movement of unit length."""
    tau = np.arange(0.0, 1.0 + 1e-9, 1.0 / (duration_s * rate_hz))
    return 30.0 * tau**2 * (1.0 - tau) ** 2 / duration_s


@pytest.mark.parametrize(
    "speed",
    [np.ones(7), np.zeros(40), np.full(40, np.nan), np.concatenate((np.ones(20), [np.nan], np.ones(20)))],
    ids=["too short", "no motion", "unknown", "gap"],
)
def test_smoothness_undefined_is_nan(speed: FloatArray) -> None:
    assert math.isnan(sparc(speed, 30.0))


def test_speed_peaks_ignore_ripples_and_close_neighbours() -> None:
    speed = min_jerk_speed(1.0, 30.0)[:-1]
    ripple = speed.copy()
    ripple[20] += 0.01 + speed[19] - speed[20]
    assert count_speed_peaks(ripple, 30.0, 0.02) == 1
    twin = np.array([0.0, 1.0, 0.2, 0.9, 0.0])
    assert count_speed_peaks(twin, 30.0, 0.02) == 1
    assert count_speed_peaks(twin, 10.0, 0.02) == 2
    assert count_speed_peaks(np.full(20, np.nan), 30.0, 0.02) == 0

"""Smoothness against the published vectors and the cases where nothing may be said."""

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


def make_serial_speed(parts: int, rate_hz: float = 30.0) -> FloatArray:
    return np.concatenate([min_jerk_speed(1.0, rate_hz)[:-1]] * parts)


def test_smoothness_of_the_reference_vector_is_exact() -> None:
    t = np.arange(-1.0, 1.0, 0.01)
    speed = np.exp(-5.0 * t**2)
    assert sparc(speed, 100.0) == pytest.approx(-1.41403, abs=5e-6)


@pytest.mark.parametrize(("parts", "arc_length"), [(2, -2.26), (4, -3.10)])
def test_smoothness_falls_with_submovements(parts: int, arc_length: float) -> None:
    assert sparc(make_serial_speed(parts), 30.0) == pytest.approx(arc_length, abs=0.08)


@pytest.mark.parametrize(
    "speed",
    [np.ones(7), np.zeros(40), np.full(40, np.nan), np.concatenate((np.ones(20), [np.nan], np.ones(20)))],
    ids=["too short", "no motion", "unknown", "gap"],
)
def test_smoothness_undefined_is_nan(speed: FloatArray) -> None:
    assert math.isnan(sparc(speed, 30.0))


def test_speed_peaks_ignore_ripples_and_close_neighbours() -> None:
    speed = make_serial_speed(1)
    ripple = speed.copy()
    ripple[20] += 0.01 + speed[19] - speed[20]
    assert count_speed_peaks(ripple, 30.0, 0.02) == 1
    twin = np.array([0.0, 1.0, 0.2, 0.9, 0.0])
    assert count_speed_peaks(twin, 30.0, 0.02) == 1
    assert count_speed_peaks(twin, 10.0, 0.02) == 2
    assert count_speed_peaks(np.full(20, np.nan), 30.0, 0.02) == 0

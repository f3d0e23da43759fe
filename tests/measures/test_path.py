"""Length, straightness and timing of a reach."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.measures.path import farthest_from_start_m, measure_path
from core.measures.signals import Signal, even_signal
from core.types import FloatArray

RATE = 30.0


def reach(length_m: float, bow_m: float = 0.0) -> Signal:
    """One second of minimum jerk along x with a sideways bow, rest before and after."""
    t = np.arange(0.0, 3.0 + 1e-9, 1.0 / RATE)
    tau = np.clip(t - 1.0, 0.0, 1.0)
    s = 10 * tau**3 - 15 * tau**4 + 6 * tau**5
    return even_signal(t, np.column_stack((length_m * s, bow_m * np.sin(math.pi * s), 0.0 * s)))


def test_straight_reach() -> None:
    found = measure_path(reach(0.3), 1.0, 2.0)
    assert found.length_m == pytest.approx(0.3, abs=1e-9)
    assert found.straightness == pytest.approx(1.0, abs=1e-9)
    assert found.peak_speed_m_s == pytest.approx(1.875 * 0.3, rel=0.02)
    assert found.time_to_peak_share == pytest.approx(0.5, abs=0.02)
    assert found.peaks == 1.0
    assert found.sparc == pytest.approx(-1.40, abs=0.05)
    assert found.ldlj < -5.0


def test_half_circle_is_longer_by_half_pi() -> None:
    angle = np.linspace(0.0, math.pi, 61)
    circle: FloatArray = np.column_stack((np.cos(angle), np.sin(angle), 0.0 * angle)) * 0.1
    found = measure_path(even_signal(np.arange(61) / RATE, circle), 0.0, 2.0)
    assert found.straightness == pytest.approx(math.pi / 2, rel=1e-3)


def test_undefined_cases() -> None:
    assert math.isnan(measure_path(reach(0.04), 1.0, 2.0).straightness)
    assert measure_path(reach(0.04), 1.0, 2.0).length_m == pytest.approx(0.04, abs=1e-9)
    signal = reach(0.3)
    signal.value[45:50] = np.nan
    assert math.isnan(measure_path(signal, 1.0, 2.0).length_m)
    assert math.isnan(measure_path(signal, 50.0, 60.0).length_m)


def test_how_far_the_wrist_went() -> None:
    assert farthest_from_start_m(reach(0.03)) == pytest.approx(0.03, abs=1e-6)
    empty = even_signal(np.arange(5) / RATE, np.full((5, 3), np.nan))
    assert math.isnan(farthest_from_start_m(empty))
    late = reach(0.03)
    late.value[: round(0.5 * RATE)] = np.nan  # the hand comes into view late: its place is where it was first seen
    assert farthest_from_start_m(late) == pytest.approx(0.03, abs=1e-6)

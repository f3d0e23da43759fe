"""Validity, and range of motion with error bars."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.measures.motion_range import MotionRange, motion_range
from carpus.core.measures.noise import MAX_CUTOFF_HZ
from carpus.core.measures.repetitions import find_repetitions
from carpus.core.measures.signals import (
    low_pass,
    resample_evenly,
    valid_wrist_angles,
)
from carpus.core.model.types import FloatArray
from tests.measures.ways import RATE, way


def exercise_deg(tops: list[float]) -> FloatArray:
    """Up, a second of hold, and down."""
    parts = [part for top in tops for part in ((0.0, 1.0), (top, 1.0), (0.0, 1.0), (-top, 1.0))]
    return way([*parts, (0.0, 1.0)])


def measure_range(value_deg: FloatArray, valid: FloatArray | None = None) -> MotionRange:
    """Of an angle without noise, known to a degree."""
    t = 5.0 + np.arange(len(value_deg)) / RATE
    both = resample_evenly(t, np.radians(np.column_stack((value_deg, np.ones(len(t))))), valid)
    repetitions = find_repetitions(both.column(0)).repetitions
    return motion_range(low_pass(both.column(0), MAX_CUTOFF_HZ), both.column(1), repetitions)


def test_valid_wrist_angles_exclude_uncertain_and_steep_flexion() -> None:
    angles = np.radians([[1.0, 2.0, 3.0], [1.0, 76.0, 3.0], [np.nan, 2.0, 3.0], [1.0, 2.0, 3.0]])
    sd = np.radians(np.full((4, 3), 1.0))
    sd[3, 2] = math.radians(9.0)
    expected = [[True, True, True], [False, True, False], [False, True, True], [True, True, False]]
    assert valid_wrist_angles(np.ones(4, dtype=bool), angles, sd).tolist() == expected


def test_motion_range_over_repetitions_is_exact() -> None:
    tops = [40.0, 44.0, 48.0, 52.0, 56.0]
    found = measure_range(exercise_deg(tops))
    assert found.repetitions == 5
    np.testing.assert_allclose(np.degrees(found.arc.values), tops, atol=0.3)
    assert math.degrees(found.arc.mean) == pytest.approx(48.0, abs=0.3)
    assert math.degrees(found.arc.spread_sd) == pytest.approx(np.std(tops, ddof=1), abs=0.2)
    assert math.degrees(found.maximum.best) == pytest.approx(56.0, abs=0.3)
    assert math.degrees(found.minimum.best) == pytest.approx(0.0, abs=0.3)
    assert not found.top_limited
    assert not found.bottom_limited


@pytest.mark.parametrize(("share", "measured"), [(0.69, 1), (0.71, 2)])
def test_motion_range_repetition_needs_seven_tenths_visible(share: float, measured: int) -> None:
    value = np.radians(exercise_deg([40.0, 50.0]))
    angle = resample_evenly(np.arange(len(value)) / RATE, value)
    first, second = find_repetitions(angle).repetitions
    found = motion_range(angle, angle, (first, replace(second, valid_share=share)))
    assert found.repetitions == measured
    assert math.degrees(found.arc.best) == pytest.approx(50.0 if measured == 2 else 40.0, abs=0.3)


def test_motion_range_without_repetitions_covers_the_recording() -> None:
    found = measure_range(way([(0.0, 2.0), (7.0, 1.0), (0.0, 2.0)]))
    assert found.repetitions == 0
    assert math.degrees(found.arc.mean) == pytest.approx(7.0, abs=0.1)


def test_motion_range_hand_leaving_at_the_top_is_limited() -> None:
    value = np.concatenate((exercise_deg([40.0] * 3), way([(80.0, 1.0)])))
    found = measure_range(value, valid=value <= 45.0)
    assert math.degrees(found.maximum.best) == pytest.approx(40.0, abs=0.5)
    assert measure_range(value[-30:], valid=value[-30:] <= 45.0).top_limited

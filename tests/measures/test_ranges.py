"""Validity, range of motion with error bars, speed of strokes, and the summary of an angle."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from carpus.core.hand.clinical_angles import rotation_from_angles
from carpus.core.measures.motion_range import MotionRange, motion_range
from carpus.core.measures.noise import HIGHEST_CUTOFF_HZ
from carpus.core.measures.repetitions import find_repetitions
from carpus.core.measures.signals import (
    even_signal,
    low_pass,
    settled,
    valid_angle,
    valid_view,
    valid_wrist_angles,
    view_tilt_rad,
)
from carpus.core.measures.speed import StrokeMeasures, measure_stroke
from carpus.core.types import FloatArray

RATE = 30.0
LOOKING_DOWN = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])


def min_jerk(start: float, end: float, duration_s: float) -> FloatArray:
    tau = np.arange(0.0, 1.0, 1.0 / (duration_s * RATE))
    return start + (end - start) * (10 * tau**3 - 15 * tau**4 + 6 * tau**5)


def exercise_deg(tops: list[float], move_s: float = 1.0, hold_s: float = 1.0) -> FloatArray:
    parts = [np.zeros(30)]
    for top in tops:
        hold = np.full(int(hold_s * RATE), top)
        parts += [min_jerk(0.0, top, move_s), hold, min_jerk(top, 0.0, move_s), np.zeros(20)]
    return np.concatenate(parts)


@dataclass(frozen=True)
class Measured:
    """Range and strokes of an angle without noise."""

    valid_share: float
    range: MotionRange
    strokes: list[StrokeMeasures]

    def stroke_mean(self, quantity: str, *, rising: bool | None = None) -> float:
        return float(np.nanmean([getattr(m, quantity) for m in self.strokes if rising in (None, m.stroke.rising)]))


def summary_of(value_deg: FloatArray, sd_deg: float = 1.0, valid: FloatArray | None = None) -> Measured:
    t = 5.0 + np.arange(len(value_deg)) / RATE
    both = even_signal(t, np.radians(np.column_stack((value_deg, np.full(len(t), sd_deg)))), valid)
    angle, found = both.column(0), find_repetitions(both.column(0))
    measured = motion_range(low_pass(angle, HIGHEST_CUTOFF_HZ), both.column(1), found.repetitions)
    return Measured(angle.valid_share, measured, [measure_stroke(angle, stroke) for stroke in found.strokes])


def test_tilt_of_known_poses() -> None:
    angles = np.radians([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 50.0, 0.0], [0.0, 0.0, -80.0]])
    tilt = view_tilt_rad(rotation_from_angles(angles, "right"), LOOKING_DOWN)
    np.testing.assert_allclose(np.degrees(tilt), [0.0, 0.0, 50.0, 80.0], atol=1e-6)


def test_frames_beside_a_hand_out_of_sight_are_not_measured() -> None:
    time_s = np.arange(60) / 30.0
    view = np.ones(60, dtype=bool)
    view[20:30] = False  # a third of a second
    view[45:48] = False  # a gap that is filled
    kept = settled(view, time_s)
    assert not kept[18:32].any()
    assert kept[:17].all()
    assert kept[33:45].all()
    assert kept[48:].all()
    assert (kept <= view).all()
    assert settled(np.ones(60, dtype=bool), time_s).all()
    assert settled(np.empty(0, dtype=bool), np.empty(0)).shape == (0,)


def test_invalid_views_are_found_each_for_its_reason() -> None:
    status = np.array([0, 1, 2, 0, 0, 0])
    palm = np.ones((6, 6, 2))
    palm[3, :3] = np.nan
    palm[4, :2] = np.nan
    angles = np.zeros((6, 3))
    angles[5, 2] = math.radians(71.0)
    rotation = rotation_from_angles(angles, "left")
    rotation[2] = np.nan
    assert valid_view(status, palm, rotation, LOOKING_DOWN).tolist() == [True, False, False, False, True, False]


def test_unsure_angles_and_steep_flexion() -> None:
    view = np.ones(4, dtype=bool)
    angles = np.radians([[1.0, 2.0, 3.0], [1.0, 76.0, 3.0], [np.nan, 2.0, 3.0], [1.0, 2.0, 3.0]])
    sd = np.radians(np.full((4, 3), 1.0))
    sd[3, 2] = math.radians(9.0)
    expected = [[True, True, True], [False, True, False], [False, True, True], [True, True, False]]
    assert valid_wrist_angles(view, angles, sd).tolist() == expected
    assert not valid_angle(view, angles[:, 0], np.full(4, np.nan)).any()


def test_range_over_repetitions() -> None:
    tops = [40.0, 44.0, 48.0, 52.0, 56.0]
    found = summary_of(exercise_deg(tops)).range
    assert found.repetitions == 5
    np.testing.assert_allclose(np.degrees(found.arc.values), tops, atol=0.3)
    assert math.degrees(found.arc.mean) == pytest.approx(48.0, abs=0.3)
    assert math.degrees(found.arc.spread_sd) == pytest.approx(np.std(tops, ddof=1), abs=0.2)
    assert math.degrees(found.maximum.best) == pytest.approx(56.0, abs=0.3)
    assert math.degrees(found.minimum.best) == pytest.approx(0.0, abs=0.3)
    assert not found.top_limited
    assert not found.bottom_limited


@pytest.mark.parametrize(("share", "measured"), [(0.69, 1), (0.71, 2)])
def test_a_repetition_seen_for_less_than_seven_tenths_is_not_measured(share: float, measured: int) -> None:
    value = np.radians(exercise_deg([40.0, 50.0]))
    angle = even_signal(np.arange(len(value)) / RATE, value)
    first, second = find_repetitions(angle).repetitions
    found = motion_range(angle, angle, (first, replace(second, valid_share=share)))
    assert found.repetitions == measured
    assert math.degrees(found.arc.best) == pytest.approx(50.0 if measured == 2 else 40.0, abs=0.3)


def test_arc_does_not_depend_on_the_neutral_but_the_ends_do() -> None:
    value = exercise_deg([50.0] * 3)
    plain, shifted = summary_of(value).range, summary_of(value - 15.0).range
    assert shifted.arc.mean == pytest.approx(plain.arc.mean, abs=1e-9)
    assert math.degrees(plain.maximum.mean - shifted.maximum.mean) == pytest.approx(15.0, abs=1e-6)


def test_without_repetitions_the_whole_recording_is_one_range() -> None:
    found = summary_of(np.concatenate((np.zeros(60), min_jerk(0.0, 7.0, 1.0), np.full(60, 7.0)))).range
    assert found.repetitions == 0
    assert math.degrees(found.arc.mean) == pytest.approx(7.0, abs=0.1)


def test_nothing_valid_is_unknown_not_zero() -> None:
    value = exercise_deg([40.0] * 3)
    found = summary_of(value, valid=np.zeros(len(value), dtype=bool))
    assert found.valid_share == 0.0
    assert found.range.repetitions == 0
    assert math.isnan(found.range.arc.mean)
    assert math.isnan(found.range.arc.best)


def test_a_top_out_of_sight_is_said_to_be_limited() -> None:
    value = exercise_deg([70.0] * 3)
    found = summary_of(value, valid=value < 60.0).range
    assert found.top_limited
    assert not found.bottom_limited
    assert math.degrees(found.maximum.best) < 61.0


def test_a_hand_that_leaves_at_the_top_for_good_is_limited_too() -> None:
    value = np.concatenate((exercise_deg([40.0] * 3), min_jerk(0.0, 80.0, 1.0)))
    found = summary_of(value, valid=value <= 45.0).range
    assert math.degrees(found.maximum.best) == pytest.approx(40.0, abs=0.5)
    assert summary_of(value[-30:], valid=value[-30:] <= 45.0).range.top_limited


def test_strokes_of_minimum_jerk() -> None:
    found = summary_of(exercise_deg([60.0] * 4, move_s=1.0))
    assert len(found.strokes) == 8
    assert found.stroke_mean("peaks") == 1.0
    assert math.degrees(found.stroke_mean("peak_speed_rad_s")) == pytest.approx(1.875 * 60.0, rel=0.05)
    assert found.stroke_mean("time_to_peak_share") == pytest.approx(0.5, abs=0.06)
    # Minimum jerk passes 5 % of its peak speed after 5.9 % and before 94.1 % of its time.
    assert found.stroke_mean("movement_time_s") == pytest.approx(1.0 - 2 * 0.0594, rel=0.04)
    assert found.stroke_mean("sparc", rising=True) == pytest.approx(-1.42, abs=0.08)
    mean = math.degrees(found.stroke_mean("mean_speed_rad_s", rising=False))
    assert mean == pytest.approx(60.0 / found.stroke_mean("movement_time_s", rising=False), rel=0.02)


def test_directions_are_told_apart() -> None:
    one = np.concatenate((min_jerk(0, 50, 0.7), np.full(10, 50.0), min_jerk(50, 0, 2.0), np.zeros(10)))
    found = summary_of(np.tile(one, 4))
    assert found.stroke_mean("movement_time_s", rising=True) < 0.5 * found.stroke_mean("movement_time_s", rising=False)


def test_a_stroke_with_a_gap_is_unknown() -> None:
    value = exercise_deg([60.0] * 4)
    valid = np.ones(len(value), dtype=bool)
    valid[40:52] = False
    found = summary_of(value, valid=valid)
    assert math.isnan(found.strokes[0].peak_speed_rad_s)
    assert math.isfinite(found.strokes[1].peak_speed_rad_s)
    assert math.isfinite(found.stroke_mean("peak_speed_rad_s", rising=True))

"""Reaches, moving together, tremor, grades and other orders of angles, against plain arithmetic and the reference."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.measures.coordination import co_flexion, enslaving_share, measure_tremor, synergy_share
from carpus.core.measures.reach import find_reaches
from carpus.core.measures.signals import low_pass, resample_evenly
from carpus.core.model.hand.clinical_angles import zyz_with_sd
from carpus.core.model.types import FloatArray
from carpus.core.results.measure import Measure
from carpus.core.results.norms import SHARE_OF_NORMAL, grade_share
from tests.measures.tracked import ONE_PROCESS

pytestmark = ONE_PROCESS
RATE = 30.0


def bell_curve(share: FloatArray) -> FloatArray:
    s = np.clip(share, 0.0, 1.0)
    return 10 * s**3 - 15 * s**4 + 6 * s**5


def test_find_reaches_out_and_back_with_times_and_paths() -> None:
    t = np.arange(0.0, 21.0, 1.0 / RATE)
    way = np.zeros(len(t))
    for k in range(5):
        way += bell_curve((t - 1.0 - 4 * k) / 0.9) - bell_curve((t - 3.0 - 4 * k) / 1.4)
    signal = resample_evenly(t, np.column_stack((0.25 * way, 0.02 * np.sin(math.pi * way), 0.0 * way)))
    found = find_reaches(low_pass(signal))
    assert [reach.is_outward for reach in found] == [True, False] * 5
    for reach in found:
        duration = 0.9 if reach.is_outward else 1.4
        assert reach.movement_time_s == pytest.approx(0.836 * duration, abs=0.1)
        assert reach.path.peak_speed_m_s == pytest.approx(1.875 * 0.25 / duration, rel=0.06)
        assert reach.path.straightness == pytest.approx(1.015, abs=0.02)
        assert reach.path.peaks == 1.0
    assert find_reaches(resample_evenly(t, 0.02 * np.column_stack((way, way, way)))) == ()


def test_co_flexion_finds_correlation_and_lag() -> None:
    t = np.arange(0.0, 12.0, 1.0 / RATE)
    first, second = np.sin(2 * math.pi * 0.4 * t), 0.5 * np.sin(2 * math.pi * 0.4 * (t - 0.2))
    assert co_flexion(first, second, RATE) == pytest.approx((math.cos(2 * math.pi * 0.4 * 0.2), 0.2), abs=0.02)
    assert math.isnan(co_flexion(first, 0.001 * second, RATE)[0])
    assert abs(co_flexion(first[:10], second[:10], RATE)[1]) < 10 / RATE, "less than the longest lag"
    assert synergy_share(np.column_stack((first, 2 * first, -first))) == pytest.approx(1.0)
    assert synergy_share(np.column_stack((first, np.cos(2 * math.pi * 0.4 * t)))) == pytest.approx(0.5, abs=0.05)
    assert enslaving_share(first, 0.26 * first) == pytest.approx(0.26, abs=0.01)


def test_tremor_is_reported_above_noise_only() -> None:
    t = np.arange(0.0, 10.0, 1.0 / RATE)
    rng = np.random.default_rng(3)
    noise = math.radians(0.1)
    held = np.radians(1.5) * np.sin(2 * math.pi * 5.0 * t) + rng.normal(0.0, noise, len(t)) + 0.02 * t
    found = measure_tremor(resample_evenly(t, held), noise)
    assert found.is_tremor
    assert math.degrees(found.rms_rad) == pytest.approx(1.5 / math.sqrt(2.0), rel=0.15)
    assert not measure_tremor(resample_evenly(t, rng.normal(0.0, noise, len(t))), noise).is_tremor
    limits = [measure_tremor(resample_evenly(t, held), found.rms_rad / times).is_tremor for times in (2.9, 3.1)]
    assert limits == [False, True], "three times the noise"
    assert math.isnan(measure_tremor(resample_evenly(t[:100], held[:100]), noise).rms_rad)


@pytest.mark.parametrize(
    ("share", "grade"),
    [(1.01, "excellent"), (1.0, "excellent"), (0.76, "good"), (0.75, "fair"), (0.51, "fair"), (0.5, "poor")],
)
def test_total_active_motion_grades_match_the_reference(share: float, grade: str) -> None:
    row = Measure("share", "TAM3", SHARE_OF_NORMAL, "share", (share,), share)
    assert grade_share(row) == grade
    assert grade_share(replace(row, is_lower_bound=True)) is None


def test_zyz_angles_are_given_where_known() -> None:
    sd = np.radians([0.5, 0.5, 0.5])
    pose = Rotation.from_euler("ZYZ", [40.0, 2.0, -25.0], degrees=True).as_matrix()
    zyz, spread, total = zyz_with_sd(pose, sd, "right")
    assert np.degrees(zyz) == pytest.approx([40.0, 2.0, -25.0])
    assert np.degrees(spread[[0, 2]]) == pytest.approx([15.0, 15.0], abs=1.0), "reference 1.4"
    assert math.degrees(float(total)) == pytest.approx(15.0, abs=0.1)
    zyz, spread, total = zyz_with_sd(np.eye(3), sd, "right")
    assert np.isnan(zyz[[0, 2]]).all()
    assert np.isnan(spread[[0, 2]]).all()
    assert zyz[1] == pytest.approx(0.0), "the tilt itself is always known"
    assert np.degrees(spread[1]) == pytest.approx(0.5, abs=0.01)
    assert float(total) == pytest.approx(0.0)
    tilted = Rotation.from_euler("ZYZ", [10.0, 30.0, 5.0], degrees=True).as_matrix()
    _, spread, _ = zyz_with_sd(np.stack((tilted, np.full((3, 3), np.nan))), np.stack((sd, sd)), "right")
    assert np.degrees(spread[0, 0]) == pytest.approx(1.0, abs=0.15)
    assert np.isnan(spread[1]).all()


@pytest.mark.parametrize("hz", [0.5, 2.5])
def test_tremor_of_a_brisk_exercise_is_none(hz: float) -> None:
    t = np.arange(0.0, 12.0, 1.0 / RATE)
    # Strokes with holds at both ends: what is quick in them lies above 3 Hz too.
    strokes = np.radians(30.0) * np.tanh(3.0 * np.sin(2 * math.pi * hz * t))
    found = measure_tremor(resample_evenly(t, strokes), math.radians(0.25))
    assert not found.is_tremor
    held = np.where(t > 5.0, np.radians(2.0) * np.sin(2 * math.pi * 5.0 * t), strokes)
    found = measure_tremor(resample_evenly(t, held), math.radians(0.25))
    assert found.is_tremor, "held for seven seconds after it"
    assert math.degrees(found.rms_rad) == pytest.approx(2.0 / math.sqrt(2.0), rel=0.15)


@pytest.mark.parametrize("fps", [1.5, 20.0])
def test_tremor_at_low_frame_rate_is_unknown(fps: float) -> None:
    t = np.arange(0.0, 40.0, 1.0 / fps)
    found = measure_tremor(resample_evenly(t, np.full(len(t), 0.3)), math.radians(0.25))
    assert (found.has_few_frames, found.is_tremor) == (True, False)
    assert math.isnan(found.rms_rad)

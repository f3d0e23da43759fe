"""Length, straightness and timing of a reach."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.measures.noise import Noise
from carpus.core.measures.reach import WRIST_NOISE, find_reaches, measure_path
from carpus.core.measures.signals import Signal, resample_evenly
from tests.measures.tracked import ONE_PROCESS, track_simulated
from tests.suites import few

pytestmark = ONE_PROCESS
RATE = 30.0


def make_reach(length_m: float) -> Signal:
    """One second of minimum jerk along x, rest before and after."""
    t = np.arange(0.0, 3.0 + 1e-9, 1.0 / RATE)
    tau = np.clip(t - 1.0, 0.0, 1.0)
    s = 10 * tau**3 - 15 * tau**4 + 6 * tau**5
    return resample_evenly(t, np.column_stack((length_m * s, 0.0 * s, 0.0 * s)))


def test_path_of_a_straight_reach_is_straight() -> None:
    found = measure_path(make_reach(0.3), 1.0, 2.0)
    assert (found.length_m, found.straightness) == pytest.approx((0.3, 1.0), abs=1e-9)
    assert found.time_to_peak_share == pytest.approx(0.5, abs=0.02)
    assert found.sparc == pytest.approx(-1.40, abs=0.05)


def test_path_undefined_cases_are_nan() -> None:
    assert math.isnan(measure_path(make_reach(0.04), 1.0, 2.0).straightness)
    assert measure_path(make_reach(0.04), 1.0, 2.0).length_m == pytest.approx(0.04, abs=1e-9)
    signal = make_reach(0.3)
    signal.value[45:50] = np.nan
    assert math.isnan(measure_path(signal, 1.0, 2.0).length_m)
    assert math.isnan(measure_path(signal, 50.0, 60.0).length_m)


@pytest.mark.parametrize("smoothed", [True, False], ids=["looked back", "live"])
@pytest.mark.parametrize(("seed", "speed_hz", "share", "seconds"), few([(4, 0.06, 1.0, 20.0), (5, 0.05, 0.25, 24.0)]))
def test_reaches_slow_match_the_movement(
    seed: int, speed_hz: float, share: float, seconds: float, smoothed: bool
) -> None:
    take = track_simulated("reach_grasp", seconds, speed_hz, seed, share)
    motion = take.smoothed if smoothed else take.causal
    time_s = take.truth.time_s
    true = find_reaches(resample_evenly(time_s, take.truth.position_m))
    found = find_reaches(resample_evenly(time_s, motion.position_m, take.status == 0), noise=WRIST_NOISE[smoothed])
    assert [reach.is_outward for reach in found] == [reach.is_outward for reach in true]
    assert len(found) >= 2
    for mine, its in zip(found, true, strict=True):
        assert mine.path.peak_speed_m_s == pytest.approx(its.path.peak_speed_m_s, rel=0.08)
        assert mine.path.length_m == pytest.approx(its.path.length_m, rel=0.04)
        assert mine.path.straightness == pytest.approx(its.path.straightness, rel=0.02)
        assert mine.movement_time_s == pytest.approx(its.movement_time_s, rel=0.12)
        assert mine.path.peaks == its.path.peaks == 1.0
        assert math.isnan(mine.path.sparc) or mine.path.sparc == pytest.approx(its.path.sparc, abs=0.1)
    judged = [reach for reach in found if math.isfinite(reach.path.sparc)]
    assert bool(judged) == (share == 1.0)


def test_reaches_lost_in_noise_are_too_slow() -> None:
    time_s = np.arange(0.0, 40.0, 1.0 / RATE)
    tau = np.clip((time_s - 5.0) / 30.0, 0.0, 1.0)
    way = np.column_stack((0.06 * (10 * tau**3 - 15 * tau**4 + 6 * tau**5), 0.0 * tau, 0.0 * tau))
    noise = Noise(0.004, 0.2)
    noisy = way + noise.sample(len(time_s), RATE)[:3].T
    (reach_,) = find_reaches(resample_evenly(time_s, noisy), noise=noise)
    assert reach_.is_too_slow
    assert math.isnan(reach_.movement_time_s)
    assert math.isnan(reach_.path.peak_speed_m_s)
    assert math.isnan(reach_.path.peaks)

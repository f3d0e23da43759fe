"""Speeds, smoothness and extremes of tracked strokes against those of the true movement."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.measures.motion_range import motion_range
from carpus.core.measures.noise import FILTER_CORRELATION_S, Noise, cutoff_for_speed, estimate_extreme
from carpus.core.measures.repetitions import Stroke, find_repetitions
from carpus.core.measures.signals import Signal, low_pass, resample_evenly
from carpus.core.measures.speed import StrokeMeasures, measure_stroke
from tests.measures.tracked import ONE_PROCESS, Tracked, track_simulated
from tests.measures.ways import RATE, make_repetitions
from tests.suites import few

pytestmark = ONE_PROCESS


def find_strokes(take: Tracked, column: int, *, smoothed: bool | None) -> list[StrokeMeasures]:
    """Measures of the true strokes, taken of the true angle (None) or of a tracked one."""
    true = resample_evenly(take.truth.timestamp_s, take.truth.angles_rad[:, column])
    found = find_repetitions(true).strokes
    if smoothed is None:
        return [measure_stroke(true, stroke) for stroke in found]
    angle = make_angle(take, column, smoothed=smoothed)
    return [measure_stroke(angle.column(0), stroke, angle.column(1), smoothed=smoothed) for stroke in found]


def make_angle(take: Tracked, column: int, *, smoothed: bool) -> Signal:
    motion = take.smoothed if smoothed else take.causal
    both = np.column_stack((motion.angles_rad[:, column], motion.angles_sd_rad[:, column]))
    return resample_evenly(take.truth.timestamp_s, both, take.status == 0)


def mean_of_known(measures: list[StrokeMeasures], name: str) -> float:
    return float(np.mean([getattr(one, name) for one in measures]))


EITHER = pytest.mark.parametrize("smoothed", [True, False], ids=["looked back", "live"])
EXERCISES = (("flexion", 1, 20.0, 0.1), ("flexion", 1, 10.0, 0.4), ("fast_deviation", 0, 6.0, 1.3))
"""Motion, column of its angle, seconds, and hertz."""


@EITHER
@pytest.mark.parametrize(("motion", "column", "seconds", "speed_hz"), EXERCISES)
def test_stroke_speed_and_smoothness_match_the_movement(
    motion: str, column: int, seconds: float, speed_hz: float, smoothed: bool
) -> None:
    take = track_simulated(motion, seconds, speed_hz)
    true, found = find_strokes(take, column, smoothed=None), find_strokes(take, column, smoothed=smoothed)
    assert len(found) >= 3
    assert not any(stroke.too_slow for stroke in found)
    # Live flexion at 0.4 Hz peaks 4.3 % too high: the filter keeps what may be gliding skin uncertain,
    # and its error then lasts 0.13 s instead of 0.06 s, which no low-pass of a stroke takes away.
    most = 0.05 if (motion, speed_hz, smoothed) == ("flexion", 0.4, False) else 0.04
    assert mean_of_known(found, "peak_speed_rad_s") == pytest.approx(mean_of_known(true, "peak_speed_rad_s"), rel=most)
    assert mean_of_known(found, "movement_time_s") == pytest.approx(mean_of_known(true, "movement_time_s"), rel=0.04)
    judged = [(one, other) for one, other in zip(true, found, strict=True) if not other.too_slow_to_be_smooth]
    for one, other in judged:
        assert other.sparc == pytest.approx(one.sparc, abs=0.25)
        assert other.peaks == one.peaks or math.isnan(other.peaks)
    if judged:
        assert np.mean([other.sparc - one.sparc for one, other in judged]) == pytest.approx(0.0, abs=0.1)


def make_rise_and_return() -> Signal:
    angle = make_repetitions([(60.0, 1.0)])
    return resample_evenly(np.arange(len(angle)) / RATE, angle)


def measure_strokes(signal: Signal) -> list[StrokeMeasures]:
    return [measure_stroke(signal, stroke) for stroke in find_repetitions(signal).strokes]


def test_noise_speed_sd_matches_samples() -> None:
    noise = Noise(0.4, FILTER_CORRELATION_S)
    drawn = noise.sample(3000, RATE)
    for cutoff_hz in (2.0, 6.0):
        speeds = [
            np.gradient(low_pass(resample_evenly(np.arange(3000) / RATE, row), cutoff_hz).value, 1.0 / RATE)[
                60:-60
            ].std()
            for row in drawn[:8]
        ]
        assert noise.speed_sd(cutoff_hz) == pytest.approx(float(np.mean(speeds)), rel=0.25)
    assert math.isnan(cutoff_for_speed(noise, 1.0, 4.0))
    assert cutoff_for_speed(Noise(0.0, 0.2), 1.0, 4.0) == pytest.approx(10.0)


def test_smoothness_sd_is_the_scatter_that_noise_makes() -> None:
    true = make_rise_and_return()
    (stroke, *_) = find_repetitions(true).strokes
    noise = Noise(math.radians(0.1), FILTER_CORRELATION_S)
    sd = np.full(len(true.value), 2.0 * noise.sd)
    found = []
    for drawn in noise.sample(len(true.value), RATE)[:40]:
        both = resample_evenly(true.time_s, np.column_stack((true.value + drawn, sd)))
        found.append(measure_stroke(both.column(0), stroke, both.column(1), smoothed=False))
    values, sds = np.array([(one.sparc, one.sparc_sd()) for one in found]).T
    assert np.sqrt(np.mean(sds**2)) == pytest.approx(np.std(values), rel=0.4)
    assert measure_stroke(true, stroke).sparc_sd() == 0.0, "no noise"


def test_extreme_of_noisy_values_is_unbiased() -> None:
    held = np.concatenate((np.linspace(0.0, 30.0, 30), np.full(45, 30.0), np.linspace(30.0, 0.0, 30)))
    noise = Noise(0.5, FILTER_CORRELATION_S)
    rng = np.random.default_rng(8)
    found, plain = [], []
    for _ in range(60):
        white = rng.standard_normal(len(held))
        kept = math.exp(-1.0 / (RATE * noise.correlation_s))
        for k in range(1, len(white)):
            white[k] = kept * white[k - 1] + math.sqrt(1 - kept**2) * white[k]
        noisy = held + noise.sd * white
        plain.append(noisy.max())
        found.append(estimate_extreme(noisy, held, noise, RATE, largest=True))
    values, sds = np.array(found).T
    assert np.mean(plain) > 30.7
    assert np.mean(values) == pytest.approx(30.0, abs=0.1)
    assert np.mean(sds) == pytest.approx(np.std(values), rel=0.35)


@EITHER
def test_range_extremes_of_repetitions_are_within_a_degree(smoothed: bool) -> None:
    off_deg, sd_deg = [], []
    for motion, column, seconds, speed_hz in EXERCISES:
        take = track_simulated(motion, seconds, speed_hz)
        true = resample_evenly(take.truth.timestamp_s, take.truth.angles_rad[:, column])
        repetitions = find_repetitions(true).repetitions
        angle = make_angle(take, column, smoothed=smoothed)
        found = motion_range(low_pass(angle.column(0), 10.0), angle.column(1), repetitions, smoothed=smoothed)
        real = motion_range(true, true, repetitions)
        for mine, its, outward in ((found.maximum, real.maximum, 1.0), (found.minimum, real.minimum, -1.0)):
            off_deg += np.degrees(outward * (mine.values - its.values)).tolist()
            sd_deg.append(math.degrees(mine.measurement_sd))
    assert np.abs(off_deg).max() < 1.0
    assert np.mean(off_deg) == pytest.approx(0.0, abs=0.15)
    assert 0.05 < min(sd_deg) <= max(sd_deg) < 1.0


def test_range_extremes_of_finger_joints_are_within_three_degrees() -> None:
    take = track_simulated("fist", 7.5, 0.4, discs="hand21")
    names = list(take.truth.joint_names)
    off_deg = []
    for name in ("MCP2_flexion", "MCP3_flexion", "PIP2_flexion", "PIP3_flexion"):
        k = names.index(name)
        true = resample_evenly(take.truth.timestamp_s, take.truth.joint_angles_rad[:, k])
        repetitions = find_repetitions(true).repetitions
        both = np.column_stack((take.smoothed.joint_angles_rad[:, k], take.smoothed.joint_angles_sd_rad[:, k]))
        angle = resample_evenly(take.truth.timestamp_s, both, take.status == 0)
        found = motion_range(low_pass(angle.column(0), 10.0), angle.column(1), repetitions, smoothed=True)
        real = motion_range(true, true, repetitions)
        off_deg += np.degrees(found.minimum.values - real.minimum.values).tolist()  # the open hand: all discs are seen
    assert len(off_deg) >= 8
    assert np.abs(off_deg).max() < 3.0
    # Measured -0.51: the index finger's PIP is read 1.6 degrees too straight, at a stated sd of 5 (of two more patients
    # 2.6 and 2.2 degrees, and all four joints together -0.08 and -0.43).
    assert np.mean(off_deg) == pytest.approx(0.0, abs=0.6)


def test_stroke_speed_with_occlusion_is_unknown() -> None:
    whole = make_rise_and_return()
    time_s = whole.time_s
    gone = (time_s > 3.2) & (time_s < 3.9)  # in the middle of the way back, at its fastest
    out, *back = measure_strokes(resample_evenly(time_s, whole.value, ~gone))
    assert out.peak_speed_rad_s == pytest.approx(measure_strokes(whole)[0].peak_speed_rad_s, rel=1e-3)
    assert back
    assert all(math.isnan(stroke.peak_speed_rad_s) for stroke in back)
    # A hand that comes back into the picture in the middle of a movement is as little known.
    late = resample_evenly(time_s, whole.value, time_s > 3.4)
    assert math.isnan(measure_stroke(late, Stroke(float(late.time_s[0]), 4.0, is_rising=False)).peak_speed_rad_s)


@EITHER
@pytest.mark.parametrize(
    ("motion", "column", "seconds", "speed_hz", "seed", "share"),
    few([("flexion", 1, 30.0, 0.1, 31, 0.3), ("pronosupination", 2, 30.0, 0.1, 32, 0.5)]),
)
def test_stroke_speed_of_a_slow_stroke_is_not_that_of_noise(
    motion: str, column: int, seconds: float, speed_hz: float, seed: int, share: float, smoothed: bool
) -> None:
    take = track_simulated(motion, seconds, speed_hz, seed, share)
    # Half a way from rest is too little beside the noise of its beginning: up to 38 % too quick. No figure has it.
    true = [one for one in find_strokes(take, column, smoothed=None) if not one.stroke.is_half]
    angle = make_angle(take, column, smoothed=smoothed)
    strokes = [stroke for stroke in find_repetitions(angle.column(0)).strokes if not stroke.is_half]
    found = [measure_stroke(angle.column(0), stroke, angle.column(1), smoothed=smoothed) for stroke in strokes]
    assert len(found) == len(true)
    assert motion != "flexion" or sum(stroke.too_slow_to_be_smooth for stroke in found) >= len(found) - 1
    most = 0.25 if motion == "pronosupination" else 0.12  # measured 16 % and 9 %
    for one, other in zip(true, found, strict=True):
        assert other.too_slow or other.peak_speed_rad_s == pytest.approx(one.peak_speed_rad_s, rel=most, nan_ok=True)
        assert not other.movement_time_s < 0.6 * one.movement_time_s  # unknown is no wrong figure
        assert math.isnan(other.peaks) or other.peaks == 1.0
        assert math.isnan(other.sparc) or other.sparc == pytest.approx(one.sparc, abs=0.25)

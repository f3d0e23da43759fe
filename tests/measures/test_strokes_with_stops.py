"""Strokes of a hand that stops on its way: pauses are part of them, counted and timed."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.measures.motion_range import motion_range
from carpus.core.measures.noise import SMOOTHER_CORRELATION_S, Noise
from carpus.core.measures.repetitions import find_repetitions
from carpus.core.measures.signals import low_pass, resample_evenly
from carpus.core.measures.speed import StrokeMeasures, measure_stroke, sparc
from carpus.core.model.types import FloatArray
from tests.measures.test_noise import make_angle
from tests.measures.tracked import ONE_PROCESS, track_simulated
from tests.measures.ways import RATE, Part, make_repetitions
from tests.suites import few

pytestmark = ONE_PROCESS


def find_strokes(angle: FloatArray, sd_deg: float = 0.0) -> list[StrokeMeasures]:
    time_s = np.arange(len(angle)) / RATE
    signal = resample_evenly(time_s, angle)
    sd = resample_evenly(time_s, np.full(len(angle), math.radians(sd_deg))) if sd_deg else None
    return [measure_stroke(signal, stroke, sd) for stroke in find_repetitions(signal).strokes]


def true_speed(parts: list[Part]) -> FloatArray:
    """Degrees a second, by the formula."""
    out = []
    for arc, duration_s in parts:
        tau = np.arange(round(duration_s * RATE)) / round(duration_s * RATE)
        out.append(30.0 * arc / duration_s * (tau**2 - 2 * tau**3 + tau**4))
    return np.concatenate(out)


@pytest.mark.parametrize(
    ("parts", "published", "pauses"),
    [
        ([(60.0, 1.0)], -1.40, 0),
        ([(60.0, 0.6)], -1.40, 0),
        ([(20.0, 0.6)] * 3, -2.70, 0),
        ([(25.0, 0.8), (0.0, 0.6), (25.0, 0.8)], -3.62, 1),
    ],
    ids=["smooth", "quick", "three stops", "a pause"],
)
def test_stroke_with_a_stop_includes_the_pause(parts: list[Part], published: float, pauses: int) -> None:
    found = find_strokes(make_repetitions(parts))
    assert len(found) == 2
    duration_s = sum(part[1] for part in parts)
    moves = [part for part in parts if part[0]]
    for stroke in found:
        assert stroke.sparc == pytest.approx(published, abs=0.08)
        assert stroke.sparc == pytest.approx(sparc(true_speed(parts), RATE), abs=0.08)
        # A minimum-jerk movement passes 5 % of its peak speed after 5.9 % of its time, 10 % after 8.7 %.
        assert stroke.movement_time_s == pytest.approx(duration_s - 2 * 0.0594 * moves[0][1], abs=0.03)
        arc_rad = math.radians(sum(part[0] for part in parts))
        assert stroke.mean_speed_rad_s == pytest.approx(arc_rad / stroke.movement_time_s, rel=0.02)
        assert math.degrees(stroke.peak_speed_rad_s) == pytest.approx(1.875 * moves[0][0] / moves[0][1], rel=0.02)
        assert stroke.peaks == len(moves)
        assert stroke.pauses == pauses
        assert len(parts) > 1 or stroke.time_to_peak_share == pytest.approx(0.5, abs=0.06)
    if parts[1:] and not parts[1][0]:
        assert found[0].pause_s == pytest.approx(0.6 + 2 * 0.0865 * 0.8, abs=0.03)


parts_of_people = st.lists(
    st.tuples(st.floats(0.0, 40.0), st.floats(0.3, 3.0)).map(lambda part: (part[0] if part[0] > 3.0 else 0.0, part[1])),
    min_size=1,
    max_size=6,
)


@settings(max_examples=25, deadline=None)
@given(parts=parts_of_people, noise_deg=st.sampled_from([0.0, 0.1, 0.3, 0.6]), seed=st.integers(0, 99))
def test_stroke_mean_is_below_peak_and_pauses_within_movement(parts: list[Part], noise_deg: float, seed: int) -> None:
    angle = make_repetitions(parts)
    drawn = Noise(math.radians(noise_deg), SMOOTHER_CORRELATION_S).sample(len(angle), RATE)[seed % 64]
    for stroke in find_strokes(angle + drawn, 2.0 * noise_deg):
        assert not stroke.mean_speed_rad_s > stroke.peak_speed_rad_s
        assert not stroke.pause_s > stroke.movement_time_s
        assert not stroke.movement_time_s > stroke.stroke.end_s - stroke.stroke.start_s + 2.0
        assert not stroke.peaks < 1.0  # none is "not known"
        assert not stroke.sparc > -1.0


def test_stroke_creeping_in_the_turning_band_has_ended() -> None:
    settling = [(58.0, 1.0), (0.0, 0.5), (2.0, 1.5)]
    out, _ = find_strokes(make_repetitions(settling))
    assert out.movement_time_s == pytest.approx(1.0 - 2 * 0.0594, abs=0.03)
    assert out.pauses == 0.0


@pytest.mark.parametrize("hold_s", [0.5, 6.0])
def test_range_arc_is_not_widened_by_a_noisy_hold(hold_s: float) -> None:
    noise, off_deg, plain_deg = Noise(math.radians(0.4), SMOOTHER_CORRELATION_S), [], []
    one = make_repetitions([(60.0, 1.0)], hold_s)
    for drawn in noise.sample(3 * len(one), RATE)[:8]:
        time_s = np.arange(len(drawn)) / RATE
        both = resample_evenly(
            time_s, np.column_stack((np.tile(one, 3) + drawn, np.full(len(drawn), math.radians(0.8))))
        )
        found = find_repetitions(both.column(0))
        smooth = low_pass(both.column(0), 10.0)
        arcs = motion_range(smooth, both.column(1), found.repetitions, smoothed=True).arc.values
        off_deg += np.degrees(arcs).tolist()
        plain_deg += np.degrees(motion_range(smooth, both.column(1), found.repetitions).arc.values).tolist()
    assert np.mean(plain_deg) > 61.0
    assert np.mean(off_deg) == pytest.approx(60.0, abs=0.6)


@pytest.mark.parametrize("smoothed", [True, False], ids=["looked back", "live"])
@pytest.mark.parametrize(("seconds", "speed_hz", "share", "fewest"), few([(12.0, 0.5, 1.5, 3), (24.0, 0.15, 1.0, 0)]))
def test_stroke_smoothness_of_a_tracked_patient_with_stops_is_low(
    seconds: float, speed_hz: float, share: float, fewest: int, smoothed: bool
) -> None:
    take = track_simulated("flexion", seconds, speed_hz, seed=5, share=share, stops=True)
    true = resample_evenly(take.truth.timestamp_s, take.truth.angles_rad[:, 1])
    angle = make_angle(take, 1, smoothed=smoothed)
    pairs = [
        (measure_stroke(true, stroke), measure_stroke(angle.column(0), stroke, angle.column(1), smoothed=smoothed))
        for stroke in find_repetitions(true).strokes
    ]
    known = [(one, other) for one, other in pairs if math.isfinite(one.movement_time_s + other.movement_time_s)]
    assert len(known) >= 4
    times = np.array([(one.movement_time_s, other.movement_time_s) for one, other in known])
    assert times[:, 1].mean() == pytest.approx(times[:, 0].mean(), rel=0.07)
    tops = np.array([(one.peak_speed_rad_s, other.peak_speed_rad_s) for one, other in known])
    assert tops[:, 1].mean() == pytest.approx(tops[:, 0].mean(), rel=0.1)
    for one, other in known:
        assert other.movement_time_s == pytest.approx(one.movement_time_s, rel=0.25)
        # The smoother itself takes up to a quarter off pieces of 0.3 s.
        assert other.peak_speed_rad_s == pytest.approx(one.peak_speed_rad_s, rel=0.3)
        assert math.isnan(other.sparc) or other.sparc == pytest.approx(one.sparc, abs=0.6)
        assert math.isnan(other.pauses) or abs(other.pauses - one.pauses) <= 1.0
    assert sum(math.isfinite(other.sparc) for _, other in known) >= (fewest if smoothed else min(fewest, 1))

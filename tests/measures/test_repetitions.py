"""Counting repetitions: every one, none in noise, and cut where a person would cut them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.measures.repetitions import explain_no_repetitions, find_repetitions
from carpus.core.measures.signals import Signal, resample_evenly
from carpus.core.model.types import FloatArray

RATE = 30.0


def make_signal(value_deg: FloatArray, keep: FloatArray | None = None) -> Signal:
    return resample_evenly(np.arange(len(value_deg)) / RATE, np.radians(value_deg), keep)


def swing_to_both_sides(
    amplitude_deg: float, frequency_hz: float, count: int = 6, noise_deg: float = 0.0, seed: int = 0
) -> FloatArray:
    """Rest, ``count`` full swings to both sides, rest."""
    t = np.arange(0.0, count / frequency_hz, 1.0 / RATE)
    swing = amplitude_deg * np.sin(2.0 * math.pi * frequency_hz * t)
    still = np.zeros(int(RATE))
    value = np.concatenate((still, swing, still))
    return value + np.random.default_rng(seed).normal(0.0, noise_deg, len(value))


def swing_to_one_side(amplitude_deg: float, frequency_hz: float, count: int = 6, hold_s: float = 0.0) -> FloatArray:
    """Rest, ``count`` raised cosines with a hold at the top, rest."""
    t = np.arange(0.0, 0.5 / frequency_hz, 1.0 / RATE)
    up = 0.5 * amplitude_deg * (1.0 - np.cos(2.0 * math.pi * frequency_hz * t))
    one = np.concatenate((up, np.full(int(hold_s * RATE), amplitude_deg), up[::-1]))
    still = np.zeros(int(RATE))
    return np.concatenate((still, *([one] * count), still))


@settings(max_examples=40, deadline=None)
@given(
    amplitude=st.floats(8.0, 50.0),
    frequency=st.floats(0.2, 1.0),
    noise=st.floats(0.0, 2.0),
    seed=st.integers(0, 10_000),
)
def test_find_repetitions_six_swings_gives_six(amplitude: float, frequency: float, noise: float, seed: int) -> None:
    found = find_repetitions(make_signal(swing_to_both_sides(amplitude, frequency, noise_deg=noise, seed=seed)))
    assert len(found.repetitions) == 6


@settings(max_examples=40, deadline=None)
@given(
    amplitude=st.floats(-80.0, 80.0).filter(lambda a: abs(a) > 12.0),
    frequency=st.floats(0.2, 1.0),
    hold=st.floats(0.0, 2.0),
)
def test_find_repetitions_six_excursions_to_one_side_gives_six(amplitude: float, frequency: float, hold: float) -> None:
    found = find_repetitions(make_signal(swing_to_one_side(amplitude, frequency, hold_s=hold)))
    assert len(found.repetitions) == 6
    assert len(found.strokes) == 12
    assert found.strokes[0].is_rising == (amplitude > 0.0)
    assert all(a.is_rising != b.is_rising for a, b in zip(found.strokes, found.strokes[1:], strict=False))


@settings(max_examples=40, deadline=None)
@given(noise=st.floats(0.0, 2.0), seed=st.integers(0, 10_000), offset=st.floats(-60.0, 60.0))
def test_find_repetitions_noise_gives_none(noise: float, seed: int, offset: float) -> None:
    value = offset + np.random.default_rng(seed).normal(0.0, noise, 300)
    found = find_repetitions(make_signal(value))
    assert found.repetitions == ()
    assert found.strokes == ()


@pytest.mark.parametrize(("share", "counted"), [(0.27, 6), (0.33, 8)])
def test_find_repetitions_swing_below_three_tenths_is_none(share: float, counted: int) -> None:
    value = np.concatenate((swing_to_one_side(60.0, 0.5), swing_to_one_side(share * 60.0, 0.5, count=2)))
    assert len(find_repetitions(make_signal(value)).repetitions) == counted


@pytest.mark.parametrize(("hidden_s", "counted"), [(0.9, 4), (1.2, 3)])
def test_find_repetitions_long_occlusion_is_not_crossed(hidden_s: float, counted: int) -> None:
    value = swing_to_one_side(60.0, 0.25, count=4)
    top = 30 + 120 + 60
    keep = np.ones(len(value), dtype=bool)
    keep[top - round(0.5 * hidden_s * RATE) : top + round(0.5 * hidden_s * RATE)] = False
    found = find_repetitions(make_signal(value, keep))
    assert len(found.repetitions) == counted
    assert (len(found.occluded_s), len(found.partial_repetitions)) == ((0, 0) if counted == 4 else (1, 2))


def test_find_repetitions_strong_noise_rarely_gives_one() -> None:
    noisy = [np.random.default_rng(seed).normal(0.0, 6.0, 300) for seed in range(100)]
    assert sum(bool(find_repetitions(make_signal(value)).repetitions) for value in noisy) <= 10


def test_find_repetitions_missing_frames_keep_clear_waves() -> None:
    waves = swing_to_one_side(60.0, 0.5, count=10)
    away = np.concatenate((waves, np.zeros(20 * 30), swing_to_one_side(60.0, 0.5, count=2)))
    keep = np.ones(len(away), dtype=bool)
    keep[len(waves) + 10 : len(waves) + 20 * 30 - 10] = False
    found = find_repetitions(make_signal(away, keep))
    whole = [rep for rep in found.repetitions if rep.valid_share == 1.0]
    assert make_signal(away, keep).valid_share < 0.65
    assert len(whole) >= 12
    # Every third frame missing, anywhere, leaves all ten.
    scattered = np.random.default_rng(1).random(len(waves)) > 0.35
    assert len(find_repetitions(make_signal(waves, scattered)).repetitions) == 10


@pytest.mark.parametrize("end", ["rest", "away", "turned over"])
def test_find_repetitions_later_samples_remove_none(end: str) -> None:
    waves = swing_to_both_sides(15.0, 0.4, count=10)
    after = {
        "rest": np.zeros(60 * 30),
        "away": np.full(5 * 30, np.nan),
        "turned over": np.concatenate((np.linspace(0.0, 150.0, 20), np.full(60, 150.0))),
    }[end]
    before = find_repetitions(make_signal(waves)).repetitions
    assert len(before) == 10
    found = find_repetitions(make_signal(np.concatenate((waves, after)))).repetitions
    assert len(found) >= 10
    for one in before[:-1]:
        middle_s = 0.5 * (one.start_s + one.end_s)
        assert any(other.start_s <= middle_s <= other.end_s for other in found)


@pytest.mark.parametrize(("pace_deg_s", "first_s"), [(4.0, 0.0), (8.0, 1.5)])
def test_find_repetitions_creeping_hand_is_not_still(pace_deg_s: float, first_s: float) -> None:
    """Begun in the midst of a way of 60 degrees: what stands there is home, what moves is the piece of a repetition."""
    creep = 15.0 + pace_deg_s * np.arange(0.0, 0.5, 1.0 / RATE)
    way = 0.5 * (1.0 - np.cos(math.pi * np.arange(0.0, 1.0, 1.0 / RATE)))
    first = creep[-1] + (60.0 - creep[-1]) * way
    value = np.concatenate((creep, first, *[60.0 - 60.0 * way, 60.0 * way] * 2, np.full(int(RATE), 60.0)))
    found = find_repetitions(make_signal(value))
    assert [one.cut for one in found.partial_repetitions] == ["cut_by_start" if first_s else "cut_by_end"]
    assert [found.repetitions[0].start_s, len(found.repetitions)] == [pytest.approx(first_s, abs=0.05), 2]


def test_explain_no_repetitions_gives_the_reason() -> None:
    def why(value: FloatArray) -> str | None:
        signal = make_signal(value)
        return explain_no_repetitions(signal, find_repetitions(signal))

    assert why(np.full(200, np.nan)) == "nothing_seen"
    assert why(swing_to_both_sides(30.0, 0.5)[:20]) == "too_short"
    assert why(swing_to_both_sides(4.5, 0.5)) == "small_range"
    assert why(np.linspace(0.0, 50.0, 90)) == "no_return"
    assert why(40.0 * np.sin(2.0 * math.pi * 3.0 * np.arange(180) / 30.0)) == "too_quick"
    assert why(swing_to_both_sides(30.0, 0.5)) is None
    one = 40.0 * np.sin(2.0 * math.pi * np.arange(73) / 75.0)  # not quite to its end
    assert why(np.concatenate((np.zeros(240), one))) == "no_return", "the recording ended in it: it was not quick"
    seen = np.concatenate([np.linspace(0.0, 50.0, 30), np.linspace(50.0, 0.0, 30)] * 4)
    seen[25:] = np.where((np.arange(25, len(seen)) + 5) % 60 < 38, np.nan, seen[25:])  # its top for more than a second
    assert why(seen) == "cut_by_gap", "each takes two seconds: none was quick"

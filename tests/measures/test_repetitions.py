"""Counting repetitions: every one, none in noise, and cut where a person would cut them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.measures.repetitions import _visits, find_repetitions
from core.measures.signals import Signal, even_signal
from core.types import FloatArray

RATE = 30.0


def signal_of(value_deg: FloatArray, keep: FloatArray | None = None) -> Signal:
    return even_signal(np.arange(len(value_deg)) / RATE, np.radians(value_deg), keep)


def both_sides(
    amplitude_deg: float, frequency_hz: float, count: int = 6, noise_deg: float = 0.0, seed: int = 0
) -> FloatArray:
    """Rest, ``count`` full swings to both sides, rest."""
    t = np.arange(0.0, count / frequency_hz, 1.0 / RATE)
    swing = amplitude_deg * np.sin(2.0 * math.pi * frequency_hz * t)
    still = np.zeros(int(RATE))
    value = np.concatenate((still, swing, still))
    return value + np.random.default_rng(seed).normal(0.0, noise_deg, len(value))


def one_side(amplitude_deg: float, frequency_hz: float, count: int = 6, hold_s: float = 0.0) -> FloatArray:
    """Rest, ``count`` raised cosines with a hold at the top, rest."""
    t = np.arange(0.0, 0.5 / frequency_hz, 1.0 / RATE)
    up = 0.5 * amplitude_deg * (1.0 - np.cos(2.0 * math.pi * frequency_hz * t))
    one = np.concatenate((up, np.full(int(hold_s * RATE), amplitude_deg), up[::-1]))
    still = np.zeros(int(RATE))
    return np.concatenate((still, *([one] * count), still))


@settings(max_examples=60, deadline=None)
@given(
    amplitude=st.floats(8.0, 50.0),
    frequency=st.floats(0.2, 1.0),
    noise=st.floats(0.0, 2.0),
    seed=st.integers(0, 10_000),
)
def test_six_of_six_swings(amplitude: float, frequency: float, noise: float, seed: int) -> None:
    found = find_repetitions(signal_of(both_sides(amplitude, frequency, noise_deg=noise, seed=seed)))
    assert len(found.repetitions) == 6


@settings(max_examples=40, deadline=None)
@given(
    amplitude=st.floats(-80.0, 80.0).filter(lambda a: abs(a) > 12.0),
    frequency=st.floats(0.2, 1.0),
    hold=st.floats(0.0, 2.0),
)
def test_six_of_six_excursions_to_one_side(amplitude: float, frequency: float, hold: float) -> None:
    found = find_repetitions(signal_of(one_side(amplitude, frequency, hold_s=hold)))
    assert len(found.repetitions) == 6
    assert len(found.strokes) == 12
    assert found.strokes[0].rising == (amplitude > 0.0)
    assert all(a.rising != b.rising for a, b in zip(found.strokes, found.strokes[1:], strict=False))


@settings(max_examples=40, deadline=None)
@given(noise=st.floats(0.0, 2.0), seed=st.integers(0, 10_000), offset=st.floats(-60.0, 60.0))
def test_no_repetition_in_noise(noise: float, seed: int, offset: float) -> None:
    value = offset + np.random.default_rng(seed).normal(0.0, noise, 300)
    found = find_repetitions(signal_of(value))
    assert found.repetitions == ()
    assert found.strokes == ()


def test_repetitions_follow_each_other_and_hold_one_top_each() -> None:
    value = one_side(60.0, 0.5)
    signal = signal_of(value)
    found = find_repetitions(signal)
    for k, rep in enumerate(found.repetitions):
        part = signal.between(rep.start_s, rep.end_s)
        assert math.degrees(part.value.max()) == pytest.approx(60.0, abs=0.5)
        assert math.degrees(part.value.min()) == pytest.approx(0.0, abs=0.5)
        assert rep.valid_share == 1.0
        if k:
            assert rep.start_s >= found.repetitions[k - 1].end_s - 1e-9
    assert found.repetitions[2].end_s - found.repetitions[2].start_s == pytest.approx(2.0, abs=0.1)


def test_swings_to_both_sides_are_cut_at_the_middle() -> None:
    found = find_repetitions(signal_of(both_sides(30.0, 0.5)))
    for k, rep in enumerate(found.repetitions):
        assert rep.start_s == pytest.approx(1.0 + 2.0 * k, abs=0.1)
        assert rep.end_s == pytest.approx(3.0 + 2.0 * k, abs=0.1)


def test_a_last_swing_that_never_comes_back_is_no_repetition() -> None:
    value = one_side(60.0, 0.5)[: -(30 + 30)]
    assert value[-1] == pytest.approx(60.0, abs=0.5)
    assert len(find_repetitions(signal_of(value)).repetitions) == 5


def test_small_range_short_or_mostly_missing_gives_none() -> None:
    assert find_repetitions(signal_of(both_sides(4.5, 0.5))).repetitions == ()
    assert find_repetitions(signal_of(both_sides(30.0, 0.5)[40:65])).repetitions == ()
    value = both_sides(30.0, 0.5)
    rng = np.random.default_rng(1)
    assert find_repetitions(signal_of(value, rng.random(len(value)) > 0.35)).repetitions == ()
    assert len(find_repetitions(signal_of(value, rng.random(len(value)) > 0.2)).repetitions) == 6
    assert find_repetitions(signal_of(np.full(200, np.nan))).repetitions == ()


def test_a_hidden_stretch_shows_in_the_repetition_it_hurts() -> None:
    value = one_side(60.0, 0.5)
    keep = np.ones(len(value), dtype=bool)
    keep[30 + 2 * 60 + 22 : 30 + 2 * 60 + 38] = False
    found = find_repetitions(signal_of(value, keep))
    shares = [rep.valid_share for rep in found.repetitions]
    assert len(shares) == 6
    assert shares[2] == pytest.approx(1.0 - 16 / 60, abs=0.05)
    assert shares[:2] + shares[3:] == [1.0] * 5


def stays_sample_by_sample(value: FloatArray, middle: float, hysteresis: float) -> list[tuple[bool, int, int]]:
    """Side, first sample and sample of the extreme of every stay, as one would read them off a curve."""
    out: list[tuple[bool, int, int]] = []
    for k, sample in enumerate(value.tolist()):
        if math.isnan(sample):
            continue
        if abs(sample - middle) >= hysteresis and (not out or out[-1][0] != (sample > middle)):
            out.append((sample > middle, k, k))
        elif out:
            high, entry, turn = out[-1]
            if (sample > value[turn]) if high else (sample < value[turn]):
                out[-1] = (high, entry, k)
    return out


@settings(max_examples=200, deadline=None)
@given(
    steps=st.lists(st.integers(-8, 8), max_size=80),
    hidden=st.sets(st.integers(0, 80)),
    middle=st.integers(-6, 6),
    hysteresis=st.integers(1, 6),
)
def test_stays_and_their_extremes_are_those_read_sample_by_sample(
    steps: list[int], hidden: set[int], middle: int, hysteresis: int
) -> None:
    value = np.cumsum(np.array(steps, dtype=float))
    value[[k for k in hidden if k < len(value)]] = np.nan
    found = [(visit.high, visit.entry, visit.turn) for visit in _visits(value, middle, hysteresis)]
    assert found == stays_sample_by_sample(value, middle, hysteresis)

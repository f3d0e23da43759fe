"""Figures of agreement against what the papers and textbook formulas give."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.agreement.statistics import agreement, cmc, icc_2_1, independent_count


def test_known_differences_give_known_figures() -> None:
    reference = np.array([10.0, 20.0, 30.0, 40.0, 50.0])
    difference = np.array([1.0, 3.0, 2.0, 4.0, 0.0])
    found = agreement(reference + difference, reference, waveform=False)
    assert found.bias == pytest.approx(2.0)
    assert found.sd == pytest.approx(math.sqrt(2.5))
    assert found.limits == pytest.approx((2.0 - 1.96 * math.sqrt(2.5), 2.0 + 1.96 * math.sqrt(2.5)))
    assert found.rmse == pytest.approx(math.sqrt(6.0))
    assert found.largest == 4.0
    assert found.count == 5
    # t(4) = 2.776: the textbook interval of a mean.
    assert found.bias_interval[1] - 2.0 == pytest.approx(2.776 * math.sqrt(2.5 / 5), rel=1e-3)
    assert math.isnan(found.cmc)


def test_what_is_not_known_is_left_out_in_pairs() -> None:
    a, b = np.array([1.0, np.nan, 3.0, 4.0, 6.0]), np.array([1.0, 2.0, np.nan, 4.0, 5.0])
    assert agreement(a, b, waveform=False).count == 3
    assert math.isnan(agreement(a[:2], b[:2]).bias)


@given(st.floats(-20, 20), st.integers(0, 1000))
def test_a_constant_offset_is_bias_and_nothing_else(offset: float, seed: int) -> None:
    wave = 30.0 * np.sin(np.linspace(0, 20, 300)) + np.random.default_rng(seed).normal(size=300)
    found = agreement(wave + offset, wave)
    assert found.bias == pytest.approx(offset, abs=1e-9)
    assert found.sd == pytest.approx(0.0, abs=1e-6)
    assert found.correlation == pytest.approx(1.0)
    if abs(offset) > 1.0:
        assert found.icc < 1.0, "absolute agreement sees an offset that correlation does not"


def test_neighbours_in_time_count_for_less() -> None:
    rng = np.random.default_rng(3)
    noise = rng.normal(size=4000)
    assert independent_count(noise) > 2500
    slow = np.convolve(noise, np.ones(20) / 20, "valid")
    assert len(slow) / 40 < independent_count(slow) < len(slow) / 10


def test_the_interval_of_an_icc_holds_the_true_one() -> None:
    rng = np.random.default_rng(11)
    held = 0
    for _ in range(200):
        people = rng.normal(0.0, 3.0, 25)
        readings = people[:, None] + rng.normal(0.0, 1.0, (25, 2))
        _, (low, high) = icc_2_1(readings)
        held += low <= 0.9 <= high
    assert 180 <= held <= 199


def test_waveforms_that_have_nothing_in_common_have_no_cmc() -> None:
    x = np.linspace(0, 20, 500)
    assert math.isnan(cmc(np.sin(x), -np.sin(x)))
    assert cmc(np.sin(x), np.sin(x) + 0.01) > 0.99

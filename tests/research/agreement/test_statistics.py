"""Figures of agreement against what the papers and textbook formulas give."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.research.agreement.statistics import (
    compute_agreement,
    compute_pooled_agreement,
    effective_sample_size,
    icc_2_1,
    icc_3_1,
)


def test_agreement_of_known_differences_is_exact() -> None:
    reference = np.array([10.0, 20.0, 30.0, 40.0, 50.0])
    difference = np.array([1.0, 3.0, 2.0, 4.0, 0.0])
    found = compute_agreement(reference + difference, reference, waveform=False)
    assert found.bias == pytest.approx(2.0)
    assert found.sd == pytest.approx(math.sqrt(2.5))
    assert found.limits == pytest.approx((2.0 - 1.96 * math.sqrt(2.5), 2.0 + 1.96 * math.sqrt(2.5)))
    assert found.rmse == pytest.approx(math.sqrt(6.0))
    assert found.largest_difference == 4.0
    assert found.count == 5
    # t(4) = 2.776: the textbook interval of a mean.
    assert found.bias_interval[1] - 2.0 == pytest.approx(2.776 * math.sqrt(2.5 / 5), rel=1e-3)
    assert math.isnan(found.cmc)


@settings(max_examples=20)
@given(st.floats(-20, 20), st.integers(0, 1000))
def test_agreement_constant_offset_is_bias_only(offset: float, seed: int) -> None:
    wave = 30.0 * np.sin(np.linspace(0, 20, 300)) + np.random.default_rng(seed).normal(size=300)
    found = compute_agreement(wave + offset, wave)
    assert found.bias == pytest.approx(offset, abs=1e-9)
    assert found.sd == pytest.approx(0.0, abs=1e-6)
    assert found.correlation == pytest.approx(1.0)
    if abs(offset) > 1.0:
        assert found.icc < 1.0, "absolute agreement sees an offset that correlation does not"


def test_effective_sample_size_falls_with_autocorrelation() -> None:
    rng = np.random.default_rng(3)
    noise = rng.normal(size=4000)
    assert effective_sample_size(noise) > 2500
    slow = np.convolve(noise, np.ones(20) / 20, "valid")
    assert len(slow) / 40 < effective_sample_size(slow) < len(slow) / 10


@pytest.mark.parametrize("correlation", [-0.995, -0.5])
def test_icc_interval_of_a_negative_icc_has_its_coverage(correlation: float) -> None:
    rng = np.random.default_rng(3)
    held = [0, 0]
    for _ in range(200):
        pairs = rng.multivariate_normal([0.0, 0.0], [[1.0, correlation], [correlation, 1.0]], 40)
        for number, of in enumerate((icc_2_1, icc_3_1)):
            icc, (low, high) = of(pairs)
            assert -1.0 <= low <= icc <= high <= 1.0
            held[number] += low <= correlation <= high
    # Lin's own approximation holds less near -1, where nothing is judged any more.
    assert held[0] >= (180 if correlation > -0.95 else 160)
    assert held[1] >= 180


def test_pooled_limits_contain_both_variances() -> None:
    """Against Bland and Altman's analysis of variance (2007, section 3), by hand, for as many pairs of each."""
    rng = np.random.default_rng(8)
    people, each = 12, 5
    difference = 2.0 + rng.normal(0.0, 1.5, (people, 1)) + rng.normal(0.0, 1.0, (people, each))
    truth = rng.normal(60.0, 10.0, (people, each))
    found, between = compute_pooled_agreement(list(truth + difference), list(truth), waveform=False)
    of_people = each * difference.mean(axis=1).var(ddof=1)
    within = difference.var(axis=1, ddof=1).mean()
    sd = math.sqrt(within + (of_people - within) / each)
    assert found.bias == pytest.approx(difference.mean())
    assert found.sd == pytest.approx(sd)
    assert found.limits == pytest.approx((found.bias - 1.96 * sd, found.bias + 1.96 * sd))
    assert between.sd_within == pytest.approx(math.sqrt(within))
    assert between.sd_between == pytest.approx(math.sqrt((of_people - within) / each))
    # Taking the pairs for independent ones is too sure of the mean.
    pooled = compute_agreement((truth + difference).ravel(), truth.ravel(), waveform=False)
    assert np.ptp(found.bias_interval) > 1.5 * np.ptp(pooled.bias_interval)


def test_pooled_intervals_have_their_coverage() -> None:
    rng = np.random.default_rng(5)
    held = [0, 0, 0]
    true = 1.96 * math.hypot(1.5, 1.0)
    for _ in range(200):
        truth = [rng.normal(60.0, 10.0, int(rng.integers(3, 12))) for _ in range(10)]
        theirs = [one + rng.normal(0.0, 1.5) + rng.normal(0.0, 1.0, len(one)) for one in truth]
        found, _ = compute_pooled_agreement(theirs, truth, waveform=False)
        held[0] += found.bias_interval[0] <= 0.0 <= found.bias_interval[1]
        held[1] += found.lower_interval[0] <= -true <= found.lower_interval[1]
        held[2] += found.upper_interval[0] <= true <= found.upper_interval[1]
    assert all(182 <= one <= 199 for one in held), held


@pytest.mark.parametrize("each", [1, 2])
def test_pooled_agreement_counts_people_with_few_readings(each: int) -> None:
    rng = np.random.default_rng(0)
    truth = rng.normal(50.0, 10.0, (30, each))
    theirs = truth + rng.normal(1.0, 2.0, (30, each))
    found, between = compute_pooled_agreement(list(theirs), list(truth), waveform=False)
    assert (found.count, between.people) == (30 * each, 30)
    plain = compute_agreement(theirs.mean(axis=1), truth.mean(axis=1), waveform=False)
    assert found.bias_interval == pytest.approx(plain.bias_interval)
    assert found.lower_interval[0] < found.limits[0] < found.lower_interval[1]
    if each == 1:
        assert found.sd == pytest.approx(plain.sd)
        assert math.isnan(between.sd_within)
        assert math.isnan(between.sd_between)
    else:
        assert between.sd_within == pytest.approx((theirs - truth).std(axis=1, ddof=1).mean(), rel=0.5)
    few = [one[: 1 + k // 10] for k, one in enumerate(np.hstack((theirs, theirs, theirs))[:, :3])]
    assert compute_pooled_agreement(few, [one - 1.0 for one in few], waveform=False)[1].people == 30


def test_icc_of_constant_readings_is_nan() -> None:
    found = compute_agreement(np.zeros(50), np.ones(50))
    assert math.isnan(found.icc)
    assert math.isnan(found.icc_3_1)
    assert found.bias == -1.0

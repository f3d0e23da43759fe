"""Two curves whose lag, sign and drift are known: found, or said to be not sure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.types import FloatArray
from carpus.core.research.agreement.time_alignment import (
    AlignmentCurves,
    ClockShift,
    _correlations,
    find_shift,
    with_residual_drift,
)


def sine(time_s: FloatArray) -> FloatArray:
    return 40.0 * np.sin(2.0 * np.pi * time_s / 3.224)


def hand_curve(time_s: FloatArray) -> FloatArray:
    """Repetitions that differ a little, as people's do."""
    phase = 2.0 * np.pi * time_s / 3.2
    bent = 40.0 * np.sin(phase + 0.4 * np.sin(time_s / 3.0)) * (1.0 + 0.1 * np.sin(0.7 * time_s))
    return np.asarray(bent + 5.0 * np.cos(2.0 * phase))


def make_curves(
    way: Callable[[FloatArray], FloatArray], lag_s: float, *, length_s: float = 30.0, drift: float = 0.0,
    sign: float = 1.0, noise_deg: float = 0.3,
) -> AlignmentCurves:  # fmt: skip
    rng = np.random.default_rng(4)
    time_s, other_s = np.arange(0.0, length_s, 1 / 30), np.arange(0.0, length_s + 6.0, 0.01)
    mine = way(time_s) + rng.normal(0.0, noise_deg, len(time_s))
    other = sign * way((other_s - lag_s) / (1.0 + drift)) + rng.normal(0.0, noise_deg, len(other_s))
    return AlignmentCurves(time_s, mine[:, None], other_s, other[:, None], ignores_sign=True)


@pytest.mark.parametrize(("lag_s", "noise_deg"), [(3.0, 0.3), (-1.6, 0.3), (1.2, 15.0)])
def test_find_shift_finds_a_lag_beyond_half_a_repetition(lag_s: float, noise_deg: float) -> None:
    found = find_shift(make_curves(hand_curve, lag_s, noise_deg=noise_deg), 10.0)
    assert found.lag_s == pytest.approx(lag_s, abs=0.02)
    assert found.match > 0.8
    if noise_deg < 1.0:
        assert found.rivals == ()


def test_find_shift_periodic_curve_has_rivals() -> None:
    found = find_shift(make_curves(sine, 3.0), 10.0)
    named = [found.lag_s, *(later_s for later_s, _ in found.rivals)]
    assert any(abs(later_s - 3.0) < 0.01 for later_s in named)
    assert abs(found.lag_s) == min(map(abs, named)), "of equals the smallest"
    assert len(found.rivals) == 3
    assert found.has_more_rivals


def test_residual_drift_with_opposite_sign_is_found() -> None:
    one, other = (make_curves(sine, 0.2, length_s=30.0, drift=0.01, sign=sign) for sign in (1.0, -1.0))
    both = replace(
        one,
        values=np.hstack((other.values, 0.2 * one.values)),
        reference_values=np.hstack((other.reference_values, 0.2 * one.reference_values)),
    )
    for each in (other, both):
        found = with_residual_drift(each, find_shift(each, 10.0))
        assert found.residual_drift == pytest.approx(0.01, abs=5e-4)
        assert found.drift_free_lag_s == pytest.approx(0.2, abs=0.02)


def test_correlations_equal_those_of_each_lag() -> None:
    rng = np.random.default_rng(3)
    a, b = (np.cumsum(rng.normal(0.0, 1.0, count)) + 1e3 for count in (300, 380))
    a[40:90], b[:7], b[200:230] = np.nan, np.nan, np.nan
    a[:40] = 1e3  # at rest
    later = np.arange(-400, 401)
    found = _correlations(a, b, later, 60)
    for shift, match in zip(later.tolist(), found.tolist(), strict=True):
        mine, other = a[max(0, -shift) :], b[max(0, shift) :]
        count = min(len(mine), len(other))
        both = np.isfinite(mine[:count]) & np.isfinite(other[:count])
        if both.sum() >= 60:
            assert match == pytest.approx(np.corrcoef(mine[:count][both], other[:count][both])[0, 1], abs=1e-9)
        else:
            assert np.isnan(match)


def test_find_shift_at_the_search_limit_is_flagged() -> None:
    assert find_shift(make_curves(hand_curve, 3.0), 2.9).is_at_search_limit
    assert not find_shift(make_curves(hand_curve, 3.0), 10.0).is_at_search_limit


def test_residual_drift_is_found_with_its_lag() -> None:
    drift = -0.004
    both = make_curves(hand_curve, 0.5, length_s=60.0, drift=drift)
    found = with_residual_drift(both, find_shift(both, 10.0))
    assert found.residual_drift == pytest.approx(drift, abs=2e-4)
    assert found.drift_free_lag_s == pytest.approx(0.5, abs=0.01)
    taken = ClockShift(found.drift_free_lag_s, 1.0, drift=found.residual_drift)
    assert both.match(taken) > 0.999 > both.match(found)
    assert np.isnan(with_residual_drift(both, taken).residual_drift), "nothing is left"

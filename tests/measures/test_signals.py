"""Even time base, gaps and the low-pass."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import signal as sps

from carpus.core.measures.signals import (
    exclude_view_edges,
    low_pass,
    resample_evenly,
    valid_view,
)
from carpus.core.model import so3

RATE = 30.0


@pytest.mark.parametrize(("missing", "filled"), [(5, True), (6, True), (8, False)])
def test_resample_fills_short_gaps_only(missing: int, filled: bool) -> None:
    t = np.arange(90) / RATE
    value = t.copy()
    value[40 : 40 + missing] = np.nan
    signal = resample_evenly(t, value)
    assert bool(np.isfinite(signal.value).all()) == filled
    assert np.isfinite(signal.value).sum() == (90 if filled else 90 - missing)
    assert signal.valid_share == pytest.approx(1.0 - missing / 90)
    np.testing.assert_allclose(signal.value[np.isfinite(signal.value)], t[np.isfinite(signal.value)], atol=1e-9)
    if not filled:
        np.testing.assert_allclose(signal.gaps_s, [[39 / RATE, (40 + missing) / RATE]])
        assert signal.is_near_gap(39 / RATE - 0.1)
        assert not signal.is_near_gap(39 / RATE - 0.3)


def test_resample_occluded_ends_are_gaps() -> None:
    t = np.arange(90) / RATE
    valid = (t > 1.0) & (t < 2.0)
    signal = resample_evenly(t, np.column_stack((t, -t)), valid)
    assert signal.time_s[0] > 1.0
    assert signal.time_s[-1] < 2.0
    assert len(signal.gaps_s) == 2
    np.testing.assert_allclose(signal.value[:, 0], -signal.value[:, 1])


@pytest.mark.parametrize("known", [0, 1])
def test_resample_without_valid_samples_is_empty(known: int) -> None:
    t = np.arange(30) / RATE
    value = np.full(30, np.nan)
    value[:known] = 1.0
    signal = resample_evenly(t, value)
    assert len(signal.time_s) == 0
    assert signal.is_near_gap(0.0)
    assert len(low_pass(signal).time_s) == 0
    assert len(resample_evenly(np.empty(0), np.empty(0)).time_s) == 0


def test_low_pass_filters_each_run_separately() -> None:
    t = np.arange(0.0, 4.0, 1.0 / RATE)
    value = np.sin(t)
    value[50:60] = np.nan
    value[63:80] = np.nan
    smooth = low_pass(resample_evenly(t, value))
    # Two passes together are 3 dB down at 6 Hz where each is so at 7.03 Hz, at 30 samples a second.
    b, a = sps.butter(2, 7.0299, fs=RATE)
    np.testing.assert_allclose(smooth.value[:50], sps.filtfilt(b, a, value[:50]), atol=1e-5)
    assert np.isnan(smooth.value[50:80]).all()
    assert np.isfinite(smooth.value[80:]).all()


@pytest.mark.parametrize(
    ("status", "discs", "tilt_deg", "counts"),
    [
        (0, 4, 69.0, True), (0, 3, 0.0, False), (0, 6, 71.0, False), (0, 6, math.nan, False),
        (1, 6, 0.0, False), (2, 6, 0.0, False), (3, 6, 0.0, False),
    ],
)  # fmt: skip
def test_valid_view_needs_four_markers_and_tilt_below_70_degrees(
    status: int, discs: int, tilt_deg: float, counts: bool
) -> None:
    pixel = np.full((1, 6, 2), np.nan)
    pixel[:, :discs] = 100.0
    tilted = so3.exp(np.array([[math.radians(tilt_deg), 0.0, 0.0]]))
    towards_camera = np.diag([1.0, -1.0, -1.0])
    assert valid_view(np.array([status]), pixel, tilted, towards_camera).tolist() == [counts]


@pytest.mark.parametrize(("gone_s", "taken_s"), [(0.15, 0.0), (0.3, 0.09)])
def test_exclude_view_edges_beside_long_gaps(gone_s: float, taken_s: float) -> None:
    time_s = np.arange(200) / 100.0
    gone = (time_s > 1.0) & (time_s < 1.0 + gone_s)
    kept = time_s[exclude_view_edges(~gone, time_s)]
    first_gone_s, last_gone_s = time_s[gone][[0, -1]]
    assert kept[kept < first_gone_s].max() == pytest.approx(first_gone_s - 0.01 - taken_s, abs=0.011)
    assert kept[kept > last_gone_s].min() == pytest.approx(last_gone_s + 0.01 + taken_s, abs=0.011)
    assert exclude_view_edges(np.empty(0, dtype=bool), np.empty(0)).shape == (0,)

"""Even sampling: the rows where they are even, nothing where nothing was recorded."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.formats.export_item import uniform_times


@given(st.integers(0, 2**32 - 1), st.sets(st.integers(1, 58), min_size=1, max_size=8))
def test_uniform_times_dropped_frames_empty_own_rows(seed: int, dropped: set[int]) -> None:
    kept = np.array([row for row in range(60) if row not in dropped])
    times = 100.0 + kept / 30.0 + np.random.default_rng(seed).uniform(-0.004, 0.004, len(kept))
    even = uniform_times(times, 30.0)
    out = even.interpolate(7.0 * times)
    assert set(np.flatnonzero(np.isnan(out)).tolist()) == dropped
    wanted = 7.0 * (even.start_s + even.elapsed_s)
    assert np.nanmax(np.abs(out - wanted)) < 7.0 * 0.009, "no further off than two stamps waver"
    assert {even.row_index[row] for row in dropped} == {-1}


def test_interpolate_angles_take_shorter_way() -> None:
    times = np.array([0.0, 1.0, 2.0])
    even = uniform_times(times + 0.25 * (np.arange(3) == 1), 1.0)
    values = np.radians([179.0, -179.0, -177.0])
    assert np.degrees(np.abs(even.interpolate(values, is_angular=True))).min() > 176.0


@pytest.mark.parametrize("count", [0, 1, 2])
def test_uniform_times_of_none_or_one_row(count: int) -> None:
    even = uniform_times(np.arange(count) / 30.0, 30.0)
    assert len(even) == count
    assert even.interpolate(np.ones((count, 2))).shape == (count, 2)


@given(st.integers(0, 2**32 - 1), st.integers(3, 80))
def test_uniform_times_of_jitter_one_row_per_frame(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    times = 100.0 + np.arange(count) / 30.0 + rng.uniform(-0.004, 0.004, count)
    even = uniform_times(times, 30.0)
    assert len(even) == count
    wanted = even.start_s + np.arange(count) / 30.0
    assert np.allclose(even.interpolate(7.0 * times), 7.0 * wanted, atol=1e-9), "a straight movement stays straight"

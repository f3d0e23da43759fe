"""Who belongs to whom in C: SciPy's answer, also where several are the best."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.assignment import linear_sum_assignment
from carpus.core.kernels.choice import NUMPY, forced
from tests.kernels.pairs import LEVELS, both


@given(st.integers(0, 9), st.integers(0, 9), st.booleans(), st.integers(2, 1000), st.integers(0, 1 << 31))
def test_it_is_scipys_also_among_equals(rows: int, columns: int, maximize: bool, values: int, seed: int) -> None:
    cost = np.random.default_rng(seed).integers(0, values, (rows, columns)).astype(np.float64)
    cost[cost > 0.9 * values] = 1e6
    both(lambda: linear_sum_assignment(cost, maximize=maximize))


@pytest.mark.parametrize("asked", [NUMPY, *LEVELS])
@pytest.mark.parametrize("bad", [np.nan, -np.inf, np.inf])
def test_costs_that_are_none_are_refused(asked: str, bad: float) -> None:
    with forced(asked), pytest.raises(ValueError):
        linear_sum_assignment(np.full((2, 3), bad))

"""Roots made in place are those of NumPy, and a matrix that could not be changed in place is refused."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.tracking.unscented import make_roots
from carpus.core.types import FloatArray


def covariances(count: int, size: int) -> FloatArray:
    half = np.random.default_rng(size).normal(size=(count, size, size))
    return half @ half.transpose(0, 2, 1) + size * np.eye(size)


@pytest.mark.parametrize("size", [1, 4, 18])
def test_roots_made_in_place_are_numpys(size: int) -> None:
    matrix = covariances(3, size)
    expected = np.linalg.cholesky(matrix)
    make_roots(matrix)
    np.testing.assert_allclose(matrix, expected, rtol=0.0, atol=1e-12)


def test_what_is_not_positive_definite_has_no_root() -> None:
    with pytest.raises(np.linalg.LinAlgError):
        make_roots(-covariances(2, 4))


def test_columns_side_by_side_are_refused_and_left_as_they_were() -> None:
    matrix = np.asfortranarray(covariances(2, 4))
    before = matrix.copy()
    with pytest.raises(ValueError, match="row by row"):
        make_roots(matrix)
    assert np.array_equal(matrix, before)

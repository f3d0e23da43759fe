"""Mixtures of Gaussians, compiled, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.compiled import mixture as compiled
from carpus.core.tracking.kernel import ModeMixture
from carpus.core.types import FloatArray
from tests.compiled.comparing import LAYOUTS, assert_same, laid_out
from tests.compiled.oracle import mixture as oracle

SIZES = [(1, 8, 54), (5, 2, 21), (1, 1, 54), (2, 3, 5)]
"""Chains, modes, numbers: the palm's and the digits', one mode, and small odd ones."""


def covariances(rng: np.random.Generator, *shape: int) -> FloatArray:
    """Positive definite matrices (..., n, n) of ``shape`` (..., n)."""
    root = rng.normal(size=(*shape, shape[-1]))
    return np.asarray(root @ np.swapaxes(root, -1, -2) / shape[-1] + np.eye(shape[-1]))


def mixture_of(rng: np.random.Generator, chains: int, modes: int, n: int) -> ModeMixture:
    """Any one."""
    probability = rng.uniform(0.1, 1.0, size=(chains, modes))
    return ModeMixture(
        rng.normal(size=(chains, modes, n)),
        covariances(rng, chains, modes, n),
        probability / probability.sum(axis=1, keepdims=True),
    )


@pytest.mark.parametrize("size", SIZES)
def test_merged_of_any_size_is_the_oracles(size: tuple[int, int, int]) -> None:
    mixture = mixture_of(np.random.default_rng(7), *size)
    assert_same(compiled.merged(mixture), oracle.merged(mixture))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_merged_of_arrays_stored_otherwise_is_the_same(layout: Callable[[np.ndarray], np.ndarray]) -> None:
    mixture = mixture_of(np.random.default_rng(8), 5, 2, 21)
    assert_same(compiled.merged(laid_out(mixture, layout)), oracle.merged(mixture))


def test_merged_of_an_unknown_number_is_unknown_where_the_oracles_is() -> None:
    mixture = mixture_of(np.random.default_rng(9), 2, 3, 5)
    mixture.mean[0, 1, 2] = np.nan
    mean, covariance = compiled.merged(mixture)
    expected_mean, expected_covariance = oracle.merged(mixture)
    assert np.isnan(expected_covariance[0, 2]).all()
    assert_same((mean, covariance), (expected_mean, expected_covariance))


def test_merged_of_sizes_that_do_not_fit_is_refused() -> None:
    mixture = mixture_of(np.random.default_rng(10), 2, 3, 5)
    for wrong in (
        replace(mixture, mean=mixture.mean[:, :2]),
        replace(mixture, covariance=mixture.covariance[..., :4]),
        replace(mixture, probability=mixture.probability[:1]),
        replace(mixture, mean=mixture.mean.astype(np.float32)),
        replace(mixture, mean=mixture.mean[0]),
    ):
        with pytest.raises(ValueError, match=r"size|dtype|dimensions"):
            compiled.merged(wrong)

"""The filter's step in C against NumPy's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.kernels import choice
from carpus.core.tracking import kernel
from carpus.core.tracking.kernel import Linearisation, ModeMixture, partial_update
from carpus.core.types import FloatArray
from tests.kernels.pairs import LEVELS, both

SIZES = [(1, 8, 54, 18), (5, 2, 21, 9), (1, 1, 54, 3), (2, 3, 5, 2)]
"""Chains, modes, numbers, measured: the palm's and the digits', one mode, and none that a vector holds."""


def covariances(rng: np.random.Generator, *shape: int) -> FloatArray:
    root = rng.normal(size=(*shape, shape[-1]))
    return np.asarray(root @ np.swapaxes(root, -1, -2) / shape[-1] + np.eye(shape[-1]))


def mixture_of(rng: np.random.Generator, chains: int, modes: int, n: int) -> ModeMixture:
    probability = rng.uniform(0.1, 1.0, size=(chains, modes))
    return ModeMixture(
        rng.normal(size=(chains, modes, n)),
        covariances(rng, chains, modes, n),
        probability / probability.sum(axis=1, keepdims=True),
    )


def line_of(rng: np.random.Generator, chains: int, n: int, m: int) -> Linearisation:
    slope = rng.normal(size=(chains, m, n)) * (rng.uniform(size=(chains, m, n)) < 0.4)
    return Linearisation(rng.normal(size=(chains, m)), slope, covariances(rng, chains, m), rng.normal(size=(chains, n)))


@pytest.mark.parametrize(("chains", "modes", "n", "m"), SIZES)
@pytest.mark.parametrize("unseen", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("extras", [False, True])
def test_correction(chains: int, modes: int, n: int, m: int, unseen: float, extras: bool) -> None:
    rng = np.random.default_rng(7)
    mixture, linearised = mixture_of(rng, chains, modes, n), line_of(rng, chains, n, m)
    measured = np.where(rng.uniform(size=(chains, m)) < unseen, np.nan, rng.normal(size=(chains, m)))
    variance = np.where(np.isnan(measured), np.nan, rng.uniform(1e-6, 2.0, size=(chains, m)))
    shared = covariances(rng, chains, m) if extras else None
    partial = partial_update(n, slice(1, 3), 0.3) if extras else None
    found = both(lambda: kernel.corrected(mixture, linearised, measured, variance, shared, partial))
    assert (found.dof == np.isfinite(measured).sum(axis=1)).all()


@pytest.mark.parametrize(("chains", "modes", "n", "m"), SIZES)
@pytest.mark.parametrize("unknown", [np.nan, np.inf])
def test_a_number_unknown_is_not_passed_over_where_nothing_depends_on_it(
    chains: int, modes: int, n: int, m: int, unknown: float
) -> None:
    rng = np.random.default_rng(9)
    mixture, linearised = mixture_of(rng, chains, modes, n), line_of(rng, chains, n, m)
    linearised.slope[:] = 0.0
    mixture.covariance[..., -1, :-1] = mixture.covariance[..., :-1, -1] = unknown
    measured, variance = rng.normal(size=(chains, m)), rng.uniform(1e-6, 2.0, size=(chains, m))

    def known() -> np.ndarray:
        try:
            return np.isfinite(kernel.corrected(mixture, linearised, measured, variance).mixture.mean)
        except np.linalg.LinAlgError:
            return np.zeros_like(mixture.mean, dtype=bool)

    with np.errstate(invalid="ignore"):
        assert not both(known).any()


def small(modes: int = 2) -> tuple[ModeMixture, Linearisation]:
    """A chain of six numbers, four of them measured."""
    rng = np.random.default_rng(11)
    return mixture_of(rng, 1, modes, 6), line_of(rng, 1, 6, 4)


ONES = np.ones((1, 4))


def test_arrays_stored_otherwise_are_read_as_they_are() -> None:
    """Not row by row, backwards, every second number, or of another byte order."""
    mixture, linearised = small()
    turned = replace(
        linearised, slope=np.asfortranarray(linearised.slope[0])[None], error=linearised.error[:, ::-1, ::-1]
    )
    both(lambda: kernel.corrected(mixture, turned, np.ones((1, 8))[:, ::2], ONES))
    both(lambda: kernel.corrected(mixture, linearised, ONES.astype(">f8"), ONES).nis)


@pytest.mark.parametrize("how", [choice.NUMPY, *LEVELS])
def test_no_correction_by_what_is_no_covariance_and_unknown_stays_unknown(how: str) -> None:
    mixture, linearised = small()
    negative = replace(linearised, error=linearised.error - 1e3 * np.eye(4))
    no_scatter = replace(linearised, slope=np.zeros((1, 4, 6)), error=-np.eye(4)[None])
    unknown = replace(linearised, error=np.where(np.eye(4) > 0.0, np.nan, linearised.error))
    with choice.forced(how):
        for bad in (negative, no_scatter):
            with pytest.raises(np.linalg.LinAlgError):
                kernel.corrected(mixture, bad, ONES, ONES)
        assert np.isnan(kernel.corrected(mixture, unknown, ONES, ONES).mixture.mean).all()


@pytest.mark.parametrize("level", LEVELS)
def test_an_array_of_another_type_is_refused(level: str) -> None:
    mixture, linearised = small()
    narrow = replace(mixture, mean=mixture.mean.astype(np.float32))
    with choice.forced(level), pytest.raises(TypeError):
        kernel.corrected(narrow, linearised, ONES, ONES)


def test_a_mode_that_is_far_off_keeps_the_same_little_chance() -> None:
    mixture, linearised = small(modes=3)
    mixture.mean[0, 2] += 1e3
    found = both(lambda: kernel.corrected(mixture, linearised, ONES, ONES))
    assert found.mixture.probability[0, 2] == pytest.approx(1e-6, rel=1e-3)


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("wrong", ["covariance", "about", "measured", "variance", "shared"])
def test_an_array_of_another_size_is_refused_before_it_is_read(level: str, wrong: str) -> None:
    """NumPy would repeat it for every chain; in C what lies behind it would be read."""
    rng = np.random.default_rng(13)
    mixture, linearised = mixture_of(rng, 5, 2, 6), line_of(rng, 5, 6, 4)
    given = {name: np.ones((5, 4)) for name in ("measured", "variance")} | {"shared": covariances(rng, 5, 4)}
    if wrong == "covariance":
        mixture = replace(mixture, covariance=mixture.covariance[:1])
    elif wrong == "about":
        linearised = replace(linearised, about=linearised.about[:1])
    else:
        given[wrong] = given[wrong][:1]
    with choice.forced(level), pytest.raises(ValueError):
        kernel.corrected(mixture, linearised, **given)

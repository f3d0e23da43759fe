"""Mixtures of Gaussians, compiled, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.compiled import mixture as compiled
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import (
    Linearisation,
    ModeMixture,
    Transition,
    mode_transition_matrix,
    partial_update_shares,
    predict_mixture,
    propagate_mixture,
    update_mixture,
)
from tests.compiled.comparing import LAYOUTS, assert_same, laid_out
from tests.compiled.oracle import mixture as oracle

SIZES = [(1, 8, 54, 18), (5, 2, 21, 9), (1, 1, 54, 3), (2, 3, 5, 2)]
"""Chains, modes, numbers, measured: the palm's and the digits', one mode, and small odd ones."""


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


def line_of(rng: np.random.Generator, chains: int, n: int, m: int) -> Linearisation:
    """Any measurement of few numbers each."""
    slope = rng.normal(size=(chains, m, n)) * (rng.uniform(size=(chains, m, n)) < 0.4)
    return Linearisation(rng.normal(size=(chains, m)), slope, covariances(rng, chains, m), rng.normal(size=(chains, n)))


def step_of(rng: np.random.Generator, modes: int, n: int) -> Transition:
    """Any step of which the first third mixes and the last third relaxes."""
    m = n // 3
    moving = rng.normal(size=(m, m))
    kept = np.where(np.arange(n) < m, 1.0, rng.uniform(0.2, 1.0, size=(modes, n)))
    return Transition(moving, covariances(rng, modes, m), kept, covariances(rng, modes, m))


def small(modes: int = 2) -> tuple[ModeMixture, Linearisation]:
    """A chain of six numbers, four of them measured."""
    rng = np.random.default_rng(11)
    return mixture_of(rng, 1, modes, 6), line_of(rng, 1, 6, 4)


ONES = np.ones((1, 4))


@pytest.mark.parametrize("size", SIZES)
def test_merged_of_any_size_is_the_oracles(size: tuple[int, ...]) -> None:
    mixture = mixture_of(np.random.default_rng(7), *size[:3])
    assert_same(compiled.merge_modes(mixture), oracle.merged(mixture))


@pytest.mark.parametrize("size", SIZES)
def test_steps_ahead_of_any_size_are_the_oracles(size: tuple[int, ...]) -> None:
    rng = np.random.default_rng(12)
    chains, modes, n, _ = size
    mixture, switch = mixture_of(rng, chains, modes, n), mode_transition_matrix(modes, 0.5, 0.03)
    forward, noise = rng.normal(size=(chains, n, n)), covariances(rng, chains, modes, n)
    forward[rng.uniform(size=forward.shape) < 0.6] = 0.0
    assert_same(predict_mixture(mixture, forward, noise, switch), oracle.predicted(mixture, forward, noise, switch))
    step, nominal = step_of(rng, modes, n), rng.normal(size=n)
    assert_same(propagate_mixture(mixture, step, nominal, switch), oracle.transitioned(mixture, step, nominal, switch))


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("unseen", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("extras", [False, True])
def test_correction_of_any_size_is_the_oracles(size: tuple[int, ...], unseen: float, extras: bool) -> None:
    rng = np.random.default_rng(7)
    chains, modes, n, m = size
    mixture, line = mixture_of(rng, chains, modes, n), line_of(rng, chains, n, m)
    measured = np.where(rng.uniform(size=(chains, m)) < unseen, np.nan, rng.normal(size=(chains, m)))
    variance = np.where(np.isnan(measured), np.nan, rng.uniform(1e-6, 2.0, size=(chains, m)))
    shared = covariances(rng, chains, m) if extras else None
    partial = partial_update_shares(n, slice(1, 3), 0.3) if extras else None
    found = update_mixture(mixture, line, measured, variance, shared, partial)
    for tested in (0, m - 1):
        some = update_mixture(mixture, line, measured, variance, shared, partial, tested)
        assert_same(some, oracle.corrected(mixture, line, measured, variance, shared, partial, tested))
        assert_same(some.mixture, found.mixture)
    assert_same(found, oracle.corrected(mixture, line, measured, variance, shared, partial))
    assert (found.dof == np.isfinite(measured).sum(axis=1)).all()


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("unknown", [np.nan, np.inf])
def test_number_unknown_is_not_passed_over_where_nothing_depends_on_it(size: tuple[int, ...], unknown: float) -> None:
    rng = np.random.default_rng(9)
    chains, modes, n, m = size
    mixture, line = mixture_of(rng, chains, modes, n), line_of(rng, chains, n, m)
    line.slope[:] = 0.0
    mixture.covariance[:, :, n - 1, n - 2] = mixture.covariance[:, :, n - 2, n - 1] = unknown
    measured, variance = rng.normal(size=(chains, m)), rng.uniform(1e-6, 2.0, size=(chains, m))
    with np.errstate(invalid="ignore"):
        for how in (update_mixture, oracle.corrected):
            assert not np.isfinite(how(mixture, line, measured, variance).mixture.mean).any()
        forward, noise = np.repeat(np.eye(n)[None], chains, axis=0), covariances(rng, chains, modes, n)
        found, expected = (how(mixture, forward, noise).covariance for how in (predict_mixture, oracle.predicted))
        assert not np.isfinite(found[:, :, n - 1]).any()
        assert (np.isfinite(found) <= np.isfinite(expected)).all()


@pytest.mark.parametrize("layout", LAYOUTS)
def test_arrays_stored_otherwise_give_the_same(layout: Callable[[np.ndarray], np.ndarray]) -> None:
    rng = np.random.default_rng(8)
    mixture, line, switch = mixture_of(rng, 5, 2, 21), line_of(rng, 5, 21, 9), mode_transition_matrix(2, 0.5, 0.03)
    measured, variance = rng.normal(size=(5, 9)), rng.uniform(1e-6, 2.0, size=(5, 9))
    step, nominal, forward, noise = (
        step_of(rng, 2, 21),
        np.ones(21),
        covariances(rng, 5, 21),
        covariances(rng, 5, 2, 21),
    )
    other = laid_out(mixture, layout)
    assert_same(compiled.merge_modes(other), oracle.merged(mixture))
    found = predict_mixture(other, layout(forward), layout(noise), layout(switch))
    assert_same(found, oracle.predicted(mixture, forward, noise, switch))
    found = propagate_mixture(other, laid_out(step, layout), nominal, layout(switch))
    assert_same(found, oracle.transitioned(mixture, step, nominal, switch))
    found = update_mixture(other, laid_out(line, layout), layout(measured), layout(variance))
    assert_same(found, oracle.corrected(mixture, line, measured, variance))


def test_mixture_invalid_covariance_is_refused_and_nan_stays() -> None:
    mixture, line = small()
    negative = replace(line, error=line.error - 1e3 * np.eye(4))
    no_scatter = replace(line, slope=np.zeros((1, 4, 6)), error=-np.eye(4)[None])
    unknown = replace(line, error=np.where(np.eye(4) > 0.0, np.nan, line.error))
    for how in (update_mixture, oracle.corrected):
        for bad in (negative, no_scatter):
            with pytest.raises(np.linalg.LinAlgError):
                how(mixture, bad, ONES, ONES)
        assert np.isnan(how(mixture, unknown, ONES, ONES).mixture.mean).all()


def test_mode_that_is_far_off_keeps_same_little_chance() -> None:
    mixture, line = small(modes=3)
    mixture.mean[0, 2] += 1e3
    found = update_mixture(mixture, line, ONES, ONES)
    assert_same(found, oracle.corrected(mixture, line, ONES, ONES))
    assert found.mixture.probability[0, 2] == pytest.approx(1e-6, rel=1e-3)


def test_sizes_that_do_not_fit_are_refused() -> None:
    mixture = mixture_of(np.random.default_rng(10), 2, 3, 5)
    for wrong in (
        replace(mixture, mean=mixture.mean[:, :2]),
        replace(mixture, covariance=mixture.covariance[..., :4]),
        replace(mixture, probability=mixture.probability[:1]),
        replace(mixture, mean=mixture.mean.astype(np.float32)),
        replace(mixture, mean=mixture.mean[0]),
    ):
        with pytest.raises(ValueError, match=r"size|dtype|dimensions"):
            compiled.merge_modes(wrong)
    square = np.ones((2, 5, 5))
    with pytest.raises(ValueError, match="size"):
        predict_mixture(mixture, square[:1], covariances(np.random.default_rng(1), 2, 3, 5))
    with pytest.raises(ValueError, match="row"):
        predict_mixture(mixture, square, covariances(np.random.default_rng(1), 2, 3, 5), np.ones((2, 2)))
    step = step_of(np.random.default_rng(2), 3, 5)
    wide = np.ones((3, 9, 9))
    for wrong_step in (
        replace(step, decay=step.decay[:2]),
        replace(step, moving=step.moving[:, :0]),
        replace(step, moving=np.ones((len(step.moving), 99))),
        replace(step, relaxing=step.relaxing[..., :-1]),
        replace(step, relaxing=wide),
    ):
        with pytest.raises(ValueError, match="size"):
            propagate_mixture(mixture, wrong_step, np.ones(5))


@pytest.mark.parametrize("wrong", ["covariance", "about", "measured", "variance", "shared", "partial"])
def test_measurement_of_another_size_is_refused(wrong: str) -> None:
    """NumPy would repeat it for every chain; compiled, what lies behind it would be read."""
    rng = np.random.default_rng(13)
    mixture, line = mixture_of(rng, 5, 2, 6), line_of(rng, 5, 6, 4)
    given = {name: np.ones((5, 4)) for name in ("measured", "variance")}
    given |= {"shared": covariances(rng, 5, 4), "partial": np.ones(6)}
    if wrong == "covariance":
        mixture = replace(mixture, covariance=mixture.covariance[:1])
    elif wrong == "about":
        line = replace(line, point=line.point[:1])
    else:
        given[wrong] = given[wrong][:1]
    with pytest.raises(ValueError, match="size"):
        update_mixture(mixture, line, **given)

"""Names of blobs: eq. (12) by its own formula, the joint resolution by trying every assignment there is."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.stats import chi2, multivariate_normal

from carpus.core.model.types import FloatArray
from carpus.core.tracking.association.association import (
    DEPTH_OUTLIER_PROBABILITY,
    LOG_IMPOSSIBLE,
    assign_blobs,
    associate_jointly,
    chi2_quantiles,
    log_odds,
)
from carpus.core.tracking.filter.settings import AssociationSettings

RES_PX2 = 640.0 * 480.0
SETTINGS = AssociationSettings(prior_marker=0.85, prior_clutter=0.15, gate_sd=5.0, depth_range_m=0.5)


def association_posterior(odds: FloatArray) -> FloatArray:
    """p(a_i = j | y_i) of every blob, (D, M + 1), column 0 clutter: eq. (12)."""
    stacked = np.concatenate((np.zeros((1, odds.shape[1])), odds), axis=0).T
    weight = np.exp(stacked - stacked.max(axis=1, keepdims=True))
    return np.asarray(weight / weight.sum(axis=1, keepdims=True))


def assignments(markers: int, blobs: int) -> list[tuple[int, ...]]:
    """Every way to give markers blobs or none (-1), no blob twice."""
    return list({p[:markers] for p in permutations([*range(blobs), *[-1] * markers], markers)})


odds_tables = st.integers(1, 4).flatmap(
    lambda m: st.integers(0, 4).flatmap(
        lambda d: st.lists(
            st.lists(st.one_of(st.floats(-20.0, 20.0), st.just(LOG_IMPOSSIBLE)), min_size=d, max_size=d),
            min_size=m,
            max_size=m,
        ).map(lambda rows: np.array(rows, dtype=float).reshape(m, d))
    )
)


@settings(deadline=None, max_examples=80)
@given(odds_tables)
def test_assign_blobs_is_the_best_of_all_assignments(odds: FloatArray) -> None:
    assigned = assign_blobs(odds)
    used = assigned[assigned >= 0]
    assert len(set(used)) == len(used), "no blob twice"
    reached = sum(odds[j, i] for j, i in enumerate(assigned) if i >= 0)
    best = max(sum(odds[j, i] for j, i in enumerate(a) if i >= 0) for a in assignments(*odds.shape))
    assert reached == pytest.approx(best, abs=1e-9)
    assert all(odds[j, i] > 0.0 for j, i in enumerate(assigned) if i >= 0), "clutter is likelier than such a name"


def random_covariance(rng: np.random.Generator, count: int) -> FloatArray:
    sd = np.tile([2.0, 2.0, 0.003], count) * rng.uniform(0.5, 2.0, 3 * count)
    root = rng.normal(size=(3 * count, 3 * count)) / np.sqrt(3.0 * count) + np.eye(3 * count)
    return np.asarray((root @ root.T) * np.outer(sd, sd))


def scene(seed: int, markers: int = 3, clutter: int = 2) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Predictions (3M,) with covariance, blobs of a draw from it and of clutter, some without depth; noise."""
    rng = np.random.default_rng(seed)
    covariance = random_covariance(rng, markers)
    mean = np.concatenate([[*rng.uniform([300.0, 200.0], [312.0, 212.0]), 0.7] for _ in range(markers)])
    there = (mean + np.linalg.cholesky(covariance) @ rng.normal(size=mean.size)).reshape(markers, 3)
    there += rng.normal(size=there.shape) * [0.3, 0.3, 0.001]
    strange = np.column_stack(
        (rng.uniform([296.0, 196.0], [316.0, 216.0], (clutter, 2)), rng.uniform(0.68, 0.72, clutter))
    )
    blobs = rng.permutation(np.concatenate((there[rng.random(markers) < 0.8], strange)))
    blobs[rng.random(len(blobs)) < 0.25, 2] = np.nan
    noise = np.tile([0.3**2, 0.3**2, 0.001**2], (len(blobs), 1)) * rng.uniform(0.5, 2.0, (len(blobs), 1))
    return mean, covariance, blobs, noise


def get_marker_block(covariance: FloatArray) -> FloatArray:
    """Each of three markers' own (3, 3, 3)."""
    return np.stack([covariance[3 * j : 3 * j + 3, 3 * j : 3 * j + 3] for j in range(3)])


@pytest.mark.parametrize("seed", range(6))
def test_log_odds_give_equation_12(seed: int) -> None:
    mean, covariance, blobs, noise = scene(seed)
    own = get_marker_block(covariance)
    odds, with_depth = log_odds(mean.reshape(3, 3), own, blobs, noise, RES_PX2, SETTINGS)
    found = association_posterior(odds)
    assert np.allclose(found.sum(axis=1), 1.0, atol=1e-12)
    for i, blob in enumerate(blobs):
        deep = np.isfinite(blob[2])
        clutter = SETTINGS.prior_clutter / RES_PX2 / (SETTINGS.depth_range_m if deep else 1.0)
        weight = [clutter]
        for j in range(3):
            s = own[j] + np.diag(noise[i])
            there = mean[3 * j : 3 * j + 3]
            off = blob - there
            flat = multivariate_normal(there[:2], s[:2, :2]).pdf(blob[:2])
            inside = off[:2] @ np.linalg.solve(s[:2, :2], off[:2]) <= SETTINGS.gate_sd**2
            ways = [flat * inside * (DEPTH_OUTLIER_PROBABILITY / SETTINGS.depth_range_m if deep else 1.0)]
            if deep and off @ np.linalg.solve(s, off) <= SETTINGS.gate_sd**2:
                ways.append(multivariate_normal(there, s).pdf(blob))
            assert with_depth[j, i] == (len(ways) == 2 and ways[1] >= ways[0]) or not inside
            weight.append(SETTINGS.prior_marker * max(ways))
        assert np.allclose(found[i], np.array(weight) / np.sum(weight), atol=1e-9)


@pytest.mark.parametrize(("off_sd", "taken"), [(4.8, 0), (5.2, -1)])
def test_assign_blobs_beyond_the_gate_is_never_associated(off_sd: float, taken: int) -> None:
    """One by one and jointly: by its density alone a blob 5.2 standard deviations off a sure place would be its."""
    mean, covariance = np.array([300.0, 200.0, 0.7]), np.diag([0.01, 0.01, 1e-8])
    blob, noise = np.array([[300.0 + 0.1 * off_sd, 200.0, np.nan]]), np.array([[1e-9, 1e-9, 1e-12]])
    odds, _ = log_odds(mean[None], covariance[None], blob, noise, RES_PX2, SETTINGS)
    assert assign_blobs(odds).tolist() == [taken]
    jointly = associate_jointly(mean, covariance, blob, noise, RES_PX2, SETTINGS)
    assert jointly.assigned.tolist() == [taken]


def joint_score(
    mean: FloatArray,
    covariance: FloatArray,
    blobs: FloatArray,
    noise: FloatArray,
    assigned: tuple[int, ...],
    depths: tuple[bool, ...],
) -> float:
    """Log posterior of one set of names over all clutter, by the Gaussian of all named components at once."""
    rows, values, variances, extra = [], [], [], 0.0
    for marker, (blob, with_depth) in enumerate(zip(assigned, depths, strict=True)):
        if blob < 0:
            continue
        deep = bool(np.isfinite(blobs[blob, 2]))
        extra += np.log(SETTINGS.prior_marker / SETTINGS.prior_clutter * RES_PX2)
        extra += np.log(SETTINGS.depth_range_m) if with_depth else (np.log(DEPTH_OUTLIER_PROBABILITY) if deep else 0.0)
        for axis in range(3 if with_depth else 2):
            rows.append(3 * marker + axis)
            values.append(blobs[blob, axis])
            variances.append(noise[blob, axis])
    if not rows:
        return 0.0
    s = covariance[np.ix_(rows, rows)] + np.diag(variances)
    return float(multivariate_normal(mean[rows], s).logpdf(values) + extra)


def is_inside_gate(
    mean: FloatArray,
    covariance: FloatArray,
    blobs: FloatArray,
    noise: FloatArray,
    assigned: tuple[int, ...],
    depths: tuple[bool, ...],
) -> bool:
    """Whether each name, the surest marker's first, is inside the gate given those before it."""
    spread = [np.linalg.det(covariance[3 * j : 3 * j + 2, 3 * j : 3 * j + 2]) for j in range(len(assigned))]
    rows, variances, values, before = list[int](), list[float](), list[float](), 0.0
    for j in np.argsort(spread, kind="stable"):
        if assigned[j] < 0:
            continue
        axes = range(3 if depths[j] else 2)
        rows += [3 * int(j) + axis for axis in axes]
        variances += [noise[assigned[j], axis] for axis in axes]
        values += [blobs[assigned[j], axis] for axis in axes]
        off = np.array(values) - mean[rows]
        distance2 = float(off @ np.linalg.solve(covariance[np.ix_(rows, rows)] + np.diag(variances), off))
        if distance2 - before > SETTINGS.gate_sd**2:
            return False
        before = distance2
    return True


def all_scores(
    mean: FloatArray, covariance: FloatArray, blobs: FloatArray, noise: FloatArray
) -> dict[tuple[tuple[int, ...], tuple[bool, ...]], float]:
    out = {}
    markers = mean.size // 3
    for assigned in assignments(markers, len(blobs)):
        ways = [(False, True) if i >= 0 and np.isfinite(blobs[i, 2]) else (False,) for i in assigned]
        for depths in product(*ways):
            if is_inside_gate(mean, covariance, blobs, noise, assigned, depths):
                out[assigned, depths] = joint_score(mean, covariance, blobs, noise, assigned, depths)
    return out


def as_key(assigned: NDArray[np.int64], with_depth: NDArray[np.bool_]) -> tuple[tuple[int, ...], tuple[bool, ...]]:
    return tuple(int(i) for i in assigned), tuple(bool(d) for d in with_depth)


@pytest.mark.parametrize("seed", range(6))
def test_associate_jointly_wide_beam_is_the_best_of_all(seed: int) -> None:
    mean, covariance, blobs, noise = scene(seed, clutter=seed % 3)
    found = associate_jointly(mean, covariance, blobs, noise, RES_PX2, replace(SETTINGS, beam_width=10_000))
    scores = all_scores(mean, covariance, blobs, noise)
    key = as_key(found.assigned, found.with_depth)
    used = found.assigned[found.assigned >= 0]
    assert len(set(used)) == len(used), "no blob twice"
    assert scores[key] == pytest.approx(found.log_posterior, abs=1e-6)
    assert found.log_posterior == pytest.approx(max(scores.values()), abs=1e-6)


@pytest.mark.parametrize("chance", [0.05, 0.5, 0.99, 0.9995, 1.0 - 1e-9, 1.0])
def test_chi2_quantiles_are_scipys(chance: float) -> None:
    quantiles = chi2_quantiles(chance)
    assert quantiles[0] == np.inf
    np.testing.assert_allclose(quantiles[1:], chi2.ppf(chance, np.arange(1, len(quantiles))), rtol=1e-12)

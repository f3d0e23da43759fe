"""On a linear model the kernel that tracks palm and fingers is the textbook's filter, mode by mode, chain by chain."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.compiled.mixture import predict_modes
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import (
    Linearisation,
    ModeMixture,
    mode_transition_matrix,
    partial_update_shares,
    update_mixture,
)
from carpus.core.tracking.smoother.palm_smoother import SmootherTransition, smooth_backwards

CHAINS, MODES, STATES, SEEN = 3, 2, 5, 4


def positive(rng: np.random.Generator, *lead: int, size: int) -> FloatArray:
    root = rng.normal(size=(*lead, size, size))
    return root @ np.swapaxes(root, -1, -2) + 0.1 * np.eye(size)


def any_mixture(seed: int) -> ModeMixture:
    rng = np.random.default_rng(seed)
    probability = rng.uniform(0.2, 1.0, (CHAINS, MODES))
    return ModeMixture(
        rng.normal(size=(CHAINS, MODES, STATES)),
        positive(rng, CHAINS, MODES, size=STATES),
        probability / probability.sum(axis=1, keepdims=True),
    )


def any_line(seed: int) -> Linearisation:
    rng = np.random.default_rng(100 + seed)
    return Linearisation(
        rng.normal(size=(CHAINS, SEEN)),
        rng.normal(size=(CHAINS, SEEN, STATES)),
        0.1 * positive(rng, CHAINS, size=SEEN),
        rng.normal(size=(CHAINS, STATES)),
    )


@pytest.mark.parametrize("seed", range(4))
def test_update_mixture_is_kalmans_without_nan_components(seed: int) -> None:
    rng, mixture, linearised = np.random.default_rng(seed), any_mixture(seed), any_line(seed)
    measured, variance = rng.normal(size=(CHAINS, SEEN)), rng.uniform(0.01, 2.0, (CHAINS, SEEN))
    shared = 0.05 * positive(rng, CHAINS, size=SEEN)
    measured[0, 1] = measured[2, 0] = measured[2, 3] = np.nan
    found = update_mixture(mixture, linearised, measured, variance, shared)
    for c in range(CHAINS):
        used = np.flatnonzero(np.isfinite(measured[c]))
        h = linearised.slope[c][used]
        r = (linearised.error[c] + shared[c])[np.ix_(used, used)] + np.diag(variance[c][used])
        likelihood, nis = np.empty(MODES), np.empty(MODES)
        for k in range(MODES):
            p = mixture.covariance[c, k]
            s = h @ p @ h.T + r
            gain = p @ h.T @ np.linalg.inv(s)
            off = measured[c][used] - linearised.value[c][used] - h @ (mixture.mean[c, k] - linearised.point[c])
            assert np.allclose(found.mixture.mean[c, k], mixture.mean[c, k] + gain @ off, atol=1e-10)
            assert np.allclose(found.mixture.covariance[c, k], p - gain @ s @ gain.T, atol=1e-10)
            nis[k] = off @ np.linalg.inv(s) @ off
            likelihood[k] = np.exp(-0.5 * nis[k]) / np.sqrt(np.linalg.det(s))
        weight = mixture.probability[c] * likelihood
        assert np.allclose(found.mixture.probability[c], weight / weight.sum(), atol=1e-6)
        assert found.nis[c] == pytest.approx(found.mixture.probability[c] @ nis, rel=1e-6)
        assert found.dof[c] == used.size
        assert not found.residual[c][~np.isfinite(measured[c])].any()


def test_mode_transition_matrix_keeps_the_dwell_time_at_any_step() -> None:
    one, three = mode_transition_matrix(3, 0.5, 0.1), mode_transition_matrix(3, 0.5, 0.3)
    assert np.allclose(one.sum(axis=1), 1.0)
    assert one[0, 0] ** 3 == pytest.approx(three[0, 0])
    assert np.array_equal(mode_transition_matrix(1, 0.5, 0.1), np.ones((1, 1)))


@pytest.mark.parametrize("learning", [0.0, 0.3, 1.0])
def test_partial_update_limits_the_given_rows_only(learning: float) -> None:
    mixture, linearised, rng = any_mixture(3), any_line(3), np.random.default_rng(4)
    measured, variance = rng.normal(size=(CHAINS, SEEN)), np.full((CHAINS, SEEN), 0.2)
    slow, fast = slice(3, STATES), slice(0, 3)
    whole = update_mixture(mixture, linearised, measured, variance).mixture
    part = update_mixture(
        mixture, linearised, measured, variance, partial=partial_update_shares(STATES, slow, learning)
    ).mixture
    assert np.allclose(part.mean[..., fast], whole.mean[..., fast])
    assert np.allclose(
        part.mean[..., slow] - mixture.mean[..., slow], learning * (whole.mean - mixture.mean)[..., slow]
    )
    assert np.allclose(part.covariance[..., fast, fast], whole.covariance[..., fast, fast])
    assert np.linalg.eigvalsh(part.covariance).min() > 0.0
    lost = (mixture.covariance - part.covariance)[..., slow, slow]
    assert np.allclose(lost, (1.0 - (1.0 - learning) ** 2) * (mixture.covariance - whole.covariance)[..., slow, slow])


class LinearTrajectory:
    """Frames of one chain of which the filtered estimates are known, ``seconds`` apart (None: begun anew)."""

    def __init__(
        self, mixtures: list[ModeMixture], forward: FloatArray, noise: FloatArray, seconds: list[float | None]
    ) -> None:
        self._estimates = [(mixture.mean[:, 0], mixture.covariance[:, 0]) for mixture in mixtures]
        self._forward, self._noise, self._seconds = forward[None], noise[None], seconds

    def __len__(self) -> int:
        return len(self._estimates)

    def get_estimate(self, frame: int) -> tuple[FloatArray, FloatArray]:
        return self._estimates[frame]

    def seconds_to_next(self, frame: int) -> float | None:
        return self._seconds[frame]

    def compute_transition(
        self, frame: int, now: tuple[FloatArray, FloatArray], later: tuple[FloatArray, FloatArray], dt_s: float
    ) -> SmootherTransition:
        return SmootherTransition(now[1], self._forward, self._noise, later[0] - now[0] @ self._forward[0].T, later[1])

    def apply_correction(
        self, now: tuple[FloatArray, FloatArray], correction: FloatArray, covariance: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        return now[0] + correction, covariance


def smooth_trajectory(trajectory: LinearTrajectory) -> dict[int, tuple[FloatArray, FloatArray]]:
    found = {frame: estimate for frame, estimate in smooth_backwards(trajectory) if estimate is not None}
    assert len(found) == len(trajectory)
    return found


def test_smoother_equals_batch_least_squares() -> None:
    """A line of Gaussian steps and measurements, solved at once and by the recursion."""
    rng, steps, n, m = np.random.default_rng(2), 6, 3, 2
    forward, noise = rng.normal(size=(n, n)), positive(rng, size=n)
    h, r = rng.normal(size=(m, n)), np.full(m, 0.4)
    start, spread = rng.normal(size=n), positive(rng, size=n)
    seen = rng.normal(size=(steps, m))
    linearised = Linearisation(np.zeros((1, m)), h[None], np.zeros((1, m, m)), np.zeros((1, n)))
    filtered = []
    mixture = ModeMixture(start[None, None], spread[None, None], np.ones((1, 1)))
    for k in range(steps):
        if k:
            mixture = ModeMixture(*predict_modes(mixture, forward[None], noise[None, None], None))
        mixture = update_mixture(mixture, linearised, seen[None, k], r[None]).mixture
        filtered.append(mixture)
    trajectory = LinearTrajectory(filtered, forward, noise, [0.1] * (steps - 1) + [None])
    found = smooth_trajectory(trajectory)
    smoothed, covariance = [found[k][0][0] for k in range(steps)], found[0][1][0]
    information = np.zeros((steps * n, steps * n))
    vector = np.zeros(steps * n)
    information[:n, :n] += np.linalg.inv(spread)
    vector[:n] += np.linalg.inv(spread) @ start
    for k in range(steps):
        own = slice(k * n, (k + 1) * n)
        information[own, own] += h.T @ np.diag(1.0 / r) @ h
        vector[own] += h.T @ (seen[k] / r)
        if k:
            both_steps = np.r_[(k - 1) * n : (k + 1) * n]
            move = np.hstack((-forward, np.eye(n)))
            information[np.ix_(both_steps, both_steps)] += move.T @ np.linalg.inv(noise) @ move
    batch = np.linalg.solve(information, vector).reshape(steps, n)
    assert np.allclose(smoothed, batch, atol=1e-8)
    assert np.allclose(covariance, np.linalg.inv(information)[:n, :n], atol=1e-8)

    apart = smooth_trajectory(LinearTrajectory(filtered, forward, noise, [0.1, None, 0.1, 0.0, 0.1, None]))
    assert np.array_equal(apart[1][0], filtered[1].mean[:, 0]), "begun anew after it"
    assert apart[3] is apart[4], "of one moment there is one estimate"
    assert not np.allclose(apart[0][0], smoothed[0]), "what came after the break says nothing"

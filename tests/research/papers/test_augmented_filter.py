"""The augmented filter against the Kalman filter where all is linear, and against filterpy's where it is not."""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter

from carpus.core.model.hand.anatomy_prior import Gaussian
from carpus.core.model.types import FloatArray
from carpus.core.research.papers.tracker import predict_outputs, predict_state, update_state
from carpus.core.tracking.filter.mixture_filter import UnscentedParameters

SCALINGS = [UnscentedParameters(1.0, 2.0, 0.0), UnscentedParameters(0.25, 2.0, 0.0), UnscentedParameters(0.5, 0.0, 1.0)]


def some_covariance(rng: np.random.Generator, n: int) -> FloatArray:
    root = rng.normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


def moved(state: FloatArray, noise: FloatArray) -> FloatArray:
    """A motion into which the noise does not enter as a sum."""
    x, y, heading = state[..., 0], state[..., 1], state[..., 2] + noise[..., 0]
    pace = 1.0 + 0.3 * noise[..., 1] ** 2 + 0.2 * np.sin(x)
    return np.stack((x + pace * np.cos(heading), y + pace * np.sin(heading), heading), axis=-1)


def project_state(state: FloatArray) -> FloatArray:
    x, y = state[..., 0], state[..., 1]
    return np.stack((np.hypot(x + 4.0, y), np.arctan2(y, x + 4.0)), axis=-1)


@pytest.mark.parametrize("scaling", SCALINGS)
@pytest.mark.parametrize("seed", range(3))
def test_predict_and_update_are_filterpys(scaling: UnscentedParameters, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, p, q = rng.normal(size=3), 0.02 * some_covariance(rng, 3), 0.03 * some_covariance(rng, 2)
    r, y = np.array([0.04, 0.01]), project_state(x) + 0.2 * rng.normal(size=2)

    points = MerweScaledSigmaPoints(5, scaling.alpha, scaling.beta, scaling.kappa)
    oracle = UnscentedKalmanFilter(
        5, 2, 1.0, lambda s: project_state(s[:3]), lambda s, _dt: np.concatenate((moved(s[:3], s[3:]), s[3:])), points
    )
    oracle.x, oracle.P = np.concatenate((x, np.zeros(2))), np.zeros((5, 5))
    oracle.P[:3, :3], oracle.P[3:, 3:] = p, q
    oracle.Q, oracle.R = np.zeros((5, 5)), np.diag(r)
    oracle.compute_process_sigmas(1.0)
    predicted_points = oracle.sigmas_f.copy()
    oracle.predict()
    ahead = predict_state(Gaussian(x, p), q, moved, scaling)
    assert np.allclose(ahead.state.mean, oracle.x[:3], rtol=1e-9, atol=1e-12)
    assert np.allclose(ahead.state.covariance, oracle.P[:3, :3], rtol=1e-9, atol=1e-12)

    oracle.sigmas_f = predicted_points  # it draws new ones; (9) goes on with those that were moved
    oracle.update(y)
    after, _ = update_state(ahead, predict_outputs(ahead, project_state(ahead.points)), y, r)
    assert np.allclose(after.mean, oracle.x[:3], rtol=1e-8, atol=1e-10)
    assert np.allclose(after.covariance, oracle.P[:3, :3], rtol=1e-8, atol=1e-10)
    assert np.linalg.norm(after.mean - ahead.state.mean) > 1e-3

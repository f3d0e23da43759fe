"""The augmented unscented Kalman filter of Kandepu et al. (2008), which both papers use; any model, plain vectors.

The noise of the motion is part of the state from which the sigma points are drawn, so that it may enter as it will;
the noise of the measurement is added, as in (11).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carpus.core.tracking.unscented import Spread, deviations, weights_for
from carpus.core.types import FloatArray

Motion = Callable[[FloatArray, FloatArray], FloatArray]
"""States (P, n) after a step from states (P, n) and noises (P, k)."""


@dataclass(frozen=True, slots=True)
class AugmentedGaussian:
    """``mean`` (n,) and ``covariance`` (n, n)."""

    mean: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True)
class Predicted:
    """The state ahead: ``points`` (P, n) X_n,t|t-1 with ``mean_weight`` and ``covariance_weight`` (P,), and what they
    say of it."""

    points: FloatArray
    mean_weight: FloatArray
    covariance_weight: FloatArray
    state: AugmentedGaussian


@dataclass(frozen=True, slots=True)
class SeenOutputs:
    """What the predicted points show of m outputs: their mean (10) and covariance (11) without the noise of the
    measurement, and their covariance (n, m) with the state."""

    mean: FloatArray
    covariance: FloatArray
    with_state: FloatArray


@dataclass(frozen=True, slots=True)
class Corrected:
    """The state after a measurement, and the normalised innovation squared."""

    state: AugmentedGaussian
    nis: float


def predict(state: AugmentedGaussian, noise_covariance: FloatArray, motion: Motion, spread: Spread) -> Predicted:
    """Draw points over state and noise (k, k) together and move them.

    Raises ``numpy.linalg.LinAlgError`` when the covariance of the state is none.
    """
    n, k = state.mean.size, noise_covariance.shape[0]
    weights = weights_for(n + k, spread)
    both = np.zeros((n + k, n + k))
    both[:n, :n], both[n:, n:] = state.covariance, noise_covariance
    away = deviations(both, weights.scale)
    points = motion(state.mean + away[:, :n], away[:, n:])
    mean = weights.mean @ points
    apart = points - mean
    covariance = (apart * weights.covariance[:, None]).T @ apart
    return Predicted(points, weights.mean, weights.covariance, AugmentedGaussian(mean, covariance))


def seen_from(ahead: Predicted, outputs: FloatArray) -> SeenOutputs:
    """Mean and covariances of outputs (P, m) of the predicted points."""
    mean = ahead.mean_weight @ outputs
    apart = outputs - mean
    weighted = apart * ahead.covariance_weight[:, None]
    return SeenOutputs(mean, weighted.T @ apart, (ahead.points - ahead.state.mean).T @ weighted)


def correct(ahead: Predicted, seen: SeenOutputs, measured: FloatArray, noise_variance: FloatArray) -> Corrected:
    """The classical update by measurements (m,) with noise variances (m,)."""
    if not measured.size:
        return Corrected(ahead.state, float("nan"))
    innovation = measured - seen.mean
    spread = seen.covariance + np.diag(noise_variance)
    gain = np.linalg.solve(spread, seen.with_state.T).T
    covariance = ahead.state.covariance - gain @ spread @ gain.T
    state = AugmentedGaussian(ahead.state.mean + gain @ innovation, 0.5 * (covariance + covariance.T))
    return Corrected(state, float(innovation @ np.linalg.solve(spread, innovation)))

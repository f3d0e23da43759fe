"""Both forms of the filter against filterpy's UKF before the real camera: same points and weights, same answer.

Motion, rotation (SciPy) and projection are written again here, so a slip in the program's own would show.
"""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter, unscented_transform
from scipy.spatial.transform import Rotation

from core.tracking.measurement import Forecast, RigidPalm, View, forecast, forecast_augmented, update
from core.tracking.modes import ModeBank, merged
from core.tracking.motion import MotionNoise
from core.tracking.state import Belief, StateLayout
from core.tracking.unscented import Spread
from core.types import FloatArray
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M

SPREAD = Spread(alpha=0.3, beta=2.0, kappa=0.0)
NOISE = MotionNoise(2.0, 8.0, 1.5)
VIEW = View(CAMERA, FROM_ABOVE, MIDDLE_M, RigidPalm(RIGHT_PALM_M))
SHAPES = 18
ROWS = np.array([0, 1, 2, 6, 7, 9, 10, 11, 15, 16, 17])
"""CMC1 and MCP4 hidden, MCP2 without its depth: rows 3i + (u, v, z)."""
NOISE_VARIANCE = np.where(ROWS % 3 < 2, 0.3**2, 0.002**2)


def projected(position: FloatArray, rotation: FloatArray, shape: FloatArray) -> FloatArray:
    """u, v, z of all six discs, one after the other: eq. (2), (3) and the depth of (13)."""
    out = []
    for disc, shift in zip(RIGHT_PALM_M, shape.reshape(-1, 3), strict=True):
        x, y, z = FROM_ABOVE @ (rotation @ (disc + shift) + position) + MIDDLE_M
        out += [525.0 * x / z + 319.5, 525.0 * y / z + 239.5, z]
    return np.array(out)


def random_belief(layout: StateLayout, seed: int) -> Belief:
    rng = np.random.default_rng(seed)
    n = layout.size
    sd = np.concatenate((np.full(3, 0.004), np.full(3, 0.1), np.full(3, 0.06), np.full(3, 0.5), np.full(SHAPES, 6e-4)))
    if not layout.has_rates:
        sd = np.delete(sd, np.arange(9, 12))
    root = np.linalg.qr(rng.normal(size=(n, n)))[0] * np.sqrt(rng.uniform(0.5, 1.5, n))
    return Belief(
        0.02 * rng.normal(size=3),
        0.2 * rng.normal(size=3),
        Rotation.from_euler("ZYX", [0.4, 0.5, -0.3]).as_matrix(),
        rng.normal(size=3) if layout.has_rates else np.zeros(3),
        np.empty(0),
        np.empty(0),
        4e-4 * rng.normal(size=SHAPES),
        (root @ root.T) * np.outer(sd, sd),
    )


def measured_values(belief: Belief, seed: int) -> FloatArray:
    """What a hand a good sigma away from the belief would show."""
    rng = np.random.default_rng(seed + 100)
    rotation = belief.rotation_w2_w0 @ Rotation.from_rotvec(0.05 * rng.normal(size=3)).as_matrix()
    there = projected(belief.position_m + 0.004 * rng.normal(size=3), rotation, belief.shape)
    return np.asarray(there[ROWS] + np.sqrt(NOISE_VARIANCE) * rng.normal(size=ROWS.size))


def error_between(a: Belief, b: Belief, layout: StateLayout) -> FloatArray:
    parts = [b.position_m - a.position_m, b.velocity_m_s - a.velocity_m_s]
    parts.append(Rotation.from_matrix(a.rotation_w2_w0.T @ b.rotation_w2_w0).as_rotvec())
    if layout.has_rates:
        parts.append(b.rate_rad_s - a.rate_rad_s)
    return np.concatenate([*parts, b.shape - a.shape])


def in_sd(difference: FloatArray, covariance: FloatArray) -> float:
    return float(np.abs(difference / np.sqrt(np.diag(covariance))).max())


@pytest.mark.parametrize("has_rates", [True, False])
@pytest.mark.parametrize("seed", range(4))
def test_measurement_update_is_filterpys(has_rates: bool, seed: int) -> None:
    layout = StateLayout(0, has_rates, SHAPES)
    belief = random_belief(layout, seed)
    y = measured_values(belief, seed)
    seen = layout.seen

    def measurement(error: FloatArray) -> FloatArray:
        rotation = belief.rotation_w2_w0 @ Rotation.from_rotvec(error[3:6]).as_matrix()
        return projected(belief.position_m + error[:3], rotation, belief.shape + error[6:])[ROWS]

    points = MerweScaledSigmaPoints(seen.size, SPREAD.alpha, SPREAD.beta, SPREAD.kappa)
    oracle = UnscentedKalmanFilter(seen.size, ROWS.size, 1.0, measurement, lambda x, _dt: x, points)
    oracle.x, oracle.P, oracle.R = np.zeros(seen.size), belief.covariance[np.ix_(seen, seen)], np.diag(NOISE_VARIANCE)
    oracle.sigmas_f = points.sigma_points(oracle.x, oracle.P)
    oracle.update(y)

    ahead = forecast(ModeBank.of(belief, 1), layout, VIEW, SPREAD)
    after, innovation = update(ahead, ROWS, y, NOISE_VARIANCE)
    assert in_sd(after.error[0, seen] - oracle.x, oracle.P) < 1e-7
    scale = np.sqrt(np.outer(np.diag(oracle.P), np.diag(oracle.P)))
    assert np.abs((after.covariance[0][np.ix_(seen, seen)] - oracle.P) / scale).max() < 1e-7
    assert innovation.nis[0] == pytest.approx(oracle.y @ oracle.SI @ oracle.y, rel=1e-7)
    assert innovation.log_likelihood[0] == pytest.approx(oracle.log_likelihood, abs=1e-7)

    # States that the camera does not see move by regression on those it does: the Gaussian's own formula.
    unseen = np.setdiff1d(np.arange(layout.size), seen)
    p = belief.covariance
    gain = p[np.ix_(unseen, seen)] @ np.linalg.inv(p[np.ix_(seen, seen)])
    assert in_sd(after.error[0, unseen] - gain @ oracle.x, p[np.ix_(unseen, unseen)]) < 1e-7
    expected = p[np.ix_(unseen, unseen)] + gain @ (oracle.P - p[np.ix_(seen, seen)]) @ gain.T
    assert np.allclose(after.covariance[0][np.ix_(unseen, unseen)], expected, rtol=1e-6, atol=1e-9)
    assert np.abs(after.error[0]).max() > 1e-3, "the measurement did move the belief"


class AugmentedOracle:
    """Kandepu's augmented filter out of filterpy's parts: one set of points over state and noise."""

    def __init__(self, belief: Belief, layout: StateLayout, dt: float) -> None:
        self._belief, self._layout, self._dt = belief, layout, dt
        n, k = layout.size, 6
        turn_sd = NOISE.turn_acceleration_rad_s2 if layout.has_rates else NOISE.turn_rate_rad_s
        sd = np.repeat([NOISE.acceleration_m_s2, turn_sd], 3) * np.sqrt(1.0 / 30.0 / dt)
        self.points = MerweScaledSigmaPoints(n + k, SPREAD.alpha, SPREAD.beta, SPREAD.kappa)
        self.ukf = UnscentedKalmanFilter(
            n + k, ROWS.size, dt, self._measurement, self._motion, self.points,
            x_mean_fn=self._mean, residual_x=self._residual,
        )  # fmt: skip
        self.ukf.x = np.zeros(n + k)
        self.ukf.P = np.zeros((n + k, n + k))
        self.ukf.P[:n, :n] = belief.covariance
        self.ukf.P[n:, n:] = np.diag(sd**2)
        self.ukf.R = np.diag(NOISE_VARIANCE)
        self.ukf.compute_process_sigmas(dt)
        # No fresh points between motion and measurement: those of the state carry the noise along.
        self.ukf.x, self.ukf.P = unscented_transform(
            self.ukf.sigmas_f, self.ukf.Wm, self.ukf.Wc, np.zeros((n + k, n + k)), self._mean, self._residual
        )

    def _motion(self, x: FloatArray, _dt: float) -> FloatArray:
        """State after the step as T, v, turn vector of R itself, omega, shape; then the noise."""
        layout, belief, dt = self._layout, self._belief, self._dt
        error, noise = x[: layout.size], x[layout.size :]
        position, velocity = belief.position_m + error[0:3], belief.velocity_m_s + error[3:6]
        rotation = Rotation.from_matrix(belief.rotation_w2_w0) * Rotation.from_rotvec(error[6:9])
        if layout.has_rates:
            rate = belief.rate_rad_s + error[9:12]
            rotation = rotation * Rotation.from_rotvec(rate * dt + 0.5 * dt * dt * noise[3:6])
            parts = [position + velocity * dt + 0.5 * dt * dt * noise[0:3], velocity + noise[0:3] * dt]
            parts += [rotation.as_rotvec(), rate + noise[3:6] * dt]
        else:
            rotation = rotation * Rotation.from_rotvec(noise[3:6] * dt)  # eq. (5)
            parts = [position + velocity * dt, velocity + noise[0:3] * dt, rotation.as_rotvec()]
        return np.concatenate([*parts, belief.shape + error[layout.shape], noise])

    def _measurement(self, x: FloatArray) -> FloatArray:
        shape = x[: self._layout.size][self._layout.shape]
        return projected(x[:3], Rotation.from_rotvec(x[6:9]).as_matrix(), shape)[ROWS]

    def _mean(self, sigmas: FloatArray, weights: FloatArray) -> FloatArray:
        mean = weights @ sigmas
        rotations = Rotation.from_rotvec(sigmas[:, 6:9])
        centre = rotations[0]
        for _ in range(12):
            centre = centre * Rotation.from_rotvec(weights @ (centre.inv() * rotations).as_rotvec())
        mean[6:9] = centre.as_rotvec()
        return mean

    def _residual(self, a: FloatArray, b: FloatArray) -> FloatArray:
        difference = a - b
        difference[6:9] = (Rotation.from_rotvec(b[6:9]).inv() * Rotation.from_rotvec(a[6:9])).as_rotvec()
        return difference

    def update(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Correction (n,) of the predicted state, and the covariance after it."""
        n = self._layout.size
        self.ukf.update(y)
        return (self.ukf.K @ self.ukf.y)[:n], self.ukf.P[:n, :n]


@pytest.mark.parametrize("has_rates", [True, False])
@pytest.mark.parametrize("seed", range(3))
def test_augmented_filter_is_filterpys(has_rates: bool, seed: int) -> None:
    layout, dt = StateLayout(0, has_rates, SHAPES), 0.05
    belief = random_belief(layout, seed)
    oracle = AugmentedOracle(belief, layout, dt)
    mean, covariance = oracle.ukf.x.copy(), oracle.ukf.P.copy()
    ahead = forecast_augmented(ModeBank.of(belief, 1), NOISE, np.ones(1), dt, layout, VIEW, SPREAD)
    predicted = merged(ahead.bank, layout).nominal
    n = layout.size
    assert in_sd(predicted.position_m - mean[:3], covariance[:3, :3]) < 1e-7
    assert in_sd(predicted.velocity_m_s - mean[3:6], covariance[3:6, 3:6]) < 1e-7
    turn = Rotation.from_matrix(predicted.rotation_w2_w0).inv() * Rotation.from_rotvec(mean[6:9])
    assert turn.magnitude() < 1e-8
    scale = np.sqrt(np.outer(np.diag(covariance[:n, :n]), np.diag(covariance[:n, :n])))
    assert np.abs((predicted.covariance - covariance[:n, :n]) / scale).max() < 1e-6

    y = measured_values(predicted, seed)
    correction, p = oracle.update(y)
    after, innovation = update(ahead, ROWS, y, NOISE_VARIANCE)
    final = merged(after, layout).nominal
    assert in_sd(error_between(predicted, final, layout) - correction, p) < 1e-6
    assert np.abs((final.covariance - p) / np.sqrt(np.outer(np.diag(p), np.diag(p)))).max() < 1e-6
    assert innovation.nis[0] == pytest.approx(oracle.ukf.y @ oracle.ukf.SI @ oracle.ukf.y, rel=1e-6)


def mode_after_prediction(ahead: Forecast, layout: StateLayout, k: int) -> Belief:
    return ahead.bank.nominal.moved(ahead.bank.error[k], layout, ahead.bank.covariance[k])


def test_augmented_modes_are_each_the_filter_run_alone() -> None:
    """Two modes with means apart and noises four times and half; they are told as errors from one belief."""
    layout, dt = StateLayout(0, True, SHAPES), 0.04
    belief = random_belief(layout, 7)
    rng = np.random.default_rng(8)
    root = np.linalg.cholesky(belief.covariance)
    error = 0.3 * (root @ rng.normal(size=(layout.size, 2))).T
    bank = ModeBank(belief, error, np.stack((belief.covariance, 0.5 * belief.covariance)), np.array([0.3, 0.7]))
    scales = np.array([0.5, 4.0])
    together = forecast_augmented(bank, NOISE, scales, dt, layout, VIEW, SPREAD)
    for k in range(2):
        alone = belief.moved(error[k], layout, bank.covariance[k])
        single = forecast_augmented(ModeBank.of(alone, 1), NOISE, scales[k : k + 1], dt, layout, VIEW, SPREAD)
        a, b = mode_after_prediction(together, layout, k), single.bank.nominal
        # The turns are a fiftieth radian apart, and turns told from there and from here differ to second order.
        assert in_sd(error_between(a, b, layout), single.bank.covariance[0]) < 0.02
        sd = np.sqrt(np.diag(single.bank.covariance[0]))
        assert np.abs((a.covariance - single.bank.covariance[0]) / np.outer(sd, sd)).max() < 0.05
        off = (together.marker_mean[k] - single.marker_mean[0]).reshape(6, 3)
        assert np.abs(off / [0.1, 0.1, 1e-4]).max() < 1.0
    assert np.linalg.norm(error[:, layout.turn], axis=1).max() > 0.02

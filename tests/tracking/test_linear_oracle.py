"""On a linear model both forms of the unscented filter are the Kalman filter, to the last digits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from core import so3
from core.tracking import modes
from core.tracking.measurement import Forecast, View, forecast_augmented, forecast_reduced, update
from core.tracking.modes import ModeBank
from core.tracking.motion import MotionNoise
from core.tracking.state import Belief, StateLayout
from core.tracking.unscented import Spread
from core.types import FloatArray

MARKERS = 4
JOINTS, SHAPES = 3, 2
NOISE = MotionNoise(2.0, 8.0, 1.5, 12.0, 2.5)
TOLERANCE = 1e-10


@dataclass(frozen=True)
class LinearView:
    """Stands in for the camera: what it sees of a marker is linear in position, joints, shape and one turn.

    The turn about Z is read from the first column of R, which a turn about X or Y alone does not move aside.
    """

    by_position: FloatArray
    by_joints: FloatArray
    by_shape: FloatArray
    by_yaw: FloatArray

    def observe(
        self, position_m: FloatArray, rotation_w2_w0: FloatArray, joints_rad: FloatArray, shape: FloatArray
    ) -> FloatArray:
        yaw = np.arctan2(rotation_w2_w0[..., 1, 0], rotation_w2_w0[..., 0, 0])
        flat = (
            position_m @ self.by_position.T
            + joints_rad @ self.by_joints.T
            + shape @ self.by_shape.T
            + yaw[..., None] * self.by_yaw
        )
        return np.asarray(flat.reshape(*flat.shape[:-1], MARKERS, 3))

    def matrix(self, layout: StateLayout) -> FloatArray:
        """H (3 M, n) of the same."""
        h = np.zeros((3 * MARKERS, layout.size))
        h[:, 0:3] = self.by_position
        h[:, 8] = self.by_yaw
        h[:, layout.joints] = self.by_joints
        h[:, layout.shape] = self.by_shape
        return h


def linear_view(rng: np.random.Generator, yaw: float) -> LinearView:
    rows = 3 * MARKERS
    return LinearView(
        rng.normal(size=(rows, 3)), rng.normal(size=(rows, JOINTS)), rng.normal(size=(rows, SHAPES)),
        yaw * rng.normal(size=rows),
    )  # fmt: skip


class KalmanFilter:
    """The textbook: x = F x, P = F P F' + Q; K = P H' S^-1, x += K (y - H x), P -= K S K'."""

    def __init__(self, x: FloatArray, p: FloatArray) -> None:
        self.x, self.p = x.copy(), p.copy()

    def predict(self, f: FloatArray, q: FloatArray) -> None:
        self.x = f @ self.x
        self.p = f @ self.p @ f.T + q

    def update(self, h: FloatArray, y: FloatArray, r: FloatArray) -> None:
        s = h @ self.p @ h.T + np.diag(r)
        k = self.p @ h.T @ np.linalg.inv(s)
        self.x = self.x + k @ (y - h @ self.x)
        self.p = self.p - k @ s @ k.T


def by_hand(layout: StateLayout, dt: float) -> tuple[FloatArray, FloatArray]:
    """F and Q, written out axis by axis: eq. (5) of the wrist paper, or the accelerations held over a step."""
    n = layout.size
    f, q = np.eye(n), np.zeros((n, n))
    per_sample = 1.0 / 30.0 / dt  # the density stays when the frame rate changes

    def white_rate(at: int, sd: float) -> None:
        q[at, at] = sd**2 * per_sample * dt**2

    def white_acceleration(at: int, rate_at: int, sd: float) -> None:
        f[at, rate_at] = dt
        g = np.array([0.5 * dt**2, dt])
        q[np.ix_([at, rate_at], [at, rate_at])] = sd**2 * per_sample * np.outer(g, g)

    for axis in range(3):
        if layout.has_rates:
            white_acceleration(axis, 3 + axis, NOISE.acceleration_m_s2)
            white_acceleration(6 + axis, 9 + axis, NOISE.turn_acceleration_rad_s2)
        else:
            f[axis, 3 + axis] = dt
            white_rate(3 + axis, NOISE.acceleration_m_s2)
            white_rate(6 + axis, NOISE.turn_rate_rad_s)
    for j in range(JOINTS):
        at = layout.joints.start + j
        if layout.has_rates:
            white_acceleration(at, layout.joint_rates.start + j, NOISE.joint_acceleration_rad_s2)
        else:
            white_rate(at, NOISE.joint_rate_rad_s)
    return f, q


def start(layout: StateLayout, rng: np.random.Generator, yaw_rate: float) -> Belief:
    """A belief whose turn is independent of all else and alike about X and Y, everything else correlated."""
    n = layout.size
    turning = list(range(6, layout.rate.stop if layout.has_rates else 9))
    other = [i for i in range(n) if i not in turning]
    root = rng.normal(size=(len(other), len(other)))
    p = np.zeros((n, n))
    p[np.ix_(other, other)] = root @ root.T / len(other) + 0.1 * np.eye(len(other))
    p[turning, turning] = [0.01, 0.01, 0.04, 0.01, 0.01, 0.25][: len(turning)]
    has_rates = layout.has_rates
    return Belief(
        rng.normal(size=3),
        rng.normal(size=3),
        so3.exp(np.array([0.0, 0.0, 0.3])),
        np.array([0.0, 0.0, yaw_rate]) if has_rates else np.zeros(3),
        rng.normal(size=JOINTS),
        rng.normal(size=JOINTS) if has_rates else np.zeros(JOINTS),
        rng.normal(size=SHAPES),
        p,
    )


def as_vector(belief: Belief, layout: StateLayout) -> FloatArray:
    parts = [belief.position_m, belief.velocity_m_s, so3.log(belief.rotation_w2_w0)]
    parts += [belief.rate_rad_s] if layout.has_rates else []
    parts += [belief.joints_rad]
    parts += [belief.joint_rates_rad_s] if layout.has_rates else []
    return np.concatenate([*parts, belief.shape])


def forecast(form: str, bank: ModeBank, dt: float, layout: StateLayout, view: LinearView) -> Forecast:
    stands_in: View = view  # type: ignore[assignment]
    build = forecast_reduced if form == "reduced" else forecast_augmented
    return build(bank, NOISE, np.ones(1), dt, layout, stands_in, Spread(alpha=0.3, beta=2.0, kappa=0.0))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("form", "has_rates", "yaw"),
    [
        ("reduced", True, 1.0),
        ("reduced", False, 1.0),
        ("augmented", False, 1.0),
        # Turn and turn rate about different axes do not commute, so here nothing is seen of the turn.
        ("augmented", True, 0.0),
    ],
)
def test_unscented_is_the_kalman_filter_on_a_linear_model(form: str, has_rates: bool, yaw: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    layout = StateLayout(JOINTS, has_rates, SHAPES)
    view = linear_view(rng, yaw)
    belief = start(layout, rng, yaw_rate=0.4 * yaw)
    h = view.matrix(layout)
    kalman = KalmanFilter(as_vector(belief, layout), belief.covariance)
    compared = [i for i in range(layout.size) if i not in (6, 7, 9, 10)] if has_rates else list(range(layout.size))
    if form == "augmented":
        compared = list(range(layout.size))
    bank = ModeBank.of(belief, 1)
    for _ in range(40):
        # Not longer: of the turns about X and Y nothing is seen, and points past a quarter turn are not linear.
        dt = float(rng.choice([0.005, 1.0 / 60.0, 1.0 / 30.0]))
        ahead = forecast(form, bank, dt, layout, view)
        rows = np.sort(rng.choice(3 * MARKERS, size=int(rng.integers(0, 3 * MARKERS + 1)), replace=False))
        noise = rng.uniform(0.05, 0.5, rows.size) ** 2
        kalman.predict(*by_hand(layout, dt))
        y = h[rows] @ kalman.x + 0.3 * rng.normal(size=rows.size)
        after, innovation = update(ahead, rows, y, noise)
        if rows.size:
            s = h[rows] @ kalman.p @ h[rows].T + np.diag(noise)
            v = y - h[rows] @ kalman.x
            assert np.allclose(innovation.nis, v @ np.linalg.solve(s, v), rtol=1e-9)
            expected = -0.5 * (v @ np.linalg.solve(s, v) + np.linalg.slogdet(2.0 * np.pi * s)[1])
            assert np.allclose(innovation.log_likelihood, expected, rtol=1e-9)
            assert innovation.dof == rows.size
        kalman.update(h[rows], y, noise)
        bank = modes.merged(after, layout)
        belief = bank.nominal
        mean = as_vector(belief, layout)
        assert np.abs(mean - kalman.x)[compared].max() < TOLERANCE
        assert np.abs(belief.covariance - kalman.p)[np.ix_(compared, compared)].max() < TOLERANCE


def test_residuals_have_unit_variance_when_noise_and_model_are_right() -> None:
    """The normalised residuals by which each marker's noise is judged are N(0, 1) for a right filter."""
    rng = np.random.default_rng(5)
    layout = StateLayout(JOINTS, False, SHAPES)
    view = linear_view(rng, 0.0)
    belief = start(layout, rng, yaw_rate=0.0)
    h = view.matrix(layout)
    rows = np.array([0, 1, 4, 5, 6, 9])
    noise = np.array([0.3, 0.1, 0.5, 0.2, 0.4, 0.3]) ** 2
    ahead = forecast("reduced", ModeBank.of(belief, 1), 0.05, layout, view)
    mean, covariance = as_vector(ahead.bank.nominal, layout), ahead.bank.covariance[0]
    root = np.linalg.cholesky(covariance)
    residuals = []
    for _ in range(2000):
        x = mean + root @ rng.normal(size=layout.size)
        y = h[rows] @ x + np.sqrt(noise) * rng.normal(size=rows.size)
        residuals.append(update(ahead, rows, y, noise)[1].residual[0])
    variance = np.mean(np.square(residuals), axis=0)
    # Chi-square with 2000 degrees of freedom: within 5 standard deviations of one.
    assert np.all(np.abs(variance - 1.0) < 5.0 * np.sqrt(2.0 / 2000.0))

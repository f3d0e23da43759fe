"""How the hand may move between two frames: eq. (1) and (5) of the wrist paper and the constant-rate model.

Noise is given as the papers' standard deviation per sample at 30 pictures a second and used as a
continuous density q = sd^2 / 30, so that other or missing frame times keep their meaning (reference 4.5).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from core import so3
from core.tracking.state import Belief, StateLayout
from core.types import FloatArray

REFERENCE_DT_S = 1.0 / 30.0

MotionModel = Literal["constant_rate", "paper"]


@dataclass(frozen=True, slots=True)
class MotionNoise:
    """Standard deviations per sample at 30 Hz; three numbers for x, y, z of W2.

    ``acceleration_m_s2`` of the wrist (eta_v); ``turn_acceleration_rad_s2`` for the constant-rate model;
    ``turn_rate_rad_s`` eta_omega of the papers; ``joint_*`` (J,) or a scalar likewise for the fingers.
    """

    acceleration_m_s2: float = 2.0
    turn_acceleration_rad_s2: float = 8.0
    turn_rate_rad_s: float = 1.5
    joint_acceleration_rad_s2: float = 12.0
    joint_rate_rad_s: float = 2.5

    def scaled(self, factor: float) -> MotionNoise:
        return replace(
            self,
            acceleration_m_s2=self.acceleration_m_s2 * factor,
            turn_acceleration_rad_s2=self.turn_acceleration_rad_s2 * factor,
            turn_rate_rad_s=self.turn_rate_rad_s * factor,
            joint_acceleration_rad_s2=self.joint_acceleration_rad_s2 * factor,
            joint_rate_rad_s=self.joint_rate_rad_s * factor,
        )

    def per_step(self, layout: StateLayout, dt_s: float) -> FloatArray:
        """Standard deviations (k,) of the noise inputs of :func:`advance` for a step of ``dt_s``."""
        stretch = np.sqrt(REFERENCE_DT_S / dt_s)
        turn = self.turn_acceleration_rad_s2 if layout.has_rates else self.turn_rate_rad_s
        joint = self.joint_acceleration_rad_s2 if layout.has_rates else self.joint_rate_rad_s
        sd = np.concatenate((np.full(3, self.acceleration_m_s2), np.full(3, turn), np.full(layout.joint_count, joint)))
        return np.asarray(sd * stretch)


def advance(belief: Belief, noise: FloatArray, dt_s: float, layout: StateLayout) -> Belief:
    """The mean after ``dt_s`` under noise inputs (..., 6 + J): acceleration, turning, joints.

    Without rates this is eq. (5) of the wrist paper and (1) of the hand paper to the letter; with rates
    the inputs are accelerations that hold over the step. The covariance is left as it is.
    """
    push, turning, joints = noise[..., 0:3], noise[..., 3:6], noise[..., 6:]
    if not layout.has_rates:
        return replace(
            belief,
            position_m=belief.position_m + belief.velocity_m_s * dt_s,
            velocity_m_s=belief.velocity_m_s + push * dt_s,
            rotation_w2_w0=belief.rotation_w2_w0 @ so3.exp(turning * dt_s),
            joints_rad=belief.joints_rad + joints * dt_s,
        )
    half = 0.5 * dt_s * dt_s
    return replace(
        belief,
        position_m=belief.position_m + belief.velocity_m_s * dt_s + push * half,
        velocity_m_s=belief.velocity_m_s + push * dt_s,
        rotation_w2_w0=belief.rotation_w2_w0 @ so3.exp(belief.rate_rad_s * dt_s + turning * half),
        rate_rad_s=belief.rate_rad_s + turning * dt_s,
        joints_rad=belief.joints_rad + belief.joint_rates_rad_s * dt_s + joints * half,
        joint_rates_rad_s=belief.joint_rates_rad_s + joints * dt_s,
    )


@dataclass(frozen=True, slots=True)
class Stride:
    """One step of the motion about a belief, for the m states that move (all but the shape).

    ``forward`` F (m, m): how a small error travels, the turn to first order; ``noise`` Q (m, m); ``turned`` (3, 3)
    the turn that the rate makes of the step.
    """

    forward: FloatArray
    noise: FloatArray
    turned: FloatArray


def stride(belief: Belief, noise: MotionNoise, dt_s: float, layout: StateLayout) -> Stride:
    """F, Q and the turn of a single belief's step."""
    turned, on_the_way = _turn(belief, dt_s, layout)
    return Stride(_forward(turned, on_the_way, dt_s, layout), _driven(noise, on_the_way, dt_s, layout), turned)


def transition(belief: Belief, dt_s: float, layout: StateLayout) -> FloatArray:
    """F (n, n) of all states."""
    f = np.eye(layout.size)
    f[layout.moving, layout.moving] = _forward(*_turn(belief, dt_s, layout), dt_s, layout)
    return f


def process_covariance(belief: Belief, noise: MotionNoise, dt_s: float, layout: StateLayout) -> FloatArray:
    """Q (n, n) of all states: what the noise inputs of :func:`advance` add to the covariance in ``dt_s``."""
    q = np.zeros((layout.size, layout.size))
    q[layout.moving, layout.moving] = _driven(noise, _turn(belief, dt_s, layout)[1], dt_s, layout)
    return q


def coasted(belief: Belief, step: Stride, dt_s: float, layout: StateLayout) -> Belief:
    """The mean after ``dt_s`` without noise: :func:`advance` with the turn at hand."""
    joints = belief.joints_rad
    if layout.has_rates and layout.joint_count:
        joints = joints + belief.joint_rates_rad_s * dt_s
    return Belief(
        belief.position_m + belief.velocity_m_s * dt_s,
        belief.velocity_m_s,
        belief.rotation_w2_w0 @ step.turned,
        belief.rate_rad_s,
        joints,
        belief.joint_rates_rad_s,
        belief.shape,
        belief.covariance,
    )


def _turn(belief: Belief, dt_s: float, layout: StateLayout) -> tuple[FloatArray, FloatArray]:
    """The turn (3, 3) that the rate makes of a step, and its right Jacobian (3, 3); no turn without rates."""
    if not layout.has_rates:
        return _NO_TURN, _NO_TURN
    turn = belief.rate_rad_s * dt_s
    return so3.exp(turn), so3.right_jacobian(turn)


_NO_TURN = np.eye(3)


def _forward(turned: FloatArray, on_the_way: FloatArray, dt_s: float, layout: StateLayout) -> FloatArray:
    still, dt_at = _still(layout)
    f = still.copy()
    f.reshape(-1)[dt_at] = dt_s
    if layout.has_rates:
        f[6:9, 6:9] = turned.T
        f[6:9, 9:12] = on_the_way * dt_s
    return f


@lru_cache(maxsize=16)
def _still(layout: StateLayout) -> tuple[FloatArray, NDArray[np.int64]]:
    """The identity (m, m) of the states that move, and where in it, flat, a value grows by its rate."""
    size = layout.moving.stop
    value, rate = np.arange(3), 3 + np.arange(3)
    if layout.has_rates:
        joint = np.arange(layout.joint_count)
        value, rate = np.r_[value, layout.joints.start + joint], np.r_[rate, layout.joint_rates.start + joint]
    return np.eye(size), value * size + rate


@lru_cache(maxsize=16)
def _process_terms(noise: MotionNoise, layout: StateLayout) -> FloatArray:
    """A, B, C (3, m m) of Q(dt) = A dt + B dt^2 + C dt^3 of the states that move, flat, from noise that holds over a
    step and has the density sd^2 / 30."""
    turn = noise.turn_acceleration_rad_s2 if layout.has_rates else noise.turn_rate_rad_s
    joint = noise.joint_acceleration_rad_s2 if layout.has_rates else noise.joint_rate_rad_s
    linear, square, cubic = (np.zeros((layout.moving.stop, layout.moving.stop)) for _ in range(3))

    def drive(value: slice, rate: slice, sd: float, moves_value: bool) -> None:
        density = sd**2 * REFERENCE_DT_S
        v, r = np.arange(value.start, value.stop), np.arange(rate.start, rate.stop)
        linear[r, r] = density
        if moves_value:
            square[v, r] = square[r, v] = 0.5 * density
            cubic[v, v] = 0.25 * density

    drive(layout.position, layout.velocity, noise.acceleration_m_s2, layout.has_rates)
    if layout.has_rates:
        drive(layout.turn, layout.rate, turn, True)
        drive(layout.joints, layout.joint_rates, joint, True)
    else:
        drive(layout.turn, layout.turn, turn, False)
        drive(layout.joints, layout.joints, joint, False)
    return np.stack((linear, square, cubic)).reshape(3, -1)


def _driven(noise: MotionNoise, on_the_way: FloatArray, dt_s: float, layout: StateLayout) -> FloatArray:
    size = layout.moving.stop
    q = (np.array((dt_s, dt_s**2, dt_s**3)) @ _process_terms(noise, layout)).reshape(size, size)
    if layout.has_rates:
        # Turning is pushed about the axes on the way, not about those at the end: Jr, as in the transition. Its noise
        # is the same about all of them.
        turn, with_rate = q.item(6, 6), q.item(6, 9)
        q[6:9, 6:9] = turn * (on_the_way @ on_the_way.T)
        q[6:9, 9:12] = across = with_rate * on_the_way
        q[9:12, 6:9] = across.T
    return q


def carried(covariance: FloatArray, step: Stride, layout: StateLayout, scale2: FloatArray | None = None) -> FloatArray:
    """F P F' + Q (..., n, n) of covariances (..., n, n), Q multiplied by ``scale2`` (...) if there is one.

    The shape stays: in its rows and columns F is the identity.
    """
    f, moving = step.forward, layout.moving
    out = covariance.copy()
    out[..., moving, :] = f @ out[..., moving, :]
    out[..., moving] = out[..., moving] @ f.T
    out[..., moving, moving] += step.noise if scale2 is None else scale2[..., None, None] * step.noise
    return out


def predict(belief: Belief, noise: MotionNoise, dt_s: float, layout: StateLayout) -> Belief:
    """Linear prediction: exact mean, P <- F P F' + Q."""
    step = stride(belief, noise, dt_s, layout)
    return replace(coasted(belief, step, dt_s, layout), covariance=carried(belief.covariance, step, layout))

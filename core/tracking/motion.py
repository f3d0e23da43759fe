"""How the hand may move between two frames: eq. (1) and (5) of the wrist paper and the constant-rate model.

Noise is given as the papers' standard deviation per sample at 30 pictures a second and used as a
continuous density q = sd^2 / 30, so that other or missing frame times keep their meaning (reference 4.5).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

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


def transition(belief: Belief, dt_s: float, layout: StateLayout) -> FloatArray:
    """F (..., n, n): how a small error travels over ``dt_s``; exact but for the turn, there first order."""
    lead = belief.position_m.shape[:-1]
    n = layout.size
    f = np.zeros((*lead, n, n))
    f[..., np.arange(n), np.arange(n)] = 1.0
    f[..., [0, 1, 2], [3, 4, 5]] = dt_s
    if layout.has_rates:
        turn = belief.rate_rad_s * dt_s
        f[..., 6:9, 6:9] = np.swapaxes(so3.exp(turn), -1, -2)
        f[..., 6:9, 9:12] = so3.right_jacobian(turn) * dt_s
        j = np.arange(layout.joint_count)
        f[..., layout.joints.start + j, layout.joint_rates.start + j] = dt_s
    return f


def process_covariance(noise: MotionNoise, dt_s: float, layout: StateLayout) -> FloatArray:
    """Q (..., n, n) = G diag(sd^2) G', G the derivative of :func:`advance` by its noise inputs."""
    sd = noise.per_step(layout, dt_s)
    n, half = layout.size, 0.5 * dt_s * dt_s
    g = np.zeros((n, sd.size))
    axes, joints = np.arange(3), np.arange(layout.joint_count)
    g[3 + axes, axes] = dt_s
    if layout.has_rates:
        g[axes, axes] = half
        g[6 + axes, 3 + axes] = half
        g[9 + axes, 3 + axes] = dt_s
        g[layout.joints.start + joints, 6 + joints] = half
        g[layout.joint_rates.start + joints, 6 + joints] = dt_s
    else:
        g[6 + axes, 3 + axes] = dt_s
        g[layout.joints.start + joints, 6 + joints] = dt_s
    scaled = g * sd
    return np.asarray(scaled @ scaled.T)


def predict(
    belief: Belief, noise: MotionNoise, dt_s: float, layout: StateLayout, scales: FloatArray | None = None
) -> Belief:
    """Linear prediction: exact mean, P <- F P F' + Q; ``scales`` (K,) multiplies the sds per alternative."""
    f = transition(belief, dt_s, layout)
    q = process_covariance(noise, dt_s, layout)
    if scales is not None:
        q = q * (scales**2)[:, None, None]
    covariance = f @ belief.covariance @ np.swapaxes(f, -1, -2) + q
    still = np.zeros(6 + layout.joint_count)
    return replace(advance(belief, still, dt_s, layout), covariance=covariance)

"""The papers' state and how it moves: x = (T, v, psi, theta, phi, theta_1..J) and (1) of both papers."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core import so3
from carpus.core.papers.augmented_filter import Gaussian, Motion
from carpus.core.papers.euler import euler_near, rotation_of
from carpus.core.papers.settings import PaperSettings
from carpus.core.types import FloatArray

POSITION, VELOCITY, EULER, JOINTS = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, None)
PALM_STATES, PALM_NOISES = 9, 6
_SAMPLE_S = 1.0 / 30.0
"""The papers' dt. Other steps keep the density of the noise, so that a missing picture counts as the time it is."""


@dataclass(frozen=True, slots=True)
class PaperMotion:
    """(1) for a hand with ``joint_count`` joint angles; noises are drawn with unit variance and scaled here."""

    settings: PaperSettings
    joint_count: int

    @property
    def noise_covariance(self) -> FloatArray:
        """(6 + J, 6 + J): eta_v, eta_omega and eta_theta in units of their standard deviations."""
        return np.eye(PALM_NOISES + self.joint_count)

    def at_neutral(self) -> Gaussian:
        """At rest at the pose that was clicked."""
        s, joints = self.settings, self.joint_count
        sd = [s.position_start_m] * 3 + [s.velocity_start_m_s] * 3 + [s.angle_start_rad] * 3
        sd += [s.joint_start_rad] * joints
        return Gaussian(np.zeros(PALM_STATES + joints), np.diag(np.square(sd)))

    def over(self, dt_s: float) -> Motion:
        """(1) over ``dt_s``, for many states (P, n) and noises (P, k) at once."""
        s = self.settings
        by_noise = math.sqrt(_SAMPLE_S * dt_s)  # eta dt, eta of variance sd^2 dt_0 / dt

        def moved(state: FloatArray, noise: FloatArray) -> FloatArray:
            pushed = noise * by_noise
            out = state.copy()
            out[:, POSITION] += state[:, VELOCITY] * dt_s
            out[:, VELOCITY] += s.acceleration_m_s2 * pushed[:, 0:3]
            turned = rotation_of(state[:, EULER]) @ so3.exp(s.turn_rate_rad_s * pushed[:, 3:6])
            out[:, EULER] = euler_near(turned, state[:, EULER])
            out[:, JOINTS] += s.joint_rate_rad_s * pushed[:, 6:]
            return out

        return moved

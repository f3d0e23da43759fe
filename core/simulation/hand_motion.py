"""Posture of wrist, fingers and arm as a function of time: strokes, slow sway and tremor."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.simulation.strokes import StrokePath, minimum_jerk
from core.types import FloatArray

STILL_S = 0.8
"""Length of the still neutral pose at the start."""

_SWAY_WRIST_RAD = np.radians([1.0, 1.5, 1.5])
_SWAY_CARRY_M = 0.0008
_SWAY_JOINT_RAD = math.radians(0.7)


@dataclass(frozen=True, slots=True)
class HandMotion:
    """Posture as a function of time; angles and metres are continuous in position, velocity and acceleration.

    ``wrist`` (3) clinical angles, ``joints`` (J), ``carry`` (3) displacement of the whole arm in W0, metres.
    """

    joint_names: tuple[str, ...]
    wrist: StrokePath
    joints: StrokePath
    carry: StrokePath
    sway: Sway
    tremor_rad: float
    tremor_hz: float
    tremor_axis: FloatArray

    def wrist_angles_rad(self, time_s: FloatArray) -> FloatArray:
        """Deviation, flexion, pro/supination, (N, 3)."""
        ramp = _ramp(time_s)
        tremor = self.tremor_rad * np.sin(2.0 * math.pi * self.tremor_hz * (time_s - STILL_S)) * ramp
        sway = self.sway.wrist_rad(time_s) * ramp[:, None]
        return np.asarray(self.wrist.at(time_s) + sway + tremor[:, None] * self.tremor_axis)

    def joint_angles_rad(self, time_s: FloatArray) -> FloatArray:
        """Finger joint angles, (N, J)."""
        ramp = _ramp(time_s)[:, None]
        tremor = 0.5 * self.tremor_rad * np.sin(2.0 * math.pi * self.tremor_hz * (time_s[:, None] - STILL_S) + 1.0)
        flexing = np.array([name.startswith(("MCP", "IP1")) and name.endswith("flexion") for name in self.joint_names])
        return np.asarray(self.joints.at(time_s) + ramp * (self.sway.joint_rad(time_s) + tremor * flexing))

    def carry_m(self, time_s: FloatArray) -> FloatArray:
        """Displacement of the arm in W0, (N, 3)."""
        return np.asarray(self.carry.at(time_s) + self.sway.carry_m(time_s) * _ramp(time_s)[:, None])


@dataclass(frozen=True, slots=True)
class Sway:
    """Slow unwanted movement: three sines per channel, ``rate_rad_s``, ``phase_rad`` and ``amount`` all (C, 3)."""

    rate_rad_s: FloatArray
    phase_rad: FloatArray
    amount: FloatArray

    def _at(self, time_s: FloatArray) -> FloatArray:
        waves = np.sin(self.rate_rad_s * time_s[:, None, None] + self.phase_rad)
        return np.asarray((self.amount * waves).sum(axis=-1))

    def wrist_rad(self, time_s: FloatArray) -> FloatArray:
        return self._at(time_s)[:, :3]

    def carry_m(self, time_s: FloatArray) -> FloatArray:
        return self._at(time_s)[:, 3:6]

    def joint_rad(self, time_s: FloatArray) -> FloatArray:
        return self._at(time_s)[:, 6:]


def _ramp(time_s: FloatArray) -> FloatArray:
    """0 during the still start, 1 from half a second after it."""
    return minimum_jerk((time_s - STILL_S) / 0.5)


def drawn_sway(rng: np.random.Generator, joint_count: int) -> Sway:
    """A person's unrest: about a degree in each angle, under a millimetre in place."""
    shape = (6 + joint_count, 3)
    amount = np.concatenate((_SWAY_WRIST_RAD, np.full(3, _SWAY_CARRY_M), np.full(joint_count, _SWAY_JOINT_RAD)))
    return Sway(
        rate_rad_s=2.0 * math.pi * rng.uniform(0.08, 0.4, shape),
        phase_rad=rng.uniform(0.0, 2.0 * math.pi, shape),
        amount=amount[:, None] * rng.dirichlet(np.ones(3), shape[0]),
    )

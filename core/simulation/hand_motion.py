"""Posture of wrist, fingers and arm as a function of time: minimum-jerk strokes from one posture to the next, slow sway
and tremor."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.types import FloatArray


def minimum_jerk(share: FloatArray) -> FloatArray:
    """Share of the way covered after a share of the time, both 0 to 1 (Flash and Hogan 1985).

    >>> float(minimum_jerk(np.array(0.5)))
    0.5
    """
    s = np.clip(share, 0.0, 1.0)
    return np.asarray(s * s * s * (10.0 + s * (6.0 * s - 15.0)))


@dataclass(frozen=True, slots=True)
class StrokePath:
    """Postures ``value`` (K, C) reached at ``time_s`` (K,), strictly rising, joined by minimum-jerk strokes.

    Two equal postures in a row are a hold; before the first and after the last the posture stays.
    """

    time_s: FloatArray
    value: FloatArray

    def at(self, time_s: FloatArray) -> FloatArray:
        """Posture (N, C) at times (N,)."""
        if len(self.time_s) == 1:
            return np.repeat(self.value, len(time_s), axis=0)
        k = np.clip(np.searchsorted(self.time_s, time_s, side="right") - 1, 0, len(self.time_s) - 2)
        share = (time_s - self.time_s[k]) / (self.time_s[k + 1] - self.time_s[k])
        return np.asarray(self.value[k] + minimum_jerk(share)[:, None] * (self.value[k + 1] - self.value[k]))


class StrokeWriter:
    """Builds a :class:`StrokePath` stroke by stroke from a starting posture (C,)."""

    def __init__(self, start: FloatArray, still_s: float) -> None:
        self._time_s = [0.0, still_s]
        self._value = [start, start]

    @property
    def time_s(self) -> float:
        return self._time_s[-1]

    @property
    def posture(self) -> FloatArray:
        return self._value[-1]

    def move(self, target: FloatArray, duration_s: float) -> None:
        self._time_s.append(self.time_s + max(duration_s, 1e-3))
        self._value.append(np.asarray(target, dtype=np.float64))

    def hold(self, duration_s: float) -> None:
        if duration_s > 0.0:
            self.move(self.posture, duration_s)

    def path(self) -> StrokePath:
        return StrokePath(np.array(self._time_s), np.array(self._value))


STILL_S = 0.8
"""Length of the still neutral pose at the start."""

_SWAY_WRIST_RAD = np.radians([1.0, 1.5, 1.5])
_SWAY_CARRY_M = 0.0008
_SWAY_JOINT_RAD = math.radians(0.7)
_TENODESIS_BEND_RAD = math.radians(5.0)
_CLOSING = {"MCP": 1.0, "PIP": 1.0, "DIP": 2.0 / 3.0, "MCP1_flexion": 0.3, "IP1_flexion": 0.4}
_TENODESIS = (0.75, 1.0)
_ROLLING = np.concatenate((np.radians([0.8, 1.2, 4.0]), np.full(3, 0.002)))
_RESTLESS = np.concatenate((np.radians([0.8, 1.0, 1.0]), np.full(3, 0.0012)))
_RESTLESS_JOINT_RAD = math.radians(2.0)


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
    habits: Habits

    def wrist_angles_rad(self, time_s: FloatArray) -> FloatArray:
        """Deviation, flexion, pro/supination, (N, 3)."""
        ramp = _ramp(time_s)
        tremor = self.tremor_rad * np.sin(2.0 * math.pi * self.tremor_hz * (time_s - STILL_S)) * ramp
        sway = self.sway.wrist_rad(time_s) * ramp[:, None]
        own = self.wrist.at(time_s) + sway + tremor[:, None] * self.tremor_axis
        return np.asarray(own + self.habits.at(time_s, ramp)[:, :3])

    def joint_angles_rad(self, time_s: FloatArray) -> FloatArray:
        ramp = _ramp(time_s)[:, None]
        tremor = 0.5 * self.tremor_rad * np.sin(2.0 * math.pi * self.tremor_hz * (time_s[:, None] - STILL_S) + 1.0)
        flexing = np.array([name.startswith(("MCP", "IP1")) and name.endswith("flexion") for name in self.joint_names])
        own = self.joints.at(time_s) + ramp * (self.sway.joint_rad(time_s) + tremor * flexing)
        unrest = self.habits.at(time_s, ramp[:, 0])[:, 6:]
        if self.habits.tenodesis == 0.0:
            return np.asarray(own + unrest)
        extension = -self.wrist_angles_rad(time_s)[:, 1]
        return np.asarray(own + unrest + self.habits.closing_rad(extension)[:, None] * _closing(self.joint_names))

    def carry_m(self, time_s: FloatArray) -> FloatArray:
        ramp = _ramp(time_s)
        own = self.carry.at(time_s) + self.sway.carry_m(time_s) * ramp[:, None]
        return np.asarray(own + self.habits.at(time_s, ramp)[:, 3:6])


@dataclass(frozen=True, slots=True)
class Sway:
    """Slow unwanted movement: three sines per channel, ``rate_rad_s``, ``phase_rad`` and ``amount`` all (C, 3)."""

    rate_rad_s: FloatArray
    phase_rad: FloatArray
    amount: FloatArray

    def at(self, time_s: FloatArray) -> FloatArray:
        """All channels, (N, C): three of the wrist, three of the arm's place, the joints."""
        waves = np.sin(self.rate_rad_s * time_s[:, None, None] + self.phase_rad)
        return np.asarray((self.amount * waves).sum(axis=-1))

    def wrist_rad(self, time_s: FloatArray) -> FloatArray:
        return self.at(time_s)[:, :3]

    def carry_m(self, time_s: FloatArray) -> FloatArray:
        return self.at(time_s)[:, 3:6]

    def joint_rad(self, time_s: FloatArray) -> FloatArray:
        return self.at(time_s)[:, 6:]


@dataclass(frozen=True, slots=True)
class Habits:
    """What the hand does besides the exercise: fingers close by ``tenodesis`` of the wrist's extension; ``moving`` is
    further unrest once the exercise runs, ``always`` from the first frame on, counted from there."""

    tenodesis: float
    moving: Sway
    always: Sway

    def at(self, time_s: FloatArray, ramp: FloatArray) -> FloatArray:
        """Channels (N, C) as of :class:`Sway`, for the ramp (N,) of the exercise."""
        begun = self.always.at(np.zeros(1))
        return np.asarray(self.moving.at(time_s) * ramp[:, None] + self.always.at(time_s) - begun)

    def closing_rad(self, extension_rad: FloatArray) -> FloatArray:
        """Flexion (N,) of knuckles and middle joints: they close with extension, and open a third as far with
        flexion."""
        bend = np.sqrt(extension_rad**2 + _TENODESIS_BEND_RAD**2) - _TENODESIS_BEND_RAD
        return np.asarray(self.tenodesis * (2.0 * extension_rad + bend) / 3.0)


def _closing(names: tuple[str, ...]) -> FloatArray:
    """Share (J,) of each joint in the fingers' closing by themselves."""
    return np.array(
        [_CLOSING.get(name, _CLOSING.get(name[:3], 0.0) if name.endswith("flexion") else 0.0) for name in names]
    )


def _ramp(time_s: FloatArray) -> FloatArray:
    """0 during the still start, 1 from half a second after it."""
    return minimum_jerk((time_s - STILL_S) / 0.5)


def drawn_sway(rng: np.random.Generator, joint_count: int) -> Sway:
    """A person's unrest: about a degree in each angle, under a millimetre in place."""
    amount = np.concatenate((_SWAY_WRIST_RAD, np.full(3, _SWAY_CARRY_M), np.full(joint_count, _SWAY_JOINT_RAD)))
    return _drawn(rng, amount, (0.08, 0.4))


def drawn_habits(rng: np.random.Generator, habits: tuple[str, ...], joint_count: int) -> Habits:
    """How far one person's habits go; those that are not named are drawn, too, and left out."""
    tenodesis = float(rng.uniform(*_TENODESIS))
    rolling = _drawn(rng, np.concatenate((_ROLLING, np.zeros(joint_count))), (0.15, 0.5))
    restless = _drawn(rng, np.concatenate((_RESTLESS, np.full(joint_count, _RESTLESS_JOINT_RAD))), (0.2, 0.7))
    return Habits(
        tenodesis if "tenodesis" in habits else 0.0,
        rolling if "rolling_forearm" in habits else replace(rolling, amount=0.0 * rolling.amount),
        restless if "restless_clicks" in habits else replace(restless, amount=0.0 * restless.amount),
    )


def _drawn(rng: np.random.Generator, amount: FloatArray, rate_hz: tuple[float, float]) -> Sway:
    shape = (len(amount), 3)
    return Sway(
        rate_rad_s=2.0 * math.pi * rng.uniform(*rate_hz, shape),
        phase_rad=rng.uniform(0.0, 2.0 * math.pi, shape),
        amount=amount[:, None] * rng.dirichlet(np.ones(3), shape[0]),
    )

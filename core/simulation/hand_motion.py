"""Posture of hand and arm over time: minimum-jerk strokes, sway, tremor, soft tissue.

Soft tissue is skin that glides over joints, ring and little metacarpals that flex, and knuckles that rise (clinical
reference 10). Capitate and metacarpals 2 and 3 are the fixed unit with W. All movement counts from the posture of the
first frame, where the hand is as if it were rigid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.model.hand.kinematics import finger_angles
from carpus.core.model.hand.protocols import SITES
from carpus.core.model.types import FloatArray
from carpus.core.simulation.spec import RandomStream, RecordingSpec


def minimum_jerk(share: FloatArray) -> FloatArray:
    """Return the share of the way after a share of the time, 0 to 1 (Flash and Hogan 1985).

    >>> float(minimum_jerk(np.array(0.5)))
    0.5
    """
    s = np.clip(share, 0.0, 1.0)
    return np.asarray(s * s * s * (10.0 + s * (6.0 * s - 15.0)))


@dataclass(frozen=True, slots=True)
class StrokePath:
    """Postures (K, C) reached at increasing times (K,), joined by minimum-jerk strokes.

    Two equal postures in a row are a hold; before the first and after the last the posture stays.
    """

    time_s: FloatArray
    value: FloatArray

    def evaluate(self, time_s: FloatArray) -> FloatArray:
        """Return the posture (N, C) at times (N,)."""
        if len(self.time_s) == 1:
            return np.repeat(self.value, len(time_s), axis=0)
        k = np.clip(np.searchsorted(self.time_s, time_s, side="right") - 1, 0, len(self.time_s) - 2)
        share = (time_s - self.time_s[k]) / (self.time_s[k + 1] - self.time_s[k])
        return np.asarray(self.value[k] + minimum_jerk(share)[:, None] * (self.value[k + 1] - self.value[k]))


class StrokePathBuilder:
    """Builds a :class:`StrokePath` from a starting posture (C,)."""

    def __init__(self, start: FloatArray, still_s: float) -> None:
        self._time_s = [0.0, still_s]
        self._value = [start, start]

    @property
    def time_s(self) -> float:
        return self._time_s[-1]

    @property
    def posture(self) -> FloatArray:
        return self._value[-1]

    def add_stroke(self, target: FloatArray, duration_s: float) -> None:
        self._time_s.append(self.time_s + max(duration_s, 1e-3))
        self._value.append(np.asarray(target, dtype=np.float64))

    def add_hold(self, duration_s: float) -> None:
        if duration_s > 0.0:
            self.add_stroke(self.posture, duration_s)

    def build(self) -> StrokePath:
        return StrokePath(np.array(self._time_s), np.array(self._value))


STILL_S = 0.8
"""Duration of the still neutral pose at the start."""

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
    """Posture over time, with continuous velocity and acceleration.

    ``wrist`` (3) are clinical angles, ``joints`` (J), ``arm`` (3) the displacement of the arm in W0, m.
    """

    joint_names: tuple[str, ...]
    wrist: StrokePath
    joints: StrokePath
    arm: StrokePath
    sway: Sway
    tremor_rad: float
    tremor_hz: float
    tremor_axis: FloatArray
    habits: Habits

    def wrist_angles_rad(self, time_s: FloatArray) -> FloatArray:
        """Return deviation, flexion, pronosupination, (N, 3)."""
        ramp = _exercise_ramp(time_s)
        tremor = self.tremor_rad * np.sin(2.0 * math.pi * self.tremor_hz * (time_s - STILL_S)) * ramp
        sway = self.sway.evaluate(time_s)[:, :3] * ramp[:, None]
        own = self.wrist.evaluate(time_s) + sway + tremor[:, None] * self.tremor_axis
        return np.asarray(own + self.habits.evaluate(time_s, ramp)[:, :3])

    def joint_angles_rad(self, time_s: FloatArray) -> FloatArray:
        """Return the finger joint angles, (N, J)."""
        ramp = _exercise_ramp(time_s)[:, None]
        tremor = 0.5 * self.tremor_rad * np.sin(2.0 * math.pi * self.tremor_hz * (time_s[:, None] - STILL_S) + 1.0)
        flexing = np.array([name.startswith(("MCP", "IP1")) and name.endswith("flexion") for name in self.joint_names])
        own = self.joints.evaluate(time_s) + ramp * (self.sway.evaluate(time_s)[:, 6:] + tremor * flexing)
        unrest = self.habits.evaluate(time_s, ramp[:, 0])[:, 6:]
        if self.habits.tenodesis == 0.0:
            return np.asarray(own + unrest)
        closing_rad = self.habits.closing_rad(-self.wrist_angles_rad(time_s)[:, 1])
        shares = [
            _CLOSING.get(name, _CLOSING.get(name[:3], 0.0) if name.endswith("flexion") else 0.0)
            for name in self.joint_names
        ]
        return np.asarray(own + unrest + closing_rad[:, None] * np.array(shares))

    def arm_displacement_m(self, time_s: FloatArray) -> FloatArray:
        """Return the displacement of the arm in W0, (N, 3)."""
        ramp = _exercise_ramp(time_s)
        own = self.arm.evaluate(time_s) + self.sway.evaluate(time_s)[:, 3:6] * ramp[:, None]
        return np.asarray(own + self.habits.evaluate(time_s, ramp)[:, 3:6])


@dataclass(frozen=True, slots=True)
class Sway:
    """Slow involuntary movement: three sines per channel, all arrays (C, 3)."""

    rate_rad_s: FloatArray
    phase_rad: FloatArray
    amount: FloatArray

    def evaluate(self, time_s: FloatArray) -> FloatArray:
        """Return the channels (N, C): three of the wrist, three of the arm, the joints."""
        waves = np.sin(self.rate_rad_s * time_s[:, None, None] + self.phase_rad)
        return np.asarray((self.amount * waves).sum(axis=-1))


@dataclass(frozen=True, slots=True)
class Habits:
    """Movements besides the exercise: tenodesis, sway during the exercise, sway from the first frame on."""

    tenodesis: float
    exercise_sway: Sway
    constant_sway: Sway

    def evaluate(self, time_s: FloatArray, ramp: FloatArray) -> FloatArray:
        """Return the channels (N, C) of :class:`Sway` for the ramp (N,) of the exercise."""
        start = self.constant_sway.evaluate(np.zeros(1))
        exercise = self.exercise_sway.evaluate(time_s) * ramp[:, None]
        return np.asarray(exercise + self.constant_sway.evaluate(time_s) - start)

    def closing_rad(self, extension_rad: FloatArray) -> FloatArray:
        """Return the flexion (N,) of MCP and PIP: they close with wrist extension, open less with flexion."""
        bend = np.sqrt(extension_rad**2 + _TENODESIS_BEND_RAD**2) - _TENODESIS_BEND_RAD
        return np.asarray(self.tenodesis * (2.0 * extension_rad + bend) / 3.0)


def _exercise_ramp(time_s: FloatArray) -> FloatArray:
    """Return 0 during the still start, 1 from half a second after it."""
    return minimum_jerk((time_s - STILL_S) / 0.5)


def sample_sway(rng: np.random.Generator, joint_count: int) -> Sway:
    """Draw a person's sway: about a degree in each angle, below a millimetre in place."""
    amount = np.concatenate((_SWAY_WRIST_RAD, np.full(3, _SWAY_CARRY_M), np.full(joint_count, _SWAY_JOINT_RAD)))
    return _sample_waves(rng, amount, (0.08, 0.4))


def sample_habits(rng: np.random.Generator, habits: tuple[str, ...], joint_count: int) -> Habits:
    """Draw the extent of one person's habits; those not named are drawn too, and removed."""
    tenodesis = float(rng.uniform(*_TENODESIS))
    rolling = _sample_waves(rng, np.concatenate((_ROLLING, np.zeros(joint_count))), (0.15, 0.5))
    restless = _sample_waves(rng, np.concatenate((_RESTLESS, np.full(joint_count, _RESTLESS_JOINT_RAD))), (0.2, 0.7))
    return Habits(
        tenodesis if "tenodesis" in habits else 0.0,
        rolling if "rolling_forearm" in habits else replace(rolling, amount=0.0 * rolling.amount),
        restless if "restless_clicks" in habits else replace(restless, amount=0.0 * restless.amount),
    )


def _sample_waves(rng: np.random.Generator, amount: FloatArray, rate_hz: tuple[float, float]) -> Sway:
    shape = (len(amount), 3)
    return Sway(
        rate_rad_s=2.0 * math.pi * rng.uniform(*rate_hz, shape),
        phase_rad=rng.uniform(0.0, 2.0 * math.pi, shape),
        amount=amount[:, None] * rng.dirichlet(np.ones(3), shape[0]),
    )


MAX_GLIDE_MM = 8.0
"""Largest glide at the knuckles for 90 degrees of flexion."""
FULL_CUP_RAD = np.radians([12.0, 20.0])
"""Flexion of the ring and little metacarpals in a power grip of a supple hand."""
_GRIP_MCP_RAD, _GRIP_PIP_RAD = math.radians(75.0), math.radians(85.0)
"""Ring and little finger in a power grip."""
_FULL_RISE_RAD = math.radians(75.0)
"""MCP flexion at which a knuckle is fully risen."""

_GAIN_OF_JOINT = {"WRIST": 0.6, "CMC1": 0.6, "MCP1": 0.3, "IP1": 0.2, "MCP": 1.0, "PIP": 0.25, "DIP": 0.15, "TIP": 0.0}
"""Glide per angle as a share of that at the knuckles."""
_LAG_S = (0.06, 0.14)
_PLAY_RAD = (math.radians(2.0), math.radians(6.0))
"""The skin lags the bone by half of this in either direction."""
_STEP_S = 1.0 / 150.0


@dataclass(frozen=True, slots=True)
class TissueState:
    """Soft tissue at N times.

    Attributes
    ----------
    glide_m : (N, 21) of each marker along its finger, distal positive
    cup_rad : (N, 2) flexion of metacarpals 4 and 5
    rise : (N, 4) of knuckles 2 to 5, 0 to 1
    """

    glide_m: FloatArray
    cup_rad: FloatArray
    rise: FloatArray

    @staticmethod
    def rigid(count: int) -> TissueState:
        return TissueState(np.zeros((count, 21)), np.zeros((count, 2)), np.zeros((count, 4)))

    def select(self, i: int) -> TissueState:
        """Return the i-th time without the leading axis."""
        return TissueState(self.glide_m[i], self.cup_rad[i], self.rise[i])


@dataclass(frozen=True, slots=True)
class SimulatedTissue:
    """Soft tissue of one person.

    ``glide_m_rad`` (21,) is per angle of the joint beneath, ``swerve_rad`` (21,) its direction off the finger's,
    ``cup_rad`` (2,) in a full grip.
    """

    glide_m_rad: FloatArray
    swerve_rad: FloatArray
    cup_rad: FloatArray
    knuckle_rise_m: float
    lag_s: float
    play_rad: float

    @property
    def is_rigid(self) -> bool:
        return not (self.glide_m_rad.any() or self.cup_rad.any())


def sample_tissue(spec: RecordingSpec) -> SimulatedTissue:
    """Draw a person's tissue; values of the spec take precedence."""
    rng = spec.generator(RandomStream.TISSUE)
    drawn_mm, drawn_cup = rng.uniform(0.0, MAX_GLIDE_MM), rng.uniform(0.3, 1.0)
    glide_mm = drawn_mm if spec.skin_glide_mm is None else spec.skin_glide_mm
    cupping = drawn_cup if spec.cupping is None else spec.cupping
    share = np.array([_GAIN_OF_JOINT.get(name, _GAIN_OF_JOINT.get(name[:3], 0.0)) for name in SITES])
    return SimulatedTissue(
        glide_m_rad=share * rng.uniform(0.8, 1.2, len(share)) * glide_mm * 1e-3 / (0.5 * math.pi),
        swerve_rad=rng.uniform(-0.25, 0.25, len(share)),
        cup_rad=FULL_CUP_RAD * cupping,
        knuckle_rise_m=rng.uniform(0.0005, 0.0012) if glide_mm > 0.0 or cupping > 0.0 else 0.0,
        lag_s=rng.uniform(*_LAG_S),
        play_rad=rng.uniform(*_PLAY_RAD),
    )


class TissueMovement:
    """Soft tissue of one person during one motion."""

    def __init__(self, tissue: SimulatedTissue, motion: HandMotion, seconds: float) -> None:
        self._tissue = tissue
        if tissue.is_rigid:
            return
        self._time_s = np.arange(0.0, seconds + 0.5, _STEP_S)
        joints = motion.joint_angles_rad(self._time_s)
        beneath = _angles_beneath_rad(motion.wrist_angles_rad(self._time_s), motion.joint_names, joints)
        beneath = beneath - beneath[0]
        skin = apply_lag(apply_play(beneath, tissue.play_rad), tissue.lag_s / _STEP_S)
        self._glide_m = skin * tissue.glide_m_rad

        # how far (N,) ring and little finger close, 0 straight to 1 in a power grip
        def mean(joint: str) -> FloatArray:
            return np.asarray(joints[:, [motion.joint_names.index(f"{joint}{k}_flexion") for k in (4, 5)]].mean(axis=1))

        share = np.clip(0.5 * (mean("MCP") / _GRIP_MCP_RAD + mean("PIP") / _GRIP_PIP_RAD), 0.0, 1.0)
        grip = np.asarray(share**3 * (3.0 - 2.0 * share))
        self._cup_rad = (grip - grip[0])[:, None] * tissue.cup_rad
        knuckles = beneath[:, [SITES.index(f"MCP{k}") for k in (2, 3, 4, 5)]]
        self._rise = np.clip(knuckles / _FULL_RISE_RAD, 0.0, 1.0)

    def evaluate(self, time_s: FloatArray) -> TissueState:
        """Return the state at times (N,)."""
        if self._tissue.is_rigid:
            return TissueState.rigid(len(time_s))

        def interpolate(values: FloatArray) -> FloatArray:
            return np.stack([np.interp(time_s, self._time_s, column) for column in values.T], axis=-1)

        return TissueState(interpolate(self._glide_m), interpolate(self._cup_rad), interpolate(self._rise))


def apply_play(driver: FloatArray, play: float) -> FloatArray:
    """Apply play to a driver (N, C): the output moves only while an end of the gap pushes it."""
    half, out = 0.5 * play, np.empty_like(driver)
    current = out[0] = driver[0]
    for i in range(1, len(driver)):
        current = out[i] = np.clip(current, driver[i] - half, driver[i] + half)
    return out


def apply_lag(driver: FloatArray, steps: float) -> FloatArray:
    """Apply a first-order lag of so many steps to a driver (N, C), starting at rest."""
    share, out = 1.0 / (1.0 + steps), np.empty_like(driver)
    current = out[0] = driver[0]
    for i in range(1, len(driver)):
        current = out[i] = current + share * (driver[i] - current)
    return out


def _angles_beneath_rad(wrist_rad: FloatArray, names: tuple[str, ...], joints_rad: FloatArray) -> FloatArray:
    """Return the angle (N, 21) of the joint under each marker: flexion, of CMC1 palmar abduction."""
    out = np.zeros((len(joints_rad), 21))
    out[:, 0] = wrist_rad[:, 1]
    for marker, joint in (("CMC1", "CMC1_abduction"), ("MCP1", "MCP1_flexion"), ("IP1", "IP1_flexion")):
        out[:, SITES.index(marker)] = joints_rad[:, names.index(joint)]
    out[:, 5:].reshape(-1, 4, 4)[..., :3] = finger_angles(joints_rad)[..., 1:]
    return out

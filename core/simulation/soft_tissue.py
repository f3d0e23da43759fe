"""What of a hand is not rigid: skin that glides over joints, ring and little metacarpals that flex, rising knuckles.

Clinical reference 10. The fixed unit is capitate, second and third metacarpal: W stays with it. All movement counts
from the posture of the first frame, where the hand is as if it were rigid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.kinematics import finger_angles
from carpus.core.hand.sites import SITES
from carpus.core.simulation.hand_motion import HandMotion
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.types import FloatArray

MOST_GLIDE_MM = 8.0
"""Largest glide drawn at the knuckles, for 90 degrees of flexion."""
FULL_CUP_RAD = np.radians([12.0, 20.0])
"""Flexion of the ring and little metacarpal in the power grip of a supple hand."""
_GRIP_MCP_RAD, _GRIP_PIP_RAD = math.radians(75.0), math.radians(85.0)
"""Ring and little finger in a power grip."""
_FULL_RISE_RAD = math.radians(75.0)
"""A knuckle has risen as far as it does."""

_GAIN_OF_JOINT = {"WRIST": 0.6, "CMC1": 0.6, "MCP1": 0.3, "IP1": 0.2, "MCP": 1.0, "PIP": 0.25, "DIP": 0.15, "TIP": 0.0}
"""Glide per angle as a share of that at the knuckles."""
_LAG_S = (0.06, 0.14)
_PLAY_RAD = (math.radians(2.0), math.radians(6.0))
"""The skin stays behind the bone by half of this on the way there, and by half of it on the way back."""
_STEP_S = 1.0 / 150.0


@dataclass(frozen=True, slots=True)
class TissueState:
    """At N times: ``glide_m`` (N, 21) of each disc along its finger, distal positive; ``cup_rad`` (N, 2) flexion of
    metacarpals 4 and 5; ``rise`` (N, 4) of the knuckles 2 to 5, 0 to 1 of the person's full rise."""

    glide_m: FloatArray
    cup_rad: FloatArray
    rise: FloatArray

    @staticmethod
    def rigid(count: int) -> TissueState:
        return TissueState(np.zeros((count, 21)), np.zeros((count, 2)), np.zeros((count, 4)))

    def only(self, i: int) -> TissueState:
        """The i-th time alone, without the leading axis."""
        return TissueState(self.glide_m[i], self.cup_rad[i], self.rise[i])


@dataclass(frozen=True, slots=True)
class SimulatedTissue:
    """One person: ``glide_m_rad`` (21,) per angle of the joint beneath; ``swerve_rad`` (21,) of that glide off the
    finger's direction; ``cup_rad`` (2,) in a full grip; ``knuckle_rise_m``; ``lag_s``; ``play_rad``."""

    glide_m_rad: FloatArray
    swerve_rad: FloatArray
    cup_rad: FloatArray
    knuckle_rise_m: float
    lag_s: float
    play_rad: float

    @property
    def is_rigid(self) -> bool:
        return not (self.glide_m_rad.any() or self.cup_rad.any())


def tissue_of(spec: RecordingSpec) -> SimulatedTissue:
    """Draw a person's tissue; what the spec gives is taken instead."""
    rng = spec.random(RandomStream.TISSUE)
    drawn_mm, drawn_cup = rng.uniform(0.0, MOST_GLIDE_MM), rng.uniform(0.3, 1.0)
    glide_mm = drawn_mm if spec.skin_glide_mm is None else spec.skin_glide_mm
    cupping = drawn_cup if spec.cupping is None else spec.cupping
    share = np.array([_GAIN_OF_JOINT.get(name, _GAIN_OF_JOINT.get(name[:3], 0.0)) for name in SITES])
    gain = share * rng.uniform(0.8, 1.2, len(share)) * glide_mm * 1e-3 / (0.5 * math.pi)
    swerve = rng.uniform(-0.25, 0.25, len(share))
    return SimulatedTissue(
        glide_m_rad=gain,
        swerve_rad=swerve,
        cup_rad=FULL_CUP_RAD * cupping,
        knuckle_rise_m=rng.uniform(0.0005, 0.0012) if glide_mm > 0.0 or cupping > 0.0 else 0.0,
        lag_s=rng.uniform(*_LAG_S),
        play_rad=rng.uniform(*_PLAY_RAD),
    )


class TissueMovement:
    """How the soft parts of one person follow one motion."""

    def __init__(self, tissue: SimulatedTissue, motion: HandMotion, seconds: float) -> None:
        self._tissue = tissue
        if tissue.is_rigid:
            return
        self._time_s = np.arange(0.0, seconds + 0.5, _STEP_S)
        joints = motion.joint_angles_rad(self._time_s)
        beneath = _angles_beneath_rad(motion.wrist_angles_rad(self._time_s), motion.joint_names, joints)
        beneath = beneath - beneath[0]
        skin = lagged(with_play(beneath, tissue.play_rad), tissue.lag_s / _STEP_S)
        self._glide_m = skin * tissue.glide_m_rad
        grip = _grip(motion.joint_names, joints)
        self._cup_rad = (grip - grip[0])[:, None] * tissue.cup_rad
        knuckles = beneath[:, [SITES.index(f"MCP{k}") for k in (2, 3, 4, 5)]]
        self._rise = np.clip(knuckles / _FULL_RISE_RAD, 0.0, 1.0)

    def at(self, time_s: FloatArray) -> TissueState:
        """State at times (N,); before the first frame it is that of the first frame."""
        if self._tissue.is_rigid:
            return TissueState.rigid(len(time_s))
        return TissueState(*(self._between(values, time_s) for values in (self._glide_m, self._cup_rad, self._rise)))

    def _between(self, values: FloatArray, time_s: FloatArray) -> FloatArray:
        return np.stack([np.interp(time_s, self._time_s, column) for column in values.T], axis=-1)


def with_play(driver: FloatArray, play: float) -> FloatArray:
    """What follows a driver (N, C) with play: it moves only while pushed by one end of a gap of that width."""
    half, out = 0.5 * play, np.empty_like(driver)
    now = out[0] = driver[0]
    for i in range(1, len(driver)):
        now = out[i] = np.clip(now, driver[i] - half, driver[i] + half)
    return out


def lagged(driver: FloatArray, steps: float) -> FloatArray:
    """First-order lag of a driver (N, C) by so many steps, starting at rest."""
    share, out = 1.0 / (1.0 + steps), np.empty_like(driver)
    now = out[0] = driver[0]
    for i in range(1, len(driver)):
        now = out[i] = now + share * (driver[i] - now)
    return out


def _angles_beneath_rad(wrist_rad: FloatArray, names: tuple[str, ...], joints_rad: FloatArray) -> FloatArray:
    """Angle (N, 21) of the joint over which each disc lies: flexion, of CMC1 palmar abduction."""
    out = np.zeros((len(joints_rad), 21))
    out[:, 0] = wrist_rad[:, 1]
    for disc, joint in (("CMC1", "CMC1_abduction"), ("MCP1", "MCP1_flexion"), ("IP1", "IP1_flexion")):
        out[:, SITES.index(disc)] = joints_rad[:, names.index(joint)]
    out[:, 5:].reshape(-1, 4, 4)[..., :3] = finger_angles(joints_rad)[..., 1:]
    return out


def _grip(names: tuple[str, ...], joints_rad: FloatArray) -> FloatArray:
    """How far (N,) ring and little finger close: 0 straight to 1 in a power grip, where the palm is fully cupped."""

    def mean(joint: str) -> FloatArray:
        return np.asarray(joints_rad[:, [names.index(f"{joint}{k}_flexion") for k in (4, 5)]].mean(axis=1))

    share = np.clip(0.5 * (mean("MCP") / _GRIP_MCP_RAD + mean("PIP") / _GRIP_PIP_RAD), 0.0, 1.0)
    return np.asarray(share**3 * (3.0 - 2.0 * share))

"""The skeleton: where each bone is for given angles, by turning one bone after the other.

Angles of the fingers (N, 21): the thumb's five, then abduction, MCP, PIP and DIP flexion of fingers 2 to 5, in the
conventions of reference 3.2: zero is the straight chain in the axes of W, abduction counts from the person's own fan.
Bones of ring and little finger are carried by their metacarpals.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from carpus.core.model.types import FloatArray
from tests.second_patient.person import Person


class Bone(IntEnum):
    """Forearm near the elbow and near the wrist, the fixed unit (capitate, metacarpals 2 and 3), and all others."""

    ELBOW = 0
    FOREARM = 1
    FIXED = 2
    MC4 = 3
    MC5 = 4
    MC1 = 5
    PP1 = 6
    DP1 = 7
    PP2 = 8
    PP3 = 11
    PP4 = 14
    PP5 = 17


BONES = 20
_ARM_END_M = 0.070
_CUP_ROLL = 0.45
"""A metacarpal that flexes turns its palm side to the thumb, by this share."""


@dataclass(frozen=True, slots=True)
class Posture:
    """N moments of one right hand in the room, radians and metres.

    ``wrist`` (N, 3) deviation, flexion, pro-supination of the fixed unit; ``place_m`` (N, 3) of the capitate;
    ``fingers`` (N, 21); ``cup`` (N,) 0 flat to 1 full grip; ``arm_roll`` (N,) of the whole forearm.
    """

    wrist: FloatArray
    place_m: FloatArray
    fingers: FloatArray
    cup: FloatArray
    arm_roll: FloatArray

    def __len__(self) -> int:
        return len(self.wrist)


@dataclass(frozen=True, slots=True)
class Placed:
    """Bones in the room: ``turn`` (N, 20, 3, 3), columns along, across and out of the back of each bone, and
    ``joint_m`` (N, 20, 3) its proximal joint."""

    turn: FloatArray
    joint_m: FloatArray


def about_x(angle: FloatArray | float) -> FloatArray:
    """Turn about the first axis, (..., 3, 3)."""
    c, s, o, i = _parts(angle)
    return np.stack((i, o, o, o, c, -s, o, s, c), axis=-1).reshape(*c.shape, 3, 3)


def about_y(angle: FloatArray | float) -> FloatArray:
    """Turn about the second axis, (..., 3, 3)."""
    c, s, o, i = _parts(angle)
    return np.stack((c, o, s, o, i, o, -s, o, c), axis=-1).reshape(*c.shape, 3, 3)


def about_z(angle: FloatArray | float) -> FloatArray:
    """Turn about the third axis, (..., 3, 3)."""
    c, s, o, i = _parts(angle)
    return np.stack((c, -s, o, s, c, o, o, o, i), axis=-1).reshape(*c.shape, 3, 3)


def _parts(angle: FloatArray | float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    c, s = np.cos(np.asarray(angle, dtype=np.float64)), np.sin(np.asarray(angle, dtype=np.float64))
    return c, s, np.zeros_like(c), np.ones_like(c)


def place_bones(person: Person, posture: Posture, chain_axes: FloatArray) -> Placed:
    """All bones; ``chain_axes`` (3, 3) are the axes of W in B, in which the fingers' chains count."""
    count = len(posture)
    turn, joint = np.empty((count, BONES, 3, 3)), np.empty((count, BONES, 3))
    hand = about_z(posture.wrist[:, 0]) @ about_y(posture.wrist[:, 1]) @ about_x(posture.wrist[:, 2])
    place = posture.place_m
    turn[:, Bone.FIXED], joint[:, Bone.FIXED] = hand, place
    # The radius turns with the hand, the elbow hardly.
    for bone, share, along in ((Bone.FOREARM, 0.85, 0.0), (Bone.ELBOW, 0.35, -_ARM_END_M)):
        roll = about_x(share * posture.wrist[:, 2] + posture.arm_roll)
        turn[:, bone], joint[:, bone] = roll, place + along * roll[..., 0]

    own = np.broadcast_to(np.eye(3), (count, 3, 3))
    carrier = {1: (own, np.zeros(3)), 2: (own, np.zeros(3))}
    for ray, bone, most in ((3, Bone.MC4, person.cup_rad[0]), (4, Bone.MC5, person.cup_rad[1])):
        down = posture.cup * most
        cupped = about_y(down) @ about_x(_CUP_ROLL * down)
        base = person.base_m[ray]
        shift = base - cupped @ base
        carrier[ray] = (cupped, shift)
        turn[:, bone], joint[:, bone] = hand @ cupped, place + hand @ base

    q = posture.fingers
    thumb = hand @ chain_axes @ about_z(person.fan_rad[0] + q[:, 0]) @ about_y(q[:, 1]) @ about_x(-person.roll_rad)
    start = place + hand @ person.base_m[0]
    for bone, bend in ((Bone.MC1, None), (Bone.PP1, about_y(q[:, 2]) @ about_z(q[:, 3])), (Bone.DP1, about_y(q[:, 4]))):
        thumb = thumb if bend is None else thumb @ bend
        turn[:, bone], joint[:, bone] = thumb, start
        start = start + person.thumb_m[bone - Bone.MC1] * thumb[..., 0]

    for ray in (1, 2, 3, 4):
        first = Bone.PP2 + 3 * (ray - 1)
        mine = q[:, 5 + 4 * (ray - 1) : 9 + 4 * (ray - 1)]
        by, shift = carrier[ray]
        start = place + np.einsum("nij,nj->ni", hand, by @ person.knuckle_m[ray - 1] + shift)
        finger = hand @ by @ chain_axes @ about_z(person.fan_rad[ray] + mine[:, 0])
        for i in range(3):
            finger = finger @ about_y(mine[:, 1 + i])
            turn[:, first + i], joint[:, first + i] = finger, start
            start = start + person.finger_m[ray - 1, i] * finger[..., 0]
    return Placed(turn, joint)


def bone_length_m(person: Person) -> FloatArray:
    """Length (20,) of each bone; of the fixed unit that of its third metacarpal's end from the capitate."""
    out = np.empty(BONES)
    out[Bone.ELBOW], out[Bone.FOREARM] = 0.17, _ARM_END_M
    out[Bone.FIXED] = float(np.linalg.norm(person.knuckle_m[1]))
    for bone, ray in ((Bone.MC4, 3), (Bone.MC5, 4)):
        out[bone] = float(np.linalg.norm(person.knuckle_m[ray - 1] - person.base_m[ray]))
    out[Bone.MC1 : Bone.MC1 + 3] = person.thumb_m
    out[Bone.PP2 :] = person.finger_m.ravel()
    return out


REST_DEG = np.array([18.0, 22.0, 0.0, 0.0, 0.0, 6.0, 0, 0, 0, 0.0, 0, 0, 0, -5.0, 0, 0, 0, -11.0, 0, 0, 0])
"""Fingers spread and straight: the posture in which the skin is made."""


def rest_posture() -> Posture:
    """The one in which the skin is made, in B."""
    return Posture(np.zeros((1, 3)), np.zeros((1, 3)), np.radians(REST_DEG)[None], np.zeros(1), np.zeros(1))

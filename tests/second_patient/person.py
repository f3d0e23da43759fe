"""Who is simulated, and the skeleton: where each bone is for given angles, by turning one bone after the other.

Bone frame B of a RIGHT hand: origin in the head of the capitate, about which the wrist turns; x distal, y to the
thumb, z out of the back of the hand. Rays are counted 0 thumb, 1 index to 4 little finger. Angles of the fingers
(N, 21): the thumb's five, then abduction, MCP, PIP and DIP flexion of fingers 2 to 5, in the conventions of reference
3.2: zero is the straight chain in the axes of W, abduction counts from the person's own fan. Bones of ring and little
finger are carried by their metacarpals.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from carpus.core.model.types import FloatArray

# Buryanov & Kotiuk 2010 by reference 3.3: metacarpal, proximal, middle, distal phalanx with the soft tip; mm.
_THUMB_MM = (46.2, 31.6, 21.7 + 5.7)
_FINGER_MM = (
    (68.1, 39.8, 22.4, 15.8 + 3.8),
    (64.6, 44.6, 26.3, 17.4 + 4.0),
    (58.0, 41.4, 25.7, 17.3 + 4.0),
    (53.7, 32.7, 18.1, 16.0 + 3.7),
)
_WHOLE_MM = 25.0 + sum(_FINGER_MM[1])  # with the carpus
_BASE_MM = np.array([[4.0, 21.0, -10.0], [17.0, 11.0, -1.0], [19.0, 1.0, 0.0], [17.0, -8.0, -2.0], [13.0, -16.0, -5.0]])
"""CMC joints 1 to 5 of a hand of that size."""
_RAY_DEG, _RAY_DOWN_DEG = np.array([7.5, 0.0, -7.0, -14.0]), np.array([0.5, 0.0, 1.5, 4.0])
"""Directions of metacarpals 2 to 5: to the thumb, and down along the arch of the flat hand."""
_FAN_DEG, _ROLL_DEG, _BONE_SD = np.array([30.0, 5.0, 0.0, -5.0, -10.0]), 48.0, 0.05
# Depth of the joint centres below the skin (reference 2), mean and half range, mm.
_DEEP_MM = {"MCP": (11.0, 1.8), "PIP": (7.5, 1.0), "DIP": (5.6, 0.8), "TIP": (5.0, 0.6), "WRIST": (15.0, 2.5)}


@dataclass(frozen=True, slots=True)
class Person:
    """One drawn person; metres and radians.

    ``base_m`` (5, 3) CMC joints, ``knuckle_m`` (4, 3) MCP joints 2 to 5; ``thumb_m`` (3,) MC PP DP; ``finger_m`` (4, 3)
    PP MP DP up to the end of the finger; ``fan_rad`` (5,) and ``roll_rad`` as rho and tau of the reference;
    ``deep_m`` depth below the skin of the joints by kind; ``girth`` (5,) factor of each ray's flesh;
    ``cup_rad`` (2,) flexion of metacarpals 4 and 5 in a full grip; ``glide_m`` how far skin slips over bone by disc
    (knuckles and PIP for 90 degrees, MCP1 and IP1 for 60, CMC1 for 40 of palmar abduction, WRIST from 60 of flexion to
    60 of extension); ``rise_m`` of the knuckles in a fist.
    """

    size: float
    base_m: FloatArray
    knuckle_m: FloatArray
    thumb_m: FloatArray
    finger_m: FloatArray
    fan_rad: FloatArray
    roll_rad: float
    deep_m: dict[str, float]
    girth: FloatArray
    cup_rad: FloatArray
    glide_m: dict[str, float]
    rise_m: float


def draw_person(rng: np.random.Generator, *, rigid: bool = False) -> Person:
    """An adult; ``rigid``: one whose skin and palm do not move."""

    def around(mean: FloatArray | float, sd: float, shape: tuple[int, ...] = ()) -> FloatArray:
        return mean + sd * np.clip(rng.normal(size=shape), -2.0, 2.0)

    size = float(around(182.0, 10.0)) / _WHOLE_MM
    bones = size * 1e-3 * np.array(_FINGER_MM) * around(1.0, _BONE_SD, (4, 4))
    thumb = size * 1e-3 * np.array(_THUMB_MM) * around(1.0, _BONE_SD, (3,))
    base = size * 1e-3 * (_BASE_MM + around(0.0, 0.8, (5, 3)))
    ray = np.radians(around(_RAY_DEG, 1.2, (4,)))
    down = np.radians(_RAY_DOWN_DEG * around(1.0, 0.3, (4,)))
    along = np.stack((np.cos(ray) * np.cos(down), np.sin(ray) * np.cos(down), -np.sin(down)), axis=-1)
    deep = {
        kind: size * 1e-3 * (mean + half * float(rng.uniform(-1.0, 1.0))) for kind, (mean, half) in _DEEP_MM.items()
    }
    most_mm = {f"{joint}{k}": most for joint, most in (("MCP", (2.0, 6.0)), ("PIP", (0.3, 1.5)), ("DIP", (0.1, 0.8)))
               for k in (2, 3, 4, 5)}  # fmt: skip
    most_mm |= {"MCP1": (2.0, 4.0), "IP1": (0.3, 1.0), "WRIST": (3.0, 8.0), "CMC1": (2.0, 5.0)}
    glide = {name: float(rng.uniform(1e-3 * low, 1e-3 * high)) for name, (low, high) in most_mm.items()}
    cup = np.radians([rng.uniform(10.0, 12.0), rng.uniform(18.0, 20.0)])
    return Person(
        size=size,
        base_m=base,
        knuckle_m=base[1:] + bones[:, :1] * along,
        thumb_m=thumb,
        finger_m=bones[:, 1:],
        fan_rad=np.radians(around(_FAN_DEG, 1.5, (5,))),
        roll_rad=float(np.radians(around(_ROLL_DEG, 4.0))),
        deep_m=deep,
        girth=around(1.0, 0.06) * around(1.0, 0.03, (5,)),
        cup_rad=np.zeros(2) if rigid else cup,
        glide_m=dict.fromkeys(glide, 0.0) if rigid else glide,
        rise_m=0.0 if rigid else float(rng.uniform(1.0e-3, 2.5e-3)),
    )


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
REST_DEG = np.array([18.0, 22.0, 0.0, 0.0, 0.0, 6.0, 0, 0, 0, 0.0, 0, 0, 0, -5.0, 0, 0, 0, -11.0, 0, 0, 0])
"""Fingers spread and straight: the posture in which the skin is made."""


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

    def moment(self, i: int) -> Posture:
        one = slice(i, i + 1)
        return Posture(self.wrist[one], self.place_m[one], self.fingers[one], self.cup[one], self.arm_roll[one])


@dataclass(frozen=True, slots=True)
class Placed:
    """Bones in the room: ``turn`` (N, 20, 3, 3), columns along, across and out of the back of each bone, and
    ``joint_m`` (N, 20, 3) its proximal joint."""

    turn: FloatArray
    joint_m: FloatArray


def about(axis: int, angle: FloatArray | float) -> FloatArray:
    """Turn about an axis, (..., 3, 3)."""
    a, b = (axis + 1) % 3, (axis + 2) % 3
    c, s = np.cos(np.asarray(angle, dtype=np.float64)), np.sin(np.asarray(angle, dtype=np.float64))
    out = np.zeros((*c.shape, 3, 3))
    out[..., axis, axis] = 1.0
    out[..., a, a], out[..., a, b], out[..., b, a], out[..., b, b] = c, -s, s, c
    return out


def place_bones(person: Person, posture: Posture, chain_axes: FloatArray) -> Placed:
    """All bones; ``chain_axes`` (3, 3) are the axes of W in B, in which the fingers' chains count."""
    count = len(posture.wrist)
    turn, joint = np.empty((count, BONES, 3, 3)), np.empty((count, BONES, 3))
    hand = about(2, posture.wrist[:, 0]) @ about(1, posture.wrist[:, 1]) @ about(0, posture.wrist[:, 2])
    place = posture.place_m
    turn[:, Bone.FIXED], joint[:, Bone.FIXED] = hand, place
    # The radius turns with the hand, the elbow hardly.
    for bone, share, along in ((Bone.FOREARM, 0.85, 0.0), (Bone.ELBOW, 0.35, -_ARM_END_M)):
        roll = about(0, share * posture.wrist[:, 2] + posture.arm_roll)
        turn[:, bone], joint[:, bone] = roll, place + along * roll[..., 0]

    own = np.broadcast_to(np.eye(3), (count, 3, 3))
    carrier = {1: (own, np.zeros(3)), 2: (own, np.zeros(3))}
    for ray, bone, most in ((3, Bone.MC4, person.cup_rad[0]), (4, Bone.MC5, person.cup_rad[1])):
        down = posture.cup * most
        cupped = about(1, down) @ about(0, _CUP_ROLL * down)
        base = person.base_m[ray]
        carrier[ray] = (cupped, base - cupped @ base)
        turn[:, bone], joint[:, bone] = hand @ cupped, place + hand @ base

    q = posture.fingers
    thumb = hand @ chain_axes @ about(2, person.fan_rad[0] + q[:, 0]) @ about(1, q[:, 1]) @ about(0, -person.roll_rad)
    start = place + hand @ person.base_m[0]
    for i, bend in enumerate((own, about(1, q[:, 2]) @ about(2, q[:, 3]), about(1, q[:, 4]))):
        thumb = thumb @ bend
        turn[:, Bone.MC1 + i], joint[:, Bone.MC1 + i] = thumb, start
        start = start + person.thumb_m[i] * thumb[..., 0]

    for ray in (1, 2, 3, 4):
        first, mine = Bone.PP2 + 3 * (ray - 1), q[:, 5 + 4 * (ray - 1) : 9 + 4 * (ray - 1)]
        by, shift = carrier[ray]
        start = place + np.einsum("nij,nj->ni", hand, by @ person.knuckle_m[ray - 1] + shift)
        finger = hand @ by @ chain_axes @ about(2, person.fan_rad[ray] + mine[:, 0])
        for i in range(3):
            finger = finger @ about(1, mine[:, 1 + i])
            turn[:, first + i], joint[:, first + i] = finger, start
            start = start + person.finger_m[ray - 1, i] * finger[..., 0]
    return Placed(turn, joint)


def place_at_rest(person: Person) -> Placed:
    """The bones in the posture in which the skin is made, in B."""
    still = Posture(np.zeros((1, 3)), np.zeros((1, 3)), np.radians(REST_DEG)[None], np.zeros(1), np.zeros(1))
    return place_bones(person, still, np.eye(3))

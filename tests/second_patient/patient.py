"""The patient as one body: bones, skin, discs, all at any moment, on either side, in the room.

The room of a RIGHT hand has the axes of B where the hand lies straight; a left hand is the whole mirrored at y = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from carpus.core.model.types import FloatArray, Side
from tests.second_patient.discs import (
    NAMES,
    StuckDiscs,
    bends,
    disc_points,
    lifts_m,
    on_paths,
    skin_points,
    stick_discs,
)
from tests.second_patient.flesh import Skin, make_skin
from tests.second_patient.person import Person, draw_person
from tests.second_patient.skeleton import Bone, Placed, Posture, place_bones, rest_posture
from tests.second_patient.skinning import blended_turn, dual_quaternions, turn_vectors

MIRROR = np.array([1.0, -1.0, 1.0])
_HELD_M = 0.016
_IN_PLANE = [NAMES.index(name) for name in ("WRIST", "MCP2", "MCP3", "MCP4", "MCP5")]


@dataclass(frozen=True, slots=True, repr=False)
class Body:
    """One moment in the room: corners ``point_m`` (V, 3) and ``normal`` (V, 3), discs ``disc_m`` (21, 3) with the way
    out ``disc_normal`` (21, 3) and towards the finger tip ``disc_along`` (21, 3), and where they sit at rest
    ``disc_rest_m`` (21, 3)."""

    point_m: FloatArray
    normal: FloatArray
    disc_m: FloatArray
    disc_normal: FloatArray
    disc_along: FloatArray
    disc_rest_m: FloatArray


@dataclass(frozen=True, slots=True, repr=False)
class Patient:
    """``chain_axes`` (3, 3): axes of W, by the discs of the neutral pose, in B: the fingers' angles count in them."""

    side: Side
    person: Person
    skin: Skin
    stuck: StuckDiscs
    chain_axes: FloatArray

    @property
    def mirror(self) -> FloatArray:
        """What the room's axes are multiplied by on this side."""
        return MIRROR if self.side == "left" else np.ones(3)

    def placed(self, posture: Posture) -> Placed:
        """All bones, of the right hand."""
        return place_bones(self.person, posture, self.chain_axes)

    def discs_m(self, posture: Posture, rows: Sequence[int] = tuple(range(len(NAMES)))) -> FloatArray:
        """Centres of the discs of these ``rows`` in the room, (N, M, 3)."""
        return self.mirror * disc_points(self.person, self.skin, self.stuck, posture, self.chain_axes, rows)

    def body(self, posture: Posture) -> Body:
        """Skin and discs of a single moment."""
        rest = place_bones(self.person, rest_posture(), np.eye(3))
        dual = dual_quaternions(rest, self.placed(posture))[0]
        rise, tendon = (part[0] for part in lifts_m(self.person, posture))
        point = skin_points(self.skin, np.arange(len(self.skin.corner_m)), dual, rise, tendon)
        normal = turn_vectors(blended_turn(self.skin.weight, dual), self.skin.normal)
        corner, share = on_paths(self.stuck.path, bends(posture)[0] * self.stuck.slip_m)
        disc = np.einsum("mk,mkj->mj", share, point[corner])
        disc_normal = np.einsum("mk,mkj->mj", share, normal[corner])
        disc_normal /= np.linalg.norm(disc_normal, axis=1, keepdims=True)
        weight = np.einsum("mk,mkb->mb", share, self.skin.weight[corner])
        along = turn_vectors(blended_turn(weight, dual), np.array([path.along for path in self.stuck.path]))
        along -= np.sum(along * disc_normal, axis=1, keepdims=True) * disc_normal
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        sits = np.einsum("mk,mkj->mj", share, self.skin.corner_m[corner])
        return Body(*(self.mirror * part for part in (point, normal, disc, disc_normal, along)), sits)


def make_patient(seed: int, side: Side, neutral: Posture, *, rigid: bool = False) -> Patient:
    """The patient of a seed; ``neutral`` is the posture that is clicked; ``rigid``: skin and palm stand still."""
    person, skin, stuck = _grown(seed, rigid)
    axes = np.eye(3)
    for _ in range(3):
        disc = disc_points(person, skin, stuck, neutral, axes)[0]
        hand = place_bones(person, neutral, axes).turn[0, Bone.FIXED]
        axes = hand.T @ frame_of_discs(disc, hand[:, 2])
    return Patient(side, person, skin, stuck, axes)


@lru_cache(maxsize=8)
def _grown(seed: int, rigid: bool) -> tuple[Person, Skin, StuckDiscs]:
    """What is the same in every take of a patient: to net the skin takes longer than all the rest."""
    rng = np.random.default_rng([seed, 1301])
    person = draw_person(rng, rigid=rigid)
    skin = make_skin(person)
    stuck = stick_discs(person, skin, rng)
    if rigid:
        skin = _held(skin, stuck)
        stuck = StuckDiscs(stuck.path, np.zeros(len(NAMES)), stuck.size_m, stuck.cut)
    return person, skin, stuck


def frame_of_discs(disc_m: FloatArray, out: FloatArray) -> FloatArray:
    """Axes of W as columns (3, 3) from the discs (21, 3): X from WRIST to MCP3, Z the normal of the plane through WRIST
    and the knuckles on the side of ``out``, Y = Z x X (interface 4, reference 1.1)."""
    x = disc_m[NAMES.index("MCP3")] - disc_m[NAMES.index("WRIST")]
    x = x / np.linalg.norm(x)
    plane = disc_m[_IN_PLANE] - disc_m[_IN_PLANE].mean(axis=0)
    z = np.linalg.svd(plane)[2][2]
    z = z * np.sign(z @ out)
    z = z - (z @ x) * x
    z = z / np.linalg.norm(z)
    return np.stack((x, np.cross(z, x), z), axis=-1)


def _held(skin: Skin, stuck: StuckDiscs) -> Skin:
    """The skin around each disc of the palm fast on its bone."""
    weight = skin.weight.copy()
    bones = {
        "WRIST": Bone.FIXED,
        "CMC1": Bone.FIXED,
        "MCP2": Bone.FIXED,
        "MCP3": Bone.FIXED,
        "MCP4": Bone.MC4,
        "MCP5": Bone.MC5,
    }
    for name, bone in bones.items():
        path = stuck.path[NAMES.index(name)]
        middle = path.share[len(path.share) // 2] @ skin.corner_m[path.corner[len(path.share) // 2]]
        near = np.linalg.norm(skin.corner_m - middle, axis=1) < _HELD_M
        weight[near] = 0.0
        weight[near, bone] = 1.0
    return Skin(skin.corner_m, skin.normal, skin.triangle, weight, skin.knuckle, skin.tendon)

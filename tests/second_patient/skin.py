"""The skin at rest as a triangle mesh, how it hangs on the bones, and how they move it.

Flesh is a density along strands (elliptic sections that change from station to station); where the densities add up
to one, there is the skin. It is cut out of a grid as a net of quadrangles whose corners are drawn onto the skin. Bones
move it by blended dual quaternions, which keep the girth of a bent joint.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from carpus.core.model.types import FloatArray
from tests.second_patient.person import BONES, Bone, Person, Placed, place_at_rest

_HARDNESS = 4.5
_STEP_M, _ARM_STEP_M = 0.0042, 0.011
_ARM_FROM_M, _HAND_FROM_M = -0.235, -0.030
_LEAST_WEIGHT = 0.01
_KNUCKLE_BEYOND_M = 0.0015
_PARENT = [1, 2, 2, 2, 2, 2, 5, 6, 2, 8, 9, 2, 11, 12, 3, 14, 15, 4, 17, 18]
_ORDER = [Bone.FOREARM, Bone.ELBOW, *range(3, BONES)]


@dataclass(frozen=True, slots=True, repr=False)
class Strand:
    """S stations: ``centre_m`` (S, 3), half ``width_m``, height ``up_m`` over and ``down_m`` under the centre (S,);
    ``up`` (3,) the way out of the back."""

    centre_m: FloatArray
    width_m: FloatArray
    up_m: FloatArray
    down_m: FloatArray
    up: FloatArray


@dataclass(frozen=True, slots=True, repr=False)
class Skin:
    """V corners and T triangles at rest in B.

    ``corner_m``, ``normal`` (V, 3); ``triangle`` (T, 3), seen from outside in mathematical order; ``weight`` (V, 20)
    of the bones; ``knuckle`` and ``tendon`` (V, 4) how much each ray's knuckle or tendon lifts a corner.
    """

    corner_m: FloatArray
    normal: FloatArray
    triangle: NDArray[np.int64]
    weight: FloatArray
    knuckle: FloatArray
    tendon: FloatArray


def make_skin(person: Person) -> Skin:
    """The person's skin."""
    rest = place_at_rest(person)
    strands = _strands(person, rest)
    corner, triangle = _net(strands)
    for _ in range(4):
        value, slope = _density(strands, corner)
        steep = np.maximum(np.sum(slope**2, axis=1), 1.0)
        move = ((1.0 - value) / steep)[:, None] * slope
        corner = corner + np.clip(move, -0.001, 0.001)
    _, slope = _density(strands, corner)
    normal = -slope / np.linalg.norm(slope, axis=1, keepdims=True)
    return Skin(corner, normal, triangle, _weights(person, rest, corner), *_lifts(person, corner, normal))


def _strand(unit_m: float, centre_m: FloatArray, sections: ArrayLike, up: FloatArray) -> Strand:
    """A strand with half width, height over and height under its middle at each station, in units of ``unit_m``."""
    width, over, under = unit_m * np.asarray(sections).T
    return Strand(np.asarray(centre_m), width, over, under, up)


def _strands(person: Person, rest: Placed) -> list[Strand]:
    mm, girth = 1e-3 * person.size, person.girth
    up = np.array([0.0, 0.0, 1.0])
    deep = {kind: value / mm for kind, value in person.deep_m.items()}
    wrist, knuckle, middle, end = deep["WRIST"], deep["MCP"], deep["PIP"], deep["DIP"]
    arm = mm * np.array([[-250.0, 0, 2], [-150, 0, 1], [-60, 0, 0], [-18, 0, 0], [6, 0, 0], [22, -1, -1]])
    thick = [(43, 33, 36), (38, 27, 31), (31, 18, 23), (29, wrist - 0.5, 19), (28, wrist - 1.5, 18), (27, 10, 15)]
    out = [_strand(girth[2] * mm, arm, thick, up)]
    for ray in (1, 2, 3, 4):
        unit = girth[ray] * mm
        base, head = person.base_m[ray], person.knuckle_m[ray - 1]
        along = base + np.array([0.0, 0.5, 0.96])[:, None] * (head - base)
        top = knuckle - (1.4, 0.8, 1.4, 2.0)[ray - 1]
        out.append(_strand(unit, along, [(9.0, 9.5, 13), (8.5, 8.6, 12), (9.0, top, 12)], up))
        first = Bone.PP2 + 3 * (ray - 1)
        f = (0.97, 1.0, 0.95, 0.86)[ray - 1]
        pip, dip, tip = np.cumsum(person.finger_m[ray - 1])
        places = np.array([0.0, 0.45 * pip, pip, 0.5 * (pip + dip), dip, 0.5 * (dip + tip), tip - 5.0 * f * mm])
        wide = f * np.array([9.6, 8.8, 9.3, 8.0, 8.3, 8.0, 6.9])
        over = [knuckle - 0.8, middle + 0.2, middle, middle - 1.0, end, deep["TIP"], 4.6]
        under = f * np.array([11, 9.5, 8.6, 8.4, 7.0, 7.3, 5.4])
        turn = rest.turn[0, first]
        out.append(_strand(unit, head + places[:, None] * turn[:, 0], np.column_stack((wide, over, under)), turn[:, 2]))
    out.append(_thumb(person, rest))
    mcp1, index = rest.joint_m[0, Bone.PP1], person.knuckle_m[0]
    thenar = [mm * np.array([16.0, 12.0, -13.0]), 0.55 * mcp1 + 0.45 * mm * np.array([46.0, 20.0, -16.0])]
    web = [mm * np.array([24.0, 17.0, -9.0]), 0.42 * mcp1 + 0.58 * index + mm * np.array([-17.0, -2.0, -7.0])]
    out.append(_strand(girth[0] * mm, np.stack(thenar), [(12, 9, 11), (11, 8, 9)], up))
    out.append(_strand(girth[0] * mm, np.stack(web), [(13, 7, 8), (10, 5, 6)], up))
    edge = mm * np.array([[14.0, -17.0, -10.0], [42.0, -25.0, -12.0], [0.0, -27.0, -12.0]])
    edge[2, 0] = 0.9 * person.knuckle_m[3, 0]
    out.append(_strand(girth[4] * mm, edge, [(10, 9, 12), (10, 9, 12), (9, 8, 9)], up))
    return out


def _thumb(person: Person, rest: Placed) -> Strand:
    mm = 1e-3 * person.size
    cmc, mcp, ip = rest.joint_m[0, [Bone.MC1, Bone.PP1, Bone.DP1]]
    ahead = rest.turn[0, Bone.DP1, :, 0]
    tip = ip + person.thumb_m[2] * ahead
    centre = [cmc, 0.55 * mcp + 0.45 * cmc, mcp, 0.5 * (mcp + ip), ip, 0.5 * (ip + tip), tip - 6.0 * mm * ahead]
    sections = np.column_stack(
        ([11, 10.5, 10.5, 9.6, 10, 9.6, 7.2], [9, 8.8, 8.8, 7.2, 7.2, 5.6, 4.6], [13, 13, 10.5, 10, 8.4, 8.2, 6])
    )
    return _strand(person.girth[0] * mm, np.stack(centre), sections, rest.turn[0, Bone.PP1, :, 2])


def _density(strands: list[Strand], point_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Density (P,) and its slope (P, 3) at points (P, 3)."""
    value, slope = np.zeros(len(point_m)), np.zeros((len(point_m), 3))
    for strand in strands:
        far, way = _reach(strand, point_m)
        density = np.exp(np.minimum(-_HARDNESS * (far - 1.0), 8.0))
        value += density
        slope += (-_HARDNESS * density)[:, None] * way
    return value, slope


def _reach(strand: Strand, point_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Distance (P,) of points from the strand's middle line in units of its section there, and its slope (P, 3)."""
    best, way = np.full(len(point_m), np.inf), np.zeros((len(point_m), 3))
    for i in range(len(strand.centre_m) - 1):
        a, b = strand.centre_m[i], strand.centre_m[i + 1]
        length = float(np.linalg.norm(b - a))
        ahead = (b - a) / length
        side = np.cross(strand.up, ahead)
        side /= np.linalg.norm(side)
        back = np.cross(ahead, side)
        along = (point_m - a) @ ahead
        t = np.clip(along / length, 0.0, 1.0)
        u, v = (point_m - a) @ side, (point_m - a) @ back
        beyond = along - t * length
        mix = [(1.0 - t) * part[i] + t * part[i + 1] for part in (strand.width_m, strand.up_m, strand.down_m)]
        high = np.where(v >= 0.0, mix[1], mix[2])
        end = 0.5 * (mix[1] + mix[2])
        far = np.sqrt((u / mix[0]) ** 2 + (v / high) ** 2 + (beyond / end) ** 2 + 1e-9)
        nearer = far < best
        direction = (
            (u / mix[0] ** 2)[:, None] * side + (v / high**2)[:, None] * back + (beyond / end**2)[:, None] * ahead
        ) / far[:, None]
        best = np.where(nearer, far, best)
        way[nearer] = direction[nearer]
    return best, way


def _net(strands: list[Strand]) -> tuple[FloatArray, NDArray[np.int64]]:
    """Corners and triangles where the density passes one: a corner in every cell of the grid that the skin crosses."""
    every = np.concatenate([strand.centre_m for strand in strands])
    low, high = every.min(axis=0) - 0.030, every.max(axis=0) + 0.024
    x = np.concatenate((np.arange(_ARM_FROM_M, _HAND_FROM_M, _ARM_STEP_M), np.arange(_HAND_FROM_M, high[0], _STEP_M)))
    axes = (x, np.arange(low[1] - 0.012, high[1] + 0.012, _STEP_M), np.arange(low[2] - 0.012, high[2] + 0.016, _STEP_M))
    shape = tuple(len(axis) for axis in axes)
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    value = _density(strands, grid.reshape(-1, 3))[0].reshape(shape) - 1.0
    inside = value > 0.0
    cell = tuple(n - 1 for n in shape)
    total, count = np.zeros((*cell, 3)), np.zeros(cell)
    for axis in range(3):
        crossing = np.diff(inside.astype(np.int8), axis=axis) != 0
        near, next_ = (tuple(one if i == axis else slice(None) for i in range(3)) for one in (np.s_[:-1], np.s_[1:]))
        first = value[near]
        share = np.where(crossing, first / np.where(crossing, first - value[next_], 1.0), 0.0)
        point = grid[near] + share[..., None] * (grid[next_] - grid[near])
        others = [i for i in range(3) if i != axis]
        for steps in ((0, 0), (0, 1), (1, 0), (1, 1)):
            cut = [slice(None)] * 3
            for i, step in zip(others, steps, strict=True):
                cut[i] = slice(step, cell[i] + step)
            total += np.where(crossing[tuple(cut)][..., None], point[tuple(cut)], 0.0)
            count += crossing[tuple(cut)]
    used = count > 0
    number = np.full(cell, -1, dtype=np.int64)
    number[used] = np.arange(int(used.sum()))
    corner = total[used] / count[used][:, None]
    triangles = []
    for axis in range(3):
        crossing = np.diff(inside.astype(np.int8), axis=axis)
        b, c = (axis + 1) % 3, (axis + 2) % 3
        place = np.argwhere(crossing != 0)
        place = place[(place[:, b] > 0) & (place[:, c] > 0) & (place[:, b] < cell[b]) & (place[:, c] < cell[c])]
        leaves = crossing[tuple(place.T)] < 0
        ring = []
        for step_b, step_c in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
            beside = place.copy()
            beside[:, b] += step_b
            beside[:, c] += step_c
            ring.append(number[tuple(beside.T)])
        quad = np.stack(ring, axis=1)
        quad = np.where(leaves[:, None], quad, quad[:, ::-1])
        triangles += [quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]]
    return corner, np.concatenate(triangles)


def _weights(person: Person, rest: Placed, corner_m: FloatArray) -> FloatArray:
    """Weights (V, 20): the nearer a bone, the more of it; softer over the palm and the wrist than on fingers."""
    length = {Bone.MC1 + i: one for i, one in enumerate((*person.thumb_m, *person.finger_m.ravel()))}
    far = np.empty((len(corner_m), BONES))
    for bone, long_m in length.items():
        start = rest.joint_m[0, bone]
        far[:, bone] = _from_segment(corner_m, start, start + long_m * rest.turn[0, bone, :, 0])
    for bone, ray in ((Bone.MC4, 3), (Bone.MC5, 4)):
        far[:, bone] = _from_segment(corner_m, person.base_m[ray], person.knuckle_m[ray - 1])
    fixed = [(np.zeros(3), person.base_m[ray]) for ray in (0, 1, 2, 3, 4)]
    fixed += [(person.base_m[ray], person.knuckle_m[ray - 1]) for ray in (1, 2)]
    far[:, Bone.FIXED] = np.min([_from_segment(corner_m, a, b) for a, b in fixed], axis=0)
    arm = np.array([-0.080, 0.0, 0.0])
    far[:, Bone.FOREARM] = _from_segment(corner_m, arm, np.array([-0.012, 0.0, 0.0]))
    far[:, Bone.ELBOW] = _from_segment(corner_m, np.array([-0.4, 0.0, 0.0]), arm)
    # The skin of a knuckle bends a little beyond the joint, where the webs begin.
    far[:, [Bone.PP2, Bone.PP3, Bone.PP4, Bone.PP5]] += _KNUCKLE_BEYOND_M
    soft = person.size * np.interp(
        corner_m[:, 0], np.array([-0.1, -0.015, 0.03, 0.065, 0.095]), np.array([12.0, 4.0, 3.0, 1.7, 1.3]) * 1e-3
    )
    thumb = far[:, Bone.MC1 : Bone.MC1 + 3].min(axis=1) <= far.min(axis=1)
    soft = np.where(thumb, np.minimum(soft, 2.2e-3), soft)
    weight = np.exp(-(far - far.min(axis=1, keepdims=True)) / soft[:, None])
    weight[weight < _LEAST_WEIGHT] = 0.0
    return np.asarray(weight / weight.sum(axis=1, keepdims=True))


def _from_segment(point_m: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    t = np.clip((point_m - a) @ (b - a) / float((b - a) @ (b - a)), 0.0, 1.0)
    return np.asarray(np.linalg.norm(point_m - a - t[:, None] * (b - a), axis=1))


def _lifts(person: Person, corner_m: FloatArray, normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Where knuckles and tendons lift the skin, (V, 4) each, on the back only."""
    back = np.clip(normal[:, 2], 0.0, 1.0)[:, None]
    mm = 1e-3 * person.size
    knuckle, tendon = [], []
    for ray in (1, 2, 3, 4):
        head = person.knuckle_m[ray - 1]
        flat = np.linalg.norm((corner_m - head)[:, :2], axis=1)
        knuckle.append(np.exp(-0.5 * (flat / (7.0 * mm)) ** 2))
        start = np.array([12.0 * mm, 1.0 * mm * (2.5 - ray), 0.0])
        t = (corner_m - start) @ (head - start) / float((head - start) @ (head - start))
        aside = np.linalg.norm((corner_m - start - np.clip(t, 0, 1)[:, None] * (head - start))[:, :2], axis=1)
        tendon.append(np.exp(-0.5 * (aside / (2.8 * mm)) ** 2) * np.clip(np.minimum(t, 1.05 - t) / 0.25, 0.0, 1.0))
    return np.stack(knuckle, axis=1) * back, np.stack(tendon, axis=1) * back


def dual_quaternions(rest: Placed, placed: Placed) -> FloatArray:
    """How each bone moved from rest, (N, 20, 8): turn and dual part, each on its parent's side of the sphere."""
    turn = placed.turn @ np.swapaxes(rest.turn, -1, -2)
    shift = placed.joint_m - np.einsum("nbij,nbj->nbi", turn, np.broadcast_to(rest.joint_m, placed.joint_m.shape))
    real = Rotation.from_matrix(turn.reshape(-1, 3, 3)).as_quat()[:, [3, 0, 1, 2]].reshape(*turn.shape[:-2], 4)
    for bone in _ORDER:
        flip = np.sum(real[:, bone] * real[:, _PARENT[bone]], axis=-1) < 0.0
        real[flip, bone] *= -1.0
    v = real[..., 1:]
    dual = np.concatenate((-np.sum(shift * v, axis=-1, keepdims=True), real[..., :1] * shift + np.cross(shift, v)), -1)
    return np.concatenate((real, 0.5 * dual), axis=-1)


def move_points(weight: FloatArray, dual: FloatArray, point_m: FloatArray) -> FloatArray:
    """Points (P, 3) with weights (P, 20) as the bones (20, 8) carry them."""
    blended = weight @ dual
    blended /= np.linalg.norm(blended[:, :4], axis=1, keepdims=True)
    real, other = blended[:, :4], blended[:, 4:]
    shift = 2.0 * (real[:, :1] * other[:, 1:] - other[:, :1] * real[:, 1:] + np.cross(real[:, 1:], other[:, 1:]))
    return turn_vectors(real, point_m) + shift


def turn_vectors(real: FloatArray, vector: FloatArray) -> FloatArray:
    """Vectors (P, 3) turned by unit quaternions (P, 4)."""
    w, v = real[:, :1], real[:, 1:]
    return vector + 2.0 * np.cross(v, np.cross(v, vector) + w * vector)


def blended_turn(weight: FloatArray, dual: FloatArray) -> FloatArray:
    """Unit quaternions (P, 4) by which the skin turns."""
    real = weight @ dual[:, :4]
    return real / np.linalg.norm(real, axis=1, keepdims=True)

"""Where the paper discs stick, how the skin carries them, and how far it slips over the bone.

A disc's centre is a point of the skin: it lies on a path of skin points, and as joints bend it moves along that path.
What the blended skin does by itself and the slip along the path make together the glide drawn for the person.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray
from tests.second_patient.person import Bone, Person, Posture, place_at_rest, place_bones
from tests.second_patient.skin import Skin, dual_quaternions, move_points

NAMES = ("WRIST", "CMC1", "MCP1", "IP1", "TIP1") + tuple(
    f"{joint}{k}" for k in (2, 3, 4, 5) for joint in ("MCP", "PIP", "DIP", "TIP")
)
PALM = ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")

_STEP_M, _HALF_STEPS = 0.0005, 18
_BEND_RAD, _WRIST_BEND_RAD = np.radians(40.0), np.radians(35.0)
"""Joint angle over which most of the slip has happened."""
_OVER_M = 0.012
_BETWEEN_M, _BETWEEN_ENDS_M, _LEAST_M = 0.0022, 0.0022, 0.0040
"""Paper that is left between two discs, half of it, and the smallest disc: 8 mm, for the ends of small fingers."""
_ROUNDS, _MOST_SLIP_M = 5, 0.007


@dataclass(frozen=True, slots=True, repr=False)
class Path:
    """Skin points every half millimetre along a disc's way, at its middle the place where it was stuck.

    ``corner`` (S, 3) corners of the triangle of each point and ``share`` (S, 3) of them; ``along`` (3,) the way
    at rest.
    """

    corner: NDArray[np.int64]
    share: FloatArray
    along: FloatArray


@dataclass(frozen=True, slots=True, repr=False)
class StuckDiscs:
    """All 21 discs: ``path`` of each; ``slip_m`` (21,) along it when its joint is bent as far as ``glide_m`` counts;
    ``size_m`` (21,) radius of the paper; ``cut`` (21, 4) how crooked its edge is, two waves and their phases."""

    path: tuple[Path, ...]
    slip_m: FloatArray
    size_m: FloatArray
    cut: FloatArray


def stick_discs(person: Person, skin: Skin, rng: np.random.Generator) -> StuckDiscs:
    """A therapist sticks them, a millimetre or two off, up to five."""
    rest = place_at_rest(person)
    paths = []
    for name in NAMES:
        place, out, along = _aim(person, rest.turn[0], rest.joint_m[0], name)
        side = np.cross(out, along)
        off = np.clip(rng.normal(size=2), -2.5, 2.5) * (1.2e-3 if name in PALM else 0.8e-3)
        place = place + off[0] * along + off[1] * side
        paths.append(_path(skin, place, out / np.linalg.norm(out), along / np.linalg.norm(along)))
    radius = np.full(len(NAMES), 0.5e-3 * rng.uniform(10.5, 13.5)) + 0.15e-3 * rng.normal(size=len(NAMES))
    # Smaller ones where knuckles stand close, and on the ends of fingers.
    middle = np.array([_middle(skin, path) for path in paths])
    apart = np.linalg.norm(np.diff(middle, axis=0), axis=1)
    knuckles = middle[[NAMES.index(f"MCP{k}") for k in (2, 3, 4, 5)]]
    room = np.full(len(NAMES), 0.5 * float(np.linalg.norm(np.diff(knuckles, axis=0), axis=1).min()) - _BETWEEN_M)
    for i, name in enumerate(NAMES):
        if name.startswith(("DIP", "TIP")):
            beside = apart[i - 1] if name.startswith("TIP") else apart[i]
            room[i] = min(room[i], 5.2e-3, 0.5 * float(beside) - _BETWEEN_ENDS_M)
    radius = np.clip(np.minimum(radius, room), _LEAST_M, 7e-3)
    cut = np.stack((*rng.uniform(0.0, 0.035, (2, len(NAMES))), *rng.uniform(0.0, 6.3, (2, len(NAMES)))), axis=1)
    return StuckDiscs(tuple(paths), _solve_slip(person, skin, paths), radius, cut)


def _middle(skin: Skin, path: Path) -> FloatArray:
    """Where a disc was stuck, at rest."""
    row = len(path.share) // 2
    return path.share[row] @ skin.corner_m[path.corner[row]]


def _aim(person: Person, turn: FloatArray, joint: FloatArray, name: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Point to stick at, the way out of the skin there and the way to the finger tip; at rest in B."""
    mm = 1e-3 * person.size
    kind, ray = name.rstrip("12345"), int(name[-1]) if name[-1].isdigit() else 0
    up, ahead = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
    if name == "WRIST":
        return mm * np.array([2.0, 0.0, 0.0]), up, ahead
    if name == "CMC1":
        along = turn[Bone.MC1, :, 0]
        # Where the camera sees it: on the back's side of the thumb's base, not on its edge.
        return joint[Bone.MC1] + 1.0 * mm * along + mm * np.array([0.0, -4.0, 0.0]), up - (up @ along) * along, along
    if ray == 1:
        bone = {"MCP": Bone.PP1, "IP": Bone.DP1, "TIP": Bone.DP1}[kind]
        along = turn[bone, :, 0]
        place = joint[bone] + (0.8 * person.thumb_m[2] if kind == "TIP" else 0.0) * along
        return place, turn[bone, :, 2], along
    first = Bone.PP2 + 3 * (ray - 2)
    if kind == "MCP":
        along = person.knuckle_m[ray - 2] - person.base_m[ray - 1]
        along = along / np.linalg.norm(along)
        return joint[first] - 4.0 * mm * along, up - (up @ along) * along, along
    bone = first + {"PIP": 1, "DIP": 2, "TIP": 2}[kind]
    along = turn[bone, :, 0]
    return joint[bone] + (0.74 * person.finger_m[ray - 2, 2] if kind == "TIP" else 0.0) * along, turn[bone, :, 2], along


def _path(skin: Skin, place: FloatArray, out: FloatArray, along: FloatArray) -> Path:
    """Skin points straight outwards of points along a line."""
    steps = _STEP_M * np.arange(-_HALF_STEPS, _HALF_STEPS + 1)
    corner = skin.corner_m
    near = np.linalg.norm(corner - place, axis=1) < 0.045
    triangle = skin.triangle[near[skin.triangle].all(axis=1)]
    a, b, c = (corner[triangle[:, i]] for i in range(3))
    facing = np.cross(b - a, c - a) @ out > 0.0
    triangle, a, b, c = triangle[facing], a[facing], b[facing], c[facing]
    start = place + steps[:, None] * along
    # Each line start + h out meets a triangle a + s (b - a) + t (c - a): three equations for s, t, h.
    matrix = np.stack((b - a, c - a, np.broadcast_to(-out, a.shape)), axis=-1)
    share = np.einsum("tij,ptj->pti", np.linalg.inv(matrix), start[:, None] - a[None])
    hit = (share[..., 0] >= -1e-9) & (share[..., 1] >= -1e-9) & (share[..., 0] + share[..., 1] <= 1.0 + 1e-9)
    height = np.where(hit & (share[..., 2] > 0.0), share[..., 2], -np.inf)
    middle = height[_HALF_STEPS].max()
    height = np.where(np.abs(height - middle) < _OVER_M, height, -np.inf)
    best = height.argmax(axis=1)
    found = np.isfinite(height.max(axis=1))
    if not found[_HALF_STEPS]:
        raise ValueError(f"no skin over {place}")
    # Beyond the end of a finger there is no skin: the path stops.
    rows = np.arange(len(steps))
    good = rows[found]
    best = best[good[np.abs(rows[:, None] - good).argmin(axis=1)]]
    rows = good[np.abs(rows[:, None] - good).argmin(axis=1)]
    s, t = share[rows, best, 0], share[rows, best, 1]
    return Path(triangle[best], np.stack((1.0 - s - t, s, t), axis=1), along)


def bends(posture: Posture) -> FloatArray:
    """What the slip of each disc follows, (N, 21): 0 in the straight hand, 1 where ``glide_m`` counts."""

    def law(angle: FloatArray, full: float, over: float = _BEND_RAD) -> FloatArray:
        return np.sign(angle) * (1.0 - np.exp(-np.abs(angle) / over)) / (1.0 - np.exp(-full / over))

    q = posture.fingers
    out = np.zeros((len(q), len(NAMES)))
    out[:, 0] = -np.tanh(posture.wrist[:, 1] / _WRIST_BEND_RAD) / np.tanh(np.radians(60.0) / _WRIST_BEND_RAD)
    out[:, 1] = law(q[:, 1], np.radians(40.0))
    out[:, 2], out[:, 3] = law(q[:, 2], np.radians(60.0)), law(q[:, 4], np.radians(60.0))
    for ray in (1, 2, 3, 4):
        for i in range(3):
            out[:, 5 + 4 * (ray - 1) + i] = law(q[:, 6 + 4 * (ray - 1) + i], np.radians(90.0))
    return out


def lifts_m(person: Person, posture: Posture) -> tuple[FloatArray, FloatArray]:
    """How far each ray's knuckle and tendon stand out, (N, 4) each: knuckles of a fist, tendons of stretched fingers
    over a bent-back wrist."""
    knuckle = posture.fingers[:, 6::4]
    rise = person.rise_m * np.clip(knuckle / np.radians(90.0), 0.0, 1.1)
    back = np.clip(-posture.wrist[:, 1:2] / np.radians(60.0), 0.0, 1.0)
    straight = np.clip(1.0 - knuckle / np.radians(40.0), 0.0, 1.0)
    return rise, 0.35 * person.rise_m * (0.3 + back) * straight


def skin_points(
    skin: Skin, corner: NDArray[np.int64], dual: FloatArray, rise_m: FloatArray, tendon_m: FloatArray
) -> FloatArray:
    """Corners of the skin (K,) as one moment's bones (20, 8) carry them, knuckles (4,) and tendons (4,) out; (K, 3)."""
    out = skin.knuckle[corner] @ rise_m + skin.tendon[corner] @ tendon_m
    return move_points(skin.weight[corner], dual, skin.corner_m[corner] + out[:, None] * skin.normal[corner])


def disc_points(person: Person, skin: Skin, stuck: StuckDiscs, posture: Posture, chain_axes: FloatArray) -> FloatArray:
    """Centres of the discs in the room of a right hand, (N, 21, 3)."""
    rest = place_at_rest(person)
    dual = dual_quaternions(rest, place_bones(person, posture, chain_axes))
    rise, tendon = lifts_m(person, posture)
    slip = bends(posture) * stuck.slip_m
    out = np.empty((len(slip), len(NAMES), 3))
    for i in range(len(slip)):
        corner, share = on_paths(stuck.path, slip[i])
        points = skin_points(skin, corner.ravel(), dual[i], rise[i], tendon[i]).reshape(len(NAMES), 6, 3)
        out[i] = np.einsum("mk,mkj->mj", share, points)
    return out


def on_paths(paths: Sequence[Path], slip_m: FloatArray) -> tuple[NDArray[np.int64], FloatArray]:
    """Corners (M, 6) of the skin and their shares (M, 6) in the disc's centre, slipped by (M,) along its path."""
    corner, share = np.empty((len(paths), 6), dtype=np.int64), np.empty((len(paths), 6))
    for i, path in enumerate(paths):
        place = min(max(float(slip_m[i]) / _STEP_M + _HALF_STEPS, 0.0), 2.0 * _HALF_STEPS - 1e-6)
        row, part = int(place), place - int(place)
        corner[i] = path.corner[row : row + 2].ravel()
        share[i, :3], share[i, 3:] = (1.0 - part) * path.share[row], part * path.share[row + 1]
    return corner, share


def full_bend(name: str) -> tuple[Posture, Bone]:
    """Two postures between which a disc glides as far as the person's ``glide_m`` says, and the bone beneath it."""
    fingers, wrist = np.zeros((2, 21)), np.zeros((2, 3))
    bone = Bone.FIXED
    if name == "WRIST":
        wrist[:, 1] = np.radians([60.0, -60.0])
    elif name == "CMC1":
        fingers[1, 1] = np.radians(40.0)
    elif name == "MCP1":
        fingers[1, 2], bone = np.radians(60.0), Bone.MC1
    else:
        ray = int(name[-1])
        fingers[1, 6 + 4 * (ray - 2)] = np.radians(90.0)
        bone = {2: Bone.FIXED, 3: Bone.FIXED, 4: Bone.MC4, 5: Bone.MC5}[ray]
    return Posture(wrist, np.zeros((2, 3)), fingers, np.zeros(2), np.zeros(2)), bone


def _solve_slip(person: Person, skin: Skin, paths: Sequence[Path]) -> FloatArray:
    """Slip along the path with which the whole glide of palm and MCP1 is what was drawn; of the others what was drawn
    is the slip itself, for the bending joint's own skin comes on top."""
    slip, rest = np.array([person.glide_m.get(name, 0.0) for name in NAMES]), place_at_rest(person)
    for name in (*PALM, "MCP1"):
        row = NAMES.index(name)
        path, want, found = paths[row], slip[row], 0.0
        posture, bone = full_bend(name)
        placed, bend = place_bones(person, posture, np.eye(3)), bends(posture)[:, row]
        dual, (rise, tendon) = dual_quaternions(rest, placed), lifts_m(person, posture)
        along = path.along if bone != Bone.MC1 else rest.turn[0, bone].T @ path.along

        def glide(slip_m: float) -> float:
            """How far the disc moves over the bone beneath it, along its way, between the two postures."""
            seen = []
            for i in (0, 1):
                corner, share = on_paths([path], bend[i : i + 1] * slip_m)  # noqa: B023
                disc = share[0] @ skin_points(skin, corner[0], dual[i], rise[i], tendon[i])  # noqa: B023
                seen.append(placed.turn[i, bone].T @ (disc - placed.joint_m[i, bone]))  # noqa: B023
            return float((seen[1] - seen[0]) @ along)  # noqa: B023

        for _ in range(_ROUNDS):
            gain = max((glide(found + _STEP_M) - glide(found)) / _STEP_M, 0.25)
            found = float(np.clip(found + (want - glide(found)) / gain, -_MOST_SLIP_M, _MOST_SLIP_M))
        slip[row] = found
    return slip

"""Moves the skin with the bones: blended dual quaternions, which keep the girth of a bent joint."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.model.types import FloatArray
from tests.second_patient.skeleton import BONES, Bone, Placed

_PARENT = [1, 2, 2, 2, 2, 2, 5, 6, 2, 8, 9, 2, 11, 12, 3, 14, 15, 4, 17, 18]
_ORDER = [Bone.FIXED, Bone.FOREARM, Bone.ELBOW, *range(3, BONES)]


def dual_quaternions(rest: Placed, placed: Placed) -> FloatArray:
    """How each bone moved from rest, (N, 20, 8): turn and dual part, each on its parent's side of the sphere."""
    turn = placed.turn @ np.swapaxes(rest.turn, -1, -2)
    shift = placed.joint_m - np.einsum("nbij,nbj->nbi", turn, np.broadcast_to(rest.joint_m, placed.joint_m.shape))
    real = _quaternion(turn)
    for bone in _ORDER[1:]:
        flip = np.sum(real[:, bone] * real[:, _PARENT[bone]], axis=-1) < 0.0
        real[flip, bone] *= -1.0
    pure = np.concatenate((np.zeros((*shift.shape[:-1], 1)), shift), axis=-1)
    return np.concatenate((real, 0.5 * _product(pure, real)), axis=-1)


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


def _product(a: FloatArray, b: FloatArray) -> FloatArray:
    w = a[..., :1] * b[..., :1] - np.sum(a[..., 1:] * b[..., 1:], axis=-1, keepdims=True)
    v = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + np.cross(a[..., 1:], b[..., 1:])
    return np.concatenate((w, v), axis=-1)


def _quaternion(turn: FloatArray) -> FloatArray:
    """Unit quaternions (..., 4), w first, of rotations (..., 3, 3)."""
    found = Rotation.from_matrix(turn.reshape(-1, 3, 3)).as_quat()
    return np.asarray(found[:, [3, 0, 1, 2]]).reshape(*turn.shape[:-2], 4)

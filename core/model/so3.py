"""Rotations without angles: exponential and logarithm on SO(3), batched.

A rotation vector (..., 3) is axis times angle in radians. Perturbations stand on the right, ``R Exp(d)``, so ``d`` is
in the axes of the moving frame, as the angular velocity of eq. (1) of the wrist paper is.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.model.types import FloatArray

_SMALL = 1e-8
_TINY = 1e-300  # added to a squared angle, so that no turn at all needs no case of its own

_GENERATORS = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
)


def skew(vector: FloatArray) -> FloatArray:
    """Return the matrix (..., 3, 3) of the cross product with ``vector`` (..., 3)."""
    if vector.ndim == 1:
        x, y, z = vector.tolist()
        return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray((vector @ _GENERATORS).reshape(*vector.shape, 3))


def exp(rotation_vector: FloatArray) -> FloatArray:
    """Return the rotation matrices (..., 3, 3) of rotation vectors (..., 3).

    Rodrigues' formula.

    >>> exp(np.array([0.0, 0.0, np.pi / 2])).round(6) + 0.0
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """
    if rotation_vector.ndim == 1:
        return _exp_one(*rotation_vector.tolist())
    turn = rotation_vector.reshape(-1, 3)
    angle = np.sqrt(np.vecdot(turn, turn) + _TINY)
    a, half = np.sin(angle) / angle, np.sin(0.5 * angle) / angle
    cross = skew(turn)
    out: FloatArray = (2.0 * half * half)[:, None, None] * (cross @ cross)  # (1 - cos(angle)) / angle^2
    out += a[:, None, None] * cross
    out.reshape(-1, 9)[:, ::4] += 1.0  # the diagonals
    return out.reshape(*rotation_vector.shape, 3)


def _exp_one(x: float, y: float, z: float) -> FloatArray:
    """Return one rotation, without the cost of array calls."""
    angle2 = x * x + y * y + z * z
    if angle2 < _SMALL:
        a, b = 1.0 - angle2 / 6.0, 0.5 - angle2 / 24.0
    else:
        angle = math.sqrt(angle2)
        a, b = math.sin(angle) / angle, (1.0 - math.cos(angle)) / angle2
    c = 1.0 - b * angle2
    return np.array(
        [
            [c + b * x * x, b * x * y - a * z, b * x * z + a * y],
            [b * x * y + a * z, c + b * y * y, b * y * z - a * x],
            [b * x * z - a * y, b * y * z + a * x, c + b * z * z],
        ]
    )


def log(rotation: FloatArray) -> FloatArray:
    """Return the rotation vectors (..., 3) of matrices (..., 3, 3), length at most pi."""
    if rotation.ndim == 2:
        turn = _log_one(rotation)
        if turn is not None:
            return turn
    r = rotation
    vee = 0.5 * np.stack((r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]), -1)
    sine = np.linalg.norm(vee, axis=-1)
    cosine = 0.5 * (np.trace(r, axis1=-2, axis2=-1) - 1.0)
    angle = np.arctan2(sine, cosine)
    scale = np.where(sine < 1e-7, 1.0, angle / np.where(sine < 1e-7, 1.0, sine))
    out: FloatArray = vee * scale[..., None]
    half_turn = (sine < 1e-4) & (cosine < 0.0)
    if np.any(half_turn):
        # Near pi the antisymmetric part vanishes: the axis is the dominant column of the symmetric part plus I.
        for index in np.argwhere(half_turn):
            where = tuple(index)
            symmetric = 0.5 * (r[where] + r[where].T) + np.eye(3)
            axis = symmetric[:, int(np.argmax(np.diag(symmetric)))]
            axis = axis / np.linalg.norm(axis)
            if axis @ vee[where] < 0.0:
                axis = -axis
            out[where] = angle[where] * axis
    return out


def _log_one(rotation: FloatArray) -> FloatArray | None:
    """Return one rotation vector without the cost of array calls; None near half a turn."""
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rotation.tolist()
    x, y, z = 0.5 * (r21 - r12), 0.5 * (r02 - r20), 0.5 * (r10 - r01)
    sine, cosine = math.sqrt(x * x + y * y + z * z), 0.5 * (r00 + r11 + r22 - 1.0)
    if sine < 1e-4 and cosine < 0.0:
        return None
    scale = 1.0 if sine < 1e-7 else math.atan2(sine, cosine) / sine
    return np.array((scale * x, scale * y, scale * z))


def project_to_rotation(matrix: FloatArray) -> FloatArray:
    """Return the rotations nearest to matrices (..., 3, 3) in the least-squares sense."""
    u, _, vt = np.linalg.svd(matrix)
    sign = np.linalg.det(u @ vt)
    u = u.copy()
    u[..., :, 2] *= sign[..., None]
    return np.asarray(u @ vt)


def fit_rigid_transform(source: FloatArray, target: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rotation (3, 3) and shift (3,) that bring points (P, 3) nearest to others.

    Kabsch's solution, without a mirror.
    """
    a, b = source.mean(axis=0), target.mean(axis=0)
    turn = project_to_rotation((target - b).T @ (source - a))
    return turn, b - turn @ a

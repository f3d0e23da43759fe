"""Thumb and fingers as the filter has them: where their discs lie, sigma points of them, and the limits of joints.

Arrays lead with the digit (5), thumb first. A digit's state (21) holds five slots of its joints, their rates and
eleven constants of its anatomy. Slots and constants side by side are its pose (16): slots at 0 to 4, lengths of the
three bones at 5 to 7, fan at 8 and roll at 9, the root's place from the disc above it at 10 to 12, heights of the three
discs at 13 to 15. Slots of the thumb: CMC extension and abduction, MCP flexion and abduction, IP flexion; of a finger:
MCP abduction, MCP flexion, PIP flexion, DIP flexion beyond what PIP brings with it, and one that is not used. Metres in
the axes W of a right palm (ahead, aside, up); radians.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.carpus.core.compiled.small_matrices import add_product, inverse_root
from cython.cimports.libc.math import M_PI_2, M_SQRT1_2, cos, erfc, exp, sin, sqrt
from numpy.typing import NDArray

from carpus.core.compiled.palm import as_array
from carpus.core.model.hand.kinematics import DIP_PER_PIP

FLOOR = 1e-14
"""Variance that keeps the covariance of slots that do not move positive definite."""
POSE = np.r_[0:5, 10:21]
"""Where slots and constants stand in a state."""
BENT, OTHER = np.array([0, 1, 2, 3, 4, 9]), np.array([5, 6, 7, 8, 10, 11, 12, 13, 14, 15])
"""Where in a pose slots and roll stand, which bend the discs' places, and what these are all but linear in."""

Array = NDArray[np.float64]

_LENGTH = cython.declare(cython.int, 5)
_FAN = cython.declare(cython.int, 8)
_ROLL = cython.declare(cython.int, 9)
_ROOT = cython.declare(cython.int, 10)
_HEIGHT = cython.declare(cython.int, 13)
_DIP_PER_PIP = cython.declare(double, DIP_PER_PIP)
_ROOT_PI = cython.declare(double, np.sqrt(np.pi))


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _place_axis(
    x: double, y: double, z: double, azimuth: double, abduction: double,
    roll: double, out: double[::1],
) -> cython.void:  # fmt: skip
    """Turn a direction of the thumb from its metacarpal's axes (along it, dorsal, that of its flexion) into W."""
    over = cos(roll) * y - sin(roll) * z
    across = sin(roll) * y + cos(roll) * z
    ahead = cos(abduction) * x + sin(abduction) * over
    out[0] = cos(azimuth) * ahead - sin(azimuth) * across
    out[1] = sin(azimuth) * ahead + cos(azimuth) * across
    out[2] = cos(abduction) * over - sin(abduction) * x


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _place_bone(pitch: double, azimuth: double, out: double[::1]) -> cython.void:
    """Fill in a direction in W, ``pitch`` under the palm's plane."""
    out[0] = cos(pitch) * cos(azimuth)
    out[1] = cos(pitch) * sin(azimuth)
    out[2] = -sin(pitch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _place_chain(
    digit: cython.int,
    s: cython.const[double][::1],
    root: cython.const[double][::1],
    bone: double[:, ::1],
    normal: double[:, ::1],
    joint: double[:, ::1],
    disc: double[:, ::1],
) -> cython.void:
    """Place a digit with pose ``s``: bones, normals and discs, (3, 3) each, and joint centres (4, 3)."""
    cython.declare(d=cython.int, k=cython.int)
    azimuth = s[_FAN] + s[0]
    if digit == 0:
        # The proximal phalanx in the metacarpal's axes: along it, and dorsal to it (that one has no third component).
        x, y, z = cos(s[3]) * cos(s[2]), -cos(s[3]) * sin(s[2]), sin(s[3])
        dorsal_x, dorsal_y = sin(s[2]), cos(s[2])
        on, over, half_on, half_over = cos(s[4]), sin(s[4]), cos(0.5 * s[4]), sin(0.5 * s[4])
        _place_axis(1.0, 0.0, 0.0, azimuth, s[1], s[_ROLL], bone[0])
        _place_axis(x, y, z, azimuth, s[1], s[_ROLL], bone[1])
        _place_axis(on * x - over * dorsal_x, on * y - over * dorsal_y, on * z, azimuth, s[1], s[_ROLL], bone[2])
        _place_axis(0.0, 1.0, 0.0, azimuth, s[1], s[_ROLL], normal[0])
        _place_axis(
            half_over * x + half_on * dorsal_x, half_over * y + half_on * dorsal_y, half_over * z, azimuth, s[1],
            s[_ROLL], normal[1],
        )  # fmt: skip
        _place_axis(over * x + on * dorsal_x, over * y + on * dorsal_y, over * z, azimuth, s[1], s[_ROLL], normal[2])
    else:
        # A finger bends in the plane of its azimuth. Discs over PIP and DIP stand square to the middle of two bones.
        proximal = s[1]
        middle = proximal + s[2]
        distal = middle + _DIP_PER_PIP * s[2] + s[3]
        _place_bone(proximal, azimuth, bone[0])
        _place_bone(middle, azimuth, bone[1])
        _place_bone(distal, azimuth, bone[2])
        _place_bone(0.5 * (proximal + middle) - M_PI_2, azimuth, normal[0])
        _place_bone(0.5 * (middle + distal) - M_PI_2, azimuth, normal[1])
        _place_bone(distal - M_PI_2, azimuth, normal[2])
    for k in range(3):
        joint[0, k] = root[k] + (s[_ROOT + k] if k < 2 else -s[_ROOT + k])
        for d in range(3):
            joint[d + 1, k] = joint[d, k] + s[_LENGTH + d] * bone[d, k]
            disc[d, k] = joint[d + 1, k] + s[_HEIGHT + d] * normal[d, k]


def place_digits(pose: Array, root_m: Array) -> tuple[Array, Array, Array, Array]:
    """
    Place bones, joints and discs of all digits.

    Parameters
    ----------
    pose : numpy.ndarray
        Slots and constants (5, 16).
    root_m : numpy.ndarray
        Discs (5, 3) under which the digits begin.

    Returns
    -------
    tuple of numpy.ndarray
        Directions of the bones (5, 3, 3), normals of the discs (5, 3, 3), joint centres (5, 4, 3) from the root's to
        the tip, and discs (5, 3, 3).
    """
    s: cython.const[double][:, ::1] = as_array(pose, "poses", (5, 16))
    root: cython.const[double][:, ::1] = as_array(root_m, "roots", (5, 3))
    out = np.empty((5, 3, 3)), np.empty((5, 3, 3)), np.empty((5, 4, 3)), np.empty((5, 3, 3))
    bone: double[:, :, ::1] = out[0]
    normal: double[:, :, ::1] = out[1]
    joint: double[:, :, ::1] = out[2]
    disc: double[:, :, ::1] = out[3]
    r: cython.int
    for r in range(5):
        _place_chain(r, s[r], root[r], bone[r], normal[r], joint[r], disc[r])
    return out


def place_discs(pose: Array, root_m: Array, digits: list[int]) -> Array:
    """Place the discs (R, S, 3, 3) of R ``digits`` in S poses (R, S, 16) of each, under ``root_m`` (R, 3)."""
    s: cython.const[double][:, :, ::1] = as_array(pose, "poses", (len(digits), pose.shape[1], 16))
    root: cython.const[double][:, ::1] = as_array(root_m, "roots", (len(digits), 3))
    out = np.empty((pose.shape[0], pose.shape[1], 3, 3))
    disc: double[:, :, :, ::1] = out
    joint: double[:, :, ::1] = np.empty((3, 4, 3))
    cython.declare(r=Py_ssize_t, i=Py_ssize_t)
    for r in range(s.shape[0]):
        digit: cython.int = digits[r]
        for i in range(s.shape[1]):
            _place_chain(digit, s[r, i], root[r], joint[0], joint[1], joint[2], disc[r, i])
    return out


def compute_digit_sigma_points(
    mean: Array, covariance: Array, root_m: Array, scale: float
) -> tuple[Array, Array, Array, Array, Array]:
    """
    Spread sigma points of the digits, and place their discs.

    The points stand along the columns of the Cholesky factor L of what bends the discs' places; the other constants go
    with each column as they are correlated with it, by L^-1 times their covariance with what bends.

    Parameters
    ----------
    mean, covariance : numpy.ndarray
        States (5, 21) and their covariances (5, 21, 21).
    root_m : numpy.ndarray
        Discs (5, 3) under which the digits begin.
    scale : float
        How many columns the points stand from the mean.

    Returns
    -------
    tuple of numpy.ndarray
        Discs (5, 13, 3, 3), the centre's first; L^-1 (5, 6, 6); by how much the other constants go with each column
        (5, 6, 10); derivative (5, 3, 3, 10) of the centre's discs by these; normals (5, 3, 3) of the discs there.

    Raises
    ------
    numpy.linalg.LinAlgError
        When a covariance is not positive definite.
    """
    state: cython.const[double][:, ::1] = as_array(mean, "states", (5, 21))
    wide: cython.const[double][:, :, ::1] = as_array(covariance, "covariances", (5, 21, 21))
    root: cython.const[double][:, ::1] = as_array(root_m, "roots", (5, 3))
    out = (
        np.empty((5, 13, 3, 3)), np.empty((5, 6, 6)), np.zeros((5, 6, 10)), np.zeros((5, 3, 3, 10)),
        np.empty((5, 3, 3)),
    )  # fmt: skip
    disc: double[:, :, :, ::1] = out[0]
    unroot: double[:, :, ::1] = out[1]
    along: double[:, :, ::1] = out[2]
    by_constants: double[:, :, :, ::1] = out[3]
    normal: double[:, :, ::1] = out[4]
    pose: cython.const[Py_ssize_t][::1] = POSE
    bent: cython.const[Py_ssize_t][::1] = BENT
    other: cython.const[Py_ssize_t][::1] = OTHER
    s: double[::1] = np.empty(16)
    moved: double[::1] = np.empty(16)
    bone: double[:, ::1] = np.empty((3, 3))
    facing: double[:, ::1] = np.empty((3, 3))
    joint: double[:, ::1] = np.empty((4, 3))
    block: double[:, ::1] = np.empty((6, 6))
    cross: double[:, ::1] = np.empty((6, 10))
    floor: double = FLOOR
    step: double = scale
    cython.declare(r=cython.int, i=Py_ssize_t, j=Py_ssize_t, p=Py_ssize_t)
    for r in range(5):
        for i in range(16):
            s[i] = state[r, pose[i]]
        _place_chain(r, s, root[r], bone, normal[r], joint, disc[r, 0])
        _fill_slopes(s, bone, normal[r], joint, disc[r, 0], by_constants[r])
        for i in range(6):
            for j in range(6):
                block[i, j] = wide[r, pose[bent[i]], pose[bent[j]]] + (floor if i == j else 0.0)
            for j in range(10):
                cross[i, j] = wide[r, pose[bent[i]], pose[other[j]]]
        if not inverse_root(block, unroot[r]):  # what is left in the upper half of the block is L'
            raise np.linalg.LinAlgError("Matrix is not positive definite")
        add_product(unroot[r], cross, along[r])
        for p in range(12):
            by = step if p < 6 else -step
            moved[:] = s
            for i in range(p % 6, 6):
                moved[bent[i]] += by * block[p % 6, i]
            for j in range(10):
                moved[other[j]] += by * along[r, p % 6, j]
            _place_chain(r, moved, root[r], bone, facing, joint, disc[r, 1 + p])
    return out


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _fill_slopes(
    s: cython.const[double][::1],
    bone: cython.const[double][:, ::1],
    normal: cython.const[double][:, ::1],
    joint: cython.const[double][:, ::1],
    disc: cython.const[double][:, ::1],
    out: double[:, :, ::1],
) -> cython.void:
    """Fill zeros with the derivative (3 discs, 3, 10) of the discs by the constants but for the roll."""
    cython.declare(d=cython.int, b=cython.int, k=cython.int)
    for d in range(3):
        for k in range(3):
            for b in range(d + 1):
                out[d, k, b] = bone[b, k]
            out[d, k, 4 + k] = 1.0 if k < 2 else -1.0
            out[d, k, 7 + d] = normal[d, k]
        out[d, 0, 3] = joint[0, 1] - disc[d, 1]  # the fan turns all about the root's normal
        out[d, 1, 3] = disc[d, 0] - joint[0, 0]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _compute_tail_ratio(z: double) -> double:
    """
    Compute phi(z) / Phi(z) of the normal density and its integral.

    Without underflow: Phi(z) = exp(-z^2/2) erfcx(-z / sqrt 2) / 2, with erfcx(x) = exp(x^2) erfc(x), for large x by its
    series.
    """
    x = M_SQRT1_2 * max(-z, -20.0)
    y = 1.0 / (x * x) if x != 0.0 else 0.0
    if x < 20.0:
        scaled = exp(x * x) * erfc(x)
    else:
        scaled = (1.0 - y * (0.5 - y * (0.75 - y * (1.875 - y * (6.5625 - y * 29.53125))))) / (x * _ROOT_PI)
    return 2.0 * M_SQRT1_2 / (_ROOT_PI * scaled)


def apply_limits(
    mixture: Any, limits: Array, direction: Array, soft_rad: float, near_sd: float
) -> tuple[Array, Array] | None:
    """
    Apply the limits of joints as soft constraints.

    The Gaussian of each angle is multiplied by a soft step at either limit. What that makes of its mean and variance is
    a measurement of the angle, and those of a digit act together with independent errors: with the angles' covariance
    S and their precisions P = D D, by M = I + D S D = L L'.

    Parameters
    ----------
    mixture : ModeMixture
        Digits (5, K, 21).
    limits : numpy.ndarray
        Lowest and highest (5, 5, 2) of the angles, rad.
    direction : numpy.ndarray
        Angle j of a digit is ``direction[digit, j] @ slots``, (5, 5, 5).
    soft_rad : float
        Standard deviation of a step.
    near_sd : float
        Standard deviations, of angle and step together, from which on a limit pulls.

    Returns
    -------
    tuple of numpy.ndarray, or None
        Means (5, K, 21) and covariances (5, K, 21, 21); None where no limit is near.
    """
    modes: Py_ssize_t = mixture.mean.shape[1]
    mean: cython.const[double][:, :, ::1] = as_array(mixture.mean, "states", (5, modes, 21))
    wide: cython.const[double][:, :, :, ::1] = as_array(mixture.covariance, "covariances", (5, modes, 21, 21))
    limit: cython.const[double][:, :, ::1] = as_array(limits, "limits", (5, 5, 2))
    turn: cython.const[double][:, :, ::1] = as_array(direction, "directions of angles", (5, 5, 5))
    soft2: double = soft_rad * soft_rad
    reach: double = near_sd
    across: double[:, ::1] = np.empty((5, 21))  # of the angles with all
    white: double[:, ::1] = np.empty((5, 21))
    shared: double[:, ::1] = np.empty((5, 5))  # of the angles, S
    matrix: double[:, ::1] = np.empty((5, 5))
    inverse: double[:, ::1] = np.empty((5, 5))
    root: double[::1] = np.empty(5)
    pull: double[::1] = np.empty(5)
    told: double[::1] = np.empty(5)
    out_mean: double[:, :, ::1]
    out_wide: double[:, :, :, ::1]
    out = None
    cython.declare(r=Py_ssize_t, k=Py_ssize_t, i=Py_ssize_t, j=Py_ssize_t, n=Py_ssize_t)
    for r in range(5):
        for k in range(modes):
            any_near: cython.bint = False
            for j in range(5):
                angle = 0.0
                variance = 0.0
                for i in range(5):
                    angle += turn[r, j, i] * mean[r, k, i]
                for n in range(21):
                    across[j, n] = 0.0
                    for i in range(5):
                        across[j, n] += turn[r, j, i] * wide[r, k, i, n]
                for i in range(5):
                    variance += turn[r, j, i] * across[j, i]
                root[j] = pull[j] = 0.0
                far = reach * sqrt(variance + soft2)
                if not (angle - far < limit[r, j, 0] or angle + far > limit[r, j, 1]) or not variance > 1e-9:
                    continue
                any_near = True
                # A step up at the lower limit, then, turned about, one at the upper.
                at, narrow = angle, variance
                for n in range(2):
                    if n == 1:
                        at = -at
                    total = narrow + soft2
                    z = (at - (limit[r, j, 0] if n == 0 else -limit[r, j, 1])) / sqrt(total)
                    ratio = _compute_tail_ratio(z)
                    at += narrow * ratio / sqrt(total)
                    narrow -= narrow * narrow * ratio * (z + ratio) / total
                precision = max(1.0 / narrow - 1.0 / variance, 0.0)
                root[j] = sqrt(precision)
                pull[j] = -at / narrow - angle / variance - precision * angle
            if not any_near:
                continue
            if out is None:
                out = np.array(mean), np.array(wide)
                out_mean, out_wide = out
            for i in range(5):
                for j in range(5):
                    shared[i, j] = 0.0
                    for n in range(5):
                        shared[i, j] += across[i, n] * turn[r, j, n]
                for j in range(5):
                    matrix[i, j] = root[i] * shared[i, j] * root[j] + (1.0 if i == j else 0.0)
            if not inverse_root(matrix, inverse):
                raise np.linalg.LinAlgError("Matrix is not positive definite")
            for i in range(5):
                told[i] = 0.0
                for n in range(21):
                    white[i, n] = 0.0
                for j in range(i + 1):
                    by = inverse[i, j] * root[j]
                    for n in range(21):
                        white[i, n] += by * across[j, n]
                    for n in range(5):
                        told[i] += by * shared[j, n] * pull[n]
            for i in range(5):
                for n in range(21):
                    out_mean[r, k, n] += pull[i] * across[i, n] - told[i] * white[i, n]
                    for j in range(21):
                        out_wide[r, k, n, j] -= white[i, n] * white[i, j]
    return out

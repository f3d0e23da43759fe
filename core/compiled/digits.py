"""Thumb and fingers as the filter has them: where discs lie, their sigma points and images, limits, joints as read.

Arrays lead with the digit (5), thumb first. A digit's state (21) holds five slots of its joints, their rates and
eleven constants of its anatomy. Slots and constants side by side are its pose (16): slots at 0 to 4, lengths of the
three bones at 5 to 7, fan at 8 and roll at 9, the root's place from the disc above it at 10 to 12, heights of the three
discs at 13 to 15. Slots of the thumb: CMC extension and abduction, MCP flexion and abduction, IP flexion; of a finger:
MCP abduction, MCP flexion, PIP flexion, DIP flexion beyond what PIP brings with it, and one that is not used. Metres in
the axes W of a right palm (ahead, aside, up), or in camera axes where it is said; radians.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython.cimports.carpus.core.compiled.small_matrices import add_product, inverse_root
from cython.cimports.libc.math import cos, erfc, exp, sin, sqrt
from numpy.typing import NDArray

from carpus.core.hand.kinematics import DIP_PER_PIP

FLOOR, NARROW2 = 1e-14, 1e-10
"""Variances that keep slots that do not move positive definite: in sigma points, and as they are read."""
DEPTH_STAYS_M = 0.0004
"""Error of a disc's depth that no averaging removes."""
ACROSS_M = 0.00015
"""So closely a disc holds its joints across the line of sight where errors stay."""
INHERITED = 0.25
"""Share of a joint's information that resists errors of its discs that stay."""
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
_TO_DIP = cython.declare(cython.double, DIP_PER_PIP)
_QUARTER = cython.declare(cython.double, 0.5 * np.pi)
_ROOT_HALF = cython.declare(cython.double, np.sqrt(0.5))
_ROOT_PI = cython.declare(cython.double, np.sqrt(np.pi))


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _place_axis(
    x: cython.double, y: cython.double, z: cython.double, azimuth: cython.double, abduction: cython.double,
    roll: cython.double, out: cython.double[::1],
) -> cython.void:  # fmt: skip
    """A direction of the thumb in W, from that along its metacarpal, dorsal to it, and along its flexion's axis."""
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
def _place_bone(pitch: cython.double, azimuth: cython.double, out: cython.double[::1]) -> cython.void:
    """A direction in W, ``pitch`` under the palm's plane."""
    out[0] = cos(pitch) * cos(azimuth)
    out[1] = cos(pitch) * sin(azimuth)
    out[2] = -sin(pitch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _lay(
    digit: cython.int,
    s: cython.const[cython.double][::1],
    root: cython.const[cython.double][::1],
    bone: cython.double[:, ::1],
    normal: cython.double[:, ::1],
    joint: cython.double[:, ::1],
    disc: cython.double[:, ::1],
) -> cython.void:
    """Of a digit with pose ``s``: directions of the bones, normals of the discs, (3, 3) each, joint centres (4, 3) from
    the root's to the tip, and discs (3, 3)."""
    d: cython.int
    k: cython.int
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
        distal = middle + _TO_DIP * s[2] + s[3]
        _place_bone(proximal, azimuth, bone[0])
        _place_bone(middle, azimuth, bone[1])
        _place_bone(distal, azimuth, bone[2])
        _place_bone(0.5 * (proximal + middle) - _QUARTER, azimuth, normal[0])
        _place_bone(0.5 * (middle + distal) - _QUARTER, azimuth, normal[1])
        _place_bone(distal - _QUARTER, azimuth, normal[2])
    for k in range(3):
        joint[0, k] = root[k] + (s[_ROOT + k] if k < 2 else -s[_ROOT + k])
        for d in range(3):
            joint[d + 1, k] = joint[d, k] + s[_LENGTH + d] * bone[d, k]
            disc[d, k] = joint[d + 1, k] + s[_HEIGHT + d] * normal[d, k]


def lay_out(pose: Array, root_m: Array) -> tuple[Array, Array, Array, Array]:
    """Directions of the bones (5, 3, 3), normals of the discs (5, 3, 3), joint centres (5, 4, 3) from the root's to the
    tip, and discs (5, 3, 3), for poses (5, 16); ``root_m`` (5, 3) discs under which the digits begin."""
    s: cython.const[cython.double][:, ::1] = np.ascontiguousarray(pose)
    root: cython.const[cython.double][:, ::1] = np.ascontiguousarray(root_m)
    if pose.shape != (5, 16) or root_m.shape != (5, 3):
        raise ValueError("poses are of size (5, 16), roots of size (5, 3)")
    out = np.empty((5, 3, 3)), np.empty((5, 3, 3)), np.empty((5, 4, 3)), np.empty((5, 3, 3))
    bone: cython.double[:, :, ::1] = out[0]
    normal: cython.double[:, :, ::1] = out[1]
    joint: cython.double[:, :, ::1] = out[2]
    disc: cython.double[:, :, ::1] = out[3]
    r: cython.int
    for r in range(5):
        _lay(r, s[r], root[r], bone[r], normal[r], joint[r], disc[r])
    return out


def lay_discs(pose: Array, root_m: Array, digits: list[int]) -> Array:
    """Discs (R, S, 3, 3) of some ``digits`` in S poses (R, S, 16) each, under ``root_m`` (R, 3)."""
    s: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(pose)
    root: cython.const[cython.double][:, ::1] = np.ascontiguousarray(root_m)
    if pose.shape[2] != 16 or root_m.shape != (len(digits), 3) or pose.shape[0] != len(digits):
        raise ValueError("poses are of size (R, S, 16), roots of size (R, 3)")
    out = np.empty((pose.shape[0], pose.shape[1], 3, 3))
    disc: cython.double[:, :, :, ::1] = out
    joint: cython.double[:, :, ::1] = np.empty((3, 4, 3))
    r: cython.Py_ssize_t
    i: cython.Py_ssize_t
    for r in range(s.shape[0]):
        digit: cython.int = digits[r]
        for i in range(s.shape[1]):
            _lay(digit, s[r, i], root[r], joint[0], joint[1], joint[2], disc[r, i])
    return out


def spread_points(
    mean: Array, covariance: Array, root_m: Array, scale: float
) -> tuple[Array, Array, Array, Array, Array]:
    """Sigma points of states (5, 21) with covariances (5, 21, 21), laid out as a ``DigitPoints`` has them.

    They stand ``scale`` along the columns of the Cholesky factor L of what bends the discs' places; the other constants
    go with each column as they are correlated with it, by L^-1 times their covariance with what bends.
    """
    state: cython.const[cython.double][:, ::1] = np.ascontiguousarray(mean)
    wide: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(covariance)
    root: cython.const[cython.double][:, ::1] = np.ascontiguousarray(root_m)
    if mean.shape != (5, 21) or covariance.shape != (5, 21, 21) or root_m.shape != (5, 3):
        raise ValueError("states are of size (5, 21), their covariances (5, 21, 21), roots (5, 3)")
    out = (
        np.empty((5, 13, 3, 3)), np.empty((5, 6, 6)), np.zeros((5, 6, 10)), np.zeros((5, 3, 3, 10)),
        np.empty((5, 3, 3)),
    )  # fmt: skip
    disc: cython.double[:, :, :, ::1] = out[0]
    unroot: cython.double[:, :, ::1] = out[1]
    along: cython.double[:, :, ::1] = out[2]
    by_constants: cython.double[:, :, :, ::1] = out[3]
    normal: cython.double[:, :, ::1] = out[4]
    pose: cython.const[cython.Py_ssize_t][::1] = POSE
    bent: cython.const[cython.Py_ssize_t][::1] = BENT
    other: cython.const[cython.Py_ssize_t][::1] = OTHER
    s: cython.double[::1] = np.empty(16)
    moved: cython.double[::1] = np.empty(16)
    bone: cython.double[:, ::1] = np.empty((3, 3))
    facing: cython.double[:, ::1] = np.empty((3, 3))
    joint: cython.double[:, ::1] = np.empty((4, 3))
    block: cython.double[:, ::1] = np.empty((6, 6))
    cross: cython.double[:, ::1] = np.empty((6, 10))
    floor: cython.double = FLOOR
    step: cython.double = scale
    r: cython.int
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    p: cython.Py_ssize_t
    for r in range(5):
        for i in range(16):
            s[i] = state[r, pose[i]]
        _lay(r, s, root[r], bone, normal[r], joint, disc[r, 0])
        _lay_slopes(s, bone, normal[r], joint, disc[r, 0], by_constants[r])
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
            _lay(r, moved, root[r], bone, facing, joint, disc[r, 1 + p])
    return out


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _lay_slopes(
    s: cython.const[cython.double][::1],
    bone: cython.const[cython.double][:, ::1],
    normal: cython.const[cython.double][:, ::1],
    joint: cython.const[cython.double][:, ::1],
    disc: cython.const[cython.double][:, ::1],
    out: cython.double[:, :, ::1],
) -> cython.void:
    """Derivative (3 discs, 3, 10) of the discs by the constants but for the roll, into zeros."""
    d: cython.int
    b: cython.int
    k: cython.int
    for d in range(3):
        for k in range(3):
            for b in range(d + 1):
                out[d, k, b] = bone[b, k]
            out[d, k, 4 + k] = 1.0 if k < 2 else -1.0
            out[d, k, 7 + d] = normal[d, k]
        out[d, 0, 3] = joint[0, 1] - disc[d, 1]  # the fan turns all about the root's normal
        out[d, 1, 3] = disc[d, 0] - joint[0, 0]


def linearised(points: Any, view: Any, weights: Any) -> tuple[Array, Array, Array, Array, Array, Array]:
    """What a camera sees of ``DigitPoints``, as statistical linear regression has it (Garcia-Fernandez 2015).

    Of the images u, v, z of three discs: value (5, 9), slope (5, 9, 21), covariance (5, 9, 9) of what is not linear,
    and of all; the discs (5, 3, 3) in camera axes, and derivative (5, 3, 3, 3) of the images by that. ``view`` a
    ``DigitView``, ``weights`` the points' ``Weights``.
    """
    disc: cython.const[cython.double][:, :, :, ::1] = np.ascontiguousarray(points.disc_m)
    unroot: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(points.unroot)
    along: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(points.along)
    by_constants: cython.const[cython.double][:, :, :, ::1] = np.ascontiguousarray(points.by_constants)
    wide: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(points.covariance)
    rotation: cython.const[cython.double][:, ::1] = np.ascontiguousarray(view.rotation)
    translation: cython.const[cython.double][::1] = np.ascontiguousarray(view.translation_m)
    if (
        points.disc_m.shape != (5, 13, 3, 3) or points.unroot.shape != (5, 6, 6) or points.along.shape != (5, 6, 10)
        or points.by_constants.shape != (5, 3, 3, 10) or points.covariance.shape != (5, 21, 21)
        or view.rotation.shape != (3, 3) or view.translation_m.shape != (3,)
    ):  # fmt: skip
        raise ValueError("points or view are not of their size")
    fx: cython.double = view.camera.fx_px
    fy: cython.double = view.camera.fy_px
    cx: cython.double = view.camera.cx_px
    cy: cython.double = view.camera.cy_px
    mean_middle: cython.double = weights.mean[0]
    mean_other: cython.double = weights.mean[1]
    spread_middle: cython.double = weights.covariance[0]
    spread_other: cython.double = weights.covariance[1]
    per_step: cython.double = 0.5 / weights.scale
    out = (
        np.zeros((5, 9)), np.zeros((5, 9, 21)), np.zeros((5, 9, 9)), np.empty((5, 9, 9)), np.empty((5, 3, 3)),
        np.zeros((5, 3, 3, 3)),
    )  # fmt: skip
    value: cython.double[:, ::1] = out[0]
    slope: cython.double[:, :, ::1] = out[1]
    error: cython.double[:, :, ::1] = out[2]
    spread: cython.double[:, :, ::1] = out[3]
    centre: cython.double[:, :, ::1] = out[4]
    by_place: cython.double[:, :, :, ::1] = out[5]
    pose: cython.const[cython.Py_ssize_t][::1] = POSE
    bent: cython.const[cython.Py_ssize_t][::1] = BENT
    other: cython.const[cython.Py_ssize_t][::1] = OTHER
    image: cython.double[:, ::1] = np.empty((13, 9))
    half: cython.double[:, ::1] = np.empty((9, 6))
    bend: cython.double[:, ::1] = np.empty((7, 9))
    by_other: cython.double[:, ::1] = np.empty((9, 10))
    by_bent: cython.double[:, ::1] = np.empty((9, 6))
    cross: cython.double[:, ::1] = np.empty((9, 21))
    turned: cython.double[:, ::1] = np.empty((21, 9))
    r: cython.int
    d: cython.int
    k: cython.int
    a: cython.Py_ssize_t
    b: cython.Py_ssize_t
    i: cython.Py_ssize_t
    p: cython.Py_ssize_t
    for r in range(5):
        for p in range(13):
            for d in range(3):
                x = _turned(rotation[0], disc[r, p, d]) + translation[0]
                y = _turned(rotation[1], disc[r, p, d]) + translation[1]
                z = _turned(rotation[2], disc[r, p, d]) + translation[2]
                image[p, 3 * d], image[p, 3 * d + 1], image[p, 3 * d + 2] = x * (fx / z) + cx, y * (fy / z) + cy, z
                if p == 0:
                    centre[r, d, 0], centre[r, d, 1], centre[r, d, 2] = x, y, z
                    by_place[r, d, 0, 0], by_place[r, d, 0, 2] = fx / z, -fx * x / (z * z)
                    by_place[r, d, 1, 1], by_place[r, d, 1, 2] = fy / z, -fy * y / (z * z)
                    by_place[r, d, 2, 2] = 1.0
        for a in range(9):
            value[r, a] = mean_middle * image[0, a]
            for p in range(1, 13):
                value[r, a] += mean_other * image[p, a]
            # The odd part of the spread is the slope along the root's columns; nothing linear follows the even part.
            for p in range(6):
                half[a, p] = (image[1 + p, a] - image[7 + p, a]) * per_step
                bend[p, a] = sqrt(2.0 * spread_other) * (0.5 * (image[1 + p, a] + image[7 + p, a]) - value[r, a])
            bend[6, a] = image[0, a] - value[r, a]
        for a in range(9):
            for b in range(9):
                error[r, a, b] = spread_middle * bend[6, a] * bend[6, b]
                for p in range(6):
                    error[r, a, b] += bend[p, a] * bend[p, b]
        # By the other constants as derived; what is left of each column is that of what bends, through L^-1.
        by_other[:] = 0.0
        for d in range(3):
            for k in range(3):
                for b in range(3):
                    by_w = 0.0
                    for i in range(3):
                        by_w += by_place[r, d, k, i] * rotation[i, b]
                    for i in range(10):
                        by_other[3 * d + k, i] += by_w * by_constants[r, d, b, i]
        by_bent[:] = 0.0
        for a in range(9):
            for p in range(6):
                for i in range(10):
                    half[a, p] -= along[r, p, i] * by_other[a, i]
        add_product(half, unroot[r], by_bent)
        for a in range(9):
            for i in range(6):
                slope[r, a, pose[bent[i]]] = by_bent[a, i]
            for i in range(10):
                slope[r, a, pose[other[i]]] = by_other[a, i]
        cross[:] = 0.0
        add_product(slope[r], wide[r], cross)
        for a in range(9):
            for i in range(21):
                turned[i, a] = slope[r, a, i]
        spread[r] = error[r]
        add_product(cross, turned, spread[r])
    return out


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _turned(row: cython.const[cython.double][::1], at: cython.const[cython.double][::1]) -> cython.double:
    return row[0] * at[0] + row[1] * at[1] + row[2] * at[2]


def inherited(covariance: Array, seat: Any, linearised: Any, normal: Array) -> Array:
    """Covariance (5, 5, 5) that the slots inherit from the turn of W and from depths that stay wrong.

    The slots answer to errors of the images as in a correction by them, with noise that averaging does not remove, and
    with a share of what is known of the joints, covariances (5, 21, 21), against it. What a depth moves a disc along
    its ``normal`` (5, 3, 3) is taken for height; what it moves it across, the joints take. ``seat`` is a ``Seat``,
    ``linearised`` how it shows the digits.
    """
    wide: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(covariance)
    facing: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(normal)
    slope: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(linearised.slope)
    centre: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(linearised.centre_m)
    by_place: cython.const[cython.double][:, :, :, ::1] = np.ascontiguousarray(linearised.by_place)
    root: cython.const[cython.double][:, ::1] = np.ascontiguousarray(seat.palm.disc_m)
    rotation: cython.const[cython.double][:, ::1] = np.ascontiguousarray(seat.view.rotation)
    translation: cython.const[cython.double][::1] = np.ascontiguousarray(seat.view.translation_m)
    turning: cython.const[cython.double][:, ::1] = np.ascontiguousarray(seat.turn_covariance)
    if (
        covariance.shape != (5, 21, 21) or normal.shape != (5, 3, 3) or linearised.slope.shape != (5, 9, 21)
        or linearised.centre_m.shape != (5, 3, 3) or linearised.by_place.shape != (5, 3, 3, 3)
        or seat.palm.disc_m.shape != (6, 3) or seat.view.rotation.shape != (3, 3)
        or seat.view.translation_m.shape != (3,) or seat.turn_covariance.shape != (3, 3)
    ):  # fmt: skip
        raise ValueError("digits, their images or their seat are not of their size")
    fx: cython.double = seat.view.camera.fx_px
    fy: cython.double = seat.view.camera.fy_px
    across_m: cython.double = ACROSS_M
    stays_m: cython.double = DEPTH_STAYS_M
    share: cython.double = INHERITED
    narrow2: cython.double = NARROW2
    out = np.zeros((5, 5, 5))
    found: cython.double[:, :, ::1] = out
    by_slot: cython.double[:, ::1] = np.empty((9, 5))
    by_error: cython.double[:, ::1] = np.empty((9, 4))  # a turn about each axis, and a depth
    told: cython.double[:, ::1] = np.empty((5, 6))
    half: cython.double[:, ::1] = np.empty((5, 6))
    matrix: cython.double[:, ::1] = np.empty((5, 5))
    inverse: cython.double[:, ::1] = np.empty((5, 5))
    root_m: cython.double[::1] = np.empty(3)
    lever: cython.double[::1] = np.empty(3)
    moved: cython.double[::1] = np.empty(3)
    r: cython.int
    d: cython.int
    k: cython.int
    a: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    for r in range(5):
        for k in range(3):
            root_m[k] = _turned(rotation[k], root[r + 1]) + translation[k]
        for d in range(3):
            z = centre[r, d, 2]
            along = _turned(rotation[2], facing[r, d])
            for k in range(3):
                lever[k] = root_m[k] - centre[r, d, k]
                moved[k] = (1.0 if k == 2 else 0.0) - along * _turned(rotation[k], facing[r, d])
            for k in range(3):
                unit = z / (fx * across_m) if k == 0 else z / (fy * across_m) if k == 1 else 1.0 / stays_m
                a = 3 * d + k
                e = by_place[r, d, k]
                for i in range(5):
                    by_slot[a, i] = slope[r, a, i] * unit
                by_error[a, 0] = (e[1] * lever[2] - e[2] * lever[1]) * unit
                by_error[a, 1] = (e[2] * lever[0] - e[0] * lever[2]) * unit
                by_error[a, 2] = (e[0] * lever[1] - e[1] * lever[0]) * unit
                by_error[a, 3] = _turned(e, moved) * stays_m * unit
        # M = H' H + share P^-1 with H in units of the noise; the slots answer by M^-1 H'.
        for i in range(5):
            for j in range(5):
                matrix[i, j] = wide[r, i, j] + (narrow2 if i == j else 0.0)
        if not inverse_root(matrix, inverse):
            raise np.linalg.LinAlgError("Matrix is not positive definite")
        for i in range(5):
            for j in range(5):
                matrix[i, j] = 0.0
                for a in range(5):
                    matrix[i, j] += share * inverse[a, i] * inverse[a, j]
                for a in range(9):
                    matrix[i, j] += by_slot[a, i] * by_slot[a, j]
            for j in range(6):
                told[i, j] = 0.0
            for a in range(9):  # by each turn, and by each disc's own depth
                for j in range(3):
                    told[i, j] += by_slot[a, i] * by_error[a, j]
                told[i, 3 + a // 3] += by_slot[a, i] * by_error[a, 3]
        if not inverse_root(matrix, inverse):
            raise np.linalg.LinAlgError("Matrix is not positive definite")
        half[:] = 0.0
        add_product(inverse, told, half)
        for i in range(5):
            for j in range(6):
                told[i, j] = 0.0
                for a in range(i, 5):
                    told[i, j] += inverse[a, i] * half[a, j]
        for i in range(5):
            for k in range(3):
                half[i, k] = told[i, 0] * turning[0, k] + told[i, 1] * turning[1, k] + told[i, 2] * turning[2, k]
                half[i, k + 3] = told[i, k + 3]
        for i in range(5):
            for j in range(5):
                for k in range(6):
                    found[r, i, j] += half[i, k] * told[j, k]
    return out


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _tail_ratio(z: cython.double) -> cython.double:
    """phi(z) / Phi(z) of the normal density and integral, without underflow: Phi(z) = exp(-z^2/2) erfcx(-z/sqrt 2) / 2,
    erfcx(x) = exp(x^2) erfc(x), for large x by its series."""
    x = _ROOT_HALF * max(-z, -20.0)
    y = 1.0 / (x * x) if x != 0.0 else 0.0
    if x < 20.0:
        scaled = exp(x * x) * erfc(x)
    else:
        scaled = (1.0 - y * (0.5 - y * (0.75 - y * (1.875 - y * (6.5625 - y * 29.53125))))) / (x * _ROOT_PI)
    return 2.0 * _ROOT_HALF / (_ROOT_PI * scaled)


def within_limits(
    mixture: Any, limits: Array, direction: Array, soft_rad: float, near_sd: float
) -> tuple[Array, Array] | None:
    """Means and covariances of a ``ModeMixture`` (5, K, 21) with the ``limits`` (5, 5, 2) of its angles heard; None
    where no limit is near. Angle j of a digit is ``direction[digit, j] @ slots``.

    The Gaussian of each angle is multiplied by a soft step of ``soft_rad`` at either limit; what that makes of its mean
    and variance is a measurement of the angle, and those of a digit with independent errors act together: with the
    angles' covariance S and their precisions P = D D, by M = I + D S D = L L'.
    """
    mean: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(mixture.mean)
    wide: cython.const[cython.double][:, :, :, ::1] = np.ascontiguousarray(mixture.covariance)
    limit: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(limits)
    turn: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(direction)
    modes: cython.Py_ssize_t = mean.shape[1]
    if (
        mixture.mean.shape != (5, modes, 21) or mixture.covariance.shape != (5, modes, 21, 21)
        or limits.shape != (5, 5, 2) or direction.shape != (5, 5, 5)
    ):  # fmt: skip
        raise ValueError("digits or limits are not of their size")
    soft2: cython.double = soft_rad * soft_rad
    reach: cython.double = near_sd
    across: cython.double[:, ::1] = np.empty((5, 21))  # of the angles with all
    white: cython.double[:, ::1] = np.empty((5, 21))
    shared: cython.double[:, ::1] = np.empty((5, 5))  # of the angles, S
    matrix: cython.double[:, ::1] = np.empty((5, 5))
    inverse: cython.double[:, ::1] = np.empty((5, 5))
    root: cython.double[::1] = np.empty(5)
    pull: cython.double[::1] = np.empty(5)
    told: cython.double[::1] = np.empty(5)
    out_mean: cython.double[:, :, ::1]
    out_wide: cython.double[:, :, :, ::1]
    out = None
    r: cython.Py_ssize_t
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    n: cython.Py_ssize_t
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
                    ratio = _tail_ratio(z)
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

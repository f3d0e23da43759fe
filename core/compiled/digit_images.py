"""What a camera sees of thumb and fingers, what their joints inherit of its errors, and what blobs measure of discs.

States and poses are those of ``digits.py``; images are u, v and z of the three discs of a digit in turn, in pixels and
metres. Metres in camera axes.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.carpus.core.compiled.small_matrices import add_product, inverse_root
from cython.cimports.libc.math import M_PI, NAN, isfinite, sqrt
from numpy.typing import NDArray

from carpus.core.compiled.digits import BENT, OTHER, POSE
from carpus.core.compiled.palm import as_array

NARROW2 = 1e-10
"""Variance that keeps the covariance of slots that do not move positive definite where joints are read."""
DEPTH_STAYS_M = 0.0004
"""Error of a disc's depth that no averaging removes."""
ACROSS_M = 0.00015
"""So closely a disc holds its joints across the line of sight where errors stay."""
INHERITED = 0.25
"""Share of a joint's information that resists errors of its discs that stay."""

Array = NDArray[np.float64]


def linearise_images(points: Any, view: Any, weights: Any) -> tuple[Array, Array, Array, Array, Array, Array]:
    """
    Linearise what the camera sees of the digits, by statistical linear regression (Garcia-Fernandez 2015).

    ``points`` are ``DigitSigmaPoints``, before the ``DigitView``, with the ``SigmaWeights``.

    Returns
    -------
    tuple of numpy.ndarray
        Images (5, 9), their slope (5, 9, 21), the covariance (5, 9, 9) of what is not linear, and of all; the discs
        (5, 3, 3), and the derivative (5, 3, 3, 3) of the images by that.
    """
    disc: cython.const[double][:, :, :, ::1] = as_array(points.disc_m, "discs", (5, 13, 3, 3))
    unroot: cython.const[double][:, :, ::1] = as_array(points.unroot, "inverse roots", (5, 6, 6))
    along: cython.const[double][:, :, ::1] = as_array(points.along, "what goes along", (5, 6, 10))
    by_constants: cython.const[double][:, :, :, ::1] = as_array(points.by_constants, "slopes", (5, 3, 3, 10))
    wide: cython.const[double][:, :, ::1] = as_array(points.covariance, "covariances", (5, 21, 21))
    rotation: cython.const[double][:, ::1] = as_array(view.rotation, "the view's rotation", (3, 3))
    translation: cython.const[double][::1] = as_array(view.translation_m, "the view's place", (3,))
    fx: double = view.camera.fx_px
    fy: double = view.camera.fy_px
    cx: double = view.camera.cx_px
    cy: double = view.camera.cy_px
    mean_middle: double = weights.mean[0]
    mean_other: double = weights.mean[1]
    spread_middle: double = weights.covariance[0]
    spread_other: double = weights.covariance[1]
    per_step: double = 0.5 / weights.scale
    out = (
        np.zeros((5, 9)), np.zeros((5, 9, 21)), np.zeros((5, 9, 9)), np.empty((5, 9, 9)), np.empty((5, 3, 3)),
        np.zeros((5, 3, 3, 3)),
    )  # fmt: skip
    value: double[:, ::1] = out[0]
    slope: double[:, :, ::1] = out[1]
    error: double[:, :, ::1] = out[2]
    spread: double[:, :, ::1] = out[3]
    centre: double[:, :, ::1] = out[4]
    by_place: double[:, :, :, ::1] = out[5]
    pose: cython.const[Py_ssize_t][::1] = POSE
    bent: cython.const[Py_ssize_t][::1] = BENT
    other: cython.const[Py_ssize_t][::1] = OTHER
    image: double[:, ::1] = np.empty((13, 9))
    at: double[::1] = np.empty(3)
    half: double[:, ::1] = np.empty((9, 6))
    bend: double[:, ::1] = np.empty((7, 9))
    by_other: double[:, ::1] = np.empty((9, 10))
    by_bent: double[:, ::1] = np.empty((9, 6))
    cross: double[:, ::1] = np.empty((9, 21))
    turned: double[:, ::1] = np.empty((21, 9))
    cython.declare(r=cython.int, d=cython.int, k=cython.int, a=Py_ssize_t, b=Py_ssize_t, i=Py_ssize_t, p=Py_ssize_t)
    for r in range(5):
        for p in range(13):
            for d in range(3):
                _place_in_camera(rotation, translation, disc[r, p, d], at)
                x, y, z = at[0], at[1], at[2]
                image[p, 3 * d], image[p, 3 * d + 1], image[p, 3 * d + 2] = x * (fx / z) + cx, y * (fy / z) + cy, z
                if p == 0:
                    centre[r, d] = at
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
@cython.nogil
@cython.exceptval(check=False)
def _place_in_camera(
    rotation: cython.const[double][:, ::1],
    translation: cython.const[double][::1],
    place: cython.const[double][::1],
    out: double[::1],
) -> cython.void:
    """Fill in R p + t."""
    k: cython.int
    for k in range(3):
        out[k] = rotation[k, 0] * place[0] + rotation[k, 1] * place[1] + rotation[k, 2] * place[2] + translation[k]


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _dot(row: cython.const[double][::1], at: cython.const[double][::1]) -> double:
    return row[0] * at[0] + row[1] * at[1] + row[2] * at[2]


def compute_inherited(covariance: Array, base: Any, linearised: Any, normal: Array) -> Array:
    """
    Compute what the slots inherit from the turn of W and from depths that stay wrong.

    The slots answer to errors of the images as in a correction by them, with noise that averaging does not remove, and
    with a share of what is known of the joints against it: by M^-1 H' with M = H' H + share P^-1, H in units of the
    noise. What a depth moves a disc along its normal is taken for height; what it moves it across, the joints take.

    The states have the ``covariance`` (5, 21, 21), the discs normals (5, 3, 3) in W; the palm is a ``DigitBase``, and
    the digits are seen as in a ``DigitLinearisation``.

    Returns
    -------
    numpy.ndarray
        Covariance (5, 5, 5).

    Raises
    ------
    numpy.linalg.LinAlgError
        When a covariance is not positive definite.
    """
    wide: cython.const[double][:, :, ::1] = as_array(covariance, "covariances", (5, 21, 21))
    facing: cython.const[double][:, :, ::1] = as_array(normal, "normals", (5, 3, 3))
    slope: cython.const[double][:, :, ::1] = as_array(linearised.slope, "slopes", (5, 9, 21))
    centre: cython.const[double][:, :, ::1] = as_array(linearised.centre_m, "discs", (5, 3, 3))
    by_place: cython.const[double][:, :, :, ::1] = as_array(linearised.by_place, "slopes by place", (5, 3, 3, 3))
    root: cython.const[double][:, ::1] = as_array(base.palm.disc_m, "the palm's discs", (6, 3))
    rotation: cython.const[double][:, ::1] = as_array(base.view.rotation, "the base's rotation", (3, 3))
    translation: cython.const[double][::1] = as_array(base.view.translation_m, "the base's place", (3,))
    turning: cython.const[double][:, ::1] = as_array(base.turn_covariance, "covariance of the base's turn", (3, 3))
    fx: double = base.view.camera.fx_px
    fy: double = base.view.camera.fy_px
    across_m: double = ACROSS_M
    stays_m: double = DEPTH_STAYS_M
    share: double = INHERITED
    narrow2: double = NARROW2
    out = np.zeros((5, 5, 5))
    found: double[:, :, ::1] = out
    by_slot: double[:, ::1] = np.empty((9, 5))
    by_error: double[:, ::1] = np.empty((9, 4))  # a turn about each axis, and a depth
    told: double[:, ::1] = np.empty((5, 6))
    half: double[:, ::1] = np.empty((5, 6))
    matrix: double[:, ::1] = np.empty((5, 5))
    inverse: double[:, ::1] = np.empty((5, 5))
    root_m: double[::1] = np.empty(3)
    lever: double[::1] = np.empty(3)
    moved: double[::1] = np.empty(3)
    cython.declare(r=cython.int, d=cython.int, k=cython.int, a=Py_ssize_t, i=Py_ssize_t, j=Py_ssize_t)
    for r in range(5):
        _place_in_camera(rotation, translation, root[r + 1], root_m)
        for d in range(3):
            z = centre[r, d, 2]
            along = _dot(rotation[2], facing[r, d])
            for k in range(3):
                lever[k] = root_m[k] - centre[r, d, k]
                moved[k] = (1.0 if k == 2 else 0.0) - along * _dot(rotation[k], facing[r, d])
            for k in range(3):
                unit = z / (fx * across_m) if k == 0 else z / (fy * across_m) if k == 1 else 1.0 / stays_m
                a = 3 * d + k
                for i in range(5):
                    by_slot[a, i] = slope[r, a, i] * unit
                x, y, w = by_place[r, d, k, 0], by_place[r, d, k, 1], by_place[r, d, k, 2]
                by_error[a, 0] = y * lever[2] - w * lever[1]
                by_error[a, 1] = w * lever[0] - x * lever[2]
                by_error[a, 2] = x * lever[1] - y * lever[0]
                by_error[a, 3] = _dot(by_place[r, d, k], moved) * stays_m
                for i in range(4):
                    by_error[a, i] *= unit
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


def measure_assigned_discs(
    scene: Any,
    names: Any,
    own_px2: float,
    radius_m: float,
    shade: tuple[float, float],
    crowd: tuple[float, float],
    merging: tuple[float, float, float],
) -> tuple[Array, Array]:
    """
    Measure the discs by the blobs that they were named for.

    Now that the disc is known, so is the size it would have if it were whole: what is missing of it lets its middle
    wander. Discs that all but touch the next one stray, as their edges run together.

    Parameters
    ----------
    scene : DigitScene
        What is expected of the discs, and the blobs.
    names : DigitAssignment
        Blob of every disc.
    own_px2 : float
        Variance of a middle.
    radius_m : float
        A large disc's.
    shade : tuple of float
        By how much of the radius a middle wanders for each share that is missing of the disc; below which share it is.
    crowd : tuple of float
        How many radii the next disc is nearer than; how many pixels it makes a middle stray.
    merging : tuple of float
        Chance to be seen from which on a disc's blob may hold a neighbour too; how much larger than the disc it is
        then; the share of :func:`_split_blob`.

    Returns
    -------
    tuple of numpy.ndarray
        Images (5, 9), NaN where there is none, and their variances (5, 9).
    """
    blobs: Py_ssize_t = len(scene.area_px)
    value: cython.const[double][:, ::1] = as_array(scene.blobs.value, "the blobs", (blobs, 3))
    noise: cython.const[double][:, ::1] = as_array(scene.blobs.variance, "the blobs' variances", (blobs, 3))
    area: cython.const[double][::1] = as_array(scene.area_px, "the blobs' areas", (blobs,))
    whole: cython.const[double][:, ::1] = as_array(scene.whole_px, "the discs' areas", (5, 3))
    disc_m2: cython.const[double][:, ::1] = as_array(scene.disc_m2, "the discs' sizes", (5, 3))
    visible: cython.const[double][:, ::1] = as_array(scene.visible, "chances", (5, 3))
    expected: cython.const[double][:, ::1] = as_array(scene.linearised.value, "images", (5, 9))
    spread: cython.const[double][:, :, ::1] = as_array(scene.image_covariance, "their covariance", (5, 9, 9))
    factor: cython.const[double][:, ::1] = as_array(scene.noise_factor, "factors", (5, 9))
    has_discs: cython.const[cython.uchar][::1] = as_array(scene.has_discs, "digits with discs", (5,)).view(np.uint8)
    assigned: cython.const[cython.longlong][:, ::1] = as_array(names.assigned, "names", (5, 3))
    with_depth: cython.const[cython.uchar][:, ::1] = as_array(names.with_depth, "depths believed", (5, 3)).view(
        np.uint8
    )
    fx: double = scene.view.camera.fx_px
    own2: double = own_px2
    reach: double = crowd[0] * radius_m * fx
    crowd2: double = crowd[1] * crowd[1]
    wanders: double = shade[0]
    whole_from: double = shade[1]
    was_seen: double = merging[0]
    merged_from: double = merging[1]
    merged_share: double = merging[2]
    out = np.empty((5, 9)), np.empty((5, 9))
    measured: double[:, ::1] = out[0]
    variance: double[:, ::1] = out[1]
    measured[:] = NAN
    variance[:] = 1.0
    alone: cython.uchar[::1] = np.empty(3, dtype=np.uint8)
    cython.declare(r=cython.int, d=cython.int, k=cython.int, other=cython.int, b=Py_ssize_t)
    for r in range(5):
        for d in range(3):
            b = assigned[r, d]
            alone[d] = b < 0 and has_discs[r]
            if b < 0:
                continue
            if b >= blobs:
                raise ValueError(f"names: blob {b} where {blobs} are there")
            for k in range(3):
                measured[r, 3 * d + k], variance[r, 3 * d + k] = value[b, k], noise[b, k]
            if not with_depth[r, d]:
                measured[r, 3 * d + 2] = NAN
            missing = max(whole_from - area[b] / whole[r, d], 0.0)
            stray2 = own2 + wanders * wanders * whole[r, d] / M_PI * missing * missing
            if (d > 0 and _is_near(expected[r], d - 1, d, reach)) or (d < 2 and _is_near(expected[r], d, d + 1, reach)):
                stray2 += crowd2
            if isfinite(stray2):
                variance[r, 3 * d] = variance[r, 3 * d + 1] = stray2
        for d in range(3):
            b = assigned[r, d]
            if b < 0 or not visible[r, d] >= was_seen:
                continue
            across = fx / expected[r, 3 * d + 2]
            face = disc_m2[r, d] * across * across
            other = d + 1 if d < 2 and alone[min(d + 1, 2)] else d - 1 if d > 0 and alone[max(d - 1, 0)] else -1
            if other >= 0 and area[b] > merged_from * face:
                alone[other] = False
                half = sqrt(face / M_PI) * min((area[b] - whole[r, d]) / face, 2.0)
                _split_blob(d, other, half, merged_share, across, expected[r], spread[r], measured[r], variance[r])
        for k in range(9):
            variance[r, k] *= factor[r, k]
    return out


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _is_near(at: cython.const[double][::1], d: cython.int, e: cython.int, reach: double) -> cython.bint:
    """Tell whether the middles of two discs are nearer than ``reach`` over the depth of the further out one."""
    u, v, far = at[3 * e] - at[3 * d], at[3 * e + 1] - at[3 * d + 1], reach / at[3 * e + 2]
    return u * u + v * v < far * far


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _split_blob(
    d: cython.int,
    other: cython.int,
    half: double,
    share: double,
    across: double,
    expected: cython.const[double][::1],
    spread: cython.const[double][:, ::1],
    measured: double[::1],
    variance: double[::1],
) -> cython.void:
    """
    Split a blob between its disc ``d`` and the ``other``, which has none (unresolved, Koch and van Keuk 1997).

    Two discs side by side cover more than one by as much of a disc as their middles lie apart in diameters, all but;
    either lies ``half`` of that from the centre, along the line on which they are expected, as surely as that is known,
    and give or take a ``share`` of it. The depth is of either. ``across`` pixels are a metre there.
    """
    cython.declare(k=cython.int, i=cython.int, j=cython.int)
    gap2: double = 0.0
    shift2: double = 0.0
    for k in range(2):
        i, j = 3 * d + k, 3 * other + k
        gap2 += (expected[j] - expected[i]) * (expected[j] - expected[i])
        gap2 += spread[i, i] + spread[j, j] - 2.0 * spread[i, j]
    by = half / sqrt(gap2)
    for k in range(2):
        shift = by * (expected[3 * other + k] - expected[3 * d + k])
        shift2 += shift * shift
    stray2 = half * half * (1.0 + share * share) - shift2
    for k in range(2):
        i, j = 3 * d + k, 3 * other + k
        shift = by * (expected[j] - expected[i])
        measured[j], variance[j] = measured[i] + shift, variance[i] + stray2
        measured[i], variance[i] = measured[i] - shift, variance[i] + stray2
    deep = 2.0 * half / across
    variance[3 * d + 2] += deep * deep

"""What is read off the palm in every frame: its angles, and how the fingers sit on it.

The wrist's axes are worked out for one shape of the palm, and turned with it to first order as it is refined.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.carpus.core.compiled.palm import fill_rotation, multiply, multiply_transposed
from cython.cimports.libc.math import asin, atan2, cos, fabs, hypot, sin, sqrt
from numpy.typing import NDArray

from carpus.core.compiled.palm import as_array

# Where the numbers stand in the palm's error vector.
SIZE = cython.declare(Py_ssize_t, 54)
POSITION = cython.declare(Py_ssize_t, 0)
TURN = cython.declare(Py_ssize_t, 6)
RATE = cython.declare(Py_ssize_t, 9)
SHAPE = cython.declare(Py_ssize_t, 12)
SKIN = cython.declare(Py_ssize_t, 33)
DISCS = cython.declare(Py_ssize_t, 6)
SHAPES = cython.declare(Py_ssize_t, 18)
READ = cython.declare(Py_ssize_t, 24)

Array = NDArray[np.float64]


def read_wrist(
    known: Any,
    disc_m: Array,
    estimate: Any,
    start: Array | None,
    stays: Array | None,
    sign: float,
    undefined_rad: float,
) -> tuple[Array, ...]:
    """
    Read the wrist's pose and clinical angles, and how surely they are known.

    In the axes A of the wrist the rotation is Q = A' R A. Errors d of the turn and s of the shape, by which the axes
    turn S s, make of it Q Exp(A' d + (1 - Q') S s). Angles are ZYX Euler angles psi, theta, phi with clinical signs
    (clinical reference 1.2).

    Parameters
    ----------
    known : WristAxes
        Axes as worked out, S, and the shape of which they are.
    disc_m : numpy.ndarray
        Calibrated places (6, 3) of the discs in the body.
    estimate : PalmEstimate
        The palm in W0.
    start : numpy.ndarray or None
        Rotation (3, 3) of the neutral pose, where it is not that of no angle.
    stays : numpy.ndarray or None
        Covariance (3, 3) of the turn in the body, besides.
    sign : float
        +1 for a right hand, -1 for a left one.
    undefined_rad : float
        Below this beta the ZYZ angles are not defined.

    Returns
    -------
    tuple of numpy.ndarray
        Axes (3, 3) as they are now; rotation (3, 3) as shown; place of the WRIST disc, rate, angles, their standard
        deviations and ZYZ angles, each (3,).
    """
    state: cython.const[double][::1] = as_array(estimate.value, "the palm's state", (SIZE,))
    rotation: cython.const[double][:, ::1] = as_array(estimate.rotation_w2_w0, "the palm's rotation", (3, 3))
    covariance: cython.const[double][:, ::1] = as_array(estimate.covariance, "the palm's covariance", (SIZE, SIZE))
    disc: cython.const[double][:, ::1] = as_array(disc_m, "places of the discs", (DISCS, 3))
    by_shape: cython.const[double][:, ::1] = as_array(known.sensitivity, "turns by the shape", (3, SHAPES))
    vectors, matrices = np.empty((5, 3)), np.empty((8, 3, 3))
    vector: double[:, ::1] = vectors
    matrix: double[:, :, ::1] = matrices
    axes: double[:, ::1] = matrix[0]
    shown: double[:, ::1] = matrix[1]
    back: double[:, ::1] = matrix[2]
    own: double[:, ::1] = matrix[3]
    spread: double[:, ::1] = matrix[4]
    half: double[:, ::1] = matrix[5]
    left: double[:, ::1] = matrix[6]
    by_turn: double[:, ::1] = matrix[7]
    turn_axes(known.axes, by_shape, known.shape_m, state, half, axes)
    for i in range(3):
        vector[0, i] = state[POSITION + i]
        vector[1, i] = 0.0
        for j in range(3):
            back[i, j] = axes[j, i]
            vector[0, i] += rotation[i, j] * (disc[0, j] + state[SHAPE + j] + state[SKIN + j])
            vector[1, i] += axes[j, i] * state[RATE + j]
    multiply(back, rotation, half)
    multiply(half, axes, own)
    for i in range(3):
        for j in range(3):
            left[i, j] = (1.0 if i == j else 0.0) - own[j, i]
    fill_turn_covariance(back, left, by_shape, covariance, spread)
    if stays is not None:
        further: cython.const[double][:, ::1] = as_array(stays, "what stays of the turn", (3, 3))
        multiply(back, further, half)
        multiply(half, axes, left)
        for i in range(3):
            for j in range(3):
                spread[i, j] += left[i, j]
    shown[:] = own
    if start is not None:
        neutral: cython.const[double][:, ::1] = as_array(start, "the neutral pose", (3, 3))
        multiply(neutral, own, shown)

    s: double = sign
    theta = asin(min(max(-shown[2, 0], -1.0), 1.0))
    phi = atan2(shown[2, 1], shown[2, 2])
    vector[2, 0], vector[2, 1], vector[2, 2] = s * atan2(shown[1, 0], shown[0, 0]), theta + 0.0, s * phi
    # Derivative of the angles by a small turn; it grows without bound as flexion nears 90 degrees.
    c = cos(theta)
    c = 1e-6 if fabs(c) < 1e-6 else c
    t = s * sin(theta) / c
    by_turn[0, 0], by_turn[0, 1], by_turn[0, 2] = 0.0, s * sin(phi) / c, s * cos(phi) / c
    by_turn[1, 0], by_turn[1, 1], by_turn[1, 2] = 0.0, cos(phi), -sin(phi)
    by_turn[2, 0], by_turn[2, 1], by_turn[2, 2] = s, sin(phi) * t, cos(phi) * t
    multiply(by_turn, spread, half)
    for i in range(3):
        variance = half[i, 0] * by_turn[i, 0] + half[i, 1] * by_turn[i, 1] + half[i, 2] * by_turn[i, 2]
        vector[3, i] = sqrt(0.0 if variance < 0.0 else variance)
    beta = atan2(hypot(shown[0, 2], shown[1, 2]), shown[2, 2])
    vector[4, :] = float("nan")
    if beta >= undefined_rad:
        vector[4, 0], vector[4, 1] = atan2(shown[1, 2], shown[0, 2]), beta
        vector[4, 2] = atan2(shown[2, 1], -shown[2, 0])
    return matrices[0], matrices[1], vectors[0], vectors[1], vectors[2], vectors[3], vectors[4]


def compute_finger_base(
    known: Any, disc_m: Array, estimate: Any, view: Any, sign: float, metacarpal_m: float
) -> tuple[Array, ...]:
    """
    Tell where the fingers sit on the palm as refined, and how the camera sees it.

    Ring and little metacarpal flex and take their fingers along; what else a disc moves is skin.

    Parameters
    ----------
    known : WristAxes
        Axes as worked out, how they turn by the shape, and the shape of which they are.
    disc_m : numpy.ndarray
        Calibrated places (6, 3) of the discs in the body.
    estimate : PalmEstimate
        The palm in W0.
    view : View
        The camera in W0.
    sign : float
        +1 for a right hand, -1 for a left one, whose axes are mirrored.
    metacarpal_m : float
        Length of the metacarpals that flex.

    Returns
    -------
    tuple of numpy.ndarray
        Axes (3, 3), origin (3,), discs (6, 3), flexion (5,) of the metacarpals and its standard deviation (5,) of a
        ``PalmGeometry``; from there into camera axes rotation (3, 3) and translation (3,); in camera axes the
        covariances of the body's place and turn (6, 6) and of the turn of the axes (3, 3).
    """
    state: cython.const[double][::1] = as_array(estimate.value, "the palm's state", (SIZE,))
    rotation: cython.const[double][:, ::1] = as_array(estimate.rotation_w2_w0, "the palm's rotation", (3, 3))
    covariance: cython.const[double][:, ::1] = as_array(estimate.covariance, "the palm's covariance", (SIZE, SIZE))
    disc: cython.const[double][:, ::1] = as_array(disc_m, "places of the discs", (DISCS, 3))
    by_shape: cython.const[double][:, ::1] = as_array(known.sensitivity, "turns by the shape", (3, SHAPES))
    w0_cam: cython.const[double][:, ::1] = as_array(view.rotation_w0_cam, "the camera's rotation", (3, 3))
    at: cython.const[double][::1] = as_array(view.translation_w0_cam_m, "the camera's place", (3,))
    matrices, places, cups, pose = np.empty((7, 3, 3)), np.empty((2 * DISCS + 1, 3)), np.zeros((2, 5)), np.zeros((6, 6))
    matrix: double[:, :, ::1] = matrices
    axes: double[:, ::1] = matrix[0]
    body_cam: double[:, ::1] = matrix[1]
    to_camera: double[:, ::1] = matrix[2]
    turned: double[:, ::1] = matrix[3]
    spread: double[:, ::1] = matrix[4]
    half: double[:, ::1] = matrix[5]
    still: double[:, ::1] = matrix[6]
    place: double[:, ::1] = places
    cup: double[:, ::1] = cups
    of_pose: double[:, ::1] = pose
    turn_axes(known.axes, by_shape, known.shape_m, state, half, axes)
    for i in range(3):
        for j in range(3):
            still[i, j] = 1.0 if i == j else 0.0
    fill_turn_covariance(still, axes, by_shape, covariance, spread)
    multiply(w0_cam, rotation, body_cam)
    multiply(body_cam, spread, half)
    multiply_transposed(half, body_cam, turned)
    if sign < 0.0:
        for i in range(3):
            axes[i, 1] = -axes[i, 1]
    multiply(body_cam, axes, to_camera)
    for d in range(DISCS):
        for i in range(3):
            place[d, i] = disc[d, i] + state[SHAPE + 3 * d + i]
            if d > 3 and i > 0:
                place[d, i] += state[SKIN + 3 * d + i]
    for d in range(DISCS):
        for i in range(3):
            place[DISCS + d, i] = 0.0
            for j in range(3):
                place[DISCS + d, i] += (place[d, j] - place[0, j]) * axes[j, i]
    for d in range(4, DISCS):
        i = SKIN + 3 * d + 2
        cup[0, d - 1], cup[1, d - 1] = -state[i] / metacarpal_m, sqrt(covariance[i, i]) / metacarpal_m
    for i in range(3):
        place[2 * DISCS, i] = at[i]
        for j in range(3):
            place[2 * DISCS, i] += body_cam[i, j] * place[0, j] + w0_cam[i, j] * state[POSITION + j]
    # Of place and turn, each by its own rotation into the camera: four blocks B P C'.
    for p in range(2):
        for q in range(2):
            for i in range(3):
                for j in range(3):
                    half[i, j] = covariance[POSITION + p * (TURN - POSITION) + i, POSITION + q * (TURN - POSITION) + j]
            multiply(body_cam if p else w0_cam, half, spread)
            multiply_transposed(spread, body_cam if q else w0_cam, half)
            for a in range(3):
                for b in range(3):
                    of_pose[3 * p + a, 3 * q + b] = half[a, b]
    body = matrices[0], places[0], places[DISCS : 2 * DISCS], cups[0], cups[1]
    return *body, matrices[2], places[2 * DISCS], pose, matrices[3]


@cython.cfunc
def turn_axes(
    axes_known: object,
    by_shape: cython.const[double][:, ::1],
    shape_known: object,
    state: cython.const[double][::1],
    turn: double[:, ::1],
    out: double[:, ::1],
) -> cython.void:
    """``out`` = axes Exp(S s) for a shape that has moved by s since they were worked out."""
    axes: cython.const[double][:, ::1] = as_array(axes_known, "the wrist's axes", (3, 3))
    about: cython.const[double][::1] = as_array(shape_known, "the shape of the axes", (SHAPES,))
    x: double = 0.0
    y: double = 0.0
    z: double = 0.0
    for i in range(SHAPES):
        moved = state[SHAPE + i] - about[i]
        x += by_shape[0, i] * moved
        y += by_shape[1, i] * moved
        z += by_shape[2, i] * moved
    fill_rotation(x, y, z, turn)
    multiply(axes, turn, out)


@cython.cfunc
def fill_turn_covariance(
    by_turn: double[:, ::1],
    by_axes: double[:, ::1],
    by_shape: cython.const[double][:, ::1],
    covariance: cython.const[double][:, ::1],
    out: double[:, ::1],
) -> cython.void:
    """``out`` = E P E' for a turn that is E d = ``by_turn`` d + ``by_axes`` S s, of errors d of the turn and s of the
    shape."""
    errors: double[:, ::1] = np.zeros((6, READ))
    for i in range(3):
        for j in range(3):
            errors[i, j] = by_turn[i, j]
        for j in range(SHAPES):
            for k in range(3):
                errors[i, SHAPE - TURN + j] += by_axes[i, k] * by_shape[k, j]
        for k in range(READ):
            for j in range(READ):
                errors[3 + i, j] += errors[i, k] * covariance[TURN + k, TURN + j]
    for i in range(3):
        for j in range(3):
            out[i, j] = 0.0
            for k in range(READ):
                out[i, j] += errors[3 + i, k] * errors[j, k]

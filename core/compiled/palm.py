"""The palm in every frame: how it moves, what the camera should see of it, and its errors reset after an update.

Symbols of the wrist paper: R rotation, omega angular velocity, P covariance of the error vector (54,), in the order of
``core/tracking/filter/palm_state.py``. An error d of the turn means R Exp(d). K modes, J of the soft tissue.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.carpus.core.compiled.small_matrices import add_product, inverse_root
from cython.cimports.libc.math import cos, exp, expm1, sin, sqrt
from numpy.typing import NDArray

from carpus.core.compiled.mixture import merge_modes

SIZE = cython.declare(Py_ssize_t, 54)
POSITION = cython.declare(Py_ssize_t, 0)
VELOCITY = cython.declare(Py_ssize_t, 3)
TURN = cython.declare(Py_ssize_t, 6)
RATE = cython.declare(Py_ssize_t, 9)
MOVING = cython.declare(Py_ssize_t, 12)
SHAPE = cython.declare(Py_ssize_t, 12)
SKIN = cython.declare(Py_ssize_t, 33)
SOFT = cython.declare(Py_ssize_t, 21)
DISCS = cython.declare(Py_ssize_t, 6)
SEEN = cython.declare(Py_ssize_t, 18)
HOME = cython.declare(Py_ssize_t, 0)
WRIST = cython.declare(Py_ssize_t, 5)
FLOOR = cython.declare(double, 1e-14)
_NONE = np.zeros((3, 3))


def compute_palm_transition(
    motion: Any, rate_rad_s: NDArray[np.float64], dt_s: float, unseen: NDArray[np.float64] | None, digits: Any
) -> tuple[NDArray[np.float64], ...]:
    """
    Step of the palm's errors: x <- F x + w with w ~ N(0, Q), and of its modes.

    Velocities stay, pushed all along the step by a white acceleration of density q: Q holds q dt^3 / 3, q dt^2 / 2 and
    q dt. A rate turns by Exp(omega dt), and errors of it by the right Jacobian of that. Skin and relief are
    Ornstein-Uhlenbeck processes. Modes of motion last ``motion.dwell_s``; those of the tissue go over at its ``rates``,
    from home (where joints are seen) or to the wrist's own mode the more, the faster the hand turns.

    Parameters
    ----------
    motion : PalmMotion
        Noise of the motion, of which every mode has its own scale, and modes of the tissue: those at rest, each scale
        times each resting tissue, before those of moving tissue.
    rate_rad_s : numpy.ndarray
        Angular velocity (3,) in W2.
    dt_s : float
        How long the step takes.
    unseen : numpy.ndarray or None
        Projection (3, 3) on the turns in W2 that nothing showed.
    digits : DigitSpeeds
        How fast thumb and fingers turn, rad/s.

    Returns
    -------
    tuple of numpy.ndarray
        F of the moving numbers (12, 12) and their Q in every mode (K, 12, 12); the share that each number keeps
        (K, 54); Q of skin and relief (K, 21, 21); probability (K, K) to go over from row to column mode; the rotation
        (3, 3) of the step.
    """
    noise, tissue = motion.noise, motion.tissue
    count: Py_ssize_t = tissue.count
    modes: Py_ssize_t = motion.modes
    rates: cython.const[double][:, ::1] = as_array(tissue.rates, "rates of the tissue", (count, count))
    omega: cython.const[double][::1] = as_array(rate_rad_s, "the palm's rate", (3,))
    lasts: cython.const[double][:, ::1] = as_array(tissue.lasts_s, "how long tissue lasts", (count, SOFT))
    rest: cython.const[double][:, :, ::1] = as_array(tissue.stationary, "scatter of tissue", (count, SOFT, SOFT))
    scale_of: cython.const[double][::1] = as_array(motion.scale_of, "the modes' scales", (modes,))
    tissue_of: cython.const[cython.longlong][::1] = motion.tissue_of
    hidden: cython.const[double][:, ::1] = as_array(_NONE if unseen is None else unseen, "turns not seen", (3, 3))
    dt: double = dt_s
    push: double = noise.acceleration_density
    turning: double = noise.turn_acceleration_density
    unseen_scale: double = motion.unseen_scale

    moving, turns = np.zeros((MOVING, MOVING)), np.empty((5, 3, 3))
    forward: double[:, ::1] = moving
    each: double[:, :, ::1] = turns
    turn: double[:, ::1] = each[0]
    jacobian: double[:, ::1] = each[1]
    square: double[:, ::1] = each[2]
    along: double[:, ::1] = each[3]
    along_square: double[:, ::1] = each[4]
    fill_rotation(omega[0] * dt, omega[1] * dt, omega[2] * dt, turn)
    fill_right_jacobian(omega[0] * dt, omega[1] * dt, omega[2] * dt, jacobian)
    for i in range(MOVING):
        forward[i, i] = 1.0
    for i in range(3):
        forward[POSITION + i, VELOCITY + i] = dt
        for j in range(3):
            forward[TURN + i, TURN + j] = turn[j, i]
            forward[TURN + i, RATE + j] = dt * jacobian[i, j]

    # Turning is pushed about the axes on the way, not about those at the end: Jr, as in F.
    turns[2] = turns[1] @ turns[1].T
    multiply(jacobian, hidden, along)
    turns[4] = turns[3] @ turns[3].T
    driven = np.zeros((modes, MOVING, MOVING))
    pushed: double[:, :, ::1] = driven
    for k in range(modes):
        by = scale_of[k] * scale_of[k]
        # How briskly a hand moves is told by what is seen of it, and says nothing of turns that are not.
        more = max(unseen_scale * unseen_scale - by, 0.0)
        for i in range(3):
            pushed[k, POSITION + i, POSITION + i] = by * push * dt * dt * dt / 3.0
            pushed[k, POSITION + i, VELOCITY + i] = pushed[k, VELOCITY + i, POSITION + i] = by * push * dt * dt / 2.0
            pushed[k, VELOCITY + i, VELOCITY + i] = by * push * dt
            for j in range(3):
                pushed[k, TURN + i, TURN + j] = turning * dt**3 / 3.0 * (by * square[i, j] + more * along_square[i, j])
                across = turning * dt * dt / 2.0 * (by * jacobian[i, j] + more * along[i, j])
                pushed[k, TURN + i, RATE + j] = pushed[k, RATE + j, TURN + i] = across
                pushed[k, RATE + i, RATE + j] = turning * dt * ((by if i == j else 0.0) + more * hidden[i, j])

    palm: double = sqrt(omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2])
    thumb: double = digits[0]
    fingers: double = digits[1]
    is_joint_driven: cython.bint = tissue.is_joint_driven
    per_rad: double = dt / tissue.lasts_rad if is_joint_driven else 0.0
    left, relaxing = np.empty((modes, SIZE)), np.empty((modes, SOFT, SOFT))
    kept: double[:, ::1] = left
    kept[:] = 1.0
    relaxed: double[:, :, ::1] = relaxing
    for k in range(modes):
        for i in range(SOFT):
            # The wrist's disc, the thumb's, the knuckles', and the relief over all of them.
            speed = palm if i < 3 else thumb if i < 6 else fingers if i < SEEN else max(palm, thumb, fingers)
            kept[k, SKIN + i] = exp(-dt / lasts[tissue_of[k], i] - per_rad * speed)
            for j in range(i + 1):
                relaxed[k, i, j] = relaxed[k, j, i] = rest[tissue_of[k], i, j] * (
                    1.0 - kept[k, SKIN + i] * kept[k, SKIN + j]
                )

    resting: Py_ssize_t = tissue.resting
    scales: Py_ssize_t = motion.scales.shape[0]
    leaving: double = tissue.leaving_per_rad
    pace: double = 0.2 + min(palm / tissue.turning_rad_s, 3.0)
    between: double[:, ::1] = np.empty((count, count))
    for i in range(count):
        total: double = 0.0
        for j in range(count):
            rate: double = rates[i, j]
            if is_joint_driven and i == HOME and j != HOME:
                rate += leaving * max(palm, thumb, fingers)
            elif not is_joint_driven and i < resting and j == WRIST:
                rate *= pace
            between[i, j] = rate
            total += rate
        leave = -expm1(-total * dt)
        for j in range(count):
            between[i, j] *= leave / max(total, 1e-12)
        between[i, i] = 1.0 - leave
    switching = np.empty((modes, modes))
    switch: double[:, ::1] = switching
    at_rest: Py_ssize_t = scales * resting
    leave = 1.0 - exp(-dt / motion.dwell_s)
    for i in range(modes):
        for j in range(modes):
            chance: double = between[tissue_of[i], tissue_of[j]]
            if j < at_rest <= i:
                chance /= scales
            elif j < at_rest and scales > 1:
                chance *= 1.0 - leave if i // resting == j // resting else leave / (scales - 1)
            switch[i, j] = chance
    return moving, driven, left, relaxing, switching, turns[0]


def predict_palm_measurement(estimate: Any, mixture: Any, view: Any, weights: Any) -> tuple[NDArray[np.float64], ...]:
    """
    Predict what the camera sees of the palm's discs: h linearised, by sigma points of the pose.

    The pose bends the pictures, so its slope is that of the sigma points, eq. (10) and (11) of the wrist paper, and
    what nothing linear can follow of them is noise; in the discs' places the slope is the derivative.

    The errors of the ``ModeMixture``, one chain of K modes, are from the ``PalmEstimate``, which has the covariance of
    all modes together. The discs lie as in the ``PalmView``; the 13 sigma points have the ``SigmaWeights``.

    Returns
    -------
    tuple of numpy.ndarray
        Pixels and depth that h expects of all discs, u, v, z in turn (1, 18); slope (1, 18, 54) by the error vector;
        covariance (1, 18, 18) of what that misses; of each disc the mean over all modes (6, 3) and its covariance
        (6, 3, 3).
    """
    modes: Py_ssize_t = mixture.mean.shape[1]
    state: cython.const[double][::1] = as_array(estimate.value, "the palm's state", (SIZE,))
    spread: cython.const[double][:, ::1] = as_array(estimate.covariance, "the palm's covariance", (SIZE, SIZE))
    rotation: cython.const[double][:, ::1] = as_array(estimate.rotation_w2_w0, "the palm's rotation", (3, 3))
    mean: cython.const[double][:, :, ::1] = as_array(mixture.mean, "means of the modes", (1, modes, SIZE))
    weight: cython.const[double][:, ::1] = as_array(mixture.probability, "the modes' probability", (1, modes))
    palm: cython.const[double][:, ::1] = as_array(view.palm_m, "places of the discs", (DISCS, 3))
    hidden: cython.const[double][:, ::1] = as_array(view.depth_bias, "what calibration hides", (DISCS, SEEN))
    w0_cam: cython.const[double][:, ::1] = as_array(view.rotation_w0_cam, "the camera's rotation", (3, 3))
    at: cython.const[double][::1] = as_array(view.translation_w0_cam_m, "the camera's place", (3,))
    of_middle: double = weights.mean[0]
    of_others: double = weights.mean[1]
    scatter_of_middle: double = weights.covariance[0]
    scatter_of_others: double = weights.covariance[1]
    scale: double = weights.scale
    camera = view.camera
    fx: double = camera.fx_px
    fy: double = camera.fy_px
    cx: double = camera.cx_px
    cy: double = camera.cy_px
    # Room to work in, few arrays cut up: to make one costs as much as to fill it.
    roots: double[:, :, ::1] = np.empty((2, 6, 6))
    root: double[:, ::1] = roots[0]
    unroot: double[:, ::1] = roots[1]
    turns: double[:, :, ::1] = np.empty((3, 3, 3))
    turned: double[:, ::1] = turns[0]
    there: double[:, ::1] = turns[1]
    in_camera: double[:, ::1] = turns[2]
    threes: double[:, ::1] = np.empty((DISCS + 2, 3))
    place: double[:, ::1] = threes[:DISCS]
    shift: double[::1] = threes[DISCS]
    turn: double[::1] = threes[DISCS + 1]
    images: double[:, ::1] = np.empty((25, SEEN))
    sigma: double[:, ::1] = images[:13]
    half: double[:, ::1] = images[13:19]
    bend: double[:, ::1] = images[19:]
    wide: double[:, ::1] = np.zeros((SEEN + 2, SIZE))
    cross: double[:, ::1] = wide[:SEEN]
    middle: double[::1] = wide[SEEN]
    unknown: double[::1] = wide[SEEN + 1]
    for i in range(6):
        for j in range(6):
            root[i, j] = spread[find_pose_row(i), find_pose_row(j)]
        root[i, i] += FLOOR
    if not inverse_root(root, unroot):
        raise np.linalg.LinAlgError("Matrix is not positive definite")

    # Pixel u, v and depth z of all discs from every sigma point: the middle one, those along each column of the root
    # and those against it.
    for d in range(DISCS):
        for i in range(3):
            place[d, i] = palm[d, i] + state[SHAPE + 3 * d + i] + state[SKIN + 3 * d + i]
    for p in range(12, -1, -1):
        column, reach = (p + 5) % 6, 0.0 if p == 0 else scale if p <= 6 else -scale
        for i in range(3):
            shift[i] = reach * root[column, i] if i >= column else 0.0
            turn[i] = reach * root[column, 3 + i] if 3 + i >= column else 0.0
        fill_rotation(turn[0], turn[1], turn[2], turned)
        multiply(rotation, turned, there)
        multiply(w0_cam, there, in_camera)
        for i in range(3):
            origin: double = at[i]
            for j in range(3):
                origin += w0_cam[i, j] * (state[POSITION + j] + shift[j])
            for d in range(DISCS):
                sigma[p, 3 * d + i] = (
                    origin
                    + in_camera[i, 0] * place[d, 0]
                    + in_camera[i, 1] * place[d, 1]
                    + in_camera[i, 2] * place[d, 2]
                )
        for d in range(DISCS):
            z = sigma[p, 3 * d + 2]
            sigma[p, 3 * d] = cx + fx * sigma[p, 3 * d] / z
            sigma[p, 3 * d + 1] = cy + fy * sigma[p, 3 * d + 1] / z

    value, slope, error = np.empty((1, SEEN)), np.zeros((1, SEEN, SIZE)), np.empty((1, SEEN, SEEN))
    line: double[::1] = value[0]
    h: double[:, ::1] = slope[0]
    missed: double[:, ::1] = error[0]
    for a in range(SEEN):
        line[a] = of_middle * sigma[0, a]
        for p in range(1, 13):
            line[a] += of_others * sigma[p, a]
        for p in range(6):
            half[p, a] = (sigma[1 + p, a] - sigma[7 + p, a]) * (0.5 / scale)
            bend[p, a] = 0.5 * (sigma[1 + p, a] + sigma[7 + p, a]) - line[a]
    for a in range(SEEN):
        for b in range(a + 1):
            total: double = scatter_of_middle * (sigma[0, a] - line[a]) * (sigma[0, b] - line[b])
            for p in range(6):
                total += 2.0 * scatter_of_others * bend[p, a] * bend[p, b]
            missed[a, b] = missed[b, a] = total
        for i in range(6):
            for p in range(i, 6):
                h[a, find_pose_row(i)] += half[p, a] * unroot[p, i]
    for d in range(DISCS):
        u, v, z = sigma[0, 3 * d], sigma[0, 3 * d + 1], sigma[0, 3 * d + 2]
        for j in range(3):
            b = SHAPE + 3 * d + j
            h[3 * d, b] = (fx * in_camera[0, j] + (cx - u) * in_camera[2, j]) / z
            h[3 * d + 1, b] = (fy * in_camera[1, j] + (cy - v) * in_camera[2, j]) / z
            h[3 * d + 2, b] = in_camera[2, j]
            for i in range(3):
                h[3 * d + i, SKIN + 3 * d + j] = h[3 * d + i, b]
        for j in range(SEEN):
            h[3 * d + 2, SHAPE + j] -= hidden[d, j]
            line[3 * d + 2] -= hidden[d, j] * state[SHAPE + j]

    # h is linear now: what it makes of the whole mixture's covariance is that of what it makes of the modes.
    expected, own = np.empty((DISCS, 3)), np.empty((DISCS, 3, 3))
    out_mean: double[:, ::1] = expected
    out_covariance: double[:, :, ::1] = own
    add_product(h, spread, cross)
    # Zeros, or NaN where any number is: the product passes over what h does not ask for.
    for i in range(SIZE):
        for j in range(SIZE):
            unknown[j] += 0.0 * spread[i, j]
    for p in range(modes):
        for j in range(SIZE):
            middle[j] += weight[0, p] * mean[0, p, j]
    for d in range(DISCS):
        for i in range(3):
            a = 3 * d + i
            out_mean[d, i] = line[a]
            for j in range(SIZE):
                out_mean[d, i] += h[a, j] * middle[j]
            for j in range(3):
                out_covariance[d, i, j] = missed[a, 3 * d + j]
            for b in range(SIZE):
                for j in range(3):
                    out_covariance[d, i, j] += unknown[b] + cross[a, b] * h[3 * d + j, b]
    return value, slope, error, expected, own


def reset_errors(nominal: Any, mixture: Any) -> tuple[NDArray[np.float64], ...]:
    """
    Move the nominal estimate to the mixture's mean, and tell the modes' errors from there.

    Errors of a ``ModeMixture`` of one chain are from the ``nominal`` ``PalmEstimate``. Turns are then measured from
    another rotation: log(Exp(-m) Exp(e)), to second order.

    Returns
    -------
    tuple of numpy.ndarray
        The estimate's rotation (3, 3), value (54,) and covariance (54, 54); mean (1, K, 54) of the modes' errors.
    """
    modes: Py_ssize_t = mixture.mean.shape[1]
    mean: cython.const[double][:, :, ::1] = as_array(mixture.mean, "means of the modes", (1, modes, SIZE))
    state: cython.const[double][::1] = as_array(nominal.value, "the palm's state", (SIZE,))
    rotation: cython.const[double][:, ::1] = as_array(nominal.rotation_w2_w0, "the palm's rotation", (3, 3))
    whole_mean, whole = merge_modes(mixture)
    middle: cython.const[double][::1] = whole_mean[0]
    turned, value, apart = np.empty((3, 3)), np.empty(SIZE), np.empty((1, modes, SIZE))
    there: double[:, ::1] = turned
    out_value: double[::1] = value
    off: double[:, :, ::1] = apart
    by: double[:, ::1] = np.empty((3, 3))
    x, y, z = middle[TURN], middle[TURN + 1], middle[TURN + 2]
    for k in range(modes):
        for i in range(SIZE):
            off[0, k, i] = mean[0, k, i] - middle[i]
        a, b, c = mean[0, k, TURN], mean[0, k, TURN + 1], mean[0, k, TURN + 2]
        off[0, k, TURN] += 0.5 * (b * z - c * y)
        off[0, k, TURN + 1] += 0.5 * (c * x - a * z)
        off[0, k, TURN + 2] += 0.5 * (a * y - b * x)
    for i in range(SIZE):
        out_value[i] = 0.0 if TURN <= i < RATE else state[i] + middle[i]
    fill_rotation(x, y, z, by)
    multiply(rotation, by, there)
    return turned, value, whole[0], apart


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def find_pose_row(i: Py_ssize_t) -> Py_ssize_t:
    """Where a number of the pose stands: those of the position, then those of the turn."""
    return POSITION + i if i < 3 else TURN + i - 3


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def fill_rotation(x: double, y: double, z: double, out: double[:, ::1]) -> cython.void:
    """Exp (3, 3) of one turn by Rodrigues' formula; its series near no turn."""
    angle2 = x * x + y * y + z * z
    a: double = 1.0 - angle2 / 6.0
    b: double = 0.5 - angle2 / 24.0
    if not angle2 < 1e-8:
        a, b = sin(sqrt(angle2)) / sqrt(angle2), (1.0 - cos(sqrt(angle2))) / angle2
    c = 1.0 - b * angle2
    out[0, 0], out[0, 1], out[0, 2] = c + b * x * x, b * x * y - a * z, b * x * z + a * y
    out[1, 0], out[1, 1], out[1, 2] = b * x * y + a * z, c + b * y * y, b * y * z - a * x
    out[2, 0], out[2, 1], out[2, 2] = b * x * z - a * y, b * y * z + a * x, c + b * z * z


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def fill_right_jacobian(x: double, y: double, z: double, out: double[:, ::1]) -> cython.void:
    """Jr (3, 3) of one turn, with Exp(t + d) = Exp(t) Exp(Jr d) to first order."""
    angle2 = x * x + y * y + z * z
    b: double = 0.5 - angle2 / 24.0
    c: double = 1.0 / 6.0 - angle2 / 120.0
    if not angle2 < 1e-6:
        angle = sqrt(angle2)
        b, c = (1.0 - cos(angle)) / angle2, (angle - sin(angle)) / (angle2 * angle)
    d = 1.0 - c * angle2
    out[0, 0], out[0, 1], out[0, 2] = d + c * x * x, c * x * y + b * z, c * x * z - b * y
    out[1, 0], out[1, 1], out[1, 2] = c * x * y - b * z, d + c * y * y, c * y * z + b * x
    out[2, 0], out[2, 1], out[2, 2] = c * x * z + b * y, c * y * z - b * x, d + c * z * z


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def multiply(a: cython.const[double][:, ::1], b: cython.const[double][:, ::1], out: double[:, ::1]) -> cython.void:
    """``out`` = A B of matrices (3, 3)."""
    for i in range(3):
        for j in range(3):
            out[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]


def as_array(array: NDArray[np.float64], name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return the array stored row by row; refuse another shape. Another type is refused by the view of it."""
    if array.shape != shape:
        raise ValueError(f"{name}: {array.shape} where {shape} is read")
    return np.ascontiguousarray(array)

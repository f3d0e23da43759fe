"""Point-to-plane fit of the palm's pose to depth readings of the back of the hand."""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.carpus.core.compiled.palm import fill_rotation, multiply
from cython.cimports.libc.math import fabs

from carpus.core.compiled.palm import as_array

# Where the numbers stand in the palm's error vector.
SIZE = cython.declare(Py_ssize_t, 54)
POSITION = cython.declare(Py_ssize_t, 0)
TURN = cython.declare(Py_ssize_t, 6)
BACK = cython.declare(Py_ssize_t, 30)
RELIEF = cython.declare(Py_ssize_t, 51)


def measure_surface(estimate: Any, samples: Any, surface: Any, view: Any, settings: Any) -> tuple[Any, ...] | None:
    """
    Measure the palm's error by a fit of its calibrated surface, from the estimate's pose on, by Gauss-Newton.

    A step solves J' W J s = J' W h for s, the turns about X and Y and the shift along Z about the surface's middle,
    with h the height of each reading over the plane of the node under it and W Huber's weight of it. Its covariance is
    that of s for readings that share their errors as far as their patches overlap, and what no number of readings takes
    away.

    The fit starts from the ``PalmEstimate``; it takes ``SurfaceSamples``, a ``DorsalSurface`` in the axes of the body,
    the ``PalmView`` and the ``SurfaceSettings``.

    Returns
    -------
    tuple of numpy.ndarray and int, or None
        Turns in rad and height in metres that the estimate is wrong by (3,), their covariance (3, 3), their slope
        (3, 54) by the palm's error vector, and how many readings were used; None where these are too few.
    """
    count: Py_ssize_t = len(samples.depth_m)
    rows: Py_ssize_t = surface.height_m.shape[0]
    columns: Py_ssize_t = surface.height_m.shape[1]
    pixel: cython.const[double][:, ::1] = as_array(samples.pixel, "the readings' pixels", (count, 2))
    depth: cython.const[double][::1] = as_array(samples.depth_m, "the readings' depths", (count,))
    state: cython.const[double][::1] = as_array(estimate.value, "the palm's state", (SIZE,))
    started: cython.const[double][:, ::1] = as_array(estimate.rotation_w2_w0, "the palm's rotation", (3, 3))
    in_w0: cython.const[double][:, ::1] = as_array(view.rotation_w0_cam, "the camera's rotation", (3, 3))
    origin: cython.const[double][::1] = as_array(view.translation_w0_cam_m, "the camera's place", (3,))
    nodes = (rows + 2) * (columns + 2)
    plane: cython.const[double][:, ::1] = as_array(surface.plane, "the planes of the surface", (nodes, 4))
    node: cython.const[double][:, ::1] = as_array(surface.to_node, "the grid of the surface", (4, 2))
    middle: cython.const[double][::1] = as_array(surface.middle_m, "the middle of the surface", (3,))
    camera, sensor = view.camera, view.camera.sensor
    fx: double = camera.fx_px
    fy: double = camera.fy_px
    cx: double = camera.cx_px
    cy: double = camera.cy_px
    huber: double = settings.huber_m
    most: double = settings.max_residual_m

    # Of each reading its place in W0, height and weight, and by how much turns and shifts bring it off its plane.
    place: double[:, ::1] = np.empty((count, 3))
    height: double[:, ::1] = np.empty((count, 2))
    by_pose: double[:, ::1] = np.empty((count, 6))
    for i in range(count):
        x = (pixel[i, 0] - cx) / fx * depth[i] - origin[0]
        y = (pixel[i, 1] - cy) / fy * depth[i] - origin[1]
        z = depth[i] - origin[2]
        for k in range(3):
            place[i, k] = x * in_w0[0, k] + y * in_w0[1, k] + z * in_w0[2, k]

    small: double[:, :, ::1] = np.zeros((5, 3, 3))
    rotation: double[:, ::1] = small[0]
    square: double[:, ::1] = small[1]
    inverse: double[:, ::1] = small[2]
    turn: double[:, ::1] = small[3]
    before: double[:, ::1] = small[4]
    vectors: double[:, ::1] = np.zeros((5, 3))
    position: double[::1] = vectors[0]
    side: double[::1] = vectors[1]
    row: double[::1] = vectors[2]
    turned: double[::1] = vectors[3]
    shifted: double[::1] = vectors[4]
    rotation[:] = started
    position[:] = state[POSITION : POSITION + 3]
    used: Py_ssize_t = 0
    for _ in range(settings.iterations):
        square[:] = 0.0
        side[:] = 0.0
        used = 0
        for i in range(count):
            ahead, across, up = place[i, 0] - position[0], place[i, 1] - position[1], place[i, 2] - position[2]
            x = rotation[0, 0] * ahead + rotation[1, 0] * across + rotation[2, 0] * up - middle[0]
            y = rotation[0, 1] * ahead + rotation[1, 1] * across + rotation[2, 1] * up - middle[1]
            z = rotation[0, 2] * ahead + rotation[1, 2] * across + rotation[2, 2] * up - middle[2]
            j = round_to_index(x * node[0, 1] + y * node[1, 1] + z * node[2, 1] + node[3, 1], rows + 1) * (columns + 2)
            j += round_to_index(x * node[0, 0] + y * node[1, 0] + z * node[2, 0] + node[3, 0], columns + 1)
            nx, ny, nz = plane[j, 0], plane[j, 1], plane[j, 2]
            h = x * nx + y * ny + z * nz + plane[j, 3]
            w = huber / max(fabs(h), huber) if fabs(h) < most else 0.0
            used += fabs(h) < most
            height[i, 0], height[i, 1] = h, w
            by_pose[i, 0], by_pose[i, 1], by_pose[i, 2] = y * nz - z * ny, z * nx - x * nz, x * ny - y * nx
            by_pose[i, 3], by_pose[i, 4], by_pose[i, 5] = nx, ny, nz
            row[0], row[1], row[2] = by_pose[i, 0], by_pose[i, 1], nz
            for a in range(3):
                side[a] += row[a] * w * h
                for b in range(3):
                    square[a, b] += row[a] * w * row[b]
        if used < settings.min_readings:
            return None
        invert(square, inverse)
        x = inverse[0, 0] * side[0] + inverse[0, 1] * side[1] + inverse[0, 2] * side[2]
        y = inverse[1, 0] * side[0] + inverse[1, 1] * side[1] + inverse[1, 2] * side[2]
        z = inverse[2, 0] * side[0] + inverse[2, 1] * side[1] + inverse[2, 2] * side[2]
        # The turn is about the middle of the surface; the estimate's error is a turn about its origin.
        row[0], row[1], row[2] = -y * middle[2], x * middle[2], z - x * middle[1] + y * middle[0]
        turned[0] += x
        turned[1] += y
        for k in range(3):
            shifted[k] += row[k]
            position[k] += rotation[k, 0] * row[0] + rotation[k, 1] * row[1] + rotation[k, 2] * row[2]
        fill_rotation(x, y, 0.0, turn)
        before[:] = rotation
        multiply(before, turn, rotation)

    # Of those used, J' W times turns and shifts of the whole pose, and J' W E W J for errors E of unit variance, of
    # which two readings share a part as far as their patches, as wide as one, overlap.
    patch: double = sensor.patch_px
    shared: double = 1.0 if sensor.averages else settings.shared_variance_share
    near: double[:, ::1] = np.empty((used, 5))  # u and v in patches, and the row of W J
    of_pose: double[:, ::1] = np.zeros((3, 6))
    alike: double[:, ::1] = square
    alike[:] = 0.0
    square_sum: double = 0.0
    weights: double = 0.0
    j = 0
    for i in range(count):
        h, w = height[i, 0], height[i, 1]
        square_sum += w * h * h
        weights += w
        if not fabs(h) < most:
            continue
        near[j, 0], near[j, 1] = pixel[i, 0] / patch, pixel[i, 1] / patch
        near[j, 2], near[j, 3], near[j, 4] = w * by_pose[i, 0], w * by_pose[i, 1], w * by_pose[i, 5]
        for a in range(3):
            for k in range(6):
                of_pose[a, k] += near[j, 2 + a] * by_pose[i, k]
        j += 1
    for i in range(used):
        side[0], side[1], side[2] = 0.5 * near[i, 2], 0.5 * near[i, 3], 0.5 * near[i, 4]
        for j in range(i):
            across, down = 1.0 - fabs(near[j, 0] - near[i, 0]), 1.0 - fabs(near[j, 1] - near[i, 1])
            if across > 0.0 and down > 0.0:
                for a in range(3):
                    side[a] += shared * across * down * near[j, 2 + a]
        for a in range(3):
            for b in range(3):
                alike[a, b] += near[i, 2 + a] * side[b] + side[a] * near[i, 2 + b]

    value, covariance, slope = np.empty(3), np.empty((3, 3)), np.zeros((3, SIZE))
    wrong: double[::1] = value
    spread: double[:, ::1] = covariance
    out: double[:, ::1] = slope
    ordered: double[::1] = np.sort(samples.depth_m)
    depth_m = 0.5 * (ordered[(count - 1) // 2] + ordered[count // 2])
    reading_m: double = sensor.reading.fixed_m + sensor.reading.square_per_m * depth_m * depth_m
    reading_m = max(settings.min_reading_sd_per_m * depth_m * depth_m, reading_m)
    scatter2: double = settings.persistence_factor * max(square_sum / weights, reading_m * reading_m)
    # What stays and changes slowly over the picture tilts and lifts the surface as a whole.
    stays_px: double = sensor.stays_px
    up_m: double = sensor.stays.fixed_m + sensor.stays.square_per_m * depth_m * depth_m if stays_px else 0.0
    turn_rad = up_m * fx / (max(stays_px, 1.0) * depth_m)
    turn_sd: double = settings.turn_sd_rad
    up_sd: double = settings.height_sd_m
    multiply(inverse, alike, before)
    multiply(before, inverse, spread)
    for a in range(3):
        for b in range(3):
            spread[a, b] *= scatter2
        spread[a, a] += turn_sd * turn_sd + turn_rad * turn_rad if a < 2 else up_sd * up_sd + up_m * up_m
    # Of the whole pose: a shift along the surface and a turn about its normal also move what is read.
    by_turn: double[:, ::1] = turn
    for a in range(3):
        for k in range(3):
            by_turn[a, k] = (
                inverse[a, 0] * of_pose[0, k] + inverse[a, 1] * of_pose[1, k] + inverse[a, 2] * of_pose[2, k]
            )
            row[k] = inverse[a, 0] * of_pose[0, 3 + k]
            row[k] += inverse[a, 1] * of_pose[1, 3 + k] + inverse[a, 2] * of_pose[2, 3 + k]
        out[a, TURN] = by_turn[a, 0] + middle[1] * row[2] - middle[2] * row[1]
        out[a, TURN + 1] = by_turn[a, 1] + middle[2] * row[0] - middle[0] * row[2]
        out[a, TURN + 2] = by_turn[a, 2] + middle[0] * row[1] - middle[1] * row[0]
        out[a, BACK + a] = out[a, RELIEF + a] = 1.0
        # What the estimate's own relief explains of it is no error.
        wrong[a] = -state[RELIEF + a] - state[BACK + a]
        for k in range(3):
            out[a, POSITION + k] = started[k, 0] * row[0] + started[k, 1] * row[1] + started[k, 2] * row[2]
            wrong[a] += row[k] * shifted[k] + out[a, TURN + k] * turned[k]
    return value, covariance, slope, used


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def round_to_index(x: double, most: Py_ssize_t) -> Py_ssize_t:
    """Whole number from 0 to ``most`` nearest to x; 0 where that is unknown."""
    return cython.cast(Py_ssize_t, min(x, most) + 0.5) if x > 0.0 else 0


@cython.cfunc
@cython.exceptval(check=True)
def invert(matrix: double[:, ::1], inverse: double[:, ::1]) -> cython.void:
    """Inverse (3, 3) by cofactors."""
    for i in range(3):
        for j in range(3):
            a, b, c, d = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
            inverse[j, i] = matrix[a, c] * matrix[b, d] - matrix[a, d] * matrix[b, c]
    size = matrix[0, 0] * inverse[0, 0] + matrix[0, 1] * inverse[1, 0] + matrix[0, 2] * inverse[2, 0]
    if size == 0.0:
        raise np.linalg.LinAlgError("Singular matrix")
    for i in range(3):
        for j in range(3):
            inverse[i, j] /= size

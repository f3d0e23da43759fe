"""Point-to-plane fit of the palm's pose to depth readings of the back of the hand, compiled."""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython.cimports.carpus.core.compiled.palm import fill_rotation, multiply
from cython.cimports.libc.math import fabs

from carpus.core.compiled.palm import given


def fit_surface(estimate: Any, samples: Any, surface: Any, view: Any, settings: Any) -> tuple[Any, ...] | None:
    """
    Fit the pose of the calibrated surface to readings, from the estimate's pose on, by Gauss-Newton.

    A step solves J' W J s = J' W h for s, the turns about X and Y and the shift along Z about the surface's middle,
    with h the height of each reading over the plane of the node under it and W Huber's weight of it.

    Parameters
    ----------
    estimate : PalmEstimate
        The palm in W0 from which the fit starts.
    samples : SurfaceSamples
        Pixels (S, 2) and depths (S,) in metres.
    surface : BackSurface
        Planes of the nodes, in the axes of the body.
    view : View
        Where the camera is in W0.
    settings : SurfaceSettings
        Steps, limits and the fewest readings.

    Returns
    -------
    tuple of numpy.ndarray, float and int, or None
        Turn (3,) in rad and shift (3,) in metres in the axes of the body; (J' W J)^-1 (3, 3); J' W times the turns and
        shifts of the whole pose (3, 6); J' W W J where every reading errs by itself (3, 3), and where they share as
        much of their errors as their patches overlap (3, 3); the weighted mean square of h in m^2; how many readings
        were used. None where these are too few.
    """
    count: cython.Py_ssize_t = len(samples.depth_m)
    rows: cython.Py_ssize_t = surface.height_m.shape[0]
    columns: cython.Py_ssize_t = surface.height_m.shape[1]
    pixel: cython.const[cython.double][:, ::1] = given(samples.pixel, "the readings' pixels", (count, 2))
    depth: cython.const[cython.double][::1] = given(samples.depth_m, "the readings' depths", (count,))
    rotation: cython.double[:, ::1] = given(estimate.rotation_w2_w0, "the palm's rotation", (3, 3)).copy()
    position: cython.double[::1] = given(estimate.position_m, "the palm's place", (3,)).copy()
    in_w0: cython.const[cython.double][:, ::1] = given(view.rotation_w0_cam, "the camera's rotation", (3, 3))
    origin: cython.const[cython.double][::1] = given(view.translation_w0_cam_m, "the camera's place", (3,))
    plane: cython.const[cython.double][:, ::1] = given(
        surface.plane, "the planes of the surface", ((rows + 2) * (columns + 2), 4)
    )
    node: cython.const[cython.double][:, ::1] = given(surface.to_node, "the grid of the surface", (4, 2))
    middle: cython.const[cython.double][::1] = given(surface.middle_m, "the middle of the surface", (3,))
    fx: cython.double = view.camera.fx_px
    fy: cython.double = view.camera.fy_px
    cx: cython.double = view.camera.cx_px
    cy: cython.double = view.camera.cy_px
    huber: cython.double = settings.huber_m
    most: cython.double = settings.most_m

    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    a: cython.Py_ssize_t
    b: cython.Py_ssize_t
    place: cython.double[:, ::1] = np.empty((count, 3))
    for i in range(count):
        x = (pixel[i, 0] - cx) / fx * depth[i] - origin[0]
        y = (pixel[i, 1] - cy) / fy * depth[i] - origin[1]
        z = depth[i] - origin[2]
        for k in range(3):
            place[i, k] = x * in_w0[0, k] + y * in_w0[1, k] + z * in_w0[2, k]

    height: cython.double[::1] = np.empty(count)
    weight: cython.double[::1] = np.empty(count)
    by_pose: cython.double[:, ::1] = np.empty((count, 6))
    turned, shifted, inverse = np.zeros(3), np.zeros(3), np.zeros((3, 3))
    total_turn: cython.double[::1] = turned
    total_shift: cython.double[::1] = shifted
    solved: cython.double[:, ::1] = inverse
    square: cython.double[:, ::1] = np.empty((3, 3))
    side: cython.double[::1] = np.empty(3)
    row: cython.double[::1] = np.empty(3)
    turn: cython.double[:, ::1] = np.empty((3, 3))
    before: cython.double[:, ::1] = np.empty((3, 3))
    used: cython.Py_ssize_t = 0
    for _ in range(settings.steps):
        square[:] = 0.0
        side[:] = 0.0
        used = 0
        for i in range(count):
            ahead, across, up = place[i, 0] - position[0], place[i, 1] - position[1], place[i, 2] - position[2]
            x = rotation[0, 0] * ahead + rotation[1, 0] * across + rotation[2, 0] * up - middle[0]
            y = rotation[0, 1] * ahead + rotation[1, 1] * across + rotation[2, 1] * up - middle[1]
            z = rotation[0, 2] * ahead + rotation[1, 2] * across + rotation[2, 2] * up - middle[2]
            j = nearest(x * node[0, 1] + y * node[1, 1] + z * node[2, 1] + node[3, 1], rows + 1) * (columns + 2)
            j += nearest(x * node[0, 0] + y * node[1, 0] + z * node[2, 0] + node[3, 0], columns + 1)
            nx, ny, nz = plane[j, 0], plane[j, 1], plane[j, 2]
            h = x * nx + y * ny + z * nz + plane[j, 3]
            w = huber / max(fabs(h), huber) if fabs(h) < most else 0.0
            used += fabs(h) < most
            height[i], weight[i] = h, w
            by_pose[i, 0], by_pose[i, 1], by_pose[i, 2] = y * nz - z * ny, z * nx - x * nz, x * ny - y * nx
            by_pose[i, 3], by_pose[i, 4], by_pose[i, 5] = nx, ny, nz
            row[0], row[1], row[2] = by_pose[i, 0], by_pose[i, 1], nz
            for a in range(3):
                side[a] += row[a] * w * h
                for b in range(3):
                    square[a, b] += row[a] * w * row[b]
        if used < settings.least:
            return None
        invert(square, solved)
        x = solved[0, 0] * side[0] + solved[0, 1] * side[1] + solved[0, 2] * side[2]
        y = solved[1, 0] * side[0] + solved[1, 1] * side[1] + solved[1, 2] * side[2]
        z = solved[2, 0] * side[0] + solved[2, 1] * side[1] + solved[2, 2] * side[2]
        total_turn[0] += x
        total_turn[1] += y
        # The turn is about the middle of the surface; the estimate's error is a turn about its origin.
        row[0], row[1], row[2] = -y * middle[2], x * middle[2], z - x * middle[1] + y * middle[0]
        for k in range(3):
            total_shift[k] += row[k]
            position[k] += rotation[k, 0] * row[0] + rotation[k, 1] * row[1] + rotation[k, 2] * row[2]
        fill_rotation(x, y, 0.0, turn)
        multiply(rotation, turn, before)
        rotation[:] = before

    patch: cython.double = view.camera.sensor.patch_px
    sums = np.zeros((3, 6)), np.zeros((3, 3)), np.zeros((3, 3))
    of_pose: cython.double[:, ::1] = sums[0]
    alone: cython.double[:, ::1] = sums[1]
    alike: cython.double[:, ::1] = sums[2]
    near: cython.double[:, ::1] = np.empty((5, used))  # u and v in patches, and the rows of J' W
    overlapping: cython.double[:, ::1] = np.zeros((3, used))
    spread2: cython.double = 0.0
    total: cython.double = 0.0
    j = 0
    for i in range(count):
        spread2 += weight[i] * height[i] * height[i]
        total += weight[i]
        if not fabs(height[i]) < most:
            continue
        near[0, j], near[1, j] = pixel[i, 0] / patch, pixel[i, 1] / patch
        for a in range(3):
            near[2 + a, j] = weight[i] * by_pose[i, a if a < 2 else 5]
            for k in range(6):
                of_pose[a, k] += near[2 + a, j] * by_pose[i, k]
        j += 1
    # Every pair once: a reading's patch, as wide as one, overlaps another's by (1 - |du|) (1 - |dv|).
    for i in range(used):
        for j in range(i):
            share = max(1.0 - fabs(near[0, j] - near[0, i]), 0.0) * max(1.0 - fabs(near[1, j] - near[1, i]), 0.0)
            overlapping[0, j] += share * near[2, i]
            overlapping[1, j] += share * near[3, i]
            overlapping[2, j] += share * near[4, i]
    for i in range(used):
        for a in range(3):
            for b in range(3):
                alone[a, b] += near[2 + a, i] * near[2 + b, i]
                alike[a, b] += near[2 + a, i] * overlapping[b, i] + overlapping[a, i] * near[2 + b, i]
    for a in range(3):
        for b in range(3):
            alike[a, b] += alone[a, b]
    return turned, shifted, inverse, *sums, spread2 / total, used


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def nearest(x: cython.double, most: cython.Py_ssize_t) -> cython.Py_ssize_t:
    """Whole number from 0 to ``most`` nearest to x; 0 where that is unknown."""
    return cython.cast(cython.Py_ssize_t, min(x, most) + 0.5) if x > 0.0 else 0


@cython.cfunc
@cython.exceptval(check=True)
def invert(matrix: cython.double[:, ::1], inverse: cython.double[:, ::1]) -> cython.void:
    """Inverse (3, 3) by cofactors."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
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

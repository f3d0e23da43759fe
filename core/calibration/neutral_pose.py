"""Pose of the neutral wrist frame before the camera by least squares: eq. (13) to (20) of the wrist paper."""

from __future__ import annotations

import numpy as np

from carpus.core import so3
from carpus.core.camera import Camera
from carpus.core.types import FloatArray

_ROUNDS = 30
_SETTLED = 1e-12


def pose_by_least_squares(
    camera: Camera,
    marker_w0_m: FloatArray,
    pixel: FloatArray,
    depth_m: FloatArray,
    rotation_w0_cam: FloatArray,
    translation_w0_cam_m: FloatArray,
    *,
    pixel_sd_px: float = 0.3,
    depth_sd_m: float = 0.002,
) -> tuple[FloatArray, FloatArray]:
    """Rotation (3, 3) and translation (3,) of g_w0c that best explain pixels (M, 2) and depths (M,).

    Minimises (15), pixels and depths weighed by their standard deviations; the linear step (19), (20) is
    repeated to convergence from the given start. Depths that are NaN are left out. The orientation is
    moved by a turn on the right, R Exp(d), not through angles.
    """
    rotation, translation = rotation_w0_cam, translation_w0_cam_m
    weight = np.concatenate((np.full(pixel.size, 1.0 / pixel_sd_px), np.full(depth_m.size, 1.0 / depth_sd_m)))
    measured = np.concatenate((pixel.ravel(), depth_m))
    used = np.isfinite(measured)
    for _ in range(_ROUNDS):
        point = marker_w0_m @ rotation.T + translation
        x, y, z = point.T
        predicted = np.concatenate((camera.project(point).ravel(), z))
        by_point = np.zeros((pixel.size + depth_m.size, 3))
        by_point[0 : pixel.size : 2, 0] = camera.fx_px / z
        by_point[0 : pixel.size : 2, 2] = -camera.fx_px * x / z**2
        by_point[1 : pixel.size : 2, 1] = camera.fy_px / z
        by_point[1 : pixel.size : 2, 2] = -camera.fy_px * y / z**2
        by_point[pixel.size :, 2] = 1.0
        marker = np.concatenate((np.repeat(np.arange(z.size), 2), np.arange(z.size)))
        by_turn = -rotation @ so3.skew(marker_w0_m)  # d(R Exp(d) m) / dd
        jacobian = np.concatenate((by_point, np.einsum("rk,rkj->rj", by_point, by_turn[marker])), axis=1)
        weighted = (jacobian * weight[:, None])[used]
        step = np.linalg.pinv(weighted) @ (weight * (measured - predicted))[used]
        translation = translation + step[:3]
        rotation = rotation @ so3.exp(step[3:])
        if float(step @ step) < _SETTLED**2:
            break
    return rotation, translation

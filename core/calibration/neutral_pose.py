"""Neutral pose of W0 in the camera by least squares: eq. (13) to (20) of the wrist paper."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.types import FloatArray

_MAX_ITERATIONS = 30
_CONVERGED_STEP = 1e-12
PIXEL_SD_PX, DEPTH_SD_M = 0.3, 0.002
"""Standard deviations of a marker's centre and of its depth, which weigh one against the other."""


def estimate_neutral_pose(
    camera: Camera,
    marker_w0_m: FloatArray,
    pixel: FloatArray,
    depth_m: FloatArray,
    rotation_w0_cam: FloatArray,
    translation_w0_cam_m: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Estimate rotation (3, 3) and translation (3,) of g_w0c from pixels and depths.

    Minimises (15), weighted by the standard deviations; the linear step (19), (20) is repeated until it converges. The
    orientation is updated on the right, R Exp(d). The markers are (M, 3) in W0, ``pixel`` (M, 2) undistorted,
    ``depth_m`` (M,) with NaN where unknown; a rotation and translation to start from are given.
    """
    rotation, translation = rotation_w0_cam, translation_w0_cam_m
    weight = np.concatenate((np.full(pixel.size, 1.0 / PIXEL_SD_PX), np.full(depth_m.size, 1.0 / DEPTH_SD_M)))
    measured = np.concatenate((pixel.ravel(), depth_m))
    used = np.isfinite(measured)
    for _ in range(_MAX_ITERATIONS):
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
        if float(step @ step) < _CONVERGED_STEP**2:
            break
    return rotation, translation


TOWARDS_CAMERA = np.array([0.0, 0.0, -1.0])


def marker_positions_cam_m(calibration: Calibration) -> FloatArray:
    """Return the measured markers (M, 3) in the camera, NaN where the depth is unknown."""
    return np.asarray(
        calibration.marker_position_w0_m @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m
    )


def with_w0_from_markers(calibration: Calibration) -> Calibration:
    """Rebuild W0 from the measured markers (reference 1.1), as all filters but the first use it."""
    disc_cam_m = marker_positions_cam_m(calibration)
    palm_cam_m = disc_cam_m[list(calibration.clicks.protocol.palm)]
    return with_w0_pose(calibration, disc_cam_m, wrist_axes(palm_cam_m, TOWARDS_CAMERA), palm_cam_m[0])


def with_w0_pose(
    calibration: Calibration, marker_cam_m: FloatArray, rotation: FloatArray, translation: FloatArray
) -> Calibration:
    """Move W0 to another pose; the markers (M, 3) keep their place in space."""
    turn = rotation.T @ calibration.rotation_w0_cam
    return replace(
        calibration,
        marker_position_w0_m=(marker_cam_m - translation) @ rotation,
        rotation_w0_cam=rotation,
        translation_w0_cam_m=translation,
        marker_covariance_w0_m2=turn @ calibration.marker_covariance_w0_m2 @ turn.T,
    )

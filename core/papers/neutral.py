"""Where the papers' wrist frame W0 lies before the camera: (13) to (20) of the wrist paper, on the palm as modelled.

Pixels and depths of (15) have no common unit in the papers; they are weighed by what they are known to.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.calibration.neutral_pose import pose_by_least_squares
from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.hand.wrist_frame import wrist_axes
from carpus.core.papers.chain import PalmModel, discs_cam_m, palm_modelled
from carpus.core.types import FloatArray

_TOWARDS_CAMERA = np.array([0.0, 0.0, -1.0])


def as_written(calibration: Calibration, camera: Camera, palm: PalmModel) -> Calibration:
    """The calibration with g_w0c of the palm as modelled; the measured discs stay where they are in space."""
    disc_cam_m = discs_cam_m(calibration)
    palm_cam_m = disc_cam_m[list(calibration.clicks.protocol.palm)]
    axes = wrist_axes(palm_cam_m, _TOWARDS_CAMERA)
    model_m = palm_modelled((palm_cam_m - palm_cam_m[0]) @ axes, palm)
    pixel, depth_m = camera.project(palm_cam_m), palm_cam_m[:, 2]
    rotation, translation = pose_by_least_squares(camera, model_m, pixel, depth_m, axes, palm_cam_m[0])
    return _seen_from(calibration, disc_cam_m, rotation, translation)


def by_the_discs(calibration: Calibration) -> Calibration:
    """The calibration with W0 built from the measured discs again (reference 1.1), as every other filter has it."""
    disc_cam_m = discs_cam_m(calibration)
    palm_cam_m = disc_cam_m[list(calibration.clicks.protocol.palm)]
    return _seen_from(calibration, disc_cam_m, wrist_axes(palm_cam_m, _TOWARDS_CAMERA), palm_cam_m[0])


def _seen_from(
    calibration: Calibration, disc_cam_m: FloatArray, rotation: FloatArray, translation: FloatArray
) -> Calibration:
    turn = rotation.T @ calibration.rotation_w0_cam
    return replace(
        calibration,
        marker_position_w0_m=(disc_cam_m - translation) @ rotation,
        rotation_w0_cam=rotation,
        translation_w0_cam_m=translation,
        marker_covariance_w0_m2=turn @ calibration.marker_covariance_w0_m2 @ turn.T,
    )

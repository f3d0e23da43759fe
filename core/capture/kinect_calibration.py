"""The calibration that lies in a recording of an Azure Kinect or Femto: both lenses, and how the cameras stand."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from carpus.core.camera import Camera
from carpus.core.types import FloatArray

DEPTH_WINDOWS_PX: Mapping[tuple[int, int], tuple[int, int, int]] = {
    (640, 576): (1024, 192, 180),
    (320, 288): (512, 96, 90),
    (1024, 1024): (1024, 0, 0),
    (512, 512): (512, 0, 0),
}
"""Of each size of depth picture: the side of the whole sensor in its pixels, and where the picture begins on it."""
_PURPOSES = {"color": "CALIBRATION_CameraPurposePhotoVideo", "depth": "CALIBRATION_CameraPurposeDepth"}
_MODEL = "CALIBRATION_LensDistortionModelBrownConrady"
_VALUES = 14
_HIDDEN_SHARE = 0.125
"""Of the height of the whole colour sensor (4:3), above and below a picture of 16:9."""


@dataclass(frozen=True, slots=True)
class KinectCalibration:
    """Both cameras for pictures of one size each; a point p of the depth camera's axes is ``rotation`` p +
    ``translation_m`` in those of the colour camera."""

    color: Camera
    depth: Camera
    rotation: FloatArray
    translation_m: FloatArray


def read_calibration(text: bytes, color_size_px: tuple[int, int], depth_size_px: tuple[int, int]) -> KinectCalibration:
    """The calibration as the maker stores it (JSON), for pictures of these sizes. Raises ValueError with what is wrong.

    The maker's figures are shares of the whole sensor's sides; its pixels begin at 0, so their middles lie at 0.5.
    """
    if depth_size_px not in DEPTH_WINDOWS_PX:
        raise ValueError("depth pictures of {}x{}".format(*depth_size_px))
    width, height = color_size_px
    if width * 3 == height * 4:
        top, whole_height = 0.0, float(height)
    elif width * 9 == height * 16:
        whole_height = height / (1.0 - 2.0 * _HIDDEN_SHARE)
        top = whole_height * _HIDDEN_SHARE
    else:
        raise ValueError(f"colour pictures of {width}x{height}")
    side, left, above = DEPTH_WINDOWS_PX[depth_size_px]
    try:
        told = json.loads(text.decode("utf-8", errors="replace").rstrip("\0"))["CalibrationInformation"]["Cameras"]
        cameras = {each["Purpose"]: each for each in told}
        color, depth = (cameras[_PURPOSES[name]] for name in ("color", "depth"))
        lenses = (
            _camera(color, color_size_px, (float(width), whole_height), (0.0, top)),
            _camera(depth, depth_size_px, (float(side), float(side)), (float(left), float(above))),
        )
        (turn, shift_m), (depth_turn, depth_shift_m) = _pose(color), _pose(depth)
    except (KeyError, TypeError, IndexError, ValueError, RecursionError) as cause:
        raise ValueError("its calibration is not in the maker's form") from cause
    # each pose leads from common axes into a camera's
    rotation = turn @ depth_turn.T
    return KinectCalibration(*lenses, rotation, shift_m - rotation @ depth_shift_m)


def _camera(
    told: Any, size_px: tuple[int, int], whole_px: tuple[float, float], corner_px: tuple[float, float]
) -> Camera:
    intrinsics = told["Intrinsics"]
    if intrinsics["ModelType"] != _MODEL:
        raise ValueError("another model of the lens")
    values = [float(value) for value in intrinsics["ModelParameters"][:_VALUES]]
    cx, cy, fx, fy, k1, k2, k3, k4, k5, k6, *_, p2, p1 = values
    if len(values) != _VALUES or not all(map(math.isfinite, values)) or min(fx, fy) <= 0.0:
        raise ValueError("no lens")
    return Camera(
        fx * whole_px[0],
        fy * whole_px[1],
        cx * whole_px[0] - corner_px[0] - 0.5,
        cy * whole_px[1] - corner_px[1] - 0.5,
        *size_px,
        (k1, k2, p1, p2, k3, k4, k5, k6),
        origin="factory",
        distortion_model="rational_polynomial",
    )


def _pose(told: Any) -> tuple[FloatArray, FloatArray]:
    rotation = np.array(told["Rt"]["Rotation"], dtype=np.float64).reshape(3, 3)
    translation_m = np.array(told["Rt"]["Translation"], dtype=np.float64).reshape(3)
    off = np.abs(rotation @ rotation.T - np.eye(3)).max()
    if not off < 1e-2 or not np.abs(translation_m).max() < 1.0:
        raise ValueError("no pose")
    return rotation, translation_m

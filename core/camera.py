"""The pinhole camera: intrinsics, projection, back-projection."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.depth_sensor import ASSUMED_SENSOR, DepthSensor
from carpus.core.types import FloatArray


@dataclass(frozen=True, slots=True)
class Camera:
    """Intrinsics of the colour camera in pixels; ``distortion`` is plumb_bob (k1, k2, p1, p2, k3)."""

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    width_px: int = 640
    height_px: int = 480
    distortion: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    origin: str = "default"
    """Where the numbers come from: ``file``, ``calibration`` (kept for this camera), ``driver`` or ``default``."""
    sensor: DepthSensor = ASSUMED_SENSOR
    """What its depth is worth."""

    @property
    def matrix(self) -> FloatArray:
        """Camera matrix K, shape (3, 3)."""
        return np.array([[self.fx_px, 0.0, self.cx_px], [0.0, self.fy_px, self.cy_px], [0.0, 0.0, 1.0]])

    @property
    def is_distorted(self) -> bool:
        """Whether any distortion coefficient differs from zero."""
        return any(self.distortion)

    def project(self, point_cam_m: FloatArray) -> FloatArray:
        """Undistorted pixels (..., 2) of points (..., 3) in camera axes; eq. (2) of the wrist paper.

        >>> Camera(525.0, 525.0, 319.5, 239.5).project(np.array([0.0, 0.0, 0.7]))
        array([319.5, 239.5])
        """
        z = point_cam_m[..., 2]
        u = point_cam_m[..., 0] / z
        v = point_cam_m[..., 1] / z
        return np.stack((self.fx_px * u + self.cx_px, self.fy_px * v + self.cy_px), axis=-1)

    def back_project(self, pixel: FloatArray, depth_m: FloatArray) -> FloatArray:
        """Points (..., 3) in camera axes, metres, of undistorted pixels (..., 2) at depths (...)."""
        x = (pixel[..., 0] - self.cx_px) / self.fx_px
        y = (pixel[..., 1] - self.cy_px) / self.fy_px
        return np.stack((x * depth_m, y * depth_m, depth_m + 0.0 * x), axis=-1)

    def undistort(self, pixel: FloatArray) -> FloatArray:
        """Pixels (D, 2) as an ideal pinhole would see them."""
        if not self.is_distorted or pixel.size == 0:
            return pixel
        k = self.matrix
        flat = cv2.undistortPoints(pixel.reshape(-1, 1, 2), k, np.array(self.distortion), P=k)
        return np.asarray(flat, dtype=np.float64).reshape(-1, 2)

    def distort(self, pixel: FloatArray) -> FloatArray:
        """Inverse of :meth:`undistort`: where ideal pixels (D, 2) lie in the real picture."""
        if not self.is_distorted or pixel.size == 0:
            return pixel
        rays = self.back_project(pixel, np.ones(pixel.shape[:-1]))
        out, _ = cv2.projectPoints(
            rays.reshape(-1, 1, 3), np.zeros(3), np.zeros(3), self.matrix, np.array(self.distortion)
        )
        return np.asarray(out, dtype=np.float64).reshape(-1, 2)


DEFAULT_CAMERA = Camera(525.0, 525.0, 319.5, 239.5)
"""Nominal Xtion colour camera (reference values of the TUM RGB-D data set)."""

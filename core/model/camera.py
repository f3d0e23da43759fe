"""The pinhole camera: intrinsics, projection, back-projection."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.model.depth_sensor import ASSUMED_SENSOR, DepthSensor
from carpus.core.model.types import FloatArray

DistortionModel = Literal["plumb_bob", "rational_polynomial", "inverse_brown_conrady"]

# Number of coefficients by model; in OpenCV's order k1 k2 p1 p2 k3, then k4 k5 k6.
DISTORTION_COEFFICIENT_COUNTS: Mapping[DistortionModel, int] = {
    "plumb_bob": 5,
    "rational_polynomial": 8,
    "inverse_brown_conrady": 5,
}

_MAX_ITERATIONS, _TOLERANCE_PX = 20, 1e-7  # OpenCV's own few iterations leave a strong lens unfinished.


@dataclass(frozen=True, slots=True)
class Camera:
    """Intrinsics of the colour camera in pixels, and its lens.

    ``distortion_model`` says what ``distortion`` is: plumb_bob (k1, k2, p1, p2, k3); rational_polynomial, with k4, k5,
    k6 of a denominator after them; inverse_brown_conrady (RealSense), the polynomial of plumb_bob that leads the other
    way, from the distorted image to the ideal one. ``origin`` says where the numbers come from: ``file``,
    ``calibration`` (stored for this camera), ``factory`` (from the camera), ``driver`` (its field of view) or
    ``default``.
    """

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    width_px: int = 640
    height_px: int = 480
    distortion: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0)
    origin: str = "default"
    sensor: DepthSensor = ASSUMED_SENSOR
    distortion_model: DistortionModel = "plumb_bob"

    @property
    def matrix(self) -> FloatArray:
        """Camera matrix K (3, 3)."""
        return np.array([[self.fx_px, 0.0, self.cx_px], [0.0, self.fy_px, self.cy_px], [0.0, 0.0, 1.0]])

    @property
    def is_distorted(self) -> bool:
        return any(self.distortion)

    def project(self, point_cam_m: FloatArray) -> FloatArray:
        """Return undistorted pixels (..., 2) of points (..., 3) in camera axes.

        Eq. (2) of the wrist paper.

        >>> Camera(525.0, 525.0, 319.5, 239.5).project(np.array([0.0, 0.0, 0.7]))
        array([319.5, 239.5])
        """
        out: FloatArray = point_cam_m[..., :2] / point_cam_m[..., 2:]
        out *= (self.fx_px, self.fy_px)
        out += (self.cx_px, self.cy_px)
        return out

    def backproject(self, pixel: FloatArray, depth_m: FloatArray) -> FloatArray:
        """Return points (..., 3) in camera axes of undistorted pixels (..., 2) at depths (...)."""
        x = (pixel[..., 0] - self.cx_px) / self.fx_px
        y = (pixel[..., 1] - self.cy_px) / self.fy_px
        return np.stack((x * depth_m, y * depth_m, depth_m + 0.0 * x), axis=-1)

    def undistort(self, pixel: FloatArray) -> FloatArray:
        """Return pixels (D, 2) as an ideal pinhole camera would see them."""
        if not self.is_distorted or pixel.size == 0:
            return pixel
        if self.distortion_model == "plumb_bob":
            return self._undistort_plumb_bob(pixel)
        return (
            self._apply_polynomial(pixel)
            if self.distortion_model == "inverse_brown_conrady"
            else self._invert_polynomial(pixel)
        )

    def distort(self, pixel: FloatArray) -> FloatArray:
        """Return where ideal pixels (D, 2) lie in the distorted image."""
        if not self.is_distorted or pixel.size == 0:
            return pixel
        return (
            self._invert_polynomial(pixel)
            if self.distortion_model == "inverse_brown_conrady"
            else self._apply_polynomial(pixel)
        )

    def _undistort_plumb_bob(self, pixel: FloatArray) -> FloatArray:
        import cv2  # a session is opened without it

        k = self.matrix
        flat = cv2.undistortPoints(pixel.reshape(-1, 1, 2), k, np.array(self.distortion), P=k)
        return np.asarray(flat, dtype=np.float64).reshape(-1, 2)

    def _apply_polynomial(self, pixel: FloatArray) -> FloatArray:
        import cv2

        rays = self.backproject(pixel, np.ones(pixel.shape[:-1]))
        out, _ = cv2.projectPoints(
            rays.reshape(-1, 1, 3), np.zeros(3), np.zeros(3), self.matrix, np.array(self.distortion)
        )
        return np.asarray(out, dtype=np.float64).reshape(-1, 2)

    def _invert_polynomial(self, pixel: FloatArray) -> FloatArray:
        """Invert :meth:`_apply_polynomial` by fixed-point iteration."""
        out = self._undistort_plumb_bob(pixel)
        for _ in range(_MAX_ITERATIONS):
            off = self._apply_polynomial(out) - pixel
            out = out - off
            if np.abs(off).max() < _TOLERANCE_PX:
                break
        return out


# Nominal Xtion colour camera (reference values of the TUM RGB-D data set).
DEFAULT_CAMERA = Camera(525.0, 525.0, 319.5, 239.5)

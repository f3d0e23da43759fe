"""The pinhole camera: projection by the book, back-projection and lens distortion there and back."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from carpus.core.model.camera import Camera, DistortionModel
from carpus.core.model.types import FloatArray

CAMERA = Camera(520.0, 530.0, 322.0, 236.0)
RATIONAL_MODEL: DistortionModel = "rational_polynomial"
INVERSE_MODEL: DistortionModel = "inverse_brown_conrady"
LENS = Camera(520.0, 530.0, 322.0, 236.0, distortion=(0.05, -0.12, 0.001, -0.002, 0.03))


def points(count: int = 40) -> FloatArray:
    rng = np.random.default_rng(0)
    return rng.uniform([-0.25, -0.2, 0.5], [0.25, 0.2, 1.2], (count, 3))


def test_projection_is_equation_2_and_undone() -> None:
    there = points().reshape(4, 10, 3)
    x, y, z = np.moveaxis(there, -1, 0)
    seen = CAMERA.project(there)
    assert np.allclose(seen, np.stack((520.0 * x / z + 322.0, 530.0 * y / z + 236.0), axis=-1), atol=1e-9)
    assert np.allclose(CAMERA.backproject(seen, z), there, atol=1e-12)


def test_distortion_is_plumb_bob_and_undone() -> None:
    ideal = LENS.project(points())
    real = LENS.distort(ideal)
    k1, k2, p1, p2, k3 = LENS.distortion
    for (u, v), (x, y, z) in zip(real, points(), strict=True):
        a, b = x / z, y / z
        r2 = a * a + b * b
        radial = 1.0 + k1 * r2 + k2 * r2**2 + k3 * r2**3
        assert u == pytest.approx(520.0 * (a * radial + 2.0 * p1 * a * b + p2 * (r2 + 2.0 * a * a)) + 322.0)
        assert v == pytest.approx(530.0 * (b * radial + p1 * (r2 + 2.0 * b * b) + 2.0 * p2 * a * b) + 236.0)
    assert np.abs(real - ideal).max() > 1.0
    assert np.abs(LENS.undistort(real) - ideal).max() < 0.01


RATIONAL = replace(LENS, distortion=(0.5, -0.3, 0.001, -0.002, 0.1, 0.45, -0.2, 0.05), distortion_model=RATIONAL_MODEL)
INVERSE = replace(LENS, distortion=(-0.056, 0.067, 0.0009, 0.0005, -0.021), distortion_model=INVERSE_MODEL)


def test_rational_lens_is_opencvs() -> None:
    """Judge: OpenCV's map of where each pixel of an ideal picture lies in the real one."""
    across, down = cv2.initUndistortRectifyMap(
        RATIONAL.matrix, np.array(RATIONAL.distortion), np.eye(3), RATIONAL.matrix, (640, 480), cv2.CV_32FC1
    )
    rows, columns = np.mgrid[0:480:37, 0:640:41]
    ideal = np.stack((columns.ravel(), rows.ravel()), axis=-1).astype(np.float64)
    real = RATIONAL.distort(ideal)
    judged = np.stack((across[rows, columns].ravel(), down[rows, columns].ravel()), axis=-1)
    assert np.abs(real - judged).max() < 1e-4
    assert np.abs(real - ideal).max() > 3.0
    assert np.abs(RATIONAL.undistort(real) - ideal).max() < 1e-4


def test_inverse_lens_leads_from_real_frame_to_ideal_one() -> None:
    """As librealsense takes a pixel of such a stream to its ray; OpenCV's plumb_bob the other way round."""
    real = INVERSE.project(points())
    ideal = INVERSE.undistort(real)
    c0, c1, c2, c3, c4 = INVERSE.distortion
    x, y = ((real - [322.0, 236.0]) / [520.0, 530.0]).T
    r2 = x * x + y * y
    f = 1.0 + c0 * r2 + c1 * r2 * r2 + c4 * r2**3
    u, v = x * f + 2.0 * c2 * x * y + c3 * (r2 + 2.0 * x * x), y * f + 2.0 * c3 * x * y + c2 * (r2 + 2.0 * y * y)
    assert np.allclose(ideal, np.stack((520.0 * u + 322.0, 530.0 * v + 236.0), axis=-1), atol=1e-9)
    assert np.abs(ideal - real).max() > 1.0
    assert np.abs(INVERSE.distort(ideal) - real).max() < 1e-4

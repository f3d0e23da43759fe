"""The pinhole camera: projection by the book, back-projection and lens distortion there and back."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.camera import Camera
from carpus.core.types import FloatArray

CAMERA = Camera(520.0, 530.0, 322.0, 236.0)
LENS = Camera(520.0, 530.0, 322.0, 236.0, distortion=(0.05, -0.12, 0.001, -0.002, 0.03))


def points(count: int = 40) -> FloatArray:
    rng = np.random.default_rng(0)
    return rng.uniform([-0.25, -0.2, 0.5], [0.25, 0.2, 1.2], (count, 3))


def test_projection_is_equation_2() -> None:
    for x, y, z in points():
        u, v = CAMERA.project(np.array([x, y, z]))
        assert u == pytest.approx(520.0 * x / z + 322.0)
        assert v == pytest.approx(530.0 * y / z + 236.0)


def test_the_camera_looks_along_z_with_x_right_and_y_down() -> None:
    centre = CAMERA.project(np.array([0.0, 0.0, 1.0]))
    assert CAMERA.project(np.array([0.1, 0.0, 1.0]))[0] > centre[0]
    assert CAMERA.project(np.array([0.0, 0.1, 1.0]))[1] > centre[1]
    assert np.allclose(centre, [322.0, 236.0])


def test_back_projection_undoes_projection() -> None:
    there = points().reshape(4, 10, 3)
    assert np.allclose(CAMERA.back_project(CAMERA.project(there), there[..., 2]), there, atol=1e-12)


def test_a_point_of_unknown_depth_is_unknown_whole() -> None:
    back = CAMERA.back_project(np.array([[300.0, 200.0]]), np.array([np.nan]))
    assert np.isnan(back).all()


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


def test_a_lens_without_distortion_leaves_pixels_alone() -> None:
    pixel = np.array([[3.0, 4.0]])
    assert np.array_equal(CAMERA.undistort(pixel), pixel)
    assert np.array_equal(CAMERA.distort(pixel), pixel)
    assert not CAMERA.is_distorted
    assert LENS.is_distorted


def test_no_pixels_are_no_trouble() -> None:
    assert LENS.undistort(np.empty((0, 2))).shape == (0, 2)
    assert LENS.distort(np.empty((0, 2))).shape == (0, 2)

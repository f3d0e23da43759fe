"""The neutral pose by least squares (eq. 13 to 20): the truth, from bad starts, and as exact as the noise allows."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from carpus.core.calibration.neutral_pose import DEPTH_SD_M, PIXEL_SD_PX, estimate_neutral_pose
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from tests.tracking.hands import FROM_ABOVE
from tests.tracking.hands import RIGHT_PALM_M as PALM_M

CAMERA = Camera(520.0, 530.0, 318.0, 243.0)


def true_pose(seed: int) -> tuple[FloatArray, FloatArray]:
    rng = np.random.default_rng(seed)
    rotation = FROM_ABOVE @ Rotation.from_rotvec(rng.uniform(-0.3, 0.3, 3)).as_matrix()
    return rotation, np.array([0.0, 0.03, 0.7]) + rng.uniform(-0.05, 0.05, 3)


def measure_markers(rotation: FloatArray, translation: FloatArray) -> FloatArray:
    """u, v of every disc, then the depths."""
    x, y, z = (PALM_M @ rotation.T + translation).T
    return np.concatenate((np.stack((520.0 * x / z + 318.0, 530.0 * y / z + 243.0), axis=1).ravel(), z))


def fit_pose(values: FloatArray, rotation: FloatArray, translation: FloatArray) -> tuple[FloatArray, FloatArray]:
    return estimate_neutral_pose(CAMERA, PALM_M, values[:12].reshape(6, 2), values[12:], rotation, translation)


def angle_between(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(Rotation.from_matrix(a.T @ b).as_rotvec())


def predicted_covariance(rotation: FloatArray, translation: FloatArray) -> FloatArray:
    """(H' W H)^-1 with H by finite differences of translation and turn."""
    columns = []
    for i in range(6):
        step = np.zeros(6)
        step[i] = 1e-6
        ahead, back = (
            measure_markers(rotation @ Rotation.from_rotvec(s * step[3:]).as_matrix(), translation + s * step[:3])
            for s in (1.0, -1.0)
        )
        columns.append((ahead - back) / 2e-6)
    h = np.stack(columns, axis=1) / np.concatenate((np.full(12, PIXEL_SD_PX), np.full(6, DEPTH_SD_M)))[:, None]
    return np.asarray(np.linalg.inv(h.T @ h))


def test_neutral_pose_errors_match_the_predicted_covariance() -> None:
    rotation, translation = true_pose(3)
    covariance = predicted_covariance(rotation, translation)
    rng = np.random.default_rng(0)
    errors = []
    for _ in range(150):
        noise = np.concatenate((PIXEL_SD_PX * rng.normal(size=12), DEPTH_SD_M * rng.normal(size=6)))
        found = fit_pose(measure_markers(rotation, translation) + noise, rotation, translation)
        errors.append(np.concatenate((found[1] - translation, angle_between(rotation, found[0]))))
    error = np.array(errors)
    # Normalised squared errors sum to a chi-square with 6 degrees of freedom each.
    squared = np.einsum("ni,ij,nj->n", error, np.linalg.inv(covariance), error)
    assert chi2.ppf(1e-4, 900) < squared.sum() < chi2.isf(1e-4, 900)
    mean = error.mean(axis=0)
    assert mean @ np.linalg.solve(covariance / 150.0, mean) < chi2.isf(1e-4, 6)


def test_neutral_pose_without_depth_is_determined() -> None:
    """The papers' colour-only measurement, from a start near by."""
    rotation, translation = true_pose(6)
    values = measure_markers(rotation, translation)
    values[12:] = np.nan
    found = fit_pose(values, rotation @ Rotation.from_rotvec([0.05, 0.05, -0.1]).as_matrix(), translation + 0.01)
    assert np.linalg.norm(angle_between(rotation, found[0])) < 1e-6
    assert np.linalg.norm(found[1] - translation) < 1e-6

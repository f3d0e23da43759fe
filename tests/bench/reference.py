"""The yardstick: a plain NumPy augmented unscented Kalman filter, as one would write it from the papers.

State of 26: position 3, velocity 3, turn 3, joints 17. Process noise of 23: acceleration 3, turning 3, joints 17.
Augmented 49, so 99 sigma points; 21 markers through a pinhole camera, 42 pixels. One step is predict and update;
which blob is which marker is taken as known. Fingers are an abduction and a planar chain in closed form.
"""

from __future__ import annotations

import numpy as np

from carpus.core.model.types import FloatArray

STATE, NOISE, MARKERS = 26, 23, 21
FOCAL_PX, CENTRE_PX, DISTANCE_M = 525.0, np.array([319.5, 239.5]), 0.7
PIXEL_VARIANCE, ALPHA, BETA = 1.0, 0.5, 2.0
_KNUCKLE_M = np.array(
    [[0.03, 0.035, 0.0], [0.085, 0.025, 0.0], [0.09, 0.0, 0.0], [0.085, -0.022, 0.0], [0.078, -0.042, 0.0]]
)
_SEGMENT_M = np.array(
    [[0.045, 0.032, 0.025], [0.042, 0.025, 0.02], [0.046, 0.03, 0.02], [0.042, 0.028, 0.02], [0.034, 0.02, 0.018]]
)
_DIP_OF_PIP = 2.0 / 3.0
"""Markers: wrist, then four on each of thumb to little finger."""


class ReferenceFilter:
    """Mean (26,) and covariance (26, 26), stepped by :meth:`step`."""

    def __init__(self) -> None:
        # begun at the truth: from pixels alone a finger bent up looks like one bent down, and a straight one is both
        self.mean = motion(0.0)
        self.covariance = np.diag(np.r_[np.full(3, 1e-5), np.full(3, 1e-2), np.full(3, 1e-3), np.full(17, 1e-2)])
        self._noise = np.diag(np.r_[np.full(3, 2.0), np.full(3, 1.5), np.full(17, 2.5)] ** 2)
        size = STATE + NOISE
        spread = ALPHA**2 * size
        self._root = np.sqrt(spread)
        self._mean_weight = np.full(2 * size + 1, 0.5 / spread)
        self._mean_weight[0] = (spread - size) / spread
        self._cov_weight = self._mean_weight.copy()
        self._cov_weight[0] += 1.0 - ALPHA**2 + BETA

    def step(self, measured_px: FloatArray, dt_s: float) -> None:
        """Predict over ``dt_s`` and correct by all markers' pixels (42,)."""
        size = STATE + NOISE
        root = np.zeros((size, size))
        root[:STATE, :STATE] = np.linalg.cholesky(self.covariance)
        root[STATE:, STATE:] = np.linalg.cholesky(self._noise)
        start = np.concatenate((self.mean, np.zeros(NOISE)))
        points = start + self._root * np.concatenate((np.zeros((1, size)), root.T, -root.T))
        moved = _moved(points, dt_s)
        seen = project_markers(moved)
        mean, expected = self._mean_weight @ moved, self._mean_weight @ seen
        state_error, pixel_error = moved - mean, seen - expected
        weighted = self._cov_weight[:, None] * pixel_error
        covariance = state_error.T @ (self._cov_weight[:, None] * state_error)
        innovation = pixel_error.T @ weighted + PIXEL_VARIANCE * np.eye(2 * MARKERS)
        gain = np.linalg.solve(innovation, weighted.T @ state_error).T
        self.mean = mean + gain @ (measured_px - expected)
        covariance -= gain @ innovation @ gain.T
        self.covariance = 0.5 * (covariance + covariance.T)


def _moved(points: FloatArray, dt_s: float) -> FloatArray:
    """States (P, 26) of augmented points (P, 49) after ``dt_s``."""
    out = points[:, :STATE].copy()
    noise = points[:, STATE:]
    out[:, 0:3] += dt_s * points[:, 3:6] + 0.5 * dt_s**2 * noise[:, 0:3]
    out[:, 3:6] += dt_s * noise[:, 0:3]
    out[:, 6:9] += dt_s * noise[:, 3:6]
    out[:, 9:26] += dt_s * noise[:, 6:23]
    return out


def project_markers(states: FloatArray) -> FloatArray:
    """Pixels (P, 42) of the markers for states (P, 26)."""
    in_hand = _markers_m(states[:, 9:26])
    rotation = _rotations(states[:, 6:9])
    in_camera = np.matmul(in_hand, rotation.transpose(0, 2, 1)) + states[:, None, 0:3]
    pixel = FOCAL_PX * in_camera[..., :2] / (DISTANCE_M + in_camera[..., 2:]) + CENTRE_PX
    return pixel.reshape(len(states), -1)


def _markers_m(joints: FloatArray) -> FloatArray:
    """Places (P, 21, 3) of the markers in the hand; joints (P, 17)."""
    count = len(joints)
    abduction = np.stack((joints[:, 1], joints[:, 5], joints[:, 8], joints[:, 11], joints[:, 14]), axis=1)
    first = np.stack((joints[:, 0], joints[:, 6], joints[:, 9], joints[:, 12], joints[:, 15]), axis=1)
    second = np.stack((joints[:, 2] + joints[:, 3], joints[:, 7], joints[:, 10], joints[:, 13], joints[:, 16]), axis=1)
    third = _DIP_OF_PIP * second
    third[:, 0] = joints[:, 4]
    bend = np.cumsum(np.stack((first, second, third), axis=2), axis=2)
    along = np.cumsum(_SEGMENT_M * np.cos(bend), axis=2)
    down = np.cumsum(-_SEGMENT_M * np.sin(bend), axis=2)
    out = np.zeros((count, MARKERS, 3))
    finger = out[:, 1:].reshape(count, 5, 4, 3)
    finger[...] = _KNUCKLE_M[:, None]
    finger[:, :, 1:, 0] += along * np.cos(abduction)[..., None]
    finger[:, :, 1:, 1] += along * np.sin(abduction)[..., None]
    finger[:, :, 1:, 2] += down
    return out


def _rotations(turn: FloatArray) -> FloatArray:
    """Rotation matrices (P, 3, 3) of rotation vectors (P, 3) by Rodrigues."""
    angle = np.linalg.norm(turn, axis=1)
    axis = turn / np.maximum(angle, 1e-12)[:, None]
    cross = np.zeros((len(turn), 3, 3))
    cross[:, 0, 1], cross[:, 0, 2] = -axis[:, 2], axis[:, 1]
    cross[:, 1, 0], cross[:, 1, 2] = axis[:, 2], -axis[:, 0]
    cross[:, 2, 0], cross[:, 2, 1] = -axis[:, 1], axis[:, 0]
    sine, cosine = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3) + sine * cross + (1.0 - cosine) * (cross @ cross)


def motion(time_s: float) -> FloatArray:
    """True state (26,) of the reference's motion: the wrist sways, all joints bend, and none is ever straight."""
    state = np.zeros(STATE)
    state[0:3] = 0.02 * np.sin(2.0 * np.pi * 0.3 * time_s + np.arange(3))
    state[6:9] = 0.4 * np.sin(2.0 * np.pi * 0.4 * time_s + np.arange(3))
    state[9:26] = 0.5 + 0.25 * (1.0 - np.cos(2.0 * np.pi * 0.3 * time_s + 0.1 * np.arange(17)))
    return state

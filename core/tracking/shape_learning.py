"""How the palm's shape is learnt while it moves, of measurements whose errors do not come anew with every frame.

The matching window flattens knuckles: a part of a disc's error in depth stays over a recording, and the calibration had
it too. What corrects a disc's place is then partly its depth that goes on being wrong. Shading and the pattern of the
depths stay as long as the pose does: neighbouring frames tell little that is new of the shape.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.tracking.kernel import learning_shares
from carpus.core.tracking.palm_state import SHAPE, SIZE
from carpus.core.types import FloatArray

_FLOOR_M = 1e-5
"""Keeps the covariance of a perfectly measured disc positive definite."""


def along_rays(calibration: Calibration, sd_m: float) -> FloatArray:
    """Covariances (M, 3, 3) in W0 of errors along the rays from the camera, ``sd_m`` in depth."""
    place = _cam_m(calibration)
    ray = (place / place[:, 2:]) @ calibration.rotation_w0_cam
    return np.asarray(sd_m**2 * ray[:, :, None] * ray[:, None, :])


def hidden_by_calibration(calibration: Calibration, share: float) -> FloatArray:
    """What a shape (3M,) takes from the depths (M,) of every pose: matrix (M, 3M).

    Its effect on the calibration's depths times the ``share`` of it that is their error: by that much the discs lie
    elsewhere without ever being seen there.
    """
    count = len(calibration.marker_position_w0_m)
    disc = np.arange(count)
    out = np.zeros((count, count, 3))
    out[disc, disc] = share * calibration.rotation_w0_cam[2]
    return out.reshape(count, -1)


def _cam_m(calibration: Calibration) -> FloatArray:
    return calibration.marker_position_w0_m @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m


def shape_shares(news: float) -> tuple[FloatArray, FloatArray]:
    """Shares of a correction that mean and covariance take, the shape only ``news`` (0 to 1) of its information."""
    return learning_shares(SIZE, SHAPE, 1.0 - math.sqrt(1.0 - news))


def shape_covariance(calibration: Calibration, depth_stays_m: float) -> FloatArray:
    """Covariance (18, 18) of the discs' places as calibrated; ``depth_stays_m`` what the scatter of a still hand's
    depths does not show of their error."""
    own = calibration.marker_covariance_w0_m2 + along_rays(calibration, depth_stays_m) + _FLOOR_M**2 * np.eye(3)
    count = len(own)
    covariance = np.zeros((count, 3, count, 3))
    covariance[np.arange(count), :, np.arange(count), :] = own
    return covariance.reshape(3 * count, -1)

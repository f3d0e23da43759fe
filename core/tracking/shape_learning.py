"""How the palm's shape is learnt while it moves, of measurements whose errors do not come anew with every frame.

The matching window flattens knuckles: a part of a disc's error in depth stays over a recording, and the calibration had
it too. What corrects a disc's place is then partly its depth that goes on being wrong. Shading, the pattern of the
depths and the steps to which they are rounded stay as long as the pose does: a hand that is still tells nothing new of
its shape, and motion does.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.depth_sensor import DepthSensor
from carpus.core.tracking.kernel import partial_update
from carpus.core.tracking.palm_state import LEARNT, SIZE
from carpus.core.tracking.settings import MeasurementNoise
from carpus.core.types import FloatArray

_FLOOR_M = 1e-5
"""Keeps the covariance of a perfectly measured disc positive definite."""


def along_rays(calibration: Calibration, sd_m: FloatArray) -> FloatArray:
    """Covariances (M, 3, 3) in W0 of errors along the rays from the camera, ``sd_m`` (M,) in depth."""
    place = _cam_m(calibration)
    ray = (place / place[:, 2:]) @ calibration.rotation_w0_cam
    return np.asarray(np.broadcast_to(sd_m, len(ray))[:, None, None] ** 2 * ray[:, :, None] * ray[:, None, :])


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


def fresh_share(before_m: FloatArray, after_m: FloatArray, camera: Camera) -> float:
    """How far the depths' errors are other ones than in the picture before, 0 to 1, by how the discs (M, 3), in camera
    axes, have moved meanwhile: across by so much of a matching window, along by so much of a reading's error."""
    across_m, down_m, along_m = (np.add.reduce(np.abs(after_m - before_m)) / len(after_m)).tolist()
    depth_m = float(np.add.reduce(after_m[:, 2])) / len(after_m)
    windows = math.hypot(across_m, down_m) * camera.fx_px / depth_m / camera.sensor.patch_px
    return 1.0 - math.exp(-2.0 * windows - along_m / float(camera.sensor.reading_sd_m(np.array(depth_m))))


def shape_partial_update(news: float) -> FloatArray:
    """Shares (n,) of a correction that the mean takes, what is learnt only ``news`` (0 to 1) of what is told."""
    return partial_update(SIZE, LEARNT, 1.0 - math.sqrt(1.0 - news))


def shape_covariance(calibration: Calibration, sensor: DepthSensor, noise: MeasurementNoise) -> FloatArray:
    """Covariance (18, 18) of the discs' places as calibrated, with what the scatter of a still hand's depths does not
    show of their error: its ``depth_stays_m``, and the step to which a depth stays rounded while the hand is still."""
    rounded_m = 0.0 if sensor.averages else noise.depth_locks * sensor.reading_sd_m(_cam_m(calibration)[:, 2])
    own = calibration.marker_covariance_w0_m2 + along_rays(calibration, np.hypot(noise.depth_stays_m, rounded_m))
    own = own + _FLOOR_M**2 * np.eye(3)
    count = len(own)
    covariance = np.zeros((count, 3, count, 3))
    covariance[np.arange(count), :, np.arange(count), :] = own
    return covariance.reshape(3 * count, -1)

"""What stays of the depth's error stays in the angles, however sure the filter has grown."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.depth_sensor import D435, DepthSensor
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.palm_state import InitialSd, initial_estimate
from carpus.core.tracking.filter.readout import Readout
from tests.session.samples import make_calibration

PALM_M = 1e-3 * np.array([[0, 0, 0], [20, 30, 0], [80, 25, 0], [85, 5, 0], [80, -15, 0], [72, -35, 0]], dtype=float)
RADIUS_M, AWAY_M = 6e-3, 0.7


def angles_sd_deg(sensor: DepthSensor) -> FloatArray:
    """Of a palm that lies flat before a camera of a sensor, and which the filter is sure of."""
    calibration = replace(
        make_calibration(),
        marker_position_w0_m=PALM_M,
        rotation_w0_cam=np.diag([1.0, -1.0, -1.0]),
        translation_w0_cam_m=np.array([0.0, 0.0, AWAY_M]),
        start_angles_rad=np.zeros(3),
    )
    camera = replace(DEFAULT_CAMERA, sensor=sensor)
    sure = replace(initial_estimate(InitialSd(), 1e-12 * np.eye(21)))
    sure = replace(sure, covariance=1e-12 * np.eye(len(sure.covariance)))
    moment = Readout(calibration, camera, RADIUS_M).read_kinematics(sure)
    return np.degrees(moment.angles_sd_rad)


def test_readout_stereo_tilt_covariance_matches_six_biased_discs() -> None:
    area_px = np.array(math.pi * (RADIUS_M * DEFAULT_CAMERA.fx_px / AWAY_M) ** 2)
    sd_m = float(D435.disc_bias_sd_m(np.array(AWAY_M), area_px))
    flat = PALM_M - PALM_M.mean(axis=0)
    drawn = np.random.default_rng(3).normal(0.0, sd_m, (20_000, 6))
    slopes = drawn @ np.linalg.pinv(flat[:, :2]).T
    along, across = np.degrees(slopes.std(axis=0))
    deviation, flexion, turn = angles_sd_deg(D435)
    assert flexion == pytest.approx(along, rel=0.1)
    assert turn == pytest.approx(across, rel=0.1)
    assert deviation < 0.2 * flexion, "pixels tell it"

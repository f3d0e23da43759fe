"""How a disc's noise and size follow what is seen, and what stays of the depth's error in shape and angles."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.depth_sensor import AZURE_KINECT, D435, PRIMESENSE, DepthSensor
from carpus.core.model.types import Detections, FloatArray
from carpus.core.tracking.filter.palm_state import InitialSd, initial_estimate
from carpus.core.tracking.filter.predicted_measurement import (
    LOCKED_DEPTH_SHARE,
    adapt_noise_factor,
    measurements_from_blobs,
    shape_covariance,
)
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.filter.settings import MeasurementNoise, TrackerSettings
from carpus.core.tracking.finger_filter import update_disc_areas
from carpus.core.tracking.tracker import Tracker
from tests.session.samples import make_calibration
from tests.tracking.hands import CAMERA, DT_S, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, Pose, blobs, calibration

NOISE = MeasurementNoise()
ALL = np.ones((1, 3), dtype=bool)


def adapt(seconds: float, residual: tuple[float, float, float], dt_s: float = DT_S) -> FloatArray:
    """The factors (3,) of a disc whose residuals stay so."""
    factor = np.ones((1, 3))
    for _ in range(round(seconds / dt_s)):
        factor = adapt_noise_factor(factor, np.array([residual]), ALL, dt_s, NOISE)
    return np.asarray(factor[0])


def test_adapt_noise_factors_stay_in_bounds() -> None:
    assert adapt(5.0, (20.0, 20.0, 20.0)) == pytest.approx(np.full(3, NOISE.max_variance_factor))
    assert adapt(5.0, (0.0, 0.0, 0.0)) == pytest.approx(np.full(3, NOISE.min_variance_factor))
    factor = np.array([[2.0, 2.0, 3.0]])
    nothing = np.zeros((1, 3), dtype=bool)
    assert np.array_equal(adapt_noise_factor(factor, np.full((1, 3), 9.0), nothing, DT_S, NOISE), factor)
    without_depth = np.array([[True, True, False]])
    assert adapt_noise_factor(factor, np.full((1, 3), 9.0), without_depth, DT_S, NOISE)[0, 2] == 3.0


@pytest.mark.parametrize("sensor", [PRIMESENSE, D435, AZURE_KINECT], ids=lambda sensor: sensor.kind)
def test_depth_variance_has_scatter_and_bias(sensor: DepthSensor) -> None:
    """Twice the book's scatter is four times its variance; the sensor's pattern and a steep slope come on top."""
    settings = TrackerSettings(noise=replace(NOISE, depth_noise_ratio=2.0))
    area, steep_m = np.full(2, math.pi * 25.0), 0.002
    book_m, pattern_m = float(sensor.disc_sd_m(np.array(0.7), area[0])), float(sensor.bias_sd_m(np.array(0.7)))
    said_m = np.array([book_m, math.hypot(book_m, steep_m)])
    seen = Detections(np.zeros((2, 2)), np.full(2, 0.7), said_m, area, np.ones(2))
    flat, steep = measurements_from_blobs(seen, 5.0, settings, sensor).variance[:, 2]
    assert flat == pytest.approx(4.0 * book_m**2 + pattern_m**2)
    assert steep == pytest.approx(flat + steep_m**2)


def test_disc_areas_grow_fast_shrink_slowly_and_stay_unseen() -> None:
    nan = math.nan
    known, seen = np.array([[50.0, 100.0, 70.0, nan, nan]]), np.array([[100.0, 50.0, nan, 80.0, nan]])
    assert update_disc_areas(known, seen)[0, 3] == 80.0, "given by the first picture"
    for _ in range(15):
        known = update_disc_areas(known, seen)
    grown, shrunk, unseen, first, never = known[0]
    assert grown > 97.0, "half hidden at first, known within half a second"
    assert 80.0 < shrunk < 92.0, "half hidden for half a second, kept"
    assert (unseen, first) == (70.0, 80.0)
    assert math.isnan(never)


def test_shape_covariance_is_larger_along_the_ray() -> None:
    measured, stays_m = calibration(sd_m=4e-4), 3e-4
    noise = replace(TrackerSettings().noise, depth_bias_sd_m=stays_m)
    found = shape_covariance(measured, D435, noise)
    locked = shape_covariance(measured, PRIMESENSE, noise) - found
    for disc, place in enumerate(RIGHT_PALM_M @ FROM_ABOVE.T + MIDDLE_M):
        own = slice(3 * disc, 3 * disc + 3)
        ray = FROM_ABOVE.T @ (place / np.linalg.norm(place))
        along = stays_m * np.linalg.norm(place) / place[2]
        assert ray @ found[own, own] @ ray == pytest.approx(4e-4**2 + along**2, rel=1e-2)
        rounded = LOCKED_DEPTH_SHARE * float(PRIMESENSE.reading_sd_m(place[2])) * np.linalg.norm(place) / place[2]
        assert ray @ locked[own, own] @ ray == pytest.approx(rounded**2), "depths that are rounded stay so"
        across = np.cross(ray, [1.0, 0.0, 0.0])
        assert across @ found[own, own] @ across / (across @ across) == pytest.approx(4e-4**2, rel=1e-2)
        assert not np.delete(found[own], np.arange(own.start, own.stop), axis=1).any()


def test_depth_bias_limits_the_sd_of_angles() -> None:
    """The axes of the hand are those of its discs: as sure as their heights are, seen from elsewhere."""
    stated = []
    for stays_m in (0.0, TrackerSettings().noise.depth_bias_sd_m, 1e-3):
        noise = replace(TrackerSettings().noise, depth_bias_sd_m=stays_m)
        tracker = Tracker(calibration(sd_m=5e-5), CAMERA, TrackerSettings(noise=noise, use_surface=False))
        for k in range(16):
            pose = Pose(np.array([3.0, 2.0, 2.0]) * min(k, 10))
            frame = tracker.step(k, k * DT_S, blobs(pose))
        stated.append(np.degrees(frame.kinematics.angles_sd_rad))
    assert (stated[1] > 1.01 * stated[0]).any(), "the shipped size of it counts"
    assert (stated[2] > 1.2 * stated[1]).any()


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

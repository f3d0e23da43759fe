"""The palm's shape is learnt slowly and from what can be true of it; the rest of the state as ever."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.depth_sensor import D435, PRIMESENSE
from carpus.core.tracking.filter.predicted_measurement import (
    LOCKED_DEPTH_SHARE,
    shape_covariance,
)
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.tracking.hands import CAMERA, DT_S, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, Pose, blobs, calibration


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

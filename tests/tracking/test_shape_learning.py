"""The palm's shape is learnt slowly and from what can be true of it; the rest of the state as ever."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.depth_sensor import D435, PRIMESENSE
from carpus.core.tracking.filter.palm_state import CALIBRATION_ERROR, SHAPE, SIZE, PalmEstimate
from carpus.core.tracking.filter.predicted_measurement import (
    LOCKED_DEPTH_SHARE,
    compute_fresh_share,
    depth_bias_matrix,
    shape_covariance,
    shape_partial_update,
)
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.unscented import UnscentedParameters
from carpus.core.tracking.hand_filter import HandFilter
from carpus.core.tracking.tracker import Tracker
from tests.tracking.hands import CAMERA, DT_S, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, Pose, blobs, calibration
from tests.tracking.test_palm_filter import linearised_about


@pytest.mark.parametrize("news", [0.1, 1.0])
def test_shape_partial_update_takes_its_share(news: float) -> None:
    mean = shape_partial_update(news)[CALIBRATION_ERROR]
    np.testing.assert_allclose(2.0 * mean - mean**2, news, err_msg="of the information")


def test_shape_learning_still_hand_adds_little() -> None:
    disc_m = RIGHT_PALM_M @ FROM_ABOVE.T + MIDDLE_M
    assert compute_fresh_share(disc_m, disc_m, CAMERA) == 0.0
    per_px_m = MIDDLE_M[2] / CAMERA.fx_px
    partial = [
        compute_fresh_share(disc_m, disc_m + [moved_px * per_px_m, 0.0, 0.0], CAMERA) for moved_px in (0.5, 4.5, 20.0)
    ]
    assert partial == sorted(partial)
    assert partial[0] < 0.15
    assert partial[2] > 0.95
    step_m = float(CAMERA.sensor.reading_sd_m(MIDDLE_M[2]))
    assert compute_fresh_share(disc_m, disc_m + [0.0, 0.0, 2.0 * step_m], CAMERA) > 0.8


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_depth_bias_matrix_hides_its_share(share: float) -> None:
    """A disc believed 1 mm further away is expected that much further, less what its depth goes on being wrong."""
    view = HandFilter(calibration(), CAMERA, TrackerSettings(shape_hidden=share)).view
    further = np.zeros((6, 3))
    further[3] = FROM_ABOVE.T @ np.array([0.0, 0.0, 0.001])
    seen = []
    for shape in (further, np.zeros((6, 3))):
        value = np.zeros(SIZE)
        value[SHAPE] = shape.ravel()
        estimate = PalmEstimate(np.eye(3), value, 1e-12 * np.eye(SIZE))
        seen.append(linearised_about(estimate, view, UnscentedParameters()).value.reshape(6, 3))
    change = seen[0] - seen[1]
    assert change[:, 2] == pytest.approx([0.0, 0.0, 0.0, (1.0 - share) * 0.001, 0.0, 0.0], abs=1e-9)
    assert np.array_equal(depth_bias_matrix(calibration(), share), view.depth_bias)


def test_shape_covariance_is_larger_along_the_ray() -> None:
    measured, stays_m = calibration(sd_m=4e-4), 3e-4
    noise = replace(TrackerSettings().noise, depth_stays_m=stays_m)
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
    for stays_m in (0.0, TrackerSettings().noise.depth_stays_m, 1e-3):
        noise = replace(TrackerSettings().noise, depth_stays_m=stays_m)
        tracker = Tracker(calibration(sd_m=5e-5), CAMERA, TrackerSettings(noise=noise, use_surface=False))
        for k in range(16):
            pose = Pose(np.array([3.0, 2.0, 2.0]) * min(k, 10))
            frame = tracker.step(k, k * DT_S, blobs(pose))
        stated.append(np.degrees(frame.kinematics.angles_sd_rad))
    assert (stated[1] > 1.01 * stated[0]).any(), "the shipped size of it counts"
    assert (stated[2] > 1.2 * stated[1]).any()

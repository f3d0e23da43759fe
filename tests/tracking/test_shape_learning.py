"""The palm's shape is learnt slowly and from what can be true of it; the rest of the state as ever."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.tracking.palm_state import SHAPE, SIZE, PalmBelief
from carpus.core.tracking.palm_view import sight
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.shape_learning import along_rays, hidden_by_calibration, shape_shares
from carpus.core.tracking.tracker import Tracker
from carpus.core.tracking.unscented import Spread
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, calibration


@pytest.mark.parametrize("news", [0.1, 1.0])
def test_shape_takes_its_share_of_the_information(news: float) -> None:
    mean, covariance = shape_shares(news)
    moving = np.delete(np.arange(SIZE), np.arange(SHAPE.start, SHAPE.stop))
    assert (mean[moving] == 1.0).all()
    assert mean[SHAPE] == pytest.approx(1.0 - np.sqrt(1.0 - news))
    assert covariance[SHAPE, SHAPE] == pytest.approx(news)
    assert (covariance[moving] == 1.0).all()


def test_errors_along_the_rays_move_no_pixel() -> None:
    found = along_rays(calibration(), 3e-4)
    for disc, covariance in zip(RIGHT_PALM_M, found, strict=True):
        spread, axes = np.linalg.eigh(covariance)
        assert spread[:2] == pytest.approx(0.0, abs=1e-15)
        moved = (disc + np.sqrt(spread[2]) * axes[:, 2]) @ FROM_ABOVE.T + MIDDLE_M
        there = disc @ FROM_ABOVE.T + MIDDLE_M
        assert np.allclose(CAMERA.project(moved), CAMERA.project(there), atol=1e-6)
        assert abs(moved[2] - there[2]) == pytest.approx(3e-4)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_calibration_hides_its_share_of_a_depth_that_stays_wrong(share: float) -> None:
    """A disc believed 1 mm further away is expected that much further, less what its depth goes on being wrong."""
    tracker = Tracker(calibration(), CAMERA, TrackerSettings(shape_hidden=share))
    further = np.zeros((6, 3))
    further[3] = FROM_ABOVE.T @ np.array([0.0, 0.0, 0.001])
    seen = []
    for shape in (further, np.zeros((6, 3))):
        value = np.zeros(SIZE)
        value[SHAPE] = shape.ravel()
        belief = PalmBelief(np.eye(3), value, 1e-12 * np.eye(SIZE))
        seen.append(sight(belief, tracker.view, Spread()).value.reshape(6, 3))
    change = seen[0] - seen[1]
    assert change[:, 2] == pytest.approx([0.0, 0.0, 0.0, (1.0 - share) * 0.001, 0.0, 0.0], abs=1e-9)
    assert np.array_equal(hidden_by_calibration(calibration(), share), tracker.view.hidden)

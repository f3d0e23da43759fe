"""The palm's shape is learnt slowly and from what can be true of it; the rest of the state as ever."""

from __future__ import annotations

import numpy as np
import pytest

from core.tracking.modes import ModeBank
from core.tracking.settings import TrackerSettings
from core.tracking.shape_learning import along_rays, hidden_by_calibration, slowly_learnt
from core.tracking.state import InitialSd, StateLayout, resting_belief
from core.tracking.tracker import Tracker
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, calibration

LAYOUT = StateLayout(0, True, 18)


def banks(seed: int) -> tuple[ModeBank, ModeBank]:
    """Two modes before and after the exact correction by a few linear measurements."""
    rng = np.random.default_rng(seed)
    belief = resting_belief(LAYOUT, InitialSd(), shape_covariance=1e-6 * np.eye(18))
    before = ModeBank.of(belief, 2)
    h = rng.normal(size=(5, LAYOUT.size))
    after = []
    errors = []
    for p in before.covariance:
        s = h @ p @ h.T + 0.01 * np.trace(h @ p @ h.T) * np.eye(5)
        gain = np.linalg.solve(s, h @ p).T
        errors.append(gain @ rng.normal(size=5))
        after.append(p - gain @ h @ p)
    return before, ModeBank(belief, np.array(errors), np.array(after), before.probability)


@pytest.mark.parametrize("seed", range(3))
def test_shape_takes_its_share_and_all_else_the_whole(seed: int) -> None:
    before, after = banks(seed)
    slow = slowly_learnt(before, after, LAYOUT, 0.1)
    shape = LAYOUT.shape
    assert np.array_equal(slow.error[:, : shape.start], after.error[:, : shape.start])
    assert np.allclose(slow.error[:, shape], (1.0 - np.sqrt(0.9)) * after.error[:, shape])
    moving = slice(0, shape.start)
    assert np.array_equal(slow.covariance[:, moving, moving], after.covariance[:, moving, moving])
    lost = np.trace(before.covariance[0, shape, shape] - slow.covariance[0, shape, shape])
    whole = np.trace(before.covariance[0, shape, shape] - after.covariance[0, shape, shape])
    assert lost == pytest.approx(0.1 * whole)
    for p in slow.covariance:
        sd = np.sqrt(np.diag(p))
        assert np.linalg.eigvalsh(p / np.outer(sd, sd))[0] > 0.0


def test_all_news_is_the_plain_correction() -> None:
    before, after = banks(0)
    plain = slowly_learnt(before, after, LAYOUT, 1.0)
    assert np.allclose(plain.error, after.error)
    assert np.allclose(plain.covariance, after.covariance)


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
    rest = (np.zeros(3), np.eye(3), np.empty(0))
    change = tracker.view.observe(*rest, further.ravel()) - tracker.view.observe(*rest, np.zeros(18))
    assert change[:, 2] == pytest.approx([0.0, 0.0, 0.0, (1.0 - share) * 0.001, 0.0, 0.0], abs=1e-12)
    assert np.array_equal(hidden_by_calibration(calibration(), share), tracker.view.hidden)

"""The filter's cycle alone: what an accepted update leaves behind, and what is worked out once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.model.hand.dorsal_surface import fit_dorsal_surface
from carpus.core.model.types import Detections
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.association.reacquire import FoundPalm
from carpus.core.tracking.filter.hand_geometry import palm_calibration
from carpus.core.tracking.filter.palm_state import SHAPE, SKIN
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.hand_filter import HandFilter
from tests.accuracy.carpus import calibrate_sequence
from tests.simulation.measurements import measurement_sequence
from tests.tracking.hands import CAMERA, DT_S, blobs, calibration, swing

FOUND = FoundPalm(np.array([0.02, 0.01, -0.01]), np.eye(3), np.ones(6, dtype=bool))


def run(own: HandFilter, frames: int = 40) -> None:
    """A few frames of a hand that flexes."""
    motion, rng = swing(1, 40.0, 1.0), np.random.default_rng(4)
    for k in range(frames):
        predicted = own.predict(DT_S if k else 0.0)
        scan = own.build_scan(predicted, blobs(motion(k * DT_S), rng), k * DT_S, DT_S)
        posterior = own.update(predicted, scan)
        own.learn(posterior, DT_S)
        own.accept(posterior, scan, is_seen=True, is_linked=True)


def test_hand_filter_lost_track_keeps_the_learnt_palm() -> None:
    own = HandFilter(calibration(sd_m=2e-3), CAMERA, TrackerSettings())
    calibrated = own.estimate_from_found(FOUND)
    run(own)
    learnt = own.predict(0.0).nominal
    own.drop_track()
    begun = own.estimate_from_found(FOUND)
    assert not np.any(calibrated.value[SHAPE])
    assert np.abs(learnt.value[SHAPE]).max() > 1e-5
    np.testing.assert_allclose(begun.value[SHAPE], learnt.value[SHAPE])
    np.testing.assert_allclose(begun.covariance[SHAPE, SHAPE], learnt.covariance[SHAPE, SHAPE])
    own.begin_at_neutral()
    assert not np.any(own.predict(0.0).nominal.value[SHAPE])


def with_fingers(use_surface: bool) -> tuple[HandFilter, Detections]:
    """The filter of a hand with fingers, all known as calibrated, and the blobs of its first picture."""
    seen = measurement_sequence(RecordingSpec(seed=61, protocol="hand21", motion="fist", seconds=1.0))
    known = calibrate_sequence(seen)
    corner = palm_calibration(known).marker_position_w0_m[:4]
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(-0.02, 0.11, 0.0015), np.arange(-0.05, 0.05, 0.0015)))
    level = np.full(x.size, np.median(corner[:, 2]))
    surface = fit_dorsal_surface(np.stack((x, y, level), axis=1), corner)
    assert surface is not None
    settings = TrackerSettings(use_surface=use_surface)
    return HandFilter(replace(known, surface=surface), seen.truth.camera, settings), seen.detections[0]


def test_hand_filter_lost_hand_has_diffuse_fingers() -> None:
    own, _ = with_fingers(use_surface=False)
    assert own.fingers is not None
    assert own.fingers.joint_speeds == (0.0, 0.0)
    own.drop_track()
    assert min(own.fingers.joint_speeds) > 0.5


def test_hand_filter_skin_moves_with_the_joints_beneath() -> None:
    own, _ = with_fingers(use_surface=True)
    assert own.fingers is not None
    rest = np.diagonal(own.predict(DT_S).nominal.covariance)[SKIN]
    own.fingers.reset_joints()
    assert min(own.fingers.joint_speeds) > 0.5
    moving = np.diagonal(own.predict(DT_S).nominal.covariance)[SKIN]
    assert (moving[3:] > 1.5 * rest[3:]).all()

"""Hands that differ from the tables: how widely, that truth stays true, and that pictures show what is worn."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.hand.clinical_angles import angles_from_rotation, wrist_axes
from carpus.core.model.hand.kinematics import disc_centres
from carpus.core.model.hand.protocols import HAND21
from carpus.core.simulation.patient import MAX_PLACEMENT_ERROR_M
from carpus.core.simulation.recording import SimulatedRecording
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import compute_truth
from tests.simulation.measurements import measurement_sequence

PALM = list(HAND21.palm)


def test_wide_anatomy_varies_more_than_the_prior() -> None:
    usual, wide = (
        [Scene(RecordingSpec(seed=seed, protocol="hand21", anatomy=kind, seconds=0.1)) for seed in range(24)]
        for kind in ("usual", "wide")
    )

    def spread(scenes: list[Scene]) -> np.ndarray:
        heights = np.array([s.patient.anatomy.skin_offset_m / s.patient.size for s in scenes])
        return np.asarray(heights.std(axis=0) / heights.mean(axis=0))

    assert spread(usual)[PALM].max() < 0.13
    assert spread(wide)[PALM].min() > 0.14
    radius = np.array([s.patient.marker_radius_m[0] for s in wide])
    large = radius[radius > 0.0045]
    assert large.min() < 0.0055
    assert large.max() > 0.0063
    depth = np.array([-s.patient.wrist_joint_m[2] / s.patient.size for s in wide])
    assert 0.012 <= depth.min() < 0.014 < 0.018 < depth.max() <= 0.020
    for scene in wide:
        pose = scene.pose(np.zeros(1))
        off = scene.markers_w0_m(pose)[0] - disc_centres(scene.patient.anatomy, pose.joint_angles_rad)[0]
        level = np.linalg.norm(off[:, :2], axis=1)
        assert level[PALM].max() < MAX_PLACEMENT_ERROR_M + 3e-4
        assert 0.001 < np.linalg.norm(scene.patient.placement_error_m, axis=1).mean() < 0.004


@pytest.mark.parametrize(("hand", "anatomy"), [("right", "usual"), ("left", "wide")])
def test_wide_anatomy_truth_counts_from_the_markers_frame(hand: str, anatomy: str) -> None:
    spec = RecordingSpec(seed=22, hand=hand, motion="mixed", anatomy=anatomy)
    scene = Scene(spec)
    truth = compute_truth(scene)
    axes, _ = scene.marker_frame()
    apart_deg = np.degrees(np.arccos(min(1.0, 0.5 * (np.trace(axes) - 1.0))))
    assert apart_deg > 1.0 or anatomy == "usual", "the frames are worth telling apart"
    assert truth.rotation_w0_cam[2, 2] < -0.9, "Z out of the back of the hand, towards the camera"
    still = truth.marker_position_w0_m
    assert still[2, 1] - still[5, 1] > 0.0 if hand == "right" else still[2, 1] - still[5, 1] < 0.0
    np.testing.assert_allclose(still[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(wrist_axes(still, dorsal_direction=np.array([0.0, 0.0, 1.0])), np.eye(3), atol=1e-9)
    # A rigid hand, so every disc follows from the first frame by the told rotation and place alone.
    moved = still @ truth.rotation_w2_w0.transpose(0, 2, 1) + truth.position_m[:, None]
    seen = moved @ truth.rotation_w0_cam.T + truth.translation_w0_cam_m
    np.testing.assert_allclose(seen, truth.marker_position_cam_m, atol=1e-8)
    np.testing.assert_allclose(angles_from_rotation(truth.rotation_w2_w0, hand), truth.angles_rad, atol=1e-12)
    step = truth.time_s[101] - truth.time_s[99]
    speed = (truth.position_m[101] - truth.position_m[99]) / step
    np.testing.assert_allclose(truth.velocity_m_s[100], speed, atol=0.01)
    turn = truth.rotation_w2_w0[99].T @ truth.rotation_w2_w0[101]
    vee = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / step
    np.testing.assert_allclose(truth.angular_velocity_rad_s[100], vee, atol=0.05)


def test_worn_items_are_visible_and_pen_marks_are_not_detected() -> None:
    plain = {
        "seed": 3,
        "protocol": "hand21",
        "sleeve": "none",
        "light": "bright",
        "sensor_noise": False,
        "seconds": 0.1,
    }

    def picture(**options: object) -> np.ndarray:
        return SimulatedRecording(RecordingSpec(**{**plain, **options})).render_clean(0).color  # type: ignore[arg-type]

    bare = picture()
    changed = {
        name: float((np.abs(picture(**options) - bare).max(axis=-1) > 0.02).sum())
        for name, options in {
            "ring": {"worn": "ring"},
            "watch": {"worn": "watch"},
            "bandage": {"worn": "bandage"},
            "pen": {"pen_marks": 8},
        }.items()
    }
    assert 5 < changed["ring"] < 200
    assert 200 < changed["watch"] < changed["bandage"]
    assert 8 < changed["pen"] < 300
    jeans, grey = picture(sleeve="jeans"), picture(sleeve="grey")
    cloth = np.abs(jeans - bare).max(axis=-1) > 0.05
    assert (jeans[cloth][:, 2] / jeans[cloth][:, 0]).mean() > 1.3 * (grey[cloth][:, 2] / grey[cloth][:, 0]).mean()
    with_pen, without = (measurement_sequence(RecordingSpec(seed=3, seconds=0.5, pen_marks=n)) for n in (8, 0))
    assert [len(d) for d in with_pen.detections] == [len(d) for d in without.detections]
    with pytest.raises(SettingsInvalid):
        RecordingSpec(worn="hat")

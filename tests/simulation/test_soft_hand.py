"""A hand that is not rigid: skin glides, the palm cups, the fixed unit stays, and the pictures show just that."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.hand.protocols import HAND21
from carpus.core.simulation.hand_motion import TissueState
from carpus.core.simulation.recording import SimulatedRecording
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.skin import skin_distance
from carpus.core.simulation.spec import HABITS, RecordingSpec
from carpus.core.simulation.truth import compute_truth
from tests.simulation.skin_shown import discs_found_on_the_surface
from tests.suites import few

SOFT: dict[str, Any] = {"skin_glide_mm": 7.0, "cupping": 1.0}
KNUCKLES = [HAND21.markers.index(f"MCP{k}") for k in (2, 3, 4, 5)]
CASES = [
    {"motion": "power_grip", "protocol": "hand21"},
    {"motion": "deviation", "habit": "grip+rolling_forearm", "hand": "left"},
    {"motion": "bend45", "protocol": "hand21", "hand": "left"},
    {"motion": "grasp_mug", "protocol": "hand21"},
    {"motion": "flexion", "habit": "tenodesis"},
]


def scenes(**options: Any) -> tuple[Scene, Scene]:
    """The same patient and motion, rigid and soft."""
    return Scene(RecordingSpec(seed=5, **options)), Scene(RecordingSpec(seed=5, **options, **SOFT))


def min_distance(scene: Scene) -> float:
    """Time of the firmest grip."""
    time_s = np.arange(0.0, scene.spec.seconds, 1.0 / 30.0)
    return float(time_s[scene.pose(time_s).tissue.cup_rad[:, 1].argmax()])


@pytest.mark.parametrize("options", few(CASES))
def test_soft_hand_markers_lie_on_the_surface(options: dict[str, Any]) -> None:
    spec = RecordingSpec(seed=5, depth_delay_s=0.0, sensor_noise=False, exposure_s=0.0, **options, **SOFT)
    pictures = SimulatedRecording(spec)
    frames = [0, round(30 * min_distance(pictures.scene)), 95]
    checked = discs_found_on_the_surface(pictures, frames, least_facing=0.5)
    assert checked > 2 * len(spec.marker_protocol.markers) // 3
    discs = pictures.truth.marker_position_cam_m
    assert np.linalg.norm(discs[frames] - discs[0], axis=-1).max() > 0.010


@pytest.mark.parametrize("options", few(CASES, 2))
def test_soft_hand_keeps_true_angles(options: dict[str, Any]) -> None:
    rigid, soft = (compute_truth(scene) for scene in scenes(**options))
    for name in ("angles_rad", "rotation_w2_w0", "joint_angles_rad", "angular_velocity_rad_s", "position_m"):
        np.testing.assert_array_equal(getattr(rigid, name), getattr(soft, name))
    assert np.linalg.norm(rigid.marker_position_cam_m - soft.marker_position_cam_m, axis=-1).max() > 2e-3
    np.testing.assert_allclose(rigid.marker_position_w0_m, soft.marker_position_w0_m, atol=1e-4)


def test_soft_hand_without_glide_and_cupping_is_rigid() -> None:
    options = {"motion": "fist", "protocol": "hand21", "habit": "restless_clicks"}
    soft = Scene(RecordingSpec(seed=5, **options, skin_glide_mm=1e-9, cupping=0.0))
    rigid = Scene(RecordingSpec(seed=5, **options))
    assert rigid.tissue.is_rigid
    assert not soft.tissue.is_rigid
    time_s = np.linspace(0.0, 8.0, 50)
    pose = rigid.pose(time_s)
    palm = list(HAND21.palm)
    local = (rigid.markers_w0_m(pose) - pose.position_m[:, None]) @ pose.rotation_w2_w0
    np.testing.assert_allclose(np.ptp(local[:, palm], axis=0), 0.0, atol=1e-12)
    away = np.linalg.norm(soft.markers_w0_m(soft.pose(time_s)) - rigid.markers_w0_m(pose), axis=-1)
    still = np.linalg.norm(
        soft.markers_w0_m(soft.pose(np.zeros(1))) - rigid.markers_w0_m(rigid.pose(np.zeros(1))), axis=-1
    )
    assert still.max() < 1e-4
    assert away[:, palm].max() < 2e-3  # what is left is the knuckles' rising
    assert np.delete(away, palm, axis=1).max() < 2e-4


@pytest.mark.parametrize("hand", ["right", "left"])
def test_soft_hand_fixed_unit_is_still_in_a_grip(hand: str) -> None:
    _, soft = scenes(motion="power_grip", protocol="hand21", hand=hand)
    pose = soft.pose(np.array([0.0, min_distance(soft)]))
    discs = soft.patient.anatomy.palm_disc_m * [1.0, -1.0 if hand == "left" else 1.0, 1.0]
    wrist, mcp2, mcp3 = discs[0], discs[2], discs[3]
    open_hand, grip = (soft.skin.cones_w(pose.joint_angles_rad[i], pose.tissue.select(i)) for i in (0, 1))
    for share in np.linspace(0.0, 0.75, 6):
        for end in (mcp2, mcp3):
            place = np.array([*(wrist + share * (end - wrist))[:2], 0.05])
            heights = [height_m(place, cones) for cones in (open_hand, grip)]
            assert abs(heights[1] - heights[0]) < 3e-4, (share, heights)
    # The ring and little side falls, so that the test above is about something.
    side = np.array([*(0.8 * discs[5])[:2], 0.05])
    assert height_m(side, open_hand) - height_m(side, grip) > 5e-3


def height_m(place_m: np.ndarray, cones: Any) -> float:
    """Height of the back of the hand over a place, from above."""
    place, gap_m = place_m.copy(), np.inf
    while abs(gap_m) > 1e-8:
        gap_m = float(skin_distance(place, cones))
        place[2] -= gap_m
    return float(place[2])


def test_soft_hand_knuckles_glide_and_rise() -> None:
    _, soft = scenes(motion="bend45", protocol="hand21", seconds=12.0, speed_hz=0.1)
    pose = soft.pose(np.arange(0.0, 12.0, 0.1))
    local = (soft.markers_w0_m(pose) - pose.position_m[:, None]) @ pose.rotation_w2_w0
    flexion = pose.joint_angles_rad[:, soft.motion.joint_names.index("MCP2_flexion")]
    gone_mm = 1e3 * (local[:, KNUCKLES[0], 0] - local[0, KNUCKLES[0], 0])
    bent = flexion > np.radians(40.0)
    share = np.degrees(flexion[bent] - flexion[0]) / 90.0
    assert bent.sum() > 10
    assert 0.75 * 7.0 * share.mean() < gone_mm[bent].mean() < 1.25 * 7.0 * share.mean()


def test_habits_have_their_effect() -> None:
    time_s = np.arange(0.0, 8.0, 0.02)

    def motion(habit: str, exercise: str = "flexion") -> Scene:
        return Scene(RecordingSpec(seed=5, motion=exercise, habit=habit))

    names = motion("none").motion.joint_names
    middle = names.index("MCP3_flexion")
    plain = motion("none").motion
    assert np.ptp(plain.joint_angles_rad(time_s)[:, middle]) < np.radians(4.0)
    tenodesis = motion("tenodesis").motion
    np.testing.assert_array_equal(tenodesis.wrist_angles_rad(time_s), plain.wrist_angles_rad(time_s))
    closing = (tenodesis.joint_angles_rad(time_s) - plain.joint_angles_rad(time_s))[:, middle]
    extension = -plain.wrist_angles_rad(time_s)[:, 1]
    slope = np.polyfit(extension[extension > 0.3], closing[extension > 0.3], 1)[0]
    assert 0.7 < slope < 1.0
    assert closing[extension < -0.3].max() < 0.0
    grip = motion("grip", "deviation").motion.joint_angles_rad(time_s)[:, middle]
    assert np.median(grip) > np.radians(45.0)
    busy = motion("open_close", "rest").motion.joint_angles_rad(time_s)[:, middle]
    assert np.sum(np.abs(np.diff((busy > np.radians(25.0)).astype(int)))) >= 4
    rolling = motion("rolling_forearm").motion.wrist_angles_rad(time_s) - plain.wrist_angles_rad(time_s)
    assert np.radians(1.0) < np.abs(rolling[:, 2]).max() < np.radians(8.0)
    clicks = motion("restless_clicks").motion
    first = clicks.wrist_angles_rad(np.linspace(0.0, 0.7, 20))
    assert np.radians(0.1) < np.abs(first).max() < np.radians(4.0)
    np.testing.assert_allclose(first[0], 0.0, atol=1e-12)
    assert set(RecordingSpec(habit="grip+tenodesis").habits) < set(HABITS)
    with pytest.raises(SettingsInvalid):
        RecordingSpec(habit="grip+humming")


def test_soft_hand_knuckles_stand_out_in_flexion() -> None:
    _, soft = scenes(motion="bend45", protocol="hand21")
    joints = soft.motion.joint_angles_rad(np.zeros(1))[0]
    still = TissueState.rigid(1).select(0)
    risen = dataclasses.replace(still, rise=np.ones(4))
    disc = soft.patient.anatomy.palm_disc_m[3]
    place = np.array([disc[0] + 0.003, disc[1], 0.05])
    low, high = (height_m(place, soft.skin.cones_w(joints, state)) for state in (still, risen))
    assert 0.3e-3 < high - low < 1.5e-3

"""What the simulated patient does: still start, ranges, smoothness, true velocities, frames and sides."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS
from carpus.core.simulation.hand_motion import STILL_S
from carpus.core.simulation.motions import MOTIONS, create_motion
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import compute_truth


@pytest.mark.parametrize("option", [{"dropped_share": 1.5}, {"seconds": 0.0}, {"skin_tone": 9}, {"motion": "dance"}])
def test_recording_spec_impossible_options_are_refused(option: dict) -> None:
    with pytest.raises(SettingsInvalid):
        create_motion(RecordingSpec(**option))


@pytest.mark.parametrize("name", MOTIONS)
def test_motion_starts_still_and_is_continuous(name: str) -> None:
    motion = create_motion(RecordingSpec(seed=3, motion=name, protocol="hand21", seconds=6.0, tremor_deg=1.0))
    still = np.linspace(0.0, 0.7, 20)
    assert STILL_S >= 0.7
    np.testing.assert_allclose(motion.wrist_angles_rad(still), 0.0, atol=1e-12)
    np.testing.assert_allclose(np.ptp(motion.joint_angles_rad(still), axis=0), 0.0, atol=1e-12)
    np.testing.assert_allclose(motion.arm_displacement_m(still), 0.0, atol=1e-12)
    fine = np.arange(0.0, 6.0, 0.001)
    for channel in (motion.wrist_angles_rad(fine), motion.joint_angles_rad(fine), motion.arm_displacement_m(fine)):
        speed = np.diff(channel, axis=0) / 0.001
        assert np.abs(np.diff(speed, axis=0)).max() < 0.5  # a jump in posture would be of the order of 1000


def test_motion_follows_the_options() -> None:
    time_s = np.arange(0.0, 12.0, 0.01)

    def flexion(**options: object) -> np.ndarray:
        spec = RecordingSpec(seed=1, motion="flexion", seconds=12.0, **options)  # type: ignore[arg-type]
        return np.degrees(create_motion(spec).wrist_angles_rad(time_s)[:, 1])

    def crossings(angle: np.ndarray) -> int:
        return int(np.count_nonzero(np.diff(np.sign(angle - 5.0)) > 0))

    assert np.abs(flexion(range_share=0.4)).max() < 24.0
    assert np.abs(flexion(pain_limited=True)).max() < 0.75 * np.abs(flexion()).max()
    assert crossings(flexion(repetitions=2)) == 2
    assert crossings(flexion(speed_hz=0.6)) > crossings(flexion(speed_hz=0.3))
    shaking = flexion(tremor_deg=3.0, range_share=0.0)[200:]
    spectrum = np.abs(np.fft.rfft(shaking - shaking.mean()))
    assert np.fft.rfftfreq(len(shaking), 0.01)[spectrum.argmax()] == pytest.approx(5.0, abs=0.2)


def test_motion_reach_matches_measured_people() -> None:
    time_s = np.arange(0.0, 4.0, 0.002)
    carry = create_motion(RecordingSpec(seed=2, motion="reach", seconds=4.0)).arm_displacement_m(time_s)
    speed = np.linalg.norm(np.gradient(carry, 0.002, axis=0), axis=1)
    assert 0.36 < np.linalg.norm(carry, axis=1).max() < 0.40
    assert 0.60 < speed.max() < 0.80
    moving = speed > 0.05 * speed.max()
    first = np.flatnonzero(moving)[0]
    last = first + np.flatnonzero(~moving[first:])[0]
    assert 0.7 < time_s[last] - time_s[first] < 1.15


def test_motion_dip_coupled_and_free() -> None:
    time_s = np.arange(0.0, 6.0, 0.05)
    coupled = create_motion(RecordingSpec(motion="hook", protocol="hand21"))
    free = create_motion(RecordingSpec(motion="hook", protocol="hand21", dip="free"))
    assert len(coupled.joint_names) == 17
    assert len(free.joint_names) == 21
    end = np.degrees(free.joint_angles_rad(time_s)[:, free.joint_names.index("DIP3_flexion")])
    middle = np.degrees(free.joint_angles_rad(time_s)[:, free.joint_names.index("PIP3_flexion")])
    assert 40.0 < end.max() < 48.0
    assert middle.max() > 75.0


def test_scene_palm_markers_are_rigid() -> None:
    truth = compute_truth(Scene(RecordingSpec(seed=5, motion="mixed", protocol="hand21")))
    palm = truth.marker_position_cam_m[:, [HAND21.markers.index(name) for name in PALM_MARKERS]]
    gaps = np.linalg.norm(palm[:, :, None] - palm[:, None], axis=-1)
    assert np.ptp(gaps, axis=0).max() < 1e-12


def test_truth_velocities_are_derivatives() -> None:
    spec = RecordingSpec(seed=8, motion="reach_grasp", protocol="hand21", seconds=3.0)
    scene = Scene(spec)
    truth = compute_truth(scene)
    h = 1e-3
    before, after = scene.pose(truth.time_s - h), scene.pose(truth.time_s + h)
    np.testing.assert_allclose(truth.velocity_m_s, (after.position_m - before.position_m) / (2 * h), atol=2e-3)
    np.testing.assert_allclose(
        truth.joint_velocity_rad_s, (after.joint_angles_rad - before.joint_angles_rad) / (2 * h), atol=2e-2
    )
    turn = before.rotation_w2_w0.transpose(0, 2, 1) @ after.rotation_w2_w0
    angle = np.arccos(np.clip((np.trace(turn, axis1=1, axis2=2) - 1.0) / 2.0, -1.0, 1.0))
    speed = np.linalg.norm(truth.angular_velocity_rad_s, axis=1)
    np.testing.assert_allclose(speed, angle / (2 * h), atol=2e-2)
    axis = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], -1)
    fast = speed > 0.2
    assert fast.sum() > 5
    along = np.sum(axis * truth.angular_velocity_rad_s, axis=1)[fast]
    assert (along / (np.linalg.norm(axis, axis=1) * speed)[fast]).min() > 0.999


def test_scene_left_hand_mirrors_the_right() -> None:
    right = RecordingSpec(seed=9, motion="thumb", protocol="hand21", yaw_deg=0.0, tilt_deg=0.0)
    a, b = Scene(right), Scene(dataclasses.replace(right, hand="left"))
    times = np.linspace(0.0, 6.0, 30)
    one, two = a.pose(times), b.pose(times)
    mirror = np.array([1.0, -1.0, 1.0])
    np.testing.assert_allclose(one.angles_rad, two.angles_rad, atol=1e-12)
    np.testing.assert_allclose(one.joint_angles_rad, two.joint_angles_rad, atol=1e-12)
    np.testing.assert_allclose(
        a.markers_w0_m(one) - one.arm_displacement_m[:, None],
        (b.markers_w0_m(two) - two.arm_displacement_m[:, None]) * mirror,
        atol=1e-9,
    )
    cones_a, cones_b = a.skin.cones_w(one.joint_angles_rad[9]), b.skin.cones_w(two.joint_angles_rad[9])
    np.testing.assert_allclose(cones_a.b_m, cones_b.b_m * mirror, atol=1e-9)
    np.testing.assert_allclose(cones_a.radius_b_m, cones_b.radius_b_m, atol=1e-9)

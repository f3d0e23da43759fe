"""The wrist frame by clinical reference 1.1, and signs of its angles by hand-made poses (1.2 to 1.4) for both hands."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.model import so3
from carpus.core.model.hand import clinical_angles
from carpus.core.model.hand.clinical_angles import angles_from_rotation, side_sign, wrist_axes, wrist_axes_sensitivity
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.forearm_rotation import (
    from_clinical_targets_deg,
    pronosupination_from_palm_down,
    supination_from_thumb_up,
    to_clinical_targets_deg,
    to_clinical_wrist_angles,
)
from carpus.core.model.types import FloatArray, Side
from tests.tracking.hands import CAMERA, CMC1, FROM_ABOVE, MCP2, MCP3, MCP5, RIGHT_PALM_M, WRIST, palm

DEVIATION, FLEXION, PRONOSUPINATION = range(3)
SIDES: tuple[Side, Side] = ("right", "left")


DISTANCE_M = 0.7


def seen(rotation: FloatArray, side: Side) -> tuple[FloatArray, FloatArray]:
    """Pixels (6, 2) and depths (6,) of the palm turned about the WRIST disc."""
    discs = palm(side) @ rotation.T @ FROM_ABOVE.T + [0.0, 0.0, DISTANCE_M]
    return CAMERA.project(discs), discs[:, 2]


def pose(side: Side, which: int, degrees: float) -> FloatArray:
    angles = np.zeros(3)
    angles[which] = math.radians(degrees)
    return clinical_angles.rotation_from_angles(angles, side)


def towards_the_thumb(side: Side) -> float:
    """Which way in the picture the thumb is: the right hand's on the left (reference 1.1)."""
    return -1.0 if side == "right" else 1.0


@pytest.mark.parametrize("side", SIDES)
def test_hand_lies_before_camera_as_reference_says(side: Side) -> None:
    pixel, depth = seen(np.eye(3), side)
    assert pixel[MCP3, 1] < pixel[WRIST, 1] - 50.0, "fingers point to the top of the picture"
    assert np.sign(pixel[CMC1, 0] - pixel[WRIST, 0]) == towards_the_thumb(side)
    assert depth[CMC1] > depth[WRIST], "the arch falls away from the camera"


@pytest.mark.parametrize("side", SIDES)
def test_radial_deviation_turns_the_hand_towards_the_thumb(side: Side) -> None:
    pixel, depth = seen(pose(side, DEVIATION, 10.0), side)
    still_px, still_depth = seen(np.eye(3), side)
    shift_px = pixel[MCP3] - still_px[MCP3]
    assert np.sign(shift_px[0]) == towards_the_thumb(side)
    # A turn in the picture by ten degrees about WRIST: the distance stays, the depths stay.
    assert np.linalg.norm(pixel[MCP3] - pixel[WRIST]) == pytest.approx(np.linalg.norm(still_px[MCP3] - still_px[WRIST]))
    assert np.allclose(depth, still_depth)
    along = pixel[MCP3] - pixel[WRIST]
    assert math.degrees(math.atan2(abs(along[0]), -along[1])) == pytest.approx(10.0)


@pytest.mark.parametrize("side", SIDES)
def test_flexion_sends_the_fingers_away_from_the_camera(side: Side) -> None:
    pixel, depth = seen(pose(side, FLEXION, 30.0), side)
    still_px, still_depth = seen(np.eye(3), side)
    assert depth[MCP3] - still_depth[MCP3] == pytest.approx(0.082 * math.sin(math.radians(30.0)))
    assert np.linalg.norm(pixel[MCP3] - pixel[WRIST]) < 0.9 * np.linalg.norm(still_px[MCP3] - still_px[WRIST])
    raised = seen(pose(side, FLEXION, -30.0), side)[1]
    assert raised[MCP3] < still_depth[MCP3] - 0.03, "extension lifts the hand towards the camera"


@pytest.mark.parametrize("side", SIDES)
def test_supination_raises_the_thumbs_side(side: Side) -> None:
    pixel, depth = seen(pose(side, PRONOSUPINATION, 20.0), side)
    still_px, still_depth = seen(np.eye(3), side)
    assert depth[MCP2] < still_depth[MCP2] - 0.005
    assert depth[MCP5] > still_depth[MCP5] + 0.005
    assert abs(pixel[MCP2, 0] - pixel[MCP5, 0]) < abs(still_px[MCP2, 0] - still_px[MCP5, 0]), "the palm narrows"


@pytest.mark.parametrize("side", SIDES)
def test_angles_and_their_rates_are_those_of_scipys_rotation_and_its_mirror(side: Side) -> None:
    """R' = M R M with M = diag(1, -1, 1) for the left hand, reference 1.2; the right one is SciPy's Z-Y-X."""
    angles = np.radians(np.random.default_rng(1).uniform([-170.0, -89.0, -170.0], [170.0, 89.0, 170.0], (200, 3)))
    angles[0], angles[1] = 0.0, [0.0, math.pi / 2.0, 0.0]
    mirror = np.diag([1.0, 1.0 if side == "right" else -1.0, 1.0])
    rotation = clinical_angles.rotation_from_angles(angles, side)
    assert np.allclose(rotation, mirror @ Rotation.from_euler("ZYX", angles).as_matrix() @ mirror, atol=1e-15)
    found, rates = (
        clinical_angles.angles_from_rotation(rotation, side),
        clinical_angles.angle_rates_matrix(rotation, side),
    )
    assert np.allclose(np.delete(found - angles, 1, axis=0), 0.0, atol=1e-9)
    calm = np.abs(angles[:, 1]) < np.radians(80.0)
    for axis, step in enumerate(1e-5 * np.eye(3)):
        ahead, back = (clinical_angles.angles_from_rotation(rotation[calm] @ so3.exp(by), side) for by in (step, -step))
        turned = (ahead - back + np.pi) % (2.0 * np.pi) - np.pi
        assert np.allclose(rates[calm, :, axis], turned / 2e-5, rtol=1e-6, atol=1e-6)
    for i, one in enumerate(rotation):
        angles_of_one, rates_of_one, _ = clinical_angles.compute_wrist_angles(one, side)
        assert np.allclose(angles_of_one, found[i], rtol=0.0, atol=1e-12)
        assert np.allclose(rates_of_one, rates[i], rtol=1e-9, atol=1e-12)


def test_zyz_is_the_papers_parametrisation_and_nan_near_neutral() -> None:
    angles = np.random.default_rng(2).uniform([-179.0, 3.1, -179.0], [179.0, 176.0, 179.0], (100, 3))
    angles[0], angles[1] = (40.0, 0.0, -10.0), (40.0, 2.999, -10.0)
    rotation = Rotation.from_euler("ZYZ", angles, degrees=True).as_matrix()
    found = np.degrees([clinical_angles.compute_wrist_angles(one, "right")[2] for one in rotation])
    assert np.isnan(found[:2]).all()
    assert np.allclose(found[2:], angles[2:], atol=1e-6)


UP = np.array([0.0, 0.0, 1.0])


def place_palm(side: Side, seed: int) -> tuple[FloatArray, FloatArray]:
    """The palm somewhere in space, and the direction its back faces there."""
    rng = np.random.default_rng(seed)
    rotation = so3.exp(rng.normal(size=3))
    return palm(side) @ rotation.T + rng.normal(size=3), rotation @ UP


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("seed", range(2))
def test_wrist_axes_match_the_definition(side: Side, seed: int) -> None:
    discs, back = place_palm(side, seed)
    axes = wrist_axes(discs, back)
    x, y, z = axes.T
    assert np.allclose(axes.T @ axes, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0), "right-handed on both hands"
    along = discs[3] - discs[0]
    assert np.allclose(x, along / np.linalg.norm(along))
    assert z @ back > 0.9, "Z out of the back of the hand"
    assert np.allclose(y, np.cross(z, x))
    # Y is on the thumb's side of a right hand, on the other side of a left one.
    assert np.sign((discs[2] - discs[5]) @ y) == (1.0 if side == "right" else -1.0)


def test_wrist_axes_z_is_the_least_squares_normal() -> None:
    discs, back = place_palm("right", 3)
    plane = discs[[0, 2, 3, 4, 5]]
    normal = np.linalg.svd(plane - plane.mean(axis=0))[2][2]
    x = (discs[3] - discs[0]) / np.linalg.norm(discs[3] - discs[0])
    z = normal - (normal @ x) * x
    z *= np.sign(z @ back) / np.linalg.norm(z)
    assert np.allclose(wrist_axes(discs, back)[:, 2], z, atol=1e-12)


def test_wrist_axes_turn_with_the_palm_in_batches() -> None:
    rotations = so3.exp(np.random.default_rng(5).normal(size=(12, 3)))
    toward = np.array([0.0, 0.0, -1.0])
    facing = (rotations @ UP) @ toward
    rotations, facing = rotations[np.abs(facing) > 0.2], facing[np.abs(facing) > 0.2]  # none edge-on
    assert {-1.0, 1.0} == set(np.sign(facing))
    discs = RIGHT_PALM_M @ np.swapaxes(rotations, -1, -2)
    for rotation, side, axes in zip(rotations, np.sign(facing), wrist_axes(discs, toward), strict=True):
        # Seen from the palm's side the frame is the same but for a half turn about X.
        flip = np.diag([1.0, side, side])
        assert np.allclose(axes, rotation @ wrist_axes(RIGHT_PALM_M, UP) @ flip, atol=1e-12)


def test_wrist_axes_sensitivity_matches_finite_differences() -> None:
    rng = np.random.default_rng(6)
    axes, sensitivity = wrist_axes_sensitivity(RIGHT_PALM_M, UP)
    assert np.allclose(axes, wrist_axes(RIGHT_PALM_M, UP))
    for _ in range(20):
        shift_m = 2e-5 * rng.normal(size=(6, 3))
        turn = so3.log(axes.T @ wrist_axes(RIGHT_PALM_M + shift_m, UP))
        assert np.allclose(sensitivity @ shift_m.ravel(), turn, rtol=0.0, atol=1e-6)
        assert np.linalg.norm(turn) > 1e-5


DISTAL = np.array([1.0, 0.0, 0.0])
POSES = {
    "palm flat on the table": (UP, -90.0),
    "thumb up": (None, 0.0),
    "palm up": (-UP, 90.0),
}
"""Where the back of the hand looks in the room (None: away from the body's middle), and supination from thumb up."""


def palm_m(back: FloatArray, side: Side) -> FloatArray:
    """The palm's discs (6, 3) in the room, fingers along X, of a hand whose back looks in a direction."""
    radial = side_sign(side) * np.cross(back, DISTAL)
    along = np.array([0.0, 13.1, 80.5, 80.3, 73.6, 66.2]) / 1e3
    across = np.array([0.0, 15.7, 20.1, 0.0, -16.5, -32.2]) / 1e3
    return along[:, None] * DISTAL + across[:, None] * radial


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("pose", POSES)
def test_supination_of_a_textbook_pose_is_the_clinics_number(pose: str, side: Side) -> None:
    neutral = wrist_axes(palm_m(UP, side), UP)
    back, expected_deg = POSES[pose]
    # Thumb up, fingers forward: the back of a right hand looks to the right (-Y), of a left one to the left.
    back = np.array([0.0, -side_sign(side), 0.0]) if back is None else back
    moved = wrist_axes(palm_m(back, side), back)
    angles = angles_from_rotation(neutral.T @ moved, side)
    assert math.degrees(float(supination_from_thumb_up(angles[2]))) == pytest.approx(expected_deg, abs=1e-6)


def test_forearm_rotation_signs_and_turns_round_trip() -> None:
    deg = np.array([-179.0, -20.0, 0.0, 65.0, 90.0, 135.0, 180.0])
    read = np.degrees(supination_from_thumb_up(np.radians(deg)))
    assert read == pytest.approx([91.0, -110.0, -90.0, -25.0, 0.0, 45.0, 90.0])
    assert np.degrees(pronosupination_from_palm_down(np.radians(read))) == pytest.approx(deg)


def test_clinical_angle_includes_the_measured_start() -> None:
    """A forearm that starts at 60 degrees of pronation has + 30 from palm down in the file, and so reads 60."""
    stored = np.radians([[0.0, 0.0, 30.0], [0.0, 0.0, 90.0]])
    start = np.radians([0.0, 0.0, 30.0])
    turned = to_clinical_wrist_angles(stored, get_exercise("FOREARM_PS"), start)
    assert np.degrees(turned[:, 2]) == pytest.approx([-60.0, 0.0])
    aside = to_clinical_wrist_angles(stored, get_exercise("WRIST_FE"), start)
    assert np.degrees(aside[:, 2]) == pytest.approx([0.0, 60.0])  # rotation from the start
    assert np.array_equal(aside[:, :2], stored[:, :2])


def test_targets_of_an_older_version_are_converted_and_those_of_other_exercises_stay() -> None:
    turn, bend = get_exercise("FOREARM_PS"), get_exercise("WRIST_FE")
    assert to_clinical_targets_deg((60.0, -20.0), turn) == (-30.0, -110.0)
    assert to_clinical_targets_deg((60.0, -20.0), bend) == (60.0, -20.0)
    assert from_clinical_targets_deg(to_clinical_targets_deg((60.0, math.nan), turn), turn)[0] == 60.0
    assert math.isnan(to_clinical_targets_deg((60.0, math.nan), turn)[1])

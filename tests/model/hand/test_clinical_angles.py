"""Signs by hand-made poses (clinical reference 1.2 to 1.4) for both hands, before the camera of reference 1.1."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from carpus.core.model import so3
from carpus.core.model.hand import clinical_angles
from carpus.core.model.types import FloatArray, Side
from tests.tracking.hands import CAMERA, CMC1, FROM_ABOVE, MCP2, MCP3, MCP5, WRIST, palm

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


@settings(deadline=None)
@given(st.floats(-170.0, 170.0), st.floats(-89.0, 89.0), st.floats(-170.0, 170.0), st.sampled_from(SIDES))
def test_angles_from_rotation_inverts_rotation_from_angles(
    deviation: float, flexion: float, pronosupination: float, side: Side
) -> None:
    angles = np.radians([deviation, flexion, pronosupination])
    rotation = clinical_angles.rotation_from_angles(angles, side)
    assert np.allclose(clinical_angles.angles_from_rotation(rotation, side), angles, atol=1e-9)


@settings(deadline=None)
@given(st.floats(-60.0, 60.0), st.floats(-80.0, 80.0), st.floats(-60.0, 60.0))
def test_left_hand_is_right_one_in_mirror(deviation: float, flexion: float, supination: float) -> None:
    """R' = M R M with M = diag(1, -1, 1), reference 1.2; and the right one is SciPy's Z-Y-X."""
    angles = np.radians([deviation, flexion, supination])
    right = clinical_angles.rotation_from_angles(angles, "right")
    left = clinical_angles.rotation_from_angles(angles, "left")
    mirror = np.diag([1.0, -1.0, 1.0])
    assert np.allclose(left, mirror @ right @ mirror, atol=1e-15)
    assert np.allclose(right, Rotation.from_euler("ZYX", angles).as_matrix(), atol=1e-15)


@settings(deadline=None)
@given(
    st.floats(-80.0, 80.0), st.floats(-80.0, 80.0), st.floats(-80.0, 80.0), st.sampled_from(SIDES), st.integers(0, 2)
)
def test_rates_of_the_angles_against_finite_differences(
    deviation: float, flexion: float, supination: float, side: Side, axis: int
) -> None:
    rotation = clinical_angles.rotation_from_angles(np.radians([deviation, flexion, supination]), side)
    step = np.zeros(3)
    step[axis] = 1e-5
    ahead = clinical_angles.angles_from_rotation(rotation @ so3.exp(step), side)
    back = clinical_angles.angles_from_rotation(rotation @ so3.exp(-step), side)
    rates = clinical_angles.angle_rates_matrix(rotation, side)[:, axis]
    assert np.allclose(rates, (ahead - back) / 2e-5, rtol=1e-6, atol=1e-7)


@settings(deadline=None)
@given(st.floats(-180.0, 180.0), st.floats(-90.0, 90.0), st.floats(-180.0, 180.0), st.sampled_from(SIDES))
@example(0.0, 0.0, 0.0, "right")
@example(0.0, 90.0, 0.0, "left")
def test_compute_wrist_angles_matches_the_batch_functions(
    deviation: float, flexion: float, supination: float, side: Side
) -> None:
    rotation = clinical_angles.rotation_from_angles(np.radians([deviation, flexion, supination]), side)
    angles, rates, zyz = clinical_angles.compute_wrist_angles(rotation, side)
    assert np.allclose(angles, clinical_angles.angles_from_rotation(rotation, side), rtol=0.0, atol=1e-12)
    assert np.allclose(rates, clinical_angles.angle_rates_matrix(rotation, side), rtol=1e-9, atol=1e-12)
    assert np.allclose(zyz, clinical_angles.zyz_from_rotation(rotation), rtol=0.0, atol=1e-12, equal_nan=True)


@settings(deadline=None)
@given(st.floats(-179.0, 179.0), st.floats(3.1, 176.0), st.floats(-179.0, 179.0))
def test_zyz_is_the_papers_parametrisation(alpha: float, beta: float, gamma: float) -> None:
    rotation = Rotation.from_euler("ZYZ", [alpha, beta, gamma], degrees=True).as_matrix()
    found = np.degrees(clinical_angles.zyz_from_rotation(rotation))
    assert np.allclose(found, [alpha, beta, gamma], atol=1e-6)


@pytest.mark.parametrize("beta_deg", [0.0, 2.999])
def test_zyz_near_neutral_is_nan(beta_deg: float) -> None:
    rotation = Rotation.from_euler("ZYZ", [40.0, beta_deg, -10.0], degrees=True).as_matrix()
    assert np.isnan(clinical_angles.zyz_from_rotation(rotation)).all()

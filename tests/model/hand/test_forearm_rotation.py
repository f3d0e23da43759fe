"""Pronation and supination have one zero for clinicians, thumb up, and one in the files, palm down."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.model.hand.clinical_angles import angles_from_rotation, side_sign, wrist_axes
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.forearm_rotation import (
    from_clinical_targets_deg,
    pronosupination_from_palm_down,
    supination_from_thumb_up,
    to_clinical_targets_deg,
    to_clinical_wrist_angles,
)
from carpus.core.model.types import FloatArray, Side

DISTAL, UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
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

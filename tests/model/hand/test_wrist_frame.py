"""The wrist frame from palm discs against its definition in the clinical reference 1.1."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model import so3
from carpus.core.model.hand.clinical_angles import wrist_axes, wrist_axes_sensitivity
from carpus.core.model.types import FloatArray, Side
from tests.tracking.hands import RIGHT_PALM_M, palm

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

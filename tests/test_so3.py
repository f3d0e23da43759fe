"""Rotations against SciPy's and against their own definitions, close to no turn and close to half a turn."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.model import so3
from carpus.core.model.types import FloatArray

ANGLES_RAD = np.array(
    [
        0.0,
        *10.0 ** np.linspace(-12.0, -1.0, 23),
        *np.linspace(0.1, 3.1, 16),
        *(np.pi - 10.0 ** np.linspace(-12.0, -1.0, 23)),
    ]
)
"""From a picoradian to as little short of half a turn: the series of the code take over inside."""


def random_turns(count: int, most_rad: float, seed: int = 0) -> FloatArray:
    rng = np.random.default_rng(seed)
    axes = rng.normal(size=(count, 3))
    return axes / np.linalg.norm(axes, axis=1, keepdims=True) * rng.uniform(0.0, most_rad, (count, 1))


def turn_between(a: FloatArray, b: FloatArray) -> float:
    """Angle between two rotations, from their difference: good to the last digits also where it is tiny."""
    return float(2.0 * np.arcsin(np.clip(np.linalg.norm(a - b) / np.sqrt(8.0), 0.0, 1.0)))


def test_exponential_is_scipys_rotation_and_the_logarithm_undoes_it() -> None:
    for axis in random_turns(12, 1.0, seed=1):
        for angle in ANGLES_RAD:
            turn = axis / np.linalg.norm(axis) * angle
            rotation = so3.exp(turn)
            assert np.allclose(rotation, Rotation.from_rotvec(turn).as_matrix(), rtol=0.0, atol=1e-14)
            assert np.allclose(rotation @ rotation.T, np.eye(3), rtol=0.0, atol=1e-14)
            back = so3.log(rotation)
            # Half a turn about an axis is also half a turn about the opposite one: then the rotation is compared.
            assert np.linalg.norm(back) <= np.pi + 1e-12
            assert turn_between(so3.exp(back), rotation) < 1e-7
            if angle < np.pi - 1e-6:
                assert np.allclose(back, turn, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("short_of_pi", [1e-2, 1e-3, 2e-4, 1.01e-4, 0.99e-4, 1e-5, 1e-6, 1e-7, 1e-9, 0.0])
def test_logarithm_near_half_a_turn_keeps_the_axis(short_of_pi: float) -> None:
    for turn in random_turns(50, np.pi, seed=3):
        axis = turn / np.linalg.norm(turn)
        back = so3.log(so3.exp(axis * (np.pi - short_of_pi)))
        assert np.linalg.norm(back) == pytest.approx(np.pi - short_of_pi, abs=1e-8)
        across = np.linalg.norm(np.cross(axis, back / np.linalg.norm(back)))
        assert across < 1e-7


def test_exponential_and_logarithm_work_on_batches_as_one_by_one() -> None:
    turns = random_turns(60, 3.1).reshape(4, 15, 3)
    turns[0, 0] = 0.0
    turns[1, 2] = [0.0, np.pi, 0.0]
    rotations = so3.exp(turns)
    assert rotations.shape == (4, 15, 3, 3)
    assert np.allclose(rotations[2, 7], so3.exp(turns[2, 7]), rtol=0.0, atol=1e-15)  # another order of sums
    assert np.array_equal(so3.log(rotations)[1, 3], so3.log(rotations[1, 3]))
    assert np.allclose(so3.log(rotations), turns, atol=1e-8)


def test_nearest_rotation_is_the_least_squares_one() -> None:
    rng = np.random.default_rng(7)
    rotations = so3.exp(random_turns(30, 3.0, seed=8))
    matrices = rotations + 0.2 * rng.normal(size=rotations.shape)
    nearest = so3.project_to_rotation(matrices)
    for matrix, found in zip(matrices, nearest, strict=True):
        assert np.allclose(found @ found.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(found) == pytest.approx(1.0)
        reached = np.linalg.norm(found - matrix)
        for turn in random_turns(40, 0.3, seed=9):
            assert np.linalg.norm(found @ so3.exp(turn) - matrix) >= reached - 1e-12


def test_nearest_rotation_of_a_mirror_is_no_mirror() -> None:
    mirror = np.diag([1.0, 1.0, -1.0])
    mirror[2, 2] = -0.4
    found = so3.project_to_rotation(mirror)
    assert np.allclose(found, np.eye(3), atol=1e-12)

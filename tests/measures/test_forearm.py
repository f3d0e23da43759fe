"""A forearm that lies still is not said to move, and one that moves is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.measures.wrist_centre import estimate_wrist_centre
from carpus.core.model import so3
from carpus.core.model.types import FloatArray

CENTRE_M = np.array([0.004, -0.002, -0.018])


def make_flexion(centre_m: FloatArray, degrees: float = 60.0, count: int = 300) -> tuple[FloatArray, FloatArray]:
    """Places of the disc and rotations of a hand that bends about a centre that stays."""
    angle = math.radians(degrees) * np.sin(np.linspace(0.0, 6 * math.pi, count))
    rotation = so3.exp(np.column_stack((0.1 * angle, angle, 0.2 * np.cos(angle))))
    return centre_m - rotation @ centre_m, rotation


def add_noise(position_m: FloatArray) -> FloatArray:
    return position_m + np.random.default_rng(2).normal(0.0, 0.0005, position_m.shape)


def test_wrist_centre_of_flexion_is_found_and_still() -> None:
    position, rotation = make_flexion(CENTRE_M)
    found = estimate_wrist_centre(add_noise(position), rotation, np.ones(len(position), dtype=bool))
    assert np.linalg.norm(position - position[0], axis=1).max() > 0.015, "the disc itself does"
    assert found.centre_w2_m == pytest.approx(CENTRE_M, abs=1e-3)
    assert found.residual_m == pytest.approx(0.0005 * math.sqrt(3.0), rel=0.2)
    assert found.displacement_m.max() < 0.003


def test_wrist_centre_moving_forearm_shows_displacement() -> None:
    position, rotation = make_flexion(CENTRE_M)
    position = position.copy()
    position[210:260, 0] += 0.02
    found = estimate_wrist_centre(position, rotation, np.ones(len(position), dtype=bool))
    assert found.displacement_m[210:260].min() == pytest.approx(0.02, rel=0.1)
    assert found.displacement_m[:200].max() < 0.003


def test_wrist_centre_without_rotation_is_default_and_without_data_unknown() -> None:
    position, rotation = make_flexion(CENTRE_M, degrees=1.0)
    found = estimate_wrist_centre(add_noise(position), rotation, np.ones(len(position), dtype=bool))
    assert np.linalg.norm(found.centre_w2_m - [0.0, 0.0, -0.015]) < 0.015
    unseen = estimate_wrist_centre(position, rotation, np.zeros(len(position), dtype=bool))
    assert math.isnan(unseen.residual_m)
    assert np.isnan(unseen.displacement_m).all()

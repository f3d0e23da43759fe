"""The filter as written down is the filter that is computed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.digit_filter import DIGIT_SIZE, DigitMotion
from carpus.core.tracking.filter.hand_geometry import N_CONSTANTS, N_DIGITS, N_DISCS, N_SLOTS
from carpus.core.tracking.filter.motion import MotionNoise, PalmMotion, palm_transition
from carpus.core.tracking.filter.palm_state import N_PALM_DISCS, RIGID_MOTION, SIZE
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import (
    SoftTissue,
    TissueModes,
    joint_driven_modes,
    resting_and_moving_modes,
)
from carpus.core.tracking.filter.state_model import (
    DIGIT_MEASUREMENTS,
    DIGIT_STATE,
    PALM_MEASUREMENTS,
    PALM_STATE,
    StatePart,
)
from tests.sources import SOURCES
from tests.test_document_names import is_there


@pytest.mark.parametrize(("parts", "size"), [(PALM_STATE, SIZE), (DIGIT_STATE, DIGIT_SIZE)])
def test_every_number_of_the_state_is_told_once(parts: tuple[StatePart, ...], size: int) -> None:
    rows = [row for part in parts for row in range(part.rows.start, part.rows.stop)]
    assert rows == list(range(size))


@SOURCES
def test_every_name_that_is_told_is_in_the_program() -> None:
    told = [name for part in (*PALM_STATE, *DIGIT_STATE) for name in part.source]
    told += [name for part in (*PALM_MEASUREMENTS, *DIGIT_MEASUREMENTS) for name in (*part.h, *part.r)]
    assert [name for name in told if not is_there(name)] == []
    assert PALM_MEASUREMENTS[0].size == 3 * N_PALM_DISCS
    assert DIGIT_MEASUREMENTS[0].size == 3 * N_DISCS


def moved_by(forward: FloatArray, parts: tuple[StatePart, ...]) -> dict[str, tuple[str, ...]]:
    """What a transition puts into each part, beside itself."""
    return {
        into.name: tuple(of.name for of in parts if of is not into and np.any(forward[into.rows, of.rows]))
        for into in parts
    }


@pytest.mark.parametrize("tissue", [resting_and_moving_modes, joint_driven_modes])
def test_the_palm_moves_as_told(tissue: Callable[[SoftTissue], TissueModes]) -> None:
    settings = TrackerSettings()
    motion = PalmMotion(MotionNoise(), tissue(settings.tissue), np.array(settings.mode_scales))
    step = palm_transition(np.array([0.3, -0.2, 0.5]), motion, 0.03)
    moving = tuple(part for part in PALM_STATE if part.rows.stop <= RIGID_MOTION.stop)
    assert moved_by(step.moving, moving) == {part.name: part.moved_by for part in moving}
    assert all(not part.moved_by for part in PALM_STATE if part not in moving)
    assert all(np.diagonal(step.driven[0])[part.rows].min() > 0.0 for part in moving)


def test_a_digit_moves_as_told() -> None:
    free = np.ones((N_DIGITS, N_SLOTS))
    motion = DigitMotion(free, np.array([1.0]), np.ones((N_DIGITS, N_CONSTANTS)), np.zeros((N_DIGITS, N_SLOTS)), 1.0)
    forward, noise = motion.compute_transition(0.03, np.ones(N_DIGITS), None)
    assert moved_by(forward[2], DIGIT_STATE) == {part.name: part.moved_by for part in DIGIT_STATE}
    assert np.diagonal(noise[2]).min() > 0.0

"""The tables of the state in resources/method.md say what is computed."""

from __future__ import annotations

import re
from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter import digit_filter, palm_state
from carpus.core.tracking.filter.digit_filter import DIGIT_SIZE, DigitMotion
from carpus.core.tracking.filter.hand_geometry import N_CONSTANTS, N_DIGITS, N_SLOTS
from carpus.core.tracking.filter.motion import MotionNoise, PalmMotion, palm_transition
from carpus.core.tracking.filter.palm_state import RIGID_MOTION, SIZE
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import (
    SoftTissue,
    TissueModes,
    joint_driven_modes,
    resting_and_moving_modes,
)
from tests.sources import ROOT, SOURCES

pytestmark = SOURCES


def read_state(module: ModuleType) -> tuple[dict[str, slice], dict[str, set[str]]]:
    """Read the rows of each part of a state, and the parts that F adds to it, from the document."""
    name = module.__name__.rsplit(".", 1)[1]
    text = (ROOT / "resources" / "method.md").read_text(encoding="utf-8")
    lines = [line.split("|") for line in text.splitlines() if line.startswith(f"| `{name}.")]
    parts = [re.findall(rf"{name}\.(\w+)", cells[1])[0] for cells in lines]
    added = [set(re.findall(rf"{name}\.(\w+)", cells[4])) for cells in lines]
    return {part: getattr(module, part) for part in parts}, dict(zip(parts, added, strict=True))


def added_parts(forward: FloatArray, rows: dict[str, slice]) -> dict[str, set[str]]:
    """Find what a transition adds to each part, beside itself."""
    return {into: {part for part in rows if part != into and np.any(forward[rows[into], rows[part]])} for into in rows}


@pytest.mark.parametrize(("module", "size"), [(palm_state, SIZE), (digit_filter, DIGIT_SIZE)])
def test_state_table_has_every_row_once(module: ModuleType, size: int) -> None:
    rows = [row for part in read_state(module)[0].values() for row in range(part.start, part.stop)]
    assert rows == list(range(size))


@pytest.mark.parametrize("tissue", [resting_and_moving_modes, joint_driven_modes])
def test_palm_transition_adds_the_parts_of_the_table(tissue: Callable[[SoftTissue], TissueModes]) -> None:
    settings = TrackerSettings()
    motion = PalmMotion(MotionNoise(), tissue(settings.tissue), np.array(settings.mode_scales))
    step = palm_transition(np.array([0.3, -0.2, 0.5]), motion, 0.03)
    rows, added = read_state(palm_state)
    moving = {part: own for part, own in rows.items() if own.stop <= RIGID_MOTION.stop}
    assert added_parts(step.moving, moving) == {part: added[part] for part in moving}
    assert all(not added[part] for part in rows if part not in moving)
    assert all(np.diagonal(step.driven[0])[own].min() > 0.0 for own in moving.values())


def test_digit_transition_adds_the_parts_of_the_table() -> None:
    free = np.ones((N_DIGITS, N_SLOTS))
    motion = DigitMotion(free, np.array([1.0]), np.ones((N_DIGITS, N_CONSTANTS)), np.zeros((N_DIGITS, N_SLOTS)), 1.0)
    forward, noise = motion.compute_transition(0.03, np.ones(N_DIGITS), None)
    rows, added = read_state(digit_filter)
    assert added_parts(forward[2], rows) == added
    assert np.diagonal(noise[2]).min() > 0.0

"""Any wrong order of the palm's six names is seen on any patient's hand, and no right one is doubted."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.calibration.name_checks import PalmNameSettings, shifted_names
from carpus.core.hand.protocols import HAND21, PALM_MARKERS
from carpus.core.types import Side
from tests.calibration.test_plausibility import seen_plan

SETTINGS = PalmNameSettings()

SIDES: tuple[Side, ...] = ("right", "left")


@pytest.mark.parametrize("side", SIDES)
def test_right_names_are_not_doubted(side: Side) -> None:
    for seed in range(8):
        assert shifted_names(side, seen_plan(seed, side, "wrist6"), SETTINGS) == ()
        assert shifted_names(side, seen_plan(seed, side, "hand21")[list(HAND21.palm)], SETTINGS) == ()


@pytest.mark.parametrize("side", SIDES)
def test_names_one_disc_further_on_are_told_with_the_wrist_first(side: Side) -> None:
    for seed in range(6):
        plan = seen_plan(seed, side, "wrist6")
        assert shifted_names(side, np.roll(plan, 1, axis=0), SETTINGS)[:2] == ("WRIST", "MCP5")
        assert shifted_names(side, np.roll(plan, -1, axis=0), SETTINGS)[:2] == ("WRIST", "CMC1")


@pytest.mark.parametrize("side", SIDES)
def test_every_wrong_order_is_told_name_by_name(side: Side) -> None:
    for seed in range(2):
        plan = seen_plan(seed, side, "wrist6")
        for order in list(permutations(range(6)))[1:]:
            wrong = shifted_names(side, plan[list(order)], SETTINGS)
            assert set(wrong) == {PALM_MARKERS[i] for i in range(6) if order[i] != i}
            # The disc under a name is order[i]; what it should be called follows in the list.
            first = PALM_MARKERS.index(wrong[0])
            assert wrong[1] == PALM_MARKERS[order[first]]


def test_the_other_hand_with_its_names_in_order_is_not_called_shifted() -> None:
    for seed in range(6):
        assert shifted_names("left", seen_plan(seed, "right", "wrist6"), SETTINGS) == ()


@pytest.mark.parametrize("tilt_deg", [-35.0, 35.0])
@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_tilted_hand_is_not_doubted_and_a_shift_on_it_is_told(axis: str, tilt_deg: float) -> None:
    for seed in range(6):
        flat = np.column_stack((seen_plan(seed, "right", "wrist6"), np.zeros(6)))
        plan = Rotation.from_euler(axis, tilt_deg, degrees=True).apply(flat - flat.mean(axis=0))[:, :2]
        assert shifted_names("right", plan, SETTINGS) == ()
        assert shifted_names("right", np.roll(plan, 1, axis=0), SETTINGS)[:2] == ("WRIST", "MCP5")

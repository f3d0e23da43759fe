"""Is it the hand it claims to be: over hands of all sizes and shapes."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.calibration.name_checks import SideSettings, looks_like_other_side, plan_view
from carpus.core.hand.protocols import HAND21, WRIST6
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import truth_of
from carpus.core.types import FloatArray, Side

SETTINGS = SideSettings()
PROTOCOLS = {"wrist6": WRIST6, "hand21": HAND21}


def seen_plan(seed: int, side: Side, protocol: str) -> FloatArray:
    """A patient's discs at the neutral pose as the camera has them."""
    truth = truth_of(Scene(RecordingSpec(seed=seed, hand=side, protocol=protocol, motion="rest", seconds=0.2)))
    return plan_view(truth.disc_position_cam_m[0])


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("side", ["right", "left"])
def test_patients_hands_are_not_doubted(protocol: str, side: Side) -> None:
    for seed in range(12):
        plan = seen_plan(seed, side, protocol)
        assert not looks_like_other_side(PROTOCOLS[protocol], side, plan, SETTINGS)


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("side", ["right", "left"])
def test_the_other_side_is_seen(protocol: str, side: Side) -> None:
    claimed: Side = "left" if side == "right" else "right"
    for seed in range(12):
        assert looks_like_other_side(PROTOCOLS[protocol], claimed, seen_plan(seed, side, protocol), SETTINGS)


def test_turn_size_and_place_of_the_hand_do_not_matter() -> None:
    plan = seen_plan(0, "right", "wrist6")
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    assert not looks_like_other_side(WRIST6, "right", 0.7 * plan @ turn.T - 0.1, SETTINGS)
    assert looks_like_other_side(WRIST6, "left", 0.7 * plan @ turn.T - 0.1, SETTINGS)

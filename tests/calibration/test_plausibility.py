"""Is it a hand, the hand it claims to be, with the names in their places: over hands of all sizes and shapes."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from core.calibration.plausibility import looks_like_other_side, plan_view, swapped_markers
from core.hand.protocols import HAND21, WRIST6, MarkerProtocol
from core.simulation.scene import Scene
from core.simulation.spec import RecordingSpec
from core.simulation.truth import truth_of
from core.types import FloatArray, Side

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
        assert swapped_markers(PROTOCOLS[protocol], side, plan) is None
        assert not looks_like_other_side(PROTOCOLS[protocol], side, plan)


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("side", ["right", "left"])
def test_the_other_side_is_seen(protocol: str, side: Side) -> None:
    claimed: Side = "left" if side == "right" else "right"
    for seed in range(12):
        assert looks_like_other_side(PROTOCOLS[protocol], claimed, seen_plan(seed, side, protocol))


def swaps_found(protocol: MarkerProtocol, pairs: list[tuple[int, int]], seeds: range) -> list[bool]:
    found = []
    for seed in seeds:
        plan = seen_plan(seed, "right", protocol.name)
        for pair in pairs:
            swapped = plan.copy()
            swapped[list(pair)] = swapped[list(pair)][::-1]
            named = swapped_markers(protocol, "right", swapped)
            found.append(named is not None and set(named) == {protocol.markers[pair[0]], protocol.markers[pair[1]]})
    return found


def test_any_two_swapped_palm_names_are_found() -> None:
    assert np.mean(swaps_found(WRIST6, list(combinations(range(6), 2)), range(8))) > 0.95


def test_swapped_neighbours_of_the_whole_hand_are_found() -> None:
    index = HAND21.markers.index
    pairs = [(index("TIP2"), index("TIP3")), (index("PIP4"), index("DIP4")), (index("WRIST"), index("TIP5"))]
    assert np.mean(swaps_found(HAND21, pairs, range(4))) > 0.6


def test_turn_size_and_place_of_the_hand_do_not_matter() -> None:
    plan = seen_plan(0, "right", "wrist6")
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    assert swapped_markers(WRIST6, "right", 1.3 * plan @ turn + 0.4) is None
    assert not looks_like_other_side(WRIST6, "right", 0.7 * plan @ turn.T - 0.1)
    assert looks_like_other_side(WRIST6, "left", 0.7 * plan @ turn.T - 0.1)

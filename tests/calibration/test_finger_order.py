"""Wrong names of the whole hand: every exchange of two is found and named, and no hand of any shape is doubted."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from carpus.core.calibration.name_checks import FingerOrderSettings, misnamed, plan_view
from carpus.core.hand.anatomy import anatomy_from_size
from carpus.core.hand.kinematics import disc_centres
from carpus.core.hand.protocols import HAND21, joint_angle_names
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import truth_of
from carpus.core.types import FloatArray, Side

SETTINGS = FingerOrderSettings()
ROW = HAND21.markers.index


def seen_plan(seed: int, side: Side) -> FloatArray:
    truth = truth_of(Scene(RecordingSpec(seed=seed, hand=side, protocol="hand21", motion="rest", seconds=0.2)))
    return plan_view(truth.disc_position_cam_m[0])


def bent_plan(rng: np.random.Generator, side: Side) -> FloatArray:
    """A hand with every finger bent and spread by itself, as far as its tips stay in view, a little tilted."""
    angle = dict.fromkeys(joint_angle_names(), 0.0)
    for finger in "2345":
        bend, curl = rng.uniform(-10.0, 50.0), rng.uniform(0.0, 60.0)
        seen = min(1.0, 75.0 / max(bend + curl * 5.0 / 3.0, 1.0))
        angle |= {f"MCP{finger}_flexion": seen * bend, f"PIP{finger}_flexion": seen * curl}
        angle[f"MCP{finger}_abduction"] = rng.uniform(-8.0, 8.0)
    angle |= {"CMC1_extension": rng.uniform(-10.0, 40.0), "CMC1_abduction": rng.uniform(0.0, 40.0)}
    angle |= {"MCP1_flexion": rng.uniform(-10.0, 35.0), "IP1_flexion": rng.uniform(-20.0, 40.0)}
    hand = anatomy_from_size(rng.uniform(0.13, 0.205), side=side, nail_discs=True)
    discs = disc_centres(hand, np.radians([angle[name] for name in joint_angle_names()]))
    tilt = np.radians(rng.uniform(-20.0, 20.0))
    across = discs[:, 1] * np.cos(tilt) + discs[:, 2] * np.sin(tilt)
    return np.stack((-across, discs[:, 0]), axis=1)


@pytest.mark.parametrize("side", ["right", "left"])
def test_no_hand_is_doubted(side: Side) -> None:
    for seed in range(12):
        assert misnamed(HAND21, side, seen_plan(seed, side), SETTINGS) is None
    rng = np.random.default_rng(4)
    assert [misnamed(HAND21, side, bent_plan(rng, side), SETTINGS) for _ in range(80)] == [None] * 80


def test_any_two_exchanged_names_are_found_and_named() -> None:
    plan = seen_plan(3, "right")
    for pair in list(combinations(range(21), 2))[::3]:
        wrong = plan.copy()
        wrong[list(pair)] = plan[list(pair)[::-1]]
        found = misnamed(HAND21, "right", wrong, SETTINGS)
        assert found is not None, pair
        assert set(sum(found.swapped, ())) == {HAND21.markers[i] for i in pair}


@pytest.mark.parametrize(
    "pair", [("TIP3", "TIP4"), ("TIP1", "IP1"), ("MCP3", "MCP4"), ("PIP2", "DIP2"), ("MCP1", "CMC1"), ("TIP4", "TIP5")]
)
@pytest.mark.parametrize("side", ["right", "left"])
def test_the_usual_mistakes_are_named_on_many_hands(pair: tuple[str, str], side: Side) -> None:
    rows = [ROW(name) for name in pair]
    for seed in range(4):
        plan = seen_plan(seed, side)
        plan[rows] = plan[rows[::-1]]
        found = misnamed(HAND21, side, plan, SETTINGS)
        assert found is not None
        assert {*found.swapped[0], *found.swapped[1]} == set(pair)


def test_two_whole_fingers_that_stand_in_for_each_other_are_named() -> None:
    plan = seen_plan(1, "right")
    middle, ring = ([ROW(f"{joint}{k}") for joint in ("MCP", "PIP", "DIP", "TIP")] for k in (3, 4))
    plan[middle + ring] = plan[ring + middle]
    found = misnamed(HAND21, "right", plan, SETTINGS)
    assert found is not None
    assert found.swapped == tuple(tuple(HAND21.markers[i] for i in rows) for rows in (middle, ring))


def test_a_name_on_something_that_is_no_disc_of_the_hand_is_named_alone() -> None:
    plan = seen_plan(2, "right")
    plan[ROW("TIP5")] = plan[0] + [0.05, -0.06]  # a blue sleeve
    found = misnamed(HAND21, "right", plan, SETTINGS)
    assert found is not None
    assert found.alone == "TIP5"

"""Wrong labels, the wrong side, spots that are no markers: told one by one, on hands of any size, side and shape."""

from __future__ import annotations

from functools import cache
from itertools import permutations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.calibration.calibrate import CalibrationOutcome
from carpus.core.calibration.label_checks import (
    average_palm,
    find_label_fault,
    find_odd_marker,
    find_shifted_labels,
    is_other_side,
    plan_view,
)
from carpus.core.calibration.result import Clicks
from carpus.core.model.hand.anatomy import anatomy_from_size
from carpus.core.model.hand.kinematics import disc_centres
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS, WRIST6, joint_angle_names
from carpus.core.model.types import FloatArray, Side
from carpus.core.simulation.scene import Scene as SimulatedScene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import compute_truth
from tests.calibration.still_hands import Scene, make_frames, run_calibration
from tests.detection.pictures import CAMERA, PAPERS, SKIN, Extra

SIDES: tuple[Side, Side] = ("right", "left")
PROTOCOLS = {"wrist6": WRIST6, "hand21": HAND21}
ROW = HAND21.markers.index


@cache
def _visible_plan(seed: int, side: Side, protocol: str) -> FloatArray:
    truth = compute_truth(
        SimulatedScene(RecordingSpec(seed=seed, hand=side, protocol=protocol, motion="rest", seconds=0.2))
    )
    return plan_view(truth.marker_position_cam_m[0])


def visible_plan(seed: int, side: Side, protocol: str = "hand21") -> FloatArray:
    """A patient's discs at the neutral pose as the camera has them."""
    return _visible_plan(seed, side, protocol).copy()


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("side", SIDES)
def test_other_side_is_found_and_own_side_accepted(protocol: str, side: Side) -> None:
    claimed: Side = "left" if side == "right" else "right"
    for seed in range(6):
        plan = visible_plan(seed, side, protocol)
        assert not is_other_side(PROTOCOLS[protocol], side, plan)
        assert is_other_side(PROTOCOLS[protocol], claimed, plan)


@pytest.mark.parametrize("side", SIDES)
def test_shifted_labels_of_a_permutation_are_named(side: Side) -> None:
    """Every seventh of them, of which each marker has each place."""
    plan = visible_plan(0, side, "wrist6")
    for order in list(permutations(range(6)))[1::7]:
        wrong = find_shifted_labels(side, plan[list(order)])
        assert set(wrong) == {PALM_MARKERS[i] for i in range(6) if order[i] != i}
        # The disc under a name is order[i]; what it should be called follows in the list.
        first = PALM_MARKERS.index(wrong[0])
        assert wrong[1] == PALM_MARKERS[order[first]]


@pytest.mark.parametrize(("axis", "tilt_deg"), [("x", -35.0), ("y", 35.0)])
def test_shifted_labels_of_a_tilted_hand_are_found(axis: str, tilt_deg: float) -> None:
    for seed in range(3):
        flat = np.column_stack((visible_plan(seed, "right", "wrist6"), np.zeros(6)))
        plan = Rotation.from_euler(axis, tilt_deg, degrees=True).apply(flat - flat.mean(axis=0))[:, :2]
        assert find_shifted_labels("right", plan) == ()
        assert find_shifted_labels("right", np.roll(plan, 1, axis=0))[:2] == ("WRIST", "MCP5")


def bend_plan(rng: np.random.Generator, side: Side) -> FloatArray:
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
def test_label_fault_of_right_labels_is_none(side: Side) -> None:
    for seed in range(6):
        assert find_label_fault(HAND21, side, visible_plan(seed, side)) is None
    rng = np.random.default_rng(4)
    assert [find_label_fault(HAND21, side, bend_plan(rng, side)) for _ in range(40)] == [None] * 40


def test_label_fault_two_swapped_fingers_are_named() -> None:
    plan = visible_plan(1, "right")
    middle, ring = ([ROW(f"{joint}{k}") for joint in ("MCP", "PIP", "DIP", "TIP")] for k in (3, 4))
    plan[middle + ring] = plan[ring + middle]
    found = find_label_fault(HAND21, "right", plan)
    assert found is not None
    assert found.swapped == tuple(tuple(HAND21.markers[i] for i in rows) for rows in (middle, ring))


SIDES: tuple[Side, Side] = ("right", "left")
NO_SPOT = np.empty((0, 2))
MCP3 = PALM_MARKERS.index("MCP3")


def calibrate_clicks(scene: Scene, clicked_px: FloatArray, *spots: FloatArray) -> CalibrationOutcome:
    radius_px = CAMERA.fx_px * 0.006 / scene.distance_m
    extras = tuple(Extra((float(u), float(v)), radius_px, PAPERS["blue"]) for u, v in spots)
    return run_calibration(scene, Clicks(scene.side, WRIST6, clicked_px), make_frames(scene, 5, extras=extras))


def odd_kinds(outcome: CalibrationOutcome) -> list[str]:
    kinds = [finding.kind for finding in outcome.verdict.findings]
    return [kind for kind in kinds if kind in ("other_spot", "spare_spot", "no_palm")]


def test_odd_marker_blue_spot_as_mcp3_is_found() -> None:
    scene = Scene(side="left")
    true = scene.discs_px
    false = true[0] + 0.62 * (true[MCP3] - true[0])  # the hand would be 115 mm long
    clicked = true.copy()
    clicked[MCP3] = false
    outcome = calibrate_clicks(scene, clicked, false)
    assert odd_kinds(outcome) == ["other_spot"]
    (finding,) = (one for one in outcome.verdict.findings if one.kind == "other_spot")
    assert finding.markers == ("MCP3",)
    assert np.linalg.norm(np.array(finding.spot_px) - true[MCP3]) < 1.5
    assert outcome.calibration is not None
    assert not outcome.calibration.verdict.is_good
    clicked[MCP3] = finding.spot_px  # the name is moved; what lies on the palm is still one spot too many
    assert odd_kinds(calibrate_clicks(scene, clicked, false)) == ["spare_spot"]


def test_odd_marker_spot_away_from_the_palm_is_ignored() -> None:
    scene = Scene()
    away = scene.discs_px.min(axis=0) + [-38.0, 60.0]
    assert odd_kinds(calibrate_clicks(scene, scene.discs_px, away)) == []


@pytest.mark.parametrize(("radii", "told"), [(1.2, True), (2.6, False)])
def test_near_spot_beside_a_marker_is_found(radii: float, told: bool) -> None:
    """Either may be the disc: a ring finger's knuckle was measured on the wrong of two, and nothing was said."""
    scene = Scene()
    radius_px = CAMERA.fx_px * 0.006 / scene.distance_m
    u, v = scene.discs_px[0]
    spot = Extra((float(u + radii * radius_px), float(v)), 0.5 * radius_px, PAPERS["blue"])
    frames = make_frames(scene, 5, extras=(spot,))
    for one in frames:  # a line of skin between the two
        left, right = (round(u + (radii + by) * radius_px) for by in (-0.85, -0.4))
        one.color_rgb[round(v) - 6 : round(v) + 7, left:right] = SKIN
    outcome = run_calibration(scene, frames=frames)
    near = [finding for finding in outcome.verdict.findings if finding.kind == "near_spot"]
    assert [finding.markers for finding in near] == ([("WRIST",)] if told else [])
    assert all(np.linalg.norm(np.array(finding.spot_px) - spot.pixel) < 1.5 for finding in near)
    assert outcome.verdict.can_start


@pytest.mark.parametrize("side", SIDES)
def test_odd_marker_impossible_palm_names_the_marker(side: Side) -> None:
    rng = np.random.default_rng(4)
    for marker in range(6):
        plan = average_palm(side).copy()
        outward = plan[marker] - plan.mean(axis=0)
        plan[marker] -= 0.9 * outward  # pulled into the middle
        plan += rng.normal(0.0, 0.001, plan.shape)
        odd = find_odd_marker(side, plan, NO_SPOT)
        assert odd is not None
        assert (odd.marker, odd.is_spot_better) == (marker, False)


def test_odd_marker_of_varied_hands_is_none() -> None:
    rng = np.random.default_rng(0)
    asked = 0
    for _ in range(300):
        plan = average_palm("right") * rng.uniform(0.92, 1.08, 2)  # slender and broad hands
        plan = plan + rng.normal(0.0, 0.003, plan.shape)
        asked += find_odd_marker("right", plan, NO_SPOT) is not None
    assert asked <= 3

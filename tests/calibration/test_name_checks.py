"""Labels of the markers: proposed where they are sure, wrong ones and spots that are no markers told one by one."""

from __future__ import annotations

from functools import cache
from itertools import permutations

import numpy as np
import pytest
from numpy.typing import NDArray
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
from carpus.core.calibration.label_proposal import LabelProposal, propose_labels
from carpus.core.calibration.result import Clicks
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.hand.anatomy import anatomy_from_size
from carpus.core.model.hand.kinematics import disc_centres
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS, WRIST6, joint_angle_names
from carpus.core.model.types import Detections, FloatArray, Side
from carpus.core.simulation.scene import Scene as SimulatedScene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import compute_truth
from tests.calibration.still_hands import Scene, make_frames, run_calibration
from tests.detection.pictures import CAMERA, PAPERS, SKIN, Extra
from tests.simulation.measurements import measurement_sequence

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


IntArray = NDArray[np.int64]
SEEDS = range(200, 203)


def hand(seed: int, side: Side, protocol: str = "hand21", false_blobs: float = 0.0) -> tuple[Detections, IntArray]:
    """Blobs of a picture of a still hand that lies in any direction, and the true blob of every marker, -1 for none."""
    rng = np.random.default_rng(seed)
    spec = RecordingSpec(
        seed=seed,
        hand=side,
        protocol=protocol,
        motion="rest",
        seconds=0.1,
        false_blobs=false_blobs,
        yaw_deg=float(rng.uniform(-180.0, 180.0)),
        hand_length_mm=float(rng.uniform(125.0, 210.0)),
    )
    sequence = measurement_sequence(spec)
    return sequence.detections[1], sequence.marker[1]


def find_blob(marker: IntArray, count: int) -> IntArray:
    true = np.full(count, -1)
    true[marker[marker >= 0]] = np.flatnonzero(marker >= 0)
    return true


def is_complete(proposal: LabelProposal) -> bool:
    return bool((proposal.blob >= 0).all())


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("side", ["right", "left"])
def test_propose_labels_among_false_blobs_labels_all(side: Side, seed: int) -> None:
    blobs, marker = hand(seed, side, false_blobs=3.0)
    proposal = propose_labels(blobs, DEFAULT_CAMERA, side, HAND21)
    assert np.array_equal(proposal.blob, find_blob(marker, 21))
    assert proposal.is_sure.sum() >= 20
    assert np.nanmax(proposal.misfit_m) < 0.01


@pytest.mark.parametrize("seed", SEEDS)
def test_propose_labels_of_the_palm_labels_six(seed: int) -> None:
    blobs, marker = hand(seed, "left", "wrist6", false_blobs=2.0)
    proposal = propose_labels(blobs, DEFAULT_CAMERA, "left", WRIST6)
    assert np.array_equal(proposal.blob, find_blob(marker, 6))
    assert proposal.is_sure.all(), "six right names are confirmed at once"
    other = propose_labels(blobs, DEFAULT_CAMERA, "right", WRIST6)
    assert not (is_complete(other) and other.is_sure.any()), "the other hand's names are looked at one by one"


@pytest.mark.parametrize(("seed", "gone"), [(1076, "CMC1"), (1101, "CMC1"), (1163, "MCP4"), (1046, "MCP4")])
def test_propose_labels_missing_palm_marker_is_not_replaced(seed: int, gone: str) -> None:
    side: Side = "left" if seed % 2 else "right"
    blobs, marker = hand(seed, side, "wrist6", false_blobs=4.0)
    there = np.arange(len(blobs)) != find_blob(marker, 6)[WRIST6.markers.index(gone)]
    assert is_complete(propose_labels(blobs, DEFAULT_CAMERA, side, WRIST6))
    assert not is_complete(propose_labels(blobs.subset(there), DEFAULT_CAMERA, side, WRIST6))


def test_propose_labels_keeps_given_labels() -> None:
    blobs, marker = hand(201, "right")
    true = find_blob(marker, 21)
    given = {row: int(true[row]) for row in (0, 1, 5, 9, 17)}
    assert np.array_equal(propose_labels(blobs, DEFAULT_CAMERA, "right", HAND21, given_labels=given).blob, true)
    tip, other = HAND21.markers.index("TIP2"), HAND21.markers.index("TIP3")
    turned_round = given | {tip: int(true[other]), other: int(true[tip])}
    kept = propose_labels(blobs, DEFAULT_CAMERA, "right", HAND21, given_labels=turned_round)
    assert all(kept.blob[row] == blob for row, blob in turned_round.items())
    assert len(set(kept.blob[kept.blob >= 0])) == np.count_nonzero(kept.blob >= 0)


def test_propose_labels_without_hand_labels_none() -> None:
    rng = np.random.default_rng(3)
    for count in (0, 1, 5, 24):
        pixel = rng.uniform((0.0, 0.0), (640.0, 480.0), (count, 2))
        many: FloatArray = np.full(count, 0.7)
        blobs = Detections(pixel, many, 0.001 * many, 80.0 * many, many)
        proposal = propose_labels(blobs, DEFAULT_CAMERA, "right", HAND21)
        assert not is_complete(proposal)
        assert proposal.is_sure.sum() <= 4

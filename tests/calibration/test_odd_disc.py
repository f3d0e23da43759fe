"""A spot that is no disc, clicked as one: what the palm's shape and an unnamed spot beside it say."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationOutcome
from carpus.core.calibration.label_checks import average_palm, find_odd_marker
from carpus.core.calibration.result import Clicks
from carpus.core.model.hand.protocols import PALM_MARKERS, WRIST6
from carpus.core.model.types import FloatArray, Side
from tests.calibration.still_hands import Scene, make_frames, run_calibration
from tests.detection.pictures import CAMERA, PAPERS, SKIN, Extra

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

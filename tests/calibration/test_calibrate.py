"""From clicks on a still hand to the measured palm; every finding comes from its own fault and from no other."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.calibration.calibrate import (
    CalibrationSettings,
    NeutralCapture,
    check_hand_length,
    measure_hand,
    require_calibration,
)
from carpus.core.calibration.result import Calibration, CalibrationFinding, Clicks
from carpus.core.model.depth_sensor import PRIMESENSE
from carpus.core.model.errors import ClickOnNoMarker, MarkerWithoutDepth
from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.model.types import Side
from tests.calibration.still_hands import Scene, make_frames, render_still_hand, run_calibration
from tests.detection.pictures import CAMERA, PALM_PX
from tests.tracking.hands import palm

SIDES: tuple[Side, Side] = ("right", "left")
NAMES = WRIST6.markers


def assert_good(scene: Scene) -> Calibration:
    outcome = run_calibration(scene)
    assert outcome.verdict.findings == ()
    assert outcome.calibration is not None
    return outcome.calibration


def single_finding(findings: tuple[CalibrationFinding, ...], kind: str) -> CalibrationFinding:
    assert [finding.kind for finding in findings] == [kind]
    return findings[0]


@pytest.mark.parametrize("side", SIDES)
def test_calibrate_hand_measures_palm_and_pose_of_both_hands(side: Side) -> None:
    scene = Scene(side)
    found = assert_good(scene)
    assert np.linalg.norm(found.marker_position_w0_m - palm(side), axis=1).max() < 0.0015
    placed = found.marker_position_w0_m @ found.rotation_w0_cam.T + found.translation_w0_cam_m
    assert np.linalg.norm(placed - scene.discs_cam_m, axis=1).max() < 0.0012
    turn = Rotation.from_matrix(scene.rotation_w0_cam.T @ found.rotation_w0_cam)
    assert np.degrees(turn.magnitude()) < 1.5
    assert found.rotation_w0_cam[2, 2] < -0.99, "Z out of the back of the hand, towards the camera"
    assert np.linalg.det(found.rotation_w0_cam) == pytest.approx(1.0)
    assert np.allclose(found.marker_position_w0_m[0], 0.0, atol=1e-9), "origin WRIST"
    assert np.allclose(found.marker_position_w0_m[3, 1:], 0.0, atol=1e-9), "X to MCP3"


def test_calibrate_hand_verdict_has_plain_values() -> None:
    scene = Scene(tilt_deg=9.0, distance_m=0.66)
    verdict = assert_good(scene).verdict
    assert verdict.distance_m == pytest.approx(scene.discs_cam_m[0, 2], abs=0.002)
    assert verdict.hand_length_mm == pytest.approx(82.0 / 0.446, rel=0.02)
    # The tilt is told against the line of sight to WRIST, which itself is a few degrees off the axis.
    sight = scene.discs_cam_m[0] / np.linalg.norm(scene.discs_cam_m[0])
    expected = np.degrees(np.arccos(-scene.rotation_w0_cam[:, 2] @ sight))
    assert verdict.tilt_deg == pytest.approx(expected, abs=1.5)
    assert verdict.frames_used == 16, "half a second at 30 a second"
    assert verdict.residual_mm.shape == (6,)
    assert (verdict.residual_mm < 2.0).all()
    assert verdict.is_good
    assert verdict.can_start


def test_calibrate_hand_click_on_skin_is_named() -> None:
    scene = Scene()
    pixel = scene.discs_px.copy()
    pixel[4] = 0.5 * (scene.discs_px[0] + scene.discs_px[3]) + [8.0, 0.0]
    outcome = run_calibration(scene, Clicks("right", WRIST6, pixel), render_still_hand(scene, 5))
    finding = single_finding(outcome.verdict.findings, "click_on_no_marker")
    assert finding.markers == ("MCP4",)
    assert finding.blocks
    assert not outcome.verdict.can_start
    assert outcome.calibration is None
    assert np.isnan(outcome.pixel[4]).all()
    assert np.isfinite(np.delete(outcome.pixel, 4, axis=0)).all()
    with pytest.raises(ClickOnNoMarker) as caught:
        require_calibration(outcome)
    assert caught.value.subject == "MCP4"


def test_calibrate_hand_two_clicks_on_one_marker_are_named() -> None:
    scene = Scene()
    pixel = scene.discs_px.copy()
    pixel[5] = pixel[4] + [1.5, -1.0]
    outcome = run_calibration(scene, Clicks("right", WRIST6, pixel), render_still_hand(scene, 5))
    finding = single_finding(outcome.verdict.findings, "two_clicks_on_one")
    assert set(finding.markers) == {"MCP4", "MCP5"}
    assert finding.blocks


@pytest.mark.parametrize(("pair", "side"), [((0, 1), "right"), ((3, 4), "left")])
def test_calibrate_hand_swapped_clicks_are_named(pair: tuple[int, int], side: Side) -> None:
    scene = Scene(side)
    pixel = scene.discs_px.copy()
    pixel[list(pair)] = pixel[list(pair)][::-1]
    verdict = run_calibration(scene, Clicks(side, WRIST6, pixel), render_still_hand(scene, 1)).verdict
    swaps = [finding for finding in verdict.findings if finding.kind == "swapped"]
    assert [set(finding.markers) for finding in swaps] == [{NAMES[pair[0]], NAMES[pair[1]]}]
    assert not any(finding.blocks for finding in verdict.findings), "it is told, and tracking may go on"


@pytest.mark.parametrize(("side", "by"), [("right", 1), ("left", -2)])
def test_calibrate_hand_shifted_labels_are_refused(side: Side, by: int) -> None:
    scene = Scene(side)
    clicks = Clicks(side, WRIST6, np.roll(scene.discs_px, by, axis=0))
    outcome = run_calibration(scene, clicks, render_still_hand(scene, 5))
    finding = single_finding(outcome.verdict.findings, "shifted")
    assert set(finding.markers) == set(NAMES)
    assert finding.markers[:2] == ("WRIST", NAMES[-by])
    assert not outcome.verdict.can_start
    assert not finding.blocks, "the command line tells it and goes on"


def test_calibrate_hand_wrong_side_is_found() -> None:
    scene = Scene("right")
    outcome = run_calibration(scene, Clicks("left", WRIST6, scene.discs_px), render_still_hand(scene, 5))
    assert single_finding(outcome.verdict.findings, "wrong_side").blocks is False


def test_check_hand_length_other_length_is_found() -> None:
    outcome = run_calibration(Scene())
    length_mm = outcome.verdict.hand_length_mm
    for same in (math.nan, length_mm, 0.9 * length_mm, 1.1 * length_mm):
        assert check_hand_length(outcome, same) is outcome
    for other in (0.8 * length_mm, 1.25 * length_mm):
        doubted = check_hand_length(outcome, other)
        finding = single_finding(doubted.verdict.findings, "other_length")
        assert (finding.value, finding.limit) == (length_mm, other)
        assert doubted.calibration is not None
        assert doubted.calibration.verdict is doubted.verdict, "the session keeps it"
        assert doubted.verdict.can_start


def test_calibrate_hand_marker_without_depth_is_named() -> None:
    scene = Scene()
    outcome = run_calibration(scene, frames=make_frames(scene, 5, hole_at=5))
    finding = single_finding(outcome.verdict.findings, "no_depth")
    assert finding.markers == ("MCP5",)
    assert finding.blocks
    with pytest.raises(MarkerWithoutDepth, match="MCP5"):
        require_calibration(outcome)
    blind = [replace(frame, depth_raw=None) for frame in render_still_hand(scene, 5)]
    findings = run_calibration(scene, frames=blind).verdict.findings
    assert [(one.kind, *one.markers) for one in findings] == [("no_depth", name) for name in NAMES]


@pytest.mark.parametrize(
    ("scene", "kind", "value", "limit", "unit"),
    [
        (Scene(tilt_deg=25.0), "tilt", pytest.approx(25.0, abs=6.0), 15.0, "deg"),
        (Scene(distance_m=0.52), "distance", pytest.approx(0.52, abs=0.005), 0.6, "m"),
        (Scene(size=0.55), "hand_length", pytest.approx(0.55 * 82.0 / 0.446, rel=0.03), 110.0, "mm"),
        (Scene(size=1.3), "hand_length", pytest.approx(1.3 * 82.0 / 0.446, rel=0.03), 225.0, "mm"),
    ],
)
def test_calibrate_hand_tilt_and_distance_are_found_with_value(
    scene: Scene, kind: str, value: object, limit: float, unit: str
) -> None:
    finding = single_finding(run_calibration(scene, frames=make_frames(scene, 6)).verdict.findings, kind)
    assert finding.value == value
    assert (finding.limit, finding.unit, finding.blocks) == (limit, unit, False)


def test_neutral_capture_ends_when_the_hand_moves() -> None:
    scene = Scene()
    shift = np.zeros((17, 2))
    shift[9:, 0] = 0.6 * np.arange(1, 9)
    outcome = run_calibration(scene, frames=make_frames(scene, shift_px=shift))
    # A shift of more than 0.7 px is a movement: the tenth picture still passes, the eleventh does not.
    assert outcome.capture_frames == 10
    assert outcome.verdict.findings == ()
    assert np.abs(outcome.pixel - scene.discs_px).max() < 0.4


def test_calibrate_hand_jumping_depth_gives_residual() -> None:
    scene = Scene()
    frames = []
    for k, frame in enumerate(render_still_hand(scene)):
        assert frame.depth_raw is not None
        raw = frame.depth_raw.copy()
        u, v = np.rint(scene.discs_px[4]).astype(int)
        raw[v - 8 : v + 9, u - 8 : u + 9] += np.uint16(60 if k % 2 else 0)  # 12 mm to and fro
        frames.append(replace(frame, depth_raw=raw))
    verdict = run_calibration(scene, frames=frames).verdict
    finding = single_finding(verdict.findings, "residual")
    assert finding.markers == ("MCP4",)
    assert finding.value == pytest.approx(6.0, abs=1.0)
    assert finding.unit == "mm"
    assert not finding.blocks


def test_measure_hand_noise_of_a_still_hand_is_measured() -> None:
    quiet, loud = (
        run_calibration(one, frames=make_frames(one, 9)).noise for one in (Scene(noise=0.5), Scene(noise=2.0))
    )
    assert 0.0 < quiet.pixel_sd_px < 0.5 * loud.pixel_sd_px
    assert quiet.depth_sd_m < 0.6 * loud.depth_sd_m
    assert loud.marker_radius_m == pytest.approx(0.006, rel=0.1)
    few = run_calibration(Scene(), frames=render_still_hand(Scene(), 3)).noise
    assert np.isnan(few.pixel_sd_px), "three pictures show no noise worth the name"


def test_measure_hand_covariances_match_errors() -> None:
    """Errors in depth over many hands against what is claimed; sideways the discs are known far better."""
    squares = []
    for scene in (Scene(), Scene("left"), Scene(tilt_deg=9.0, distance_m=0.66)):
        found = run_calibration(scene).calibration
        assert found is not None
        placed = found.marker_position_w0_m @ found.rotation_w0_cam.T + found.translation_w0_cam_m
        covariance_cam = found.rotation_w0_cam @ found.marker_covariance_w0_m2 @ found.rotation_w0_cam.T
        error = (placed - scene.discs_cam_m)[:, 2]
        squares.append(error**2 / covariance_cam[:, 2, 2])
        assert (covariance_cam[:, 0, 0] < covariance_cam[:, 2, 2]).all()
        assert np.linalg.eigvalsh(found.marker_covariance_w0_m2).min() > 0.0
    # The pattern that stays with a surface is not in these pictures, so the claim is on the careful side.
    assert np.mean(squares) < 2.0


def _make_capture(clicks: Clicks, frames: int, pixel_sd: float, depth_sd_m: float, said_m: float) -> NeutralCapture:
    rng = np.random.default_rng(7)
    count = len(clicks.pixel)
    sway = rng.normal(0.0, 0.3, (frames, 1, 2))  # the arm's, common to all discs
    pixel = clicks.pixel + sway + rng.normal(0.0, pixel_sd, (frames, count, 2))
    depth_m = 0.7 + rng.normal(0.0, depth_sd_m, (frames, count))
    return NeutralCapture(pixel, depth_m, np.full((frames, count), said_m), np.full((frames, count), 60.0))


@pytest.mark.parametrize("protocol", [WRIST6, HAND21])
def test_measure_hand_noise_is_independent_of_marker_count(protocol: MarkerProtocol) -> None:
    """What all share is the hand's; each disc's part of that is given back, to few discs more than to many."""
    spread = np.column_stack((np.arange(21) % 5 * 40.0 + 200.0, np.arange(21) // 5 * 40.0 + 150.0))
    palm = list(HAND21.palm)
    spread[palm] = PALM_PX
    pixel = spread if protocol is HAND21 else PALM_PX
    capture = _make_capture(Clicks("right", protocol, pixel), 300, 0.1, 0.001, 0.001)
    noise = measure_hand(Clicks("right", protocol, pixel), capture, CAMERA, CalibrationSettings()).noise
    assert noise.pixel_sd_px == pytest.approx(0.1, rel=0.045)
    assert noise.depth_sd_m == pytest.approx(0.001, rel=0.04)


@pytest.mark.parametrize("frames", [8, 200])
@pytest.mark.parametrize("said_over_book", [1.0, 3.0])
def test_measure_hand_covariance_falls_with_frames(frames: int, said_over_book: float) -> None:
    """Scatter is averaged away; the pattern of the depth and a slope stay; across, a tenth of a pixel stays."""
    book_m = float(PRIMESENSE.reading_sd_m(np.array(0.7)))
    clicks = Clicks("right", WRIST6, PALM_PX)
    capture = _make_capture(clicks, frames, 0.1, 0.001, said_over_book * book_m)
    calibration = measure_hand(clicks, capture, CAMERA, CalibrationSettings()).calibration
    assert calibration is not None
    turn = calibration.rotation_w0_cam
    in_cam = turn @ calibration.marker_covariance_w0_m2 @ turn.T
    steep2 = (said_over_book**2 - 1.0) * book_m**2
    pattern_m = 0.5e-3 * 0.7**2
    along_m = np.sqrt(0.001**2 / frames + pattern_m**2 + steep2)
    assert np.sqrt(in_cam[:, 2, 2]) == pytest.approx(np.full(6, along_m), rel=0.25 if frames == 8 else 0.03)
    across_m = np.hypot(0.1 / np.sqrt(frames), 0.1) * 0.7 / CAMERA.fx_px
    flat = np.linalg.eigvalsh(in_cam)[:, 0]
    assert np.sqrt(flat) == pytest.approx(np.full(6, across_m), rel=0.15)

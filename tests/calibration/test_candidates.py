"""Discs found before any click, and the disc under one click: by rendered hands whose discs are known."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationSettings, calibrate_hand
from carpus.core.calibration.candidates import find_marker_at_click, find_marker_candidates, find_nearest_blob
from carpus.core.calibration.label_proposal import propose_labels
from carpus.core.detection.appearance import DetectionSettings
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import HAND21
from carpus.core.model.types import FloatArray, Frame, Side
from carpus.core.simulation.recording import SimulatedRecording, sample_clicks
from carpus.core.simulation.spec import RecordingSpec
from tests.suites import few

SETTINGS = DetectionSettings()
RADIUS_PX = 4.8


@lru_cache(maxsize=4)
def detect_candidates(seed: int, paper_to: str = "blue") -> tuple[Frame, Camera, FloatArray]:
    """A still hand, its camera and where its discs are (6, 2); the colour channels may be exchanged."""
    pictures = SimulatedRecording(
        RecordingSpec(seed=seed, hand="left" if seed % 2 else "right", distance_m=0.66, light="normal", false_blobs=1.0)
    )
    color, depth = pictures.apply_sensor(0, pictures.render_clean(0))
    if paper_to == "green":
        # The blue of the paper becomes green while skin and table keep theirs.
        blue = color[..., 2].astype(int) > color[..., 0].astype(int) + 40
        color = np.where(blue[..., None], color[..., [0, 2, 1]], color)
    return Frame(0, 0.0, color, depth, 1.0 / 5000.0), pictures.truth.camera, pictures.truth.marker_px[0]


@pytest.mark.parametrize("seed", few([0, 1, 3], 2))
def test_marker_candidates_of_the_palm_are_found_and_snapped_to(seed: int) -> None:
    frame, camera, discs = detect_candidates(seed)
    found = find_marker_candidates(frame, camera, SETTINGS)
    rng = np.random.default_rng(seed)
    for disc in discs:
        taken = find_nearest_blob(found, disc + rng.normal(0.0, 1.5, 2), RADIUS_PX, SETTINGS)
        assert len(taken) == 1
        assert np.linalg.norm(taken.pixel[0] - disc) < 0.8


@pytest.mark.parametrize(("seed", "side"), few([(304, "left"), (301, "right"), (300, "left")], 2))
def test_marker_candidates_of_a_whole_hand_are_found_and_labelled(seed: int, side: Side) -> None:
    """The first is a child's, with small discs that take on some of the skin; the last wears a blue sleeve."""
    spec = RecordingSpec(seed=seed, hand=side, protocol="hand21", motion="rest", false_blobs=2.0)
    pictures = SimulatedRecording(spec)
    color, depth = pictures.apply_sensor(0, pictures.render_clean(0))
    found = find_marker_candidates(Frame(0, 0.0, color, depth, 1.0 / 5000.0), pictures.truth.camera, SETTINGS)
    proposal = propose_labels(found, pictures.truth.camera, side, HAND21)
    assert (proposal.blob >= 0).all()
    assert np.linalg.norm(found.pixel[proposal.blob] - pictures.truth.marker_px[0], axis=1).max() < 3.0  # under a disc


def test_calibrate_hand_clicks_at_edges_of_small_markers_are_assigned() -> None:
    """Colours learnt under them alone are half skin, and discs fall in two."""
    spec = RecordingSpec(
        seed=22, protocol="hand21", motion="fingers", seconds=5.0, hidden_share=0.03, false_blobs=1.0,
        distance_m=0.66, light="normal",
    )  # fmt: skip
    pictures = SimulatedRecording(spec)
    frames = [Frame(i, i / 30.0, *pictures.apply_sensor(i, pictures.render_clean(i)), 1.0 / 5000.0) for i in range(3)]
    clicks, camera = sample_clicks(pictures.truth), pictures.truth.camera
    outcome = calibrate_hand(clicks, frames, camera, CalibrationSettings(), SETTINGS)
    assert not any(finding.blocks for finding in outcome.verdict.findings)
    assert np.linalg.norm(outcome.pixel - pictures.truth.marker_px[0], axis=1).max() < 1.5


@pytest.mark.parametrize("paper_to", ["blue", "green"])
def test_marker_at_click_of_any_colour_is_found(paper_to: str) -> None:
    frame, camera, discs = detect_candidates(0, paper_to)
    for disc in discs:
        taken = find_marker_at_click(frame, disc + 1.0, camera, SETTINGS)
        assert len(taken) == 1
        assert np.linalg.norm(taken.pixel[0] - disc) < 1.0


def test_marker_candidates_without_hand_are_none() -> None:
    frame, camera, _ = detect_candidates(0)
    grey = Frame(0, 0.0, np.full_like(frame.color_rgb, 90), None, 1.0)
    assert len(find_marker_candidates(grey, camera, SETTINGS)) == 0
    for corner in ((0.0, 0.0), (639.0, 479.0)):
        assert len(find_marker_at_click(grey, np.array(corner), camera, SETTINGS)) == 0


def render_dark_cloth(frame: Frame, base: tuple[int, int, int], from_row: int, seed: int) -> Frame:
    """The picture with a dark pullover from a row down: folds, weave and noise, its hue blue by chance."""
    rng = np.random.default_rng(seed)
    shape = frame.color_rgb.shape
    folds, weave = cv2.GaussianBlur(rng.normal(size=shape[:2]), (0, 0), 3.0), rng.normal(size=shape)
    tint = cv2.GaussianBlur(rng.normal(size=shape), (0, 0), 3.0)
    cloth = np.array(base) * (1.0 + 0.35 * folds / folds.std())[..., None] + 3.0 * weave + 4.0 * tint / tint.std()
    color = frame.color_rgb.copy()
    color[from_row:] = np.clip(cloth, 0, 255).astype(np.uint8)[from_row:]
    return Frame(0, 0.0, color, frame.depth_raw, frame.depth_unit_m)


CLOTHS = [(26, 29, 40), (20, 20, 24), (40, 46, 66)]


@pytest.mark.parametrize(("seed", "base"), few(zip((0, 1, 0), CLOTHS, strict=True)))
def test_marker_candidates_of_a_dark_pullover_are_none(seed: int, base: tuple[int, int, int]) -> None:
    frame, camera, _ = detect_candidates(0)
    cloth = render_dark_cloth(frame, base, 0, seed)
    found = find_marker_candidates(cloth, camera, SETTINGS)
    assert len(found) <= 8  # it was all that is ever handed on, 48
    assert not (propose_labels(found, camera, "right", HAND21).blob >= 0).any()
    clicks = np.random.default_rng(seed).uniform((20, 20), (620, 460), (30, 2))
    assert sum(len(find_marker_at_click(cloth, click, camera, SETTINGS)) for click in clicks) <= 1


@pytest.mark.parametrize("base", CLOTHS[:2])
def test_marker_candidates_beside_a_dark_pullover_are_found(base: tuple[int, int, int]) -> None:
    frame, camera, discs = detect_candidates(0)
    below = int(discs[:, 1].max() + 25)
    found = find_marker_candidates(render_dark_cloth(frame, base, below, 0), camera, SETTINGS)
    for disc in discs:
        assert np.linalg.norm(found.pixel - disc, axis=1).min() < 1.0
    assert len(found) <= 14

"""Depth that lies beside colour is noticed from the hand's outline, and only then."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.calibration.calibrate import CalibrationSettings, calibrate_hand
from carpus.core.calibration.neutral_depth import estimate_depth_offset_px
from carpus.core.detection.appearance import DetectionSettings, learn_appearance
from carpus.core.model.types import FloatArray, Frame
from carpus.core.simulation.recording import SimulatedRecording, sample_clicks
from carpus.core.simulation.spec import RecordingSpec

DETECTION = DetectionSettings()
SEEDS = (1, 2, 5)


def offset_px(pictures: SimulatedRecording, frame: Frame) -> float:
    clicks = sample_clicks(pictures.truth)
    looks, centre = learn_appearance(frame, clicks.pixel, pictures.truth.camera, DETECTION)
    return estimate_depth_offset_px(frame, looks, centre[np.isfinite(centre[:, 0])])


def shift_depth(frame: Frame, columns: int, rows: int) -> Frame:
    """The frame with its depth beside its colour; what comes into the picture is a hole."""
    assert frame.depth_raw is not None
    depth = np.zeros_like(frame.depth_raw)
    height, width = depth.shape
    target = (slice(max(rows, 0), height + min(rows, 0)), slice(max(columns, 0), width + min(columns, 0)))
    source = (slice(max(-rows, 0), height - max(rows, 0)), slice(max(-columns, 0), width - max(columns, 0)))
    depth[target] = frame.depth_raw[source]
    return replace(frame, depth_raw=depth)


@pytest.fixture(scope="module")
def takes() -> list[tuple[SimulatedRecording, Frame]]:
    """A first picture of several patients, tables, lights and sleeves."""
    made = [SimulatedRecording(RecordingSpec(seed=seed, seconds=0.1, protocol="wrist6")) for seed in SEEDS]
    return [(pictures, next(pictures.frames())) for pictures in made]


def test_depth_offset_of_registered_depth_is_zero(takes: list[tuple[SimulatedRecording, Frame]]) -> None:
    assert [offset_px(*take) for take in takes] == [0.0] * len(takes)


@pytest.mark.parametrize("shift", [(-12, 0), (10, -10)])
def test_depth_offset_of_shifted_depth_is_found(
    shift: tuple[int, int], takes: list[tuple[SimulatedRecording, Frame]]
) -> None:
    """In most rooms: on a table of the skin's own colour the picture does not say."""
    true_px = float(np.hypot(*shift))
    found: FloatArray = np.array([offset_px(pictures, shift_depth(frame, *shift)) for pictures, frame in takes])
    noticed = found[found > 0.0]
    assert len(noticed) >= len(takes) - 1
    assert np.abs(noticed - true_px).max() < 6.0


def test_depth_offset_without_depth_or_markers_is_zero(takes: list[tuple[SimulatedRecording, Frame]]) -> None:
    pictures, frame = takes[0]
    assert offset_px(pictures, replace(frame, depth_raw=None)) == 0.0
    assert offset_px(pictures, shift_depth(frame, 640, 0)) == 0.0, "a picture full of holes"


def test_calibrate_hand_depth_offset_is_found(takes: list[tuple[SimulatedRecording, Frame]]) -> None:
    pictures, frame = takes[0]
    clicks, camera = sample_clicks(pictures.truth), pictures.truth.camera
    for each, is_off in ((frame, False), (shift_depth(frame, 12, 0), True)):
        found = calibrate_hand(clicks, [each], camera, CalibrationSettings(), DETECTION).verdict.findings
        assert ("depth_off" in [finding.kind for finding in found]) == is_off

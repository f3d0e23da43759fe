"""Compact pictures: the hand and its surroundings are kept whole, the room about it is not, and it costs little."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.capture.files.image_codec import encode_color, encode_depth
from carpus.core.capture.files.raw import BYTES_PER_FRAME, RawRecording, RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Frame, TrackedFrame, TrackStatus
from carpus.core.pipeline.measurement import HandRegions, compute_hand_region, mask_outside
from carpus.core.tracking.tracker import Tracker
from tests.tracking.hands import CAMERA, RIGID, blobs, calibration, swing


def tracked() -> TrackedFrame:
    return Tracker(calibration(), CAMERA, RIGID).step(0, 0.0, blobs(swing(1, 0.0, 1.0)(0.0)))


def noisy(rng: np.random.Generator) -> Frame:
    """A picture whose every pixel differs from its neighbours, as a sensor's does."""
    color = np.clip(120 + 6 * rng.normal(size=(480, 640, 3)), 0, 255).astype(np.uint8)
    depth = np.clip(700 + 3 * rng.normal(size=(480, 640)), 1, 4000).astype(np.uint16)
    return Frame(0, 0.0, color, depth, 0.001, 0)


def test_hand_crop_lost_hand_keeps_whole_image() -> None:
    hand = HandRegions(CAMERA, WRIST6)
    assert hand.find_region(0.0) is None
    hand.update(tracked())
    assert hand.find_region(0.0) is not None
    hand.update(replace(tracked(), status=TrackStatus.LOST))
    assert hand.find_region(0.0) is None
    frame = noisy(np.random.default_rng(1))
    assert mask_outside(frame, None) is frame


def test_hand_crop_waiting_frame_uses_region_of_its_time() -> None:
    hand, now = HandRegions(CAMERA, WRIST6), tracked()
    hand.update(now)
    then = hand.find_region(0.0)
    hand.update(replace(now, timestamp_s=10.0, marker_position_cam_m=now.marker_position_cam_m + [0.1, 0.0, 0.0]))
    assert hand.find_region(10.0) != then
    assert hand.find_region(0.1) == then
    assert hand.find_region(-0.1) is None


def test_hand_crop_depth_is_lossless_and_smaller(tmp_path: Path) -> None:
    frame, area = noisy(np.random.default_rng(2)), compute_hand_region(tracked(), CAMERA, WRIST6)
    info = SourceInfo("x", CAMERA, True, None, 30.0, {})
    writer = RawWriter(tmp_path / "s.carpusraw", info, crop=lambda whole: mask_outside(whole, area))
    writer.append_frame(frame)
    writer.close()
    (back,) = RawRecording(tmp_path / "s.carpusraw").frames()
    np.testing.assert_array_equal(back.depth_raw, mask_outside(frame, area).depth_raw)
    whole = len(encode_color(frame.color_rgb)) + len(encode_depth(frame.depth_raw))  # type: ignore[arg-type]
    assert writer.path.stat().st_size < 0.6 * whole
    assert 0.6 * whole > BYTES_PER_FRAME


def test_hand_crop_stale_region_keeps_whole_image() -> None:
    hand = HandRegions(CAMERA, WRIST6)
    hand.update(tracked())
    assert hand.find_region(0.1) is not None
    assert hand.find_region(1.0) is None


def test_hand_region_contains_markers_and_fingers() -> None:
    frame = tracked()
    area = compute_hand_region(frame, CAMERA, WRIST6)
    assert area is not None
    discs = frame.marker_measured_px
    span = float(np.ptp(discs, axis=0).max())
    for disc in discs:
        assert area.left < disc[0] < area.right
        assert area.top < disc[1] < area.bottom
    assert discs[:, 1].min() - area.top >= min(1.4 * span, discs[:, 1].min()) - 1.0
    assert area.left >= 0
    assert area.bottom <= CAMERA.height_px

"""A short recording, pictures to angles and looked back, by NumPy and in C: the same hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.core.calibration.calibrate import calibrate
from carpus.core.calibration.clicks import read_clicks
from carpus.core.capture.tum import TumFolder
from carpus.core.kernels import choice
from carpus.core.pipeline.track import TrackSettings, build_walk, learnt_from
from carpus.core.simulation.recording import CLICKS_FILE, simulate
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.types import Frame, Moment, TrackedFrame, TrackStatus
from tests.kernels.pairs import LEVELS, numbers

NEAREST = 1e-6
"""Of each number's size. The steps agree to 1e-9; what is passed on from frame to frame adds up."""

WRIST = RecordingSpec(seed=31, motion="mixed", seconds=2.0, hidden_share=0.1, false_blobs=2.0)
HAND = RecordingSpec(seed=32, protocol="hand21", motion="fist", seconds=1.6, hidden_share=0.1, false_blobs=2.0)


def damaged(frames: list[Frame]) -> list[Frame]:
    """Some pictures without depth, some gone, one of nothing."""
    kept = [frame for frame in frames if not 40 <= frame.index < 44]
    dark = np.zeros_like(frames[0].color_rgb)
    return [
        replace(frame, depth_raw=None) if frame.index % 17 == 16
        else replace(frame, color_rgb=dark) if frame.index == 37
        else frame
        for frame in kept
    ]  # fmt: skip


def walked(folder: Path, frames: list[Frame]) -> tuple[list[TrackedFrame], list[Moment]]:
    """Every frame, and looked back."""
    camera, settings = TumFolder(folder).info.camera, TrackSettings()
    opening = [frame for frame in frames if frame.timestamp_s - frames[0].timestamp_s <= settings.calibration.still_s]
    outcome = calibrate(
        read_clicks(folder / CLICKS_FILE), opening, camera, settings.calibration, settings.detection, None
    )
    ends_s = opening[max(outcome.capture_frames, 1) - 1].timestamp_s
    walk = build_walk(
        outcome, camera, settings, learnt_from(outcome.noise, ends_s, settings.tracker), keep_history=True
    )
    return [walk(frame) for frame in frames if frame.timestamp_s > ends_s], walk.tracker.smoothed()


@pytest.mark.parametrize("spec", [WRIST, HAND], ids=["wrist", "hand"])
def test_every_number_of_every_frame(spec: RecordingSpec, tmp_path: Path) -> None:
    simulate(spec, tmp_path / "made")
    frames = damaged(list(TumFolder(tmp_path / "made").frames()))
    with choice.forced(choice.NUMPY):
        expected, looked_back = walked(tmp_path / "made", frames)
    assert {TrackStatus.TRACKED} <= {frame.status for frame in expected}
    for level in LEVELS:
        with choice.forced(level):
            found, again = walked(tmp_path / "made", frames)
        for one, other in zip(numbers([*found, *again]), numbers([*expected, *looked_back]), strict=True):
            np.testing.assert_allclose(one, other, rtol=NEAREST, atol=NEAREST)

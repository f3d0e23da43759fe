"""A short recording, pictures to angles and looked back, by NumPy and in C: the same hand."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from carpus.core.calibration.calibrate import calibrate
from carpus.core.calibration.clicks import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.kernels import choice
from carpus.core.pipeline.track import FramePipeline, TrackSettings, build_pipeline, learnt_from
from carpus.core.simulation.recording import CLICKS_FILE
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import Frame, TrackStatus
from tests.compiled.golden_tracks import damaged
from tests.kernels.pairs import LEVELS, numbers
from tests.rendered import LEFT_DEVIATION, WHOLE_HAND, Rendered

NEAREST = 1e-6
"""Of each number's size, or of one: the steps agree to 1e-9, and what is passed on from frame to frame adds up."""
NEAREST_PX = 1e-5
"""NumPy's detector sums colours in single precision, the one in C in double; a disc's place is known to 0.05 px."""
MOST_COUNTED_M = 2e-4
"""A reading just at the step that makes an edge may count or not, and moves the depth's sd by 1e-4 m at most."""
NEAREST_RAD = 1e-4
"""Angles of the whole way, which those differences shift."""

MOST_FRAMES = 30
"""Rendering costs more than all walks together: recordings that others show too, and the first of their pictures."""

Pipeline = Callable[[], FramePipeline[Tracker]]


def made(folder: Path) -> tuple[list[Frame], Pipeline]:
    """The frames to track, and walks of the hand calibrated in those before."""
    clicks = read_clicks(folder / CLICKS_FILE)
    frames = damaged(list(islice(TumFolder(folder).frames(), MOST_FRAMES)), clicks.pixel)
    camera, settings = TumFolder(folder).info.camera, TrackSettings()
    opening = [frame for frame in frames if frame.timestamp_s - frames[0].timestamp_s <= settings.calibration.still_s]
    outcome = calibrate(clicks, opening, camera, settings.calibration, settings.detection, None)
    ends_s = opening[max(outcome.capture_frames, 1) - 1].timestamp_s
    learnt = learnt_from(outcome.noise, ends_s, settings.tracker)
    return [one for one in frames if one.timestamp_s > ends_s], lambda: build_pipeline(
        outcome, camera, settings, learnt
    )


@pytest.mark.parametrize("spec", [LEFT_DEVIATION, WHOLE_HAND], ids=["wrist", "hand"])
def test_the_same_hand(spec: RecordingSpec, rendered: Rendered) -> None:
    frames, begun = made(rendered(spec))
    with choice.forced(choice.NUMPY):
        pipeline = begun()
        expected = [pipeline(frame) for frame in frames]
        looked_back = pipeline.tracker.smoothed()
        whole_pictures = [pipeline.detector.detect(frame) for frame in frames[::5]]
    assert {TrackStatus.TRACKED} <= {frame.status for frame in expected}
    for level in LEVELS:
        with choice.forced(level):
            tracker = begun().tracker
            found = [tracker.step(f.index, f.timestamp_s, f.detections, f.dropped_before) for f in expected]
            again = tracker.smoothed()
            pipeline = begun()
            followed = [pipeline(frame) for frame in frames]
            pictures = [pipeline.detector.detect(frame) for frame in frames[::5]]
        for one, other in zip(numbers([found, again]), numbers([expected, looked_back]), strict=True):
            np.testing.assert_allclose(one, other, rtol=NEAREST, atol=NEAREST)
        for blobs, same in zip(pictures, whole_pictures, strict=True):
            np.testing.assert_allclose(blobs.pixel, same.pixel, rtol=0.0, atol=NEAREST_PX)
            np.testing.assert_allclose(blobs.depth_m, same.depth_m, rtol=1e-12)
            np.testing.assert_allclose(blobs.depth_sd_m, same.depth_sd_m, rtol=1e-9, atol=MOST_COUNTED_M)
            np.testing.assert_allclose(blobs.area_px, same.area_px, rtol=NEAREST_PX)
            np.testing.assert_allclose(blobs.similarity, same.similarity, rtol=1e-9)
        for frame, same_frame in zip(followed, expected, strict=True):
            assert frame.status is same_frame.status
            for angles, others in (
                (frame.moment.angles_rad, same_frame.moment.angles_rad),
                (frame.moment.joint_angles_rad, same_frame.moment.joint_angles_rad),
            ):
                np.testing.assert_allclose(angles, others, rtol=0.0, atol=NEAREST_RAD)

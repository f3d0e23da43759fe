"""The yardstick of the bench does its job: it follows the hand, so that what is timed is a filter that works."""

from __future__ import annotations

import numpy as np

from carpus.core.model.types import Detections, Frame, Region
from carpus.core.pipeline.track import FramePipeline
from carpus.core.tracking import hand_filter
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.bench import reference
from tests.bench.tracking import spy_on_parts
from tests.tracking.hands import CAMERA, Pose, blobs, calibration


def test_plain_filter_follows_wrist_and_fingers() -> None:
    plain, rng = reference.ReferenceFilter(), np.random.default_rng(1)
    place_m, joints_rad = [], []
    for k in range(1, 150):
        truth = reference.motion(k / 30.0)
        pixel = reference.project_markers(truth[None])[0] + rng.normal(0.0, 1.0, 2 * reference.MARKERS)
        plain.step(pixel, 1.0 / 30.0)
        if k > 60:
            place_m.append(plain.mean[:3] - truth[:3])
            joints_rad.append(plain.mean[9:] - truth[9:])
    assert plain.mean.shape == (26,)
    assert np.sqrt(np.mean(np.square(place_m))) < 0.006
    assert np.degrees(np.sqrt(np.mean(np.square(joints_rad)))) < 8.0


def test_spy_measures_parts_of_frame_and_leaves_no_trace() -> None:
    class Blobs:
        def detect(self, _frame: Frame, _region: object = None) -> Detections:
            return blobs(Pose())

        def compute_search_region(self, *_: object) -> Region:
            return Region(0, 0, 1, 1)

    pipeline = FramePipeline(Blobs(), Tracker(calibration(), CAMERA, TrackerSettings()))  # type: ignore[arg-type]
    true = hand_filter.associate_and_update
    with spy_on_parts(pipeline) as spent:
        for index in range(5):
            pipeline(Frame(index, index / 30.0, np.zeros((1, 1, 3), np.uint8), None, 1e-3))
        assert hand_filter.associate_and_update is not true
    assert hand_filter.associate_and_update is true
    # Without depth there is nothing to fit the surface to, but its readings are looked for.
    assert set(spent) == {"detection", "association", "prediction", "surface"}
    assert min(spent.values()) > 0.0

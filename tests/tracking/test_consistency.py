"""What is seen and not used, or surprises for too long, makes a frame doubtful."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Detections, TrackedFrame, TrackStatus
from carpus.core.tracking.association.consistency import MAX_UNUSED_S, ConsistencyTest, find_unused_markers
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.hand_filter import HandFilter
from carpus.core.tracking.tracker import TrackedFrameBuilder, Tracker
from tests.tracking.hands import CAMERA, DT_S, MCP3, Pose, angles_deg, blobs, calibration, swing, truth_deg

NONE = np.zeros(3, dtype=bool)


def test_consistency_nis_beyond_bound_widens_the_sd() -> None:
    watch = ConsistencyTest(3)
    one = watch.update(DT_S, NONE, 200.0, 10, 2)
    assert not one.is_any or one.sd_factor < 3.0, "one surprise is not enough"
    for _ in range(30):
        last = watch.update(DT_S, NONE, 90.0, 10, 2)
    assert last.doubted.tolist() == [False, False, True]
    assert 2.5 < last.sd_factor < 3.1, "to what the innovations say, 9 times the variance"
    watch.reset()
    assert not watch.update(DT_S, NONE, 10.0, 10, 0).is_any


def test_unused_markers_need_a_free_blob_at_place_and_depth() -> None:
    disc_m = CAMERA.backproject(np.array([[100.0, 100.0], [200.0, 100.0]]), np.array([0.7, 0.7]))

    def find_unused(assigned: list[int], blob_px: list[list[float]], blob_m: list[float]) -> list[bool]:
        seen, some = Detections.none(), np.array(blob_px).reshape(-1, 2)
        seen = replace(seen, pixel=some, depth_m=np.array(blob_m))
        return find_unused_markers(disc_m, np.array(assigned), seen, CAMERA).tolist()

    assert find_unused([-1, 0], [[200.0, 100.0], [103.0, 101.0]], [0.7, 0.7]) == [True, False]
    assert find_unused([-1, 0], [[200.0, 100.0]], [0.7]) == [False, False]
    assert find_unused([-1, 0], [[200.0, 100.0], [130.0, 100.0]], [0.7, 0.7]) == [False, False]
    assert find_unused([-1, 0], [[200.0, 100.0], [103.0, 101.0]], [0.7, 0.6]) == [False, False]
    assert find_unused([-1, 0], [[200.0, 100.0], [103.0, 101.0]], [0.7, np.nan]) == [True, False]


def test_rejected_blob_is_left_out_and_stored() -> None:
    """The spot beside the hand is no disc, as a person said of a frame before."""
    motion, rng = swing(1, 35.0, 0.4), np.random.default_rng(1)
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    said_at, still_px = 20, np.array([260.0, 120.0])
    frames: list[TrackedFrame] = []
    for k in range(60):
        if k == said_at:
            tracker.labels.reject(tracker.markers.index("MCP3"), still_px)
        seen = blobs(motion(k * DT_S), rng, false_px=[] if 30 <= k < 40 else [still_px.tolist()])
        frames.append(tracker.step(k, k * DT_S, seen))
    left_out = np.array([int(frame.is_rejected.sum()) for frame in frames])
    assert not left_out[:said_at].any()
    shown = np.r_[said_at:30, 40:60]
    assert (left_out[shown] == 1).all(), "known again after it was out of sight"
    assert all(len(frames[k].detections) == 7 for k in shown), "and stored all the same"
    error = angles_deg(frames) - truth_deg(motion, np.arange(60) * DT_S)
    assert np.all(np.sqrt((error[10:] ** 2).mean(axis=0)) < [0.3, 0.9, 1.5])


def test_row_unused_marker_is_doubted_until_reset() -> None:
    settings = TrackerSettings()
    own = HandFilter(calibration(), CAMERA, settings)
    results = TrackedFrameBuilder(WRIST6, own.order, None, own.readout)
    seen = blobs(Pose())
    beside = replace(seen, pixel=seen.pixel + np.where(np.arange(6) == MCP3, 6.5, 0.0)[:, None] * [0.8, 0.6])

    def row(index: int) -> TrackedFrame:
        """Of a hand at rest that was there the moment before; nothing is accepted."""
        predicted = own.predict(0.0)
        scan = own.build_scan(predicted, beside, index * DT_S, DT_S)
        posterior = own.update(predicted, scan)
        assert posterior.palm.assigned[MCP3] < 0
        return results.build_frame(index, TrackStatus.TRACKED, posterior, scan, None, beside, 0)

    patient = int(MAX_UNUSED_S / DT_S) + 1
    rows = [row(index) for index in range(patient + 3)]
    assert rows[0].status is TrackStatus.TRACKED
    assert rows[-1].status is TrackStatus.DOUBTFUL
    assert rows[-1].doubted.tolist() == [marker == MCP3 for marker in range(6)]
    assert np.all(rows[-1].kinematics.angles_sd_rad > 1.4 * rows[0].kinematics.angles_sd_rad)
    assert results.build_lost_frame(99, 99 * DT_S, Detections.none(), 0).status is TrackStatus.LOST
    assert row(100).status is TrackStatus.TRACKED, "another hand: nothing is contradicted yet"
    np.testing.assert_allclose(row(101).measured_share, 5.0 / 6.0 * 2.0 / 3.0)

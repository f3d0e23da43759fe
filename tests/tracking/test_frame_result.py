"""What a frame's row says of what was measured, and for how long it doubts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Detections, TrackedFrame, TrackStatus
from carpus.core.tracking.association.consistency import MAX_UNUSED_S
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.hand_filter import HandFilter
from carpus.core.tracking.tracker import TrackedFrameBuilder
from tests.tracking.hands import CAMERA, DT_S, MCP3, Pose, blobs, calibration


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

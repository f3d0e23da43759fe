"""Whatever comes in: the covariance stays one, and no frame is claimed that is not there."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.types import Detections, FloatArray, TrackStatus
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.suites import few
from tests.tracking.hands import CAMERA, Pose, blobs, calibration

SETTINGS = {
    "default": TrackerSettings(),
    "without depth": TrackerSettings(use_depth=False),
    "brisk": TrackerSettings(profile="brisk"),
}


def trouble(seed: int, count: int) -> list[tuple[float, Detections]]:
    """A wandering hand: steps from 5 ms to 2 s, discs covered one by one and all together, false blobs, pictures
    without depth, the same measurements twice."""
    rng = np.random.default_rng(seed)
    time_s, angles, position = 0.0, np.zeros(3), np.zeros(3)
    out: list[tuple[float, Detections]] = []
    for i in range(count):
        is_gap = rng.random() < 0.1
        time_s += float(np.exp(rng.uniform(np.log(0.005), np.log(2.0)))) if is_gap else float(rng.uniform(0.005, 0.05))
        angles = np.clip(angles + rng.normal(size=3) * [3.0, 5.0, 5.0], [-35.0, -70.0, -60.0], [35.0, 70.0, 60.0])
        position = np.clip(position + 0.002 * rng.normal(size=3), -0.05, 0.05)
        covered = 1.0 if (i // 60) % 3 == 2 else 0.15
        found = blobs(
            Pose(angles, position),
            rng,
            hidden=np.flatnonzero(rng.random(6) < covered),
            false_px=[tuple(rng.uniform([100.0, 50.0], [500.0, 430.0])) for _ in range(rng.integers(0, 4))],
            with_depth=rng.random() > 0.1,
        )
        if out and rng.random() < 0.1:
            found = out[-1][1]
        out.append((time_s, found))
    return out


def is_covariance(p: FloatArray) -> bool:
    sd = np.sqrt(np.diag(p))
    scaled = p / np.outer(sd, sd)
    return bool(np.abs(scaled - scaled.T).max() < 1e-9 and np.linalg.eigvalsh(scaled)[0] > 0.0)


@pytest.mark.parametrize("name", few(SETTINGS, 2))
def test_tracker_random_input_keeps_a_valid_covariance(name: str) -> None:
    tracker = Tracker(calibration(), CAMERA, SETTINGS[name])
    statuses = []
    for i, (time_s, found) in enumerate(trouble(len(name), 190)):
        frame = tracker.step(i, time_s, found)
        estimate = tracker.record.history[-1].estimate
        statuses.append(frame.status)
        assert (estimate is None) == (frame.status is TrackStatus.LOST)
        if estimate is None:
            assert np.isnan(frame.kinematics.angles_rad).all()
            assert np.isnan(frame.kinematics.position_m).all()
            assert np.isnan(frame.kinematics.rotation_w2_w0).all()
            assert np.isnan(frame.marker_position_cam_m).all()
            continue
        assert is_covariance(estimate.covariance)
        assert np.allclose(estimate.rotation_w2_w0 @ estimate.rotation_w2_w0.T, np.eye(3), atol=1e-9)
        assert np.isfinite(frame.kinematics.angles_rad).all()
        assert (frame.kinematics.angles_sd_rad > 0.0).all()
        measured = np.isfinite(frame.marker_measured_px).all(axis=1)
        assert (frame.status is TrackStatus.TRACKED) == (np.count_nonzero(measured) >= 3)
        # Every measured place is a blob of this frame, and none is used twice.
        used = [tuple(pixel) for pixel in frame.marker_measured_px[measured]]
        assert len(set(used)) == len(used)
        assert set(used) <= {tuple(pixel) for pixel in found.pixel}
    assert set(statuses) >= {TrackStatus.TRACKED, TrackStatus.PREDICTED, TrackStatus.LOST}, "the run was hard enough"
    smoothed = tracker.smooth()
    assert [np.isnan(m.angles_rad).all() for m in smoothed] == [s is TrackStatus.LOST for s in statuses]

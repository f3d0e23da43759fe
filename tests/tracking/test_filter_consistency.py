"""The filter is as sure as it may be: innovations and errors against their stated covariances, motion by motion.

NIS: innovation against its covariance, per measured component; NEES: the turn's and the place's error against theirs,
per axis. Both are 1 on average when all is stated as it is. A hand's motion is no white acceleration: at rest and at
ends of strokes the filter allows for more than happens, so the averages may lie below 1, and hardly above.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.model.depth_sensor import PRIMESENSE
from carpus.core.model.types import Detections, FloatArray, TrackStatus
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.suites import few
from tests.tracking.hands import CAMERA, DT_S, RIGID, Motion, Pose, blobs, build_rotation, calibration, swing

PIXEL_SD_PX = 0.15
DEPTH_SD_M = float(np.hypot(PRIMESENSE.reading_sd_m(np.array(0.7)), PRIMESENSE.bias_sd_m(np.array(0.7))))
SECONDS, RUNS, SETTLED = 4.0, 2, 15
HIDDEN_SHARE = 0.1
MOTIONS: dict[str, Motion] = {
    "rest": lambda _time_s: Pose(),
    "slow deviation": swing(0, 25.0, 0.4),
    "slow flexion": swing(1, 50.0, 0.4),
    "slow pro/supination": swing(2, 35.0, 0.4),
    "fast deviation": swing(0, 25.0, 1.7),
}


def consistency(motion: Motion, settings: TrackerSettings, noise: float = 1.0) -> tuple[float, float, float]:
    """Mean NIS per component, and mean NEES per axis of turn and of place, over some runs of a well known palm.

    ``noise`` of the measurements over what the settings say of it.
    """
    nis, dof, turn, place = 0.0, 0, [], []
    for seed in range(RUNS):
        rng = np.random.default_rng(seed)
        tracker = Tracker(calibration(sd_m=1e-4), CAMERA, settings)
        for i in range(round(SECONDS / DT_S)):
            pose = motion(i * DT_S)
            found = blobs(
                pose,
                rng,
                hidden=np.flatnonzero(rng.random(6) < HIDDEN_SHARE),
                pixel_sd_px=noise * PIXEL_SD_PX,
                depth_sd_m=noise * DEPTH_SD_M,
            )
            frame = tracker.step(i, i * DT_S, found)
            estimate = tracker.record.history[-1].estimate
            if i < SETTLED or estimate is None:
                continue
            if frame.nis_dof:
                nis, dof = nis + frame.nis, dof + frame.nis_dof
            error = Rotation.from_matrix(estimate.rotation_w2_w0.T @ build_rotation(*pose.angles_deg)).as_rotvec()
            turn.append(compute_nees(error, estimate.covariance[6:9, 6:9]))
            place.append(compute_nees(pose.position_m - estimate.position_m, estimate.covariance[:3, :3]))
    return nis / dof, float(np.mean(turn)), float(np.mean(place))


def compute_nees(error: FloatArray, covariance: FloatArray) -> float:
    return float(error @ np.linalg.solve(covariance, error)) / error.size


def build_settings(**noise: float) -> TrackerSettings:
    """Settings that know the palm's depths to be right, with other choices about noise."""
    settings = RIGID
    return replace(settings, noise=replace(settings.noise, depth_bias_sd_m=0.0, **noise))


@pytest.mark.parametrize(
    "name", few(["slow flexion", "fast deviation", "rest", "slow deviation", "slow pro/supination"], 2)
)
def test_filter_nees_is_consistent(name: str) -> None:
    nis, turn, place = consistency(MOTIONS[name], build_settings())
    assert 0.7 < nis < 1.1
    assert 0.6 < turn < 1.25
    assert 0.6 < place < 1.25


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

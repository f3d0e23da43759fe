"""The papers' filter over frames: it follows what it can, and says when it cannot."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.types import FloatArray, Side, TrackedFrame, TrackStatus
from carpus.core.research.papers.tracker import PaperTracker
from tests.research.papers.hands import (
    MEASURED,
    blobs,
    calibration,
    finger_blobs,
    hand_calibration,
    palm_blobs,
    tilt_palm,
    track_poses,
)
from tests.tracking.hands import CAMERA, is_unknown, palm

FRAMES = 120
NOTHING = blobs(np.empty((0, 2)))


def swing(which: int, amplitude_deg: float, hz: float = 0.4):  # type: ignore[no-untyped-def]
    def at(time_s: float) -> FloatArray:
        return amplitude_deg * np.sin(2.0 * np.pi * hz * time_s) * np.eye(3)[which]

    return at


def wrist_tracker(side: Side = "right") -> PaperTracker:
    return PaperTracker(calibration(palm(side), side=side), CAMERA, MEASURED)


def errors_deg(frames: list[TrackedFrame], at) -> FloatArray:  # type: ignore[no-untyped-def]
    return np.array([np.degrees(frame.kinematics.angles_rad) - at(frame.timestamp_s) for frame in frames])


@pytest.mark.parametrize(("which", "amplitude_deg", "side"), [(0, 25.0, "left"), (1, 35.0, "right"), (2, 30.0, "left")])
def test_rigid_palm_without_clutter_is_followed_to_few_degrees(which: int, amplitude_deg: float, side: Side) -> None:
    at = swing(which, amplitude_deg)
    frames = track_poses(wrist_tracker(side), palm_blobs(at, FRAMES, side=side))
    error = errors_deg(frames, at)
    assert (np.sqrt(np.mean(error**2, axis=0)) < 4.0).all()
    assert all(frame.status is TrackStatus.TRACKED for frame in frames)
    sd = np.degrees([frame.kinematics.angles_sd_rad for frame in frames])
    assert np.mean(np.abs(error) < 2.0 * sd) > 0.8
    assert np.isnan(frames[-1].kinematics.angular_velocity_rad_s).all(), "white in the papers' model"


def test_papers_tracker_visible_hand_is_tracked() -> None:
    """Seen at a slant, so that the picture tells which way a finger bends."""
    rotation = tilt_palm(20.0)

    def bent(time_s: float) -> FloatArray:
        out = np.zeros(17)
        out[6::3] = out[7::3] = np.radians(15.0) * (1.0 - np.cos(0.5 * np.pi * time_s))
        out[5], out[14] = np.radians(8.0), np.radians(-8.0)
        return out * min(1.0, time_s)

    frames = track_poses(
        PaperTracker(hand_calibration(rotation), CAMERA, MEASURED), finger_blobs(bent, FRAMES, rotation)
    )
    assert all(frame.status is TrackStatus.TRACKED for frame in frames)
    error = np.degrees([frame.kinematics.joint_angles_rad - bent(frame.timestamp_s) for frame in frames])
    rmse = np.sqrt(np.mean(error[15:] ** 2, axis=0))
    assert (rmse[5:] < 6.0).all()
    assert (rmse[5::3] < 2.0).all(), "abduction is what a picture shows"
    wrist = np.sqrt(np.mean(np.degrees([frame.kinematics.angles_rad for frame in frames]) ** 2, axis=0))
    assert (wrist < 6.0).all()
    last = frames[-1]
    assert last.kinematics.joint_position_m.shape == (21, 3)
    assert np.isfinite(last.kinematics.joint_angles_sd_rad).all()
    assert (last.measured_share == 1.0).all()
    assert last.nis_dof == 42


@pytest.mark.parametrize("whole_hand", [False, True])
def test_papers_tracker_hidden_hand_is_predicted_lost_and_found(whole_hand: bool) -> None:
    at = swing(0, 0.0)
    if whole_hand:
        tracker = PaperTracker(hand_calibration(tilt_palm(0.0)), CAMERA, MEASURED)
        seen = finger_blobs(lambda _t: np.zeros(17), 20, tilt_palm(0.0))
    else:
        tracker, seen = wrist_tracker(), palm_blobs(at, 20)
    away = track_poses(tracker, [*seen, *(NOTHING,) * 70])
    status = [frame.status for frame in away]
    assert status[:20] == [TrackStatus.TRACKED] * 20
    last = 20 + status[20:].index(TrackStatus.LOST)
    assert set(status[20:last]) == {TrackStatus.PREDICTED}
    assert away[last].timestamp_s - away[19].timestamp_s == pytest.approx(1.5, abs=0.05)
    assert set(status[last:]) == {TrackStatus.LOST}
    assert all(is_unknown(frame) for frame in away[last:])
    assert all(np.isfinite(frame.kinematics.angles_rad).all() for frame in away[:last])
    sd = [frame.kinematics.angles_sd_rad[1] for frame in away[20:last]]
    assert (np.diff(sd) > 0.0).all(), "what is not seen grows less sure"

    part = blobs(np.delete(seen[0].pixel, 0, axis=0)) if not whole_hand else blobs(seen[0].pixel[:3])
    assert tracker.step(90, 3.0, part).status is TrackStatus.LOST, "not all of the palm is there"
    back = tracker.step(91, 3.1, seen[0])
    assert back.status is TrackStatus.TRACKED
    assert np.isfinite(back.kinematics.angles_rad).all()


def test_papers_tracker_random_blobs_never_fail() -> None:
    rng = np.random.default_rng(0)
    for tracker in (wrist_tracker(), PaperTracker(hand_calibration(tilt_palm(0.0)), CAMERA, MEASURED)):
        for i in range(90):
            found = blobs(rng.uniform((0.0, 0.0), (640.0, 480.0), (int(rng.integers(0, 40)), 2)))
            frame = tracker.step(i, i / 30.0 + (i > 45) * 4.0, found)
            if frame.status is TrackStatus.LOST:
                assert is_unknown(frame)
            else:
                assert np.isfinite(frame.kinematics.angles_rad).all()
                assert (frame.kinematics.angles_sd_rad >= 0.0).all()
                assert np.isfinite(frame.kinematics.joint_angles_sd_rad).all()
        assert len(frame.measured_share) in (3, 17)


def test_papers_tracker_gap_loses_the_hand() -> None:
    tracker, seen = wrist_tracker(), palm_blobs(swing(0, 0.0), 5)
    track_poses(tracker, seen)
    assert is_unknown(tracker.step(5, 9.0, seen[0]))
    assert tracker.step(6, 9.03, seen[0]).status is TrackStatus.TRACKED

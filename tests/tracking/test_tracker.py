"""What the tracker does: follow, bridge, lose, find again, and say how sure it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.types import Detections, Side, TrackedFrame, TrackStatus
from carpus.core.tracking.association import consistency
from carpus.core.tracking.filter.palm_state import SHAPE
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.suites import few
from tests.tracking.hands import (
    CAMERA,
    CMC1,
    DT_S,
    MCP3,
    MCP4,
    RIGID,
    WRIST,
    Motion,
    Pose,
    angles_deg,
    blobs,
    calibration,
    combine_motions,
    discs_cam_m,
    is_unknown,
    shift_pose,
    swing,
    track,
    truth_deg,
)

ALL = range(6)


def times(count: int) -> list[float]:
    return [k * DT_S for k in range(count)]


def seen(
    motion: Motion, count: int, seed: int = 0, side: Side = "right", hidden_from: int = 0, hidden_to: int = 0
) -> list[tuple[float, Detections]]:
    """``count`` frames of a motion, all discs covered from one frame to another."""
    rng = np.random.default_rng(seed)
    return [
        (t, blobs(motion(t), rng, side=side, hidden=ALL if hidden_from <= k < hidden_to else ()))
        for k, t in enumerate(times(count))
    ]


def statuses(frames: list[TrackedFrame]) -> list[TrackStatus]:
    return [frame.status for frame in frames]


def hold_still(_time_s: float) -> Pose:
    return Pose()


def named_rightly(frame: TrackedFrame, pose: Pose, side: Side = "right") -> bool:
    """Whether every blob taken for a marker is that marker's."""
    true = CAMERA.project(discs_cam_m(pose, side))
    taken = np.isfinite(frame.marker_measured_px[:, 0])
    return bool(taken.any() and np.linalg.norm(frame.marker_measured_px - true, axis=1)[taken].max() < 2.0)


@pytest.mark.parametrize(
    ("which", "amplitude_deg", "hz", "side"),
    [
        (0, 22.0, 0.4, "right"),
        (1, 45.0, 0.4, "left"),
        (2, 45.0, 0.4, "right"),
        (2, 45.0, 0.4, "left"),
        (0, 20.0, 1.7, "left"),
    ],
)
def test_tracker_angles_follow_both_hands(which: int, amplitude_deg: float, hz: float, side: Side) -> None:
    motion = swing(which, amplitude_deg, hz)
    frames = track(seen(motion, 120, seed=which, side=side), side=side)
    error = angles_deg(frames) - truth_deg(motion, times(120))
    assert set(statuses(frames)) == {TrackStatus.TRACKED}
    assert np.all(np.sqrt((error**2).mean(axis=0)) < [0.3, 0.9, 1.2])
    assert np.ptp(angles_deg(frames)[:, which]) == pytest.approx(2.0 * amplitude_deg, rel=0.1)
    assert all(named_rightly(frame, motion(t), side) for frame, t in zip(frames, times(120), strict=True))


@pytest.mark.parametrize(("which", "hz"), [(0, 1.0), (1, 0.4), (2, 1.0)])
@pytest.mark.parametrize("gone", few([30, 12]))
def test_tracker_hand_hidden_for_a_second_keeps_its_labels(which: int, gone: int, hz: float) -> None:
    motion = swing(which, 25.0, hz)
    for seed, start in enumerate((40, 52)):
        frames = track(seen(motion, start + gone + 10, seed, hidden_from=start, hidden_to=start + gone))
        assert set(statuses(frames[start : start + gone])) == {TrackStatus.PREDICTED}
        back = frames[start + gone :]
        assert TrackStatus.TRACKED in statuses(back[:3])
        error = np.abs(angles_deg(back) - truth_deg(motion, times(start + gone + 10)[start + gone :]))
        for frame, off, t in zip(back, error, times(start + gone + 10)[start + gone :], strict=True):
            if frame.status is TrackStatus.TRACKED:
                assert named_rightly(frame, motion(t))
                assert off.max() < 6.0, "no frame is called tracked at a wrong pose"


def test_tracker_hidden_hand_sd_grows_and_covers_the_truth() -> None:
    motion = swing(0, 20.0, 0.4)
    frames = track(seen(motion, 80, hidden_from=40, hidden_to=70))
    sd = np.degrees(np.array([frame.kinematics.angles_sd_rad for frame in frames]))
    assert (np.diff(sd[40:70, 0]) > 0.0).all()
    assert sd[45, 0] > 3.0 * sd[39, 0]
    error = np.abs(angles_deg(frames) - truth_deg(motion, times(80)))
    assert (error[40:70] < 4.0 * sd[40:70]).all()


def test_tracker_hand_hidden_for_long_is_lost_until_found() -> None:
    rng = np.random.default_rng(3)
    elsewhere = shift_pose(Pose(np.array([15.0, 20.0, -10.0])), [0.06, 0.05, 0.03])
    tracked = track(
        (t, blobs(elsewhere if k >= 90 else Pose(), rng, hidden=ALL if 20 <= k < 90 else ()))
        for k, t in enumerate(times(120))
    )
    assert tracked[20].status is TrackStatus.PREDICTED
    lost = [frame for frame in tracked[:90] if frame.status is TrackStatus.LOST]
    # 1.5 seconds after the last sight, and then until it is back.
    assert [frame.index for frame in lost] == list(range(lost[0].index, 90))
    assert 1.45 < lost[0].timestamp_s - tracked[19].timestamp_s < 1.6
    assert all(map(is_unknown, lost))
    assert set(statuses(tracked[90:])) == {TrackStatus.TRACKED}
    error = np.abs(angles_deg(tracked[93:]) - elsewhere.angles_deg)
    assert error.max() < 4.0
    assert named_rightly(tracked[-1], elsewhere)


def test_tracker_turned_palm_is_not_the_hidden_hand() -> None:
    """Blobs in the shape of a palm that points backwards: no wrist turns so far while it is covered for a blink."""
    backwards = Pose(np.array([175.0, 0.0, 0.0]), np.array([0.08, 0.0, 0.0]))
    rng = np.random.default_rng(5)
    frames = track(((t, blobs(backwards if 20 <= k < 50 else Pose(), rng)) for k, t in enumerate(times(60))), RIGID)
    assert np.abs(angles_deg(frames)).max() < 20.0
    assert set(statuses(frames[20:50])) == {TrackStatus.PREDICTED}
    assert set(statuses(frames[:20] + frames[50:])) == {TrackStatus.TRACKED}


def test_tracker_frames_without_depth_use_the_pixels() -> None:
    motion = swing(1, 30.0, 0.4)
    rng = np.random.default_rng(7)
    frames = track([(t, blobs(motion(t), rng, with_depth=k % 3 != 0)) for k, t in enumerate(times(120))])
    assert set(statuses(frames)) == {TrackStatus.TRACKED}
    error = angles_deg(frames) - truth_deg(motion, times(120))
    assert np.sqrt((error**2).mean(axis=0)).max() < 1.5
    assert np.isnan(frames[60].marker_measured_depth_m).all()
    assert np.isfinite(frames[61].marker_measured_depth_m).all()


def test_tracker_use_depth_false_ignores_depth() -> None:
    """``--no-depth``: the papers' measurement. With and without depths in the blobs the result is the same."""
    motion = swing(0, 20.0, 0.4)
    settings = TrackerSettings(use_depth=False)
    with_depths = track([(t, blobs(motion(t), np.random.default_rng(k))) for k, t in enumerate(times(60))], settings)
    without = track(
        [(t, blobs(motion(t), np.random.default_rng(k), with_depth=False)) for k, t in enumerate(times(60))], settings
    )
    assert np.array_equal(angles_deg(with_depths), angles_deg(without))
    error = angles_deg(with_depths) - truth_deg(motion, times(60))
    assert np.sqrt((error[:, 0] ** 2).mean()) < 0.5, "deviation is a measurement of the picture"


def test_tracker_lens_distortion_is_removed_and_restored() -> None:
    lens = replace(CAMERA, distortion=(0.08, -0.15, 0.001, -0.001, 0.0))
    motion = swing(0, 20.0, 0.4)
    ideal = seen(motion, 60, seed=9)
    frames = [(t, replace(found, pixel=lens.distort(found.pixel))) for t, found in ideal]
    tracked = track(frames, tracker=Tracker(calibration(), lens, TrackerSettings()))
    error = angles_deg(tracked) - truth_deg(motion, times(60))
    assert np.sqrt((error[:, 0] ** 2).mean()) < 0.3
    off = tracked[-1].marker_predicted_px - tracked[-1].marker_measured_px
    assert np.abs(off).max() < 2.0, "predictions are told in the real picture"
    assert set(map(tuple, tracked[-1].marker_measured_px)) == set(map(tuple, frames[-1][1].pixel))


def test_tracker_prediction_covers_the_markers() -> None:
    motion = swing(0, 20.0, 0.8)
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    outside = 0
    for k, t in enumerate(times(90)):
        expected = tracker.predict_measurement(t)
        assert expected is not None
        true = CAMERA.project(discs_cam_m(motion(t)))
        off = true - expected.pixel
        squared = np.einsum("mi,mij,mj->m", off, np.linalg.inv(expected.covariance_px2), off)
        outside += int(np.count_nonzero(squared > 25.0))
        tracker.step(k, t, blobs(motion(t), np.random.default_rng(k)))
    assert outside == 0


def test_tracker_restart_does_not_link_to_the_old_track() -> None:
    """After the still capture the tracker starts anew: nothing of before is counted twice."""

    def get_shape_sd(tracker: Tracker, step: int) -> float:
        estimate = tracker.record.history[step].estimate
        assert estimate is not None
        return float(np.trace(estimate.covariance[SHAPE, SHAPE]))

    first, second = seen(hold_still, 15, seed=1), [(15 * DT_S + t, found) for t, found in seen(hold_still, 30, seed=2)]
    again, fresh, on = (Tracker(calibration(), CAMERA, RIGID) for _ in range(3))
    track(first, tracker=again)
    again.begin_at_neutral()
    track(second, tracker=again)
    track(second, tracker=fresh)
    track([*first, *second], tracker=on)
    for k in range(30):
        assert get_shape_sd(again, 15 + k) == pytest.approx(get_shape_sd(fresh, k), rel=0.05)
    assert get_shape_sd(on, 15) < 0.9 * get_shape_sd(again, 15)


def test_tracker_smoothed_is_nearer_to_the_truth_than_filtered() -> None:
    filtered_error, smoothed_error = [], []
    for seed, (which, amplitude_deg, hz) in enumerate([(0, 22.0, 0.4), (1, 45.0, 0.4), (2, 40.0, 0.5)]):
        motion = swing(which, amplitude_deg, hz)
        tracker = Tracker(calibration(), CAMERA, RIGID)
        frames = track(seen(motion, 120, seed), tracker=tracker)
        truth = truth_deg(motion, times(120))
        smoothed = np.degrees([moment.angles_rad for moment in tracker.smooth()])
        filtered_error.append(angles_deg(frames) - truth)
        smoothed_error.append(smoothed - truth)
    filtered, smooth = (np.sqrt(np.mean(np.square(e), axis=(0, 1))) for e in (filtered_error, smoothed_error))
    assert np.all(smooth < 0.9 * filtered)


def test_tracker_smoothing_bridges_a_covered_stretch() -> None:
    for which, amplitude_deg in ((0, 22.0), (1, 40.0)):
        motion = swing(which, amplitude_deg, 0.4)
        tracker = Tracker(calibration(), CAMERA, TrackerSettings())
        frames = track(seen(motion, 120, hidden_from=60, hidden_to=80), tracker=tracker)
        truth = truth_deg(motion, times(120))
        error = angles_deg(frames) - truth
        smoothed = np.degrees([moment.angles_rad for moment in tracker.smooth()]) - truth
        assert np.abs(smoothed[60:80, which]).max() < 0.5 * np.abs(error[60:80, which]).max()
        # And what was measured before it is not pulled away.
        assert np.abs(smoothed[50:60, which]).max() < 1.0


@pytest.mark.parametrize("missing", few([15, 40, 3, 8, 30], 2))
def test_tracker_fast_hand_is_found_after_missing_frames(missing: int) -> None:
    """Going on as it did it would have turned over meanwhile; every disc of it is in sight."""
    motion, start = swing(1, 50.0, 1.5), 30
    for seed in range(4):
        frames = seen(motion, start + 3 * seed + missing + 8, seed)
        del frames[start + 3 * seed : start + 3 * seed + missing]
        back = track(frames)[start + 3 * seed :]
        assert set(statuses(back)) == {TrackStatus.TRACKED}
        for frame, (t, _) in zip(back, frames[start + 3 * seed :], strict=True):
            assert named_rightly(frame, motion(t))
            apart = np.linalg.norm(frame.marker_position_cam_m - discs_cam_m(motion(t)), axis=1)
            assert apart.max() < 0.012


def test_tracker_flipped_hand_is_corrected_by_other_markers() -> None:
    """So fast that wrist and thumb were not where they were expected, and with the knuckles the hand turned over."""
    motion = swing(1, 50.0, 2.2)
    for seed in range(3):
        frames = track(seen(motion, 120, seed))
        off = np.array(
            [
                np.linalg.norm(frame.marker_position_cam_m - discs_cam_m(motion(t)), axis=1).max() > 0.03
                for frame, t in zip(frames, times(120), strict=True)
            ]
        )
        assert np.count_nonzero(off) <= 4
        assert not off[-30:].any()


def test_tracker_search_is_incomplete_without_palm_or_turn() -> None:
    def found(count: int) -> Detections:
        return blobs(Pose(), hidden=range(count, 6))

    at = times(3)
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    track([(at[0], found(6)), (at[1], found(6))], tracker=tracker)
    assert [tracker.is_search_incomplete(found(count)) for count in (3, 4, 5)] == [True, False, False]
    tracker.step(2, at[2], blobs(Pose(), hidden=(WRIST, CMC1)))
    assert [tracker.is_search_incomplete(found(count)) for count in (3, 4, 5, 6)] == [True, True, True, False]


@pytest.mark.parametrize("before_m", [0.06, -0.1])
def test_tracker_blob_at_far_depth_is_never_associated(before_m: float) -> None:
    """A blue thing rests over the covered WRIST, or seems to lie on the table there, while the hand turns away."""
    rng, motion = np.random.default_rng(8), swing(0, 20.0, 0.4)
    wrist_px = CAMERA.project(discs_cam_m(Pose())[WRIST])
    covered = {"hidden": [WRIST], "false_px": [wrist_px], "false_depth_m": 0.7 - before_m}
    tracked = track((t, blobs(motion(t), rng, **(covered if k >= 4 else {}))) for k, t in enumerate(times(60)))
    assert np.isnan([frame.marker_measured_px[WRIST] for frame in tracked[4:]]).all()
    assert set(statuses(tracked)) == {TrackStatus.TRACKED}
    assert np.abs(angles_deg(tracked) - truth_deg(motion, times(60))).max() < 4.0


def test_tracker_four_false_blobs_do_not_move_a_hand_of_three() -> None:
    """They are one more than what is seen of the hand, and as far away as no hand was predicted to be."""
    rng = np.random.default_rng(9)
    like = blobs(shift_pose(Pose(np.array([38.0, 0.0, 0.0])), [0.05, 0.03, 0.0]), rng, hidden=(MCP3, MCP4))
    frames = [(t, blobs(Pose(), rng, hidden=(CMC1, MCP3, MCP4) if k >= 20 else ())) for k, t in enumerate(times(40))]
    tracked = track([*frames[:20], *((t, combine_motions(own, like)) for t, own in frames[20:])])
    assert set(statuses(tracked)) == {TrackStatus.TRACKED}
    assert all(named_rightly(frame, Pose()) for frame in tracked)
    assert np.abs(angles_deg(tracked)).max() < 4.0


@pytest.mark.parametrize(("seed", "side"), few([(1, "left"), (0, "right"), (2, "left"), (3, "right")]))
def test_tracker_other_hand_is_never_tracked(seed: int, side: Side) -> None:
    """It shows five or six discs, mirrored, while the hand is covered for longer than it is kept."""
    rng = np.random.default_rng(seed)
    own, other = swing(seed % 3, 25.0, 0.8), swing((seed + 1) % 3, 20.0, 0.6)
    beside_m = np.array([0.02, (0.13 + 0.03 * seed) * (1 if seed % 2 else -1), 0.02])
    frames = []
    for k, t in enumerate(times(100)):
        covered = 30 <= k < 85
        hand = blobs(own(t), rng, side=side, hidden=ALL if covered else ())
        hidden = (int(rng.integers(6)),) if rng.random() < 0.3 else ()
        mirrored: Side = "left" if side == "right" else "right"
        frames.append(
            (t, combine_motions(hand, blobs(shift_pose(other(t), beside_m), rng, side=mirrored, hidden=hidden)))
        )
    tracked = track(frames, side=side)
    assert set(statuses(tracked[:30])) == set(statuses(tracked[88:])) == {TrackStatus.TRACKED}
    assert TrackStatus.TRACKED not in statuses(tracked[30:85])
    assert tracked[84].status is TrackStatus.LOST
    off_m = np.linalg.norm(tracked[-1].marker_position_cam_m - discs_cam_m(own(frames[-1][0]), side), axis=1)
    assert off_m.max() < 0.01


def test_tracker_long_gap_reacquires_the_hand() -> None:
    """The camera stood still for twelve seconds in the middle of a stroke: nothing is carried over them."""
    rng = np.random.default_rng(8)
    moving, elsewhere = swing(1, 30.0, 0.5), shift_pose(Pose(np.array([-10.0, 20.0, 5.0])), [0.04, 0.03, 0.0])
    before = [(t, blobs(moving(t), rng)) for t in times(65)]
    after = [(before[-1][0] + 12.0 + t, blobs(elsewhere, rng)) for t in times(10)]
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    track(before, tracker=tracker)
    assert tracker.predict_measurement(after[0][0]) is None
    frames = track(after, tracker=tracker)
    assert set(statuses(frames)) == {TrackStatus.TRACKED}
    assert np.abs(angles_deg(frames) - elsewhere.angles_deg).max() < 4.0
    assert max(np.linalg.norm(frame.kinematics.velocity_m_s) for frame in frames) < 0.3


def lose_and_find(shown_after: int) -> list[TrackStatus]:
    """A hand hidden until it is lost, then there for ``shown_after`` pictures, then all but one disc hidden again."""
    gone, back, rng = 20, 90, np.random.default_rng(11)
    hidden = [()] * gone + [tuple(ALL)] * (back - gone) + [()] * shown_after + [(0, 1, 2, 4, 5)] * 3
    return statuses(track((k * DT_S, blobs(Pose(), rng, hidden=some)) for k, some in enumerate(hidden)))[back:]


def test_tracker_doubt_widens_only_the_sd(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    frames = [(t, blobs(Pose(), np.random.default_rng(i), pixel_sd_px=0.6)) for i, t in enumerate(times(20))]
    monkeypatch.setattr(consistency, "MAX_MEAN_NIS", 1e9)
    sure = track(frames)[-1]
    monkeypatch.setattr(consistency, "MAX_MEAN_NIS", 0.0)
    doubted = track(frames)[-1]
    assert (sure.status, doubted.status) == (TrackStatus.TRACKED, TrackStatus.DOUBTFUL)
    assert np.array_equal(sure.kinematics.angles_rad, doubted.kinematics.angles_rad)
    widened = doubted.kinematics.angles_sd_rad / sure.kinematics.angles_sd_rad
    assert widened[0] > 1.2
    assert widened == pytest.approx(np.full(3, widened[0]))


def test_tracker_reacquired_hand_is_on_probation() -> None:
    """Found out of nothing and gone in the next pictures, it was no hand; borne out for a while, it is one hidden."""
    brief = lose_and_find(2)
    assert brief[:2] == [TrackStatus.TRACKED] * 2
    assert brief[2:] == [TrackStatus.LOST] * 3
    just_short = lose_and_find(5)
    assert just_short[5:] == [TrackStatus.LOST] * 3
    long = lose_and_find(8)
    assert long[8:] == [TrackStatus.PREDICTED] * 3

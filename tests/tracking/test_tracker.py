"""What the tracker does: follow, bridge, lose, find again, and say how sure it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.types import Detections, FloatArray, Side, TrackedFrame, TrackStatus
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
    build_rotation,
    calibration,
    combine_motions,
    discs_cam_m,
    is_unknown,
    shift_pose,
    swing,
    track,
    truth_deg,
)

SIDES: tuple[Side, Side] = ("right", "left")
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


def test_tracker_step_needs_no_prediction() -> None:
    """What was predicted before a picture came spares work and decides nothing."""
    walk = seen(swing(1, 30.0, 1.0), 12)
    bare, asked, misled = (Tracker(calibration(), CAMERA, RIGID) for _ in range(3))
    for k, (time_s, found) in enumerate(walk):
        frames = (
            bare.step(k, time_s, found),
            _asked_for(asked, time_s).step(k, time_s, found),
            _asked_for(misled, time_s + 0.2).step(k, time_s, found),
        )
        assert all(np.array_equal(frames[0].kinematics.angles_rad, frame.kinematics.angles_rad) for frame in frames)


def _asked_for(tracker: Tracker, time_s: float) -> Tracker:
    assert tracker.predict_measurement(time_s) is not None
    return tracker


def hold_still(_time_s: float) -> Pose:
    return Pose()


def named_rightly(frame: TrackedFrame, pose: Pose, side: Side = "right") -> bool:
    """Whether every blob taken for a marker is that marker's."""
    true = CAMERA.project(discs_cam_m(pose, side))
    taken = np.isfinite(frame.marker_measured_px[:, 0])
    return bool(taken.any() and np.linalg.norm(frame.marker_measured_px - true, axis=1)[taken].max() < 2.0)


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    ("which", "amplitude_deg", "hz"), [(0, 22.0, 0.4), (1, 45.0, 0.4), (2, 45.0, 0.4), (0, 20.0, 1.7)]
)
def test_tracker_angles_follow_both_hands(which: int, amplitude_deg: float, hz: float, side: Side) -> None:
    motion = swing(which, amplitude_deg, hz)
    frames = track(seen(motion, 120, seed=which, side=side), side=side)
    error = angles_deg(frames) - truth_deg(motion, times(120))
    assert set(statuses(frames)) == {TrackStatus.TRACKED}
    assert np.all(np.sqrt((error**2).mean(axis=0)) < [0.3, 0.9, 1.2])
    assert np.ptp(angles_deg(frames)[:, which]) == pytest.approx(2.0 * amplitude_deg, rel=0.1)
    assert all(named_rightly(frame, motion(t), side) for frame, t in zip(frames, times(120), strict=True))


@pytest.mark.parametrize("hidden", [(0,), (3,), (1, 5), (2, 4)])
def test_tracker_covered_markers_are_tolerated(hidden: tuple[int, ...]) -> None:
    motion = swing(1, 40.0, 0.4)
    rng = np.random.default_rng(1)
    frames = track([(t, blobs(motion(t), rng, hidden=hidden if t > 1.0 else ())) for t in times(120)])
    error = angles_deg(frames) - truth_deg(motion, times(120))
    assert set(statuses(frames)) == {TrackStatus.TRACKED}
    assert np.abs(error).max() < 5.0
    last = frames[-1]
    assert np.isnan(last.marker_measured_px[list(hidden)]).all()
    assert np.isfinite(last.marker_position_cam_m).all()
    there = discs_cam_m(motion(times(120)[-1]))
    assert np.linalg.norm(last.marker_position_cam_m - there, axis=1).max() < 0.004, "hidden ones too"


@pytest.mark.parametrize("hz", [0.4, 1.0])
@pytest.mark.parametrize("which", [0, 1, 2])
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


def test_tracker_lone_blob_is_not_associated_after_long_hiding() -> None:
    """Something blue lies where a disc might be while a sleeve covers the hand for a second."""
    rng, moving = np.random.default_rng(6), swing(0, 20.0, 0.4)
    thing_px = [CAMERA.project(discs_cam_m(Pose())[WRIST]) + [9.0, 6.0]]
    seen_at = [
        (t, blobs(moving(t), rng, hidden=ALL, false_px=thing_px, false_depth_m=0.705) if 20 <= k < 50
         else blobs(moving(t), rng))
        for k, t in enumerate(times(60))
    ]  # fmt: skip
    frames = track(seen_at)
    assert np.isnan([frame.marker_measured_px for frame in frames[31:50]]).all()
    assert frames[-1].status is TrackStatus.TRACKED
    assert np.abs(angles_deg(frames[-1:])[0] - moving(59 * DT_S).angles_deg).max() < 2.0


@pytest.mark.parametrize("shown", [(), (WRIST,), (WRIST, CMC1)])
def test_tracker_motion_while_hidden_is_covered_by_the_sd(
    shown: tuple[int, ...],
) -> None:
    rng = np.random.default_rng(8)
    tracker = Tracker(calibration(), CAMERA, TrackerSettings())
    hidden = [disc for disc in range(6) if disc not in shown]
    for i in range(60):
        at_s = i * DT_S
        # At rest for a second, then off while hidden: 30 degrees in half a second.
        flexed_deg = float(np.interp(i, [31, 46], [0.0, 30.0]))
        pose = Pose(np.array([0.0, flexed_deg, 0.0]))
        frame = tracker.step(i, at_s, blobs(pose, rng, hidden=hidden if 30 <= i < 50 else ()))
        off = np.abs(frame.kinematics.angles_rad - np.radians(pose.angles_deg)) / frame.kinematics.angles_sd_rad
        assert off.max() < 3.0, i
    assert frame.status is TrackStatus.TRACKED
    assert named_rightly(frame, pose)


def test_tracker_jump_in_sight_is_followed_within_three_frames() -> None:
    rng = np.random.default_rng(4)
    there = shift_pose(Pose(np.array([-15.0, 30.0, 10.0])), [0.05, -0.06, 0.02])
    frames = track([(t, blobs(Pose() if k < 20 else there, rng)) for k, t in enumerate(times(40))])
    late = frames[23:]
    assert set(statuses(late)) == {TrackStatus.TRACKED}
    assert all(named_rightly(frame, there) for frame in late)
    assert np.abs(angles_deg(late) - there.angles_deg).max() < 5.0


def test_tracker_false_blobs_near_markers_are_not_associated() -> None:
    motion, rng = swing(0, 20.0, 0.4), np.random.default_rng(5)

    def beside_px(time_s: float) -> FloatArray:
        """Two radii away, moving along."""
        return CAMERA.project(discs_cam_m(motion(time_s)))[[2, 5]] + [[9.0, -6.0], [-8.0, 7.0]]

    tracked = track((t, blobs(motion(t), rng, false_px=beside_px(t), false_depth_m=0.70)) for t in times(120))
    assert set(statuses(tracked)) == {TrackStatus.TRACKED}
    assert all(named_rightly(frame, motion(t)) for frame, t in zip(tracked, times(120), strict=True))


def test_tracker_false_blobs_do_not_replace_covered_markers() -> None:
    rng = np.random.default_rng(6)
    covered = {"hidden": [MCP3], "false_px": [CAMERA.project(discs_cam_m(Pose()))[MCP3] + [10.0, 10.0]]}
    tracked = track((t, blobs(Pose(), rng, **(covered if k >= 20 else {}))) for k, t in enumerate(times(60)))
    assert np.isnan([frame.marker_measured_px[MCP3] for frame in tracked[20:]]).all()
    assert np.abs(angles_deg(tracked)).max() < 3.0


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


@pytest.mark.parametrize(
    ("start_deg", "flexes_deg", "reads_deg"),
    [([25.0, 0.0, 0.0], 30.0, [25.0, 30.0, 0.0]), ([0.0, 30.0, 0.0], -30.0, [0.0, 0.0, 0.0])],
    ids=["deviated", "flexed"],
)
@pytest.mark.parametrize("side", SIDES)
def test_tracker_start_angles_are_added_as_rotations(
    side: Side, start_deg: list[float], flexes_deg: float, reads_deg: list[float]
) -> None:
    """A hand calibrated deviated by 25 that then flexes by 30 about its own axis: R_start R, not the other order; one
    calibrated flexed that straightens."""
    tracker = Tracker(calibration(side, start_angles_rad=np.radians(start_deg)), CAMERA, TrackerSettings())

    def turning(time_s: float) -> Pose:
        return Pose(np.array([0.0, flexes_deg * min(1.0, max(0.0, time_s - 0.2) / 1.5), 0.0]))

    frames = track(seen(turning, 75, side=side), tracker=tracker)
    assert angles_deg(frames)[3] == pytest.approx(start_deg, abs=1.0)
    expected = build_rotation(*start_deg, side) @ build_rotation(0.0, flexes_deg, 0.0, side)
    assert np.allclose(frames[-1].kinematics.rotation_w2_w0, expected, atol=0.03)
    assert angles_deg(frames)[-1] == pytest.approx(reads_deg, abs=1.5)


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


def test_tracker_without_history_records_no_steps() -> None:
    tracker = Tracker(calibration(), CAMERA, TrackerSettings(), keep_history=False)
    track(seen(hold_still, 10), tracker=tracker)
    assert tracker.record.history == []


def test_tracker_smoothed_is_nearer_to_the_truth_than_filtered() -> None:
    filtered_error, smoothed_error = [], []
    for seed, (which, amplitude_deg, hz) in enumerate([(0, 22.0, 0.4), (1, 45.0, 0.4), (2, 40.0, 0.5), (0, 20.0, 1.7)]):
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


def test_tracker_direct_share_is_that_of_the_last_second() -> None:
    rng = np.random.default_rng(10)
    frames = track([(t, blobs(Pose(), rng, hidden=(1, 2) if k >= 30 else ())) for k, t in enumerate(times(75))])
    assert frames[29].measured_share == pytest.approx([1.0] * 3)
    assert frames[45].measured_share == pytest.approx([1.0 - 16 / 31 / 3] * 3, abs=0.02)
    assert frames[74].measured_share == pytest.approx([4 / 6] * 3)


def test_tracker_gap_between_frames_keeps_the_track() -> None:
    """After a drop at 15 pictures a second with only the knuckles in view, the prediction still counts."""
    errors = []
    for seed in range(6):
        rng = np.random.default_rng(seed)
        motion = swing(1, 20.0, 0.3)
        at = [k / 15.0 for k in range(75) if k not in (40, 41)]
        frames = track([(t, blobs(motion(t), rng, hidden=(WRIST, 1) if 2.6 < t < 3.4 else ())) for t in at], RIGID)
        blind = [k for k, t in enumerate(at) if 2.7 < t < 3.4]
        errors.append(np.abs(angles_deg(frames) - truth_deg(motion, at))[blind].max())
    assert np.median(errors) < 8.0


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
    for seed in range(6):
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


@pytest.mark.parametrize(("seed", "side"), few([(0, "right"), (1, "left"), (2, "left"), (3, "right")], 2))
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

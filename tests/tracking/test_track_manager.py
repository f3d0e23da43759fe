"""When a track begins, is confirmed, coasts and is given up, by times and counts alone."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from carpus.core.model import so3
from carpus.core.model.types import LossReason, TrackStatus
from carpus.core.tracking.association.reacquire import FoundPalm
from carpus.core.tracking.association.track_manager import (
    CONFIRMATION_S,
    MAX_RATE_RAD_S,
    MAX_TURN_RAD,
    MIN_PALM_MARKERS,
    PROBATION_S,
    TURN_SLACK_RAD,
    VAGUE_SD_RAD,
    TrackManager,
    TrackStage,
)

LOST_AFTER_S, LEAST_FOUND = 1.5, 4


def manager(*, amid_digits: bool = False) -> TrackManager:
    out = TrackManager(LEAST_FOUND, LOST_AFTER_S, has_digits=amid_digits)
    out.begin_at_neutral()
    return out


def build_found(count: int, turned_rad: float = 0.0) -> FoundPalm:
    return FoundPalm(np.zeros(3), so3.exp(np.array([turned_rad, 0.0, 0.0])), np.arange(6) < count)


def update_track(track: TrackManager, at_s: float, count: int, *, fits: bool = True) -> TrackStatus:
    track.start_frame(at_s)
    return track.update_status(at_s, count, is_consistent=fits)


def test_track_without_frames_times_out() -> None:
    track = manager()
    assert not track.is_timed_out(99.0), "before the first frame there is nothing to be late for"
    update_track(track, 2.0, 6)
    assert not track.is_timed_out(2.0 + LOST_AFTER_S)
    assert track.is_timed_out(2.01 + LOST_AFTER_S)
    assert track.time_step_s(2.5) == 0.5
    track.begin_at_neutral(5.0)
    assert track.time_step_s(5.25) == 0.25
    assert not track.start_frame(5.25)
    assert track.start_frame(5.5)
    track.drop_track(6.0)
    assert track.time_step_s(6.25) == 0.25, "a loss is of its own moment"


@pytest.mark.parametrize(("count", "stage"), [(4, TrackStage.TENTATIVE), (5, TrackStage.CONFIRMED)])
def test_track_found_by_fewest_markers_is_tentative(count: int, stage: TrackStage) -> None:
    track = manager()
    track.drop_track(1.0)
    assert track.is_lost
    assert track.try_initiate(build_found(count), 1.1)
    assert track.stage is stage
    assert track.is_reacquisition_due(5, 0, 0.0) == (stage is TrackStage.TENTATIVE)
    assert track.turn_limits(np.eye(3), 1.1).max_rad == (
        MAX_TURN_RAD if stage is TrackStage.TENTATIVE else pytest.approx(TURN_SLACK_RAD)
    )
    update_track(track, 1.2, 5, fits=False)
    assert track.stage is stage
    update_track(track, 1.3, 4)
    assert track.stage is stage
    update_track(track, 1.4, 5)
    assert track.stage is TrackStage.CONFIRMED


def test_track_unconfirmed_or_few_markers_is_uncertain() -> None:
    track = manager()
    update_track(track, 0.0, 6)
    assert not track.is_weakly_supported(MIN_PALM_MARKERS + 1, VAGUE_SD_RAD)
    assert track.is_weakly_supported(MIN_PALM_MARKERS, 0.0)
    assert track.is_weakly_supported(6, VAGUE_SD_RAD + 0.01)
    update_track(track, 0.1, 0)
    assert track.is_weakly_supported(6, 0.0)
    update_track(track, 0.2, 6)
    assert not track.is_weakly_supported(6, 0.0)


def test_track_reacquired_unconfirmed_pose_is_lost_within_probation_only() -> None:
    track = manager()
    track.drop_track(1.0)
    track.try_initiate(build_found(6), 1.1)
    least, unconfirmed = MIN_PALM_MARKERS, LossReason.UNCONFIRMED_POSE
    assert track.find_loss_reason(least, 1.1) is unconfirmed
    assert track.find_loss_reason(least + 1, 1.1) is None
    assert track.find_loss_reason(least - 1, 1.1 + 0.9 * PROBATION_S) is unconfirmed
    assert track.find_loss_reason(least, 1.1 + 0.9 * PROBATION_S) is None
    assert track.find_loss_reason(0, 1.1 + 1.1 * PROBATION_S) is None


def test_track_lost_keeps_and_logs_the_first_reason(caplog: pytest.LogCaptureFixture) -> None:
    track = manager()
    update_track(track, 0.0, 6)
    reason = track.find_loss_reason(MIN_PALM_MARKERS - 1, LOST_AFTER_S + 0.1)
    with caplog.at_level(logging.INFO):
        track.drop_track(LOST_AFTER_S + 0.1, reason)
        track.drop_track(9.0, LossReason.NO_FRAMES)
    assert track.loss_reason is LossReason.TOO_FEW_MARKERS
    assert len(caplog.records) == 1
    assert LossReason.TOO_FEW_MARKERS.value in caplog.text


def test_track_four_markers_among_fingers_need_confirmation() -> None:
    assert manager().try_initiate(build_found(4), 0.0)
    assert manager(amid_digits=True).try_initiate(build_found(5), 0.0)
    step_s = 0.4 * CONFIRMATION_S

    def start_track(*turned_rad: float, counts: tuple[int, ...] = (4, 4, 4, 4)) -> list[bool]:
        track = manager(amid_digits=True)
        track.drop_track(0.0)
        out = []
        for k, (turn, count) in enumerate(zip(turned_rad, counts, strict=True)):
            track.start_frame(k * step_s)
            out.append(track.try_initiate(build_found(count, turn), k * step_s) if count else False)
        return out

    assert start_track(0.0, 0.1, 0.2, 0.3) == [False, False, False, True]
    assert not any(start_track(0.0, 0.1, 0.1 + 1.1 * TURN_SLACK_RAD, 0.1 + 1.1 * TURN_SLACK_RAD))
    assert not any(start_track(0.0, 0.0, 0.0, 0.0, counts=(4, 4, 0, 4))), "not seen for a picture it begins anew"


def test_turn_limits_grow_with_time_up_to_the_maximum() -> None:
    track, turned = manager(), so3.exp(np.array([0.0, 0.4, 0.0]))
    update_track(track, 0.0, 6)
    capped_s = (MAX_TURN_RAD - TURN_SLACK_RAD) / MAX_RATE_RAD_S
    at = [track.turn_limits(turned, gone_s) for gone_s in (0.0, 0.05, 0.99 * capped_s, 1.01 * capped_s, 9.0)]
    most = [TURN_SLACK_RAD + gone_s * MAX_RATE_RAD_S for gone_s in (0.0, 0.05, 0.99 * capped_s)]
    assert [one.max_rad for one in at] == pytest.approx([*most, MAX_TURN_RAD, MAX_TURN_RAD])
    assert all(one.max_tilt_rad == MAX_TURN_RAD for one in at)
    assert all(one.rotation_w2_w0 is turned for one in at[:3])
    anyhow = track.widest_turn_limits()
    assert all(np.array_equal(one.rotation_w2_w0, np.eye(3)) for one in (*at[3:], anyhow)), "no longer as foreseen"

"""When a track begins, is confirmed, coasts and is given up, by times and counts alone."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from carpus.core.model import so3
from carpus.core.model.types import LossReason, TrackStatus
from carpus.core.tracking.association.reacquire import FoundPalm
from carpus.core.tracking.association.track_manager import (
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

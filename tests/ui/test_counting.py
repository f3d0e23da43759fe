"""The live count: whenever it is asked for, it is what the measures find in all that was recorded up to then."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.hand.exercises import FLEXION, exercise_named
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.repetitions import find_repetitions
from carpus.core.measures.signals import even_signal
from carpus.core.types import TrackedFrame, TrackStatus
from carpus.ui.live.counting import RunningCount
from tests.moments import with_moment
from tests.ui.fakes import FakeFeed

RATE_HZ = 30.0


@lru_cache(maxsize=1)
def any_frame() -> TrackedFrame:
    return FakeFeed(seconds=1.0).frames[20]


@settings(max_examples=25, deadline=None)
@given(
    amplitude_deg=st.floats(3.0, 60.0),
    frequency_hz=st.floats(0.2, 1.5),
    offset_deg=st.floats(-40.0, 40.0),
    lengths=st.lists(st.integers(1, 70), min_size=3, max_size=12),
    hidden=st.lists(st.integers(0, 600), max_size=4),
    seed=st.integers(0, 1000),
)
def test_counted_piece_by_piece_is_counted_as_a_whole(
    amplitude_deg: float, frequency_hz: float, offset_deg: float, lengths: list[int], hidden: list[int], seed: int
) -> None:
    random = np.random.default_rng(seed)
    count = sum(lengths)
    time_s = 3.0 + np.cumsum(random.uniform(0.9, 1.1, count)) / RATE_HZ
    angle_deg = (
        offset_deg + amplitude_deg * np.sin(2.0 * np.pi * frequency_hz * time_s) + random.normal(0.0, 0.3, count)
    )
    seen = np.ones(count, dtype=bool)
    for start in hidden:
        seen[start : start + 12] = False
    frame, flexion = any_frame(), np.arange(len(WRIST_ANGLES)) == FLEXION
    frames = [
        replace(
            with_moment(frame, angles_rad=np.where(flexion, np.radians(angle_deg[k]), frame.moment.angles_rad)),
            timestamp_s=float(time_s[k]),
            status=TrackStatus.TRACKED if seen[k] else TrackStatus.PREDICTED,
        )
        for k in range(count)
    ]
    running, end, most = RunningCount(exercise_named("WRIST_FE")), 0, 0
    for length in lengths:
        running.append(frames[end : end + length])
        end += length
        whole = even_signal(time_s[:end], np.radians(angle_deg[:end]), seen[:end])
        expected = len(find_repetitions(whole).repetitions) if len(whole.time_s) else 0
        most = max(most, expected)  # what was counted is never unmade
        if end > 2:
            assert running.count() == most


def test_what_somebody_else_moved_neither_counts_nor_is_a_best() -> None:
    frame, time_s = any_frame(), np.arange(0.0, 30.0, 1.0 / RATE_HZ)
    angle_deg = np.where(time_s < 15.0, 30.0, 60.0) * np.sin(2.0 * np.pi * 0.4 * time_s)
    frames = [
        replace(
            with_moment(frame, angles_rad=np.radians([0.0, angle, 0.0]), angles_sd_rad=np.radians([0.5, 0.7, 1.2])),
            timestamp_s=float(at_s),
            status=TrackStatus.TRACKED,
        )
        for at_s, angle in zip(time_s, angle_deg, strict=True)
    ]
    half, running = len(frames) // 2, RunningCount(exercise_named("WRIST_FE"))
    running.append(frames[:half])
    by_itself = running.count()
    running.say_way(frames[half - 1].timestamp_s, passive=True)
    running.append(frames[half:-60])
    assert running.count() <= by_itself + 1, "the one that had begun"
    assert running.best_positive_deg < 31.0
    running.say_way(frames[-60].timestamp_s, passive=False)
    running.append(frames[-60:])
    assert running.best_positive_deg > 31.0, "by itself again"


def test_frames_just_after_a_hand_came_back_give_no_best() -> None:
    frame = any_frame()
    count = 90
    angle_deg = np.full(count, 20.0)
    angle_deg[60:62] = 60.0  # found again in a wrong pose for two pictures
    angle_deg[80] = 30.0
    frames = [
        replace(
            with_moment(
                frame,
                angles_rad=np.radians([0.0, angle_deg[k], 0.0]),
                angles_sd_rad=np.radians([0.5, 0.7, 1.2]),
            ),
            timestamp_s=3.0 + k / RATE_HZ,
            status=TrackStatus.PREDICTED if 40 <= k < 60 else TrackStatus.TRACKED,
        )
        for k in range(count)
    ]
    running = RunningCount(exercise_named("WRIST_FE"))
    running.append(frames)
    assert abs(running.best_positive_deg - 30.0) < 1e-9
    at_once = RunningCount(exercise_named("WRIST_FE"))
    at_once.append(frames[:3])
    assert abs(at_once.best_positive_deg - 20.0) < 1e-9, "the first frames of a recording count"

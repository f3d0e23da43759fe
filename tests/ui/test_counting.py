"""The live count: whenever it is asked for, it is what the measures find in all that was recorded up to then."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from core.hand.protocols import WRIST_ANGLES
from core.measures.repetitions import find_repetitions
from core.measures.signals import even_signal
from core.output.exercises import FLEXION, exercise_named
from core.types import TrackedFrame, TrackStatus
from tests.ui.fakes import FakeFeed
from ui.live.counting import RunningCount

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
    frame = any_frame()
    frames = [
        replace(
            frame,
            timestamp_s=float(time_s[k]),
            status=TrackStatus.TRACKED if seen[k] else TrackStatus.PREDICTED,
            angles_rad=np.where(np.arange(len(WRIST_ANGLES)) == FLEXION, np.radians(angle_deg[k]), frame.angles_rad),
        )
        for k in range(count)
    ]
    running, end = RunningCount(exercise_named("WRIST_FE")), 0
    for length in lengths:
        running.append(frames[end : end + length])
        end += length
        whole = even_signal(time_s[:end], np.radians(angle_deg[:end]), seen[:end])
        expected = len(find_repetitions(whole).repetitions) if len(whole.time_s) else 0
        if end > 2:
            assert running.count() == expected

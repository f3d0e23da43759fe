"""A stored source played at its own times, and as a patient who rests until let go and moves once."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from itertools import islice

import numpy as np
import pytest

from carpus.core.capture.playback_sources import PacedSource, PracticeSource
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.types import Frame
from tests.pipeline.live_fakes import frame, wait_until


class Stored:
    """Frames 0.1 s apart, at once."""

    def __init__(self, gap_s: float = 0.1, count: int = 4) -> None:
        self.info = SourceInfo("stored", DEFAULT_CAMERA, False, count, 1.0 / gap_s)
        self.closed = 0
        self._gap_s = gap_s
        self._count = count

    def frames(self) -> Iterator[Frame]:
        for index in range(self._count):
            one = frame(index)
            yield Frame(index, 50.0 + index * self._gap_s, one.color_rgb, None, 0.001)

    def close(self) -> None:
        self.closed += 1


def test_paced_source_releases_no_frame_early() -> None:
    source, begin_s = PacedSource(Stored(), speed=2.0), time.monotonic()
    arrivals = [(one.index, time.monotonic()) for one in source.frames()]
    assert [index for index, _ in arrivals] == [0, 1, 2, 3]
    for index, at_s in arrivals:  # not from when the first one was taken up, which may be late
        assert at_s - begin_s >= index * 0.05 - 1e-3
    assert source.info.nominal_fps == pytest.approx(20.0)


def test_paced_source_keeps_late_frames() -> None:
    source = PacedSource(Stored(gap_s=0.001, count=5))
    seen = []
    for one in source.frames():
        time.sleep(0.005)
        seen.append(one.index)
    assert seen == [0, 1, 2, 3, 4]


def test_paced_source_close_ends_wait_and_closes_source() -> None:
    behind = Stored(gap_s=3600.0)
    source = PacedSource(behind)
    seen: list[int] = []
    player = threading.Thread(target=lambda: seen.extend(one.index for one in source.frames()))
    player.start()
    wait_until(lambda: seen == [0])
    assert behind.closed == 0
    source.close()
    player.join(20.0)
    assert not player.is_alive()
    assert seen == [0]
    assert behind.closed >= 1
    source.close()


STILL, TOTAL = 6, 15


class Take:
    """Fifteen frames at 10 fps; each picture's value is its number; one frame is missing before the twelfth."""

    def __init__(self) -> None:
        self.info = SourceInfo("take", DEFAULT_CAMERA, False, TOTAL, 10.0)
        self.closed = False

    def frames(self) -> Iterator[Frame]:
        for number in range(TOTAL):
            time_s = 50.0 + 0.1 * number + (0.1 if number >= 12 else 0.0)
            yield Frame(number, time_s, np.full((2, 2, 3), number, np.uint8), None, 1e-3, int(number == 12))

    def close(self) -> None:
        self.closed = True


def numbers(frames: list[Frame]) -> list[int]:
    return [int(frame.color_rgb[0, 0, 0]) for frame in frames]


def test_practice_source_rests_after_movement_with_rising_times() -> None:
    source = PracticeSource(Take(), still_s=0.55)
    source.start_movement()
    walk = source.frames()
    moved, rest = TOTAL - STILL, 25
    frames = list(islice(walk, moved + rest))
    assert numbers(frames[:moved]) == list(range(STILL, TOTAL))
    assert set(numbers(frames[moved:])) == set(range(STILL))
    source.start_movement()
    frames += islice(walk, TOTAL + 5)
    assert numbers(frames[moved + rest : moved + rest + TOTAL]) == list(range(TOTAL))
    assert set(numbers(frames[moved + rest + TOTAL :])) <= set(range(STILL))
    steps = np.diff([frame.timestamp_s for frame in frames])
    gap = np.array([frame.dropped_before for frame in frames[1:]]) > 0
    np.testing.assert_allclose(steps, np.where(gap, 0.2, 0.1), atol=1e-9)
    assert [frame.index for frame in frames] == list(range(len(frames)))


def test_practice_source_next_recording_is_played_at_next_start() -> None:
    take, other = Take(), Take()
    source = PracticeSource(take, 0.55)
    source.start_movement()
    walk = source.frames()
    list(islice(walk, TOTAL - STILL + 3))
    other.frames = lambda: iter(list(Take().frames())[::-1])  # type: ignore[method-assign]
    source.set_next_recording(other)
    source.start_movement()
    assert numbers(list(islice(walk, TOTAL))) == list(range(TOTAL))[::-1]
    source.close()
    assert take.closed
    assert other.closed


def test_practice_source_rests_until_movement_is_available() -> None:
    beginning, whole = Take(), Take()
    beginning.frames = lambda: islice(Take().frames(), STILL)  # type: ignore[method-assign]
    source = PracticeSource(beginning, 0.55, is_still_only=True)
    walk = source.frames()
    source.start_movement()
    assert numbers(list(islice(walk, STILL))) == list(range(STILL)), "each as soon as it is there"
    assert not source.can_move
    assert set(numbers(list(islice(walk, 30)))) <= set(range(STILL)), "nothing to show yet"
    source.set_next_recording(whole)
    assert source.can_move
    moving = list(islice(walk, TOTAL))
    assert numbers(moving) == list(range(TOTAL))
    source.set_next_recording(None)
    source.start_movement()
    assert set(numbers(list(islice(walk, 30)))) <= set(range(STILL)), "the next one is not drawn either"
    source.close()
    assert whole.closed
    assert beginning.closed
    assert list(walk) == []

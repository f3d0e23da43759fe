"""The practice patient: rests until let go, moves once, rests until let go again; times as a camera's."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

import numpy as np

from carpus.core.capture.playback_sources import PracticeSource
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.types import Frame

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

"""A stored source played at its own times."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import pytest

from carpus.core.capture.playback_sources import PacedSource
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


def test_paced_source_can_be_played_again() -> None:
    source = PacedSource(Stored(gap_s=0.001))
    assert [one.index for one in source.frames()] == [one.index for one in source.frames()]

"""A source, a tracker and sinks without camera, filter and disk, that the tests can hold, slow down and break."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.types import Detections, Frame, TrackedFrame, TrackStatus
from tests.session.samples import make_frame

PATIENCE_S = 60.0
"""How long a test waits for what must happen; only a failing test ever waits that long."""


def wait_until(condition: Callable[[], bool]) -> None:
    """Returns when a condition holds; fails the test when it does not come to hold."""
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.001)


def frame(index: int, dropped_before: int = 0) -> Frame:
    """A tiny picture whose every pixel is its number."""
    color = np.full((4, 6, 3), index % 256, np.uint8)
    return Frame(index, 100.0 + index / 30.0, color, None, 0.001, dropped_before)


def make_tracked_frame(of: Frame) -> TrackedFrame:
    """A tracked frame that remembers which frame it came from."""
    return replace(
        make_frame(0),
        index=of.index,
        timestamp_s=of.timestamp_s,
        status=TrackStatus.TRACKED,
        detections=Detections.none(),
        dropped_before=of.dropped_before,
    )


class ControlledSource:
    """Delivers frames only when let; counts how often it was closed."""

    def __init__(self, total: int | None = None, fault: Exception | None = None, dropped_before: int = 0) -> None:
        self.info = SourceInfo("held", DEFAULT_CAMERA, False, total, 30.0)
        self.closed = 0
        self._total = total
        self._fault = fault
        self._dropped_before = dropped_before
        self._allowed = threading.Semaphore(0)
        self._ended = threading.Event()

    def let(self, count: int) -> None:
        """Allows the next frames."""
        self._allowed.release(count)

    def frames(self) -> Iterator[Frame]:
        index = 0
        while self._total is None or index < self._total:
            while not self._allowed.acquire(timeout=0.01):
                if self._ended.is_set():
                    return
            yield frame(index, self._dropped_before)
            index += 1
        if self._fault is not None:
            raise self._fault

    def close(self) -> None:
        self.closed += 1
        self._ended.set()


class Gate:
    """A door that a thread passes only while it is open; tells whether somebody waits."""

    def __init__(self) -> None:
        self._open = threading.Event()
        self.waiting = False

    def open(self) -> None:
        self._open.set()

    def pass_through(self) -> None:
        self.waiting = not self._open.is_set()
        assert self._open.wait(PATIENCE_S)
        self.waiting = False


def make_gated_tracker(gate: Gate, since: int = 0) -> Callable[[Frame], TrackedFrame]:
    """A tracker that waits at a gate with the pictures from ``since`` on."""

    def slow(of: Frame) -> TrackedFrame:
        if of.index >= since:
            gate.pass_through()
        return make_tracked_frame(of)

    return slow


class FakeSession:
    """A session file in memory; ``fault_at`` breaks at that row; ``gate`` holds up every row."""

    def __init__(self, path: Path, fault_at: int | None = None, gate: Gate | None = None) -> None:
        self.path = path
        self.rows: list[TrackedFrame] = []
        self.pictures: list[Frame] = []
        self.events: list[tuple[float, str, str]] = []
        self.flushed = 0
        self.ended = ""
        self.threads: set[str] = set()
        self._fault_at = fault_at
        self._gate = gate

    def append(self, row: TrackedFrame) -> None:
        self._before(len(self.rows))
        self.rows.append(row)

    def append_frame(self, picture: Frame) -> None:
        self._before(len(self.pictures))
        self.pictures.append(picture)

    def add_event(self, time_s: float, kind: str, text: str) -> None:
        self.events.append((time_s, kind, text))

    def prepare(self) -> None:
        self.flushed = len(self.rows)

    def close(self) -> None:
        self._end("closed")

    def abandon(self) -> None:
        self._end("abandoned")

    def discard(self) -> None:
        self._end("discarded")

    def _before(self, count: int) -> None:
        self.threads.add(threading.current_thread().name)
        if self._gate is not None:
            self._gate.pass_through()
        if count == self._fault_at:
            raise OSError(28, "No space left on device")

    def _end(self, how: str) -> None:
        self.threads.add(threading.current_thread().name)
        self.ended = how

"""Recordings that a library plays in the capture process: it may die, hang, be closed or started anew at any moment."""

from __future__ import annotations

import os
import signal
import threading
from multiprocessing.shared_memory import SharedMemory
from typing import Any

import numpy as np
import pytest

from carpus.core.capture.devices import capture_process
from carpus.core.model.errors import DriverFailed
from carpus.core.model.types import Frame
from tests.capture.oni_samples import color_picture
from tests.capture.played import PlayedSource


def assert_whole(frames: list[Frame], count: int) -> None:
    assert [frame.index for frame in frames] == list(range(count))
    assert all(np.array_equal(frame.color_rgb, color_picture(frame.index + 1)) for frame in frames)
    assert not any(frame.color_rgb.flags.writeable for frame in frames)


def test_file_player_dead_library_raises() -> None:
    source = PlayedSource(60)
    frames = source.frames()
    next(frames)
    os.kill(source.pid, signal.SIGSEGV)
    with pytest.raises(DriverFailed, match="SIGSEGV"):
        list(frames)
    assert_whole(list(source.frames()), 60)


def test_file_player_close_ends_pass_of_another_thread() -> None:
    source = PlayedSource(60)
    frames = source.frames()
    next(frames)
    os.kill(source.pid, signal.SIGSTOP)
    rest: list[Frame] = []
    reader = threading.Thread(target=lambda: rest.extend(frames))
    reader.start()
    source.close()
    reader.join(60.0)
    assert not reader.is_alive()
    assert len(rest) < 60


@pytest.fixture
def memories(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the shared memories that a test's own capture processes were given."""
    names: list[str] = []

    def noted(*arguments: Any, **options: Any) -> SharedMemory:
        memory = SharedMemory(*arguments, **options)
        names.append(memory.name)
        return memory

    monkeypatch.setattr(capture_process, "SharedMemory", noted)
    return names


def exists(name: str) -> bool:
    try:
        SharedMemory(name).close()
    except FileNotFoundError:
        return False
    return True


def test_file_player_leaves_no_process_or_memory(memories: list[str]) -> None:
    source = PlayedSource(30)
    first = source.frames()
    next(first)
    frames = source.frames()
    next(frames)
    assert len(list(first)) < 29, "a new pass ends the one before"
    pid = source.pid
    assert exists(memories[-1])
    frames.close()  # type: ignore[attr-defined]
    assert len(memories) == 2
    assert not any(exists(name) for name in memories)
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    source.close()
    source.close()
    assert list(source.frames()) == []


def test_capture_process_failed_start_leaves_no_memory(memories: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise OSError("no more processes")

    monkeypatch.setattr("multiprocessing.context.SpawnProcess.start", refuse)
    with pytest.raises(OSError, match="no more processes"):
        list(PlayedSource(2).frames())
    assert [exists(name) for name in memories] == [False]

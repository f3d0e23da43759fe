"""Recordings that a library plays in the capture process: it may die, hang, be closed or started anew at any moment."""

from __future__ import annotations

import os
import signal
import threading
from multiprocessing.shared_memory import SharedMemory
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.capture.devices import capture_process
from carpus.core.capture.devices.capture_process import CaptureProcess
from carpus.core.model.errors import DriverFailed
from carpus.core.model.types import Frame
from tests.capture.oni_samples import color_picture
from tests.capture.played import PlayedSource

ROOT = Path(__file__).parents[2]


def assert_whole(frames: list[Frame], count: int) -> None:
    assert [frame.index for frame in frames] == list(range(count))
    assert all(np.array_equal(frame.color_rgb, color_picture(frame.index + 1)) for frame in frames)
    assert not any(frame.color_rgb.flags.writeable for frame in frames)


def test_file_player_new_pass_ends_the_one_before() -> None:
    source = PlayedSource(30)
    first = source.frames()
    next(first)
    assert_whole(list(source.frames()), 30)
    assert len(list(first)) < 30
    source.close()
    source.close()
    assert list(source.frames()) == []


@pytest.mark.parametrize(("blow", "detail"), [(signal.SIGSEGV, "SIGSEGV"), (signal.SIGSTOP, "no answer")])
def test_file_player_dead_or_hanging_library_raises(
    blow: signal.Signals, detail: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = PlayedSource(60)
    frames = source.frames()
    next(frames)
    with monkeypatch.context() as patience:
        patience.setattr(CaptureProcess.receive_report, "__defaults__", (0.5,))
        os.kill(source.pid, blow)
        with pytest.raises(DriverFailed) as caught:
            list(frames)
    assert detail in caught.value.detail
    assert len(list(source.frames())) == 60


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
    next(source.frames())
    frames = source.frames()
    next(frames)
    pid = source.pid
    assert exists(memories[-1])
    frames.close()  # type: ignore[attr-defined]
    assert len(memories) == 2
    assert not any(exists(name) for name in memories)
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_capture_process_failed_start_leaves_no_memory(memories: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise OSError("no more processes")

    monkeypatch.setattr("multiprocessing.context.SpawnProcess.start", refuse)
    with pytest.raises(OSError, match="no more processes"):
        list(PlayedSource(2).frames())
    assert [exists(name) for name in memories] == [False]

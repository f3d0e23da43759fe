"""What every test gets: one BLAS thread, no screen, folders of its own, and no thread left behind."""

from __future__ import annotations

import multiprocessing
import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

# Before anything imports NumPy or Qt: two BLAS pools stall each other, and there is no screen to open windows on.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

_FOLDERS = ("XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME")
_GRACE_S = 5.0
"""How long a thread may take to end after its test; a leak never ends, so the figure only delays the report."""


@pytest.fixture(autouse=True)
def own_folders(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Settings, patients and caches of the person who runs the tests are neither read nor written.

    Child processes inherit it. Returns the folder that stands for the person's home.
    """
    home = tmp_path_factory.mktemp("home")
    for name in _FOLDERS:
        folder = home / name.lower()
        folder.mkdir(mode=0o700)
        monkeypatch.setenv(name, str(folder))
    return home


@pytest.fixture(autouse=True)
def no_thread_left() -> Iterator[None]:
    """Fails a test that leaves a thread or a child process running."""
    threads_before = set(threading.enumerate())
    children_before = {child.pid for child in multiprocessing.active_children()}
    yield
    end = time.monotonic() + _GRACE_S
    while True:
        threads = [t for t in threading.enumerate() if t not in threads_before and not _is_foreign(t)]
        children = [c for c in multiprocessing.active_children() if c.pid not in children_before]
        if not (threads or children) or time.monotonic() > end:
            break
        time.sleep(0.01)
    assert not threads, f"left running: {[t.name for t in threads]}"
    assert not children, f"left running: {[c.name for c in children]}"


def _is_foreign(thread: threading.Thread) -> bool:
    """Threads that Python only borrowed (Qt's own, seen once in a callback) are not ours to end."""
    return isinstance(thread, threading._DummyThread)

"""Child processes: settled before their work is loaded, ended with their owner, callable from a daemon."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from multiprocessing.connection import Connection
from pathlib import Path

import pytest

from carpus.core.platform.child_process import (
    BLAS_THREADS,
    ChildDiedError,
    ChildProcess,
    call_in_child,
    end_with_owner,
)

ROOT = Path(__file__).parents[1]


def tell_state(link: Connection) -> None:
    link.send((signal.getsignal(signal.SIGINT), [os.environ.get(name) for name in BLAS_THREADS]))


def sleep_deaf(link: Connection) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    link.send("deaf")
    time.sleep(120.0)


def sleep_until_owner_goes(link: Connection) -> None:
    end_with_owner()
    link.send(os.getpid())
    time.sleep(120.0)


def refuse() -> None:
    raise ValueError("not today")


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def call_from_daemon() -> None:
    assert multiprocessing.current_process().daemon
    assert call_in_child(len, "four") == 4
    assert multiprocessing.current_process().daemon


@pytest.mark.parametrize(
    "is_forked", [False, pytest.param(True, marks=pytest.mark.skipif("win32" in sys.platform, reason="no fork"))]
)
def test_child_process_resets_signals_and_threads(is_forked: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in BLAS_THREADS:
        monkeypatch.delenv(name, raising=False)
    child = ChildProcess(tell_state, name="test", is_forked=is_forked)
    assert child.link.recv() == (signal.SIG_IGN, ["1"] * len(BLAS_THREADS))
    child.end(grace_s=60.0)
    assert not child.is_alive


def test_child_process_loads_work_after_signals_are_set() -> None:
    code = "import sys, carpus.core.platform.child_process; print({'h5py', 'numpy', 'PySide6'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "set()"


def test_child_process_ignoring_its_end_is_killed() -> None:
    child = ChildProcess(sleep_deaf, name="test")
    assert child.link.recv() == "deaf"
    child.terminate()
    child.end(grace_s=0.1)
    assert "SIGKILL" in child.describe_exit()


def test_child_process_ends_with_its_owner() -> None:
    owner = (
        "from carpus.core.platform.child_process import ChildProcess\n"
        "child = ChildProcess('tests.test_child_process:sleep_until_owner_goes', name='test')\n"
        "print(child.link.recv(), flush=True)\n"
        "import os, signal; os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", owner], capture_output=True, text=True, cwd=ROOT, check=False, timeout=60
    )
    state = Path(f"/proc/{int(done.stdout)}/stat")
    until_s = time.monotonic() + 60.0
    while state.exists() and state.read_text().rsplit(")", 1)[1].split()[0] != "Z":
        assert time.monotonic() < until_s, "the child outlives its owner"
        time.sleep(0.02)


def test_call_in_child_returns_value_or_raises() -> None:
    assert call_in_child(len, "four") == 4
    with pytest.raises(ValueError, match="not today"):
        call_in_child(refuse)
    with pytest.raises(ChildDiedError, match="SIGKILL"):
        call_in_child(die)
    with pytest.raises(ChildDiedError, match="no answer"):
        call_in_child(time.sleep, 120.0, limit_s=0.1)


def test_child_process_starts_from_daemon() -> None:
    """A worker of a pool, as researchers use them, may read sessions."""
    process = multiprocessing.get_context("spawn").Process(target=call_from_daemon, daemon=True)
    process.start()
    process.join(60.0)
    assert process.exitcode == 0

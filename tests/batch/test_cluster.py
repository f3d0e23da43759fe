"""A real scheduler with two workers: the same numbers as on one machine, also when a worker is killed on the way."""

from __future__ import annotations

import csv
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from tqdm import tqdm

from carpus.app.__main__ import main
from carpus.app.batch.cluster import outcomes_on
from carpus.app.batch.places import places
from carpus.app.batch.tables import OUTCOMES_FILE
from carpus.app.batch.work import Outcome, Task
from carpus.core.errors import SchedulerUnreachable
from carpus.core.pipeline.track import TrackSettings
from carpus.core.session.reader import read_session
from carpus.core.simulation.recording import simulate
from carpus.core.simulation.spec import RecordingSpec

ROOT = Path(__file__).parents[2]
COUNT = 4


@dataclass(frozen=True)
class Cluster:
    address: str
    workers: list[subprocess.Popen[bytes]]


@pytest.fixture(autouse=True)
def _quiet_bars(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tqdm, "monitor_interval", 0)  # the bars' own thread would outlive the test


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    at = tmp_path / "scheduler.json"
    here = ("--host", "127.0.0.1")

    def begin(kind: str, *options: str) -> subprocess.Popen[bytes]:
        words = (sys.executable, "-m", f"distributed.cli.dask_{kind}", "--scheduler-file", str(at), *here, *options)
        return subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    begun = [begin("scheduler", "--port", "0", "--no-dashboard", "--no-show")]
    try:
        begun += [begin("worker", "--nthreads", "1", "--no-nanny", "--no-dashboard") for _ in range(2)]
        from distributed import Client

        with Client(scheduler_file=str(at), timeout="120s", set_as_default=False) as client:
            client.wait_for_workers(2, timeout=120)
            address = client.scheduler.address
        yield Cluster(address, begun[1:])
    finally:
        for process in reversed(begun):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def recordings(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("recordings")
    for seed in range(COUNT):
        simulate(RecordingSpec(seed=seed, seconds=0.7), root / f"r{seed}")
    return root


def told(folder: Path) -> dict[str, str]:
    with (folder / OUTCOMES_FILE).open(newline="", encoding="utf-8") as file:
        return {row["session"]: row["outcome"] for row in csv.DictReader(file)}


def test_a_worker_that_is_killed_costs_nothing(cluster: Cluster, recordings: Path, tmp_path: Path) -> None:
    out = tmp_path / "far"
    tasks = [Task(place, TrackSettings(smooth=False)) for place in places([recordings], out)]
    coming = outcomes_on(cluster.address, tasks)
    found: list[Outcome] = [next(coming)]
    cluster.workers[0].send_signal(signal.SIGKILL)
    found += coming
    assert cluster.workers[1].poll() is None
    assert sorted(each.place.name for each in found) == [f"r{seed}.h5" for seed in range(COUNT)]
    assert {each.result for each in found} <= {"tracked", "kept"}

    # The same by the command, which finds all done; and the same numbers as here.
    words = ["track", str(recordings), "--no-smooth"]
    assert main([*words, "--output", str(out), "--scheduler", cluster.address]) == 0
    assert set(told(out).values()) == {"kept"}
    assert main([*words, "--output", str(tmp_path / "near"), "--jobs", "2"]) == 0
    for seed in range(COUNT):
        far, near = (read_session(folder / f"r{seed}.h5").motion for folder in (out, tmp_path / "near"))
        assert np.array_equal(far.angles_rad, near.angles_rad, equal_nan=True)
        assert np.array_equal(far.angles_sd_rad, near.angles_sd_rad, equal_nan=True)


def test_a_scheduler_that_is_not_there_is_told(
    recordings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("carpus.app.batch.cluster.PATIENCE_S", 1.0)
    begin = time.monotonic()
    with pytest.raises(SchedulerUnreachable):
        list(outcomes_on("tcp://127.0.0.1:9", []))
    assert time.monotonic() - begin < 60.0
    words = ["track", str(recordings), "--output", str(tmp_path / "out"), "--scheduler", "nonsense://"]
    assert main(words) == 1
    assert "nonsense" in capsys.readouterr().err


def test_without_the_extra_it_says_what_to_install(
    recordings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["track", str(recordings), "--output", str(tmp_path / "out"), "--scheduler", "tcp://x:1"]) == 1
    assert "carpus[cluster]" in capsys.readouterr().err

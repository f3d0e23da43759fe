"""A real scheduler with workers as people start them: the same numbers as on one machine, also when a worker or the
client is killed on the way."""

from __future__ import annotations

import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from distributed import Client
from pyarrow import parquet

from carpus.app.__main__ import main
from carpus.app.batch.processes import outcomes_on
from carpus.app.batch.work import Outcome, Task
from carpus.app.commands.track_many import OUTCOMES_FILE
from carpus.app.sources import places
from carpus.core.errors import SchedulerUnreachable
from carpus.core.pipeline.track import TrackSettings
from carpus.core.session.reader import read_session
from tests.rendered import DEVIATION, FLEXION, LEFT_DEVIATION, Rendered

ROOT = Path(__file__).parents[2]
RECORDINGS = (FLEXION, DEVIATION, LEFT_DEVIATION)
COUNT = len(RECORDINGS)
LOCAL = """
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=1, dashboard_address=":0") as cluster:
        print(cluster.scheduler_address, flush=True)
        __import__('sys').stdin.read()
"""


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A scheduler and two workers as people start them: each has its nanny, and is a daemon."""
    folder = tmp_path_factory.mktemp("cluster")
    at = folder / "scheduler.json"

    def begin(kind: str, *options: str) -> subprocess.Popen[bytes]:
        here = ("--scheduler-file", str(at), "--host", "127.0.0.1")
        words = (sys.executable, "-m", f"distributed.cli.dask_{kind}", *here, *options)
        return subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    begun = [begin("scheduler", "--port", "0", "--no-dashboard", "--no-show")]
    try:
        begun.append(begin("worker", "--nworkers", "2", "--nthreads", "1", "--no-dashboard"))
        with Client(scheduler_file=str(at), timeout="120s", set_as_default=False) as client:
            client.wait_for_workers(2, timeout=120)
            address: str = client.scheduler.address
        yield address
    finally:
        for process in reversed(begun):
            process.terminate()  # the nannies end their workers
        for process in begun:
            process.wait(60)


@pytest.fixture(scope="module")
def recordings(rendered: Rendered, tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("recordings")
    for number, spec in enumerate(RECORDINGS):
        shutil.copytree(rendered(spec), root / f"r{number}")
    return root


def told(folder: Path) -> dict[str, str]:
    with (folder / OUTCOMES_FILE).open(newline="", encoding="utf-8") as file:
        return {row["session"]: row["outcome"] for row in csv.DictReader(file)}


def test_a_worker_that_is_killed_costs_nothing(address: str, recordings: Path, tmp_path: Path) -> None:
    out = tmp_path / "far"
    tasks = [Task(place, TrackSettings(smooth=False)) for place in places([recordings], out)]
    with Client(address, set_as_default=False) as client:
        processes = client.run(os.getpid)
    coming = outcomes_on(address, tasks)
    found: list[Outcome] = [next(coming)]
    os.kill(next(iter(processes.values())), signal.SIGKILL)
    found += coming
    assert sorted(each.place.name for each in found) == [f"r{seed}.h5" for seed in range(COUNT)]
    assert {each.result for each in found} <= {"tracked", "kept"}, [each.said for each in found]
    assert {path.suffix for path in out.iterdir()} == {".h5"}, "nothing half-done is left"

    # The same by the command, which finds all done; and the same numbers as here.
    words = ["track", str(recordings), "--no-smooth"]
    assert main([*words, "--output", str(out), "--scheduler", address]) == 0
    assert set(told(out).values()) == {"kept"}
    assert main([*words, "--output", str(tmp_path / "near"), "--jobs", "2"]) == 0
    for seed in range(COUNT):
        far, near = (read_session(folder / f"r{seed}.h5").motion for folder in (out, tmp_path / "near"))
        assert np.array_equal(far.angles_rad, near.angles_rad, equal_nan=True)
        assert np.array_equal(far.angles_sd_rad, near.angles_sd_rad, equal_nan=True)


def test_a_client_that_is_killed_begins_again(address: str, recordings: Path, tmp_path: Path) -> None:
    out, table = tmp_path / "out", tmp_path / "all.parquet"
    words = ["track", str(recordings), "--no-smooth", "--output", str(out), "--table", str(table)]
    words += ["--scheduler", address]
    client = subprocess.Popen([sys.executable, "-m", "carpus", *words], stderr=subprocess.DEVNULL)
    until = time.monotonic() + 120.0
    while not list(out.glob("*.part")) and time.monotonic() < until:
        time.sleep(0.01)
    client.kill()
    client.wait()
    assert not table.exists()
    assert main(words) == 0
    assert set(told(out)) == {f"r{seed}.h5" for seed in range(COUNT)}
    assert set(told(out).values()) <= {"tracked", "kept"}
    assert set(parquet.read_table(table).column("session").to_pylist()) == set(told(out))
    assert {path.suffix for path in out.iterdir()} == {".h5", ".csv"}
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == [table.name]
    assert main(words) == 0, "and once more"


def test_a_cluster_made_in_python_tracks(recordings: Path, tmp_path: Path) -> None:
    """Dask's own default: workers in processes, several threads each."""
    place = places([recordings / "r0"], tmp_path)[0]
    broken = replace(place, clicks=recordings / "none.json", session=tmp_path / "none.h5", name="none.h5")
    tasks = [Task(each, TrackSettings(smooth=False)) for each in (place, broken)]
    begun = subprocess.Popen([sys.executable, "-c", LOCAL], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    address = begun.stdout.readline().strip()
    found = {each.place.name: each for each in outcomes_on(address, tasks)}
    begun.communicate("", 60)
    assert found["r0.h5"].result == "tracked"
    assert found["none.h5"].result == "fault"
    assert "none.json" in found["none.h5"].said[0]


def test_a_scheduler_that_is_not_there_is_told(
    recordings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("carpus.app.batch.processes.PATIENCE_S", 1.0)
    with pytest.raises(SchedulerUnreachable):
        list(outcomes_on("tcp://127.0.0.1:9", []))
    words = ["track", str(recordings), "--output", str(tmp_path / "out"), "--scheduler", "nonsense://"]
    assert main(words) == 1
    assert "nonsense" in capsys.readouterr().err


def test_without_the_extra_it_says_what_to_install(
    recordings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["track", str(recordings), "--output", str(tmp_path / "out"), "--scheduler", "tcp://x:1"]) == 1
    assert "-m pip install distributed" in capsys.readouterr().err

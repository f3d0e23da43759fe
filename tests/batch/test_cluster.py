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
from carpus.app.batch.tracking_task import TrackingOutcome, TrackingTask
from carpus.app.batch.worker_pool import run_tasks_on_scheduler
from carpus.app.commands.track_many import OUTCOMES_FILE
from carpus.app.sources import CLICKS_FILE, plan_inputs
from carpus.core.model.errors import SchedulerUnreachable
from carpus.core.pipeline.track import TrackSettings
from carpus.core.session.reader import read_session
from tests.rendered import FLEXION, Rendered

ROOT = Path(__file__).parents[2]
COUNT = 3
LOCAL = """
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
        print(cluster.scheduler_address, flush=True)
        __import__('sys').stdin.read()
"""


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A scheduler and two workers, each a daemon with its nanny."""
    begun = subprocess.Popen([sys.executable, "-c", LOCAL], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    yield begun.stdout.readline().strip()
    begun.communicate("", 60)


@pytest.fixture(scope="module")
def recordings(rendered: Rendered, tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("recordings")
    for number in range(COUNT):
        shutil.copytree(rendered(FLEXION), root / f"r{number}")
    return root


def told(folder: Path) -> dict[str, str]:
    with (folder / OUTCOMES_FILE).open(newline="", encoding="utf-8") as file:
        return {row["session"]: row["outcome"] for row in csv.DictReader(file)}


@pytest.mark.thorough
def test_worker_that_is_killed_costs_nothing(address: str, recordings: Path, tmp_path: Path) -> None:
    out = tmp_path / "far"
    found_there = plan_inputs([recordings], out)
    broken = replace(found_there[0], clicks=recordings / "none.json", session=out / "none.h5", name="none.h5")
    tasks = [TrackingTask(place, TrackSettings(smooth=False)) for place in (*found_there, broken)]
    with Client(address, set_as_default=False) as client:
        processes = client.run(os.getpid)
    coming = run_tasks_on_scheduler(address, tasks)
    found: list[TrackingOutcome] = [next(coming)]
    os.kill(next(iter(processes.values())), signal.SIGKILL)
    found += coming
    (fault,) = (each for each in found if each.tracking_input == broken)
    assert (fault.result, "none.json" in fault.messages[0]) == ("fault", True)
    found.remove(fault)
    assert sorted(each.tracking_input.name for each in found) == [f"r{number}.h5" for number in range(COUNT)]
    assert {each.result for each in found} <= {"tracked", "kept"}, [each.messages for each in found]
    assert {path.suffix for path in out.iterdir()} == {".h5"}, "nothing half-done is left"

    # The same by the command, which finds all done; and the same numbers as here.
    assert main(["track", str(recordings), "--no-smooth", "--output", str(out), "--scheduler", address]) == 0
    assert set(told(out).values()) == {"kept"}
    near, clicks = tmp_path / "near.h5", recordings / "r0" / CLICKS_FILE
    words = ["track", str(recordings / "r0"), "--calibration", str(clicks), "--no-smooth", "--output", str(near)]
    assert main(words) == 0
    here = read_session(near).motion
    for number in range(COUNT):
        far = read_session(out / f"r{number}.h5").motion
        assert np.array_equal(far.angles_rad, here.angles_rad, equal_nan=True)
        assert np.array_equal(far.angles_sd_rad, here.angles_sd_rad, equal_nan=True)


def test_workers_elsewhere_track_what_the_command_asks(address: str, rendered: Rendered, tmp_path: Path) -> None:
    """The short form of the others: one recording, nobody killed, the numbers of this computer."""
    recording, near, table = rendered(FLEXION), tmp_path / "near.h5", tmp_path / "all.parquet"
    shutil.copytree(recording, tmp_path / "in" / "r")
    words = ["track", str(tmp_path / "in"), "--no-smooth", "--output", str(tmp_path / "out"), "--table", str(table)]
    assert main([*words, "--scheduler", address]) == 0
    assert told(tmp_path / "out") == {"r.h5": "tracked"}
    assert set(parquet.read_table(table).column("session").to_pylist()) == {"r.h5"}
    words = ["track", str(recording), "--calibration", str(recording / CLICKS_FILE), "--no-smooth", "--output"]
    assert main([*words, str(near)]) == 0
    far, here = (read_session(path).motion for path in (tmp_path / "out" / "r.h5", near))
    assert np.array_equal(far.angles_rad, here.angles_rad, equal_nan=True)


@pytest.mark.thorough
def test_client_that_is_killed_begins_again(address: str, recordings: Path, tmp_path: Path) -> None:
    out, table = tmp_path / "out", tmp_path / "all.parquet"
    words = ["track", str(recordings), "--no-smooth", "--output", str(out), "--table", str(table)]
    words += ["--scheduler", address]
    client = subprocess.Popen([sys.executable, "-m", "carpus", *words], stderr=subprocess.DEVNULL)
    until = time.monotonic() + 120.0
    while not list(out.glob(".*.tmp")) and time.monotonic() < until:
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


def test_scheduler_that_is_not_there_is_reported(
    recordings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("carpus.app.batch.worker_pool.CONNECT_TIMEOUT_S", 1.0)
    with pytest.raises(SchedulerUnreachable):
        list(run_tasks_on_scheduler("tcp://127.0.0.1:9", []))
    words = ["track", str(recordings), "--output", str(tmp_path / "out"), "--scheduler", "nonsense://"]
    assert main(words) == 1
    assert "nonsense" in capsys.readouterr().err


def test_missing_extra_names_package_to_install(
    recordings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["track", str(recordings), "--output", str(tmp_path / "out"), "--scheduler", "tcp://x:1"]) == 1
    assert "-m pip install distributed" in capsys.readouterr().err

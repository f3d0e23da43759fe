"""Processes of a batch that die, and one that is told to stop."""

from __future__ import annotations

import multiprocessing
import time
from pathlib import Path

import pytest

from carpus.app.batch.places import Place
from carpus.app.batch.processes import DIED, cores, outcomes
from carpus.app.batch.work import Task
from carpus.core.pipeline.track import TrackSettings
from tests.batch.deadly import deadly


def task(folder: Path, name: str, kind: str = "") -> Task:
    return Task(Place(folder / name, None, folder / f"{name}.h5", f"{name}.h5"), TrackSettings(), kind)


def test_only_what_kills_its_process_is_a_fault(tmp_path: Path) -> None:
    kinds = ["", "dies", "", "once", "", ""]
    tasks = [task(tmp_path, f"r{i}", kind) for i, kind in enumerate(kinds)]
    found = {outcome.place.name: outcome for outcome in outcomes(tasks, 2, deadly)}
    assert len(found) == len(tasks)
    assert [found[f"r{i}.h5"].result for i in range(len(kinds))] == [
        "fault" if kind == "dies" else "tracked" for kind in kinds
    ]
    assert found["r1.h5"].said == (DIED,)


def test_who_stops_looking_leaves_no_process_behind(tmp_path: Path) -> None:
    others = set(multiprocessing.active_children())  # such as the one that reads files for the tests before
    tasks = [task(tmp_path, "quick"), *(task(tmp_path, f"r{i}", "waits") for i in range(3))]
    coming = outcomes(tasks, 2, deadly)
    assert next(coming).place.name == "quick.h5"
    until = time.monotonic() + 60.0
    while not list(tmp_path.glob("r*.h5")) and time.monotonic() < until:
        time.sleep(0.02)
    begin = time.monotonic()
    coming.close()  # type: ignore[attr-defined]
    assert time.monotonic() - begin < 20.0
    assert not list(tmp_path.glob("r*.h5")), "what was under way was tidied"
    assert set(multiprocessing.active_children()) <= others


def test_there_is_a_core() -> None:
    assert cores() >= 1
    assert list(outcomes([], 2)) == []


@pytest.mark.parametrize("count", [1, 5])
def test_any_number_of_processes(count: int, tmp_path: Path) -> None:
    tasks = [task(tmp_path, f"r{i}") for i in range(3)]
    assert {outcome.place.name for outcome in outcomes(tasks, count, deadly)} == {t.place.name for t in tasks}

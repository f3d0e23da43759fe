"""Processes of a batch that die, and one that is told to stop."""

from __future__ import annotations

import multiprocessing
import threading
import time
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from carpus.app.batch import processes, work
from carpus.app.batch.processes import DIED, cores, outcomes
from carpus.app.batch.work import Task
from carpus.app.sources import TrackingInput
from carpus.core.errors import OutputBusy, OutputExists
from carpus.core.pipeline.track import TrackSettings
from carpus.core.session.disk import part_path
from carpus.core.session.recovery import Heartbeat
from tests.batch.deadly import deadly
from tests.records.samples import record


def task(folder: Path, name: str, kind: str = "") -> Task:
    return Task(TrackingInput(folder / name, None, folder / f"{name}.h5", f"{name}.h5"), TrackSettings(), kind)


def test_only_what_kills_its_process_is_a_fault(tmp_path: Path) -> None:
    kinds = ["", "dies", "once", ""]
    tasks = [task(tmp_path, f"r{i}", kind) for i, kind in enumerate(kinds)]
    found = {outcome.place.name: outcome for outcome in outcomes(tasks, 2, deadly)}
    assert len(found) == len(tasks)
    assert [found[f"r{i}.h5"].result for i in range(len(kinds))] == [
        "fault" if kind == "dies" else "tracked" for kind in kinds
    ]
    assert found["r1.h5"].said == (DIED,)


def test_what_hangs_is_given_up_and_tidied(tmp_path: Path) -> None:
    (outcome,) = outcomes([task(tmp_path, "r0", "hangs")], 2, deadly, limit_s=6.0)
    assert "0.1 minutes" in outcome.said[0]
    assert not list(tmp_path.iterdir()), "half session and heartbeat are gone"


def test_what_somebody_is_still_writing_is_the_fault_of_its_recording(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def busy(session: Path) -> None:
        raise OutputBusy(session)

    monkeypatch.setattr(processes, "clear_leftovers", busy)
    monkeypatch.setattr(processes._Child, "ask", lambda *_: None)
    children = processes.Children()
    outcome = children.outcome(task(tmp_path, "r0"), 60.0, deadly)
    children.end()
    assert (outcome.result, outcome.may_pass) == ("fault", True)
    assert "r0.h5" in outcome.said[0]


def test_only_what_may_pass_is_tried_again(tmp_path: Path) -> None:
    tasks = [task(tmp_path, "r0", "stutters"), task(tmp_path, "r1", "refuses")]
    found = {outcome.place.name: outcome.result for outcome in outcomes(tasks, 2, deadly)}
    assert found == {"r0.h5": "tracked", "r1.h5": "fault"}
    assert [(tmp_path / f"r{k}.tries").read_text() for k in (0, 1)] == ["xx", "x"]


def test_what_another_run_is_writing_is_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "BUSY_STEP_S", 0.01)
    session = tmp_path / "r0.h5"
    part = part_path(session, "0123abcd")
    part.write_bytes(b"half")
    heart = Heartbeat(part)  # of this process, which lives
    other = part_path(tmp_path / "r01.h5", "0123abcd")
    other.write_bytes(b"half")
    monkeypatch.setattr(work, "BUSY_S", 0.1)
    with pytest.raises(OutputBusy):
        work.clear_leftovers(session)
    assert part.exists()
    monkeypatch.setattr(work, "BUSY_S", 60.0)
    threading.Timer(0.3, heart.end).start()
    work.clear_leftovers(session)
    assert [path.name for path in tmp_path.iterdir()] == [other.name], "only its own"
    heart.path.write_text("{}")  # a heartbeat alone, of a process that was killed as it ended
    work.clear_leftovers(session)
    assert [path.name for path in tmp_path.iterdir()] == [other.name]


def test_what_another_run_finished_meanwhile_was_done_before(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def slower(_: Path, output: Path, *__: object, **___: object) -> None:
        record(output, "", datetime(2026, 11, 1, tzinfo=UTC))
        raise OutputExists(output)

    monkeypatch.setattr(work, "retrack_session", slower)
    outcome = work.work(task(tmp_path, "r0"))
    assert (outcome.result, outcome.frames > 0) == ("kept", True)


def test_a_worker_with_another_version_tracks_nothing(tmp_path: Path) -> None:
    outcome = work.work(replace(task(tmp_path, "r0"), software_version="0.0.1"))
    assert outcome.result == "fault"
    assert "0.0.1" in outcome.said[0]


def test_who_stops_looking_leaves_no_process_behind(tmp_path: Path) -> None:
    tasks = [task(tmp_path, "quick"), *(task(tmp_path, f"r{i}", "waits") for i in range(3))]
    coming = outcomes(tasks, 2, deadly)
    assert next(coming).place.name == "quick.h5"
    until = time.monotonic() + 60.0
    while not list(tmp_path.glob("r*.h5")) and time.monotonic() < until:
        time.sleep(0.02)
    coming.close()  # type: ignore[attr-defined]
    assert not list(tmp_path.glob("r*.h5")), "what was under way was tidied"
    assert "carpus-batch" not in {child.name for child in multiprocessing.active_children()}


def test_there_is_a_core() -> None:
    assert cores() >= 1
    assert list(outcomes([], 2)) == []


def test_more_processes_than_tasks(tmp_path: Path) -> None:
    tasks = [task(tmp_path, f"r{i}") for i in range(2)]
    assert {outcome.place.name for outcome in outcomes(tasks, 5, deadly)} == {t.place.name for t in tasks}

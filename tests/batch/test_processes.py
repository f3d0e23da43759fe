"""Processes of a batch that die, and one that is told to stop."""

from __future__ import annotations

import multiprocessing
import time
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from carpus.app.batch import tracking_task
from carpus.app.batch.tracking_task import TrackingTask
from carpus.app.batch.worker_pool import DIED_TEXT, run_tasks
from carpus.app.sources import TrackingInput
from carpus.core.model.errors import OutputExists
from carpus.core.pipeline.track import TrackSettings
from tests.batch.deadly import deadly
from tests.records.samples import record


def task(folder: Path, name: str, kind: str = "") -> TrackingTask:
    return TrackingTask(TrackingInput(folder / name, None, folder / f"{name}.h5", f"{name}.h5"), TrackSettings(), kind)


def test_worker_death_is_only_fault_of_task(tmp_path: Path) -> None:
    kinds = ["", "dies", "once", ""]
    tasks = [task(tmp_path, f"r{i}", kind) for i, kind in enumerate(kinds)]
    found = {outcome.tracking_input.name: outcome for outcome in run_tasks(tasks, 2, deadly)}
    assert len(found) == len(tasks)
    assert [found[f"r{i}.h5"].result for i in range(len(kinds))] == [
        "fault" if kind == "dies" else "tracked" for kind in kinds
    ]
    assert found["r1.h5"].messages == (DIED_TEXT,)


def test_hanging_task_is_abandoned(tmp_path: Path) -> None:
    (outcome,) = run_tasks([task(tmp_path, "r0", "hangs")], 2, deadly, limit_s=6.0)
    assert "0.1 minutes" in outcome.messages[0]
    assert not list(tmp_path.iterdir()), "half a session is gone"


def test_transient_failure_alone_is_retried(tmp_path: Path) -> None:
    tasks = [task(tmp_path, "r0", "stutters"), task(tmp_path, "r1", "refuses")]
    found = {outcome.tracking_input.name: outcome.result for outcome in run_tasks(tasks, 2, deadly)}
    assert found == {"r0.h5": "tracked", "r1.h5": "fault"}
    assert [(tmp_path / f"r{k}.tries").read_text() for k in (0, 1)] == ["xx", "x"]


def test_task_finished_by_other_run_is_skipped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def slower(_: Path, output: Path, *__: object, **___: object) -> None:
        record(output, "", datetime(2026, 11, 1, tzinfo=UTC))
        raise OutputExists(output)

    monkeypatch.setattr(tracking_task, "retrack_session", slower)
    outcome = tracking_task.execute_task(task(tmp_path, "r0"))
    assert (outcome.result, outcome.frames > 0) == ("kept", True)


def test_worker_with_another_version_tracks_nothing(tmp_path: Path) -> None:
    outcome = tracking_task.execute_task(replace(task(tmp_path, "r0"), software_version="0.0.1"))
    assert outcome.result == "fault"
    assert "0.0.1" in outcome.messages[0]


def test_abandoned_iteration_leaves_no_process(tmp_path: Path) -> None:
    tasks = [task(tmp_path, "quick"), *(task(tmp_path, f"r{i}", "waits") for i in range(3))]
    coming = run_tasks(tasks, 2, deadly)
    assert next(coming).tracking_input.name == "quick.h5"
    until = time.monotonic() + 60.0
    while not list(tmp_path.glob("r*.h5")) and time.monotonic() < until:
        time.sleep(0.02)
    coming.close()  # type: ignore[attr-defined]
    assert not list(tmp_path.glob("r*.h5")), "what was under way was tidied"
    assert "carpus-batch" not in {child.name for child in multiprocessing.active_children()}

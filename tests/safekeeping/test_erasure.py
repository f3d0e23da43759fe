"""Erased is erased: files, rows, journals, old lists, what was made elsewhere; and nothing of anybody else."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from datetime import date, timedelta
from pathlib import Path

import pytest

from carpus.core.errors import ErasureUnfinished, OutputNotWritable
from carpus.core.safekeeping import erasure
from carpus.core.safekeeping.audit import AUDIT_FILE, AuditLog, read_audit
from carpus.core.safekeeping.retention import due, kept_until
from carpus.core.session import out_of_sight
from carpus.core.session.register import PatientRegister
from tests.safekeeping.samples import HERON, LINDEN, T0, measure, traces


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "data"


@pytest.fixture
def register(folder: Path) -> Iterator[PatientRegister]:
    with PatientRegister(folder) as opened:
        yield opened


def deeds(folder: Path) -> list[str]:
    return [entry.did for entry in read_audit(folder).entries]


def test_a_session_goes_with_its_files_and_rows_and_the_others_stay(folder: Path, register: PatientRegister) -> None:
    linden = register.add(LINDEN)
    first, second = measure(register, linden, T0), measure(register, linden, T0 + timedelta(days=7))
    kept = set(register.session(second).path.parent.glob(register.session(second).path.stem + ".*"))
    plan = erasure.plan_session(register, first)
    assert (plan.sessions, len(plan.files), plan.others) == (1, 4, 1)
    assert plan.size_bytes == sum(path.stat().st_size for path in plan.files)
    erased = erasure.erase(register, plan, AuditLog(folder, "window", lambda: "AB"))
    assert (erased.files, erased.made) == (4, 0)
    assert [entry.session_id for entry in register.sessions(linden)] == [second]
    assert set((folder / "sessions" / "Linden-42").iterdir()) == kept
    assert deeds(folder) == ["erase_begun", "erased"]
    assert traces(folder, first[:8]) == [AUDIT_FILE], "the log keeps that it was erased, by its number"
    assert register.rebuild_from_sessions().sessions == 1


def test_earlier_results_and_copies_of_a_recording_go_too(folder: Path, register: PatientRegister) -> None:
    linden = register.add(LINDEN)
    first = measure(register, linden, T0)
    recording = register.session(first).recording_id
    measure(register, linden, T0 + timedelta(hours=1), recording)
    copy = folder / "sessions" / "a copy.h5"
    shutil.copy(register.session(first).path, copy)
    register.rebuild_from_sessions()
    plan = erasure.plan_session(register, first)
    assert plan.sessions == 1
    assert copy in plan.files
    erasure.erase(register, plan, AuditLog(folder, "window"))
    assert register.sessions(linden) == []
    register.rebuild_from_sessions()
    assert register.sessions(linden) == []


def test_of_an_erased_patient_there_is_no_trace_in_the_folder(folder: Path) -> None:
    with PatientRegister(folder) as register:
        linden, heron = register.add(LINDEN), register.add(HERON)
        for day in range(3):
            measure(register, linden, T0 + timedelta(days=day))
        measure(register, heron, T0)
        for name in ("patients.version1.sqlite3", "patients.damaged-20261009-120000.sqlite3"):
            with (
                closing(sqlite3.connect(folder / name)) as old,
                closing(sqlite3.connect(folder / "patients.sqlite3")) as now,
            ):
                now.backup(old)
        (folder / "patients.damaged-2.sqlite3").write_bytes(b"no list, but Linden 42 is in it")
        (folder / "sessions" / "Linden-42" / "left over.part").write_bytes(b"x")
        before = traces(folder, "Linden", "Erika Mustermann", "flexor tendon")
        assert {"patients.version1.sqlite3", "patients.damaged-20261009-120000.sqlite3"} <= set(before)
        plan = erasure.plan_patient(register, linden)
        assert (plan.sessions, len(plan.files)) == (3, 13)
        erasure.erase(register, plan, AuditLog(folder, "command"))
        assert [record.entry for record in register.patients()] == [HERON]
        assert register.patients()[0].session_count == 1
        assert traces(folder, "Linden", "Erika Mustermann", "flexor tendon") == []
        assert not (folder / "sessions" / "Linden-42").exists()
    assert traces(folder, "Linden", "Erika Mustermann", "flexor tendon") == []
    with closing(sqlite3.connect(folder / "patients.version1.sqlite3")) as old:
        assert old.execute("SELECT pseudonym FROM patient").fetchall() == [("Heron 17",)]
    with PatientRegister(folder) as register:
        assert [record.entry for record in register.patients()] == [HERON]


def test_a_session_moved_to_another_patient_stays_with_that_one(folder: Path, register: PatientRegister) -> None:
    linden, heron = register.add(LINDEN), register.add(HERON)
    moved, own = measure(register, linden, T0), measure(register, linden, T0 + timedelta(days=1))
    register.move_session(moved, heron)
    erasure.erase(register, erasure.plan_patient(register, linden), AuditLog(folder, "window"))
    assert register.session(moved).path.exists()
    assert register.session(moved).path.with_suffix(".carpusraw").exists()
    with pytest.raises(KeyError):
        register.session(own)


def test_files_made_elsewhere_go_unless_they_were_changed(
    tmp_path: Path, folder: Path, register: PatientRegister
) -> None:
    linden, heron = register.add(LINDEN), register.add(HERON)
    mine, theirs = measure(register, linden, T0), measure(register, heron, T0)
    out = tmp_path / "papers"
    out.mkdir()
    paths = {name: out / name for name in ("report.pdf", "table.csv", "edited.csv", "gone.csv", "theirs.pdf")}
    for name, path in paths.items():
        path.write_text(name)
    register.remember_made([paths["report.pdf"]], "report", [mine])
    register.remember_made([paths["table.csv"], paths["edited.csv"], paths["gone.csv"]], "export", [mine])
    register.remember_made([paths["theirs.pdf"]], "report", [theirs])
    paths["edited.csv"].write_text("with the therapist's own notes")
    paths["gone.csv"].unlink()
    plan = erasure.plan_session(register, mine)
    assert {one.path.name: one.state for one in plan.made} == {
        "report.pdf": "as_made", "table.csv": "as_made", "edited.csv": "changed", "gone.csv": "not_found",
    }  # fmt: skip
    assert erasure.erase(register, plan, AuditLog(folder, "window")).made == 2
    assert sorted(path.name for path in out.iterdir()) == ["edited.csv", "theirs.pdf"]
    assert erasure.plan_session(register, theirs).made_going[0].path == paths["theirs.pdf"]
    assert traces(folder, "edited.csv", "gone.csv") == []


def test_an_erasure_that_is_cut_short_ends_at_the_next_start(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with PatientRegister(folder) as register:
        linden = register.add(LINDEN)
        session = measure(register, linden, T0)
        plan = erasure.plan_session(register, session)

        def cut(*_: object) -> None:
            raise KeyboardInterrupt

        with monkeypatch.context() as broken:
            broken.setattr(out_of_sight, "go_on_erasing", cut)
            with pytest.raises(KeyboardInterrupt):
                erasure.erase(register, plan, AuditLog(folder, "window"))
        assert plan.files[0].exists()
        assert register.rebuild_from_sessions().sessions == 0, "what is to go does not come back"
    with PatientRegister(folder) as register:
        assert register.erased_late == len(plan.files)
        assert not any(path.exists() for path in plan.files)
        assert register.sessions(linden) == []


def test_what_cannot_be_deleted_is_told_and_tried_again(
    folder: Path, register: PatientRegister, monkeypatch: pytest.MonkeyPatch
) -> None:
    linden = register.add(LINDEN)
    plan = erasure.plan_session(register, measure(register, linden, T0))
    held, real = plan.files[0], Path.unlink

    def unlink(path: Path, missing_ok: bool = False) -> None:
        if path == held:
            raise PermissionError(13, "Permission denied", str(path))
        real(path, missing_ok=missing_ok)

    with monkeypatch.context() as locked:
        locked.setattr(Path, "unlink", unlink)
        with pytest.raises(ErasureUnfinished) as told:
            erasure.erase(register, plan, AuditLog(folder, "window"))
    assert (told.value.subject, told.value.detail) == (held.name, "1")
    assert [path for path in plan.files if path.exists()] == [held]
    assert "erased" not in deeds(folder)
    assert register.sessions(linden) == []
    register.close()
    with PatientRegister(folder) as again:
        assert again.erased_late == 1
    assert not held.exists()


def test_what_cannot_be_logged_is_not_begun(folder: Path, register: PatientRegister) -> None:
    linden = register.add(LINDEN)
    session = measure(register, linden, T0)
    (folder / AUDIT_FILE).mkdir()
    plan = erasure.plan_session(register, session)
    with pytest.raises(OutputNotWritable):
        erasure.erase(register, plan, AuditLog(folder, "window"))
    assert all(path.exists() for path in plan.files)
    assert len(register.sessions(linden)) == 1


def test_the_archive_takes_out_of_lists_and_counts_and_gives_back(register: PatientRegister) -> None:
    linden, heron = register.add(LINDEN), register.add(HERON)
    first, second = measure(register, linden, T0), measure(register, linden, T0 + timedelta(days=1))
    recording = register.session(second).recording_id
    register.archive(recording, T0)
    assert [entry.session_id for entry in register.sessions(linden)] == [first]
    assert register.patient(linden).session_count == 1
    register.archive(linden, T0)
    assert [record.patient_id for record in register.patients()] == [heron]
    assert register.patient(linden).entry == LINDEN
    assert set(register.archived()) == {recording, linden}
    register.rebuild_from_sessions()
    assert [record.patient_id for record in register.patients()] == [heron]
    register.bring_back(linden)
    register.bring_back(recording)
    assert register.patient(linden).session_count == 2
    assert len(register.patients()) == 2


def test_what_is_due_is_decided_by_the_last_session(register: PatientRegister) -> None:
    linden, heron = register.add(LINDEN), register.add(HERON)
    for years in (12, 11):
        measure(register, linden, T0 - timedelta(days=366 * years))
    measure(register, heron, T0 - timedelta(days=366 * 12))
    measure(register, heron, T0)
    found = due(register, 10, date(2026, 11, 20))
    assert [(one.pseudonym, one.sessions, one.archived) for one in found] == [("Linden 42", 2, False)]
    assert found[0].until == kept_until(T0 - timedelta(days=366 * 11), 10)
    register.archive(linden)
    assert [one.archived for one in due(register, 10, date(2026, 11, 20))] == [True]
    assert due(register, 0, date(2026, 11, 20)) == []
    last_day = found[0].until
    assert due(register, 10, last_day) == []
    assert len(due(register, 10, last_day + timedelta(days=1))) == 1

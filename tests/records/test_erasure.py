"""Erased is erased: files, rows, journals, what was set aside; and nothing of anybody else, nothing outside."""

from __future__ import annotations

import contextlib
import json
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import h5py
import pytest
from sqlalchemy import select, update

from carpus.core.model.errors import (
    ConcurrentChange,
    ErasureBlockedByLink,
    ErasureUnfinished,
    FolderMissing,
    OutputNotWritable,
    SessionChanged,
    SessionUnreadable,
)
from carpus.core.records import clinic_records, database, erasure, session_records
from carpus.core.records.backup import create_backup
from carpus.core.records.changes import insert_row
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.log import read_log
from carpus.core.records.retention import find_due_patients, retention_end
from carpus.core.records.schema import PATIENT, SESSION
from carpus.core.records.values import Patient
from carpus.core.session.reader import read_outline, read_session, verify
from tests.records.samples import (
    HERON,
    LINDEN,
    NAMES,
    T0,
    House,
    fill,
    measure,
    open_store,
    record,
    strip_stored_fields,
    traces,
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "data"


@pytest.fixture
def house(folder: Path) -> Iterator[House]:
    with open_store(folder) as found:
        yield found


def deeds(house: House) -> list[str]:
    return [entry.action for entry in read_log(house.store)]


def erase_patient(house: House, patient_id: str) -> int:
    return erasure.erase(house.store, erasure.plan_patient(house.store, patient_id), house.log)


def test_erase_already_erased_elsewhere_succeeds(house: House) -> None:
    linden = house.patients.add(LINDEN)
    session = measure(house, linden, T0)
    plans = [erasure.plan_patient(house.store, linden), erasure.plan_session(house.store, session)]
    erase_patient(house, linden)
    for plan in plans:
        erasure.erase(house.store, plan, house.log)
    linden = house.patients.add(LINDEN)
    session = measure(house, linden, T0)
    plan = erasure.plan_patient(house.store, linden)
    erasure.erase(house.store, erasure.plan_session(house.store, session), house.log)
    with pytest.raises(ConcurrentChange):  # the patient is still there
        erasure.erase(house.store, plan, house.log)


def test_erase_session_deletes_all_results_and_copies(folder: Path, house: House) -> None:
    linden = house.patients.add(LINDEN)
    first = measure(house, linden, T0)
    measure(house, linden, T0 + timedelta(hours=1), house.index.patient_sessions(linden)[0].recording_id)
    copies = [folder / "sessions" / name for name in ("known.h5", "not scanned yet.h5")]
    for copy in copies:
        shutil.copy(house.index.get(first).path, copy)
        if copy is copies[0]:
            house.files.scan()
    plan = erasure.plan_session(house.store, first)
    assert plan.recording_count == 1
    assert set(copies) < set(plan.files)
    erasure.erase(house.store, plan, house.log)
    assert house.files.scan().session_count == 0
    assert house.index.patient_sessions(linden) == []


def test_erase_patient_leaves_no_trace_in_folder(folder: Path) -> None:
    with open_store(folder) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        sessions = fill(house, linden)
        fill(house, heron)
        (folder / "sessions" / linden / "left over.part").write_bytes(b"x")
        plan = erasure.plan_patient(house.store, linden)
        assert (plan.recording_count, len(plan.files)) == (3, 10)
        erasure.erase(house.store, plan, house.log)
        words = (*NAMES, LINDEN.diagnosis, LINDEN.diagnosis.casefold(), linden, *sessions)
        assert traces(folder, *words) == [], "while it is open: also free pages and journals"
        assert house.names() == ["Heron 17"]
        (other,) = house.patients.search()
        assert (strip_stored_fields(other), other.session_count) == (HERON, 3)
        kept = [
            session_records.read_comments(house.store, one.session_id) for one in house.index.patient_sessions(heron)
        ]
        assert kept == [[f"{HERON.pseudonym} is well"]] * 3
        assert clinic_records.read_last_place(folder, "He") == f"/papers/{HERON.name}"
        assert clinic_records.read_recipients(house.store) == [f"{HERON.name}\nOak Street 1"]
        assert house.patients.diagnoses() == [f"as {HERON.name}"], "what names nobody stays"
    assert traces(folder, *NAMES, linden, *sessions) == []


def test_erase_patient_keeps_sessions_moved_to_another(folder: Path, house: House) -> None:
    linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
    moved, own = measure(house, linden, T0), measure(house, linden, T0 + timedelta(days=1))
    former = house.index.get(moved)
    house.index.move_to_patient(moved, heron)
    assert not [*former.path.parent.glob(f"{former.path.stem}*")]
    header, now = read_outline(house.index.get(moved).path).header, house.index.get(moved)
    assert (header.session_id, header.subject_id, now.path.parent.name) == (moved, "Heron 17", heron)
    assert verify(now.path).has_checksum
    row = house.store.row(select(SESSION).where(SESSION.c.id == moved))
    assert row.size == now.path.stat().st_size
    assert replace(now, path=former.path) == former
    angles, others = (read_session(house.index.get(one).path).motion.angles_rad for one in (moved, own))
    assert (angles == others).all()
    now.path.with_suffix(".carpusraw").write_bytes(b"pictures of nobody")
    erase_patient(house, linden)
    assert traces(folder, "Linden", "Erika Mustermann", linden) == []
    assert house.index.get(moved).path.exists()
    assert house.index.get(moved).path.with_suffix(".carpusraw").exists()
    with pytest.raises(SessionUnreadable):
        house.index.get(own)


def test_plan_names_output_files_and_erase_keeps_them(tmp_path: Path, folder: Path, house: House) -> None:
    mine = measure(house, house.patients.add(LINDEN), T0)
    out = tmp_path / "papers"
    out.mkdir()
    paths = {name: out / name for name in ("report.pdf", "edited.csv", "gone.csv")}
    for name, path in paths.items():
        path.write_text(name)
    session_records.record_output_files(house.store, paths.values(), "export", [mine])
    paths["edited.csv"].write_text("with the therapist's own notes")
    paths["gone.csv"].unlink()
    plan = erasure.plan_session(house.store, mine)
    assert [path.name for path in plan.output_files] == ["edited.csv", "report.pdf"]
    erasure.erase(house.store, plan, house.log)
    assert sorted(path.name for path in out.iterdir()) == ["edited.csv", "report.pdf"]
    assert traces(folder, "edited.csv", "gone.csv") == []


def test_erase_follows_no_path_out_of_the_folder(tmp_path: Path, folder: Path, house: House) -> None:
    mine = tmp_path / "mine"
    record(mine / "a.h5", "Linden 42", T0)
    (mine / "b.h5").write_text("a letter")
    linden = house.patients.add(LINDEN)
    ids = [measure(house, linden, T0 + timedelta(days=day)) for day in range(3)]
    (folder / "sessions" / "link").symlink_to(mine)
    shutil.rmtree(folder / "sessions" / linden)
    for session_id, path in zip(ids, (str(mine / "b.h5"), "../../mine/b.h5", "link/b.h5"), strict=True):
        house.store.execute_local(update(SESSION).where(SESSION.c.id == session_id).values(path=path))
    with pytest.raises(ErasureBlockedByLink, match="link"):
        erase_patient(house, linden)
    house.store.execute_local(update(SESSION).where(SESSION.c.id == ids[2]).values(path=str(mine / "c.h5")))
    (folder / "sessions" / linden).symlink_to(mine)
    with pytest.raises(ErasureBlockedByLink, match=linden):
        erase_patient(house, linden)
    assert len(house.index.patient_sessions(linden)) == 3, "nothing was begun"
    house.store.execute_local(
        update(SESSION).values(erasing=1), update(PATIENT).where(PATIENT.c.id == linden).values(erasing=1)
    )
    erasure.resume_erasures(house.store, house.log)
    assert len(house.store.rows(select(SESSION))) == 3, "a link that came after the mark is waited for"
    (folder / "sessions" / linden).unlink()
    erasure.resume_erasures(house.store, house.log)
    assert sorted(path.name for path in mine.iterdir()) == ["a.h5", "b.h5"]
    assert house.store.rows(select(SESSION)) == []


def test_erase_while_share_is_away_deletes_nothing(
    tmp_path: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    share = tmp_path / "share"
    share.mkdir()
    with open_store(folder, sessions=share) as house:
        linden = house.patients.add(LINDEN)
        path = house.index.get(measure(house, linden, T0)).path
        share.rename(tmp_path / "away")
        with pytest.raises(FolderMissing):
            erasure.plan_patient(house.store, linden)
        house.store.execute_local(update(PATIENT).where(PATIENT.c.id == linden).values(erasing=1))
    with open_store(folder, sessions=share) as house:
        erasure.resume_erasures(house.store, house.log)
        share.mkdir()  # where it is mounted
        erasure.resume_erasures(house.store, house.log)
        share.rmdir()
        (tmp_path / "away").rename(share)
        assert path.exists()
        files_of = erasure._files_to_delete
        with monkeypatch.context() as meanwhile:
            meanwhile.setattr(
                erasure, "_files_to_delete", lambda *of: share.rename(tmp_path / "away") and files_of(*of)
            )
            erasure.resume_erasures(house.store, house.log)
        (tmp_path / "away").rename(share)
        assert path.exists()
        assert house.store.rows(select(SESSION)), "it went away while it was looked through"
        with monkeypatch.context() as killed:
            killed.setattr(erasure, "_clinic_rows_naming", lambda *_: 1 / 0)  # once the files are gone
            with pytest.raises(ZeroDivisionError):
                erasure.resume_erasures(house.store, house.log)
        erasure.resume_erasures(house.store, house.log)
        assert house.store.rows(select(SESSION)) == [], "it goes on where the share has no other session"
    assert not path.exists()
    assert traces(tmp_path, *NAMES, linden) == []


def test_erase_patient_includes_files_not_scanned_yet(folder: Path, house: House) -> None:
    linden = house.patients.add(LINDEN)
    copy = record(folder / "sessions" / "copied in" / "a.h5", "linden 42", T0 + timedelta(days=1))
    plan = erasure.plan_patient(house.store, linden)
    assert copy in plan.files
    late = record(folder / "sessions" / "late.h5", "Linden 42", T0 + timedelta(days=2))
    erasure.erase(house.store, plan, house.log)
    assert not late.exists(), "also what came while a person read what goes"
    assert house.files.scan().session_count == 0
    assert house.names() == []
    assert traces(folder, *NAMES, linden) == []


def test_plan_patient_lists_unassigned_files_and_erase_keeps_them(folder: Path, house: House) -> None:
    linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
    others = house.index.get(measure(house, heron, T0)).path
    shutil.copy(others, folder / "sessions" / "a copy.h5")
    house.files.scan()
    outside = [folder / "sessions" / "letters" / "a Linden 42.txt", folder / "sessions" / "damaged.h5"]
    outside += [folder.with_name("data.before-restore-20261009-120000"), folder / "records.damaged-1-2.sqlite3"]
    for path in outside:
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(b"whose?")
    others.with_name("also Linden 42.txt").write_bytes(b"in the folder of another")
    plan = erasure.plan_patient(house.store, linden)
    assert (plan.unassigned_files[0], set(plan.unassigned_files)) == (outside[0], set(outside)), (
        "what is named like the patient first"
    )
    erasure.erase(house.store, plan, house.log)
    assert all(path.exists() for path in (*outside, others, others.with_name("also Linden 42.txt")))
    assert erasure.plan_session(house.store, house.index.patient_sessions(heron)[0].session_id).unassigned_files == ()


@pytest.mark.parametrize("after", ["mark", "files"])
def test_erase_interrupted_is_finished_at_next_start(folder: Path, monkeypatch: pytest.MonkeyPatch, after: str) -> None:
    with open_store(folder) as house:
        linden = house.patients.add(LINDEN)
        sessions = fill(house, linden)
        plan = erasure.plan_patient(house.store, linden)

        def cut(*_: object) -> None:
            raise KeyboardInterrupt

        with monkeypatch.context() as broken:
            broken.setattr(erasure, "delete_marked" if after == "mark" else "delete_row", cut)
            with pytest.raises(KeyboardInterrupt):
                erasure.erase(house.store, plan, house.log)
        assert any(path.exists() for path in plan.files) == (after == "mark")
        assert house.names() == []
        assert house.files.scan().session_count == 0, "what is to go does not come back"
    DataFolder(folder).close()
    assert not any(path.exists() for path in plan.files)
    assert traces(folder, *NAMES, linden, *sessions) == []


def test_erase_locked_file_is_reported_and_tried_again(
    folder: Path, house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    linden = house.patients.add(LINDEN)
    plan = erasure.plan_session(house.store, measure(house, linden, T0))
    held, real = plan.files[0], Path.unlink

    def unlink(path: Path, missing_ok: bool = False) -> None:
        if path == held:
            raise PermissionError(13, "Permission denied", str(path))
        real(path, missing_ok=missing_ok)

    with monkeypatch.context() as locked:
        locked.setattr(Path, "unlink", unlink)
        with pytest.raises(ErasureUnfinished) as told:
            erasure.erase(house.store, plan, house.log)
    assert (told.value.subject, told.value.detail) == (held.name, "1")
    assert [path for path in plan.files if path.exists()] == [held]
    assert "erased" not in deeds(house)
    assert house.index.patient_sessions(linden) == []
    erasure.resume_erasures(house.store, house.log)
    assert not held.exists()
    assert deeds(house)[-1] == "erased"


def test_erase_without_log_is_not_started(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    linden = house.patients.add(LINDEN)
    plan = erasure.plan_session(house.store, measure(house, linden, T0))

    def full(*_: object, **__: object) -> None:
        raise OutputNotWritable("log")

    monkeypatch.setattr(type(house.log), "write_entry", full)
    with pytest.raises(OutputNotWritable):
        erasure.erase(house.store, plan, house.log)
    assert all(path.exists() for path in plan.files)
    assert len(house.index.patient_sessions(linden)) == 1


def test_archive_removes_from_lists_and_unarchive_restores(house: House) -> None:
    linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
    first, second = measure(house, linden, T0), measure(house, linden, T0 + timedelta(days=1))
    house.index.archive(second, T0)
    assert [entry.session_id for entry in house.index.patient_sessions(linden)] == [first]
    assert house.patients.get(linden).session_count == 1
    house.patients.archive(linden, T0)
    assert [record.patient_id for record in house.patients.search()] == [heron]
    assert strip_stored_fields(house.patients.get(linden)) == LINDEN
    assert house.patients.archive_times() == {linden: T0}
    assert [entry.session_id for entry, _, _ in house.index.list_archived()] == [second]
    again = measure(house, linden, T0 + timedelta(days=2), house.index.get(second).recording_id)
    assert again not in [one.session_id for one in house.index.patient_sessions(linden)], (
        "tracked again, it stays archived"
    )
    house.files.scan()
    assert house.names() == ["Heron 17"]
    house.patients.unarchive(linden)
    house.index.unarchive(second)
    assert house.patients.get(linden).session_count == 2
    assert house.patients.get(linden).result_count == 3


def test_find_due_patients_uses_last_session(house: House) -> None:
    linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
    for years in (12, 11):
        measure(house, linden, T0 - timedelta(days=366 * years))
    measure(house, heron, T0 - timedelta(days=366 * 12))
    measure(house, heron, T0)
    found = find_due_patients(house.store, 10, date(2026, 11, 20))
    assert [(one.pseudonym, one.sessions, one.is_archived) for one in found] == [("Linden 42", 2, False)]
    assert found[0].keep_until == retention_end(T0 - timedelta(days=366 * 11), 10)
    house.patients.archive(linden)
    assert [one.is_archived for one in find_due_patients(house.store, 10, date(2026, 11, 20))] == [True]
    assert find_due_patients(house.store, 0, date(2026, 11, 20)) == []
    last_day = found[0].keep_until
    assert find_due_patients(house.store, 10, last_day) == []
    assert len(find_due_patients(house.store, 10, last_day + timedelta(days=1))) == 1


WITHOUT_ROOM = """
import json, resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
from carpus.app.__main__ import main
for words in json.loads(sys.argv[1]):
    print(words[0], main(words), file=sys.stderr)
"""


def test_commands_on_full_disk_report_it(tmp_path: Path, folder: Path) -> None:
    """A limit of the system that no file may hold a byte: each write is refused as on a full disk."""
    with open_store(folder) as house:
        linden = house.patients.add(LINDEN)
        session = house.index.get(measure(house, linden, T0)).path
    create_backup(folder, tmp_path / "place")
    commands = (
        ("erase", "Linden 42", "--data-folder", folder, "--for-good", "Linden 42"),
        ("backup", tmp_path / "full", "--data-folder", folder),
        ("restore", tmp_path / "place", "--into", tmp_path / "new"),
        ("export", session, "--output", tmp_path / "export"),
        ("report", session, "--output", tmp_path / "report.pdf"),
    )
    asked = json.dumps([[str(word) for word in words] for words in commands])
    run = [sys.executable, "-c", WITHOUT_ROOM, asked]
    said = subprocess.run(run, capture_output=True, text=True, timeout=300, check=False).stderr.splitlines()
    for name, *_ in commands:
        at = said.index(f"{name} 1")
        assert "no space left" in said[at - 1], name
    assert session.exists()
    assert sorted(path.name for path in tmp_path.iterdir() if path.is_file()) == []
    assert not (tmp_path / "new").exists()


def test_move_to_patient_failing_changes_nothing(folder: Path, house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
    session_id = measure(house, linden, T0)
    files = {path for path in folder.rglob("*") if path.is_file()}
    with monkeypatch.context() as broken:
        broken.setattr(house.store, "apply", lambda _: (_ for _ in ()).throw(OutputNotWritable(folder)))
        with pytest.raises(OutputNotWritable):
            house.index.move_to_patient(session_id, heron)
    assert {path for path in folder.rglob("*") if path.is_file()} == files
    path = house.index.get(session_id).path
    with h5py.File(path, "r+") as file:
        file.attrs["exercise"] = "WRIST_RU"
    with pytest.raises(SessionChanged):
        house.index.move_to_patient(session_id, heron)
    assert house.index.get(session_id).path == path
    path.unlink()
    house.index.move_to_patient(session_id, heron)
    assert house.index.owner_id(session_id) == heron, "a session whose file is away is moved all the same"


def test_erase_patient_with_foreign_id_deletes_nothing_elsewhere(tmp_path: Path, folder: Path, house: House) -> None:
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "letter.txt").write_text("a letter")
    people = [str(mine), "../../mine", "."]
    stays = measure(house, house.patients.add(LINDEN), T0)
    house.store.apply(
        [
            insert_row(PATIENT, one, pseudonym_key=one, pseudonym=f"Oak {number}", erasing=1)
            for number, one in enumerate(people)
        ]
    )
    for one in people:
        with pytest.raises(OutputNotWritable):
            house.index.new_path(one, "Oak", "WRIST_FE", "right", T0)
    erasure.resume_erasures(house.store, house.log)
    assert (mine / "letter.txt").exists()
    assert house.index.get(stays).path.exists()
    assert house.names() == ["Linden 42"]


def test_erase_keeps_addresses_containing_numeric_name(house: House) -> None:
    kept = ("Dr. Linde\nLindenstraße 10\n10115 Berlin", "Dr. Oliver\nElm Street 2")
    house.patients.set_diagnosis_listed("Flexor tendon, zone 2", is_listed=True)
    for pseudonym in ("1", "10", "2", "Linden", "Oliv"):
        for address in (*kept, "Family Li\nAsh Street 3"):
            clinic_records.save_recipient(house.store, address)
        erase_patient(house, house.patients.add(Patient(pseudonym, "right", name="Li")))
        assert set(clinic_records.read_recipients(house.store)) == set(kept), pseudonym
        assert house.patients.diagnoses() == ["Flexor tendon, zone 2"]


def test_erase_session_deletes_files_and_rows_of_it_alone(folder: Path, house: House) -> None:
    linden = house.patients.add(LINDEN)
    first, second = measure(house, linden, T0), measure(house, linden, T0 + timedelta(days=7))
    path = house.index.get(second).path
    alike = record(house.index.get(first).path.with_suffix(".2.h5"), "Linden 42", T0 + timedelta(days=9))
    house.files.scan()
    kept = {alike, *path.parent.glob(path.stem + ".*")}
    plan = erasure.plan_session(house.store, first)
    assert (plan.recording_count, len(plan.files), plan.pseudonym) == (1, 3, "Linden 42")
    assert plan.size_bytes == sum(path.stat().st_size for path in plan.files)
    assert erasure.erase(house.store, plan, house.log) == 3
    assert [entry.path for entry in house.index.patient_sessions(linden)] == [alike, path]
    assert set(path.parent.iterdir()) == kept
    assert deeds(house) == ["erase_begun", "erased"]
    assert traces(folder, first) == []
    assert house.patients.get(linden).session_count == 2
    assert house.files.scan().session_count == 0


def test_erase_with_open_reader_reports_log_as_left(
    folder: Path, house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(database, "LOCK_WAIT_MS", 0)
    linden = house.patients.add(LINDEN)
    with contextlib.closing(sqlite3.connect(folder / database.STORE_FILE)) as reader:
        reader.execute("BEGIN")
        reader.execute("SELECT count(*) FROM patient").fetchall()
        with pytest.raises(ErasureUnfinished, match="wal"):
            erase_patient(house, linden)
        reader.rollback()
    erasure.resume_erasures(house.store, house.log)
    assert traces(folder, *NAMES) == []

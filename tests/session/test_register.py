"""The register of patients: private, searchable, rebuilt from session files, safe to open twice."""

from __future__ import annotations

import contextlib
import random
import sqlite3
import stat
import threading
import uuid
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from carpus.core.errors import OutputNotWritable, PseudonymTaken, RegisterUnreadable, SessionUnreadable
from carpus.core.hand.protocols import WRIST6
from carpus.core.session import register as register_module
from carpus.core.session.pseudonyms import WORDS, suggest_pseudonym
from carpus.core.session.register import (
    MIGRATIONS,
    REGISTER_FILE,
    PatientEntry,
    PatientRegister,
    default_data_folder,
)
from carpus.core.session.values import SessionHeader, new_header
from carpus.core.session.writer import SessionWriter
from tests.session.samples import CAMERA, make_calibration, make_frame

T0 = datetime(2026, 11, 10, 9, 0, tzinfo=UTC)
LINDEN = PatientEntry("Linden 42", "right", "left", "40-49", "flexor tendon", "Erika Mustermann")
HERON = PatientEntry("Heron 17", "left")


def header(subject: str, created: datetime, hand: str = "right") -> SessionHeader:
    return new_header(
        hand="right" if hand == "right" else "left",
        protocol=WRIST6,
        software_version="0.1.0",
        subject_id=subject,
        exercise="WRIST_FE",
        now=created,
        session_id=uuid.uuid4(),
    )


def record(path: Path, subject: str, created: datetime, hand: str = "right", frames: int = 4) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    with SessionWriter.create(path, header(subject, created, hand), CAMERA, make_calibration()) as session:
        for row in range(frames):
            session.append(make_frame(row))
    return path


def measure(register: PatientRegister, patient_id: str, created: datetime) -> Path:
    """One session of a patient, stored and entered as the application does."""
    pseudonym = register.patient(patient_id).entry.pseudonym
    path = register.new_session_path(patient_id, "WRIST_FE", "right", created)
    register.enter_session(record(path, pseudonym, created), patient_id)
    return path


def names(register: PatientRegister, search: str = "") -> list[str]:
    return [record.entry.pseudonym for record in register.patients(search)]


def test_what_is_entered_is_found_again(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        patient_id = register.add(LINDEN)
        path = measure(register, patient_id, T0)
    with PatientRegister(tmp_path) as register:
        (found,) = register.patients()
        assert (found.patient_id, found.entry) == (patient_id, LINDEN)
        assert (found.session_count, found.last_session, found.last_exercise) == (1, T0, "WRIST_FE")
        (session,) = register.sessions(patient_id)
        assert (session.path, session.created, session.hand, session.frames) == (path, T0, "right", 4)
        assert session.duration_s == pytest.approx(0.1)
        assert session.complete
        assert register.session(session.session_id) == session


def test_the_last_session_comes_first(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        never = register.add(PatientEntry("Fir 12", "left"), T0 + timedelta(days=9))
        linden, heron = register.add(LINDEN, T0), register.add(HERON, T0)
        measure(register, linden, T0 + timedelta(days=2))
        measure(register, heron, T0 + timedelta(days=1))
        assert names(register) == ["Linden 42", "Heron 17", "Fir 12"]
        # another zone: ten in the morning in Sydney is before nine in the evening in London
        later = datetime.fromisoformat("2026-11-13T21:00:00+00:00")
        measure(register, linden, datetime.fromisoformat("2026-11-14T07:00:00+11:00"))
        measure(register, heron, later)
        assert names(register) == ["Heron 17", "Linden 42", "Fir 12"]
        assert register.patient(heron).last_session == later
        assert [s.created.day for s in register.sessions(linden)] == [14, 12]
        assert register.sessions(never) == []


@pytest.mark.parametrize(
    ("search", "found"),
    [
        ("", {"Linden 42", "Heron 17"}),
        ("lind", {"Linden 42"}),
        ("42 linden", {"Linden 42"}),
        ("MUSTER", {"Linden 42"}),
        ("tendon", {"Linden 42"}),
        ("17", {"Heron 17"}),
        ("heron 42", set()),
        ("%", set()),
    ],
)
def test_search(tmp_path: Path, search: str, found: set[str]) -> None:
    with PatientRegister(tmp_path) as register:
        register.add(LINDEN)
        register.add(HERON)
        assert set(names(register, search)) == found


def test_a_pseudonym_belongs_to_one_patient(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        linden, heron = register.add(LINDEN), register.add(HERON)
        with pytest.raises(PseudonymTaken):
            register.add(PatientEntry("LINDEN 42", "left"))
        with pytest.raises(PseudonymTaken):
            register.change(heron, PatientEntry("linden 42", "left"))
        register.change(linden, PatientEntry("linden 42", "both", note="changed"))
        assert register.patient(linden).entry.note == "changed"
        assert register.patient(heron).entry == HERON
        with pytest.raises(KeyError):
            register.change("nobody", PatientEntry("Oak 11", "left"))
        with pytest.raises(KeyError):
            register.patient("nobody")
        with pytest.raises(KeyError):
            register.session("nothing")


def test_a_new_name_keeps_the_sessions_through_a_rebuild(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        patient_id = register.add(LINDEN)
        measure(register, patient_id, T0)
        register.change(patient_id, PatientEntry("Oak 11", "right"))
        register.rebuild_from_sessions()
        assert names(register) == ["Oak 11"]
        assert len(register.sessions(patient_id)) == 1


def test_a_lost_register_is_made_again_from_the_session_files(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        linden, heron = register.add(LINDEN), register.add(HERON)
        for day in range(3):
            measure(register, linden, T0 + timedelta(days=day))
        measure(register, heron, T0)
        before = {entry.path for patient in (linden, heron) for entry in register.sessions(patient)}
    for path in tmp_path.glob(f"{REGISTER_FILE}*"):
        path.unlink()
    with PatientRegister(tmp_path) as register:
        assert names(register) == ["Linden 42", "Heron 17"]
        again = {e.path for patient in register.patients() for e in register.sessions(patient.patient_id)}
        assert again == before
        entry = register.patients()[0].entry
        assert (entry.side, entry.name, entry.note) == ("right", "", "")  # names were only in the register


def test_a_rebuild_finds_what_was_copied_in_and_forgets_what_is_gone(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        linden = register.add(LINDEN)
        gone = measure(register, linden, T0)
        gone.unlink()
        record(register.sessions_folder / "from elsewhere" / "a.h5", "linden 42", T0 + timedelta(days=1))
        record(register.sessions_folder / "b.h5", "Wren 33", T0, "left")
        record(register.sessions_folder / "c.h5", "Wren 33", T0, "right")
        record(register.sessions_folder / "d.h5", "", T0)
        (register.sessions_folder / "junk.h5").write_text("not a session")
        (register.sessions_folder / "s.h5.12345678.part").write_text("being recorded")
        rebuilt = register.rebuild_from_sessions()
        assert (rebuilt.sessions, rebuilt.patients_added) == (4, 1)
        assert [fault.subject for fault in rebuilt.faults] == [str(register.sessions_folder / "junk.h5")]
        assert register.patient(linden).entry == LINDEN
        assert [entry.path.name for entry in register.sessions(linden)] == ["a.h5"]
        wren = next(patient for patient in register.patients() if patient.entry.pseudonym == "Wren 33")
        assert (wren.entry.side, wren.session_count) == ("both", 2)
        again = register.rebuild_from_sessions()
        assert (again.sessions, again.patients_added) == (4, 0)


def test_the_data_folder_can_be_moved(tmp_path: Path) -> None:
    with PatientRegister(tmp_path / "old") as register:
        patient_id = register.add(LINDEN)
        measure(register, patient_id, T0)
    (tmp_path / "old").rename(tmp_path / "new")
    with PatientRegister(tmp_path / "new") as register:
        (session,) = register.sessions(patient_id)
        assert session.path.is_file()
        assert session.path.is_relative_to(tmp_path / "new")


def test_folders_and_files_are_for_their_owner_only(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    folder.mkdir(mode=0o755)
    with PatientRegister(folder) as register:
        patient_id = register.add(LINDEN)
        path = register.new_session_path(patient_id, "WRIST_FE", "right", T0)
        found = {p: stat.S_IMODE(p.stat().st_mode) for p in (folder, *folder.rglob("*"))}
    assert path.parent in found
    assert any(p.name.endswith("-wal") for p in found)
    for p, mode in found.items():
        assert mode == (0o700 if p.is_dir() else 0o600), p


def test_names_are_in_the_register_only(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        measure(register, register.add(LINDEN), T0)
    holding = {p.name for p in tmp_path.rglob("*") if p.is_file() and b"Mustermann" in p.read_bytes()}
    assert holding == {REGISTER_FILE}


def test_paths_of_new_sessions_are_free_and_speak(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        patient_id = register.add(LINDEN)
        first = register.new_session_path(patient_id, "wrist: up/down", "left", T0)
        assert first.name == "Linden-42_2026-11-10_090000_wrist-up-down_left.h5"
        first.write_text("")
        second = register.new_session_path(patient_id, "wrist: up/down", "left", T0)
        assert second != first
        assert second.parent == first.parent


def test_an_unreadable_session_is_not_entered(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        patient_id = register.add(LINDEN)
        junk = tmp_path / "junk.h5"
        junk.write_text("x")
        with pytest.raises(SessionUnreadable):
            register.enter_session(junk, patient_id)
        assert register.sessions(patient_id) == []


@pytest.mark.parametrize("content", [b"this is no register at all" * 100, b"SQLite format 3\0" + b"x" * 5000])
def test_a_damaged_register_is_told_and_left_as_it_is(tmp_path: Path, content: bytes) -> None:
    (tmp_path / REGISTER_FILE).write_bytes(content)
    with pytest.raises(RegisterUnreadable):
        PatientRegister(tmp_path)
    assert (tmp_path / REGISTER_FILE).read_bytes() == content


def test_a_register_of_a_newer_carpus_is_told(tmp_path: Path) -> None:
    PatientRegister(tmp_path).close()
    with contextlib.closing(sqlite3.connect(tmp_path / REGISTER_FILE)) as database:
        database.execute(f"PRAGMA user_version = {len(MIGRATIONS) + 1}")
    with pytest.raises(RegisterUnreadable) as caught:
        PatientRegister(tmp_path)
    assert f"version {len(MIGRATIONS) + 1}" in caught.value.detail


def test_an_older_register_is_brought_up_to_date_and_copied_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with PatientRegister(tmp_path) as register:
        register.add(LINDEN)
    more = "ALTER TABLE patient ADD COLUMN colour TEXT NOT NULL DEFAULT 'green'"
    monkeypatch.setattr(register_module, "MIGRATIONS", (*MIGRATIONS, more))
    with PatientRegister(tmp_path) as register:
        assert register.patients()[0].entry == LINDEN
    with contextlib.closing(sqlite3.connect(tmp_path / REGISTER_FILE)) as database:
        assert database.execute("SELECT pseudonym, colour FROM patient").fetchall() == [("Linden 42", "green")]
        assert database.execute("PRAGMA user_version").fetchone() == (len(MIGRATIONS) + 1,)
    copy = tmp_path / f"patients.version{len(MIGRATIONS)}.sqlite3"
    assert stat.S_IMODE(copy.stat().st_mode) == 0o600
    with contextlib.closing(sqlite3.connect(copy)) as database:
        assert database.execute("SELECT name FROM patient").fetchall() == [("Erika Mustermann",)]
        assert database.execute("PRAGMA user_version").fetchone() == (len(MIGRATIONS),)


def test_a_migration_that_breaks_off_changes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with PatientRegister(tmp_path) as register:
        register.add(LINDEN)
    broken = "ALTER TABLE patient ADD COLUMN colour TEXT; SELECT * FROM nowhere"
    with monkeypatch.context() as patch:
        patch.setattr(register_module, "MIGRATIONS", (*MIGRATIONS, broken))
        with pytest.raises(RegisterUnreadable):
            PatientRegister(tmp_path)
    with PatientRegister(tmp_path) as register:
        assert names(register) == ["Linden 42"]


def test_it_uses_a_write_ahead_log(tmp_path: Path) -> None:
    with PatientRegister(tmp_path), contextlib.closing(sqlite3.connect(tmp_path / REGISTER_FILE)) as database:
        assert database.execute("PRAGMA journal_mode").fetchone() == ("wal",)


def test_several_threads_and_two_programs_at_once(tmp_path: Path) -> None:
    faults: list[BaseException] = []

    def work(register: PatientRegister, start: int) -> None:
        try:
            for number in range(start, start + 20):
                register.add(PatientEntry(f"Oak {number}", "left"))
                register.patients("oak")
        except BaseException as fault:
            faults.append(fault)

    with PatientRegister(tmp_path) as one, PatientRegister(tmp_path) as other:
        threads = [
            threading.Thread(target=work, args=(register, start))
            for register, start in ((one, 100), (one, 200), (other, 300), (other, 400))
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert not faults
        assert len(one.patients()) == len(other.patients()) == 80


def test_a_data_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputNotWritable):
        PatientRegister(tmp_path / "file" / "data")


def test_the_data_folder_is_the_user_s(own_folders: Path) -> None:
    assert default_data_folder().name == "carpus"
    assert default_data_folder().is_relative_to(own_folders)


def test_pseudonyms_are_speakable_free_and_without_end() -> None:
    assert len(set(WORDS)) == len(WORDS)
    assert all(word.isalpha() and len(word) <= 8 for word in WORDS)
    taken = {f"{word} {number}" for word in WORDS for number in range(10, 100)}
    free = sorted(taken)[17]
    assert suggest_pseudonym(taken - {free}) == free
    assert suggest_pseudonym({name.upper() for name in taken}) == f"{WORDS[0]} 100"
    assert suggest_pseudonym((), random.Random(1)) == suggest_pseudonym((), random.Random(1))
    assert len({suggest_pseudonym((), random.Random(seed)) for seed in range(50)}) > 40


def test_the_register_suggests_what_nobody_has(tmp_path: Path) -> None:
    with PatientRegister(tmp_path) as register:
        first = register.suggest_pseudonym(random.Random(3))
        register.add(PatientEntry(first, "left"))
        assert register.suggest_pseudonym(random.Random(3)) != first


def test_an_entry_needs_a_pseudonym_and_a_known_age_band() -> None:
    with pytest.raises(ValueError, match="pseudonym"):
        PatientEntry("  ", "left")
    with pytest.raises(ValueError, match="age band"):
        PatientEntry("Oak 11", "left", age_band="43")


def test_what_a_damaged_file_says_of_itself_keeps_no_start_from_going_on(tmp_path: Path) -> None:
    """Bytes in a file that are no text come out of HDF5 as lone surrogates, which no database and no log takes."""
    with PatientRegister(tmp_path) as register:
        path = register.sessions_folder / "1.h5.part"
        path.write_bytes(b"nothing")
        fault = SessionUnreadable(path, "unknown protocol 'wr\udc80st6'")
        assert register.first_told([fault]) == [fault]
        assert register.first_told([fault]) == []
        assert "wr\\udc80st6" in fault.detail
        str(fault).encode("utf-8")

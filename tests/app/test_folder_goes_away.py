"""The data folder goes away while a session is recorded: it waits on this computer, says so, and comes home."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from carpus.core.model.errors import (
    CarpusFault,
    DiskFull,
    FolderMissing,
    RecordingTooShort,
    SessionShareEmpty,
    SessionSpooled,
    SpooledSessionErased,
    SpooledSessionMoved,
)
from carpus.core.records import new_sessions
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.erasure import erase, plan_patient
from carpus.core.records.new_sessions import SessionIntake, recover_sessions
from carpus.core.records.recordings import spool_folder
from carpus.core.records.values import Patient
from tests.app.test_library import set_up
from tests.records.samples import record
from tests.session.samples import CREATED, write_closed_journal


def record_session(library: DataFolder, patient_id: str, pseudonym: str = "Linden 42") -> Path:
    """A session that has just been recorded, and has not been entered."""
    return record(SessionIntake(library).new_path(set_up(patient_id, pseudonym)), pseudonym, CREATED, "left")


@pytest.fixture
def library(tmp_path: Path) -> Iterator[DataFolder]:
    with closing(DataFolder(tmp_path / "data")) as opened:
        yield opened


def test_session_without_its_folder_is_published_when_it_is_back(tmp_path: Path, library: DataFolder) -> None:
    key = library.patients.add(Patient("Linden 42", "left"))
    told: list[CarpusFault] = []
    library.on_fault = told.append
    path = record_session(library, key)
    assert path.parent == spool_folder(tmp_path / "data") / key
    assert path.parent.stat().st_mode & 0o777 == 0o700
    (tmp_path / "data").rename(tmp_path / "unplugged")
    session_id = SessionIntake(library).register(set_up(key, "Linden 42"), path)
    assert [type(fault) for fault in told] == [SessionSpooled]
    assert not (tmp_path / "data").exists(), "what is made in the place of a disk would hide under it"
    assert len(library.session(session_id)) > 0  # it can be reviewed although the register is gone
    library.close()
    (tmp_path / "unplugged").rename(tmp_path / "data")
    with closing(DataFolder(tmp_path / "data")) as again:
        assert [type(fault) for fault in recover_sessions(again)[1]] == [SpooledSessionMoved]
        (entry,) = again.sessions(key)
        assert again.session(entry.session_id).header.session_id == session_id
        assert list(spool_folder(tmp_path / "data").iterdir()) == []


def test_hanging_share_does_not_block(library: DataFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    key = library.patients.add(Patient("Linden 42", "left"))
    told: list[CarpusFault] = []
    library.on_fault = told.append
    monkeypatch.setattr(new_sessions, "PUBLISH_TIMEOUT_S", 0.1)
    answers, copy = threading.Event(), new_sessions.copy_session

    def hang(path: Path, folder: Path) -> Path:
        answers.wait(20.0)
        return copy(path, folder)

    monkeypatch.setattr(new_sessions, "copy_session", hang)
    path = record_session(library, key)
    session_id = SessionIntake(library).register(set_up(key, "Linden 42"), path)
    assert [type(fault) for fault in told] == [SessionSpooled]
    assert len(library.session(session_id)) > 0
    answers.set()
    for thread in threading.enumerate():
        if thread.name == "publishing":
            thread.join()
    assert [type(fault) for fault in recover_sessions(library)[1]] == [SpooledSessionMoved]
    assert [entry.session_id for entry in library.sessions(key)] == [session_id]
    assert not path.exists()


def test_full_data_folder_keeps_the_session_local_until_there_is_room(
    library: DataFolder, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: Path, folder: Path) -> Path:
        raise DiskFull(folder)

    key = library.patients.add(Patient("Linden 42", "left"))
    told: list[CarpusFault] = []
    library.on_fault = told.append
    with monkeypatch.context() as patched:
        patched.setattr(new_sessions, "copy_session", full)
        SessionIntake(library).register(set_up(key, "Linden 42"), record_session(library, key))
    assert [type(fault) for fault in told] == [SessionSpooled]
    SessionIntake(library).recover_interrupted()  # as when the list of patients is shown
    assert len(library.sessions(key)) == 1


def test_killed_recording_is_recovered_at_the_next_start(library: DataFolder) -> None:
    key = library.patients.add(Patient("Linden 42", "left"))
    path = SessionIntake(library).new_path(set_up(key, "Linden 42"))
    write_closed_journal(path.with_suffix(".journal"), 40)
    write_closed_journal(path.with_name("first second.journal"), 0)
    found, faults = recover_sessions(library)
    assert [(one.patient_id, round(one.duration_s, 1)) for one in found] == [(key, 1.3)]
    assert [type(fault) for fault in faults] == [RecordingTooShort]
    assert [entry.session_id for entry in library.sessions(key)] == [found[0].session_id]
    assert recover_sessions(library) == ([], [])


def test_missing_share_does_not_prevent_measuring(tmp_path: Path) -> None:
    """Nothing is made where the share belongs, which would hide under it once it is mounted."""
    data, share = tmp_path / "data", tmp_path / "share"
    with closing(DataFolder(data, sessions_folder=share)) as library:
        assert [type(fault) for fault in recover_sessions(library)[1]] == [FolderMissing]
        told: list[CarpusFault] = []
        library.on_fault = told.append
        linden = library.patients.add(Patient("Linden 42", "left"))
        path = record_session(library, linden)
        SessionIntake(library).register(set_up(linden, "Linden 42"), path)
        assert [type(fault) for fault in told] == [SessionSpooled]
        recover_sessions(library)
        assert path.exists()
        assert not share.exists()
    share.mkdir()
    with closing(DataFolder(data, sessions_folder=share)) as library:
        assert [type(fault) for fault in recover_sessions(library)[1]] == [SpooledSessionMoved]
        assert [one.path.parent for one in library.sessions(linden)] == [share / linden]


def test_pending_data_of_deleted_patient_is_deleted(tmp_path: Path) -> None:
    data, share = tmp_path / "data", tmp_path / "share"
    with closing(DataFolder(data, sessions_folder=share)) as library:
        linden = library.patients.add(Patient("Linden 42", "left"))
        path = record_session(library, linden)
        path.with_name("damaged.h5").write_bytes(b"of a kill")
        path.with_name("pictures.carpusraw").write_bytes(b"without a session")
        write_closed_journal(path.with_name("killed.journal"), 3)
        heron = library.patients.add(Patient("Heron 17", "left"))
        record_session(library, heron, "Heron 17")
        library.patients.change(Patient("Heron 18", "left", patient_id=heron))
        erase(library.store, plan_patient(library.store, linden), library.log_writer)
        share.mkdir()
        told = [type(fault) for fault in recover_sessions(library)[1]]
        assert (told.count(SpooledSessionErased), told.count(SpooledSessionMoved)) == (1, 1)
        assert not path.parent.exists(), "also what cannot be read"
        assert [one.pseudonym for one in library.patients.search()] == ["Heron 18"], "by identity, not by name"
        assert len(library.sessions(heron)) == 1


def test_empty_mount_point_is_not_used_as_share(tmp_path: Path) -> None:
    data, share = tmp_path / "data", tmp_path / "share"
    share.mkdir()
    with closing(DataFolder(data, sessions_folder=share)) as library:
        assert recover_sessions(library) == ([], []), "a new one is empty"
        linden = library.patients.add(Patient("Linden 42", "left"))
        choice, places = set_up(linden, "Linden 42"), SessionIntake(library)
        places.register(choice, record_session(library, linden))
        share.rename(tmp_path / "unplugged")
        share.mkdir()
        assert [type(fault) for fault in recover_sessions(library)[1]] == [SessionShareEmpty]
        places.register(choice, record_session(library, linden))
        assert list(share.iterdir()) == [], "under the share it would be hidden"
        share.rmdir()
        (tmp_path / "unplugged").rename(share)
        assert [type(fault) for fault in recover_sessions(library)[1]] == [SessionSpooled, SpooledSessionMoved]
        assert len(library.sessions(linden)) == 2


def test_session_being_published_is_not_imported_as_well(library: DataFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    key = library.patients.add(Patient("Linden 42", "left"))
    found: list[object] = []
    copy = new_sessions.copy_session

    def copied(path: Path, folder: Path) -> Path:
        found.append(recover_sessions(library))  # the share is back at this moment
        return copy(path, folder)

    monkeypatch.setattr(new_sessions, "copy_session", copied)
    SessionIntake(library).register(set_up(key, "Linden 42"), record_session(library, key))
    assert found == [([], [])]
    assert len(library.sessions(key)) == 1

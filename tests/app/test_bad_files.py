"""Whatever lies in the data folder, the program starts; a file that is no session is set apart and named once."""

from __future__ import annotations

import os
import shutil
import sqlite3
import uuid
from collections.abc import Callable
from contextlib import closing
from itertools import product
from operator import delitem, setitem
from pathlib import Path

import h5py
import pytest

from carpus.core.model.errors import (
    CarpusFault,
    PatientListMissing,
    PatientListRebuilt,
    SessionFilesIgnored,
    SessionUnreadable,
)
from carpus.core.records import new_sessions, session_list
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.database import STORE_FILE
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.records.values import Patient
from carpus.core.session.writer import SessionWriter
from tests.records.samples import open_store as opened_store
from tests.session.samples import CAMERA, make_calibration, make_frame, make_header
from tests.session.test_golden import unpack_golden


def store_file(path: Path, subject: str = "Linden 42", *, finished: bool = True) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    if not finished:
        part = unpack_golden("v2-wrist6.h5.0123abcd.part", path.parent)
        os.utime(part, (0, 0))
        return part.rename(part.with_name(f"{path.name}.{uuid.uuid4().hex[:8]}.part"))
    header = make_header(session_id=uuid.uuid4(), subject=subject)
    writer = SessionWriter.create(path, header, CAMERA, make_calibration())
    for row in range(12):
        writer.append(make_frame(row))
    writer.close()
    return path


def start_program(folder: Path) -> tuple[list[str], list[CarpusFault]]:
    """The program's start on a folder: patients, and what it tells of its files."""
    with closing(DataFolder(folder)) as library:
        faults = [one for one in recover_sessions(library)[1] if not isinstance(one, PatientListMissing)]
        return [record.pseudonym for record in library.patients.search()], faults


BAD: dict[str, Callable[[h5py.File], object]] = {
    "group": lambda file: (delitem(file, "/frames/timestamp"), file.create_group("/frames/timestamp")),
    "scalar": lambda file: (delitem(file, "/detections/frame"), setitem(file, "/detections/frame", 3)),
    "huge": lambda file: file["/frames/timestamp"].resize(1 << 60, axis=0),
    "sign": lambda file: setitem(file["/detections/count"], 5, -1 << 31),
    "blank": lambda file: setitem(file.attrs, "subject_id", " "),
    "text for a time": lambda file: setitem(file.attrs, "created", "0001-01-01T00:00:00+23:59"),
}


def test_bad_files_do_not_keep_the_program_from_starting(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(new_sessions, "MAX_LISTED_FILES", 100)
    sessions = tmp_path / "sessions"
    store_file(sessions / "Heron-17" / "good.h5", "Heron 17")
    bad: dict[Path, str] = {}
    for change, finished in product(BAD, (True, False)):
        path = store_file(sessions / "Linden-42" / f"{change} {finished}.h5", finished=finished)
        bad[path] = change
        with h5py.File(path, "r+") as file:
            BAD[change](file)
        os.utime(path, (0, 0))
    patients, faults = start_program(tmp_path)
    assert "Heron 17" in patients
    assert all(isinstance(fault, SessionUnreadable) for fault in faults)
    named = [Path(fault.subject).name for fault in faults]
    assert set(named) <= {path.name for path in bad}
    for path, change in bad.items():
        assert path.exists() or path.with_name(f"{path.name.partition('.h5')[0]}.h5").exists()
        assert change not in ("group", "scalar") or named.count(path.name) == 1
    assert start_program(tmp_path) == (patients, []), "named once, and not opened again"


def test_unchanged_files_are_not_opened_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number in range(5):
        store_file(tmp_path / "sessions" / f"{number}.h5")
    start_program(tmp_path)
    opened: list[Path] = []
    real = session_list.read_outline
    monkeypatch.setattr(session_list, "read_outline", lambda path: (opened.append(path), real(path))[1])
    store_file(tmp_path / "sessions" / "new.h5")
    start_program(tmp_path)
    assert [path.name for path in opened] == ["new.h5"]


def test_copied_session_counts_once(tmp_path: Path) -> None:
    first = store_file(tmp_path / "sessions" / "b.h5")
    with opened_store(tmp_path) as house:
        house.files.scan()
        (patient,) = house.patients.search()
        shutil.copy(first, tmp_path / "sessions" / "a.h5")
        assert house.files.scan().session_count == 0
        assert [entry.path.name for entry in house.index.patient_sessions(patient.patient_id)] == ["b.h5"]
        assert house.patients.get(patient.patient_id).session_count == 1
        assert session_list.read_file_states(house.store)["a.h5"].reason == "a copy of b.h5"
        first.unlink()
        house.files.scan()
        assert [entry.path.name for entry in house.index.patient_sessions(patient.patient_id)] == ["a.h5"]
    with opened_store(tmp_path) as house:
        assert house.patients.get(patient.patient_id).session_count == 1


def test_names_that_are_no_text_and_links(tmp_path: Path) -> None:
    sessions = tmp_path / "sessions"
    outside = store_file(tmp_path / "outside.h5", "Elsewhere 1")
    store_file(sessions / "s.h5")
    shutil.copy(outside, os.fsencode(sessions) + b"/\xff\xfe.h5")
    (sessions / "link.h5").symlink_to(outside)
    (sessions / "dangling.h5").symlink_to(tmp_path / "nowhere")
    os.mkfifo(sessions / "pipe.h5")
    (sessions / "folder.h5").mkdir()
    patients, faults = start_program(tmp_path)
    assert patients == ["Linden 42"]
    assert len(faults) == 1
    assert isinstance(faults[0], SessionFilesIgnored)
    assert faults[0].detail == "5 files"


def test_part_without_header_is_reported_once(tmp_path: Path) -> None:
    part = store_file(tmp_path / "sessions" / "s.h5", finished=False)
    part.write_bytes(b"\x89HDF" + bytes(3000))
    os.utime(part, (0, 0))
    patients, faults = start_program(tmp_path)
    assert (patients, len(faults)) == ([], 1)
    assert start_program(tmp_path)[1] == []
    reserved = part.with_name("t.h5.01234567.part")
    reserved.write_bytes(bytes(600_000))  # ended before its first byte
    os.utime(reserved, (0, 0))
    assert start_program(tmp_path)[1] == []
    assert part.exists()
    assert reserved.exists()


def rows(statement: str) -> Callable[[Path], object]:
    def change(path: Path) -> None:
        with closing(sqlite3.connect(path)) as database, database:
            database.execute("PRAGMA ignore_check_constraints = ON")
            database.execute(statement)

    return change


DAMAGE: dict[str, Callable[[Path], object]] = {
    "overwritten": lambda path: path.write_bytes(b"no register" * 500),
    "cut off": lambda path: path.write_bytes(path.read_bytes()[:5000]),
    # A table's name that is no text: SQLite's complaint about it cannot be read either.
    "misnamed": lambda path: path.write_bytes(path.read_bytes().replace(b"TABLE session", b"TABLX s\xd5ssion", 1)),
    "another column": rows("ALTER TABLE patient RENAME COLUMN note TO remark"),
    "no time": rows("UPDATE session SET created = 'yesterday'"),
    "no sex": rows("UPDATE patient SET sex = 'old', side = '7'"),
}


@pytest.fixture(scope="module")
def kept_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("kept")
    store_file(folder / "sessions" / "s.h5")
    start_program(folder)
    return folder


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_register_does_not_keep_program_from_starting(kept_folder: Path, tmp_path: Path, damage: str) -> None:
    shutil.copytree(kept_folder, tmp_path, dirs_exist_ok=True)
    DAMAGE[damage](tmp_path / STORE_FILE)
    assert damage != "misnamed" or b"TABLX" in (tmp_path / STORE_FILE).read_bytes()
    patients, faults = start_program(tmp_path)
    assert len(patients) == 1
    for fault in faults:
        assert isinstance(fault, PatientListRebuilt)
        assert Path(fault.subject).exists()
    with opened_store(tmp_path) as house:
        (patient,) = house.patients.search()
        assert patient.session_count == 1
        assert len(house.index.patient_sessions(patient.patient_id)) == 1
    assert start_program(tmp_path) == (patients, [])


def test_name_that_is_removed_is_nowhere(tmp_path: Path) -> None:
    with opened_store(tmp_path) as house:
        key = house.patients.add(Patient("Linden 42", "right", name="Wilhelmina Featherstone", note="a note"))
        for number in range(50):
            house.patients.change(
                Patient("Linden 42", "right", name=f"Wilhelmina Featherstone {number}", patient_id=key)
            )
        house.patients.change(Patient("Linden 42", "right", patient_id=key))
        found = [path.name for path in tmp_path.iterdir() if path.is_file() and b"Featherstone" in path.read_bytes()]
        assert found == []


def test_damaged_file_is_read_again_when_it_has_changed(tmp_path: Path) -> None:
    path = tmp_path / "sessions" / "s.h5"
    good = store_file(path).read_bytes()
    path.write_bytes(good[:3000])
    assert len(start_program(tmp_path)[1]) == 1
    path.write_bytes(good)
    assert start_program(tmp_path) == (["Linden 42"], [])

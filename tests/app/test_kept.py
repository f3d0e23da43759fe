"""What commands and windows do with sessions of a data folder stands in its log, and what they made goes with them."""

from __future__ import annotations

import csv
import io
import shutil
import uuid
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

import h5py
import pytest

from carpus.app.session_commands import read_choices, read_comment
from carpus.app.settings import settings_folder
from carpus.core.model.errors import OutputNotWritable
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.log import read_log
from carpus.core.records.patients import read_last_setup
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.ui.screens.sessions.session_list import SessionStore
from tests.app.test_library import set_up, store
from tests.commands import Command
from tests.formats.takes import store_session
from tests.records.samples import traces


@pytest.fixture
def library(tmp_path: Path) -> Iterator[DataFolder]:
    opened = DataFolder(tmp_path / "data")
    opened.get_initials = lambda: "AB"
    yield opened
    opened.close()


def deeds(folder: Path) -> list[tuple[str, str, str]]:
    with Store(folder) as opened:
        return [(entry.action, entry.source, entry.initials) for entry in read_log(opened)]


def test_window_actions_are_logged_without_names(library: DataFolder, tmp_path: Path) -> None:
    stored = SessionStore(library)
    linden = library.patients.add(Patient("Linden 42", "right", "right", note="a note", name="Erika Mustermann"))
    library.patients.change(Patient("Linden 43", "right", "right", patient_id=linden))
    session = store(library, set_up(linden, "Linden 43"))
    store(library, set_up(PRACTICE_PATIENT, "Practice patient"))
    stored.exclude(session, "pain")
    stored.exclude(session, "")
    library.save_choices(session, RepetitionChoices({1: "pain"}))
    stored.rename_exercise(session, "FOREARM_PS")
    out = tmp_path / "out"
    out.mkdir()
    library.export(session, str(out))
    records = RecordRetention(library)
    records.archive_session(session)
    assert [one.pseudonym for one in records.list_archived()] == ["Linden 43"]
    records.unarchive(records.list_archived()[0].item_id)
    records.archive_patient(linden)
    assert [(one.pseudonym, one.recorded) for one in records.list_archived()] == [("Linden 43", None)]
    records.unarchive(linden)
    assert records.list_archived() == []
    assert [did for did, _, _ in deeds(library.folder)] == [
        "added", "changed", "recorded", "set_aside", "taken_back", "changed", "renamed", "exported", "archived",
        "brought_back", "archived", "brought_back",
    ]  # fmt: skip
    assert {(by, who) for _, by, who in deeds(library.folder)} == {("window", "AB")}
    content = repr(read_log(library.store))
    assert not any(word in content for word in ("Linden", "Erika", "pain", "a note", linden, session))
    plan = records.plan_patient(linden)
    assert {path.parent for path in plan.output_files} == {out}
    assert read_last_setup(library.store, linden) is not None
    records.erase(plan)
    assert list(out.iterdir()) != [], "no file outside of the data folder is touched"
    assert traces(library.folder, "Linden", "Erika", linden, session) == []


def test_commands_are_logged_where_the_session_is_kept(library: DataFolder, tmp_path: Path, command: Command) -> None:
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    session = store(library, set_up(linden, "Linden 42"))
    practice = store(library, set_up(PRACTICE_PATIENT, "Practice patient"))
    path, out, elsewhere = library.entry(session).path, tmp_path / "out", tmp_path / "own.h5"
    elsewhere.write_bytes(path.read_bytes())
    for words in (
        ("info", path), ("verify", path), ("export", path, "--output", out),
        ("report", path, "--output", out / "r.pdf"), ("info", library.entry(practice).path), ("info", elsewhere),
    ):  # fmt: skip
        done = command(*words)
        assert (done.code, "Written: " in done.out) == (0, words[0] == "export")
    again = command("export", path, "--output", out)
    assert (again.code, f"{path.stem}.wrist" in again.err) == (1, True), "nothing is overwritten"
    commands = [did for did, by, _ in deeds(library.folder) if by == "command"]
    assert commands == ["opened", "opened", "exported", "reported"]
    assert "6 lines." in command("log", "--data-folder", library.folder).out
    asked = command("erase", path)
    assert (asked.code, path.exists()) == (0, True)
    assert f"Delete this yourself: {out / 'r.pdf'}" in asked.out
    assert (command("erase", path, "--for-good", "Heron 17").code, path.exists()) == (1, True)
    assert (command("erase", path, "--for-good", "linden 42").code, path.exists()) == (0, False)
    assert (out / "r.pdf").exists()
    assert library.sessions(linden) == []
    assert command("erase", elsewhere).code == 1


def test_progress_of_a_listed_patient_excludes_the_archive(
    library: DataFolder, command: Command, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    linden, heron = (library.patients.add(Patient(name, "right", "right")) for name in ("Linden 42", "Heron 17"))
    sessions, whole = [str(uuid.uuid4()) for _ in range(2)], store_session(tmp_path, frames=120, moving=True)
    for session_id in sessions:
        path = library.session_list.new_path(linden, "Linden 42", "WRIST_FE", "left", datetime.now(UTC))
        shutil.copy(whole, path)
        with h5py.File(path, "r+") as file:
            file.attrs.update(subject_id="", session_id=session_id, recording_id=session_id)
        library.session_list.add(path, linden)
    store(library, set_up(PRACTICE_PATIENT, "Practice patient"))
    monkeypatch.setenv("CARPUS_DATA", str(library.folder))

    def counted(*asked: str | Path) -> tuple[set[str], set[str]]:
        done = command("progress", *asked)
        assert done.code == 0, done.err
        rows = list(csv.DictReader(io.StringIO(done.out)))
        return {row["session_id"] for row in rows}, {row["subject_id"] for row in rows}

    assert counted("linden 42") == counted("all") == (set(sessions), {"Linden 42"})
    RecordRetention(library).archive_session(sessions[0])
    expected = {sessions[1]}, {"Linden 42"}
    assert counted("Linden 42") == counted("all", "--sessions", library.folder) == expected
    assert counted("all", "--sessions", library.entry(sessions[0]).path)[0] == {sessions[0]}
    assert "There is no session" in command("progress", "Heron 17").err
    assert "did you mean “Heron 17”" in command("progress", "Heron 16").err
    RecordRetention(library).archive_patient(linden)
    assert counted("Linden 42") == expected
    assert command("progress", "all").code == 1
    assert library.sessions(heron) == []


def test_log_that_cannot_be_written_is_reported_and_stops_nothing_else(
    library: DataFolder, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[Exception] = []
    library.on_fault = told.append

    def full(*_: object, **__: object) -> None:
        raise OutputNotWritable(library.folder)

    monkeypatch.setattr(library.log_writer, "write_entry", full)
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    assert library.patients.get(linden).pseudonym == "Linden 42"
    assert [type(one).__name__ for one in told] == ["OutputNotWritable"]


def test_backup_by_command_is_restored_elsewhere(library: DataFolder, tmp_path: Path, command: Command) -> None:
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    store(library, set_up(linden, "Linden 42"))
    place, new = tmp_path / "disk", tmp_path / "new"
    assert command("backup", place, "--list").code == 1
    made = command("backup", place, "--data-folder", library.folder)
    assert (made.code, "1 sessions" in made.out) == (0, True)
    assert command("backup", place, "--compare").code == 0
    store(library, set_up(linden, "Linden 42"))
    told = command("restore", place, "--against", library.folder)
    assert (told.code, "Sessions added: 0, changed: 0, removed: 1." in told.out) == (0, True)
    assert [command("restore", place, "--into", new).code for _ in range(2)] == [0, 1]
    with closing(DataFolder(new)) as restored:
        assert [len(restored.sessions(one.patient_id)) for one in restored.patients.search()] == [1]
    assert [did for did, _, _ in deeds(new)] == ["added", "recorded", "backed_up", "recorded", "restored"]
    assert command("erase", "Linden 42", "--data-folder", library.folder, "--for-good", "linden 42").code == 0
    later = command("restore", place, "--into", tmp_path / "later")
    assert "deleted again: 1 patients" in later.out
    with closing(DataFolder(tmp_path / "later")) as restored:
        assert restored.patients.search() == []


def test_commands_find_the_records_of_a_file_on_the_share(
    tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    data, share = tmp_path / "data", tmp_path / "share"
    share.mkdir()
    monkeypatch.setenv("CARPUS_DATA", str(data))
    settings = settings_folder() / "settings.toml"
    settings.parent.mkdir(parents=True, exist_ok=True)
    settings.write_text(f'[records]\nsessions = "{share}"\n')
    with closing(DataFolder(data, sessions_folder=share)) as library:
        linden = library.patients.add(Patient("Linden 42", "right", "right"))
        session = store(library, set_up(linden, "Linden 42"))
        library.save_comment(session, "Less swelling.")
        library.save_choices(session, RepetitionChoices({0: "pain"}))
        path = library.entry(session).path
    assert path.is_relative_to(share)
    assert (read_comment(path), read_choices(path).excluded) == ("Less swelling.", {0: "pain"})
    assert command("backup", tmp_path / "disk").code == 0
    assert command("erase", path, "--for-good", "Linden 42").code == 0
    assert not path.exists()

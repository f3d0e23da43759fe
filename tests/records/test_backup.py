"""Everything comes back from a back-up, bit by bit, and nothing damaged does."""

from __future__ import annotations

import errno
import itertools
import json
import os
import shutil
import sqlite3
import uuid
from datetime import UTC, datetime, timedelta
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from carpus.core.model.errors import (
    BackupFolderUnsuited,
    BackupIncomplete,
    BackupMismatch,
    BackupUnreadable,
    DiskFull,
    OutputBusy,
    OutputExists,
    PatientListBusy,
    PatientListReadOnly,
    PatientListUnreadable,
)
from carpus.core.records import backup as module
from carpus.core.records import erasure
from carpus.core.records.backup import (
    BACKUPS,
    OBJECTS,
    Backup,
    create_backup,
    is_backup_due,
    list_backups,
    prune_backups,
    read_backup,
    verify_backup,
)
from carpus.core.records.database import STORE_FILE, copy_to_memory
from carpus.core.records.log import read_log
from carpus.core.records.patients import Patients
from carpus.core.records.restoring import (
    LogHistory,
    activate_restored,
    has_restored_folder,
    plan_restore,
    read_history,
    restore,
)
from carpus.core.records.store import Store
from tests.records.samples import HERON, LINDEN, NAMES, T0, measure, open_store, strip_stored_fields, traces

NOW = datetime(2026, 11, 20, 18, 0, tzinfo=UTC)


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("kept")
    with open_store(folder) as house:
        linden = house.patients.add(LINDEN)
        measure(house, linden, T0)
        measure(house, linden, T0 + timedelta(days=1))
        house.log.write_entry("opened", "patient", linden)
    (folder / "set_ups.json").write_text("{}")
    return folder


@pytest.fixture
def data(kept: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(kept, tmp_path / "data"))


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """For back-ups."""
    return tmp_path / "disk"


def make_backup(data: Path, place: Path, now: datetime = NOW, **options: Any) -> Backup:
    return create_backup(data, place, now=now, **options)


def contents(folder: Path) -> dict[str, bytes]:
    """All but the store, whose journal comes and goes, and locks."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and ".sqlite3" not in path.name and path.suffix != ".lock"
    }


def restore_backup(place: Path, made: Backup, target: Path, settings: Path | None = None) -> None:
    restore(made, place, target, LogHistory(), settings_folder=settings)
    activate_restored(target, NOW)


@pytest.mark.parametrize(
    "trouble", ["", "a journal", "a journal while it is read", "another computer writes", "damaged"]
)
def test_backup_of_read_only_folder_fails_only_while_it_is_written(
    trouble: str, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    connect, read_bytes, store, numbers = sqlite3.connect, Path.read_bytes, data / STORE_FILE, itertools.count()

    def only_reads(name: str, **options: Any) -> sqlite3.Connection:
        if "mode=rw" in name:
            fault = sqlite3.OperationalError("unable to open database file")
            fault.sqlite_errorcode = sqlite3.SQLITE_CANTOPEN
            raise fault
        return connect(name, **options)

    def read(path: Path) -> bytes:
        content = read_bytes(path)
        if path == store and trouble == "a journal while it is read":
            store.with_name(f"{STORE_FILE}-wal").write_bytes(b"what is written now")
        return content + b"%d" % next(numbers) if path == store and trouble == "another computer writes" else content

    if trouble == "a journal":
        store.with_name(f"{STORE_FILE}-wal").write_bytes(b"what was written last")
    if trouble == "damaged":
        store.write_bytes(store.read_bytes()[:5000])
    monkeypatch.setattr(sqlite3, "connect", only_reads)
    monkeypatch.setattr(Path, "read_bytes", read)
    if trouble:
        with pytest.raises(PatientListUnreadable) as told:
            make_backup(data, tmp_path / "place")
        assert type(told.value) is {
            "a journal": PatientListReadOnly, "a journal while it is read": PatientListReadOnly,
            "another computer writes": PatientListBusy, "damaged": PatientListUnreadable,
        }[trouble]  # fmt: skip
        return
    with Store(data, copy=copy_to_memory(store)) as kept:
        assert [strip_stored_fields(record) for record in Patients(kept).search()] == [LINDEN]
    made = make_backup(data, tmp_path / "place")
    monkeypatch.undo()
    restore_backup(tmp_path / "place", made, tmp_path / "again")
    with open_store(tmp_path / "again") as house:
        assert house.names() == [LINDEN.pseudonym]


def make_backups(data: Path, place: Path, *days: int) -> list[Backup]:
    """Back-ups made so many days ago, each of something else."""
    made = []
    for day in days:
        (data / "set_ups.json").write_text(json.dumps({"day": day}))
        made.append(make_backup(data, place, NOW - timedelta(days=day)))
    return made


def test_restore_on_another_computer_brings_everything_back(data: Path, place: Path, tmp_path: Path) -> None:
    settings = tmp_path / "settings"
    settings.mkdir()
    for name in ("preferences", "lab"):
        (settings / f"{name}.toml").write_text("x = 1")
    with open_store(data) as house:  # it runs
        made = make_backup(data, place, settings_folder=settings)
        first = [entry.session_id for entry in house.index.patient_sessions(house.patients.search()[0].patient_id)]
    assert made.session_count == 2
    new, new_settings = tmp_path / "new" / "carpus", tmp_path / "new settings"
    new_settings.mkdir()
    (new_settings / "lab.toml").write_text("x = 2")
    restore_backup(place, made, new, new_settings)
    assert contents(new) == contents(data)
    assert (new_settings / "preferences.toml").read_text() == "x = 1"
    assert (new_settings / "lab.toml").read_text() == "x = 2", "settings that are there stay"
    assert {path.stat().st_mode & 0o077 for path in new.rglob("*")} == {0}
    with open_store(new) as house:
        (patient,) = house.patients.search()
        assert strip_stored_fields(patient) == LINDEN
        assert [entry.session_id for entry in house.index.patient_sessions(patient.patient_id)] == first
        assert house.files.scan().session_count == 0
    with pytest.raises(OutputExists):
        restore_backup(place, made, new)


def test_backup_stores_equal_content_once(data: Path, place: Path) -> None:
    first = make_backup(data, place)
    objects = {path: path.stat().st_mtime_ns for path in (place / OBJECTS).glob("*/*")}
    second = make_backup(data, place, NOW + timedelta(days=1))
    assert [one.name for one in list_backups(place)] == [second.name, first.name]
    after = {path: path.stat().st_mtime_ns for path in (place / OBJECTS).glob("*/*")}
    kept = [path for path in objects if objects[path] == after.get(path)]
    assert len(after) <= len(objects) + 1
    assert len(kept) >= len(objects) - 1, "only the store is copied anew"
    make_backup(data, place)
    assert len(list_backups(place)) == 3, "two of one second are two"


@pytest.mark.parametrize("at", [0, -1])
def test_verify_backup_flipped_bit_raises(
    data: Path, place: Path, tmp_path: Path, at: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = make_backup(data, place)
    verify_backup(place, made)
    one = next(file for file in made.files if file.path.endswith(".h5"))
    content = place / OBJECTS / one.sha256[:2] / one.sha256
    damaged = bytearray(content.read_bytes())
    damaged[at] ^= 1
    content.write_bytes(bytes(damaged))
    with pytest.raises(BackupMismatch):
        verify_backup(place, made)
    with pytest.raises(BackupMismatch):
        restore_backup(place, made, tmp_path / "new")
    assert not list(tmp_path.glob("*new*")), "nothing is left"
    make_backup(data, place, NOW + timedelta(days=1))
    for later in list_backups(place):
        verify_backup(place, later)  # written anew, for the earlier one too
    monkeypatch.setattr(module, "hash_file", lambda *_, **__: "")
    with pytest.raises(BackupMismatch):
        make_backup(data, place, NOW + timedelta(days=2))
    assert len(list_backups(place)) == 2, "what could not be compared is no back-up"


@pytest.mark.parametrize("where", [".", "sessions/backup", ".."])
def test_create_backup_in_or_around_data_folder_is_refused(data: Path, where: str) -> None:
    with pytest.raises(BackupFolderUnsuited):
        make_backup(data, data / where)


def test_plan_restore_lists_changes_and_restore_keeps_old_folder(data: Path, place: Path) -> None:
    made = make_backup(data, place)
    gone, changed = sorted((data / "sessions").rglob("*.h5"))
    gone.unlink()
    changed.write_bytes(b"changed")
    (data / "sessions" / "new.h5").write_bytes(b"new")
    plan = plan_restore(made, place, data, LogHistory())
    assert plan.added == (gone.relative_to(data).as_posix(),)
    assert plan.replaced == (changed.relative_to(data).as_posix(),)
    assert plan.removed == ("sessions/new.h5",)
    restore(made, place, data, LogHistory(), overwrite=True)
    old = activate_restored(data, NOW)
    assert old is not None
    assert (old / "sessions" / "new.h5").read_bytes() == b"new"
    assert gone.exists()
    assert plan_restore(made, place, data, LogHistory()).replaced == ()


@pytest.mark.parametrize(
    ("days", "keep", "months", "left"),
    [
        ((0, 1, 2, 40, 41, 70, 900), 2, 24, [0, 1, 40, 70]),
        ((0, 1, 2, 3, -3, -2), 2, 0, [-3, -2, 0, 1]),  # made by a clock that ran ahead
        ((0, 1, -3), 0, 1, [-3, 0]),  # the month's newest is that of a day that has been
    ],
)
def test_prune_backups_keeps_newest_and_one_per_month(
    data: Path, place: Path, days: tuple[int, ...], keep: int, months: int, left: list[int]
) -> None:
    made = make_backups(data, place, *days)
    of_killed = [place / OBJECTS / f".{uuid.uuid4().hex}", place / BACKUPS / f".{made[0].name}-2.json.part"]
    for path in of_killed:
        path.write_bytes(b"half")
    assert prune_backups(place, keep, months, NOW) == len(days) - len(left)
    assert [(NOW - one.made).days for one in list_backups(place)] == left
    for one in list_backups(place):
        verify_backup(place, one)
    needed = {file.sha256 for one in list_backups(place) for file in one.files}
    assert {path.name for path in (place / OBJECTS).glob("*/*")} == needed
    assert not any(path.exists() for path in of_killed)


def test_prune_backups_keeps_contents_of_newer_format(data: Path, place: Path) -> None:
    _, newer, _ = make_backups(data, place, 900, 800, 0)
    path = place / BACKUPS / f"{newer.name}.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"format_version": 99}))
    assert prune_backups(place, 1, 0, NOW) == 1
    verify_backup(place, newer)


@pytest.mark.parametrize("at_reading", [1, 3])
def test_prune_backups_unreadable_backup_loses_nothing(
    data: Path, place: Path, monkeypatch: pytest.MonkeyPatch, at_reading: int
) -> None:
    real, read = Path.read_text, list[Path]()
    made = make_backups(data, place, 1, 0)[0]

    def faulty(path: Path, *told: Any, **named: Any) -> str:
        read.append(path)
        if path.stem == made.name and read.count(path) == at_reading:
            raise OSError(5, "Input/output error")
        return real(path, *told, **named)

    with monkeypatch.context() as patched:
        patched.setattr(Path, "read_text", faulty)
        assert prune_backups(place, 9, 24, NOW) == 0
    verify_backup(place, made)


def test_backup_from_json_newer_or_foreign_is_refused(data: Path, place: Path) -> None:
    path = place / BACKUPS / f"{create_backup(data, place, now=NOW).name}.json"
    told = json.loads(path.read_text())
    for change in (
        {"format_version": 2},
        {"format": "x"},
        {"files": [["../../evil", "0" * 64, 1, 1]]},
        {"files": [["/etc/passwd", "0" * 64, 1, 1]]},
        {"files": [["a", "../../../etc/passwd", 1, 1]]},
        {"made": "yesterday"},
        {"made": "2026-11-20T18:00:00"},
        {"lacking": 1e999},
        {"made": "9999-12-31T23:59:59-23:59"},
        {"lacking": True},
        {"files": [["a", "0" * 64, -1, 1]]},
        {"files": [["a", "0" * 64, 1, 1 << 80]]},
        {"files": [["a", "0" * 64, 1, 1], ["a", "1" * 64, 1, 1]]},
    ):
        path.write_text(json.dumps(told | change))
        with pytest.raises(BackupUnreadable):
            read_backup(path)
    assert prune_backups(place, 0, 0, NOW) == 0, "nothing is taken away that an unread list may need"


def test_is_backup_due_after_days() -> None:
    assert is_backup_due(None, 3, NOW)
    assert not is_backup_due(NOW, 3, NOW + timedelta(days=3))
    assert is_backup_due(NOW, 3, NOW + timedelta(days=3, minutes=1))


def test_create_backup_follows_links(data: Path, place: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "large disk" / "sessions"
    elsewhere.parent.mkdir()
    (data / "sessions").rename(elsewhere)
    (data / "sessions").symlink_to(elsewhere)
    (data / "sessions" / "around").symlink_to(data)  # in a circle
    (data / "limits.json").symlink_to(data / "set_ups.json")
    made = make_backup(data, place)
    assert made.session_count == 2
    restore_backup(place, made, tmp_path / "new")
    assert len([path for path in (tmp_path / "new" / "sessions").rglob("*.h5") if not path.is_symlink()]) == 2
    assert (tmp_path / "new" / "limits.json").read_text() == "{}"
    with pytest.raises(BackupFolderUnsuited):
        make_backup(data, elsewhere / "backup")


def test_create_backup_contains_sessions_of_share(data: Path, place: Path, tmp_path: Path) -> None:
    share = tmp_path / "share"
    (data / "sessions").rename(share)
    made = make_backup(data, place, sessions_folder=share)
    assert (made.session_count, made.missing_count) == (2, 0)
    restore_backup(place, made, tmp_path / "new")
    assert contents(tmp_path / "new" / "sessions") == contents(share)
    with pytest.raises(BackupFolderUnsuited):
        create_backup(data, share / "backup", sessions_folder=share)
    share.rename(tmp_path / "away")
    with pytest.raises(BackupIncomplete):
        make_backup(data, place, sessions_folder=share)


def test_create_backup_twice_at_once_one_waits(data: Path, place: Path) -> None:
    """What only an old back-up had goes with that one, unless a back-up that runs has just found it there."""
    met = []
    make_backup(data, place, NOW - timedelta(days=40))

    def other(done: int, _: int) -> None:
        assert prune_backups(place, 0, 0, NOW) == 0
        with pytest.raises(OutputBusy):
            make_backup(data, place)
        met.append(done)

    made = make_backup(data, place, progress=other)
    assert met
    verify_backup(place, made)
    assert prune_backups(place, 1, 0, NOW) == 1
    verify_backup(place, made)


@pytest.mark.parametrize("lost", ["file", "folder", "link"])
def test_create_backup_missing_session_file_is_incomplete(data: Path, place: Path, tmp_path: Path, lost: str) -> None:
    sessions = data / "sessions"
    if lost == "file":
        next(iter(sessions.rglob("*.h5"))).unlink()
    else:
        sessions.rename(tmp_path / "away")
    if lost == "link":
        sessions.symlink_to(tmp_path / "nowhere")
    with pytest.raises(BackupIncomplete) as told:
        make_backup(data, place)
    assert int(told.value.detail) == {"file": 1, "folder": 2, "link": 3}[lost]
    (made,) = list_backups(place)
    assert made.missing_count == int(told.value.detail)
    assert "set_ups.json" in {one.path for one in made.files}, "all else is in it"


class Trouble:
    """At one step that changes a name or a file of the disk: a kill, which tidies nothing up, or a full disk."""

    def __init__(self, number: int, kind: str, patched: pytest.MonkeyPatch) -> None:
        self._left, self._kind, self._rmtree = number, kind, shutil.rmtree
        self.is_met = False
        for name in ("rename", "replace"):
            named = partial(self._step, getattr(Path, name))
            patched.setattr(Path, name, lambda path, *told, named=named: named(path, *told))
        patched.setattr(os, "fsync", partial(self._step, os.fsync))
        patched.setattr(shutil, "rmtree", self._tidied)

    def _step(self, real: Any, *told: Any) -> Any:
        self._left -= 1
        if self._left == -1:
            self.is_met = True
            raise KeyboardInterrupt if self._kind == "killed" else OSError(errno.ENOSPC, "No space left on device")
        return real(*told)

    def _tidied(self, *told: Any, **named: Any) -> None:
        if not self.is_met or self._kind == "full":
            self._rmtree(*told, **named)


@pytest.mark.parametrize("kind", ["killed", "full"])
def test_create_backup_failing_at_any_step_keeps_others(
    kind: str, data: Path, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_backup(data, place)
    for number in itertools.count():
        (data / "set_ups.json").write_text(f"{number}")
        with monkeypatch.context() as patched:
            trouble = Trouble(number, kind, patched)
            try:
                make_backup(data, place, NOW + timedelta(minutes=number))
            except KeyboardInterrupt:
                assert kind == "killed"
            except DiskFull:
                assert kind == "full"
        for one in list_backups(place):
            verify_backup(place, one)
        if not trouble.is_met:
            break
    assert number > 5
    assert list_backups(place)[0].made == NOW + timedelta(minutes=number), "and the next one is whole"
    prune_backups(place, 99, 99, NOW + timedelta(days=1))
    assert not [path for path in place.rglob(".*") if path.name != module.LOCK_FILE]


@pytest.mark.parametrize("kind", ["killed", "full"])
def test_restore_failing_at_any_step_loses_and_leaves_nothing(
    kind: str, data: Path, place: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, before = make_backup(data, place), contents(data)
    (data / "set_ups.json").write_text("since")
    for number in itertools.count():
        with monkeypatch.context() as patched:
            trouble = Trouble(number, kind, patched)
            try:
                restore(made, place, data, LogHistory(), overwrite=True)
                activate_restored(data, NOW)
            except KeyboardInterrupt:
                assert kind == "killed"
            except DiskFull:
                assert kind == "full"
                assert not list(tmp_path.glob(".*restoring")), "nothing half is left"
        if not trouble.is_met:
            break
        if has_restored_folder(data):  # as at the next start
            activate_restored(data, NOW)
        asides = list(tmp_path.glob("data.before-restore-*"))
        assert len(asides) == (contents(data) == before)
        for aside in asides:
            shutil.rmtree(data)
            aside.rename(data)
        assert (data / "set_ups.json").read_text() == "since", "what was there is kept"
    assert number > 10
    assert contents(data) == before
    assert len(list(tmp_path.iterdir())) == 3, "what killed ones left is gone"


@pytest.mark.parametrize("what", ["patient", "session"])
def test_restore_does_not_bring_back_erased_since(what: str, data: Path, place: Path, tmp_path: Path) -> None:
    with open_store(data) as house:
        heron = house.patients.add(HERON)
        stays = measure(house, heron, T0)
        linden = house.patients.id_of_pseudonym(LINDEN.pseudonym)
        first, second = (one.session_id for one in house.index.patient_sessions(linden))
        made = make_backup(data, place)
        plan = (
            erasure.plan_patient(house.store, linden) if what == "patient" else erasure.plan_session(house.store, first)
        )
        erasure.erase(house.store, plan, house.log)
        past = read_history(place, house.store)
        changes = plan_restore(made, place, data, past)
    assert (changes.added, changes.removed, changes.erased_count) == ((), (), 1), "said before"
    assert restore(made, place, tmp_path / "new", past) == 1
    activate_restored(tmp_path / "new", NOW)
    assert traces(tmp_path / "new", first, *((linden, second, *NAMES) if what == "patient" else ())) == []
    with open_store(tmp_path / "new") as house:
        assert house.names() == (["Heron 17"] if what == "patient" else ["Heron 17", "Linden 42"])
        assert house.index.get(stays).path.exists()
        assert what == "patient" or house.index.get(second).path.exists()
        assert [one.action for one in read_log(house.store)][-3:] == ["erase_begun", "erased", "erased"], (
            "the log goes on"
        )
        assert house.files.scan().session_count == 0


def test_restore_without_data_folder_uses_log_of_newest_backup(data: Path, place: Path, tmp_path: Path) -> None:
    old = make_backup(data, place)
    with open_store(data) as house:
        linden = house.patients.id_of_pseudonym(LINDEN.pseudonym)
        erasure.erase(house.store, erasure.plan_patient(house.store, linden), house.log)
    make_backup(data, place, NOW + timedelta(days=1))
    shutil.rmtree(data)
    assert restore(old, place, data, read_history(place, None)) == 1
    activate_restored(data, NOW)
    assert traces(data, linden, *NAMES) == []


def test_restore_failing_leaves_no_settings(data: Path, place: Path, tmp_path: Path) -> None:
    settings = tmp_path / "settings"
    settings.mkdir()
    for name in ("a", "b"):
        (settings / f"{name}.toml").write_text(f"{name} = 1")
    made = make_backup(data, place, settings_folder=settings)
    last = next(one for one in made.files if one.path.endswith("b.toml")).sha256
    (place / OBJECTS / last[:2] / last).write_text("b = 2")
    with pytest.raises(BackupMismatch):
        restore_backup(place, made, tmp_path / "new", tmp_path / "new settings")
    assert list((tmp_path / "new settings").iterdir()) == []


def test_prune_backups_without_list_deletes_nothing(data: Path, place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = make_backup(data, place)
    (place / BACKUPS).rename(place / "away")
    (place / BACKUPS).mkdir()
    assert prune_backups(place, 9, 24, NOW) == 0
    verify_backup(place, made)

    def refused(_: object) -> list[Path]:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "iterdir", refused)
    with pytest.raises(BackupUnreadable):
        prune_backups(place, 9, 24, NOW)
    verify_backup(place, made)


def test_create_backup_unreadable_file_is_reported_rest_included(
    data: Path, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = Path.open

    def refused(path: Path, *told: Any, **named: Any) -> Any:
        if path.name == "set_ups.json":
            raise PermissionError(13, "no", str(path))
        return real(path, *told, **named)

    monkeypatch.setattr(Path, "open", refused)
    with pytest.raises(BackupIncomplete, match=r"set_ups\.json"):
        make_backup(data, place)
    assert list_backups(place)[0].session_count == 2


def test_prune_backups_leaves_link_targets(data: Path, place: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    make_backups(data, place, 0, 40)
    mine.mkdir()
    for name in ("thesis.txt", "0" * 64):
        (mine / name).write_text("years of work")
    (place / OBJECTS / "zz").symlink_to(mine)
    (place / OBJECTS / "00").mkdir(exist_ok=True)
    (place / OBJECTS / "00" / "note.txt").write_text("mine too")
    assert prune_backups(place, 1, 0, NOW) == 1
    assert sorted(path.name for path in mine.iterdir()) == ["0" * 64, "thesis.txt"]
    assert (place / OBJECTS / "00" / "note.txt").exists()

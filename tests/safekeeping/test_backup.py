"""Everything comes back from a back-up, bit by bit, and nothing damaged does."""

from __future__ import annotations

import json
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from carpus.core.errors import BackupPlaceUnsuited, BackupUnequal, BackupUnreadable, OutputExists
from carpus.core.safekeeping import backup as module
from carpus.core.safekeeping.audit import AUDIT_FILE, AuditLog, read_audit
from carpus.core.safekeeping.backup import (
    BACKUPS,
    OBJECTS,
    back_up,
    backups,
    compare,
    is_due,
    last_backup,
    log_was_cut,
    plan_restore,
    put_in_place,
    read_backup,
    restore,
    thin_out,
)
from carpus.core.session.register import PatientRegister
from carpus.core.session.writer import SessionWriter
from tests.safekeeping.samples import LINDEN, T0, measure
from tests.session.samples import CAMERA, make_calibration, make_frame, make_header

NOW = datetime(2026, 11, 20, 18, 0, tzinfo=UTC)


@pytest.fixture
def data(tmp_path: Path) -> Path:
    folder = tmp_path / "data"
    with PatientRegister(folder) as register:
        linden = register.add(LINDEN)
        measure(register, linden, T0)
        measure(register, linden, T0 + timedelta(days=1))
    AuditLog(folder, "window").note("opened", "patient", linden)
    (folder / "set_ups.json").write_text("{}")
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    """All but the register, whose journal comes and goes."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and ".sqlite3" not in path.name and path.name != module.LAST_FILE
    }


def test_everything_is_restored_on_another_computer(data: Path, tmp_path: Path) -> None:
    settings = tmp_path / "settings"
    settings.mkdir()
    (settings / "preferences.toml").write_text("x = 1")
    with PatientRegister(data) as register:  # it runs
        made = back_up(data, tmp_path / "disk", software_version="1", settings_folder=settings, now=NOW)
        first = [entry.session_id for entry in register.sessions(register.patients()[0].patient_id)]
    assert (made.sessions, made.running, made.audit_chain) == (2, 0, read_audit(data).chain)
    new, new_settings = tmp_path / "new" / "carpus", tmp_path / "new settings"
    restore(tmp_path / "disk", made, new, settings_folder=new_settings)
    assert contents(new) == contents(data)
    assert (new_settings / "preferences.toml").read_text() == "x = 1"
    assert {path.stat().st_mode & 0o077 for path in new.rglob("*")} == {0}
    with PatientRegister(new) as register:
        (patient,) = register.patients()
        assert patient.entry == LINDEN
        assert [entry.session_id for entry in register.sessions(patient.patient_id)] == first
        assert not register.is_behind()
    with pytest.raises(OutputExists):
        restore(tmp_path / "disk", made, new)


def test_a_running_recording_is_left_out_and_said(data: Path, tmp_path: Path) -> None:
    path = data / "sessions" / "Linden-42" / "running.h5"
    with SessionWriter.create(path, make_header(), CAMERA, make_calibration()) as writer:
        writer.append(make_frame(0))
        (path.with_suffix(".carpusraw")).write_bytes(b"growing")
        made = back_up(data, tmp_path / "disk", software_version="1", now=NOW)
        assert made.running == 1
        assert not [one.path for one in made.files if "running" in one.path]
    last = last_backup(data)
    assert last is not None
    assert (last.sessions, last.missing, last.made) == (2, 1, NOW)


def test_the_same_content_is_stored_once(data: Path, tmp_path: Path) -> None:
    place = tmp_path / "disk"
    first = back_up(data, place, software_version="1", now=NOW)
    objects = {path: path.stat().st_mtime_ns for path in (place / OBJECTS).glob("*/*")}
    second = back_up(data, place, software_version="1", now=NOW + timedelta(days=1))
    assert [one.name for one in backups(place)] == [second.name, first.name]
    after = {path: path.stat().st_mtime_ns for path in (place / OBJECTS).glob("*/*")}
    kept = [path for path in objects if objects[path] == after.get(path)]
    assert len(after) <= len(objects) + 1
    assert len(kept) >= len(objects) - 1, "only the register is copied anew"


@pytest.mark.parametrize("place", [0, -1])
def test_a_flipped_bit_is_noticed(data: Path, tmp_path: Path, place: int) -> None:
    disk = tmp_path / "disk"
    made = back_up(data, disk, software_version="1", now=NOW)
    compare(disk, made)
    one = next(file for file in made.files if file.path.endswith(".h5"))
    content = disk / OBJECTS / one.sha256[:2] / one.sha256
    damaged = bytearray(content.read_bytes())
    damaged[place] ^= 1
    content.write_bytes(bytes(damaged))
    with pytest.raises(BackupUnequal):
        compare(disk, made)
    with pytest.raises(BackupUnequal):
        restore(disk, made, tmp_path / "new")
    assert not (tmp_path / "new").exists()
    with pytest.raises(BackupUnequal):
        back_up(data, disk, software_version="1", now=NOW + timedelta(days=1))
    assert [one.name for one in backups(disk)] == [made.name], "what could not be compared is no back-up"


def test_a_back_up_that_was_cut_short_is_none(data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def cut(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as broken:
        broken.setattr(module, "_compare", cut)
        with pytest.raises(KeyboardInterrupt):
            back_up(data, tmp_path / "disk", software_version="1", now=NOW)
    assert backups(tmp_path / "disk") == []
    assert last_backup(data) is None
    assert back_up(data, tmp_path / "disk", software_version="1", now=NOW).sessions == 2


@pytest.mark.parametrize("where", [".", "sessions/backup", ".."])
def test_a_place_in_or_around_the_data_is_refused(data: Path, where: str) -> None:
    with pytest.raises(BackupPlaceUnsuited):
        back_up(data, data / where, software_version="1")


def test_what_a_restore_changes_is_known_before_and_the_old_folder_is_kept(data: Path, tmp_path: Path) -> None:
    place = tmp_path / "disk"
    made = back_up(data, place, software_version="1", now=NOW)
    gone, changed = sorted((data / "sessions").rglob("*.h5"))
    gone.unlink()
    changed.write_bytes(b"changed")
    (data / "sessions" / "new.h5").write_bytes(b"new")
    plan = plan_restore(made, data)
    assert plan.added == (gone.relative_to(data).as_posix(),)
    assert plan.replaced == (changed.relative_to(data).as_posix(),)
    assert plan.lost == ("sessions/new.h5",)
    restore(place, made, tmp_path / "restored")
    old = put_in_place(tmp_path / "restored", data, NOW)
    assert (old / "sessions" / "new.h5").read_bytes() == b"new"
    assert gone.exists()
    assert plan_restore(made, data).replaced == ()


def test_the_newest_and_one_of_each_month_are_kept(data: Path, tmp_path: Path) -> None:
    place = tmp_path / "disk"
    for days in (0, 1, 2, 40, 41, 70, 900):
        (data / "set_ups.json").write_text(json.dumps({"day": days}))
        back_up(data, place, software_version="1", now=NOW - timedelta(days=days))
    assert thin_out(place, 2, 24, NOW) == 3
    left = [(NOW - one.made).days for one in backups(place)]
    assert left == [0, 1, 40, 70]
    for one in backups(place):
        compare(place, one)
    needed = {file.sha256 for one in backups(place) for file in one.files}
    assert {path.name for path in (place / OBJECTS).glob("*/*")} == needed


def test_a_newer_or_foreign_list_is_refused(data: Path, tmp_path: Path) -> None:
    place = tmp_path / "disk"
    path = place / BACKUPS / f"{back_up(data, place, software_version='1', now=NOW).name}.json"
    told = json.loads(path.read_text())
    for change in (
        {"format_version": 2},
        {"format": "x"},
        {"files": [["../../evil", "0" * 64, 1, 1]]},
        {"files": [["/etc/passwd", "0" * 64, 1, 1]]},
        {"files": [["a", "../../../etc/passwd", 1, 1]]},
        {"made": "yesterday"},
    ):
        path.write_text(json.dumps(told | change))
        with pytest.raises(BackupUnreadable):
            read_backup(path)
    assert thin_out(place, 0, 0, NOW) == 0, "nothing is taken away that an unread list may need"


def test_when_a_person_is_reminded(data: Path, tmp_path: Path) -> None:
    assert is_due(None, 3, NOW)
    back_up(data, tmp_path / "disk", software_version="1", now=NOW)
    last = last_backup(data)
    assert not is_due(last, 3, NOW + timedelta(days=3))
    assert is_due(last, 3, NOW + timedelta(days=3, minutes=1))


def test_the_log_is_part_of_it_and_must_go_on_from_there(data: Path, tmp_path: Path) -> None:
    log = AuditLog(data, "window")
    log.note("opened", "session", "1")
    assert not log_was_cut(data, read_audit(data))
    made = back_up(data, tmp_path / "disk", software_version="1", now=NOW)
    assert AUDIT_FILE in {one.path for one in made.files}
    log.note("opened", "session", "2")
    assert not log_was_cut(data, read_audit(data))
    lines = (data / AUDIT_FILE).read_bytes().splitlines(keepends=True)
    (data / AUDIT_FILE).write_bytes(lines[0])
    assert read_audit(data).is_whole
    assert log_was_cut(data, read_audit(data))


def test_two_of_one_second_are_two(data: Path, tmp_path: Path) -> None:
    for _ in range(2):
        back_up(data, tmp_path / "disk", software_version="1", now=NOW)
    assert len(backups(tmp_path / "disk")) == 2

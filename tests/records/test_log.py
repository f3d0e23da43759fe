"""The log of deeds: only ever added to, by many programs at once, without names; and what ``carpus log`` writes."""

from __future__ import annotations

import contextlib
import csv
import sqlite3
from pathlib import Path

import pytest
from sqlalchemy import delete, insert, select, update
from sqlalchemy.exc import DatabaseError

from carpus.core.model.errors import OutputNotWritable
from carpus.core.records.changes import fingerprint
from carpus.core.records.database import STORE_FILE
from carpus.core.records.log import AuditLogWriter, read_log
from carpus.core.records.schema import AUDIT_LOG
from carpus.core.records.store import Store
from tests.commands import Command
from tests.records.samples import LINDEN, T0, measure, open_store, traces


def test_log_entry_contains_no_name_or_id(tmp_path: Path) -> None:
    said = (" ", "Linden 42", "wr\udc80st", "x" * 65)
    with open_store(tmp_path) as house:
        for fact in ("/data/sessions/Linden-42/s.h5", "Ada", "x" * 65):
            with pytest.raises(ValueError):
                house.log.write_entry("opened", "patient", "", name=fact)
        assert read_log(house.store) == ()
        for identity in said:
            house.log.write_entry("recovered", "session", identity)
        assert len({one.subject for one in read_log(house.store)}) == len(said)
        assert traces(tmp_path, "Linden") == []


def test_log_command_prints_and_writes_table(tmp_path: Path, command: Command) -> None:
    with Store(tmp_path) as store:
        AuditLogWriter(store, "window", lambda: "AB").write_entry("backed_up", "everything", sessions=7)
    said = command("log", "--data-folder", tmp_path)
    assert said.code == 0
    assert all(word in said.out for word in ("AB", "backed_up", "sessions=7"))
    table = tmp_path / "log.csv"
    assert command("log", "--data-folder", tmp_path, "--output", table).code == 0
    with table.open(newline="", encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert (row["who"], row["did"], row["facts"]) == ("AB", "backed_up", "sessions=7")
    assert command("log", "--data-folder", tmp_path, "--output", table).code == 1


NOTHING_THERE = (
    "carpus: The folder contains no Carpus data: {}. Nothing was changed. "
    "Choose the folder that contains the patients. “carpus doctor” shows which data folder is used. (C-410)\n"
)


def test_reading_commands_work_in_read_only_folder(
    tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Or in a share that lets nobody delete: the reserve of 0.2.0 stays."""
    with open_store(tmp_path) as house:
        linden = house.patients.add(LINDEN)
        measure(house, linden, T0)
        house.log.write_entry("opened", "patient", linden)
    reserve, unlink = tmp_path / ".reserve", Path.unlink
    reserve.touch()
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*") if path.is_file()}

    def only_reads(folder: Path) -> None:
        raise OutputNotWritable(folder, "Read-only file system")

    def keep(path: Path, missing_ok: bool = False) -> None:
        if path == reserve:
            raise PermissionError(path)
        unlink(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", keep)
    log = command("log", "--data-folder", tmp_path)
    assert (log.code, "opened" in log.out) == (0, True)
    monkeypatch.setattr("carpus.core.records.store.make_private_folder", only_reads)
    log = command("log", "--data-folder", tmp_path)
    assert (log.code, "opened" in log.out) == (0, True)
    progress = command("progress", LINDEN.pseudonym, "--sessions", tmp_path)
    assert (progress.code, progress.err) == (0, "")
    assert {path: path.stat().st_mtime_ns for path in before} == before
    monkeypatch.undo()
    command("log", "--data-folder", tmp_path)
    assert not reserve.exists()


def test_log_command_creates_no_store(tmp_path: Path, command: Command) -> None:
    tmp_path.chmod(0o755)
    for words in (("log",), ("erase", "Linden 42"), ("backup", tmp_path.with_name("disk"))):
        done = command(*words, "--data-folder", tmp_path)
        assert (done.code, done.err) == (1, NOTHING_THERE.format(tmp_path))
    assert (list(tmp_path.iterdir()), tmp_path.stat().st_mode & 0o777) == ([], 0o755)


def test_read_log_skips_and_reports_damaged_entry(tmp_path: Path, command: Command) -> None:
    with open_store(tmp_path) as house:
        house.store.execute_local(insert(AUDIT_LOG).values(id="x", at_ns=0, facts="{"))
        house.log.write_entry("locked", "program")
    said = command("log", "--data-folder", tmp_path)
    assert (said.code, "     2  " in said.out, "left out" in said.err) == (0, True, True)


def test_log_entry_cannot_be_changed_or_deleted(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        house.log.get_initials = lambda: "AB"
        house.log.write_entry("opened", "session", "0" * 32)
        house.log.write_entry("erased", "patient", "1" * 32, files=3)
        before = read_log(house.store)
        mine = {"id": house.store.rows(select(AUDIT_LOG.c.id))[0].id, "at": "", "at_ns": 0, "facts": "{}"}
        again = insert(AUDIT_LOG).prefix_with("OR REPLACE").values(mine)
        for change in (update(AUDIT_LOG).values(who="XY"), delete(AUDIT_LOG), again):
            with pytest.raises(DatabaseError, match="only added to"):
                house.store.execute_local(change)
        assert read_log(house.store) == before
        assert [(one.number, one.initials, one.action, dict(one.facts)) for one in before] == [
            (1, "AB", "opened", {}), (2, "AB", "erased", {"files": 3}),
        ]  # fmt: skip
        assert before[0].subject == fingerprint("0" * 32)
    with contextlib.closing(sqlite3.connect(tmp_path / STORE_FILE)) as database:
        database.execute("DROP TRIGGER deed_is_kept")
        database.commit()
    with open_store(tmp_path) as house, pytest.raises(DatabaseError, match="only added to"):  # restored
        house.store.execute_local(delete(AUDIT_LOG))

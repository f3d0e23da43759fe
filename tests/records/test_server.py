"""A clinic's PostgreSQL: several computers on one store; the server gone, frozen, back; nothing twice, nothing
overwritten in silence; what computers had of their own goes there once. Against a real server that the tests start."""

from __future__ import annotations

import json
import shutil
import signal
import sqlite3
import time
import uuid
from contextlib import closing
from dataclasses import replace
from datetime import timedelta
from pathlib import Path

import pytest
from sqlalchemy import Engine, create_engine, inspect, select, text
from sqlalchemy.exc import DBAPIError
from sqlalchemy.pool import NullPool

from carpus.core.model.errors import (
    CarpusFault,
    ConcurrentChange,
    PatientListVersionUnknown,
    PseudonymNumbered,
    PseudonymTaken,
    ServerUnavailable,
    SettingsInvalid,
    SpooledSessionErased,
)
from carpus.core.records import erasure, local_store_import, schema, server, session_records
from carpus.core.records.backup import create_backup, list_backups
from carpus.core.records.changes import fingerprint
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.database import STORE_FILE
from carpus.core.records.log import read_log
from carpus.core.records.new_sessions import SessionIntake, recover_sessions
from carpus.core.records.restoring import LogHistory, activate_restored, restore
from carpus.core.records.schema import PATIENT, TABLES
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from tests.app.test_library import set_up
from tests.records.postgres import Cluster
from tests.records.samples import HERON, LINDEN, T0, fill, measure, open_store, record, strip_stored_fields, traces

GOLDEN = Path(__file__).with_name("golden") / "version-1.sqlite3"
VERSIONS = Path(schema.__file__).with_name("migrations") / "versions"


@pytest.fixture
def there(cluster: Cluster) -> str:
    """The url of a database with empty tables."""
    return cluster.new_database(f"c{uuid.uuid4().hex[:12]}", "model")


def engine_of(url: str) -> Engine:
    return create_engine(url.replace("postgresql", "postgresql+psycopg"), poolclass=NullPool)


def count(url: str, table: str) -> int:
    with engine_of(url).connect() as connection:
        return int(connection.execute(text(f"SELECT count(*) FROM {table} WHERE id != 'practice'")).scalar() or 0)


def test_server_shows_entries_on_other_computer_at_once(tmp_path: Path, cluster: Cluster) -> None:
    there, sessions = cluster.new_database("empty"), tmp_path / "share"
    sessions.mkdir()
    with (
        open_store(tmp_path / "a", there, sessions=sessions) as a,
        open_store(tmp_path / "b", there, sessions=sessions) as b,
    ):
        linden = a.patients.add(LINDEN)
        session_ids = fill(a, linden)
        assert (strip_stored_fields(b.patients.get(linden)), b.patients.get(linden).session_count) == (LINDEN, 3)
        assert b.names("erika MUSTER") == ["Linden 42"]
        assert b.index.get(session_ids[0]) == a.index.get(session_ids[0])
        assert b.files.scan().session_count == 0, "what one computer has looked at the other need not read"
        assert [one.action for one in read_log(b.store)] == ["opened"]
        with pytest.raises(PseudonymTaken):
            b.patients.add(Patient("LINDEN 42", "left"))
        erasure.erase(b.store, erasure.plan_patient(b.store, linden), b.log)
        assert a.names() == []
    for folder in (sessions, tmp_path / "b"):
        assert traces(folder, "Linden", "Erika", linden, session_ids[0]) == []
    assert [count(there, name) for name in TABLES if name != "deed"] == [0] * (len(TABLES) - 1)


def test_server_away_is_reported_and_sessions_listed_when_back(tmp_path: Path, cluster: Cluster, there: str) -> None:
    with closing(DataFolder(tmp_path, url=there)) as library:
        recover_sessions(library)
        linden = library.patients.add(LINDEN)
        cluster.stop()
        try:
            with pytest.raises(ServerUnavailable):
                library.patients.search()
            begin = time.monotonic()
            for _ in range(20):
                with pytest.raises(ServerUnavailable):
                    library.patients.search()
            assert time.monotonic() - begin < 1.0, "nobody waits for it again"
            assert library.store.is_server_away
            record(tmp_path / "sessions" / linden / "s.h5", "Linden 42", T0)
            record(tmp_path / "sessions" / uuid.uuid4().hex / "t.h5", "Typed 7", T0)
            with closing(DataFolder(tmp_path, url=there)) as started_now:
                assert [type(one) for one in recover_sessions(started_now)[1]] == [ServerUnavailable]
        finally:
            cluster.start()
        library.store.server.ping()  # type: ignore[union-attr]
        assert not library.store.is_server_away
        assert recover_sessions(library) == ([], [])
        assert {one.pseudonym: one.session_count for one in library.patients.search()} == {
            "Linden 42": 1, "Typed 7": 1,
        }  # fmt: skip
        assert strip_stored_fields(library.patients.get(linden)) == LINDEN


def test_server_away_typed_pseudonym_becomes_listed_patient(tmp_path: Path, there: str) -> None:
    with closing(DataFolder(tmp_path, url=there)) as library:
        linden = library.patients.add(LINDEN)
        typed = set_up(uuid.uuid4().hex, "linden 42")
        path = record(SessionIntake(library).new_path(typed), "linden 42", T0)
        session_id = SessionIntake(library).register(typed, path)
        assert library.session(session_id).header.subject_id == "linden 42", "reviewed at once"
        assert recover_sessions(library) == ([], [])
        assert [one.session_id for one in library.sessions(linden)] == [session_id]
        assert library.owner_id(session_id) == linden


def test_server_silent_is_left_after_seconds(
    tmp_path: Path, cluster: Cluster, there: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "STALL_TIMEOUT_S", 0.5)
    with open_store(tmp_path, there) as house:
        linden = house.patients.add(LINDEN)
        session_id = measure(house, linden, T0)
        cluster.signal(signal.SIGSTOP)
        try:
            with pytest.raises(ServerUnavailable):
                session_records.add_comment(house.store, session_id, "not kept", "AB")
        finally:
            cluster.signal(signal.SIGCONT)
        house.store.server.ping()  # type: ignore[union-attr]
        session_records.add_comment(house.store, session_id, "kept", "AB")
        assert session_records.read_comments(house.store, session_id) == ["kept"]
        cluster.signal(signal.SIGTERM, all_of_them=False)
        assert house.names() == ["Linden 42"], "a line that was cut since then is made anew, and nobody hears of it"


def test_server_log_cannot_be_changed(tmp_path: Path, there: str) -> None:
    with open_store(tmp_path / "a", there) as a:
        a.log.write_entry("locked", "program")
    for statement in ("UPDATE deed SET who = 'XY'", "DELETE FROM deed", "TRUNCATE deed"):
        with pytest.raises(DBAPIError, match="only added to"), engine_of(there).begin() as connection:
            connection.execute(text(statement))
    assert count(there, "deed") == 1


def test_server_newer_version_and_wrong_url_are_reported(tmp_path: Path, there: str) -> None:
    with engine_of(there).begin() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '99'"))
    with open_store(tmp_path, there) as house, pytest.raises(PatientListVersionUnknown):
        house.names()
    for url in ("postgresql://", "postgresql://a:b:c@host:port/x"):
        with pytest.raises((SettingsInvalid, ServerUnavailable)), open_store(tmp_path, url) as house:
            house.names()


def test_server_erasure_elsewhere_deletes_files_here(tmp_path: Path, there: str) -> None:
    with closing(DataFolder(tmp_path / "b", url=there)) as b:
        with open_store(tmp_path / "a", there) as a:
            linden = b.patients.add(LINDEN)
            path = b.session_list.new_path(linden, "Linden 42", "WRIST_FE", "right", T0)
            b.session_list.add(record(path, "Linden 42", T0), linden)
            erasure.erase(a.store, erasure.plan_patient(a.store, linden), a.log)
        assert path.exists(), "another computer's folder is nobody else's"
        assert [type(one) for one in recover_sessions(b)[1]] == [SpooledSessionErased]
        assert b.patients.search() == []
    assert traces(tmp_path, "Linden", "Erika", linden) == []


def test_create_backup_contains_rows_of_server(tmp_path: Path, there: str) -> None:
    with open_store(tmp_path / "data", there) as house:
        linden = house.patients.add(LINDEN)
        fill(house, linden)
        create_backup(tmp_path / "data", tmp_path / "place", copy_store=house.store.copy_to_memory)
        wanted = {name: house.store.rows(select(table).order_by(table.c.id)) for name, table in TABLES.items()}
    restore(list_backups(tmp_path / "place")[0], tmp_path / "place", tmp_path / "alone", LogHistory())
    activate_restored(tmp_path / "alone", T0)
    with open_store(tmp_path / "alone") as house:
        for name, table in TABLES.items():
            assert house.store.rows(select(table).order_by(table.c.id)) == wanted[name], name
        names = house.names()
        house.files.scan()
        assert house.names() == names


# --- what a computer has of its own -------------------------------------------------------------------------
def test_server_first_version_is_migrated(tmp_path: Path, cluster: Cluster) -> None:
    url = first_version(cluster)
    with engine_of(url).begin() as connection:
        connection.execute(text("INSERT INTO patient (id, folded, pseudonym) VALUES ('a', 'linden 42', 'Linden 42')"))
    with open_store(tmp_path, url) as house:
        assert house.names() == ["Linden 42"]
        house.patients.change(replace(LINDEN, patient_id="a", version=house.patients.get("a").version))
        columns = inspect(engine_of(url))
        for table in schema.METADATA.tables.values():
            assert {one["name"] for one in columns.get_columns(table.name)} == set(table.c.keys())
        assert "carpus_next_step" not in str(house.store.rows(select(text("proname FROM pg_proc"))))


def first_version(cluster: Cluster) -> str:
    """A new database as Carpus 0.2.0 made it."""
    url = cluster.new_database(f"c{uuid.uuid4().hex[:12]}")
    with engine_of(url).begin() as connection:
        connection.exec_driver_sql((VERSIONS / "1.postgresql.sql").read_text(encoding="utf-8"))
        connection.exec_driver_sql("CREATE TABLE alembic_version (version_num VARCHAR(32) NOT NULL PRIMARY KEY)")
        connection.exec_driver_sql("INSERT INTO alembic_version VALUES ('1')")
    return url


def copy_of(folder: Path, url: str, *waiting: list[list[object]]) -> None:
    """A computer's copy as 0.2.0 left it, with changes that wait for the server."""
    folder.mkdir()
    shutil.copyfile(GOLDEN, folder / STORE_FILE)
    with engine_of(url).connect() as connection:
        known = str(connection.execute(local_store_import._SERVER_ID_QUERY).scalar())
    with closing(sqlite3.connect(folder / STORE_FILE)) as copy, copy:
        copy.execute("INSERT OR REPLACE INTO own VALUES ('server', ?)", [known])
        for number, change in enumerate(waiting):
            copy.execute("INSERT INTO outbox (id, change) VALUES (?, ?)", [f"c{number}", json.dumps(change)])


def test_import_of_first_version_applies_queued_changes_once(tmp_path: Path, cluster: Cluster) -> None:
    told: list[CarpusFault] = []
    url = first_version(cluster)
    linden, heron, gone, other = (uuid.uuid4().hex for _ in range(4))
    with engine_of(url).begin() as connection:
        for values in (f"'{linden}', 'linden 42', 'Linden 42', 7", f"'{other}', 'heron 17', 'Heron 17', 7"):
            connection.execute(text(f"INSERT INTO patient (id, folded, pseudonym, version) VALUES ({values})"))
    named = {"folded": "heron 17", "pseudonym": "Heron 17", "search": "heron 17"}
    session = {"patient_id": linden, "path": "a/s.h5", "recording_id": "r", "exercise": "WRIST_FE", "hand": "right"}
    copy_of(
        tmp_path / "a", url,
        [["change", "patient", linden, {"note": "typed while away"}, 7, 11]],
        [["change", "patient", linden, {"note": "and once more"}, 19, 12]],
        [["new", "patient", heron, {**named, "added_s": 1.0}, 0, 13]],
        [["keep", "session", "s", session, 0, 14]],
        [["new", "comment", "c", {"session_id": "s", "text": "Less swelling.", "entered_ns": 1}, 0, 15]],
        [["change", "patient", other, {"note": "by a slower one"}, 6, 16]],
        [["new", "comment", "d", {"session_id": gone, "text": "of nobody"}, 0, 17]],
        [["join", "diagnosis", "x", {"words": "Mallet finger", "version": 1}, 0, 18]],
    )  # fmt: skip
    with open_store(tmp_path / "a", url, told.append) as a:
        assert sorted(a.names()) == ["Heron 17", "Heron 17 (2)", "Linden 42"]
        assert a.patients.get(heron).pseudonym == "Heron 17 (2)"
        assert (a.patients.get(linden).note, a.patients.get(linden).session_count) == ("typed while away", 1)
        assert a.patients.get(other).note == ""
        assert session_records.read_comments(a.store, "s") == ["Less swelling."]
    assert [type(one) for one in told] == [ConcurrentChange, PseudonymNumbered, ConcurrentChange, ConcurrentChange]
    assert list((tmp_path / "a").glob("records*.sqlite3*")) == [], "it would keep the names of who is erased elsewhere"
    assert count(url, "diagnosis") == 1
    copy_of(tmp_path / "b", url, [["new", "diagnosis", "y", {"words": "Boutonniere"}, 0, 1]])
    with open_store(tmp_path / "b", url) as b:  # the same identity of a change: it was delivered, and its answer lost
        b.names()
    assert (count(url, "diagnosis"), count(url, "patient")) == (1, 3)


def test_import_of_own_store_leaves_out_erased(tmp_path: Path, there: str) -> None:
    with open_store(tmp_path / "a") as a:
        linden, heron = a.patients.add(LINDEN), a.patients.add(HERON)
        fill(a, linden)
        session_records.add_comment(a.store, measure(a, heron, T0), "gone", "AB")
        measure(a, PRACTICE_PATIENT, T0 + timedelta(days=1))
        wanted = a.patients.get(linden)
    with open_store(tmp_path / "b", there) as b:
        b.log.write_entry("erased", "patient", heron)
    with open_store(tmp_path / "a", there) as a:
        assert a.patients.search() == [wanted]
        assert (count(there, "session"), count(there, "comment"), count(there, "made")) == (3, 3, 3)
        assert fingerprint(heron) in {one.subject for one in read_log(a.store)}
        assert a.files.scan().session_count == 1, "the practice patient's, by their files"
    (aside,) = (tmp_path / "a").glob("records*.sqlite3")
    assert "before-server" in aside.name


def test_import_of_damaged_copy_rescues_rows(tmp_path: Path, there: str) -> None:
    told: list[CarpusFault] = []
    with open_store(tmp_path) as house:
        for number in range(300):
            house.patients.add(Patient(f"Oak {number}", "left"))
    content = bytearray((tmp_path / STORE_FILE).read_bytes())
    content[40960:45056] = bytes(4096)
    (tmp_path / STORE_FILE).write_bytes(content)
    with Store(tmp_path, url=there, on_fault=told.append) as store:
        assert len(store.rows(select(PATIENT.c.id))) > 100
    assert len(list(tmp_path.glob("records.damaged-*.sqlite3"))) == 1

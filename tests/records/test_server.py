"""A clinic's PostgreSQL: two computers, each with its copy; the server gone, back, slow to agree; nothing lost, nothing
twice, nothing overwritten in silence. Against a real server that the tests start."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
import uuid
from datetime import timedelta
from pathlib import Path

import pytest
from sqlalchemy import Engine, create_engine, delete, func, insert, select, text, update
from sqlalchemy.exc import DBAPIError
from sqlalchemy.pool import NullPool

from carpus.core.errors import (
    CarpusFault,
    ChangedMeanwhile,
    ChangeRefused,
    PseudonymGiven,
    PseudonymTaken,
    RegisterUnreadable,
    ServerGone,
)
from carpus.core.records import changes, erasure, of_clinic, of_sessions, server
from carpus.core.records.changes import PRACTICE, Change, RowChange, dropped, new
from carpus.core.records.kept_sets import keep_sets
from carpus.core.records.log import read_log
from carpus.core.records.schema import COMMENT, DEED, OUTBOX, OWN, PATIENT, SESSION
from carpus.core.records.server import Server
from carpus.core.records.set_up import USUAL_SETS
from carpus.core.records.values import PatientEntry, Rebuilt
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.report_form import Letterhead, ReportForm
from tests.records.postgres import Cluster, binaries
from tests.records.samples import (
    HERON,
    LINDEN,
    LONG_S,
    T0,
    fill,
    measure,
    opened,
    record,
    settled,
    shared,
    traces,
    until,
    waiting,
)
from tests.torture.wire import Wire


@pytest.fixture
def there(cluster: Cluster, monkeypatch: pytest.MonkeyPatch) -> str:
    """The url of a database with empty tables, at which computers look often."""
    monkeypatch.setattr(server, "LOOK_S", 0.4)
    monkeypatch.setattr(server, "RETRY_S", 0.4)
    return cluster.new_database(f"c{uuid.uuid4().hex[:12]}", "model")


def engine_of(url: str) -> Engine:
    return create_engine(url.replace("postgresql", "postgresql+psycopg"), poolclass=NullPool)


def count(url: str, table: str) -> int:
    with engine_of(url).connect() as connection:
        return int(connection.execute(text(f"SELECT count(*) FROM {table}")).scalar() or 0)


def test_what_one_computer_enters_the_other_has(tmp_path: Path, cluster: Cluster) -> None:
    there, sessions = cluster.new_database("empty"), tmp_path / "share"
    sessions.mkdir()
    with opened(tmp_path / "a", there, sessions=sessions) as a, opened(tmp_path / "b", there, sessions=sessions) as b:
        linden = a.patients.add(LINDEN)
        session_id = measure(a, linden, T0)
        measure(a, PRACTICE, T0)
        of_sessions.add_comment(a.store, session_id, "Less swelling.", "AB")
        until(lambda: bool(b.store.rows(select(COMMENT))))
        assert (b.patients.one(linden).entry, b.patients.one(linden).session_count) == (LINDEN, 1)
        assert b.index.one(session_id) == a.index.one(session_id)
        assert b.index.one(session_id).path.exists()
        assert b.files.take_in().sessions == 1, "the practice patient's, which is of nobody"
        assert len(b.index.of_patient(linden)) == 1
        settled(a)
        assert count(there, "patient") == count(there, "session") == 1, "of the practice patient nothing is sent"
        erasure.erase(a.store, erasure.plan_patient(a.store, linden), a.log)
        until(lambda: not b.store.rows(select(SESSION.c.id).where(SESSION.c.id == session_id)))
        assert b.names() == []
        assert count(there, "patient") == count(there, "session") == count(there, "comment") == 0
    assert traces(tmp_path / "a", "Linden", linden, session_id) == []


def test_all_that_people_write_is_on_every_computer(tmp_path: Path, there: str) -> None:
    with opened(tmp_path / "a", there) as a:
        fill(a, a.patients.add(LINDEN))
        keep_sets(a.store, USUAL_SETS, ())
        of_clinic.keep_form(a.store, ReportForm(Letterhead("Hand clinic"), "letter"), ReportForm())
        of_clinic.note_backup(a.store, T0, "/backups", 3, 1000)
        settled(a)
        wanted = shared(a)
    assert [name for name, rows in wanted.items() if not rows] == []
    with opened(tmp_path / "b", there) as b:
        settled(b)
        assert shared(b) == wanted


def test_the_practice_patient_s_sessions_are_of_no_server_wherever_they_lie(tmp_path: Path, there: str) -> None:
    share = tmp_path / "share"
    share.mkdir()
    with opened(tmp_path / "a", there, sessions=share) as a, opened(tmp_path / "b", there, sessions=share) as b:
        session_id = measure(a, PRACTICE, T0)
        path = a.index.one(session_id).path
        path.rename(share / "elsewhere.h5")
        assert b.files.take_in() == Rebuilt(1, 0, ())
        assert (b.index.owner(session_id), b.names()) == (PRACTICE, [])
        theirs = {"path": "elsewhere.h5", "recording_id": session_id, "patient_id": None}
        a.patients.add(LINDEN)
        b.store._server._send("x", [new(SESSION, session_id, **theirs)])  # type: ignore[union-attr]
        settled(b)
        until(lambda: b.names() == ["Linden 42"])
        assert a.index.owner(session_id) == b.index.owner(session_id) == PRACTICE, "whatever a server says of it"


def test_closing_waits_for_no_server_that_is_frozen(tmp_path: Path, cluster: Cluster, there: str) -> None:
    wire = Wire(cluster.port)
    with opened(tmp_path, there.replace(str(cluster.port), str(wire.port))) as house:
        settled(house)
        server = house.store._server
        wire.answers_come = False
        house.patients.add(LINDEN)
        house.store.close()
        assert not server._thread.is_alive()
    wire.close()


def test_what_a_broken_line_makes_the_library_say_is_on_no_stderr() -> None:
    code = (
        "import logging, carpus.core.records.server\n"
        "logging.getLogger('sqlalchemy.pool.impl.QueuePool').error('Error closing cursor')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr == ""


def test_two_people_change_one_thing_and_the_second_is_told(tmp_path: Path, there: str) -> None:
    with opened(tmp_path / "a", there) as a, opened(tmp_path / "b", there) as b:
        linden = a.patients.add(LINDEN)
        session_id = measure(a, linden, T0)
        settled(a)
        until(lambda: bool(b.store.rows(select(SESSION.c.id).where(SESSION.c.id == session_id))))
        seen = b.patients.one(linden).version
        assert seen == a.patients.one(linden).version, "both have it before anybody changes it"
        a.patients.change(linden, PatientEntry("Linden 42", "right", note="mine"), seen)
        with pytest.raises(ChangedMeanwhile):
            b.patients.change(linden, PatientEntry("Linden 42", "right", note="yours"), seen)
        assert b.patients.one(linden).entry.note == "mine", "the copy has what holds"
        of_sessions.keep_choices(a.store, session_id, RepetitionChoices({0: "a"}), 0)
        with pytest.raises(ChangedMeanwhile):
            of_sessions.keep_choices(b.store, session_id, RepetitionChoices({1: "b"}), 0)
        assert of_sessions.choices(b.store, session_id)[0].left_out == {0: "a"}
        until(lambda: bool(b.patients.called("Linden 42")))
        with pytest.raises(PseudonymTaken):
            b.patients.add(PatientEntry("LINDEN 42", "left"))


def test_what_was_changed_twice_while_away_overwrites_nobody(tmp_path: Path, there: str) -> None:
    """The second change was made from what the first one left, which nobody else has ever seen."""
    told: list[CarpusFault] = []
    with opened(tmp_path / "a", there) as a, opened(tmp_path / "b", there) as b:
        linden = a.patients.add(LINDEN)
        until(lambda: b.names() == ["Linden 42"])
        settled(a)
        a.store.close()
        with opened(tmp_path / "a") as away:
            for note in ("first", "second"):
                version = away.patients.one(linden).version
                away.patients.change(linden, PatientEntry("Linden 42", "right", note=note), version)
        b.patients.change(linden, PatientEntry("Linden 42", "right", note="yours"), b.patients.one(linden).version)
        settled(b)
        with opened(tmp_path / "a", there, told.append) as back:
            until(lambda: len(told) == 2)
            until(lambda: not back.store.rows(select(OUTBOX)))
            assert back.patients.one(linden).entry.note == b.patients.one(linden).entry.note == "yours"
    assert [type(one) for one in told] == [ChangedMeanwhile, ChangedMeanwhile]


def test_what_was_refused_as_the_program_ended_is_told_at_the_next_start(tmp_path: Path, there: str) -> None:
    told: list[CarpusFault] = []
    with opened(tmp_path, there) as house:
        measure(house, house.patients.add(LINDEN), T0)
        settled(house)
        house.store.close()
    with opened(tmp_path) as house:
        house.patients.add(HERON)
        house.store.own(update(OUTBOX).values(refused="ChangedMeanwhile"))
    with opened(tmp_path, there, told.append) as house:
        until(lambda: not house.store.rows(select(OUTBOX)))
    assert [(type(one), one.subject) for one in told] == [(ChangedMeanwhile, "patient")]


def test_a_server_that_falls_silent_while_it_is_read_holds_up_nobody(
    tmp_path: Path, cluster: Cluster, there: str
) -> None:
    wire = Wire(cluster.port)
    with opened(tmp_path, there.replace(str(cluster.port), str(wire.port))) as house:
        session_id = measure(house, house.patients.add(LINDEN), T0)
        settled(house)
        wire.answers_come = False
        begin = time.monotonic()
        for number in range(30):
            of_sessions.add_comment(house.store, session_id, str(number), "AB")
            time.sleep(0.1)
        for _ in range(3):
            house.patients.change(house.patients.called("Linden 42"), LINDEN, house.patients.listed()[0].version)
        assert time.monotonic() - begin < LONG_S, "one waits for the server's word, and nobody after that"
        wire.cut()
        wire.answers_come = True
        settled(house)
    wire.close()
    assert count(there, "comment") == 30


def test_measuring_never_waits_and_what_is_new_arrives_once(tmp_path: Path, cluster: Cluster, there: str) -> None:
    told_a: list[CarpusFault] = []
    told_b: list[CarpusFault] = []
    with opened(tmp_path / "a", there, told_a.append) as a, opened(tmp_path / "b", there, told_b.append) as b:
        linden = a.patients.add(LINDEN)
        settled(a)
        until(lambda: b.names() == ["Linden 42"])
        cluster.stop()
        try:
            until(lambda: a.store.is_behind and b.store.is_behind)
            session_id = measure(a, linden, T0)
            for number in range(20):
                of_sessions.add_comment(a.store, session_id, str(number), "AB")
            a.patients.change(linden, PatientEntry("Linden 42", "right", note="mine"), a.patients.one(linden).version)
            b.patients.change(linden, PatientEntry("Linden 42", "right", note="yours"), b.patients.one(linden).version)
            heron_a, heron_b = a.patients.add(HERON), b.patients.add(HERON)
            measure(b, heron_b, T0)
            a.log.note("opened", "session", session_id)
            assert b.names() == ["Heron 17", "Linden 42"], "patients as last known, with what is new here"
            assert waiting(a) == 24
            assert [type(one) for one in told_a].count(ServerGone) == 1, "told once, not at every try"
        finally:
            cluster.start()
        settled(a)
        settled(b)
        until(lambda: len(a.names()) == len(b.names()) == 3)
        assert sorted(a.names()) == sorted(b.names()) == ["Heron 17", "Heron 17 (2)", "Linden 42"]
        assert any(isinstance(one, PseudonymGiven) for one in told_a + told_b), "told, and nothing of it lost"
        assert any(isinstance(one, ChangedMeanwhile) for one in told_a + told_b)
        until(lambda: a.patients.one(linden).entry == b.patients.one(linden).entry)
        assert a.patients.one(heron_a).session_count + a.patients.one(heron_b).session_count == 1
        assert [one.text for one in of_sessions.comments(b.store, session_id)] == [str(n) for n in range(20)]
        assert [one.did for one in read_log(b.store)] == ["opened"], "the log is read of the server"


def test_a_change_whose_answer_is_lost_is_made_once(
    tmp_path: Path, there: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The connection breaks right after the server has taken it: it is sent again, and there once."""
    real, broken = Server._send, list[str]()

    def send(self: Server, change_id: str, change: object) -> None:
        real(self, change_id, change)  # type: ignore[arg-type]
        if change_id not in broken:
            broken.append(change_id)
            raise _cut()

    with opened(tmp_path / "a", there) as a:
        session_id = measure(a, a.patients.add(LINDEN), T0)
        settled(a)
        monkeypatch.setattr(Server, "_send", send)
        for number in range(2):
            of_sessions.add_comment(a.store, session_id, str(number), "AB")
        a.log.note("opened", "session", session_id)
        until(lambda: waiting(a) == 0)
        assert len(broken) == 3
    assert (count(there, "comment"), count(there, "deed")) == (2, 1)


def test_what_is_laid_out_while_a_forgotten_change_is_sent_arrives_too(
    tmp_path: Path, there: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The new change gets the number in the outbox that the forgotten one had, and is another all the same."""
    real, sent = Server._send, list[str]()
    with opened(tmp_path, there) as house:
        session_id = measure(house, house.patients.add(LINDEN), T0)
        settled(house)

        def send(self: Server, change_id: str, change: Change) -> None:
            real(self, change_id, change)
            sent.append(change_id)
            if len(sent) == 1:
                house.store.forget_waiting([row.id for row in change])
                of_sessions.add_comment(house.store, session_id, "second", "AB")

        monkeypatch.setattr(Server, "_send", send)
        of_sessions.add_comment(house.store, session_id, "first", "AB")
        settled(house)
        until(lambda: len(sent) == 2)
    assert count(there, "comment") == 2


def _cut() -> DBAPIError:
    from sqlalchemy.exc import OperationalError

    return OperationalError("", {}, Exception("server closed the connection unexpectedly"))


def test_a_computer_that_joins_brings_what_it_has(tmp_path: Path, there: str) -> None:
    with opened(tmp_path / "a") as a:
        linden = a.patients.add(LINDEN)
        session_id = measure(a, linden, T0)
        of_sessions.add_comment(a.store, measure(a, PRACTICE, T0), "of nobody", "")
        of_sessions.add_comment(a.store, session_id, "before", "AB")
        a.log.note("opened", "session", session_id)
    with opened(tmp_path / "b") as b:
        b.patients.add(HERON)
    with opened(tmp_path / "a", there) as a, opened(tmp_path / "b", there) as b:
        until(lambda: sorted(a.names()) == sorted(b.names()) == ["Heron 17", "Linden 42"])
        until(lambda: [one.text for one in of_sessions.comments(b.store, session_id)] == ["before"])
        settled(a)
        assert count(there, "deed") == 1
        assert b.patients.one(linden).session_count == 1


def test_a_new_computer_takes_no_session_of_the_share_for_its_own(tmp_path: Path, there: str) -> None:
    share = tmp_path / "share"
    share.mkdir()
    with opened(tmp_path / "a", there, sessions=share) as a:
        linden = a.patients.add(LINDEN)
        session_id = measure(a, linden, T0)
        settled(a)
    with opened(tmp_path / "b", "postgresql://127.0.0.1:1/nowhere", sessions=share) as b:
        assert b.files.take_in() == Rebuilt(0, 0, ()), "the server may know whose it is"
        heron = b.patients.add(HERON)
        record(b.index.new_path(heron, "Heron 17", "WRIST_FE", "left", T0), "Heron 17", T0)
        assert b.files.take_in() == Rebuilt(1, 0, ())
    with opened(tmp_path / "b", there, sessions=share) as b:
        b.files.take_in()
        settled(b)
        assert sorted(b.names()) == ["Heron 17", "Linden 42"]
        assert b.index.owner(session_id) == linden
        assert count(there, "patient") == count(there, "session") == 2


def test_of_what_a_computer_brings_only_a_name_that_is_taken_gets_a_number(tmp_path: Path, there: str) -> None:
    told: list[CarpusFault] = []
    for name in ("a", "b"):
        with opened(tmp_path / name) as house:
            linden, own = house.patients.add(LINDEN), house.patients.add(PatientEntry(f"Oak {name}", "left"))
            record(house.store.sessions_folder / "s.h5", f"Oak {name}", T0)
            house.files.take_in()
            of_sessions.add_comment(house.store, measure(house, linden, T0), name, "AB")
            assert house.patients.one(own).session_count == 1
        with opened(tmp_path / name, there, told.append) as house:
            settled(house)
    with opened(tmp_path / "c", there) as house:
        until(lambda: len(house.names()) == 4)
        assert sorted(house.names()) == ["Linden 42", "Linden 42 (2)", "Oak a", "Oak b"]
        assert {one.session_count for one in house.patients.listed()} == {1}
        assert sorted(row.text for row in house.store.rows(select(COMMENT))) == ["a", "b"]
    assert [type(one) for one in told] == [PseudonymGiven]


def test_a_copy_that_joins_again_brings_back_nobody_who_was_erased(tmp_path: Path, there: str) -> None:
    with opened(tmp_path / "a", there) as a:
        linden = a.patients.add(LINDEN)
        of_sessions.add_comment(a.store, measure(a, linden, T0), "before", "AB")
        settled(a)
        a.store.close()
    shutil.copytree(tmp_path / "a", tmp_path / "old")
    with opened(tmp_path / "old") as old:
        old.store.own(delete(OWN))
    with opened(tmp_path / "a", there) as a:
        erasure.erase(a.store, erasure.plan_patient(a.store, linden), a.log)
        settled(a)
    with opened(tmp_path / "old", there) as old:
        old.patients.add(HERON)
        until(lambda: old.names() == ["Heron 17"])
        settled(old)
    assert (count(there, "patient"), count(there, "session"), count(there, "comment")) == (1, 0, 0)


def test_the_log_of_the_server_is_only_added_to_as_well(tmp_path: Path, there: str) -> None:
    with opened(tmp_path / "a", there) as a:
        a.log.note("locked", "program")
        settled(a)
    engine = engine_of(there)
    for statement in ("UPDATE deed SET who = 'XY'", "DELETE FROM deed", "TRUNCATE deed"):
        with pytest.raises(DBAPIError, match="only added to"), engine.begin() as connection:
            connection.execute(text(statement))
    with engine.connect() as connection:
        assert connection.execute(select(func.count()).select_from(DEED)).scalar() == 1
        assert connection.execute(select(func.count()).select_from(PATIENT)).scalar() == 0


def test_no_server_at_all_is_told_and_holds_up_nothing(tmp_path: Path) -> None:
    told: list[CarpusFault] = []
    with opened(tmp_path, "postgresql://carpus@127.0.0.1:9/carpus", told.append) as house:
        house.patients.add(LINDEN)
        until(lambda: bool(told))
        assert isinstance(told[0], ServerGone)
        assert house.names() == ["Linden 42"]


def test_erased_while_the_server_is_away_leaves_no_name_in_what_waits(
    tmp_path: Path, cluster: Cluster, there: str
) -> None:
    with opened(tmp_path, there) as house:
        settled(house)
        cluster.stop()
        try:
            linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
            session_id, given = measure(house, linden, T0), measure(house, linden, T0 + timedelta(days=1))
            house.index.move(given, heron)
            house.index.one(given).path.with_suffix(".carpusraw").unlink()
            of_sessions.add_comment(house.store, session_id, "Linden 42 is well", "AB")
            erasure.erase(house.store, erasure.plan_patient(house.store, linden), house.log)
            outbox = " ".join(row.change for row in house.store.rows(select(OUTBOX)))
            assert "Erika Mustermann" not in outbox
            assert "is well" not in outbox
            assert traces(tmp_path, "Erika Mustermann", "is well") == []
        finally:
            cluster.start()
        settled(house)
        assert house.index.owner(given) == heron
        assert (count(there, "patient"), count(there, "session")) == (1, 1)
        until(lambda: traces(tmp_path, session_id) == [])


def test_what_the_server_may_not_write_waits(tmp_path: Path, there: str) -> None:
    name = there.rsplit("/", 1)[1]
    with opened(tmp_path, there) as house:
        session_id = measure(house, house.patients.add(LINDEN), T0)
        settled(house)
    engine = engine_of(there)
    for only_read in (True, False):
        with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
            connection.execute(text("SET default_transaction_read_only = off"))
            connection.execute(text(f"ALTER DATABASE {name} SET default_transaction_read_only = {only_read}"))
        with opened(tmp_path, there) as house:
            until(lambda: house.store._server is not None and house.store._server._has_looked)
            if only_read:
                of_sessions.add_comment(house.store, session_id, "a\0b \ud800", "AB")
                until(lambda: house.store.is_behind)
            else:
                settled(house)
            assert [one.text for one in of_sessions.comments(house.store, session_id)] == ["a\ufffdb ?"]
    assert count(there, "comment") == 1


def test_what_is_erased_once_more_goes_everywhere_once_more(tmp_path: Path, there: str) -> None:
    row = new(PATIENT, uuid.uuid4().hex, folded="linden 42", pseudonym="Linden 42")
    with opened(tmp_path / "a", there) as a, opened(tmp_path / "b", there) as b:
        for _ in range(2):
            a.store.do([row])
            until(lambda: b.names() == ["Linden 42"])
            a.store.do([dropped(PATIENT, row.id)])
            until(lambda: b.names() == [])


def test_a_server_that_is_put_back_from_a_dump_gets_what_it_lacks(tmp_path: Path, there: str) -> None:
    dump = str(tmp_path / "dump")
    with opened(tmp_path / "a", there) as a:
        a.patients.add(LINDEN)
        settled(a)
        subprocess.run([binaries() / "pg_dump", "--format=custom", "--file", dump, there], check=True)
        a.patients.add(HERON)
        settled(a)
    back = ["--clean", "--single-transaction", "--dbname", there, dump]
    subprocess.run([binaries() / "pg_restore", *back], check=True)
    with opened(tmp_path / "b", there) as b, opened(tmp_path / "a", there) as a:
        for number in range(9):  # more than was lost: the number of the last change says nothing
            b.patients.add(PatientEntry(f"Oak {number}", "left"))
        until(lambda: len(a.names()) == len(b.names()) == 11)


def test_a_server_of_a_newer_carpus_is_told_also_where_it_is_known(tmp_path: Path, there: str) -> None:
    told: list[CarpusFault] = []
    with opened(tmp_path, there) as house:
        settled(house)
    with engine_of(there).begin() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '99'"))
    with opened(tmp_path, there, told.append):
        until(lambda: bool(told))
    assert isinstance(told[0], RegisterUnreadable)


def test_a_change_that_can_never_be_made_lets_the_others_pass(
    tmp_path: Path, there: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "RETRY_S", 0.0)
    told: list[CarpusFault] = []
    with opened(tmp_path, there, told.append) as house:
        settled(house)
        lost = RowChange("keep", "of a newer Carpus", "x", {})
        house.store.own(insert(OUTBOX).values(id="y", change=changes.told([lost])))
        house.patients.add(LINDEN)
        until(lambda: any(isinstance(one, ChangeRefused) for one in told))
        settled(house)
    assert count(there, "patient") == 1


def test_what_others_erased_goes_here_with_its_files(tmp_path: Path, there: str) -> None:
    with opened(tmp_path / "a", there) as a, opened(tmp_path / "b", there) as b:
        linden = b.patients.add(LINDEN)
        session_id = measure(b, linden, T0)
        of_clinic.keep_place(b.store, "report", "/papers/Erika Mustermann")
        (tmp_path / "b" / "records.damaged-20261009-120000.sqlite3").write_bytes(b"Linden 42")
        until(lambda: bool(a.store.rows(select(SESSION.c.id).where(SESSION.c.id == session_id))))
        settled(a)
        erasure.erase(a.store, erasure.plan_patient(a.store, linden), a.log)
        until(lambda: traces(tmp_path / "b", "Linden", "Erika", linden) == [])
        assert b.files.take_in().patients_added == 0

"""A clinic's PostgreSQL behind the copies of its computers: own changes are delivered, those of others fetched.

Everything is read of this computer's own copy, and every change is made there first and laid into an outbox in the same
transaction; so nothing ever waits for a server that is gone. A change has an identity, which the server takes down in
the transaction that makes it: it arrives once, however often it is sent. One that the server refuses, since somebody
else was quicker, is told; the copy then has what the server has.
"""

from __future__ import annotations

import logging
import pickle
import socket
import tempfile
import threading
import time
import uuid
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from sqlalchemy import Connection, Row, Select, Table, create_engine, delete, event, func, select, text, update
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.exc import DataError, DBAPIError, IntegrityError, InterfaceError, OperationalError

from carpus.core.errors import CarpusFault, ChangedMeanwhile, ChangeRefused, PseudonymGiven, PseudonymTaken, ServerGone
from carpus.core.records.changes import PRACTICE, Change, RowChange, is_practice, joining, lay_out, make, read_back
from carpus.core.records.database import Database, up_to_date
from carpus.core.records.schema import COPIED, DEED, DELIVERED, OUTBOX, OWN, PATIENT, SEEN, SESSION, SHARED, TOMBSTONE

LOOK_S, RETRY_S, KEEP_DELIVERED_S = 2.0, 5.0, 90 * 86_400.0
AT_ONCE, PAGE = 500, 5000
IN_MEMORY_BYTES = 64 << 20
MOST_NAMESAKES = 99
logging.getLogger("sqlalchemy.pool").addHandler(logging.NullHandler())  # what a broken line says is told as a fault
_OPTIONS = {
    "connect_timeout": 3, "tcp_user_timeout": 4000, "keepalives_idle": 5, "keepalives_interval": 5,
    "keepalives_count": 3, "application_name": "carpus",
    "options": "-c statement_timeout=60000 -c lock_timeout=5000",
}  # fmt: skip
PATIENCE_S, MOST_CONNECTING_S = 2.0, 30.0
"""How long a program that ends waits for what is on its way; and, once every line is cut, for a connection that is
being made to each of the server's addresses."""
MOST_TRIES = 5
"""Of a change at which the server fails again and again, before it is refused: what comes after it would wait."""
_WAITS = {"42501", "25006"}
"""No right, read-only: as PostgreSQL calls what waits until somebody has seen to it."""
_WHICH = text(
    "SELECT system_identifier || '/' || current_database() || '/' || coalesce(to_regclass('deed')::oid::text, '')"
    " FROM pg_control_system()"
)
_UNIQUE = {"patient": "folded", "session": "path"}


class Server:
    """Delivers and fetches in a thread of its own; from there ``tell`` is called, and ``let_go`` with what is gone."""

    def __init__(
        self, url: str, copy: Database, tell: Callable[[CarpusFault], None], let_go: Callable[[Collection[str]], None]
    ) -> None:
        plain = url.removeprefix("postgresql+psycopg").removeprefix("postgresql").removeprefix("postgres")
        self._engine = create_engine(f"postgresql+psycopg{plain}", connect_args=_OPTIONS, pool_size=1, max_overflow=1)
        self._lines: list[Any] = []
        event.listen(self._engine, "connect", self._connected)
        self._name = self._engine.url.render_as_string(hide_password=True).split("@")[-1]
        self._copy, self._tell, self._let_go = copy, tell, let_go
        self._fetched, self._known, self._tries = -1, "", Counter[str]()
        self._work, self._ends = threading.Event(), threading.Event()
        self._rounds = threading.Condition()
        self._round, self._refused = 0, dict[str, CarpusFault]()
        self.is_there = False
        """Whether it answered last time."""
        self._answers = True
        """Whether nobody has waited for it in vain since then."""
        self._has_looked = False
        self._leaves_traces = False
        """Whether something was taken out of the copy of which its write-ahead log still tells."""
        self._thread = threading.Thread(target=self._run, name="records", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Ends the thread; what is not delivered waits for the next start. A server that keeps it waiting is left: what
        still runs when Python ends pulls the program down with it."""
        self._ends.set()
        self._work.set()
        self._thread.join(PATIENCE_S)
        for one in self._lines:
            _cut(one)
        self._thread.join(MOST_CONNECTING_S)
        if not self._thread.is_alive():
            self._engine.dispose()

    def _connected(self, line: Any, _: object) -> None:
        self._lines = [*(one for one in self._lines if not one.closed), line]

    def wake(self) -> None:
        """There is something to deliver."""
        self._work.set()

    def delivered(self, change_id: str, most_s: float) -> None:
        """Wait for a change to arrive, if the server is there; raises what the server had against it."""
        end = time.monotonic() + most_s
        with self._rounds:
            while self.is_there and self._answers and time.monotonic() < end:
                if change_id in self._refused:
                    raise self._refused.pop(change_id)
                with self._copy.reading() as connection:
                    if connection.execute(select(OUTBOX.c.id).where(OUTBOX.c.id == change_id)).first() is None:
                        return
                self._work.set()
                self._rounds.wait(0.05)
            self._answers = self._answers and time.monotonic() < end

    def has_fetched(self, most_s: float) -> bool:
        """Whether the copy has what the server had when this program began, or since; waits for the first look."""
        with self._rounds:
            self._rounds.wait_for(lambda: self._round > 0, most_s)
            return self.is_there

    def settled(self, most_s: float) -> bool:
        """Wait until nothing is on its way, if the server is there; whether it is so."""
        end = time.monotonic() + most_s
        with self._rounds:
            while time.monotonic() < end and (self.is_there or not self._has_looked):
                with self._copy.reading() as connection:
                    if self.is_there and connection.execute(select(OUTBOX.c.id)).first() is None:
                        return True
                self._work.set()
                self._rounds.wait(0.05)
        return False

    def rows(self, query: Select[Any]) -> Sequence[Row[Any]]:
        """What is stored there. Raises :class:`ServerGone`."""
        try:
            with self._engine.connect() as connection:
                return connection.execute(query).all()
        except DBAPIError as cause:
            raise ServerGone(self._name, _said(cause)) from cause

    def _run(self) -> None:
        pause = 0.0
        while not self._ends.is_set():
            self._work.wait(pause)
            self._work.clear()
            pause = LOOK_S
            try:
                if not self._has_looked:
                    self._tell_late()
                self._go_round()
                self._has_looked = self.is_there = self._answers = True
            except Exception as cause:  # whatever a server says, the copy goes on
                pause = RETRY_S
                if (self.is_there or not self._has_looked) and not self._ends.is_set():
                    said = cause if isinstance(cause, CarpusFault) else ServerGone(self._name, _said(cause))
                    self._tell(said)
                self._has_looked, self.is_there = True, False
                if not self._ends.is_set():
                    self._ends.wait(0.5)
            with self._rounds:
                self._round += 1
                self._rounds.notify_all()

    def _go_round(self) -> None:
        self._join()
        while self._deliver():
            pass
        self._fetch()
        if self._leaves_traces:
            self._leaves_traces = not self._copy.leave_no_trace(waits=False)

    # --- to the server ------------------------------------------------------------------------------------
    def _join(self) -> None:
        """The first time that a program meets a server its tables are made, or brought to this version; the first time
        that this copy meets it, what is here goes there. One put back from a dump, whose tables were made anew, is
        another server: its steps are of before, and what it lacks goes there again."""
        with self._engine.begin() as there:
            known = str(there.execute(_WHICH).scalar())
            if known == self._known:
                return
            there.execute(text("SELECT pg_advisory_xact_lock(2025)"))
            up_to_date(there, self._name)
            known = str(there.execute(_WHICH).scalar())
        self._known, self._fetched = known, -1
        with self._copy.reading() as connection:
            if connection.execute(select(OWN.c.value).where(OWN.c.name == "server")).scalar() == known:
                return
        with self._copy.writing() as connection:
            for table in SHARED.values():
                for rows in connection.execute(select(table)).mappings().partitions(AT_ONCE):
                    mine = [row for row in joining(table, rows) if not is_practice(connection, row)]
                    if mine:
                        lay_out(connection, mine, uuid.uuid4().hex)
            for key, value in (("server", known), ("step", "0")):
                made = sqlite.insert(OWN).values(name=key, value=value)
                connection.execute(made.on_conflict_do_update(index_elements=["name"], set_={"value": value}))

    def _deliver(self) -> bool:
        """Send the changes that wait, in order; whether there were any."""
        with self._copy.reading() as connection:
            query = select(OUTBOX).where(OUTBOX.c.refused == "").order_by(OUTBOX.c.number).limit(AT_ONCE)
            waiting = connection.execute(query).all()
        for row in waiting:
            if self._ends.is_set():
                return False
            change, fault = list[RowChange](), None
            try:
                change = [*read_back(row.change)]
                self._send(row.id, change)
            except Exception as cause:
                if not self._is_hopeless(row.id, cause):
                    raise
                fault = cause if isinstance(cause, CarpusFault) else ChangeRefused(self._name, _said(cause))
            there = self._as_there(change) if fault is not None else []
            with self._copy.writing() as connection:
                done = OUTBOX.c.id == row.id  # a number is given again once its row is gone
                if fault is None:
                    connection.execute(delete(OUTBOX).where(done))
                    self._leaves_traces |= any(one.way == "drop" for one in change)
                else:
                    connection.execute(update(OUTBOX).where(done).values(refused=type(fault).__name__))
                    for one, found in there:
                        _put_back(connection, one, found)
            if fault is not None:
                self._refuse(row.id, fault)
                self._forget(row.id)
        return bool(waiting)

    def _is_hopeless(self, change_id: str, cause: Exception) -> bool:
        """Whether a change will never be taken; a broken line, a missing right, a server that only reads are waited
        for."""
        if isinstance(cause, CarpusFault | IntegrityError | DataError):
            return True
        state = getattr(getattr(cause, "orig", None), "sqlstate", None)
        if isinstance(cause, OperationalError | InterfaceError | OSError) or state in _WAITS:
            return False
        self._tries[change_id] += 1
        return self._tries[change_id] >= MOST_TRIES

    def _forget(self, change_id: str) -> None:
        with self._copy.writing() as connection:
            connection.execute(delete(OUTBOX).where(OUTBOX.c.id == change_id))

    def _tell_late(self) -> None:
        """What was refused when the program ended before it could say so."""
        with self._copy.reading() as connection:
            untold = connection.execute(select(OUTBOX).where(OUTBOX.c.refused != "")).all()
        for row in untold:
            self._tell(ChangedMeanwhile(read_back(row.change)[0].table))
            self._forget(row.id)

    def _refuse(self, change_id: str, fault: CarpusFault) -> None:
        """Whoever waits for it is told; else it is told as news."""
        with self._rounds:
            self._refused[change_id] = fault
            self._rounds.notify_all()
            self._rounds.wait(0.2)
            untold = self._refused.pop(change_id, None)
        if untold is not None:
            self._tell(untold)

    def _send(self, change_id: str, change: Change) -> None:
        """Make a change there, once. A new patient whose pseudonym somebody else has taken meanwhile is not lost: a
        number is put to the name, which is told."""
        given = dict[str, int]()
        while True:
            sent = [_numbered(row, given[row.id]) if row.id in given else row for row in change]
            try:
                with self._engine.begin() as there:
                    taken_down = postgresql.insert(DELIVERED).values(id=change_id, at_s=time.time())
                    there.execute(text("SELECT pg_advisory_xact_lock(2026)"))  # one at a time, before any row is held
                    if there.execute(taken_down.on_conflict_do_nothing().returning(DELIVERED.c.id)).first():
                        make(there, sent)
            except PseudonymTaken as fault:
                names = {row.values.get("pseudonym"): row.id for row in sent if row.way in ("new", "join")}
                if (patient_id := names.get(fault.subject, "")) and given.get(patient_id, 1) < MOST_NAMESAKES:
                    given[patient_id] = given.get(patient_id, 1) + 1
                    continue
                raise
            for row in change:
                if row.id in given:
                    self._tell(PseudonymGiven(row.values["pseudonym"], f"{given[row.id]}"))
            return

    def _as_there(self, change: Change) -> list[tuple[RowChange, dict[str, Any] | None]]:
        """Rows of a refused change, as the server has them."""
        with self._engine.connect() as there:
            rows = [one for one in change if one.table in SHARED and one.table != DEED.name]
            tables = [SHARED[one.table] for one in rows]
            found = [
                there.execute(select(table).where(table.c.id == one.id)).mappings().first()
                for one, table in zip(rows, tables, strict=True)
            ]
        return [(one, None if row is None else dict(row)) for one, row in zip(rows, found, strict=True)]

    # --- from the server ----------------------------------------------------------------------------------
    def _fetch(self) -> None:
        """Bring the copy up to date with what others have changed. All of it is read first: whoever writes into the
        copy does not wait for a server that falls silent."""
        with tempfile.SpooledTemporaryFile(max_size=IN_MEMORY_BYTES) as file:
            with self._engine.connect().execution_options(isolation_level="REPEATABLE READ") as there, there.begin():
                newest = int(there.execute(text("SELECT last_value FROM carpus_step")).scalar() or 0)
                if newest == self._fetched:
                    return
                with self._copy.reading() as connection:
                    last = int(connection.execute(select(OWN.c.value).where(OWN.c.name == "step")).scalar() or 0)
                gone = there.execute(select(TOMBSTONE).where(TOMBSTONE.c.step > last)).all()
                seen = max([last, *(row.step for row in gone)])
                for table in COPIED:
                    after = last
                    while part := there.execute(_next(table, after)).mappings().all():
                        after = part[-1]["step"]
                        pickle.dump((table.name, [dict(row) for row in part]), file)
                    seen = max(seen, after)
                newest_deed = there.execute(select(func.max(DEED.c.step))).scalar() or 0
            pickle.dump(("", []), file)
            file.seek(0)
            with self._copy.writing() as connection:
                if connection.execute(select(func.count()).where(OUTBOX.c.refused == "")).scalar():
                    self._work.set()
                    return  # changed meanwhile: delivered first
                connection.exec_driver_sql("PRAGMA defer_foreign_keys = ON")
                self._leaves_traces |= bool(gone)
                for row in gone:
                    table = SHARED[row.of_table]
                    if table in (PATIENT, SESSION):  # their files go before them
                        connection.execute(update(table).where(table.c.id == row.id).values(erasing=1))
                    else:
                        connection.execute(delete(table).where(table.c.id == row.id))
                while (part := pickle.load(file))[0]:
                    _put(connection, *part)
                connection.execute(update(OWN).where(OWN.c.name == "step").values(value=str(seen)))
        if gone:
            self._let_go({row.id for row in gone if row.of_table in (PATIENT.name, SESSION.name)})
        # A number that is given and cannot be seen yet is of a change that is about to come: looked for again.
        self._fetched = max(seen, newest_deed)
        with suppress(DBAPIError), self._engine.begin() as there:
            there.execute(delete(DELIVERED).where(DELIVERED.c.at_s < time.time() - KEEP_DELIVERED_S))


def _put_back(connection: Connection, refused: RowChange, found: dict[str, Any] | None) -> None:
    table = SHARED[refused.table]
    if found is not None:
        _put(connection, table.name, [found])
    elif refused.way != "join":
        connection.execute(delete(table).where(table.c.id == refused.id))
        connection.execute(delete(SEEN).where(SEEN.c.path == refused.values.get("path")))


def _next(table: Table, after: int) -> Select[Any]:
    return select(table).where(table.c.step > after).order_by(table.c.step).limit(PAGE)


def _put(connection: Connection, name: str, rows: Sequence[dict[str, Any]]) -> None:
    table = SHARED[name]
    if table is SESSION:  # what is of this computer alone is nobody else's to change
        mine = set(connection.scalars(select(SESSION.c.id).where(SESSION.c.patient_id == PRACTICE)))
        rows = [row for row in rows if row["id"] not in mine]
    if not rows:
        return
    if name in _UNIQUE:  # what is unique there may have changed hands: the names that come are free first
        unique = table.c[_UNIQUE[name]]
        these = unique.in_([row[unique.name] for row in rows]) | table.c.id.in_([row["id"] for row in rows])
        connection.execute(update(table).where(these).values({unique.name: "\N{BULLET}" + table.c.id}))
    made = sqlite.insert(table)
    values = {column.name: made.excluded[column.name] for column in table.c if column.name != "id"}
    connection.execute(made.on_conflict_do_update(index_elements=["id"], set_=values), rows)


def _numbered(row: RowChange, number: int) -> RowChange:
    """A new patient with a number behind the pseudonym."""
    named = {name: f"{row.values[name]} ({number})" for name in ("pseudonym", "folded")}
    return replace(row, values={**row.values, **named})


def _cut(line: Any) -> None:
    """End a connection from another thread than the one that waits for its answer."""
    with suppress(Exception), socket.fromfd(line.fileno(), socket.AF_INET, socket.SOCK_STREAM) as wire:
        wire.shutdown(socket.SHUT_RDWR)


def _said(cause: Exception) -> str:
    return " ".join(str(getattr(cause, "orig", cause)).split())[:200]

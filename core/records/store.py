"""The open store of a data folder: rows are read, and changed together."""

from __future__ import annotations

import sqlite3
import uuid
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, suppress
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeVar

from sqlalchemy import Connection, Delete, Insert, Row, Select, Update, insert, select

from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import exclusive_lock, iter_paths, make_private_folder
from carpus.core.records.changes import ChangeSet, apply_changes, insert_row
from carpus.core.records.database import STORE_FILE, Database, copy_to_memory, move_aside, rescue_rows
from carpus.core.records.schema import PATIENT, TABLES
from carpus.core.records.session_setup import PRACTICE_PATIENT

if TYPE_CHECKING:
    from carpus.core.records.server import Server


T = TypeVar("T")
SESSIONS_FOLDER = "sessions"
LOCK_TIMEOUT_S = 60.0
"""Wait for another program that opens the store; migrating a large one takes long."""
MAX_DETAIL_CHARACTERS = 100
BATCH_ROWS = 500
PRACTICE_NAME = "Practice patient"


class Store:
    """Store of a data folder, safe for several threads and programs.

    It is a SQLite file in the folder or, with a ``url``, a clinic's PostgreSQL, which is first asked when something is
    read. A damaged file is set aside, reported and rebuilt. Raises what :class:`Database` does; with a server every use
    raises :class:`ServerUnavailable` while that does not answer.
    """

    def __init__(
        self,
        folder: Path,
        sessions_folder: Path | None = None,
        url: str = "",
        on_fault: Callable[[CarpusFault], None] = lambda _: None,
        copy: sqlite3.Connection | None = None,
    ) -> None:
        """``copy`` is the content of a read-only folder's store, for :func:`open_to_read`."""
        self.folder = folder
        self.sessions_folder = sessions_folder or folder / SESSIONS_FOLDER
        self.uses_share = self.sessions_folder != folder / SESSIONS_FOLDER
        """The sessions lie in a folder of several computers, which is never created here."""
        if copy is None:
            make_private_folder(folder)
            with suppress(OSError):  # in a folder that can only be read it stays
                (folder / ".reserve").unlink()  # room on the disk that Carpus 0.2.0 kept
            if not self.uses_share:
                make_private_folder(self.sessions_folder)
        self._on_fault, self._reported_rows = on_fault, set[str]()
        self.startup_faults: list[CarpusFault] = []
        """Faults found when the store was opened."""
        self.server: Server | None = None
        self._path = folder / STORE_FILE
        if url:
            from carpus.core.records.server import Server

            self._database: Database | Server = Server(url, self._prepare_server)
            self.server = self._database
            return
        self._database = database = self._open_database() if copy is None else Database(self._path, copy)
        if database.is_new and not self.startup_faults and self._has_sessions():
            self.startup_faults.append(errors.PatientListMissing(self._path))
        with database.writing() as connection:
            _ensure_practice_patient(connection)

    def _prepare_server(self, connection: Connection) -> Callable[[], None]:
        """Prepare a server in an open transaction and import this computer's own store.

        Returns what to do after the commit.
        """
        _ensure_practice_patient(connection)
        if not self._path.is_file():
            return lambda: None
        from carpus.core.records.local_store_import import LocalStoreImport

        try:
            with self._exclusive_lock(), connection.begin_nested():
                done = LocalStoreImport(self._path, connection)
        except sqlite3.Error:
            self._open_database().close()  # what can be read of a damaged one
            done = LocalStoreImport(self._path, connection)

        def finish() -> None:
            for fault in done.faults:
                self._on_fault(fault)
            if done.was_server_copy:  # it would keep the names of who is erased elsewhere
                for tail in ("", "-wal", "-shm"):
                    self._path.with_name(self._path.name + tail).unlink(missing_ok=True)
            else:
                move_aside(self._path, datetime.now(), "before-server")

        return finish

    def _open_database(self) -> Database:
        path = self._path
        # two programs that meet a damaged one would each set aside what the other has just made
        with self._exclusive_lock():
            try:
                return Database(path)
            except errors.PatientListDamaged as fault:
                aside, database = move_aside(path, datetime.now()), Database(path)
                rows = rescue_rows(aside, database)
                self.startup_faults.append(
                    errors.PatientListRebuilt(
                        aside, phrase("{detail}; {count} rows read", detail=fault.detail, count=rows)
                    )
                )
                return database

    def _exclusive_lock(self) -> AbstractContextManager[None]:
        """Keep other programs from opening the store; raises :class:`PatientListBusy`."""
        busy = partial(errors.PatientListBusy, self._path)
        return exclusive_lock(self._path.with_suffix(".lock"), busy, LOCK_TIMEOUT_S)

    def _has_sessions(self) -> bool:
        files = (one.relative_to(self.sessions_folder) for one in iter_paths(self.sessions_folder, ".h5"))
        return any(one.parts[0] != PRACTICE_PATIENT for one in files)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the store; may be called twice."""
        self._database.close()

    def rows(self, query: Select[Any]) -> Sequence[Row[Any]]:
        with self._database.reading() as connection:
            return connection.execute(query).all()

    def scalars(self, query: Select[Any]) -> set[Any]:
        """Return the different values of the first column."""
        return {row[0] for row in self.rows(query)}

    def row(self, query: Select[Any]) -> Row[Any] | None:
        with self._database.reading() as connection:
            return connection.execute(query).first()

    def apply(self, changes: ChangeSet) -> None:
        """Apply changes together or not at all.

        Raises :class:`ConcurrentChange`, :class:`PseudonymTaken` and the faults of writing.
        """
        with self._database.writing() as connection:
            apply_changes(connection, changes)

    def valid_rows(self, rows: Iterable[Row[Any]], parse: Callable[[Row[Any]], T]) -> list[T]:
        """Parse rows with an ``id``; damaged ones are left out and reported once."""
        found = []
        for row in rows:
            try:
                found.append(parse(row))
            except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as cause:
                if row.id not in self._reported_rows:
                    self._reported_rows.add(row.id)
                    self._on_fault(
                        errors.PatientListDamaged(self.folder / STORE_FILE, str(cause)[:MAX_DETAIL_CHARACTERS])
                    )
        return found

    def execute_local(self, *statements: Insert | Delete | Update) -> None:
        """Execute statements on tables without versions."""
        with self._database.writing() as connection:
            for statement in statements:
                connection.execute(statement)

    @property
    def is_server_away(self) -> bool:
        """True if there is a server that did not answer when it was last asked."""
        return self.server is not None and self.server.is_away

    def copy_to_memory(self) -> sqlite3.Connection:
        """Copy the store to SQLite in memory, in one transaction.

        Raises :class:`PatientListUnreadable` and its kinds.
        """
        if self.server is None:
            return copy_to_memory(self._path)
        copy = sqlite3.connect(":memory:", isolation_level=None, check_same_thread=False)
        with self.server.snapshot() as there, Database(self._path, copy).writing() as here:
            for table in TABLES.values():
                for rows in there.execute(select(table)).mappings().partitions(BATCH_ROWS):
                    here.execute(insert(table), [dict(row) for row in rows])
        return copy

    def purge_deleted(self) -> bool:
        """Remove deleted content from the disk; return False while another program reads."""
        return self._database.purge_deleted()


def open_to_read(
    folder: Path,
    sessions_folder: Path | None = None,
    url: str = "",
    on_fault: Callable[[CarpusFault], None] = lambda _: None,
) -> Store:
    """Open a store for reading, also in a read-only folder. Raises the faults of a store."""
    try:
        return Store(folder, sessions_folder, url, on_fault)
    except (errors.OutputNotWritable, errors.DiskFull):
        return Store(folder, sessions_folder, copy=copy_to_memory(folder / STORE_FILE))


def _ensure_practice_patient(connection: Connection) -> None:
    if connection.execute(select(PATIENT.c.id).where(PATIENT.c.id == PRACTICE_PATIENT)).first() is None:
        names = {"pseudonym_key": f"\N{BULLET}{PRACTICE_PATIENT}", "pseudonym": PRACTICE_NAME}
        apply_changes(connection, [insert_row(PATIENT, PRACTICE_PATIENT, **names, side="right")])


def new_id() -> str:
    """Return a new random id of a row."""
    return uuid.uuid4().hex

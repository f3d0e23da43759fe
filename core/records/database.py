"""SQLite file of the store: private, deleted content overwritten, SQLite's errors turned into faults."""

from __future__ import annotations

import contextlib
import sqlite3
import threading
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, create_engine, event, inspect
from sqlalchemy.exc import DBAPIError
from sqlalchemy.pool import StaticPool

from carpus.core.model import errors
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import find_free_name, is_disk_full, make_private_file, write_fault
from carpus.core.records.schema import METADATA, SESSION, SQLITE_LOG, TABLES, VERSION, rename_former_columns

STORE_FILE = "records.sqlite3"
MAX_CHECKED_BYTES = 64 << 20
"""Larger files are not checked when they are opened: that would delay the start."""
LOCK_WAIT_MS = 5000
"""How long one program waits for another."""
CANNOT_WRITE_CODES = (sqlite3.SQLITE_READONLY, sqlite3.SQLITE_CANTOPEN)
MAYBE_FULL_CODES = (sqlite3.SQLITE_IOERR, *CANNOT_WRITE_CODES)
"""What SQLite also reports on a full disk, which has no room for its journal."""
READ_ATTEMPTS = 3
COPY_TIMEOUT_S = 30.0
_MIGRATION_LOCK = threading.Lock()
"""Alembic keeps the running migration in globals: one at a time in a process."""


class Database:
    """SQLite database: readers never wait for a writer; one writer at a time, also among programs.

    ``is_new``: the tables had to be created. Raises :class:`PatientListUnreadable`, :class:`PatientListDamaged` where
    waiting does not help, :class:`OutputNotWritable`, :class:`DiskFull`.
    """

    def __init__(self, path: Path, copy: sqlite3.Connection | None = None) -> None:
        """``copy`` replaces a file that cannot be written; changes of it are lost."""
        self._path, self._write_lock, self._is_closed = path, threading.RLock(), False
        if copy is None:
            make_private_file(path)
            self._engine = create_engine(
                f"sqlite:///{path}", connect_args={"isolation_level": None, "timeout": LOCK_WAIT_MS / 1e3}
            )
        else:
            self._engine = create_engine("sqlite://", creator=lambda: copy, poolclass=StaticPool)
        event.listen(self._engine, "connect", _configure_connection)
        event.listen(self._engine, "begin", _begin_transaction)
        try:
            with self.writing() as connection:
                is_checked = copy is None and path.stat().st_size <= MAX_CHECKED_BYTES  # a copy was when it was made
                if is_checked and connection.exec_driver_sql("PRAGMA quick_check(1)").scalar() != "ok":
                    raise errors.PatientListDamaged(path, phrase("damaged"))
                self.is_new = migrate(connection, path)
                _restore_log_triggers(connection)
                for table in METADATA.sorted_tables:  # as text: SQLAlchemy would take a millisecond for each
                    columns = ", ".join(f'{table.name}."{column.name}"' for column in table.c)
                    connection.exec_driver_sql(f"SELECT {columns} FROM {table.name} LIMIT 0")
        except (DBAPIError, sqlite3.Error) as cause:
            self.close()
            raise errors.PatientListDamaged(path, str(getattr(cause, "orig", cause))) from cause
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the database; may be called twice. Connections in use are closed when returned."""
        self._is_closed = True
        self._engine.pool.dispose()

    @contextlib.contextmanager
    def reading(self) -> Iterator[Connection]:
        with self._translate_errors(), self._engine.begin() as connection:
            yield connection

    @contextlib.contextmanager
    def writing(self) -> Iterator[Connection]:
        """Open a transaction; it is rolled back after an exception."""
        with self._write_lock, self._translate_errors(), self._engine.connect() as connection:
            writes = connection.execution_options(writes=True)
            with writes.begin():
                yield writes

    def purge_deleted(self) -> bool:
        """Empty the write-ahead log, which keeps overwritten content.

        Returns False while another program reads.
        """
        with self._write_lock, self._translate_errors(), contextlib.closing(self._engine.raw_connection()) as raw:
            raw.execute(f"PRAGMA busy_timeout = {LOCK_WAIT_MS}")
            return not raw.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()[0]

    @contextlib.contextmanager
    def _translate_errors(self) -> Iterator[None]:
        """Translate SQLite's errors; close a connection returned after :meth:`close`, which the pool would keep."""
        try:
            yield
        except (DBAPIError, sqlite3.Error) as cause:  # what SQLite says at a connection comes as it is
            error = getattr(cause, "orig", cause)
            code = getattr(error, "sqlite_errorcode", 0) & 0xFF
            if code == sqlite3.SQLITE_FULL or (code in MAYBE_FULL_CODES and is_disk_full(self._path.parent)):
                raise errors.DiskFull(self._path) from cause
            if code in CANNOT_WRITE_CODES:
                raise errors.OutputNotWritable(self._path, str(error)) from cause
            if code in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB):
                raise errors.PatientListDamaged(self._path, str(error)) from cause
            if code in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
                raise errors.PatientListBusy(self._path, str(error)) from cause
            if code == sqlite3.SQLITE_IOERR:
                raise errors.PatientListUnreadable(self._path, str(error)) from cause
            raise
        finally:
            if self._is_closed:
                self._engine.pool.dispose()


def copy_to_memory(path: Path) -> sqlite3.Connection:
    """Copy a store to memory in one transaction, whoever has it open.

    Also from a read-only folder, where SQLite opens no file, as long as no journal lies beside it. Raises
    :class:`PatientListUnreadable` and its kinds.
    """
    copy = sqlite3.connect(":memory:", isolation_level=None, check_same_thread=False)
    try:
        try:
            uri = f"{path.absolute().as_uri()}?mode=rw"
            with contextlib.closing(sqlite3.connect(uri, uri=True, timeout=COPY_TIMEOUT_S)) as store:
                store.backup(copy)
        except sqlite3.Error as cause:
            code = getattr(cause, "sqlite_errorcode", 0) & 0xFF
            if code not in CANNOT_WRITE_CODES and not (code in MAYBE_FULL_CODES and is_disk_full(path.parent)):
                raise
            copy.deserialize(_read_unlocked(path))
        if copy.execute("PRAGMA quick_check(1)").fetchone() != ("ok",):
            raise errors.PatientListDamaged(path, phrase("damaged"))
    except (sqlite3.Error, OSError) as cause:
        copy.close()
        raise (
            errors.DiskFull(path) if is_disk_full(path.parent) else errors.PatientListUnreadable(path, str(cause))
        ) from cause
    except BaseException:
        copy.close()
        raise
    return copy


def _read_unlocked(path: Path) -> bytes:
    """Read a store whose file cannot be written.

    SQLite's ``immutable`` would read on while another computer writes. Here the file is read twice: nobody wrote if
    both readings are equal and there was no journal before or after. Raises :class:`PatientListReadOnly`,
    :class:`PatientListBusy` or OSError.
    """
    for _ in range(READ_ATTEMPTS):
        is_written = _has_journal(path)
        content, again = path.read_bytes(), path.read_bytes()
        if content == again and not is_written and not _has_journal(path):
            return content[:18] + b"\1\1" + content[20:]  # the mark of a write-ahead log would ask for one
    if _has_journal(path):
        raise errors.PatientListReadOnly(path)
    raise errors.PatientListBusy(path, phrase("folder not writable"))


def _has_journal(path: Path) -> bool:
    journals = (path.with_name(path.name + tail) for tail in ("-wal", "-journal"))
    return any(one.exists() and one.stat().st_size for one in journals)


def migrate(connection: Connection, name: Path | str) -> bool:
    """Migrate the tables to this version; return whether there were none. Loads Alembic only if needed.

    Raises :class:`PatientListVersionUnknown`, or :class:`PatientListDamaged` for another kind of database.
    """
    tables = set(inspect(connection).get_table_names())
    found = connection.exec_driver_sql("SELECT version_num FROM alembic_version").scalar() if (
        "alembic_version" in tables
    ) else None  # fmt: skip
    if found == VERSION:
        return False
    if found is None and tables:
        raise errors.PatientListDamaged(name, phrase("damaged"))
    if found is not None and found not in map(str, range(1, int(VERSION))):
        error = phrase(
            "version {version}, but this version of Carpus reads up to {count}",
            version=str(found) or "?",
            count=VERSION,
        )
        raise errors.PatientListVersionUnknown(name, error)
    from alembic.command import upgrade
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parent / "migrations").replace("%", "%%"))
    config.attributes["connection"] = connection
    with _MIGRATION_LOCK:
        upgrade(config, "head")
    return found is None


def _restore_log_triggers(connection: Connection) -> None:
    query = "SELECT name, sql FROM sqlite_master WHERE type = 'trigger'"
    there = {str(name): sql for name, sql in connection.exec_driver_sql(query)}
    for one in SQLITE_LOG.strip().removesuffix(";").split(";\n"):
        name = one.split()[2]
        if there.get(name) != one:
            connection.exec_driver_sql(f"DROP TRIGGER IF EXISTS {name}")
            connection.exec_driver_sql(one)


def rescue_rows(damaged: Path, target: Database) -> int:
    """Copy readable rows of a damaged store, from both ends of each table; return how many.

    Sessions are listed again from their files.
    """
    count = 0
    with (
        contextlib.suppress(sqlite3.Error),
        contextlib.closing(sqlite3.connect(f"{damaged.absolute().as_uri()}?mode=ro", uri=True)) as old,
        target.writing() as connection,
    ):
        new = connection.connection.cursor()
        new.execute("PRAGMA defer_foreign_keys = ON")
        for table in TABLES.values():
            there = set[str]()
            with contextlib.suppress(sqlite3.Error):
                there = {one for _, one, *_ in old.execute(f"PRAGMA table_info({table.name})")}
            columns = rename_former_columns(table, {one: f'"{one}"' for one in there})
            names = ", ".join(columns.values())
            put = f"INSERT OR IGNORE INTO {table.name} ({', '.join(columns)}) VALUES ({', '.join('?' * len(columns))})"
            for order in ("ASC", "DESC"):
                with contextlib.suppress(sqlite3.Error):
                    for row in old.execute(f"SELECT {names} FROM {table.name} ORDER BY rowid {order}"):
                        with contextlib.suppress(sqlite3.Error):  # a value of another kind, or what is there already
                            count += new.execute(put, row).rowcount
        while orphans := new.execute("PRAGMA foreign_key_check").fetchall():
            for name, rowid, _, _ in orphans:
                lost = f"UPDATE {name} SET patient_id = NULL" if name == SESSION.name else f"DELETE FROM {name}"
                new.execute(f"{lost} WHERE rowid = ?", (rowid,))
    return count


def move_aside(path: Path, now: datetime, label: str = "damaged") -> Path:
    """Rename a database and its journals, so that a new one can be made; return the new path."""
    aside = find_free_name(path.with_name(f"{path.stem}.{label}-{now:%Y%m%d-%H%M%S}{path.suffix}"))
    try:
        for tail in ("", "-wal", "-shm"):
            old = path.with_name(path.name + tail)
            if old.exists():
                old.rename(aside.with_name(aside.name + tail))
    except OSError as cause:
        raise write_fault(path, cause) from cause
    return aside


def _configure_connection(connection: Any, _: object) -> None:
    connection.text_factory = lambda stored: stored.decode("utf-8", "replace")
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA foreign_keys = ON")
    connection.execute("PRAGMA secure_delete = ON")  # what is taken out is overwritten, not only forgotten


def _begin_transaction(connection: Connection) -> None:
    writes = connection.get_execution_options().get("writes", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")

"""A private SQLite file: write-ahead log, versions with a script each, complaints as faults."""

from __future__ import annotations

import contextlib
import os
import sqlite3
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, cast

from carpus.core.encryption import cipher
from carpus.core.encryption.cipher import is_encrypted
from carpus.core.encryption.keys import folder_of, is_on, key_for
from carpus.core.errors import DiskFull, OutputNotWritable, RegisterDamaged, RegisterUnreadable
from carpus.core.phrase import phrase


class Database:
    """One connection for all threads, one transaction at a time.

    ``migrations`` has one script for each version, in order; ``PRAGMA user_version`` counts those that ran, and
    ``is_new`` tells that none had, ``is_raised`` that some had and others were missing. Before an older file is brought
    up to date a copy is laid beside it. ``tables`` with their columns must be there in the end. The file is readable by
    its owner only, and what is taken out of it is overwritten. Raises :class:`RegisterUnreadable`, or
    :class:`RegisterDamaged` where waiting does not help, :class:`OutputNotWritable`, :class:`DiskFull`.
    """

    def __init__(self, path: Path, migrations: Sequence[str], tables: Mapping[str, str] | None = None) -> None:
        self._path, self._migrations, self._tables = path, migrations, tables or {}
        self._lock = threading.RLock()
        _touch_private(path)
        found = self._connect(migrations)
        self.is_new, self.is_raised = found == 0, 0 < found < len(migrations)

    def _connect(self, migrations: Sequence[str]) -> int:
        self._connection = connect(self._path)
        self._file = _identity(self._path)
        self._connection.row_factory = row_factory(self._connection)
        self._connection.text_factory = lambda stored: stored.decode("utf-8", "replace")
        try:
            with self._complaints():
                return self._prepare(migrations)
        except BaseException:
            self._connection.close()
            raise

    def exchange(self, change: Callable[[Path], None]) -> None:
        """Let go of the file while ``change`` puts another form of it in its place, and open what is there then."""
        with self._lock:
            self._connection.close()
            try:
                change(self._path)
            finally:
                self._connect(self._migrations)

    def close(self) -> None:
        """May be called twice."""
        with self._lock:
            self._connection.close()

    @contextlib.contextmanager
    def transaction(self) -> Iterator[sqlite3.Connection]:
        """All of it is stored, or, after an exception, nothing."""
        with self._lock, self._complaints():
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                self._check_place()
                yield self._connection
            except BaseException:
                self._connection.rollback()
                raise
            self._connection.commit()

    def _check_place(self) -> None:
        """Nothing is written into a file that another program has exchanged for another form of it."""
        with contextlib.suppress(OSError):
            if _identity(self._path) != self._file:
                raise RegisterUnreadable(self._path, phrase("another program has exchanged it"))

    def leave_no_trace(self) -> None:
        """Empty the write-ahead log, which keeps what was overwritten; another program may hold that up a little."""
        with self._lock, self._complaints():
            self._connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")

    @contextlib.contextmanager
    def _complaints(self) -> Iterator[None]:
        try:
            yield
        except complaint_kinds() as cause:
            code = getattr(cause, "sqlite_errorcode", 0) & 0xFF
            if code == sqlite3.SQLITE_FULL:
                raise DiskFull(self._path) from cause
            if code == sqlite3.SQLITE_READONLY:
                raise OutputNotWritable(self._path, str(cause)) from cause
            if code in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB):
                raise RegisterDamaged(self._path, str(cause)) from cause
            raise RegisterUnreadable(self._path, str(cause)) from cause
        except UnicodeDecodeError as cause:  # SQLite's own complaint quotes the damage
            raise RegisterDamaged(self._path, phrase("names in it are no text")) from cause

    def _prepare(self, migrations: Sequence[str]) -> int:
        """Bring the file up to date; its version before."""
        connection = self._connection
        connection.execute("PRAGMA busy_timeout = 5000")
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA foreign_keys = ON")
        connection.execute("PRAGMA secure_delete = ON")  # what is taken out is overwritten, not only forgotten
        if connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
            raise RegisterDamaged(self._path, phrase("damaged"))
        version = int(connection.execute("PRAGMA user_version").fetchone()[0])
        if version > len(migrations):
            raise RegisterUnreadable(
                self._path,
                phrase("version {version}, this Carpus reads up to {count}", version=version, count=len(migrations)),
            )
        if 0 < version < len(migrations):
            self._copy_aside(version)
        for number, script in enumerate(migrations[version:], start=version + 1):
            connection.executescript(f"BEGIN; {script}; PRAGMA user_version = {number}; COMMIT;")
        for table, columns in self._tables.items():
            try:
                connection.execute(f"SELECT {columns} FROM {table} LIMIT 1").fetchone()
            except complaint_kinds() as cause:
                if "no such" not in str(cause):
                    raise
                raise RegisterDamaged(self._path, str(cause)) from cause
        return version

    def _copy_aside(self, version: int) -> None:
        path = self._path.with_name(f"{self._path.stem}.version{version}{self._path.suffix}")
        _touch_private(path)
        with contextlib.closing(connect(path, like=self._path)) as copy:
            self._connection.backup(copy)


def connect(path: Path, *, like: Path | None = None) -> sqlite3.Connection:
    """A connection to a register or a copy of one, plain or encrypted as the file is, or a new one as ``like`` is or
    as its folder asks for. Raises :class:`FolderLocked`."""
    is_new = not path.exists() or path.stat().st_size == 0
    if is_encrypted(path) or (is_new and (is_encrypted(like) if like else _wants_encryption(path))):
        return cast("sqlite3.Connection", cipher.connect(path, key_for(path if like is None else like)))
    return sqlite3.connect(path, check_same_thread=False, isolation_level=None)


def row_factory(connection: Any) -> Any:
    """Rows with names, of the library that the connection is of."""
    return sqlite3.Row if isinstance(connection, sqlite3.Connection) else cipher.library().Row


def _identity(path: Path) -> tuple[int, int]:
    found = path.stat()
    return found.st_dev, found.st_ino


def _wants_encryption(path: Path) -> bool:
    folder = folder_of(path)
    return folder is not None and is_on(folder)


def complaint_kinds() -> tuple[type[Exception], ...]:
    """What SQLite complains by, and SQLCipher where it is in use."""
    loaded = sys.modules.get("sqlcipher3.dbapi2")
    return (sqlite3.Error,) if loaded is None else (sqlite3.Error, loaded.Error)


def set_aside(path: Path, now: datetime) -> Path:
    """Give a damaged database and its journals another name, so that a new one can be made; where it is now."""
    aside = path.with_name(f"{path.stem}.damaged-{now:%Y%m%d-%H%M%S}{path.suffix}")
    try:
        for tail in ("", "-wal", "-shm"):
            old = path.with_name(path.name + tail)
            if old.exists():
                old.rename(aside.with_name(aside.name + tail))
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause
    return aside


def make_private(folder: Path) -> None:
    """Make a folder that only its owner may enter."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
    except OSError as cause:
        raise OutputNotWritable(folder, cause.strerror or "") from cause


def _touch_private(path: Path) -> None:
    """An empty file for its owner only, before SQLite would make one; its journals take over the permissions."""
    try:
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, 0o600))
        path.chmod(0o600)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause

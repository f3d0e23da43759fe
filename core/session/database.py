"""A private SQLite file: write-ahead log, versions with a script each, complaints as faults."""

from __future__ import annotations

import contextlib
import os
import sqlite3
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

from core.errors import DiskFull, OutputNotWritable, RegisterUnreadable


class Database:
    """One connection for all threads, one transaction at a time.

    ``migrations`` has one script for each version, in order; ``PRAGMA user_version`` counts those that ran, and
    ``is_new`` tells that none had. Before an older file is brought up to date a copy is laid beside it. The file
    is readable by its owner only. Raises :class:`RegisterUnreadable`, :class:`OutputNotWritable`, :class:`DiskFull`.
    """

    def __init__(self, path: Path, migrations: Sequence[str]) -> None:
        self._path = path
        self._lock = threading.RLock()
        _touch_private(path)
        self._connection = sqlite3.connect(path, check_same_thread=False, isolation_level=None)
        self._connection.row_factory = sqlite3.Row
        try:
            with self._complaints():
                self.is_new = self._prepare(migrations)
        except BaseException:
            self._connection.close()
            raise

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
                yield self._connection
            except BaseException:
                self._connection.rollback()
                raise
            self._connection.commit()

    @contextlib.contextmanager
    def _complaints(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as cause:
            code = getattr(cause, "sqlite_errorcode", 0) & 0xFF
            if code == sqlite3.SQLITE_FULL:
                raise DiskFull(self._path) from cause
            if code == sqlite3.SQLITE_READONLY:
                raise OutputNotWritable(self._path, str(cause)) from cause
            raise RegisterUnreadable(self._path, str(cause)) from cause

    def _prepare(self, migrations: Sequence[str]) -> bool:
        connection = self._connection
        connection.execute("PRAGMA busy_timeout = 5000")
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA foreign_keys = ON")
        if connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
            raise RegisterUnreadable(self._path, "damaged")
        version = int(connection.execute("PRAGMA user_version").fetchone()[0])
        if version > len(migrations):
            raise RegisterUnreadable(self._path, f"version {version}, this Carpus reads up to {len(migrations)}")
        if 0 < version < len(migrations):
            self._copy_aside(version)
        for number, script in enumerate(migrations[version:], start=version + 1):
            connection.executescript(f"BEGIN; {script}; PRAGMA user_version = {number}; COMMIT;")
        return version == 0

    def _copy_aside(self, version: int) -> None:
        path = self._path.with_name(f"{self._path.stem}.version{version}{self._path.suffix}")
        _touch_private(path)
        with contextlib.closing(sqlite3.connect(path)) as copy:
            self._connection.backup(copy)


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

"""The open store of one data folder: rows are read, and changed by whole changes."""

from __future__ import annotations

import sqlite3
import time
import uuid
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeVar

from sqlalchemy import Connection, Delete, Insert, Row, Select, Update, insert, select

from carpus.core.durable import hold, make_private, make_private_file
from carpus.core.errors import (
    CarpusFault,
    DiskFull,
    FolderMissing,
    LogUnguarded,
    NoDataFolder,
    OutputNotWritable,
    RegisterBusy,
    RegisterDamaged,
    RegisterMissing,
    RegisterSetAside,
)
from carpus.core.phrase import phrase
from carpus.core.records.changes import PRACTICE, Change, make, new
from carpus.core.records.database import STORE_FILE, Database, copied, rescue, set_aside
from carpus.core.records.reserve import free_reserve
from carpus.core.records.schema import PATIENT, TABLES
from carpus.core.session.disk import below

if TYPE_CHECKING:
    from carpus.core.records.server import Server

T = TypeVar("T")
SESSIONS_FOLDER = "sessions"
MOST_ALONE_S = 60.0
"""To wait for another program that opens the store: one that brings a large one up to date takes long."""
MOST_SAID = 100
"""Signs of what is wrong with a row."""
ROWS_AT_ONCE = 500
PRACTICE_NAME = "Practice patient"


class Store:
    """May be used from several threads and programs at once. It lies in the data folder, as SQLite, or, with the
    ``url`` of one, in a clinic's PostgreSQL, which is first asked when something is read. A damaged file is set aside,
    told, and made again. Raises what :class:`Database` does; with a server each use raises :class:`ServerGone` while
    that does not answer.
    """

    def __init__(
        self,
        folder: Path,
        sessions_folder: Path | None = None,
        url: str = "",
        tell: Callable[[CarpusFault], None] = lambda _: None,
        copy: sqlite3.Connection | None = None,
    ) -> None:
        """``copy``: of a folder that cannot be written, for :func:`reading`."""
        self.folder = folder
        self.sessions_folder = sessions_folder or folder / SESSIONS_FOLDER
        self.on_share = self.sessions_folder != folder / SESSIONS_FOLDER
        """Whether the sessions lie in a folder of several computers, which is never made here and keeps its rights."""
        if copy is None:
            make_private(folder)
            if not self.on_share:
                make_private(self.sessions_folder)
        self._tell, self._unsound = tell, set[str]()
        self.told: list[CarpusFault] = []
        """What was found when the store was opened."""
        self.server: Server | None = None
        self._path = folder / STORE_FILE
        if url:
            from carpus.core.records.server import Server

            self._database: Database | Server = Server(url, self._meet)
            self.server = self._database
            return
        self._database = database = self._opened() if copy is None else Database(self._path, copy)
        if database.was_unguarded:
            self.told.append(LogUnguarded(self._path))
        if database.is_new and not self.told and self._has_sessions():
            self.told.append(RegisterMissing(self._path))
        with database.writing() as connection:
            _enter_practice(connection)

    def _meet(self, there: Connection) -> Callable[[], None]:
        """Make a server ready in an open transaction, and give it what this computer has of its own; what is then to be
        done once that is stored."""
        _enter_practice(there)
        if not self._path.is_file():
            return lambda: None
        from carpus.core.records.hand_over import HandOver

        try:
            with _alone(self._path), there.begin_nested():
                done = HandOver(self._path, there)
        except sqlite3.Error:
            self._opened().close()  # what can be read of a damaged one
            done = HandOver(self._path, there)

        def then() -> None:
            for fault in done.faults:
                self._tell(fault)
            if done.was_copy:  # it would keep the names of who is erased elsewhere
                for tail in ("", "-wal", "-shm"):
                    self._path.with_name(self._path.name + tail).unlink(missing_ok=True)
            else:
                set_aside(self._path, datetime.now(), "before-server")

        return then

    def _opened(self) -> Database:
        path = self._path
        with _alone(path):  # two programs that meet a damaged one would each set aside what the other has just made
            try:
                try:
                    return Database(path)
                except DiskFull:
                    if not free_reserve(self.folder):
                        raise
                    return Database(path)
            except RegisterDamaged as fault:
                aside, database = set_aside(path, datetime.now()), Database(path)
                rows = rescue(aside, database)
                self.told.append(
                    RegisterSetAside(aside, phrase("{detail}; {count} rows read", detail=fault.detail, count=rows))
                )
                return database

    def _has_sessions(self) -> bool:
        files = (one.relative_to(self.sessions_folder) for one in below(self.sessions_folder, ".h5"))
        return any(one.parts[0] != PRACTICE for one in files)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """May be called twice."""
        self._database.close()

    def rows(self, query: Select[Any]) -> Sequence[Row[Any]]:
        with self._database.reading() as connection:
            return connection.execute(query).all()

    def row(self, query: Select[Any]) -> Row[Any] | None:
        with self._database.reading() as connection:
            return connection.execute(query).first()

    def do(self, change: Change) -> None:
        """Make a change, whole or not at all.

        Raises :class:`ChangedMeanwhile` where somebody else was quicker, :class:`PseudonymTaken` and the faults of
        writing.
        """
        with self._database.writing() as connection:
            make(connection, change)

    def sound(self, rows: Iterable[Row[Any]], read: Callable[[Row[Any]], T]) -> list[T]:
        """What ``read`` makes of each row of one with an ``id``; a damaged one is left out, and told once."""
        found = []
        for row in rows:
            try:
                found.append(read(row))
            except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as cause:
                if row.id not in self._unsound:
                    self._unsound.add(row.id)
                    self._tell(RegisterDamaged(self.folder / STORE_FILE, str(cause)[:MOST_SAID]))
        return found

    def own(self, *statements: Insert | Delete | Update) -> None:
        """Change what has no version."""
        with self._database.writing() as connection:
            for statement in statements:
                connection.execute(statement)

    @property
    def is_away(self) -> bool:
        """Whether there is a server that did not answer when it was last asked."""
        return self.server is not None and self.server.is_away

    def copied(self) -> sqlite3.Connection:
        """All of it as SQLite in memory, as of one moment. Raises :class:`RegisterUnreadable` and its kinds."""
        if self.server is None:
            return copied(self._path)
        copy = sqlite3.connect(":memory:", isolation_level=None, check_same_thread=False)
        with self.server.unchanging() as there, Database(self._path, copy).writing() as here:
            for table in TABLES.values():
                for rows in there.execute(select(table)).mappings().partitions(ROWS_AT_ONCE):
                    here.execute(insert(table), [dict(row) for row in rows])
        return copy

    def leave_no_trace(self) -> bool:
        """Bring what was taken out to the disk as taken out; whether it is."""
        return self._database.leave_no_trace()


def reading(
    folder: Path,
    sessions_folder: Path | None = None,
    url: str = "",
    tell: Callable[[CarpusFault], None] = lambda _: None,
) -> Store:
    """The store of a folder for who only reads: also of one that cannot be written. Raises the faults of a store."""
    try:
        return Store(folder, sessions_folder, url, tell)
    except (OutputNotWritable, DiskFull):
        return Store(folder, sessions_folder, copy=copied(folder / STORE_FILE))


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """While no other program opens that store. Raises :class:`RegisterBusy`, :class:`OutputNotWritable`."""
    end = time.monotonic() + MOST_ALONE_S
    lock = path.with_suffix(".lock")
    make_private_file(lock)
    with lock.open("r+b") as file:
        while True:
            try:
                hold(file)
                break
            except OSError as cause:
                if time.monotonic() > end:
                    raise RegisterBusy(path, cause.strerror or "") from cause
                time.sleep(0.02)
        yield


def _enter_practice(connection: Connection) -> None:
    """See that the practice patient is there."""
    if connection.execute(select(PATIENT.c.id).where(PATIENT.c.id == PRACTICE)).first() is None:
        practice = new(PATIENT, PRACTICE, folded=f"\N{BULLET}{PRACTICE}", pseudonym=PRACTICE_NAME, side="right")
        make(connection, [practice])


def new_id() -> str:
    """A new random identity of a row."""
    return uuid.uuid4().hex


def is_kept_in(folder: Path) -> bool:
    """Whether there is a store in a folder."""
    return (folder / STORE_FILE).is_file()


def look_for_store(folder: Path) -> None:
    """Raises :class:`FolderMissing`, :class:`NoDataFolder` for one without a store: a look makes none."""
    if not folder.is_dir():
        raise FolderMissing(folder)
    if not is_kept_in(folder):
        raise NoDataFolder(folder)

"""The open store of one data folder: rows are read of this computer's file, and changed by whole changes."""

from __future__ import annotations

import sqlite3
import time
import uuid
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeVar

from sqlalchemy import Delete, Insert, Row, Select, Update, select

from carpus.core.durable import hold, make_private, make_private_file
from carpus.core.errors import (
    CarpusFault,
    DiskFull,
    ErasureUnfinished,
    FolderMissing,
    LogUnguarded,
    NoDataFolder,
    OutputNotWritable,
    PseudonymTaken,
    RegisterBusy,
    RegisterDamaged,
    RegisterMissing,
    RegisterSetAside,
    ServerGone,
)
from carpus.core.phrase import phrase
from carpus.core.records.changes import PRACTICE, Change, forget, is_practice, is_shared, lay_out, make, new
from carpus.core.records.database import STORE_FILE, Database, copied, rescue, set_aside
from carpus.core.records.reserve import free_reserve
from carpus.core.records.schema import PATIENT
from carpus.core.session.disk import below

if TYPE_CHECKING:
    from carpus.core.records.server import Server

T = TypeVar("T")
SESSIONS_FOLDER = "sessions"
MOST_ALONE_S = 60.0
"""To wait for another program that opens the store: one that brings a large one up to date takes long."""
MOST_WAIT_S = 2.0
"""For the server's word on what somebody else may have changed too."""
MOST_SAID = 100
"""Signs of what is wrong with a row."""
CONTESTED = ("patient", "correction", "exercise_set", "report_form")


class Store:
    """May be used from several threads and programs at once. A damaged file is set aside, told, and made again.

    With the ``url`` of a PostgreSQL server changes are delivered there and fetched from there
    (:mod:`core.records.server`); what is found meanwhile is told from its thread. Raises what :class:`Database` does.
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
        path = folder / STORE_FILE
        self._database = self._opened(path) if copy is None else Database(path, copy)
        if self._database.was_unguarded:
            self.told.append(LogUnguarded(folder / STORE_FILE))
        if self._database.is_new and not url and not self.told and self._has_sessions():
            self.told.append(RegisterMissing(folder / STORE_FILE))
        if not self.rows(select(PATIENT.c.id).where(PATIENT.c.id == PRACTICE)):
            practice = new(PATIENT, PRACTICE, folded=f"\N{BULLET}{PRACTICE}", pseudonym=PRACTICE, side="right")
            with suppress(PseudonymTaken):  # another program that was started now was quicker
                self._make([practice], "")
        self._server: Server | None = None
        if url:
            from carpus.core.records.server import Server

            self._server = Server(url, self._database, tell, self._let_go)

    def _opened(self, path: Path) -> Database:
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
        if self._server is not None:
            self._server.close()
            self._server = None
        self._database.close()

    def rows(self, query: Select[Any]) -> Sequence[Row[Any]]:
        with self._database.reading() as connection:
            return connection.execute(query).all()

    def row(self, query: Select[Any]) -> Row[Any] | None:
        with self._database.reading() as connection:
            return connection.execute(query).first()

    def do(self, change: Change) -> None:
        """Make a change, whole or not at all. What two people could do at once waits for the server a moment, if that
        is there: what it refuses is told here.

        Raises :class:`ChangedMeanwhile`, :class:`PseudonymTaken` and the faults of writing.
        """
        change_id = new_id()
        self._make(change, change_id)
        if self._server is not None:
            self._server.wake()
            if any(row.version or (row.way == "new" and row.table in CONTESTED) for row in change):
                self._server.delivered(change_id, MOST_WAIT_S)

    def _make(self, change: Change, change_id: str) -> None:
        with self._database.writing() as connection:
            make(connection, change)
            shared = [row for row in change if change_id and not is_practice(connection, row)]
            if shared and is_shared(connection):
                lay_out(connection, shared, change_id)

    def knows_all(self) -> bool:
        """Whether there is no server, or the copy is up to date with it; waits a moment when it was just opened."""
        return self._server is None or self._server.has_fetched(MOST_WAIT_S)

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

    def rows_there(self, query: Select[Any]) -> Sequence[Row[Any]]:
        """What the server has, of what is copied nowhere; this computer's own where there is none, or it is gone."""
        if self._server is not None:
            with suppress(ServerGone):
                return self._server.rows(query)
        return self.rows(query)

    @property
    def is_behind(self) -> bool:
        """Whether there is a server that does not answer."""
        return self._server is not None and not self._server.is_there

    def settled(self, most_s: float) -> bool:
        """Wait until the server has all of this computer and this one all of it; whether it is so. True without one."""
        return self._server is None or self._server.settled(most_s)

    def _let_go(self, gone_there: Collection[str]) -> None:
        """What another computer erased goes here with its files."""
        from carpus.core.records.erasure import go_on

        left = go_on(self, gone_there)
        if left:
            self._tell(ErasureUnfinished(left[0].name, f"{len(left)}"))

    def own(self, *statements: Insert | Delete | Update) -> None:
        """Change what is of this computer alone."""
        with self._database.writing() as connection:
            for statement in statements:
                connection.execute(statement)

    def forget_waiting(self, ids: Collection[str]) -> None:
        """Take what is erased out of the changes that wait for the server; that it goes is told there all the same."""
        with self._database.writing() as connection:
            forget(connection, ids)

    def leave_no_trace(self) -> bool:
        """Bring what was taken out to the disk as taken out; whether it is."""
        return self._database.leave_no_trace()


def reading(
    folder: Path,
    sessions_folder: Path | None = None,
    url: str = "",
    tell: Callable[[CarpusFault], None] = lambda _: None,
) -> Store:
    """The store of a folder for who only reads: also of one that cannot be written, then without its server. Raises the
    faults of a store."""
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


def new_id() -> str:
    """Of a row."""
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

"""A clinic's PostgreSQL as the store of all its computers.

A server that does not answer is reported at once and not waited for again until :meth:`Server.ping`.
"""

from __future__ import annotations

import contextlib
import logging
import socket
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

from sqlalchemy import Connection, create_engine, text
from sqlalchemy.exc import ArgumentError, DBAPIError

from carpus.core.model.errors import DiskFull, OutputNotWritable, PatientListBusy, ServerUnavailable, SettingsInvalid
from carpus.core.model.phrase import phrase
from carpus.core.records.database import migrate

logging.getLogger("sqlalchemy.pool").addHandler(logging.NullHandler())  # what a broken line says is told as a fault
STALL_TIMEOUT_S = 6.0
"""A connection without an answer for so long is closed: the window waits for it."""
RETRY_AFTER_S = 10.0
"""After a missing answer the server is not asked again for so long."""
_OPTIONS = {
    "connect_timeout": 3, "tcp_user_timeout": 4000, "keepalives_idle": 5, "keepalives_interval": 5,
    "keepalives_count": 3, "application_name": "carpus",
    "options": "-c lock_timeout=4000 -c idle_in_transaction_session_timeout=10000",
}  # fmt: skip
_BUSY, _DISK_FULL, _READ_ONLY = ("55P03", "40P01"), ("53100",), ("42501", "25006")
"""PostgreSQL's SQLSTATE codes."""


class Server:
    """Reading and writing as in :class:`core.records.database.Database`; connects at the first use.

    ``prepare`` is called in its own transaction when the server first answers and its tables are of this version; what
    it returns is called after the commit.
    """

    def __init__(self, url: str, prepare: Callable[[Connection], Callable[[], None]]) -> None:
        plain = url.removeprefix("postgresql+psycopg").removeprefix("postgresql").removeprefix("postgres")
        try:
            self._engine = create_engine(f"postgresql+psycopg{plain}", connect_args=_OPTIONS, pool_size=2)
        except (ArgumentError, ValueError) as cause:
            raise SettingsInvalid("records.url", str(cause)) from cause
        self.name = self._engine.url.render_as_string(hide_password=True).split("@")[-1]
        self._prepare, self._is_ready = prepare, False
        self._prepare_lock = threading.RLock()
        self._retry_at_s = 0.0

    @property
    def is_away(self) -> bool:
        """True if the server did not answer when it was last asked."""
        return self._retry_at_s > 0.0

    def close(self) -> None:
        """Close all connections; may be called twice."""
        self._engine.dispose()

    def ping(self) -> None:
        """Ask whether the server answers. Raises :class:`ServerUnavailable` and other faults of a store."""
        self._retry_at_s = min(self._retry_at_s, time.monotonic())
        with self.reading():
            pass

    def purge_deleted(self) -> bool:
        """Do nothing: a server does it itself."""
        return True

    @contextlib.contextmanager
    def reading(self) -> Iterator[Connection]:
        with self._translate_errors(), self._connect() as connection:
            yield connection.execution_options(isolation_level="AUTOCOMMIT")

    @contextlib.contextmanager
    def writing(self) -> Iterator[Connection]:
        """Open a transaction that is rolled back after an exception; one writer at a time of all computers."""
        with self._translate_errors(), self._connect() as connection, connection.begin():
            connection.execute(text("SELECT pg_advisory_xact_lock(2026)"))
            yield connection

    @contextlib.contextmanager
    def snapshot(self) -> Iterator[Connection]:
        """Open a long reading transaction that sees one state of the data."""
        self.ping()
        options = {"isolation_level": "REPEATABLE READ"}
        with (
            self._translate_errors(),
            self._engine.connect().execution_options(**options) as connection,
            connection.begin(),
        ):
            yield connection

    @contextlib.contextmanager
    def _connect(self) -> Iterator[Connection]:
        if time.monotonic() < self._retry_at_s:
            raise ServerUnavailable(self.name, phrase("no answer"))
        with self._prepare_lock:
            if not self._is_ready:
                with self._setup_transaction() as connection:
                    migrate(connection, self.name)
                with self._setup_transaction() as connection:  # its own: what changes tables holds up everybody
                    then = self._prepare(connection)
                self._is_ready = True
                then()
        with self._checked_connection() as connection:
            self._retry_at_s = 0.0
            yield connection

    @contextlib.contextmanager
    def _setup_transaction(self) -> Iterator[Connection]:
        """Open a transaction while no other computer sets up the server, which may take minutes."""
        with self._engine.begin() as connection:
            try:
                connection.execute(text("SELECT pg_advisory_xact_lock(2025)"))
            except DBAPIError as cause:
                self._retry_at_s = time.monotonic() + RETRY_AFTER_S
                raise ServerUnavailable(self.name, phrase("another computer is sending its data")) from cause
            yield connection

    @contextlib.contextmanager
    def _checked_connection(self) -> Iterator[Connection]:
        """Open a connection that has just answered, a new one in place of one that was closed.

        It is closed again when it stalls.
        """
        for is_last in (False, True):
            with contextlib.closing(self._engine.connect()) as connection:
                line = connection.connection.driver_connection
                stall = threading.Timer(STALL_TIMEOUT_S, _shut_down, (line,))
                stall.daemon = True
                stall.start()
                try:
                    try:
                        connection.exec_driver_sql("SELECT 1")
                        connection.rollback()
                    except DBAPIError as cause:
                        if is_last or not cause.connection_invalidated:
                            raise
                        continue
                    yield connection
                    return
                finally:
                    stall.cancel()

    @contextlib.contextmanager
    def _translate_errors(self) -> Iterator[None]:
        try:
            yield
        except DBAPIError as cause:
            message = " ".join(str(cause.orig).split())[:200]
            state = getattr(cause.orig, "sqlstate", None)
            if state in _BUSY:
                raise PatientListBusy(self.name, message) from cause
            if state in _DISK_FULL:
                raise DiskFull(self.name, message) from cause
            if state in _READ_ONLY:
                raise OutputNotWritable(self.name, message) from cause
            if cause.connection_invalidated or state is None or state[:2] in ("08", "28", "3D", "53", "57"):
                self._retry_at_s = time.monotonic() + RETRY_AFTER_S
                raise ServerUnavailable(self.name, message) from cause
            raise


def _shut_down(connection: Any) -> None:
    """End a connection from another thread than the one that waits for it."""
    with contextlib.suppress(Exception), socket.fromfd(connection.fileno(), socket.AF_INET, socket.SOCK_STREAM) as wire:
        wire.shutdown(socket.SHUT_RDWR)

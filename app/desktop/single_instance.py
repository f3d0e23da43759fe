"""One Carpus at a time per data folder; a second one brings the first to the front."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QLockFile
from PySide6.QtNetwork import QLocalServer, QLocalSocket

LOCK_FILE = "carpus.lock"
TIMEOUT_MS = 500


class SingleInstance:
    """Lock on a data folder until :meth:`release`."""

    def __init__(self, folder: Path) -> None:
        self._name = "carpus-" + hashlib.sha256(str(folder.resolve()).encode()).hexdigest()[:16]
        self._lock = QLockFile(str(folder / LOCK_FILE))
        self._lock.setStaleLockTime(0)  # held as long as its process lives, however long that is
        self._server: QLocalServer | None = None

    def acquire(self) -> bool:
        """Take the lock; return False if another Carpus has it.

        If no lock can be written, opening the folder fails with the reason.
        """
        return self._lock.tryLock(0) or self._lock.error() != QLockFile.LockError.LockFailedError

    def listen(self, on_request: Callable[[Path | None], None]) -> None:
        """Call ``on_request`` with the session file of each second Carpus, or None."""
        QLocalServer.removeServer(self._name)  # of a process that was ended by force
        self._server = QLocalServer()
        self._server.setSocketOptions(QLocalServer.SocketOption.UserAccessOption)
        self._server.newConnection.connect(lambda: self._accept_connections(on_request))
        self._server.listen(self._name)

    def _accept_connections(self, on_request: Callable[[Path | None], None]) -> None:
        assert self._server is not None
        while (caller := self._server.nextPendingConnection()) is not None:
            caller.readyRead.connect(lambda caller=caller: self._read_request(caller, on_request))
            caller.disconnected.connect(caller.deleteLater)
            self._read_request(caller, on_request)  # what came before anybody listened

    def _read_request(self, caller: QLocalSocket, on_request: Callable[[Path | None], None]) -> None:
        """Read one line: a path, or nothing."""
        if not caller.canReadLine():
            return
        path = os.fsdecode(bytes(caller.readLine().data()).rstrip(b"\n"))
        caller.write(b"here")
        caller.flush()
        caller.disconnectFromServer()
        on_request(Path(path) if path else None)

    def notify_running_instance(self, session: Path | None = None) -> bool:
        """Ask the running Carpus to come to the front and open a file; return True if it answered."""
        socket = QLocalSocket()
        socket.connectToServer(self._name)
        answered = socket.waitForConnected(TIMEOUT_MS)
        if answered:
            socket.write((b"" if session is None else os.fsencode(session)) + b"\n")
            answered = socket.waitForReadyRead(TIMEOUT_MS)
        socket.abort()
        return bool(answered)

    def release(self) -> None:
        """Release the lock; may be called twice."""
        if self._server is not None:
            self._server.close()
            self._server = None
        self._lock.unlock()

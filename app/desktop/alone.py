"""One Carpus at a time on one data folder; a second one brings the first to the front."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QLockFile
from PySide6.QtNetwork import QLocalServer, QLocalSocket

LOCK_FILE = "carpus.lock"
PATIENCE_MS = 500


class Alone:
    """Holds a data folder for this process until :meth:`let_go`."""

    def __init__(self, folder: Path) -> None:
        self._name = "carpus-" + hashlib.sha256(str(folder.resolve()).encode()).hexdigest()[:16]
        self._lock = QLockFile(str(folder / LOCK_FILE))
        self._lock.setStaleLockTime(0)  # held as long as its process lives, however long that is
        self._server: QLocalServer | None = None

    def take(self) -> bool:
        """Whether no other Carpus has the folder. Where no lock can be written, what opens the folder tells why."""
        return self._lock.tryLock(0) or self._lock.error() != QLockFile.LockError.LockFailedError

    def listen(self, called: Callable[[Path | None], None]) -> None:
        """From now on a second Carpus that calls makes ``called`` happen, with the file that it was to open."""
        QLocalServer.removeServer(self._name)  # of a process that was ended by force
        self._server = QLocalServer()
        self._server.setSocketOptions(QLocalServer.SocketOption.UserAccessOption)
        self._server.newConnection.connect(lambda: self._answer(called))
        self._server.listen(self._name)

    def _answer(self, called: Callable[[Path | None], None]) -> None:
        assert self._server is not None
        while (caller := self._server.nextPendingConnection()) is not None:
            caller.readyRead.connect(lambda caller=caller: self._hear(caller, called))
            caller.disconnected.connect(caller.deleteLater)
            self._hear(caller, called)  # what came before anybody listened

    def _hear(self, caller: QLocalSocket, called: Callable[[Path | None], None]) -> None:
        """One line: the path, or nothing."""
        if not caller.canReadLine():
            return
        path = os.fsdecode(bytes(caller.readLine().data()).rstrip(b"\n"))
        caller.write(b"here")
        caller.flush()
        caller.disconnectFromServer()
        called(Path(path) if path else None)

    def call_first(self, session: Path | None = None) -> bool:
        """Ask the Carpus that has the folder to come to the front and to open a file; whether it answered."""
        socket = QLocalSocket()
        socket.connectToServer(self._name)
        answered = socket.waitForConnected(PATIENCE_MS)
        if answered:
            socket.write((b"" if session is None else os.fsencode(session)) + b"\n")
            answered = socket.waitForReadyRead(PATIENCE_MS)
        socket.abort()
        return bool(answered)

    def let_go(self) -> None:
        """May be called twice."""
        if self._server is not None:
            self._server.close()
            self._server = None
        self._lock.unlock()

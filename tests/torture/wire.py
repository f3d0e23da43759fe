"""The wire between programs and a server, to be cut: all at once, or so that only the answers are lost."""

from __future__ import annotations

import socket
import threading
from contextlib import suppress


class Wire:
    """Listens on a ``port`` of its own and passes on what comes."""

    def __init__(self, to_port: int) -> None:
        self._to_port = to_port
        self.is_whole = self.answers_come = True
        self._ends: list[socket.socket] = []
        self._passing: list[threading.Thread] = []
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listening.getsockname()[1])
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def cut(self) -> None:
        """Whoever is connected is so no more."""
        for one in self._ends:
            with suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
        self._ends.clear()

    def close(self) -> None:
        """For good."""
        self._listening.shutdown(socket.SHUT_RDWR)
        self._thread.join()
        self._listening.close()
        self.cut()
        for one in self._passing:
            one.join()

    def _listen(self) -> None:
        while True:
            try:
                near, _ = self._listening.accept()
            except OSError:
                return
            try:
                if not self.is_whole:
                    raise ConnectionRefusedError
                far = socket.create_connection(("127.0.0.1", self._to_port), 3.0)
            except OSError:
                near.close()
                continue
            far.settimeout(None)
            self._ends += [near, far]
            self._passing.append(threading.Thread(target=self._both_ways, args=(near, far), daemon=True))
            self._passing[-1].start()

    def _both_ways(self, near: socket.socket, far: socket.socket) -> None:
        back = threading.Thread(target=self._pass_on, args=(far, near, True), daemon=True)
        back.start()
        self._pass_on(near, far, False)
        back.join()
        near.close()
        far.close()

    def _pass_on(self, one: socket.socket, other: socket.socket, answers: bool) -> None:
        with suppress(OSError):
            while data := one.recv(1 << 16):
                if self.answers_come or not answers:
                    other.sendall(data)
        for end in (one, other):  # not closed: that would leave whoever waits for it waiting
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

"""A real PostgreSQL for tests: a cluster of its own in a temporary folder, on a port of its own."""

from __future__ import annotations

import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import psycopg


def binaries() -> Path:
    """Where the server's programs are; installed by ``installer/setup.sh test``."""
    versions = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    found = str(versions[-1]) if versions else shutil.which("initdb")
    assert found, "no PostgreSQL here: installer/setup.sh test installs it"
    return Path(found).parent


class Cluster:
    """``url`` of its database; as root it runs as nobody's user, since the server refuses root."""

    def __init__(self) -> None:
        # Beside the tests' own folders, into which another user cannot go.
        self.folder = folder = Path(tempfile.mkdtemp(prefix="carpus-postgres-"))
        self._bin = binaries()
        self._as = "postgres" if os.geteuid() == 0 else None
        if self._as:
            os.chown(folder, pwd.getpwnam(self._as).pw_uid, -1)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self._log = str(folder / "log")
        self._call(
            "initdb", "-D", str(folder / "data"), "-U", "carpus", "-A", "trust", "-E", "UTF8", "-N", "--no-instructions"
        )
        self.start()

    def url(self, database: str = "postgres") -> str:
        """For the settings."""
        return f"postgresql://carpus@127.0.0.1:{self.port}/{database}"

    def start(self) -> None:
        """Until it answers."""
        options = f"-p {self.port} -c listen_addresses=127.0.0.1 -c unix_socket_directories={self.folder} -c fsync=off"
        start = ("pg_ctl", "-D", str(self.folder / "data"), "-o", options, "-l", self._log, "-w", "start")
        for _ in range(20):  # what was killed may still hold its memory
            with suppress(subprocess.CalledProcessError):
                return self._call(*start)
            time.sleep(0.3)
        raise AssertionError(Path(self._log).read_text(errors="replace")[-2000:])

    def end(self) -> None:
        """And leave nothing behind."""
        self.stop()
        shutil.rmtree(self.folder)

    def stop(self, how: str = "immediate") -> None:
        """As if it were killed."""
        self._call("pg_ctl", "-D", str(self.folder / "data"), "-m", how, "-w", "stop")

    def signal(self, number: signal.Signals, *, all_of_them: bool = True) -> None:
        """Send a signal to the server, or only to those of its processes that serve a connection."""
        first = int((self.folder / "data" / "postmaster.pid").read_text().split()[0])
        others = [int(one) for one in Path(f"/proc/{first}/task/{first}/children").read_text().split()]
        serving = [one for one in others if ": carpus " in Path(f"/proc/{one}/cmdline").read_text(errors="replace")]
        for one in [first, *others] if all_of_them else serving:
            os.kill(one, number)

    def new_database(self, name: str, like: str = "template1") -> str:
        """An empty one, or a copy of another that nobody uses; its url."""
        with psycopg.connect(self.url(), autocommit=True) as connection:
            connection.execute(f"CREATE DATABASE {name} TEMPLATE {like}".encode())
        return self.url(name)

    def _call(self, program: str, *arguments: str) -> None:
        command: Sequence[str] = [str(self._bin / program), *arguments]
        subprocess.run(
            command, check=True, user=self._as, cwd=self.folder, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, env={**os.environ, "LC_ALL": "C"},
        )  # fmt: skip

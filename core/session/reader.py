"""Reads session files without opening one in this process.

Whatever a file does to the HDF5 library, it does it to the reading process (:mod:`core.session.reading_process`),
which has limits of time and memory, serves many questions and is started anew when it has died. What is read comes
back as values with read-only arrays.
"""

from __future__ import annotations

import contextlib
import io
import os
import pickle
import sys
import threading
from collections.abc import Iterator
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, cast

from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault, SessionMissing, SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.platform.child_process import ChildProcess
from carpus.core.session.values import DetectionTable, EncodedImages, Session, SessionOutline, VerificationResult

TIMEOUT_S, BYTES_PER_S = 20.0, 2e6
"""An answer may take so long by the clock, and a second more for so many bytes: a slow share is no damaged file."""
RAW_CHUNK_BYTES = 1 << 24
_NUMPY_NAMES = ("ndarray", "dtype", "_reconstruct", "_frombuffer", "scalar")
"""An answer is made of these and of this program's own classes; a process that a file has taken over could send others.
"""


def read_session(path: Path) -> Session:
    """Read a session. Raises :class:`SessionUnreadable`.

    Blobs and pictures stay in the file: :func:`read_detections`, :func:`read_raw`.
    """
    return cast(Session, _request("session", path))


def read_outline(path: Path) -> SessionOutline:
    """Header, length and state of a session, without its data: quick enough for a whole folder."""
    return cast(SessionOutline, _request("outline", path))


def read_detections(path: Path) -> DetectionTable:
    """Every blob of every frame of a session."""
    return cast(DetectionTable, _request("detections", path))


def has_raw(path: Path) -> bool:
    """Whether the session kept its pictures."""
    return bool(_request("has_raw", path))


def raw_depth_unit_m(path: Path) -> float:
    """Metres per count of the depth pictures kept."""
    return float(_request("raw_depth_unit_m", path))


def read_raw(path: Path) -> Iterator[EncodedImages]:
    """The pictures kept, frame by frame."""
    row = 0
    while some := cast("list[EncodedImages]", _request("raw_some", path, row, RAW_CHUNK_BYTES)):
        yield from some
        row += len(some)


def read_raw_color(path: Path, row: int) -> bytes:
    """The colour picture kept of one row; no bytes where there is none."""
    return cast(bytes, _request("raw_color", path, row))


def verify(path: Path) -> VerificationResult:
    """Whether a session is whole and unchanged; as :func:`core.session.session_file.verify`."""
    return cast(VerificationResult, _request("verify", path))


def finish_part(part: Path, when: str) -> Path | None:
    """Finish a part file where it can be ended by force; as :func:`core.session.rewriting.finish_part`."""
    return cast("Path | None", _request("recover", part, when))


def rewrite_session(path: Path, target: Path, **said: str) -> None:
    """Write a session again with other attributes; as :func:`core.session.rewriting.rewrite_session`."""
    _request("write_anew", path, target, said)


class ReadingProcess:
    """The one process that reads for this one; used from any thread, one question at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._child: ChildProcess | None = None
        self._owner = os.getpid()

    def request(self, name: str, path: Path, *arguments: object) -> Any:
        """The answer to a question about a file. Raises the fault that came instead, or :class:`SessionUnreadable`."""
        with self._lock:
            question = (name, os.fspath(path), arguments)
            link = self._start_child()
            try:
                link.send(question)
            except OSError:  # it died of something after its last answer
                self._end()
                link = self._start_child()
                link.send(question)
            size = _file_size(path)
            if not link.poll(TIMEOUT_S + size / BYTES_PER_S):
                self._end()
                raise SessionUnreadable(path, phrase("damaged: reading it does not end"))
            try:
                said, value = _receive_answer(link)
            except (EOFError, OSError):
                self._end()
                raise SessionUnreadable(path, phrase("damaged: it cannot be read to its end")) from None
            except Exception as cause:
                self._end()
                raise SessionUnreadable(path, phrase("damaged: what was read of it makes no sense")) from cause
        if said == "done":
            return value
        kind = getattr(errors, said, SessionUnreadable)
        subject, detail = value
        if isinstance(kind, type) and issubclass(kind, CarpusFault):
            raise kind(subject or path, detail)
        raise SessionUnreadable(path, detail)

    def start(self) -> None:
        """Have it ready before the first question; may be called from a thread that nobody waits for. What keeps it
        from starting is told to who asks."""
        with self._lock, contextlib.suppress(OSError):
            self._start_child()

    def end(self) -> None:
        """May be called twice; the next question starts it again."""
        with self._lock:
            self._end()

    def _start_child(self) -> Connection:
        if self._owner != os.getpid():  # a copy of the process that it answers
            self._child = None
        if self._child is None or not self._child.is_alive:
            self._end()
            work = "carpus.core.session.reading_process:run"
            self._child, self._owner = ChildProcess(work, name="reading", is_forked=_can_fork()), os.getpid()
        return self._child.link

    def _end(self) -> None:
        if self._child is not None:
            self._child.end()
            self._child = None


READING_PROCESS = ReadingProcess()
"""One for the whole program: it holds nothing but a process, and ends with the program."""


def _request(name: str, path: Path, *arguments: object) -> Any:
    try:
        is_there, is_file, is_folder = path.exists(), path.is_file(), path.is_dir()
    except (OSError, ValueError):
        is_there = is_file = is_folder = False
    if not is_there:
        raise SessionMissing(path)
    if not is_file:  # neither a folder nor a pipe is handed to HDF5, which would wait for the pipe
        raise SessionUnreadable(path, phrase("a folder") if is_folder else phrase("not a file"))
    return READING_PROCESS.request(name, path, *arguments)


def _can_fork() -> bool:
    """Whether a copy of this process is as good as a new one, and half a second quicker: nothing else runs in it."""
    if not sys.platform.startswith("linux") or threading.active_count() > 1 or "PySide6" in sys.modules:
        return False
    import h5py

    # An HDF5 file that is open here would be the same open file there.
    return bool(h5py.h5f.get_obj_count(h5py.h5f.OBJ_ALL, h5py.h5f.OBJ_ALL) == 0)


def _file_size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


def _receive_answer(link: Connection) -> tuple[str, Any]:
    count = int(link.recv_bytes())
    packed = link.recv_bytes()
    buffers = [link.recv_bytes() for _ in range(count)]
    said, value = _AnswerUnpickler(io.BytesIO(packed), buffers=buffers).load()
    return str(said), value


class _AnswerUnpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        found = super().find_class(module, name) if module.split(".")[0] in ("carpus", "numpy", "pathlib") else None
        own = isinstance(found, type) and not module.startswith("numpy")
        if not own and not (module.startswith("numpy") and name in _NUMPY_NAMES):
            raise pickle.UnpicklingError(f"{module}.{name} is no part of an answer")
        return found

"""Reading of session files in another process.

A damaged file may crash or hang the HDF5 library; it does so in the reading process
(:mod:`core.session.reading_process`), which has limits of time and memory, serves many requests and is restarted when
it has died. Results are values with read-only arrays.
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
"""Time for an answer, and bytes of the file that allow another second: a slow share is no damaged file."""
RAW_CHUNK_BYTES = 1 << 24
_NUMPY_NAMES = ("ndarray", "dtype", "_reconstruct", "_frombuffer", "scalar")
"""Answers consist of these and of this program's classes; a process taken over by a file could send others."""


def read_session(path: Path) -> Session:
    """Read a session; raises :class:`SessionUnreadable`.

    Detections and images are read by :func:`read_detections` and :func:`read_raw`.
    """
    return cast(Session, _request("session", path))


def read_outline(path: Path) -> SessionOutline:
    """Read header, length and state of a session, without its data."""
    return cast(SessionOutline, _request("outline", path))


def read_detections(path: Path) -> DetectionTable:
    """Read the detections of every frame of a session."""
    return cast(DetectionTable, _request("detections", path))


def has_raw(path: Path) -> bool:
    """Return whether the session has stored images."""
    return bool(_request("has_raw", path))


def raw_depth_unit_m(path: Path) -> float:
    """Return metres per count of the stored depth images."""
    return float(_request("raw_depth_unit_m", path))


def read_raw(path: Path) -> Iterator[EncodedImages]:
    """Yield the stored images, frame by frame."""
    row = 0
    while some := cast("list[EncodedImages]", _request("raw_some", path, row, RAW_CHUNK_BYTES)):
        yield from some
        row += len(some)


def read_raw_color(path: Path, row: int) -> bytes:
    """Return the stored colour image of a row; empty if there is none."""
    return cast(bytes, _request("raw_color", path, row))


def verify(path: Path) -> VerificationResult:
    """Verify that a session is complete and unchanged; see :func:`core.session.session_file.verify`."""
    return cast(VerificationResult, _request("verify", path))


def finish_part(part: Path, when: str) -> Path | None:
    """Finish an interrupted part file; see :func:`core.session.rewriting.finish_part`."""
    return cast("Path | None", _request("recover", part, when))


def rewrite_session(path: Path, target: Path, **attributes: str) -> None:
    """Write a session again with changed attributes; see :func:`core.session.rewriting.rewrite_session`."""
    _request("rewrite_session", path, target, attributes)


class ReadingProcess:
    """The process that reads session files; used from any thread, one request at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._child: ChildProcess | None = None
        self._owner = os.getpid()

    def request(self, name: str, path: Path, *arguments: object) -> Any:
        """Send a request about a file and return its answer; raises its fault, or :class:`SessionUnreadable`."""
        with self._lock:
            request = (name, os.fspath(path.absolute()), arguments)  # the child keeps the folder it was started in
            link = self._start_child()
            try:
                link.send(request)
            except OSError:  # it died after its last answer
                self._end()
                link = self._start_child()
                link.send(request)
            try:
                size = path.stat().st_size
            except OSError:
                size = 0
            if not link.poll(TIMEOUT_S + size / BYTES_PER_S):
                self._end()
                raise SessionUnreadable(path, phrase("damaged: Carpus could not finish reading it"))
            try:
                count, packed = int(link.recv_bytes()), link.recv_bytes()
                buffers = [link.recv_bytes() for _ in range(count)]
                outcome, value = _AnswerUnpickler(io.BytesIO(packed), buffers=buffers).load()
            except (EOFError, OSError):
                self._end()
                raise SessionUnreadable(path, phrase("damaged: the end cannot be read")) from None
            except Exception as cause:
                self._end()
                raise SessionUnreadable(path, phrase("damaged: its content is implausible")) from cause
        if outcome == "done":
            return value
        kind = getattr(errors, str(outcome), SessionUnreadable)
        subject, detail = value
        if isinstance(kind, type) and issubclass(kind, CarpusFault):
            raise kind(subject or path, detail)
        raise SessionUnreadable(path, detail)

    def start(self) -> None:
        """Start the process before the first request; a failure is reported by the request."""
        with self._lock, contextlib.suppress(OSError):
            self._start_child()

    def end(self) -> None:
        """End the process; the next request starts it again. May be called twice."""
        with self._lock:
            self._end()

    def _start_child(self) -> Connection:
        if self._owner != os.getpid():  # this is a fork of the process that it answers
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
"""One for the whole program."""


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
    """Return whether forking is safe, which is half a second quicker: no threads, no Qt, no open HDF5 file."""
    if not sys.platform.startswith("linux") or threading.active_count() > 1 or "PySide6" in sys.modules:
        return False
    import h5py

    # An HDF5 file that is open here would be the same open file there.
    return bool(h5py.h5f.get_obj_count(h5py.h5f.OBJ_ALL, h5py.h5f.OBJ_ALL) == 0)


class _AnswerUnpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        found = super().find_class(module, name) if module.split(".")[0] in ("carpus", "numpy", "pathlib") else None
        is_own_class = isinstance(found, type) and not module.startswith("numpy")
        if not is_own_class and not (module.startswith("numpy") and name in _NUMPY_NAMES):
            raise pickle.UnpicklingError(f"{module}.{name} is no part of an answer")
        return found

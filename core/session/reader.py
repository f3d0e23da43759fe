"""Reading of session files in another process.

HDF5 trusts what it reads: a damaged file may crash it, or keep it for ever in one call, in which Python handles no
signal. It does so in the reading process, which has limits of time and memory, answers one request after the other,
opens only the file of the request, and is restarted when it has died. Results are values with read-only arrays.
"""

from __future__ import annotations

import contextlib
import io
import logging
import os
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from functools import partial
from importlib import import_module
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault, SessionMissing, SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.platform.child_process import ChildProcess
from carpus.core.session.values import DetectionTable, EncodedImages, Session, SessionOutline, VerificationResult

if sys.platform != "win32":
    import resource

log = logging.getLogger(__name__)

TIMEOUT_S, BYTES_PER_S = 20.0, 2e6
"""Time for an answer, and bytes of the file that allow another second: a slow share is no damaged file."""
CPU_S, BYTES_PER_CPU_S = 1.2, 5e6
"""Processor time for a request, and bytes of the file that allow another second."""
BASE_MEMORY_BYTES, MEMORY_PER_BYTE = 700_000_000, 10
"""Memory for an answer, and additional memory for each byte of the file, up to :data:`MAX_MEMORY_BYTES`."""
MAX_MEMORY_BYTES = 6_000_000_000
RAW_CHUNK_BYTES = 1 << 24
_NUMPY_NAMES = ("ndarray", "dtype", "_reconstruct", "_frombuffer", "scalar")
"""Answers consist of these and of this program's classes; a process taken over by a file could send others."""


class ReadingProcess:
    """The process that reads session files; used from any thread, one request at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._child: ChildProcess | None = None
        self._owner = os.getpid()

    def request(self, name: str, path: Path, *arguments: object) -> Any:
        """Return what the function ``name`` (``"module:function"``) returns for a file, in the reading process.

        Raises its fault, or :class:`SessionUnreadable`.
        """
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
            self._child, self._owner = ChildProcess(run, name="reading", is_forked=_can_fork()), os.getpid()
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
    return READING_PROCESS.request(f"carpus.core.session.{name}", path, *arguments)


read_session: Callable[[Path], Session] = partial(_request, "session_file:read_session")
"""Read a session; raises :class:`SessionUnreadable`. Detections and images are read by the functions below."""
read_outline: Callable[[Path], SessionOutline] = partial(_request, "session_file:read_outline")
"""Read header, length and state of a session, without its data."""
read_detections: Callable[[Path], DetectionTable] = partial(_request, "session_file:read_detections")
"""Read the detections of every frame of a session."""
has_raw: Callable[[Path], bool] = partial(_request, "session_file:has_raw")
"""Return whether the session has stored images."""
raw_depth_unit_m: Callable[[Path], float] = partial(_request, "session_file:raw_depth_unit_m")
"""Return metres per count of the stored depth images."""
read_raw_color: Callable[[Path, int], bytes] = partial(_request, "session_file:read_raw_color")
"""Return the stored colour image of a row; empty if there is none."""
verify: Callable[[Path], VerificationResult] = partial(_request, "session_file:verify")
"""Verify that a session is complete and unchanged."""
finish_part: Callable[[Path, str], Path | None] = partial(_request, "rewriting:finish_part")
"""Finish an interrupted part file, at a time (ISO 8601)."""


def read_raw(path: Path) -> Iterator[EncodedImages]:
    """Yield the stored images, frame by frame."""
    row = 0
    while some := _request("session_file:read_raw_chunk", path, row, RAW_CHUNK_BYTES):
        yield from some
        row += len(some)


def rewrite_session(path: Path, target: Path, **attributes: str) -> None:
    """Write a session again with changed attributes; see :func:`core.session.rewriting.rewrite_session`."""
    _request("rewriting:rewrite_session", path, target, attributes)


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


# --- in the reading process -----------------------------------------------------------------------------------
def run(link: Connection) -> None:
    """Answer requests (function, path, arguments) until the owner is gone (entry point of the process).

    An answer is sent as several messages: a count, the pickled answer, then the buffers of its arrays.
    """
    if sys.platform != "win32":
        signal.signal(signal.SIGPROF, signal.SIG_DFL)  # the limit ends the process
    import_module("carpus.core.session.rewriting")  # before the first request and its limits
    while True:
        try:
            name, path, arguments = link.recv()
        except (EOFError, OSError):
            return
        try:
            size_bytes = Path(path).stat().st_size
        except OSError:
            size_bytes = 0
        _set_limits(size_bytes)
        answer = _answer(name, Path(path), arguments)
        if sys.platform != "win32":  # sending has no limits
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            hard = resource.getrlimit(resource.RLIMIT_AS)[1]
            resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
        buffers: list[pickle.PickleBuffer] = []
        try:
            packed = pickle.dumps(answer, protocol=5, buffer_callback=buffers.append)
        except MemoryError:
            text = "it asks for more memory than a session needs"
            packed, buffers = pickle.dumps(("SessionUnreadable", ("", text))), []
        try:
            link.send_bytes(str(len(buffers)).encode())
            link.send_bytes(packed)
            for buffer in buffers:
                link.send_bytes(buffer.raw())
        except OSError:
            return


def _answer(name: str, path: Path, arguments: tuple[Any, ...]) -> tuple[str, Any]:
    """Return ``done`` and the value, or the name of a fault with its subject and detail."""
    try:
        module, _, function = name.partition(":")
        return "done", getattr(import_module(module), function)(path, *arguments)
    except CarpusFault as fault:
        return type(fault).__name__, (fault.subject, fault.detail)
    except MemoryError:
        return "SessionUnreadable", (str(path), "damaged: needs more memory than any session")
    except Exception as cause:  # reported to the owner, not printed
        log.info("reading %s: %s: %s", path, type(cause).__name__, cause)
        return "SessionUnreadable", (str(path), phrase("damaged"))


def _set_limits(size_bytes: int) -> None:
    """Limit processor time and memory of this process, enforced by the system."""
    if sys.platform == "win32":
        return  # only the owner's timeout applies
    signal.setitimer(signal.ITIMER_PROF, CPU_S + size_bytes / BYTES_PER_CPU_S)
    room = min(BASE_MEMORY_BYTES + MEMORY_PER_BYTE * size_bytes, MAX_MEMORY_BYTES)
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    try:
        in_use = int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        in_use = 2_000_000_000
    wanted = in_use + room
    resource.setrlimit(resource.RLIMIT_AS, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard))

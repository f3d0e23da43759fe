"""The reading process: opens the session files that nobody vouches for, with limits of time and memory.

HDF5 trusts what it reads. A file with two blocks exchanged keeps it in one call for ever, deaf to every signal that
Python would hear of; such a process is ended from outside, and the program goes on. The process answers one question
after the other and opens nothing but the file it is asked about.
"""

from __future__ import annotations

import logging
import os
import pickle
import signal
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.session import rewriting, session_file

log = logging.getLogger(__name__)

CPU_S, BYTES_PER_CPU_S = 1.2, 5e6
"""A question may take so much of a processor's time, and a second more for so many bytes of the file."""
BASE_MEMORY_BYTES, MEMORY_PER_BYTE = 700_000_000, 10
"""Room for an answer, and so much more for each byte of the file, up to :data:`MAX_MEMORY_BYTES`."""
MAX_MEMORY_BYTES = 6_000_000_000

QUESTIONS: dict[str, Callable[..., Any]] = {
    "session": session_file.read_session,
    "outline": session_file.read_outline,
    "detections": session_file.read_detections,
    "has_raw": session_file.has_raw,
    "raw_depth_unit_m": session_file.raw_depth_unit_m,
    "raw_some": session_file.read_raw_chunk,
    "raw_color": session_file.read_raw_color,
    "recover": rewriting.finish_part,
    "verify": session_file.verify,
    "write_anew": rewriting.rewrite_session,
}
Answer = tuple[str, Any]
"""``done`` and the value, or the name of a fault with its subject and detail."""


def compute_cpu_limit_s(size_bytes: int) -> float:
    """Processor time that a question about a file of this size may take."""
    return CPU_S + size_bytes / BYTES_PER_CPU_S


def run(link: Connection) -> None:
    """Entry of the process: questions (name, path, arguments) come, answers go, until the owner is gone.

    An answer is sent as several messages: a count, the pickled answer, then the buffers of its arrays.
    """
    if sys.platform != "win32":
        signal.signal(signal.SIGPROF, signal.SIG_DFL)  # ends it, whatever it was begun with
    while True:
        try:
            name, path, arguments = link.recv()
        except (EOFError, OSError):
            return
        size = _file_size(path)
        _set_limits(size)
        answer = _answer(QUESTIONS[name], Path(path), arguments)
        _clear_limits()
        try:
            _send(link, answer)
        except OSError:
            return


def _answer(question: Callable[..., Any], path: Path, arguments: tuple[Any, ...]) -> Answer:
    try:
        return "done", question(path, *arguments)
    except CarpusFault as fault:
        return type(fault).__name__, (fault.subject, fault.detail)
    except MemoryError:
        return "SessionUnreadable", (str(path), "damaged: it asks for more memory than a session needs")
    except Exception as cause:  # the one catch of this process: told, not printed
        log.info("reading %s: %s: %s", path, type(cause).__name__, cause)
        return "SessionUnreadable", (str(path), phrase("damaged"))


def _send(link: Connection, answer: Answer) -> None:
    buffers: list[pickle.PickleBuffer] = []
    try:
        packed = pickle.dumps(answer, protocol=5, buffer_callback=buffers.append)
    except MemoryError:
        packed, buffers = pickle.dumps(("SessionUnreadable", ("", "it asks for more memory than a session needs"))), []
    link.send_bytes(str(len(buffers)).encode())
    link.send_bytes(packed)
    for buffer in buffers:
        link.send_bytes(buffer.raw())


def _file_size(path: str) -> int:
    try:
        return Path(path).stat().st_size
    except OSError:
        return 0


def _set_limits(size_bytes: int) -> None:
    """From now on this process is ended by the system when it takes too long, and refused what is too much."""
    if sys.platform == "win32":
        return  # the owner's patience alone
    import resource

    signal.setitimer(signal.ITIMER_PROF, compute_cpu_limit_s(size_bytes))
    room = min(BASE_MEMORY_BYTES + MEMORY_PER_BYTE * size_bytes, MAX_MEMORY_BYTES)
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    wanted = _address_space_bytes() + room
    resource.setrlimit(resource.RLIMIT_AS, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard))


def _clear_limits() -> None:
    if sys.platform != "win32":
        import resource

        signal.setitimer(signal.ITIMER_PROF, 0.0)
        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        resource.setrlimit(resource.RLIMIT_AS, (hard, hard))


def _address_space_bytes() -> int:
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 2_000_000_000

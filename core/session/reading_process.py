"""The reading process: opens session files of unknown origin with limits of time and memory.

HDF5 trusts what it reads. A file with two blocks exchanged keeps it in one call for ever, in which Python handles no
signal; such a process is ended from outside. It answers one request after the other and opens only the file of the
request.
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

if sys.platform != "win32":
    import resource

log = logging.getLogger(__name__)

CPU_S, BYTES_PER_CPU_S = 1.2, 5e6
"""Processor time for a request, and bytes of the file that allow another second."""
BASE_MEMORY_BYTES, MEMORY_PER_BYTE = 700_000_000, 10
"""Memory for an answer, and additional memory for each byte of the file, up to :data:`MAX_MEMORY_BYTES`."""
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
    "rewrite_session": rewriting.rewrite_session,
}
Answer = tuple[str, Any]
"""``done`` and the value, or the name of a fault with its subject and detail."""


def run(link: Connection) -> None:
    """Answer requests (name, path, arguments) until the owner is gone (entry point of the process).

    An answer is sent as several messages: a count, the pickled answer, then the buffers of its arrays.
    """
    if sys.platform != "win32":
        signal.signal(signal.SIGPROF, signal.SIG_DFL)  # the limit ends the process
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
        answer = _answer(QUESTIONS[name], Path(path), arguments)
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


def _answer(question: Callable[..., Any], path: Path, arguments: tuple[Any, ...]) -> Answer:
    try:
        return "done", question(path, *arguments)
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

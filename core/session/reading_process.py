"""The reading process: opens the session files that nobody vouches for, with limits of time and memory; finishes those
that were cut short and writes one anew for another patient.

HDF5 trusts what it reads. A file with two blocks exchanged keeps it in one call for ever, deaf to every signal that
Python would hear of; such a process is ended from outside, and the program goes on. The process answers one question
after the other and opens nothing but the file it is asked about.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import h5py

from carpus.core.durable import write_fault
from carpus.core.errors import SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.session import schema
from carpus.core.session.disk import allow_written_bytes, free_name, part_path, publish, target_of_part
from carpus.core.session.new_file import new_file
from carpus.core.session.opened import open_session, read_session, verify
from carpus.core.session.rows import growing_fields, readable_rows, unchecked_chunk, whole_rows
from carpus.core.session.seal import ATTRIBUTE, seal_of


def finish_part(part: Path, when: str) -> Path | None:
    """Finish one part file: what every dataset holds stays, and the file gets its name, or a free one beside it.

    Returns the session's path. None, and the file stays, where it ended before the first frame was stored.
    """
    own_name = target_of_part(part)
    if own_name is None:
        raise SessionUnreadable(part, phrase("not the part file of a session"))
    if own_name.exists() and own_name.samefile(
        part
    ):  # ended between the last two steps: only the old name is left over
        part.unlink()
        return own_name
    if not _holds_anything(part):
        return None
    if not _is_reachable(part):
        allow_written_bytes(part)
    with open_session(part) as file:
        finished = bool(file.attrs["complete"])
        if not finished and whole_rows(file).frames == 0:
            return None
    if not finished:
        _finish(part, when)
    read_session(part)
    target = free_name(own_name)
    publish(part, target)
    return target


def _finish(part: Path, when: str) -> None:
    """Cut every dataset to the rows that all of them hold, and mark the file."""
    try:
        with h5py.File(part, "r+") as file:
            rows = whole_rows(file)
            for field, dataset in growing_fields(file):
                end = rows.along(str(field.shape[0]))
                _mend_last_chunk(dataset, end)
                dataset.resize(end, axis=0)
            if "/smoothed" in file and not _smoothed_is_whole(file, rows.frames):
                del file["/smoothed"]  # half of a result that can be computed again
            file.attrs[schema.RECOVERED] = when
            file.attrs.modify("complete", True)
            file.attrs[ATTRIBUTE] = seal_of(file)
    except (OSError, RuntimeError, KeyError) as cause:
        if isinstance(cause, KeyError):
            raise SessionUnreadable(part, phrase("damaged: {what}", what=cause.args[0])) from cause
        raise write_fault(part, cause) from cause


def _mend_last_chunk(dataset: h5py.Dataset, end: int) -> None:
    """A chunk that the program was adding to when it ended has the check sum of another moment: write it again."""
    if end == 0 or not dataset.fletcher32 or dataset.dtype.kind == "O":
        return
    last = (end - 1) // dataset.chunks[0] * dataset.chunks[0]
    try:
        dataset[last:end]
    except (OSError, RuntimeError):
        rows = unchecked_chunk(dataset, last)
        dataset.resize(last + dataset.chunks[0], axis=0)  # a whole chunk is written without being read before
        dataset[last:] = rows


def _holds_anything(part: Path) -> bool:
    """Whether a byte was written; a program that ended while it began leaves room that was only reserved."""
    with part.open("rb") as file:
        while block := file.read(1 << 20):
            if block.strip(b"\0"):
                return True
    return False


def _smoothed_is_whole(file: h5py.File, frames: int) -> bool:
    fields = [f for f in schema.SMOOTHED_FIELDS if not f.fingers_only or "/joints" in file]
    try:
        return all(file[field.path][()].shape[0] == frames for field in fields)
    except (KeyError, OSError, RuntimeError):
        return False


def _is_reachable(part: Path) -> bool:
    """Whether every row that the file announces can be read."""
    try:
        with h5py.File(part, "r") as file:
            return all(readable_rows(dataset) == dataset.shape[0] for _, dataset in growing_fields(file))
    except (OSError, RuntimeError, KeyError):
        return False


def given(path: Path, target: Path, subject_id: str) -> None:
    """Write a session as ``target``: all that it says stays, but not a byte of the former name.

    Raises :class:`SessionUnreadable`, :class:`SessionChanged` for one that is not whole, and the faults of writing;
    then nothing is left behind.
    """
    verify(path)
    with open_session(path) as old:
        part = part_path(target, str(old.attrs["session_id"]))
        try:
            with new_file(part) as file:
                _copy(old, file, subject_id)
            with part.open("rb") as written:
                os.fsync(written.fileno())
            verify(part)
            publish(part, target)
        except (OSError, RuntimeError) as cause:
            raise write_fault(target, cause) from cause
        finally:
            part.unlink(missing_ok=True)


def _copy(old: h5py.File, file: h5py.File, subject_id: str) -> None:
    for name in old:
        old.copy(name, file)
    for name, value in old.attrs.items():
        if name != ATTRIBUTE:
            file.attrs[name] = subject_id if name == "subject_id" else value
    if ATTRIBUTE in old.attrs:
        file.attrs[ATTRIBUTE] = seal_of(file)


CPU_S, BYTES_PER_CPU_S = 1.2, 20e6
"""A question may take so much of a processor's time, and a second more for so many bytes of the file."""
MEMORY_BYTES, MEMORY_PER_BYTE = 700_000_000, 3
"""Room for an answer, and so much more for each byte of the file, up to :data:`MOST_MEMORY_BYTES`."""
MOST_MEMORY_BYTES = 6_000_000_000

Answer = tuple[str, Any]
"""``done`` and the value, or the name of a fault with its subject and detail."""


def cpu_limit_s(size_bytes: int) -> float:
    """Processor time that a question about a file of this size may take."""
    return CPU_S + size_bytes / BYTES_PER_CPU_S


def run(link: Connection) -> None:
    """Entry of the process: questions (name, path, arguments) come, answers go, until the owner is gone.

    An answer is sent as several messages: a count, the pickled answer, then the buffers of its arrays.
    """
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGPROF"):
        number = getattr(signal, name, None)
        if number is not None:
            signal.signal(number, signal.SIG_IGN if name == "SIGINT" else signal.SIG_DFL)
    questions = _questions()
    while True:
        try:
            name, path, arguments = link.recv()
        except (EOFError, OSError):
            return
        size = _size(path)
        _limit(size)
        answer = _answered(questions[name], Path(path), arguments)
        _limit_no_more()
        try:
            _send(link, answer)
        except OSError:
            return


def _questions() -> dict[str, Callable[..., Any]]:
    from carpus.core.session import opened

    return {
        "session": opened.read_session,
        "outline": opened.read_outline,
        "detections": opened.read_detections,
        "has_raw": opened.has_raw,
        "raw_depth_unit_m": opened.raw_depth_unit_m,
        "raw_some": opened.read_raw_some,
        "raw_color": opened.read_raw_color,
        "recover": finish_part,
        "verify": opened.verify,
        "give": given,
    }


def _answered(question: Callable[..., Any], path: Path, arguments: tuple[Any, ...]) -> Answer:
    from carpus.core.errors import CarpusFault

    try:
        return "done", question(path, *arguments)
    except CarpusFault as fault:
        return type(fault).__name__, (fault.subject, fault.detail)
    except MemoryError:
        return "SessionUnreadable", (str(path), "damaged: it asks for more memory than a session needs")
    except Exception as cause:  # the one catch of this process: told, not printed
        return "SessionUnreadable", (str(path), f"damaged: {type(cause).__name__}: {cause}"[:300])


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


def _size(path: str) -> int:
    try:
        return Path(path).stat().st_size
    except OSError:
        return 0


def _limit(size_bytes: int) -> None:
    """From now on this process is ended by the system when it takes too long, and refused what is too much."""
    if sys.platform == "win32":
        return  # the owner's patience alone
    import resource

    signal.setitimer(signal.ITIMER_PROF, cpu_limit_s(size_bytes))
    room = min(MEMORY_BYTES + MEMORY_PER_BYTE * size_bytes, MOST_MEMORY_BYTES)
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    wanted = _address_space_bytes() + room
    resource.setrlimit(resource.RLIMIT_AS, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard))


def _limit_no_more() -> None:
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

"""Finishes sessions that were cut short: what every dataset holds stays, and the file gets its name."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import h5py

from core.errors import CarpusFault, RecordingMissing, SessionUnreadable
from core.session import schema
from core.session.disk import is_being_written, publish, target_of_part, write_fault
from core.session.reader import open_session, read_session
from core.session.rows import growing_fields, readable_rows, whole_rows

_SUPERBLOCK = struct.Struct("<8sB4xB10xQ8xQ")
"""Start of an HDF5 file: signature, version, size of addresses, base address, end-of-file address."""
_END_OF_FILE_AT = _SUPERBLOCK.size - 8


@dataclass(frozen=True, slots=True)
class Recovery:
    """``recovered`` the files finished; ``busy`` part files still being written; ``faults`` one for each file left;
    ``empty`` part files in which nothing had been stored yet."""

    recovered: tuple[Path, ...]
    busy: tuple[Path, ...]
    faults: tuple[CarpusFault, ...]
    empty: tuple[Path, ...] = ()


def interrupted_sessions(folder: Path) -> list[Path]:
    """The part files of a folder and the folders in it, also of sessions that are running."""
    return sorted(path for path in folder.rglob("*.part") if target_of_part(path) is not None)


def recover_folder(folder: Path, now: datetime | None = None) -> Recovery:
    """Finish every interrupted session of a folder and the folders in it; what cannot be finished stays as it is.

    Raises :class:`RecordingMissing` when there is no such folder.
    """
    if not folder.is_dir():
        raise RecordingMissing(folder)
    recovered, busy, faults, empty = [], [], [], []
    for part in interrupted_sessions(folder):
        try:
            if is_being_written(part):
                busy.append(part)
                continue
            target = recover(part, now)
            if target is None:
                empty.append(part)
            else:
                recovered.append(target)
        except CarpusFault as fault:
            faults.append(fault)
        except OSError as cause:
            faults.append(SessionUnreadable(part, cause.strerror or "cannot be opened"))
    return Recovery(tuple(recovered), tuple(busy), tuple(faults), tuple(empty))


def recover(part: Path, now: datetime | None = None) -> Path | None:
    """Finish one part file and return the session's path: its own name, or a free one beside it. None, and the file
    stays, where it ended before the first frame was stored."""
    own_name = target_of_part(part)
    if own_name is None:
        raise SessionUnreadable(part, "not the part file of a session")
    if own_name.exists() and own_name.samefile(
        part
    ):  # ended between the last two steps: only the old name is left over
        part.unlink()
        return own_name
    if not _is_reachable(part):
        _allow_written_bytes(part)
    with open_session(part) as file:
        finished = bool(file.attrs["complete"])
        if not finished and whole_rows(file).frames == 0:
            return None
    if not finished:
        _finish(part, (now or datetime.now().astimezone()).isoformat(timespec="seconds"))
    read_session(part)
    target = _free_name(own_name)
    publish(part, target)
    return target


def _finish(part: Path, when: str) -> None:
    """Cut every dataset to the rows that all of them hold, and mark the file."""
    try:
        with h5py.File(part, "r+") as file:
            rows = whole_rows(file)
            for field, dataset in growing_fields(file):
                dataset.resize(rows.along(str(field.shape[0])), axis=0)
            if "/smoothed" in file and not _smoothed_is_whole(file, rows.frames):
                del file["/smoothed"]  # half of a result that can be computed again
            file.attrs[schema.RECOVERED] = when
            file.attrs.modify("complete", True)
    except (OSError, RuntimeError, KeyError) as cause:
        if isinstance(cause, KeyError):
            raise SessionUnreadable(part, f"damaged: {cause.args[0]}") from cause
        raise write_fault(part, cause) from cause


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


def _allow_written_bytes(part: Path) -> None:
    """Set the end-of-file address to the file's true length.

    HDF5 writes that address last. A kill before it leaves good data behind an end that is too early, which HDF5
    then refuses to read; the writer reserves room in advance, so the true length always covers them.
    """
    try:
        with part.open("r+b") as file:
            start = file.read(_SUPERBLOCK.size)
            length = file.seek(0, 2)
            if len(start) < _SUPERBLOCK.size:
                return
            *kind, end = _SUPERBLOCK.unpack(start)
            if kind == [b"\x89HDF\r\n\x1a\n", 0, 8, 0] and end < length:
                file.seek(_END_OF_FILE_AT)
                file.write(struct.pack("<Q", length))
    except OSError as cause:
        raise write_fault(part, cause) from cause


def _free_name(target: Path) -> Path:
    candidate, number = target, 1
    while candidate.exists() or candidate.is_symlink():
        number += 1
        candidate = target.with_name(f"{target.stem}-{number}{target.suffix}")
    return candidate

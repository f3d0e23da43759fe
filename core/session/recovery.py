"""Finishes sessions that were cut short: what every dataset holds stays, and the file gets its name."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import h5py

from carpus.core.durable import write_fault
from carpus.core.errors import CarpusFault, RecordingMissing, SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.session import heartbeat, reader, schema
from carpus.core.session.disk import allow_written_bytes, free_name, is_being_written, publish, target_of_part
from carpus.core.session.opened import open_session, read_session
from carpus.core.session.rows import growing_fields, readable_rows, unchecked_chunk, whole_rows
from carpus.core.session.seal import ATTRIBUTE, seal_of


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


def recover_folder(folder: Path, now: datetime | None = None, given_up: Collection[Path] = ()) -> Recovery:
    """Finish every interrupted session of a folder and the folders in it; what cannot be finished stays as it is,
    and the part files ``given_up`` are not looked at.

    Raises :class:`RecordingMissing` when there is no such folder.
    """
    if not folder.is_dir():
        raise RecordingMissing(folder)
    when = (now or datetime.now().astimezone()).isoformat(timespec="seconds")
    recovered, busy, faults, empty = [], [], [], []
    parts = [part for part in interrupted_sessions(folder) if part not in given_up]
    beating = heartbeat.still_beating(parts)
    for part in parts:
        try:
            if part in beating or is_being_written(part):
                busy.append(part)
                continue
            target = reader.finish_part(part, when)
            heartbeat.remove(part)
            if target is None:
                empty.append(part)
            else:
                recovered.append(target)
        except CarpusFault as fault:
            faults.append(fault)
        except OSError as cause:
            faults.append(SessionUnreadable(part, cause.strerror or phrase("cannot be opened")))
    return Recovery(tuple(recovered), tuple(busy), tuple(faults), tuple(empty))


def finish_part(part: Path, when: str) -> Path | None:
    """Finish one part file and return the session's path: its own name, or a free one beside it. None, and the file
    stays, where it ended before the first frame was stored. Runs in the reading process."""
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

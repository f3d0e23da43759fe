"""What the reading process writes: a session cut short is finished, one is written anew for another patient or as a
further result."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

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


def write_anew(path: Path, target: Path, said: Mapping[str, str]) -> None:
    """Write a session as ``target`` with other attributes: all else stays, and not a byte of what they said before.

    Raises :class:`SessionUnreadable`, :class:`SessionChanged` for one that is not whole, and the faults of writing;
    then nothing is left behind.
    """
    verify(path)
    with open_session(path) as old:
        part = part_path(target, str(old.attrs["session_id"]))
        try:
            with new_file(part) as file:
                _copy(old, file, said)
            with part.open("rb") as written:
                os.fsync(written.fileno())
            verify(part)
            publish(part, target)
        except (OSError, RuntimeError) as cause:
            raise write_fault(target, cause) from cause
        finally:
            part.unlink(missing_ok=True)


def _copy(old: h5py.File, file: h5py.File, said: Mapping[str, str]) -> None:
    told = {**old.attrs, **said}
    for name in sorted(told, key=[*schema.ROOT_ATTRIBUTES, *told].index):  # as it was recorded
        if name != ATTRIBUTE:
            file.attrs[name] = told[name]
    for name in old:
        old.copy(name, file)
    if ATTRIBUTE in old.attrs:
        file.attrs[ATTRIBUTE] = seal_of(file)

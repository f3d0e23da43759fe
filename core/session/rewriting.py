"""What the reading process writes: interrupted sessions are finished, others rewritten with changed attributes."""

from __future__ import annotations

import os
import re
import shutil
import struct
from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path

import h5py

from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import find_free_name, publish, temporary_path, write_fault
from carpus.core.session import schema
from carpus.core.session.checksum import CHECKSUM_ATTRIBUTE, compute_checksum
from carpus.core.session.file_layout import create_dataset
from carpus.core.session.session_file import layout_from_file, open_session, verify
from carpus.core.session.structure import (
    RowCounts,
    count_readable_rows,
    count_whole_rows,
    find_growing_fields,
    read_rows,
)

_SUPERBLOCK = struct.Struct("<8sB4xB10xQ8xQ")
"""Start of an HDF5 file: signature, version, size of addresses, base address, end-of-file address."""
_END_OF_FILE_AT = _SUPERBLOCK.size - 8
_PART = re.compile(r"(?P<target>.+)\.[0-9a-f]{8}\.part")


def find_part_target(part: Path) -> Path | None:
    """Return the final name of a part file of Carpus 0.2.0; None for any other file."""
    match = _PART.fullmatch(part.name)
    return part.with_name(match["target"]) if match else None


def finish_part(part: Path, when: str) -> Path | None:
    """Write a session from a part file of Carpus 0.2.0, with the rows that every dataset has.

    The part file is not changed, and removed when the session has its name, or a free one beside it.

    Returns
    -------
    Path or None
        The session; None if the part file ended before its first frame, and is kept.
    """
    own_name = find_part_target(part)
    if own_name is None:
        raise SessionUnreadable(part, phrase("not the part file of a session"))
    if own_name.exists() and own_name.samefile(part):  # ended between the last two steps: the old name is left over
        part.unlink()
        return own_name
    target = find_free_name(own_name)
    copy, new = temporary_path(target), temporary_path(target)
    try:
        shutil.copyfile(part, copy)
        copy.chmod(0o600)
        with copy.open("rb") as file:
            if not any(block.strip(b"\0") for block in iter(partial(file.read, 1 << 20), b"")):
                return None  # space was reserved, and nothing written
        _repair_file_end(copy)
        with open_session(copy) as old:
            rows = count_whole_rows(old)
            if rows.frames == 0:
                return None
            with h5py.File(new, "x", libver="earliest") as file:
                new.chmod(0o600)
                _copy_whole_rows(old, file, rows)
                file.attrs["complete"] = True
                file.attrs.setdefault(schema.RECOVERED, when)
                file.attrs[CHECKSUM_ATTRIBUTE] = compute_checksum(file)
        with new.open("r+b") as written:
            os.fsync(written.fileno())
        verify(new)
        publish(new, target)
    except SessionUnreadable as fault:
        raise SessionUnreadable(part, fault.detail) from fault
    except OSError as cause:
        raise write_fault(target, cause) from cause
    finally:
        copy.unlink(missing_ok=True)
        new.unlink(missing_ok=True)
    part.unlink()
    return target


def _repair_file_end(part: Path) -> None:
    """Set the end-of-file address to the file's true length.

    HDF5 writes that address last. After a kill before it, HDF5 refuses to read good data behind an end that is too
    early; space was reserved in advance, so the true length always covers them.
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


def _copy_whole_rows(old: h5py.File, file: h5py.File, rows: RowCounts) -> None:
    """Copy a part file, each dataset cut to the rows that all of them have.

    Half a smoother's result is left out, since it can be computed again, and so is an unreadable table of repetitions.
    """
    for name in old.attrs:
        if name != CHECKSUM_ATTRIBUTE:
            file.attrs[name] = old.attrs[name]
    for name in ("camera", "calibration"):
        old.copy(name, file)
    layout = layout_from_file(Path(old.filename), old)
    smoothed = {field.path: field for field in schema.SMOOTHED_FIELDS if layout.has(field)}
    fields = {field.path: field for field, _ in find_growing_fields(old)}
    with suppress(OSError, RuntimeError, KeyError):
        if all(count_readable_rows(old[path]) == rows.frames for path in smoothed):
            fields |= smoothed
    for path, field in fields.items():
        end = rows.axis_length(str(field.shape[0]))
        dataset = create_dataset(file, field, layout)
        dataset.resize(end, axis=0)
        kept = read_rows(old[path], end)
        dataset[:] = kept.view(dataset.dtype) if kept.dtype.kind == "S" else kept  # those of 0.2.0 are marked as UTF-8
    for name, names in layout.group_names().items():
        for group in (name, f"/smoothed{name}"):
            if group in file:
                file[group].attrs["names"] = names
    if "/raw" in file:
        file["/raw"].attrs[schema.RAW_DEPTH_UNIT] = old["/raw"].attrs[schema.RAW_DEPTH_UNIT]
    with suppress(OSError, RuntimeError, KeyError):
        old.copy(schema.REPETITIONS.path, file)


def rewrite_session(path: Path, target: Path, changed: Mapping[str, str]) -> None:
    """Write a session as ``target`` with changed attributes; no byte of their old values remains.

    Raises
    ------
    SessionUnreadable, SessionChanged
        The session is not complete and unchanged.
    OutputExists, OutputNotWritable, DiskFull
        It could not be written; nothing is left.
    """
    verify(path)
    with open_session(path) as old:
        part = temporary_path(target)
        try:
            with h5py.File(part, "x", libver="earliest") as file:
                part.chmod(0o600)
                attributes = {**old.attrs, **changed}
                for name in sorted(attributes, key=[*schema.ROOT_ATTRIBUTES, *attributes].index):  # as it was recorded
                    if name != CHECKSUM_ATTRIBUTE:
                        file.attrs[name] = attributes[name]
                for name in old:
                    old.copy(name, file)
                if CHECKSUM_ATTRIBUTE in old.attrs:
                    file.attrs[CHECKSUM_ATTRIBUTE] = compute_checksum(file)
            with part.open("rb") as written:
                os.fsync(written.fileno())
            verify(part)
            publish(part, target)
        except (OSError, RuntimeError) as cause:
            raise write_fault(target, cause) from cause
        finally:
            part.unlink(missing_ok=True)

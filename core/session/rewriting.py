"""What the reading process writes: interrupted sessions are finished, others rewritten with changed attributes."""

from __future__ import annotations

import math
import os
import re
import shutil
import struct
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import find_free_name, publish, temporary_path, write_fault
from carpus.core.session import schema
from carpus.core.session.checks import CHECKSUM_ATTRIBUTE, compute_checksum, count_stored_rows
from carpus.core.session.file_layout import create_dataset
from carpus.core.session.schema import Field
from carpus.core.session.session_file import SessionFile, open_session, verify

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
    copy = temporary_path(target)
    try:
        shutil.copyfile(part, copy)
        copy.chmod(0o600)
        with copy.open("rb") as file:
            if not any(block.strip(b"\0") for block in iter(partial(file.read, 1 << 20), b"")):
                return None  # space was reserved, and nothing written
        _repair_file_end(copy)
        with open_session(copy) as old:
            rows = _count_whole_rows(old)
        if rows["N"] == 0:
            return None
        with _new_session(target) as file, open_session(copy) as old:
            _copy_whole_rows(old, file, rows)
            file.attrs["complete"] = True
            file.attrs.setdefault(schema.RECOVERED, when)
            file.attrs[CHECKSUM_ATTRIBUTE] = compute_checksum(file)
    except SessionUnreadable as fault:
        raise SessionUnreadable(part, fault.detail) from fault
    except OSError as cause:
        raise write_fault(target, cause) from cause
    finally:
        copy.unlink(missing_ok=True)
    part.unlink()
    return target


@contextmanager
def _new_session(target: Path) -> Iterator[h5py.File]:
    """Create a session file, which gets its name when it is complete and verified; after a fault nothing is left."""
    part = temporary_path(target)
    try:
        with h5py.File(part, "x", libver="earliest") as file:
            part.chmod(0o600)
            yield file
        with part.open("r+b") as written:
            os.fsync(written.fileno())
        verify(part)
        publish(part, target)
    except (OSError, RuntimeError) as cause:
        raise write_fault(target, cause) from cause
    finally:
        part.unlink(missing_ok=True)


def _repair_file_end(part: Path) -> None:
    """Set the end-of-file address to the file's true length.

    HDF5 writes that address last. After a kill before it, HDF5 refuses to read good data behind an end that is too
    early; space was reserved in advance, so the true length always covers them.
    """
    with part.open("r+b") as file:
        start = file.read(_SUPERBLOCK.size)
        length = file.seek(0, 2)
        if len(start) < _SUPERBLOCK.size:
            return
        *kind, end = _SUPERBLOCK.unpack(start)
        if kind == [b"\x89HDF\r\n\x1a\n", 0, 8, 0] and end < length:
            file.seek(_END_OF_FILE_AT)
            file.write(struct.pack("<Q", length))


def _copy_whole_rows(old: h5py.File, file: h5py.File, rows: Mapping[str, int]) -> None:
    """Copy a part file, each dataset cut to the rows that all of them have.

    Half a smoother's result is left out, since it can be computed again, and so is an unreadable table of repetitions.
    """
    for name in old.attrs:
        if name != CHECKSUM_ATTRIBUTE:
            file.attrs[name] = old.attrs[name]
    for name in ("camera", "calibration"):
        old.copy(name, file)
    layout = SessionFile(Path(old.filename), old).layout
    smoothed = {field.path: field for field in schema.SMOOTHED_FIELDS if layout.has(field)}
    fields = {field.path: field for field, _ in _growing_datasets(old)}
    with suppress(OSError, RuntimeError, KeyError):
        if all(_count_readable_rows(old[path]) == rows["N"] for path in smoothed):
            fields |= smoothed
    for path, field in fields.items():
        end = rows[str(field.shape[0])]
        dataset = create_dataset(file, field, layout)
        dataset.resize(end, axis=0)
        kept = _read_rows(old[path], end)
        dataset[:] = kept.view(dataset.dtype) if kept.dtype.kind == "S" else kept  # those of 0.2.0 are marked as UTF-8
    for name, names in layout.group_names().items():
        for group in (name, f"/smoothed{name}"):
            if group in file:
                file[group].attrs["names"] = names
    if "/raw" in file:
        file["/raw"].attrs[schema.RAW_DEPTH_UNIT] = old["/raw"].attrs[schema.RAW_DEPTH_UNIT]
    with suppress(OSError, RuntimeError, KeyError):
        old.copy(schema.REPETITIONS.path, file)


def _growing_datasets(file: h5py.File) -> list[tuple[Field, h5py.Dataset]]:
    """Return the datasets of this file that grew while it was written; they differ in length."""
    growing = (field for field in schema.ALL_FIELDS if field.shape[0] in schema.GROWING_AXES)
    return [
        (field, file[field.path]) for field in growing if field not in schema.SMOOTHED_FIELDS and field.path in file
    ]


def _count_whole_rows(file: h5py.File) -> dict[str, int]:
    """Return how many rows from the start every dataset has, by axis; each frame has its detections and images."""
    growing = _growing_datasets(file)
    longest = {
        axis: min((_count_readable_rows(data) for field, data in growing if field.shape[0] == axis), default=0)
        for axis in schema.GROWING_AXES
    }
    timestamp_s = _read_rows(file["/frames/timestamp"], longest["N"])
    is_valid = np.isfinite(timestamp_s)
    is_valid[1:] &= np.diff(timestamp_s) > 0.0
    frames = _count_leading(is_valid)
    frames, detections = _count_with_detections(file, frames, longest["D"])
    for stream, end in zip(schema.RAW_STREAMS, schema.RAW_ENDS, strict=True):
        if end.path in file:
            reached = _read_rows(file[end.path], frames)
            is_valid = reached >= 0
            is_valid[1:] &= np.diff(reached) >= 0
            reached = reached[: _count_leading(is_valid)]
            frames = int(np.searchsorted(reached, longest[str(stream.shape[0])], side="right"))
    ends = (
        int(_read_rows(file[end.path], frames)[-1]) if end.path in file and frames > 0 else 0 for end in schema.RAW_ENDS
    )
    detections = min(detections, _count_with_detections(file, frames, longest["D"])[1])
    events = 0
    with suppress(OSError, RuntimeError, KeyError):  # a table of events that is broken does not condemn the frames
        events = _count_leading(np.isfinite(_read_rows(file["/events/time"], longest["E"])))
    return dict(zip(schema.GROWING_AXES, (frames, detections, events, *ends), strict=True))


def _count_readable_rows(dataset: h5py.Dataset) -> int:
    """Return the rows that can be read: a kill during a flush may leave the last chunk announced but unreachable."""
    rows = int(dataset.shape[0])
    if not dataset.chunks:
        return rows
    step = dataset.chunks[0]
    rows = min(rows, count_stored_rows(dataset))
    while rows > 0:
        begin = (rows - 1) // step * step
        try:
            _read_rows(dataset, rows, begin)
        except (OSError, RuntimeError):
            rows = begin
        else:
            break
    return rows


def _read_rows(dataset: h5py.Dataset, end: int, first: int = 0) -> NDArray[Any]:
    """Read rows of an interrupted session.

    A chunk with a wrong checksum was being written when the program ended. Only its end is new, so it is read anyway,
    and the times show which of its rows are valid.
    """
    try:
        return np.asarray(dataset[first:end])
    except (OSError, RuntimeError):
        step = dataset.chunks[0] if dataset.chunks else 0
        last = (end - 1) // step * step if step else 0
        if not step or not dataset.fletcher32 or last < first or dataset.dtype.kind == "O":
            raise
        _, stored = dataset.id.read_direct_chunk((last, *(0 for _ in dataset.shape[1:])))  # whatever its checksum
        count = math.prod(dataset.chunks)
        torn = np.frombuffer(stored, dataset.dtype, count).reshape(dataset.chunks)[: end - last]
        return np.concatenate((np.asarray(dataset[first:last]), torn)) if last > first else torn


def _count_leading(good: np.ndarray) -> int:
    return len(good) if good.all() else int(np.argmin(good))


def _count_with_detections(file: h5py.File, frames: int, blobs: int) -> tuple[int, int]:
    """Return how many frames have all their detections, and how many detections these are."""
    if schema.DETECTION_COUNT.path not in file:
        return frames, int(np.searchsorted(_read_rows(file[schema.DETECTION_FRAME.path], blobs), frames))
    counts = _read_rows(file[schema.DETECTION_COUNT.path], frames)
    counts = counts[: _count_leading(counts >= 0)]
    reached = np.cumsum(counts, dtype=np.int64)
    frames = int(np.searchsorted(reached, blobs, side="right"))
    return frames, int(reached[frames - 1]) if frames > 0 else 0


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
    with open_session(path) as old, _new_session(target) as file:
        attributes = {**old.attrs, **changed}
        for name in sorted(attributes, key=[*schema.ROOT_ATTRIBUTES, *attributes].index):  # as it was recorded
            if name != CHECKSUM_ATTRIBUTE:
                file.attrs[name] = attributes[name]
        for name in old:
            old.copy(name, file)
        if CHECKSUM_ATTRIBUTE in old.attrs:
            file.attrs[CHECKSUM_ATTRIBUTE] = compute_checksum(file)

"""Structure check of session files, and the complete rows of interrupted ones.

HDF5 follows links into other files, reads any file as external storage and allocates whatever a shape claims. All of
that is rejected here before a value is read (hard links, storage inside the file, declared types and sizes).

The datasets of an interrupted file differ in length, since they do not grow in one instant.
"""

from __future__ import annotations

import itertools
import math
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.session import schema
from carpus.core.session.plausibility import damage_error
from carpus.core.session.schema import Field

MAX_OBJECTS = 400
"""Groups and datasets of one file; the schema has fewer than 100."""
MAX_DEPTH = 6
_PLAIN_LAYOUTS = (h5py.h5d.COMPACT, h5py.h5d.CONTIGUOUS, h5py.h5d.CHUNKED)
_PLAIN_FILTERS = (h5py.h5z.FILTER_FLETCHER32, h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE)
MAX_COMPRESSION_RATIO = 1032
"""Largest ratio of the gzip format."""
_KINDS = {"f": "f", "u": "iu", "i": "iu", "t": "SO", "r": "V"}
_FIELDS = {field.path: field for field in schema.ALL_FIELDS}
_ENDS_OF_RAW = {field.path for field in schema.RAW_STREAMS}


def check_structure(file: h5py.File, size_bytes: int) -> None:
    """Raise :class:`ContentError` unless the file contains only plain groups and datasets of the schema's size."""
    whole = bool(file.attrs.get("complete", False))
    seen: set[tuple[int, int]] = set()
    waiting: list[tuple[str, h5py.h5g.GroupID, int]] = [("", h5py.h5g.open(file.id, b"/"), 0)]
    declared = 0
    while waiting:
        place, group, depth = waiting.pop()
        names = list(itertools.islice(group, MAX_OBJECTS + 1))
        if depth > MAX_DEPTH or len(names) + len(seen) > MAX_OBJECTS:  # perhaps without an end
            raise damage_error(place)
        for name in names:
            inside = f"{place}/{name.decode('utf-8', 'replace')}"
            if group.links.get_info(name).type != h5py.h5l.TYPE_HARD:
                raise damage_error(inside)
            info = h5py.h5o.get_info(group, name)
            key = (info.fileno, info.addr)
            if key in seen or (inside in _FIELDS and info.type != h5py.h5o.TYPE_DATASET):
                raise damage_error(inside)
            seen.add(key)
            if info.type == h5py.h5o.TYPE_GROUP:
                waiting.append((inside, h5py.h5g.open(group, name), depth + 1))
            elif info.type == h5py.h5o.TYPE_DATASET:
                dataset = h5py.Dataset(h5py.h5d.open(group, name))
                plan = dataset.id.get_create_plist()
                filters = [plan.get_filter(number)[0] for number in range(plan.get_nfilters())]
                is_inside = plan.get_layout() in _PLAIN_LAYOUTS and plan.get_external_count() == 0
                if not is_inside or not set(filters) <= set(_PLAIN_FILTERS):
                    raise damage_error(inside)
                if inside in _FIELDS:
                    declared += _check_size(_FIELDS[inside], dataset, size_bytes, whole=whole)
    if declared > MAX_COMPRESSION_RATIO * size_bytes + 65536:
        raise damage_error("/")


def _check_size(field: Field, dataset: h5py.Dataset, file_bytes: int, *, whole: bool) -> int:
    """Return the bytes that reading a dataset takes; raises if type, axes or size are not as declared."""
    kind, shape = dataset.dtype.kind, dataset.shape
    is_text = kind != "O" or h5py.check_string_dtype(dataset.dtype) is not None
    if kind not in _KINDS[field.dtype[0]] or not is_text or shape is None or len(shape) != len(field.shape):
        raise damage_error(field.path)
    claimed = math.prod(int(length) for length in shape) * dataset.dtype.itemsize
    stored = int(dataset.id.get_storage_size())
    if dataset.chunks is not None and field.shape[0] in schema.GROWING_AXES and not whole:
        # A flush that was cut short leaves rows announced whose chunk is not there; they are not read.
        claimed = min(claimed, count_stored_rows(dataset) * math.prod(map(int, shape[1:])) * dataset.dtype.itemsize)
        if math.prod(dataset.chunks) * dataset.dtype.itemsize > 1 << 27:
            raise damage_error(field.path)
    packed = MAX_COMPRESSION_RATIO if dataset.compression else 1
    if stored > file_bytes or claimed > packed * max(stored, 0) + 4096:
        raise damage_error(field.path)
    return 0 if field.path in _ENDS_OF_RAW else claimed


def count_stored_rows(dataset: h5py.Dataset) -> int:
    """Return the rows for which a growing dataset has chunks; its shape may claim more."""
    step, *row = dataset.chunks
    chunk_bytes = step * math.prod(row) * dataset.dtype.itemsize + (4 if dataset.fletcher32 else 0)
    return int(dataset.id.get_storage_size()) // chunk_bytes * int(step) if chunk_bytes else int(dataset.shape[0])


_GROWING = [
    field
    for field in schema.ALL_FIELDS
    if field.shape[0] in schema.GROWING_AXES and field not in schema.SMOOTHED_FIELDS
]


@dataclass(frozen=True, slots=True)
class RowCounts:
    """Rows along each growing axis; every frame counted has its detections and images."""

    frames: int
    detections: int
    events: int
    color_bytes: int
    depth_bytes: int

    def axis_length(self, axis: str) -> int:
        by_axis = (self.frames, self.detections, self.events, self.color_bytes, self.depth_bytes)
        return dict(zip(("N", "D", "E", "C", "B"), by_axis, strict=True))[axis]


def find_growing_fields(file: h5py.File) -> list[tuple[Field, h5py.Dataset]]:
    """Return the datasets of this file that grow while it is written."""
    return [(field, file[field.path]) for field in _GROWING if field.path in file]


def count_whole_rows(file: h5py.File) -> RowCounts:
    """Return how many rows from the start every dataset has."""
    longest = dict.fromkeys(schema.GROWING_AXES, 0)
    growing = find_growing_fields(file)
    for axis in longest:
        longest[axis] = min((count_readable_rows(data) for field, data in growing if field.shape[0] == axis), default=0)
    timestamp_s = read_rows(file["/frames/timestamp"], longest["N"])
    is_valid = np.isfinite(timestamp_s)
    is_valid[1:] &= np.diff(timestamp_s) > 0.0
    frames = _count_leading(is_valid)
    frames, detections = _count_with_detections(file, frames, longest["D"])
    ends = []
    for stream, end in zip(schema.RAW_STREAMS, schema.RAW_ENDS, strict=True):
        if end.path in file:
            reached = read_rows(file[end.path], frames)
            is_valid = reached >= 0
            is_valid[1:] &= np.diff(reached) >= 0
            reached = reached[: _count_leading(is_valid)]
            frames = int(np.searchsorted(reached, longest[str(stream.shape[0])], side="right"))
    for end in schema.RAW_ENDS:
        ends.append(int(read_rows(file[end.path], frames)[-1]) if end.path in file and frames > 0 else 0)
    detections = min(detections, _count_with_detections(file, frames, longest["D"])[1])
    events = 0
    with suppress(OSError, RuntimeError, KeyError):  # a table of events that is broken does not condemn the frames
        events = _count_leading(np.isfinite(read_rows(file["/events/time"], longest["E"])))
    return RowCounts(frames, detections, events, *ends)


def count_readable_rows(dataset: h5py.Dataset) -> int:
    """Return the rows that can be read: a kill during a flush may leave the last chunk announced but unreachable."""
    rows = int(dataset.shape[0])
    if not dataset.chunks:
        return rows
    step = dataset.chunks[0]
    rows = min(rows, count_stored_rows(dataset))
    while rows > 0:
        begin = (rows - 1) // step * step
        try:
            read_rows(dataset, rows, begin)
        except (OSError, RuntimeError):
            rows = begin
        else:
            break
    return rows


def read_rows(dataset: h5py.Dataset, end: int, first: int = 0) -> NDArray[Any]:
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
        torn = read_chunk(dataset, last)[: end - last]
        return np.concatenate((np.asarray(dataset[first:last]), torn)) if last > first else torn


def read_chunk(dataset: h5py.Dataset, begin: int) -> NDArray[Any]:
    """Return the chunk that starts at a row, whatever its checksum."""
    _, stored = dataset.id.read_direct_chunk((begin, *(0 for _ in dataset.shape[1:])))
    size = math.prod(dataset.chunks) * dataset.dtype.itemsize
    return np.frombuffer(stored, dataset.dtype, size // dataset.dtype.itemsize).reshape(dataset.chunks)


def _count_leading(good: np.ndarray) -> int:
    return len(good) if good.all() else int(np.argmin(good))


def _count_with_detections(file: h5py.File, frames: int, blobs: int) -> tuple[int, int]:
    """Return how many frames have all their detections, and how many detections these are."""
    if schema.DETECTION_COUNT.path not in file:
        return frames, int(np.searchsorted(read_rows(file[schema.DETECTION_FRAME.path], blobs), frames))
    counts = read_rows(file[schema.DETECTION_COUNT.path], frames)
    counts = counts[: _count_leading(counts >= 0)]
    reached = np.cumsum(counts, dtype=np.int64)
    frames = int(np.searchsorted(reached, blobs, side="right"))
    return frames, int(reached[frames - 1]) if frames > 0 else 0

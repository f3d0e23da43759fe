"""How many rows of an interrupted session are whole: the datasets do not grow in one instant."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from carpus.core.session import schema
from carpus.core.session.plain_file import chunk_rows_there
from carpus.core.session.schema import Field

_GROWING = [
    field
    for field in schema.ALL_FIELDS
    if field.shape[0] in schema.GROWING_AXES and field not in schema.SMOOTHED_FIELDS
]


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows along each growing axis; every frame counted has its blobs and its pictures."""

    frames: int
    detections: int
    events: int
    color_bytes: int
    depth_bytes: int

    def along(self, axis: str) -> int:
        by_axis = (self.frames, self.detections, self.events, self.color_bytes, self.depth_bytes)
        return dict(zip(("N", "D", "E", "C", "B"), by_axis, strict=True))[axis]


def growing_fields(file: h5py.File) -> list[tuple[Field, h5py.Dataset]]:
    """The datasets of this file that grew while it was written."""
    return [(field, file[field.path]) for field in _GROWING if field.path in file]


def whole_rows(file: h5py.File) -> Rows:
    """The longest beginning of the session of which every dataset holds every row."""
    longest = dict.fromkeys(schema.GROWING_AXES, 0)
    growing = growing_fields(file)
    for axis in longest:
        longest[axis] = min((readable_rows(data) for field, data in growing if field.shape[0] == axis), default=0)
    frames = _rising(rows_of(file["/frames/timestamp"], longest["N"]))
    frames, detections = _with_blobs(file, frames, longest["D"])
    ends = []
    for stream, end in zip(schema.RAW_STREAMS, schema.RAW_ENDS, strict=True):
        if end.path in file:
            reached = _rising_ends(rows_of(file[end.path], frames))
            frames = min(frames, len(reached))
            frames = int(np.searchsorted(reached, longest[str(stream.shape[0])], side="right"))
    for end in schema.RAW_ENDS:
        ends.append(int(rows_of(file[end.path], frames)[-1]) if end.path in file and frames > 0 else 0)
    detections = min(detections, _with_blobs(file, frames, longest["D"])[1])
    events = rows_of(file["/events/time"], longest["E"])
    return Rows(frames, detections, _leading(np.isfinite(events)), *ends)


def readable_rows(dataset: h5py.Dataset) -> int:
    """Rows that can be read: a kill inside a flush may leave the last chunk announced but not reachable."""
    rows = int(dataset.shape[0])
    if not dataset.chunks:
        return rows
    step = dataset.chunks[0]
    rows = min(rows, chunk_rows_there(dataset))
    while rows > 0:
        begin = (rows - 1) // step * step
        try:
            rows_of(dataset, rows, begin)
        except (OSError, RuntimeError):
            rows = begin
        else:
            break
    return rows


def rows_of(dataset: h5py.Dataset, end: int, begin: int = 0) -> NDArray[Any]:
    """Rows of a session that was cut short. A chunk whose check sum does not fit was being added to when the program
    ended: only its end is new, so it is read all the same, and the times say which of its rows count."""
    try:
        return np.asarray(dataset[begin:end])
    except (OSError, RuntimeError):
        step = dataset.chunks[0] if dataset.chunks else 0
        last = (end - 1) // step * step if step else 0
        if not step or not dataset.fletcher32 or last < begin or dataset.dtype.kind == "O":
            raise
        torn = unchecked_chunk(dataset, last)[: end - last]
        return np.concatenate((np.asarray(dataset[begin:last]), torn)) if last > begin else torn


def unchecked_chunk(dataset: h5py.Dataset, begin: int) -> NDArray[Any]:
    """The chunk that begins at a row, whatever its check sum says."""
    _, stored = dataset.id.read_direct_chunk((begin, *(0 for _ in dataset.shape[1:])))
    size = math.prod(dataset.chunks) * dataset.dtype.itemsize
    return np.frombuffer(stored, dataset.dtype, size // dataset.dtype.itemsize).reshape(dataset.chunks)


def _rising(timestamp_s: np.ndarray) -> int:
    """Length of the beginning in which times are known and rise."""
    good = np.isfinite(timestamp_s)
    good[1:] &= np.diff(timestamp_s) > 0.0
    return _leading(good)


def _leading(good: np.ndarray) -> int:
    return len(good) if good.all() else int(np.argmin(good))


def _rising_ends(ends: NDArray[Any]) -> NDArray[Any]:
    """The beginning of a column of ends in which they are known and do not fall."""
    good = ends >= 0
    good[1:] &= np.diff(ends) >= 0
    return ends[: _leading(good)]


def _with_blobs(file: h5py.File, frames: int, blobs: int) -> tuple[int, int]:
    """How many of the frames have all their blobs, and how many blobs that makes."""
    if schema.DETECTION_COUNT.path not in file:
        return frames, int(np.searchsorted(rows_of(file[schema.DETECTION_FRAME.path], blobs), frames))
    counts = rows_of(file[schema.DETECTION_COUNT.path], frames)
    counts = counts[: _leading(counts >= 0)]
    reached = np.cumsum(counts, dtype=np.int64)
    frames = int(np.searchsorted(reached, blobs, side="right"))
    return frames, int(reached[frames - 1]) if frames > 0 else 0

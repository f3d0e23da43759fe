"""How many rows of an interrupted session are whole: the datasets do not grow in one instant."""

from __future__ import annotations

from dataclasses import dataclass

import h5py
import numpy as np

from core.session import schema
from core.session.schema import Field


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
    fields = (field for field in schema.ALL_FIELDS if field.shape[0] in schema.GROWING_AXES)
    return [(field, file[field.path]) for field in fields if field.path in file and field not in schema.SMOOTHED_FIELDS]


def whole_rows(file: h5py.File) -> Rows:
    """The longest beginning of the session of which every dataset holds every row."""
    longest = dict.fromkeys(schema.GROWING_AXES, 0)
    for axis in longest:
        lengths = [readable_rows(data) for field, data in growing_fields(file) if field.shape[0] == axis]
        longest[axis] = min(lengths, default=0)
    frames = _rising(file["/frames/timestamp"][: longest["N"]])
    frames, detections = _with_blobs(file, frames, longest["D"])
    ends = []
    for stream, end in zip(schema.RAW_STREAMS, schema.RAW_ENDS, strict=True):
        if end.path in file:
            reached = file[end.path][:frames]
            frames = int(np.searchsorted(reached, longest[str(stream.shape[0])], side="right"))
    for end in schema.RAW_ENDS:
        ends.append(int(file[end.path][frames - 1]) if end.path in file and frames > 0 else 0)
    detections = min(detections, _with_blobs(file, frames, longest["D"])[1])
    events = file["/events/time"][: longest["E"]]
    return Rows(frames, detections, _leading(np.isfinite(events)), *ends)


def readable_rows(dataset: h5py.Dataset) -> int:
    """Rows that can be read: a kill inside a flush may leave the last chunk announced but not reachable."""
    rows = int(dataset.shape[0])
    step = dataset.chunks[0] if dataset.chunks else max(rows, 1)
    while rows > 0:
        begin = (rows - 1) // step * step
        try:
            dataset[begin:rows]
        except (OSError, RuntimeError):
            rows = begin
        else:
            break
    return rows


def _rising(timestamp_s: np.ndarray) -> int:
    """Length of the beginning in which times are known and rise."""
    good = np.isfinite(timestamp_s)
    good[1:] &= np.diff(timestamp_s) > 0.0
    return _leading(good)


def _leading(good: np.ndarray) -> int:
    return len(good) if good.all() else int(np.argmin(good))


def _with_blobs(file: h5py.File, frames: int, blobs: int) -> tuple[int, int]:
    """How many of the frames have all their blobs, and how many blobs that makes."""
    if schema.DETECTION_COUNT.path not in file:
        return frames, int(np.searchsorted(file[schema.DETECTION_FRAME.path][:blobs], frames))
    reached = np.cumsum(file[schema.DETECTION_COUNT.path][:frames])
    frames = int(np.searchsorted(reached, blobs, side="right"))
    return frames, int(reached[frames - 1]) if frames > 0 else 0

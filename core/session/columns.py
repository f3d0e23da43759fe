"""Rows of a session as columns of the schema, for the recording journal and the session file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from carpus.core.model.types import SurfaceSamples, TrackedFrame
from carpus.core.session import schema
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.values import Event, Motion

Blocks = dict[str, Any]
"""Rows to add, an array for the path of each dataset. ``/detections/frame`` counts from the first frame of the
blocks.
"""


def build_frame_blocks(layout: TableLayout, frames: Sequence[TrackedFrame]) -> Blocks:
    """Return the columns of frames with their detections and depth samples."""
    blobs = [frame.detections for frame in frames]
    counts = np.array([len(some) for some in blobs])
    total = int(counts.sum())
    found: Blocks = {
        schema.DETECTION_FRAME.path: np.repeat(np.arange(len(frames)), counts),
        schema.DETECTION_COUNT.path: counts,
    }
    for field in schema.DETECTION_FIELDS:
        data = np.concatenate([getattr(some, field.attribute) for some in blobs])
        found[field.path] = check_shape(field, data, (total, *layout.row_shape(field)))
    for field in schema.SURFACE_FIELDS:
        found[field.path] = _fill_readings(field, [some.surface for some in blobs])
    for field in schema.FINGER_FIELDS if layout.protocol.has_fingers else ():
        found[field.path] = _fill_readings(field, [some.fingers for some in blobs])
    for field in filter(layout.has, schema.FRAME_FIELDS):
        of = [frame.kinematics for frame in frames] if field in schema.MOTION_FIELDS else frames
        values = [getattr(one, field.attribute) for one in of]
        found[field.path] = check_shape(field, values, (len(frames), *layout.row_shape(field)))
    return found


def build_motion_blocks(layout: TableLayout, motion: Motion) -> Blocks:
    """Return the columns of the smoother's result."""
    count = len(motion.position_m)
    return {
        field.path: check_shape(field, getattr(motion, field.attribute), (count, *layout.row_shape(field)))
        for field in filter(layout.has, schema.SMOOTHED_FIELDS)
    }


def build_event_blocks(event: Event) -> Blocks:
    """Return one event as columns, in as many rows as its text needs."""
    rows = [Event(event.time_s, event.kind, part) for part in _split_text(event.text)]
    found = {}
    for field in schema.EVENT_FIELDS:
        values = [getattr(row, field.attribute) for row in rows]
        cells = [value.encode() if isinstance(value, str) else value for value in values]
        found[field.path] = np.array(cells, dtype=field.h5_dtype)
    return found


def check_shape(field: Field, value: Any, shape: tuple[int, ...]) -> Any:
    """Return the value as an array of the field's type; raises ValueError if its shape is wrong."""
    data = np.asarray(value, dtype=field.h5_dtype)
    if data.shape != shape:
        raise ValueError(f"{field.path} got {data.shape}, {shape} expected")
    return data


def _fill_readings(field: Field, readings: Sequence[SurfaceSamples | None]) -> Any:
    """Return the depth samples of some frames, padded to the same number."""
    row_shape = tuple(size for size in field.shape[1:] if isinstance(size, int))
    out = np.full((len(readings), *row_shape), field.fill, dtype=field.h5_dtype)
    for row, some in zip(out, readings, strict=True):
        if some is not None:
            value = getattr(some, field.attribute)
            row[: len(value)] = value
    return out


def _split_text(text: str) -> Iterator[str]:
    """Yield pieces of a text that fit into a row, cut between characters."""
    rest = text.encode("utf-8", "replace")
    while True:
        part = rest[: schema.TEXT_BYTES].decode("utf-8", "ignore")
        yield part
        rest = rest[len(part.encode()) :]
        if not rest:
            return

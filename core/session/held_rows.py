"""What was taken and is not in the file yet, and what each dataset gets from it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from carpus.core.session import schema
from carpus.core.session.new_file import checked
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.values import Event, Motion, RawPictures
from carpus.core.types import SurfaceSamples, TrackedFrame

Block = tuple[Field, Any]
"""Rows to add to the dataset of a field."""
RowsInFile = Callable[[str], int]
"""How many rows the dataset of a path has already."""


@dataclass(slots=True)
class HeldRows:
    """Held in memory between two flushes: frames, the pictures of each if these are kept, events, and the smoother's
    results for the next frames."""

    frames: list[TrackedFrame] = dataclasses.field(default_factory=list)
    pictures: list[RawPictures] = dataclasses.field(default_factory=list)
    events: list[Event] = dataclasses.field(default_factory=list)
    smoothed: list[Motion] = dataclasses.field(default_factory=list)

    def add_event(self, time_s: float, kind: str, text: str) -> None:
        """As many rows as the text needs."""
        self.events += [Event(time_s, kind, part) for part in _parts(text)]

    @property
    def smoothed_rows(self) -> int:
        """For how many frames the smoother's result is held."""
        return sum(len(motion.position_m) for motion in self.smoothed)

    def blocks(self, layout: TableLayout, rows_in_file: RowsInFile) -> list[Block]:
        """What each dataset gets."""
        return [
            *self._of_frames(layout, rows_in_file),
            *self._of_smoothed(layout),
            *(
                (field, _cells(field, [getattr(one, field.attribute) for one in self.events]))
                for field in schema.EVENT_FIELDS
                if self.events
            ),
        ]

    def _of_frames(self, layout: TableLayout, rows_in_file: RowsInFile) -> Iterator[Block]:
        """The blobs and pictures first, then the frames that count them."""
        frames = self.frames
        if not frames:
            return
        blobs = [frame.detections for frame in frames]
        counts = np.array([len(some) for some in blobs])
        first = rows_in_file(schema.FRAME_FIELDS[0].path)
        row = np.repeat(np.arange(first, first + len(frames)), counts)
        yield schema.DETECTION_FRAME, row
        for field in schema.DETECTION_FIELDS:
            data = np.concatenate([getattr(some, field.attribute) for some in blobs])
            yield field, checked(field, data, (len(row), *layout.row_shape(field)))
        yield schema.DETECTION_COUNT, counts
        for field in schema.SURFACE_FIELDS:
            yield field, _reading_rows(field, [some.surface for some in blobs])
        for field in schema.FINGER_FIELDS if layout.protocol.has_fingers else ():
            yield field, _reading_rows(field, [some.fingers for some in blobs])
        yield from self._of_pictures(rows_in_file)
        for field in filter(layout.has, schema.FRAME_FIELDS):
            of = [frame.moment for frame in frames] if field in schema.MOTION_FIELDS else frames
            values = [getattr(one, field.attribute) for one in of]
            yield field, checked(field, values, (len(frames), *layout.row_shape(field)))

    def _of_pictures(self, rows_in_file: RowsInFile) -> Iterator[Block]:
        if not self.pictures:
            return
        for stream, end in zip(schema.RAW_STREAMS, schema.RAW_ENDS, strict=True):
            pictures: Sequence[bytes] = [getattr(both, stream.attribute) for both in self.pictures]
            yield stream, np.frombuffer(b"".join(pictures), np.uint8)
            yield end, rows_in_file(stream.path) + np.cumsum([len(picture) for picture in pictures])

    def _of_smoothed(self, layout: TableLayout) -> Iterator[Block]:
        if not self.smoothed:
            return
        for field in filter(layout.has, schema.SMOOTHED_FIELDS):
            data = np.concatenate([getattr(motion, field.attribute) for motion in self.smoothed])
            yield field, checked(field, data, (len(data), *layout.row_shape(field)))


def _reading_rows(field: Field, readings: Sequence[SurfaceSamples | None]) -> Any:
    """The depth readings of some frames, filled up to the same number."""
    row_shape = tuple(size for size in field.shape[1:] if isinstance(size, int))
    out = np.full((len(readings), *row_shape), field.fill, dtype=field.h5_dtype)
    for row, some in zip(out, readings, strict=True):
        if some is not None:
            value = getattr(some, field.attribute)
            row[: len(value)] = value
    return out


def _cells(field: Field, values: Sequence[Any]) -> Any:
    texts = [value.encode() if isinstance(value, str) else value for value in values]
    return np.array(texts, dtype=field.h5_dtype)


def _parts(text: str) -> Iterator[str]:
    """A text in pieces that fit into a row, cut between letters."""
    rest = text.encode("utf-8", "replace")
    while True:
        part = rest[: schema.TEXT_BYTES].decode("utf-8", "ignore")
        yield part
        rest = rest[len(part.encode()) :]
        if not rest:
            return

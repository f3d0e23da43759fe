"""Writes a session while it runs: flushed about every second, given its name only when it is whole."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5py
import numpy as np

from core.calibration.result import Calibration
from core.camera import Camera
from core.errors import CarpusFault, OutputExists, OutputNotWritable, TimesUnordered
from core.session import schema
from core.session.disk import part_path, publish, reserve, sync_folder, write_fault
from core.session.new_file import checked, create_growing, describe, new_file, write_calibration, write_header
from core.session.schema import Field, Layout
from core.session.values import Event, Motion, RawPictures, SessionHeader
from core.types import TrackedFrame

FLUSH_EVERY_S = 0.8
"""A kill loses what came since the last flush; with a frame and the flush itself that stays below a second."""
ROWS_HELD = 4096
"""Rows held in memory at most, when frames come faster than the clock (tracking a stored recording)."""
_INDEX_BYTES = 512 * 1024
"""More than HDF5's index grows by in one flush."""


Block = tuple[Field, Any]
"""Rows to add to the dataset of a field."""


class SessionWriter:
    """One session file in the making; used by one thread, from :meth:`create` to :meth:`close`.

    Rows are held in memory and written, flushed and synchronised together, so that between two flushes the file
    does not change. Within a flush the times come last: a row with a time has all the rest, whenever the process
    is ended. The file lies beside its target as
    ``NAME.xxxxxxxx.part`` and gets its name in :meth:`close`; nothing is ever overwritten. After a fault the part
    file stays, and :mod:`core.session.recovery` finishes it.
    """

    def __init__(self, file: h5py.File, path: Path, part: Path, layout: Layout, clock: Callable[[], float]) -> None:
        self.path = path
        self.part_path = part
        self._file = file
        self._layout = layout
        self._clock = clock
        self._descriptor = os.open(part, os.O_RDWR)
        self._growing: dict[str, h5py.Dataset] = {}
        self._rows: list[TrackedFrame] = []
        self._raw: list[RawPictures] = []
        self._events: list[Event] = []
        self._raw_bytes = {field.attribute: 0 for field in schema.RAW_STREAMS}
        self._count = 0
        self._last_time_s = -np.inf
        self._flushed_at_s = clock()
        self._fault: CarpusFault | None = None

    @classmethod
    def create(
        cls,
        path: Path,
        header: SessionHeader,
        camera: Camera,
        calibration: Calibration,
        *,
        raw_depth_unit_m: float | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> Self:
        """Begin a session that is to become ``path``. With ``raw_depth_unit_m`` every frame brings its pictures.

        Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; then nothing is left behind.
        """
        if os.path.lexists(path):
            raise OutputExists(path)
        part = part_path(path, header.session_id)
        try:
            file = new_file(part)
        except FileExistsError as cause:
            raise OutputExists(part) from cause
        except OSError as cause:
            raise OutputNotWritable(path.parent, os.strerror(cause.errno) if cause.errno else "") from cause
        layout = Layout(header.protocol, header.joint_names)
        writer = cls(file, path, part, layout, clock)
        try:
            with writer._writing(0):
                write_header(file, header, camera)
                write_calibration(file, layout, calibration)
                writer._growing = create_growing(file, layout, raw_depth_unit_m)
        except CarpusFault:
            writer._release()
            part.unlink(missing_ok=True)
            raise
        sync_folder(part.parent)
        return writer

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.close()
        else:
            self.abandon()

    def __len__(self) -> int:
        """Frames taken so far."""
        return self._count

    def append(self, tracked: TrackedFrame, raw: RawPictures | None = None) -> None:
        """Take one frame; writes when a flush is due. Never drops: it raises :class:`DiskFull` instead."""
        self._check_open()
        if tracked.timestamp_s <= self._last_time_s:
            raise TimesUnordered(self.path, f"{tracked.timestamp_s:.6f} s after {self._last_time_s:.6f} s")
        if (raw is not None) != (schema.RAW_ENDS[0].path in self._growing):
            raise ValueError("pictures come with every frame or with none")
        self._last_time_s = tracked.timestamp_s
        self._rows.append(tracked)
        if raw is not None:
            self._raw.append(raw)
        self._count += 1
        self._flush_when_due()

    def add_event(self, time_s: float, kind: str, text: str = "") -> None:
        """Note something that happened at a time of the recording."""
        self._check_open()
        self._events.append(Event(time_s, kind, text))
        self._flush_when_due()

    def flush(self) -> None:
        """Bring everything taken so far to the disk."""
        self._check_open()
        blocks = [*self._frame_blocks(), *self._event_blocks()]
        self._flushed_at_s = self._clock()
        if not blocks:
            return
        with self._writing(sum(map(self._room_for, blocks))):
            self._grow([block for block in blocks if block[0] not in schema.COMMIT_FIELDS])
            self._synchronise()
            self._grow([block for block in blocks if block[0] in schema.COMMIT_FIELDS])
        self._rows, self._raw, self._events = [], [], []

    def write_smoothed(self, motion: Motion) -> None:
        """Store the smoother's result, one row for every frame appended."""
        self.flush()
        fields = [field for field in schema.SMOOTHED_FIELDS if self._layout.has(field)]
        blocks = [(field, self._rows_of(field, getattr(motion, field.attribute), self._count)) for field in fields]
        with self._writing(sum(data.nbytes for _, data in blocks)):
            for field, data in blocks:
                describe(self._file.create_dataset(field.path, data=data), field, self._layout)
            for group, names in self._layout.group_names().items():
                if "/smoothed" + group in self._file:
                    self._file["/smoothed" + group].attrs["names"] = names

    def close(self) -> None:
        """Finish: mark the file complete and give it its name. Does nothing when closed, or after a fault."""
        if not self._file:
            return
        if self._fault is not None:
            self.abandon()
            return
        try:
            self.flush()
            with self._writing(0):
                self._file.attrs.modify("complete", True)
        except CarpusFault:
            self._release()
            raise
        self._release()
        publish(self.part_path, self.path)

    def abandon(self) -> None:
        """Stop without finishing; what was taken stays in the part file."""
        if self._file and self._fault is None:
            with contextlib.suppress(CarpusFault, ValueError):  # the exception on its way tells more
                self.flush()
        self._release()

    def discard(self) -> None:
        """Stop and remove the part file: for work that can be done again from its recording."""
        self._release()
        self.part_path.unlink(missing_ok=True)

    def _flush_when_due(self) -> None:
        if self._clock() - self._flushed_at_s >= FLUSH_EVERY_S or len(self._rows) >= ROWS_HELD:
            self.flush()

    def _check_open(self) -> None:
        if self._fault is not None:
            raise self._fault
        if not self._file:
            raise ValueError("the session is closed")

    def _grow(self, blocks: list[Block]) -> None:
        for field, data in blocks:
            dataset = self._growing[field.path]
            begin = dataset.shape[0]
            dataset.resize(begin + len(data), axis=0)
            dataset[begin:] = data

    def _room_for(self, block: Block) -> int:
        """Bytes by which the file grows for a block: whole chunks, and the texts, which lie elsewhere."""
        field, data = block
        dataset = self._growing[field.path]
        step, *row = dataset.chunks
        new_chunks = -(-(dataset.shape[0] + len(data)) // step) - -(-dataset.shape[0] // step)
        return int(new_chunks * step * np.prod(row) * dataset.dtype.itemsize) + _text_bytes(data)

    def _synchronise(self) -> None:
        self._file.flush()
        os.fsync(self._descriptor)

    @contextlib.contextmanager
    def _writing(self, room: int) -> Iterator[None]:
        """Around every change of the file: room first, then the change, then flush and synchronise."""
        try:
            reserve(self._descriptor, self.part_path, self._file.id.get_filesize(), room + _INDEX_BYTES)
            yield
            self._synchronise()
        except CarpusFault as fault:
            self._fault = fault
            raise
        except (OSError, RuntimeError) as cause:
            self._fault = write_fault(self.part_path, cause)
            raise self._fault from cause

    def _release(self) -> None:
        """Close the file and cut off the room that was reserved and not used."""
        if not self._file:
            return
        used = self._file.id.get_filesize()
        with contextlib.suppress(OSError, RuntimeError):  # after a fault; what reached the disk stays
            self._file.close()
        os.truncate(self._descriptor, used)
        os.fsync(self._descriptor)
        os.close(self._descriptor)

    def _frame_blocks(self) -> list[Block]:
        """What each dataset gets from the rows held: the blobs and pictures first, then the frames that count them."""
        rows = self._rows
        if not rows:
            return []
        blobs = [row.detections for row in rows]
        counts = np.array([len(some) for some in blobs])
        frame = np.repeat(np.arange(self._count - len(rows), self._count), counts)
        blocks: list[Block] = [(schema.DETECTION_FRAME, frame)]
        for field in schema.DETECTION_FIELDS:
            data = np.concatenate([getattr(some, field.attribute) for some in blobs])
            blocks.append((field, self._rows_of(field, data, len(frame))))
        blocks.append((schema.DETECTION_COUNT, counts))
        blocks += self._raw_blocks()
        for field in schema.FRAME_FIELDS:
            if self._layout.has(field):
                blocks.append((field, self._rows_of(field, [getattr(row, field.attribute) for row in rows], len(rows))))
        return blocks

    def _raw_blocks(self) -> list[Block]:
        if not self._raw:
            return []
        blocks: list[Block] = []
        for stream, end in zip(schema.RAW_STREAMS, schema.RAW_ENDS, strict=True):
            pictures: Sequence[bytes] = [getattr(raw, stream.attribute) for raw in self._raw]
            ends = self._raw_bytes[stream.attribute] + np.cumsum([len(picture) for picture in pictures])
            self._raw_bytes[stream.attribute] = int(ends[-1])
            blocks += [(stream, np.frombuffer(b"".join(pictures), np.uint8)), (end, ends)]
        return blocks

    def _event_blocks(self) -> list[Block]:
        if not self._events:
            return []
        return [
            (field, np.array([getattr(event, field.attribute) for event in self._events], dtype=field.h5_dtype))
            for field in schema.EVENT_FIELDS
        ]

    def _rows_of(self, field: Field, value: Any, rows: int) -> Any:
        return checked(field, value, (rows, *self._layout.row_shape(field)))


def _text_bytes(data: Any) -> int:
    return sum(64 + 4 * len(text) for text in data) if data.dtype == object else 0

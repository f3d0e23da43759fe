"""Writes a session while it runs: flushed twice a second, given its name only when it is whole."""

from __future__ import annotations

import contextlib
import os
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.durable import copy_open_file, is_still_there, sync_folder, write_fault
from carpus.core.errors import (
    CarpusFault,
    DiskFull,
    EndStalled,
    FolderGone,
    OutputExists,
    OutputNotWritable,
    RecordingMoved,
    TimesUnordered,
)
from carpus.core.phrase import phrase
from carpus.core.session import schema
from carpus.core.session.disk import allow_written_bytes, free_name, part_path, publish, reserve
from carpus.core.session.heartbeat import Heartbeat
from carpus.core.session.new_file import (
    checked,
    create_checked,
    create_growing,
    create_smoothed,
    describe,
    new_file,
    write_calibration,
    write_header,
)
from carpus.core.session.opened import session_in
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.seal import ATTRIBUTE, Digests, seal_of
from carpus.core.session.values import Event, Motion, RawPictures, Repetitions, Session, SessionHeader
from carpus.core.types import SurfaceSamples, TrackedFrame

FLUSH_EVERY_S = 0.5
"""A kill loses what came since the last flush; with the flush itself on a busy computer that stays below a second."""
ROWS_HELD = 1024
"""Rows held in memory at most, when frames come faster than the clock (tracking a stored recording)."""
_INDEX_BYTES = 512 * 1024
"""More than HDF5's index grows by in one flush."""


Block = tuple[Field, Any]
"""Rows to add to the dataset of a field."""


@dataclass(frozen=True, slots=True)
class Fallback:
    """Where a recording goes on when its folder goes away: ``folder`` names (and makes) the place, ``told`` hears of it
    as :class:`RecordingMoved`, in the writing thread."""

    folder: Callable[[], Path]
    told: Callable[[CarpusFault], None]


@dataclass(frozen=True, slots=True)
class _Beginning:
    """What a file begins with, for one that has to begin again elsewhere."""

    header: SessionHeader
    camera: Camera
    calibration: Calibration
    raw_depth_unit_m: float | None


class SessionWriter:
    """One session file in the making; used by one thread, from :meth:`create` to :meth:`close`.

    Rows are held in memory and written, flushed and synchronised together, so that between two flushes the file
    does not change. Within a flush the times come last: a row with a time has all the rest, whenever the process
    is ended. The file lies beside its target as
    ``NAME.xxxxxxxx.part`` and gets its name in :meth:`close`; nothing is ever overwritten. After a fault the part
    file stays, and :mod:`core.session.recovery` finishes it.

    A heartbeat beside the part file (:mod:`core.session.heartbeat`) says that it is being written, and looks every
    second whether the file is still where it was. Where it is not, or cannot be written any more, the recording goes
    on in the ``fallback``'s folder, with all that was recorded where that can still be read.
    """

    def __init__(
        self,
        file: h5py.File,
        path: Path,
        part: Path,
        layout: TableLayout,
        clock: Callable[[], float],
        beginning: _Beginning,
        fallback: Fallback | None,
    ) -> None:
        self.path = path
        self._beginning, self._fallback = beginning, fallback
        self.part_path = part
        self._file = file
        self._layout = layout
        self._clock = clock
        self._descriptor = os.open(part, os.O_RDWR)
        self._growing: dict[str, h5py.Dataset] = {}
        self._digests = Digests()
        self._rows: list[TrackedFrame] = []
        self._raw: list[RawPictures] = []
        self._events: list[Event] = []
        self._smoothed: list[Motion] = []
        self._raw_bytes = {field.attribute: 0 for field in schema.RAW_STREAMS}
        self._count = 0
        self._last_time_s = -np.inf
        self._flushed_at_s = clock()
        self._fault: CarpusFault | None = None
        self._heart = Heartbeat(part, self._look)

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
        fallback: Fallback | None = None,
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
        layout = TableLayout(header.protocol, header.joint_names)
        beginning = _Beginning(header, camera, calibration, raw_depth_unit_m)
        writer = cls(file, path, part, layout, clock, beginning, fallback)
        try:
            writer._begin()
        except BaseException:
            writer._release()
            part.unlink(missing_ok=True)
            raise
        sync_folder(part.parent)
        return writer

    def _begin(self) -> None:
        with self._writing(0):
            write_header(self._file, self._beginning.header, self._beginning.camera)
            write_calibration(self._file, self._layout, self._beginning.calibration)
            self._growing = create_growing(self._file, self._layout, self._beginning.raw_depth_unit_m)

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
        """Frames taken so far; those since it began again, where what was recorded before could not be taken along."""
        return self._count

    @property
    def stored(self) -> int:
        """Frames of those taken that are in the file."""
        return self._count - len(self._rows)

    @property
    def smoothed(self) -> int:
        """Frames of those taken whose smoothed motion was taken too."""
        taken = sum(len(motion.position_m) for motion in self._smoothed)
        return self._digests.rows(schema.SMOOTHED_FIELDS[0].path) + taken

    def append(self, tracked: TrackedFrame, raw: RawPictures | None = None) -> None:
        """Take one frame; writes when a flush is due. Never drops: it raises :class:`DiskFull` instead."""
        self._check_open()
        if tracked.timestamp_s <= self._last_time_s:
            raise TimesUnordered(
                self.path,
                phrase(
                    "{timestamp_s} s after {last_time_s} s",
                    timestamp_s=f"{tracked.timestamp_s:.6f}",
                    last_time_s=f"{self._last_time_s:.6f}",
                ),
            )
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
        self._events += [Event(time_s, kind, part) for part in _parts(text)]
        self._flush_when_due()

    def flush(self) -> None:
        """Bring everything taken so far to the disk, or to another where this one cannot be reached any more."""
        self._check_open()
        if self._heart.trouble is not None:
            self._move(self._heart.trouble)
        try:
            self._flush()
        except OutputNotWritable as fault:
            self._move(fault)
            self._flush()

    def _flush(self) -> None:
        if self._smoothed and schema.SMOOTHED_FIELDS[0].path not in self._growing:
            with self._writing(0):
                self._growing |= create_smoothed(self._file, self._layout)
        blocks = [*self._frame_blocks(), *self._smoothed_blocks(), *self._event_blocks()]
        self._flushed_at_s = self._clock()
        if not blocks:
            return
        with self._writing(sum(map(self._room_for, blocks))):
            self._grow([block for block in blocks if block[0] not in schema.COMMIT_FIELDS])
            self._synchronise()
            self._grow([block for block in blocks if block[0] in schema.COMMIT_FIELDS])
        for field, data in blocks:
            self._digests.add(field.path, np.asarray(data, dtype=field.h5_dtype))
        self._rows, self._raw, self._events, self._smoothed = [], [], [], []

    def add_smoothed(self, motion: Motion) -> None:
        """Take the smoother's result for the next frames, from the first appended on; written with the next flush."""
        self._check_open()
        if self.smoothed + len(motion.position_m) > self._count:
            raise ValueError("/smoothed got more rows than there are frames")
        self._smoothed.append(motion)

    def write_smoothed(self, motion: Motion) -> None:
        """Store the smoother's result, one row for every frame appended."""
        if len(motion.position_m) != self._count:
            raise ValueError(f"/smoothed got {len(motion.position_m)} rows for {self._count} frames")
        self.add_smoothed(motion)
        self.flush()

    def drop_smoothed(self) -> None:
        """Leave the smoother's result out: it does not come to all frames."""
        self.flush()
        if "/smoothed" in self._file:
            with self._writing(0):
                del self._file["/smoothed"]
                for field in schema.SMOOTHED_FIELDS:
                    self._growing.pop(field.path, None)

    def read_back(self) -> Session:
        """What is in the file so far, as :func:`core.session.reader.read_session` gives it."""
        self.flush()
        return session_in(self.part_path, self._file)

    def write_repetitions(self, repetitions: Repetitions) -> None:
        """Store what was counted, once all frames are there."""
        self.flush()
        rows = [
            tuple(getattr(row, column.attribute) for column in schema.REPETITION_COLUMNS) for row in repetitions.rows
        ]
        rows = [(*row[:-1], row[-1].encode()[: schema.REPETITION_DTYPE["reason"].itemsize]) for row in rows]
        data = np.array(rows, dtype=schema.REPETITION_DTYPE)
        with self._writing(data.nbytes):
            table = create_checked(self._file, schema.REPETITIONS.path, data)
            describe(table, schema.REPETITIONS, self._layout)
            for name in ("unit", "description"):
                table.attrs[f"column_{name}s"] = [getattr(column, name) for column in schema.REPETITION_COLUMNS]
            table.attrs[schema.REPETITION_ANGLE] = repetitions.angle

    def close(self) -> None:
        """Finish: mark the file complete and give it its name. Does nothing when closed, or after a fault."""
        if not self._file:
            return
        if self._fault is not None:
            self.abandon()
            return
        try:
            self._heart.trouble = self._heart.trouble or self._look()
            self.flush()
            try:
                self._seal()
            except OutputNotWritable as fault:
                self._move(fault)
                self._seal()
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

    def _seal(self) -> None:
        with self._writing(0):
            self._file.attrs.modify("complete", True)
            self._file.attrs[ATTRIBUTE] = seal_of(self._file, self._digests.known())

    def _look(self) -> CarpusFault | None:
        """Whether the part file is still the file that is written; from the heartbeat's thread."""
        return None if is_still_there(self._descriptor, self.part_path) else FolderGone(self.part_path.parent)

    def _move(self, fault: CarpusFault) -> None:
        """Go on elsewhere, with all that was recorded if it can still be read, else with what was not yet written."""
        if self._fallback is None or isinstance(fault, DiskFull):
            self._fault = self._fault or fault
            raise fault
        lost_folder = self.part_path.parent
        path = free_name(self._fallback.folder() / self.path.name)
        self._heart.end()
        stored = self._count - len(self._rows)
        header = self._beginning.header
        part = part_path(path, header.session_id)
        taken_along = self._copy_to(part, stored)
        if not taken_along:
            part = self._begin_again(path, stored)
        self._fault = None
        self.path, self.part_path = path, part
        self._heart = Heartbeat(part, self._look)
        told, self._fallback = self._fallback.told, None  # one disaster at a time
        told(
            RecordingMoved(
                path,
                ""
                if taken_along
                else phrase("the first {stored} rows stay in {lost_folder}", stored=stored, lost_folder=lost_folder),
            )
        )

    def go_on_elsewhere(self) -> Self:
        """A new file in the fallback's folder with what this one has not stored, for another thread while the one that
        writes hangs in the disk. What was stored stays there and is finished once the disk answers.

        Raises :class:`FolderGone` where there is no other place, :class:`EndStalled` where all is stored.
        """
        if self._fallback is None:
            raise FolderGone(self.part_path.parent)
        fallback, self._fallback = self._fallback, None
        rows, raw, events = list(self._rows), list(self._raw), list(self._events)
        stored = self._count - len(rows)
        if stored and not rows:
            raise EndStalled(self.part_path.parent)
        begun = self._beginning
        new_id = str(uuid.uuid4())
        header = replace(begun.header, session_id=new_id, recording_id=new_id) if stored else begun.header
        writer = type(self).create(
            free_name(fallback.folder() / self.path.name),
            header,
            begun.camera,
            begun.calibration,
            raw_depth_unit_m=begun.raw_depth_unit_m,
            clock=self._clock,
        )
        if stored and rows:
            text = f"goes on from session {begun.header.session_id}, {stored} rows of which are elsewhere"
            events.insert(0, Event(rows[0].timestamp_s, "moved", text))
        writer._rows, writer._raw, writer._events = rows, raw, events
        writer._count, writer._last_time_s = len(rows), self._last_time_s
        fallback.told(
            RecordingMoved(
                writer.path,
                phrase("the first {stored} rows stay in {parent}", stored=stored, parent=self.part_path.parent)
                if stored
                else "",
            )
        )
        return writer

    def _flush_when_due(self) -> None:
        if self._heart.trouble is not None:
            self.flush()
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
        return int(new_chunks * step * np.prod(row) * dataset.dtype.itemsize)

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

    def _copy_to(self, part: Path, stored: int) -> bool:
        """Write on in a copy of the part file: its bytes can be read through what is open, wherever its name has gone.
        False where they cannot."""
        with contextlib.suppress(OSError, RuntimeError):
            self._file.close()
        try:
            copy_open_file(self._descriptor, part)
            allow_written_bytes(part)
            file = h5py.File(part, "r+", libver="earliest", rdcc_nbytes=0)
        except (OSError, RuntimeError, CarpusFault):
            part.unlink(missing_ok=True)
            return False
        if not self._digests.rows(schema.SMOOTHED_FIELDS[0].path):  # begun, perhaps: it is begun anew in the copy
            file.pop("/smoothed", None)
            for field in schema.SMOOTHED_FIELDS:
                self._growing.pop(field.path, None)
        growing = {path: file[path] for path in self._growing}
        ends = self._ends_of(growing, stored)
        if ends is None:
            file.close()
            part.unlink(missing_ok=True)
            return False
        for path, end in ends.items():
            growing[path].resize(end, axis=0)
        os.close(self._descriptor)
        self._file, self._growing, self._descriptor = file, growing, os.open(part, os.O_RDWR)
        return True

    def _ends_of(self, growing: dict[str, h5py.Dataset], stored: int) -> dict[str, int] | None:
        """To what the datasets of a copy are cut, so that what was not wholly written is written again; None where
        something that was written is not there."""
        ends = {path: self._digests.rows(path) for path in growing}
        if ends[schema.FRAME_FIELDS[0].path] != stored:
            return None
        return None if any(growing[path].shape[0] < end for path, end in ends.items()) else ends

    def _begin_again(self, path: Path, stored: int) -> Path:
        """A new file for what comes from now on; it says where the beginning is."""
        old = self._beginning.header
        new_id = str(uuid.uuid4())
        header = replace(old, session_id=new_id, recording_id=new_id)  # two halves, not two results of one recording
        part = part_path(path, header.session_id)
        with contextlib.suppress(OSError):
            os.close(self._descriptor)
        self._file, self._descriptor = new_file(part), os.open(part, os.O_RDWR)
        self._beginning = replace(self._beginning, header=header)
        self._digests, self._count, self._smoothed = Digests(), len(self._rows), []
        self._raw_bytes = {field.attribute: 0 for field in schema.RAW_STREAMS}
        self._fault = None
        self._begin()
        if self._rows:
            text = f"goes on from session {old.session_id}, {stored} rows of which are elsewhere"
            self._events.insert(0, Event(self._rows[0].timestamp_s, "moved", text))
        return part

    def _release(self) -> None:
        """Close the file and cut off the room that was reserved and not used."""
        if not self._file:
            return
        self._heart.end()
        used = self._file.id.get_filesize()
        with contextlib.suppress(OSError, RuntimeError):  # after a fault; what reached the disk stays
            self._file.close()
        with contextlib.suppress(OSError):  # a disk that is gone; what reached it stays
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
        blocks += [(field, _reading_rows(field, [some.surface for some in blobs])) for field in schema.SURFACE_FIELDS]
        if self._layout.protocol.has_fingers:
            blocks += [
                (field, _reading_rows(field, [some.fingers for some in blobs])) for field in schema.FINGER_FIELDS
            ]
        blocks += self._raw_blocks()
        for field in schema.FRAME_FIELDS:
            if self._layout.has(field):
                of = [row.moment for row in rows] if field in schema.MOTION_FIELDS else rows
                blocks.append((field, self._rows_of(field, [getattr(one, field.attribute) for one in of], len(rows))))
        return blocks

    def _smoothed_blocks(self) -> list[Block]:
        if not self._smoothed:
            return []
        blocks: list[Block] = []
        for field in schema.SMOOTHED_FIELDS:
            if self._layout.has(field):
                data = np.concatenate([getattr(motion, field.attribute) for motion in self._smoothed])
                blocks.append((field, self._rows_of(field, data, len(data))))
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
            (field, _cells(field, [getattr(event, field.attribute) for event in self._events]))
            for field in schema.EVENT_FIELDS
        ]

    def _rows_of(self, field: Field, value: Any, rows: int) -> Any:
        return checked(field, value, (rows, *self._layout.row_shape(field)))


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

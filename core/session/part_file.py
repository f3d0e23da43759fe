"""The part file of a session: changed in steps that neither a kill nor a full disk can tear, watched, moved, sealed."""

from __future__ import annotations

import contextlib
import dataclasses
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.durable import copy_open_file, is_still_there, sync_folder, write_fault
from carpus.core.errors import CarpusFault, FolderGone, OutputExists, OutputNotWritable
from carpus.core.session import schema
from carpus.core.session.disk import allow_written_bytes, reserve
from carpus.core.session.new_file import (
    checked,
    create_growing,
    create_repetitions,
    create_smoothed,
    new_file,
    write_calibration,
    write_header,
)
from carpus.core.session.opened import session_in
from carpus.core.session.recovery import Heartbeat
from carpus.core.session.schema import Field, TableLayout
from carpus.core.session.seal import ATTRIBUTE, Digests, seal_of
from carpus.core.session.values import Event, Motion, RawPictures, Repetitions, Session, SessionHeader
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


_INDEX_BYTES = 512 * 1024
"""More than HDF5's index grows by in one flush."""


@dataclass(frozen=True, slots=True)
class FileBeginning:
    """What a file begins with, for one that has to begin again elsewhere."""

    header: SessionHeader
    camera: Camera
    calibration: Calibration
    raw_depth_unit_m: float | None


class PartFile:
    """An open part file, its datasets that grow, and the heartbeat beside it.

    The heartbeat (:mod:`core.session.recovery`) says that the file is being written, and looks every second whether it
    is still where it was: :attr:`trouble`. ``fault`` is what went wrong in a change of the file, after which it is not
    changed any more.
    """

    def __init__(
        self, path: Path, file: h5py.File, layout: TableLayout, growing: dict[str, h5py.Dataset], digests: Digests
    ) -> None:
        self.path, self.layout = path, layout
        self.fault: CarpusFault | None = None
        self._file, self._growing, self._digests = file, growing, digests
        self._descriptor = os.open(path, os.O_RDWR)
        self._heart = Heartbeat(path, self._missing)

    @classmethod
    def begun(cls, path: Path, beginning: FileBeginning) -> Self:
        """A new file without rows. Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; then
        nothing is left behind."""
        try:
            file = new_file(path)
        except FileExistsError as cause:
            raise OutputExists(path) from cause
        except OSError as cause:
            raise OutputNotWritable(path.parent, os.strerror(cause.errno) if cause.errno else "") from cause
        layout = TableLayout(beginning.header.protocol, beginning.header.joint_names)
        part = cls(path, file, layout, {}, Digests())
        try:
            with part._changing(0):
                write_header(file, beginning.header, beginning.camera)
                write_calibration(file, layout, beginning.calibration)
                part._growing = create_growing(file, layout, beginning.raw_depth_unit_m)
        except BaseException:
            part.close()
            path.unlink(missing_ok=True)
            raise
        sync_folder(path.parent)
        return part

    @property
    def is_open(self) -> bool:
        """Whether it can still be written."""
        return bool(self._file)

    @property
    def trouble(self) -> CarpusFault | None:
        """That the file is not where it was any more, as far as the heartbeat has seen."""
        return self._heart.trouble

    def look(self) -> None:
        """Not wait for the next beat."""
        self._heart.trouble = self._heart.trouble or self._missing()

    def _missing(self) -> CarpusFault | None:
        return None if is_still_there(self._descriptor, self.path) else FolderGone(self.path.parent)

    @property
    def keeps_pictures(self) -> bool:
        """Whether every frame brings its pictures."""
        return schema.RAW_ENDS[0].path in self._growing

    def rows(self, path: str) -> int:
        """Rows of a dataset that are on the disk."""
        return self._digests.rows(path)

    def add(self, blocks: Sequence[Block]) -> None:
        """Rows to datasets; the times last: a row with a time has all the rest, whenever the process is ended."""
        with self._changing(sum(_room_for(self._growing[field.path], len(data)) for field, data in blocks)):
            self._grow([block for block in blocks if block[0] not in schema.COMMIT_FIELDS])
            self._synchronise()
            self._grow([block for block in blocks if block[0] in schema.COMMIT_FIELDS])
        for field, data in blocks:
            self._digests.add(field.path, np.asarray(data, dtype=field.h5_dtype))

    def begin_smoothed(self) -> None:
        """Room for the smoother's result, if there is none yet."""
        if schema.SMOOTHED_FIELDS[0].path not in self._growing:
            with self._changing(0):
                self._growing |= create_smoothed(self._file, self.layout)

    def drop_smoothed(self) -> None:
        """Take the smoother's result out again."""
        if "/smoothed" in self._file:
            with self._changing(0):
                self._forget_smoothed(self._file)

    def _forget_smoothed(self, file: h5py.File) -> None:
        file.pop("/smoothed", None)
        for field in schema.SMOOTHED_FIELDS:
            self._growing.pop(field.path, None)

    def write_repetitions(self, repetitions: Repetitions) -> None:
        with self._changing(len(repetitions.rows) * schema.REPETITION_DTYPE.itemsize):
            create_repetitions(self._file, self.layout, repetitions)

    def session(self) -> Session:
        return session_in(self.path, self._file)

    def seal(self) -> None:
        with self._changing(0):
            self._file.attrs.modify("complete", True)
            self._file.attrs[ATTRIBUTE] = seal_of(self._file, self._digests.known())

    def copied(self, path: Path) -> Self | None:
        """The same file elsewhere, to go on in: its bytes can be read through what is open, wherever its name has gone.
        None where they cannot, or are not all there. This one is let go either way."""
        self._heart.end()
        with contextlib.suppress(OSError, RuntimeError):
            self._file.close()
        file = None
        with contextlib.suppress(OSError, RuntimeError, CarpusFault):
            copy_open_file(self._descriptor, path)
            allow_written_bytes(path)
            file = h5py.File(path, "r+", libver="earliest", rdcc_nbytes=0)
        with contextlib.suppress(OSError):
            os.close(self._descriptor)
        if file is None:
            path.unlink(missing_ok=True)
            return None
        if not self.rows(schema.SMOOTHED_FIELDS[0].path):  # begun, perhaps: it is begun anew in the copy
            self._forget_smoothed(file)
        growing = {name: file[name] for name in self._growing}
        if any(dataset.shape[0] < self.rows(name) for name, dataset in growing.items()):
            file.close()
            path.unlink(missing_ok=True)
            return None
        for name, dataset in growing.items():  # what was not wholly written is written again
            dataset.resize(self.rows(name), axis=0)
        return type(self)(path, file, self.layout, growing, self._digests)

    def close(self) -> None:
        """Cut off the room that was reserved and not used. May be called twice."""
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

    @contextlib.contextmanager
    def _changing(self, room: int) -> Iterator[None]:
        """Around every change of the file: room first, then the change, then flush and synchronise."""
        try:
            reserve(self._descriptor, self.path, self._file.id.get_filesize(), room + _INDEX_BYTES)
            yield
            self._synchronise()
        except CarpusFault as fault:
            self.fault = fault
            raise
        except (OSError, RuntimeError) as cause:
            self.fault = write_fault(self.path, cause)
            raise self.fault from cause

    def _synchronise(self) -> None:
        self._file.flush()
        os.fsync(self._descriptor)

    def _grow(self, blocks: Sequence[Block]) -> None:
        for field, data in blocks:
            dataset = self._growing[field.path]
            begin = dataset.shape[0]
            dataset.resize(begin + len(data), axis=0)
            dataset[begin:] = data


def _room_for(dataset: h5py.Dataset, rows: int) -> int:
    """Bytes by which the file grows for rows of a dataset: whole chunks."""
    step, *row = dataset.chunks
    new_chunks = -(-(dataset.shape[0] + rows) // step) - -(-dataset.shape[0] // step)
    return int(new_chunks * step * np.prod(row) * dataset.dtype.itemsize)

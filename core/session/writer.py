"""Writer of session files: every chunk is written once and read back, under a hidden name until complete."""

from __future__ import annotations

import contextlib
import hashlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Self

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CarpusFault, OutputExists, OutputNotWritable, TimesUnordered
from carpus.core.model.phrase import phrase
from carpus.core.model.types import TrackedFrame
from carpus.core.platform.durable import (
    FileWriter,
    open_private,
    publish,
    remove_leftovers,
    reserve_space,
    temporary_path,
    write_fault,
)
from carpus.core.session import schema
from carpus.core.session.checks import CHECKSUM_ATTRIBUTE, compute_checksum, to_bytes
from carpus.core.session.file_layout import (
    ROWS_AT_ONCE,
    Blocks,
    build_empty_session,
    build_event_blocks,
    build_frame_blocks,
    build_motion_blocks,
    create_repetitions,
    create_smoother_datasets,
)
from carpus.core.session.session_file import SessionFile
from carpus.core.session.values import Event, Motion, Repetitions, Session, SessionHeader

_TIMES = schema.FRAME_FIELDS[0].path
_INDEX_BYTES = 512 * 1024
"""More than HDF5's index grows in one step."""


class SessionWriter(FileWriter):
    """Session file in progress, to be used by one thread until :meth:`close`.

    It gets its name in :meth:`close`; no other file is overwritten. After a fault nothing is left: the recording or
    journal still exists.
    """

    def __init__(self, path: Path, empty: bytes) -> None:
        """Create the file from one without rows.

        Raises
        ------
        OutputExists, OutputNotWritable, DiskFull
            It could not be created; nothing is left.
        """
        if os.path.lexists(path):
            raise OutputExists(path)
        remove_leftovers(path)
        self.path = path
        self._temporary = temporary_path(path)
        self._rows: dict[str, int] = {}
        self._pending_frames: list[TrackedFrame] = []
        self._pending: dict[str, list[Any]] = {}
        self._digests: dict[str, Any] = {}
        self._last_time_s = -np.inf
        try:
            with open(self._temporary, "xb", opener=open_private) as file:
                file.write(empty)
        except OSError as cause:
            with contextlib.suppress(OSError):
                self._temporary.unlink()
            raise write_fault(path.parent, cause) from cause
        self._descriptor = os.open(self._temporary, os.O_RDWR)
        self._file = h5py.File(self._temporary, "r+", libver="earliest", rdcc_nbytes=0)
        self._layout = SessionFile(path, self._file).layout

    @classmethod
    def create(cls, path: Path, header: SessionHeader, camera: Camera, calibration: Calibration) -> Self:
        return cls(path, build_empty_session(header, camera, calibration))

    def __len__(self) -> int:
        return self._rows.get(_TIMES, 0) + len(self._pending_frames)

    def append(self, tracked: TrackedFrame) -> None:
        if tracked.timestamp_s <= self._last_time_s:
            times = {"timestamp_s": f"{tracked.timestamp_s:.6f}", "last_time_s": f"{self._last_time_s:.6f}"}
            raise TimesUnordered(self.path, phrase("{timestamp_s} s after {last_time_s} s", **times))
        self._last_time_s = tracked.timestamp_s
        self._pending_frames.append(tracked)
        if len(self._pending_frames) >= ROWS_AT_ONCE:
            self.flush()

    def add_event(self, time_s: float, kind: str, text: str = "") -> None:
        self.add_blocks(build_event_blocks(Event(time_s, kind, text)))

    def add_blocks(self, blocks: Blocks) -> None:
        """Add rows as arrays, of frames with all that belongs to them, or of events."""
        blocks = dict(blocks)
        if schema.DETECTION_FRAME.path in blocks:
            blocks[schema.DETECTION_FRAME.path] = blocks[schema.DETECTION_FRAME.path] + self._rows.get(_TIMES, 0)
        for path, data in blocks.items():
            self._pending.setdefault(path, []).append(data)
            self._rows[path] = self._rows.get(path, 0) + len(data)
        if self._rows.get(_TIMES, 0) - self._file[_TIMES].shape[0] >= ROWS_AT_ONCE:
            self._write(whole_chunks=True)

    def write_motion(self, motion: Motion) -> None:
        """Write the smoother's result, one row for every frame appended."""
        if len(motion.position_m) != len(self):
            raise ValueError(f"/smoothed got {len(motion.position_m)} rows for {len(self)} frames")
        self.add_motion_blocks(build_motion_blocks(self._layout, motion))

    def add_motion_blocks(self, blocks: Blocks) -> None:
        """Add the smoother's result of the next frames as arrays, from the first frame on."""
        if not self.smoother_row_count:
            with self._reserve_and_flush(0):
                create_smoother_datasets(self._file, self._layout)
        self.add_blocks(blocks)

    @property
    def smoother_row_count(self) -> int:
        return self._rows.get(schema.SMOOTHED_FIELDS[0].path, 0)

    def drop_motion(self) -> None:
        """Remove the smoother's result, which is incomplete."""
        if self.smoother_row_count:
            with self._reserve_and_flush(0):
                del self._file["/smoothed"]
            for field in schema.SMOOTHED_FIELDS:
                for known in (self._pending, self._rows, self._digests):
                    known.pop(field.path, None)

    def read_session(self) -> Session:
        """Return the session as written so far."""
        self.flush()
        return SessionFile(self.path, self._file).read_session()

    def write_repetitions(self, repetitions: Repetitions) -> None:
        """Write the table of repetitions, once all frames are there."""
        self.flush()
        with self._reserve_and_flush(len(repetitions.rows) * schema.REPETITION_DTYPE.itemsize):
            create_repetitions(self._file, self._layout, repetitions)

    def flush(self) -> None:
        if self._pending_frames:
            frames, self._pending_frames = self._pending_frames, []
            self.add_blocks(build_frame_blocks(self._layout, frames))
        self._write()

    def close(self, recovered: str = "") -> None:
        """Finish the file: compute its checksum, synchronise it and give it its name; may be called twice.

        ``recovered`` is when an interrupted recording was finished.
        """
        if not self._file:
            return
        try:
            self.flush()
            with self._reserve_and_flush(0):
                if recovered:
                    self._file.attrs[schema.RECOVERED] = recovered
                self._file.attrs[CHECKSUM_ATTRIBUTE] = compute_checksum(
                    self._file, {path: one.hexdigest() for path, one in self._digests.items()}
                )
            self._close_file()
            publish(self._temporary, self.path)
        except (OSError, RuntimeError) as cause:
            raise write_fault(self.path, cause) from cause
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Stop and leave nothing behind; may be called twice, and when closed."""
        self._close_file(keep=False)
        self._temporary.unlink(missing_ok=True)

    def _close_file(self, keep: bool = True) -> None:
        if not self._file:
            return
        try:
            used = self._file.id.get_filesize()
            self._file.close()
            if keep:  # cut off the room that was reserved and not used
                os.truncate(self._descriptor, used)
                os.fsync(self._descriptor)
        except (OSError, RuntimeError):
            if keep:
                raise
        finally:
            os.close(self._descriptor)

    def _write(self, *, whole_chunks: bool = False) -> None:
        """Write pending rows; with ``whole_chunks`` incomplete chunks wait, so that none is compressed twice."""
        rows: dict[str, Any] = {}
        for path, parts in self._pending.items():
            data, dataset = np.concatenate(parts), self._file[path]
            rest = (dataset.shape[0] + len(data)) % dataset.chunks[0] if whole_chunks else 0
            end = max(len(data) - rest, 0)
            self._pending[path] = [data[end:]]
            if end:
                rows[path] = np.asarray(data[:end], dtype=dataset.dtype)
        self._pending = {path: parts for path, parts in self._pending.items() if len(parts[0])}
        if not rows:
            return
        with self._reserve_and_flush(2 * sum(data.nbytes for data in rows.values())):
            for path, data in rows.items():
                dataset = self._file[path]
                begin = dataset.shape[0]
                dataset.resize(begin + len(data), axis=0)
                dataset[begin:] = data
        for path, data in rows.items():
            dataset = self._file[path]
            try:  # read back for the checksum of the file
                stored = to_bytes(np.asarray(dataset[dataset.shape[0] - len(data) :]))
            except (OSError, RuntimeError) as cause:
                raise write_fault(self.path, cause) from cause
            if stored != to_bytes(data):
                raise OutputNotWritable(self.path.parent, phrase("the saved data differ from the recorded data"))
            self._digests.setdefault(path, hashlib.sha256()).update(stored)
        if whole_chunks:
            os.fsync(self._descriptor)  # so that the end has little left to do

    @contextlib.contextmanager
    def _reserve_and_flush(self, room: int) -> Iterator[None]:
        """Reserve space before a change of the file and flush it afterwards: a full disk must not reach HDF5."""
        if not self._file:
            raise ValueError("the session is closed")
        try:
            reserve_space(self._descriptor, self.path, self._file.id.get_filesize(), room + _INDEX_BYTES)
            yield
            self._file.flush()
        except CarpusFault:
            raise
        except (OSError, RuntimeError) as cause:
            raise write_fault(self.path, cause) from cause

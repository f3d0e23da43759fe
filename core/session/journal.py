"""The recording journal: append-only file of everything measured while a session is recorded.

It is on this computer's own disk. From it :func:`core.records.recordings.write_session` makes the session file, at Stop
or after a kill alike. Layout, little-endian: ``CARPUSRJ``, then records of 4 letters, u32 number, u32 length, u32
CRC-32 of the content, u32 CRC-32 of these 16 bytes, and the content:

- ``SESS`` a session file without rows, as HDF5: header, camera, calibration
- ``PATI`` identity of the patient, as text
- ``ROWS`` arrays of frames or of an event, ``SMOO`` of the smoother's result: u32 length of a JSON list of path, type
  and shape, that list, and the arrays
"""

from __future__ import annotations

import io
import json
import os
import re
import struct
import time
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from io import FileIO
from pathlib import Path

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CarpusFault, OutputExists, OutputNotWritable, SessionUnreadable, TimesUnordered
from carpus.core.model.phrase import phrase
from carpus.core.model.types import TrackedFrame
from carpus.core.platform.durable import FileWriter, lock_file, open_private, sync_folder, write_fault
from carpus.core.session.file_layout import (
    Blocks,
    build_empty_session,
    build_event_blocks,
    build_frame_blocks,
    build_motion_blocks,
)
from carpus.core.session.schema import TableLayout
from carpus.core.session.values import Event, Motion, SessionHeader

SUFFIX = ".journal"
MAGIC = b"CARPUSRJ"
SYNC_EVERY_S = 0.5
"""A kill or a power cut costs what came since; with the writing on a busy computer that is less than a second."""
MAX_PENDING_ROWS = 256
"""Rows kept in memory while a stored recording is played faster than real time."""
_RECORD = struct.Struct("<4sIIII")


class RecordingJournal(FileWriter):
    """Writer of a journal, to be used by one thread; synchronised twice a second."""

    def __init__(
        self,
        path: Path,
        header: SessionHeader,
        camera: Camera,
        calibration: Calibration,
        patient_id: str = "",
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Create the journal.

        Raises
        ------
        OutputExists, OutputNotWritable, DiskFull
            It could not be created; nothing is left.
        """
        self.path = path
        self.smoother_row_count = 0
        self._layout = TableLayout(header.protocol, header.joint_names)
        self._clock, self._synced_at_s = clock, clock()
        self._last_time_s = -np.inf
        self._pending_frames: list[TrackedFrame] = []
        self._pending_records: list[tuple[bytes, bytes]] = []
        self._count = 0
        self._fault: CarpusFault | None = None
        try:
            self._file: FileIO | None = FileIO(path, "xb", opener=open_private)
        except FileExistsError as cause:
            raise OutputExists(path) from cause
        except OSError as cause:
            raise OutputNotWritable(path.parent, cause.strerror or "") from cause
        try:
            lock_file(self._file)
            self._pending_records += [
                (b"SESS", build_empty_session(header, camera, calibration)),
                (b"PATI", patient_id.encode()),
            ]
            self._write(MAGIC)
        except BaseException:
            self.discard()
            raise
        sync_folder(path.parent)

    def append(self, tracked: TrackedFrame) -> None:
        """Append one frame; it is never dropped, :class:`DiskFull` is raised instead."""
        if tracked.timestamp_s <= self._last_time_s:
            times = {"timestamp_s": f"{tracked.timestamp_s:.6f}", "last_time_s": f"{self._last_time_s:.6f}"}
            raise TimesUnordered(self.path, phrase("{timestamp_s} s after {last_time_s} s", **times))
        self._last_time_s = tracked.timestamp_s
        self._pending_frames.append(tracked)
        self._write_when_due()

    def add_event(self, time_s: float, kind: str, text: str = "") -> None:
        self._pending_records.append((b"ROWS", pack_arrays(build_event_blocks(Event(time_s, kind, text)))))
        self._write_when_due()

    def add_smoothed(self, motion: Motion) -> None:
        """Add the smoother's result of the next frames, from the first appended on."""
        self._pending_records.append((b"SMOO", pack_arrays(build_motion_blocks(self._layout, motion))))
        self.smoother_row_count += len(motion.position_m)

    def flush(self) -> None:
        if self._fault is not None:
            raise self._fault
        if self._pending_frames:
            self._pending_records.append((b"ROWS", pack_arrays(build_frame_blocks(self._layout, self._pending_frames))))
            self._pending_frames = []
        self._write()

    def close(self) -> None:
        """Write everything to the disk and close the file. May be called twice."""
        if self._file is not None:
            try:
                self.flush()
            finally:
                self._close_file()

    def abandon(self) -> None:
        """Stop after a fault; what was added is kept."""
        with suppress(CarpusFault, ValueError):  # the first exception is the cause
            self.close()

    def discard(self) -> None:
        """Close and remove the file: nothing was recorded, or the session has been written."""
        self._close_file()
        self.path.unlink(missing_ok=True)

    def _close_file(self) -> None:
        if self._file is not None:
            self._file.close()
            self._file = None

    def _write_when_due(self) -> None:
        if self._clock() - self._synced_at_s >= SYNC_EVERY_S or len(self._pending_frames) >= MAX_PENDING_ROWS:
            self.flush()

    def _write(self, start: bytes = b"") -> None:
        """Write all pending records at once and synchronise."""
        self._synced_at_s = self._clock()
        if not self._pending_records:
            return
        if self._file is None:
            raise ValueError("the journal is closed")
        data = bytearray(start)
        for kind, content in self._pending_records:
            head = struct.pack("<4sIII", kind, self._count, len(content), zlib.crc32(content))
            data += head + struct.pack("<I", zlib.crc32(head)) + content
            self._count += 1
        self._pending_records = []
        try:
            rest = memoryview(data)
            while rest:
                rest = rest[self._file.write(rest) or 0 :]
            os.fsync(self._file.fileno())
        except OSError as cause:
            self._fault = write_fault(self.path, cause)
            raise self._fault from cause


class JournalReader:
    """Reader of a journal from its start, and later of what was added since; never writes.

    Raises :class:`SessionUnreadable` if the file is no journal. ``empty_session`` is the session file without rows,
    None if the recording ended before it was stored.
    """

    def __init__(self, path: Path) -> None:
        try:
            self._file = path.open("rb")
        except OSError as cause:
            raise SessionUnreadable(path, cause.strerror or "") from cause
        self._count, self._position = 0, len(MAGIC)
        self._has_skipped = self._has_gap = False
        start = self._file.read(len(MAGIC))
        if not MAGIC.startswith(start.rstrip(b"\0")):
            self._file.close()
            raise SessionUnreadable(path, phrase("not a recording journal"))
        kind, content = next(self.read(), (b"", b""))
        self.empty_session = content if kind == b"SESS" else None

    def read(self) -> Iterator[tuple[bytes, bytes]]:
        """Yield kind and content of each further complete record.

        Records with damaged content are skipped; the journal ends where no record begins.
        """
        while True:
            self._file.seek(self._position)
            head = self._file.read(_RECORD.size)
            if len(head) < _RECORD.size:
                return
            kind, number, length, content_sum, head_sum = _RECORD.unpack(head)
            if head_sum != zlib.crc32(head[:16]) or number != self._count:
                return
            content = self._file.read(length)
            if len(content) < length:
                return
            self._position += _RECORD.size + length
            self._count += 1
            if zlib.crc32(content) == content_sum:
                self._has_gap |= self._has_skipped
                yield kind, content
            else:
                self._has_skipped = True

    def is_damaged(self) -> bool:
        """Return whether a record follows a damaged one; a kill or a power cut only costs the end."""
        for _ in self.read():
            pass
        self._file.seek(self._position + 4)  # past a last one that is not whole
        rest = b"" if self._has_gap else self._file.read()
        heads = (rest[one.start() : one.start() + _RECORD.size] for one in re.finditer(b"PATI|ROWS|SMOO", rest))
        return self._has_gap or any(head[16:] == struct.pack("<I", zlib.crc32(head[:16])) for head in heads)

    @property
    def session_id(self) -> str:
        """Id of the session; empty if the recording ended before it was stored."""
        if self.empty_session is None:
            return ""
        with h5py.File(io.BytesIO(self.empty_session), "r") as file:
            return str(file.attrs["session_id"])

    def close(self) -> None:
        """Close the file; may be called twice."""
        self._file.close()


def pack_arrays(blocks: Blocks) -> bytes:
    """Return arrays by path as the content of a record."""
    arrays = {path: np.ascontiguousarray(data) for path, data in blocks.items()}
    table = json.dumps([(path, data.dtype.str, data.shape) for path, data in arrays.items()]).encode()
    return b"".join((struct.pack("<I", len(table)), table, *(data.tobytes() for data in arrays.values())))


def unpack_arrays(content: bytes) -> Blocks:
    """Return the arrays of :func:`pack_arrays`; raises ValueError for other content."""
    (length,) = struct.unpack_from("<I", content)
    position, blocks = 4 + length, {}
    for path, dtype, shape in json.loads(content[4:position]):
        count = int(np.prod(shape, dtype=np.int64))
        blocks[path] = np.frombuffer(content, dtype, count, position).reshape(shape)
        position += blocks[path].nbytes
    return blocks

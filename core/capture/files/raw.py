"""The application's own raw recording: colour and depth in one file that only grows.

Written data are never changed, so a crash or a full disk costs at most the last frame. Layout, little-endian:
``CARPUSRW``, u32 version, then records. A record is a header of 32 bytes (4 letters, u32 checksum of all that follows,
f64 time in seconds, u32 frames missing before, u32 number, u32 size of colour, u32 size of depth) and the two images in
tiles (:mod:`.image_codec`), JPEG or PNG each. ``HEAD`` comes first with JSON instead of colour, ``FRAM`` is a frame,
numbered from 0; ``DONE`` ends a complete recording and has the count of its frames as number.
"""

from __future__ import annotations

import json
import math
import os
import re
import struct
import time
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import BinaryIO

import numpy as np

from carpus.core.capture.files.image_codec import (
    MAX_IMAGE_BYTES,
    TiledImage,
    decode_color,
    decode_depth,
    encode_color,
    encode_depth,
    pack_tiles,
)
from carpus.core.capture.source import NoticeHandler, SourceInfo, ignore_notice
from carpus.core.model import errors
from carpus.core.model.camera import DISTORTION_COEFFICIENT_COUNTS, Camera
from carpus.core.model.depth_sensor import ASSUMED_SENSOR, parse_sensor
from carpus.core.model.phrase import phrase
from carpus.core.model.types import ByteImage, DepthImage, Frame, Region
from carpus.core.platform.durable import FileWriter, open_private, write_fault

SUFFIX = ".carpusraw"
BYTES_PER_FRAME = 62_000
"""Colour and depth of the hand and its surroundings: 58 000 to 62 000 bytes for a simulated whole hand, 34 000 to 50
000 for a wrist; a whole image takes 203 000 to 326 000.
"""
MB_PER_MINUTE = round(60 * 30 * BYTES_PER_FRAME / 1e6, -1)
MAGIC = b"CARPUSRW"
VERSION = 2
_START = struct.Struct("<8sI")
_RECORD = struct.Struct("<4sIdIIII")
_CHECKSUM_START = 8
SYNC_EVERY_S = 0.5
MAX_FRAMES = 1 << 24
"""Six days at 30 fps; a record with a larger number is damaged."""
_RECORD_TAG = re.compile(b"HEAD|FRAM|DONE")
_NO_COLOR, _NO_DEPTH = np.empty((0, 0, 3), np.uint8), np.empty((0, 0), np.uint16)


class RawWriter(FileWriter):
    """Writer of one raw recording: a context manager, or ended by :meth:`close`; synchronised twice a second.

    ``crop`` is applied to each frame before it is stored.
    """

    def __init__(
        self,
        path: Path,
        info: SourceInfo,
        *,
        lossless: bool = False,
        crop: Callable[[Frame], Frame] = lambda frame: frame,
    ) -> None:
        self.path = path
        self._synced_at_s = time.monotonic()
        self._info = info
        self._lossless, self._crop = lossless, crop
        self._depth_unit_m: float | None = None
        self._count = 0
        self._end = 0
        try:
            self._file: BinaryIO | None = open(path, "x+b", opener=open_private)  # noqa: SIM115  # closed by close
        except FileExistsError as cause:
            raise errors.OutputExists(path) from cause
        except OSError as cause:
            raise write_fault(path, cause) from cause
        self._write(_START.pack(MAGIC, VERSION))

    def __len__(self) -> int:
        return self._count

    def append_frame(self, frame: Frame) -> None:
        """Append one frame: depth lossless, colour as JPEG 95 or lossless. Times must rise."""
        frame = self._crop(frame)
        if self._count == 0:
            self._depth_unit_m = frame.depth_unit_m
            info, camera = self._info, self._info.camera
            content = {
                "name": info.name,
                "nominal_fps": info.nominal_fps,
                "has_depth": info.has_depth,
                "depth_unit_m": self._depth_unit_m,
                "color": "png" if self._lossless else "jpeg",
                "settings": dict(info.settings),
                "recording_id": info.recording_id,
                "recorded": info.recorded,
                "depth_sensor": camera.sensor.to_dict(),
                # an older Carpus, which would take any lens for plumb_bob, refuses a head that names one
                "camera": {
                    name: value
                    for name, value in asdict(camera).items()
                    if name != "sensor" and (name, value) != ("distortion_model", "plumb_bob")
                },
            }
            self._write(_pack_record(b"HEAD", 0.0, 0, 0, json.dumps(content, ensure_ascii=False).encode(), b""))
        depth = b"" if frame.depth_raw is None else pack_tiles(frame.depth_raw, encode_depth)
        if depth and frame.depth_unit_m != self._depth_unit_m:
            raise ValueError(f"depth in steps of {frame.depth_unit_m} m after {self._depth_unit_m} m")
        color = pack_tiles(frame.color_rgb, partial(encode_color, lossless=self._lossless))
        self._write(_pack_record(b"FRAM", frame.timestamp_s, frame.dropped_before, self._count, color, depth))
        self._count += 1

    def close(self) -> None:
        """Mark the recording as complete and synchronise it; may be called twice."""
        if self._file is None:
            return
        if self._count:
            self._write(_pack_record(b"DONE", 0.0, 0, self._count, b"", b""))
        try:
            os.fsync(self._file.fileno())
            self._file.close()
        except OSError as cause:
            raise write_fault(self.path, cause) from cause
        finally:
            self._file = None

    def abandon(self) -> None:
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
            self._file = None

    def discard(self) -> None:
        self.abandon()
        self.path.unlink(missing_ok=True)

    def _write(self, data: bytes) -> None:
        if self._file is None:
            raise ValueError("the recording is closed")
        try:
            self._file.write(data)
            self._file.flush()
            if time.monotonic() - self._synced_at_s >= SYNC_EVERY_S:
                self._synced_at_s = time.monotonic()
                os.fsync(self._file.fileno())
        except OSError as cause:
            # half a record at the end would be passed over anyway, but a clean end is better
            with suppress(OSError):
                self._file.truncate(self._end)
            raise write_fault(self.path, cause) from cause
        self._end += len(data)


@dataclass(frozen=True, slots=True)
class _RecordEntry:
    """Header and position of one record."""

    position: int
    kind: bytes
    checksum: int
    timestamp_s: float
    dropped_before: int
    number: int
    color_size: int
    depth_size: int

    @property
    def end(self) -> int:
        return self.position + _RECORD.size + self.color_size + self.depth_size


@dataclass(frozen=True, slots=True)
class LazyFrame:
    """Frame whose images are decoded when they are needed."""

    index: int
    timestamp_s: float
    color: TiledImage[ByteImage]
    depth: TiledImage[DepthImage] | None
    depth_unit_m: float
    dropped_before: int

    def decode(self, region: Region | None) -> Frame:
        """Return the frame, decoded at least within the region; None for all of it."""
        depth_raw = None if self.depth is None else self.depth.decode(region)
        return Frame(
            self.index, self.timestamp_s, self.color.decode(region), depth_raw, self.depth_unit_m, self.dropped_before
        )


class RawRecording:
    """Raw recording as a source of frames; an interrupted one is read up to its last complete frame.

    Frames with a wrong checksum are skipped and count as missing before the next one; ``notice`` receives
    :class:`DamagedFramesExcluded` at the end, and :class:`RecordingDamaged` if data follow the end.
    """

    def __init__(self, path: Path, *, notice: NoticeHandler = ignore_notice) -> None:
        if not path.is_file():
            raise errors.RecordingMissing(path)
        self._path = path
        self._notice = notice
        try:
            with path.open("rb") as file:
                head, self._entries, done, self._surplus_bytes = _build_index(path, file)
                header = b"" if head is None else _read_payload(file, head)
        except OSError as cause:
            raise errors.RecordingUnreadable(path, cause.strerror or "") from cause
        if not self._entries:
            raise errors.RecordingEmpty(path)
        self.is_complete = done is not None
        self._count = max(entry.number for entry in self._entries) + 1 if done is None else done.number
        self._times_s = np.array([entry.timestamp_s for entry in self._entries])
        try:
            content = json.loads(header or b"")
            camera = dict(content["camera"])
            camera["distortion"] = tuple(camera["distortion"])
            if len(camera["distortion"]) != DISTORTION_COEFFICIENT_COUNTS[camera.get("distortion_model", "plumb_bob")]:
                raise ValueError("a lens of no kind")
            camera["sensor"] = parse_sensor(content["depth_sensor"]) if "depth_sensor" in content else ASSUMED_SENSOR
            self._depth_unit_m = float(content["depth_unit_m"])
            lens = Camera(**camera)
            sizes = (lens.fx_px, lens.fy_px, lens.width_px, lens.height_px, self._depth_unit_m)
            if not all(map(math.isfinite, (lens.cx_px, lens.cy_px, *lens.distortion, *sizes))) or min(sizes) <= 0.0:
                raise ValueError("no camera's values")
            self.info = SourceInfo(
                str(content["name"]),
                lens,
                bool(content["has_depth"]) and any(entry.depth_size for entry in self._entries),
                len(self._entries),
                float(content["nominal_fps"]),
                {str(key): str(value) for key, value in content["settings"].items()}
                | ({} if self.is_complete else {"complete": "no: cut short, read up to its last whole frame"}),
                str(content.get("recording_id", "")),
                str(content.get("recorded", "")),
            )
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError, RecursionError) as cause:
            detail = phrase("damaged header, {count} frames present", count=len(self._entries))
            raise errors.RecordingUnreadable(path, detail) from cause

    def frames(self) -> Iterator[Frame]:
        """Yield all frames from the first on; may be repeated."""
        for frame in self.lazy_frames():
            yield frame.decode(None)

    def lazy_frames(self) -> Iterator[LazyFrame]:
        """Yield all frames, each decoded only where it is needed."""
        left_out = index = number = 0
        last_s = -math.inf
        camera = self.info.camera
        size_px = (camera.width_px, camera.height_px)
        with self._path.open("rb") as file:
            for entry in self._entries:
                pictures = _read_payload(file, entry)
                in_order = last_s < entry.timestamp_s < math.inf and number <= entry.number < self._count
                if not pictures or not in_order:
                    left_out += 1
                    continue
                color, depth = self._open_color(pictures, entry), None
                if entry.depth_size:
                    depth = TiledImage(self._path, pictures[entry.color_size :], _NO_DEPTH, decode_depth)
                if color.size_px != size_px or (depth is not None and depth.size_px != size_px):
                    raise errors.FrameSizeChanged(self._path)
                missing = entry.dropped_before + entry.number - number
                yield LazyFrame(index, entry.timestamp_s, color, depth, self._depth_unit_m, missing)
                index, number, last_s = index + 1, entry.number + 1, entry.timestamp_s
        lost = max(left_out, self._count - index)
        if lost:
            detail = phrase("{lost} of {count} frames", lost=lost, count=self._count)
            self._notice(errors.DamagedFramesExcluded(self._path, detail))
        if self._surplus_bytes:
            detail = phrase("{count} bytes after the end of the recording", count=self._surplus_bytes)
            self._notice(errors.RecordingDamaged(self._path, detail))

    def load_color(self, timestamp_s: float) -> ByteImage | None:
        """Return the colour image at a time; None if it was not stored or is damaged."""
        place = int(np.searchsorted(self._times_s, timestamp_s - 1e-6))
        if place == len(self._times_s) or self._times_s[place] > timestamp_s + 1e-6:
            return None
        entry = self._entries[place]
        with self._path.open("rb") as file:
            pictures = _read_payload(file, entry)
        return self._open_color(pictures, entry).decode(None) if pictures else None

    def _open_color(self, pictures: bytes, entry: _RecordEntry) -> TiledImage[ByteImage]:
        return TiledImage(self._path, pictures[: entry.color_size], _NO_COLOR, decode_color)

    def close(self) -> None:
        """Do nothing: no file is open between two passes."""


def is_raw_recording(path: Path) -> bool:
    """Return whether a file starts like a raw recording."""
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def _pack_record(kind: bytes, time_s: float, dropped: int, number: int, color: bytes, depth: bytes) -> bytes:
    head = _RECORD.pack(kind, 0, time_s, dropped, number, len(color), len(depth))
    rest = b"".join((head[_CHECKSUM_START:], color, depth))
    return kind + struct.pack("<I", zlib.crc32(rest)) + rest


def _build_index(
    path: Path, file: BinaryIO
) -> tuple[_RecordEntry | None, list[_RecordEntry], _RecordEntry | None, int]:
    """Return header, frames, end record (None if interrupted) and number of bytes after it."""
    size = file.seek(0, os.SEEK_END)
    file.seek(0)
    start = file.read(_START.size)
    if len(start) < _START.size or not start.startswith(MAGIC):
        raise errors.RecordingUnreadable(path, phrase("not a raw recording"))
    version = _START.unpack(start)[1]
    if version != VERSION:
        versions = {"version": version, "newest": VERSION}
        detail = phrase("format version {version}, but this version of Carpus reads {newest}", **versions)
        raise errors.RecordingUnreadable(path, detail)
    head: _RecordEntry | None = None
    entries: list[_RecordEntry] = []
    for record in _scan_records(file, size):
        if record.kind == b"DONE":
            return head, entries, record, size - record.end
        if record.kind == b"FRAM":
            entries.append(record)
        else:
            head = head or record
    return head, entries, None, 0


def _scan_records(file: BinaryIO, size: int) -> Iterator[_RecordEntry]:
    """Yield each record at the end of the one before; after damage the next one with a right checksum.

    The search starts within the record before if that is damaged, since its size may be. Checksums tried in vain cover
    at most four times the size of the file.
    """
    left = 4 * size

    def is_valid(record: _RecordEntry) -> bool:
        nonlocal left
        if _read_payload(file, record) is not None:
            return True
        left -= record.end - record.position
        return False

    position, number = _START.size, 0
    last: _RecordEntry | None = None
    while position < size:
        record = _read_record_header(file, position, size)
        if record is None or record.number != number or (record.kind == b"DONE" and not is_valid(record)):
            begin = position if last is None or is_valid(last) else last.position + 1
            candidates = (_read_record_header(file, place, size) for place in _find_record_tags(file, begin))
            record = next((one for one in candidates if left < 0 or (one is not None and is_valid(one))), None)
            if record is None or left < 0:
                return
        yield record
        position, number, last = record.end, record.number + (record.kind == b"FRAM"), record


def _read_record_header(file: BinaryIO, position: int, size: int) -> _RecordEntry | None:
    """Return the record header at a position, whatever its checksum; None if it cannot be one."""
    file.seek(position)
    data = file.read(_RECORD.size)
    if len(data) < _RECORD.size or not _RECORD_TAG.match(data):
        return None
    entry = _RecordEntry(position, *_RECORD.unpack(data))
    if entry.end > size or max(entry.color_size, entry.depth_size) > MAX_IMAGE_BYTES:
        return None
    return entry if max(entry.number, entry.dropped_before) <= MAX_FRAMES else None


def _find_record_tags(file: BinaryIO, position: int) -> Iterator[int]:
    """Yield the positions of record tags from a position on, in growing blocks."""
    length = 256
    while True:
        file.seek(position)
        data = file.read(length)
        for found in _RECORD_TAG.finditer(data):
            yield position + found.start()
        if len(data) < length:
            return
        position += length - 3  # letters may lie across
        length = min(2 * length, 1 << 20)


def _read_payload(file: BinaryIO, entry: _RecordEntry) -> bytes | None:
    """Return the two images of a frame as bytes; None if the checksum differs."""
    file.seek(entry.position + _CHECKSUM_START)
    rest = file.read(entry.end - entry.position - _CHECKSUM_START)
    return rest[_RECORD.size - _CHECKSUM_START :] if zlib.crc32(rest) == entry.checksum else None

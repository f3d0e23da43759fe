"""The application's own raw recording: colour and depth pictures in one file that only grows.

Nothing that was written is touched again, so a crash or a full disk costs at most the last frame, and writing needs
no lock that others wait for. Layout, little-endian: ``CARPUSRW``, u32 version, then records. A record is a header of
32 bytes (4 letters, u32 check sum of all that follows, f64 time in seconds, u32 frames missing before, u32 number,
u32 size of colour, u32 size of depth) and the two pictures in tiles (:mod:`.pictures`), JPEG or PNG each. ``HEAD``
comes first with JSON instead of colour, ``FRAM`` is a frame, ``DONE`` ends a recording that was closed.
"""

from __future__ import annotations

import errno
import json
import math
import os
import struct
import time
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from carpus.core.camera import COEFFICIENTS, Camera
from carpus.core.capture.files.pictures import Tiled, decode_color, decode_depth, encode_color, encode_depth, packed
from carpus.core.capture.source import Notice, SourceInfo, ignore
from carpus.core.depth_sensor import ASSUMED_SENSOR, sensor_of
from carpus.core.durable import Writing, copy_open_file, is_still_there, private
from carpus.core.errors import (
    DiskFull,
    OutputExists,
    OutputNotWritable,
    PictureSizeChanged,
    PicturesLost,
    RecordingEmpty,
    RecordingMissing,
    RecordingUnreadable,
)
from carpus.core.phrase import phrase
from carpus.core.types import ByteImage, DepthImage, Frame, Region

SUFFIX = ".carpusraw"
BYTES_PER_PICTURE = 62_000
"""Colour and depth of a hand and its surroundings, the most of what the simulated camera gave: 58 000 to 62 000 of a
whole hand, 34 000 to 50 000 of a wrist; a whole picture takes 203 000 to 326 000."""
MB_PER_MINUTE = round(60 * 30 * BYTES_PER_PICTURE / 1e6, -1)
MAGIC = b"CARPUSRW"
VERSION = 2
_START = struct.Struct("<8sI")
_RECORD = struct.Struct("<4sIdIIII")
_CHECKED_FROM = 8
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
LOOK_EVERY_S = 0.8
MAX_PICTURE_BYTES = 1 << 27
_NO_COLOR, _NO_DEPTH = np.empty((0, 0, 3), np.uint8), np.empty((0, 0), np.uint16)


class RawWriter(Writing):
    """Writes one raw recording. Use as a context manager, or end it by :meth:`close`.

    When its folder goes away it goes on in the one that ``fallback`` names, with what was recorded if that can still be
    read.
    """

    def __init__(
        self,
        path: Path,
        info: SourceInfo,
        *,
        lossless: bool = False,
        fallback: Callable[[], Path] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._path = path
        self._fallback, self._clock = fallback, clock
        self._looked_s = clock()
        self._info = info
        self._lossless = lossless
        self._depth_unit_m: float | None = None
        self._count = 0
        self._end = 0
        self._file: BinaryIO | None = _create(path)
        self._put(_START.pack(MAGIC, VERSION))

    @property
    def path(self) -> Path:
        return self._path

    def __len__(self) -> int:
        return self._count

    def append_frame(self, frame: Frame) -> None:
        """Store one frame: depth without loss, colour as JPEG 95 or without loss. Times rise strictly."""
        if self._fallback is not None and self._clock() - self._looked_s >= LOOK_EVERY_S:
            self._looked_s = self._clock()
            if self._file is not None and not is_still_there(self._file.fileno(), self._path):
                self._move(self._fallback())
        if self._count == 0:
            self._depth_unit_m = frame.depth_unit_m
            self._put(_record(b"HEAD", 0.0, 0, 0, self._head(), b""))
        depth = b"" if frame.depth_raw is None else packed(frame.depth_raw, encode_depth)
        if depth and frame.depth_unit_m != self._depth_unit_m:
            raise ValueError(f"depth in steps of {frame.depth_unit_m} m after {self._depth_unit_m} m")
        color = packed(frame.color_rgb, partial(encode_color, lossless=self._lossless))
        self._put(_record(b"FRAM", frame.timestamp_s, frame.dropped_before, self._count, color, depth))
        self._count += 1

    def go_on_elsewhere(self, frame: Frame | None) -> RawWriter:
        """A new recording in the fallback's folder, beginning with ``frame``, for another thread while the one that
        writes hangs in the disk; what was stored stays there. Raises :class:`OutputNotWritable` without a fallback."""
        if self._fallback is None:
            raise OutputNotWritable(self._path)
        folder, self._fallback = self._fallback(), None
        new = RawWriter(folder / self._path.name, self._info, lossless=self._lossless, clock=self._clock)
        if frame is not None:
            new.append_frame(frame)
        return new

    def close(self) -> None:
        """Mark the recording as whole and bring it to the disk; may be called twice."""
        if self._file is None:
            return
        if self._count:
            self._put(_record(b"DONE", 0.0, 0, self._count, b"", b""))
        try:
            os.fsync(self._file.fileno())
            self._file.close()
        except OSError as cause:
            raise _write_fault(self._path, cause) from cause
        finally:
            self._file = None

    def abandon(self) -> None:
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
            self._file = None

    def discard(self) -> None:
        self.abandon()
        self._path.unlink(missing_ok=True)

    def _move(self, folder: Path) -> None:
        """Go on elsewhere; what was recorded comes along where it can still be read."""
        assert self._file is not None
        path, old = folder / self._path.name, self._file
        self._fallback = None  # one disaster at a time
        try:
            copy_open_file(old.fileno(), path)
            self._file = path.open("r+b")
            self._file.seek(self._end)
        except OSError:
            path.unlink(missing_ok=True)
            self._file, self._end, self._count = _create(path), 0, 0
            self._put(_START.pack(MAGIC, VERSION))
        self._path = path
        with suppress(OSError):
            old.close()

    def _head(self) -> bytes:
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
            "depth_sensor": camera.sensor.as_mapping(),
            "camera": {
                "fx_px": camera.fx_px,
                "fy_px": camera.fy_px,
                "cx_px": camera.cx_px,
                "cy_px": camera.cy_px,
                "width_px": camera.width_px,
                "height_px": camera.height_px,
                "distortion": list(camera.distortion),
                "origin": camera.origin,
                # An older Carpus, which would take any lens for plumb_bob, refuses a head that names one.
                **({} if camera.distortion_model == "plumb_bob" else {"distortion_model": camera.distortion_model}),
            },
        }
        return json.dumps(content, ensure_ascii=False).encode()

    def _put(self, data: bytes) -> None:
        if self._file is None:
            raise ValueError("the recording is closed")
        try:
            self._file.write(data)
            self._file.flush()
        except OSError as cause:
            # half a record at the end would be passed over anyway, but a clean end is better
            with suppress(OSError):
                self._file.truncate(self._end)
            raise _write_fault(self._path, cause) from cause
        self._end += len(data)


@dataclass(frozen=True, slots=True)
class _Entry:
    """Where one frame lies in the file."""

    position: int
    timestamp_s: float
    dropped_before: int
    color_size: int
    depth_size: int
    check: int


@dataclass(frozen=True, slots=True)
class PackedFrame:
    """A frame whose pictures are unpacked where they are looked at."""

    index: int
    timestamp_s: float
    color: Tiled[ByteImage]
    depth: Tiled[DepthImage] | None
    depth_unit_m: float
    dropped_before: int

    def seen(self, part: Region | None) -> Frame:
        """The frame for who looks at a part of the pictures, None for all of them; the rest may still be empty."""
        depth_raw = None if self.depth is None else self.depth.seen(part)
        return Frame(
            self.index, self.timestamp_s, self.color.seen(part), depth_raw, self.depth_unit_m, self.dropped_before
        )


class RawRecording:
    """A raw recording as a source of frames. One that was cut short is read up to its last whole frame.

    Frames that do not pass their check sum are left out: the next one counts them as missing, and ``notice`` hears
    :class:`PicturesLost` at the end.
    """

    def __init__(self, path: Path, *, notice: Notice = ignore) -> None:
        if not path.is_file():
            raise RecordingMissing(path)
        self._path = path
        self._notice = notice
        try:
            with path.open("rb") as file:
                head, self._entries, self.complete = _index(path, file)
        except OSError as cause:
            raise RecordingUnreadable(path, cause.strerror or "") from cause
        if not self._entries:
            raise RecordingEmpty(path)
        self._times_s = np.array([entry.timestamp_s for entry in self._entries])
        try:
            camera = dict(head["camera"])
            camera["distortion"] = tuple(camera["distortion"])
            if len(camera["distortion"]) != COEFFICIENTS[camera.get("distortion_model", "plumb_bob")]:
                raise ValueError("a lens of no kind")
            camera["sensor"] = sensor_of(head["depth_sensor"]) if "depth_sensor" in head else ASSUMED_SENSOR
            self._depth_unit_m = float(head["depth_unit_m"])
            lens = Camera(**camera)
            _check(lens, self._depth_unit_m)
            self._info = SourceInfo(
                str(head["name"]),
                lens,
                bool(head["has_depth"]) and any(entry.depth_size for entry in self._entries),
                len(self._entries),
                float(head["nominal_fps"]),
                {str(key): str(value) for key, value in head["settings"].items()}
                | ({} if self.complete else {"complete": "no: cut short, read up to its last whole frame"}),
                str(head.get("recording_id", "")),
                str(head.get("recorded", "")),
            )
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as cause:
            raise RecordingUnreadable(path, phrase("its head is damaged")) from cause

    @property
    def info(self) -> SourceInfo:
        return self._info

    def frames(self) -> Iterator[Frame]:
        """All frames from the first on; may be walked through again."""
        for frame in self.packed_frames():
            yield frame.seen(None)

    def packed_frames(self) -> Iterator[PackedFrame]:
        """As :meth:`frames`, each unpacked only where somebody looks."""
        lost = missing = index = 0
        last_s = -math.inf
        camera = self._info.camera
        size_px = (camera.width_px, camera.height_px)
        with self._path.open("rb") as file:
            for entry in self._entries:
                pictures = _read(file, entry)
                if not pictures or not last_s < entry.timestamp_s < math.inf:
                    lost += 1
                    missing += 1 + entry.dropped_before
                    continue
                color, depth = self._color(pictures, entry), None
                if entry.depth_size:
                    depth = Tiled(self._path, pictures[entry.color_size :], _NO_DEPTH, decode_depth)
                if color.size_px != size_px or (depth is not None and depth.size_px != size_px):
                    raise PictureSizeChanged(self._path)
                yield PackedFrame(
                    index,
                    entry.timestamp_s,
                    color,
                    depth,
                    self._depth_unit_m,
                    entry.dropped_before + missing,
                )
                index, missing, last_s = index + 1, 0, entry.timestamp_s
        if lost:
            self._notice(
                PicturesLost(self._path, phrase("{lost} of {count} frames", lost=lost, count=len(self._entries)))
            )

    def color_at(self, timestamp_s: float) -> ByteImage | None:
        """The colour picture of that time, None when it was not stored or is damaged."""
        place = int(np.searchsorted(self._times_s, timestamp_s - 1e-6))
        if place == len(self._times_s) or self._times_s[place] > timestamp_s + 1e-6:
            return None
        entry = self._entries[place]
        with self._path.open("rb") as file:
            pictures = _read(file, entry)
        return self._color(pictures, entry).seen(None) if pictures else None

    def _color(self, pictures: bytes, entry: _Entry) -> Tiled[ByteImage]:
        return Tiled(self._path, pictures[: entry.color_size], _NO_COLOR, decode_color)

    def close(self) -> None:
        """Nothing is held open between two walks."""


def is_raw_recording(path: Path) -> bool:
    """Whether a file begins like a raw recording."""
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def _record(kind: bytes, time_s: float, dropped: int, number: int, color: bytes, depth: bytes) -> bytes:
    head = _RECORD.pack(kind, 0, time_s, dropped, number, len(color), len(depth))
    rest = b"".join((head[_CHECKED_FROM:], color, depth))
    return kind + struct.pack("<I", zlib.crc32(rest)) + rest


def _index(path: Path, file: BinaryIO) -> tuple[Mapping[str, Any], list[_Entry], bool]:
    """Head, frames and whether the recording was closed; a torn end is passed over."""
    size = file.seek(0, os.SEEK_END)
    file.seek(0)
    start = file.read(_START.size)
    if len(start) < _START.size or not start.startswith(MAGIC):
        raise RecordingUnreadable(path, phrase("not a raw recording"))
    version = _START.unpack(start)[1]
    if version != VERSION:
        raise RecordingUnreadable(
            path, phrase("format version {version}, this Carpus reads {newest}", version=version, newest=VERSION)
        )
    head: Mapping[str, Any] = {}
    entries: list[_Entry] = []
    position = _START.size
    while position + _RECORD.size <= size:
        file.seek(position)
        kind, check, time_s, dropped, _, color_size, depth_size = _RECORD.unpack(file.read(_RECORD.size))
        end = position + _RECORD.size + color_size + depth_size
        if kind == b"DONE":
            return head, entries, True
        if kind not in (b"HEAD", b"FRAM") or end > size or max(color_size, depth_size) > MAX_PICTURE_BYTES:
            break
        entry = _Entry(position, time_s, dropped, color_size, depth_size, check)
        if kind == b"HEAD":
            head = _json(path, _read(file, entry))
        else:
            entries.append(entry)
        position = end
    return head, entries, False


def _check(camera: Camera, depth_unit_m: float) -> None:
    """Raises ``TypeError`` or ``ValueError`` for what no camera is."""
    if not all(map(math.isfinite, (camera.cx_px, camera.cy_px, *camera.distortion))):
        raise ValueError("no camera's middle or lens")
    sizes = (camera.fx_px, camera.fy_px, camera.width_px, camera.height_px, depth_unit_m)
    if not all(0.0 < size < math.inf for size in sizes):
        raise ValueError("no camera's size")


def _json(path: Path, data: bytes) -> Mapping[str, Any]:
    try:
        content = json.loads(data)
    except (ValueError, RecursionError) as cause:
        raise RecordingUnreadable(path, phrase("its head is damaged")) from cause
    if not isinstance(content, dict):
        raise RecordingUnreadable(path, phrase("its head is damaged"))
    return content


def _read(file: BinaryIO, entry: _Entry) -> bytes:
    """Both pictures of a frame, one after the other; empty when the check sum differs."""
    file.seek(entry.position + _CHECKED_FROM)
    rest = file.read(_RECORD.size - _CHECKED_FROM + entry.color_size + entry.depth_size)
    return rest[_RECORD.size - _CHECKED_FROM :] if zlib.crc32(rest) == entry.check else b""


def _create(path: Path) -> BinaryIO:
    try:
        return open(path, "x+b", opener=private)
    except FileExistsError as cause:
        raise OutputExists(path) from cause
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _write_fault(path: Path, cause: OSError) -> DiskFull | OutputNotWritable:
    return DiskFull(path) if cause.errno in _FULL else OutputNotWritable(path, cause.strerror or "")

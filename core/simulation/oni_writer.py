"""Writes .oni recordings that the OpenNI2 library plays: depth packed without loss, colour as JPEG or as it is."""

from __future__ import annotations

import dataclasses
import math
import shutil
import struct
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, Literal

import numpy as np

from carpus.core.camera import Camera
from carpus.core.capture.camera_info import CAMERA_FILE, sidecar_path, write_camera_info
from carpus.core.capture.files import oni_format as oni
from carpus.core.capture.files.oni_format import Codec, NodeType, RecordType, encode_depth
from carpus.core.capture.files.pictures import encode_color
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.video_mode import PixelFormat
from carpus.core.durable import Writing, private
from carpus.core.errors import DiskFull, OutputExists, OutputNotWritable
from carpus.core.simulation.recording import CLICKS_FILE, TRUTH_FILE, simulate
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.types import ByteImage, DepthImage, Frame

ColorCodec = Literal["jpeg", "raw"]
DepthCodec = Literal["table", "raw"]
MAX_DEPTH = 10000
NOT_KNOWN = 0xFFFFFFFFFFFFFFFF
"""A time that is not known yet: all ones, as the library's own recorder writes it."""
_DEPTH_FORMATS = ((1e-3, PixelFormat.DEPTH_1_MM), (1e-4, PixelFormat.DEPTH_100_UM))


class _Stream:
    """One stream while it is written."""

    def __init__(self, node: int, name: str, kind: NodeType, codec: bytes) -> None:
        self.node = node
        self.name = name
        self.kind = kind
        self.codec = codec
        self.added_at = 0
        self.last_at = 0
        self.entries: list[tuple[int, int]] = []


class OniWriter(Writing):
    """Writes one recording. Use as a context manager; the file is whole only after :meth:`close`.

    >>> import tempfile
    >>> from carpus.core.camera import DEFAULT_CAMERA
    >>> folder = tempfile.TemporaryDirectory()
    >>> with folder, OniWriter(Path(folder.name) / "a.oni", DEFAULT_CAMERA) as writer:
    ...     writer.add_color(np.zeros((480, 640, 3), np.uint8), 0.0)
    ...     writer.add_depth(np.full((480, 640), 700, np.uint16), 0.0)
    """

    def __init__(
        self,
        path: Path,
        camera: Camera,
        *,
        fps: int = 30,
        color: ColorCodec = "jpeg",
        depth: DepthCodec | None = "table",
        depth_unit_m: float = 1e-3,
        mirrored: bool = False,
    ) -> None:
        formats = [code for unit_m, code in _DEPTH_FORMATS if math.isclose(unit_m, depth_unit_m)]
        if depth and not formats:
            raise ValueError(f"depth in steps of {depth_unit_m} m; an .oni file takes 1 mm or 0.1 mm")
        self._path = path
        self._camera = camera
        self._fps = fps
        self._mirrored = mirrored
        self._streams: dict[NodeType, _Stream] = {}
        self._greatest_us = 0
        self._stream_count = 2 if depth else 1
        self._file: BinaryIO | None = _create(path)
        self._write(self._header(NOT_KNOWN))
        if depth:
            codec = Codec.DEPTH_TABLE if depth == "table" else Codec.RAW
            self._add_stream("Depth", NodeType.DEPTH, codec, formats[0])
        codec = Codec.JPEG if color == "jpeg" else Codec.RAW
        self._add_stream("Image", NodeType.IMAGE, codec, PixelFormat.RGB888)
        for stream in self._streams.values():
            self._record(RecordType.NODE_READY, stream.node)
        for stream in self._streams.values():
            fields = oni.DATA_BEGIN_FIELDS.pack(0xFFFFFFFF, NOT_KNOWN)
            self._record(RecordType.DATA_BEGIN, stream.node, fields)

    def add_color(self, color_rgb: ByteImage, timestamp_s: float) -> None:
        """Append a colour picture (H, W, 3); times rise strictly."""
        stream = self._streams[NodeType.IMAGE]
        if color_rgb.shape != (self._camera.height_px, self._camera.width_px, 3) or color_rgb.dtype != np.uint8:
            raise ValueError(f"colour picture {color_rgb.shape} {color_rgb.dtype}")
        self._picture(
            stream, timestamp_s, encode_color(color_rgb) if stream.codec == Codec.JPEG else color_rgb.tobytes()
        )

    def add_depth(self, depth_raw: DepthImage, timestamp_s: float) -> None:
        """Append a depth picture (H, W) in the unit given at the start."""
        stream = self._streams[NodeType.DEPTH]
        if depth_raw.shape != (self._camera.height_px, self._camera.width_px) or depth_raw.dtype != np.uint16:
            raise ValueError(f"depth picture {depth_raw.shape} {depth_raw.dtype}")
        payload = encode_depth(depth_raw) if stream.codec == Codec.DEPTH_TABLE else depth_raw.tobytes()
        self._picture(stream, timestamp_s, payload)

    def close(self) -> None:
        """Write the tables and the end; may be called twice."""
        if self._file is None:
            return
        seek_at: dict[int, int] = {}
        for stream in self._streams.values():
            self._record(RecordType.NODE_REMOVED, stream.node, replaces=stream.added_at)
            if stream.entries:
                # entry 0 is never a picture; it points to the first one, where a failed search ends up
                entries = [(0, stream.entries[0][1]), *stream.entries]
                table = b"".join(oni.SEEK_ENTRY.pack(time_us, 0, position) for time_us, position in entries)
                seek_at[stream.node] = self._record(RecordType.SEEK_TABLE, stream.node, payload=table)
        self._record(RecordType.END, 0)
        for stream in self._streams.values():
            self._file.seek(stream.added_at)
            self._write(self._added(stream, seek_at.get(stream.node, 0), len(stream.entries)))
        self._file.seek(0)
        self._write(self._header(self._greatest_us))
        try:
            self._file.close()
        except OSError as cause:
            raise DiskFull(self._path) from cause
        finally:
            self._file = None

    def abandon(self) -> None:
        """Leave the file as it is: without its end, which every reader notices."""
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
            self._file = None

    def _picture(self, stream: _Stream, timestamp_s: float, payload: bytes) -> None:
        time_us = round(timestamp_s * 1e6)
        if time_us < 0 or (stream.entries and time_us <= stream.entries[-1][0]):
            raise ValueError(f"{stream.name} at {timestamp_s} s does not follow the picture before")
        fields = oni.NEW_DATA_FIELDS.pack(time_us, len(stream.entries) + 1)
        stream.last_at = self._record(RecordType.NEW_DATA, stream.node, fields, payload, stream.last_at)
        stream.entries.append((time_us, stream.last_at))
        self._greatest_us = max(self._greatest_us, time_us)

    def _add_stream(self, name: str, kind: NodeType, codec: bytes, pixel_format: PixelFormat) -> None:
        stream = self._streams[kind] = _Stream(len(self._streams) + 1, name, kind, codec)
        camera = self._camera
        is_depth = kind == NodeType.DEPTH
        stream.added_at = self._tell()
        self._write(self._added(stream, 0, 0xFFFFFFFF))
        mode = struct.pack("<III", camera.width_px, camera.height_px, self._fps)
        self._int(stream, oni.FRAME_SIZE, camera.width_px * camera.height_px * (2 if is_depth else 3))
        self._int(stream, "xnIsGenerating", 1)
        if is_depth:
            self._int(stream, oni.MAX_DEPTH, MAX_DEPTH)
        self._int(stream, "xnSupportedMapOutputModesCount", 1)
        self._property(stream, "xnSupportedMapOutputModes", mode)
        self._property(stream, oni.MAP_OUTPUT_MODE, mode)
        self._property(stream, "xnSupportedPixelFormats", struct.pack("<I", 8 if is_depth else 1))
        self._int(stream, oni.PIXEL_FORMAT_1, 4 if is_depth else 1)
        self._int(stream, oni.PIXEL_FORMAT_2, pixel_format)
        across = 2.0 * math.atan(camera.width_px / 2.0 / camera.fx_px)
        down = 2.0 * math.atan(camera.height_px / 2.0 / camera.fy_px)
        self._property(stream, oni.FIELD_OF_VIEW, struct.pack("<dd", across, down))
        self._int(stream, "Cropping", 1)
        self._property(stream, oni.CROPPING, bytes(12))
        self._int(stream, "Mirror", 1)
        self._int(stream, oni.MIRROR, int(self._mirrored))

    def _header(self, greatest_us: int) -> bytes:
        return oni.FILE_HEADER.pack(oni.FILE_MAGIC, *oni.FILE_VERSION, greatest_us, self._stream_count)

    def _added(self, stream: _Stream, seek_at: int, count: int) -> bytes:
        last_us = stream.entries[-1][0] if stream.entries else 0
        numbers = (stream.kind, stream.codec, count, 0, last_us, seek_at)
        fields = _string(stream.name) + oni.NODE_ADDED_FIELDS.pack(*numbers)
        return _record_bytes(RecordType.NODE_ADDED, stream.node, fields, 0, 0)

    def _int(self, stream: _Stream, name: str, value: int) -> None:
        self._property(stream, name, struct.pack("<Q", value), RecordType.INT_PROPERTY)

    def _property(
        self, stream: _Stream, name: str, data: bytes, kind: RecordType = RecordType.GENERAL_PROPERTY
    ) -> None:
        self._record(kind, stream.node, _string(name) + struct.pack("<I", len(data)) + data)

    def _record(self, kind: RecordType, node: int, fields: bytes = b"", payload: bytes = b"", replaces: int = 0) -> int:
        position = self._tell()
        self._write(_record_bytes(kind, node, fields, len(payload), replaces))
        self._write(payload)
        return position

    def _tell(self) -> int:
        assert self._file is not None
        return self._file.tell()

    def _write(self, data: bytes) -> None:
        assert self._file is not None, "the recording is closed"
        try:
            self._file.write(data)
        except OSError as cause:
            raise DiskFull(self._path) from cause


def write_oni(
    path: Path,
    frames: Iterable[Frame],
    camera: Camera,
    *,
    fps: int = 30,
    color: ColorCodec = "jpeg",
    mirrored: bool = False,
    simulated: bool = False,
) -> int:
    """Write ``frames`` to ``path`` and the camera beside it (``NAME.camera_info.yaml``); returns how many.

    With ``mirrored`` the pictures are written left for right, as a camera left on its default does. ``simulated``
    pictures are said to be in the file beside, since the recording itself has no place for it.
    """
    sidecar = sidecar_path(path)
    if sidecar.exists():
        raise OutputExists(sidecar)
    written = 0
    writer: OniWriter | None = None
    unit_m = 1e-3
    try:
        for frame in frames:
            if writer is None:
                unit_m = frame.depth_unit_m if frame.depth_raw is not None else 1e-3
                writer = OniWriter(path, camera, fps=fps, color=color, depth_unit_m=unit_m, mirrored=mirrored)
            side = -1 if mirrored else 1
            if frame.depth_raw is not None:
                if not math.isclose(frame.depth_unit_m, unit_m):
                    raise ValueError(f"depth in steps of {frame.depth_unit_m} m after {unit_m} m")
                writer.add_depth(np.ascontiguousarray(frame.depth_raw[:, ::side]), frame.timestamp_s)
            writer.add_color(np.ascontiguousarray(frame.color_rgb[:, ::side]), frame.timestamp_s)
            written += 1
        if writer is not None:
            writer.close()
    finally:
        if writer is not None:
            writer.abandon()
    if written:
        write_camera_info(sidecar, camera, registered=True, mirrored=mirrored, simulated=simulated)
    return written


def _create(path: Path) -> BinaryIO:
    try:
        return open(path, "xb", opener=private)
    except FileExistsError as cause:
        raise OutputExists(path) from cause
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _string(text: str) -> bytes:
    raw = text.encode("ascii") + b"\0"
    return struct.pack("<I", len(raw)) + raw


def _record_bytes(kind: RecordType, node: int, fields: bytes, payload_size: int, replaces: int) -> bytes:
    size = oni.RECORD_HEADER.size + len(fields)
    return oni.RECORD_HEADER.pack(oni.RECORD_MAGIC, kind, node, size, payload_size, replaces) + fields


RECORDING_FILE = "recording.oni"
_MILLIMETRE = 1e-3


def simulate_oni(spec: RecordingSpec, folder: Path, progress: Callable[[int, int], None] | None = None) -> Path:
    """Make ``recording.oni`` with its sidecar, clicks and truth in ``folder``; the file's path.

    Depth is in whole millimetres, as the device gives it.
    """
    target = folder / RECORDING_FILE
    if target.exists():
        raise OutputExists(target)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".rendering.", dir=folder) as scratch:
        pictures = Path(scratch) / "tum"
        simulate(spec, pictures, progress)
        source = TumFolder(pictures, read_ahead=4)
        frames = in_millimetres(source.frames())
        write_oni(target, frames, source.info.camera, fps=round(spec.fps), simulated=True)
        for name in (CLICKS_FILE, TRUTH_FILE, CAMERA_FILE):
            shutil.move(pictures / name, folder / name)
    return target


def in_millimetres(frames: Iterator[Frame]) -> Iterator[Frame]:
    """The frames with their depth in whole millimetres, as the device gives it."""
    for frame in frames:
        depth = frame.depth_raw
        if depth is not None:
            depth = np.rint(depth * (frame.depth_unit_m / _MILLIMETRE)).astype(np.uint16)
        yield dataclasses.replace(frame, depth_raw=depth, depth_unit_m=_MILLIMETRE)

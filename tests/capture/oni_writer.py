"""Writes .oni recordings that the OpenNI2 library plays: depth packed without loss, colour as JPEG or as it is."""

from __future__ import annotations

import dataclasses
import math
import shutil
import struct
import sys
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Literal

import numpy as np

from carpus.core.capture.camera_info import sidecar_path, write_camera_info
from carpus.core.capture.files import oni_format as oni
from carpus.core.capture.files.image_codec import encode_color
from carpus.core.capture.files.oni_format import Codec, NodeType, RecordType
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.source import PixelFormat
from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, DepthImage, Frame
from carpus.core.simulation.recording import CLICKS_FILE, simulate
from carpus.core.simulation.spec import RecordingSpec

ColorCodec = Literal["jpeg", "raw"]
DepthCodec = Literal["table", "raw"]
MAX_DEPTH = 10000
NOT_KNOWN = 0xFFFFFFFFFFFFFFFF
"""A time that is not known yet: all ones, as the library's own recorder writes it."""
_NODE_ADDED_FIELDS = struct.Struct("<I4sIQQQ")
"""After the name: node type, codec, number of images, first and last timestamp, position of the seek table."""
_DATA_BEGIN_FIELDS = struct.Struct("<IQ")
_SEEK_ENTRY = struct.Struct("<QIQ")
_FRAME_SIZE, _MAX_DEPTH = "oniRequiredFrameSize", "xnDeviceMaxDepth"
_DEPTH_FORMATS = ((1e-3, PixelFormat.DEPTH_1_MM), (1e-4, PixelFormat.DEPTH_100_UM))


@dataclasses.dataclass
class _Stream:
    """One stream while it is written."""

    node: int
    name: str
    kind: NodeType
    codec: bytes
    added_at: int = 0
    last_at: int = 0
    entries: list[tuple[int, int]] = dataclasses.field(default_factory=list)


class OniWriter:
    """Writes one recording; the file is whole only after :meth:`close`."""

    def __init__(
        self,
        path: Path,
        camera: Camera,
        *,
        color: ColorCodec = "jpeg",
        depth: DepthCodec | None = "table",
        depth_unit_m: float = 1e-3,
        mirrored: bool = False,
    ) -> None:
        formats = [code for unit_m, code in _DEPTH_FORMATS if math.isclose(unit_m, depth_unit_m)]
        self._camera = camera
        self._mirrored = mirrored
        self._streams: dict[NodeType, _Stream] = {}
        self._greatest_us = 0
        self._stream_count = 2 if depth else 1
        self._file = path.open("xb")
        self._file.write(self._header(NOT_KNOWN))
        if depth:
            codec = Codec.DEPTH_TABLE if depth == "table" else Codec.RAW
            self._add_stream("Depth", NodeType.DEPTH, codec, formats[0])
        codec = Codec.JPEG if color == "jpeg" else Codec.RAW
        self._add_stream("Image", NodeType.IMAGE, codec, PixelFormat.RGB888)
        for stream in self._streams.values():
            self._record(RecordType.NODE_READY, stream.node)
        for stream in self._streams.values():
            fields = _DATA_BEGIN_FIELDS.pack(0xFFFFFFFF, NOT_KNOWN)
            self._record(RecordType.DATA_BEGIN, stream.node, fields)

    def add_color(self, color_rgb: ByteImage, timestamp_s: float) -> None:
        """Append a colour picture (H, W, 3); times rise strictly."""
        stream = self._streams[NodeType.IMAGE]
        payload = encode_color(color_rgb) if stream.codec == Codec.JPEG else color_rgb.tobytes()
        self._picture(stream, timestamp_s, payload)

    def add_depth(self, depth_raw: DepthImage, timestamp_s: float) -> None:
        """Append a depth picture (H, W) in the unit given at the start."""
        stream = self._streams[NodeType.DEPTH]
        payload = encode_depth(depth_raw) if stream.codec == Codec.DEPTH_TABLE else depth_raw.tobytes()
        self._picture(stream, timestamp_s, payload)

    def close(self) -> None:
        """Write the tables and the end."""
        seek_at: dict[int, int] = {}
        for stream in self._streams.values():
            self._record(RecordType.NODE_REMOVED, stream.node, replaces=stream.added_at)
            if stream.entries:
                # entry 0 is never a picture; it points to the first one, where a failed search ends up
                entries = [(0, stream.entries[0][1]), *stream.entries]
                table = b"".join(_SEEK_ENTRY.pack(time_us, 0, position) for time_us, position in entries)
                seek_at[stream.node] = self._record(RecordType.SEEK_TABLE, stream.node, payload=table)
        self._record(RecordType.END, 0)
        for stream in self._streams.values():
            self._file.seek(stream.added_at)
            self._file.write(self._added(stream, seek_at.get(stream.node, 0), len(stream.entries)))
        self._file.seek(0)
        self._file.write(self._header(self._greatest_us))
        self._file.close()

    def _picture(self, stream: _Stream, timestamp_s: float, payload: bytes) -> None:
        time_us = round(timestamp_s * 1e6)
        fields = oni.NEW_DATA_FIELDS.pack(time_us, len(stream.entries) + 1)
        stream.last_at = self._record(RecordType.NEW_DATA, stream.node, fields, payload, stream.last_at)
        stream.entries.append((time_us, stream.last_at))
        self._greatest_us = max(self._greatest_us, time_us)

    def _add_stream(self, name: str, kind: NodeType, codec: bytes, pixel_format: PixelFormat) -> None:
        stream = self._streams[kind] = _Stream(len(self._streams) + 1, name, kind, codec)
        camera = self._camera
        is_depth = kind == NodeType.DEPTH
        stream.added_at = self._file.tell()
        self._file.write(self._added(stream, 0, 0xFFFFFFFF))
        mode = struct.pack("<III", camera.width_px, camera.height_px, 30)
        self._int(stream, _FRAME_SIZE, camera.width_px * camera.height_px * (2 if is_depth else 3))
        self._int(stream, "xnIsGenerating", 1)
        if is_depth:
            self._int(stream, _MAX_DEPTH, MAX_DEPTH)
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
        fields = _string(stream.name) + _NODE_ADDED_FIELDS.pack(*numbers)
        return _record_bytes(RecordType.NODE_ADDED, stream.node, fields, 0, 0)

    def _int(self, stream: _Stream, name: str, value: int) -> None:
        self._property(stream, name, struct.pack("<Q", value), RecordType.INT_PROPERTY)

    def _property(
        self, stream: _Stream, name: str, data: bytes, kind: RecordType = RecordType.GENERAL_PROPERTY
    ) -> None:
        self._record(kind, stream.node, _string(name) + struct.pack("<I", len(data)) + data)

    def _record(self, kind: RecordType, node: int, fields: bytes = b"", payload: bytes = b"", replaces: int = 0) -> int:
        position = self._file.tell()
        self._file.write(_record_bytes(kind, node, fields, len(payload), replaces))
        self._file.write(payload)
        return position


def write_oni(
    path: Path,
    frames: Iterable[Frame],
    camera: Camera,
    *,
    color: ColorCodec = "jpeg",
    simulated: bool = False,
) -> None:
    """Write ``frames``, depth in millimetres, to ``path``, and the camera beside it (``NAME.camera_info.yaml``)."""
    with closing(OniWriter(path, camera, color=color)) as writer:
        for frame in frames:
            if frame.depth_raw is not None:
                writer.add_depth(frame.depth_raw, frame.timestamp_s)
            writer.add_color(frame.color_rgb, frame.timestamp_s)
    write_camera_info(sidecar_path(path), camera, registered=True)
    if simulated:
        with sidecar_path(path).open("a") as file:
            file.write("simulated: true\n")


def _string(text: str) -> bytes:
    raw = text.encode("ascii") + b"\0"
    return struct.pack("<I", len(raw)) + raw


def _record_bytes(kind: RecordType, node: int, fields: bytes, payload_size: int, replaces: int) -> bytes:
    size = oni.RECORD_HEADER.size + len(fields)
    return oni.RECORD_HEADER.pack(oni.RECORD_MAGIC, kind, node, size, payload_size, replaces) + fields


def encode_depth(depth_raw: DepthImage) -> bytes:
    """Pack a depth picture (H, W), each pixel's index in full: :func:`oni_format.decode_depth` describes it."""
    values, index = np.unique(depth_raw, return_inverse=True)
    index = index.ravel()
    rest = np.stack((np.full(index.size - 1, 0xFF), index[1:] >> 8, index[1:] & 0xFF), axis=1)
    head = struct.pack("<H", values.size) + values.astype("<u2").tobytes() + struct.pack("<H", int(index[0]))
    return head + rest.astype(np.uint8).tobytes()


def convert_to_millimetres(frames: Iterator[Frame]) -> Iterator[Frame]:
    """The frames with their depth in whole millimetres, as the device gives it."""
    for frame in frames:
        depth = frame.depth_raw
        if depth is not None:
            depth = np.rint(depth * (frame.depth_unit_m / 1e-3)).astype(np.uint16)
        yield dataclasses.replace(frame, depth_raw=depth, depth_unit_m=1e-3)


def main() -> None:
    """Write a simulated hand of one second, with its clicks, into the folder that the command line names."""
    folder = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch:
        pictures = Path(scratch) / "tum"
        simulate(RecordingSpec(seed=3, seconds=1.0), pictures)
        source = TumFolder(pictures)
        folder.mkdir(parents=True, exist_ok=True)
        write_oni(folder / "recording.oni", convert_to_millimetres(source.frames()), source.info.camera, simulated=True)
        shutil.copy(pictures / CLICKS_FILE, folder)


if __name__ == "__main__":
    main()

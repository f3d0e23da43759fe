"""An .oni recording as a source of frames.

It is read without the OpenNI2 library, which crashes on some damaged files: first the structure of the file, then
image by image.
"""

from __future__ import annotations

import math
import struct
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import FileIO
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carpus.core.capture.camera_info import CameraInfo, read_camera_info, rescale_camera, sidecar_path
from carpus.core.capture.files import oni_format as oni
from carpus.core.capture.files.image_codec import decode_color
from carpus.core.capture.files.oni_format import Codec, NodeType, RecordType, decode_depth
from carpus.core.capture.frame_assembly import (
    DEPTH_UNIT_M,
    FILE_PAIRING_LIMIT,
    FrameAssembler,
    StreamLayout,
    camera_from_field_of_view,
)
from carpus.core.capture.source import NoticeHandler, PixelFormat, Sensor, SourceInfo, ignore_notice
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.model.types import SIMULATED, Frame

MAX_WIDTH_PX, MAX_HEIGHT_PX, MAX_FPS = 1600, 1200, 120
MAX_TIME_US = 1 << 60
HEADER_READ_BYTES = 160
"""Holds header and fields of nearly every record."""

_NODE_ADDED_RECORDS = (RecordType.NODE_ADDED, RecordType.NODE_ADDED_1_0_0_5, RecordType.NODE_ADDED_1_0_0_4)
_PROPERTY_RECORDS = (RecordType.INT_PROPERTY, RecordType.GENERAL_PROPERTY)
_CODECS = {
    NodeType.DEPTH: (Codec.RAW, Codec.DEPTH_TABLE, Codec.DEPTH_PLAIN),
    NodeType.IMAGE: (Codec.RAW, Codec.JPEG),
}
_FORMATS = {
    NodeType.DEPTH: (PixelFormat.DEPTH_1_MM, PixelFormat.DEPTH_100_UM),
    NodeType.IMAGE: (PixelFormat.RGB888,),
}
_OLD_FORMATS = {1: PixelFormat.RGB888, 2: PixelFormat.YUV422, 3: PixelFormat.GRAY8, 4: PixelFormat.GRAY16}
_CONSTANT_PROPERTIES = (oni.MAP_OUTPUT_MODE, oni.CROPPING, oni.PIXEL_FORMAT_1, oni.PIXEL_FORMAT_2, oni.MIRROR)
"""Properties that must not change once there are images."""


@dataclass(frozen=True, slots=True)
class OniStream:
    """One stream of a recording.

    ``number`` (N,) rises; ``timestamp_us`` (N,); ``position`` (N,) in the file and ``size_bytes`` (N,) of the encoded
    images.
    """

    width_px: int
    height_px: int
    fps: int
    codec: str
    pixel_format: int
    mirrored: bool
    field_of_view_rad: tuple[float, float] | None
    number: NDArray[np.int64]
    timestamp_us: NDArray[np.int64]
    position: NDArray[np.int64]
    size_bytes: NDArray[np.int64]

    def __len__(self) -> int:
        return int(self.number.shape[0])


@dataclass(frozen=True, slots=True)
class OniContents:
    """Structure of a complete recording; ``identity`` (size, time of change) shows whether the file was changed."""

    path: Path
    identity: tuple[int, int]
    version: str
    color: OniStream
    depth: OniStream | None


@dataclass(slots=True)
class _Node:
    kind: NodeType
    codec: bytes
    properties: dict[str, bytes] = field(default_factory=dict)
    images: list[tuple[int, int, int, int]] = field(default_factory=list)
    """Number, time, position and size of each."""

    def read_int(self, name: str) -> int:
        return int.from_bytes(self.properties.get(name, b""), "little")

    @property
    def pixel_format(self) -> int:
        new, old = self.read_int(oni.PIXEL_FORMAT_2), self.read_int(oni.PIXEL_FORMAT_1)
        if new or self.kind == NodeType.DEPTH:
            return new or PixelFormat.DEPTH_1_MM  # the old number is ignored
        return _OLD_FORMATS.get(old, PixelFormat.JPEG) if old else PixelFormat.RGB888


@dataclass(frozen=True, slots=True)
class _Record:
    position: int
    kind: int
    node: int
    fields: bytes
    payload_size: int


def read_file_identity(path: Path) -> tuple[int, int]:
    """Return size and time of the last change."""
    found = path.stat()
    return found.st_size, found.st_mtime_ns


def read_contents(path: Path) -> OniContents:
    """Read the structure of a complete .oni file; raises a :class:`CarpusFault` if it cannot be played."""
    if not path.is_file():
        raise errors.RecordingMissing(path)
    try:
        with FileIO(path) as file:
            return _ContentsReader(path, file).read()
    except OSError as cause:
        raise errors.RecordingUnreadable(path, cause.strerror or "") from cause


class _ContentsReader:
    """One pass over the records of a file."""

    def __init__(self, path: Path, file: FileIO) -> None:
        self._path = path
        self._file = file
        self._identity = read_file_identity(path)
        self._header = oni.RECORD_HEADER
        self._nodes: dict[int, _Node | None] = {}

    def read(self) -> OniContents:
        head = self._file.read(oni.FILE_HEADER.size)
        if len(head) < oni.FILE_HEADER.size or head[:4] != oni.FILE_MAGIC:
            raise errors.RecordingUnreadable(self._path, phrase("not an .oni file"))
        _, *version, _, _ = oni.FILE_HEADER.unpack(head)
        if not oni.OLDEST_VERSION <= tuple(version) <= oni.FILE_VERSION:
            raise errors.RecordingUnsupported(self._path, "format version " + ".".join(map(str, version)))
        if tuple(version) < oni.FILE_VERSION:
            self._header = oni.OLD_RECORD_HEADER
        for record in self._read_records():
            try:
                self._handle_record(record)
            except (struct.error, UnicodeDecodeError) as cause:
                raise self._damage_error("fields of the wrong size", record.position) from cause
        return self._build_contents(".".join(map(str, version)))

    def _damage_error(self, what: str, position: int) -> CarpusFault:
        return errors.RecordingDamaged(self._path, phrase("{what}, at byte {position}", what=what, position=position))

    def _read_records(self) -> Iterator[_Record]:
        """Yield all records up to END; raises if the chain breaks."""
        position, header = oni.FILE_HEADER.size, self._header
        while True:
            self._file.seek(position)
            read = self._file.read(HEADER_READ_BYTES)
            if len(read) < header.size:
                raise self._damage_error("the recording was not finished", position)
            magic, kind, node, fields_size, payload_size, _ = header.unpack_from(read)
            if magic != oni.RECORD_MAGIC:
                raise self._damage_error("the chain of records is broken", position)
            if kind == RecordType.END:
                return
            if kind not in RecordType._value2member_map_:
                raise self._damage_error(f"unknown record {kind}", position)
            if fields_size < header.size:
                raise self._damage_error(f"record fields of {fields_size} bytes", position)
            if position + fields_size + payload_size > self._identity[0]:
                raise self._damage_error("the recording was not finished", position)
            if payload_size and kind not in (RecordType.NEW_DATA, RecordType.SEEK_TABLE):
                raise self._damage_error("payload where none belongs", position)
            if fields_size > len(read):
                read += self._file.read(fields_size - len(read))
            yield _Record(position, kind, node, read[header.size : fields_size], payload_size)
            position += fields_size + payload_size

    def _handle_record(self, record: _Record) -> None:
        if record.kind in _NODE_ADDED_RECORDS:
            self._add_node(record)
            return
        if record.node not in self._nodes:
            raise self._damage_error("record of an unknown stream", record.position)
        node = self._nodes[record.node]
        if node is None:
            return
        if record.kind in _PROPERTY_RECORDS:
            self._set_property(node, record)
        elif record.kind == RecordType.NEW_DATA:
            self._index_image(node, record)

    def _read_text(self, record: _Record) -> tuple[str, int]:
        """Return the text at the start of the fields, and the offset behind it."""
        (size,) = struct.unpack_from("<I", record.fields)
        raw = record.fields[4 : 4 + size]
        if len(raw) != size or raw[-1:] != b"\0":
            raise self._damage_error("bad name", record.position)
        return raw[:-1].decode("ascii"), 4 + size

    def _add_node(self, record: _Record) -> None:
        _, offset = self._read_text(record)
        kind, codec = struct.unpack_from("<I4s", record.fields, offset)
        if record.node in self._nodes:
            raise self._damage_error("two streams of one name", record.position)
        if kind in _CODECS and codec not in _CODECS[kind]:
            shown = codec.decode("ascii", "replace")
            detail = phrase("codec {codec} for {name}", codec=shown, name=NodeType(kind).name)
            raise errors.RecordingUnsupported(self._path, detail)
        self._nodes[record.node] = _Node(NodeType(kind), codec) if kind in _CODECS else None

    def _set_property(self, node: _Node, record: _Record) -> None:
        name, offset = self._read_text(record)
        (size,) = struct.unpack_from("<I", record.fields, offset)
        data = record.fields[offset + 4 : offset + 4 + size]
        if len(data) != size:
            raise self._damage_error(f"property {name} of the wrong size", record.position)
        if node.images and name in _CONSTANT_PROPERTIES and node.properties.get(name) != data:
            raise errors.RecordingUnsupported(self._path, phrase("{name} changes within the file", name=name))
        node.properties[name] = data

    def _index_image(self, node: _Node, record: _Record) -> None:
        time_us, number = oni.NEW_DATA_FIELDS.unpack(record.fields)
        last_number, last_us = node.images[-1][:2] if node.images else (0, -1)
        if number <= last_number:
            raise self._damage_error(f"picture number {number}", record.position)
        if time_us > MAX_TIME_US:
            raise self._damage_error("a picture later than the recording's end", record.position)
        if time_us <= last_us:
            detail = phrase("{value} frame {number}", value=node.kind.name.lower(), number=number)
            raise errors.TimesUnordered(self._path, detail)
        position = record.position + self._header.size + len(record.fields)
        node.images.append((number, time_us, position, record.payload_size))

    def _build_contents(self, version: str) -> OniContents:
        images, depths = (
            [node for node in self._nodes.values() if node is not None and node.kind == kind]
            for kind in (NodeType.IMAGE, NodeType.DEPTH)
        )
        if not images:
            raise errors.RecordingUnsupported(self._path, phrase("no colour frames"))
        if len(images) > 1 or len(depths) > 1:
            raise errors.RecordingUnsupported(self._path, phrase("more than one camera"))
        if not images[0].images:
            raise errors.RecordingEmpty(self._path)
        try:
            color = self._build_stream(images[0])
            depth = self._build_stream(depths[0]) if depths and depths[0].images else None
        except struct.error as cause:
            raise self._damage_error("fields of the wrong size", oni.FILE_HEADER.size) from cause
        return OniContents(self._path, self._identity, version, color, depth)

    def _build_stream(self, node: _Node) -> OniStream:
        properties, pixel_format = node.properties, node.pixel_format
        width, height, fps = struct.unpack("<III", properties.get(oni.MAP_OUTPUT_MODE, bytes(12)))
        if not (1 <= width <= MAX_WIDTH_PX and 1 <= height <= MAX_HEIGHT_PX and 1 <= fps <= MAX_FPS):
            raise self._damage_error(f"frames of {width}x{height} at {fps} fps", oni.FILE_HEADER.size)
        if any(properties.get(oni.CROPPING, b"")[:4]):
            raise errors.RecordingUnsupported(self._path, phrase("cropped frames"))
        if pixel_format not in _FORMATS[node.kind]:
            name = next((each.name for each in PixelFormat if each == pixel_format), str(pixel_format))
            as_color, as_depth = phrase("colour as {name}", name=name), phrase("depth as {name}", name=name)
            raise errors.RecordingUnsupported(self._path, as_depth if node.kind == NodeType.DEPTH else as_color)
        view: tuple[float, float] | None = None
        if oni.FIELD_OF_VIEW in properties:
            across, down = struct.unpack("<dd", properties[oni.FIELD_OF_VIEW])
            view = (across, down) if 0.0 < across < math.pi and 0.0 < down < math.pi else None
        mirrored = any(properties.get(oni.MIRROR, b""))
        columns = np.array(node.images, np.int64).T
        return OniStream(width, height, fps, node.codec.decode("ascii"), pixel_format, mirrored, view, *columns)


class OniSource:
    """Frames of an .oni file, in order, as fast as they are read.

    The structure is read at once; :meth:`frames` may be repeated, one pass at a time. ``registered`` states whether
    depth is registered, for a file without a sidecar; None assumes so and notifies :class:`RegistrationAssumed`.
    Damaged images are skipped and notified at the end (:class:`DamagedFramesExcluded`).
    """

    def __init__(self, path: Path, *, registered: bool | None = None, notice: NoticeHandler = ignore_notice) -> None:
        self._contents = read_contents(path)
        self._path = path
        self._notice = notice
        self._current_pass: object = None
        self._is_closed = False
        self._streams = {Sensor.COLOR: self._contents.color}
        if self._contents.depth is not None:
            self._streams[Sensor.DEPTH] = self._contents.depth
        sidecar = sidecar_path(path)
        camera_info = read_camera_info(sidecar) if sidecar.exists() else None
        self._layout = _build_layout(self._contents, camera_info)
        times_us = self._contents.color.timestamp_us
        self._period_us = float(np.median(np.diff(times_us))) if len(times_us) > 1 else 1e6 / self._contents.color.fps
        self.info = self._build_info(camera_info, registered)

    def frames(self) -> Iterator[Frame]:
        """Yield all frames from the first on; a pass in progress ends when another begins."""
        walk = self._current_pass = object()
        assembler = FrameAssembler(self._layout, self._period_us, FILE_PAIRING_LIMIT)
        arrived: Counter[Sensor] = Counter()
        try:
            with self._path.open("rb") as file:
                if read_file_identity(self._path) != self._contents.identity:
                    raise errors.RecordingDamaged(self._path, phrase("the file changes while it is read"))
                # stream and index of each image in the order of the file
                places = [
                    (position, sensor, place)
                    for sensor, stream in self._streams.items()
                    for place, position in enumerate(stream.position.tolist())
                ]
                for sensor, place in [(sensor, place) for _, sensor, place in sorted(places)]:
                    if self._is_closed or self._current_pass is not walk:
                        return
                    stream = self._streams[sensor]
                    picture = self._read_image(file, stream, place)
                    if picture is not None:
                        arrived[sensor] += 1
                        time_us, number = int(stream.timestamp_us[place]), int(stream.number[place])
                        yield from assembler.add(sensor, time_us, number, picture)
        except OSError as cause:
            raise errors.RecordingDamaged(self._path, cause.strerror or phrase("cannot be opened")) from cause
        yield from assembler.finish()
        names = {Sensor.COLOR: "colour", Sensor.DEPTH: "depth"}
        counts = [
            f"{len(stream) - arrived[sensor]} of {len(stream)} {names[sensor]}"
            for sensor, stream in self._streams.items()
            if arrived[sensor] < len(stream)
        ]
        if counts:
            self._notice(errors.DamagedFramesExcluded(self._path, ", ".join(counts)))

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._is_closed = True

    def _read_image(self, file: BinaryIO, stream: OniStream, place: int) -> NDArray[Any] | None:
        """Return one image, (H, W, 3) uint8 or (H, W) uint16; None if it is damaged."""
        size = int(stream.size_bytes[place])
        file.seek(int(stream.position[place]))
        data = file.read(size)
        if len(data) < size:
            raise errors.RecordingDamaged(self._path, phrase("the file changes while it is read"))
        shape = (stream.height_px, stream.width_px)
        if stream is self._contents.depth:
            return decode_depth(data, stream.codec.encode(), shape)
        if stream.codec.encode() == Codec.JPEG:
            picture = decode_color(data)
            return picture if picture is not None and picture.shape == (*shape, 3) else None
        return np.frombuffer(data, np.uint8).reshape((*shape, 3)) if size == 3 * shape[0] * shape[1] else None

    def _build_info(self, camera_info: CameraInfo | None, answer: bool | None) -> SourceInfo:
        contents, layout = self._contents, self._layout
        view = contents.color.field_of_view_rad or (contents.depth.field_of_view_rad if contents.depth else None)
        if camera_info:
            camera = rescale_camera(camera_info.camera, layout.size_px)
        else:
            camera = camera_from_field_of_view(layout.size_px, view)
        if camera is None:
            size = "{}x{}".format(*layout.size_px)
            if camera_info:
                wanted = f"{camera_info.camera.width_px}x{camera_info.camera.height_px}"
                detail = f"for pictures of {wanted}, these are {size}"
                raise errors.CameraFileUnreadable(sidecar_path(self._path), detail)
            raise errors.RecordingUnsupported(self._path, phrase("no intrinsics for frames of {size}", size=size))
        settings = {"format": f".oni {contents.version}", "color": _format_stream(contents.color)}
        if contents.depth is not None:
            settings["depth"] = _format_stream(contents.depth)
            settings["registered"] = self._resolve_registration(camera_info.registered if camera_info else None, answer)
        settings["mirrored"] = "turned back" if layout.color_mirrored else "no"
        if layout.format_enlargement:
            settings["enlarged"] = layout.format_enlargement
            self._notice(errors.FramesEnlarged(self._path, layout.format_enlargement))
        if camera_info is not None and camera_info.simulated:
            settings[SIMULATED] = "yes"
        has_depth, count = contents.depth is not None, len(contents.color)
        return SourceInfo(self._path.name, camera, has_depth, count, float(contents.color.fps), settings)

    def _resolve_registration(self, camera_info: bool | None, answer: bool | None) -> str:
        registered = camera_info if camera_info is not None else answer
        if registered is None:
            self._notice(errors.RegistrationAssumed(self._path))
            return "assumed"
        if not registered:
            self._notice(errors.DepthNotRegistered(self._path))
        return "yes" if registered else "no"


def _build_layout(contents: OniContents, camera_info: CameraInfo | None) -> StreamLayout:
    color, depth = contents.color, contents.depth
    mirrored = camera_info.mirrored if camera_info else None
    layout = StreamLayout(
        (color.width_px, color.height_px),
        (depth.width_px, depth.height_px) if depth else None,
        color.mirrored if mirrored is None else mirrored,
        (depth.mirrored if depth else False) if mirrored is None else mirrored,
        DEPTH_UNIT_M[depth.pixel_format] if depth else 1e-3,
    )
    if layout.describe_size_mismatch():
        raise errors.RecordingUnsupported(contents.path, layout.describe_size_mismatch())
    return layout


def _format_stream(stream: OniStream) -> str:
    return f"{stream.width_px}x{stream.height_px} {stream.codec} {stream.fps} fps"

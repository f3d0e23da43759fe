"""Reads the structure of an .oni file and refuses what the OpenNI2 library would die or hang on.

The library trusts its files: a wrong size overruns its buffers, pictures before their codec is ready or a name
outside ASCII end the process, and a file without its ``END`` record never ends. Everything it relies on is
verified here first. Damage inside a picture's own bytes is not looked for: the library survives that, and the
source counts what is lost.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import FileIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carpus.core.capture import oni_format as oni
from carpus.core.capture.oni_format import Codec, NodeType, RecordType
from carpus.core.capture.video_mode import PixelFormat
from carpus.core.errors import (
    CarpusFault,
    RecordingDamaged,
    RecordingEmpty,
    RecordingMissing,
    RecordingUnreadable,
    RecordingUnsupported,
    TimesUnordered,
)
from carpus.core.phrase import phrase

MAX_NODES = 16
MAX_FIELDS_SIZE = 1 << 20
MAX_WIDTH_PX, MAX_HEIGHT_PX, MAX_FPS = 1600, 1200, 120
MAX_FRAME_SIZE = 16 << 20
MAX_TIME_US = 1 << 60
FIRST_READ = 160
"""Holds the header and fields of nearly every record."""

_ADDED = (RecordType.NODE_ADDED, RecordType.NODE_ADDED_1_0_0_5, RecordType.NODE_ADDED_1_0_0_4)
_PROPERTIES = (
    RecordType.INT_PROPERTY,
    RecordType.REAL_PROPERTY,
    RecordType.STRING_PROPERTY,
    RecordType.GENERAL_PROPERTY,
)
_CODECS = {
    NodeType.DEPTH: (Codec.RAW, Codec.DEPTH_TABLE, Codec.DEPTH_PLAIN),
    NodeType.IMAGE: (Codec.RAW, Codec.JPEG),
    NodeType.IR: (Codec.RAW, Codec.DEPTH_TABLE, Codec.DEPTH_PLAIN, Codec.JPEG),
}
_BYTES_PER_PIXEL = {
    PixelFormat.DEPTH_1_MM: 2,
    PixelFormat.DEPTH_100_UM: 2,
    PixelFormat.RGB888: 3,
    PixelFormat.YUV422: 2,
    PixelFormat.GRAY8: 1,
    PixelFormat.GRAY16: 2,
    PixelFormat.JPEG: 1,
    PixelFormat.YUYV: 2,
}
_OLD_FORMATS = {1: PixelFormat.RGB888, 2: PixelFormat.YUV422, 3: PixelFormat.GRAY8, 4: PixelFormat.GRAY16}
_GENERAL_SIZES = {oni.MAP_OUTPUT_MODE: 12, oni.CROPPING: 12, oni.FIELD_OF_VIEW: 16, oni.REAL_WORLD: 24}
_FIXED = (oni.MAP_OUTPUT_MODE, oni.CROPPING, oni.PIXEL_FORMAT_1, oni.PIXEL_FORMAT_2, oni.FRAME_SIZE, oni.MIRROR)
"""Properties that must not change once pictures come."""


@dataclass(frozen=True, slots=True)
class OniStream:
    """One stream of a recording.

    ``number`` (N,) as the library will report them, ``timestamp_us`` (N,); ``position`` (N,) in the file and
    ``size_bytes`` (N,) of the coded pictures.
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

    @property
    def frame_bytes(self) -> int:
        """Bytes of one decoded picture."""
        return self.width_px * self.height_px * _BYTES_PER_PIXEL[PixelFormat(self.pixel_format)]


@dataclass(frozen=True, slots=True)
class OniContents:
    """What a sound recording holds. ``identity`` (size, time of change) tells whether the file is still the same."""

    path: Path
    identity: tuple[int, int]
    version: str
    color: OniStream
    depth: OniStream | None


@dataclass(slots=True)
class _Node:
    name: str
    kind: int
    codec: bytes
    frames: int | None
    seek_position: int
    properties: dict[str, bytes] = field(default_factory=dict)
    pixel_format: int = 0
    ready: bool = False
    removed: bool = False
    numbers: list[int] = field(default_factory=list)
    times_us: list[int] = field(default_factory=list)
    positions: list[int] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)

    @property
    def has_pictures(self) -> bool:
        return self.kind in _CODECS


@dataclass(frozen=True, slots=True)
class _Record:
    position: int
    kind: RecordType
    node: int
    fields: bytes
    payload_size: int


def check_recording(path: Path) -> OniContents:
    """The contents of an .oni file that the library can play to its end.

    Raises :class:`RecordingMissing`, :class:`RecordingUnreadable`, :class:`RecordingDamaged`,
    :class:`RecordingUnsupported`, :class:`RecordingEmpty` or :class:`TimesUnordered`.
    """
    if not path.is_file():
        raise RecordingMissing(path)
    try:
        with FileIO(path) as file:
            return _Walk(path, file).contents()
    except OSError as cause:
        raise RecordingUnreadable(path, cause.strerror or "") from cause


class _Walk:
    """One pass over the records of a file."""

    def __init__(self, path: Path, file: FileIO) -> None:
        self._path = path
        self._file = file
        self._size = path.stat().st_size
        self._identity = (self._size, path.stat().st_mtime_ns)
        self._nodes: dict[int, _Node] = {}
        self._seek_tables: dict[int, tuple[int, int]] = {}
        self._begun = False
        self._has_pictures = False

    def contents(self) -> OniContents:
        head = self._file.read(oni.FILE_HEADER.size)
        if len(head) < oni.FILE_HEADER.size or head[:4] != oni.FILE_MAGIC:
            raise RecordingUnreadable(self._path, phrase("not an .oni file"))
        _, *version, self._greatest_us, self._max_node = oni.FILE_HEADER.unpack(head)
        if not oni.OLDEST_VERSION <= tuple(version) <= oni.FILE_VERSION:
            raise RecordingUnsupported(self._path, "format version " + ".".join(map(str, version)))
        if not 1 <= self._max_node <= MAX_NODES:
            raise self._damaged(f"{self._max_node} streams", 0)
        self._is_old = tuple(version) < oni.FILE_VERSION
        for record in self._records():
            try:
                self._take(record)
            except (struct.error, UnicodeDecodeError, IndexError) as cause:
                raise self._damaged("fields of the wrong size", record.position) from cause
        self._verify_seek_tables()
        return self._result(".".join(map(str, version)))

    def _damaged(self, what: str, position: int) -> CarpusFault:
        return RecordingDamaged(self._path, phrase("{what}, at byte {position}", what=what, position=position))

    def _records(self) -> Iterator[_Record]:
        """All records up to END; raises when the chain breaks."""
        header = oni.OLD_RECORD_HEADER if self._is_old else oni.RECORD_HEADER
        position = oni.FILE_HEADER.size
        while True:
            self._file.seek(position)
            read = self._file.read(FIRST_READ)
            if len(read) < header.size:
                raise self._damaged("the recording was not finished", position)
            magic, kind, node, fields_size, payload_size, _ = header.unpack_from(read)
            if magic != oni.RECORD_MAGIC:
                raise self._damaged("the chain of records is broken", position)
            if kind == RecordType.END:
                return
            if kind not in RecordType._value2member_map_:
                raise self._damaged(f"unknown record {kind}", position)
            if not header.size <= fields_size <= MAX_FIELDS_SIZE:
                raise self._damaged(f"record fields of {fields_size} bytes", position)
            if fields_size + payload_size > oni.MAX_RECORD_SIZE:
                raise self._damaged(f"record of {fields_size + payload_size} bytes", position)
            if position + fields_size + payload_size > self._size:
                raise self._damaged("the recording was not finished", position)
            if payload_size and kind not in (RecordType.NEW_DATA, RecordType.SEEK_TABLE):
                raise self._damaged("payload where none belongs", position)
            if node > self._max_node:
                raise self._damaged(f"stream {node} of {self._max_node}", position)
            if fields_size > len(read):
                read += self._file.read(fields_size - len(read))
            yield _Record(position, RecordType(kind), node, read[header.size : fields_size], payload_size)
            position += fields_size + payload_size

    def _take(self, record: _Record) -> None:
        if record.kind in _ADDED:
            self._add(record)
            return
        node = self._nodes.get(record.node)
        if node is None or (node.removed and record.kind != RecordType.SEEK_TABLE):
            raise self._damaged("record of an unknown stream", record.position)
        if record.kind in _PROPERTIES:
            self._property(node, record)
        elif record.kind == RecordType.NODE_READY:
            self._ready(node, record)
        elif record.kind == RecordType.DATA_BEGIN:
            self._begin(node, record)
        elif record.kind == RecordType.NEW_DATA:
            self._picture(node, record)
        elif record.kind == RecordType.NODE_REMOVED:
            node.removed = True
        elif record.kind == RecordType.SEEK_TABLE:
            self._seek_tables[record.position] = (record.node, record.payload_size)

    def _text(self, record: _Record, offset: int, limit: int) -> tuple[str, int]:
        """A string field and the offset behind it. The library hashes text by signed characters: ASCII only."""
        (size,) = struct.unpack_from("<I", record.fields, offset)
        raw = record.fields[offset + 4 : offset + 4 + size]
        if not 2 <= size <= limit or len(raw) != size or raw[-1] or 0 in raw[:-1] or not raw.isascii():
            raise self._damaged("bad name", record.position)
        return raw[:-1].decode("ascii"), offset + 4 + size

    def _add(self, record: _Record) -> None:
        name, offset = self._text(record, 0, oni.MAX_NAME_SIZE)
        kind, codec = struct.unpack_from("<I4s", record.fields, offset)
        frames: int | None = None
        seek_position = 0
        if record.kind != RecordType.NODE_ADDED_1_0_0_4:
            (frames,) = struct.unpack_from("<I", record.fields, offset + 8)
            struct.unpack_from("<QQ", record.fields, offset + 12)
        if record.kind == RecordType.NODE_ADDED:
            (seek_position,) = struct.unpack_from("<I" if self._is_old else "<Q", record.fields, offset + 28)
        node = _Node(name, kind, codec, frames, seek_position)
        if record.node in self._nodes or any(name == other.name for other in self._nodes.values()):
            raise self._damaged("two streams of one name", record.position)
        if node.has_pictures and codec not in _CODECS[NodeType(kind)]:
            raise RecordingUnsupported(
                self._path,
                phrase("codec {codec} for {name}", codec=codec.decode("ascii", "replace"), name=NodeType(kind).name),
            )
        if self._has_pictures:
            raise self._damaged("a stream that begins late", record.position)
        self._nodes[record.node] = node

    def _property(self, node: _Node, record: _Record) -> None:
        name, offset = self._text(record, 0, MAX_FIELDS_SIZE)
        (size,) = struct.unpack_from("<I", record.fields, offset)
        data = record.fields[offset + 4 : offset + 4 + size]
        whole = len(data) == size
        if record.kind in (RecordType.INT_PROPERTY, RecordType.REAL_PROPERTY):
            whole = whole and size == 8
        elif record.kind == RecordType.STRING_PROPERTY:
            whole = whole and size > 0 and data[-1] == 0
        elif name in _GENERAL_SIZES:
            whole = whole and size == _GENERAL_SIZES[name]
        if not whole:
            raise self._damaged(f"property {name} of the wrong size", record.position)
        if self._has_pictures and name in _FIXED and node.properties.get(name) != data:
            raise RecordingUnsupported(self._path, phrase("{name} changes on the way", name=name))
        node.properties[name] = data
        if name == oni.PIXEL_FORMAT_2:
            node.pixel_format = int.from_bytes(data, "little")
        elif name == oni.PIXEL_FORMAT_1:
            # the library takes depth for millimetres here, whatever the number says
            old = int.from_bytes(data, "little")
            if old not in (1, 2, 3, 4, 5):
                raise self._damaged(f"pixel format {old}", record.position)
            node.pixel_format = (
                PixelFormat.DEPTH_1_MM if node.kind == NodeType.DEPTH else _OLD_FORMATS.get(old, PixelFormat.JPEG)
            )

    def _ready(self, node: _Node, record: _Record) -> None:
        node.ready = True
        if not node.has_pictures:
            return
        width, height, fps = self._mode(node)
        if not (1 <= width <= MAX_WIDTH_PX and 1 <= height <= MAX_HEIGHT_PX and 1 <= fps <= MAX_FPS):
            raise self._damaged(f"pictures of {width}x{height} at {fps} fps", record.position)
        if oni.CROPPING not in node.properties:
            raise self._damaged("no cropping property, so that no picture would come", record.position)
        if any(node.properties[oni.CROPPING][:4]):
            raise RecordingUnsupported(self._path, phrase("cropped pictures"))
        if node.codec == Codec.DEPTH_TABLE and oni.MAX_DEPTH not in node.properties:
            raise self._damaged("no greatest depth", record.position)
        if not node.pixel_format:
            node.pixel_format = {
                NodeType.DEPTH: PixelFormat.DEPTH_1_MM,
                NodeType.IMAGE: PixelFormat.RGB888,
                NodeType.IR: PixelFormat.GRAY16,
            }[NodeType(node.kind)]
        if node.pixel_format not in _BYTES_PER_PIXEL:
            raise RecordingUnsupported(
                self._path, phrase("pixel format {pixel_format}", pixel_format=node.pixel_format)
            )
        needed = width * height * _BYTES_PER_PIXEL[PixelFormat(node.pixel_format)]
        for name in (oni.FRAME_SIZE, oni.OLD_FRAME_SIZE):
            told = int.from_bytes(node.properties.get(name, b""), "little")
            if told and not needed <= told <= MAX_FRAME_SIZE:
                raise self._damaged(f"pictures of {told} bytes, {needed} expected", record.position)

    def _mode(self, node: _Node) -> tuple[int, int, int]:
        width, height, fps = struct.unpack("<III", node.properties.get(oni.MAP_OUTPUT_MODE, bytes(12)))
        return width, height, fps

    def _begin(self, node: _Node, record: _Record) -> None:
        frames, _ = oni.DATA_BEGIN_FIELDS.unpack_from(record.fields)
        if node.frames is None:
            node.frames = frames
        if not node.has_pictures:
            raise self._damaged("pictures of a node that has none", record.position)
        self._begun = True

    def _picture(self, node: _Node, record: _Record) -> None:
        # until each node is ready the library reads on and on, over pictures too; some have no codec yet
        if not (node.has_pictures and self._begun and all(each.ready for each in self._nodes.values())):
            raise self._damaged("pictures before all streams are ready", record.position)
        self._has_pictures = True
        if len(record.fields) != oni.NEW_DATA_FIELDS.size:
            raise self._damaged("fields of the wrong size", record.position)
        time_us, number = oni.NEW_DATA_FIELDS.unpack(record.fields)
        if time_us > min(self._greatest_us, MAX_TIME_US):
            raise self._damaged("a picture later than the recording's end", record.position)
        if number > (node.frames or 0) or number <= (node.numbers[-1] if node.numbers else 0):
            raise self._damaged(f"picture number {number}", record.position)
        if node.times_us and time_us <= node.times_us[-1] and node.kind != NodeType.IR:
            raise TimesUnordered(
                self._path, phrase("{value} picture {number}", value=NodeType(node.kind).name.lower(), number=number)
            )
        node.numbers.append(number)
        node.times_us.append(time_us)
        header = oni.OLD_RECORD_HEADER if self._is_old else oni.RECORD_HEADER
        node.positions.append(record.position + header.size + len(record.fields))
        node.sizes.append(record.payload_size)

    def _verify_seek_tables(self) -> None:
        """The library follows each seek table blindly while it opens the file."""
        entry = oni.OLD_SEEK_ENTRY_SIZE if self._is_old else oni.SEEK_ENTRY.size
        for identity, node in self._nodes.items():
            if node.frames and node.seek_position:
                wanted = (identity, (node.frames + 1) * entry)
                if self._seek_tables.get(node.seek_position) != wanted:
                    raise self._damaged("the seek table is not where it should be", node.seek_position)

    def _result(self, version: str) -> OniContents:
        images = [node for node in self._nodes.values() if node.kind == NodeType.IMAGE]
        depths = [node for node in self._nodes.values() if node.kind == NodeType.DEPTH]
        if not images:
            raise RecordingUnsupported(self._path, phrase("no colour pictures"))
        if len(images) > 1 or len(depths) > 1:
            raise RecordingUnsupported(self._path, phrase("more than one camera"))
        if not images[0].numbers:
            raise RecordingEmpty(self._path)
        if images[0].pixel_format != PixelFormat.RGB888:
            raise RecordingUnsupported(
                self._path, phrase("colour as {name}", name=PixelFormat(images[0].pixel_format).name)
            )
        depth = depths[0] if depths and depths[0].numbers else None
        if depth is not None and depth.pixel_format not in (PixelFormat.DEPTH_1_MM, PixelFormat.DEPTH_100_UM):
            raise RecordingUnsupported(self._path, phrase("depth as {name}", name=PixelFormat(depth.pixel_format).name))
        color_stream = self._stream(images[0])
        return OniContents(self._path, self._identity, version, color_stream, self._stream(depth) if depth else None)

    def _stream(self, node: _Node) -> OniStream:
        view: tuple[float, float] | None = None
        if oni.FIELD_OF_VIEW in node.properties:
            across, down = struct.unpack("<dd", node.properties[oni.FIELD_OF_VIEW])
            view = (across, down) if 0.0 < across < math.pi and 0.0 < down < math.pi else None
        mirrored = any(node.properties.get(oni.MIRROR, b""))
        columns = (np.array(each, np.int64) for each in (node.numbers, node.times_us, node.positions, node.sizes))
        codec = node.codec.decode("ascii")
        return OniStream(*self._mode(node), codec, node.pixel_format, mirrored, view, *columns)

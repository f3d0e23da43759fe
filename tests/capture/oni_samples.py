"""Small recordings with pictures that tell which one they are, and the means to look inside and damage them."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from carpus.core.capture.files.oni_format import RecordType
from carpus.core.model.camera import Camera
from carpus.core.model.types import ByteImage, DepthImage
from tests.capture.oni_writer import ColorCodec, DepthCodec, OniWriter

WIDTH, HEIGHT = 64, 48
CAMERA = Camera(52.5, 52.5, 31.5, 23.5, WIDTH, HEIGHT)
PERIOD_S = 1.0 / 30.0
START_S = 0.010
DEPTH_LATE_S = 0.003


def color_picture(number: int) -> ByteImage:
    """Not the same left for right, and different for each number."""
    rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH]
    picture = np.stack([columns * 255 // WIDTH, rows * 255 // HEIGHT, (columns + rows) % 256], -1).astype(np.uint8)
    picture[:8, :8] = (37 * number + 11) % 256
    return picture


def depth_picture(number: int) -> DepthImage:
    """Noise, steps, holes; the first pixel holds the number."""
    rng = np.random.default_rng(number)
    rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH]
    picture = (600 + columns + 2 * rows + rng.integers(0, 4, (HEIGHT, WIDTH))).astype(np.uint16)
    picture[HEIGHT // 4 : HEIGHT // 2] = 2500
    picture[rng.random((HEIGHT, WIDTH)) < 0.03] = 0
    picture[0, 0] = 5000 + number
    return picture


def write_sample(
    path: Path,
    count: int = 6,
    *,
    color: ColorCodec = "raw",
    depth: DepthCodec | None = "table",
    depth_unit_m: float = 1e-3,
    mirrored: bool = False,
) -> Path:
    """A recording of ``count`` colour and depth pictures; depth comes 3 ms late."""
    writer = OniWriter(path, CAMERA, color=color, depth=depth, depth_unit_m=depth_unit_m, mirrored=mirrored)
    side = -1 if mirrored else 1
    with closing(writer):
        for number in range(1, count + 1):
            time_s = START_S + (number - 1) * PERIOD_S
            writer.add_color(np.ascontiguousarray(color_picture(number)[:, ::side]), time_s)
            if depth:
                writer.add_depth(np.ascontiguousarray(depth_picture(number)[:, ::side]), time_s + DEPTH_LATE_S)
    return path


@dataclass(frozen=True)
class Record:
    """A record of a file: where it is, what it is, where its payload is."""

    position: int
    kind: RecordType
    node: int
    fields_size: int
    payload_size: int

    @property
    def payload(self) -> slice:
        start = self.position + self.fields_size
        return slice(start, start + self.payload_size)


def records(data: bytes) -> Iterator[Record]:
    """All records of a sound file, by a reader of its own."""
    position = 24
    while True:
        magic, kind, node, fields_size, payload_size = struct.unpack_from("<IIIII", data, position)
        assert magic == 0x0052494E
        yield Record(position, RecordType(kind), node, fields_size, payload_size)
        if kind == RecordType.END:
            return
        position += fields_size + payload_size


def find(data: bytes, kind: RecordType, occurrence: int = 0, node: int | None = None) -> Record:
    """The n-th record of a kind."""
    found = [record for record in records(data) if record.kind == kind and node in (None, record.node)]
    return found[occurrence]


def patch_bytes(data: bytes, position: int, new: bytes) -> bytes:
    """``data`` with some bytes replaced."""
    return data[:position] + new + data[position + len(new) :]


Change = Callable[[Record, bytes, bytes], tuple[bytes, bytes]]


def rebuilt(data: bytes, change: Change) -> bytes:
    """A file written anew, record by record; ``change`` gives the fields and payload of each. Without seek tables."""
    out = bytearray(data[:24])
    for record in records(data):
        if record.kind == RecordType.SEEK_TABLE:
            continue
        fields = data[record.position + 28 : record.position + record.fields_size]
        payload = data[record.payload]
        if record.kind == RecordType.NODE_ADDED:
            fields = fields[:-8] + bytes(8)
        fields, payload = change(record, fields, payload)
        size = 28 + len(fields)
        out += struct.pack("<IIIIIQ", 0x0052494E, record.kind, record.node, size, len(payload), 0) + fields + payload
    return bytes(out)


def with_size(data: bytes, node: int, width: int, height: int) -> bytes:
    """The same recording with the upper left part of every picture of a stream."""

    def change(record: Record, fields: bytes, payload: bytes) -> tuple[bytes, bytes]:
        if record.node == node and b"xnMapOutputMode\0" in fields:
            fields = fields[:-12] + struct.pack("<III", width, height, 30)
        if record.node == node == 2 and record.kind == RecordType.NEW_DATA:
            payload = np.frombuffer(payload, np.uint8).reshape(HEIGHT, WIDTH, 3)[:height, :width].tobytes()
        return fields, payload

    return rebuilt(data, change)

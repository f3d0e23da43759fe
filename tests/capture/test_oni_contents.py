"""What a file holds: a sound one its streams, a damaged or other one what is wrong with it."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.files import oni_format as oni
from carpus.core.capture.files.oni_format import NodeType, RecordType
from carpus.core.capture.files.oni_source import read_contents
from carpus.core.capture.source import PixelFormat
from carpus.core.model.errors import (
    CarpusFault,
    RecordingDamaged,
    RecordingMissing,
    RecordingUnreadable,
    RecordingUnsupported,
    TimesUnordered,
)
from tests.capture.oni_samples import CAMERA, HEIGHT, WIDTH, find, patch_bytes, records, write_sample

DEPTH_NODE, IMAGE_NODE = 1, 2


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return write_sample(tmp_path_factory.mktemp("oni") / "sound.oni", color="jpeg").read_bytes()


def check(tmp_path: Path, data: bytes) -> CarpusFault | None:
    """The fault of a file with these bytes."""
    path = tmp_path / "file.oni"
    path.write_bytes(data)
    try:
        read_contents(path)
    except CarpusFault as fault:
        return fault
    return None


def test_oni_contents_complete_file_is_read(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 5, color="jpeg", depth_unit_m=1e-4, mirrored=True)
    found = read_contents(path)
    assert found.depth is not None
    for stream in (found.color, found.depth):
        assert (stream.width_px, stream.height_px, stream.fps) == (WIDTH, HEIGHT, 30)
        assert stream.mirrored
        assert stream.number.tolist() == [1, 2, 3, 4, 5]
    assert found.color.timestamp_us.tolist() == [10000, 43333, 76667, 110000, 143333]
    assert found.depth.timestamp_us.tolist() == [13000, 46333, 79667, 113000, 146333]
    assert (found.color.codec, found.depth.codec) == ("JPEG", "16zT")
    assert (found.color.pixel_format, found.depth.pixel_format) == (PixelFormat.RGB888, PixelFormat.DEPTH_100_UM)
    assert found.color.field_of_view_rad == pytest.approx(
        (2 * np.arctan(32 / CAMERA.fx_px), 2 * np.arctan(24 / CAMERA.fy_px))
    )
    assert found.version == "1.0.1.0"


def test_oni_contents_other_file_or_folder_raises(tmp_path: Path) -> None:
    for path in (tmp_path / "none.oni", tmp_path):
        with pytest.raises(RecordingMissing):
            read_contents(path)
    for data in (b"", b"NI10" + bytes(19), b"RIFF" + bytes(200)):
        assert isinstance(check(tmp_path, data), RecordingUnreadable)


Damage = Callable[[bytes], bytes]


def patch_record(kind: RecordType, offset: int, new: bytes, occurrence: int = 0, node: int | None = None) -> Damage:
    """Replace bytes ``offset`` after the start of a record."""
    return lambda data: patch_bytes(data, find(data, kind, occurrence, node).position + offset, new)


def cut_before(kind: RecordType, occurrence: int = 0, extra: int = 0) -> Damage:
    return lambda data: data[: find(data, kind, occurrence).position + extra]


def position_of_property(data: bytes, node: int, name: str) -> tuple[int, int, int]:
    """Start of the record, of the value's size, and of the value."""
    wanted = name.encode() + b"\0"
    for record in records(data):
        start = record.position + 28
        if record.node == node and 3 <= record.kind <= 6 and data[start + 4 : start + 4 + len(wanted)] == wanted:
            return record.position, start + 4 + len(wanted), start + 8 + len(wanted)
    raise AssertionError(name)


def with_property(node: int, name: str, value: bytes) -> Damage:
    return lambda data: patch_bytes(data, position_of_property(data, node, name)[2], value)


def without_property(node: int, name: str) -> Damage:
    def damage(data: bytes) -> bytes:
        start, _, value = position_of_property(data, node, name)
        (size,) = struct.unpack_from("<I", data, start + 12)
        assert start + size > value
        return data[:start] + data[start + size :]

    return damage


def rename_property(node: int, name: str, new: bytes) -> Damage:
    return lambda data: patch_bytes(data, position_of_property(data, node, name)[0] + 32, new)


HUGE = struct.pack("<I", 0x7FFFFFFF)
ADDED_CODEC = 28 + 4 + len(b"Image\0") + 4
DAMAGED = {
    "record fields beyond the buffer": patch_record(RecordType.NEW_DATA, 12, HUGE, 2),
    "property name outside ASCII": rename_property(IMAGE_NODE, "xnMirror", b"xnM\xefrror"),
    "name without its end": patch_record(RecordType.NODE_ADDED, 28, HUGE),
    "property larger than its record": lambda data: patch_bytes(
        data, position_of_property(data, 1, "xnFOV")[1], b"\x00\xff\x00\x00"
    ),
    "no end": cut_before(RecordType.END),
    "cut inside a picture": cut_before(RecordType.NEW_DATA, 5, 60),
    "cut inside a record header": cut_before(RecordType.NEW_DATA, 5, 11),
    "broken chain": patch_record(RecordType.NEW_DATA, 0, b"XXXX", 3),
    "unknown record": patch_record(RecordType.NEW_DATA, 4, b"\x63\x00\x00\x00", 3),
    "unknown stream": patch_record(RecordType.NEW_DATA, 8, b"\x09\x00\x00\x00", 3),
    "payload beyond the buffer": patch_record(RecordType.NEW_DATA, 16, HUGE, 3),
    "payload after a property": patch_record(RecordType.INT_PROPERTY, 16, b"\x04\x00\x00\x00"),
    "picture number 0": patch_record(RecordType.NEW_DATA, 36, bytes(4)),
    "no size": without_property(IMAGE_NODE, oni.MAP_OUTPUT_MODE),
    "absurd size": with_property(IMAGE_NODE, oni.MAP_OUTPUT_MODE, struct.pack("<III", 60000, 60000, 30)),
    "size property of the wrong length": lambda data: patch_bytes(
        data, position_of_property(data, IMAGE_NODE, oni.MAP_OUTPUT_MODE)[1], b"\x0b"
    ),
    "two streams of one number": patch_record(RecordType.NODE_ADDED, 8, b"\x01\x00\x00\x00", 1),
}


@pytest.mark.parametrize("damage", DAMAGED.values(), ids=DAMAGED.keys())
def test_oni_contents_damaged_file_raises(tmp_path: Path, sound: bytes, damage: Damage) -> None:
    data = damage(sound)
    assert data != sound
    fault = check(tmp_path, data)
    assert isinstance(fault, RecordingDamaged)
    assert fault.subject == str(tmp_path / "file.oni")
    assert "at byte" in fault.detail


UNSUPPORTED = {
    "newer version": lambda data: patch_bytes(data, 4, b"\x02"),
    "unknown codec": patch_record(RecordType.NODE_ADDED, ADDED_CODEC, b"WHAT", 1),
    "cropped": with_property(DEPTH_NODE, oni.CROPPING, struct.pack("<IHHHH", 1, 0, 0, 32, 24)),
    "colour as YUV": with_property(IMAGE_NODE, oni.PIXEL_FORMAT_2, struct.pack("<Q", PixelFormat.YUV422)),
    "unknown pixel format": with_property(IMAGE_NODE, oni.PIXEL_FORMAT_2, struct.pack("<Q", 999)),
    "no colour": patch_record(RecordType.NODE_ADDED, ADDED_CODEC - 4, struct.pack("<I4s", NodeType.IR, b"JPEG"), 1),
}


@pytest.mark.parametrize("damage", UNSUPPORTED.values(), ids=UNSUPPORTED.keys())
def test_oni_contents_unsupported_recording_is_named(tmp_path: Path, sound: bytes, damage: Damage) -> None:
    assert isinstance(check(tmp_path, damage(sound)), RecordingUnsupported)


def test_oni_contents_unordered_times_raise(tmp_path: Path, sound: bytes) -> None:
    backwards = patch_record(RecordType.NEW_DATA, 28, struct.pack("<Q", 1000), 2, IMAGE_NODE)(sound)
    fault = check(tmp_path, backwards)
    assert isinstance(fault, TimesUnordered)
    assert fault.detail == "image frame 3"

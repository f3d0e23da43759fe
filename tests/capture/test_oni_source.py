"""Recordings as a source of frames: every picture, in order, at its time; what is wrong with a damaged file."""

from __future__ import annotations

import os
import struct
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.capture.camera_info import sidecar_path, write_camera_info
from carpus.core.capture.files import oni_format as oni
from carpus.core.capture.files.oni_format import NodeType, RecordType
from carpus.core.capture.files.oni_source import OniSource, read_contents
from carpus.core.capture.source import PixelFormat
from carpus.core.model.camera import Camera
from carpus.core.model.errors import (
    CameraFileUnreadable,
    CarpusFault,
    DepthNotRegistered,
    FramesEnlarged,
    RecordingDamaged,
    RecordingMissing,
    RecordingUnreadable,
    RecordingUnsupported,
    TimesUnordered,
)
from carpus.core.model.types import Frame
from tests.capture.oni_samples import (
    CAMERA,
    HEIGHT,
    PERIOD_S,
    START_S,
    WIDTH,
    color_picture,
    depth_picture,
    find,
    patch_bytes,
    records,
    with_size,
    write_sample,
)
from tests.torture.mutations import cut, flip, noise, remove, repeat, zeros


def play(path: Path) -> tuple[list[Frame], list[CarpusFault]]:
    notices: list[CarpusFault] = []
    source = OniSource(path, registered=True, notice=notices.append)
    frames = list(source.frames())
    source.close()
    return frames, notices


def change_sample(folder: Path, count: int, change: Callable[[bytes], bytes], **how: Any) -> Path:
    """A sample whose bytes are not as they were written."""
    path = write_sample(folder / "a.oni", count, **how)
    path.write_bytes(change(path.read_bytes()))
    return path


def assert_whole(frames: list[Frame], count: int) -> None:
    assert [frame.index for frame in frames] == list(range(count))
    for number, frame in enumerate(frames, start=1):
        assert np.array_equal(frame.color_rgb, color_picture(number))
        assert np.array_equal(frame.depth_raw, depth_picture(number))
        assert frame.timestamp_s == pytest.approx(START_S + (number - 1) * PERIOD_S, abs=1e-6)
        assert frame.dropped_before == 0
        assert not frame.color_rgb.flags.writeable
        assert frame.color_rgb.flags.c_contiguous


@pytest.mark.parametrize("depth", ["raw", "table"])
def test_oni_source_is_lossless_and_can_be_repeated(tmp_path: Path, depth: Any) -> None:
    source = OniSource(write_sample(tmp_path / "手首 été.oni", 4, depth=depth))
    for _ in range(2):
        assert_whole(list(source.frames()), 4)
    source.close()
    source.close()
    assert list(source.frames()) == []


@pytest.mark.parametrize(("registered", "expected"), [(True, []), (False, [DepthNotRegistered])])
def test_oni_source_uses_sidecar(tmp_path: Path, registered: bool, expected: list[type[CarpusFault]]) -> None:
    path = write_sample(tmp_path / "a.oni", 2)
    write_camera_info(sidecar_path(path), CAMERA, registered=registered)
    notices: list[CarpusFault] = []
    source = OniSource(path, registered=not registered, notice=notices.append)
    assert [type(fault) for fault in notices] == expected
    assert source.info.settings["registered"] == ("yes" if registered else "no")
    assert source.info.camera.origin == "file"
    assert all(frame.depth_raw is not None for frame in source.frames())


def test_oni_source_sidecar_of_other_size_raises(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 2)
    write_camera_info(sidecar_path(path), replace(CAMERA, height_px=40))
    with pytest.raises(CameraFileUnreadable) as caught:
        OniSource(path)
    assert caught.value.subject == str(sidecar_path(path))


def test_oni_source_mirrored_images_are_flipped(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 1, mirrored=True)
    assert_whole(play(path)[0], 1)
    assert OniSource(path).info.settings["mirrored"] == "turned back"
    write_camera_info(sidecar_path(path), CAMERA, registered=True, mirrored=False)
    (frame,) = play(path)[0]
    assert np.array_equal(frame.color_rgb, color_picture(1)[:, ::-1]), "the camera file knows better"
    assert np.array_equal(frame.depth_raw, depth_picture(1)[:, ::-1])


def test_oni_source_small_colour_is_enlarged(tmp_path: Path) -> None:
    path = change_sample(tmp_path, 1, lambda data: with_size(data, 2, WIDTH // 2, HEIGHT // 2))
    small = Camera(26.25, 26.25, 15.5, 11.5, WIDTH // 2, HEIGHT // 2)
    write_camera_info(sidecar_path(path), small, registered=True)
    notices: list[CarpusFault] = []
    source = OniSource(path, notice=notices.append)
    assert [type(fault) for fault in notices] == [FramesEnlarged]
    assert source.info.camera == replace(CAMERA, origin="file")
    (frame,) = source.frames()
    assert np.array_equal(frame.depth_raw, depth_picture(1))
    # the mean of each 2x2 block is the small pixel, up to the smoothing at edges
    blocks = frame.color_rgb.reshape(HEIGHT // 2, 2, WIDTH // 2, 2, 3).mean((1, 3))
    small_picture = color_picture(1)[: HEIGHT // 2, : WIDTH // 2].astype(float)
    assert np.abs(blocks - small_picture)[12:-2, 12:-2].mean() < 3.0


def test_oni_source_incompatible_sizes_raise(tmp_path: Path) -> None:
    with pytest.raises(RecordingUnsupported, match="colour 64x48, depth 60x48"):
        OniSource(change_sample(tmp_path, 2, lambda data: with_size(data, 1, 60, 48)))


def damage_payload(data: bytes, node: int, occurrence: int) -> bytes:
    payload = find(data, RecordType.NEW_DATA, occurrence, node).payload
    noise = np.random.default_rng(3).integers(0, 256, payload.stop - payload.start, np.uint8).tobytes()
    return patch_bytes(data, payload.start, noise)


def test_oni_source_damaged_depth_leaves_frame_without_depth(tmp_path: Path) -> None:
    frames, notices = play(change_sample(tmp_path, 6, lambda data: damage_payload(data, 1, 3)))
    assert [frame.depth_raw is not None for frame in frames] == [True, True, True, False, True, True]
    assert [fault.detail for fault in notices] == ["1 of 6 depth"]


def test_oni_source_changed_file_raises(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 60)
    source = OniSource(path)
    frames = source.frames()
    next(frames)
    os.truncate(path, 100_000)
    for rest in (frames, source.frames()):
        with pytest.raises(RecordingDamaged, match="the file changes while it is read"):
            list(rest)


DEPTH_NODE, IMAGE_NODE = 1, 2


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return write_sample(tmp_path_factory.mktemp("oni") / "sound.oni", color="jpeg").read_bytes()


def find_fault(tmp_path: Path, data: bytes) -> CarpusFault | None:
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
        assert isinstance(find_fault(tmp_path, data), RecordingUnreadable)


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
    fault = find_fault(tmp_path, data)
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
    assert isinstance(find_fault(tmp_path, damage(sound)), RecordingUnsupported)


def test_oni_contents_unordered_times_raise(tmp_path: Path, sound: bytes) -> None:
    backwards = patch_record(RecordType.NEW_DATA, 28, struct.pack("<Q", 1000), 2, IMAGE_NODE)(sound)
    fault = find_fault(tmp_path, backwards)
    assert isinstance(fault, TimesUnordered)
    assert fault.detail == "image frame 3"


NUMBERS = (0, 1, 2, 27, 29, 255, 65_535, 65_536, 5_760_000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)


def number_in_structure(data: bytearray, rng: np.random.Generator) -> None:
    """Another number somewhere outside the pictures."""
    spans = [range(24), *(range(one.position, one.position + one.fields_size) for one in records(bytes(data)))]
    place = int(rng.choice([place for span in spans for place in span]))
    data[place : place + 4] = int(rng.choice(NUMBERS)).to_bytes(4, "little")


MUTATIONS = (number_in_structure, number_in_structure, number_in_structure, flip, noise, zeros, cut, remove, repeat)


def test_oni_source_mutated_file_raises_only_faults(tmp_path: Path) -> None:
    """``CARPUS_FUZZ_FILES=20000`` tries more of them."""
    count, kinds = int(os.environ.get("CARPUS_FUZZ_FILES", "160")), Counter[str]()
    path = tmp_path / "mutated.oni"
    for color in ("raw", "jpeg"):
        sound = write_sample(tmp_path / f"{color}.oni", 4, color=color).read_bytes()  # type: ignore[arg-type]
        for number in range(count // 2):
            data = bytearray(sound)
            MUTATIONS[number % len(MUTATIONS)](data, np.random.default_rng(number))
            path.write_bytes(data)
            try:
                for frame in OniSource(path).frames():
                    assert frame.color_rgb.shape == (HEIGHT, WIDTH, 3)
                    assert frame.depth_raw is None or frame.depth_raw.shape == (HEIGHT, WIDTH)
                kinds["played"] += 1
            except CarpusFault as fault:
                kinds[type(fault).__name__] += 1
    assert kinds["played"] > count // 10
    assert kinds["RecordingDamaged"] > count // 4

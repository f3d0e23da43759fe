"""Raw recordings and their pictures in tiles: what goes in comes out, whatever gnaws at the file."""

from __future__ import annotations

import json
import math
import struct
import time
import zlib
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from carpus.core.capture.files.image_codec import (
    TILE_PX,
    TiledImage,
    decode_color,
    encode_color,
    pack_tiles,
)
from carpus.core.capture.files.raw import MAX_FRAMES, RawRecording, RawWriter, _pack_record, is_raw_recording
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import D435
from carpus.core.model.errors import (
    CarpusFault,
    DamagedFramesExcluded,
    FrameSizeChanged,
    OutputExists,
    OutputNotWritable,
    RecordingDamaged,
    RecordingEmpty,
    RecordingMissing,
    RecordingUnreadable,
)
from carpus.core.model.types import ByteImage, Frame, Region
from tests.capture.oni_samples import HEIGHT, WIDTH, color_picture, depth_picture
from tests.capture.small_disk import disk_full_at

LENS = (0.1, -0.2, 0.001, 0.002, 0.3)
CAMERA = Camera(52.0, 53.0, 31.0, 23.0, WIDTH, HEIGHT, LENS, "file", D435, "inverse_brown_conrady")
INFO = SourceInfo("Xtion Pro Live", CAMERA, True, None, 30.0, {"serial": "1206", "registered": "by the camera"})


def frames(count: int) -> list[Frame]:
    """Times of a camera, one gap, one frame without depth."""
    out = []
    for i in range(count):
        time_s, depth = 3.25 + i / 30.0 + (0.1 if i > 2 else 0.0), None if i == 1 else depth_picture(i)
        out.append(Frame(i, time_s, color_picture(i), depth, 1e-3, 3 if i == 3 else 0))
    return out


def write(path: Path, count: int = 6, *, lossless: bool = True) -> Path:
    with RawWriter(path, INFO, lossless=lossless) as writer:
        for frame in frames(count):
            writer.append_frame(frame)
        assert len(writer) == count
        assert writer.path == path
    return path


def assert_same(read: Frame, written: Frame) -> None:
    assert np.array_equal(read.color_rgb, written.color_rgb)
    assert (read.depth_raw is None) == (written.depth_raw is None)
    if read.depth_raw is not None:
        assert np.array_equal(read.depth_raw, written.depth_raw)
    assert read.timestamp_s == written.timestamp_s
    assert read.depth_unit_m == written.depth_unit_m


def test_raw_recording_lossless_frames_are_read_back_exactly(tmp_path: Path) -> None:
    recording = RawRecording(write(tmp_path / "take.carpusraw"))
    for _ in range(2):
        back = list(recording.frames())
        assert [frame.index for frame in back] == list(range(6))
        for read, written in zip(back, frames(6), strict=True):
            assert_same(read, written)
            assert read.dropped_before == written.dropped_before
            assert not read.color_rgb.flags.writeable
    assert recording.is_complete
    assert recording.info == SourceInfo(INFO.name, CAMERA, True, 6, 30.0, INFO.settings)


def test_raw_recording_layout_matches_independent_reader(tmp_path: Path) -> None:
    start, *parts = write_records(tmp_path / "take.carpusraw", 3)
    assert start == b"CARPUSRW\x02\x00\x00\x00"
    assert [part[:4] for part in parts] == [b"HEAD", b"FRAM", b"FRAM", b"FRAM", b"DONE"]
    for part in parts:
        _, check, time_s, _, number, color_size, _ = struct.unpack_from("<4sIdIIII", part)
        assert zlib.crc32(part[8:]) == check
        color = part[32 : 32 + color_size]
        if part[:4] == b"HEAD":
            head = json.loads(color)
            assert head["camera"]["distortion"] == [0.1, -0.2, 0.001, 0.002, 0.3]
            assert head["depth_unit_m"] == 1e-3
        elif part[:4] == b"FRAM":
            assert time_s == frames(3)[number].timestamp_s
            assert struct.unpack_from("<HHI", color) == (WIDTH, HEIGHT, len(color) - 8)  # one tile
            picture = cv2.imdecode(np.frombuffer(color[8:], np.uint8), cv2.IMREAD_COLOR_RGB)
            assert np.array_equal(picture, color_picture(number))
    assert is_raw_recording(tmp_path / "take.carpusraw")
    assert not is_raw_recording(tmp_path)


def test_raw_recording_truncated_file_keeps_complete_frames(tmp_path: Path) -> None:
    data = write(tmp_path / "whole.carpusraw", 4).read_bytes()
    path = tmp_path / "cut.carpusraw"
    whole = frames(4)
    seen = set()
    for length in [*range(12, len(data), 1997), len(data) - 1]:
        path.write_bytes(data[:length])
        try:
            recording = RawRecording(path)
        except RecordingEmpty:
            seen.add(0)
            continue
        back = list(recording.frames())
        seen.add(len(back))
        assert not recording.is_complete
        for read, written in zip(back, whole, strict=False):
            assert_same(read, written)
    assert seen == {0, 1, 2, 3, 4}


def records(data: bytes) -> list[bytes]:
    """Start, head, frames and end of a recording, each by itself."""
    found, position = [data[:12]], 12
    while position < len(data):
        end = position + 32 + sum(struct.unpack_from("<II", data, position + 24))
        found.append(data[position:end])
        position = end
    return found


def write_records(path: Path, count: int) -> list[bytes]:
    return records(write(path, count).read_bytes())


def read_back(path: Path, parts: list[bytes]) -> tuple[RawRecording, list[Frame], list[CarpusFault]]:
    path.write_bytes(b"".join(parts))
    notices: list[CarpusFault] = []
    recording = RawRecording(path, notice=notices.append)
    return recording, list(recording.frames()), notices


LETTERS, NUMBER, COLOR_SIZE, DEPTH_SIZE = 0, 20, 24, 28


@pytest.mark.parametrize(
    "place", [LETTERS, NUMBER, NUMBER + 3, COLOR_SIZE, COLOR_SIZE + 3, DEPTH_SIZE, DEPTH_SIZE + 3, 500]
)
def test_raw_recording_one_damaged_byte_loses_one_frame(tmp_path: Path, place: int) -> None:
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 8)
    for number in (0, 4, 7):
        damaged = bytearray(parts[2 + number])
        damaged[place] ^= 1 << 7
        recording, back, notices = read_back(path, [*parts[: 2 + number], bytes(damaged), *parts[3 + number :]])
        assert recording.is_complete
        others = [frame for frame in frames(8) if frame.index != number]
        for read, written in zip(back, others, strict=True):
            assert_same(read, written)
            assert read.dropped_before == written.dropped_before + (written.index == number + 1)
        assert [(type(fault), fault.detail) for fault in notices] == [(DamagedFramesExcluded, "1 of 8 frames")]


@pytest.mark.parametrize("gone", [(0,), (7,), (3, 4, 6)])
def test_raw_recording_missing_frames_are_counted_and_notified(tmp_path: Path, gone: tuple[int, ...]) -> None:
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 8)
    _, back, notices = read_back(path, [part for at, part in enumerate(parts) if at - 2 not in gone])
    assert len(back) == 8 - len(gone)
    own = sum(frame.dropped_before for frame in frames(8) if frame.index not in gone)
    assert sum(frame.dropped_before for frame in back) == own + sum(number < 7 for number in gone)
    assert [(type(fault), fault.detail) for fault in notices] == [(DamagedFramesExcluded, f"{len(gone)} of 8 frames")]


def test_raw_recording_duplicate_frame_is_notified(tmp_path: Path) -> None:
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 6)
    _, back, notices = read_back(path, [*parts[:5], parts[4], *parts[5:]])
    assert [frame.dropped_before for frame in back] == [frame.dropped_before for frame in frames(6)]
    assert [fault.detail for fault in notices] == ["1 of 6 frames"]


@pytest.mark.parametrize(
    ("time_s", "dropped", "number"),
    [(math.nan, 0, 2), (math.inf, 0, 2), (3.32, MAX_FRAMES + 1, 2), (3.32, 2**32 - 1, 2), (3.32, 0, MAX_FRAMES)],
)
def test_raw_recording_frame_with_impossible_value_is_skipped(
    tmp_path: Path, time_s: float, dropped: int, number: int
) -> None:
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 6)
    size = struct.unpack_from("<I", parts[4], COLOR_SIZE)[0]
    altered = _pack_record(b"FRAM", time_s, dropped, number, parts[4][32 : 32 + size], parts[4][32 + size :])
    _, back, notices = read_back(path, [*parts[:4], altered, *parts[5:]])
    assert [frame.dropped_before for frame in back] == [0, 0, 3 + 1, 0, 0]
    assert [fault.detail for fault in notices] == ["1 of 6 frames"]


def test_raw_recording_search_time_is_linear_in_size(tmp_path: Path) -> None:
    """Every 32 bytes a record with a wrong checksum that would reach to the end of the file."""
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 2)
    count = 20_000
    false = [struct.pack("<4sIdIIII", b"FRAM", 1, 9.0, 0, 7, 32 * (count - at - 1), 0) for at in range(count)]
    start_s = time.process_time()
    recording, back, _ = read_back(path, [*parts[:3], *false])
    assert (recording.is_complete, len(back)) == (False, 1)
    assert time.process_time() - start_s < 1.0  # 0.05 s; each checksum to the end would be 6.4 GB


def test_raw_recording_data_after_end_are_notified(tmp_path: Path) -> None:
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 3)
    for surplus in (b"hello", b"".join(parts)):
        recording, back, notices = read_back(path, [*parts, surplus])
        assert (recording.is_complete, len(back)) == (True, 3)
        assert [type(fault) for fault in notices] == [RecordingDamaged]
        assert str(len(surplus)) in notices[0].detail


@pytest.mark.parametrize("place", [0, 4, NUMBER])
def test_raw_recording_damaged_end_is_ignored(tmp_path: Path, place: int) -> None:
    path = tmp_path / "take.carpusraw"
    parts = write_records(path, 3)
    end = bytearray(parts[-1])
    end[place] ^= 1
    recording, back, notices = read_back(path, [*parts[:-1], bytes(end)])
    assert (recording.is_complete, len(back), notices) == (False, 3, [])


@pytest.mark.parametrize("place", [12, 16, 12 + COLOR_SIZE, 12 + COLOR_SIZE + 2, 60])
def test_raw_recording_damaged_header_raises_with_frame_count(tmp_path: Path, place: int) -> None:
    path = write(tmp_path / "take.carpusraw", 4)
    data = bytearray(path.read_bytes())
    data[place] ^= 1
    path.write_bytes(data)
    with pytest.raises(RecordingUnreadable, match=r"damaged header, 4\b"):
        RawRecording(path)


def test_raw_writer_frames_are_in_the_file_at_once(tmp_path: Path) -> None:
    """Whatever kills the program afterwards: nothing waits in its memory."""
    writer = RawWriter(tmp_path / "take.carpusraw", INFO)
    for count, frame in enumerate(frames(4), start=1):
        writer.append_frame(frame)
        recording = RawRecording(writer.path)
        assert (recording.is_complete, len(list(recording.frames()))) == (False, count)
    last = np.abs(next(reversed(list(recording.frames()))).color_rgb.astype(int) - frame.color_rgb)
    assert 0.0 < last.mean() < 2.5, "as JPEG"
    writer.abandon()


def test_raw_writer_full_disk_keeps_recording(tmp_path: Path) -> None:
    writer = RawWriter(tmp_path / "full.carpusraw", INFO, lossless=True)
    with disk_full_at(100_000), writer:
        for frame in frames(100):
            writer.append_frame(frame)
    assert len(writer) > 3
    assert len(list(RawRecording(writer.path).frames())) == len(writer)


def test_raw_writer_invalid_use_raises(tmp_path: Path) -> None:
    path = write(tmp_path / "take.carpusraw", 1)
    before = path.read_bytes()
    with pytest.raises(OutputExists):
        RawWriter(path, INFO)
    assert path.read_bytes() == before
    with pytest.raises(OutputNotWritable):
        RawWriter(tmp_path / "none" / "take.carpusraw", INFO)
    writer = RawWriter(tmp_path / "other.carpusraw", INFO)
    writer.append_frame(frames(1)[0])
    fine = frames(2)[0]
    with pytest.raises(ValueError, match="depth in steps"):
        writer.append_frame(Frame(1, 9.0, fine.color_rgb, fine.depth_raw, 1e-4))
    writer.close()
    writer.close()
    with pytest.raises(ValueError, match="closed"):
        writer.append_frame(fine)
    writer.discard()
    assert list(tmp_path.iterdir()) == [path]


def test_raw_recording_unreadable_file_raises(tmp_path: Path) -> None:
    with pytest.raises(RecordingMissing):
        RawRecording(tmp_path / "none")
    path = tmp_path / "take.carpusraw"
    RawWriter(path, INFO).close()
    with pytest.raises(RecordingEmpty):
        RawRecording(path)
    for data in (b"", b"CARPUSRW", b"CARPUSRW\x01\x00\x00\x00", b"RIFF" + bytes(100)):
        path.write_bytes(data)
        with pytest.raises(RecordingUnreadable):
            RawRecording(path)


@pytest.mark.parametrize(
    "said",
    [
        {"fx_px": 0.0},
        {"fy_px": float("nan")},
        {"fx_px": "52"},
        {"height_px": -48},
        {"distortion": [float("nan")] * 5},
        {"distortion": "abcde"},
        {"depth_unit_m": 0.0},
    ],
)
def test_raw_recording_impossible_camera_raises(tmp_path: Path, said: dict[str, object]) -> None:
    path = write(tmp_path / "take.carpusraw", 2)
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12 + 24)[0]
    head = json.loads(data[44 : 44 + size])
    (head if "depth_unit_m" in said else head["camera"]).update(said)
    path.write_bytes(data[:12] + _pack_record(b"HEAD", 0.0, 0, 0, json.dumps(head).encode(), b"") + data[44 + size :])
    with pytest.raises(RecordingUnreadable, match="head"):
        RawRecording(path)


@pytest.mark.parametrize("size", [{"color_rgb": color_picture(1)[:24, :32]}, {"depth_raw": depth_picture(1)[:24, :32]}])
def test_raw_recording_wrong_image_size_raises(tmp_path: Path, size: dict[str, Any]) -> None:
    with RawWriter(tmp_path / "take.carpusraw", INFO) as writer:
        for frame in (frames(1)[0], replace(frames(4)[3], **size)):
            writer.append_frame(frame)
    walk = RawRecording(writer.path).frames()
    next(walk)
    with pytest.raises(FrameSizeChanged):
        next(walk)


def test_raw_recording_any_altered_byte_gives_no_wrong_image(tmp_path: Path) -> None:
    data = write(tmp_path / "whole.carpusraw", 3).read_bytes()
    whole = {frame.timestamp_s: frame for frame in frames(3)}
    path = tmp_path / "altered.carpusraw"
    rng = np.random.default_rng(5)
    for place in [*range(44, 500, 6), *rng.integers(0, len(data), 75).tolist()]:
        altered = bytearray(data)
        altered[place] ^= 1 << int(rng.integers(8))
        path.write_bytes(altered)
        try:
            recording = RawRecording(path)
            for frame in recording.frames():
                assert_same(frame, whole[frame.timestamp_s])
            assert recording.info.camera == CAMERA
        except CarpusFault:
            continue


TILED_WIDTH, TILED_HEIGHT = 250, 130
COLOR, DEPTH = np.empty((0, 0, 3), np.uint8), np.empty((0, 0), np.uint16)


def noisy_color() -> ByteImage:
    return np.random.default_rng(3).integers(1, 256, (TILED_HEIGHT, TILED_WIDTH, 3), dtype=np.uint8)


def color_from(data: bytes) -> TiledImage[ByteImage]:
    return TiledImage(Path("take"), data, COLOR, decode_color)


def test_tiled_jpeg_equals_whole_jpeg() -> None:
    color = noisy_color()
    back = color_from(pack_tiles(color, encode_color)).decode(None)
    np.testing.assert_array_equal(back, decode_color(encode_color(color)))
    assert not back.flags.writeable


@pytest.mark.parametrize(
    "part",
    [
        Region(0, 0, 1, 1), Region(79, 79, 81, 81), Region(160, 80, 240, 130), Region(-50, 100, 20, 900),
        Region(240, 0, 250, 130), Region(-20, -20, -5, -5), Region(300, 10, 400, 20),
    ],
)  # fmt: skip
def test_tiled_image_decodes_only_the_region(part: Region) -> None:
    color = noisy_color()
    tiled = color_from(pack_tiles(color, partial(encode_color, lossless=True)))
    seen = tiled.decode(part)
    inside = np.s_[max(part.top, 0) : max(part.bottom, 0), max(part.left, 0) : max(part.right, 0)]
    np.testing.assert_array_equal(seen[inside], color[inside])
    columns = min(part.right, TILED_WIDTH) // TILE_PX - max(part.left, 0) // TILE_PX + 1
    assert seen.any(axis=-1).sum() <= max(columns, 0) * TILE_PX * TILED_HEIGHT
    np.testing.assert_array_equal(tiled.decode(None), color)


@pytest.mark.parametrize(
    "damaged",
    [
        lambda data: b"",
        lambda data: data[:40],
        lambda data: data[:-1],
        lambda data: data + b"x",
        lambda data: b"\xff\xff\xff\xff" + data[4:],
        lambda data: data[:36] + bytes(len(data) - 36),
        lambda data: b"\xfb" + data[1:],  # a column wider
    ],
)
def test_tiled_image_invalid_data_raises(damaged: object) -> None:
    data = pack_tiles(noisy_color(), encode_color)
    with pytest.raises(RecordingUnreadable, match="take"):
        color_from(damaged(data)).decode(None)  # type: ignore[operator]

"""TUM folders: every picture once, the right depth with it, one typed fault for each bad input; and their writer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.capture.camera_info import write_camera_info
from carpus.core.capture.files.tum import TumFolder, TumWriter, pair_by_time, to_tum_depth
from carpus.core.capture.source import FrameSource, SourceInfo, is_simulated
from carpus.core.model.camera import DEFAULT_CAMERA, Camera
from carpus.core.model.errors import (
    CameraFileUnreadable,
    CarpusFault,
    DamagedFramesExcluded,
    DepthMissing,
    FrameDamaged,
    FrameSizeChanged,
    InitialFrameDamaged,
    OutputExists,
    OutputNotWritable,
    RecordingEmpty,
    RecordingMissing,
    RecordingUnreadable,
    RepeatedTimesExcluded,
    TimesUnordered,
    UnitAssumed,
)
from carpus.core.model.types import Frame
from tests.capture.oni_samples import HEIGHT, WIDTH, color_picture
from tests.capture.oni_samples import depth_picture as distances
from tests.capture.small_disk import disk_full_at

TIMES_S = [1305031102.175304 + 0.033 * k for k in (0, 1, 2, 5, 6)]


def depth_picture(index: int) -> np.ndarray:
    return np.random.default_rng(1000 + index).integers(0, 65536, (HEIGHT, WIDTH), dtype=np.uint16)


def write_recording(folder: Path, times_s: list[float] = TIMES_S, depth_late_s: float = 0.004) -> Path:
    """A folder written by hand: colour, and depth a few milliseconds later."""
    (folder / "rgb").mkdir(parents=True)
    (folder / "depth").mkdir()
    color_lines, depth_lines = ["# color images", "# timestamp filename"], ["# depth maps"]
    for k, time_s in enumerate(times_s):
        color, depth = f"rgb/{time_s:.6f}.png", f"depth/{time_s + depth_late_s:.6f}.png"
        cv2.imwrite(str(folder / color), color_picture(k)[..., ::-1])
        cv2.imwrite(str(folder / depth), depth_picture(k))
        color_lines.append(f"{time_s:.6f} {color}")
        depth_lines.append(f"{time_s + depth_late_s:.6f} {depth}")
    (folder / "rgb.txt").write_text("\n".join(color_lines) + "\n")
    (folder / "depth.txt").write_text("\n".join(depth_lines) + "\n")
    return folder


@pytest.fixture
def take(tmp_path: Path) -> Path:
    return write_recording(tmp_path / "take")


def edit(path: Path, change: Callable[[list[str]], list[str]]) -> None:
    path.write_text("\n".join(change(path.read_text().splitlines())) + "\n")


def test_tum_folder_images_are_read_exactly(take: Path) -> None:
    for name in ("rgb.txt", "depth.txt"):  # as an editor on Windows leaves them
        text = (take / name).read_text()
        (take / name).write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n\r\n").encode())
    source = TumFolder(take)
    for _ in range(2):  # may be walked through again
        frames = list(source.frames())
        assert [frame.index for frame in frames] == [0, 1, 2, 3, 4]
        assert [frame.timestamp_s for frame in frames] == [round(time_s, 6) for time_s in TIMES_S]
        assert [frame.dropped_before for frame in frames] == [0, 0, 0, 2, 0]
        for k, frame in enumerate(frames):
            np.testing.assert_array_equal(frame.color_rgb, color_picture(k))
            np.testing.assert_array_equal(frame.depth_raw, depth_picture(k))
            assert frame.depth_unit_m == pytest.approx(1 / 5000)
            assert not frame.color_rgb.flags.writeable
            assert frame.depth_raw is not None
            assert not frame.depth_raw.flags.writeable


def test_tum_folder_colour_only_is_read_without_requires_depth(take: Path) -> None:
    (take / "depth.txt").unlink()
    source: FrameSource = TumFolder(take, requires_depth=False)
    assert not source.info.has_depth
    assert all(frame.depth_raw is None for frame in source.frames())


Spoiler = Callable[[Path], object]


def cut(folder: Path, kind: str, keep: float) -> None:
    path = sorted((folder / kind).iterdir())[2]
    data = path.read_bytes()
    path.write_bytes(data[: int(len(data) * keep)])


def flip_a_bit(folder: Path) -> None:
    path = sorted((folder / "rgb").iterdir())[2]
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(bytes(data))


def swap_files(name: str) -> Spoiler:
    """The last two lines of a list in each other's place."""
    return lambda folder: edit(folder / name, lambda lines: [*lines[:-2], lines[-1], lines[-2]])


def more(name: str, line: str) -> Spoiler:
    return lambda folder: edit(folder / name, lambda lines: [*lines, line or lines[-1]])


def picture(kind: str, index: int, value: np.ndarray) -> Spoiler:
    return lambda folder: cv2.imwrite(str(sorted((folder / kind).iterdir())[index]), value)


def camera_file(camera: Camera, **how: bool) -> Spoiler:
    return lambda folder: write_camera_info(folder / "camera_info.yaml", camera, **how)


def to_a_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


GREY, SMALL = np.zeros((HEIGHT, WIDTH), np.uint8), np.zeros((24, 32, 3), np.uint8)
OWN_CAMERA = Camera(52.0, 53.0, 31.5, 23.5, WIDTH, HEIGHT, origin="file")
BAD: dict[str, tuple[Spoiler, type[CarpusFault], str]] = {
    "no folder": (lambda f: f.rename(f.with_name("elsewhere")), RecordingMissing, ""),
    "a file": (lambda f: (f.rename(f.with_name("elsewhere")), f.touch()), RecordingUnreadable, "not a folder"),
    "no colour list": (lambda f: (f / "rgb.txt").unlink(), RecordingUnreadable, "missing"),
    "colour list is a folder": (lambda f: to_a_folder(f / "rgb.txt"), RecordingUnreadable, ""),
    "colour list is binary": (lambda f: (f / "rgb.txt").write_bytes(b"\xff\x00\xfe"), RecordingUnreadable, "text"),
    "colour list empty": (lambda f: (f / "rgb.txt").write_text("# nothing\n"), RecordingEmpty, "rgb.txt"),
    "no depth list": (lambda f: (f / "depth.txt").unlink(), DepthMissing, "depth.txt"),
    "depth list empty": (lambda f: (f / "depth.txt").write_text(""), DepthMissing, "depth.txt"),
    "garbage line": (more("rgb.txt", "hello there"), RecordingUnreadable, "line 8"),
    "line without a name": (more("rgb.txt", "1305031109.0"), RecordingUnreadable, "line 8"),
    "time not a number": (more("depth.txt", "nan x.png"), RecordingUnreadable, "line 7"),
    "times swapped": (swap_files("rgb.txt"), TimesUnordered, "line 7"),
    "a line leads to a drive": (more("rgb.txt", "1305031109.0 C:\\a.png"), RecordingUnreadable, "outside the folder"),
    "a unit of depth that is none": (
        lambda f: (camera_file(OWN_CAMERA)(f), edit(f / "camera_info.yaml", lambda t: [*t, "depth_unit_m: 1"])),
        CameraFileUnreadable, "depth_unit_m",
    ),
    "depth times swapped": (swap_files("depth.txt"), TimesUnordered, "line 6"),
    "colour picture gone": (lambda f: sorted((f / "rgb").iterdir())[3].unlink(), FrameDamaged, "missing"),
    "depth picture gone": (lambda f: sorted((f / "depth").iterdir())[3].unlink(), FrameDamaged, "missing"),
    "colour picture cut": (lambda f: cut(f, "rgb", 0.5), FrameDamaged, "truncated"),
    "depth picture cut": (lambda f: cut(f, "depth", 0.9), FrameDamaged, "truncated"),
    "picture empty": (lambda f: cut(f, "rgb", 0.0), FrameDamaged, "empty"),
    "picture is text": (lambda f: sorted((f / "rgb").iterdir())[1].write_text("a"), FrameDamaged, "not an image"),
    "one bit altered": (flip_a_bit, FrameDamaged, "altered"),
    "depth of 8 bits": (picture("depth", 2, GREY), FrameDamaged, "8 bits"),
    "depth in colour": (picture("depth", 2, color_picture(0)), FrameDamaged, "colour image"),
    "colour of 16 bits": (picture("rgb", 2, np.zeros((HEIGHT, WIDTH, 3), np.uint16)), FrameDamaged, "16 bits"),
    "colour is grey": (picture("rgb", 0, GREY), InitialFrameDamaged, "grey"),
    "colour size changes": (picture("rgb", 2, SMALL), FrameSizeChanged, "32 x 24"),
    "depth of another size": (picture("depth", 0, np.zeros((24, 32), np.uint16)), FrameSizeChanged, "32 x 24"),
    "camera file of another size": (camera_file(DEFAULT_CAMERA), CameraFileUnreadable, "640 x 480"),
    "mirrored": (camera_file(OWN_CAMERA, mirrored=True), CameraFileUnreadable, "mirrored"),
    "depth at other times": (
        lambda f: edit(f / "depth.txt", lambda t: [line.replace("13050311", "14050311", 1) for line in t]),
        DepthMissing, "20 ms",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_tum_folder_invalid_input_raises_one_fault(take: Path, case: str) -> None:
    spoil, kind, fact = BAD[case]
    spoil(take)
    with pytest.raises(kind) as caught:
        list(TumFolder(take).frames())
    assert type(caught.value) is kind
    assert fact in caught.value.detail
    assert caught.value.subject.startswith(str(take))


rising = st.lists(st.integers(0, 400), unique=True, max_size=12).map(lambda ms: np.array(sorted(ms)) * 1e-3)


@given(rising, rising)
def test_pair_by_time_is_optimal_within_limit(color_s: np.ndarray, depth_s: np.ndarray) -> None:
    partner = pair_by_time(color_s, depth_s)
    used = [d for d in partner if d is not None]
    assert len(used) == len(set(used))
    for c, d in enumerate(partner):
        if d is not None:
            assert abs(color_s[c] - depth_s[d]) <= 0.020 + 1e-5
        for other in range(len(depth_s)):
            gap = abs(color_s[c] - depth_s[other])
            if gap > 0.020 - 1e-5 or other == d:
                continue
            # a nearer depth picture is left alone only where its own colour picture is at least as near
            mine = np.inf if d is None else abs(color_s[c] - depth_s[d])
            owner = partner.index(other) if other in used else None
            theirs = np.inf if owner is None else abs(color_s[owner] - depth_s[other])
            assert mine <= gap + 1e-9 or theirs <= gap + 1e-9


def test_tum_folder_skip_damaged_notifies(take: Path, notices: list[CarpusFault]) -> None:
    color, depth = (sorted((take / kind).iterdir()) for kind in ("rgb", "depth"))
    color[1].write_text("no picture")
    color[3].unlink()
    depth[2].write_bytes(b"")
    source = TumFolder(take, skip_damaged=True, notice=notices.append)
    frames = list(source.frames())
    assert [frame.index for frame in frames] == [0, 1, 2]
    assert [frame.timestamp_s for frame in frames] == [round(TIMES_S[k], 6) for k in (0, 2, 4)]
    for frame, number in zip(frames, (0, 2, 4), strict=True):
        np.testing.assert_array_equal(frame.color_rgb, color_picture(number))
    assert frames[1].depth_raw is None
    assert frames[1].dropped_before == 1, "the damaged one"
    assert all(isinstance(fault, DamagedFramesExcluded) for fault in notices)
    assert [fault.detail for fault in notices] == ["1 colour missing", "1 colour and 1 depth damaged"]


def test_tum_folder_damaged_first_image_raises_always(take: Path) -> None:
    first = min((take / "rgb").iterdir())
    for spoil in (lambda: first.write_text("no picture"), first.unlink):
        spoil()
        with pytest.raises(InitialFrameDamaged):
            TumFolder(take, skip_damaged=True)


@pytest.mark.parametrize(
    ("unit", "counts", "first_s"), [("ms", 1e3, 120.0), ("µs", 1e6, 120.0), ("ns", 1e9, 1726543210.0)]
)
def test_tum_folder_other_time_unit_is_notified(
    take: Path, notices: list[CarpusFault], unit: str, counts: float, first_s: float
) -> None:
    for name in ("rgb.txt", "depth.txt"):
        lines = [line.split() for line in (take / name).read_text().splitlines() if line[0] != "#"]
        later = [(f"{(first_s + float(time_s) - TIMES_S[0]) * counts:.3f}", path) for time_s, path in lines]
        (take / name).write_text("".join(f"{time} {path}\n" for time, path in later))
    source = TumFolder(take, notice=notices.append)
    assert [type(fault) for fault in notices] == [UnitAssumed, UnitAssumed]
    assert unit in notices[0].detail
    stamps = np.array([frame.timestamp_s for frame in source.frames()])
    assert stamps == pytest.approx(first_s + np.array(TIMES_S) - TIMES_S[0], abs=1e-5)
    assert source.info.nominal_fps == pytest.approx(1.0 / 0.033, rel=0.01)


def test_tum_folder_duplicate_time_is_skipped_and_notified(take: Path, notices: list[CarpusFault]) -> None:
    for name in ("rgb.txt", "depth.txt"):
        edit(take / name, lambda lines: [*lines[:-1], lines[-2], lines[-1], lines[-1]])
    frames = list(TumFolder(take, notice=notices.append).frames())
    assert [frame.timestamp_s for frame in frames] == [round(time_s, 6) for time_s in TIMES_S]
    assert [(type(fault), fault.detail) for fault in notices] == 2 * [(RepeatedTimesExcluded, "2")]


@pytest.mark.parametrize(("counts_per_m", "said"), [(5000, False), (1000, True)])
def test_tum_folder_millimetre_depth_is_notified(
    take: Path, notices: list[CarpusFault], counts_per_m: int, said: bool
) -> None:
    for path in (take / "depth").iterdir():
        picture = np.full((HEIGHT, WIDTH), round(0.72 * counts_per_m), np.uint16)
        picture[:10] = 0
        cv2.imwrite(str(path), picture)
    frame = next(TumFolder(take, notice=notices.append).frames())
    assert frame.depth_raw is not None
    assert frame.depth_raw[20, 20] * frame.depth_unit_m == pytest.approx(0.72)
    assert [type(fault) for fault in notices] == [UnitAssumed] * said


@pytest.mark.parametrize("unit_m", ["1e-3", "0.0002"])
def test_tum_folder_uses_depth_unit_of_camera_file(take: Path, notices: list[CarpusFault], unit_m: str) -> None:
    write_camera_info(take / "camera_info.yaml", OWN_CAMERA)
    edit(take / "camera_info.yaml", lambda lines: [*lines, f"depth_unit_m: {unit_m}"])
    assert next(TumFolder(take, notice=notices.append).frames()).depth_unit_m == float(unit_m)
    assert not notices


INFO = SourceInfo("Xtion Pro Live", OWN_CAMERA, True, None, 30.0)


def stored_frames() -> list[Frame]:
    return [Frame(i, 10.0 + i / 30.0, color_picture(i), None if i == 2 else distances(i), 1e-3) for i in range(5)]


def test_tum_writer_full_disk_keeps_complete_frames(tmp_path: Path) -> None:
    path = tmp_path / "take"
    one, two, three, *_ = stored_frames()
    writer = TumWriter(path, INFO)
    writer.append_frame(one)
    writer.append_frame(two)
    with disk_full_at(1000):
        writer.append_frame(three)
    writer.abandon()
    assert [frame.timestamp_s for frame in TumFolder(path).frames()] == pytest.approx([10.0, 10.0 + 1 / 30.0])
    listed = (path / "rgb.txt").read_text() + (path / "depth.txt").read_text()
    assert all(f"{picture.parent.name}/{picture.name}\n" in listed for picture in path.rglob("*.png"))


@pytest.mark.parametrize("room", [10, 200])
def test_tum_writer_disk_full_at_start_raises(tmp_path: Path, room: int) -> None:
    with disk_full_at(room):
        TumWriter(tmp_path / "take", INFO)
    assert list(tmp_path.iterdir()) == [], "and can be tried again"


def test_tum_writer_images_are_read_back(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "take"
    with TumWriter(path, INFO) as writer:
        for frame in stored_frames():
            writer.append_frame(frame)
        assert len(writer) == 5
    assert "\n10.000000 depth/10.000000.png\n" in (path / "depth.txt").read_text()
    folder = TumFolder(path)
    assert folder.info.camera == OWN_CAMERA
    back = list(folder.frames())
    assert len(back) == 5
    for read, written in zip(back, stored_frames(), strict=True):
        assert np.array_equal(read.color_rgb, written.color_rgb)
        assert read.timestamp_s == pytest.approx(written.timestamp_s, abs=1e-6)
        assert (read.depth_raw is None) == (written.depth_raw is None)
        if read.depth_raw is not None and written.depth_raw is not None:
            assert np.array_equal(read.depth_raw, written.depth_raw * 5)
            assert read.depth_raw[0, 0] * read.depth_unit_m == pytest.approx(written.depth_raw[0, 0] * 1e-3)


@pytest.mark.parametrize("settings", [{}, {"simulated": "yes"}])
def test_tum_writer_keeps_simulated_remark(tmp_path: Path, settings: dict[str, str]) -> None:
    with TumWriter(tmp_path / "take", replace(INFO, settings=settings)) as writer:
        writer.append_frame(stored_frames()[0])
    assert is_simulated(TumFolder(tmp_path / "take").info) == bool(settings)


@pytest.mark.parametrize(
    ("unit_m", "raw", "expected"), [(1e-3, 13107, 65535), (1e-3, 13108, 0), (1e-4, 3, 2), (2e-4, 7, 7)]
)
def test_to_tum_depth_converts_units(unit_m: float, raw: int, expected: int) -> None:
    assert to_tum_depth(np.full((1, 1), raw, np.uint16), unit_m)[0, 0] == expected


def test_tum_writer_existing_folder_is_kept(tmp_path: Path) -> None:
    (tmp_path / "take").mkdir()
    with pytest.raises(OutputExists):
        TumWriter(tmp_path / "take", INFO)
    (tmp_path / "file").touch()
    with pytest.raises(OutputNotWritable):
        TumWriter(tmp_path / "file" / "take", INFO)
    writer = TumWriter(tmp_path / "other", INFO)
    writer.discard()
    writer.close()
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["file", "take"]


def test_tum_writer_full_disk_keeps_complete_lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "take"
    writer = TumWriter(path, INFO)
    writer.append_frame(stored_frames()[0])
    before = (path / "rgb.txt").read_bytes()
    monkeypatch.setattr("carpus.core.capture.files.tum.encode_color", lambda *_, **__: b"picture")
    with disk_full_at(len(before) + 5):
        writer.append_frame(stored_frames()[2])
    assert (path / "rgb.txt").read_bytes() == before
    assert len(list((path / "rgb").iterdir())) == 1
    writer.append_frame(stored_frames()[3])  # there is room again
    writer.close()
    assert (path / "rgb.txt").read_bytes() == before + b"10.100000 rgb/10.100000.png\n"

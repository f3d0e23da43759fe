"""Recording as a TUM folder, read back by the TUM reader."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.files.tum import TumFolder, TumWriter, to_tum_depth
from carpus.core.capture.source import SourceInfo, is_simulated
from carpus.core.model.camera import Camera
from carpus.core.model.errors import OutputExists, OutputNotWritable
from carpus.core.model.types import Frame
from tests.capture.oni_samples import HEIGHT, WIDTH, color_picture, depth_picture
from tests.capture.small_disk import disk_full_at

CAMERA = Camera(52.0, 53.0, 31.0, 23.0, WIDTH, HEIGHT, origin="file")
INFO = SourceInfo("Xtion Pro Live", CAMERA, True, None, 30.0)


def frames() -> list[Frame]:
    return [Frame(i, 10.0 + i / 30.0, color_picture(i), None if i == 2 else depth_picture(i), 1e-3) for i in range(5)]


def test_tum_writer_full_disk_keeps_complete_frames(tmp_path: Path) -> None:
    path = tmp_path / "take"
    one, two, three, *_ = frames()
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
        for frame in frames():
            writer.append_frame(frame)
        assert len(writer) == 5
    assert "\n10.000000 depth/10.000000.png\n" in (path / "depth.txt").read_text()
    folder = TumFolder(path)
    assert folder.info.camera == CAMERA
    back = list(folder.frames())
    assert len(back) == 5
    for read, written in zip(back, frames(), strict=True):
        assert np.array_equal(read.color_rgb, written.color_rgb)
        assert read.timestamp_s == pytest.approx(written.timestamp_s, abs=1e-6)
        assert (read.depth_raw is None) == (written.depth_raw is None)
        if read.depth_raw is not None and written.depth_raw is not None:
            assert np.array_equal(read.depth_raw, written.depth_raw * 5)
            assert read.depth_raw[0, 0] * read.depth_unit_m == pytest.approx(written.depth_raw[0, 0] * 1e-3)


@pytest.mark.parametrize("settings", [{}, {"simulated": "yes"}])
def test_tum_writer_keeps_simulated_remark(tmp_path: Path, settings: dict[str, str]) -> None:
    with TumWriter(tmp_path / "take", replace(INFO, settings=settings)) as writer:
        writer.append_frame(frames()[0])
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
    writer.append_frame(frames()[0])
    before = (path / "rgb.txt").read_bytes()
    monkeypatch.setattr("carpus.core.capture.files.tum.encode_color", lambda *_, **__: b"picture")
    with disk_full_at(len(before) + 5):
        writer.append_frame(frames()[2])
    assert (path / "rgb.txt").read_bytes() == before
    assert len(list((path / "rgb").iterdir())) == 1
    writer.append_frame(frames()[3])  # there is room again
    writer.close()
    assert (path / "rgb.txt").read_bytes() == before + b"10.100000 rgb/10.100000.png\n"

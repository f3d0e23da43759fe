"""The ROS camera file: what is written is read back, and by a plain YAML reader too."""

from __future__ import annotations

import inspect
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from carpus.core.capture.camera_info import StoredCalibration, read_camera_info, write_camera_info
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import D435, PRIMESENSE
from carpus.core.model.errors import CameraFileUnreadable, OutputExists, OutputNotWritable

CAMERA = Camera(570.3, 571.9, 314.2, 235.1, 640, 480, (0.041, -0.12, 1e-5, -3e-4, 0.07), origin="file")

ROS_FILE = """\
image_width: 640
image_height: 480
camera_name: rgb_PS1080
camera_matrix:
  rows: 3
  cols: 3
  data: [537.5, 0, 321.25, 0, 538.0, 240.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [1e-05, -2.5e-1, 0.001, -0.002, 0.0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
registered: true
mirrored: false
"""


EIGHT = (0.5, -0.3, 1e-5, -3e-4, 0.1, 0.4, -0.2, 0.05)
WIDE = replace(CAMERA, distortion=EIGHT, distortion_model="rational_polynomial")
INVERSE = replace(CAMERA, distortion_model="inverse_brown_conrady")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "camera_info.yaml"


@pytest.mark.parametrize("camera", [CAMERA, WIDE, INVERSE], ids=lambda camera: camera.distortion_model)
def test_camera_info_written_file_is_read_back_exactly(path: Path, camera: Camera) -> None:
    write_camera_info(path, camera, registered=True)
    info = read_camera_info(path)
    assert info.camera == camera
    assert (info.registered, info.mirrored) == (True, None)


def test_camera_info_without_sensor_assumes_primesense(path: Path) -> None:
    named, silent = path.with_name("b.yaml"), path.with_name("c.yaml")
    write_camera_info(path, replace(CAMERA, sensor=D435.with_focal(600.0)))
    assert read_camera_info(path).camera.sensor == D435.with_focal(600.0)
    write_camera_info(silent, CAMERA)
    assert "depth_sensor" not in silent.read_text()
    assert read_camera_info(silent).camera.sensor == replace(PRIMESENSE, origin="assumed")
    named.write_text(ROS_FILE + "depth_sensor: d435\n")
    assert read_camera_info(named).camera.sensor == D435
    for wrong in ("x1", "[1, 2]", "{name: mine, kind: radar}", "{name: mine, reading: 3, stays: {}}"):
        named.write_text(ROS_FILE + f"depth_sensor: {wrong}\n")
        with pytest.raises(CameraFileUnreadable, match="depth_sensor"):
            read_camera_info(named)


def test_camera_info_damaged_calibration_raises(path: Path) -> None:
    write_camera_info(path, CAMERA, calibration=StoredCalibration("77", "2026-11-20T09:00:00+00:00", pictures=12))
    whole = path.read_text()
    for old, new in (
        ("2026-11-20", "2026-99-20"),
        ("pictures: 12", "pictures: .inf"),
        ("width: 640", f"width: {10**400}"),
    ):
        assert old in whole
        path.write_text(whole.replace(old, new))
        with pytest.raises(CameraFileUnreadable):
            read_camera_info(path)


def test_camera_info_ros_file_is_read(path: Path) -> None:
    path.write_text(ROS_FILE)
    info = read_camera_info(path)
    expected = Camera(537.5, 538.0, 321.25, 240.5, 640, 480, (1e-5, -0.25, 0.001, -0.002, 0.0), origin="file")
    assert info.camera == expected
    assert (info.registered, info.mirrored) == (True, False)


@pytest.mark.parametrize(
    ("old", "new", "fact"),
    [
        ("image_width: 640", "", "image_width"),
        ("image_height: 480", "image_height: tall", "image_height"),
        ("plumb_bob", "equidistant", "distortion_model equidistant, plumb_bob or rational_polynomial"),
        ("0, 0, 1]\ndist", "0, 0]\ndist", "8 numbers"),
        ("[537.5,", "[-537.5,", "camera_matrix"),
        ("[537.5,", "[0.5375,", "do not fit a frame"),
        ("[537.5,", "[wide,", "camera_matrix"),
        ("0.0]\nrect", "0.0\nrect", "not YAML, line"),
        ("[1e-05, -2.5e-1, 0.001,", "[", "2 numbers"),
        ("[1e-05, -2.5e-1, 0.001,", "[30.0, 0.0, 0.001,", "do not describe a lens"),
        ("registered: true", "registered: perhaps", "registered"),
        ("image_width: 640", "\timage_width: 640", "YAML"),
    ],
)
def test_camera_info_invalid_value_is_named_in_fault(path: Path, old: str, new: str, fact: str) -> None:
    assert old in ROS_FILE
    path.write_text(ROS_FILE.replace(old, new))
    with pytest.raises(CameraFileUnreadable) as caught:
        read_camera_info(path)
    assert fact in caught.value.detail
    assert caught.value.subject == str(path)


@pytest.mark.parametrize("content", [b"just words", b"- 1\n- 2\n", b"\xff\xfe\x00", b"#" * 2_000_000])
def test_camera_info_other_content_raises(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    with pytest.raises(CameraFileUnreadable):
        read_camera_info(path)


def test_camera_info_nested_without_end_raises(path: Path) -> None:
    path.write_text("[" * 300)
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack(0)) + 150)  # a thousand deep takes seconds
    try:
        with pytest.raises(CameraFileUnreadable, match="not YAML"):
            read_camera_info(path)
    finally:
        sys.setrecursionlimit(limit)


def test_camera_info_existing_file_is_kept(path: Path) -> None:
    path.write_text("mine")
    with pytest.raises(OutputExists):
        write_camera_info(path, CAMERA)
    assert path.read_text() == "mine"
    with pytest.raises(OutputNotWritable):
        write_camera_info(path / "nowhere.yaml", CAMERA)

"""The parts of the capture path that need no library: pairing, frames from pictures, faults from the system's facts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.capture.devices import cameras, openni2_camera
from carpus.core.capture.devices.cameras import UsbCamera, find_usb_cameras
from carpus.core.capture.devices.openni2 import OpenNI2Error, VideoFrame
from carpus.core.capture.devices.openni2_camera import MODELS, frame_size_bytes
from carpus.core.capture.frame_assembly import (
    PAIRING_TOLERANCE_US,
    FrameAssembler,
    StreamLayout,
    camera_from_field_of_view,
)
from carpus.core.capture.source import PixelFormat, Sensor, VideoMode
from carpus.core.model.errors import CameraBusy, CameraMissing, CameraPermission, CarpusFault, DriverFailed
from carpus.core.model.types import Frame

PERIOD_US = 33_333


LAYOUT = StreamLayout((6, 4), (6, 4))


def feed(assembler: FrameAssembler, kind: str, time_us: int, number: int = 1) -> list[Frame]:
    """Feed an image; depth has the value of its turn, by which it is found again."""
    view = np.zeros((4, 6, 3), np.uint8) if kind == "color" else np.full((4, 6), number, np.uint16)
    return assembler.add(Sensor.COLOR if kind == "color" else Sensor.DEPTH, time_us, number, view)


def pair_images(events: list[tuple[str, int]], limit: int = 4, start_limit: int = 0) -> list[tuple[int, int | None]]:
    """Times of colour pictures and their depth, fed in this order."""
    assembler, out = FrameAssembler(LAYOUT, PERIOD_US, limit, start_limit), []
    for turn, (kind, time_us) in enumerate(events):
        out += feed(assembler, kind, time_us, 0 if kind == "color" else turn)
    out += assembler.finish()
    depth_us = [None if one.depth_raw is None else events[int(one.depth_raw[0, 0])][1] for one in out]
    return [(round(1e6 * frame.timestamp_s), at) for frame, at in zip(out, depth_us, strict=True)]


def test_frame_assembler_skips_colour_without_depth_at_start_only() -> None:
    events = [("color", 0), ("color", 33_000), ("depth", 66_000), ("color", 66_000), ("color", 99_000)]
    assert pair_images(events, start_limit=5) == [(66_000, 66_000), (99_000, None)]
    assert pair_images(events, start_limit=0)[0] == (0, None)


@given(
    st.lists(st.integers(1, 50_000), min_size=1, max_size=30),
    st.lists(st.integers(1, 50_000), min_size=0, max_size=30),
    st.integers(-20_000, 20_000),
)
def test_frame_assembler_uses_each_colour_once_and_depth_at_most_once(
    color: list[int], depth: list[int], shift: int
) -> None:
    events = [("color", int(t)) for t in np.cumsum(color)] + [("depth", int(t) + shift) for t in np.cumsum(depth)]
    pairs = pair_images(sorted(events, key=lambda event: event[1]), limit=100)
    assert [time_us for time_us, _ in pairs] == [int(t) for t in np.cumsum(color)]
    used = [partner for _, partner in pairs if partner is not None]
    assert len(used) == len(set(used))
    assert used == sorted(used)
    assert all(abs(time_us - partner) <= PAIRING_TOLERANCE_US for time_us, partner in pairs if partner is not None)


def color_of(value: int) -> np.ndarray:
    return np.full((4, 6, 3), value, np.uint8)


def test_frame_assembler_counts_gaps_and_survives_clock_restart() -> None:
    layout = StreamLayout((6, 4), None)
    assembler = FrameAssembler(layout, PERIOD_US, 4)
    frames = []
    for number, time_us in ((1, 0), (2, PERIOD_US), (5, 4 * PERIOD_US), (6, 4 * PERIOD_US)):
        frames += assembler.add(Sensor.COLOR, time_us, number, color_of(number))
    assert [frame.dropped_before for frame in frames] == [0, 0, 2]
    assembler.restart(layout, first_us=7_000, gap_us=1_000_000)
    frames += assembler.add(Sensor.COLOR, 7_000, 1, color_of(9))
    frames += assembler.add(Sensor.COLOR, 7_000 + PERIOD_US, 2, color_of(10))
    assert [frame.index for frame in frames] == [0, 1, 2, 3, 4]
    times_s = np.array([frame.timestamp_s for frame in frames])
    assert np.diff(times_s) == pytest.approx([0.033333, 0.099999, 1.0, 0.033333])
    assert [frame.dropped_before for frame in frames[3:]] == [29, 0]
    slow = FrameAssembler(layout, 1e6, 4)
    frames = slow.add(Sensor.COLOR, 0, 1, color_of(1)) + slow.add(Sensor.COLOR, PERIOD_US, 4, color_of(2))
    assert frames[1].dropped_before == 2, "by number, where times do not tell"


@pytest.mark.parametrize("mirrored", [False, True])
def test_stream_layout_enlarges_depth_by_repetition(mirrored: bool) -> None:
    layout = StreamLayout((8, 6), (4, 3), False, mirrored)
    small = np.arange(12, dtype=np.uint16).reshape(3, 4)
    large = layout.convert_depth(small)
    assert large.shape == (6, 8)
    expected = small[:, ::-1] if mirrored else small
    assert (large == expected.repeat(2, 0).repeat(2, 1)).all()
    assert layout.format_enlargement == "depth from 4x3 to 8x6"
    assert layout.describe_size_mismatch() == ""


MODE = VideoMode(PixelFormat.RGB888, 64, 48, 30)


def picture(**changes: int | bool) -> VideoFrame:
    frame = VideoFrame(
        sensor=Sensor.COLOR, index=1, timestamp_us=1, width_px=64, height_px=48, stride_bytes=192, size_bytes=9216,
        address=4096,
    )  # fmt: skip
    frame.mode.pixel_format = PixelFormat.RGB888
    for name, value in changes.items():
        setattr(frame.mode if name == "pixel_format" else frame, name, value)
    return frame


@pytest.mark.parametrize(
    "changes",
    [
        {"size_bytes": 9215}, {"size_bytes": 614392}, {"width_px": 60000, "height_px": 60000}, {"stride_bytes": 64},
        {"pixel_format": PixelFormat.YUV422}, {"pixel_format": 12345}, {"is_cropped": True}, {"address": 0},
        {"height_px": 47},
    ],
)  # fmt: skip
def test_frame_size_bytes_only_of_expected_mode(changes: dict[str, int]) -> None:
    assert frame_size_bytes(picture(), MODE) == 9216
    assert frame_size_bytes(picture(**changes), MODE) is None
    assert frame_size_bytes(picture(pixel_format=999), VideoMode(999, 64, 48, 30)) is None


def test_find_usb_cameras_reads_sysfs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A made-up bus with one camera that a program holds, and something else."""
    device, driver, node = tmp_path / "sys" / "1-2", tmp_path / "usbfs", tmp_path / "001" / "007"
    for folder in (device / "1-2:1.0", driver, node.parent, tmp_path / "sys" / "usb1"):
        folder.mkdir(parents=True)
    facts = {"idVendor": "1d27", "idProduct": "0601", "busnum": "1", "devnum": "7", "speed": "480"}
    for name, text in facts.items():
        (device / name).write_text(text + "\n")
    (device / "1-2:1.0" / "driver").symlink_to(driver)
    (tmp_path / "sys" / "usb1" / "idVendor").write_text("1d6b\n")
    node.touch()
    monkeypatch.setattr(cameras, "SYSFS", tmp_path / "sys")
    monkeypatch.setattr(cameras, "DEVICE_NODES", tmp_path)
    (camera,) = find_usb_cameras(MODELS)
    assert camera == UsbCamera("Asus Xtion Pro Live", "1d27", "0601", node, 480, True, True)


def seen(**changes: bool) -> UsbCamera:
    values = {"can_open": True, "is_claimed": False, **changes}
    return UsbCamera("Asus Xtion Pro Live", "1d27", "0601", Path("/dev/bus/usb/001/007"), 480, **values)


@pytest.mark.parametrize(
    ("connected", "reason", "fault"),
    [
        ([], "no devices found", CameraMissing),
        ([seen(can_open=False)], "Failed to open the USB device!", CameraPermission),
        ([seen(is_claimed=True)], "Error!", CameraBusy),
        ([seen()], 'Could not open "1d27/0601@3/4": Failed to set USB interface!', CameraBusy),
        ([seen()], "USB transfer timeout!", DriverFailed),
    ],
)
def test_open_error_tells_the_cause(connected: list[UsbCamera], reason: str, fault: type[CarpusFault]) -> None:
    failed = openni2_camera._open_error(OpenNI2Error("oniDeviceOpen", 1, reason), connected)
    assert type(failed) is fault


def test_camera_from_field_of_view_has_its_focal_length() -> None:
    # the angles an Asus Xtion tells: f = 570.34 px
    camera = camera_from_field_of_view((640, 480), (1.02260, 0.79662))
    assert camera is not None
    assert camera.fx_px == pytest.approx(570.34, abs=0.05)
    assert camera.fy_px == pytest.approx(570.34, abs=0.05)
    assert (camera.cx_px, camera.cy_px, camera.origin) == (319.5, 239.5, "driver")
    assert camera_from_field_of_view((640, 400), None) is None

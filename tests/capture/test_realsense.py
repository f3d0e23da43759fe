"""RealSense without a camera: the maker's own library with its software device, recorder and player."""

from __future__ import annotations

import multiprocessing
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from importlib.metadata import PackageNotFoundError
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

import carpus
from carpus.app.sources import open_recording
from carpus.core.capture.devices import realsense
from carpus.core.capture.devices.cameras import (
    UsbCamera,
    camera_open_error,
    camera_unlisted_error,
    check_firmware_and_usb,
    open_camera,
)
from carpus.core.capture.devices.color_lock import MAX_ROUNDS, ColorController, ColorStatistics
from carpus.core.capture.devices.process_camera import ProcessCamera
from carpus.core.capture.doctor import check_open_camera
from carpus.core.capture.files.realsense_recording import RealSenseRecording
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.errors import (
    CameraBusy,
    CameraLost,
    CameraMismatch,
    CameraMissing,
    CameraPermission,
    CameraReturned,
    CarpusFault,
    DriverFailed,
    ExtraMissing,
    RecordingDamaged,
)
from carpus.core.model.fault_text import format_fault_line
from tests.capture import fake_realsense
from tests.capture.fake_realsense import DEPTH_FX, EDGE_PX, FX, HEIGHT, NEAR_MM, SHIFT_M, WIDTH
from tests.capture.reconnection import assert_reconnects
from tests.rendered import FLEXION, Rendered

FRAMES = 24
EDGE_X = (EDGE_PX - 0.5 - (WIDTH - 1) / 2) / DEPTH_FX
"""Where the edge of the plane lies, of its depth."""


def record_take(take: Path, path: Path) -> None:
    source = TumFolder(take)
    fake_realsense.record(path, islice(source.frames(), FRAMES), source.info.camera.fx_px)
    source.close()


@pytest.fixture(scope="module")
def folder(rendered: Rendered) -> Path:
    return rendered(FLEXION)


@pytest.fixture(scope="module")
def take(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The simulated recording as the maker's library stores it."""
    path = tmp_path_factory.mktemp("realsense") / "take.db3"
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as other:
        other.submit(record_take, folder, path).result()
    return path


def test_realsense_recording_tracks_like_its_folder(take: Path, folder: Path) -> None:
    source = open_recording(take)
    assert isinstance(source, RealSenseRecording)
    info = source.info
    assert (info.frame_count, info.has_depth, info.nominal_fps) == (FRAMES, True, 30.0)
    assert (info.camera.origin, info.camera.distortion_model) == ("factory", "plumb_bob")
    assert (info.settings["serial"], info.settings["clock"]) == ("815412070123", "camera")
    assert info.camera.sensor.kind == "active stereo"
    made_of = TumFolder(folder)
    for stored, made in zip(source.frames(), made_of.frames(), strict=False):
        assert stored.timestamp_s == pytest.approx(made.timestamp_s, abs=1e-5)
        assert np.array_equal(stored.color_rgb, made.color_rgb)
        assert stored.depth_raw is not None
        assert made.depth_raw is not None
        off_m = np.abs(stored.depth_raw * stored.depth_unit_m - made.depth_raw * made.depth_unit_m)
        assert off_m.max() < 0.6e-3
    made_of.close()
    assert len(list(source.frames())) == FRAMES, "a second walk"
    source.close()
    assert list(source.frames()) == []
    tracked = list(carpus.track(take, folder / "calibration.json"))
    assert [frame.status for frame in tracked] == ["tracked"] * FRAMES


def test_realsense_recording_other_or_truncated_file_raises(take: Path, tmp_path: Path) -> None:
    whole = take.read_bytes()
    for content in (b"no database", b"", whole[: len(whole) // 2]):
        (tmp_path / "a.db3").write_bytes(content)
        with pytest.raises(RecordingDamaged):
            list(open_recording(tmp_path / "a.db3").frames())


@pytest.fixture
def camera(tmp_path: Path, notices: list[CarpusFault]) -> Iterator[ProcessCamera]:
    context = partial(fake_realsense.plug_in, tmp_path)
    source = replace(realsense.KIND, make_context=context).open(notice=notices.append)
    yield source
    source.close()


@pytest.mark.usefixtures("short_retry")
def test_realsense_camera_lost_reconnects(camera: ProcessCamera, notices: list[CarpusFault], tmp_path: Path) -> None:
    info = camera.info
    assert (info.name, info.settings["preset"], info.settings["emitter"]) == (
        "Intel RealSense D435", "high accuracy", "on",
    )  # fmt: skip
    assert info.settings["registered"] == "by the library"
    assert info.camera.sensor.name == "RealSense D435"
    frames = camera.frames()
    first = list(islice(frames, 8))
    for frame in first:
        assert frame.color_rgb.shape == (480, 640, 3)
        assert frame.depth_raw is not None
        assert set(np.unique(frame.depth_raw)) == {0, NEAR_MM}
        edge_px = np.argmax(frame.depth_raw[HEIGHT // 2] > 0)
        assert edge_px == pytest.approx((WIDTH - 1) / 2 + FX * (EDGE_X + SHIFT_M / (NEAR_MM / 1000.0)), abs=1.0)
        assert frame.depth_unit_m == 1e-3
    assert_reconnects(camera, frames, first, notices, tmp_path / "unplugged", tmp_path / "crash")


@pytest.mark.usefixtures("short_retry")
def test_realsense_camera_mismatch_is_notified_and_waits(
    camera: ProcessCamera, notices: list[CarpusFault], tmp_path: Path
) -> None:
    frames = camera.frames()
    next(frames)
    (tmp_path / "other").touch()
    (tmp_path / "crash").touch()

    def put_back(fault: CarpusFault) -> None:
        notices.append(fault)
        if isinstance(fault, CameraMismatch):
            (tmp_path / "other").unlink()

    camera._notice = put_back
    for _ in frames:  # the crash takes a moment; pictures of before may still come
        if notices and isinstance(notices[-1], CameraReturned):
            break
    assert [type(fault) for fault in notices] == [CameraLost, CameraMismatch, CameraReturned]
    assert format_fault_line(notices[1]).startswith(
        "A different camera is connected (Intel RealSense D435 815412070124). "
        "Carpus expects Intel RealSense D435 815412070123."
    )


def test_realsense_open_by_serial_tells_the_cause() -> None:
    def seen(name: str, *, can_open: bool = True, is_claimed: bool = False) -> UsbCamera:
        return UsbCamera(name, "8086", "0b07", Path("/dev/bus/usb/001/007"), 5000, can_open, is_claimed)

    wanted, other = seen("D435"), "D435 815412070124"
    assert type(camera_unlisted_error([], [])) is CameraMissing
    assert type(camera_unlisted_error([wanted], [other])) is CameraMismatch
    assert type(camera_unlisted_error([wanted, seen("D435", can_open=False)], [other])) is CameraPermission
    assert type(camera_unlisted_error([wanted, seen("D435", is_claimed=True)], [other])) is CameraBusy
    assert type(camera_unlisted_error([wanted], [])) is DriverFailed
    assert type(camera_open_error("errno=16 Last Error: Device or resource busy", [wanted])) is CameraBusy
    assert type(camera_open_error("failed to open interface, RS2_USB_STATUS_ACCESS", [wanted])) is CameraPermission
    assert type(camera_open_error("hwmon command timed out", [seen("D435", is_claimed=True)])) is DriverFailed


def test_realsense_color_lock_keeps_colours(camera: ProcessCamera, notices: list[CarpusFault]) -> None:
    frames = camera.frames()
    before = next(frames).color_rgb.mean(axis=(0, 1))
    camera.lock_exposure()
    after = before * 0.0
    for frame in islice(frames, 60):
        after = frame.color_rgb.mean(axis=(0, 1))
    assert notices == []
    assert after == pytest.approx(before, rel=0.04)


@pytest.mark.parametrize(
    ("true", "slope"),
    [((60.0, 3500.0), 1.0 / 8000.0), ((300.0, 5000.0), -1.0 / 3000.0), ((120.0, 6000.0), 1.0 / 8000.0)],
)
def test_color_controller_finds_matching_settings(true: tuple[float, float], slope: float) -> None:
    def look(exposure: float, kelvin: float) -> ColorStatistics:
        return ColorStatistics(80.0 * exposure / true[0], slope * (kelvin - true[1]))

    exposure, kelvin = 156.0, 4600.0
    hold = ColorController(look(*true), exposure, (1.0, 320.0), kelvin, (2800.0, 6500.0))
    for _ in range(10 * MAX_ROUNDS):
        step = hold.update(look(exposure, kelvin))
        if step is not None:
            exposure, kelvin = step.exposure, step.kelvin
    assert hold.is_done
    assert hold.has_converged
    assert exposure == pytest.approx(true[0], rel=0.03)


def test_realsense_doctor_opens_camera(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    context = partial(fake_realsense.plug_in, tmp_path)
    monkeypatch.setattr(realsense, "KIND", replace(realsense.KIND, make_context=context))
    findings = {each.name: each for each in check_open_camera("realsense", 0.5)}
    assert {"Frames", "Mirror"} <= findings.keys()
    assert findings["Depth registration"].observation == "depth and colour are aligned, by the library"
    assert findings["Firmware"].state == "warning"
    assert findings["USB"].state == "good"


def test_realsense_doctor_checks_driver_and_settings(monkeypatch: pytest.MonkeyPatch) -> None:
    states = {
        each.name: each.state
        for each in check_firmware_and_usb({"firmware": "5.12.1.0", "firmware_wanted": "5.16.0.1", "usb": "2.1"})
    }
    assert states == {"Firmware": "warning", "USB": "warning"}
    assert {each.state for each in check_firmware_and_usb({"firmware": "5.16.0.1", "usb": "3.2"})} == {"good"}

    def missing(name: str) -> str:
        raise PackageNotFoundError(name)

    monkeypatch.setattr("importlib.metadata.version", missing)
    assert realsense.KIND.check_driver(True, False) is None, "no obstacle, and nothing to tick"
    found = realsense.KIND.check_driver(True, True)
    assert found is not None
    assert (found.state, found.remedy) == ("bad", f"Run “{sys.executable} -m pip install pyrealsense2”.")
    with pytest.raises(ExtraMissing) as notices:
        open_camera("realsense:7")
    assert format_fault_line(notices.value).endswith("-m pip install pyrealsense2”. (C-001)")

"""The examination: what is good is said to be, what is not comes with a remedy."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture import doctor
from carpus.core.capture.devices import openni2_camera, realsense
from carpus.core.capture.devices.cameras import CameraKind, UsbCamera, load_camera_kind
from carpus.core.capture.doctor import examine
from carpus.core.capture.source import SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.errors import CameraBusy, DriverMissing
from carpus.core.model.installation import Finding
from carpus.core.model.types import Frame


def test_examine_with_dummy_camera_checks_everything(tmp_path: Path) -> None:
    found = examine(tmp_path / "data", camera_uri="xtion:Dummy", measure_s=0.5)
    findings = {finding.name: finding for finding in found}
    assert list(findings) == [
        "Python", "Packages", "Compiled parts", "Window", "Fonts", "Data folder", "Disk", "Disk encryption",
        "Driver", "RealSense driver", "Orbbec driver", "Camera permissions, Asus Xtion", "Camera", "Frames",
        "Depth registration", "Mirror", "Clock",
    ]  # fmt: skip
    for name in ("Python", "Packages", "Fonts", "Data folder", "Driver", "Camera permissions, Asus Xtion"):
        assert findings[name].state == "good", findings[name]
    assert "OpenNI2 2.2" in findings["Driver"].observation
    assert "320x240" in findings["Frames"].observation
    assert not (tmp_path / "data").exists()
    assert all((finding.state == "good") == (finding.remedy == "") for finding in findings.values())


def test_check_packages_missing_one_is_bad(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "PACKAGES", ("numpy", "none-such"))
    remedy = f"Run “{sys.executable} -m pip install none-such”."
    assert doctor.check_packages() == Finding("Packages", "bad", "missing: none-such", remedy)


def test_check_window_aborting_qt_is_bad(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "version", lambda name: "6.12.0")
    monkeypatch.setattr(doctor.sys, "version_info", (3, 11, 7))
    assert doctor.check_window().state == "bad"


def test_check_data_folder_reports_readers_and_lack_of_rights(tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    finding = doctor.check_data_folder(tmp_path)
    assert (finding.state, "chmod 700" in finding.remedy) == ("warning", True)
    tmp_path.chmod(0o700)
    assert doctor.check_data_folder(tmp_path).state == "good"
    (tmp_path / "file").touch()
    assert doctor.check_data_folder(tmp_path / "file" / "data").state == "bad"


def test_check_disk_space_low_warns(tmp_path: Path) -> None:
    assert doctor.check_disk_space(tmp_path, 1_000_000_000).state == "warning"
    finding = doctor.check_disk_space(tmp_path, 60_000_000_000)
    assert (finding.state, finding.observation) == ("good", "60.0 GB free, about 545 minutes with video")


def test_check_driver_missing_library_is_bad(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> None:
        raise DriverMissing("libOpenNI2.so.0", "cannot open shared object file")

    monkeypatch.setattr(openni2_camera, "load_library", missing)
    finding = openni2_camera.check_driver(True, True)
    assert (finding.state, finding.observation) == ("bad", "cannot open shared object file")
    assert "libopenni2-0" in finding.remedy


def test_check_udev_rules_finds_vendor_and_product(tmp_path: Path) -> None:
    assert doctor.check_udev_rules(openni2_camera.KIND, (tmp_path / "none", tmp_path)).state == "warning"
    (tmp_path / "60-camera.rules").write_text('SUBSYSTEM=="usb", ATTR{idVendor}=="1D27", MODE="0666"\n')
    assert doctor.check_udev_rules(openni2_camera.KIND, (tmp_path,)).state == "good"
    assert doctor.check_udev_rules(load_camera_kind("orbbec"), (tmp_path,)).state == "warning"
    (tmp_path / "70-graphics.rules").write_text('SUBSYSTEM=="drm", ATTRS{vendor}=="0x8086"\n')
    assert doctor.check_udev_rules(load_camera_kind("realsense"), (tmp_path,)).state == "warning"


@pytest.mark.parametrize(
    ("speed", "can_open", "claimed", "state"),
    [(480, True, False, "good"), (480, False, False, "bad"), (480, True, True, "warning"), (12, True, False, "bad")],
)
def test_check_camera_reports_rights_use_and_speed(speed: int, can_open: bool, claimed: bool, state: str) -> None:
    camera = UsbCamera("Asus Xtion Pro Live", "1d27", "0601", Path("/dev/bus/usb/001/007"), speed, can_open, claimed)
    finding = doctor.check_camera(openni2_camera.KIND, camera)
    assert finding.state == state
    assert "1d27:0601" in finding.observation


def frames(period_s: float, *, missing: int = 0, depth: bool = True) -> list[Frame]:
    color, distance = np.zeros((480, 640, 3), np.uint8), np.zeros((480, 640), np.uint16)
    return [Frame(i, i * period_s, color, distance if depth else None, 1e-3, missing) for i in range(10)]


@pytest.mark.parametrize(
    ("some", "state"),
    [
        (frames(1 / 30), "good"),
        (frames(1 / 30, missing=1), "warning"),
        (frames(1 / 25), "warning"),
        (frames(1 / 15), "bad"),
        (frames(1 / 30, depth=False), "bad"),
        ([], "bad"),
    ],
)
def test_check_frames_reports_rate_gaps_and_depth(some: list[Frame], state: str) -> None:
    assert doctor.check_frames(some).state == state


@pytest.mark.parametrize(
    ("settings", "states"),
    [
        ({"registered": "by the camera", "mirrored": "no"}, ["good", "good", "good"]),
        ({"registered": "no", "mirrored": "turned back"}, ["warning", "good", "good"]),
        ({"registered": "by the driver", "clock": "computer"}, ["good", "good", "warning"]),
    ],
)
def test_check_camera_settings_reports_registration_mirror_and_clock(
    settings: dict[str, str], states: list[str]
) -> None:
    info = SourceInfo("a camera", DEFAULT_CAMERA, True, None, 30.0, settings)
    some = frames(1 / 30)
    findings = doctor.check_camera_settings(info, some, [frame.timestamp_s for frame in some])
    assert [finding.name for finding in findings] == ["Depth registration", "Mirror", "Clock"]
    assert [finding.state for finding in findings] == states
    assert doctor.check_clock(1.5, 3.0, "camera").state == "warning", "it drifts"


def test_check_open_camera_fault_is_a_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    def busy(*_: object, **__: object) -> None:
        raise CameraBusy("camera", "Failed to set USB interface!")

    monkeypatch.setattr(doctor, "open_camera", busy)
    (finding,) = doctor.check_open_camera("", 1.0)
    assert (finding.state, finding.remedy) == ("bad", "Close the other program that uses the camera.")


def test_check_drivers_unneeded_library_is_no_obstacle(monkeypatch: pytest.MonkeyPatch) -> None:
    def lacking(_asks_version: bool, _wanted: bool) -> Finding:
        return Finding("Driver", "bad", "not found", "Install it.")

    there = UsbCamera("Intel RealSense D435", "8086", "0b07", Path("/dev/bus/usb/002/003"), 480, True, False)
    without = replace(openni2_camera.KIND, check_driver=lacking)
    monkeypatch.setattr(CameraKind, "find_connected", lambda kind: [there] if kind is realsense.KIND else [])
    monkeypatch.setattr(doctor, "_camera_kinds", lambda: [without, realsense.KIND])
    assert [each.state for each in doctor.check_drivers(loads_library=False)] == ["warning", "good"]
    monkeypatch.setattr(doctor, "_camera_kinds", lambda: [without])
    assert [each.state for each in doctor.check_drivers(loads_library=False)] == ["bad"]
    slow = doctor.check_camera(realsense.KIND, there)
    assert (slow.state, "USB 3" in slow.remedy) == ("warning", True)

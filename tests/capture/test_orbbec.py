"""Orbbec's newer cameras without a camera: the maker's own library with its player in place of the bus."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy as np
import pytest

from carpus.core.capture.devices import orbbec
from carpus.core.capture.devices.capture_process import CameraConfig
from carpus.core.capture.devices.orbbec import (
    choose_streams,
    find_device,
    find_sensor,
    import_sdk,
)
from carpus.core.capture.devices.process_camera import ProcessCamera
from carpus.core.model.depth_sensor import AZURE_KINECT
from carpus.core.model.errors import (
    CameraBusy,
    CameraMismatch,
    CameraMissing,
    CameraUnsuited,
    CarpusFault,
)
from tests.capture import fake_orbbec
from tests.capture.fake_orbbec import BENT, DEPTH_FX, EDGE_PX, NEAR_MM, SERIAL, SHIFT_MM, FakeDeviceList
from tests.capture.reconnection import assert_reconnects


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("orbbec") / "plane.bag"
    fake_orbbec.record(path)
    return path


@pytest.fixture
def camera(
    tmp_path: Path, bag: Path, notices: list[CarpusFault], monkeypatch: pytest.MonkeyPatch
) -> Iterator[ProcessCamera]:
    monkeypatch.chdir(tmp_path)
    context = partial(fake_orbbec.plug_in, tmp_path, bag)
    source = replace(orbbec.KIND, make_context=context).open(notice=notices.append)
    yield source
    source.close()
    assert not (tmp_path / "Log").exists(), "the library keeps logs where the program was started"


@pytest.mark.usefixtures("short_retry")
def test_orbbec_camera_lost_reconnects(camera: ProcessCamera, notices: list[CarpusFault], tmp_path: Path) -> None:
    info = camera.info
    lens = info.camera
    assert (info.name, info.settings["serial"]) == ("Orbbec Femto Bolt(Playback)", SERIAL)
    assert (info.settings["firmware"], info.settings["usb"], info.settings["shrunk"]) == (
        "1.0.9",
        "3.2",
        "2 pixels to one",
    )
    assert info.camera.sensor == AZURE_KINECT
    assert (lens.width_px, lens.height_px, lens.fx_px, lens.cx_px) == (640, 480, 525.0, 319.5)
    assert (lens.distortion_model, lens.origin) == ("rational_polynomial", "factory")
    assert lens.distortion == pytest.approx(BENT)
    frames = camera.frames()
    first = list(islice(frames, 8))
    depth_m = NEAR_MM / 1000.0
    edge_m = (EDGE_PX - 0.5 - (320 - 1) / 2) / DEPTH_FX * depth_m + SHIFT_MM / 1000.0
    for frame in first:
        assert frame.color_rgb.shape == (480, 640, 3)
        assert frame.depth_raw is not None
        assert set(np.unique(frame.depth_raw)) == {0, NEAR_MM}
        assert frame.depth_unit_m == 1e-3
        for row in (90, 240, 400):
            seen = lens.undistort(np.array([[np.argmax(frame.depth_raw[row] > 0) - 0.5, row]]))
            assert lens.backproject(seen, np.array([depth_m]))[0, 0] == pytest.approx(edge_m, abs=2 * depth_m / 525.0)
    assert_reconnects(camera, frames, first, notices, tmp_path / "unplugged")
    assert notices[0].detail == "unplugged"


def test_orbbec_stand_ins_match_library() -> None:
    ob = import_sdk()
    for stand_in, real in ((FakeDeviceList, ob.DeviceList), (fake_orbbec.FakeContext, ob.Context)):
        names = [name for name in vars(stand_in) if not name.startswith("_")]
        assert [name for name in names if not hasattr(real, name)] == []
    assert ob.Context().query_devices().get_count() == 0


def test_orbbec_find_device_by_serial() -> None:
    ob, state = import_sdk(), import_sdk().OBDeviceAccessState
    free, held = state.OB_DEVICE_ACCESS_STATE_AVAILABLE, state.OB_DEVICE_ACCESS_STATE_EXCLUSIVE

    def found(serials: str, wanted: str, as_it_is: Any = free) -> Any:
        listed = FakeDeviceList({each: each for each in serials}, as_it_is)
        return find_device(ob, SimpleNamespace(query_devices=lambda: listed), CameraConfig(wanted))

    assert found("ab", "") == "a"
    assert found("ab", "b") == "b"
    for serials, wanted, as_it_is, fault in (
        ("", "", free, CameraMissing),
        ("ab", "c", free, CameraMismatch),
        ("a", "", held, CameraBusy),
    ):
        with pytest.raises(fault):
            found(serials, wanted, as_it_is)


def test_orbbec_choose_streams_prefers_wanted_size() -> None:
    ob = import_sdk()

    def chosen(colors: list[tuple[int, int]], depths: list[tuple[int, int]]) -> tuple[int, int, int]:
        def listed(sensor: Any) -> Any:
            is_color = sensor == ob.OBSensorType.COLOR_SENSOR
            profiles = [
                mock.Mock(
                    get_width=lambda width=width: width,
                    get_height=lambda height=height: height,
                    get_fps=lambda: 30,
                    get_format=lambda: ob.OBFormat.RGB if is_color else ob.OBFormat.Y16,
                )
                for width, height in (colors if is_color else depths)
            ]
            for profile in profiles:
                profile.as_video_stream_profile.return_value = profile
            return SimpleNamespace(get_count=lambda: len(profiles), get_stream_profile_by_index=lambda at: profiles[at])

        streams = choose_streams(ob, SimpleNamespace(get_stream_profile_list=listed))
        return streams.color.get_width(), streams.depth.get_width(), streams.downscale

    gemini = [(1280, 720), (848, 480), (640, 480), (640, 360)]
    assert chosen(gemini, [(1280, 800), (848, 480), (640, 480), (424, 240)]) == (640, 640, 1)
    assert chosen([(3840, 2160), (1280, 960), (1280, 720)], [(1024, 1024), (640, 576), (320, 288)]) == (1280, 640, 2)
    for colors, depths in (([(3840, 2160)], [(640, 576)]), (gemini, [])):
        with pytest.raises(CameraUnsuited):
            chosen(colors, depths)


@pytest.mark.parametrize(
    ("name", "kind", "origin"),
    [
        ("Orbbec Femto Mega", "time of flight", "stated"),
        ("Orbbec Gemini 335", "active stereo", "assumed"),
        ("Orbbec Gemini 335L", "active stereo", "assumed"),
    ],
)
def test_orbbec_find_sensor_by_model(name: str, kind: str, origin: str) -> None:
    sensor = find_sensor({"camera": name, "depth_focal_px": "370.0"})
    assert (sensor.kind, sensor.origin) == (kind, origin)
    assert sensor.baseline_m == {"Orbbec Gemini 335": 0.050, "Orbbec Gemini 335L": 0.095}.get(name, 0.0)

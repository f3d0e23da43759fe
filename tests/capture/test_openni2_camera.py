"""The live path against the library's own dummy device: threads, times, stop, restart, loss and return."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from itertools import islice, pairwise

import pytest

from carpus.core.capture.devices.capture_process import CameraConfig, CaptureProcess
from carpus.core.capture.devices.openni2_camera import KIND
from carpus.core.capture.devices.process_camera import ProcessCamera
from carpus.core.model.camera import Camera
from carpus.core.model.errors import (
    CameraFileUnreadable,
    CameraLost,
    CameraMissing,
    CameraReturned,
    CarpusFault,
    DepthNotRegistered,
    DriverFailed,
    DriverMissing,
    ExposureUnstable,
)
from carpus.core.model.types import Frame

PERIOD_S = 0.033


@pytest.fixture
def camera(notices: list[CarpusFault]) -> Iterator[ProcessCamera]:
    source = KIND.open("Dummy", notice=notices.append)
    yield source
    source.close()


def blow(source: ProcessCamera, how: signal.Signals) -> None:
    os.kill(source._process._child.pid, how)


def assert_rising(frames: list[Frame]) -> None:
    assert [frame.index for frame in frames] == list(range(len(frames)))
    assert all(later.timestamp_s > earlier.timestamp_s for earlier, later in pairwise(frames))


def test_openni2_camera_yields_frames(camera: ProcessCamera, notices: list[CarpusFault]) -> None:
    frames = list(islice(camera.frames(), 20))
    for frame in frames:
        assert frame.color_rgb.shape == (240, 320, 3)
        # a busy computer may miss a depth picture
        assert frame.depth_raw is None or frame.depth_raw.shape == (240, 320)
        assert frame.depth_unit_m == 1e-3
        assert not frame.color_rgb.flags.writeable
    assert any(frame.depth_raw is not None for frame in frames)
    for earlier, later in pairwise(frames):
        # in the device's own time, whatever the computer was busy with
        missing = later.dropped_before
        assert later.timestamp_s - earlier.timestamp_s == pytest.approx((missing + 1) * PERIOD_S, abs=1e-6)
    assert [type(fault) for fault in notices] == [DepthNotRegistered]
    again = camera.frames()
    frames += islice(again, 3)
    camera.lock_exposure()
    for frame in islice(again, 10):
        frames.append(frame)
        if isinstance(notices[-1], ExposureUnstable):
            break
    assert_rising(frames)
    assert [type(fault) for fault in notices] == [DepthNotRegistered, ExposureUnstable]


def test_openni2_camera_slow_reader_counts_drops_until_closed(
    camera: ProcessCamera,
) -> None:
    frames, has_all = [], threading.Event()

    def read() -> None:
        for frame in camera.frames():
            frames.append(frame)
            if len(frames) == 2:
                time.sleep(2.0)  # twice what the ring holds
            if len(frames) == 40:
                has_all.set()

    reader = threading.Thread(target=read)
    reader.start()
    assert has_all.wait(60.0)
    camera.close()
    reader.join(20.0)
    assert not reader.is_alive()
    assert_rising(frames)
    lost = sum(frame.dropped_before for frame in frames)
    spanned = round((frames[-1].timestamp_s - frames[0].timestamp_s) / PERIOD_S) + 1
    assert lost > 5
    assert spanned == len(frames) + lost


def test_openni2_camera_hanging_is_restarted_and_close_ends_reconnecting(
    camera: ProcessCamera, notices: list[CarpusFault], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(CaptureProcess.receive_report, "__defaults__", (2.0,))
    frames = []
    for frame in camera.frames():
        frames.append(frame)
        if len(frames) == 5:
            blow(camera, signal.SIGSTOP)
        if len(frames) == 30 and CameraReturned in map(type, notices):
            break
    assert_rising(frames[:30])
    assert [type(fault) for fault in notices] == [DepthNotRegistered, CameraLost, CameraReturned]
    assert "no answer" in notices[1].detail
    steps_s = [later.timestamp_s - earlier.timestamp_s for earlier, later in pairwise(frames)]
    away = max(range(len(steps_s)), key=steps_s.__getitem__)
    # the gap is the time that really passed, and the frames missing in it are counted
    assert steps_s[away] > 2 * PERIOD_S
    assert frames[away + 1].dropped_before == round(steps_s[away] / (1 / 30)) - 1
    blow(camera, signal.SIGKILL)
    rest = camera.frames()
    next(rest)
    assert [type(fault) for fault in notices[3:]] == [CameraLost, CameraReturned], "lost before it was read"
    blow(camera, signal.SIGKILL)
    camera._plan = CameraConfig(uri="1d27/0601@9/9")
    reader = threading.Thread(target=lambda: list(rest))
    reader.start()
    camera.close()
    reader.join(10.0)
    assert not reader.is_alive()


@pytest.mark.usefixtures("short_retry")
def test_openni2_camera_absent_too_long_raises(camera: ProcessCamera, notices: list[CarpusFault]) -> None:
    camera._patience_s = 0.1
    frames = camera.frames()
    next(frames)
    camera._plan = CameraConfig(uri="1d27/0601@9/9")
    blow(camera, signal.SIGKILL)
    with pytest.raises(CameraLost):
        list(frames)
    assert [type(fault) for fault in notices] == [DepthNotRegistered, CameraLost]


def test_openni2_camera_repeated_crash_or_missing_driver_raises(
    camera: ProcessCamera, monkeypatch: pytest.MonkeyPatch
) -> None:
    for fault in (DriverFailed("Dummy", "SIGSEGV"), DriverMissing("libOpenNI2.so.0")):
        waited: list[object] = []

        def crash(fault: CarpusFault = fault) -> Iterator[Frame]:
            raise fault
            yield

        monkeypatch.setattr(camera, "_read_frames", crash)
        monkeypatch.setattr(camera, "_reconnect", lambda lost, waited=waited: waited.append(lost) or 0.0)
        with pytest.raises(type(fault)):
            list(camera.frames())
        assert bool(waited) == isinstance(fault, DriverFailed)


def test_openni2_camera_missing_raises() -> None:
    with pytest.raises(CameraMissing):
        KIND.open("1d27/0601@9/9")


def test_openni2_camera_uses_measured_intrinsics(notices: list[CarpusFault]) -> None:
    measured = Camera(530.0, 531.0, 318.0, 241.0, distortion=(0.1, 0.0, 0.0, 0.0, 0.0), origin="file")
    source = KIND.open("Dummy", camera=measured)
    found = source.info.camera
    source.close()
    assert (found.fx_px, found.cx_px, found.cy_px) == (265.0, (318.5 / 2) - 0.5, (241.5 / 2) - 0.5)
    assert (found.distortion, found.origin) == (measured.distortion, "file")
    with pytest.raises(CameraFileUnreadable):
        KIND.open("Dummy", camera=Camera(500.0, 500.0, 320.0, 256.0, 640, 512))

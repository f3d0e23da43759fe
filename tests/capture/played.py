"""A recording played by a stand-in for a maker's library: in the capture process, as RealSense's is."""

from __future__ import annotations

import threading
from pathlib import Path
from unittest import mock

import numpy as np

from carpus.core.capture.devices.capture_process import CaptureChannel, CaptureProcess, DeviceOpened
from carpus.core.capture.files import realsense_recording
from carpus.core.capture.files.realsense_recording import SLOTS, RealSenseRecording
from carpus.core.capture.source import PixelFormat, Sensor, SourceInfo, VideoMode
from tests.capture.oni_samples import CAMERA, HEIGHT, WIDTH, color_picture

MODES = {Sensor.COLOR: VideoMode(PixelFormat.RGB888, WIDTH, HEIGHT, 30)}
PERIOD_US = 33_333


def serve(channel: CaptureChannel, count: int) -> None:
    """So many pictures, the next only when there is room for it."""
    channel.send(DeviceOpened(MODES, {}))
    for number in range(1, count + 1):
        while not channel.has_free_slot:
            channel.handle_commands(block=True)
            channel.send_heartbeat()
        if channel.is_stopping:
            return
        picture = memoryview(np.ascontiguousarray(color_picture(number)).tobytes())
        channel.publish(Sensor.COLOR, number, number * PERIOD_US, picture)


class PlayedSource(RealSenseRecording):
    """Frames of ``count`` pictures; a walk as often as wanted."""

    def __init__(self, count: int) -> None:
        self._count, self._path = count, Path("stand-in")
        self._closing, self._lock = threading.Event(), threading.Lock()
        self._process = self._opened = None
        self.info = SourceInfo("stand-in", CAMERA, False, count, 30.0)

    @property
    def pid(self) -> int:
        assert self._process is not None
        return self._process._child.pid

    def _open(self) -> DeviceOpened | None:
        def start(*_: object) -> CaptureProcess:
            return CaptureProcess(serve, self._count, "stand-in", WIDTH * HEIGHT * 3, SLOTS)

        with mock.patch.object(realsense_recording, "CaptureProcess", start):
            return super()._open()

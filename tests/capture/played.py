"""A recording played by a stand-in for a maker's library: in the capture process, as RealSense's is."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from carpus.core.capture.devices.capture_child import CaptureOutlet, DeviceOpened
from carpus.core.capture.files.realsense_recording import FilePlayer
from carpus.core.capture.frame_assembly import FILE_PAIRING_LIMIT, FrameAssembler, StreamLayout
from carpus.core.capture.source import SourceInfo
from carpus.core.capture.video_mode import PixelFormat, Sensor, VideoMode
from carpus.core.model.types import Frame
from tests.capture.oni_samples import CAMERA, HEIGHT, WIDTH, color_picture

MODES = {Sensor.COLOR: VideoMode(PixelFormat.RGB888, WIDTH, HEIGHT, 30)}
PERIOD_US = 33_333


def serve(outlet: CaptureOutlet, count: int) -> None:
    """So many pictures, the next only when there is room for it."""
    outlet.send(DeviceOpened(MODES, {}, None, {}))
    for number in range(1, count + 1):
        while not outlet.has_free_slot:
            outlet.handle_commands(block=True)
            outlet.send_heartbeat()
        if outlet.is_stopping:
            return
        picture = memoryview(np.ascontiguousarray(color_picture(number)).tobytes())
        outlet.publish(Sensor.COLOR, number, number * PERIOD_US, picture)


class PlayedSource:
    """Frames of ``count`` pictures; a walk as often as wanted."""

    def __init__(self, count: int) -> None:
        self._count = count
        self.player = FilePlayer(serve, Path("stand-in"), WIDTH * HEIGHT * 3)
        self.info = SourceInfo("stand-in", CAMERA, False, count, 30.0)

    @property
    def pid(self) -> int:
        assert self.player._process is not None
        assert self.player._process.pid is not None
        return self.player._process.pid

    def frames(self) -> Iterator[Frame]:
        if self.player.open(self._count, 60.0) is None:
            return
        layout = StreamLayout((WIDTH, HEIGHT), None)
        yield from self.player.frames(FrameAssembler(layout, float(PERIOD_US), FILE_PAIRING_LIMIT), MODES)

    def close(self) -> None:
        self.player.close()

"""OpenNI2 inside the capture process: plays a recording in lockstep, or hands on what a camera sends."""

from __future__ import annotations

import ctypes
import threading
import time
from collections.abc import Mapping

from carpus.core.capture.capture_messages import Alive, Broken
from carpus.core.capture.capture_process import WAIT_MS, GaveUp, Heard, Outlet
from carpus.core.capture.openni2 import (
    CallFailed,
    Context,
    Device,
    DeviceState,
    Picture,
    Stream,
    StreamProperty,
)
from carpus.core.capture.openni2_opening import (
    open_camera,
    open_unchanged,
    start_recording,
    survivable_name,
    without_deadly,
)
from carpus.core.capture.openni2_plans import CameraPlan, FilePlan
from carpus.core.capture.video_mode import PixelFormat, Sensor, VideoMode
from carpus.core.errors import CameraLost, DriverFailed, RecordingDamaged

END_WAIT_MS = 20
FILE_SILENCE_S = 3.0
BYTES_PER_PIXEL: dict[int, int] = {PixelFormat.RGB888: 3, PixelFormat.DEPTH_1_MM: 2, PixelFormat.DEPTH_100_UM: 2}


def serve(outlet: Outlet, plan: FilePlan | CameraPlan) -> None:
    """Serve a plan in the capture process."""
    try:
        _serve(outlet, plan)
    except CallFailed as failure:
        raise GaveUp(DriverFailed, f"{failure.call}: {failure.reason}") from failure


def _serve(outlet: Outlet, plan: FilePlan | CameraPlan) -> None:
    library = Context()
    happened = _Happened()
    outlet.hold(library, happened)
    library.watch(happened.on_state, happened.on_gone)
    if isinstance(plan, FilePlan):
        file = open_unchanged(plan)
        path: str | None = plan.path
        if plan.deadly:
            file, path = without_deadly(file, plan.deadly, lambda: outlet.send(Alive())), None
        device = library.open(survivable_name(path, file))
        opened = start_recording(device, plan)
    else:
        device, opened = open_camera(library, plan)
    outlet.send(opened)
    loop = _Loop(outlet, library, device, happened, opened.modes)
    try:
        if isinstance(plan, FilePlan):
            loop.play(dict(plan.last_number))
        else:
            loop.watch()
    finally:
        if isinstance(plan, CameraPlan):
            device.close()


class _Happened:
    """Facts noted by the library's own threads."""

    def __init__(self) -> None:
        self.ended = threading.Event()
        self.gone = threading.Event()
        self.uri = ""

    def on_state(self, _uri: str, state: int) -> None:
        if state == DeviceState.END_OF_FILE:
            self.ended.set()

    def on_gone(self, uri: str) -> None:
        if uri == self.uri:
            self.gone.set()


class _Loop:
    """Hands pictures from the library to the outlet."""

    def __init__(
        self,
        outlet: Outlet,
        library: Context,
        device: Device,
        happened: _Happened,
        modes: Mapping[Sensor, VideoMode],
    ) -> None:
        self._outlet = outlet
        self._library = library
        self._streams = list(device.streams)
        self._happened = happened
        self._happened.uri = device.info().uri
        self._modes = modes
        outlet.set_exposure = self._set_automatic

    def play(self, last_number: dict[Sensor, int]) -> None:
        """A recording: the next picture only when there is room for it."""
        heard = time.monotonic()
        waiting = dict(last_number)
        while waiting and not self._outlet.stopping:
            self._outlet.obey(block=not self._outlet.has_room)
            if not self._outlet.has_room:
                heard = time.monotonic()
                continue
            ended = self._happened.ended.is_set()
            ready = self._library.wait(self._streams, END_WAIT_MS if ended else WAIT_MS)
            if ready is not None:
                heard = time.monotonic()
                stream = self._streams[ready]
                if self._take(stream) >= waiting.get(stream.sensor, 0):
                    waiting.pop(stream.sensor, None)
            elif ended:
                return
            elif time.monotonic() - heard > FILE_SILENCE_S:
                raise GaveUp(RecordingDamaged, f"no picture for {FILE_SILENCE_S:g} s")
            self._outlet.stay_alive()

    def watch(self) -> None:
        """A camera: the newest picture of each stream, whenever there is one."""
        heard = Heard(self._modes)
        while not self._outlet.stopping:
            self._outlet.obey(block=False)
            if self._happened.gone.is_set():
                raise GaveUp(CameraLost, "unplugged")
            if self._library.wait(self._streams, WAIT_MS) is not None:
                # the wait names the older stream; reading only that one would starve the other
                for stream in self._streams:
                    if self._library.wait([stream], 0) is not None:
                        self._take(stream)
                        heard.picture_of(stream.sensor)
            heard.check()
            self._outlet.stay_alive()

    def _take(self, stream: Stream) -> int:
        """Pass one picture on; its number, 0 when there was none."""
        sensor = stream.sensor
        with stream.read() as picture:
            if picture is None:
                return 0
            size = agreed_size(picture, self._modes[sensor])
            if size is None:
                self._outlet.send(Broken(sensor, picture.index))
            else:
                pixels = memoryview((ctypes.c_ubyte * size).from_address(picture.address)).cast("B")
                self._outlet.put(sensor, picture.index, picture.timestamp_us, pixels)
            return picture.index

    def _set_automatic(self, on: bool) -> bool:
        color = next(stream for stream in self._streams if stream.sensor == Sensor.COLOR)
        keys = (StreamProperty.AUTO_EXPOSURE, StreamProperty.AUTO_WHITE_BALANCE)
        done = [color.set_int(key, int(on)) for key in keys]
        return all(done)


def agreed_size(picture: Picture, mode: VideoMode) -> int | None:
    """Bytes that may be read of ``picture``: None unless size, format and stride are those of its stream.

    A damaged recording yields any width and height with any number of bytes behind them.
    """
    row = mode.width_px * BYTES_PER_PIXEL.get(mode.pixel_format, 0)
    size = row * mode.height_px
    agreed = (
        size > 0
        and picture.address != 0
        and not picture.is_cropped
        and picture.pixel_format == mode.pixel_format
        and (picture.width_px, picture.height_px) == (mode.width_px, mode.height_px)
        and picture.stride_bytes == row
        and picture.size_bytes == size
    )
    return size if agreed else None

"""OpenNI2 inside the capture process: hands on what a camera sends."""

from __future__ import annotations

import ctypes
import threading

from carpus.core.capture.camera_plan import CameraPlan
from carpus.core.capture.capture_messages import Broken
from carpus.core.capture.capture_process import WAIT_MS, GaveUp, Heard, Outlet
from carpus.core.capture.openni2 import CallFailed, Context, Picture, Stream, StreamProperty
from carpus.core.capture.openni2_opening import open_camera
from carpus.core.capture.video_mode import PixelFormat, Sensor, VideoMode
from carpus.core.errors import DriverFailed

BYTES_PER_PIXEL: dict[int, int] = {PixelFormat.RGB888: 3, PixelFormat.DEPTH_1_MM: 2, PixelFormat.DEPTH_100_UM: 2}


def serve(outlet: Outlet, plan: CameraPlan) -> None:
    """Serve a plan in the capture process."""
    try:
        _serve(outlet, plan)
    except CallFailed as failure:
        raise GaveUp(DriverFailed, f"{failure.call}: {failure.reason}") from failure


def _serve(outlet: Outlet, plan: CameraPlan) -> None:
    library, gone = Context(), _Gone()
    outlet.hold(library, gone)
    library.watch(gone.hear)
    device, opened = open_camera(library, plan)
    gone.uri = device.info().uri
    streams = list(device.streams)

    def pass_on(heard: Heard) -> None:
        if library.wait(streams, WAIT_MS) is not None:
            # the wait names the older stream; reading only that one would starve the other
            for stream in streams:
                if library.wait([stream], 0) is not None:
                    _take(outlet, stream, opened.modes[stream.sensor])
                    heard.picture_of(stream.sensor)

    def set_automatic(on: bool) -> bool:
        color = next(stream for stream in streams if stream.sensor == Sensor.COLOR)
        keys = (StreamProperty.AUTO_EXPOSURE, StreamProperty.AUTO_WHITE_BALANCE)
        done = [color.set_int(key, int(on)) for key in keys]
        return all(done)

    outlet.set_exposure = set_automatic
    outlet.send(opened)
    try:
        outlet.watch(opened.modes, gone, pass_on)
    finally:
        device.close()


class _Gone(threading.Event):
    """Set by the library's own threads when the device at ``uri`` was unplugged."""

    uri = ""

    def hear(self, uri: str) -> None:
        if uri == self.uri:
            self.set()


def _take(outlet: Outlet, stream: Stream, mode: VideoMode) -> None:
    """Pass one picture on, where there is one."""
    with stream.read() as picture:
        if picture is None:
            return
        size = agreed_size(picture, mode)
        if size is None:
            outlet.send(Broken(stream.sensor, picture.index))
        else:
            pixels = memoryview((ctypes.c_ubyte * size).from_address(picture.address)).cast("B")
            outlet.put(stream.sensor, picture.index, picture.timestamp_us, pixels)


def agreed_size(picture: Picture, mode: VideoMode) -> int | None:
    """Bytes that may be read of ``picture``: None unless size, format and stride are those of its stream.

    A driver may hand out any width and height with any number of bytes behind them.
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

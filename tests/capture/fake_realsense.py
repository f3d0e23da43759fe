"""The maker's library without a camera: its software device with the pictures of a simulated hand, or plain ones.

:func:`plugged_in` runs in the capture process, in place of the bus. What happens to the camera is told by files in a
folder: ``unplugged`` (it is not found, and sends nothing), ``crash`` (the driver takes its process down), ``other``
(another one is there).
"""

from __future__ import annotations

import math
import os
import threading
import time
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pyrealsense2 as rs

WIDTH, HEIGHT, FPS = 640, 480, 30
PERIOD_MS = 1000.0 / FPS
SERIAL, OTHER_SERIAL = "815412070123", "815412070124"
FX, DEPTH_FX, SHIFT_M = 525.0, 470.0, 0.015
"""Focal lengths of colour and depth in pixels, and how far right of the colour camera the depth camera sits."""
EDGE_PX, NEAR_MM = 320, 700
"""In the depth picture nothing is left of this column, and a plane right of it."""
AUTO_EXPOSURE, AUTO_KELVIN = 220.0, 5200.0
"""What its automatics have chosen, which nobody can read."""


class FakeCamera:
    """One software device with a colour and a depth sensor."""

    def __init__(self, fx: float = 525.0, depth_fx: float = 525.0, shift_m: float = 0.0, serial: str = SERIAL) -> None:
        self.device = rs.software_device()
        self.device.register_info(rs.camera_info.name, "Intel RealSense D435")
        self.device.register_info(rs.camera_info.serial_number, serial)
        self.device.register_info(rs.camera_info.firmware_version, "5.12.1.0")
        self.device.register_info(rs.camera_info.recommended_firmware_version, "5.16.0.1")
        self.device.register_info(rs.camera_info.usb_type_descriptor, "3.2")
        self.depth = self.device.add_sensor("Stereo Module")
        self.color = self.device.add_sensor("RGB Camera")
        self.depth_profile = self.depth.add_video_stream(_stream(rs.stream.depth, 0, rs.format.z16, 2, depth_fx))
        self.color_profile = self.color.add_video_stream(_stream(rs.stream.color, 1, rs.format.rgb8, 3, fx))
        self.depth.add_read_only_option(rs.option.depth_units, 0.001)
        for sensor, option, low, high, value in (
            (self.depth, rs.option.visual_preset, 0, 5, 0),
            (self.depth, rs.option.emitter_enabled, 0, 2, 0),
            (self.color, rs.option.enable_auto_exposure, 0, 1, 1),
            (self.color, rs.option.enable_auto_white_balance, 0, 1, 1),
            (self.color, rs.option.exposure, 1, 10000, 156),
            (self.color, rs.option.white_balance, 2800, 6500, 4600),
        ):
            reach = rs.option_range()
            reach.min, reach.max, reach.default = low, high, value
            reach.step = 10 if option == rs.option.white_balance else 1
            sensor.add_option(option, reach, True)
        towards = rs.extrinsics()
        towards.rotation, towards.translation = [1, 0, 0, 0, 1, 0, 0, 0, 1], [shift_m, 0.0, 0.0]
        self.depth_profile.register_extrinsics_to(self.color_profile, towards)

    def send(self, number: int, color: np.ndarray, depth: np.ndarray, at_ms: float) -> None:
        """One pair of pictures, with the device's own time."""
        for sensor, profile, pixels, size in (
            (self.depth, self.depth_profile, depth, 2),
            (self.color, self.color_profile, color, 3),
        ):
            frame = rs.software_video_frame()
            frame.pixels, frame.bpp, frame.stride = np.ascontiguousarray(pixels), size, WIDTH * size
            frame.timestamp, frame.domain = at_ms, rs.timestamp_domain.hardware_clock
            frame.frame_number, frame.profile = number, profile.as_video_stream_profile()
            if sensor is self.depth:
                frame.depth_units = 0.001
            sensor.on_video_frame(frame)

    def lit(self, color: np.ndarray) -> np.ndarray:
        """A colour picture as its exposure and white balance show it."""
        option = rs.option
        automatic = self.color.get_option(option.enable_auto_exposure)
        exposure = AUTO_EXPOSURE if automatic else self.color.get_option(option.exposure)
        automatic = self.color.get_option(option.enable_auto_white_balance)
        kelvin = AUTO_KELVIN if automatic else self.color.get_option(option.white_balance)
        warm = math.exp((kelvin - AUTO_KELVIN) / 8000.0)
        gains = np.array([warm, 1.0, 1.0 / warm]) * exposure / AUTO_EXPOSURE
        return np.clip(color * gains, 0.0, 255.0).astype(np.uint8)


def plug_in(folder: Path) -> Any:
    """A context with the camera, which sends pictures from now on; without it while it is unplugged."""
    context = rs.context()
    if (folder / "unplugged").exists():
        return context
    camera = FakeCamera(FX, DEPTH_FX, SHIFT_M, OTHER_SERIAL if (folder / "other").exists() else SERIAL)
    found: list[Any] = []
    context.set_devices_changed_callback(lambda change: found.append(change.get_new_devices()))
    camera.device.add_to(context)
    while not found:
        time.sleep(0.01)
    held = found[0], found[0][0]  # the context lists it only as long as somebody has it
    threading.Thread(target=_send_all, args=(camera, folder, held), daemon=True).start()
    return context


def _send_all(camera: FakeCamera, folder: Path, _held: object) -> None:
    color = np.tile(np.linspace(40, 120, WIDTH)[None, :, None], (HEIGHT, 1, 3))
    depth = np.full((HEIGHT, WIDTH), NEAR_MM, np.uint16)
    depth[:, :EDGE_PX] = 0
    for number in count(1):
        if (folder / "crash").exists():
            (folder / "crash").unlink()
            os.abort()
        if not (folder / "unplugged").exists():
            camera.send(number, camera.lit(color), depth, 50_000.0 + number * PERIOD_MS)
        time.sleep(PERIOD_MS / 1000.0)


def record(path: Path, frames: Iterator[Any], fx: float = 525.0) -> None:
    """Store frames as the maker's library does."""
    camera = FakeCamera(fx, fx)
    recorder = rs.recorder(str(path), camera.device)
    for sensor in recorder.query_sensors():
        sensor.open(sensor.get_stream_profiles()[0])
        sensor.start(lambda _: None)
    for number, frame in enumerate(frames, 1):
        depth_mm = np.zeros((HEIGHT, WIDTH)) if frame.depth_raw is None else frame.depth_raw * frame.depth_unit_m * 1e3
        camera.send(number, frame.color_rgb, np.round(depth_mm).astype(np.uint16), frame.timestamp_s * 1000.0)
    for sensor in recorder.query_sensors():
        sensor.stop()
        sensor.close()


def _stream(kind: Any, uid: int, form: Any, size: int, fx: float) -> Any:
    stream = rs.video_stream()
    stream.type, stream.index, stream.uid = kind, 0, uid
    stream.width, stream.height, stream.fps, stream.bpp, stream.fmt = WIDTH, HEIGHT, FPS, size, form
    lens = rs.intrinsics()
    lens.width, lens.height, lens.fx, lens.fy, lens.ppx, lens.ppy = WIDTH, HEIGHT, fx, fx, 319.5, 239.5
    lens.model, lens.coeffs = rs.distortion.inverse_brown_conrady, [0.0] * 5
    stream.intrinsics = lens
    return stream

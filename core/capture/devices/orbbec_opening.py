"""Opening one of Orbbec's newer cameras inside the capture process: streams, settings, lens."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from typing import Any

from carpus.core.capture.devices.capture_process import CameraPlan, GaveUp, why_unlisted
from carpus.core.capture.devices.usb_devices import usb_cameras
from carpus.core.capture.video_mode import Lens, PixelFormat, Sensor, VideoMode
from carpus.core.errors import CameraBusy, CameraUnsuited, DriverMissing

MODULE, PACKAGE = "pyorbbecsdk", "pyorbbecsdk2"
DEPTH_SIZE_PX = (640, 480)
"""Near this the Femto cameras measure at full size and the Gemini cameras at their best."""


def library() -> Any:
    """The maker's library, told to write no log; raises :class:`DriverMissing` where it cannot be loaded."""
    try:
        with _speechless():
            import pyorbbecsdk
    except ImportError as cause:
        raise DriverMissing(PACKAGE, str(cause)) from cause
    # else it makes a folder of logs, with serial numbers, wherever the program was started
    pyorbbecsdk.Context.set_logger_to_file(pyorbbecsdk.OBLogLevel.NONE, "")
    pyorbbecsdk.Context.set_logger_to_console(pyorbbecsdk.OBLogLevel.NONE)
    return pyorbbecsdk


def load_library() -> None:
    """Load the library and no more, to see whether it can be; raises :class:`DriverMissing`."""
    library()


@contextmanager
def _speechless() -> Iterator[None]:
    """The library says on the process's own output where it lies."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


@dataclass(frozen=True, slots=True)
class OrbbecStreams:
    """The chosen profiles. ``shrink``: how many pixels of the camera's picture, across and down, become one."""

    color: Any
    depth: Any
    shrink: int = 1

    @property
    def modes(self) -> dict[Sensor, VideoMode]:
        """Of the pictures that are handed on: depth is laid on colour, so it has its size."""
        width, height = (int(side) // self.shrink for side in (self.color.get_width(), self.color.get_height()))
        return {
            Sensor.COLOR: VideoMode(PixelFormat.RGB888, width, height, int(self.color.get_fps())),
            Sensor.DEPTH: VideoMode(PixelFormat.DEPTH_1_MM, width, height, int(self.depth.get_fps())),
        }


def find_camera(ob: Any, context: Any, plan: CameraPlan) -> Any:
    """The device to open; raises :class:`GaveUp` with why there is none."""
    state = ob.OBDeviceAccessState
    held = (state.OB_DEVICE_ACCESS_STATE_CONTROLLED, state.OB_DEVICE_ACCESS_STATE_EXCLUSIVE)
    listed = context.query_devices()
    names = []
    for index in range(listed.get_count()):
        serial = str(listed.get_device_serial_number_by_index(index))
        name = f"{listed.get_device_name_by_index(index)} {serial}".strip()
        if plan.serial in ("", serial):
            if listed.query_device_access_state(index) in held:
                raise GaveUp(CameraBusy, name)
            return listed.get_device_by_index(index)
        names.append(name)
    raise why_unlisted(usb_cameras(plan.models), names)


def choose_streams(ob: Any, pipeline: Any, plan: CameraPlan) -> OrbbecStreams:
    """Colour of the wanted size, or of twice that to be shrunk, and depth at the same rate; raises :class:`GaveUp`."""
    width, height = plan.size_px
    colors = [each for each in _offered(ob, pipeline, ob.OBSensorType.COLOR_SENSOR) if _is_color(ob, each)]
    depths = [each for each in _offered(ob, pipeline, ob.OBSensorType.DEPTH_SENSOR) if _is_depth(ob, each)]
    if not depths:
        raise GaveUp(CameraUnsuited, "no depth")
    for shrink in (1, 2):
        within = (width * shrink, height * shrink)
        fitting = [each for each in colors if each.get_width() <= within[0] and each.get_height() <= within[1]]
        if fitting:
            # the library turns what a camera sends into red, green and blue; where it does not, Carpus does
            red_first = [each for each in fitting if each.get_format() == ob.OBFormat.RGB]
            color = max(red_first or fitting, key=lambda each: _nearness(each, within, plan.fps))
            rate = color.get_fps()
            return OrbbecStreams(color, max(depths, key=lambda each: _nearness(each, DEPTH_SIZE_PX, rate)), shrink)
    raise GaveUp(CameraUnsuited, f"no colour pictures of {width}x{height}")


def prepare(ob: Any, device: Any) -> dict[str, str]:
    """What a camera is set to before it streams; what of it took, for the session."""
    prop = ob.OBPropertyID
    done: dict[str, str] = {}
    for mirror in (prop.OB_PROP_COLOR_MIRROR_BOOL, prop.OB_PROP_DEPTH_MIRROR_BOOL):
        put(ob, device, mirror, 0)
    if put(ob, device, prop.OB_PROP_LASER_BOOL, 1) or put(ob, device, prop.OB_PROP_LASER_CONTROL_INT, 1):
        done["emitter"] = "on"
    follows = [
        put(ob, device, each, 1)
        for each in (prop.OB_PROP_COLOR_AUTO_EXPOSURE_BOOL, prop.OB_PROP_COLOR_AUTO_WHITE_BALANCE_BOOL)
    ]
    put(ob, device, prop.OB_PROP_COLOR_AUTO_EXPOSURE_PRIORITY_INT, 0)  # the rate does not fall in a dark room
    done["automatic_exposure"] = "on" if all(follows) else "not settable"
    return done


def put(ob: Any, device: Any, prop: Any, value: float) -> bool:
    """Set a property, of the kind that its name ends with; whether the device has it and took it."""
    if not device.is_property_supported(prop, ob.OBPermissionType.PERMISSION_WRITE):
        return False
    with suppress(RuntimeError, ob.OBError):
        if prop.name.endswith("_BOOL"):
            device.set_bool_property(prop, bool(value))
        else:
            device.set_int_property(prop, round(value))
        return True
    return False


def whole_lens(ob: Any, color: Any) -> tuple[tuple[int, int], Lens]:
    """Size and intrinsics of the colour pictures as the camera sends them."""
    found, bent = color.get_intrinsic(), color.get_distortion()
    model = ob.OBCameraDistortionModel
    five = (bent.k1, bent.k2, bent.p1, bent.p2, bent.k3)
    name, coefficients = {
        model.BROWN_CONRADY: ("plumb_bob", five),
        model.BROWN_CONRADY_K6: ("rational_polynomial", (*five, bent.k4, bent.k5, bent.k6)),
        model.INVERSE_BROWN_CONRADY: ("inverse_brown_conrady", five),
    }.get(bent.model, (str(bent.model.name).lower(), five))
    if bent.model == model.NONE or not any(coefficients):
        name, coefficients = "plumb_bob", (0.0,) * 5
    size_px = (int(color.get_width()), int(color.get_height()))
    return size_px, Lens(found.fx, found.fy, found.cx, found.cy, name, tuple(float(each) for each in coefficients))


def lens_of(ob: Any, streams: OrbbecStreams) -> Lens:
    """Intrinsics of the colour pictures that are handed on."""
    _, lens = whole_lens(ob, streams.color)
    scale = 1.0 / streams.shrink
    # half-pixel centres: the middle of a pixel lies at a whole number
    cx_px, cy_px = ((centre + 0.5) * scale - 0.5 for centre in (lens.cx_px, lens.cy_px))
    return replace(lens, fx_px=lens.fx_px * scale, fy_px=lens.fy_px * scale, cx_px=cx_px, cy_px=cy_px)


def device_settings(ob: Any, device: Any, streams: OrbbecStreams) -> dict[str, str]:
    """What a session says of the camera; only what is known."""
    info = device.get_device_info()
    name = str(info.get_name())
    settings = {
        "camera": name if name.lower().startswith("orbbec") else f"Orbbec {name}",
        "serial": str(info.get_serial_number()),
        "firmware": str(info.get_firmware_version()),
        "usb": str(info.get_connection_type()).removeprefix("USB"),
        "library": f"OrbbecSDK {ob.get_version()}",
        "color_mode": _mode_text(streams.color),
        "depth_mode": _mode_text(streams.depth),
        "lens_model": lens_of(ob, streams).model,
        "registered": "by the library",
        "depth_focal_px": f"{streams.depth.get_intrinsic().fx:.2f}",
        "clock": "camera",
        "shrunk": f"{streams.shrink} pixels to one" if streams.shrink > 1 else "",
    }
    return {key: value for key, value in settings.items() if value}


def _offered(ob: Any, pipeline: Any, sensor: Any) -> list[Any]:
    try:
        listed = pipeline.get_stream_profile_list(sensor)
    except (RuntimeError, ob.OBError):
        return []  # a camera without this sensor
    return [listed.get_stream_profile_by_index(index).as_video_stream_profile() for index in range(listed.get_count())]


def _is_color(ob: Any, profile: Any) -> bool:
    return profile.get_format() in (ob.OBFormat.RGB, ob.OBFormat.MJPG)


def _is_depth(ob: Any, profile: Any) -> bool:
    return profile.get_format() in (ob.OBFormat.Y16, ob.OBFormat.Z16)


def _nearness(profile: Any, size_px: tuple[int, int], fps: int) -> tuple[int, int]:
    away = abs(profile.get_width() - size_px[0]) + abs(profile.get_height() - size_px[1])
    return -abs(profile.get_fps() - fps), -away


def _mode_text(profile: Any) -> str:
    return f"{profile.get_width()}x{profile.get_height()} {profile.get_format().name} {profile.get_fps()} fps"

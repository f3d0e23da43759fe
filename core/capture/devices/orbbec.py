"""Orbbec cameras (Femto Bolt and Mega, Gemini 2 and 330, Astra 2), by the maker's library pyorbbecsdk2."""

from __future__ import annotations

import math
import os
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import cv2

from carpus.core.capture.devices.cameras import (
    USB_3,
    CameraKind,
    camera_open_error,
    camera_unlisted_error,
    check_firmware_and_usb,
    check_package,
    find_usb_cameras,
)
from carpus.core.capture.devices.capture_process import (
    FPS,
    POLL_MS,
    SIZE_PX,
    CameraConfig,
    CaptureChannel,
    DeviceOpened,
)
from carpus.core.capture.devices.color_lock import ColorLock, ColorOptions
from carpus.core.capture.frame_assembly import DepthDistorter, camera_from_lens
from carpus.core.capture.source import Lens, PixelFormat, Sensor, VideoMode
from carpus.core.model.depth_sensor import ASSUMED, AZURE_KINECT, D435, D455, DepthSensor
from carpus.core.model.errors import CameraBusy, CameraUnsuited, DriverMissing
from carpus.core.model.phrase import phrase

PACKAGE = "pyorbbecsdk2"
DEPTH_SIZE_PX = (640, 480)
"""Near this size the Femto cameras measure at full size and the Gemini cameras at their best."""


def import_sdk() -> Any:
    """Import the maker's library with logging disabled; raises :class:`DriverMissing`."""
    try:
        with _silence_stdout():
            import pyorbbecsdk
    except ImportError as cause:
        raise DriverMissing(PACKAGE, str(cause)) from cause
    # else it makes a folder of logs, with serial numbers, wherever the program was started
    pyorbbecsdk.Context.set_logger_to_file(pyorbbecsdk.OBLogLevel.NONE, "")
    pyorbbecsdk.Context.set_logger_to_console(pyorbbecsdk.OBLogLevel.NONE)
    return pyorbbecsdk


@contextmanager
def _silence_stdout() -> Iterator[None]:
    """Suppress the process's standard output, on which the library prints its own path."""
    sys.stdout.flush()
    stdout, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(stdout, 1)
        os.close(stdout)
        os.close(null)


@dataclass(frozen=True, slots=True)
class OrbbecStreams:
    """Chosen profiles; ``downscale`` camera pixels, across and down, become one."""

    color: Any
    depth: Any
    downscale: int = 1

    @property
    def modes(self) -> dict[Sensor, VideoMode]:
        """Modes of the published images; registered depth has the size of colour."""
        width, height = (int(side) // self.downscale for side in (self.color.get_width(), self.color.get_height()))
        return {
            Sensor.COLOR: VideoMode(PixelFormat.RGB888, width, height, int(self.color.get_fps())),
            Sensor.DEPTH: VideoMode(PixelFormat.DEPTH_1_MM, width, height, int(self.depth.get_fps())),
        }


def find_device(ob: Any, context: Any, plan: CameraConfig) -> Any:
    """Return the device to open; raises a fault if there is none."""
    state = ob.OBDeviceAccessState
    held = (state.OB_DEVICE_ACCESS_STATE_CONTROLLED, state.OB_DEVICE_ACCESS_STATE_EXCLUSIVE)
    listing = context.query_devices()
    wanted, names = plan.serial or plan.uri, []
    for index in range(listing.get_count()):
        serial = str(listing.get_device_serial_number_by_index(index))
        name = f"{listing.get_device_name_by_index(index)} {serial}".strip()
        if wanted in ("", serial):
            if listing.query_device_access_state(index) in held:
                raise CameraBusy("", name)
            return listing.get_device_by_index(index)
        names.append(name)
    raise camera_unlisted_error(find_usb_cameras(plan.models), names)


def choose_streams(ob: Any, pipeline: Any) -> OrbbecStreams:
    """Choose colour of the wanted size, or of twice that to be downscaled, and depth at the same rate.

    Raises :class:`CameraUnsuited` if the camera has none.
    """
    width, height = SIZE_PX
    colors = _list_profiles(ob, pipeline, ob.OBSensorType.COLOR_SENSOR, (ob.OBFormat.RGB, ob.OBFormat.MJPG))
    depths = _list_profiles(ob, pipeline, ob.OBSensorType.DEPTH_SENSOR, (ob.OBFormat.Y16, ob.OBFormat.Z16))
    if not depths:
        raise CameraUnsuited("", phrase("no depth"))
    for shrink in (1, 2):
        within = (width * shrink, height * shrink)
        fitting = [each for each in colors if each.get_width() <= within[0] and each.get_height() <= within[1]]
        if fitting:
            # the library turns what a camera sends into red, green and blue; where it does not, Carpus does
            red_first = [each for each in fitting if each.get_format() == ob.OBFormat.RGB]
            color = max(red_first or fitting, key=lambda each: _profile_score(each, within, FPS))
            rate = color.get_fps()
            return OrbbecStreams(color, max(depths, key=lambda each: _profile_score(each, DEPTH_SIZE_PX, rate)), shrink)
    size = {"width": width, "height": height}
    raise CameraUnsuited("", phrase("no colour images of {width} × {height} pixels", **size))


def configure(ob: Any, device: Any) -> dict[str, str]:
    """Configure the camera before it streams; return what it accepted, for the session."""
    prop = ob.OBPropertyID
    done: dict[str, str] = {}
    for mirror in (prop.OB_PROP_COLOR_MIRROR_BOOL, prop.OB_PROP_DEPTH_MIRROR_BOOL):
        set_property(ob, device, mirror, 0)
    if set_property(ob, device, prop.OB_PROP_LASER_BOOL, 1) or set_property(
        ob, device, prop.OB_PROP_LASER_CONTROL_INT, 1
    ):
        done["emitter"] = "on"
    follows = [
        set_property(ob, device, each, 1)
        for each in (prop.OB_PROP_COLOR_AUTO_EXPOSURE_BOOL, prop.OB_PROP_COLOR_AUTO_WHITE_BALANCE_BOOL)
    ]
    set_property(ob, device, prop.OB_PROP_COLOR_AUTO_EXPOSURE_PRIORITY_INT, 0)  # the rate does not fall in a dark room
    done["automatic_exposure"] = "on" if all(follows) else "not settable"
    return done


def set_property(ob: Any, device: Any, prop: Any, value: float) -> bool:
    """Set a property of the type that its name ends with; return whether the device accepted it."""
    if not device.is_property_supported(prop, ob.OBPermissionType.PERMISSION_WRITE):
        return False
    with suppress(RuntimeError, ob.OBError):
        if prop.name.endswith("_BOOL"):
            device.set_bool_property(prop, bool(value))
        else:
            device.set_int_property(prop, round(value))
        return True
    return False


def read_property(ob: Any, device: Any, prop: Any) -> tuple[float, Any] | None:
    """Return the value of an integer property and its range; None if it cannot be set."""
    if not device.is_property_supported(prop, ob.OBPermissionType.PERMISSION_READ_WRITE):
        return None
    return float(device.get_int_property(prop)), device.get_int_property_range(prop)


def read_full_size_lens(ob: Any, color: Any) -> tuple[tuple[int, int], Lens]:
    """Return size and intrinsics of the colour images as the camera sends them."""
    found, distortion = color.get_intrinsic(), color.get_distortion()
    model = ob.OBCameraDistortionModel
    five = (distortion.k1, distortion.k2, distortion.p1, distortion.p2, distortion.k3)
    name, coefficients = {
        model.BROWN_CONRADY: ("plumb_bob", five),
        model.BROWN_CONRADY_K6: ("rational_polynomial", (*five, distortion.k4, distortion.k5, distortion.k6)),
        model.INVERSE_BROWN_CONRADY: ("inverse_brown_conrady", five),
    }.get(distortion.model, (str(distortion.model.name).lower(), five))
    if distortion.model == model.NONE or not any(coefficients):
        name, coefficients = "plumb_bob", (0.0,) * 5
    size_px = (int(color.get_width()), int(color.get_height()))
    return size_px, Lens(found.fx, found.fy, found.cx, found.cy, name, tuple(float(each) for each in coefficients))


def read_lens(ob: Any, streams: OrbbecStreams) -> Lens:
    """Return the intrinsics of the published colour images."""
    _, lens = read_full_size_lens(ob, streams.color)
    scale = 1.0 / streams.downscale
    # half-pixel centres: the centre of a pixel is at a whole number
    cx_px, cy_px = ((centre + 0.5) * scale - 0.5 for centre in (lens.cx_px, lens.cy_px))
    return replace(lens, fx_px=lens.fx_px * scale, fy_px=lens.fy_px * scale, cx_px=cx_px, cy_px=cy_px)


def describe_device(ob: Any, device: Any, streams: OrbbecStreams) -> dict[str, str]:
    """Return what a session stores of the camera; unknown entries are omitted."""
    info = device.get_device_info()
    name = str(info.get_name())
    settings = {
        "camera": name if name.lower().startswith("orbbec") else f"Orbbec {name}",
        "serial": str(info.get_serial_number()),
        "firmware": str(info.get_firmware_version()),
        "usb": str(info.get_connection_type()).removeprefix("USB"),
        "library": f"OrbbecSDK {ob.get_version()}",
        "color_mode": _format_mode(streams.color),
        "depth_mode": _format_mode(streams.depth),
        "lens_model": read_lens(ob, streams).model,
        "registered": "by the library",
        "depth_focal_px": f"{streams.depth.get_intrinsic().fx:.2f}",
        "clock": "camera",
        "shrunk": f"{streams.downscale} pixels to one" if streams.downscale > 1 else "",
    }
    return {key: value for key, value in settings.items() if value}


def _list_profiles(ob: Any, pipeline: Any, sensor: Any, formats: tuple[Any, ...]) -> list[Any]:
    try:
        listing = pipeline.get_stream_profile_list(sensor)
    except (RuntimeError, ob.OBError):
        return []  # a camera without this sensor
    profiles = [
        listing.get_stream_profile_by_index(index).as_video_stream_profile() for index in range(listing.get_count())
    ]
    return [profile for profile in profiles if profile.get_format() in formats]


def _profile_score(profile: Any, size_px: tuple[int, int], fps: int) -> tuple[int, int]:
    away = abs(profile.get_width() - size_px[0]) + abs(profile.get_height() - size_px[1])
    return -abs(profile.get_fps() - fps), -away


def _format_mode(profile: Any) -> str:
    return f"{profile.get_width()}x{profile.get_height()} {profile.get_format().name} {profile.get_fps()} fps"


UNIT_DIGITS = 7


def serve(channel: CaptureChannel, plan: CameraConfig) -> None:
    """Serve a camera in the capture process."""
    ob = import_sdk()
    try:
        _serve_camera(ob, channel, plan)
    except (RuntimeError, ob.OBError) as failure:  # all that the library raises
        raise camera_open_error(" ".join(str(failure).split()), find_usb_cameras(plan.models)) from failure


def _serve_camera(ob: Any, channel: CaptureChannel, plan: CameraConfig) -> None:
    context = plan.make_context() if plan.make_context is not None else ob.Context()
    device = find_device(ob, context, plan)
    serial = device.get_device_info().get_serial_number()
    unplugged = threading.Event()

    def handle_change(removed: Any, _added: Any) -> None:
        if serial in [removed.get_device_serial_number_by_index(each) for each in range(removed.get_count())]:
            unplugged.set()

    context.set_device_changed_callback(handle_change)
    pipeline = ob.Pipeline(device)
    streams = choose_streams(ob, pipeline)
    settings = describe_device(ob, device, streams) | configure(ob, device)
    config = ob.Config()
    config.enable_stream(streams.color)
    config.enable_stream(streams.depth)
    # each picture as it comes: Carpus pairs them by their times, and counts what is missing
    config.set_frame_aggregate_output_mode(ob.OBFrameAggregateOutputMode.ANY_SITUATION)
    channel.retain(context, device, pipeline, streams, config, handle_change)
    pipeline.start(config)
    pictures = _OrbbecImages(ob, channel, streams)
    prop = ob.OBPropertyID
    options = ColorOptions(
        prop.OB_PROP_COLOR_AUTO_EXPOSURE_BOOL,
        prop.OB_PROP_COLOR_AUTO_WHITE_BALANCE_BOOL,
        prop.OB_PROP_COLOR_EXPOSURE_INT,
        prop.OB_PROP_COLOR_WHITE_BALANCE_INT,
        streams.color.get_fps(),
        partial(set_property, ob, device),
        partial(read_property, ob, device),
    )
    lock = ColorLock(channel, options)
    is_reported = False

    def forward_images() -> None:
        nonlocal is_reported
        both = pipeline.wait_for_frames(POLL_MS)
        color, depth = (None, None) if both is None else (both.get_color_frame(), both.get_depth_frame())
        if depth is not None:
            channel.note_image(Sensor.DEPTH)
            if not is_reported:  # the unit comes with a depth image, in millimetres
                unit_m = round(float(depth.get_depth_scale()) * 1e-3, UNIT_DIGITS)
                channel.send(DeviceOpened(streams.modes, settings, read_lens(ob, streams), unit_m))
                is_reported = True
            pictures.forward_depth(depth)
        if color is not None:
            channel.note_image(Sensor.COLOR)
            picture = pictures.forward_color(color)
            if picture is not None:
                lock.add_frame(picture)

    channel.run(streams.modes, unplugged, forward_images)
    pipeline.stop()


class _OrbbecImages:
    """Publisher of colour and of depth registered to it, both with the camera's times."""

    def __init__(self, ob: Any, channel: CaptureChannel, streams: OrbbecStreams) -> None:
        self._channel, self._shrink = channel, streams.downscale
        self._is_jpeg = streams.color.get_format() == ob.OBFormat.MJPG
        self._align = ob.AlignFilter(align_to_stream=ob.OBStreamType.COLOR_STREAM)
        self._align.set_align_to_stream_profile(streams.color)
        # the library lays depth on what an ideal lens would see. It can bend it too, but then takes good readings away
        # beside missing ones, or all of them, by the model of the lens
        self._align.set_config_value("TargetDistortion", 0.0)
        self._bending = DepthDistorter(camera_from_lens(*read_full_size_lens(ob, streams.color)), streams.downscale)
        channel.retain(self)

    def forward_color(self, frame: Any) -> memoryview | None:
        """Publish a colour image; return its bytes, or None if it arrived damaged and is skipped."""
        width, height = frame.get_width(), frame.get_height()
        picture = frame.get_data()
        if self._is_jpeg:
            picture = cv2.imdecode(picture, cv2.IMREAD_COLOR_RGB)
        if picture is None or picture.size != height * width * 3:
            return None
        picture = picture.reshape(height, width, 3)
        if self._shrink > 1:
            smaller = (width // self._shrink, height // self._shrink)
            picture = cv2.resize(picture, smaller, interpolation=cv2.INTER_AREA)
        return self._publish(Sensor.COLOR, frame, picture)

    def forward_depth(self, frame: Any) -> None:
        """Publish a depth image; one that cannot be registered is skipped, and its frame has no depth."""
        registered = self._align.process(frame)
        if registered is None:
            return
        registered = registered.as_depth_frame()
        picture = registered.get_data().view("<u2").reshape(registered.get_height(), registered.get_width())
        self._publish(Sensor.DEPTH, frame, self._bending.distort(picture))

    def _publish(self, sensor: Sensor, frame: Any, picture: Any) -> memoryview:
        pixels = memoryview(picture.tobytes())
        self._channel.publish(sensor, int(frame.get_index()), int(frame.get_timestamp_us()), pixels)
        return pixels


MODELS = {
    ("2bc5", "0635"): "Orbbec Femto",
    ("2bc5", "0638"): "Orbbec Femto W",
    ("2bc5", "0669"): "Orbbec Femto Mega",
    ("2bc5", "066b"): "Orbbec Femto Bolt",
    ("2bc5", "0660"): "Orbbec Astra 2",
    ("2bc5", "0670"): "Orbbec Gemini 2",
    ("2bc5", "0671"): "Orbbec Gemini 2 XL",
    ("2bc5", "0673"): "Orbbec Gemini 2 L",
    ("2bc5", "0800"): "Orbbec Gemini 335",
    ("2bc5", "0801"): "Orbbec Gemini 330",
    ("2bc5", "0803"): "Orbbec Gemini 336",
    ("2bc5", "0804"): "Orbbec Gemini 335L",
    ("2bc5", "0805"): "Orbbec Gemini 330L",
    ("2bc5", "0807"): "Orbbec Gemini 336L",
    ("2bc5", "0808"): "Orbbec Gemini 215",
    ("2bc5", "0809"): "Orbbec Gemini 210",
}
"""Product numbers from the udev rules of the library."""
_WIDE_BASELINE_MODELS = ("330L", "335L", "336L", "GEMINI 2")
"""Baseline of about 100 mm; the other Gemini cameras have about 50 mm."""


def find_sensor(settings: Mapping[str, str], color_focal_px: float = math.nan) -> DepthSensor:
    """Return the depth sensor of a camera with these settings.

    A Femto has the sensor of the Azure Kinect. For want of data, stereo cameras are taken to be as accurate as a
    RealSense of the same baseline.
    """
    name = settings.get("camera", "").upper()
    if "FEMTO" in name:
        return AZURE_KINECT
    pair = D455 if any(model in name for model in _WIDE_BASELINE_MODELS) else D435
    focal_px = float(settings.get("depth_focal_px", "nan"))
    return replace(pair.with_focal(focal_px, color_focal_px) if focal_px > 0.0 else pair, origin=ASSUMED)


KIND = CameraKind(
    title="Orbbec Femto, Gemini or Astra 2",
    models=MODELS,
    serve=serve,
    find_sensor=find_sensor,
    check_driver=partial(check_package, phrase("Orbbec driver"), PACKAGE, import_sdk),
    needed_mbit=5000,
    port_advice=USB_3,
    check_settings=check_firmware_and_usb,
    package=PACKAGE,
)

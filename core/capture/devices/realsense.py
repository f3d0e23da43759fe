"""Intel RealSense cameras of the D400 family, by the maker's library (the extra ``realsense``)."""

from __future__ import annotations

import math
import queue
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

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
from carpus.core.capture.source import Lens, PixelFormat, Sensor, VideoMode
from carpus.core.model import errors
from carpus.core.model.depth_sensor import ASSUMED, D415, D435, D455, DepthSensor
from carpus.core.model.phrase import phrase

PACKAGE = "pyrealsense2"
DEPTH_SIZE_PX = (848, 480)
"""Depth size at which the D435 and D455 measure best."""
_IDENTITY_ROTATION = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
_INTRINSIC_NAMES = ("width", "height", "fx", "fy", "ppx", "ppy", "model", "coeffs")
UNIT_DIGITS = 7
"""The library stores the depth unit as a 32-bit number: 0.001 comes back as 0.00100000005."""


def import_sdk() -> Any:
    """Import the maker's library; raises :class:`DriverMissing`."""
    try:
        import pyrealsense2
    except ImportError as cause:
        raise errors.DriverMissing(PACKAGE, str(cause)) from cause
    return pyrealsense2


@dataclass(frozen=True, slots=True)
class RealsenseStreams:
    """Chosen colour profile and depth profile (None without depth), and the profiles that each sensor opens."""

    color: Any
    depth: Any | None
    opening: tuple[tuple[Any, tuple[Any, ...]], ...]

    @property
    def modes(self) -> dict[Sensor, VideoMode]:
        """Modes of the published images; registered depth has the size of colour."""
        width, height = self.color.width(), self.color.height()
        modes = {Sensor.COLOR: VideoMode(PixelFormat.RGB888, width, height, self.color.fps())}
        if self.depth is not None:
            modes[Sensor.DEPTH] = VideoMode(PixelFormat.DEPTH_1_MM, width, height, self.depth.fps())
        return modes


def find_device(rs: Any, context: Any, plan: CameraConfig) -> Any:
    """Return the device to open; raises a fault if there is none."""
    wanted = plan.serial or plan.uri
    names = []
    for device in context.query_devices():
        serial = read_device_info(rs, device, "serial_number")
        if wanted in ("", serial):
            return device
        names.append(f"{read_device_info(rs, device, 'name')} {serial}".strip())
    raise camera_unlisted_error(find_usb_cameras(plan.models), names)


def read_device_info(rs: Any, device: Any, fact: str) -> str:
    """Return a fact of the device by the library's name of it; empty if unknown."""
    info = getattr(rs.camera_info, fact)
    return str(device.get_info(info)) if device.supports(info) else ""


def choose_streams(rs: Any, device: Any) -> RealsenseStreams:
    """Choose colour of the wanted size and rate, and depth as the camera measures it best.

    Raises :class:`CameraUnsuited` if the camera has none.
    """
    colors, depths = _list_profiles(rs, device)
    width, height = SIZE_PX

    def nearness(pair: tuple[Any, Any], size_px: tuple[int, int]) -> tuple[int, int]:
        profile = pair[1]
        return -abs(profile.fps() - FPS), -abs(profile.width() - size_px[0]) - abs(profile.height() - size_px[1])

    fitting = [
        pair
        for pair in colors
        if pair[1].format() == rs.format.rgb8 and pair[1].width() <= width and pair[1].height() <= height
    ]
    if not fitting:
        size = {"width": width, "height": height}
        raise errors.CameraUnsuited("", phrase("no colour images of {width} × {height} pixels", **size))
    if not depths:
        raise errors.CameraUnsuited("", phrase("no depth"))
    color = max(fitting, key=lambda pair: nearness(pair, SIZE_PX))
    return _group_by_sensor([color, max(depths, key=lambda pair: nearness(pair, DEPTH_SIZE_PX))])


def _list_profiles(rs: Any, device: Any) -> tuple[list[tuple[Any, Any]], list[tuple[Any, Any]]]:
    """Return sensor and profile of all colour streams, and of all depth streams."""
    offered = [
        (sensor, profile.as_video_stream_profile())
        for sensor in device.query_sensors()
        for profile in sensor.get_stream_profiles()
        if profile.is_video_stream_profile()
    ]
    colors = [pair for pair in offered if pair[1].stream_type() == rs.stream.color]
    depths = [pair for pair in offered if pair[1].stream_type() == rs.stream.depth]
    return colors, [pair for pair in depths if pair[1].format() == rs.format.z16]


def _group_by_sensor(chosen: Sequence[tuple[Any, Any]]) -> RealsenseStreams:
    """Group the profiles by sensor: one that sends both (D405) is opened once."""
    by_name: dict[str, tuple[Any, list[Any]]] = {}
    for number, (sensor, profile) in enumerate(chosen):
        by_name.setdefault(sensor.name or str(number), (sensor, []))[1].append(profile)
    opening = tuple((sensor, tuple(profiles)) for sensor, profiles in by_name.values())
    return RealsenseStreams(chosen[0][1], chosen[1][1] if len(chosen) > 1 else None, opening)


def configure(rs: Any, streams: RealsenseStreams) -> dict[str, str]:
    """Configure the camera before it streams; return what it accepted, for the session."""
    option = rs.option
    done: dict[str, str] = {}
    for sensor, profiles in streams.opening:
        # Times of the device itself: the library's fit to the computer's clock steps now and then.
        set_option(sensor, option.global_time_enabled, 0)
        if streams.depth in profiles:
            if set_option(sensor, option.visual_preset, int(rs.rs400_visual_preset.high_accuracy)):
                done["preset"] = "high accuracy"
            if set_option(sensor, option.emitter_enabled, 1):
                done["emitter"] = "on"
        automatic = set_option(sensor, option.enable_auto_exposure, 1)
        if streams.color in profiles:
            automatic = set_option(sensor, option.enable_auto_white_balance, 1) and automatic
            set_option(sensor, option.auto_exposure_priority, 0)  # the rate does not fall in a dark room
            done["automatic_exposure"] = "on" if automatic else "not settable"
    return done


def set_option(sensor: Any, option: Any, value: float) -> bool:
    """Set an option; return whether the sensor accepted it."""
    if not sensor.supports(option) or sensor.is_option_read_only(option):
        return False
    with suppress(RuntimeError):
        sensor.set_option(option, value)
        return True
    return False


def read_option(sensor: Any, option: Any) -> tuple[float, Any] | None:
    """Return the value of an option and its range; None if the sensor has no such option."""
    if not sensor.supports(option):
        return None
    return float(sensor.get_option(option)), sensor.get_option_range(option)


def read_depth_unit_m(rs: Any, streams: RealsenseStreams) -> float:
    """Return metres per count of depth."""
    for sensor, profiles in streams.opening:
        if streams.depth in profiles and sensor.supports(rs.option.depth_units):
            return round(float(sensor.get_option(rs.option.depth_units)), UNIT_DIGITS)
    return 1e-3


def read_lens(rs: Any, profile: Any) -> Lens:
    """Return the intrinsics of a profile."""
    found = profile.get_intrinsics()
    coefficients = tuple(float(each) for each in found.coeffs)
    model = {
        rs.distortion.none: "plumb_bob",
        rs.distortion.brown_conrady: "plumb_bob",
        rs.distortion.inverse_brown_conrady: "inverse_brown_conrady",
    }.get(found.model, str(found.model))
    if found.model == rs.distortion.none or not any(coefficients):
        model, coefficients = "plumb_bob", (0.0,) * len(coefficients)
    return Lens(found.fx, found.fy, found.ppx, found.ppy, model, coefficients)


def is_depth_registered(streams: RealsenseStreams) -> bool:
    """Return whether depth is registered to colour already; doing it again would only tear holes into it."""
    if streams.depth is None:
        return True
    towards = streams.depth.get_extrinsics_to(streams.color)
    here, there = streams.depth.get_intrinsics(), streams.color.get_intrinsics()
    unmoved = [*towards.rotation, *towards.translation] == [*_IDENTITY_ROTATION, 0.0, 0.0, 0.0]
    return unmoved and all(getattr(here, key) == getattr(there, key) for key in _INTRINSIC_NAMES)


def describe_device(rs: Any, device: Any, streams: RealsenseStreams) -> dict[str, str]:
    """Return what a session stores of the camera; unknown entries are omitted."""
    settings = {
        "camera": read_device_info(rs, device, "name") or "RealSense",
        "serial": read_device_info(rs, device, "serial_number"),
        "firmware": read_device_info(rs, device, "firmware_version"),
        "firmware_wanted": read_device_info(rs, device, "recommended_firmware_version"),
        "usb": read_device_info(rs, device, "usb_type_descriptor"),
        "library": f"librealsense {rs.__version__}",
        "color_mode": _format_mode(streams.color),
        "lens_model": read_lens(rs, streams.color).model,
    }
    if streams.depth is not None:
        settings["depth_mode"] = _format_mode(streams.depth)
        settings["registered"] = "by the library"
        settings["depth_focal_px"] = f"{streams.depth.get_intrinsics().fx:.2f}"
    return {key: value for key, value in settings.items() if value}


def _format_mode(profile: Any) -> str:
    return f"{profile.width()}x{profile.height()} {profile.format().name} {profile.fps()} fps"


WAITING_FRAMES = 8
JOIN_MS = 1000
FILE_SILENCE_S = 5.0


def serve(channel: CaptureChannel, plan: CameraConfig | Path) -> None:
    """Serve a camera or a recording in the capture process."""
    rs = import_sdk()
    try:
        if isinstance(plan, Path):
            _serve_recording(rs, channel, plan)
        else:
            _serve_camera(rs, channel, plan)
    except RuntimeError as failure:  # all that the library raises
        reason = " ".join(str(failure).split())
        if isinstance(plan, Path):
            raise errors.DriverFailed("", reason) from failure
        raise camera_open_error(reason, find_usb_cameras(plan.models)) from failure


def _serve_camera(rs: Any, channel: CaptureChannel, plan: CameraConfig) -> None:
    context = plan.make_context() if plan.make_context is not None else rs.context()
    device = find_device(rs, context, plan)
    unplugged = threading.Event()
    context.set_devices_changed_callback(lambda change: unplugged.set() if change.was_removed(device) else None)
    streams = choose_streams(rs, device)
    settings = describe_device(rs, device, streams) | configure(rs, streams)
    channel.retain(context, device)
    images = _RealSenseImages(rs, channel, streams, settings, drops_oldest=True)
    color = next(sensor for sensor, profiles in streams.opening if streams.color in profiles)
    options = ColorOptions(
        rs.option.enable_auto_exposure,
        rs.option.enable_auto_white_balance,
        rs.option.exposure,
        rs.option.white_balance,
        streams.color.fps(),
        partial(set_option, color),
        partial(read_option, color),
    )
    lock = ColorLock(channel, options)

    def forward_images() -> None:
        frame = images.forward()
        if frame is not None:
            sensor = Sensor.COLOR if _is_color(rs, frame) else Sensor.DEPTH
            channel.note_image(sensor)
            if sensor == Sensor.COLOR:
                lock.add_frame(memoryview(frame.get_data()).cast("B"))

    channel.run(streams.modes, unplugged, forward_images)
    for sensor, _ in streams.opening:
        sensor.stop()
        sensor.close()


def _serve_recording(rs: Any, channel: CaptureChannel, path: Path) -> None:
    try:
        playback = rs.context().load_device(str(path))
        playback.set_real_time(False)
        # colour and, if there is any, depth of a recording; raises :class:`RecordingUnsupported`
        colors, depths = _list_profiles(rs, playback)
        readable = [pair for pair in colors if pair[1].format() in (rs.format.rgb8, rs.format.bgr8)]
        if not readable:
            form = f"colour as {colors[0][1].format().name}" if colors else "no colour frames"
            raise errors.RecordingUnsupported("", form)
        streams = _group_by_sensor([readable[0], *depths[:1]])
    except RuntimeError as failure:
        raise errors.RecordingDamaged("", " ".join(str(failure).split())) from failure
    channel.retain(playback)
    playback.pause()  # else it begins with the first sensor, and the other's pictures are lost
    images = _RealSenseImages(rs, channel, streams, describe_device(rs, playback, streams), drops_oldest=False)
    playback.resume()
    last_s = time.monotonic()
    while not channel.is_stopping:
        channel.handle_commands(block=not channel.has_free_slot)
        is_stopped = playback.current_status() == rs.playback_status.stopped
        if not channel.has_free_slot or images.forward() is not None:
            last_s = time.monotonic()
        elif is_stopped:
            if not images.has_reported:
                raise errors.RecordingDamaged("", phrase("no frames"))
            return
        elif time.monotonic() - last_s > FILE_SILENCE_S:
            raise errors.RecordingDamaged("", phrase("no frames for {seconds} s", seconds=f"{FILE_SILENCE_S:g}"))
        channel.send_heartbeat()


def _is_color(rs: Any, frame: Any) -> bool:
    return bool(frame.profile.stream_type() == rs.stream.color)


class _RealSenseImages:
    """Publisher of colour and of depth registered to it, both with their own times; starts the streams."""

    def __init__(
        self,
        rs: Any,
        channel: CaptureChannel,
        streams: RealsenseStreams,
        settings: dict[str, str],
        *,
        drops_oldest: bool,
    ) -> None:
        self._rs, self._channel, self._streams, self._settings = rs, channel, streams, settings
        self._drops_oldest = drops_oldest
        self.has_reported = False
        self._is_registered = is_depth_registered(streams)
        self._align = rs.align(rs.stream.color)
        self._color: Any | None = None
        self._early: list[Any] = []
        self._joined = rs.frame_queue(1)
        self._join = rs.processing_block(
            lambda frame, source: source.frame_ready(source.allocate_composite_frame([frame, self._color]))
        )
        self._join.start(self._joined)
        self._frames: queue.Queue[Any] = queue.Queue(WAITING_FRAMES)
        channel.retain(self)
        for sensor, profiles in streams.opening:
            sensor.open(list(profiles))
        for sensor, _ in streams.opening:
            sensor.start(self._enqueue)

    def _enqueue(self, frame: Any) -> None:
        """Take a frame of the library's thread: a camera's oldest makes room, a recording reads on when there is."""
        frame.keep()
        while self._drops_oldest and self._frames.full():
            with suppress(queue.Empty):
                self._frames.get_nowait()  # its number is missing then, and counted
        self._frames.put(frame)

    def forward(self) -> Any | None:
        """Publish the next image and return it; None if there is none yet.

        A camera is reported with its first colour image, a recording with its first of any. Depth that is yet to be
        registered waits for a colour image.
        """
        rs = self._rs
        try:
            frame = self._frames.get(timeout=POLL_MS / 1000.0)
        except queue.Empty:
            return None
        is_color = _is_color(rs, frame)
        if not self.has_reported and (is_color or not self._drops_oldest):
            # the camera's time, or the computer's (of arrival)
            is_arrival = frame.get_frame_timestamp_domain() == rs.timestamp_domain.system_time
            settings = self._settings | {"clock": "computer" if is_arrival else "camera"}
            lens, unit_m = read_lens(rs, self._streams.color), read_depth_unit_m(rs, self._streams)
            self._channel.send(DeviceOpened(self._streams.modes, settings, lens, unit_m))
            self.has_reported = True
        if not is_color:
            if self._is_registered:
                self._publish(Sensor.DEPTH, frame)
            elif self._color is None:
                self._early = [*self._early[-WAITING_FRAMES:], frame]
            else:
                self._publish_registered(frame)
            return frame
        if self._color is None:
            self._color = frame  # laying depth on colour asks only how it sees, so any colour picture will do
        self._publish(Sensor.COLOR, frame)
        for early in self._early:
            self._publish_registered(early)
        self._early = []
        return frame

    def _publish_registered(self, frame: Any) -> None:
        self._join.invoke(frame)
        both = self._joined.wait_for_frame(JOIN_MS).as_frameset()
        self._publish(Sensor.DEPTH, self._align.process(both).get_depth_frame())

    def _publish(self, sensor: Sensor, frame: Any) -> None:
        image = np.asanyarray(frame.get_data())
        if frame.profile.format() == self._rs.format.bgr8:
            image = np.ascontiguousarray(image[..., ::-1])
        time_us = round(frame.get_timestamp() * 1000.0)
        self._channel.publish(sensor, frame.get_frame_number(), time_us, memoryview(image).cast("B"))


MODELS = {
    ("8086", "0ad3"): "Intel RealSense D415",
    ("8086", "0b07"): "Intel RealSense D435",
    ("8086", "0b3a"): "Intel RealSense D435i",
    ("8086", "0b5b"): "Intel RealSense D405",
    ("8086", "0b5c"): "Intel RealSense D455",
    ("8086", "1155"): "Intel RealSense D421",
}
"""The D421 has no colour camera; opening it reports so."""
SENSORS = {"D415": D415, "D435": D435, "D455": D455, "D456": D455, "D457": D455}


def find_sensor(settings: Mapping[str, str], color_focal_px: float = math.nan) -> DepthSensor:
    """Return the depth sensor of a camera with these settings; an unknown camera is taken for a D435.

    The noise is that of its own depth images; only the window is counted in pixels of colour.
    """
    name = settings.get("camera", "").upper()
    known = next((sensor for model, sensor in SENSORS.items() if model in name), None)
    sensor = replace(D435, origin=ASSUMED) if known is None else known
    focal_px = float(settings.get("depth_focal_px", "nan"))
    return sensor.with_focal(focal_px, color_focal_px) if focal_px > 0.0 else sensor


KIND = CameraKind(
    title="Intel RealSense",
    models=MODELS,
    serve=serve,
    find_sensor=find_sensor,
    check_driver=partial(check_package, phrase("RealSense driver"), PACKAGE, import_sdk),
    needed_mbit=5000,
    port_advice=USB_3,
    check_settings=check_firmware_and_usb,
    package=PACKAGE,
)

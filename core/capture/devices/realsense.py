"""Intel RealSense cameras of the D400 family, by the maker's library (the extra ``realsense``)."""

from __future__ import annotations

import math
import queue
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from carpus.core.capture.devices.cameras import USB_3, CameraKind, check_firmware_and_usb, check_library
from carpus.core.capture.devices.capture_child import (
    POLL_MS,
    CameraConfig,
    CaptureFailed,
    CaptureOutlet,
    DeviceOpened,
    StreamWatchdog,
    camera_open_error,
    camera_unlisted_error,
)
from carpus.core.capture.devices.color_lock import ColorLock, ColorSettings, Control, max_exposure
from carpus.core.capture.devices.process_camera import SIZE_PX, ProcessCamera
from carpus.core.capture.devices.usb_devices import find_usb_cameras
from carpus.core.capture.source import NoticeHandler, ignore_notice
from carpus.core.capture.video_mode import Lens, PixelFormat, Sensor, VideoMode
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import ASSUMED, D415, D435, D455, DepthSensor
from carpus.core.model.errors import (
    CameraUnsuited,
    DriverFailed,
    DriverMissing,
    ExtraMissing,
    RecordingDamaged,
    RecordingUnsupported,
)
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
        raise DriverMissing(PACKAGE, str(cause)) from cause
    return pyrealsense2


def load_library() -> None:
    """Check that the library can be loaded; raises :class:`DriverMissing`."""
    import_sdk()


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
    """Return the device to open; raises :class:`CaptureFailed` if there is none."""
    listed = list(context.query_devices())
    for device in listed:
        if not plan.serial or read_device_info(rs, device, "serial_number") == plan.serial:
            return device
    names = [
        f"{read_device_info(rs, device, 'name')} {read_device_info(rs, device, 'serial_number')}".strip()
        for device in listed
    ]
    raise camera_unlisted_error(find_usb_cameras(plan.models), names)


def read_device_info(rs: Any, device: Any, fact: str) -> str:
    """Return a fact of the device by the library's name of it; empty if unknown."""
    info = getattr(rs.camera_info, fact)
    return str(device.get_info(info)) if device.supports(info) else ""


def choose_streams(rs: Any, device: Any, plan: CameraConfig) -> RealsenseStreams:
    """Choose colour of the wanted size and rate, and depth as the camera measures it best.

    Raises :class:`CaptureFailed` if the camera has none.
    """
    offered = _list_profiles(rs, device)
    width, height = plan.size_px

    def nearness(profile: Any, size_px: tuple[int, int]) -> tuple[int, int]:
        return -abs(profile.fps() - plan.fps), -abs(profile.width() - size_px[0]) - abs(profile.height() - size_px[1])

    colors = [(sensor, each) for sensor, each in offered if each.format() == rs.format.rgb8 and _is_color(rs, each)]
    fitting = [pair for pair in colors if pair[1].width() <= width and pair[1].height() <= height]
    if not fitting:
        raise CaptureFailed(CameraUnsuited, f"no colour pictures of {width}x{height}")
    depths = [(sensor, each) for sensor, each in offered if _is_depth(rs, each)]
    if not depths:
        raise CaptureFailed(CameraUnsuited, "no depth")
    color = max(fitting, key=lambda pair: nearness(pair[1], plan.size_px))
    depth = max(depths, key=lambda pair: nearness(pair[1], DEPTH_SIZE_PX))
    return _group_by_sensor([color, depth])


def choose_recording_streams(rs: Any, playback: Any) -> RealsenseStreams:
    """Return colour and, if there is any, depth of a recording; raises :class:`CaptureFailed`."""
    offered = _list_profiles(rs, playback)
    colors = [pair for pair in offered if _is_color(rs, pair[1])]
    readable = [pair for pair in colors if pair[1].format() in (rs.format.rgb8, rs.format.bgr8)]
    if not readable:
        form = f"colour as {colors[0][1].format().name}" if colors else "no colour frames"
        raise CaptureFailed(CameraUnsuited, form)
    depths = [pair for pair in offered if _is_depth(rs, pair[1])]
    return _group_by_sensor([readable[0], *depths[:1]])


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


def set_nearest_option(sensor: Any, option: Any, value: float) -> bool:
    """Set an option to the nearest accepted value: the sensor rejects values between its steps."""
    if not sensor.supports(option):
        return False
    reach = sensor.get_option_range(option)
    step = reach.step or 1.0
    value = min(max(value, reach.min), reach.max)
    return set_option(sensor, option, reach.min + round((value - reach.min) / step) * step)


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
        "depth_mode": _format_mode(streams.depth) if streams.depth is not None else "",
        "lens_model": read_lens(rs, streams.color).model,
        "registered": "by the library" if streams.depth is not None else "",
    }
    if streams.depth is not None:
        settings["depth_focal_px"] = f"{streams.depth.get_intrinsics().fx:.2f}"
    return {key: value for key, value in settings.items() if value}


def _list_profiles(rs: Any, device: Any) -> list[tuple[Any, Any]]:
    return [
        (sensor, profile.as_video_stream_profile())
        for sensor in device.query_sensors()
        for profile in sensor.get_stream_profiles()
        if profile.is_video_stream_profile()
    ]


def _is_color(rs: Any, profile: Any) -> bool:
    return bool(profile.stream_type() == rs.stream.color)


def _is_depth(rs: Any, profile: Any) -> bool:
    return bool(profile.stream_type() == rs.stream.depth and profile.format() == rs.format.z16)


def _group_by_sensor(chosen: Sequence[tuple[Any, Any]]) -> RealsenseStreams:
    """Group the profiles by sensor: one that sends both (D405) is opened once."""
    by_name: dict[str, tuple[Any, list[Any]]] = {}
    for number, (sensor, profile) in enumerate(chosen):
        by_name.setdefault(sensor.name or str(number), (sensor, []))[1].append(profile)
    opening = tuple((sensor, tuple(profiles)) for sensor, profiles in by_name.values())
    return RealsenseStreams(chosen[0][1], chosen[1][1] if len(chosen) > 1 else None, opening)


def _format_mode(profile: Any) -> str:
    return f"{profile.width()}x{profile.height()} {profile.format().name} {profile.fps()} fps"


WAITING_FRAMES = 8
JOIN_MS = 1000
FILE_SILENCE_S = 5.0


def serve(outlet: CaptureOutlet, plan: CameraConfig | Path) -> None:
    """Serve a camera or a recording in the capture process."""
    rs = import_sdk()
    try:
        if isinstance(plan, Path):
            _serve_recording(rs, outlet, plan)
        else:
            _serve_camera(rs, outlet, plan)
    except RuntimeError as failure:  # all that the library raises
        reason = " ".join(str(failure).split())
        if isinstance(plan, Path):
            raise CaptureFailed(DriverFailed, reason) from failure
        raise camera_open_error(reason, find_usb_cameras(plan.models)) from failure


def _serve_camera(rs: Any, outlet: CaptureOutlet, plan: CameraConfig) -> None:
    context = plan.make_context() if plan.make_context is not None else rs.context()
    device = find_device(rs, context, plan)
    unplugged = threading.Event()
    context.set_devices_changed_callback(lambda change: unplugged.set() if change.was_removed(device) else None)
    streams = choose_streams(rs, device, plan)
    settings = describe_device(rs, device, streams) | configure(rs, streams)
    frame_queue: queue.Queue[Any] = queue.Queue(WAITING_FRAMES)
    outlet.retain(context, device, streams, frame_queue)

    def enqueue(frame: Any) -> None:
        frame.keep()
        while True:
            try:
                frame_queue.put_nowait(frame)
                return
            except queue.Full:
                _get_frame(frame_queue, 0.0)  # the oldest; its number is missing then, and counted

    _start_streams(streams, enqueue)
    pictures = _RealSenseImages(rs, outlet, streams)
    hold = ColorLock(outlet, _RealSenseControls(rs, streams))
    outlet.lock_exposure = hold.start
    is_reported = False

    def forward_images(watchdog: StreamWatchdog) -> None:
        nonlocal is_reported
        frame = _get_frame(frame_queue, POLL_MS / 1000.0)
        if frame is None:
            return
        sensor = _frame_sensor(rs, frame)
        watchdog.reset(sensor)
        if sensor == Sensor.COLOR and not is_reported:
            outlet.send(_build_report(rs, streams, settings | {"clock": _clock_name(rs, frame)}))
            is_reported = True
        pictures.forward(frame)
        if sensor == Sensor.COLOR:
            hold.add_frame(memoryview(frame.get_data()).cast("B"))

    outlet.run(streams.modes, unplugged, forward_images)
    for sensor, _ in streams.opening:
        sensor.stop()
        sensor.close()


def _serve_recording(rs: Any, outlet: CaptureOutlet, path: Path) -> None:
    try:
        playback = rs.context().load_device(str(path))
        playback.set_real_time(False)
        streams = choose_recording_streams(rs, playback)
    except RuntimeError as failure:
        raise CaptureFailed(RecordingDamaged, " ".join(str(failure).split())) from failure
    except CaptureFailed as failure:
        raise CaptureFailed(RecordingUnsupported, failure.detail) from failure
    frame_queue: queue.Queue[Any] = queue.Queue(WAITING_FRAMES)
    outlet.retain(playback, streams, frame_queue)

    def enqueue(frame: Any) -> None:
        frame.keep()
        frame_queue.put(frame)  # the library reads on only when this is over

    settings = describe_device(rs, playback, streams)
    playback.pause()  # else it begins with the first sensor, and the other's pictures are lost
    _start_streams(streams, enqueue)
    playback.resume()
    pictures = _RealSenseImages(rs, outlet, streams)
    watchdog = time.monotonic()
    is_reported = False
    while not outlet.is_stopping:
        outlet.handle_commands(block=not outlet.has_free_slot)
        if not outlet.has_free_slot:
            watchdog = time.monotonic()
            continue
        frame = _get_frame(frame_queue, POLL_MS / 1000.0)
        if frame is not None:
            watchdog = time.monotonic()
            if not is_reported:
                outlet.send(_build_report(rs, streams, settings | {"clock": _clock_name(rs, frame)}))
                is_reported = True
            pictures.forward(frame)
        elif playback.current_status() == rs.playback_status.stopped and frame_queue.empty():
            if not is_reported:
                raise CaptureFailed(RecordingDamaged, "no picture in it")
            return
        elif time.monotonic() - watchdog > FILE_SILENCE_S:
            raise CaptureFailed(RecordingDamaged, f"no picture for {FILE_SILENCE_S:g} s")
        outlet.send_heartbeat()


def _start_streams(streams: RealsenseStreams, take: Callable[[Any], None]) -> None:
    for sensor, profiles in streams.opening:
        sensor.open(list(profiles))
    for sensor, _ in streams.opening:
        sensor.start(take)


def _get_frame(frame_queue: queue.Queue[Any], wait_s: float) -> Any | None:
    try:
        return frame_queue.get(timeout=wait_s) if wait_s > 0.0 else frame_queue.get_nowait()
    except queue.Empty:
        return None


def _frame_sensor(rs: Any, frame: Any) -> Sensor:
    return Sensor.COLOR if frame.profile.stream_type() == rs.stream.color else Sensor.DEPTH


def _clock_name(rs: Any, frame: Any) -> str:
    """Return the clock of the time stamps: the camera's, or the computer's (time of arrival)."""
    return "computer" if frame.get_frame_timestamp_domain() == rs.timestamp_domain.system_time else "camera"


def _build_report(rs: Any, streams: RealsenseStreams, settings: dict[str, str]) -> DeviceOpened:
    mirrored = dict.fromkeys(streams.modes, False)
    return DeviceOpened(
        streams.modes, mirrored, None, settings, read_lens(rs, streams.color), read_depth_unit_m(rs, streams)
    )


class _RealSenseImages:
    """Publisher of colour and of depth registered to it, both with their own times."""

    def __init__(self, rs: Any, outlet: CaptureOutlet, streams: RealsenseStreams) -> None:
        self._rs, self._outlet = rs, outlet
        self._is_registered = is_depth_registered(streams)
        self._align = rs.align(rs.stream.color)
        self._color: Any | None = None
        self._early: list[Any] = []
        self._joined = rs.frame_queue(1)
        self._join = rs.processing_block(
            lambda frame, source: source.frame_ready(source.allocate_composite_frame([frame, self._color]))
        )
        self._join.start(self._joined)
        outlet.retain(self)

    def forward(self, frame: Any) -> None:
        """Publish one image; depth from before the first colour image waits for it."""
        if _frame_sensor(self._rs, frame) == Sensor.DEPTH:
            if self._is_registered:
                self._publish(Sensor.DEPTH, frame, memoryview(frame.get_data()).cast("B"))
            elif self._color is None:
                self._early = [*self._early[-WAITING_FRAMES:], frame]
            else:
                self._forward_depth(frame)
            return
        if self._color is None:
            self._color = frame  # laying depth on colour asks only how it sees, so any colour picture will do
        data = memoryview(frame.get_data()).cast("B")
        is_turned = frame.profile.format() == self._rs.format.bgr8
        self._publish(Sensor.COLOR, frame, _bgr_to_rgb(data) if is_turned else data)
        for early in self._early:
            self._forward_depth(early)
        self._early = []

    def _forward_depth(self, frame: Any) -> None:
        self._join.invoke(frame)
        both = self._joined.wait_for_frame(JOIN_MS).as_frameset()
        registered = self._align.process(both).get_depth_frame()
        self._publish(Sensor.DEPTH, registered, memoryview(registered.get_data()).cast("B"))

    def _publish(self, sensor: Sensor, frame: Any, picture: memoryview) -> None:
        self._outlet.publish(sensor, frame.get_frame_number(), round(frame.get_timestamp() * 1000.0), picture)


def _bgr_to_rgb(blue_first: memoryview) -> memoryview:
    out = bytearray(blue_first.nbytes)
    out[0::3], out[1::3], out[2::3] = blue_first[2::3], blue_first[1::3], blue_first[0::3]
    return memoryview(out)


class _RealSenseControls:
    """Exposure and white balance of the colour sensor."""

    def __init__(self, rs: Any, streams: RealsenseStreams) -> None:
        self._option = rs.option
        self._sensor = next(sensor for sensor, profiles in streams.opening if streams.color in profiles)
        self._max_exposure = max_exposure(streams.color.fps())

    def disable_automatic(self) -> tuple[bool, bool]:
        option, sensor = self._option, self._sensor
        return set_option(sensor, option.enable_auto_exposure, 0), set_option(
            sensor, option.enable_auto_white_balance, 0
        )

    def read_exposure(self) -> Control | None:
        found = self._read_control(self._option.exposure)
        return None if found is None else replace(found, max_value=min(found.max_value, self._max_exposure))

    def read_white_balance(self) -> Control | None:
        return self._read_control(self._option.white_balance)

    def apply(self, step: ColorSettings) -> None:
        set_nearest_option(self._sensor, self._option.exposure, step.exposure)
        if step.kelvin:
            set_nearest_option(self._sensor, self._option.white_balance, step.kelvin)

    def _read_control(self, option: Any) -> Control | None:
        if not self._sensor.supports(option):
            return None
        reach = self._sensor.get_option_range(option)
        return Control(float(self._sensor.get_option(option)), reach.min, reach.max)


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


def open_realsense(
    *,
    uri: str | None = None,
    camera: Camera | None = None,
    patience_s: float = math.inf,
    notice: NoticeHandler = ignore_notice,
    context: Callable[[], Any] | None = None,
) -> ProcessCamera:
    """Open the first camera, or the one with the serial number ``uri``.

    Raises :class:`ExtraMissing` without the library.
    """
    require_library()
    plan = CameraConfig(uri or "", SIZE_PX, models=MODELS, make_context=context)

    def opened_sensor(opened: DeviceOpened) -> DepthSensor:
        return find_sensor(opened.settings, math.nan if opened.lens is None else opened.lens.fx_px)

    return ProcessCamera(
        serve, plan, uri or "RealSense", opened_sensor, camera=camera, patience_s=patience_s, notice=notice
    )


def require_library() -> None:
    """Raise :class:`ExtraMissing` if the maker's library is not installed; loads nothing."""
    if find_spec(PACKAGE) is None:
        raise ExtraMissing(PACKAGE)


def find_sensor(settings: Mapping[str, str], color_focal_px: float = math.nan) -> DepthSensor:
    """Return the depth sensor of a camera with these settings; an unknown camera is taken for a D435.

    The noise is that of its own depth images; only the window is counted in pixels of colour.
    """
    name = settings.get("camera", "").upper()
    known = next((sensor for model, sensor in SENSORS.items() if model in name), None)
    sensor = replace(D435, origin=ASSUMED) if known is None else known
    focal_px = float(settings.get("depth_focal_px", "nan"))
    return sensor.with_focal(focal_px, color_focal_px) if focal_px > 0.0 else sensor


check_driver = partial(check_library, phrase("RealSense driver"), PACKAGE, load_library)
KIND = CameraKind(
    title="Intel RealSense",
    models=MODELS,
    open=open_realsense,
    check_driver=check_driver,
    needed_mbit=5000,
    port_advice=USB_3,
    check_settings=check_firmware_and_usb,
)

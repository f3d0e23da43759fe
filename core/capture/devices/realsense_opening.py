"""Opening a RealSense camera or recording inside the capture process: streams, settings, lens."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from carpus.core.capture.devices.capture_process import CameraPlan, GaveUp, why_unlisted
from carpus.core.capture.devices.usb_devices import usb_cameras
from carpus.core.capture.video_mode import Lens, PixelFormat, Sensor, VideoMode
from carpus.core.errors import CameraUnsuited, DriverMissing

PACKAGE = "pyrealsense2"
DEPTH_SIZE_PX = (848, 480)
"""The depth picture that the D435 and D455 measure best with."""
_NO_TURN = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
_SEES_LIKE = ("width", "height", "fx", "fy", "ppx", "ppy", "model", "coeffs")
UNIT_DIGITS = 7
"""The library keeps the unit of depth as a 32-bit number: 0.001 comes back as 0.00100000005."""


def library() -> Any:
    """The maker's library; raises :class:`DriverMissing` where it cannot be loaded."""
    try:
        import pyrealsense2
    except ImportError as cause:
        raise DriverMissing(PACKAGE, str(cause)) from cause
    return pyrealsense2


def load_library() -> None:
    """Load the library and no more, to see whether it can be; raises :class:`DriverMissing`."""
    library()


@dataclass(frozen=True, slots=True)
class RealsenseStreams:
    """The chosen colour profile and depth profile (None without depth), and which sensor opens which."""

    color: Any
    depth: Any | None
    opening: tuple[tuple[Any, tuple[Any, ...]], ...]

    @property
    def modes(self) -> dict[Sensor, VideoMode]:
        """Of the pictures that are handed on: depth is laid on colour, so it has its size."""
        width, height = self.color.width(), self.color.height()
        modes = {Sensor.COLOR: VideoMode(PixelFormat.RGB888, width, height, self.color.fps())}
        if self.depth is not None:
            modes[Sensor.DEPTH] = VideoMode(PixelFormat.DEPTH_1_MM, width, height, self.depth.fps())
        return modes


def find_camera(rs: Any, context: Any, plan: CameraPlan) -> Any:
    """The device to open; raises :class:`GaveUp` with why there is none."""
    listed = list(context.query_devices())
    for device in listed:
        if not plan.serial or said(rs, device, "serial_number") == plan.serial:
            return device
    names = [f"{said(rs, device, 'name')} {said(rs, device, 'serial_number')}".strip() for device in listed]
    raise why_unlisted(usb_cameras(plan.models), names)


def said(rs: Any, device: Any, fact: str) -> str:
    """What a device says of itself, by the library's name of the fact; empty where it says nothing."""
    info = getattr(rs.camera_info, fact)
    return str(device.get_info(info)) if device.supports(info) else ""


def camera_streams(rs: Any, device: Any, plan: CameraPlan) -> RealsenseStreams:
    """Colour of the wanted size and rate, depth as the camera measures it best; raises :class:`GaveUp`."""
    offered = _offered(rs, device)
    width, height = plan.size_px

    def nearness(profile: Any, size_px: tuple[int, int]) -> tuple[int, int]:
        return -abs(profile.fps() - plan.fps), -abs(profile.width() - size_px[0]) - abs(profile.height() - size_px[1])

    colors = [(sensor, each) for sensor, each in offered if each.format() == rs.format.rgb8 and _is_color(rs, each)]
    fitting = [pair for pair in colors if pair[1].width() <= width and pair[1].height() <= height]
    if not fitting:
        raise GaveUp(CameraUnsuited, f"no colour pictures of {width}x{height}")
    depths = [(sensor, each) for sensor, each in offered if _is_depth(rs, each)]
    if not depths:
        raise GaveUp(CameraUnsuited, "no depth")
    color = max(fitting, key=lambda pair: nearness(pair[1], plan.size_px))
    depth = max(depths, key=lambda pair: nearness(pair[1], DEPTH_SIZE_PX))
    return _streams([color, depth])


def stored_streams(rs: Any, playback: Any) -> RealsenseStreams:
    """Colour and, where there is any, depth of a recording; raises :class:`GaveUp`."""
    offered = _offered(rs, playback)
    colors = [pair for pair in offered if _is_color(rs, pair[1])]
    readable = [pair for pair in colors if pair[1].format() in (rs.format.rgb8, rs.format.bgr8)]
    if not readable:
        form = f"colour as {colors[0][1].format().name}" if colors else "no colour pictures"
        raise GaveUp(CameraUnsuited, form)
    depths = [pair for pair in offered if _is_depth(rs, pair[1])]
    return _streams([readable[0], *depths[:1]])


def prepare(rs: Any, streams: RealsenseStreams) -> dict[str, str]:
    """What a camera is set to before it streams; what of it took, for the session."""
    option = rs.option
    done: dict[str, str] = {}
    for sensor, profiles in streams.opening:
        # Times of the device itself: the library's fit to the computer's clock steps now and then.
        put(sensor, option.global_time_enabled, 0)
        if streams.depth in profiles:
            if put(sensor, option.visual_preset, int(rs.rs400_visual_preset.high_accuracy)):
                done["preset"] = "high accuracy"
            if put(sensor, option.emitter_enabled, 1):
                done["emitter"] = "on"
        automatic = put(sensor, option.enable_auto_exposure, 1)
        if streams.color in profiles:
            automatic = put(sensor, option.enable_auto_white_balance, 1) and automatic
            put(sensor, option.auto_exposure_priority, 0)  # the rate does not fall in a dark room
            done["automatic_exposure"] = "on" if automatic else "not settable"
    return done


def put(sensor: Any, option: Any, value: float) -> bool:
    """Set an option; whether the sensor has it and took it."""
    if not sensor.supports(option) or sensor.is_option_read_only(option):
        return False
    with suppress(RuntimeError):
        sensor.set_option(option, value)
        return True
    return False


def put_near(sensor: Any, option: Any, value: float) -> bool:
    """Set an option to the value nearest to this that the sensor takes: it refuses all between its steps."""
    if not sensor.supports(option):
        return False
    reach = sensor.get_option_range(option)
    step = reach.step or 1.0
    value = min(max(value, reach.min), reach.max)
    return put(sensor, option, reach.min + round((value - reach.min) / step) * step)


def depth_unit_m(rs: Any, streams: RealsenseStreams) -> float:
    """Metres per count of depth."""
    for sensor, profiles in streams.opening:
        if streams.depth in profiles and sensor.supports(rs.option.depth_units):
            return round(float(sensor.get_option(rs.option.depth_units)), UNIT_DIGITS)
    return 1e-3


def lens_of(rs: Any, profile: Any) -> Lens:
    """Intrinsics of a profile."""
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


def lies_on_color(streams: RealsenseStreams) -> bool:
    """Whether depth lies on colour as it comes; laying it there once more would only tear holes into it."""
    if streams.depth is None:
        return True
    towards = streams.depth.get_extrinsics_to(streams.color)
    here, there = streams.depth.get_intrinsics(), streams.color.get_intrinsics()
    unmoved = [*towards.rotation, *towards.translation] == [*_NO_TURN, 0.0, 0.0, 0.0]
    return unmoved and all(getattr(here, key) == getattr(there, key) for key in _SEES_LIKE)


def device_settings(rs: Any, device: Any, streams: RealsenseStreams) -> dict[str, str]:
    """What a session says of the camera; only what is known."""
    settings = {
        "camera": said(rs, device, "name") or "RealSense",
        "serial": said(rs, device, "serial_number"),
        "firmware": said(rs, device, "firmware_version"),
        "firmware_wanted": said(rs, device, "recommended_firmware_version"),
        "usb": said(rs, device, "usb_type_descriptor"),
        "library": f"librealsense {rs.__version__}",
        "color_mode": _mode_text(streams.color),
        "depth_mode": _mode_text(streams.depth) if streams.depth is not None else "",
        "lens_model": lens_of(rs, streams.color).model,
        "registered": "by the library" if streams.depth is not None else "",
    }
    if streams.depth is not None:
        settings["depth_focal_px"] = f"{streams.depth.get_intrinsics().fx:.2f}"
    return {key: value for key, value in settings.items() if value}


def _offered(rs: Any, device: Any) -> list[tuple[Any, Any]]:
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


def _streams(chosen: Sequence[tuple[Any, Any]]) -> RealsenseStreams:
    """A sensor that sends both (the D405's) is opened once, for both."""
    by_name: dict[str, tuple[Any, list[Any]]] = {}
    for number, (sensor, profile) in enumerate(chosen):
        by_name.setdefault(sensor.name or str(number), (sensor, []))[1].append(profile)
    opening = tuple((sensor, tuple(profiles)) for sensor, profiles in by_name.values())
    return RealsenseStreams(chosen[0][1], chosen[1][1] if len(chosen) > 1 else None, opening)


def _mode_text(profile: Any) -> str:
    return f"{profile.width()}x{profile.height()} {profile.format().name} {profile.fps()} fps"

"""Intel RealSense cameras of the D400 family, by the maker's library (the extra ``realsense``)."""

from __future__ import annotations

import math
import queue
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from carpus.core.camera import Camera
from carpus.core.capture.devices.camera_kind import CameraKind
from carpus.core.capture.devices.capture_process import (
    WAIT_MS,
    CameraPlan,
    GaveUp,
    Heard,
    Opened,
    Outlet,
    why_not_opened,
)
from carpus.core.capture.devices.color_lock import ColorLock, Control, Step
from carpus.core.capture.devices.maker_library import USB_3, further_findings, library_finding
from carpus.core.capture.devices.process_camera import SIZE_PX, ProcessCamera
from carpus.core.capture.devices.realsense_opening import (
    RealsenseStreams,
    camera_streams,
    depth_unit_m,
    device_settings,
    find_camera,
    lens_of,
    library,
    lies_on_color,
    load_library,
    prepare,
    put,
    put_near,
    stored_streams,
)
from carpus.core.capture.devices.usb_devices import usb_cameras
from carpus.core.capture.source import Notice, ignore
from carpus.core.capture.video_mode import Sensor
from carpus.core.depth_sensor import ASSUMED, D415, D435, D455, DepthSensor
from carpus.core.errors import DriverFailed, ExtraMissing, RecordingDamaged, RecordingUnsupported
from carpus.core.installing import Finding
from carpus.core.phrase import phrase

WAITING_FRAMES = 8
JOIN_MS = 1000
FILE_SILENCE_S = 5.0
LIGHT_SHARE = 0.9
"""Of a picture's time the longest exposure: a longer one would slow the camera down."""
EXPOSURE_UNIT_S = 1e-4
"""Of the colour sensor's exposure."""


def serve(outlet: Outlet, plan: CameraPlan | Path) -> None:
    """Serve a plan in the capture process."""
    rs = library()
    try:
        if isinstance(plan, Path):
            _play(rs, outlet, plan)
        else:
            _watch(rs, outlet, plan)
    except RuntimeError as failure:  # all that the library raises
        reason = " ".join(str(failure).split())
        if isinstance(plan, Path):
            raise GaveUp(DriverFailed, reason) from failure
        raise why_not_opened(reason, usb_cameras(plan.models)) from failure


def _watch(rs: Any, outlet: Outlet, plan: CameraPlan) -> None:
    """A camera: the newest pictures, whenever there are any."""
    context = plan.context() if plan.context is not None else rs.context()
    device = find_camera(rs, context, plan)
    gone = threading.Event()
    context.set_devices_changed_callback(lambda change: gone.set() if change.was_removed(device) else None)
    streams = camera_streams(rs, device, plan)
    settings = device_settings(rs, device, streams) | prepare(rs, streams)
    waiting: queue.Queue[Any] = queue.Queue(WAITING_FRAMES)
    outlet.hold(context, device, streams, waiting)

    def take(frame: Any) -> None:
        frame.keep()
        while True:
            try:
                waiting.put_nowait(frame)
                return
            except queue.Full:
                _next(waiting, 0.0)  # the oldest; its number is missing then, and counted

    _start(streams, take)
    pictures = _Pictures(rs, outlet, streams)
    hold = ColorLock(outlet, _Controls(rs, streams))
    outlet.lock_exposure = hold.begin
    is_told = False

    def pass_on(heard: Heard) -> None:
        nonlocal is_told
        frame = _next(waiting, WAIT_MS / 1000.0)
        if frame is None:
            return
        sensor = _sensor_of(rs, frame)
        heard.picture_of(sensor)
        if sensor == Sensor.COLOR and not is_told:
            outlet.send(_opened(rs, streams, settings | {"clock": _clock(rs, frame)}))
            is_told = True
        pictures.pass_on(frame)
        if sensor == Sensor.COLOR:
            hold.look(memoryview(frame.get_data()).cast("B"))

    outlet.watch(streams.modes, gone, pass_on)
    _stop(streams)


def _play(rs: Any, outlet: Outlet, path: Path) -> None:
    """A recording: each picture, the next only when there is room for it."""
    try:
        playback = rs.context().load_device(str(path))
        playback.set_real_time(False)
        streams = stored_streams(rs, playback)
    except RuntimeError as failure:
        raise GaveUp(RecordingDamaged, " ".join(str(failure).split())) from failure
    except GaveUp as failure:
        raise GaveUp(RecordingUnsupported, failure.detail) from failure
    waiting: queue.Queue[Any] = queue.Queue(WAITING_FRAMES)
    outlet.hold(playback, streams, waiting)

    def take(frame: Any) -> None:
        frame.keep()
        waiting.put(frame)  # the library reads on only when this is over

    settings = device_settings(rs, playback, streams)
    playback.pause()  # else it begins with the first sensor, and the other's pictures are lost
    _start(streams, take)
    playback.resume()
    pictures = _Pictures(rs, outlet, streams)
    heard = time.monotonic()
    is_told = False
    while not outlet.stopping:
        outlet.obey(block=not outlet.has_room)
        if not outlet.has_room:
            heard = time.monotonic()
            continue
        frame = _next(waiting, WAIT_MS / 1000.0)
        if frame is not None:
            heard = time.monotonic()
            if not is_told:
                outlet.send(_opened(rs, streams, settings | {"clock": _clock(rs, frame)}))
                is_told = True
            pictures.pass_on(frame)
        elif playback.current_status() == rs.playback_status.stopped and waiting.empty():
            if not is_told:
                raise GaveUp(RecordingDamaged, "no picture in it")
            return
        elif time.monotonic() - heard > FILE_SILENCE_S:
            raise GaveUp(RecordingDamaged, f"no picture for {FILE_SILENCE_S:g} s")
        outlet.stay_alive()


def _start(streams: RealsenseStreams, take: Callable[[Any], None]) -> None:
    for sensor, profiles in streams.opening:
        sensor.open(list(profiles))
    for sensor, _ in streams.opening:
        sensor.start(take)


def _stop(streams: RealsenseStreams) -> None:
    for sensor, _ in streams.opening:
        sensor.stop()
        sensor.close()


def _next(waiting: queue.Queue[Any], wait_s: float) -> Any | None:
    try:
        return waiting.get(timeout=wait_s) if wait_s > 0.0 else waiting.get_nowait()
    except queue.Empty:
        return None


def _sensor_of(rs: Any, frame: Any) -> Sensor:
    return Sensor.COLOR if frame.profile.stream_type() == rs.stream.color else Sensor.DEPTH


def _clock(rs: Any, frame: Any) -> str:
    """Whose time stamps are: the camera's, or those of arrival."""
    return "computer" if frame.get_frame_timestamp_domain() == rs.timestamp_domain.system_time else "camera"


def _opened(rs: Any, streams: RealsenseStreams, settings: dict[str, str]) -> Opened:
    mirrored = dict.fromkeys(streams.modes, False)
    return Opened(streams.modes, mirrored, None, settings, lens_of(rs, streams.color), depth_unit_m(rs, streams))


class _Pictures:
    """Passes colour on, and depth, laid on colour by the library; both with their own times."""

    def __init__(self, rs: Any, outlet: Outlet, streams: RealsenseStreams) -> None:
        self._rs, self._outlet = rs, outlet
        self._lies = lies_on_color(streams)
        self._align = rs.align(rs.stream.color)
        self._color: Any | None = None
        self._early: list[Any] = []
        self._joined = rs.frame_queue(1)
        self._join = rs.processing_block(self._both)
        self._join.start(self._joined)
        outlet.hold(self)

    def pass_on(self, frame: Any) -> None:
        """One picture; depth from before the first colour waits for it."""
        if _sensor_of(self._rs, frame) == Sensor.DEPTH:
            if self._lies:
                self._put(Sensor.DEPTH, frame, memoryview(frame.get_data()).cast("B"))
            elif self._color is None:
                self._early = [*self._early[-WAITING_FRAMES:], frame]
            else:
                self._depth(frame)
            return
        if self._color is None:
            self._color = frame  # laying depth on colour asks only how it sees, so any colour picture will do
        data = memoryview(frame.get_data()).cast("B")
        is_turned = frame.profile.format() == self._rs.format.bgr8
        self._put(Sensor.COLOR, frame, _turned(data) if is_turned else data)
        for early in self._early:
            self._depth(early)
        self._early = []

    def _depth(self, frame: Any) -> None:
        self._join.invoke(frame)
        both = self._joined.wait_for_frame(JOIN_MS).as_frameset()
        laid = self._align.process(both).get_depth_frame()
        self._put(Sensor.DEPTH, laid, memoryview(laid.get_data()).cast("B"))

    def _both(self, frame: Any, source: Any) -> None:
        source.frame_ready(source.allocate_composite_frame([frame, self._color]))

    def _put(self, sensor: Sensor, frame: Any, picture: memoryview) -> None:
        self._outlet.put(sensor, frame.get_frame_number(), round(frame.get_timestamp() * 1000.0), picture)


def _turned(blue_first: memoryview) -> memoryview:
    """Red first."""
    out = bytearray(blue_first.nbytes)
    out[0::3], out[1::3], out[2::3] = blue_first[2::3], blue_first[1::3], blue_first[0::3]
    return memoryview(out)


class _Controls:
    """Exposure and white balance of the colour sensor."""

    def __init__(self, rs: Any, streams: RealsenseStreams) -> None:
        self._option = rs.option
        self._sensor = next(sensor for sensor, profiles in streams.opening if streams.color in profiles)
        self._longest = LIGHT_SHARE / streams.color.fps() / EXPOSURE_UNIT_S

    def stop_following(self) -> tuple[bool, bool]:
        option, sensor = self._option, self._sensor
        return put(sensor, option.enable_auto_exposure, 0), put(sensor, option.enable_auto_white_balance, 0)

    def exposure(self) -> Control | None:
        found = self._control(self._option.exposure)
        return None if found is None else replace(found, most=min(found.most, self._longest))

    def balance(self) -> Control | None:
        return self._control(self._option.white_balance)

    def put(self, step: Step) -> None:
        put_near(self._sensor, self._option.exposure, step.exposure)
        if step.kelvin:
            put_near(self._sensor, self._option.white_balance, step.kelvin)

    def _control(self, option: Any) -> Control | None:
        if not self._sensor.supports(option):
            return None
        reach = self._sensor.get_option_range(option)
        return Control(float(self._sensor.get_option(option)), reach.min, reach.max)


PACKAGE = "pyrealsense2"
MODELS = {
    ("8086", "0ad3"): "Intel RealSense D415",
    ("8086", "0b07"): "Intel RealSense D435",
    ("8086", "0b3a"): "Intel RealSense D435i",
    ("8086", "0b5b"): "Intel RealSense D405",
    ("8086", "0b5c"): "Intel RealSense D455",
    ("8086", "1155"): "Intel RealSense D421",
}
"""The D421 has no colour camera: it is named, and opening it says so."""
SENSORS = {"D415": D415, "D435": D435, "D455": D455, "D456": D455, "D457": D455}


def open_realsense(
    *,
    uri: str | None = None,
    camera: Camera | None = None,
    patience_s: float = math.inf,
    notice: Notice = ignore,
    context: Callable[[], Any] | None = None,
) -> ProcessCamera:
    """The first camera, or the one whose serial number ``uri`` is; ``context`` as for :class:`CameraPlan`.

    Raises :class:`ExtraMissing` without the library.
    """
    require_library()
    plan = CameraPlan(uri or "", SIZE_PX, models=MODELS, context=context)
    return ProcessCamera(serve, plan, uri or "RealSense", _sensor, camera=camera, patience_s=patience_s, notice=notice)


def _sensor(opened: Opened) -> DepthSensor:
    """By the camera's name, and how its depth pictures see."""
    return sensor_named(opened.settings, math.nan if opened.lens is None else opened.lens.fx_px)


def require_library() -> None:
    """Raises :class:`ExtraMissing` where the maker's library is not installed; loads nothing."""
    if find_spec(PACKAGE) is None:
        raise ExtraMissing(PACKAGE)


def sensor_named(settings: Mapping[str, str], color_focal_px: float = math.nan) -> DepthSensor:
    """The depth sensor of a camera with these settings; assumed like a D435's where the name is not known. Its noise is
    in the geometry of its own depth pictures; only its window is counted in pixels of colour."""
    name = settings.get("camera", "").upper()
    known = next((sensor for model, sensor in SENSORS.items() if model in name), None)
    sensor = replace(D435, origin=ASSUMED) if known is None else known
    focal_px = float(settings.get("depth_focal_px", "nan"))
    return sensor.with_focal(focal_px, color_focal_px) if focal_px > 0.0 else sensor


def driver_finding(asks_version: bool = True, wanted: bool = True) -> Finding | None:
    """The maker's library, by its package; loaded, in a process of its own, only where a camera wants it."""
    return library_finding(phrase("RealSense driver"), PACKAGE, load_library, asks=asks_version, wanted=wanted)


KIND = CameraKind(
    title="Intel RealSense",
    models=MODELS,
    open=open_realsense,
    driver=driver_finding,
    needed_mbit=5000,
    port=USB_3,
    further=further_findings,
)

"""Orbbec's newer cameras (Femto Bolt and Mega, Gemini 2 and 330, Astra 2), by the maker's library pyorbbecsdk2."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import cv2

from carpus.core.camera import Camera
from carpus.core.capture.devices.camera_kind import CameraKind
from carpus.core.capture.devices.capture_process import WAIT_MS, CameraPlan, Heard, Opened, Outlet, why_not_opened
from carpus.core.capture.devices.color_lock import ColorLock, Control, Step
from carpus.core.capture.devices.maker_library import USB_3, further_findings, library_finding
from carpus.core.capture.devices.orbbec_opening import (
    MODULE,
    PACKAGE,
    OrbbecStreams,
    choose_streams,
    device_settings,
    find_camera,
    lens_of,
    library,
    load_library,
    prepare,
    put,
    whole_lens,
)
from carpus.core.capture.devices.process_camera import SIZE_PX, ProcessCamera
from carpus.core.capture.devices.usb_devices import usb_cameras
from carpus.core.capture.frame_assembly import LensBending, camera_of_lens
from carpus.core.capture.source import Notice, ignore
from carpus.core.capture.video_mode import Sensor
from carpus.core.depth_sensor import ASSUMED, AZURE_KINECT, D435, D455, DepthSensor
from carpus.core.errors import DriverMissing
from carpus.core.installing import Finding
from carpus.core.phrase import phrase

LIGHT_SHARE = 0.9
"""Of a picture's time the longest exposure: a longer one would slow the camera down."""
EXPOSURE_UNIT_S = 1e-4
"""Of the colour camera's exposure."""
UNIT_DIGITS = 7


def serve(outlet: Outlet, plan: CameraPlan) -> None:
    """Serve a plan in the capture process."""
    ob = library()
    try:
        _watch(ob, outlet, plan)
    except (RuntimeError, ob.OBError) as failure:  # all that the library raises
        raise why_not_opened(" ".join(str(failure).split()), usb_cameras(plan.models)) from failure


def _watch(ob: Any, outlet: Outlet, plan: CameraPlan) -> None:
    """The newest pictures, whenever there are any."""
    context = plan.context() if plan.context is not None else ob.Context()
    device = find_camera(ob, context, plan)
    serial = device.get_device_info().get_serial_number()
    gone = threading.Event()

    def changed(removed: Any, _added: Any) -> None:
        if serial in [removed.get_device_serial_number_by_index(each) for each in range(removed.get_count())]:
            gone.set()

    context.set_device_changed_callback(changed)
    pipeline = ob.Pipeline(device)
    streams = choose_streams(ob, pipeline, plan)
    settings = device_settings(ob, device, streams) | prepare(ob, device)
    config = ob.Config()
    config.enable_stream(streams.color)
    config.enable_stream(streams.depth)
    # each picture as it comes: Carpus pairs them by their times, and counts what is missing
    config.set_frame_aggregate_output_mode(ob.OBFrameAggregateOutputMode.ANY_SITUATION)
    outlet.hold(context, device, pipeline, streams, config, changed)
    pipeline.start(config)
    pictures = _Pictures(ob, outlet, streams)
    lock = ColorLock(outlet, _Controls(ob, device, streams))
    outlet.lock_exposure = lock.begin
    is_told = False

    def pass_on(heard: Heard) -> None:
        nonlocal is_told
        both = pipeline.wait_for_frames(WAIT_MS)
        color, depth = (None, None) if both is None else (both.get_color_frame(), both.get_depth_frame())
        if depth is not None:
            heard.picture_of(Sensor.DEPTH)
            if not is_told:  # a depth picture tells its unit, in millimetres
                unit_m = round(float(depth.get_depth_scale()) * 1e-3, UNIT_DIGITS)
                mirrored = dict.fromkeys(streams.modes, False)
                outlet.send(Opened(streams.modes, mirrored, None, settings, lens_of(ob, streams), unit_m))
                is_told = True
            pictures.pass_depth(depth)
        if color is not None:
            heard.picture_of(Sensor.COLOR)
            picture = pictures.pass_color(color)
            if picture is not None:
                lock.look(picture)

    outlet.watch(streams.modes, gone, pass_on)
    pipeline.stop()


class _Pictures:
    """Passes colour on, and depth, laid on colour by the library; both with the camera's own times."""

    def __init__(self, ob: Any, outlet: Outlet, streams: OrbbecStreams) -> None:
        self._outlet, self._shrink = outlet, streams.shrink
        self._is_jpeg = streams.color.get_format() == ob.OBFormat.MJPG
        self._align = ob.AlignFilter(align_to_stream=ob.OBStreamType.COLOR_STREAM)
        self._align.set_align_to_stream_profile(streams.color)
        # the library lays depth on what an ideal lens would see. It can bend it too, but then takes good readings away
        # beside missing ones, or all of them, by the model of the lens
        self._align.set_config_value("TargetDistortion", 0.0)
        self._bending = LensBending(camera_of_lens(*whole_lens(ob, streams.color)), streams.shrink)
        outlet.hold(self)

    def pass_color(self, frame: Any) -> memoryview | None:
        """Hand a colour picture on; its bytes, None of one that arrived damaged: it is left out, and counted."""
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
        return self._put(Sensor.COLOR, frame, picture)

    def pass_depth(self, frame: Any) -> None:
        """Hand a depth picture on; one that cannot be laid on colour is left out, and its frame has none."""
        laid = self._align.process(frame)
        if laid is None:
            return
        laid = laid.as_depth_frame()
        picture = laid.get_data().view("<u2").reshape(laid.get_height(), laid.get_width())
        self._put(Sensor.DEPTH, frame, self._bending.bend(picture))

    def _put(self, sensor: Sensor, frame: Any, picture: Any) -> memoryview:
        pixels = memoryview(picture.tobytes())
        self._outlet.put(sensor, int(frame.get_index()), int(frame.get_timestamp_us()), pixels)
        return pixels


class _Controls:
    """Exposure and white balance of the colour camera."""

    def __init__(self, ob: Any, device: Any, streams: OrbbecStreams) -> None:
        self._ob, self._device, self._prop = ob, device, ob.OBPropertyID
        self._longest = LIGHT_SHARE / streams.color.get_fps() / EXPOSURE_UNIT_S

    def stop_following(self) -> tuple[bool, bool]:
        exposure, balance = (
            put(self._ob, self._device, each, 0)
            for each in (self._prop.OB_PROP_COLOR_AUTO_EXPOSURE_BOOL, self._prop.OB_PROP_COLOR_AUTO_WHITE_BALANCE_BOOL)
        )
        return exposure, balance

    def exposure(self) -> Control | None:
        found = self._control(self._prop.OB_PROP_COLOR_EXPOSURE_INT)
        return None if found is None else replace(found, most=max(found.least, min(found.most, self._longest)))

    def balance(self) -> Control | None:
        return self._control(self._prop.OB_PROP_COLOR_WHITE_BALANCE_INT)

    def put(self, step: Step) -> None:
        self._put_near(self._prop.OB_PROP_COLOR_EXPOSURE_INT, step.exposure)
        if step.kelvin:
            self._put_near(self._prop.OB_PROP_COLOR_WHITE_BALANCE_INT, step.kelvin)

    def _control(self, prop: Any) -> Control | None:
        if not self._device.is_property_supported(prop, self._ob.OBPermissionType.PERMISSION_READ_WRITE):
            return None
        reach = self._device.get_int_property_range(prop)
        return Control(float(self._device.get_int_property(prop)), float(reach.min), float(reach.max))

    def _put_near(self, prop: Any, value: float) -> None:
        reach = self._device.get_int_property_range(prop)
        step = reach.step or 1
        value = min(max(value, reach.min), reach.max)
        put(self._ob, self._device, prop, reach.min + round((value - reach.min) / step) * step)


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
"""Product numbers as in the udev rules that come with the library."""
_WIDE = ("330L", "335L", "336L", "GEMINI 2")
"""Their eyes stand some 100 mm apart, those of the other Gemini cameras about 50 mm."""


def open_orbbec(
    *,
    uri: str | None = None,
    camera: Camera | None = None,
    patience_s: float = math.inf,
    notice: Notice = ignore,
    context: Callable[[], Any] | None = None,
) -> ProcessCamera:
    """The first camera, or the one whose serial number ``uri`` is; ``context`` as for :class:`CameraPlan`.

    Raises :class:`DriverMissing` without the library.
    """
    if find_spec(MODULE) is None:
        raise DriverMissing(PACKAGE, PACKAGE)
    plan = CameraPlan(uri or "", SIZE_PX, models=MODELS, context=context)
    return ProcessCamera(serve, plan, uri or "Orbbec", _sensor, camera=camera, patience_s=patience_s, notice=notice)


def _sensor(opened: Opened) -> DepthSensor:
    """By the camera's name, and how its depth pictures see."""
    return sensor_named(opened.settings, math.nan if opened.lens is None else opened.lens.fx_px)


def sensor_named(settings: Mapping[str, str], color_focal_px: float = math.nan) -> DepthSensor:
    """The depth sensor of a camera with these settings: a Femto's is the Azure Kinect's; two eyes and a projector are
    assumed to be as sure as a RealSense's with eyes as far apart, for want of figures."""
    name = settings.get("camera", "").upper()
    if "FEMTO" in name:
        return AZURE_KINECT
    pair = D455 if any(model in name for model in _WIDE) else D435
    focal_px = float(settings.get("depth_focal_px", "nan"))
    return replace(pair.with_focal(focal_px, color_focal_px) if focal_px > 0.0 else pair, origin=ASSUMED)


def driver_finding(asks_version: bool = True, wanted: bool = True) -> Finding | None:
    """The maker's library, by its package; loaded, in a process of its own, only where a camera wants it."""
    return library_finding(phrase("Orbbec driver"), PACKAGE, load_library, asks=asks_version, wanted=wanted)


KIND = CameraKind(
    title="Orbbec Femto, Gemini or Astra 2",
    models=MODELS,
    open=open_orbbec,
    driver=driver_finding,
    needed_mbit=5000,
    port=USB_3,
    further=further_findings,
)

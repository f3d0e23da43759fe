"""Intel RealSense cameras of the D400 family, by the maker's library (the extra ``realsense``)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from carpus.core.camera import Camera
from carpus.core.capture.camera_kind import CameraKind
from carpus.core.capture.camera_plan import CameraPlan
from carpus.core.capture.capture_messages import Opened
from carpus.core.capture.maker_library import USB_3, further_findings, library_finding
from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.process_camera import SIZE_PX, ProcessCamera
from carpus.core.capture.realsense_opening import load_library
from carpus.core.capture.realsense_process import serve
from carpus.core.depth_sensor import ASSUMED, D415, D435, D455, DepthSensor
from carpus.core.errors import ExtraMissing
from carpus.core.finding import Finding
from carpus.core.phrase import phrase

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

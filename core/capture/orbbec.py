"""Orbbec's newer cameras (Femto Bolt and Mega, Gemini 2 and 330, Astra 2), by the maker's library pyorbbecsdk2."""

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
from carpus.core.capture.orbbec_opening import MODULE, PACKAGE, load_library
from carpus.core.capture.orbbec_process import serve
from carpus.core.capture.process_camera import SIZE_PX, ProcessCamera
from carpus.core.depth_sensor import ASSUMED, AZURE_KINECT, D435, D455, DepthSensor
from carpus.core.errors import DriverMissing
from carpus.core.finding import Finding
from carpus.core.phrase import phrase

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

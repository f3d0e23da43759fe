"""Intel RealSense cameras of the D400 family, by the maker's library (the extra ``realsense``)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from carpus.core.camera import Camera
from carpus.core.capture.camera_kind import CameraKind
from carpus.core.capture.camera_plan import CameraPlan
from carpus.core.capture.capture_messages import Opened
from carpus.core.capture.maker_library import library_finding
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


class RealSenseCamera(ProcessCamera):
    """The first RealSense, or the one whose serial number ``uri`` is; ``context`` as for :class:`CameraPlan`.

    The rest as for :class:`ProcessCamera`. Raises :class:`ExtraMissing` without the library.
    """

    def __init__(
        self,
        *,
        uri: str | None = None,
        camera: Camera | None = None,
        patience_s: float = math.inf,
        notice: Notice = ignore,
        context: Callable[[], Any] | None = None,
    ) -> None:
        require_library()
        plan = CameraPlan(uri or "", SIZE_PX, models=MODELS, context=context)
        super().__init__(serve, plan, uri or "RealSense", D435, camera=camera, patience_s=patience_s, notice=notice)

    def depth_sensor(self, opened: Opened) -> DepthSensor:
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


def open_realsense(*, uri: str | None, camera: Camera | None, patience_s: float, notice: Notice) -> RealSenseCamera:
    """The first RealSense, or the one whose serial number ``uri`` is."""
    return RealSenseCamera(uri=uri, camera=camera, patience_s=patience_s, notice=notice)


def driver_finding(asks_version: bool = True, wanted: bool = True) -> Finding | None:
    """The maker's library, by its package; loaded, in a process of its own, only where a camera wants it."""
    return library_finding(phrase("RealSense driver"), PACKAGE, load_library, asks=asks_version, wanted=wanted)


def further_findings(settings: Mapping[str, str]) -> Sequence[Finding]:
    """Firmware and port of an opened camera."""
    findings = []
    firmware, wanted = settings.get("firmware", ""), settings.get("firmware_wanted", "")
    if firmware and wanted and _numbers(firmware) < _numbers(wanted):
        remedy = phrase("Bring the firmware up to date with the maker's RealSense Viewer.")
        findings.append(
            Finding(
                phrase("Firmware"),
                "warning",
                phrase("{firmware}, the library asks for {wanted}", firmware=firmware, wanted=wanted),
                remedy,
            )
        )
    elif firmware:
        findings.append(Finding(phrase("Firmware"), "good", firmware))
    usb = settings.get("usb", "")
    if usb.startswith("2"):
        findings.append(Finding("USB", "warning", f"USB {usb}", KIND.port))
    elif usb:
        findings.append(Finding("USB", "good", f"USB {usb}"))
    return findings


def _numbers(version_text: str) -> list[int]:
    return [int(part) if part.isdigit() else 0 for part in version_text.split(".")]


KIND = CameraKind(
    title="Intel RealSense",
    models=MODELS,
    open=open_realsense,
    driver=driver_finding,
    needed_mbit=5000,
    port=phrase("Plug it into a USB 3 port, with a USB 3 cable and without a hub."),
    further=further_findings,
)

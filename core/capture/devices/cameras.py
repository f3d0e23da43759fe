"""The live cameras that there are (one line here and one module for each), and what is known of a kind before one is
opened: for `carpus doctor` its library, and once it is open its firmware and port.

A module has ``KIND``, a :class:`CameraKind`. Loading it loads no driver.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Protocol

from carpus.core.camera import Camera
from carpus.core.capture.devices.usb_devices import UsbCamera, usb_cameras
from carpus.core.capture.source import Notice, ignore
from carpus.core.errors import CameraUnknown, DriverMissing
from carpus.core.installing import Finding, how_to_install
from carpus.core.names import known_names
from carpus.core.phrase import Phrase, phrase

if TYPE_CHECKING:
    from carpus.core.capture.devices.process_camera import ProcessCamera


def library_finding(
    name: str, package: str, load: Callable[[], None], asks: bool = True, wanted: bool = True
) -> Finding | None:
    """The maker's library by its package; loaded, in a process of its own, where ``asks`` and ``wanted``; None where it
    is missing and nothing wants it."""
    from importlib.metadata import PackageNotFoundError, version  # which every command would load here

    try:
        found = f"{package} {version(package)}"
    except PackageNotFoundError:
        found = phrase("missing: {package}", package=package)
        return Finding(name, "bad", found, how_to_install(package)) if wanted else None
    trouble = _load_trouble(load) if asks and wanted else ""
    if not trouble:
        return Finding(name, "good", found)
    return Finding(
        name,
        "bad",
        phrase("{found}, cannot be loaded: {trouble}", found=found, trouble=trouble),
        phrase("Install it, and what it names, again."),
    )


def _load_trouble(load: Callable[[], None]) -> str:
    """Why the library cannot be loaded; empty when it can. Only who asks loads what starts processes."""
    from carpus.core.child_process import ChildDied, call_in_child

    try:
        call_in_child(load)
    except DriverMissing as fault:
        return fault.detail
    except ChildDied:
        return "it ends its process"
    return ""


USB_3 = phrase("Plug it into a USB 3 port, with a USB 3 cable and without a hub.")


def further_findings(settings: Mapping[str, str]) -> Sequence[Finding]:
    """Firmware and port of an opened camera."""
    findings = []
    firmware, wanted, usb = (settings.get(key, "") for key in ("firmware", "firmware_wanted", "usb"))
    if firmware and wanted and _numbers(firmware) < _numbers(wanted):
        found = phrase("{firmware}, the library asks for {wanted}", firmware=firmware, wanted=wanted)
        remedy = phrase("Bring the firmware up to date with the maker's RealSense Viewer.")
        findings.append(Finding(phrase("Firmware"), "warning", found, remedy))
    elif firmware:
        findings.append(Finding(phrase("Firmware"), "good", firmware))
    if usb.startswith("2"):
        findings.append(Finding("USB", "warning", f"USB {usb}", USB_3))
    elif usb:
        findings.append(Finding("USB", "good", f"USB {usb}"))
    return findings


def _numbers(version_text: str) -> list[int]:
    return [int(part) if part.isdigit() else 0 for part in version_text.split(".")]


class Opening(Protocol):
    """Opens a camera. ``uri`` None: the first; ``camera``: measured intrinsics; ``patience_s``: how long it may be
    away before that is a fault. Its driver is loaded then and not before."""

    def __call__(
        self, *, uri: str | None, camera: Camera | None, patience_s: float, notice: Notice
    ) -> ProcessCamera: ...


def no_findings(_settings: Mapping[str, str]) -> Sequence[Finding]:
    """Of a kind of which nothing more is known."""
    return ()


@dataclass(frozen=True, slots=True)
class CameraKind:
    """``models`` are names by USB vendor and product (four hexadecimal digits each).

    ``driver`` says how its library is, None where nothing need be said: whether its version is asked (in a process
    of its own, half a second), and whether a camera of the kind is wanted; ``further`` what its settings, once
    opened, tell of firmware and port.
    """

    title: str
    models: Mapping[tuple[str, str], str]
    open: Opening
    driver: Callable[[bool, bool], Finding | None]
    needed_mbit: int
    port: Phrase
    further: Callable[[Mapping[str, str]], Sequence[Finding]] = no_findings

    @property
    def rules(self) -> str:
        """For udev, a line for each vendor: whoever sits at the computer may open the camera."""
        lines = []
        for vendor in sorted({vendor for vendor, _ in self.models}):
            products = "|".join(product for of, product in self.models if of == vendor)
            which = f'ATTR{{idVendor}}=="{vendor}", ATTR{{idProduct}}=="{products}"'
            lines.append(f'SUBSYSTEM=="usb", {which}, MODE="0660", TAG+="uaccess"')
        return "\n".join(lines)

    def seen(self) -> list[UsbCamera]:
        """Those plugged in; empty where the system does not tell."""
        return usb_cameras(self.models)


CAMERAS = {
    "xtion": "openni2_camera",
    "realsense": "realsense",
    "orbbec": "orbbec",
}
"""Module by kind; the first is the usual one."""


def kind_of(uri: str) -> str:
    """Which kind a camera's address names before its first colon; the usual one where it names none."""
    named = uri.partition(":")[0]
    return named if named in CAMERAS else next(iter(CAMERAS))


def check_address(uri: str) -> None:
    """Raise :class:`CameraUnknown` where ``uri`` names a kind that there is not.

    Without a kind it is OpenNI2's own address, ``1d27/0601@1/7``, which has a stroke, or empty.
    """
    named = uri.partition(":")[0]
    if named and named not in CAMERAS and "/" not in uri:
        raise CameraUnknown(named, known_names(named, CAMERAS))


def camera_kind(name: str) -> CameraKind:
    """The kind of that name."""
    kind: CameraKind = import_module(f"{__package__}.{CAMERAS[name]}").KIND
    return kind


def udev_rules() -> str:
    """Of all kinds, as the Debian package brings them."""
    return "".join(f"# {kind.title}\n{kind.rules}\n" for kind in map(camera_kind, CAMERAS))


def seen_cameras() -> list[tuple[str, UsbCamera]]:
    """The cameras plugged in, of all kinds, with the names of their kinds; empty where the system does not tell."""
    return [(name, camera) for name in CAMERAS for camera in camera_kind(name).seen()]


def name_to_open(uri: str = "") -> str | None:
    """Name of what :func:`open_camera` would open, empty where the system does not tell, None where there is none."""
    wanted = [camera.name for name, camera in seen_cameras() if not uri or name == kind_of(uri)]
    if wanted:
        return wanted[0]
    return None if sys.platform.startswith("linux") else ""


def kind_to_open(uri: str = "") -> str:
    """The kind that :func:`open_camera` opens: as named, else of the first that is plugged in, else the usual one."""
    return kind_of(uri) if uri else next((name for name, _ in seen_cameras()), kind_of(uri))


def open_camera(
    uri: str = "", *, camera: Camera | None = None, patience_s: float = math.inf, notice: Notice = ignore
) -> ProcessCamera:
    """Open a camera by its address (``KIND``, or ``KIND:`` and what the kind calls it); empty: the first plugged in.

    Raises :class:`CameraUnknown`, the faults of its module, and :class:`CameraLost` when it is away for more than
    ``patience_s``.
    """
    check_address(uri)
    name = kind_to_open(uri)
    named, _, which = uri.partition(":")
    place = which if named in CAMERAS else uri
    return camera_kind(name).open(uri=place or None, camera=camera, patience_s=patience_s, notice=notice)

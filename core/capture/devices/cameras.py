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

from carpus.core.capture.devices.usb_devices import UsbCamera, find_usb_cameras
from carpus.core.capture.source import NoticeHandler, ignore_notice
from carpus.core.model.camera import Camera
from carpus.core.model.errors import CameraUnknown, DriverMissing
from carpus.core.model.installation import Finding, install_hint
from carpus.core.model.names import describe_known_names
from carpus.core.model.phrase import Phrase, phrase

if TYPE_CHECKING:
    from carpus.core.capture.devices.process_camera import ProcessCamera


def check_library(
    name: str, package: str, load: Callable[[], None], loads_library: bool = True, is_needed: bool = True
) -> Finding | None:
    """The maker's library by its package; loaded, in a process of its own, where ``loads_library`` and ``is_needed``;
    None where it
    is missing and nothing wants it."""
    from importlib.metadata import PackageNotFoundError, version  # which every command would load here

    try:
        found = f"{package} {version(package)}"
    except PackageNotFoundError:
        found = phrase("missing: {package}", package=package)
        return Finding(name, "bad", found, install_hint(package)) if is_needed else None
    trouble = _find_load_error(load) if loads_library and is_needed else ""
    if not trouble:
        return Finding(name, "good", found)
    return Finding(
        name,
        "bad",
        phrase("{found}, cannot be loaded: {trouble}", found=found, trouble=trouble),
        phrase("Install it, and what it names, again."),
    )


def _find_load_error(load: Callable[[], None]) -> str:
    """Why the library cannot be loaded; empty when it can. Only who asks loads what starts processes."""
    from carpus.core.platform.child_process import ChildDiedError, call_in_child

    try:
        call_in_child(load)
    except DriverMissing as fault:
        return fault.detail
    except ChildDiedError:
        return "it ends its process"
    return ""


USB_3 = phrase("Plug it into a USB 3 port, with a USB 3 cable and without a hub.")


def check_firmware_and_usb(settings: Mapping[str, str]) -> Sequence[Finding]:
    """Firmware and port of an opened camera."""
    findings = []
    firmware, wanted, usb = (settings.get(key, "") for key in ("firmware", "firmware_wanted", "usb"))
    if firmware and wanted and _parse_version(firmware) < _parse_version(wanted):
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


def _parse_version(version_text: str) -> list[int]:
    return [int(part) if part.isdigit() else 0 for part in version_text.split(".")]


class CameraOpener(Protocol):
    """Opens a camera. ``uri`` None: the first; ``camera``: measured intrinsics; ``patience_s``: how long it may be
    away before that is a fault. Its driver is loaded then and not before."""

    def __call__(
        self, *, uri: str | None, camera: Camera | None, patience_s: float, notice: NoticeHandler
    ) -> ProcessCamera: ...


def no_findings(_settings: Mapping[str, str]) -> Sequence[Finding]:
    """Of a kind of which nothing more is known."""
    return ()


@dataclass(frozen=True, slots=True)
class CameraKind:
    """``models`` are names by USB vendor and product (four hexadecimal digits each).

    ``check_driver`` says how its library is, None where nothing need be said: whether its version is asked (in a
    process
    of its own, half a second), and whether a camera of the kind is wanted; ``check_settings`` what its settings, once
    opened, tell of firmware and port.
    """

    title: str
    models: Mapping[tuple[str, str], str]
    open: CameraOpener
    check_driver: Callable[[bool, bool], Finding | None]
    needed_mbit: int
    port_advice: Phrase
    check_settings: Callable[[Mapping[str, str]], Sequence[Finding]] = no_findings

    @property
    def udev_rules(self) -> str:
        """For udev, a line for each vendor: whoever sits at the computer may open the camera."""
        lines = []
        for vendor in sorted({vendor for vendor, _ in self.models}):
            products = "|".join(product for of, product in self.models if of == vendor)
            which = f'ATTR{{idVendor}}=="{vendor}", ATTR{{idProduct}}=="{products}"'
            lines.append(f'SUBSYSTEM=="usb", {which}, MODE="0660", TAG+="uaccess"')
        return "\n".join(lines)

    def find_connected(self) -> list[UsbCamera]:
        """Those plugged in; empty where the system does not tell."""
        return find_usb_cameras(self.models)


CAMERAS = {
    "xtion": "openni2_camera",
    "realsense": "realsense",
    "orbbec": "orbbec",
}
"""Module by kind; the first is the usual one."""


def parse_kind(uri: str) -> str:
    """Which kind a camera's address names before its first colon; the usual one where it names none."""
    named = uri.partition(":")[0]
    return named if named in CAMERAS else next(iter(CAMERAS))


def validate_address(uri: str) -> None:
    """Raise :class:`CameraUnknown` where ``uri`` names a kind that there is not.

    Without a kind it is OpenNI2's own address, ``1d27/0601@1/7``, which has a stroke, or empty.
    """
    named = uri.partition(":")[0]
    if named and named not in CAMERAS and "/" not in uri:
        raise CameraUnknown(named, describe_known_names(named, CAMERAS))


def load_camera_kind(name: str) -> CameraKind:
    """The kind of that name."""
    kind: CameraKind = import_module(f"{__package__}.{CAMERAS[name]}").KIND
    return kind


def format_udev_rules() -> str:
    """Of all kinds, as the Debian package brings them."""
    return "".join(f"# {kind.title}\n{kind.udev_rules}\n" for kind in map(load_camera_kind, CAMERAS))


def find_connected_cameras() -> list[tuple[str, UsbCamera]]:
    """The cameras plugged in, of all kinds, with the names of their kinds; empty where the system does not tell."""
    return [(name, camera) for name in CAMERAS for camera in load_camera_kind(name).find_connected()]


def find_camera_name(uri: str = "") -> str | None:
    """Name of what :func:`open_camera` would open, empty where the system does not tell, None where there is none."""
    wanted = [camera.name for name, camera in find_connected_cameras() if not uri or name == parse_kind(uri)]
    if wanted:
        return wanted[0]
    return None if sys.platform.startswith("linux") else ""


def choose_kind(uri: str = "") -> str:
    """The kind that :func:`open_camera` opens: as named, else of the first that is plugged in, else the usual one."""
    return parse_kind(uri) if uri else next((name for name, _ in find_connected_cameras()), parse_kind(uri))


def open_camera(
    uri: str = "", *, camera: Camera | None = None, patience_s: float = math.inf, notice: NoticeHandler = ignore_notice
) -> ProcessCamera:
    """Open a camera by its address (``KIND``, or ``KIND:`` and what the kind calls it); empty: the first plugged in.

    Raises :class:`CameraUnknown`, the faults of its module, and :class:`CameraLost` when it is away for more than
    ``patience_s``.
    """
    validate_address(uri)
    name = choose_kind(uri)
    named, _, which = uri.partition(":")
    place = which if named in CAMERAS else uri
    return load_camera_kind(name).open(uri=place or None, camera=camera, patience_s=patience_s, notice=notice)

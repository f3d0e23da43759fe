"""Registry of live cameras, the cameras on the USB bus, and why one of them cannot be opened.

A camera module has a ``KIND``, a :class:`CameraKind`. Importing it loads no driver.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carpus.core.capture.source import NoticeHandler, ignore_notice
from carpus.core.model import errors
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.errors import CarpusFault
from carpus.core.model.installation import Finding, install_hint
from carpus.core.model.names import describe_known_names
from carpus.core.model.phrase import Phrase, phrase

if TYPE_CHECKING:
    from carpus.core.capture.devices.capture_process import ServeFunction
    from carpus.core.capture.devices.process_camera import ProcessCamera


SYSFS = Path("/sys/bus/usb/devices")
DEVICE_NODES = Path("/dev/bus/usb")


@dataclass(frozen=True, slots=True)
class UsbCamera:
    """Camera on the bus, whether a driver can open it or not; ``speed_mbit`` is the speed of its port."""

    name: str
    vendor: str
    product: str
    node: Path
    speed_mbit: int
    can_open: bool
    is_claimed: bool


def find_usb_cameras(models: Mapping[tuple[str, str], str]) -> list[UsbCamera]:
    """Return the connected cameras among ``models`` (name by USB vendor and product, four hexadecimal digits each).

    Empty on systems without sysfs (no Linux).
    """
    found = []
    for device in sorted(SYSFS.glob("*")):
        vendor, product = _read_text(device / "idVendor"), _read_text(device / "idProduct")
        name = models.get((vendor, product))
        if name is None:
            continue
        bus, number = (int(_read_text(device / part) or 0) for part in ("busnum", "devnum"))
        node = DEVICE_NODES / f"{bus:03d}" / f"{number:03d}"
        drivers = [each.resolve().name for each in device.glob(f"{device.name}:*/driver")]
        speed = _read_text(device / "speed")
        speed_mbit, can_open = int(float(speed)) if speed else 0, os.access(node, os.R_OK | os.W_OK)
        found.append(UsbCamera(name, vendor, product, node, speed_mbit, can_open, "usbfs" in drivers))
    return found


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace").strip()
    except OSError:
        return ""


_BUSY_WORDS = ("busy", "in use", "errno=16")
_PERMISSION_WORDS = ("permission", "access denied", "usb_status_access", "errno=13")


def camera_unlisted_error(connected: Sequence[UsbCamera], listed: Sequence[str] = ()) -> CarpusFault:
    """Return why the driver does not list the wanted camera.

    The bus, which has the ``connected`` ones, does not state the serial numbers that drivers do: one that the driver
    has not ``listed`` may be the wanted one.
    """
    if len(connected) > len(listed):
        if locked := [camera.node for camera in connected if not camera.can_open]:
            return errors.CameraPermission("", str(locked[0]))
        if claimed := [camera.name for camera in connected if camera.is_claimed]:
            return errors.CameraBusy("", claimed[0])
        name = connected[0].name
        return errors.DriverFailed("", phrase("{name} is plugged in, but the driver does not see it", name=name))
    return errors.CameraMismatch("", ", ".join(listed)) if listed else errors.CameraMissing("", "")


def camera_open_error(reason: str, connected: Sequence[UsbCamera]) -> CarpusFault:
    """Return why the driver could not open a listed camera, from its own error message.

    Which driver claims the camera is no help: the driver that failed may have claimed it itself.
    """
    text = reason.lower()
    if any(word in text for word in _BUSY_WORDS):
        return errors.CameraBusy("", reason)
    locked = [str(camera.node) for camera in connected if not camera.can_open]
    if locked or any(word in text for word in _PERMISSION_WORDS):
        return errors.CameraPermission("", locked[0] if locked else reason)
    return errors.DriverFailed("", reason)


def require_package(package: str) -> str:
    """Return the name and version of a camera maker's package; raises :class:`ExtraMissing` without it."""
    from importlib.metadata import PackageNotFoundError, version  # which every command would load here

    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError as cause:
        raise errors.ExtraMissing(package) from cause


def check_package(
    name: str, package: str, import_sdk: Callable[[], object], loads_library: bool, is_needed: bool
) -> Finding | None:
    """Check the camera maker's library by its package; None if it is missing and not needed.

    It is loaded, in a process of its own, if ``loads_library`` and ``is_needed``.
    """
    from carpus.core.platform.child_process import ChildDiedError, call_in_child

    try:
        found = require_package(package)
    except errors.ExtraMissing:
        missing = phrase("missing: {package}", package=package)
        return Finding(name, "bad", missing, install_hint(package)) if is_needed else None
    try:
        if loads_library and is_needed:
            call_in_child(_load, import_sdk)
    except (errors.DriverMissing, ChildDiedError) as cause:
        trouble = cause.detail if isinstance(cause, errors.DriverMissing) else phrase("process ended")
        words = phrase("{found}, cannot be loaded: {trouble}", found=found, trouble=trouble)
        return Finding(name, "bad", words, phrase("Reinstall it and the library it names."))
    return Finding(name, "good", found)


def _load(import_sdk: Callable[[], object]) -> None:
    import_sdk()  # a module cannot be sent back


USB_3 = phrase("Plug it into a USB 3 port, with a USB 3 cable and without a hub.")


def check_firmware_and_usb(settings: Mapping[str, str]) -> Sequence[Finding]:
    """Check firmware and USB port of an opened camera."""
    findings = []
    firmware, wanted, usb = (settings.get(key, "") for key in ("firmware", "firmware_wanted", "usb"))
    if firmware and wanted and _parse_version(firmware) < _parse_version(wanted):
        found = phrase("{firmware}, the library asks for {wanted}", firmware=firmware, wanted=wanted)
        remedy = phrase("Update the firmware with the manufacturer’s RealSense Viewer.")
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


@dataclass(frozen=True, slots=True)
class CameraKind:
    """Kind of camera: its models, how it is opened and checked.

    Attributes
    ----------
    models : mapping
        Name by USB vendor and product (four hexadecimal digits each).
    serve : callable
        Serves a camera in the capture process.
    find_sensor : callable
        Depth sensor of an opened camera by its settings and the focal length of its colour images.
    check_driver : callable
        Finding on the library. Arguments: whether to load it (half a second), whether the kind is needed.
    needed_mbit : int
        Bandwidth that its images need.
    port_advice : str
        Advice on the port to use.
    check_settings : callable
        Further findings from the settings of an opened camera.
    package : str
        Python package of the maker's library.
    make_context : callable, optional
        Makes the library's context in the capture process (tests use a software device).
    """

    title: str
    models: Mapping[tuple[str, str], str]
    serve: ServeFunction
    find_sensor: Callable[[Mapping[str, str], float], DepthSensor]
    check_driver: Callable[[bool, bool], Finding | None]
    needed_mbit: int
    port_advice: Phrase
    check_settings: Callable[[Mapping[str, str]], Sequence[Finding]] = lambda _settings: ()
    package: str = ""
    make_context: Callable[[], Any] | None = None

    def open(
        self,
        uri: str = "",
        *,
        camera: Camera | None = None,
        patience_s: float = math.inf,
        notice: NoticeHandler = ignore_notice,
    ) -> ProcessCamera:
        """Open the first camera, or the one with the address or serial number ``uri``.

        ``camera`` are measured intrinsics; a camera absent for longer than ``patience_s`` raises :class:`CameraLost`.
        """
        from carpus.core.capture.devices.capture_process import CameraConfig
        from carpus.core.capture.devices.process_camera import ProcessCamera

        if self.package:
            require_package(self.package)
        plan = CameraConfig(uri, models=self.models, make_context=self.make_context)
        return ProcessCamera(
            self.serve, plan, uri or self.title, self.find_sensor, camera=camera, patience_s=patience_s, notice=notice
        )

    @property
    def udev_rules(self) -> str:
        """Udev rules that let the logged-in user open the cameras, one line for each vendor."""
        lines = []
        for vendor in sorted({vendor for vendor, _ in self.models}):
            products = "|".join(product for of, product in self.models if of == vendor)
            which = f'ATTR{{idVendor}}=="{vendor}", ATTR{{idProduct}}=="{products}"'
            lines.append(f'SUBSYSTEM=="usb", {which}, MODE="0660", TAG+="uaccess"')
        return "\n".join(lines)

    def find_connected(self) -> list[UsbCamera]:
        """Return the connected cameras of this kind; none on a system that does not list them."""
        return find_usb_cameras(self.models)


CAMERAS = {
    "xtion": "openni2_camera",
    "realsense": "realsense",
    "orbbec": "orbbec",
}
"""Module by kind; the first is the default."""


def parse_kind(uri: str) -> str:
    """Return the kind that a camera address names before its first colon, else the default."""
    kind_name = uri.partition(":")[0]
    return kind_name if kind_name in CAMERAS else next(iter(CAMERAS))


def validate_address(uri: str) -> None:
    """Raise :class:`CameraUnknown` if the address names an unknown kind.

    Without a kind it is an OpenNI2 address with a slash, such as ``1d27/0601@1/7``, or empty.
    """
    kind_name = uri.partition(":")[0]
    if kind_name and kind_name not in CAMERAS and "/" not in uri:
        raise errors.CameraUnknown(kind_name, describe_known_names(kind_name, CAMERAS))


def load_camera_kind(name: str) -> CameraKind:
    """Return the kind of a name."""
    kind: CameraKind = import_module(f"{__package__}.{CAMERAS[name]}").KIND
    return kind


def format_udev_rules() -> str:
    """Return the udev rules of all kinds, as the Debian package installs them."""
    return "".join(f"# {kind.title}\n{kind.udev_rules}\n" for kind in map(load_camera_kind, CAMERAS))


def find_connected_cameras() -> list[tuple[str, UsbCamera]]:
    """Return kind and camera of all connected cameras; none on a system that does not list them."""
    return [(name, camera) for name in CAMERAS for camera in load_camera_kind(name).find_connected()]


def find_camera_name(uri: str = "") -> str | None:
    """Return the name of the camera that :func:`open_camera` would open.

    Empty on a system that does not list its cameras; None if there is no camera.
    """
    wanted = [camera.name for name, camera in find_connected_cameras() if not uri or name == parse_kind(uri)]
    if wanted:
        return wanted[0]
    return None if sys.platform.startswith("linux") else ""


def choose_kind(uri: str = "") -> str:
    """Return the kind that :func:`open_camera` opens: the named, else the first connected, else the default."""
    return parse_kind(uri) if uri else next((name for name, _ in find_connected_cameras()), parse_kind(uri))


def open_camera(
    uri: str = "", *, camera: Camera | None = None, patience_s: float = math.inf, notice: NoticeHandler = ignore_notice
) -> ProcessCamera:
    """Open a camera by its address: empty (the first connected), ``KIND``, or ``KIND:`` and the kind's own address.

    Raises
    ------
    CameraUnknown
        The address names an unknown kind.
    CameraLost
        The camera was absent for more than ``patience_s``.
    CarpusFault
        Other faults of the camera's module.
    """
    validate_address(uri)
    name = choose_kind(uri)
    kind_name, _, which = uri.partition(":")
    place = which if kind_name in CAMERAS else uri
    return load_camera_kind(name).open(place, camera=camera, patience_s=patience_s, notice=notice)

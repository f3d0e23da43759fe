"""The live cameras that there are: one line here and one module for each.

A module has ``KIND``, a :class:`CameraKind`. Loading it loads no driver.
"""

from __future__ import annotations

import math
import sys
from importlib import import_module
from typing import TYPE_CHECKING

from carpus.core.capture.source import Notice, ignore
from carpus.core.errors import CameraUnknown
from carpus.core.names import known_names

if TYPE_CHECKING:
    from carpus.core.camera import Camera
    from carpus.core.capture.devices.camera_kind import CameraKind, LiveCamera
    from carpus.core.capture.devices.usb_devices import UsbCamera

CAMERAS = {
    "xtion": "xtion",
    "realsense": "realsense",
    "orbbec": "orbbec",
    "astra": "astra",
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
) -> LiveCamera:
    """Open a camera by its address (``KIND``, or ``KIND:`` and what the kind calls it); empty: the first plugged in.

    Raises :class:`CameraUnknown`, the faults of its module, and :class:`CameraLost` when it is away for more than
    ``patience_s``.
    """
    check_address(uri)
    name = kind_to_open(uri)
    named, _, which = uri.partition(":")
    place = which if named in CAMERAS else uri
    return camera_kind(name).open(uri=place or None, camera=camera, patience_s=patience_s, notice=notice)

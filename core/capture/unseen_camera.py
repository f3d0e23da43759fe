"""Why a driver does not list, or does not open, a camera: by what the operating system knows of it."""

from __future__ import annotations

from collections.abc import Sequence

from carpus.core.capture.capture_process import GaveUp
from carpus.core.capture.usb_devices import UsbCamera
from carpus.core.errors import CameraBusy, CameraMissing, CameraPermission, DriverFailed, OtherCamera

_BUSY = ("busy", "in use", "errno=16")
_NO_RIGHTS = ("permission", "access denied", "usb_status_access", "errno=13")


def why_unlisted(seen: Sequence[UsbCamera], listed: Sequence[str] = ()) -> GaveUp:
    """Of the cameras ``seen`` on the bus the driver lists only ``listed`` (in words), and the wanted is not among them.

    The bus does not tell the serial numbers that drivers tell: a camera that is not listed may be the wanted one.
    """
    if len(seen) > len(listed):
        for camera in seen:
            if not camera.may_open:
                return GaveUp(CameraPermission, str(camera.node))
        for camera in seen:
            if camera.is_claimed:
                return GaveUp(CameraBusy, camera.name)
        return GaveUp(DriverFailed, f"{seen[0].name} is plugged in, but the driver does not see it")
    return GaveUp(OtherCamera, ", ".join(listed)) if listed else GaveUp(CameraMissing, "")


def why_not_opened(reason: str, seen: Sequence[UsbCamera]) -> GaveUp:
    """The driver could not open a camera it lists, for this reason in its own words. Who holds it is no help here: the
    driver that failed may have taken it itself."""
    said = reason.lower()
    if any(word in said for word in _BUSY):
        return GaveUp(CameraBusy, reason)
    locked = [str(camera.node) for camera in seen if not camera.may_open]
    if locked or any(word in said for word in _NO_RIGHTS):
        return GaveUp(CameraPermission, locked[0] if locked else reason)
    return GaveUp(DriverFailed, reason)

"""USB cameras as the operating system lists them, whether a driver can open them or not."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

SYSFS = Path("/sys/bus/usb/devices")
DEVICE_NODES = Path("/dev/bus/usb")


@dataclass(frozen=True, slots=True)
class UsbCamera:
    """Camera on the bus; ``speed_mbit`` is the speed of its port."""

    name: str
    vendor: str
    product: str
    node: Path
    speed_mbit: int
    can_open: bool
    is_claimed: bool


def find_usb_cameras(
    models: Mapping[tuple[str, str], str], sysfs: Path = SYSFS, nodes: Path = DEVICE_NODES
) -> list[UsbCamera]:
    """Return the connected cameras among ``models`` (name by USB vendor and product, four hexadecimal digits each).

    Empty on systems without sysfs (no Linux).
    """
    found = []
    for device in sorted(sysfs.glob("*")) if sysfs.is_dir() else []:
        vendor, product = _read_text(device / "idVendor"), _read_text(device / "idProduct")
        name = models.get((vendor, product))
        if name is None:
            continue
        bus, number = (int(_read_text(device / part) or 0) for part in ("busnum", "devnum"))
        node = nodes / f"{bus:03d}" / f"{number:03d}"
        drivers = [each.resolve().name for each in device.glob(f"{device.name}:*/driver")]
        speed = _read_text(device / "speed")
        found.append(
            UsbCamera(
                name,
                vendor,
                product,
                node,
                int(float(speed)) if speed else 0,
                os.access(node, os.R_OK | os.W_OK),
                "usbfs" in drivers,
            )
        )
    return found


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace").strip()
    except OSError:
        return ""

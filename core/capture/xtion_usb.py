"""What the operating system knows of cameras that the driver can serve, whether it can open them or not."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

SYSFS = Path("/sys/bus/usb/devices")
DEVICE_NODES = Path("/dev/bus/usb")
PRIMESENSE = "1d27"
PRODUCTS = {
    "0500": "PrimeSense Carmine",
    "0600": "Asus Xtion Pro Live",
    "0601": "Asus Xtion Pro Live",
    "0609": "PrimeSense Carmine 1.09",
}


@dataclass(frozen=True, slots=True)
class UsbCamera:
    """One camera on the bus. ``speed_mbit`` is what the port gives it; it needs 480."""

    name: str
    product: str
    node: Path
    speed_mbit: int
    may_open: bool
    is_claimed: bool


def usb_cameras(sysfs: Path = SYSFS, nodes: Path = DEVICE_NODES) -> list[UsbCamera]:
    """The cameras plugged in; empty where the system does not tell (no Linux)."""
    found = []
    for device in sorted(sysfs.glob("*")) if sysfs.is_dir() else []:
        if _text(device / "idVendor") != PRIMESENSE:
            continue
        product = _text(device / "idProduct")
        if product not in PRODUCTS:
            continue
        bus, number = (int(_text(device / part) or 0) for part in ("busnum", "devnum"))
        node = nodes / f"{bus:03d}" / f"{number:03d}"
        drivers = [each.resolve().name for each in device.glob(f"{device.name}:*/driver")]
        speed = _text(device / "speed")
        found.append(
            UsbCamera(
                PRODUCTS[product],
                product,
                node,
                int(float(speed)) if speed else 0,
                os.access(node, os.R_OK | os.W_OK),
                "usbfs" in drivers,
            )
        )
    return found


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace").strip()
    except OSError:
        return ""

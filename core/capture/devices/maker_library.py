"""What `carpus doctor` sees of a maker's camera: its library, and once it is open its firmware and port."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib.metadata import PackageNotFoundError, version

from carpus.core.errors import DriverMissing
from carpus.core.installing import Finding, how_to_install
from carpus.core.phrase import phrase


def library_finding(name: str, package: str, load: Callable[[], None], *, asks: bool, wanted: bool) -> Finding | None:
    """The library by its package; loaded, in a process of its own, where ``asks`` and ``wanted``; None where it is
    missing and nothing wants it."""
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
    """Why the library cannot be loaded; empty when it can."""
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as other:
            other.submit(load).result()
    except DriverMissing as fault:
        return fault.detail
    except BrokenProcessPool:
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

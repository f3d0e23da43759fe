"""What Carpus knows of a kind of live camera before one is opened."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from carpus.core.camera import Camera
from carpus.core.capture.devices.usb_devices import UsbCamera, usb_cameras
from carpus.core.capture.source import FrameSource, Notice
from carpus.core.installing import Finding
from carpus.core.phrase import Phrase


class LiveCamera(FrameSource, Protocol):
    """A source of frames that runs from construction on."""

    def lock_exposure(self) -> None:
        """From now on colours stay as they are."""
        ...


class Opening(Protocol):
    """Opens a camera. ``uri`` None: the first; ``camera``: measured intrinsics; ``patience_s``: how long it may be
    away before that is a fault. Its driver is loaded then and not before."""

    def __call__(self, *, uri: str | None, camera: Camera | None, patience_s: float, notice: Notice) -> LiveCamera: ...


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

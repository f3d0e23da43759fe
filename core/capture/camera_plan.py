"""What the capture process is asked to do with a live camera."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class CameraPlan:
    """Open a live camera: the first, or the one with this serial number; ``models`` names what may be plugged in, by
    USB vendor and product; ``uri`` is OpenNI2's address of the one to open, empty for any.

    ``context`` makes the library's context in the capture process; None: the one of the real bus. A stand-in puts a
    software device of the library there, which is then found, opened and read like a camera.
    """

    serial: str = ""
    size_px: tuple[int, int] = (640, 480)
    fps: int = 30
    models: Mapping[tuple[str, str], str] = field(default_factory=dict)
    context: Callable[[], Any] | None = None
    uri: str = ""

"""What the capture process of OpenNI2 is asked to do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from carpus.core.capture.video_mode import Sensor


@dataclass(frozen=True, slots=True)
class FilePlan:
    """Play a recording in order, picture by picture. ``last_number`` ends each stream that is wanted.

    ``deadly`` are positions of pictures on which the library dies: it gets a private copy with these spoilt.
    """

    path: str
    identity: tuple[int, int]
    last_number: Mapping[Sensor, int]
    deadly: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class CameraPlan:
    """Open a live camera: the first one of ``models`` (names by USB vendor and product), or the one at ``uri``.

    ``size_px`` is the picture size to ask for; with ``serial`` the camera with this serial number and no other.
    """

    uri: str | None = None
    size_px: tuple[int, int] = (640, 480)
    fps: int = 30
    models: Mapping[tuple[str, str], str] = field(default_factory=dict)
    serial: str = ""

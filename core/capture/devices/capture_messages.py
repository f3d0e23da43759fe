"""What the capture process and its owner tell each other through a pipe. Pictures go through shared memory."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from carpus.core.capture.video_mode import Lens, Sensor, VideoMode
from carpus.core.errors import CarpusFault


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


@dataclass(frozen=True, slots=True)
class Ring:
    """The shared memory: ``slots`` pictures of at most ``slot_bytes``."""

    name: str
    slots: int
    slot_bytes: int


@dataclass(frozen=True, slots=True)
class Alive:
    """The process is up and not stuck in the driver."""


@dataclass(frozen=True, slots=True)
class Opened:
    """The device is open and its streams run; ``modes`` are those of the pictures that come through the ring.

    ``settings`` goes into the session; ``lens`` where the driver knows it, else perhaps the ``field_of_view_rad``.
    ``frame_count``: colour pictures of a recording, None where nobody knows.
    """

    modes: Mapping[Sensor, VideoMode]
    mirrored: Mapping[Sensor, bool]
    field_of_view_rad: tuple[float, float] | None
    settings: Mapping[str, str]
    lens: Lens | None = None
    depth_unit_m: float = 1e-3
    frame_count: int | None = None


@dataclass(frozen=True, slots=True)
class Arrived:
    """A picture lies in ``slot`` until :class:`Free` gives it back. ``overrun`` were dropped for want of a slot."""

    sensor: Sensor
    slot: int
    number: int
    timestamp_us: int
    overrun: int


@dataclass(frozen=True, slots=True)
class Broken:
    """A picture whose size, format or stride was not as agreed; its memory was not read."""

    sensor: Sensor
    number: int


@dataclass(frozen=True, slots=True)
class ExposureSet:
    """Automatic exposure and white balance were locked or freed; ``done`` whether the camera can."""

    locked: bool
    done: bool


@dataclass(frozen=True, slots=True)
class Ended:
    """The recording is over, or the process was asked to stop."""


@dataclass(frozen=True, slots=True)
class Trouble:
    """The process gives up; ``fault`` and ``detail`` say why."""

    fault: type[CarpusFault]
    detail: str


@dataclass(frozen=True, slots=True)
class Free:
    """To the process: ``slot`` may be written again."""

    slot: int


@dataclass(frozen=True, slots=True)
class LockExposure:
    """To the process: keep exposure and white balance as they are, or let them adapt again."""

    locked: bool


@dataclass(frozen=True, slots=True)
class Stop:
    """To the process: close the device and end."""


Report = Alive | Opened | Arrived | Broken | ExposureSet | Ended | Trouble
Command = Free | LockExposure | Stop

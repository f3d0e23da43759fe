"""What the capture process and its owner tell each other through a pipe. Pictures go through shared memory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from carpus.core.capture.openni2 import Sensor, VideoMode
from carpus.core.errors import CarpusFault


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
    """Open a live camera: the first one, or the one at ``uri``. ``size_px`` is the picture size to ask for."""

    uri: str | None = None
    size_px: tuple[int, int] = (640, 480)
    fps: int = 30


@dataclass(frozen=True, slots=True)
class Ring:
    """The shared memory: ``slots`` pictures of at most ``slot_bytes``."""

    name: str
    slots: int
    slot_bytes: int


@dataclass(frozen=True, slots=True)
class Alive:
    """The process is up and not stuck in the library."""


@dataclass(frozen=True, slots=True)
class Opened:
    """The device is open and its streams run. ``settings`` goes into the session."""

    modes: Mapping[Sensor, VideoMode]
    mirrored: Mapping[Sensor, bool]
    field_of_view_rad: tuple[float, float] | None
    settings: Mapping[str, str]


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


Plan = FilePlan | CameraPlan
Report = Alive | Opened | Arrived | Broken | ExposureSet | Ended | Trouble
Command = Free | LockExposure | Stop

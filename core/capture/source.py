"""What every source of frames looks like to the rest of Carpus."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol

from carpus.core.camera import Camera
from carpus.core.depth_sensor import DepthSensor
from carpus.core.errors import CarpusFault
from carpus.core.types import SIMULATED, Frame

SERIAL, GIVEN = "serial", "serial_given"
"""Settings of a source: which camera it is, and that its number is a name that a person gave."""
Notice = Callable[[CarpusFault], None]
"""Hears of faults that are told and not raised: the source goes on. Called where it is opened or frames are read."""


def ignore(_fault: CarpusFault) -> None:
    """For those who do not want to be told."""


@dataclass(frozen=True, slots=True)
class SourceInfo:
    """Facts about a source. ``frame_count`` is None for a live camera; ``has_depth`` whether depth comes at all.

    ``settings`` (sensor name, driver, modes, registration ...) goes into the session's parameters; ``simulated`` is
    "yes" there for pictures of a simulated hand. ``recording_id`` and ``recorded`` (ISO 8601 with zone) where the
    recording says itself which it is and when the hand moved; empty where it does not.
    """

    name: str
    camera: Camera
    has_depth: bool
    frame_count: int | None
    nominal_fps: float
    settings: Mapping[str, str] = field(default_factory=dict)
    recording_id: str = ""
    recorded: str = ""

    @property
    def sensor(self) -> DepthSensor:
        """The depth sensor; it goes with the camera to whoever weighs its readings."""
        return self.camera.sensor

    @property
    def serial(self) -> str:
        """Which camera it is; empty where nobody knows."""
        return self.settings.get(SERIAL, "")

    @property
    def is_nameless(self) -> bool:
        """Whether the camera does not tell its number by itself."""
        return not self.serial or GIVEN in self.settings


def is_simulated(info: SourceInfo) -> bool:
    """Whether a source shows a simulated hand."""
    return info.settings.get(SIMULATED) == "yes"


class FrameSource(Protocol):
    """Frames in order, each with its own time; iterating raises a typed fault, never yields a wrong picture."""

    @property
    def info(self) -> SourceInfo: ...

    def frames(self) -> Iterator[Frame]:
        """Frames from the first on. A stored recording may be walked through again; a camera may not."""
        ...

    def close(self) -> None:
        """Give back the device or files; may be called twice."""
        ...

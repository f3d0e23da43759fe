"""What every source of frames looks like to the rest of Carpus; which recording it is, and when the hand moved: facts
of the recording, not of whoever reads it."""

from __future__ import annotations

import hashlib
import uuid
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, NamedTuple, Protocol

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.dates import is_moment, moment_from_timestamp, to_iso
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.errors import CarpusFault
from carpus.core.model.types import SIMULATED, Frame

SERIAL, SERIAL_GIVEN = "serial", "serial_given"
"""Settings of a source: which camera it is, and that its number is a name that a person gave."""
NoticeHandler = Callable[[CarpusFault], None]
"""Hears of faults that are told and not raised: the source goes on. Called where it is opened or frames are read."""


def ignore_notice(_fault: CarpusFault) -> None:
    """For those who do not want to be told."""


@dataclass(frozen=True, slots=True)
class SourceInfo:
    """Facts about a source. ``frame_count`` is None for a live camera; ``has_depth`` whether depth comes at all.

    ``settings`` (sensor name, driver, modes, registration ...) goes into the session's parameters; ``simulated`` is
    "yes" there for pictures of a simulated hand. ``compute_recording_id`` and ``recorded`` (ISO 8601 with zone) where
    the
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
        return self.settings.get(SERIAL, "")

    @property
    def is_nameless(self) -> bool:
        """Whether the camera does not tell its number by itself."""
        return not self.serial or SERIAL_GIVEN in self.settings


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


DateSource = Literal["asked", "recording", "times", "file"]
"""A person; the recording itself; the times of its pictures, which count from 1970; the date of its file."""


class RecordingDate(NamedTuple):
    """``time`` the hand moved, ISO 8601 with zone, and who says so."""

    time: str
    source: DateSource


def compute_recording_id(info: SourceInfo, first: Frame) -> str:
    """The identity of a recording: its own, else one made of its first frame, the same whenever it is read.

    Of the frame's time and depth, which are stored without loss everywhere; of the colour where there is no depth.
    """
    with suppress(ValueError):
        return str(uuid.UUID(info.recording_id))
    picture = first.color_rgb if first.depth_raw is None else first.depth_raw
    digest = hashlib.sha256(np.float64(first.timestamp_s).tobytes() + np.ascontiguousarray(picture).tobytes())
    return str(uuid.uuid5(uuid.NAMESPACE_OID, digest.hexdigest()))


def find_recording_date(info: SourceInfo, first_s: float, path: Path | None) -> RecordingDate | None:
    """When a stored recording was made; the date of its file is the last resort, None where there is none."""
    if is_moment(info.recorded):
        return RecordingDate(info.recorded, "recording")
    by_times = moment_from_timestamp(first_s)
    if by_times is not None:
        return RecordingDate(to_iso(by_times), "times")
    if path is None or not path.exists():
        return None
    return RecordingDate(to_iso(datetime.fromtimestamp(path.stat().st_mtime, UTC)), "file")

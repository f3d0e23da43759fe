"""What all sources of frames share: modes of their images, facts, protocol; identity and date of a recording."""

from __future__ import annotations

import hashlib
import uuid
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from enum import IntEnum
from pathlib import Path
from typing import Literal, NamedTuple, Protocol

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.dates import is_moment, moment_from_timestamp, to_iso
from carpus.core.model.errors import CarpusFault
from carpus.core.model.types import SIMULATED, Frame

SERIAL, SERIAL_GIVEN = "serial", "serial_given"
"""Settings of a source: the camera's serial number, and whether a person gave it as a name."""
NoticeHandler = Callable[[CarpusFault], None]
"""Receives notices (faults that are not raised) while the source goes on."""


def ignore_notice(_fault: CarpusFault) -> None:
    """Ignore a notice."""


class Sensor(IntEnum):
    """Kinds of streams; the numbers are OpenNI2's."""

    IR = 1
    COLOR = 2
    DEPTH = 3


class PixelFormat(IntEnum):
    """Pixel formats that occur; the numbers are OpenNI2's."""

    DEPTH_1_MM = 100
    DEPTH_100_UM = 101
    RGB888 = 200
    YUV422 = 201
    GRAY8 = 202
    GRAY16 = 203
    JPEG = 204
    YUYV = 205


@dataclass(frozen=True, slots=True)
class VideoMode:
    """Size, rate and pixel format of a stream."""

    pixel_format: int
    width_px: int
    height_px: int
    fps: int

    def __str__(self) -> str:
        names = {int(item): item.name for item in PixelFormat}
        return f"{self.width_px}x{self.height_px} {names.get(self.pixel_format, self.pixel_format)} {self.fps} fps"


@dataclass(frozen=True, slots=True)
class Lens:
    """Intrinsics of the colour images as the driver states them, px, with distortion model and coefficients."""

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    model: str
    coefficients: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class SourceInfo:
    """Facts about a source.

    Attributes
    ----------
    camera : Camera
        Intrinsics of the colour images.
    has_depth : bool
        Whether there is any depth.
    frame_count : int, optional
        None for a live camera.
    settings : mapping
        Camera, driver, modes, registration ...; stored in the session's parameters. ``simulated`` is "yes" for a
        simulated hand.
    recording_id, recorded : str
        Identity and date (ISO 8601 with zone) that the recording itself states, else empty.
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
    def serial(self) -> str:
        return self.settings.get(SERIAL, "")

    @property
    def is_nameless(self) -> bool:
        """Whether the camera has no serial number of its own."""
        return not self.serial or SERIAL_GIVEN in self.settings


def is_simulated(info: SourceInfo) -> bool:
    """Return whether a source shows a simulated hand."""
    return info.settings.get(SIMULATED) == "yes"


class FrameSource(Protocol):
    """Source of frames in order of time; iterating raises a fault rather than yielding a wrong image."""

    @property
    def info(self) -> SourceInfo: ...

    def frames(self) -> Iterator[Frame]:
        """Yield frames from the first on. A stored recording can be repeated, a camera cannot."""
        ...

    def close(self) -> None:
        """Release device or files; may be called twice."""
        ...


class RecordingDate(NamedTuple):
    """Time of a recording (ISO 8601 with zone) as a person, itself, its times since 1970 or its file's date say."""

    time: str
    source: Literal["asked", "recording", "times", "file"]


def compute_recording_id(info: SourceInfo, first: Frame) -> str:
    """Return the identity of a recording: its own, else a UUID made of its first frame.

    The UUID is made of time and depth, which are lossless in every format, or of colour if there is no depth.
    """
    with suppress(ValueError):
        return str(uuid.UUID(info.recording_id))
    picture = first.color_rgb if first.depth_raw is None else first.depth_raw
    digest = hashlib.sha256(np.float64(first.timestamp_s).tobytes() + np.ascontiguousarray(picture).tobytes())
    return str(uuid.uuid5(uuid.NAMESPACE_OID, digest.hexdigest()))


def find_recording_date(info: SourceInfo, first_s: float, path: Path | None) -> RecordingDate | None:
    """Return when a recording was made, as a last resort the date of its file; None if unknown."""
    if is_moment(info.recorded):
        return RecordingDate(info.recorded, "recording")
    by_times = moment_from_timestamp(first_s)
    if by_times is not None:
        return RecordingDate(to_iso(by_times), "times")
    if path is None or not path.exists():
        return None
    return RecordingDate(to_iso(datetime.fromtimestamp(path.stat().st_mtime, UTC)), "file")

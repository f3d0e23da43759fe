"""A session as values: what the writer takes and the reader gives. Arrays read are read-only."""

from __future__ import annotations

import json
import math
import uuid
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from datetime import datetime
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.dates import is_moment
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.names import normalize_name
from carpus.core.model.types import (
    SIMULATED,
    BoolArray,
    Detections,
    FloatArray,
    KinematicState,
    Side,
    SurfaceSamples,
    TrackedFrame,
)
from carpus.core.platform.version import __version__

IntArray = NDArray[np.integer]

MAX_TARGET_DEG = 180.0
"""No joint goes further; what a file claims beyond it is no target."""
SET_UP = "set_up"
"""The part of a session's parameters that says what was aimed at."""


@dataclass(frozen=True, slots=True)
class SessionHeader:
    """Who, when, what and with which settings; never a name or a birth date.

    ``recorded`` when the hand moved, empty where nobody knows, and ``created`` when the file was made, both ISO 8601
    with zone; ``recording_id`` is that of every result of one recording; ``joint_names`` empty for ``wrist6``;
    ``parameters`` JSON of all settings;
    ``origin`` the session this one was tracked again from, else empty.
    """

    session_id: str
    subject_id: str
    created: str
    hand: Side
    protocol: MarkerProtocol
    exercise: str
    software_version: str
    parameters: str
    origin: str = ""
    joint_names: tuple[str, ...] = ()
    recorded: str = ""
    recording_id: str = ""

    def __post_init__(self) -> None:
        for name, moment in (("created", self.created), ("recorded", self.recorded or self.created)):
            if not is_moment(moment):
                raise ValueError(f"{name} without a time zone: {moment}")
        object.__setattr__(self, "recording_id", self.recording_id or self.session_id)
        json.loads(self.parameters)
        if bool(self.joint_names) != self.protocol.has_fingers:
            raise ValueError(f"{self.protocol.name} with {len(self.joint_names)} joint angles")

    @property
    def recording_time(self) -> datetime:
        """When the hand moved; where nobody knows, when the file was made."""
        return datetime.fromisoformat(self.recorded or self.created)

    @property
    def is_simulated(self) -> bool:
        """Whether the pictures were of a simulated hand, as their source said: nobody's movement was measured."""
        return self._read_section("source").get(SIMULATED) == "yes"

    @property
    def set_up(self) -> Mapping[str, Any]:
        """What was aimed at; empty where the session does not say."""
        return self._read_section(SET_UP)

    @property
    def targets_deg(self) -> tuple[float, float]:
        """Targets of the exercise as set up, signed degrees of its positive and negative direction; NaN for none."""
        values = self.set_up.get("targets_deg")
        if not isinstance(values, list) or len(values) != 2:
            return math.nan, math.nan
        positive, negative = (
            float(value) if isinstance(value, (int, float)) and abs(value) <= MAX_TARGET_DEG else math.nan
            for value in values
        )
        return positive, negative

    def _read_section(self, name: str) -> Mapping[str, Any]:
        parameters = json.loads(self.parameters)
        part = parameters.get(name) if isinstance(parameters, dict) else None
        return part if isinstance(part, dict) else {}


def new_header(
    *,
    hand: Side,
    protocol: MarkerProtocol,
    subject_id: str = "",
    exercise: str = "",
    parameters: str = "{}",
    origin: str = "",
    dip_free: bool = False,
    now: datetime | None = None,
    session_id: uuid.UUID | None = None,
    recorded: str | None = None,
    recording_id: str = "",
) -> SessionHeader:
    """A header for a session that begins now; ``now`` needs a zone, and is injectable as ``session_id`` is.

    Raises :class:`NameUnsuited` for a pseudonym that cannot be one.
    Without ``recorded`` the hand moves now, without ``recording_id`` the session is a recording's first result.
    """
    created = (now or datetime.now().astimezone()).isoformat(timespec="seconds")
    return SessionHeader(
        session_id=str(session_id or uuid.uuid4()),
        subject_id=normalize_name(subject_id),
        created=created,
        hand=hand,
        protocol=protocol,
        exercise=exercise,
        software_version=__version__,
        parameters=parameters,
        origin=origin,
        joint_names=protocol.joint_names(dip_free),
        recorded=created if recorded is None else recorded,
        recording_id=recording_id,
    )


@dataclass(frozen=True, slots=True)
class Motion(KinematicState):
    """Moments of N frames, of the filter or of the smoother: every array of a :class:`KinematicState` with N rows of
    it."""


def stack_states(frames: Sequence[TrackedFrame | KinematicState]) -> Motion:
    """The frames' wrist and joints, one row each."""
    moments = [frame.kinematics if isinstance(frame, TrackedFrame) else frame for frame in frames]
    return Motion(
        **{field.name: np.array([getattr(moment, field.name) for moment in moments]) for field in fields(Motion)}
    )


def iter_states(motion: Motion) -> Iterator[KinematicState]:
    """One moment for every row."""
    columns = [getattr(motion, field.name) for field in fields(KinematicState)]
    return (KinematicState(*row) for row in zip(*columns, strict=True))


@dataclass(frozen=True, slots=True)
class MarkerSeries:
    """M markers over N frames: model position (N, M, 3) in camera axes; blob taken (N, M, 2) and its depth (N, M);
    whether what is seen contradicts what is stated of it (N, M)."""

    position_cam_m: FloatArray
    measured_px: FloatArray
    measured_depth_m: FloatArray
    doubted: BoolArray


@dataclass(frozen=True, slots=True)
class QualitySeries:
    """Frames missing before each frame (N,), share measured (N, 3 or J), NIS (N,) and its degrees of freedom (N,)."""

    dropped_before: IntArray
    measured_share: FloatArray
    nis: FloatArray
    nis_dof: IntArray


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at ``time_s`` of the recording: a repetition, a note, a pause, the camera lost."""

    time_s: float
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class RepetitionRow:
    """One repetition of the trained angle, there and back: seconds on the clock of the frames, rad, rad/s; NaN unknown.

    From where it left one turning place to where it reached the last, pauses included, or from middle to middle of a
    motion to both sides; ``peak_s`` when it was furthest on its way there, at ``angle_rad``. Its strokes are those that
    end in it: ``peak_speed_rad_s`` of the quickest, ``sparc`` their mean, ``movement_units``, ``pauses`` and
    ``pause_s``; ``movement_time_s`` how long it was on its way. ``at_least``: the angle may have gone further, and so
    the arc, while it was hidden. ``reason`` why it does not count, empty where it does.
    """

    start_s: float
    peak_s: float
    end_s: float
    angle_rad: float
    arc_rad: float
    arc_sd_rad: float
    peak_speed_rad_s: float
    peak_speed_sd_rad_s: float
    movement_time_s: float
    sparc: float
    movement_units: float
    pauses: float
    pause_s: float
    at_least: bool
    counted: bool
    reason: str


@dataclass(frozen=True, slots=True)
class Repetitions:
    """The repetitions of one session, of the angle that is called ``angle``; empty where none is trained."""

    angle: str
    rows: tuple[RepetitionRow, ...]


@dataclass(frozen=True, slots=True)
class EncodedImages:
    """One frame's pictures as picture files: colour JPEG or PNG, depth 16-bit PNG; no bytes where there is none."""

    color: bytes
    depth: bytes


@dataclass(frozen=True, slots=True)
class DetectionTable:
    """Every blob of every frame: ``frame`` (D,) row of the frame, rising; ``blobs`` all D of them.

    ``surface`` and ``fingers`` readings on the back of the hand and about the fingers: pixels (N, S, 2) and depths
    (N, S), NaN for none; empty where the session kept none.
    """

    frame: IntArray
    blobs: Detections
    surface: tuple[NDArray[Any], NDArray[Any]] = (np.empty((0, 0)), np.empty((0, 0)))
    fingers: tuple[NDArray[Any], NDArray[Any]] = (np.empty((0, 0)), np.empty((0, 0)))

    def get_frame(self, row: int) -> Detections:
        begin, end = np.searchsorted(self.frame, (row, row + 1))
        some = slice(int(begin), int(end))
        b = self.blobs
        return Detections(
            b.pixel[some],
            b.depth_m[some],
            b.depth_sd_m[some],
            b.area_px[some],
            b.similarity[some],
            _read_samples(self.surface, row),
            _read_samples(self.fingers, row),
        )


def _read_samples(kept: tuple[NDArray[Any], NDArray[Any]], row: int) -> SurfaceSamples | None:
    pixel, depth_m = kept
    if row >= len(depth_m):
        return None
    known = np.isfinite(depth_m[row])
    if not known.any():
        return None
    return SurfaceSamples(pixel[row][known].astype(np.float64), depth_m[row][known].astype(np.float64))


@dataclass(frozen=True, slots=True)
class SessionOutline:
    """What a list of sessions shows; ``recovered`` as in :class:`Session`."""

    header: SessionHeader
    frames: int
    duration_s: float
    recovered: str
    size_bytes: int = 0


@dataclass(frozen=True, slots=True)
class VerificationResult:
    """A session that is whole: all of its ``frames`` can be read; ``has_checksum``: and nothing was changed since it
    was
    finished, which sessions from before there were seals cannot tell."""

    frames: int
    has_checksum: bool


AngleOrder = Literal["zyx", "isb"]
"""Order of the wrist's angles: the papers' ZYX, or flexion first as the ISB has it."""
ANGLE_ORDERS: tuple[AngleOrder, ...] = ("zyx", "isb")


@dataclass(frozen=True, slots=True)
class Session:
    """What a session file holds, without the blobs and pictures, which are read when asked for.

    ``timestamp_s`` and ``status`` (N,); ``smoothed`` None where no smoother ran; ``recovered`` when an
    interrupted one was finished (ISO 8601), else empty.
    """

    path: Path
    header: SessionHeader
    camera: Camera
    calibration: Calibration
    timestamp_s: FloatArray
    status: IntArray
    motion: Motion
    markers: MarkerSeries
    quality: QualitySeries
    events: tuple[Event, ...]
    smoothed: Motion | None
    recovered: str
    repetitions: Repetitions | None = None
    """As counted when it was finished; None where nobody did, as in one that was recovered."""
    angle_order: AngleOrder = "zyx"
    """In which order the wrist's angles are read; in every file it is the papers'."""

    def __len__(self) -> int:
        return len(self.timestamp_s)

"""Values of a session, as the writer takes and the reader returns them (arrays read-only)."""

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
from carpus.core.platform.provenance import parameter_section
from carpus.core.platform.version import __version__

IntArray = NDArray[np.integer]

MAX_TARGET_DEG = 180.0
"""No joint moves farther; a larger target in a file is ignored."""
SET_UP = "set_up"
"""Section of a session's parameters with the targets."""


@dataclass(frozen=True, slots=True)
class SessionHeader:
    """Header of a session; never contains a name or a birth date.

    Attributes
    ----------
    created, recorded : str
        When the file was made and when the hand moved (empty if unknown), ISO 8601 with zone.
    recording_id : str
        Id of the recording, the same for all its results.
    joint_names : tuple of str
        Empty for ``wrist6``.
    parameters : str
        All settings as JSON.
    origin : str
        Id of the session that was tracked again, else empty.
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
        """When the hand moved; if unknown, when the file was made."""
        return datetime.fromisoformat(self.recorded or self.created)

    @property
    def is_simulated(self) -> bool:
        """Whether the images show a simulated hand."""
        return parameter_section(self.parameters, "source").get(SIMULATED) == "yes"

    @property
    def set_up(self) -> Mapping[str, Any]:
        """Targets and repetitions of the exercise; empty if not stored."""
        return parameter_section(self.parameters, SET_UP)

    @property
    def targets_deg(self) -> tuple[float, float]:
        """Targets in the positive and negative direction, signed degrees; NaN for none."""
        values = self.set_up.get("targets_deg")
        if not isinstance(values, list) or len(values) != 2:
            return math.nan, math.nan
        positive, negative = (
            float(value) if isinstance(value, (int, float)) and abs(value) <= MAX_TARGET_DEG else math.nan
            for value in values
        )
        return positive, negative


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
    """Return a header for a session that starts now; ``now`` and ``session_id`` can be given by tests.

    Default of ``recorded`` is now; without ``recording_id`` the session is a recording's first result. Raises
    :class:`NameUnsuited` for an invalid pseudonym.
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
    """Kinematic states of N frames: every array of a :class:`KinematicState` with a leading axis of N."""


def stack_states(frames: Sequence[TrackedFrame | KinematicState]) -> Motion:
    """Return the states of some frames as one motion."""
    moments = [frame.kinematics if isinstance(frame, TrackedFrame) else frame for frame in frames]
    return Motion(
        **{field.name: np.array([getattr(moment, field.name) for moment in moments]) for field in fields(Motion)}
    )


def iter_states(motion: Motion) -> Iterator[KinematicState]:
    """Yield the state of every row."""
    columns = [getattr(motion, field.name) for field in fields(KinematicState)]
    return (KinematicState(*row) for row in zip(*columns, strict=True))


@dataclass(frozen=True, slots=True)
class MarkerSeries:
    """M markers over N frames.

    Attributes
    ----------
    position_cam_m : ndarray, shape (N, M, 3)
        Modelled position in camera axes.
    measured_px, measured_depth_m : ndarray, shapes (N, M, 2) and (N, M)
        Associated blob and its depth.
    doubted : ndarray of bool, shape (N, M)
        Whether the image contradicts the estimate.
    """

    position_cam_m: FloatArray
    measured_px: FloatArray
    measured_depth_m: FloatArray
    doubted: BoolArray


@dataclass(frozen=True, slots=True)
class QualitySeries:
    """Frames missing before each frame (N,), measured share (N, 3 or J), NIS (N,) and its degrees of freedom (N,)."""

    dropped_before: IntArray
    measured_share: FloatArray
    nis: FloatArray
    nis_dof: IntArray


@dataclass(frozen=True, slots=True)
class Event:
    """Event at ``time_s`` of the recording: a note, a pause, the camera lost."""

    time_s: float
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class RepetitionRow:
    """One repetition of the exercised angle, there and back; seconds on the frames' clock, rad, rad/s; NaN if unknown.

    It lasts from leaving one turning point to reaching the last, pauses included, or from middle to middle of a motion
    to both sides.

    Attributes
    ----------
    peak_s, angle_rad : float
        Time and angle of the farthest point.
    peak_speed_rad_s, sparc : float
        Of the fastest stroke; mean of the strokes that end in the repetition.
    movement_time_s : float
        Time in motion.
    at_least : bool
        The arc is a lower bound, since the angle was occluded.
    reason : str
        Why the repetition is excluded, empty if it is included.
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
    """Repetitions of the angle named ``angle``; that is empty if none is exercised."""

    angle: str
    rows: tuple[RepetitionRow, ...]


@dataclass(frozen=True, slots=True)
class EncodedImages:
    """Encoded images of one frame: colour JPEG or PNG, depth 16-bit PNG; empty if there is none."""

    color: bytes
    depth: bytes


@dataclass(frozen=True, slots=True)
class DetectionTable:
    """Detections of all frames.

    Attributes
    ----------
    frame : ndarray of int, shape (D,)
        Row of the frame, rising.
    blobs : Detections
        All D blobs.
    surface, fingers : tuple of ndarray
        Depth samples on the back of the hand and around the fingers: pixels (N, S, 2) and depths (N, S), NaN for none;
        empty if the session has none.
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
    """Entry of the session list; ``recovered`` as in :class:`Session`."""

    header: SessionHeader
    frames: int
    duration_s: float
    recovered: str
    size_bytes: int = 0


@dataclass(frozen=True, slots=True)
class VerificationResult:
    """Verified session: number of frames, and whether it had a SHA-256 to compare (old sessions have none)."""

    frames: int
    has_checksum: bool


AngleOrder = Literal["zyx", "isb"]
"""Order of the wrist's angles: the papers' ZYX, or flexion first (ISB)."""
ANGLE_ORDERS: tuple[AngleOrder, ...] = ("zyx", "isb")


@dataclass(frozen=True, slots=True)
class Session:
    """Content of a session file without detections and images, which are read on demand.

    ``timestamp_s`` and ``status`` (N,); ``smoothed`` None without a smoother; ``recovered`` is when an interrupted
    recording was finished (ISO 8601), else empty.
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
    """As counted when it was finished; None if not counted, as in a recovered session."""
    angle_order: AngleOrder = "zyx"
    """Order in which the wrist's angles are read; files have the papers'."""

    def __len__(self) -> int:
        return len(self.timestamp_s)

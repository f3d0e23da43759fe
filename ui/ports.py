"""What the windows need from the rest of Carpus: values and protocols. ``app`` supplies the implementations.

No screen knows a device, a filter or a file; each takes the port it needs in its constructor.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import Literal, Protocol

from core.calibration.result import Calibration, Clicks, Finding, Verdict
from core.camera import Camera
from core.hand.protocols import MarkerProtocol
from core.output.exercises import Exercise
from core.output.report_content import RepetitionChoices, SessionFigures
from core.pipeline.live_values import LiveCounters, LiveEvent, TrackedView
from core.session.values import Session
from core.types import ByteImage, FloatArray, Frame, Side, TrackedFrame

AffectedSide = Literal["right", "left", "both"]
Dominance = Literal["right", "left", "both", "unknown"]
PRACTICE_PATIENT = "practice"
"""Identity of the practice patient: always the last row, simulated camera, nothing counts."""


# --- patients ---------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class PatientEntry:
    """What a person types about a patient. ``name`` is optional and never leaves the register."""

    pseudonym: str
    side: AffectedSide
    dominance: Dominance
    note: str = ""
    name: str = ""


@dataclass(frozen=True, slots=True)
class PatientRow:
    """One row of the list. ``name`` is searched and shown only on request."""

    patient_id: str
    pseudonym: str
    side: AffectedSide
    dominance: Dominance = "unknown"
    exercise: str = ""
    last_session: datetime | None = None
    session_count: int = 0
    note: str = ""
    name: str = ""


@dataclass(frozen=True, slots=True)
class ResultLine:
    """The last result of one movement; ``verdict`` as of :mod:`core.output.report_content`."""

    movement: str
    mean_deg: float
    sd_deg: float
    change_deg: float
    verdict: str
    joint: str = ""
    """The joint angle or ``TAM3`` of the whole hand, by its name in every file; empty for the wrist."""
    at_least: bool = False
    """Whether the joint went out of the camera's sight beyond this figure."""


@dataclass(frozen=True, slots=True)
class PatientCard:
    """What the therapist must recall before the next session."""

    row: PatientRow
    results: Sequence[ResultLine] = ()
    last_set: str = ""
    note: str = ""
    note_when: datetime | None = None
    marker_picture_rgb: ByteImage | None = None
    warnings: Sequence[str] = ()
    """What must be known of the last session: simulated, doubtful, cut short, not to count."""


@dataclass(frozen=True, slots=True)
class SessionRow:
    """One stored session of a patient."""

    session_id: str
    when: datetime
    exercise: str
    side: str
    duration_s: float
    complete: bool = True


class PatientStore(Protocol):
    """The register of patients. Names beyond the pseudonym live only behind this port."""

    def patients(self) -> Sequence[PatientRow]:
        """All rows, newest session first; without the practice patient."""
        ...

    def card(self, patient_id: str) -> PatientCard: ...

    def sessions(self, patient_id: str) -> Sequence[SessionRow]:
        """Stored sessions, newest first."""
        ...

    def suggest_pseudonym(self) -> str:
        """A speakable random name that is not taken yet."""
        ...

    def add(self, entry: PatientEntry) -> str:
        """Store a new patient; the identity given."""
        ...

    def change(self, patient_id: str, entry: PatientEntry) -> None: ...


# --- measuring --------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class SetUp:
    """What was chosen before measuring.

    Targets in degrees of the trained angle with its sign (the negative direction below zero), NaN for none.
    """

    patient_id: str
    pseudonym: str
    side: Side
    exercise: Exercise
    repetitions: int
    target_positive_deg: float
    target_negative_deg: float
    keep_pictures: bool = False
    ends_free: bool = False
    """Whether the end joints of the fingers are measured by themselves, not taken to follow the middle joints."""

    @property
    def protocol(self) -> MarkerProtocol:
        """The discs on the hand, which the exercise decides."""
        return self.exercise.protocol


class LiveFeed(Protocol):
    """The running source, as :class:`core.pipeline.live.LiveSession` offers it to a screen."""

    def newest_frame(self) -> Frame | None: ...

    def newest(self) -> TrackedView | None: ...

    def tracked_since(self, index: int) -> Sequence[TrackedFrame]: ...

    def drain_events(self) -> Sequence[LiveEvent]: ...

    def counters(self) -> LiveCounters: ...

    def add_event(self, kind: str, text: str = "") -> bool: ...

    def pause_recording(self) -> None: ...

    def resume_recording(self) -> None: ...

    @property
    def recording(self) -> bool: ...

    @property
    def recorded_from(self) -> int | None: ...

    @property
    def paused(self) -> bool: ...


class Measuring(Protocol):
    """An open source with a patient before it: from the first picture to the stored session.

    ``start_recording`` and ``stop_recording`` may wait for the disk and are called in the background;
    ``stop_recording`` returns the identity of the stored session.
    """

    @property
    def feed(self) -> LiveFeed: ...

    @property
    def camera(self) -> Camera: ...

    @property
    def calibration(self) -> Calibration | None: ...

    @property
    def starts_with_recording(self) -> bool:
        """Whether this is a stored recording, which plays from its first picture when recording starts."""
        ...

    def start_recording(self) -> None: ...

    def stop_recording(self) -> str: ...

    def close(self) -> None: ...


# --- words for what goes wrong ----------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Words:
    """The three answers of every message, and one word for lists."""

    what: str
    safe: str
    todo: str


class Phrasebook(Protocol):
    """The one table from fault to words (:mod:`core.words`), as the screens use it."""

    def fault(self, fault: Exception) -> Words: ...

    def finding(self, finding: Finding) -> Words: ...


# --- calibration ------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class FoundMarker:
    """A blob under the cursor: its centre (2,) and width in pixels of the picture."""

    pixel: FloatArray
    width_px: float


@dataclass(frozen=True, slots=True)
class ProposedMarker:
    """A blob that the program takes for a marker; not ``is_sure`` where another name would do nearly as well."""

    pixel: FloatArray
    width_px: float
    is_sure: bool


@dataclass(frozen=True, slots=True)
class VerdictLimits:
    """What the calibration is judged by, shown beside each value."""

    least_distance_m: float
    most_tilt_deg: float
    most_residual_mm: float
    hand_length_mm: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Judged:
    """A verdict, and the calibration unless something blocks it."""

    verdict: Verdict
    calibration: Calibration | None


class Calibrator(Protocol):
    """Clicks to calibration. ``judge`` may take a while and is called in the background."""

    @property
    def side(self) -> Side: ...

    @property
    def protocol(self) -> MarkerProtocol: ...

    @property
    def limits(self) -> VerdictLimits: ...

    @property
    def is_live(self) -> bool:
        """Whether pictures keep coming and another one can be taken; a recording has its first picture only."""
        ...

    def newest_frame(self) -> Frame | None: ...

    def hold(self) -> Frame:
        """Fix the picture on which will be clicked."""
        ...

    def hand_area(self) -> FloatArray | None:
        """Two corners (2, 2) of where the hand lies in the held picture, as far as that is easily known."""
        ...

    def marker_at(self, pixel: FloatArray) -> FoundMarker | None:
        """The blob under or near a pixel (2,) of the held picture."""
        ...

    def propose(self, named: Mapping[str, FloatArray]) -> Mapping[str, ProposedMarker]:
        """Names for the blobs of the held picture beside those already ``named`` (pixels by marker); called in the
        background."""
        ...

    def judge(self, clicks: Clicks, start_angles_rad: FloatArray) -> Judged: ...

    def begin(self, calibration: Calibration) -> None:
        """Start tracking from here."""
        ...


# --- stored sessions --------------------------------------------------------------------------------------
class SessionStore(Protocol):
    """Stored sessions and what is said of them. All but ``choices`` may read the disk: called in the background."""

    def session(self, session_id: str) -> Session: ...

    def picture(self, session_id: str, row: int) -> ByteImage | None:
        """The stored colour picture of a row, None when pictures were not kept."""
        ...

    def choices(self, session_id: str) -> RepetitionChoices:
        """What a person left out or moved; empty when nothing."""
        ...

    def keep_choices(self, session_id: str, choices: RepetitionChoices) -> None: ...

    def history(self, patient_id: str) -> Sequence[SessionFigures]:
        """Figures of all of a patient's sessions, choices applied, in no particular order."""
        ...

    def export(self, session_id: str, folder: str) -> Sequence[str]:
        """Write the open formats into a folder; the names of the files written."""
        ...


# --- what a person chooses for the program ----------------------------------------------------------------
ThemeChoice = Literal["light", "dark", "system"]


@dataclass(frozen=True, slots=True)
class Preferences:
    """Choices of the settings screen. ``therapist`` initials are printed on reports."""

    theme: ThemeChoice = "system"
    text_scale: float = 1.0
    data_folder: str = ""
    therapist: str = ""
    keys: Mapping[str, str] = field(default_factory=dict)

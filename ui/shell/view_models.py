"""Values that the windows share, and the port to what none of them may know: ``app`` implements it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Literal, Protocol

from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import ByteImage, FloatArray, Frame, Side
from carpus.core.pipeline.live_values import StartMode
from carpus.core.records.values import Patient
from carpus.core.results.measure import Measure
from carpus.core.results.progress import Comparison
from carpus.core.session.values import AngleOrder

# --- patients ---------------------------------------------------------------------------------------------
MeasureWithChange = tuple[Measure, Comparison | None]
"""What the last session measured, and how it changed since the first one that compares."""


@dataclass(frozen=True, slots=True)
class PatientCard:
    """What the therapist must recall before the next session."""

    patient: Patient
    results: Sequence[MeasureWithChange] = ()
    repetitions: str = ""
    note: str = ""
    note_date: datetime | None = None
    marker_photo_rgb: ByteImage | None = None
    warnings: Sequence[str] = ()
    """What must be known of the last session: simulated, doubtful, recovered, not to count."""
    has_sessions: bool = False
    """Whether there are sessions at all, also such as are not counted."""
    task_summary: str = ""
    """What a reach or a touch of finger tips came to, in place of ``results``; empty for other exercises."""


MAX_LISTED_PATIENTS = 500
"""Of patients that are shown at once; of more, searching finds the others."""


# --- calibration ------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class FoundMarker:
    """A blob under the cursor: its centre (2,) and width in pixels of the picture."""

    pixel: FloatArray
    width_px: float


@dataclass(frozen=True, slots=True)
class LabelProposal:
    """A blob that the program takes for a marker; not ``is_sure`` where another name would do nearly as well."""

    pixel: FloatArray
    width_px: float
    is_sure: bool


@dataclass(frozen=True, slots=True)
class CalibrationLimits:
    """What the calibration is judged by, shown beside each value."""

    min_distance_m: float
    max_tilt_deg: float
    max_residual_mm: float
    hand_length_mm: tuple[float, float]


@dataclass(frozen=True, slots=True)
class CalibrationAssessment:
    """A verdict, and the calibration unless something blocks it."""

    verdict: Verdict
    calibration: Calibration | None


class Calibrator(Protocol):
    """Clicks to calibration. ``assess`` may take a while and is called in the background."""

    @property
    def side(self) -> Side: ...

    @property
    def protocol(self) -> MarkerProtocol: ...

    @property
    def limits(self) -> CalibrationLimits: ...

    @property
    def previous_straight_fingers(self) -> tuple[bool, ...]:
        """What was said of this hand last time, thumb to little: the same is proposed again."""
        ...

    @property
    def is_live(self) -> bool:
        """Whether pictures keep coming and another one can be taken; a recording has its first picture only."""
        ...

    def current_frame(self) -> Frame | None: ...

    def freeze_frame(self) -> Frame:
        """Fix the picture on which will be clicked."""
        ...

    def count_candidates(self) -> int:
        """How many spots of the held picture look like discs of paper."""
        ...

    def candidate_px(self) -> FloatArray:
        """Places (D, 2) of all spots of the held picture that look like discs of paper."""
        ...

    def hand_area(self) -> FloatArray | None:
        """Two corners (2, 2) of where the hand lies in the held picture, as far as that is easily known."""
        ...

    def find_marker(self, pixel: FloatArray) -> FoundMarker | None:
        """The blob under or near a pixel (2,) of the held picture."""
        ...

    def propose_labels(self, named: Mapping[str, FloatArray]) -> Mapping[str, LabelProposal]:
        """Names for the blobs of the held picture beside those already ``named`` (pixels by marker); called in the
        background."""
        ...

    def assess(self, clicks: Clicks, start_angles_rad: FloatArray) -> CalibrationAssessment: ...

    def start_tracking(self, calibration: Calibration) -> None:
        """Start tracking from here."""
        ...


# --- what a person chooses for the program ----------------------------------------------------------------
ThemeChoice = Literal["light", "dark", "system"]


@dataclass(frozen=True, slots=True)
class Preferences:
    """Choices of the settings screen. ``therapist`` initials are printed on reports; ``angle_order`` of the wrist's
    angles, zyx or isb; ``stream``: live values go out to other programs."""

    theme: ThemeChoice = "system"
    text_scale: float = 1.0
    data_folder: str = ""
    therapist: str = ""
    angle_order: AngleOrder = "zyx"
    stream: bool = False
    patient_sound: bool = False
    """Whether the patient's view beeps where a goal is reached."""
    language: str = "system"
    """Of the window: a code of :data:`carpus.ui.kit.language.LANGUAGES`, or the computer's."""
    research: bool = False
    """Whether what only research needs is shown."""
    start: StartMode = "key"

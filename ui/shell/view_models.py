"""Values shared by screens, and the calibrator interface that ``app`` implements."""

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
"""A measure of the last session and its change since the first comparable one."""


@dataclass(frozen=True, slots=True)
class PatientCard:
    """Summary of a patient before the next session."""

    patient: Patient
    results: Sequence[MeasureWithChange] = ()
    repetitions: str = ""
    note: str = ""
    note_date: datetime | None = None
    marker_photo_rgb: ByteImage | None = None
    warnings: Sequence[str] = ()
    """Warnings of the last session: simulated, uncertain, recovered, excluded."""
    has_sessions: bool = False
    """Whether there are sessions, also excluded ones."""
    task_summary: str = ""
    """Result of a reach or a thumb opposition, in place of ``results``; empty for other exercises."""


MAX_LISTED_PATIENTS = 500
"""Patients shown at once; the others are found by searching."""


# --- calibration ------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class FoundMarker:
    """A blob under the cursor: centre (2,) and width in frame pixels."""

    pixel: FloatArray
    width_px: float


@dataclass(frozen=True, slots=True)
class LabelProposal:
    """A blob proposed for a marker; not ``is_sure`` if another label fits nearly as well."""

    pixel: FloatArray
    width_px: float
    is_sure: bool


@dataclass(frozen=True, slots=True)
class CalibrationAssessment:
    """Verdict on a calibration, and the calibration unless it is blocked."""

    verdict: Verdict
    calibration: Calibration | None


class Calibrator(Protocol):
    """Interface of the hand calibration from clicked markers.

    ``assess`` is slow and called in the background.
    """

    @property
    def side(self) -> Side: ...

    @property
    def protocol(self) -> MarkerProtocol: ...

    @property
    def previous_straight_fingers(self) -> tuple[bool, ...]:
        """Fingers, thumb to little, that could fully extend last time."""
        ...

    @property
    def is_live(self) -> bool:
        """Whether frames keep coming; a recording offers its first frame only."""
        ...

    def current_frame(self) -> Frame | None: ...

    def freeze_frame(self) -> Frame:
        """Hold the frame that will be clicked on."""
        ...

    def count_candidates(self) -> int:
        """Return the number of marker candidates in the held frame."""
        ...

    def candidate_px(self) -> FloatArray:
        """Return the pixels (D, 2) of all marker candidates in the held frame."""
        ...

    def hand_area(self) -> FloatArray | None:
        """Return two corners (2, 2) of the hand in the held frame, None if unknown."""
        ...

    def find_marker(self, pixel: FloatArray) -> FoundMarker | None:
        """Return the blob at or near a pixel (2,) of the held frame."""
        ...

    def propose_labels(self, named: Mapping[str, FloatArray]) -> Mapping[str, LabelProposal]:
        """Propose labels for blobs other than those already ``named``; called in the background."""
        ...

    def assess(self, clicks: Clicks, start_angles_rad: FloatArray) -> CalibrationAssessment: ...

    def start_tracking(self, calibration: Calibration) -> None:
        """Start tracking with this calibration."""
        ...


# --- what a person chooses for the program ----------------------------------------------------------------
ThemeChoice = Literal["light", "dark", "system"]


@dataclass(frozen=True, slots=True)
class Preferences:
    """Choices of the settings screen.

    ``angle_order`` is zyx or isb, ``stream`` sends live values to other programs.
    """

    theme: ThemeChoice = "system"
    text_scale: float = 1.0
    data_folder: str = ""
    angle_order: AngleOrder = "zyx"
    stream: bool = False
    patient_sound: bool = False
    """Whether the patient's view beeps at the goal."""
    language: str = "system"
    """Code of :data:`carpus.ui.kit.language.LANGUAGES`, or ``system``."""
    research: bool = False
    """Whether options for research are shown."""
    start: StartMode = "key"

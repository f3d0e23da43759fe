"""What the windows need from the rest of Carpus: values and protocols. ``app`` supplies the implementations.

No screen knows a device, a filter or a file; each takes the port it needs in its constructor.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Literal, Protocol

from core.types import ByteImage

AffectedSide = Literal["right", "left", "both"]
Dominance = Literal["right", "left", "both", "unknown"]
PRACTICE_PATIENT = "practice"
"""Identity of the practice patient: always the last row, simulated camera, nothing counts."""


# --- patients ---------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class PatientEntry:
    """What a person types about a patient."""

    pseudonym: str
    side: AffectedSide
    dominance: Dominance
    note: str = ""


@dataclass(frozen=True, slots=True)
class PatientRow:
    """One row of the list."""

    patient_id: str
    pseudonym: str
    side: AffectedSide
    dominance: Dominance = "unknown"
    exercise: str = ""
    last_session: datetime | None = None
    session_count: int = 0
    note: str = ""


@dataclass(frozen=True, slots=True)
class ResultLine:
    """The last result of one movement; ``verdict`` as of :mod:`core.output.report_content`."""

    movement: str
    mean_deg: float
    sd_deg: float
    change_deg: float
    verdict: str


@dataclass(frozen=True, slots=True)
class PatientCard:
    """What the therapist must recall before the next session."""

    row: PatientRow
    results: Sequence[ResultLine] = ()
    last_set: str = ""
    note: str = ""
    note_when: datetime | None = None
    marker_picture_rgb: ByteImage | None = None


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

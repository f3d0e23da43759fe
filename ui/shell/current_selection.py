"""Who and what is open: the one thing that all flows of the window share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup
from carpus.core.records.values import Patient
from carpus.ui.kit.translate import tr
from carpus.ui.shell.view_models import Calibrator

if TYPE_CHECKING:
    from carpus.core.pipeline.measurement import MeasurementController

SourceKind = Literal["camera", "file", "practice"]


@dataclass(frozen=True, slots=True)
class SourceChoice:
    """Where the pictures come from; of a stored recording only its ``path``, and whether its depth lies on its
    colours where the recording does not say and the person was asked."""

    kind: SourceKind
    path: str = ""
    is_depth_registered: bool | None = None


@dataclass(frozen=True, slots=True)
class OpenSource:
    """A source with its calibrator; ``measuring`` owns it and closes it.

    ``is_registration_unknown``: nothing says whether the depth of this recording lies on its colours.
    ``is_hand_resting``: whether the simulated hand lies still because its movement is not drawn yet.
    """

    calibrator: Calibrator
    measuring: MeasurementController
    is_registration_unknown: bool = False
    is_hand_resting: Callable[[], bool] = lambda: False


@dataclass(slots=True, eq=False)
class CurrentSelection:
    """``source_choice`` is the source last asked for, ``source`` the one that runs, ``session_id`` the session looked
    at."""

    patient: Patient | None = None
    set_up: SessionSetup | None = None
    source: OpenSource | None = None
    session_id: str = ""
    source_choice: SourceChoice = field(default_factory=lambda: SourceChoice("camera"))

    def clear(self) -> None:
        self.patient = self.set_up = None
        self.session_id = ""

    @property
    def source_kind(self) -> SourceKind:
        return self.source_choice.kind

    @property
    def is_practice(self) -> bool:
        return self.patient is not None and self.patient.patient_id == PRACTICE_PATIENT

    @property
    def patient_name(self) -> str:
        """What the patient is called: the practice patient in the person's language, however the folder has it."""
        if self.is_practice:
            return practice_patient_name()
        return self.patient.pseudonym if self.patient is not None else ""


def practice_patient_name() -> str:
    """What the practice patient is called."""
    return tr("Practice patient")

"""The patient, set-up, source and session that are open, and how a patient is named while names are hidden."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup
from carpus.core.records.values import Patient
from carpus.ui.kit.translate import tr

if TYPE_CHECKING:
    from carpus.core.calibration.hand_calibrator import HandCalibrator
    from carpus.core.pipeline.measurement import MeasurementController
from PySide6.QtCore import QObject, Signal

from carpus.ui.words.terms import identity_words

SourceKind = Literal["camera", "file", "practice"]


@dataclass(frozen=True, slots=True)
class SourceChoice:
    """Where frames come from.

    ``path`` is that of a recording. ``is_depth_registered`` is the user's answer where the recording does not say it.
    """

    kind: SourceKind
    path: str = ""
    is_depth_registered: bool | None = None


@dataclass(frozen=True, slots=True)
class OpenSource:
    """An open source and its calibrator; ``measuring`` owns and closes it.

    ``is_registration_unknown``: the recording does not say whether depth and colour are aligned. ``is_hand_resting``:
    the simulated hand rests because its movement is not rendered yet.
    """

    calibrator: HandCalibrator
    measuring: MeasurementController
    is_registration_unknown: bool = False
    is_hand_resting: Callable[[], bool] = lambda: False


@dataclass(slots=True, eq=False)
class CurrentSelection:
    """What is open, shared by all flows.

    ``source_choice`` was requested last, ``source`` is running, ``session_id`` was viewed last.
    """

    patient: Patient | None = None
    set_up: SessionSetup | None = None
    source: OpenSource | None = None
    session_id: str = ""
    source_choice: SourceChoice = field(default_factory=lambda: SourceChoice("camera"))

    def clear(self) -> None:
        self.patient = self.set_up = None
        self.session_id = ""

    @property
    def is_practice(self) -> bool:
        return self.patient is not None and self.patient.patient_id == PRACTICE_PATIENT

    @property
    def patient_name(self) -> str:
        """Name of the open patient; the practice patient's in the user's language."""
        if self.is_practice:
            return practice_patient_name()
        return self.patient.pseudonym if self.patient is not None else ""


def practice_patient_name() -> str:
    """Return the practice patient's name in the user's language."""
    return tr("Practice patient")


class NameDisplay(QObject):
    """Switch “Hide names” of the window.

    Signals: ``changed`` when names were hidden or shown again.
    """

    changed = Signal()
    is_hidden = False

    def set_hidden(self, is_hidden: bool) -> None:
        if is_hidden != self.is_hidden:
            self.is_hidden = is_hidden
            self.changed.emit()

    def real_name(self, patient: Patient) -> str:
        """Return the real name; empty while names are hidden."""
        return "" if self.is_hidden else patient.name

    def title(self, patient: Patient | None) -> str:
        """Return ``Linden 42 · Erika Mustermann``; empty without a patient."""
        if patient is None:
            return ""
        if patient.patient_id == PRACTICE_PATIENT:
            return practice_patient_name()
        return " · ".join(part for part in (patient.pseudonym, self.real_name(patient)) if part)

    def identity(self, patient: Patient) -> str:
        """Return ``born 12 Mar 1981, female, No. 4711``; empty while names are hidden."""
        return "" if self.is_hidden else identity_words(patient)

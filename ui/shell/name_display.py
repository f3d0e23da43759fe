"""Whether real names are shown, and patients as they are named on screens and pages."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.ui.shell.current_selection import practice_patient_name
from carpus.ui.words.terms import identity_words


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

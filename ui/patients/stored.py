"""The patients as the first screen asks for them, and what the card of one recalls."""

from __future__ import annotations

from collections.abc import Sequence

from carpus.core.errors import SessionUnreadable
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import compare, unfair_reasons
from carpus.ui.ports import MOST_ROWS, PatientCard, Result
from carpus.ui.words.fingers import find_compared_ranges
from carpus.ui.words.further import main_words
from carpus.ui.words.ranges import repetition_words
from carpus.ui.words.session import warnings


class StoredPatients:
    """The register of patients. Names beyond the pseudonym are known behind it alone."""

    def __init__(self, library: Library) -> None:
        self._library, self.register = library, library.patients

    def patients(self, search: str = "") -> Sequence[Patient]:
        return self.register.listed(search, most=MOST_ROWS)

    def archived(self) -> Sequence[str]:
        return [one.pseudonym for one in Records(self._library).archived() if one.recorded is None]

    def card(self, patient_id: str) -> PatientCard:
        """What the therapist must recall, of the last session against the first that compares."""
        patient = self.register.one(patient_id)
        entries = self._library.sessions(patient_id)
        if not entries:
            archived = any(one.patient_id == patient_id for one in Records(self._library).archived())
            return PatientCard(patient, has_sessions=archived)  # the way to the archive is the list of sessions
        picture = self._library.marker_picture(patient_id)
        real = [entry for entry in entries if not entry.simulated]
        if not real and patient_id != PRACTICE_PATIENT:
            return PatientCard(patient, marker_picture_rgb=picture, has_sessions=True)
        try:
            last = self._library.figures((real or entries)[0])
            first = self._first_alike(patient_id, last)
        except SessionUnreadable:
            return PatientCard(patient, marker_picture_rgb=picture, has_sessions=True)
        note = last.notes[-1][1] if last.notes else ""
        said = () if patient_id == PRACTICE_PATIENT else warnings(last)
        # A reach or a touch is not told by how far the joints bend.
        about = main_words(last)
        results = () if about else _results(first, last)
        return PatientCard(patient, results, repetition_words(last), note, last.when, picture, said, True, about)

    def _first_alike(self, patient_id: str, last: SessionFigures) -> SessionFigures | None:
        """The first session of the same hand and exercise that the progress compares with; no more are read."""
        alike = [
            entry
            for entry in self._library.sessions(patient_id)
            if entry.hand == last.side and entry.exercise == last.exercise.id and entry.session_id != last.session_id
        ]
        for entry in reversed(alike):
            figures = self._library.figures(entry)
            if figures.simulated == last.simulated and not unfair_reasons(figures, figures):
                return figures
        return None


def _results(first: SessionFigures | None, last: SessionFigures) -> Sequence[Result]:
    """Of the wrist both ends of what is trained, which the therapist trains; of the whole hand what the exercise is
    about, finger by finger."""
    rows = [row for row in find_compared_ranges(last) if row.count]
    if not last.joint_ranges:
        rows = [row for row in rows if row.what != "arc" and last.exercise.angle is not None]
    changes = {}
    if first is not None and first.session_id != last.session_id:
        changes = {item.key: item for item in compare(first, last, rows)}
    return [(row, changes.get(row.key)) for row in rows]

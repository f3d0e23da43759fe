"""Patients and their summaries for the patient list."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.types import ByteImage
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.core.results.measure import Measure
from carpus.core.results.progress import Comparison, compare_ranges, incomparable_reasons
from carpus.core.results.session_results import SessionResults
from carpus.ui.words.fingers import find_main_ranges
from carpus.ui.words.ranges import repetition_words
from carpus.ui.words.session import warning_lines
from carpus.ui.words.task_measures import task_summary

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


class PatientStore:
    """Patients of the library; names other than pseudonyms stay behind it."""

    def __init__(self, library: DataFolder) -> None:
        self._library, self.register = library, library.patients

    def list_patients(self, search: str = "") -> Sequence[Patient]:
        return self.register.search(search, limit=MAX_LISTED_PATIENTS)

    def list_archived_names(self) -> Sequence[str]:
        return [one.pseudonym for one in RecordRetention(self._library).list_archived() if one.recorded is None]

    def card(self, patient_id: str) -> PatientCard:
        """Return the summary of a patient: the last session compared with the first comparable one."""
        patient = self.register.get(patient_id)
        entries = self._library.sessions(patient_id)
        if not entries:
            archived = any(one.patient_id == patient_id for one in RecordRetention(self._library).list_archived())
            return PatientCard(patient, has_sessions=archived)  # the way to the archive is the list of sessions
        picture = self._library.read_marker_photo(patient_id)
        real = [entry for entry in entries if not entry.simulated]
        if not real and patient_id != PRACTICE_PATIENT:
            return PatientCard(patient, marker_photo_rgb=picture, has_sessions=True)
        try:
            last = self._library.results((real or entries)[0])
            first = self._first_comparable(patient_id, last)
        except SessionUnreadable:
            return PatientCard(patient, marker_photo_rgb=picture, has_sessions=True)
        note = last.notes[-1][1] if last.notes else ""
        warnings = () if patient_id == PRACTICE_PATIENT else warning_lines(last)
        # Joint ranges say little about a reach or an opposition.
        about = task_summary(last)
        results = () if about else _compare_results(first, last)
        return PatientCard(patient, results, repetition_words(last), note, last.when, picture, warnings, True, about)

    def _first_comparable(self, patient_id: str, last: SessionResults) -> SessionResults | None:
        """Return the first session of the same hand and exercise that is comparable, None if there is none."""
        alike = [
            entry
            for entry in self._library.sessions(patient_id)
            if entry.hand == last.side and entry.exercise == last.exercise.id and entry.session_id != last.session_id
        ]
        for entry in reversed(alike):
            figures = self._library.results(entry)
            if figures.is_simulated == last.is_simulated and not incomparable_reasons(figures, figures):
                return figures
        return None


def _compare_results(first: SessionResults | None, last: SessionResults) -> Sequence[MeasureWithChange]:
    """Return the measures to show with their changes.

    For the wrist these are both ends of the trained movement, for the whole hand the trained measure of each finger.
    """
    rows = [row for row in find_main_ranges(last) if row.count]
    if not last.joint_ranges:
        rows = [row for row in rows if row.quantity != "arc" and last.exercise.angle is not None]
    changes = {}
    if first is not None and first.session_id != last.session_id:
        changes = {item.key: item for item in compare_ranges(first, last, rows)}
    return [(row, changes.get(row.key)) for row in rows]

"""Sessions of a patient for the list, and changes to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from carpus.core.model.errors import SessionUnreadable
from carpus.core.records.changes import fingerprint
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.ui.screens.sessions.session_list import SessionLine
from carpus.ui.words.fingers import main_result_words
from carpus.ui.words.progress import correction_words
from carpus.ui.words.ranges import repetition_words
from carpus.ui.words.session import warning_lines


class SessionStore:
    """Sessions of a patient.

    All methods but ``list_sessions`` and ``target_patients`` access the disk and run in the background.
    """

    def __init__(
        self, library: DataFolder, name_patient: Callable[[Patient], str] = lambda patient: patient.pseudonym
    ) -> None:
        self._library, self._name_patient = library, name_patient

    def list_sessions(self, patient_id: str) -> Sequence[SessionLine]:
        """Return sessions, newest first, without what only their files contain."""
        return [
            SessionLine(one, patient_id == PRACTICE_PATIENT, self._exclusion_reason(one.session_id))
            for one in self._library.sessions(patient_id)
        ]

    def _exclusion_reason(self, session_id: str) -> str:
        try:
            choices = self._library.choices(session_id)
        except SessionUnreadable:
            return ""
        return (choices.session_exclusion_reason or "by hand") if choices.is_session_excluded else ""

    def with_figures(self, line: SessionLine) -> SessionLine:
        try:
            figures = self._library.results(line.entry)
        except SessionUnreadable:
            return replace(line, is_damaged=True, is_missing=not line.entry.path.exists())
        counted = f"{figures.repetition_count} / {len(figures.repetitions)}" if figures.repetitions else ""
        warnings = [] if line.is_practice else warning_lines(figures)
        return replace(
            line,
            main_value=main_result_words(figures),
            counted_repetitions=counted,
            counted_words=repetition_words(figures),
            warning=" ".join(warnings),
            correction=correction_words(figures),
        )

    def target_patients(self, patient_id: str) -> Sequence[tuple[str, str]]:
        rows = self._library.patients.search()
        return [(row.patient_id, self._name_patient(row)) for row in rows if row.patient_id != patient_id]

    def count_archived(self, patient_id: str) -> int:
        found = RecordRetention(self._library).list_archived()
        return sum(one.patient_id == patient_id and one.recorded is not None for one in found)

    def exclude(self, session_id: str, reason: str) -> None:
        choices = self._library.choices(session_id)
        self._library.save_choices(
            session_id, replace(choices, is_session_excluded=bool(reason), session_exclusion_reason=reason)
        )

    def move(self, session_id: str, patient_id: str) -> None:
        self._library.frame_cache.clear()
        self._library.session_list.move_to_patient(session_id, patient_id)
        self._library.audit_log.log_session("moved", session_id, to=fingerprint(patient_id))
        self._library.drop_cached_results(session_id)

    def rename_exercise(self, session_id: str, exercise: str) -> None:
        self._library.session_list.set_exercise(session_id, exercise)
        self._library.audit_log.log_session("renamed", session_id, exercise=exercise.lower())
        self._library.drop_cached_results(session_id)

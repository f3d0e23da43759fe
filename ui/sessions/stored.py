"""The sessions of a patient as their list asks for them, and what is done with one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from carpus.core.errors import SessionUnreadable
from carpus.core.records.changes import fingerprint
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.ui.sessions.listing import SessionLine
from carpus.ui.words.fingers import main_figure
from carpus.ui.words.progress import corrected_words
from carpus.ui.words.ranges import repetition_words
from carpus.ui.words.session import warnings


class StoredSessions:
    """All sessions of a patient and what can be done with them. All but ``lines`` and ``other_patients`` may read or
    write the disk: called in the background."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def lines(self, patient_id: str) -> Sequence[SessionLine]:
        """Newest first, without what only the files know."""
        return [
            SessionLine(one, patient_id == PRACTICE_PATIENT, self._aside(one.session_id))
            for one in self._library.sessions(patient_id)
        ]

    def _aside(self, session_id: str) -> str:
        try:
            choices = self._library.choices(session_id)
        except SessionUnreadable:
            return ""
        return (choices.not_counted_reason or "by hand") if choices.not_counted else ""

    def with_figures(self, line: SessionLine) -> SessionLine:
        try:
            figures = self._library.figures(line.entry)
        except SessionUnreadable:
            return replace(line, damaged=True, away=not line.entry.path.exists())
        counted = f"{figures.counted} / {len(figures.repetitions)}" if figures.repetitions else ""
        said = [] if line.of_practice else warnings(figures)
        return replace(
            line,
            figure=main_figure(figures),
            counted=counted,
            counted_words=repetition_words(figures),
            warning=" ".join(said),
            corrected=corrected_words(figures),
        )

    def other_patients(self, patient_id: str) -> Sequence[tuple[str, str]]:
        rows = self._library.patients.listed()
        return [(row.patient_id, row.pseudonym) for row in rows if row.patient_id != patient_id]

    def archived(self, patient_id: str) -> int:
        found = Records(self._library).archived()
        return sum(one.patient_id == patient_id and one.recorded is not None for one in found)

    def set_aside(self, session_id: str, reason: str) -> None:
        choices = self._library.choices(session_id)
        self._library.keep_choices(session_id, replace(choices, not_counted=bool(reason), not_counted_reason=reason))

    def move(self, session_id: str, patient_id: str) -> None:
        self._library.pictures.forget()
        self._library.index.move(session_id, patient_id)
        self._library.notes.session("moved", session_id, to=fingerprint(patient_id))
        self._library.forget_figures(session_id)

    def rename_exercise(self, session_id: str, exercise: str) -> None:
        self._library.index.rename_exercise(session_id, exercise)
        self._library.notes.session("renamed", session_id, exercise=exercise.lower())
        self._library.forget_figures(session_id)

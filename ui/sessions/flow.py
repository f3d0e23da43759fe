"""The flow of a patient's sessions: the list, and where one goes on from it."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from carpus.core.errors import SessionUnreadable
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.records.log import fingerprint
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.records.values import SessionEntry
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import put_off_last
from carpus.ui.report.hand_rows import main_figure
from carpus.ui.report.tables import repetition_words
from carpus.ui.report.words import warnings
from carpus.ui.sessions.listing import SessionLine
from carpus.ui.sessions.screen import SessionsScreen
from carpus.ui.words.progress import corrected_words


class SessionsFlow(Flow):
    """All sessions of a patient."""

    place, guide = "sessions", "sessions"
    screen: SessionsScreen

    def __init__(self, context: ScreenContext) -> None:
        stored = StoredSessions(context.library)
        super().__init__(context, SessionsScreen(context.theme, context.background, stored, context.keys))
        screen, way = self.screen, context.way
        screen.told.connect(context.messages.fault)
        screen.opened.connect(lambda session_id: way.show("review", session_id))
        screen.progress.connect(self._show_progress)
        screen.pair_wanted.connect(lambda one, other: way.show("beside", one, other))
        screen.changed.connect(self._look_for_open)

    def show(self, patient_id: str) -> None:
        self.open_patient(patient_id)
        now = self.context.now
        self.screen.begin(patient_id, now.name, now.session_id)
        self.context.way.go("sessions")

    def up(self) -> None:
        if not put_off_last(self.screen):
            self.to_patient()

    def _show_progress(self, session_id: str) -> None:
        now = self.context.now
        assert now.patient is not None
        now.session_id = session_id
        self.context.way.show("progress", now.patient.patient_id)

    def _look_for_open(self) -> None:
        """A session was moved, renamed or deleted: the one that was open may be gone."""
        with suppress(SessionUnreadable):
            if self.context.now.session_id:
                self.context.library.entry(self.context.now.session_id)
                return
        self.context.now.session_id = ""


class StoredSessions:
    """All sessions of a patient and what can be done with them. All but ``lines`` and ``other_patients`` may read or
    write the disk: called in the background."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def lines(self, patient_id: str) -> Sequence[SessionLine]:
        """Newest first, without what only the files know."""
        return [self._line(entry, patient_id == PRACTICE_PATIENT) for entry in self._library.sessions(patient_id)]

    def _line(self, entry: SessionEntry, of_practice: bool) -> SessionLine:
        return SessionLine(
            entry.session_id, entry.recorded, entry.exercise, entry.hand, entry.duration_s, entry.complete,
            entry.simulated, of_practice, self._aside(entry.session_id),
        )  # fmt: skip

    def _aside(self, session_id: str) -> str:
        try:
            choices = self._library.choices(session_id)
        except SessionUnreadable:
            return ""
        return (choices.not_counted_reason or "by hand") if choices.not_counted else ""

    def with_figures(self, line: SessionLine) -> SessionLine:
        entry = self._library.entry(line.session_id)
        try:
            figures = self._library.figures(entry)
        except SessionUnreadable:
            return replace(line, damaged=True, away=not entry.path.exists())
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
        return [(row.patient_id, row.entry.pseudonym) for row in rows if row.patient_id != patient_id]

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

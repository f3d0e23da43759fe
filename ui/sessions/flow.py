"""The flow of a patient's sessions: the list, and where one goes on from it."""

from __future__ import annotations

from contextlib import suppress

from carpus.core.errors import SessionUnreadable
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import put_off_last
from carpus.ui.sessions.screen import SessionsScreen
from carpus.ui.sessions.stored import StoredSessions


class SessionsFlow(Flow):
    """All sessions of a patient."""

    place, guide = "sessions", "sessions"
    screen: SessionsScreen

    def __init__(self, context: ScreenContext) -> None:
        stored = StoredSessions(context.library)
        super().__init__(context, SessionsScreen(context.theme, context.background, stored))
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

"""Controller of a patient's session list."""

from __future__ import annotations

from contextlib import suppress

from carpus.core.model.errors import SessionUnreadable
from carpus.ui.screens.sessions.screen import SessionsScreen
from carpus.ui.screens.sessions.session_list import SessionStore
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import postpone_last_notice


class SessionsFlow(Flow):
    """Controller of the session list."""

    screen_name, guide_page = "sessions", "sessions"
    screen: SessionsScreen

    def __init__(self, context: ScreenContext) -> None:
        stored = SessionStore(context.library, context.names.title)
        super().__init__(context, SessionsScreen(context.theme, context.background, stored))
        screen, way = self.screen, context.navigator
        screen.fault_raised.connect(context.messages.show_fault)
        screen.open_requested.connect(lambda session_id: way.open_screen("review", session_id))
        screen.progress_requested.connect(self._show_progress)
        screen.pair_requested.connect(lambda one, other: way.open_screen("comparison", one, other))
        screen.sessions_changed.connect(self._clear_missing_session)

    def open(self, patient_id: str) -> None:
        self.open_patient(patient_id)
        now = self.context.current
        self.screen.show_patient(patient_id, now.patient_name, now.session_id)
        self.context.navigator.switch_screen("sessions")

    def navigate_back(self) -> None:
        if not postpone_last_notice(self.screen):
            self.return_to_patients()

    def _show_progress(self, session_id: str) -> None:
        now = self.context.current
        assert now.patient is not None
        now.session_id = session_id
        self.context.navigator.open_screen("progress", now.patient.patient_id)

    def _clear_missing_session(self) -> None:
        """Close the open session if it was moved or deleted."""
        with suppress(SessionUnreadable):
            if self.context.current.session_id:
                self.context.library.entry(self.context.current.session_id)
                return
        self.context.current.session_id = ""

"""Who looks at a patient or a session leaves a line in the audit log."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.main_controller import MainController
from carpus.core.records.library import Library


class AccessLogger(QObject):
    """Watches the journey; changes nothing of it."""

    log_failed = Signal(object)
    """Something could not be written into the log, from whatever thread."""

    def __init__(self, journey: MainController, library: Library) -> None:
        super().__init__(journey)
        self._find_compared_ids: Callable[[], Sequence[str]] = lambda: sorted(journey.beside.screen.session_ids)
        self._current, self._library = journey.current, library
        self._last_access = ("", "")
        self.log_failed.connect(journey.messages.show_fault)
        library.on_fault = self.log_failed.emit
        journey.navigator.screen_changed.connect(self._log_access)

    def _log_access(self, place: str) -> None:
        patient = self._current.patient
        if place == "review" and self._is_new_access(place, self._current.session_id):
            self._library.audit_log.log_session("opened", self._current.session_id)
        elif place == "beside":
            for session_id in (
                self._find_compared_ids() if self._is_new_access(place, " ".join(self._find_compared_ids())) else ()
            ):
                self._library.audit_log.log_session("opened", session_id)
        elif place == "progress" and patient is not None and self._is_new_access(place, patient.patient_id):
            self._library.audit_log.log_patient("opened", patient.patient_id)
        elif place == "patients":
            self._last_access = ("", "")

    def _is_new_access(self, place: str, identity: str) -> bool:
        """Not only back from the help."""
        before, self._last_access = self._last_access, (place, identity)
        return before != self._last_access

"""Logs who opened a patient or a session."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.main_controller import MainController
from carpus.core.records.data_folder import DataFolder


class AccessLogger(QObject):
    """Logs openings when a screen is shown."""

    log_failed = Signal(object)
    """Emitted from any thread when the log cannot be written."""

    def __init__(self, controller: MainController, library: DataFolder) -> None:
        super().__init__(controller)
        self._find_compared_ids: Callable[[], Sequence[str]] = lambda: sorted(controller.comparison.screen.session_ids)
        self._current, self._library = controller.current, library
        self._last_access = ("", "")
        self.log_failed.connect(controller.messages.show_fault)
        library.on_fault = self.log_failed.emit
        controller.navigator.screen_changed.connect(self._log_access)

    def _log_access(self, place: str) -> None:
        patient = self._current.patient
        if place == "review" and self._is_new_access(place, self._current.session_id):
            self._library.audit_log.log_session("opened", self._current.session_id)
        elif place == "comparison":
            for session_id in (
                self._find_compared_ids() if self._is_new_access(place, " ".join(self._find_compared_ids())) else ()
            ):
                self._library.audit_log.log_session("opened", session_id)
        elif place == "progress" and patient is not None and self._is_new_access(place, patient.patient_id):
            self._library.audit_log.log_patient("opened", patient.patient_id)
        elif place == "patients":
            self._last_access = ("", "")

    def _is_new_access(self, place: str, identity: str) -> bool:
        """Return False on return from help or settings."""
        before, self._last_access = self._last_access, (place, identity)
        return before != self._last_access

"""Who looks at a patient or a session leaves a line in the audit log."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.journey import Journey
from carpus.core.records.library import Library


class OpeningsLogged(QObject):
    """Watches the journey; changes nothing of it."""

    log_lost = Signal(object)
    """Something could not be written into the log, from whatever thread."""

    def __init__(self, journey: Journey, library: Library) -> None:
        super().__init__(journey)
        self._now_beside: Callable[[], Sequence[str]] = lambda: sorted(journey.beside.screen.ids)
        self._now, self._library = journey.now, library
        self._seen = ("", "")
        self.log_lost.connect(journey.messages.fault)
        library.log_fault = self.log_lost.emit
        journey.way.arrived.connect(self._arrived)

    def _arrived(self, place: str) -> None:
        patient = self._now.patient
        if place == "review" and self._is_new(place, self._now.session_id):
            self._library.notes.session("opened", self._now.session_id)
        elif place == "beside":
            for session_id in self._now_beside() if self._is_new(place, " ".join(self._now_beside())) else ():
                self._library.notes.session("opened", session_id)
        elif place == "progress" and patient is not None and self._is_new(place, patient.patient_id):
            self._library.notes.patient("opened", patient.patient_id)
        elif place == "patients":
            self._seen = ("", "")

    def _is_new(self, place: str, identity: str) -> bool:
        """Not only back from the help."""
        before, self._seen = self._seen, (place, identity)
        return before != self._seen

"""The views of a patient: sessions, review, progress, and on to the report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject, Signal

from carpus.core.errors import SessionUnreadable
from carpus.core.hand.exercises import exercise_named
from carpus.core.records.values import SessionEntry
from carpus.ui.flow import TABS, Navigator
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.messages import Messages
from carpus.ui.now_open import NowOpen
from carpus.ui.ports import PatientRow
from carpus.ui.progress.screen import ProgressScreen
from carpus.ui.review.screen import ReviewScreen
from carpus.ui.sessions.screen import SessionsScreen


class KeptSessions(Protocol):
    """Which sessions there are."""

    def sessions(self, patient_id: str) -> Sequence[SessionEntry]: ...

    def entry(self, session_id: str) -> SessionEntry: ...


@dataclass(frozen=True, slots=True)
class ViewScreens:
    """The views, without the report."""

    sessions: SessionsScreen
    review: ReviewScreen
    progress: ProgressScreen


class Viewing(QObject):
    """``report_wanted`` carries the session's identity; ``stayed`` when a tab leads nowhere."""

    report_wanted = Signal(str)
    stayed = Signal()

    def __init__(
        self,
        parent: QObject,
        screens: ViewScreens,
        way: Navigator,
        tell: Messages,
        now: NowOpen,
        sessions: KeptSessions,
        find_patient: Callable[[str], PatientRow],
        places: LastPlaces,
    ) -> None:
        super().__init__(parent)
        self._list, self._review, self._progress = screens.sessions, screens.review, screens.progress
        self._way, self._tell, self._now = way, tell, now
        self._sessions, self._find_patient, self._places = sessions, find_patient, places
        self._list.opened.connect(self.open_review)
        self._list.progress.connect(self._compare)
        self._list.changed.connect(self._sessions_changed)
        self._progress.session.connect(self.open_review)
        for screen in (self._list, self._review, self._progress):
            screen.told.connect(tell.fault)

    def open_sessions(self, patient_id: str) -> None:
        """All sessions of a patient."""
        self._now.patient = self._find_patient(patient_id)
        self._list.begin(patient_id, self._now.name, self._now.session_id)
        self._way.go("sessions")

    def open_review(self, session_id: str) -> None:
        """Show one session."""
        now = self._now
        assert now.patient is not None
        now.session_id = session_id
        may_repeat = now.source is None or not now.source.measuring.starts_with_recording
        may_repeat &= bool(now.patient.patient_id)  # a file of nobody here has nobody to measure
        protocol = exercise_named(self._sessions.entry(session_id).exercise).protocol
        self._review.begin(now.patient.patient_id, session_id, may_repeat=may_repeat, whole_hand=protocol.has_fingers)
        self._review.curves.start_folder = self._places.folder("exports")
        self._way.go("review")

    def open_review_of(self, patient_id: str, session_id: str) -> None:
        """Show one session of a patient who is not open."""
        self._now.patient = self._find_patient(patient_id)
        self.open_review(session_id)

    def review_newest(self, patient_id: str) -> None:
        """Show the newest session of a patient, if there is one."""
        self._now.patient = self._find_patient(patient_id)
        sessions = self._sessions.sessions(patient_id)
        if sessions:
            self.open_review(sessions[0].session_id)

    def open_progress(self, patient_id: str) -> None:
        """Show how it went over the weeks."""
        self._now.patient = self._find_patient(patient_id)
        self._progress.chart.start_folder = self._places.folder("exports")
        self._progress.begin(patient_id, self._now.session_id)
        self._way.go("progress")

    def take_tab(self, number: int) -> None:
        """A tab of the top bar."""
        place, patient = TABS[number], self._now.patient
        if patient is None or place == self._way.place or self._tell.busy:
            self.stayed.emit()
        elif place == "sessions":
            self.open_sessions(patient.patient_id)
        elif place == "progress":
            self.open_progress(patient.patient_id)
        elif self._now.session_id and place == "report":
            self.report_wanted.emit(self._now.session_id)
        elif self._now.session_id:
            self.open_review(self._now.session_id)
        else:
            self.review_newest(patient.patient_id)

    def _compare(self, session_id: str) -> None:
        assert self._now.patient is not None
        self._now.session_id = session_id
        self.open_progress(self._now.patient.patient_id)

    def _sessions_changed(self) -> None:
        """A session was moved, renamed or deleted: the one that was open may be gone."""
        with suppress(SessionUnreadable):
            if self._now.session_id:
                self._sessions.entry(self._now.session_id)
                return
        self._now.session_id = ""

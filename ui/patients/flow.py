"""The flow of the first screen: who is measured, and what of them is looked at."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from carpus.core.records.new_sessions import NewSessions
from carpus.core.records.store import new_id
from carpus.core.records.values import Patient
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import put_off_last
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.patients.stored import StoredPatients


class PatientsFlow(Flow):
    """Whatever was open is closed."""

    place = "patients"
    screen: PatientsScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, PatientsScreen(context.theme, StoredPatients(context.library), context.today))
        screen, way, camera = self.screen, context.way, context.camera
        camera.when_looked(lambda: screen.set_camera_ready(camera.there))
        screen.start.connect(lambda patient_id: way.show("camera", patient_id))
        screen.unlisted.connect(self._measure_unlisted)
        screen.set_up.connect(lambda patient_id: way.show("exercise", patient_id))
        screen.review.connect(lambda patient_id: way.show("review", "", patient_id))
        screen.progress.connect(lambda patient_id: way.show("progress", patient_id))
        screen.sessions.connect(lambda patient_id: way.show("sessions", patient_id))
        context.shell.key.connect(self._take_key)

    def show(self, choose: str = "") -> None:
        """The list; ``choose`` who is chosen in it."""
        self.close_patient()
        NewSessions(self.context.library).cut_short()  # what a full disk kept from the list is taken into it
        self.screen.refresh(choose)
        self.context.way.go("patients")

    def first(self) -> QWidget:
        return self.screen.search

    def server_back(self) -> None:
        if self.context.way.place == "patients":
            self.screen.refresh()

    def _measure_unlisted(self, row: Patient) -> None:
        """Somebody whom the list cannot tell now: the file says who it is, by identity and pseudonym."""
        row = row if row.patient_id else replace(row, patient_id=new_id())
        self.context.now.patient = row
        self.context.way.show("exercise", row.patient_id)

    def up(self) -> None:
        if self.screen.search.text():
            self.screen.search.clear()
        elif not put_off_last(self.screen):
            self.to_patient()

    def _take_key(self, name: str) -> None:
        if self.context.way.place == "patients" and name == "search":
            self.screen.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
        elif self.context.way.place == "patients" and name == "new_patient":
            self.screen.new_patient()

"""Controller of the patient list."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from carpus.core.records.new_sessions import SessionIntake
from carpus.core.records.store import new_id
from carpus.core.records.values import Patient
from carpus.ui.screens.patients.patient_store import PatientStore
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import postpone_last_notice


class PatientsFlow(Flow):
    """Controller of the patient list; closes what was open."""

    screen_name = "patients"
    screen: PatientsScreen

    def __init__(self, context: ScreenContext) -> None:
        store = PatientStore(context.library)
        super().__init__(context, PatientsScreen(context.theme, store, context.today, context.names))
        screen, way, camera = self.screen, context.navigator, context.camera
        camera.notify_availability(lambda: screen.set_camera_ready(camera.is_connected))
        screen.start_requested.connect(lambda patient_id: way.open_screen("camera", patient_id))
        screen.unlisted_start_requested.connect(self._measure_unlisted)
        screen.setup_requested.connect(lambda patient_id: way.open_screen("exercise", patient_id))
        screen.review_requested.connect(lambda patient_id: way.open_screen("review", "", patient_id))
        screen.progress_requested.connect(lambda patient_id: way.open_screen("progress", patient_id))
        screen.sessions_requested.connect(lambda patient_id: way.open_screen("sessions", patient_id))
        context.window.key_pressed.connect(self._on_key)

    def open(self, choose: str = "") -> None:
        """Show the list with the patient ``choose`` selected."""
        self.close_patient()
        SessionIntake(
            self.context.library
        ).recover_interrupted()  # what a full disk kept from the list is taken into it
        self.screen.refresh(choose)
        self.context.navigator.switch_screen("patients")

    def initial_focus(self) -> QWidget:
        return self.screen.search

    def on_server_reconnected(self) -> None:
        if self.context.navigator.screen_name == "patients":
            self.screen.refresh()

    def _measure_unlisted(self, row: Patient) -> None:
        """Measure a patient while the list is unavailable; the file stores id and pseudonym."""
        row = row if row.patient_id else replace(row, patient_id=new_id())
        self.context.current.patient = row
        self.context.navigator.open_screen("exercise", row.patient_id)

    def navigate_back(self) -> None:
        if self.screen.search.text():
            self.screen.search.clear()
        elif not postpone_last_notice(self.screen):
            self.return_to_patients()

    def _on_key(self, name: str) -> None:
        if self.context.navigator.screen_name == "patients" and name == "search":
            self.screen.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
        elif self.context.navigator.screen_name == "patients" and name == "new_patient":
            self.screen.new_patient()

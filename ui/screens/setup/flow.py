"""The flows before measuring: exercise and source."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt

from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.model.types import Side
from carpus.core.pipeline.recording import read_free_bytes
from carpus.core.records.clinic_records import read_sets, save_sets
from carpus.core.records.patients import read_goals, read_last_setup
from carpus.core.records.session_setup import (
    DEFAULT_SETS,
    PRACTICE_PATIENT,
    ExerciseSet,
    SessionSetup,
    practice_setup,
)
from carpus.core.records.values import read_or_default
from carpus.ui.screens.setup.camera import CameraScreen
from carpus.ui.screens.setup.exercise import ExerciseScreen
from carpus.ui.screens.setup.set_dialog import SetDialog
from carpus.ui.shell.current_selection import SourceChoice
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import Answer

MIN_FREE_FOR_VIDEO_BYTES = 20e9
"""Video is saved by default if the disk has this much space: three hours of it."""


class ExerciseFlow(Flow):
    """First step, with the clinic's sets of exercises."""

    screen_name, guide_page = "exercise", "exercises"
    screen: ExerciseScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ExerciseScreen(context.theme))
        self.set_dialog = SetDialog(context.window.screen_stack, context.theme)
        self.sets: tuple[ExerciseSet, ...] = ()
        self.set_dialog.sets_saved.connect(self._save_sets)
        self.screen.sets_button.clicked.connect(self._open_sets)
        self.screen.set_up_chosen.connect(self._on_set_up_chosen)
        self.load_sets()

    def open(self, patient_id: str) -> None:
        """Open for a patient with the last set-up; earlier sessions are read meanwhile."""
        context, library = self.context, self.context.library
        context.opener.close_source()
        row = self.open_patient(patient_id)
        last = context.current.set_up or read_or_default(lambda: read_last_setup(library.store, patient_id), None)
        affected: Side | None = None if row.side == "both" else row.side
        free = read_free_bytes(library.folder) or 0
        usual = context.keep_pictures and free >= MIN_FREE_FOR_VIDEO_BYTES
        self.screen.show_patient(
            row, last, last.side if last is not None else affected,
            last.stores_frames if last is not None else usual,
            context.mb_per_minute, free / (1e6 * context.mb_per_minute),
            read_or_default(lambda: read_goals(library.store, patient_id), {}),
        )  # fmt: skip
        # What cannot be read proposes nothing; opening it tells why.
        self.run(
            lambda: library.history(patient_id),
            lambda history: self.screen.show_history(patient_id, history),
            lambda _: None,
        )
        context.navigator.switch_screen("exercise")

    def on_server_reconnected(self) -> None:
        self.load_sets()

    def _on_set_up_chosen(self, set_up: SessionSetup) -> None:
        self.context.current.set_up = set_up
        self.context.navigator.open_screen("camera", "", True)

    # --- sets of exercises --------------------------------------------------------------------------------
    def load_sets(self) -> None:
        """Load the sets; offer the default ones if that fails."""
        try:
            self.sets = read_sets(self.context.library.store)
        except ServerUnavailable:  # every screen says so
            self.sets = DEFAULT_SETS
        except CarpusFault as fault:
            self.sets = DEFAULT_SETS
            self.context.messages.show_fault(fault)
        self.screen.show_sets(self.sets)

    def _open_sets(self) -> None:
        chosen = str(self.screen.exercises.value())
        self.set_dialog.open_sets(self.sets, str(self.screen.protocol.value()), chosen.removeprefix("set:"))

    def _save_sets(self, sets: tuple[ExerciseSet, ...], chosen_id: str) -> None:
        try:
            save_sets(self.context.library.store, sets, self.sets)
        except CarpusFault as fault:
            self.context.messages.show_fault(fault)
            self.load_sets()
            return
        self.sets = sets
        self.screen.show_sets(sets, chosen_id)


class CameraFlow(Flow):
    """Second step: opens the source."""

    screen_name, guide_page = "camera", "camera"
    screen: CameraScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, CameraScreen(context.theme, is_demo=context.is_demo))
        opener, camera, screen = context.opener, context.camera, self.screen
        camera.notify_availability(lambda: screen.set_camera_ready(camera.is_connected, camera.name))
        screen.source_chosen.connect(opener.open)
        screen.path_chosen.connect(lambda path: context.recent_locations.save("recordings", str(Path(path).parent)))
        opener.opening.connect(self._on_opening)
        opener.opened.connect(self._on_opened)
        opener.failed.connect(self._on_failed)
        opener.progress_changed.connect(lambda _, total: screen.progress.setMaximum(max(total, 1)))
        opener.progress_changed.connect(lambda done, _: screen.progress.setValue(done))

    def open(self, patient_id: str = "", goes_on: bool = False) -> None:
        """Open for the chosen set-up; ``goes_on`` opens a camera that is ready without asking.

        For a patient the last set-up is used, and the source opened at once if possible; without one, the exercise is
        asked for.
        """
        now, way = self.context.current, self.context.navigator
        if not patient_id:
            self._show_screen()
            if goes_on:
                self._open_ready_source()
            return
        row = self.open_patient(patient_id)
        last = read_or_default(lambda: read_last_setup(self.context.library.store, patient_id), None)
        if last is None and patient_id != PRACTICE_PATIENT:
            way.open_screen("exercise", patient_id)
            return
        now.set_up = last or practice_setup(row.pseudonym)
        self._show_screen()
        self._open_ready_source()

    def _open_ready_source(self) -> None:
        """Open the source if there is nothing to choose: no recording is wanted and the camera is ready."""
        choice = self.context.current.source_choice
        if choice.kind == "practice" or (choice.kind == "camera" and self.context.camera.is_connected):
            self.context.opener.open(choice)

    def _show_screen(self) -> None:
        now = self.context.current
        if now.set_up is None:
            return
        self.context.opener.close_source()
        self.screen.start_folder = self.context.recent_locations.folder("recordings")
        practises = now.set_up.patient_id == PRACTICE_PATIENT
        if practises:
            now.source_choice = SourceChoice("practice")
        elif now.source_choice.kind == "practice" and not self.context.is_demo:
            now.source_choice = SourceChoice("camera")  # only the practice patient is simulated without being asked
        self.screen.show_set_up(now.set_up, now.source_choice.kind)
        self.context.navigator.switch_screen("camera")

    def navigate_back(self) -> None:
        """Go back to the exercise; the source that is being opened is dropped."""
        if self.context.current.patient is not None:
            self.context.navigator.open_screen("exercise", self.context.current.patient.patient_id)

    def _on_opening(self, choice: SourceChoice) -> None:
        words = {
            "camera": self.tr("The camera is being opened."),
            "file": self.tr("The recording is being opened."),
            "practice": self.tr("The simulated patient is being prepared."),
        }[choice.kind]
        self.screen.show_opening(True, words)

    def _on_opened(self) -> None:
        self.screen.show_opening(False)
        self.context.navigator.open_screen("markers")

    def _on_failed(self, fault: Exception) -> None:
        self.screen.show_opening(False)
        self.screen.initial_focus().setFocus(Qt.FocusReason.OtherFocusReason)
        self.context.messages.show_fault(fault, (Answer(self.tr("Choose the source again"), lambda: None),))

"""The flow before measuring: which exercise, and where the pictures come from."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Qt

from carpus.core.errors import CarpusFault, ServerGone
from carpus.core.records.kept_sets import keep_sets, last_set_up, read_sets
from carpus.core.records.patients import goals
from carpus.core.records.set_up import PRACTICE_PATIENT, USUAL_SETS, ExerciseSet, SetUp, practice_set_up
from carpus.core.records.values import unless_away
from carpus.core.results.figures import SessionFigures
from carpus.core.types import Side
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import Answer
from carpus.ui.now_open import SourceChoice
from carpus.ui.setup.camera import CameraScreen
from carpus.ui.setup.exercise import ExerciseScreen
from carpus.ui.setup.set_sheet import SetSheet

ROOM_FOR_PICTURES_BYTES = 20e9
"""Pictures are kept without being asked for where the disk has so much: three hours of them."""


class ExerciseFlow(Flow):
    """First step, with the clinic's sets of exercises."""

    place, guide = "exercise", "exercises"
    screen: ExerciseScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ExerciseScreen(context.theme))
        self.sheet = SetSheet(context.shell.stage, context.theme)
        self.sets: tuple[ExerciseSet, ...] = ()
        self.sheet.kept.connect(self._keep_sets)
        self.screen.sets_button.clicked.connect(self._open_sets)
        self.screen.ready.connect(self._go_on)
        self.look_for_sets()

    def show(self, patient_id: str) -> None:
        """For a patient, as chosen last or as in the last session; what was measured before is read meanwhile."""
        context, library = self.context, self.context.library
        context.opener.close_source()
        row = self.open_patient(patient_id)
        last = context.now.set_up or unless_away(lambda: last_set_up(library.store, patient_id), None)
        affected: Side | None = None if row.side == "both" else row.side
        free = free_bytes(library.folder)
        usual = context.keep_pictures and free >= ROOM_FOR_PICTURES_BYTES
        self.screen.begin(
            row, last, last.side if last is not None else affected,
            last.keep_pictures if last is not None else usual,
            context.mb_per_minute, free / (1e6 * context.mb_per_minute),
            unless_away(lambda: goals(library.store, patient_id), {}),
        )  # fmt: skip

        def show(history: Sequence[SessionFigures]) -> None:
            self.screen.show_history(patient_id, history)

        # What cannot be read proposes nothing; opening it tells why.
        self.run(lambda: library.history(patient_id), show, lambda _: None)
        context.way.go("exercise")

    def server_back(self) -> None:
        self.look_for_sets()

    def _go_on(self, set_up: SetUp) -> None:
        self.context.now.set_up = set_up
        self.context.way.show("camera")

    # --- sets of exercises --------------------------------------------------------------------------------
    def look_for_sets(self) -> None:
        """Read them; where that cannot be done the usual ones are offered."""
        try:
            self.sets = read_sets(self.context.library.store)
        except ServerGone:  # every screen says so
            self.sets = USUAL_SETS
        except CarpusFault as fault:
            self.sets = USUAL_SETS
            self.context.messages.fault(fault)
        self.screen.show_sets(self.sets)

    def _open_sets(self) -> None:
        chosen = str(self.screen.exercises.value())
        self.sheet.begin(self.sets, str(self.screen.protocol.value()), chosen.removeprefix("set:"))

    def _keep_sets(self, sets: tuple[ExerciseSet, ...], chosen_id: str) -> None:
        try:
            keep_sets(self.context.library.store, sets, self.sets)
        except CarpusFault as fault:
            self.context.messages.fault(fault)
            self.look_for_sets()
            return
        self.sets = sets
        self.screen.show_sets(sets, chosen_id)


class CameraFlow(Flow):
    """Second step: opens the source."""

    place, guide = "camera", "camera"
    screen: CameraScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, CameraScreen(context.theme, is_demo=context.is_demo))
        opener, camera, screen = context.opener, context.camera, self.screen
        camera.when_looked(lambda: screen.set_camera_ready(camera.there, camera.name))
        screen.wanted.connect(opener.open)
        screen.picked.connect(lambda path: context.places.keep("recordings", str(Path(path).parent)))
        opener.opening.connect(self._opening)
        opener.opened.connect(self._opened)
        opener.failed.connect(self._failed)
        opener.progressed.connect(screen.show_progress)

    def show(self, patient_id: str = "") -> None:
        """For the set-up that was chosen. For a patient with the same set-up as last time, opened at once if that can
        be; where nothing is known it is asked for."""
        now, way = self.context.now, self.context.way
        if not patient_id:
            self._begin()
            return
        row = self.open_patient(patient_id)
        last = unless_away(lambda: last_set_up(self.context.library.store, patient_id), None)
        practises = patient_id == PRACTICE_PATIENT
        if practises:
            now.choice = SourceChoice("practice")
        elif last is None:
            way.show("exercise", patient_id)
            return
        now.set_up = last or practice_set_up(row.pseudonym)
        self._begin()
        if practises or (now.kind != "file" and self.context.camera.there):
            self.context.opener.open(now.choice)

    def _begin(self) -> None:
        now = self.context.now
        if now.set_up is None:
            return
        self.context.opener.close_source()
        self.screen.start_folder = self.context.places.folder("recordings")
        practises = now.set_up.patient_id == PRACTICE_PATIENT
        if not practises and now.kind == "practice" and not self.context.is_demo:
            now.choice = SourceChoice("camera")  # nobody else is measured on the practice patient's without being asked
        self.screen.begin(now.set_up, "practice" if practises else now.kind)
        self.context.way.go("camera")

    def up(self) -> None:
        """Back to the exercise; what is being opened is not wanted any more."""
        if self.context.now.patient is not None:
            self.context.way.show("exercise", self.context.now.patient.patient_id)

    def _opening(self, choice: SourceChoice) -> None:
        words = {
            "camera": self.tr("The camera is being opened."),
            "file": self.tr("The recording is being opened."),
            "practice": self.tr("The simulated patient is being drawn."),
        }[choice.kind]
        self.screen.show_opening(True, words)

    def _opened(self) -> None:
        self.screen.show_opening(False)
        self.context.way.show("markers")

    def _failed(self, fault: Exception) -> None:
        self.screen.show_opening(False)
        self.screen.first().setFocus(Qt.FocusReason.OtherFocusReason)
        self.context.messages.fault(fault, (Answer(self.tr("Choose the source again"), lambda: None),))


def free_bytes(folder: Path) -> float:
    """Room on the disk of a folder; none where nobody can say."""
    try:
        return float(shutil.disk_usage(folder).free)
    except OSError:
        return 0.0

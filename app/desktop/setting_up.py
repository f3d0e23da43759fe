"""The flow before measuring: exercise, camera, markers; it opens the source and lets it go."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, Qt, Signal

from carpus.app.desktop.opening import Opener
from carpus.app.desktop.practice import PRACTICE_REPETITIONS
from carpus.core.calibration.result import Verdict
from carpus.core.capture.files.raw import MB_PER_MINUTE
from carpus.core.hand.exercises import EXERCISES
from carpus.core.records.set_up import PRACTICE_PATIENT, SetUp
from carpus.core.records.values import SessionEntry
from carpus.core.results.figures import SessionFigures
from carpus.core.results.goals import Goals
from carpus.core.types import ByteImage, Side
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.background import Background
from carpus.ui.flow import Navigator
from carpus.ui.last_places import LastPlaces
from carpus.ui.markers.screen import MarkersScreen
from carpus.ui.messages.messages import Messages
from carpus.ui.messages.stop_card import Answer
from carpus.ui.now_open import NowOpen, OpenSource
from carpus.ui.ports import PatientRow
from carpus.ui.setup.camera import CameraScreen
from carpus.ui.setup.choice import SourceChoice
from carpus.ui.setup.exercise import ExerciseScreen

ROOM_FOR_PICTURES_BYTES = 20e9
"""Pictures are kept without being asked for where the disk has so much: three hours of them."""


class SetUpMemory(Protocol):
    """How a patient was set up before."""

    def last_set_up(self, patient_id: str) -> SetUp | None: ...

    def sessions_alike(self, patient_id: str, set_up: SetUp) -> Sequence[SessionEntry]: ...

    def marker_picture(self, patient_id: str, set_up: SetUp | None = None) -> ByteImage | None: ...

    def goals(self, patient_id: str) -> Goals: ...

    def history(self, patient_id: str) -> Sequence[SessionFigures]: ...


@dataclass(frozen=True, slots=True)
class SetUpScreens:
    """The three steps."""

    exercise: ExerciseScreen
    camera: CameraScreen
    markers: MarkersScreen


class SettingUp(QObject):
    """``ready`` when tracking has begun; ``closing`` before the source is let go."""

    ready = Signal()
    closing = Signal()

    def __init__(
        self,
        parent: QObject,
        screens: SetUpScreens,
        way: Navigator,
        tell: Messages,
        now: NowOpen,
        memory: SetUpMemory,
        find_patient: Callable[[str], PatientRow],
        opener: Opener,
        places: LastPlaces,
        background: Background,
        *,
        camera_there: Callable[[], bool],
        keep_pictures: bool,
        free_bytes: Callable[[], float],
        is_demo: bool = False,
    ) -> None:
        super().__init__(parent)
        self._is_demo = is_demo
        self._exercise, self._camera, self._markers = screens.exercise, screens.camera, screens.markers
        self._way, self._tell, self._now, self._memory = way, tell, now, memory
        self._find_patient, self._opener, self._places, self._background = find_patient, opener, places, background
        self._camera_there, self._keep_pictures, self._free_bytes = camera_there, keep_pictures, free_bytes
        self._exercise.ready.connect(self.choose_camera)
        self._camera.wanted.connect(self.open_source)
        self._camera.picked.connect(lambda path: places.keep("recordings", str(Path(path).parent)))
        opener.opened.connect(self._opened)
        opener.failed.connect(self._failed)
        opener.progressed.connect(self._camera.show_progress)
        self._markers.started.connect(self.ready)
        self._markers.told.connect(tell.fault)
        self._markers.judged.connect(self.check_registration)

    # --- the steps ----------------------------------------------------------------------------------------
    def start(self, patient_id: str) -> None:
        """Same set-up as last time, or the first one: ask for what is not known."""
        now = self._now
        now.patient = self._find_patient(patient_id)
        set_up = self._memory.last_set_up(patient_id)
        if patient_id == PRACTICE_PATIENT:
            now.choice = SourceChoice("practice")
            self.choose_camera(set_up or practice_set_up(now.patient.pseudonym))
            self.open_source(now.choice)
        elif set_up is None:
            self.choose_exercise(patient_id)
        else:
            self.choose_camera(set_up)
            if now.kind != "file" and self._camera_there():
                self.open_source(now.choice)

    def choose_exercise(self, patient_id: str) -> None:
        """First step."""
        row = self._now.patient = self._find_patient(patient_id)
        last = self._now.set_up or self._memory.last_set_up(patient_id)
        affected: Side | None = None if row.side == "both" else row.side
        side = last.side if last is not None else affected
        free = self._free_bytes()
        keep = last.keep_pictures if last is not None else self._keep_pictures and free >= ROOM_FOR_PICTURES_BYTES
        goals = self._memory.goals(patient_id)
        self._exercise.begin(row, last, side, keep, MB_PER_MINUTE, free / (1e6 * MB_PER_MINUTE), goals)
        found: list[Sequence[SessionFigures]] = []

        def show(_: object) -> None:
            self._exercise.show_history(patient_id, found[0])

        # What cannot be read proposes nothing; opening it tells why.
        self._background.run(
            lambda: found.append(self._memory.history(patient_id)), show, lambda _: None, self._exercise
        )
        self._way.go("exercise")

    def choose_camera(self, set_up: SetUp) -> None:
        """Second step."""
        self.close_source()
        now = self._now
        now.set_up = set_up
        self._camera.start_folder = self._places.folder("recordings")
        is_practice = set_up.patient_id == PRACTICE_PATIENT
        if not is_practice and now.kind == "practice" and not self._is_demo:
            now.choice = SourceChoice("camera")  # nobody else is measured on the practice patient's without being asked
        self._camera.begin(set_up, "practice" if is_practice else now.kind)
        self._way.go("camera")

    def open_source(self, choice: SourceChoice) -> None:
        """Open camera, recording or simulation in the background."""
        now = self._now
        assert now.set_up is not None
        now.choice = choice
        words = {
            "camera": self.tr("The camera is being opened."),
            "file": self.tr("The recording is being opened."),
            "practice": self.tr("The simulated patient is being drawn."),
        }[choice.kind]
        self._camera.show_opening(True, words)
        self._opener.open(choice, now.set_up)

    def _opened(self, source: OpenSource) -> None:
        self._camera.show_opening(False)
        self._now.source = source
        self._show_markers()

    def _failed(self, fault: Exception) -> None:
        self._camera.show_opening(False)
        self._camera.first().setFocus(Qt.FocusReason.OtherFocusReason)
        self._tell.fault(fault, (Answer(self.tr("Choose the source again"), lambda: None),))

    def _show_markers(self) -> None:
        """Third step."""
        source, set_up = self._now.source, self._now.set_up
        assert source is not None
        assert set_up is not None
        patient_id = set_up.patient_id
        alike = self._memory.sessions_alike(patient_id, set_up)
        day = numbers.day_month(alike[0].recorded) if alike else ""
        self._markers.begin(source.calibrator, self._memory.marker_picture(patient_id, set_up), day)
        self._way.go("markers")

    def check_registration(self, verdict: Verdict) -> None:
        """Nothing said whether depth lies on colour, so it was taken to; the calibration has measured otherwise."""
        off = next((finding for finding in verdict.findings if finding.kind == "depth_off"), None)
        source, choice = self._now.source, self._now.choice
        if off is None or source is None or not source.asks_registration:
            return
        name = Path(choice.path.replace("\\", "/")).name

        def open_again() -> None:
            assert self._now.set_up is not None
            self.choose_camera(self._now.set_up)
            self.open_source(replace(choice, registered=False))

        self._tell.ask(
            Words(
                self.tr("The depth of {name} lies {px} pixels beside its colours.").format(
                    name=name, px=f"{off.value:.0f}"
                ),
                self.tr("The recording itself is not changed. It does not say that its depth was laid on its colours."),
                self.tr("Open it again with the depth moved onto the colours, then click the markers anew."),
            ),
            (
                Answer(self.tr("Leave it as it is"), lambda: None),
                Answer(self.tr("Open it again"), open_again),
            ),
        )

    # --- back, and away -----------------------------------------------------------------------------------
    def up_from_camera(self) -> None:
        """Back to the exercise; what is being opened is not wanted any more."""
        self._opener.cancel()
        if self._now.patient is not None:
            self.choose_exercise(self._now.patient.patient_id)

    def up_from_markers(self) -> None:
        """Back to the camera; names that a person has given are not thrown away by one key."""
        if not self._markers.has_names:
            self.up_to_camera()
            return
        self._tell.ask(
            Words(
                self.tr("Leave the markers?"),
                self.tr("The names given on this picture would be lost."),
                self.tr("Stay here, or go back to the camera."),
            ),
            (
                Answer(self.tr("Back to the camera"), self.up_to_camera, "B", risky=True),
                Answer(self.tr("Stay here"), lambda: None),
            ),
        )

    def up_to_camera(self) -> None:
        """Back from the markers or the live screen."""
        if self._now.set_up is not None:
            self.choose_camera(self._now.set_up)

    def exercise_again(self) -> None:
        """The first step once more."""
        if self._now.patient is not None:
            self.close_source()
            self.choose_exercise(self._now.patient.patient_id)

    def close_source(self) -> None:
        """Let camera or recording go."""
        self._opener.cancel()
        source, self._now.source = self._now.source, None
        if source is not None:
            self._markers.end()
            self.closing.emit()
            self._background.run(source.measuring.close, lambda _: None, self._tell.fault)


def practice_set_up(pseudonym: str) -> SetUp:
    """What the practice patient does first."""
    nothing = float("nan")
    return SetUp(PRACTICE_PATIENT, pseudonym, "right", EXERCISES[0], PRACTICE_REPETITIONS, nothing, nothing)

"""Puts the screens together: patient, exercise, camera, markers, live, review, progress, report.

Each knows its own way (:mod:`ui.flow`); here is what belongs to none: the top bar, the keys, the end.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from carpus import __version__
from carpus.app.desktop.bar import Bar
from carpus.app.desktop.care_cameras import CareCameras
from carpus.app.settings import Settings
from carpus.core.capture.files.raw import MB_PER_MINUTE
from carpus.core.errors import CarpusFault
from carpus.core.records.corrections import Corrections
from carpus.core.records.library import Library
from carpus.ui.background import Background
from carpus.ui.camera_state import CameraState
from carpus.ui.flow import STEPS, TABS, Navigator, Place, ScreenContext
from carpus.ui.keys import Keys
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.messages import Messages
from carpus.ui.now_open import NowOpen
from carpus.ui.opening import Opener, OpenIt
from carpus.ui.ports import PatientRow
from carpus.ui.setup.choice import SourceChoice
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.agreement.flow import AgreementFlow
    from carpus.ui.beside.flow import BesideFlow
    from carpus.ui.by_hand.flow import ByHandFlow
    from carpus.ui.camera_calibration.flow import BoardFlow
    from carpus.ui.check_card.flow import CardFlow
    from carpus.ui.clinic.flow import ClinicFlow
    from carpus.ui.correct.flow import CorrectFlow
    from carpus.ui.help.flow import HelpFlow
    from carpus.ui.live.flow import LiveFlow
    from carpus.ui.markers.flow import MarkersFlow
    from carpus.ui.patients.flow import PatientsFlow
    from carpus.ui.progress.flow import ProgressFlow
    from carpus.ui.report.flow import ReportFlow
    from carpus.ui.retest.flow import RetestFlow
    from carpus.ui.review.flow import ReviewFlow
    from carpus.ui.sessions.flow import SessionsFlow
    from carpus.ui.setup.flow import CameraFlow, ExerciseFlow

CORE = (
    "carpus.core.pipeline.correction",
    "carpus.core.agreement.compared_files",
    "carpus.core.agreement.retest",
    "carpus.core.calibration.camera.calibrate",
    "carpus.core.calibration.card.measure",
    "carpus.core.formats.film",
    "carpus.core.results.side_by_side",
)
"""What takes longest to load of what screens use, and has nothing of Qt in it: for whatever thread."""
ALL_KEYS = ("help", "settings", "search", "new_patient", "back", "quit")


@dataclass(frozen=True, slots=True)
class Parts:
    """What the journey needs besides the window."""

    library: Library
    open_source: OpenIt
    cameras: CareCameras
    settings: Settings
    is_demo: bool
    today: Callable[[], date]
    """The day now: the program may stand open for days."""


class Journey(QObject):
    """Owns the screens' flows."""

    patients: Place[PatientsFlow] = Place("patients.PatientsFlow")
    exercise: Place[ExerciseFlow] = Place("setup.ExerciseFlow")
    camera: Place[CameraFlow] = Place("setup.CameraFlow")
    markers: Place[MarkersFlow] = Place("markers.MarkersFlow")
    live: Place[LiveFlow] = Place("live.LiveFlow")
    sessions: Place[SessionsFlow] = Place("sessions.SessionsFlow")
    review: Place[ReviewFlow] = Place("review.ReviewFlow")
    progress: Place[ProgressFlow] = Place("progress.ProgressFlow")
    report: Place[ReportFlow] = Place("report.ReportFlow")
    by_hand: Place[ByHandFlow] = Place("by_hand.ByHandFlow")
    agreement: Place[AgreementFlow] = Place("agreement.AgreementFlow")
    beside: Place[BesideFlow] = Place("beside.BesideFlow")
    retest: Place[RetestFlow] = Place("retest.RetestFlow")
    clinic: Place[ClinicFlow] = Place("clinic.ClinicFlow")
    board: Place[BoardFlow] = Place("camera_calibration.BoardFlow")
    card: Place[CardFlow] = Place("check_card.CardFlow")
    help: Place[HelpFlow] = Place("help.HelpFlow")
    correct: Place[CorrectFlow] = Place("correct.CorrectFlow")

    def __init__(self, shell: Shell, theme: Theme, keys: Keys, parts: Parts) -> None:
        super().__init__(shell)
        self._shell, self._library = shell, parts.library
        self.takes_escape: Callable[[], bool] = lambda: False
        """Asked first when Esc is pressed: True where that closed something, and the person stays where they are."""
        self.settings, self.is_demo = parts.settings, parts.is_demo
        self.now = NowOpen(choice=SourceChoice("practice" if parts.is_demo else "camera"))
        self.background = Background()
        self.messages = messages = Messages(shell.stage, theme)
        self.opener = Opener(parts.open_source, self.now, self.background, messages.fault)
        self.camera_state = CameraState(
            parts.cameras, self.background, lambda: datetime.now().astimezone(), is_demo=parts.is_demo
        )
        self.way = Navigator(shell, lambda: messages.busy, lambda: "live" in self.way.flows and self.live.is_recording)
        self.context = ScreenContext(
            shell, theme, keys, parts.library, self.background, messages, self.way, self.now, self.opener,
            self.camera_state, parts.cameras, LastPlaces(parts.library.store), parts.settings.report, parts.today,
            __version__, parts.is_demo, parts.settings.patient.sound,
            parts.settings.recording.keep_pictures, MB_PER_MINUTE,
        )  # fmt: skip
        for name, place in PLACES.items():
            self.way.makers[name] = partial(place.make, self.context)
        self.bar = Bar(self.context, lambda: self.review.screen)
        self._connect(keys)
        self.camera_state.start()
        self._look_for_waiting()

    def _connect(self, keys: Keys) -> None:
        shell, bar, way = self._shell, self._shell.bar, self.way
        shell.set_keys({name: keys[name] for name in ALL_KEYS})
        shell.key.connect(self._take_key)
        shell.asks_before_closing = lambda: any(flow.asks_before_closing() for flow in way.flows.values())
        bar.back.connect(way.back)
        bar.tab.connect(self.take_tab)
        bar.step.connect(lambda number: self._go_to_step(STEPS[number]))
        bar.help.connect(lambda: way.show("help"))
        bar.settings.connect(lambda: way.show("settings"))
        bar.again_wanted.connect(lambda: self.correct.open_sheet(self.now.session_id))
        way.when_made("live", self._connect_live)
        way.when_made("beside", lambda: self.beside.screen.arrived.connect(way.changed))
        way.when_made("review", self._connect_review)
        way.when_made("correct", lambda: self.correct.changed.connect(self.bar.show_again))
        way.when_made("sessions", lambda: self.sessions.screen.changed.connect(self._look_for_waiting))

    def _connect_live(self) -> None:
        self.live.screen.recording_changed.connect(self.bar.show_recording)
        self.live.screen.counted.connect(self.bar.show_counters)

    def _connect_review(self) -> None:
        self.review.screen.arrived.connect(self.way.changed)
        self.review.screen.again.connect(lambda: self.way.show("live"))

    def _look_for_waiting(self) -> None:
        """What was tracked again and waits for a decision, also from before the program was started."""
        if "correct" in self.way.flows or Corrections(self._library).are_there:
            self.correct.look_for_waiting()

    @property
    def place(self) -> str:
        """Where the person is."""
        return self.way.place

    # --- from one to the other ----------------------------------------------------------------------------
    def take_tab(self, number: int) -> None:
        """A tab of the top bar."""
        place, patient = TABS[number], self.now.patient
        if patient is None or place == self.place or self.messages.busy:
            self.bar.show()
        elif place in ("sessions", "progress"):
            self.way.show(place, patient.patient_id)
        elif self.now.session_id:
            self.way.show(place, self.now.session_id)
        else:
            self.review.show("", patient.patient_id)

    def _go_to_step(self, place: str) -> None:
        if self.messages.busy:
            return
        if place == "exercise" and self.now.patient is not None:
            self.exercise.show(self.now.patient.patient_id)
        elif place == "camera":
            (self.markers.up if self.place == "markers" else self.camera.show)()

    def review_file(self, path: Path) -> None:
        """Open a session file handed over from outside; not while something is measured or asked."""
        if self.messages.busy or self.way.is_recording() or self.now.source is not None:
            return
        try:
            found = self._library.look_at(path)
        except CarpusFault as fault:
            self.messages.fault(fault)
            return
        if not found.patient_id:  # of nobody here: shown under the name in its file
            self.now.patient = PatientRow("", found.subject_id, found.side)
        self.review.show(found.session_id, found.patient_id)

    def _take_key(self, name: str) -> None:
        actions: dict[str, Callable[[], object]] = {
            "back": self._escape, "help": lambda: self.way.show("help"), "settings": lambda: self.way.show("settings"),
            "quit": self._shell.close,
        }  # fmt: skip
        if name in actions:
            actions[name]()

    def _escape(self) -> None:
        taken = not self.messages.busy and (
            self.takes_escape() or (self.place == "report" and self.report.screen.to_report())
        )
        if not taken:
            self.way.back()

    @property
    def is_at_work(self) -> bool:
        """Whether something is measured, or worked on that would end with the window."""
        measures = self.now.source is not None and self.way.behind in STEPS
        works = any(flow.is_at_work for flow in self.way.flows.values())
        return measures or works or self.background.busy

    def show_again_at(self, place: str, before: NowOpen) -> None:
        """Where the person was before the window was put together again: the same patient and tab."""
        if place == "beside":
            place = "sessions"  # from where both can be ticked again
        if before.patient is None or not before.patient.patient_id or place not in TABS:
            return
        with suppress(CarpusFault):
            if place == "progress":
                self.progress.show(before.patient.patient_id)
                self.now.session_id = before.session_id
            elif place == "sessions" or not before.session_id:
                self.sessions.show(before.patient.patient_id)
            else:
                self.review.show(before.session_id, before.patient.patient_id)

    def close(self) -> None:
        """The window closes: finish what runs, in order, and wait for it."""
        self.camera_state.stop()
        for flow in self.way.flows.values():
            flow.close()
        self.opener.end()
        self.background.wait()
        if self.now.source is not None:
            self.live.finish()


PLACES = {name: place for name, place in vars(Journey).items() if isinstance(place, Place)}
SCREENS = (*(place.module for place in PLACES.values()), "carpus.ui.settings.flow", "carpus.ui.plot.canvas")
"""What all screens are made of. For the window's thread alone: Qt makes a class when it is first named, and where two
threads name one each at once the process ends."""


def load(modules: Sequence[str]) -> Iterator[str]:
    """Load modules, one after the other."""
    for module in modules:
        import_module(module)
        yield module

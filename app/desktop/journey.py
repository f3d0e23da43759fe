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
from carpus.ui.now_open import NowOpen, SourceChoice
from carpus.ui.opening import Opener, OpenIt
from carpus.ui.ports import PatientRow
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.agreement.flow import AgreementFlow
    from carpus.ui.beside.flow import BesideFlow
    from carpus.ui.by_hand.flow import ByHandFlow
    from carpus.ui.camera_calibration.flow import BoardFlow
    from carpus.ui.check_card.flow import CardFlow
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

from typing import TYPE_CHECKING

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.pipeline.live_values import LiveCounters
from carpus.ui import numbers, terms
from carpus.ui.fault_words import finding_words, shortened

if TYPE_CHECKING:
    from carpus.ui.review.screen import ReviewScreen


MOST_NAME = 24
"""Letters of a recording's name in the top bar."""


class Bar(QObject):
    """Tells who is open, where one is, how camera, disk and recording are."""

    def __init__(self, context: ScreenContext, review: Callable[[], ReviewScreen]) -> None:
        super().__init__(context.shell)
        self._shell, self._now, self._way = context.shell, context.now, context.way
        self._camera, self._review, self._is_demo = context.camera, review, context.is_demo
        self._again = (-1, 0)
        self._way.arrived.connect(lambda _: self.show())
        self._way.changed.connect(self.show)
        self._camera.looked.connect(self.show_camera)

    def show(self) -> None:
        """All of it, for the place."""
        bar, row, set_up, place = self._shell.bar, self._now.patient, self._now.set_up, self._way.place
        side = set_up.side if set_up is not None else row.side if row is not None else ""
        words = [terms.hand_name(side)] if side else []
        if place == "live" and set_up is not None:
            words.append(terms.exercise_name(set_up.exercise.id))
        here = self._way.here
        bar.show_place(here.title(), " · ".join(words))
        if place in STEPS and place != "live":
            names = [self.tr("Exercise"), self.tr("Camera"), self.tr("Markers"), self.tr("Measure")]
            bar.show_steps(names, STEPS.index(place))
        elif place in TABS or here.tab:
            names = [self.tr("Sessions"), self.tr("Review"), self.tr("Progress"), self.tr("Report")]
            bar.show_tabs(names, TABS.index(here.tab or place))
        else:
            bar.show_nothing()
        if place != "live":
            self._shell.bar.disk.show_state("none", "")
        self.show_again(*self._again)
        self.show_camera()
        self._shell.sign.show_lines(self.sign_lines())

    def sign_lines(self) -> list[str]:
        """What must not be forgotten of what is on the screen: that it is simulated, or was doubtful."""
        now, place = self._now, self._way.place
        figures = self._review().figures if place == "review" else None
        simulated = False
        findings: tuple[CalibrationFinding, ...] = ()
        measuring = now.source.measuring if now.source is not None else None
        if place in ("markers", "live") and measuring is not None:
            simulated = measuring.is_simulated
            if place == "live" and measuring.calibration is not None:
                findings = measuring.calibration.verdict.findings
        elif figures is not None:
            simulated, findings = figures.simulated, figures.findings
        lines = []
        if simulated and now.patient is not None and not now.is_practice:
            words = self.tr("Simulated hand: this is not {name}, and does not count.")
            lines.append(words.format(name=now.patient.pseudonym))
        if figures is not None and figures.not_counted:
            lines.append(self.tr("This session does not count."))
        if findings:
            said = " ".join(finding_words(finding).happened for finding in findings)
            lines.append(self.tr("Measured although doubtful: {findings}").format(findings=said))
        return [*lines, *self._way.here.sign_lines()]

    def show_camera(self) -> None:
        """The camera in words; on the live screen the counters speak."""
        camera, now, place = self._shell.bar.camera, self._now, self._way.place
        if place == "live":
            return
        if place == "camera":
            camera.show_state("none", "")  # the screen itself says which there are, and how they stand
        elif place == "review" and (reviewed := self._review().reviewed) is not None:
            saved_at = reviewed.saved_at
            camera.show_state("good", self.tr("Saved {time}").format(time=f"{saved_at:%H:%M}"))
        elif now.kind == "file" and now.source is not None:
            name = Path(now.choice.path).name
            camera.show_state("good", self.tr("Recording {name}").format(name=shortened(name, MOST_NAME)))
        elif self._is_demo or (now.kind == "practice" and (now.source is not None or place in STEPS)):
            camera.show_state("good", self.tr("Simulated camera"))
        elif self._camera.there:
            camera.show_state("good", self.tr("Camera ready"))
        else:
            camera.show_state("bad", self.tr("No camera"))

    def show_again(self, percent: int, waiting: int) -> None:
        """How far a session is that is tracked again, -1 when none is, and how many new results wait for a decision;
        not while measuring."""
        self._again = (percent, waiting)
        button = self._shell.bar.again
        if self._way.place == "live":
            button.show_words("", "")
        elif percent >= 0:
            short = self.tr("{percent} %").format(percent=percent)
            button.show_words(
                self.tr("Tracking again {percent}").format(percent=short), short, self.tr("How far it is, and Stop")
            )
        elif waiting:
            one = self.tr("New result: choose") if waiting == 1 else self.tr("{count} new results: choose")
            button.show_words(one.format(count=waiting), self.tr("Choose"), self.tr("Old and new over each other"))
        else:
            button.show_words("", "")

    def show_recording(self, state: str, seconds: float) -> None:
        """The pill, the red line, and no way aside meanwhile."""
        self._shell.bar.pill.show_state(state, seconds)  # type: ignore[arg-type]
        self._shell.bar.show_recording(state == "recording")
        self._shell.bar.lock_aside(state != "off")

    def show_counters(self, counters: LiveCounters) -> None:
        """Pictures a second, what was lost, and for how long the disk has room."""
        least = 12 if self._now.kind == "practice" else 25  # 15 are drawn, as few as are enough
        few = counters.fps < least
        words = self.tr("{count} pictures/s, under {least}") if few else self.tr("{count} pictures/s")
        words = words.format(count=round(counters.fps), least=least)
        lost = counters.dropped + counters.missing
        if lost:
            words = self.tr("{words}, {lost} lost").format(words=words, lost=lost)
        if self._now.source is not None and self._now.source.rests():
            self._shell.bar.camera.show_state("warn", self.tr("Movement is being drawn"))
        else:
            self._shell.bar.camera.show_state("warn" if few else "good", words)
        minutes = counters.disk_minutes_left
        if minutes < 30.0 or (counters.recording and minutes == minutes):  # before, pictures are not in it
            state = "bad" if minutes < 10.0 else "warn" if minutes < 30.0 else "none"
            words = self.tr("{time} of disk left").format(time=numbers.room_left(minutes))
            self._shell.bar.disk.show_state(state, words, icon="hard-drive")  # type: ignore[arg-type]


CORE = (
    "carpus.core.pipeline.correction",
    "carpus.core.agreement.compared_files",
    "carpus.core.agreement.retest",
    "carpus.core.calibration.camera.calibrate",
    "carpus.core.calibration.card.measure",
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
        self.opener = Opener(parts.open_source, self.now, self.background, messages.fault, self)
        self.camera_state = CameraState(
            parts.cameras, self.background, lambda: datetime.now().astimezone(), self, is_demo=parts.is_demo
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
        bar.back_button.clicked.connect(way.back)
        bar.tab.connect(self.take_tab)
        bar.step.connect(lambda number: self._go_to_step(STEPS[number]))
        bar.help_button.clicked.connect(lambda: way.show("help"))
        bar.settings_button.clicked.connect(lambda: way.show("settings"))
        bar.again.clicked.connect(lambda: self.correct.open_sheet(self.now.session_id))
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
        return self.way.place

    # --- from one to the other ----------------------------------------------------------------------------
    def take_tab(self, number: int) -> None:
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
            ("live" in self.way.flows and self.live.patient_view.uncover())
            or self.takes_escape()
            or (self.place == "report" and self.report.screen.to_report())
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

"""Puts the screens and the flows together: patient, exercise, camera, markers, live, review, progress, report.

A screen whose flow lies in its folder knows its own way (:mod:`ui.flow`); of the others it is told here.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QWidget

from carpus import __version__
from carpus.app.desktop.bar import Bar
from carpus.app.desktop.calibrating import Calibrating
from carpus.app.desktop.camera_care import CameraCare
from carpus.app.desktop.camera_watch import CameraWatch
from carpus.app.desktop.care_cameras import CareCameras
from carpus.app.desktop.checking import Checking
from carpus.app.desktop.courses import CourseRun, KeptSets
from carpus.app.desktop.measuring_flow import MeasuringFlow
from carpus.app.desktop.opening import Opener
from carpus.app.desktop.patient_view import PatientViewing
from carpus.app.desktop.setting_up import SettingUp, SetUpScreens
from carpus.app.desktop.sources import Sources
from carpus.app.settings import Settings
from carpus.core.capture.calibrated import SERIAL
from carpus.core.errors import CarpusFault
from carpus.core.records.library import Library, Recovered
from carpus.core.records.set_up import SetUp
from carpus.ui.agreement.flow import AgreementFlow
from carpus.ui.background import Background
from carpus.ui.beside.flow import BesideFlow
from carpus.ui.by_hand.flow import ByHandFlow
from carpus.ui.camera_calibration.screen import BoardScreen
from carpus.ui.check_card.screen import CardScreen
from carpus.ui.check_card.standing_words import bar_words, card_words, session_words
from carpus.ui.clinic.flow import ClinicFlow
from carpus.ui.correct.flow import CorrectFlow
from carpus.ui.flow import STEPS, TABS, Flow, Navigator, ScreenContext
from carpus.ui.help.screen import HelpScreen
from carpus.ui.icons import State
from carpus.ui.keys import Keys
from carpus.ui.last_places import LastPlaces
from carpus.ui.live.screen import LiveScreen
from carpus.ui.markers.screen import MarkersScreen
from carpus.ui.messages.messages import Messages
from carpus.ui.messages.strip import put_off_last
from carpus.ui.now_open import NowOpen, OpenSource
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.ports import PatientRow, PatientStore
from carpus.ui.progress.flow import ProgressFlow
from carpus.ui.report.flow import ReportFlow
from carpus.ui.retest.flow import RetestFlow
from carpus.ui.review.flow import ReviewFlow
from carpus.ui.sessions.flow import SessionsFlow
from carpus.ui.setup.camera import CameraScreen
from carpus.ui.setup.choice import SourceChoice
from carpus.ui.setup.exercise import ExerciseScreen
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme

MEASURING = ("camera", "markers", "live")
"""Where an open camera or recording is measured with; behind the review it only waits for another set."""
ALL_KEYS = ("help", "settings", "search", "new_patient", "back", "quit")


@dataclass(frozen=True, slots=True)
class Parts:
    """What the journey needs besides the window."""

    library: Library
    patients: PatientStore
    sources: Sources
    settings: Settings
    is_demo: bool
    today: Callable[[], date]
    """The day now: the program may stand open for days."""
    cameras: CareCameras


def free_bytes(folder: Path) -> float:
    """Room on the disk of a folder; none where nobody can say."""
    try:
        return float(shutil.disk_usage(folder).free)
    except OSError:
        return 0.0


def _now() -> datetime:
    return datetime.now().astimezone()


class _Stop(Flow):
    """A screen whose flow lies elsewhere; each of these becomes a flow in the screen's folder."""

    def __init__(
        self,
        context: ScreenContext,
        place: str,
        screen: QWidget,
        guide: str = "session",
        *,
        show: Callable[..., None] | None = None,
        first: Callable[[], QWidget] | None = None,
        up: Callable[[], None] | None = None,
        leave: Callable[[], None] = lambda: None,
        while_aside: bool = False,
        title: str = "",
        sign: Callable[[], list[str]] = list,
    ) -> None:
        self.place, self.guide, self.while_aside = place, guide, while_aside
        self._show, self._first, self._up, self._leave, self._title, self._sign = show, first, up, leave, title, sign
        super().__init__(context, screen)

    def show(self, *given: Any) -> None:
        (self._show or super().show)(*given)

    def title(self) -> str:
        return self._title or super().title()

    def first(self) -> QWidget:
        return (self._first or super().first)()

    def up(self) -> None:
        (self._up or super().up)()

    def leave(self) -> None:
        self._leave()

    def sign_lines(self) -> list[str]:
        return self._sign()


class Journey(QObject):
    """Owns the screens and the flows."""

    def __init__(self, shell: Shell, theme: Theme, keys: Keys, parts: Parts) -> None:
        super().__init__(shell)
        self._shell, self._parts = shell, parts
        self.takes_escape: Callable[[], bool] = lambda: False
        """Asked first when Esc is pressed: True where that closed something, and the person stays where they are."""
        self.settings, self.is_demo = parts.settings, parts.is_demo
        self.now = NowOpen(choice=SourceChoice("practice" if parts.is_demo else "camera"))
        self.background = Background()
        self.opener = Opener(parts.sources)
        self.messages = messages = Messages(shell.stage, theme)
        self.way = Navigator(shell, lambda: messages.busy, lambda: self.live.recording_state != "off")
        self.context = ScreenContext(
            shell, theme, keys, parts.library, self.background, messages, self.way, self.now,
            LastPlaces(parts.library.store), parts.settings.report, parts.today, __version__, parts.is_demo,
        )  # fmt: skip
        self._make_screens(theme, keys)
        self._make_flows(theme)
        self._fill_table()
        self._connect(keys)
        self.watch.start()
        self.care.look()
        self.correct.look_for_waiting()

    def _make_screens(self, theme: Theme, keys: Keys) -> None:
        background = self.background
        self.patients = PatientsScreen(theme, self._parts.patients, self._parts.today)
        self.exercise = ExerciseScreen(theme)
        self.camera = CameraScreen(theme, is_demo=self.is_demo)
        self.markers = MarkersScreen(theme, keys, background)
        self.live = LiveScreen(theme, keys, background)
        self.board = BoardScreen(theme, keys)
        self.card = CardScreen(theme, keys)
        self.help = HelpScreen(theme, keys)

    def _make_flows(self, theme: Theme) -> None:
        now, tell, library, context = self.now, self.messages, self._parts.library, self.context
        places = context.places
        # In a demo the simulated camera is the camera: whether another is plugged in is nowhere looked for, or said.
        self.watch = CameraWatch(self, (lambda: "") if self.is_demo else self._parts.sources.camera_name)
        self.setting_up = SettingUp(
            self, SetUpScreens(self.exercise, self.camera, self.markers), self.way, tell, now, library,
            self._find_patient, self.opener, places, self.background,
            camera_there=lambda: self.watch.there, keep_pictures=self.settings.recording.keep_pictures,
            free_bytes=lambda: free_bytes(library.folder), is_demo=self.is_demo,
        )  # fmt: skip
        self.measuring = MeasuringFlow(self, self.live, self.way, tell, now)
        self.patient_view = PatientViewing(self._shell, self.live, theme, lambda: self.settings.patient.sound)
        self.kept_sets = KeptSets(self._shell.stage, self.exercise, tell, library, theme)
        self.course = CourseRun(self, self.live, self.patient_view, now)
        self.sessions = SessionsFlow(context)
        self.review = ReviewFlow(context)
        self.progress = ProgressFlow(context)
        self.report = ReportFlow(context)
        self.by_hand = ByHandFlow(context)
        self.agreement = AgreementFlow(context)
        self.beside = BesideFlow(context)
        self.retest = RetestFlow(context)
        self.clinic = ClinicFlow(context)
        cameras, is_demo = self._parts.cameras, self.is_demo
        self.care = CameraCare(self, cameras, self.background, _now)
        self.calibrating = Calibrating(
            self._shell, self.board, self.way, tell, cameras, places, self.background,
            camera_there=lambda: self.watch.there, is_demo=is_demo, now=_now,
        )  # fmt: skip
        self.checking = Checking(
            self._shell, self.card, self.way, tell, cameras, places, self.background, is_demo=is_demo, now=_now
        )
        self.correct = CorrectFlow(context)
        self.bar = Bar(
            self._shell, now, self.way, lambda: self.watch.there, self.review.screen,
            is_demo=is_demo, care=self._care_words,
        )  # fmt: skip

    def _fill_table(self) -> None:
        """The screens whose flow is not their own yet."""
        context, setting_up = self.context, self.setting_up
        _Stop(
            context, "patients", self.patients, first=lambda: self.patients.search, up=self._up_from_patients,
            show=self.show_patients,
        )  # fmt: skip
        _Stop(context, "exercise", self.exercise, "exercises")
        _Stop(context, "camera", self.camera, "camera", up=setting_up.up_from_camera)
        _Stop(
            context, "markers", self.markers, "calibration", first=lambda: self.markers.picture,
            up=setting_up.up_from_markers, leave=self.markers.end, while_aside=True, sign=self._measuring_lines,
        )  # fmt: skip
        _Stop(
            context, "live", self.live, "measuring", up=setting_up.up_to_camera, sign=self._measuring_lines
        )  # fmt: skip
        _Stop(
            context, "board", self.board, "cameracheck", up=self._up_from_board, leave=self.calibrating.leave,
            while_aside=True, title=self.tr("Camera calibration"),
            sign=lambda: self._simulated_camera(self.board.shows_simulated),
        )  # fmt: skip
        _Stop(
            context, "card", self.card, "cameracheck", up=self._up_from_card, leave=self.checking.leave,
            while_aside=True, title=self.tr("Check card"),
            sign=lambda: self._simulated_camera(self.card.checks.simulated),
        )  # fmt: skip
        _Stop(context, "help", self.help, first=lambda: self.help.text)

    def _connect(self, keys: Keys) -> None:
        shell, bar, way = self._shell, self._shell.bar, self.way
        shell.set_keys({name: keys[name] for name in ALL_KEYS})
        shell.key.connect(self._take_key)
        bar.back.connect(way.back)
        bar.tab.connect(self.take_tab)
        bar.step.connect(lambda number: self._go_to_step(STEPS[number]))
        bar.help.connect(self._open_guide)
        bar.settings.connect(lambda: way.show("settings"))
        # A lost camera leaves the tracking light to be seen from afar; elsewhere the top bar stays.
        way.leaving.connect(lambda to: self.messages.cover(self.live.stage if to == "live" else shell.stage))
        way.arrived.connect(lambda _: self.bar.show())
        self.help.done.connect(way.back)
        self.help.told.connect(self.messages.fault)
        self.watch.looked.connect(self._camera_looked_for)
        self.patients.start.connect(self.setting_up.start)
        self.patients.set_up.connect(self.setting_up.choose_exercise)
        self.patients.review.connect(lambda patient_id: way.show("review", "", patient_id))
        self.patients.progress.connect(self.progress.show)
        self.patients.sessions.connect(self.sessions.show)
        self.patients.clinic_wanted.connect(self.clinic.show)
        self.setting_up.ready.connect(self.measuring.begin)
        self.setting_up.closing.connect(self._source_closes)
        self.way.arrived.connect(self._meet_camera)
        for changed in (self.care.changed, self.board.turned, self.card.turned):
            changed.connect(self.bar.show)
        self.checking.calibrate.connect(self.show_board)
        self.checking.checked.connect(self.care.look)
        self.calibrating.kept.connect(self._calibration_kept)
        self.live.recording_changed.connect(self.bar.show_recording)
        self.live.counted.connect(self.bar.show_counters)
        self.measuring.begun.connect(self.patient_view.begin)
        self.measuring.begun.connect(self.course.begun)
        self.course.wanted.connect(self.measuring.begin)
        way.leaving.connect(lambda to: None if to == "live" else self.patient_view.leave())
        self.measuring.stored.connect(self._stored)
        self.measuring.patients_wanted.connect(self._to_patient)
        self.measuring.close_wanted.connect(shell.close_surely)
        shell.asks_before_closing = self.measuring.asks_before_closing
        self.beside.screen.arrived.connect(self.bar.show)
        self.retest.measure.connect(self.setting_up.start)
        self.review.screen.again.connect(self._another_set)
        self.review.screen.arrived.connect(self.bar.show)
        self.correct.changed.connect(self.bar.show_again)
        bar.again_wanted.connect(lambda: self.correct.open_sheet(self.now.session_id))
        self.sessions.screen.changed.connect(self.correct.look_for_waiting)

    # --- where one is -------------------------------------------------------------------------------------
    @property
    def place(self) -> str:
        """Where the person is."""
        return self.way.place

    @property
    def patient(self) -> PatientRow | None:
        """Who is open."""
        return self.now.patient

    @property
    def set_up(self) -> SetUp | None:
        """What was chosen before measuring."""
        return self.now.set_up

    @property
    def source(self) -> OpenSource | None:
        """What runs."""
        return self.now.source

    @property
    def session_id(self) -> str:
        """The session looked at."""
        return self.now.session_id

    def _find_patient(self, patient_id: str) -> PatientRow:
        row = self.now.patient
        return row if row is not None and row.patient_id == patient_id else self._parts.patients.card(patient_id).row

    # --- from flow to flow --------------------------------------------------------------------------------
    def show_patients(self, choose: str = "") -> None:
        """The first screen; whatever was open is closed."""
        self.setting_up.close_source()
        self._parts.library.cut_short()  # what a full disk kept from the list is taken into it
        self.now.patient = self.now.set_up = None
        self.now.session_id = ""
        self.patients.refresh(choose)
        self.way.go("patients")

    def _to_patient(self) -> None:
        self.show_patients(self.now.patient.patient_id if self.now.patient else "")

    def _up_from_patients(self) -> None:
        if not put_off_last(self.patients):
            self._to_patient()

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

    def _stored(self, session_id: str) -> None:
        self.bar.show_recording("off", 0.0)
        in_course = self.now.set_up is not None and self.now.set_up.course is not None
        if self.course.goes_on():
            self.bar.show()
            return
        self.patient_view.stored()
        if in_course and self.now.patient is not None:
            self.sessions.show(self.now.patient.patient_id)
        else:
            self.review.show(session_id)

    def show_retest(self) -> None:
        """The clinic's own test and retest; whatever was open is closed."""
        self.setting_up.close_source()
        self.now.patient = self.now.set_up = None
        self.now.session_id = ""
        self.retest.show()

    # --- the camera itself --------------------------------------------------------------------------------
    def show_board(self) -> None:
        """Calibrate the camera; whatever was open is closed."""
        self._close_for_camera()
        self.calibrating.show(card_words(self.care.standing)[1])

    def show_card(self) -> None:
        """Check the camera; whatever was open is closed."""
        self._close_for_camera()
        self.checking.show()

    def _close_for_camera(self) -> None:
        self.setting_up.close_source()
        self.now.patient = self.now.set_up = None
        self.now.session_id = ""

    def _calibration_kept(self, practice: bool) -> None:
        """The card shows at once whether it is right now."""
        self.care.look()
        self.checking.show(practice=practice)

    def _up_from_board(self) -> None:
        if self.board.is_beginning:
            self._to_patient()
        else:
            self.calibrating.back()

    def _up_from_card(self) -> None:
        if self.card.is_measuring:
            self.checking.back()
        else:
            self._to_patient()

    def _meet_camera(self, place: str) -> None:
        """A session begins with a camera: how far it is to be trusted is told, and keeps nobody from measuring."""
        if place == "markers" and self.now.kind == "camera" and self.now.source is not None:
            self.care.met(self.now.source.measuring.feed.info.settings.get(SERIAL, ""))

    def _care_words(self) -> tuple[State, str] | None:
        return bar_words(self.care.standing)

    def _simulated_camera(self, simulated: bool) -> list[str]:
        return [self.tr("Simulated camera: nothing here is of a real one.")] if simulated else []

    def _measuring_lines(self) -> list[str]:
        """What must not be forgotten of the camera that measures."""
        words = session_words(self.care.standing) if self.now.kind == "camera" else ""
        return [words] if words else []

    def _another_set(self) -> None:
        if self.now.source is not None:
            self.measuring.begin()
        elif self.now.patient is not None:
            self.setting_up.start(self.now.patient.patient_id)

    def _source_closes(self) -> None:
        self.live.end()
        self.course.end()
        self.bar.show_recording("off", 0.0)

    def review_recovered(self, found: Recovered) -> None:
        """Open a session that had been cut short."""
        self.review.show(found.session_id, found.patient_id)

    def review_file(self, path: Path) -> None:
        """Open a session file handed over from outside; not while something is measured or asked."""
        if self.messages.busy or self.live.recording_state != "off" or self.now.source is not None:
            return
        try:
            found = self._parts.library.look_at(path)
        except CarpusFault as fault:
            self.messages.fault(fault)
            return
        if not found.patient_id:  # of nobody here: shown under the name in its file
            self.now.patient = PatientRow("", found.subject_id, found.side)
        self.review.show(found.session_id, found.patient_id)

    def _go_to_step(self, place: str) -> None:
        if self.messages.busy:
            return
        if place == "exercise":
            self.setting_up.exercise_again()
        elif place == "camera":
            (self.setting_up.up_from_markers if self.place == "markers" else self.setting_up.up_to_camera)()

    def _take_key(self, name: str) -> None:
        actions: dict[str, Callable[[], object]] = {"back": self._escape, "help": self._open_guide}
        actions["settings"] = lambda: self.way.show("settings")
        actions["quit"] = self._shell.close
        if self.place == "patients":
            actions["search"] = lambda: self.patients.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
            actions["new_patient"] = self.patients.new_patient
        if name in actions:
            actions[name]()

    def _escape(self) -> None:
        taken = not self.messages.busy and (
            self.takes_escape() or (self.place == "report" and self.report.screen.to_report())
        )
        if not taken:
            self.way.back()

    def _camera_looked_for(self, there: bool, name: str) -> None:
        self.camera.set_camera_ready(there, name)
        self.patients.set_camera_ready(there)
        self.calibrating.set_camera_there(there)
        self.card.set_camera_there(there)
        self.bar.show_camera()

    def _open_guide(self) -> None:
        """The page of the screen one is on."""
        if self.way.may_aside():
            self.help.start_folder = self.context.places.folder("reports")
            self.help.show_page(self.way.here.guide)
            self.way.aside("help")

    @property
    def is_at_work(self) -> bool:
        """Whether something is measured, or worked on that would end with the window."""
        measures = self.now.source is not None and self.way.behind in MEASURING
        measures |= self.calibrating.hand.is_open or self.checking.hand.is_open
        return measures or self.correct.is_at_work or self.agreement.is_at_work or self.background.busy

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

    def show_research(self, *, on: bool) -> None:
        """Show what only research needs, or fold it away; no value changes by it."""
        self.live.show_research(on=on)
        for flow in self.way.flows.values():
            flow.show_research(on=on)

    def close(self) -> None:
        """The window closes: finish what runs, in order, and wait for it."""
        self.watch.stop()
        self.patient_view.close()
        self.markers.end()
        self.review.close()
        self.beside.close()
        self.correct.close()
        self.agreement.close()
        recording = self.measuring.let_go()
        self.opener.close()
        self.calibrating.hand.wait()
        self.checking.hand.wait()
        self.background.wait()
        self.measuring.finish(recording=recording)

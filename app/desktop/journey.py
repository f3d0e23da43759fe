"""Puts the screens and the flows together: patient, exercise, camera, markers, live, review, progress, report.

Each flow knows only its own screens and the narrow ports of :mod:`app.desktop.ways`; which leads to which is told here.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QWidget

from carpus.app.desktop.bar import Bar
from carpus.app.desktop.beside import Beside
from carpus.app.desktop.by_hand import ByHand
from carpus.app.desktop.calibrating import Calibrating
from carpus.app.desktop.camera_care import CameraCare
from carpus.app.desktop.camera_watch import CameraWatch
from carpus.app.desktop.care_cameras import CareCameras
from carpus.app.desktop.checking import Checking
from carpus.app.desktop.clinic import Clinic
from carpus.app.desktop.comparing import Comparing
from carpus.app.desktop.correcting import Correcting, Moments
from carpus.app.desktop.courses import CourseRun, KeptSets
from carpus.app.desktop.filming import Filming
from carpus.app.desktop.last_places import LastPlaces
from carpus.app.desktop.measuring_flow import MeasuringFlow
from carpus.app.desktop.navigation import Navigator, ScreenStop
from carpus.app.desktop.now_open import NowOpen
from carpus.app.desktop.opening import Opener
from carpus.app.desktop.patient_view import PatientViewing
from carpus.app.desktop.places import STEPS, TABS, Place
from carpus.app.desktop.printing import Printing
from carpus.app.desktop.report_forms import ReportForms
from carpus.app.desktop.retesting import Retesting
from carpus.app.desktop.setting_up import SettingUp, SetUpScreens
from carpus.app.desktop.shelf import StoredSessions
from carpus.app.desktop.sources import OpenSource, Sources
from carpus.app.desktop.teller import Teller
from carpus.app.desktop.viewing import Viewing, ViewScreens
from carpus.app.settings import Settings
from carpus.core.capture.calibrated import SERIAL
from carpus.core.errors import CarpusFault
from carpus.core.library.corrections import Corrections
from carpus.core.library.library import Library, Recovered
from carpus.core.library.set_up import SetUp
from carpus.ui.agreement.screen import AgreementScreen
from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.by_hand.screen import ByHandScreen
from carpus.ui.camera_calibration.screen import BoardScreen
from carpus.ui.check_card.screen import CardScreen
from carpus.ui.check_card.standing_words import bar_words, card_words, session_words, unsure_words
from carpus.ui.clinic.screen import ClinicScreen
from carpus.ui.correct.results_sheet import ResultsSheet
from carpus.ui.correct.screen import CorrectScreen
from carpus.ui.help.screen import HelpScreen
from carpus.ui.icons import State
from carpus.ui.keys import Keys
from carpus.ui.live.screen import LiveScreen
from carpus.ui.markers.screen import MarkersScreen
from carpus.ui.messages.strip import NoticeStrip
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.ports import PatientRow, PatientStore, Phrasebook
from carpus.ui.progress.screen import ProgressScreen
from carpus.ui.report.beside_page import BesideReport
from carpus.ui.report.screen import ReportScreen
from carpus.ui.retest.screen import RetestScreen
from carpus.ui.review.screen import ReviewScreen
from carpus.ui.sessions.screen import SessionsScreen
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
    phrasebook: Phrasebook
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


class Journey(QObject):
    """Owns the screens and the flows. ``settings_wanted`` asks for the settings screen,
    ``safety_wanted`` for what it has of back-up, lock and records."""

    settings_wanted = Signal()
    safety_wanted = Signal()

    def __init__(self, shell: Shell, theme: Theme, keys: Keys, parts: Parts) -> None:
        super().__init__(shell)
        self._shell, self._parts = shell, parts
        self.takes_escape: Callable[[], bool] = lambda: False
        """Asked first when Esc is pressed: True where that closed something, and the person stays where they are."""
        self.settings, self.is_demo = parts.settings, parts.is_demo
        self.now = NowOpen(choice=SourceChoice("practice" if parts.is_demo else "camera"))
        self.background = Background()
        self.opener = Opener(parts.sources)
        self._places = LastPlaces(parts.library.store)
        self.teller = Teller(shell.stage, theme, parts.phrasebook)
        self._make_screens(theme, keys)
        self._make_flows(theme)
        self._fill_table()
        self._connect(keys)
        self.watch.start()
        self.care.look()
        self.correcting.look_for_waiting()

    def _make_screens(self, theme: Theme, keys: Keys) -> None:
        background, library = self.background, self._parts.library
        self.patients = PatientsScreen(theme, self._parts.patients, self._parts.today)
        self.exercise = ExerciseScreen(theme)
        self.camera = CameraScreen(theme, is_demo=self.is_demo)
        self.markers = MarkersScreen(theme, keys, background, self._parts.phrasebook)
        self.live = LiveScreen(theme, keys, background)
        self.review = ReviewScreen(theme, keys, background, library)
        self.sessions = SessionsScreen(theme, background, StoredSessions(library), keys)
        self.progress = ProgressScreen(theme, keys, background, library)
        self.by_hand = ByHandScreen(theme, self._parts.today)
        self.report = ReportScreen(theme, keys, background)
        self.agreement = AgreementScreen(theme, keys)
        self._beside_background = Background()  # its own: what the list still reads holds up no picture
        self.beside_screen = BesideScreen(theme, keys, self._beside_background, library)
        self.retest = RetestScreen(theme, keys)
        self.clinic = ClinicScreen(theme, keys)
        self.board = BoardScreen(theme, keys)
        self.card = CardScreen(theme, keys)
        self._corrections = Corrections(library)
        self._corrections.clear_unfinished()
        self.correct = CorrectScreen(theme, keys, background, Moments(self._corrections))
        self.results_sheet = ResultsSheet(self._shell.stage, theme)
        self.help = HelpScreen(theme, keys)

    def _make_flows(self, theme: Theme) -> None:
        now, tell, library, places = self.now, self.teller, self._parts.library, self._places
        self.way = Navigator(self._shell, lambda: tell.busy, lambda: self.live.recording_state != "off")
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
        views = ViewScreens(self.sessions, self.review, self.progress)
        self.viewing = Viewing(self, views, self.way, tell, now, library, self._find_patient, places)
        self.forms = ReportForms(self, theme, library.store, tell.fault)
        self.printing = Printing(
            self._shell, self.report, self.way, tell, now, library, places, self.background,
            theme=theme, therapist=lambda: self.settings.report.therapist, forms=self.forms,
            today=self._parts.today,
        )  # fmt: skip
        self.filming = Filming(self._shell, tell, library, places, self.background, theme)
        self.entering_by_hand = ByHand(
            self, self.by_hand, self.way, tell, now, library, self.background,
            initials=lambda: self.settings.report.therapist, back=self._to_progress,
        )  # fmt: skip
        self.comparing = Comparing(
            self._shell, self.agreement, self.way, tell, now, library, places,
            theme=theme, limit_deg=lambda: self.settings.report.agreement_limit_deg,
        )  # fmt: skip
        self.beside = Beside(
            self._shell, self.beside_screen, self.way, tell, now, library, places, self.background,
            theme=theme, therapist=lambda: self.settings.report.therapist,
        )  # fmt: skip
        self.retesting = Retesting(
            self._shell, self.retest, self.way, tell, library, places, self.background, theme=theme,
            today=self._parts.today,
        )  # fmt: skip
        self.clinic_weeks = Clinic(
            self._shell, self.clinic, self.way, tell, library, places, self.background,
            after_days=lambda: self.settings.report.retest_days, today=self._parts.today,
        )  # fmt: skip
        cameras, is_demo = self._parts.cameras, self.is_demo
        self.care = CameraCare(self, cameras, self.background, _now)
        self.calibrating = Calibrating(
            self._shell, self.board, self.way, tell, cameras, places, self.background,
            camera_there=lambda: self.watch.there, is_demo=is_demo, now=_now,
        )  # fmt: skip
        self.checking = Checking(
            self._shell, self.card, self.way, tell, cameras, places, self.background, is_demo=is_demo, now=_now
        )
        self.correcting = Correcting(
            self, self.correct, self.results_sheet, self.way, tell, self._corrections,
            initials=lambda: self.settings.report.therapist,
        )  # fmt: skip
        self.bar = Bar(
            self._shell, now, lambda: self.way.place, lambda: self.watch.there, self.review, self._parts.phrasebook,
            is_demo=is_demo, care=self._care_words, sign_more=self._care_lines,
        )  # fmt: skip

    def _fill_table(self) -> None:
        """Every place: its screen, what has the keyboard first, where Back leads, what ends with it."""
        put, first, setting_up = self.way.put, self._first, self.setting_up
        up_from_patients = self._past_strips(self.patients, self._to_patient)
        put("patients", ScreenStop(self.patients, lambda: self.patients.search, up_from_patients))
        put("exercise", ScreenStop(self.exercise, self.exercise.first, self._to_patient))
        put("camera", ScreenStop(self.camera, self.camera.first, setting_up.up_from_camera))
        markers = ScreenStop(
            self.markers, lambda: self.markers.picture, setting_up.up_from_markers, self.markers.end, while_aside=True
        )
        put("markers", markers)
        put("live", ScreenStop(self.live, first(self.live), setting_up.up_to_camera))
        up_from_sessions = self._past_strips(self.sessions, self._to_patient)
        put("sessions", ScreenStop(self.sessions, self.sessions.first, up_from_sessions))
        put("review", ScreenStop(self.review, first(self.review), self._to_patient, self.review.end))
        put("progress", ScreenStop(self.progress, first(self.progress), self._up_from_progress))
        put("by_hand", ScreenStop(self.by_hand, self.by_hand.first, self.entering_by_hand.leave))
        put("report", ScreenStop(self.report, lambda: self.report.save_button, self._up_from_report))
        put("correct", ScreenStop(self.correct, first(self.correct), self._to_session, while_aside=True))
        put(
            "agreement",
            ScreenStop(self.agreement, self.agreement.first, self._to_session, self.comparing.leave, while_aside=True),
        )
        put(
            "beside",
            ScreenStop(self.beside_screen, first(self.beside_screen), self._up_from_beside, self.beside_screen.end),
        )
        put("retest", ScreenStop(self.retest, self.retest.first, self._to_patient))
        put("clinic", ScreenStop(self.clinic, self.clinic.first, self._to_patient))
        put(
            "board",
            ScreenStop(self.board, self.board.first, self._up_from_board, self.calibrating.leave, while_aside=True),
        )
        put("card", ScreenStop(self.card, self.card.first, self._up_from_card, self.checking.leave, while_aside=True))
        put("help", ScreenStop(self.help, lambda: self.help.text, self._to_patient))

    @staticmethod
    def _first(screen: QWidget) -> Callable[[], QWidget]:
        return lambda: screen

    def _connect(self, keys: Keys) -> None:
        shell, bar, way = self._shell, self._shell.bar, self.way
        shell.set_keys({name: keys[name] for name in ALL_KEYS})
        shell.key.connect(self._take_key)
        bar.back.connect(way.back)
        bar.tab.connect(self.viewing.take_tab)
        bar.step.connect(lambda number: self._go_to_step(STEPS[number]))
        bar.help.connect(self._open_guide)
        bar.settings.connect(self.settings_wanted)
        # A lost camera leaves the tracking light to be seen from afar; elsewhere the top bar stays.
        way.leaving.connect(lambda to: self.teller.cover(self.live.stage if to == "live" else shell.stage))
        way.arrived.connect(lambda _: self.bar.show())
        self.help.done.connect(way.back)
        self.help.told.connect(self.teller.fault)
        self.watch.looked.connect(self._camera_looked_for)
        self.patients.start.connect(self.setting_up.start)
        self.patients.set_up.connect(self.setting_up.choose_exercise)
        self.patients.review.connect(self.viewing.review_newest)
        self.patients.progress.connect(self.viewing.open_progress)
        self.patients.sessions.connect(self.viewing.open_sessions)
        self.patients.clinic_wanted.connect(self.clinic_weeks.show)
        self.clinic_weeks.opened.connect(self.show_patients)
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
        self.viewing.report_wanted.connect(self.printing.session)
        self.viewing.stayed.connect(self.bar.show)
        self.review.report.connect(self.printing.session)
        self.review.export.connect(self.printing.export)
        self.review.film.connect(self.filming.save)
        self.printing.formats.compare.connect(lambda: self.comparing.show(self.now.session_id))
        self.sessions.reference_wanted.connect(self._compare_listed)
        self.sessions.pair_wanted.connect(self.beside.show)
        self.review.beside.connect(self.beside.show)
        self.beside.report_wanted.connect(self.printing.pair)
        self.beside_screen.arrived.connect(self.bar.show)
        self.retesting.measure.connect(self.setting_up.start)
        self.review.again.connect(self._another_set)
        self.review.arrived.connect(self.bar.show)
        self.progress.report.connect(
            lambda figures: self.printing.course(
                figures, self.progress.followed.currentData(), self.progress.progress.by_hand
            )
        )
        self.review.correct.connect(self.correcting.show)
        self.review.result.connect(self.viewing.open_review)
        self.correct.done.connect(self.way.back)
        self.correcting.changed.connect(self.bar.show_again)
        bar.again_wanted.connect(lambda: self.correcting.open_sheet(self.now.session_id))
        self.correcting.used.connect(self._result_used)
        self.sessions.changed.connect(self.correcting.look_for_waiting)
        self.progress.table_wanted.connect(self.printing.table)
        self.progress.by_hand_wanted.connect(self.entering_by_hand.show)

    # --- where one is -------------------------------------------------------------------------------------
    @property
    def place(self) -> Place:
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

    @staticmethod
    def _past_strips(screen: QWidget, up: Callable[[], None]) -> Callable[[], None]:
        """Esc closes what is told above a list before it leaves the list."""

        def back() -> None:
            strips = [strip for strip in screen.findChildren(NoticeStrip) if strip.isVisible()]
            if strips:
                strips[-1].later.emit()
            else:
                up()

        return back

    def _to_session(self) -> None:
        if self.now.session_id:
            self.viewing.open_review(self.now.session_id)
        else:
            self._to_patient()

    def _up_from_beside(self) -> None:
        if self.beside.back_to == "review" or self.now.patient is None:
            self._to_session()
        else:
            self.viewing.open_sessions(self.now.patient.patient_id)

    def _up_from_report(self) -> None:
        if isinstance(self.report.shown, BesideReport):
            self.way.go("beside")
        else:
            self._to_session()

    def _up_from_progress(self) -> None:
        """Where one came from: the list of patients, or the session."""
        if self.way.came_from("progress") == "patients":
            self._to_patient()
        else:
            self._to_session()

    def _to_progress(self) -> None:
        if self.now.patient is not None:
            self.viewing.open_progress(self.now.patient.patient_id)
        else:
            self._to_patient()

    def _stored(self, session_id: str) -> None:
        self.bar.show_recording("off", 0.0)
        in_course = self.now.set_up is not None and self.now.set_up.course is not None
        if self.course.goes_on():
            self.bar.show()
            return
        self.patient_view.stored()
        if in_course and self.now.patient is not None:
            self.viewing.open_sessions(self.now.patient.patient_id)
        else:
            self.viewing.open_review(session_id)

    def show_retest(self) -> None:
        """The clinic's own test and retest; whatever was open is closed."""
        self.setting_up.close_source()
        self.now.patient = self.now.set_up = None
        self.now.session_id = ""
        self.retesting.show()

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

    def _care_lines(self) -> list[str]:
        """What must not be forgotten of the camera where one is."""
        simulated = self.board.shows_simulated if self.place == "board" else self.card.checks.simulated
        if self.place in ("board", "card"):
            return [self.tr("Simulated camera: nothing here is of a real one.")] if simulated else []
        if self.place in ("markers", "live") and self.now.kind == "camera":
            return [words] if (words := session_words(self.care.standing)) else []
        figures = self.review.figures
        if self.place == "review" and self.review.shown and figures is not None:
            return [words] if (words := unsure_words(figures.camera)) else []
        if self.place == "beside" and self.beside_screen.shown is not None and not self.now.is_practice:
            both = self.beside_screen.shown.both
            words = self.tr("Simulated hand: this is not a patient’s, and does not count.")
            return [words] if both.first.simulated or both.second.simulated else []
        return []

    def _compare_listed(self, session_id: str) -> None:
        self.now.session_id = session_id
        self.comparing.show(session_id)

    def _another_set(self) -> None:
        if self.now.source is not None:
            self.measuring.begin()
        elif self.now.patient is not None:
            self.setting_up.start(self.now.patient.patient_id)

    def _result_used(self, before: str, new: str) -> None:
        """A new result counts from now on; where the old one was on the screen the new one is shown."""
        if self.now.session_id == before and self.place in ("review", "correct"):
            self.viewing.open_review(new)

    def _source_closes(self) -> None:
        self.live.end()
        self.course.end()
        self.bar.show_recording("off", 0.0)

    def review_recovered(self, found: Recovered) -> None:
        """Open a session that had been cut short."""
        self.viewing.open_review_of(found.patient_id, found.session_id)

    def review_file(self, path: Path) -> None:
        """Open a session file handed over from outside; not while something is measured or asked."""
        if self.teller.busy or self.live.recording_state != "off" or self.now.source is not None:
            return
        try:
            found = self._parts.library.look_at(path)
        except CarpusFault as fault:
            self.teller.fault(fault)
            return
        if not found.patient_id:  # of nobody here: shown under the name in its file
            self.now.patient = PatientRow("", found.subject_id, found.side)
        self.viewing.open_review_of(found.patient_id, found.session_id)

    def _go_to_step(self, place: Place) -> None:
        if self.teller.busy:
            return
        if place == "exercise":
            self.setting_up.exercise_again()
        elif place == "camera":
            (self.setting_up.up_from_markers if self.place == "markers" else self.setting_up.up_to_camera)()

    def _take_key(self, name: str) -> None:
        actions: dict[str, Callable[[], object]] = {"back": self._escape, "help": self._open_guide}
        actions["settings"] = self.settings_wanted.emit
        actions["quit"] = self._shell.close
        if self.place == "patients":
            actions["search"] = lambda: self.patients.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
            actions["new_patient"] = self.patients.new_patient
        if name in actions:
            actions[name]()

    def _escape(self) -> None:
        taken = not self.teller.busy and (self.takes_escape() or (self.place == "report" and self.report.to_report()))
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
            self.help.start_folder = self._places.folder("reports")
            self.help.show_page_of(self.place)
            self.way.aside("help")

    @property
    def is_at_work(self) -> bool:
        """Whether something is measured, or worked on that would end with the window."""
        measures = self.now.source is not None and self.way.behind in MEASURING
        measures |= self.calibrating.hand.is_open or self.checking.hand.is_open
        return measures or self.correcting.is_at_work or self.comparing.is_at_work or self.background.busy

    def show_again_at(self, place: Place, before: NowOpen) -> None:
        """Where the person was before the window was put together again: the same patient and tab."""
        if place == "beside":
            place = "sessions"  # from where both can be ticked again
        if before.patient is None or not before.patient.patient_id or place not in TABS:
            return
        with suppress(CarpusFault):
            if place == "progress":
                self.viewing.open_progress(before.patient.patient_id)
                self.now.session_id = before.session_id
            elif place == "sessions" or not before.session_id:
                self.viewing.open_sessions(before.patient.patient_id)
            else:
                self.viewing.open_review_of(before.patient.patient_id, before.session_id)

    def show_research(self, *, on: bool) -> None:
        """Show what only research needs, or fold it away; no value changes by it."""
        for shown in (self.live, self.review.player, self.printing, self.sessions):
            shown.show_research(on=on)

    def put_settings(self, screen: QWidget) -> None:
        """The settings screen, which is made where settings are kept."""
        self.way.put("settings", ScreenStop(screen, self._first(screen), self._to_patient))

    def close(self) -> None:
        """The window closes: finish what runs, in order, and wait for it."""
        self.watch.stop()
        self.patient_view.close()
        self.markers.end()
        self.review.end()
        self.beside_screen.end()
        self.correcting.close()
        self.comparing.close()
        recording = self.measuring.let_go()
        self.opener.close()
        self.calibrating.hand.wait()
        self.checking.hand.wait()
        self._beside_background.wait()
        self.background.wait()
        self.measuring.finish(recording=recording)

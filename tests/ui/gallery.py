"""Every screen as a picture, with convincing data: ``python -m tests.ui.gallery FOLDER``."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import TypeVar

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QEvent, QLocale
from PySide6.QtWidgets import QApplication, QWidget

from carpus.core.agreement.reference import ReferenceOutline
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.errors import DiskFull
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.change import DEFAULT_LIMITS
from carpus.core.records.exercise_sets import USUAL_SETS
from carpus.core.results.figures import session_figures
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.results.report_form import Letterhead, ReportForm
from carpus.core.results.seen import joint_curves, session_curves
from carpus.core.session.values import Session
from carpus.core.types import Side
from carpus.core.words import Words
from carpus.ui.agreement.reference_sheet import ColumnsSheet, ReferenceSheet
from carpus.ui.agreement.screen import AgreementScreen
from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.by_hand.screen import ByHandScreen, HandRecord
from carpus.ui.camera_calibration.screen import BoardScreen
from carpus.ui.check_card.screen import CardScreen
from carpus.ui.check_card.words import CameraChecks
from carpus.ui.clinic.screen import ClinicScreen
from carpus.ui.controls.sheet import Sheet
from carpus.ui.correct.results_sheet import BothResults, ResultsSheet
from carpus.ui.correct.screen import CorrectScreen
from carpus.ui.fault_words import fault_words
from carpus.ui.fonts import load_fonts
from carpus.ui.help.screen import HelpScreen
from carpus.ui.keys import Keys
from carpus.ui.live.screen import LiveScreen
from carpus.ui.markers.screen import MarkersScreen
from carpus.ui.messages.messages import Answer, NoticeStrip, StopCard
from carpus.ui.patient.guide import GuideScene
from carpus.ui.patient.view import PatientView
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.ports import Preferences, ReferenceChoice
from carpus.ui.progress.screen import ProgressScreen
from carpus.ui.records.cards import BackupCard, BackupFacts, LockCard, RecordsCard
from carpus.ui.records.erasing import EraseSheet, ErasureFacts
from carpus.ui.records.lists import DeedLine, ListedRecord, LogSheet, RecordsSheet
from carpus.ui.records.locking import LockSheet, PinSheet
from carpus.ui.report.beside_page import BesideReport
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.pdf import progress_report, session_report
from carpus.ui.report.screen import ReportScreen
from carpus.ui.report.sheets import HomeSheet, LetterSheet
from carpus.ui.retest.flow import PeopleSheet
from carpus.ui.retest.screen import RetestScreen
from carpus.ui.review.screen import ReviewScreen
from carpus.ui.sessions.screen import SessionsScreen
from carpus.ui.settings.screen import SettingsScreen
from carpus.ui.setup.camera import CameraScreen
from carpus.ui.setup.exercise import ExerciseScreen
from carpus.ui.setup.set_sheet import SetSheet
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme, ThemeName
from carpus.ui.welcome.panel import Check, WelcomePanel
from tests.moments import with_moment
from tests.ui.camera_fakes import board_progress, board_result, camera_checks, card_progress
from tests.ui.fake_shelf import FakeShelf
from tests.ui.fakes import (
    NOW,
    FakeCalibrator,
    FakeCorrections,
    FakeFeed,
    FakeMeasuring,
    FakeSessions,
    FakeStore,
    LateFeed,
    clinic,
    compared,
    hand_values,
    hand_values_today,
    home_report,
    picture,
    restated_statements,
    retest_plan,
    session,
    set_up,
    with_other_spot,
)
from tests.ui.hand_fakes import FakeHandSessions, hand_session

SIZES = ((1280, 800), (1920, 1080))
STEPS = ("Exercise", "Camera", "Markers", "Measure")
TABS = ("Sessions", "Review", "Progress", "Report")
TODAY = date(2026, 11, 20)
TICK_FRAMES = 30
LOST = Words(
    "The camera sends no more pictures.",
    "Everything recorded so far is stored on this computer.",
    "Plug the camera in again; tracking and recording then go on by themselves.",
)
RECOVERED = Words(
    "A session of Heron 17 was cut short yesterday at 16:42. It has been recovered.",
    "All data up to 04:12 are safe; at most the last second is missing; more only where the figures came late."
    " The file is marked “recovered”.",
    "Review it now, or leave it for later: it stays in the patient’s list.",
)


ERASED_SESSION = ErasureFacts(
    "Linden 42", datetime(2026, 10, 9, 9, 51), "WRIST_FE", "right", 1, 4, 38.2, ("/home/clinic/Reports/L.pdf",), 8,
    datetime(2026, 11, 15, 18, 4), date(2036, 10, 9), 10, TODAY,
)  # fmt: skip
OLD_BACKUP = BackupFacts(
    "warn", "The last back-up is 5 days old. 7 sessions are not in it.",
    "15 Nov 2026, 18:04 · 49 sessions, 2.04 GB · read back and compared: all equal", "Reminder after 3 days.",
    "/media/clinic-disk/carpus-backup", "good", "412 GB free", True,
)  # fmt: skip
CHECKS = (
    Check("Camera", "warning", "none plugged in", "Plug the camera in, at best straight into the computer. It needs a "
          "USB 2 port; some USB 3 ports refuse cameras with old firmware."),
    Check("Camera driver", "bad", "libOpenNI2.so.0: cannot open shared object file: No such file or directory",
          "Needed for live cameras. Run: sudo apt-get install libopenni2-0"),
    Check("Camera rights", "good", "/lib/udev/rules.d/60-libopenni2-0.rules"),
    Check("Data folder", "good", "/home/clinic/.local/share/carpus, made at the first recording"),
    Check("Disk", "good", "212.4 GB free, about 1931 minutes with pictures"),
    Check("Fonts", "good", "6 faces"),
    Check("Screen", "good", "1920 × 1053 for windows"),
)  # fmt: skip
SheetT = TypeVar("SheetT", bound=Sheet)
ScreenT = TypeVar("ScreenT", bound=QWidget)
STATES = (
    "patients", "patients_empty", "patients_not_found", "patients_recovered", "patient_form", "exercise",
    "exercise_hand",
    "camera", "markers_clicking", "markers_ready", "markers_swapped", "markers_doubtful",
    "markers_start_angle", "markers_proposed", "markers_proposed_doubtful", "markers_proposed_incomplete",
    "markers_straight", "markers_other_spot", "sessions_list", "sessions_erase",
    "patient_erase",
    "live", "live_large", "live_catching_up",
    "live_speeds", "live_marker_hidden", "live_which_spot", "live_hand_lost", "live_hand",
    "live_hand_thumb_hidden", "live_hand_fist", "live_hand_not_found", "live_arm_moved",
    "live_disk_full", "live_note", "patient_view", "patient_view_goal", "patient_view_child",
    "patient_view_lost", "patient_view_rest", "exercise_sets", "exercise_goals",
    "live_pain", "live_camera_lost", "review", "review_hand", "review_passive",
    "review_passive_hand", "review_reason",
    "review_angle", "review_film",
    "review_path", "review_speeds", "review_zyz", "review_hand_finger",
    "review_reach", "review_opposition", "review_finger_ways",
    "correct", "correct_spots", "agreement", "agreement_curves", "agreement_goniometer", "agreement_hand",
    "agreement_running", "agreement_reference", "agreement_columns",
    "beside", "beside_dates", "beside_unfair", "beside_hand", "beside_reading", "report_beside",
    "retest", "retest_empty", "retest_people",
    "correct_exchanged", "correct_results", "correct_results_hand", "correct_running",
    "progress", "progress_by_hand", "progress_hand", "by_hand", "report", "report_hand",
    "report_progress", "report_own", "report_letter", "letter_sheet", "report_home",
    "home_sheet", "clinic",
    "settings", "settings_safe", "settings_research", "locked", "pin_change", "records_due", "records_log",
    "help",
    "patients_welcome", "patients_welcome_good", "patients_guided", "camera_guided",
    "markers_guided", "markers_ready_guided", "live_guided", "live_hand_guided", "review_guided",
    "report_guided", "board", "board_showing", "board_result", "board_poor", "card", "card_out", "card_none",
    "card_measuring",
)  # fmt: skip
"""Every state, by the method that shows it, in the order of the journey."""


class Gallery:
    """One window in one theme and size; each method sets one state up and returns what must be ended."""

    def __init__(self, application: QApplication, theme: ThemeName, size: tuple[int, int], scale: float = 1.0) -> None:
        self.application = application
        self.theme = Theme(theme, scale)
        self.shell = Shell(self.theme)
        self.background = Background()
        self.keys = Keys()
        self.sessions = FakeSessions()
        self.sessions.kept["session-7"] = RepetitionChoices({6: "pain"})
        self.over: list[Sheet] = []
        self.shell.resize(*size)
        self.shell.show()
        self.shell.activateWindow()
        self.settle()

    def settle(self) -> None:
        """Let everything finish that is under way."""
        for _ in range(3):
            self.application.processEvents()
            while self.background.busy:
                self.background.wait()
                self.application.processEvents()

    def place(self, steps: int = -1, tab: int = -1, where: str = "Right hand", camera: str = "Camera ready") -> None:
        bar = self.shell.bar
        bar.show()
        bar.show_place("Linden 42" if steps >= 0 or tab >= 0 or where else "", where)
        if steps >= 0:
            bar.show_steps(STEPS, steps)
        elif tab >= 0:
            bar.show_tabs(TABS, tab)
        else:
            bar.show_nothing()
        bar.camera.show_state("good" if camera else "none", camera)
        bar.disk.show_state("none", "")
        bar.pill.show_state("off", 0)
        bar.show_recording(False)

    def show(self, screen: QWidget, first: QWidget | None = None) -> None:
        while self.over:
            sheet = self.over.pop()
            sheet.close_sheet()
            sheet.deleteLater()
        self.shell.show_screen(screen, first)
        stage = self.shell.stage
        for old in [stage.widget(number) for number in range(stage.count())]:
            if old is not screen:  # every change of style would go through all that were ever shown
                stage.removeWidget(old)
                old.deleteLater()
        self.application.sendPostedEvents(None, QEvent.Type.DeferredDelete)  # outside a running loop nobody does
        self.settle()

    def patients(self) -> PatientsScreen:
        self.place(where="")
        screen = PatientsScreen(self.theme, FakeStore(), lambda: TODAY)
        screen.set_camera_ready(True)
        screen.refresh("linden")
        self.show(screen, screen.search)
        return screen

    def patients_empty(self) -> None:
        self.place(where="")
        screen = PatientsScreen(self.theme, FakeStore([]), lambda: TODAY)
        screen.refresh()
        self.show(screen, screen.search)

    def patients_welcome(self) -> None:
        self._welcome(CHECKS)

    def patients_welcome_good(self) -> None:
        self._welcome([replace(check, state="good", remedy="") for check in CHECKS], counts_later=True)

    def _welcome(self, checks: Sequence[Check], *, counts_later: bool = False) -> None:
        self.place(where="", camera="")
        screen = PatientsScreen(self.theme, FakeStore([]), lambda: TODAY)
        panel = WelcomePanel(self.theme)
        panel.show_folder("/home/clinic/.local/share/carpus", counts_later=counts_later)
        panel.show_checks(checks)
        screen.show_welcome(panel)
        self.show(screen, screen.search)

    def patients_guided(self) -> None:
        self.patients().card.bubble.show_bubble("patient")
        self.settle()

    def camera_guided(self) -> None:
        self.camera()
        self._guided(CameraScreen).bubble.show_bubble("camera")
        self.settle()

    def markers_guided(self) -> None:
        self.markers_clicking()
        self._guided(MarkersScreen).bubble.show_bubble("click")
        self.settle()

    def markers_ready_guided(self) -> None:
        self.markers_ready()
        self._guided(MarkersScreen).bubble.show_bubble("check")
        self.settle()

    def live_guided(self) -> None:
        self.live()
        self._guided(LiveScreen).bubble.show_bubble("stop")
        self.settle()

    def live_hand_guided(self) -> None:
        self.live_hand()
        self._guided(LiveScreen).bubble.show_bubble("stop")
        self.settle()

    def review_guided(self) -> None:
        self.review()
        self._guided(ReviewScreen).bubble.show_bubble("results")
        self.settle()

    def report_guided(self) -> None:
        self.report()
        self._guided(ReportScreen).bubble.show_bubble("end")
        self.settle()

    def _guided(self, kind: type[ScreenT]) -> ScreenT:
        screen = self.shell.stage.currentWidget()
        assert isinstance(screen, kind)
        return screen

    def patients_not_found(self) -> None:
        screen = self.patients()
        screen.search.setText("Fir 12")
        self.settle()

    def patients_recovered(self) -> None:
        screen = self.patients()
        screen.notice_place.addWidget(NoticeStrip(self.theme, RECOVERED, "Re&view it"))
        self.settle()

    def patient_form(self) -> None:
        self.patients().new_patient()
        self.settle()

    def exercise(self) -> None:
        self.place(steps=0)
        screen = ExerciseScreen(self.theme)
        screen.show_sets(USUAL_SETS)
        screen.begin(FakeStore().rows[5], set_up(), "right", True, 110.0, 720.0)
        self.show(screen, screen.first())

    def exercise_hand(self) -> None:
        self.place(steps=0)
        screen = ExerciseScreen(self.theme)
        screen.begin(FakeStore().rows[5], set_up("FIST_COMPOSITE", 90.0), "left", False)
        self.show(screen, screen.first())

    def camera(self) -> None:
        self.place(steps=1)
        screen = CameraScreen(self.theme)
        screen.set_camera_ready(True)
        screen.begin(set_up(), "camera")
        self.show(screen, screen.first())

    def _markers(self, clicks: int, *findings: CalibrationFinding) -> tuple[MarkersScreen, FakeCalibrator]:
        self.place(steps=2)
        screen = MarkersScreen(self.theme, self.keys, self.background)
        calibrator = FakeCalibrator()
        calibrator.findings = findings
        self.show(screen, screen.picture)
        screen.begin(calibrator, picture(), "13 Nov")
        self.settle()
        for pixel in calibrator.disc_px[:clicks]:
            screen.picture.clicked.emit(pixel + 1.0)
        self.settle()
        return screen, calibrator

    def markers_clicking(self) -> None:
        screen, calibrator = self._markers(4)
        screen.picture.set_cursor(calibrator.disc_px[4] + 2.0)
        self.settle()

    def markers_ready(self) -> None:
        self._markers(6)

    def markers_swapped(self) -> None:
        self._markers(6, CalibrationFinding("swapped", ("MCP2", "MCP3")))

    def markers_doubtful(self) -> None:
        self._markers(6, CalibrationFinding("tilt", (), 19.0, 15.0, "deg"))

    def _proposed(self, doubtful: tuple[str, ...] = (), not_found: tuple[str, ...] = ()) -> MarkersScreen:
        self.place(steps=2)
        screen = MarkersScreen(self.theme, self.keys, self.background)
        calibrator = FakeCalibrator("fist", protocol="hand21")
        calibrator.doubtful, calibrator.not_found = doubtful, not_found
        self.show(screen, screen.picture)
        screen.begin(calibrator, None, "")
        self.settle()
        return screen

    def markers_proposed(self) -> None:
        self._proposed()

    def markers_proposed_doubtful(self) -> None:
        self._proposed(doubtful=("DIP4", "TIP4"))

    def markers_proposed_incomplete(self) -> None:
        self._proposed(not_found=("TIP1",))

    def markers_start_angle(self) -> None:
        screen, _ = self._markers(2)
        screen.angle_sheet.begin(np.radians([0.0, 10.0, 0.0]))
        self.settle()

    @contextmanager
    def _live(
        self, feed: FakeFeed, seconds: float = 25.0, target_deg: float = 60.0, exercise: str = "WRIST_FE"
    ) -> Iterator[LiveScreen]:
        self.place(where="Right hand · Wrist flexion–extension", camera="30 pictures/s")
        screen = LiveScreen(self.theme, self.keys, self.background)
        self.show(screen)
        screen.begin(FakeMeasuring(feed), set_up(exercise, target_deg=target_deg))
        screen._timer.stop()
        feed.picture_number = 0
        feed.step(2)
        screen.tick()
        screen.recording.toggle()
        self.settle()
        left = round(30 * seconds) - 1
        while left > 0:  # some at a time, as a busy window looks
            feed.step(min(left, TICK_FRAMES))
            left -= TICK_FRAMES
            screen.tick()
        feed.picture_number = None
        feed.step()
        for _ in range(2 * 20):
            screen.tick()
        bar = self.shell.bar
        bar.disk.show_state("none", "212 min of disk left", icon="hard-drive")
        bar.pill.show_state("recording", 84.0)
        bar.show_recording(True)
        self.settle()
        yield screen

    def live(self) -> None:
        with self._live(FakeFeed(seconds=32.0, hidden=[(16.0, 16.9, "CMC1")])):
            pass

    def patient_view(self) -> None:
        self._patient_view("WRIST_FE", GuideScene("out", 1, 42.0, 60.0, done=5, asked=10))

    def patient_view_goal(self) -> None:
        self._patient_view("FIST_COMPOSITE", GuideScene("there", 1, 81.0, 80.0, done=5, asked=10), side="left")

    def patient_view_child(self) -> None:
        self._patient_view("WRIST_RU", GuideScene("out", 1, 14.0, 20.0, done=5, asked=10), for_child=True)

    def patient_view_lost(self) -> None:
        self._patient_view("FOREARM_PS", GuideScene("lost", 1, goal_deg=70.0, done=5, asked=10))

    def patient_view_rest(self) -> None:
        self._patient_view("WRIST_RU", GuideScene("rest", done=1, asked=3, rest_share=0.5, rest_s=30))

    def exercise_goals(self) -> None:
        self.exercise()
        screen = self.shell.stage.currentWidget()
        assert isinstance(screen, ExerciseScreen)
        screen.show_history("linden", self.sessions.history("linden"))
        self.settle()

    def exercise_sets(self) -> None:
        self.exercise()
        self._over(SetSheet(self.shell.stage, self.theme)).begin(USUAL_SETS, "wrist6")
        self.settle()

    def _patient_view(self, exercise: str, scene: GuideScene, side: Side = "right", *, for_child: bool = False) -> None:
        self.shell.bar.hide()
        view = PatientView(self.theme)
        self.show(view)
        view.begin(replace(set_up(exercise), side=side, for_child=for_child))
        view.show_scene(scene)
        self.settle()

    def live_large(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            screen.toggle_large()
            self.settle()

    def live_catching_up(self) -> None:
        """Stopped on a busy computer: the newest picture by itself, and how long it takes until all is tracked."""
        feed = LateFeed(seconds=32.0)
        with self._live(feed) as screen:
            feed.ahead_s, feed.waiting = 21.0, 1200
            screen.recording.under_way = True
            screen._show_values()
            feed.waiting = 500
            screen.tick()
            screen._show_values()
            self.settle()

    def live_speeds(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            screen.toggle_speeds()
            self.settle()

    def live_marker_hidden(self) -> None:
        with self._live(FakeFeed(seconds=32.0, hidden=[(23.0, 30.0, "CMC1")])):
            pass

    def live_which_spot(self) -> None:
        """On the whole hand, where the picture has least room for it."""
        feed = FakeFeed("fist", 32.0, protocol="hand21")
        with_other_spot(feed, 9, 23.0, taken=True, off_px=(6.0, 20.0))
        with self._live(feed, exercise="FIST_COMPOSITE", target_deg=90.0):
            self.shell.bar.show_place("Linden 42", "Right hand · Full fist")

    def live_hand_lost(self) -> None:
        with self._live(FakeFeed(seconds=32.0, lost=[(23.5, 30.0)])):
            pass

    def live_arm_moved(self) -> None:
        feed = FakeFeed(seconds=32.0)
        for number, frame in enumerate(feed.frames):
            if number > 30 * 23.5:
                feed.frames[number] = with_moment(frame, position_m=frame.moment.position_m + [0.0, 0.021, 0.004])
        with self._live(feed):
            pass

    def live_disk_full(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            self.shell.bar.disk.show_state("bad", "Disk full")
            self.shell.bar.pill.show_state("off", 0.0)
            self.shell.bar.show_recording(False)
            screen.recording.measuring.feed.recording = False  # type: ignore[union-attr, misc]
            screen.controls.refresh()
            card = StopCard(screen.stage, self.theme)
            words = fault_words(DiskFull("session.h5", "no space left"))
            answers = [Answer("To the patients", lambda: None, "P"), Answer("Go on measuring", lambda: None, "Space")]
            card.show_words(words, answers, icon="hard-drive")
            self.settle()

    def live_note(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            screen.note_sheet.begin()
            self.settle()

    def live_pain(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            screen.pain_sheet.begin()
            self.settle()

    def _hand(
        self,
        hidden: Sequence[tuple[float, float, str]] = (),
        lost: Sequence[tuple[float, float]] = (),
        seconds: float = 25.0,
    ) -> None:
        feed = FakeFeed("fist", 32.0, hidden, lost, protocol="hand21")
        with self._live(feed, seconds, exercise="FIST_COMPOSITE", target_deg=90.0) as screen:
            self.shell.bar.show_place("Linden 42", "Right hand · Full fist")
            screen.on_picture.toggle_side()
            self.settle()

    def live_hand(self) -> None:
        self._hand()

    def live_hand_thumb_hidden(self) -> None:
        self._hand([(22.5, 30.0, name) for name in ("MCP1", "IP1", "TIP1")])

    def live_hand_fist(self) -> None:
        ends = [f"{joint}{k}" for k in (2, 3, 4, 5) for joint in ("DIP", "TIP")]
        self._hand([(start, start + 2.6, name) for name in [*ends, "TIP1"] for start in (15.1, 21.1)], seconds=22.3)

    def live_hand_not_found(self) -> None:
        self._hand(lost=[(23.5, 30.0)])

    def live_camera_lost(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            screen.set_camera_lost(True)
            for _ in range(30):
                screen.tick()
            bar = self.shell.bar
            bar.camera.show_state("bad", "No camera")
            bar.pill.show_state("paused", 84.0)
            bar.show_recording(False)
            card = StopCard(screen.stage, self.theme)
            answers = [
                Answer("Check camera", lambda: None, "C"),
                Answer("Stop and review", screen.recording.stop, "Space"),
            ]
            card.show_words(
                LOST, answers, icon="unplug", detail="Recording paused by itself at 01:24.",
                safe_detail="All 1 min 24 s and 3 full repetitions.",
            )  # fmt: skip
            card.set_waiting("Waiting for the camera … 7 s")
            self.settle()

    def review(self) -> None:
        self.place(tab=1, camera="Saved 11:37")
        screen = ReviewScreen(self.theme, self.keys, self.background, self.sessions)
        self.show(screen)
        screen.begin("linden", "session-7", may_repeat=True)
        self.settle()
        screen.playing.seek(20.6)
        self.settle()
        screen.playing.stop()

    def review_hand(self, finger: int = 0) -> None:
        self.place(tab=1, camera="Saved 11:37")
        screen = ReviewScreen(self.theme, self.keys, self.background, FakeHandSessions())
        self.show(screen)
        screen.begin("linden", "hand-7", may_repeat=True)
        self.settle()
        screen.charts.finger.buttons()[finger].click()
        screen.playing.seek(12.0)
        self.settle()
        screen.playing.stop()

    def review_passive(self) -> None:
        """Three of nine repetitions were passive, and the goniometer was at hand."""
        kept, hand_values = self.sessions.kept, self.sessions.hand_values
        self.sessions.kept = {"session-7": RepetitionChoices({6: PASSIVE, 7: PASSIVE, 8: PASSIVE})}
        self.sessions.hand_values = hand_values_today()
        self.review()
        self.sessions.kept, self.sessions.hand_values = kept, hand_values

    def review_passive_hand(self) -> None:
        self.place(tab=1, camera="Saved 11:37")
        store = FakeHandSessions()
        store.kept = {"hand-7": RepetitionChoices(dict.fromkeys((3, 4, 5), PASSIVE))}
        store.hand_values = hand_values_today()
        screen = ReviewScreen(self.theme, self.keys, self.background, store)
        self.show(screen)
        screen.begin("linden", "hand-7")
        self.settle()
        screen.playing.stop()

    def review_angle(self) -> None:
        """The angle drawn on the picture."""
        self.review()
        self._guided(ReviewScreen).picture.angle_button.click()
        self.settle()

    def review_film(self) -> None:
        self.review()
        screen = self._guided(ReviewScreen)
        screen.film_sheet.begin(4)
        screen.film_sheet.agreed.click()
        self.settle()

    def review_reason(self) -> None:
        self.review()
        screen = self._guided(ReviewScreen)
        screen.reason.begin(4)
        self.settle()

    def review_hand_finger(self) -> None:
        self.review_hand(4)

    def _review_view(self, view: str) -> None:
        self.place(tab=1, camera="Saved 11:37")
        screen = ReviewScreen(self.theme, self.keys, self.background, self.sessions)
        self.show(screen)
        screen.begin("linden", "session-7", may_repeat=True)
        self.settle()
        screen.player.view.setCurrentIndex(screen.player.view.findData(view))
        screen.playing.seek(20.6)
        self.settle()
        screen.playing.stop()

    def review_path(self) -> None:
        self._review_view("path")

    def review_speeds(self) -> None:
        self._review_view("place")

    def review_zyz(self) -> None:
        self._review_view("zyz")

    def _review_exercise(self, exercise: str, motion: str, view: str, finger: int) -> None:
        self.place(tab=1, camera="Saved 11:37")
        store = FakeHandSessions()
        store.sessions = {
            f"hand-{number}": hand_session(
                NOW - timedelta(days=days), share, exercise, f"hand-{number}", motion,
                hidden=[(8.0, 9.0, name) for name in ("IP1", "TIP1")],
            )
            for number, days, share in ((6, 7, 0.9), (7, 0, 1.0))
        }  # fmt: skip
        screen = ReviewScreen(self.theme, self.keys, self.background, store)
        self.show(screen)
        screen.begin("linden", "hand-7", may_repeat=True)
        self.settle()
        screen.charts.finger.buttons()[finger].click()
        screen.player.view.setCurrentIndex(screen.player.view.findData(view))
        screen.playing.seek(9.5)
        self.settle()
        screen.playing.stop()

    def review_reach(self) -> None:
        self._review_exercise("REACH_GRASP", "reach_grasp", "path", 6)

    def review_opposition(self) -> None:
        self._review_exercise("THUMB_OPP", "opposition", "path", 0)

    def review_finger_ways(self) -> None:
        self._review_exercise("THUMB_OPP", "opposition", "path", 1)

    def _correct(self, *, pictures: bool = True, wrong_px: tuple[float, float] | None = None) -> CorrectScreen:
        """With ``wrong_px``, where the middle knuckle was taken to be."""
        self.place(tab=1, camera="Saved 11:37")
        store = FakeCorrections(self.sessions, pictures=pictures)
        screen = CorrectScreen(self.theme, self.keys, self.background, store)
        self.show(screen)
        session = self.sessions.session("session-7")
        if wrong_px is not None:
            measured = session.markers.measured_px.copy()
            measured[620, 3] = wrong_px
            session = replace(session, markers=replace(session.markers, measured_px=measured))
        screen.begin("session-7", session, 620)
        self.settle()
        return screen

    def correct(self) -> None:
        """A name that stood where there is no disc has been put on its own."""
        right_px = self.sessions.session("session-7").markers.measured_px[620, 3]
        screen = self._correct(wrong_px=(right_px[0] - 10.0, right_px[1] + 36.0))
        screen.put("MCP3", right_px)
        self.settle()

    def correct_spots(self) -> None:
        self._correct(pictures=False)

    def correct_exchanged(self) -> None:
        screen = self._correct()
        assert screen.places is not None
        screen.put("MCP3", screen.places.before(620)[4])
        self.settle()

    def _results(self, sessions: tuple[Session, Session]) -> ResultsSheet:
        self.place(tab=1, camera="Saved 11:37")
        self.shell.bar.again.show_words("New result: choose", "Choose")
        sheet = self._over(ResultsSheet(self.shell.stage, self.theme))
        old, new = sessions
        both = BothResults(
            session_figures(new), session_curves(old), session_curves(new), joint_curves(old), joint_curves(new)
        )
        words = "212 of 1240 pictures differ by more than 2°, most at 00:39.2: 17°."
        sheet.show_both("Linden 42 · 20 Nov 2026, 11:37 · Wrist flexion–extension, right hand", words, both)
        sheet.begin()
        sheet.curves.set_time(12.0)
        self.settle()
        return sheet

    def correct_results(self) -> None:
        self.review()
        new = self.sessions.session("session-7")
        shift = np.where(new.timestamp_s - new.timestamp_s[0] > 20.0, 0.3, 0.0)[:, None]
        motion = replace(new.motion, angles_rad=new.motion.angles_rad - shift)
        self._results((replace(new, motion=motion), new))

    def correct_results_hand(self) -> None:
        self.review_hand()
        self._results((hand_session(share=0.8), hand_session()))

    def correct_running(self) -> None:
        self.correct()
        self.shell.bar.again.show_words("Tracking again 63 %", "63 %")
        sheet = self._over(ResultsSheet(self.shell.stage, self.theme))
        sheet.show_running("Linden 42 · 20 Nov 2026, 11:37 · Wrist flexion–extension, right hand", 63)
        sheet.begin()
        self.settle()

    def progress(self) -> None:
        self.place(tab=2, camera="")
        screen = ProgressScreen(self.theme, self.keys, self.background, self.sessions)
        self.show(screen)
        screen.begin("linden", "session-7")
        self.settle()

    def progress_by_hand(self) -> None:
        self.place(tab=2, camera="")
        store = FakeSessions()
        store.hand_values = hand_values()
        screen = ProgressScreen(self.theme, self.keys, self.background, store)
        self.show(screen)
        screen.begin("linden", "session-7")
        self.settle()

    def by_hand(self) -> None:
        self.place(tab=2, camera="")
        screen = ByHandScreen(self.theme, lambda: date(2026, 11, 20))
        self.show(screen)
        figures = sorted(self.sessions.history("linden"), key=lambda one: one.when)
        screen.show_record(HandRecord("Linden 42", "right", tuple(hand_values()), tuple(figures), "MK"))
        self.settle()

    def progress_hand(self) -> None:
        self.place(tab=2, camera="")
        screen = ProgressScreen(self.theme, self.keys, self.background, FakeHandSessions())
        self.show(screen)
        screen.begin("linden", "hand-7")
        self.settle()

    def report_hand(self) -> None:
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        store = FakeHandSessions()
        screen.begin(session_report(store.session("hand-7"), history=store.history("linden")), "")
        self.settle()

    def report(self) -> None:
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        stored = self.sessions.session("session-7")
        choices = self.sessions.choices("session-7")
        screen.begin(session_report(stored, choices=choices, history=self.sessions.history("linden")), "")
        self.settle()

    def report_own(self) -> None:
        """The clinic's letterhead on US Letter, a comment, a part left out."""
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        head = Letterhead("Hand clinic at the river", ("12 Riverside Road", "Springfield"))
        form = ReportForm(head, "letter", frozenset({"bars"}))
        stored, history = self.sessions.session("session-7"), self.sessions.history("linden")
        screen.begin(session_report(stored, history=history, form=form, comment="Splint at night.\nCome back."), "")
        self.settle()

    def report_letter(self) -> None:
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        made = session_report(self.sessions.session("session-7"), history=self.sessions.history("linden"))
        screen.begin(LetterReport(made, "Dr Anna Doctor\nVienna", TODAY, "Maria Muster"), "")
        self.settle()

    def clinic(self) -> None:
        self.place(where="")
        screen = ClinicScreen(self.theme, self.keys)
        self.show(screen)
        screen.show_week(clinic())
        self.settle()

    def report_home(self) -> None:
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        screen.begin(home_report(), "")
        self.settle()

    def home_sheet(self) -> None:
        self.report_own()
        sheet = self._over(HomeSheet(self.shell.stage, self.theme))
        sheet.begin(session_report(self.sessions.session("session-7")), TODAY)
        self.settle()

    def letter_sheet(self) -> None:
        self.report_own()
        sheet = self._over(LetterSheet(self.shell.stage, self.theme))
        sheet.begin(["Dr Anna Doctor\nVienna"], has_name=True)
        sheet.names.setChecked(True)
        self.settle()

    def report_progress(self) -> None:
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        screen.begin(progress_report(self.sessions.history("linden")), "")
        self.settle()

    def sessions_list(self) -> SessionsScreen:
        self.place(tab=0)
        screen = SessionsScreen(self.theme, self.background, FakeShelf())
        screen._shelf._change("s2", set_aside="discs lost")  # type: ignore[attr-defined]
        self.show(screen)
        screen.begin("linden", "Linden 42", "s1")
        self.settle()
        return screen

    def _over(self, sheet: SheetT) -> SheetT:
        """A sheet over the whole stage, taken away with the next screen."""
        self.over.append(sheet)
        return sheet

    def sessions_erase(self) -> None:
        self.sessions_list()
        self._over(EraseSheet(self.shell.stage, self.theme)).begin(ERASED_SESSION)
        self.settle()

    def patient_erase(self) -> None:
        self.patients()
        patient = replace(
            ERASED_SESSION, when=None, sessions=9, files=31, size_mb=412.0, others=0,
            made=("/home/clinic/Reports/L.pdf", "/home/clinic/Reports/L.csv"),
            last_backup=None, kept_until=date(2026, 10, 9),
        )  # fmt: skip
        self._over(EraseSheet(self.shell.stage, self.theme)).begin(patient)
        self.settle()

    def markers_straight(self) -> None:
        screen = self._proposed()
        screen.naming.take_all()
        self.settle()
        screen.guidance.straight.buttons[3].click()
        self.settle()

    def markers_other_spot(self) -> None:
        spot = tuple(map(float, FakeCalibrator().disc_px[3] + [14.0, 24.0]))
        self._markers(6, CalibrationFinding("other_spot", ("MCP3",), spot_px=spot))

    def agreement(self, *, readings: bool = False, hand: bool = False, limit_deg: float = 5.0) -> AgreementScreen:
        self.place(tab=1, camera="")
        screen = AgreementScreen(self.theme, self.keys)
        self.show(screen)
        name = "goniometer.csv" if readings else "Linden42_20Nov.c3d"
        screen.show_compared(compared(readings=readings, hand=hand), name, limit_deg, may_map=not readings)
        self.settle()
        return screen

    def agreement_curves(self) -> None:
        self.agreement(limit_deg=0.0).next_view()
        self.settle()

    def agreement_goniometer(self) -> None:
        self.agreement(readings=True)

    def agreement_hand(self) -> None:
        self.agreement(hand=True)

    def agreement_running(self) -> None:
        self.place(tab=1, camera="")
        screen = AgreementScreen(self.theme, self.keys)
        self.show(screen)
        screen.running("Linden42_20Nov.c3d")
        screen.bar.show_progress(40, 100)
        self.settle()

    def agreement_reference(self) -> None:
        self.place(tab=1, camera="")
        screen = AgreementScreen(self.theme, self.keys)
        self.show(screen)
        sheet = self._over(ReferenceSheet(self.shell.stage, self.theme))
        sheet.begin([("s2", "20 Nov 2026, 11:36 · Wrist flexion–extension · same recording")])
        self.settle()

    def agreement_columns(self) -> None:
        self.place(tab=1, camera="")
        self.show(AgreementScreen(self.theme, self.keys))
        outline = ReferenceOutline(Path("optical.csv"), "angles", ("Zeit", "FlexExt", "RadUln"), {})
        sheet = self._over(ColumnsSheet(self.shell.stage, self.theme))
        sheet.begin(outline, ("time", *WRIST_ANGLES), ReferenceChoice("optical.csv", "optical.csv"))
        self.settle()

    def retest(self) -> RetestScreen:
        self.place(where="")
        screen = RetestScreen(self.theme, self.keys)
        self.show(screen)
        screen.show_exercises(["WRIST_FE", "WRIST_RU"], "WRIST_FE")
        screen.show_plan(retest_plan(), DEFAULT_LIMITS)
        screen.show_restated(restated_statements(), 3, 3)
        self.settle()
        return screen

    def retest_empty(self) -> None:
        self.place(where="")
        self.show(RetestScreen(self.theme, self.keys))

    def retest_people(self) -> None:
        self.retest()
        sheet = self._over(PeopleSheet(self.shell.stage, self.theme))
        sheet.begin([(f"p{k}", f"P{k:02d}", k % 4) for k in range(1, 15)], ["p1", "p3"])
        self.settle()

    def _beside(self, store: FakeSessions | FakeHandSessions, one: str, other: str) -> BesideScreen:
        self.place(tab=1, camera="")
        screen = BesideScreen(self.theme, self.keys, self.background, store)
        self.show(screen)
        screen.begin((one, other), "right")
        self.settle()
        assert screen.together is not None
        starts = screen.together.step.starts_s
        screen.playing.seek(starts[3] + 1.0 if len(starts) > 3 else 2.0)
        self.settle()
        screen.playing.stop()
        return screen

    def beside(self) -> BesideScreen:
        """The healthy hand of the same day."""
        store = FakeSessions()
        store.kept["session-7"] = RepetitionChoices({6: "pain"})
        left = session(NOW - timedelta(hours=1), 1.25, session_id="session-left", side="left")
        store.sessions["session-left"] = left
        return self._beside(store, "session-7", "session-left")

    def beside_dates(self) -> None:
        self._beside(self.sessions, "session-1", "session-7")

    def beside_unfair(self) -> None:
        self._beside(FakeSessions(pictures=False), "session-4", "session-left")

    def beside_hand(self) -> None:
        store = FakeHandSessions()
        store.sessions["hand-left"] = hand_session(NOW - timedelta(hours=1), session_id="hand-left", side="left")
        self._beside(store, "hand-3", "hand-left")

    def beside_reading(self) -> None:
        self.place(tab=1, camera="")
        screen = BesideScreen(self.theme, self.keys, Background(), self.sessions)
        screen.reader._background.run = lambda *_: None  # type: ignore[method-assign]
        self.show(screen)
        screen.begin(("session-1", "session-7"))
        self.settle()

    def report_beside(self) -> None:
        now = self.beside().shown
        assert now is not None
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        screen.begin(BesideReport(now, now.main_quantity, "Linden 42", "MK", "1.0.0"), "")
        self.settle()

    def settings(self) -> None:
        self.place(where="")
        chosen = Preferences(
            theme=self.theme.name, text_scale=self.theme.text_scale, data_folder="~/.local/share/carpus"
        )
        self.show(SettingsScreen(self.theme, chosen, "1.0.0"))

    def settings_safe(self) -> None:
        self.settings()
        screen = self.shell.stage.currentWidget()
        assert isinstance(screen, SettingsScreen)
        backup, lock = BackupCard(self.theme, 18), LockCard(self.theme, 10, "Ctrl+L")
        backup.show_facts(OLD_BACKUP)
        lock.show_pin(is_set=True)
        screen.add_cards("safety", backup, lock, RecordsCard(self.theme, 10, (0, 3, 5, 10, 15, 20, 30)))
        screen.choose("safety")
        self.settle()

    def settings_research(self) -> None:
        self.settings()
        screen = self.shell.stage.currentWidget()
        assert isinstance(screen, SettingsScreen)
        screen.choose("research")
        screen.research.click()
        self.settle()

    def locked(self) -> None:
        self.patients()
        sheet = self._over(LockSheet(self.shell, self.theme))
        sheet.begin(sheet.reason(datetime(2026, 11, 20, 11, 52), 10), stored=True)
        sheet.line.setText("4821")
        sheet.refuse(4, 0)
        self.settle()

    def pin_change(self) -> None:
        self.patients()
        self._over(PinSheet(self.shell.stage, self.theme)).begin(is_set=True)
        self.settle()

    def records_due(self) -> None:
        self.patients()
        words = "Their last session is more than 10 years ago. Nothing goes by itself."
        due = [
            ListedRecord(
                name, name, "9 sessions, the last on 3 Nov 2015; had to be kept until 3 Nov 2025", name[0] < "G"
            )
            for name in ("Linden 42", "Heron 17", "Fir 12")
        ]
        self._over(RecordsSheet(self.shell.stage, self.theme)).begin("What is due", words, due)
        self.settle()

    def records_log(self) -> None:
        self.patients()
        deeds = [
            DeedLine(number, datetime(2026, 11, 20, 9, number), "AB", what, "Linden 42, 2026-11-20 09:01", detail)
            for number, (what, detail) in enumerate(
                (("recorded", ""), ("opened", ""), ("exported", "files 7 · by command"), ("erased", "files 4, made 3")),
                1,
            )
        ]
        self._over(LogSheet(self.shell.stage, self.theme)).begin(deeds)
        self.settle()

    def _board(self) -> BoardScreen:
        self.place(where="")
        self.shell.bar.show_place("Camera calibration", "")
        screen = BoardScreen(self.theme, self.keys)
        self.show(screen)
        return screen

    def board(self) -> None:
        screen = self._board()
        screen.beginning.show_standing(
            "Camera 1210130114: calibrated 214 days ago. Checked 9 days ago: it measured right.", camera_there=True
        )
        screen.show_beginning()
        self.settle()

    def board_showing(self) -> None:
        screen = self._board()
        screen.show_showing(simulated=False)
        screen.showing.opened()
        frame, progress = board_progress()
        screen.showing.show_progress(progress)
        screen.showing.show_frame(frame)
        self.settle()

    def board_result(self) -> None:
        self._board().show_result(board_result())
        self.settle()

    def board_poor(self) -> None:
        self._board().show_result(board_result(poor=True))
        self.settle()

    def _card(self, checks: CameraChecks) -> CardScreen:
        self.place(where="")
        self.shell.bar.show_place("Check card", "")
        screen = CardScreen(self.theme, self.keys)
        screen.set_camera_there(True)
        self.show(screen)
        screen.show_checks(checks)
        self.settle()
        return screen

    def card(self) -> None:
        self._card(camera_checks())

    def card_out(self) -> None:
        self._card(camera_checks(out=True))

    def card_none(self) -> None:
        self._card(CameraChecks("", ""))

    def card_measuring(self) -> None:
        screen = self._card(CameraChecks("", "", simulated=True))
        self.shell.sign.show_lines(["Simulated camera: nothing here is of a real one."])
        screen.begin_measuring()
        frame, progress = card_progress()
        screen.show_frame(frame.color_rgb)
        screen.show_progress(progress)
        self.settle()
        self.shell.sign.show_lines([])

    def help(self) -> None:
        self.place(where="")
        self.show(HelpScreen(self.theme, self.keys))

    def close(self) -> None:
        """Take the window away."""
        self.shell.close()
        self.background.wait()
        self.settle()


def render_all_screens(
    folder: Path, *, sizes: tuple[tuple[int, int], ...] = SIZES, scales: tuple[float, ...] = (1.0,), only: str = "",
    states: tuple[str, ...] = (), themes: tuple[ThemeName, ...] = ("light", "dark"),
) -> list[Path]:  # fmt: skip
    """Write every state, those whose name begins with ``only``, or just ``states``; the paths written."""
    application = QApplication.instance() or QApplication(["carpus"])
    assert isinstance(application, QApplication)
    application.setStyle("Fusion")
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    load_fonts()
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for size in sizes:
        for theme in themes:
            for scale in scales:
                gallery = Gallery(application, theme, size, scale)
                for number, name in enumerate(STATES, 1):
                    if (only and not name.startswith(only)) or (states and name not in states):
                        continue
                    getattr(gallery, name)()
                    suffix = f"-{100 * scale:.0f}" if scale != 1.0 else ""
                    path = folder / f"{number:02d}-{name}-{theme}-{size[0]}x{size[1]}{suffix}.png"
                    gallery.shell.grab().save(str(path))
                    written.append(path)
                gallery.close()
    return written


if __name__ == "__main__":
    for shown in render_all_screens(Path(sys.argv[1]), only=sys.argv[2] if len(sys.argv) > 2 else ""):
        print(shown)

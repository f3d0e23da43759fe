"""Every screen as a picture, with convincing data: ``python -m tests.ui.gallery FOLDER``."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import date, datetime, timedelta
from functools import partialmethod
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication, QWidget

from carpus.core.calibration.card.checks import CheckStatus
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model.errors import DiskFull
from carpus.core.model.fault_text import MessageText
from carpus.core.model.installation import Finding
from carpus.core.model.types import ByteImage, Side
from carpus.core.records.corrections import ResultDifference
from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.session_setup import DEFAULT_SETS
from carpus.core.records.values import Patient, SessionEntry
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.results.report_form import Letterhead, ReportForm
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.fonts import load_fonts
from carpus.ui.kit.language import current_language, set_window_language
from carpus.ui.kit.theme import Theme, ThemeName
from carpus.ui.picture.movement_guide import GuideScene
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.page import Report
from carpus.ui.report.progress_page import build_progress_report
from carpus.ui.report.session_page import SessionReport, build_session_report
from carpus.ui.screens.by_hand.screen import ManualMeasurementsScreen, ManualRecord
from carpus.ui.screens.camera_calibration.screen import CameraCalibrationScreen
from carpus.ui.screens.check_card.screen import CheckCardScreen
from carpus.ui.screens.comparison.screen import ComparisonScreen
from carpus.ui.screens.correct.flow import ResultsDialog, difference_words
from carpus.ui.screens.correct.screen import CorrectionScreen
from carpus.ui.screens.help.screen import HelpScreen
from carpus.ui.screens.live.screen import LiveScreen
from carpus.ui.screens.markers.screen import MarkersScreen
from carpus.ui.screens.patient.view import PatientView
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.screens.progress.screen import ProgressScreen
from carpus.ui.screens.records.cards import BackupCard, BackupFacts, LockCard, RecordsCard
from carpus.ui.screens.records.deletion import DeleteDialog
from carpus.ui.screens.records.lock import LockScreen, PinDialog
from carpus.ui.screens.records.record_lists import ListedRecord, LogDialog, RecordsDialog
from carpus.ui.screens.report.dialogs import HomeDialog, LetterDialog
from carpus.ui.screens.report.screen import ReportScreen
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.screens.sessions.screen import SessionsScreen
from carpus.ui.screens.settings.retest_dialog import RetestDialog
from carpus.ui.screens.settings.screen import Preferences, SettingsScreen
from carpus.ui.screens.setup.camera import CameraScreen
from carpus.ui.screens.setup.exercise import ExerciseScreen
from carpus.ui.screens.setup.set_dialog import SetDialog
from carpus.ui.screens.tour.bubble import Bubble, BubbleView
from carpus.ui.screens.welcome.panel import WelcomePanel
from carpus.ui.shell.current_selection import NameDisplay
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Answer, MessageDialog, NoticeStrip
from carpus.ui.words.camera_check import camera_words
from carpus.ui.words.fault_words import fault_words
from tests.ui.camera_fakes import board_progress, board_result, card_progress, checked
from tests.ui.fake_stored_sessions import FakeStoredSessions
from tests.ui.fakes import (
    NOW,
    FakeCalibrator,
    FakeCorrections,
    FakeFeed,
    FakeMeasuring,
    FakeSessions,
    FakeStore,
    LateFeed,
    entered,
    figures_once,
    hand_values,
    hand_values_today,
    home_report,
    picture,
    retest_studies,
    session,
    set_up,
    with_other_spot,
)
from tests.ui.hand_fakes import FakeHandSessions, hand_session

SIZES = ((1280, 800), (1920, 1080))
STEPS = ("Exercise", "Camera", "Markers", "Measure")
TABS = ("Sessions", "Review", "Progress", "Report")
TODAY = date(2026, 11, 20)
SAVED = "Saved 11:37"
TICK_FRAMES = 30
LOST = MessageText(
    "The camera has stopped sending images.",
    "Everything recorded so far is saved on this computer.",
    "Plug the camera in again. Tracking and recording then continue automatically.",
    "Camera",
    "C-209",
    ("Xtion 1206", "no frame for 2 s"),
)
RECOVERED = MessageText(
    "A session of Heron 17 was interrupted yesterday at 16:42. It has been recovered.",
    "All data up to 04:12 are safe. At most the last second is missing, or more where results were delayed."
    " The file is marked “recovered”.",
    "Review it now or later. It stays in the patient’s session list.",
)
ERASED_DAY = datetime(2026, 10, 9, 9, 51)
ERASED_SESSION = ErasurePlan(
    "session", "s", "p", "Linden 42",
    (SessionEntry("s", Path("s.h5"), ERASED_DAY, ERASED_DAY, "s", "WRIST_FE", "right", 900, 30.0),),
    1, tuple(map(Path, "abcd")), 38_200_000, (Path("/home/clinic/Reports/L.pdf"),), (),
)  # fmt: skip
ERASED_PATIENT = replace(
    ERASED_SESSION, kind="patient", recording_count=9, files=tuple(Path(str(n)) for n in range(31)),
    size_bytes=412_000_000,
    output_files=(Path("/home/clinic/Reports/L.pdf"), Path("/home/clinic/Reports/L.csv")),
)  # fmt: skip
LAST_BACKUP = datetime(2026, 11, 15, 18, 4)
KEPT = "9 sessions, the last on 3 Nov 2015, retention until 3 Nov 2025"
DEEDS = [
    (numbers.format_date_time(datetime(2026, 11, 20, 9, number)), "AB", what, "Linden 42, 2026-11-20 09:01", detail)
    for number, (what, detail) in enumerate(
        (("recorded", ""), ("opened", ""), ("exported", "files 7 · by command"), ("erased", "files 4, made 3")), 1
    )
]
CORRECTED = "Linden 42 · 20 Nov 2026, 11:37 · Wrist flexion–extension, right hand"
DOCTOR = "Dr Anna Doctor\nVienna"
OLD_BACKUP = BackupFacts(
    "warn", "The last backup is 5 days old. 7 session files are missing from the backup.",
    "15 Nov 2026, 18:04 · 49 session files, 2.04 GB · verified", "Reminder after 3 days.",
    "/media/clinic-disk/carpus-backup", "good", "412 GB free", True,
)  # fmt: skip
CHECKS = (
    Finding("Camera", "warning", "none plugged in", "Plug the camera in, preferably directly into the computer. It "
            "needs a USB 2 port; some USB 3 ports refuse cameras with old firmware."),
    Finding("Camera driver", "bad", "libOpenNI2.so.0: cannot open shared object file: No such file or directory",
          "Needed for live cameras. Run: sudo apt-get install libopenni2-0"),
    Finding("Camera permissions", "good", "/lib/udev/rules.d/60-libopenni2-0.rules"),
    Finding("Data folder", "good", "/home/clinic/.local/share/carpus, made at the first recording"),
    Finding("Disk", "good", "212.4 GB free, about 1931 minutes with video"),
    Finding("Fonts", "good", "6 faces"),
    Finding("Screen", "good", "1920 × 1053 usable"),
)  # fmt: skip
ScreenT = TypeVar("ScreenT", bound=QWidget)
DialogT = TypeVar("DialogT", bound=Dialog)


def _translate(text: str, context: str = "") -> str:
    """Return a text of the window, or parts of it with dots between them, in the window's language."""
    return " · ".join(QCoreApplication.translate(context, part) for part in text.split(" · "))


class GalleryWindow:
    """One window in one theme and size, in which one thing after the other is shown."""

    def __init__(self, application: QApplication, theme: ThemeName, size: tuple[int, int], scale: float = 1.0) -> None:
        self.application = application
        self.theme = Theme(theme, scale)
        self.shell = MainWindow(self.theme)
        self.background = Background()
        self.sessions = FakeSessions()
        self.sessions.kept["session-7"] = RepetitionChoices({6: entered("pain")})
        if current_language() != "en":
            last = self.sessions.sessions["session-7"]
            events = tuple(replace(one, text=entered(one.text)) for one in last.events)
            self.sessions.sessions["session-7"] = replace(last, events=events)
        self.over: list[Dialog] = []
        self.shell.resize(*size)
        self.shell.show()
        self.shell.activateWindow()
        self.settle()

    def settle(self) -> None:
        """Let everything finish that is under way; a page lays its parts out one after the other."""
        for _ in range(6):
            self.application.processEvents()
            while self.background.is_busy:
                self.background.join()
                self.application.processEvents()

    def show_state(self, name: str) -> None:
        """One of :data:`STATES`."""
        getattr(self, name)()
        self.settle()

    def place(self, steps: int = -1, tab: int = -1, where: str = "Right hand", camera: str = "Camera ready") -> None:
        bar = self.shell.top_bar
        bar.show()
        bar.show_session("Linden 42" if steps >= 0 or tab >= 0 or where else "", _translate(where))
        if steps >= 0:
            bar.show_navigation([_translate(name, "TopBarController") for name in STEPS], steps, is_steps=True)
        elif tab >= 0:
            bar.show_navigation([_translate(name, "TopBarController") for name in TABS], tab)
        else:
            bar.show_navigation()
        bar.camera.show_state("good" if camera else "none", _translate(camera, "TopBarController"))
        bar.disk.show_state("none", "")
        bar.recording_pill.show_state("off", 0)
        bar.show_recording(False)
        bar.reanalysis_button.show_text("", "")
        self.shell.banner.show_lines([])

    def show(self, screen: ScreenT, first: QWidget | None = None, **place: Any) -> ScreenT:
        """One screen alone, in a :meth:`place` where one is told."""
        if place:
            self.place(**place)
        while self.over:
            sheet = self.over.pop()
            sheet.close_dialog()
            sheet.deleteLater()
        self.shell.show_screen(screen, first)
        stage = self.shell.screen_stack
        for old in [stage.widget(number) for number in range(stage.count())]:
            if old is not screen:  # every change of style would go through all that were ever shown
                stage.removeWidget(old)
                old.deleteLater()
        self.application.sendPostedEvents(None, QEvent.Type.DeferredDelete)  # outside a running loop nobody does
        self.settle()
        return screen

    def shown(self, kind: type[ScreenT]) -> ScreenT:
        screen = self.shell.screen_stack.currentWidget()
        assert isinstance(screen, kind)
        return screen

    def sheet(self, kind: Callable[[QWidget, Theme], DialogT], host: QWidget | None = None) -> DialogT:
        """A sheet over the whole stage, taken away with the next screen."""
        self.over.append(made := kind(host or self.shell.screen_stack, self.theme))
        return made

    def close(self) -> None:
        """Take the window away."""
        self.shell.close()
        self.background.join()
        self.settle()


State = Callable[[GalleryWindow], object]


def _then(state: str, act: Callable[[Any], object]) -> State:
    """A state in which something was done with its screen."""
    return lambda gallery: act(getattr(gallery, state)())


def _under(
    state: str, kind: Callable[..., DialogT], show_it: Callable[..., object], *given: object, **named: object
) -> State:
    """A state with a dialog over it, shown by one of its methods."""

    def show(gallery: GalleryWindow) -> None:
        getattr(gallery, state)()
        show_it(gallery.sheet(kind), *given, **named)

    return show


def _guided(state: str, bubble: Bubble) -> State:
    """A state with a bubble of the guide beside what it speaks of."""

    def show(gallery: GalleryWindow) -> None:
        gallery.show_state(state)
        gallery.shown(QWidget).findChild(BubbleView).show_bubble(bubble)

    return show


def _patient_view(exercise: str, scene: GuideScene, side: Side = "right", *, for_child: bool = False) -> State:
    def show(gallery: GalleryWindow) -> None:
        gallery.shell.top_bar.hide()
        view = gallery.show(PatientView(gallery.theme))
        view.show_set_up(replace(set_up(exercise), side=side, for_child=for_child))
        view.show_scene(scene)

    return show


class Gallery(GalleryWindow):
    """Each method shows one state; their order is that of the journey."""

    def _patients(self, store: FakeStore, chosen: str = "", *, camera: bool = False) -> PatientsScreen:
        screen = PatientsScreen(self.theme, store, lambda: TODAY, NameDisplay())
        screen.set_camera_ready(camera)
        screen.refresh(chosen)
        return self.show(screen, screen.search, where="")

    def patients(self) -> PatientsScreen:
        return self._patients(FakeStore(), "linden", camera=True)

    def patients_empty(self) -> None:
        self._patients(FakeStore([]))

    def patients_recovered(self) -> None:
        self.patients().notice_layout.addWidget(NoticeStrip(self.theme, RECOVERED, "Re&view it"))

    patient_form = _then("patients", PatientsScreen.new_patient)

    def exercise(self) -> ExerciseScreen:
        screen = ExerciseScreen(self.theme)
        screen.show_sets(DEFAULT_SETS)
        screen.show_patient(FakeStore().rows[5], set_up(), "right", True, 110.0, 720.0)
        return self.show(screen, screen.initial_focus(), steps=0)

    def exercise_hand(self) -> None:
        screen = ExerciseScreen(self.theme)
        screen.show_patient(FakeStore().rows[5], set_up("FIST_COMPOSITE", 90.0), "left", False)
        self.show(screen, screen.initial_focus(), steps=0)

    def camera(self) -> None:
        screen = CameraScreen(self.theme)
        screen.set_camera_ready(True)
        screen.show_set_up(set_up(), "camera")
        self.show(screen, screen.initial_focus(), steps=1)

    def _begin_markers(self, calibrator: FakeCalibrator, shown: ByteImage | None, since: str) -> MarkersScreen:
        screen = MarkersScreen(self.theme, self.background)
        self.show(screen, screen.picture, steps=2)
        screen.open_calibrator(calibrator, shown, since)
        self.settle()
        return screen

    def _markers(self, clicks: int, *findings: CalibrationFinding) -> tuple[MarkersScreen, FakeCalibrator]:
        calibrator = FakeCalibrator()
        calibrator.findings = findings
        screen = self._begin_markers(calibrator, picture(), entered("13 Nov"))
        for pixel in calibrator.disc_px[:clicks]:
            screen.picture.clicked.emit(pixel + 1.0)
        self.settle()
        return screen, calibrator

    def markers_clicking(self) -> None:
        screen, calibrator = self._markers(4)
        screen.picture.set_cursor(calibrator.disc_px[4] + 2.0)

    markers_ready = partialmethod(_markers, 6)
    markers_doubtful = partialmethod(_markers, 6, CalibrationFinding("tilt", (), 19.0, 15.0, "deg"))

    def markers_start_angle(self) -> None:
        screen, _ = self._markers(2)
        screen.angle_dialog.open_angles(np.radians([0.0, 10.0, 0.0]))

    def _proposed(self, doubtful: tuple[str, ...] = (), not_found: tuple[str, ...] = ()) -> MarkersScreen:
        calibrator = FakeCalibrator("fist", protocol="hand21")
        calibrator.doubtful, calibrator.not_found = doubtful, not_found
        return self._begin_markers(calibrator, None, "")

    markers_proposed = partialmethod(_proposed)
    markers_proposed_doubtful = partialmethod(_proposed, doubtful=("DIP4", "TIP4"))

    def markers_straight(self) -> None:
        screen = self._proposed()
        screen.labelling.accept_all()
        self.settle()
        screen.guidance.straight_fingers.buttons[3].click()

    def markers_other_spot(self) -> None:
        spot = tuple(map(float, FakeCalibrator().disc_px[3] + [14.0, 24.0]))
        self._markers(6, CalibrationFinding("other_spot", ("MCP3",), spot_px=spot))

    def sessions_list(self) -> None:
        sessions = FakeStoredSessions()
        sessions.exclude("s2", entered("markers lost"))
        self.show(SessionsScreen(self.theme, self.background, sessions), tab=0).show_patient(
            "linden", "Linden 42", "s1"
        )
        self.settle()

    sessions_erase = _under(
        "sessions_list", DeleteDialog, DeleteDialog.show_plan, ERASED_SESSION, 10, LAST_BACKUP, TODAY
    )
    patient_erase = _under("patients", DeleteDialog, DeleteDialog.show_plan, ERASED_PATIENT, 0, None, TODAY)

    def _live(
        self, feed: FakeFeed | None = None, seconds: float = 25.0, *, hidden: Sequence[tuple[float, float, str]] = (),
        lost: Sequence[tuple[float, float]] = (), whole_hand: bool = False,
    ) -> LiveScreen:  # fmt: skip
        """Some seconds recorded, at 60° of flexion asked for; or of a full fist, seen from the side."""
        if feed is None and whole_hand:
            feed = FakeFeed("fist", 32.0, hidden, lost, protocol="hand21")
        feed = feed or FakeFeed(seconds=32.0, hidden=hidden, lost=lost)
        self.place(where="Right hand · Wrist flexion–extension", camera="")
        screen = self.show(LiveScreen(self.theme, self.background))
        screen.open_source(FakeMeasuring(feed), set_up("FIST_COMPOSITE", 90.0) if whole_hand else set_up())
        screen._timer.stop()
        feed.picture_number = 0
        feed.step(2)
        screen.draw()
        screen.recording.toggle()
        self.settle()
        left = round(30 * seconds) - 1
        while left > 0:  # some at a time, as a busy window looks
            feed.step(min(left, TICK_FRAMES))
            left -= TICK_FRAMES
            screen.draw()
        feed.picture_number = None
        feed.step()
        for _ in range(2 * 20):
            screen.draw()
        bar = self.shell.top_bar
        bar.disk.show_state("none", entered("Space for 212 min"), icon="hard-drive")
        bar.recording_pill.show_state("recording", 84.0)
        bar.show_recording(True)
        self.settle()
        if whole_hand:
            bar.show_session("Linden 42", "Right hand · Full fist")
        return screen

    live = partialmethod(_live, hidden=[(16.0, 16.9, "CMC1")])

    def live_catching_up(self) -> None:
        """Stopped on a busy computer: the newest picture by itself, and how long it takes until all is tracked."""
        screen = self._live(feed := LateFeed(seconds=32.0))
        feed.ahead_s, feed.waiting = 21.0, 1200
        screen.recording.is_busy = True
        screen._show_values()
        feed.waiting = 500
        screen.draw()
        screen._show_values()

    live_marker_hidden = partialmethod(_live, hidden=[(23.0, 30.0, "CMC1")])

    def live_which_spot(self) -> None:
        """On the whole hand, where the picture has least room for it."""
        feed = FakeFeed("fist", 32.0, protocol="hand21")
        with_other_spot(feed, 9, 23.0, taken=True, off_px=(6.0, 20.0))
        self._live(feed, whole_hand=True)

    live_hand_lost = partialmethod(_live, lost=[(23.5, 30.0)])
    live_hand = partialmethod(_live, whole_hand=True)

    def live_disk_full(self) -> None:
        screen = self._live(feed := FakeFeed(seconds=32.0))
        self.shell.top_bar.disk.show_state("bad", "Disk full")
        self.shell.top_bar.recording_pill.show_state("off", 0.0)
        self.shell.top_bar.show_recording(False)
        feed.is_recording = False
        screen.controls.refresh()
        answers = [Answer("To the patients", lambda: None, "P"), Answer("Continue measuring", lambda: None, "Space")]
        words = fault_words(DiskFull("session.h5", "no space left"))
        MessageDialog(screen.stage, self.theme).show_words(words, answers, icon="hard-drive")

    live_note = _then("_live", lambda screen: screen.note_dialog.open_note())

    def live_camera_lost(self) -> None:
        screen = self._live()
        screen.set_camera_lost(True)
        for _ in range(30):
            screen.draw()
        bar = self.shell.top_bar
        bar.camera.show_state("bad", "No camera")
        bar.recording_pill.show_state("paused", 84.0)
        bar.show_recording(False)
        card = MessageDialog(screen.stage, self.theme)
        answers = [Answer("Check camera", lambda: None, "C"), Answer("Stop and review", screen.recording.stop, "Space")]
        detail, safe_detail = "Recording paused automatically at 01:24.", "All 1 min 24 s and 3 full repetitions."
        card.show_words(LOST, answers, icon="unplug", detail=detail, safe_detail=safe_detail)
        card.wait_text.setText("Waiting for the camera … 7 s")

    patient_view = _patient_view("WRIST_FE", GuideScene("out", 1, 42.0, 60.0, done=5, asked=10))
    patient_view_goal = _patient_view(
        "FIST_COMPOSITE", GuideScene("there", 1, 81.0, 80.0, done=5, asked=10), side="left"
    )
    patient_view_lost = _patient_view("FOREARM_PS", GuideScene("lost", 1, goal_deg=70.0, done=5, asked=10))
    exercise_sets = _under("exercise", SetDialog, SetDialog.open_sets, DEFAULT_SETS, "wrist6")

    def exercise_goals(self) -> None:
        self.exercise().show_history("linden", self.sessions.history("linden"))

    def _review(
        self, store: FakeSessions | None = None, session_id: str = "session-7", *, finger: int = -1,
        at_s: float = 20.6,
    ) -> ReviewScreen:  # fmt: skip
        screen = ReviewScreen(self.theme, self.background, store or self.sessions)
        self.show(screen, tab=1, camera=entered(SAVED)).load_session("linden", session_id, may_repeat=True)
        self.settle()
        if finger >= 0:
            screen.charts.finger.buttons()[finger].click()
        screen.playing.set_time(at_s)
        self.settle()
        screen.playing.stop()
        return screen

    def _review_hand(self, finger: int = 0) -> None:
        self._review(FakeHandSessions(), "hand-7", finger=finger, at_s=12.0)

    review = partialmethod(_review)
    review_hand = partialmethod(_review_hand)

    def review_passive_hand(self) -> None:
        """Some repetitions were passive, and the goniometer was at hand."""
        store = FakeHandSessions()
        store.kept = {"hand-7": RepetitionChoices(dict.fromkeys((3, 4, 5), PASSIVE))}
        store.hand_values = hand_values_today()
        self._review(store, "hand-7", at_s=0.0)

    review_reason = _then("review", lambda screen: screen.exclusion_dialog.open_form(4))
    review_angle = _then("review", lambda screen: screen.frame_view.angle_button.click())

    def review_hand_picture(self) -> None:
        screen = self.review()
        screen.hand_image_dialog.open_form()
        screen.hand_image_dialog.consent_check.click()

    def review_reach(self) -> None:
        store = FakeHandSessions()
        store.sessions = {
            f"hand-{number}": hand_session(
                NOW - timedelta(days=days), share, "REACH_GRASP", f"hand-{number}", "reach_grasp"
            )
            for number, days, share in ((6, 7, 0.9), (7, 0, 1.0))
        }
        self._review(store, "hand-7", finger=6, at_s=9.5)

    def _correct(self, *, pictures: bool = True, wrong_px: tuple[float, float] | None = None) -> CorrectionScreen:
        """With ``wrong_px``, where the middle knuckle was taken to be."""
        store = FakeCorrections(self.sessions, pictures=pictures)
        screen = self.show(CorrectionScreen(self.theme, self.background, store), tab=1, camera=entered(SAVED))
        session = self.sessions.session("session-7")
        if wrong_px is not None:
            measured = session.markers.measured_px.copy()
            measured[620, 3] = wrong_px
            session = replace(session, markers=replace(session.markers, measured_px=measured))
        screen.show_session("session-7", session, 620)
        self.settle()
        return screen

    def correct(self) -> None:
        """A name that stood where there is no disc has been put on its own."""
        right_px = self.sessions.session("session-7").markers.measured_px[620, 3]
        self._correct(wrong_px=(right_px[0] - 10.0, right_px[1] + 36.0)).place_marker("MCP3", right_px)

    correct_spots = partialmethod(_correct, pictures=False)

    def correct_results(self) -> None:
        self.review()
        self.place(tab=1, camera=entered(SAVED))
        self.shell.top_bar.reanalysis_button.show_text("New result: choose one", "Choose")
        sheet = self.sheet(ResultsDialog)
        words = difference_words(
            ResultDifference(1240, 212, 0.3, 39.2, 3, "flexion", ("MCP3",), is_live=True), ("MCP3",)
        )
        sheet.show_results(CORRECTED, words)
        sheet.open()

    def _comparison(self, store: FakeSessions, one: str, other: str) -> ComparisonScreen:
        screen = self.show(ComparisonScreen(self.theme, self.background, store), tab=1, camera="")
        screen.load_sessions((one, other), "right")
        self.settle()
        starts = screen.timeline.starts_s
        screen.playing.set_time(starts[3] + 1.0 if len(starts) > 3 else 2.0)
        self.settle()
        screen.playing.stop()
        return screen

    def comparison(self) -> ComparisonScreen:
        """The healthy hand of the same day."""
        store = FakeSessions()
        store.kept["session-7"] = RepetitionChoices({6: entered("pain")})
        left = session(NOW - timedelta(hours=1), 1.25, session_id="session-left", side="left")
        store.sessions["session-left"] = left
        return self._comparison(store, "session-7", "session-left")

    def comparison_hand(self) -> None:
        store = FakeHandSessions()
        store.sessions["hand-left"] = hand_session(NOW - timedelta(hours=1), session_id="hand-left", side="left")
        self._comparison(store, "hand-3", "hand-left")

    def progress(self, store: FakeSessions | None = None, session_id: str = "session-7") -> None:
        screen = ProgressScreen(self.theme, self.background, store or self.sessions)
        self.show(screen, tab=2, camera="").load_patient("linden", session_id)

    def progress_by_hand(self) -> None:
        store = FakeSessions()
        store.hand_values = hand_values()
        self.progress(store)

    def progress_hand(self) -> None:
        self.progress(FakeHandSessions(), "hand-7")

    def by_hand(self) -> None:
        screen = self.show(ManualMeasurementsScreen(self.theme, lambda: TODAY), tab=2, camera="")
        figures = sorted(self.sessions.history("linden"), key=lambda one: one.when)
        screen.show_record(ManualRecord("Linden 42", "right", tuple(hand_values()), tuple(figures), "MK"))

    def by_hand_fingers(self) -> None:
        """The grid of a fist session: some cells typed, some of them wrong or unusual, the rest measured by Carpus."""
        screen = self.show(ManualMeasurementsScreen(self.theme, lambda: TODAY), tab=2, camera="")
        figures = sorted(FakeHandSessions().history("linden"), key=lambda one: one.when)
        screen.show_record(ManualRecord("Linden 42", "right", tuple(hand_values_today()), tuple(figures), "MK"))
        for name, text in (("DIP2_EXTENSION", "-10"), ("DIP2_FLEXION", "55"), ("PIP5_FLEXION", "130")):
            screen.form.fingers.cells[name, "active"].setText(text)
        screen.form.fingers.setFocus()

    def by_hand_scores(self) -> None:
        """Kapandji score proposed from an opposition, and a questionnaire entered by its answers."""
        screen = self.show(ManualMeasurementsScreen(self.theme, lambda: TODAY), tab=2, camera="")
        seen = figures_once(hand_session(exercise="THUMB_OPP", motion="opposition"))
        figures = [replace(seen, when=NOW, side="right", is_simulated=False)]
        screen.show_record(
            ManualRecord(
                "Linden 42",
                "right",
                tuple(hand_values_today()),
                tuple(figures),
                "MK",
                Patient("Linden 42", "right", sex="female", birth_day=date(1981, 3, 12)),
            )
        )
        screen.measure_choice.choose("QUICK_DASH")
        screen.measure_choice.activated.emit(screen.measure_choice.currentIndex())
        screen.form.rows["QUICK_DASH"].answers_field.setText("1234-")
        screen.form.rows["PRWE"].answers_field.setText("4 4 5 6 7 1 2 3 4 5 6 7 8 9 10")
        screen.form.rows["PRWE"].answers_field.setFocus()

    def _report(self, made: Report) -> None:
        self.show(ReportScreen(self.theme, self.background), tab=3, camera="").show_report(made, "")
        self.settle()

    def _session_report(self, **look: Any) -> SessionReport:
        return build_session_report(self.sessions.session("session-7"), history=self.sessions.history("linden"), **look)

    def report(self) -> None:
        self._report(self._session_report(choices=self.sessions.choices("session-7")))

    def report_hand(self) -> None:
        store = FakeHandSessions()
        self._report(build_session_report(store.session("hand-7"), history=store.history("linden")))

    def report_progress(self) -> None:
        self._report(build_progress_report(self.sessions.history("linden")))

    def report_own(self) -> None:
        """The clinic's letterhead on US Letter, a comment, a part left out."""
        head = Letterhead("Hand clinic at the river", ("12 Riverside Road", "Springfield"))
        form = ReportForm(head, "letter", frozenset({"curves"}))
        self._report(self._session_report(form=form, comment="Splint at night.\nCome back."))

    def report_letter(self) -> None:
        maria = Patient("Linden 42", "right", name="Maria Muster")
        self._report(LetterReport(self._session_report(), DOCTOR, TODAY, maria))

    def letter_sheet(self) -> None:
        self.report_own()
        sheet = self.sheet(LetterDialog)
        sheet.open_form([DOCTOR], has_name=True)
        sheet.name_check.setChecked(True)

    def report_home(self) -> None:
        self._report(home_report())

    def home_sheet(self) -> None:
        self.report_own()
        self.sheet(HomeDialog).open_form(build_session_report(self.sessions.session("session-7")), TODAY)

    def settings(self) -> SettingsScreen:
        chosen = Preferences(
            theme=self.theme.name, text_scale=self.theme.text_scale, data_folder="~/.local/share/carpus"
        )
        return self.show(SettingsScreen(self.theme, chosen), where="")

    settings_measuring = _then("settings", lambda screen: screen.show_page("measuring"))

    def settings_safe(self) -> None:
        screen = self.settings()
        backup, lock = BackupCard(self.theme, 18), LockCard(self.theme, 10)
        backup.show_facts(OLD_BACKUP)
        lock.show_pin(is_set=True)
        screen.add_cards("safety", backup, lock, RecordsCard(self.theme, 10, (0, 3, 5, 10, 15, 20, 30)))
        screen.show_page("safety")

    settings_retest = _under("settings_measuring", RetestDialog, RetestDialog.show_studies, retest_studies(), 1, TODAY)

    def settings_research(self) -> None:
        screen = self.settings()
        screen.show_page("research")
        screen.form["research"].click()

    def locked(self) -> None:
        self.patients()
        sheet = self.sheet(LockScreen, self.shell)
        sheet.lock(sheet.lock_reason(datetime(2026, 11, 20, 11, 52), 10), is_session_saved=True)
        sheet.pin_field.setText("4821")
        sheet.show_wrong_pin(4, 0)

    pin_change = _under("patients", PinDialog, PinDialog.request_pin, is_set=True)
    records_due = _under(
        "patients", RecordsDialog, RecordsDialog.show_records, "Records past their retention period",
        "The last session was more than 10 years ago. Nothing is deleted automatically.",
        [ListedRecord(name, name, KEPT, name[0] < "G") for name in ("Linden 42", "Heron 17", "Fir 12")],
    )  # fmt: skip
    records_log = _under("patients", LogDialog, LogDialog.show_entries, DEEDS)

    def help(self) -> None:
        self.show(HelpScreen(self.theme), where="")

    def _welcome(self, checks: Sequence[Finding], *, counts_later: bool = False) -> None:
        screen = PatientsScreen(self.theme, FakeStore([]), lambda: TODAY, NameDisplay())
        panel = WelcomePanel(self.theme)
        panel.show_folder("/home/clinic/.local/share/carpus", needs_restart=counts_later)
        panel.show_checks(checks)
        screen.show_welcome(panel)
        self.show(screen, screen.search, where="", camera="")

    patients_welcome = partialmethod(_welcome, CHECKS)
    patients_welcome_good = partialmethod(
        _welcome, [replace(check, state="good", remedy="") for check in CHECKS], counts_later=True
    )
    markers_guided = _guided("markers_clicking", "click")

    def _board(self) -> CameraCalibrationScreen:
        self.place(where="")
        self.shell.top_bar.show_session(_translate("Camera calibration", "CameraCalibrationFlow"), "")
        return self.show(CameraCalibrationScreen(self.theme))

    def board(self) -> None:
        screen = self._board()
        screen.setup_view.show_status(camera_words(checked())[1])
        screen.setup_view.set_camera_connected(True)
        screen.show_setup()

    def board_showing(self) -> None:
        screen = self._board()
        screen.show_capture()
        screen.capture_view.show_opened()
        frame, progress = board_progress()
        screen.capture_view.show_progress(progress)
        screen.capture_view.frame_view.show_frame(frame.color_rgb)

    board_result = _then("_board", lambda screen: screen.show_result(board_result()))

    def _card(self, status: CheckStatus) -> CheckCardScreen:
        self.place(where="")
        self.shell.top_bar.show_session(_translate("Check card", "CheckCardFlow"), "")
        screen = CheckCardScreen(self.theme)
        screen.set_camera_connected(True)
        self.show(screen).show_status(status)
        self.settle()
        return screen

    card = partialmethod(_card, checked())
    card_out = partialmethod(_card, checked(out=True))

    def card_measuring(self) -> None:
        screen = self._card(CheckStatus(""))
        screen.begin_measuring()
        frame, progress = card_progress()
        screen.frame_view.show_frame(frame.color_rgb)
        screen.show_progress(progress)


STATES = tuple(name for name in vars(Gallery) if not name.startswith("_"))
"""Every state, by the method that shows it, in the order of the journey."""


def render_all_screens(
    folder: Path, *, sizes: tuple[tuple[int, int], ...] = SIZES, scales: tuple[float, ...] = (1.0,), only: str = "",
    states: tuple[str, ...] = (), themes: tuple[ThemeName, ...] = ("light", "dark"), language: str = "en",
) -> list[Path]:  # fmt: skip
    """Write every state, those whose name begins with ``only``, or just ``states``; the paths written."""
    application = QApplication.instance() or QApplication(["carpus"])
    assert isinstance(application, QApplication)
    application.setStyle("Fusion")
    set_window_language(language)
    load_fonts()
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for size, theme, scale in product(sizes, themes, scales):
        gallery = Gallery(application, theme, size, scale)
        for number, name in enumerate(STATES, 1):
            if (only and not name.startswith(only)) or (states and name not in states):
                continue
            gallery.show_state(name)
            suffix = f"-{100 * scale:.0f}" if scale != 1.0 else ""
            path = folder / f"{number:02d}-{name}-{theme}-{size[0]}x{size[1]}{suffix}.png"
            gallery.shell.grab().save(str(path))
            written.append(path)
        gallery.close()
    return written


if __name__ == "__main__":
    for shown in render_all_screens(Path(sys.argv[1]), only=sys.argv[2] if len(sys.argv) > 2 else ""):
        print(shown)

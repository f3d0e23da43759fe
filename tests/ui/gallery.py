"""Every screen as a picture, with convincing data: ``python -m tests.ui.gallery FOLDER``."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from datetime import date
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QLocale
from PySide6.QtWidgets import QApplication, QWidget

from app.desktop.phrases import WordTable
from core.calibration.result import Finding
from core.errors import DiskFull
from core.output.report_content import RepetitionChoices
from core.words import finding_words
from tests.ui.fakes import (
    FakeCalibrator,
    FakeFeed,
    FakeMeasuring,
    FakePhrasebook,
    FakeSessions,
    FakeStore,
    picture,
    set_up,
)
from tests.ui.hand_fakes import FakeHandSessions
from ui.background import Background
from ui.fonts import load_fonts
from ui.help.screen import HelpScreen
from ui.keys import Keys
from ui.live.screen import LiveScreen
from ui.markers.screen import MarkersScreen
from ui.messages.stop_card import Answer, StopCard
from ui.messages.strip import NoticeStrip
from ui.patients.screen import PatientsScreen
from ui.ports import Preferences, Words
from ui.progress.screen import ProgressScreen
from ui.report.pdf import progress_report, session_report
from ui.report.screen import ReportScreen
from ui.review.screen import ReviewScreen
from ui.settings.screen import SettingsScreen
from ui.setup.camera import CameraScreen
from ui.setup.exercise import ExerciseScreen
from ui.shell import Shell
from ui.theme import Theme, ThemeName

SIZES = ((1280, 800), (1920, 1080))
STEPS = ("Exercise", "Camera", "Markers", "Measure")
TABS = ("Session", "Review", "Progress", "Report")
TODAY = date(2026, 11, 20)
LOST = Words(
    "The camera sends no more pictures.",
    "Everything recorded so far is stored on this computer.",
    "Plug the camera in again; tracking and recording then go on by themselves.",
)
RECOVERED = Words(
    "A session of Heron 17 was cut short yesterday at 16:42. It has been recovered.",
    "All data up to 04:12 are safe; at most the last second is missing. The file is marked “recovered”.",
    "Review it now, or leave it for later: it stays in the patient’s list.",
)


class Phrases(FakePhrasebook):
    """The real words for findings."""

    def finding(self, finding: Finding) -> Words:
        words = finding_words(finding)
        return Words(words.headline, "", words.remedy)


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
        self.shell.resize(*size)
        self.shell.show()
        self.shell.activateWindow()
        self.settle()

    def settle(self) -> None:
        """Let everything finish that is under way."""
        for _ in range(3):
            self.application.processEvents()
            while self.background.busy:
                self.application.processEvents()

    def place(self, steps: int = -1, tab: int = -1, where: str = "Right hand", camera: str = "Camera ready") -> None:
        bar = self.shell.bar
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
        self.shell.show_screen(screen, first)
        self.settle()

    def patients(self) -> PatientsScreen:
        self.place(where="")
        screen = PatientsScreen(self.theme, FakeStore(), TODAY)
        screen.set_camera_ready(True)
        screen.refresh("linden")
        self.show(screen, screen.search)
        return screen

    def patients_empty(self) -> None:
        self.place(where="")
        screen = PatientsScreen(self.theme, FakeStore([]), TODAY)
        screen.refresh()
        self.show(screen, screen.search)

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
        screen.begin(FakeStore().rows[5], set_up(), "right", False)
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

    def _markers(self, clicks: int, *findings: Finding) -> tuple[MarkersScreen, FakeCalibrator]:
        self.place(steps=2)
        screen = MarkersScreen(self.theme, self.keys, self.background, Phrases())
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
        self._markers(6, Finding("swapped", ("MCP2", "MCP3")))

    def markers_doubtful(self) -> None:
        self._markers(6, Finding("tilt", (), 19.0, 15.0, "deg"))

    def _proposed(self, doubtful: tuple[str, ...] = (), not_found: tuple[str, ...] = ()) -> MarkersScreen:
        self.place(steps=2)
        screen = MarkersScreen(self.theme, self.keys, self.background, Phrases())
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
        screen.toggle_recording()
        self.settle()
        for _ in range(round(30 * seconds) - 1):
            feed.step()
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

    def live_speeds(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            screen.toggle_speeds()
            self.settle()

    def live_marker_hidden(self) -> None:
        with self._live(FakeFeed(seconds=32.0, hidden=[(23.0, 30.0, "CMC1")])):
            pass

    def live_hand_lost(self) -> None:
        with self._live(FakeFeed(seconds=32.0, lost=[(23.5, 30.0)])):
            pass

    def live_arm_moved(self) -> None:
        feed = FakeFeed(seconds=32.0)
        for number, frame in enumerate(feed.frames):
            if number > 30 * 23.5:
                feed.frames[number] = replace(frame, position_m=frame.position_m + [0.0, 0.021, 0.004])
        with self._live(feed):
            pass

    def live_disk_full(self) -> None:
        with self._live(FakeFeed(seconds=32.0)) as screen:
            self.shell.bar.disk.show_state("bad", "Disk full")
            self.shell.bar.pill.show_state("off", 0.0)
            self.shell.bar.show_recording(False)
            screen._measuring.feed.recording = False  # type: ignore[union-attr, misc]
            screen._show_buttons()
            card = StopCard(screen.stage, self.theme)
            words = WordTable().fault(DiskFull("session.h5", "no space left"))
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
            screen.toggle_side()
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
            answers = [Answer("Check camera", lambda: None, "C"), Answer("Stop and review", screen.stop, "Space")]
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
        screen.seek(20.6)
        self.settle()
        screen.end()

    def review_hand(self, finger: int = 0) -> None:
        self.place(tab=1, camera="Saved 11:37")
        screen = ReviewScreen(self.theme, self.keys, self.background, FakeHandSessions())
        self.show(screen)
        screen.begin("linden", "hand-7", may_repeat=True)
        self.settle()
        screen.finger.buttons()[finger].click()
        screen.seek(12.0)
        self.settle()
        screen.end()

    def review_hand_finger(self) -> None:
        self.review_hand(4)

    def progress(self) -> None:
        self.place(tab=2, camera="")
        screen = ProgressScreen(self.theme, self.keys, self.background, self.sessions)
        self.show(screen)
        screen.begin("linden", "session-7")
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

    def report_progress(self) -> None:
        self.place(tab=3, camera="")
        screen = ReportScreen(self.theme, self.keys, self.background)
        self.show(screen)
        screen.begin(progress_report(self.sessions.history("linden")), "")
        self.settle()

    def settings(self) -> None:
        self.place(where="")
        chosen = Preferences(
            theme=self.theme.name, text_scale=self.theme.text_scale, data_folder="~/.local/share/carpus"
        )
        self.show(SettingsScreen(self.theme, chosen, "1.0.0"))

    def help(self) -> None:
        self.place(where="")
        self.show(HelpScreen(self.theme, self.keys))

    def states(self) -> dict[str, Callable[[], object]]:
        """Every state by its file name, in the order of the journey."""
        names = (
            "patients", "patients_empty", "patients_not_found", "patients_recovered", "patient_form", "exercise",
            "exercise_hand",
            "camera", "markers_clicking", "markers_ready", "markers_swapped", "markers_doubtful",
            "markers_start_angle", "markers_proposed", "markers_proposed_doubtful", "markers_proposed_incomplete",
            "live", "live_speeds", "live_marker_hidden", "live_hand_lost", "live_hand",
            "live_hand_thumb_hidden", "live_hand_fist", "live_hand_not_found", "live_arm_moved",
            "live_disk_full", "live_note",
            "live_pain", "live_camera_lost", "review", "review_hand", "review_hand_finger",
            "progress", "progress_hand", "report", "report_hand", "report_progress", "settings", "help",
        )  # fmt: skip
        return {name: getattr(self, name) for name in names}

    def close(self) -> None:
        """Take the window away."""
        self.shell.close()
        self.background.wait()
        self.settle()


def render_all_screens(
    folder: Path, *, sizes: tuple[tuple[int, int], ...] = SIZES, scales: tuple[float, ...] = (1.0,), only: str = ""
) -> list[Path]:
    """Write every state in both themes; the paths written."""
    application = QApplication.instance() or QApplication(["carpus"])
    assert isinstance(application, QApplication)
    application.setStyle("Fusion")
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    load_fonts()
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    themes: tuple[ThemeName, ...] = ("light", "dark")
    for size in sizes:
        for theme in themes:
            for scale in scales:
                gallery = Gallery(application, theme, size, scale)
                for number, (name, show) in enumerate(gallery.states().items(), 1):
                    if only and not name.startswith(only):
                        continue
                    show()
                    suffix = f"-{100 * scale:.0f}" if scale != 1.0 else ""
                    path = folder / f"{number:02d}-{name}-{theme}-{size[0]}x{size[1]}{suffix}.png"
                    gallery.shell.grab().save(str(path))
                    written.append(path)
                gallery.close()
    return written


if __name__ == "__main__":
    for shown in render_all_screens(Path(sys.argv[1]), only=sys.argv[2] if len(sys.argv) > 2 else ""):
        print(shown)

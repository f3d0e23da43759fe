"""The complete workflow without a person, on the real windows and without a display.

Patient, simulated camera, markers, live, record, stop, review, progress, report: by keys and clicks.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PySide6.QtCore import QPoint, Qt, qInstallMessageHandler
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget

from carpus.app.command_line import handle_stop_signals
from carpus.app.compose import compose
from carpus.app.desktop.appearance import create_application
from carpus.app.desktop.practice import practice_spec
from carpus.app.desktop.source_factory import RECENT_FRAMES
from carpus.app.desktop.window import Desktop
from carpus.app.settings import ScreenSettings, Settings, WelcomeSettings
from carpus.core.model.errors import CalibrationImpossible
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.results.session_results import SessionResults
from carpus.core.simulation.recording import SimulatedRecording, is_cached, sample_clicks
from carpus.ui.kit import numbers
from carpus.ui.shell.flow import PATIENT_TABS
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle

REPETITIONS = 2
TIMEOUT_S = 60.0
Progress = Callable[[int, int | None], None]


@dataclass(frozen=True, slots=True)
class DemoResult:
    """Files of a demo run and its results as lines of text."""

    session: Path
    report: Path
    lines: Sequence[str]


class DemoDriver:
    """Presses keys and clicks like a person; waits for conditions, never for a fixed time."""

    def __init__(self, desktop: Desktop, is_stopping: Callable[[], bool] = lambda: False) -> None:
        """Wrap a desktop; ``is_stopping`` is asked at each wait and ends the run by KeyboardInterrupt."""
        self.desktop = desktop
        self.controller = desktop.controller
        self._shown_faults: list[Exception] = []
        self._is_stopping = is_stopping
        desktop.controller.messages.fault_shown.connect(self._shown_faults.append)

    def run_until(self, condition: Callable[[], bool], timeout_s: float = TIMEOUT_S) -> None:
        """Process events until ``condition`` holds; raise a fault that the window shows meanwhile."""
        end_s = time.monotonic() + timeout_s
        while not condition():
            if self._is_stopping():
                raise KeyboardInterrupt
            if self._shown_faults:
                raise self._shown_faults[0]
            if time.monotonic() > end_s:
                raise TimeoutError(f"waited in vain on the screen “{self.controller.place}”")
            self.desktop.application.processEvents()
            QTest.qWait(5)

    def run_until_screen(self, place: str) -> None:
        self.run_until(lambda: self.controller.place == place)

    def press_key(self, key: Qt.Key, widget: QWidget | None = None) -> None:
        """Press a key on a widget, by default the one with the keyboard focus."""
        now: QWidget | None = self.desktop.shell.focusWidget()
        QTest.keyClick(widget or now or self.desktop.shell, key)

    def start_practice(self) -> None:
        """Choose the practice patient and press Enter."""
        controller = self.controller
        controller.patients.screen.refresh(PRACTICE_PATIENT)
        self.press_key(Qt.Key.Key_Return, controller.patients.screen.search)

    def capture_frame(self) -> None:
        """Press Space once the hand has been visible for half a second."""
        self.run_until_screen("markers")
        markers, source = self.controller.markers.screen, self.controller.current.source
        assert source is not None
        feed = source.measuring.feed
        self.run_until(
            lambda: len(feed.recent_frames(RECENT_FRAMES)) == RECENT_FRAMES and markers.picture.image is not None
        )
        self.press_key(Qt.Key.Key_Space, markers.picture)
        self.run_until(lambda: markers.labels is not None)

    def click_markers(self, pixel: FloatArray) -> None:
        """Click pixels (M, 2) in the order of the protocol, and start measuring."""
        markers = self.controller.markers.screen
        for u, v in pixel:
            self.desktop.application.processEvents()  # what came or went beside the picture may still make it smaller
            spot: QPoint = markers.picture.to_screen(float(u), float(v)).toPoint()
            QTest.mouseMove(markers.picture, spot)
            QTest.mouseClick(markers.picture, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, spot)
        if markers.labels is None or not markers.labels.is_complete:
            raise CalibrationImpossible()
        self.run_until(markers.primary_button.isEnabled)
        self.press_key(Qt.Key.Key_Return)
        self.run_until_screen("live")

    def record(self, repetitions: int, progress: Callable[[int], None] = lambda _: None) -> str:
        """Record so many repetitions and return the id of the session."""
        live = self.controller.live.screen
        self.run_until(lambda: not live.recording.is_hand_resting())  # before, Space would be ignored
        self.press_key(Qt.Key.Key_Space, live)
        self.run_until(lambda: live.recording.state == "recording")

        def is_enough() -> bool:
            progress(live.recording.repetitions)
            return live.recording.repetitions >= repetitions

        self.run_until(is_enough)
        self.press_key(Qt.Key.Key_Space, live)
        self.run_until_screen("review")
        self.run_until(lambda: self.controller.review.screen.is_loaded)
        return self.controller.current.session_id

    def click_tab(self, place: str) -> None:
        button = self.desktop.shell.top_bar.navigation_buttons[PATIENT_TABS.index(place)]
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        self.run_until_screen(place)

    def save_report(self, path: Path) -> None:
        """Create the report from the review and save it."""
        self.controller.review.screen.card.report_button.click()
        self.run_until_screen("report")
        saved: list[str] = []
        self.controller.report.screen.saved.connect(saved.append)
        self.controller.report.screen.save(str(path))
        self.run_until(lambda: bool(saved))


def run_demo(settings: Settings, progress: Progress) -> DemoResult:
    """Run the complete workflow on the practice patient; raise the first fault that is shown."""
    settings = replace(settings, screen=ScreenSettings("light"), first_start=WelcomeSettings(answered=True))
    stopping = threading.Event()
    # first of all: an exception out of the middle of a window's own work would be lost
    handle_stop_signals(stopping.set)
    qInstallMessageHandler(_handle_qt_message)
    qt = create_application(["carpus"])
    desktop = compose(qt, settings, is_demo=True)
    try:
        walker = DemoDriver(desktop, stopping.is_set)
        desktop.show()
        walker.run_until_screen("patients")
        desktop.controller.opener.progress_changed.connect(progress)
        walker.start_practice()
        walker.run_until(lambda: desktop.controller.place == "markers", timeout_s=1800.0)
        set_up = desktop.controller.current.set_up
        assert set_up is not None
        walker.capture_frame()
        walker.click_markers(sample_clicks(SimulatedRecording(practice_spec(set_up)).truth).pixel)
        walker.run_until(lambda: is_cached(practice_spec(set_up)), timeout_s=1800.0)  # here nobody sees the hand rest
        session_id = walker.record(REPETITIONS, lambda done: progress(done, REPETITIONS))
        walker.click_tab("progress")
        walker.click_tab("review")
        walker.run_until(lambda: desktop.controller.review.screen.is_loaded)
        path = desktop.library.entry(session_id).path
        report = path.with_suffix(".pdf")
        walker.save_report(report)
        figures = desktop.library.results(desktop.library.entry(session_id))
        return DemoResult(path, report, format_results(figures))
    finally:
        desktop.close()


def _handle_qt_message(_kind: object, _context: object, message: str) -> None:
    """Print a message of Qt, except one that concerns platforms without a screen only."""
    if "does not support propagateSizeHints" not in message:
        sys.stderr.write(f"{message}\n")


def format_results(figures: SessionResults) -> list[str]:
    """Return the main results of a session as lines of text."""
    quality = figures.quality
    shares = f"{format_rounded(100.0 * quality.measured_share, 1)} % measured, {quality.dropped_frames} missing"
    lines = [f"Frames:  {quality.frames} in {format_rounded(figures.duration_s, 1)} s, {shares}"]
    lines.append(f"Repetitions: {figures.repetition_count}")
    for row in figures.wrist_ranges:
        name = terms.movement_long_name(row.quantity)
        lines.append(f"{name}: {terms.end_words(row.mean, row.quantity, row.sd)}")
    for row in figures.joint_ranges:
        if row.quantity == "arc" and row.count:
            value = numbers.format_with_sd(row.mean, row.sd)
            value = f"at least {numbers.format_degrees(row.mean)}" if row.is_lower_bound else value
            lines.append(f"{find_finger_angle(row.subject).long_name}: {value}")
    return lines

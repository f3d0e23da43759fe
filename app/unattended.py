"""The whole way without a person: the real windows on a platform without a screen, driven by keys and clicks.

patient -> simulated camera -> markers -> live -> record -> stop -> review -> progress -> report.
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

from carpus.app.command_line import on_stop, say
from carpus.app.compose import compose
from carpus.app.desktop.looks import application
from carpus.app.desktop.practice import practice_spec
from carpus.app.desktop.sources import RECENT_FRAMES
from carpus.app.desktop.window import Desktop
from carpus.app.settings import FirstStartSettings, ScreenSettings, Settings
from carpus.core.errors import CalibrationImpossible
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.results.figures import SessionFigures
from carpus.core.rounding import written
from carpus.core.simulation.recording import SimulatedPictures, clicks_of, is_cached
from carpus.core.types import FloatArray
from carpus.ui import numbers, terms
from carpus.ui.figures import figure_of
from carpus.ui.flow import TABS

REPETITIONS = 2
PATIENCE_S = 60.0
STEP_LINE_EVERY_S = 4.0
"""How often a line says what is going on where no terminal shows a bar."""
Progress = Callable[[int, int | None], None]


@dataclass(frozen=True, slots=True)
class Walked:
    """Where the session and its report are, and what came out, in lines."""

    session: Path
    report: Path
    lines: Sequence[str]


class StepLog:
    """Says every few seconds which step runs and how far it is, where no terminal shows a bar."""

    def __init__(self, is_terminal: bool) -> None:
        self._is_terminal = is_terminal
        self.begin_step("opening the window")

    def begin_step(self, step: str) -> None:
        """Name the step that begins; it is said at once."""
        self._step, self._done, self._total = step, 0, 0
        self._write_line()

    def update(self, done: int, total: int) -> None:
        """How much of the step is done."""
        self._done, self._total = done, total

    def tick(self) -> None:
        """Called again and again while the step runs."""
        if time.monotonic() - self._last_line_s >= STEP_LINE_EVERY_S:
            self._write_line()

    def _write_line(self) -> None:
        self._last_line_s = time.monotonic()
        if not self._is_terminal:
            say(f"demo: {self._step}" + (f", {self._done} of {self._total}" if self._total > 1 else ""))


class Walker:
    """Presses keys and clicks as a person would; waits for what must follow, never for a time."""

    def __init__(
        self,
        desktop: Desktop,
        is_stopping: Callable[[], bool] = lambda: False,
        on_wait: Callable[[], None] = lambda: None,
    ) -> None:
        """``is_stopping`` ends the way, by a KeyboardInterrupt at its next wait; ``on_wait`` is called at each wait."""
        self.desktop = desktop
        self._on_wait = on_wait
        self.journey = desktop.journey
        self._faults: list[Exception] = []
        self._is_stopping = is_stopping
        desktop.journey.messages.told.connect(self._faults.append)

    def until(self, condition: Callable[[], bool], patience_s: float = PATIENCE_S) -> None:
        """Let the window live until something holds; a fault it tells meanwhile ends the way."""
        end_s = time.monotonic() + patience_s
        while not condition():
            if self._is_stopping():
                raise KeyboardInterrupt
            self._on_wait()
            if self._faults:
                raise self._faults[0]
            if time.monotonic() > end_s:
                raise TimeoutError(f"waited in vain on the screen “{self.journey.place}”")
            self.desktop.application.processEvents()
            QTest.qWait(5)

    def at(self, place: str) -> None:
        self.until(lambda: self.journey.place == place)

    def press(self, key: Qt.Key, widget: QWidget | None = None) -> None:
        """A key on a widget, or on the one that has the keyboard."""
        now: QWidget | None = self.desktop.shell.focusWidget()
        QTest.keyClick(widget or now or self.desktop.shell, key)

    def start_practice(self) -> None:
        """Choose the practice patient and press Enter."""
        journey = self.journey
        journey.patients.screen.refresh(PRACTICE_PATIENT)
        self.press(Qt.Key.Key_Return, journey.patients.screen.search)

    def take_picture(self) -> None:
        """Space as soon as the hand has been seen for half a second."""
        self.at("markers")
        markers, source = self.journey.markers.screen, self.journey.now.source
        assert source is not None
        feed = source.measuring.feed
        self.until(
            lambda: len(feed.recent_frames(RECENT_FRAMES)) == RECENT_FRAMES and markers.picture.image is not None
        )
        self.press(Qt.Key.Key_Space, markers.picture)
        self.until(lambda: markers.clicking is not None)

    def click_markers(self, pixel: FloatArray) -> None:
        """Click on pixels of the picture, in the order of the protocol, and start."""
        markers = self.journey.markers.screen
        for u, v in pixel:
            self.desktop.application.processEvents()  # what came or went beside the picture may still make it smaller
            spot: QPoint = markers.picture.to_screen(float(u), float(v)).toPoint()
            QTest.mouseMove(markers.picture, spot)
            QTest.mouseClick(markers.picture, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, spot)
        if markers.clicking is None or not markers.clicking.complete:
            raise CalibrationImpossible()
        self.until(markers.primary.isEnabled)
        self.press(Qt.Key.Key_Return)
        self.at("live")

    def record(self, repetitions: int, progress: Callable[[int], None] = lambda _: None) -> str:
        """Space; wait for so many repetitions; Space again. The session that is then reviewed."""
        live = self.journey.live.screen
        self.press(Qt.Key.Key_Space, live)
        self.until(lambda: live.recording.state == "recording")

        def enough() -> bool:
            progress(live.recording.repetitions)
            return live.recording.repetitions >= repetitions

        self.until(enough)
        self.press(Qt.Key.Key_Space, live)
        self.at("review")
        self.until(lambda: self.journey.review.screen.shown)
        return self.journey.now.session_id

    def tab(self, place: str) -> None:
        """Click a tab of the patient."""
        button = self.desktop.shell.bar.way()[TABS.index(place)]
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        self.at(place)

    def save_report(self, path: Path) -> None:
        """Make the report from the review and save it."""
        self.journey.review.screen.card.report_button.click()
        self.at("report")
        saved: list[str] = []
        self.journey.report.screen.saved.connect(saved.append)
        self.journey.report.screen.save(str(path))
        self.until(lambda: bool(saved))


def walk(settings: Settings, progress: Progress) -> Walked:
    """Walk the whole way on the practice patient; raises the first fault that the windows would tell."""
    settings = replace(settings, screen=ScreenSettings("light"), first_start=FirstStartSettings(answered=True))
    steps = StepLog(sys.stderr.isatty())
    stopping = threading.Event()
    on_stop(stopping.set)  # first of all: an exception out of the middle of a window's own work would be lost
    qInstallMessageHandler(_told_by_qt)
    qt = application(["carpus"])
    desktop = compose(qt, settings, is_demo=True)

    def show_progress(done: int, total: int) -> None:
        steps.update(done, total)
        progress(done, total)

    try:
        walker = Walker(desktop, stopping.is_set, steps.tick)
        desktop.show()
        walker.at("patients")
        desktop.journey.opener.progressed.connect(show_progress)
        steps.begin_step("simulating the camera's frames")
        walker.start_practice()
        walker.until(lambda: desktop.journey.place == "markers", patience_s=1800.0)
        set_up = desktop.journey.now.set_up
        assert set_up is not None
        steps.begin_step("clicking the markers")
        walker.take_picture()
        walker.click_markers(clicks_of(SimulatedPictures(practice_spec(set_up)).truth).pixel)
        steps.begin_step("simulating the rest of the frames")
        walker.until(lambda: is_cached(practice_spec(set_up)), patience_s=1800.0)  # here nobody sees the hand rest
        steps.begin_step("recording repetitions")
        session_id = walker.record(REPETITIONS, lambda done: show_progress(done, REPETITIONS))
        steps.begin_step("review, progress and report")
        walker.tab("progress")
        walker.tab("review")
        walker.until(lambda: desktop.journey.review.screen.shown)
        path = desktop.library.entry(session_id).path
        report = path.with_suffix(".pdf")
        walker.save_report(report)
        figures = desktop.library.figures(desktop.library.entry(session_id))
        return Walked(path, report, lines_of(figures))
    finally:
        desktop.close()


def _told_by_qt(_kind: object, _context: object, message: str) -> None:
    """What Qt has to say, but for what a platform without a screen cannot do for windows that have none."""
    if "does not support propagateSizeHints" not in message:
        sys.stderr.write(f"{message}\n")


def lines_of(figures: SessionFigures) -> list[str]:
    """The main figures of a session as plain lines."""
    quality = figures.quality
    shares = f"{written(100.0 * quality.measured_share, 1)} % measured, {quality.dropped} missing"
    lines = [f"Frames:  {quality.frames} in {written(figures.duration_s, 1)} s, {shares}"]
    lines.append(f"Repetitions: {figures.counted}")
    for row in figures.wrist_ranges:
        name = terms.movement_long_name(row.what)
        lines.append(f"{name}: {terms.end_words(row.mean, row.what, row.sd)}")
    for row in figures.joint_ranges:
        if row.what == "arc" and row.count:
            value = numbers.with_spread(row.mean, row.sd)
            value = f"at least {numbers.degrees(row.mean)}" if row.at_least else value
            lines.append(f"{figure_of(row.of).long_name}: {value}")
    return lines

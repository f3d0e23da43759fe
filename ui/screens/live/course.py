"""A running set of exercises: part after part, with rest in between."""

from __future__ import annotations

import math

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.records.session_setup import SessionSetup, next_part
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.picture.movement_guide import ExerciseSnapshot
from carpus.ui.screens.live.screen import LiveScreen
from carpus.ui.screens.patient.view_controller import PatientViewController
from carpus.ui.screens.setup.set_words import course_words
from carpus.ui.shell.current_selection import CurrentSelection

STOP_DELAY_S = 2.0
"""Recording continues after the last repetition, to include its return movement."""


class CourseRunner(QObject):
    """Ends each part, times the rest and shows what comes next.

    ``screen_requested`` asks for the live screen.
    """

    screen_requested = Signal()

    def __init__(
        self, parent: QObject, live: LiveScreen, patient: PatientViewController, now: CurrentSelection
    ) -> None:
        super().__init__(parent)
        self._live, self._patient, self._current = live, patient, now
        self._done_since_s = math.inf
        self._remaining_rest_s = self._rest_s = 0
        self._timer = QTimer(self, interval=1000)
        self._timer.timeout.connect(self._on_second)
        live.snapshot_taken.connect(self._update)

    @property
    def is_resting(self) -> bool:
        return self._remaining_rest_s > 0

    def start_part(self, set_up: SessionSetup) -> None:
        self._done_since_s = math.inf
        self._show_part(set_up)

    def advance(self) -> bool:
        """Show the next part after a recording; return False if there is none."""
        now = self._current
        following = next_part(now.set_up) if now.set_up is not None else None
        if now.set_up is None or following is None or now.source is None:
            self.end()
            return False
        measuring = now.source.measuring
        if measuring.is_playback:  # a stored recording shows one exercise
            self.end()
            return False
        assert now.set_up.set_run is not None
        self._rest_s = self._remaining_rest_s = now.set_up.set_run.part.rest_s
        measuring.set_exercise(following)
        now.set_up = following
        self.screen_requested.emit()
        if self._rest_s:
            self._timer.start()
            self._show_rest()
        return True

    def end(self) -> None:
        self._timer.stop()
        self._remaining_rest_s = 0
        self._live.recording.set_resting(resting=False)
        self._patient.show_rest(None)

    def _on_second(self) -> None:
        self._remaining_rest_s -= 1
        if self._remaining_rest_s <= 0:
            self.end()
        self._show_rest()

    def _show_rest(self) -> None:
        if self._current.set_up is not None:
            self._show_part(self._current.set_up)
            course = self._current.set_up.set_run
            self._live.recording.set_resting(resting=self.is_resting)
            if self.is_resting and course is not None:
                self._patient.show_rest((self._remaining_rest_s, self._rest_s, course.part_index, len(course.parts)))

    def _show_part(self, set_up: SessionSetup) -> None:
        course = set_up.set_run
        if course is None:
            self._live.show_course("")
            return
        words = course_words(course)
        if self.is_resting:
            rest = self.tr("Rest {time}. Press Space to start now.").format(
                time=numbers.format_clock(self._remaining_rest_s)
            )
            words = f"{rest} {words}. {translate_phrase(set_up.exercise.position)}"
        self._live.show_course(words)

    def _update(self, snapshot: ExerciseSnapshot) -> None:
        set_up = self._current.set_up
        course = set_up.set_run if set_up is not None else None
        if set_up is None or course is None or snapshot.state != "recording":
            return
        if self.is_resting:
            self.end()
            self._show_part(set_up)
        part = course.part
        if part.seconds and self._live.recording.duration_s >= part.seconds:
            self._live.recording.stop()
        elif part.repetitions:
            self._done_since_s = (
                min(self._done_since_s, snapshot.time_s) if snapshot.found_count >= part.repetitions else math.inf
            )
            if snapshot.time_s - self._done_since_s >= STOP_DELAY_S:
                self._live.recording.stop()

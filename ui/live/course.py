"""A set of exercises that runs: part after part, with rest between them."""

from __future__ import annotations

import math

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.records.set_up import SetUp, next_part
from carpus.ui import numbers
from carpus.ui.live.screen import LiveScreen
from carpus.ui.now_open import NowOpen
from carpus.ui.patient.guide import Glance
from carpus.ui.patient.viewing import PatientViewing
from carpus.ui.setup.set_words import course_words
from carpus.ui.translate import say

LINGER_S = 2.0
"""After the last repetition the recording goes on for so long: it has its way back."""


class CourseRun(QObject):
    """Ends each part by itself, keeps the rest, and says what comes next. ``wanted`` asks for the live screen."""

    wanted = Signal()

    def __init__(self, parent: QObject, live: LiveScreen, patient: PatientViewing, now: NowOpen) -> None:
        super().__init__(parent)
        self._live, self._patient, self._now = live, patient, now
        self._done_since_s = math.inf
        self._rest_left_s = self._rest_s = 0
        self._timer = QTimer(self, interval=1000)
        self._timer.timeout.connect(self._second)
        live.glanced.connect(self._follow)

    @property
    def resting(self) -> bool:
        return self._rest_left_s > 0

    def begun(self, set_up: SetUp) -> None:
        self._done_since_s = math.inf
        self._show(set_up)

    def goes_on(self) -> bool:
        """A recording is stored: whether the next part follows; it is shown then."""
        now = self._now
        following = next_part(now.set_up) if now.set_up is not None else None
        if now.set_up is None or following is None or now.source is None:
            self.end()
            return False
        measuring = now.source.measuring
        if measuring.starts_with_recording:  # a stored recording shows one exercise
            self.end()
            return False
        assert now.set_up.course is not None
        self._rest_s = self._rest_left_s = now.set_up.course.part.rest_s
        measuring.choose(following)
        now.set_up = following
        self.wanted.emit()
        if self._rest_s:
            self._timer.start()
            self._show_rest()
        return True

    def end(self) -> None:
        self._timer.stop()
        self._rest_left_s = 0
        self._live.recording.rest(on=False)
        self._patient.rest(None)

    def _second(self) -> None:
        self._rest_left_s -= 1
        if self._rest_left_s <= 0:
            self.end()
        self._show_rest()

    def _show_rest(self) -> None:
        if self._now.set_up is not None:
            self._show(self._now.set_up)
            course = self._now.set_up.course
            self._live.recording.rest(on=self.resting)
            if self.resting and course is not None:
                self._patient.rest((self._rest_left_s, self._rest_s, course.number, len(course.parts)))

    def _show(self, set_up: SetUp) -> None:
        course = set_up.course
        if course is None:
            self._live.show_course("")
            return
        words = course_words(course)
        if self.resting:
            rest = self.tr("Rest {time}; Space begins at once.").format(time=numbers.clock(self._rest_left_s))
            words = f"{rest} {words}. {say(set_up.exercise.position)}"
        self._live.show_course(words)

    def _follow(self, glance: Glance) -> None:
        set_up = self._now.set_up
        course = set_up.course if set_up is not None else None
        if set_up is None or course is None or glance.state != "recording":
            return
        if self.resting:
            self.end()
            self._show(set_up)
        part = course.part
        if part.seconds and self._live.recording.recorded_s >= part.seconds:
            self._live.recording.stop()
        elif part.repetitions:
            self._done_since_s = min(self._done_since_s, glance.at_s) if glance.found >= part.repetitions else math.inf
            if glance.at_s - self._done_since_s >= LINGER_S:
                self._live.recording.stop()

"""Curves of the review, and the player below them."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QWidget

from carpus.core.results.repetition_rows import RepetitionResult
from carpus.ui.charts.session import HandPlot, SessionChart, SessionPlot
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, KeyCaps
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, row_layout
from carpus.ui.kit.text import MEDIUM, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.playback_controls import PlaybackClock, PlaybackControls, TimeSlider, clock_words
from carpus.ui.screens.review.reviewed_session import ReviewedSession
from carpus.ui.words.finger_angles import FINGERS, find_finger_angle
from carpus.ui.words.marker_words import finger_name

# Instead of a finger's number: the three wrist angles.
WRIST = -1


class ReviewCharts(QWidget):
    """Emits ``finger_chosen``."""

    finger_chosen = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        fingers: list[tuple[object, str]] = [(0, self.tr("All fingers"))]
        fingers += [(finger, finger_name(str(finger))) for finger in FINGERS]
        self.finger = ChoiceRow(theme, [*fingers, (WRIST, self.tr("Wrist"))])
        self.finger.hide()  # until a session of the whole hand is shown
        for button in self.finger.buttons():
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click must leave Space and the arrows to the player
        self.curves = SessionChart(theme)
        self._column = column_layout(self.finger, gap=8, margins=(0, 0, 0, 0), parent=self)
        fill(self._column, (self.curves, 1))
        self.finger.chosen.connect(lambda _: self.finger_chosen.emit())

    @property
    def finger_number(self) -> int:
        """Chosen finger, 0 for all, :data:`WRIST` for the wrist."""
        value = self.finger.value()
        return value if isinstance(value, int) else 0

    def fit(self, reviewed: ReviewedSession | None, *, above: QBoxLayout | None) -> bool:
        """Show fewer panels for large text; return True if another finger had to be chosen."""
        tight, place = above is not None, above or self._column
        self.curves.show_single(tight)
        if place.indexOf(self.finger) < 0:
            place.insertWidget(0, self.finger)
        self.finger.buttons()[0].setVisible(not tight)
        if tight and reviewed is not None and reviewed.is_hand and self.finger_number == 0:
            self.finger.choose(find_finger_angle(reviewed.results.exercise.joint).finger)  # five panels have no room
            return True
        return False

    def show_plot(self, reviewed: ReviewedSession, current: int) -> SessionPlot:
        """Show the angles of the wrist or of the chosen finger."""
        shown = (reviewed.curves, reviewed.results.exercise, reviewed.results.repetitions, current)
        plot: SessionPlot
        if reviewed.joints is not None and self.finger_number != WRIST:
            plot = HandPlot(*shown, joints=reviewed.joints, finger=self.finger_number)
        else:
            plot = SessionPlot(*shown, *reviewed.results.targets_deg)
        self.curves.show_plot(plot)
        return plot


class Player(Card):
    """Emits ``repetition_requested``."""

    repetition_requested = Signal()

    def __init__(self, theme: Theme, playing: PlaybackClock) -> None:
        super().__init__(theme, 0)
        self._end_s = 1.0
        self.transport = PlaybackControls(theme, playing)
        self.hints = KeyCaps(theme, [(self.tr("Space"), self.tr("play"))])
        self.repetition_button = Button(theme, self.tr("Repetition…"), "quiet", hint="X", height_px=40)
        self.repetition_button.setToolTip(
            self.tr("Mark as passive or excluded (X). [ and ] select another repetition.")
        )
        self.repetition_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.time = Text(theme, "", 14, MEDIUM)
        self.scrubber = TimeSlider(theme)
        row = row_layout(
            self.transport,
            8,
            self.hints,
            self.repetition_button,
            STRETCH,
            self.time,
            8,
            (self.scrubber, 6),
            8,
            KeyCaps(theme, [("← →", self.tr("frame"))]),
            gap=4,
            margins=(12, 7, 16, 7),
        )
        self.body.addLayout(row)
        self.repetition_button.clicked.connect(self.repetition_requested)
        self.scrubber.time_chosen.connect(playing.set_time)
        playing.time_changed.connect(self._show_time)

    def show_session(self, end_s: float, repetitions: Sequence[RepetitionResult], current: int) -> None:
        self._end_s = end_s
        self.scrubber.show_session(end_s, repetitions, current)

    def show_nothing(self) -> None:
        self.show_session(0.0, (), -1)
        self._show_time(0.0)

    def _show_time(self, time_s: float) -> None:
        self.time.setText(clock_words(time_s, self._end_s))
        self.scrubber.show_time(time_s)

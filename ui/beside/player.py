"""One player for two sessions: step, play, speed, how they are kept in step, and a track for each."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QGridLayout, QWidget

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.ui import numbers
from carpus.ui.beside.words import step_words
from carpus.ui.controls.button import Button, icon_button
from carpus.ui.controls.card import Card
from carpus.ui.controls.key_caps import KeyCaps
from carpus.ui.controls.layouts import in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, Text
from carpus.ui.review.player import SPEEDS, Scrubber
from carpus.ui.theme import Theme


class BesidePlayer(Card):
    """Emits ``stepped`` (pictures), ``play_toggled``, ``step_chosen``, and ``sought`` with which of the two was pointed
    at (0 or 1) and a time in it."""

    stepped = Signal(int)
    play_toggled = Signal()
    step_chosen = Signal(str)
    sought = Signal(int, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 0)
        self._speed = 2
        self.back = icon_button(theme, "step-back", self.tr("Previous picture (←)"))
        self.play = icon_button(theme, "play", self.tr("Play (Space)"), "well")
        self.on = icon_button(theme, "step-forward", self.tr("Next picture (→)"))
        self.speed = Button(theme, "", "quiet", height_px=40)
        self.step_name = Text(theme, self.tr("In step by"), 14, REGULAR, "text2")
        self.step = QComboBox()
        self.step.setAccessibleName(self.tr("In step by"))
        self.step.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        for value, words in step_words():
            self.step.addItem(words, value)
        for widget in (self.step, self.back, self.play, self.on, self.speed):
            widget.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        self.names = (Text(theme, "", 14, REGULAR, "text2"), Text(theme, "", 14, REGULAR, "text2"))
        self.tracks = (Scrubber(theme), Scrubber(theme))
        self.times = (Text(theme, "", 14, MEDIUM), Text(theme, "", 14, MEDIUM))
        self.hints = KeyCaps(theme, [("[ ]", self.tr("repetition"))])
        tracks = QGridLayout()
        tracks.setContentsMargins(0, 0, 0, 0)
        tracks.setHorizontalSpacing(12)
        tracks.setVerticalSpacing(0)
        for line in (0, 1):
            name, track, clock = self.names[line], self.tracks[line], self.times[line]
            track.setFixedHeight(22)
            track.sought.connect(lambda time_s, line=line: self.sought.emit(line, time_s))
            tracks.addWidget(name, line, 0)
            tracks.addWidget(track, line, 1)
            tracks.addWidget(clock, line, 2)
        tracks.setColumnStretch(1, 1)
        self.body.addLayout(
            in_line(
                self.back,
                self.play,
                self.on,
                4,
                self.speed,
                8,
                self.step_name,
                4,
                self.step,
                16,
                (tracks, 1),
                12,
                self.hints,
                gap=4,
                margins=(12, 4, 16, 4),
            )
        )
        self.back.clicked.connect(lambda: self.stepped.emit(-1))
        self.on.clicked.connect(lambda: self.stepped.emit(1))
        self.play.clicked.connect(self.play_toggled)
        self.speed.clicked.connect(self._next_speed)
        self.step.currentIndexChanged.connect(lambda _: self.step_chosen.emit(str(self.step.currentData())))
        self._show_speed()

    @property
    def factor(self) -> float:
        """How fast time passes while playing."""
        return SPEEDS[self._speed][0]

    def show_tight(self, tight: bool) -> None:
        """Large text: fewer words."""
        for shown in (self.hints, self.step_name):
            shown.setVisible(not tight)

    def show_sessions(
        self, names: Sequence[str], ends_s: Sequence[float], repetitions: Sequence[Sequence[ShownRepetition]]
    ) -> None:
        """Names, lengths and repetitions of both."""
        for line in (0, 1):
            self.names[line].setText(names[line])
            self.tracks[line].show_session(max(ends_s[line], 1e-3), repetitions[line], -1)
            self.tracks[line].setAccessibleName(self.tr("Time in the session: {name}").format(name=names[line]))

    def show_places(
        self, times_s: Sequence[float], currents: Sequence[int], ends_s: Sequence[float],
        repetitions: Sequence[Sequence[ShownRepetition]],
    ) -> None:  # fmt: skip
        """Where both are."""
        for line in (0, 1):
            self.times[line].setText(numbers.clock_tenths(times_s[line]))
            self.tracks[line].show_session(max(ends_s[line], 1e-3), repetitions[line], currents[line])
            self.tracks[line].show_time(times_s[line])

    def show_playing(self, playing: bool) -> None:
        """The button's face."""
        self.play.set_face("", icon="pause" if playing else "play")
        self.play.setAccessibleName(self.tr("Stop") if playing else self.tr("Play"))

    def first(self) -> QWidget:
        """Its first control."""
        return self.play

    def _next_speed(self) -> None:
        self._speed = (self._speed + 1) % len(SPEEDS)
        self._show_speed()

    def _show_speed(self) -> None:
        self.speed.set_face(self.tr("{factor}× speed").format(factor=SPEEDS[self._speed][1]))

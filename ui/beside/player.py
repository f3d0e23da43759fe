"""One player for two sessions: step, play, speed, how they are kept in step, and a track for each."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QGridLayout

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.ui import numbers
from carpus.ui.beside.words import step_words
from carpus.ui.controls.card import Card, KeyCaps
from carpus.ui.controls.layouts import in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, Text
from carpus.ui.playback.playing import Playing
from carpus.ui.playback.transport import Scrubber, Transport
from carpus.ui.theme import Theme


class BesidePlayer(Card):
    """``step_chosen`` carries how both are kept in step, ``sought`` which of the two was pointed at (0 or 1) and a time
    in it."""

    step_chosen = Signal(str)
    sought = Signal(int, float)

    def __init__(self, theme: Theme, playing: Playing) -> None:
        super().__init__(theme, 0)
        self.transport = Transport(theme, playing, 4)
        self._step_name = Text(theme, self.tr("In step by"), 14, REGULAR, "text2")
        self.step = QComboBox()
        self.step.setAccessibleName(self.tr("In step by"))
        self.step.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.step.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        for value, words in step_words():
            self.step.addItem(words, value)
        self._names = (Text(theme, "", 14, REGULAR, "text2"), Text(theme, "", 14, REGULAR, "text2"))
        self.tracks = (Scrubber(theme), Scrubber(theme))
        self._times = (Text(theme, "", 14, MEDIUM), Text(theme, "", 14, MEDIUM))
        self._hints = KeyCaps(theme, [("[ ]", self.tr("repetition"))])
        line = in_line(self.transport, 8, self._step_name, 4, self.step, 16, gap=4, margins=(12, 4, 16, 4))
        line.addLayout(self._both_tracks(), 1)
        line.addSpacing(12)
        line.addWidget(self._hints)
        self.body.addLayout(line)
        self.step.currentIndexChanged.connect(lambda _: self.step_chosen.emit(str(self.step.currentData())))

    def _both_tracks(self) -> QGridLayout:
        grid = QGridLayout()
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(0)
        for line, track in enumerate(self.tracks):
            track.setFixedHeight(22)
            track.sought.connect(lambda time_s, line=line: self.sought.emit(line, time_s))
            for column, widget in enumerate((self._names[line], track, self._times[line])):
                grid.addWidget(widget, line, column)
        grid.setColumnStretch(1, 1)
        return grid

    def show_tight(self, tight: bool) -> None:
        for shown in (self._hints, self._step_name):
            shown.setVisible(not tight)

    def show_names(self, names: Sequence[str]) -> None:
        for line, name in enumerate(names):
            self._names[line].setText(name)
            self.tracks[line].setAccessibleName(self.tr("Time in the session: {name}").format(name=name))

    def show_places(
        self, times_s: Sequence[float], currents: Sequence[int], ends_s: Sequence[float],
        repetitions: Sequence[Sequence[ShownRepetition]],
    ) -> None:  # fmt: skip
        for line, track in enumerate(self.tracks):
            self._times[line].setText(numbers.clock_tenths(times_s[line]))
            track.show_session(max(ends_s[line], 1e-3), repetitions[line], currents[line])
            track.show_time(times_s[line])

"""The strip between picture and table: step, play, speed, what is drawn, and the line of time."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, KeyCaps
from carpus.ui.controls.layouts import STRETCH, in_line
from carpus.ui.controls.text import MEDIUM, Text
from carpus.ui.playback.playing import Playing
from carpus.ui.playback.transport import Scrubber, Transport, clock_words
from carpus.ui.theme import Theme


class Player(Card):
    """``view_chosen`` carries what is to be drawn; ``repetition_wanted`` asks what the current repetition is."""

    view_chosen = Signal(str)
    repetition_wanted = Signal()

    def __init__(self, theme: Theme, playing: Playing) -> None:
        super().__init__(theme, 0)
        self._research = True
        self._end_s = 1.0
        self.transport = Transport(theme, playing)
        self.view = QComboBox()
        self.view.setAccessibleName(self.tr("What is drawn"))
        self.view.setToolTip(self.tr("What is drawn of the movement (V)"))
        self.view.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.view.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        for value, words in (
            ("angles", self.tr("Angles")), ("path", self.tr("Path")), ("place", self.tr("Place, speed")),
            ("zyz", self.tr("ZYZ")),
        ):  # fmt: skip
            self.view.addItem(words, value)
        self.view_key = KeyCaps(theme, [("V", "")])
        self.hints = KeyCaps(theme, [(self.tr("Space"), self.tr("play"))])
        self.repetition = Button(theme, self.tr("Repetition…"), "quiet", hint="X", height_px=40)
        self.repetition.setToolTip(self.tr("Passive, or left out (X); [ and ] go to another"))
        self.repetition.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.time = Text(theme, "", 14, MEDIUM)
        self.scrubber = Scrubber(theme)
        row = in_line(
            self.transport,
            8,
            self.view,
            4,
            self.view_key,
            12,
            self.hints,
            self.repetition,
            STRETCH,
            self.time,
            8,
            (self.scrubber, 6),
            8,
            KeyCaps(theme, [("← →", self.tr("picture"))]),
            gap=4,
            margins=(12, 7, 16, 7),
        )
        self.body.addLayout(row)
        self.repetition.clicked.connect(self.repetition_wanted)
        self.view.currentIndexChanged.connect(lambda _: self.view_chosen.emit(self.view.currentData()))
        self.scrubber.sought.connect(playing.seek)
        playing.moved.connect(self._show_time)

    def next_view(self) -> None:
        """Something else is drawn of the movement."""
        if not self._research:
            return
        self.view.setCurrentIndex((self.view.currentIndex() + 1) % self.view.count())

    def show_research(self, *, on: bool) -> None:
        """Paths, places, speeds and ZYZ beside the angles, or these alone."""
        self._research = on
        if not on:
            self.view.setCurrentIndex(0)
        for shown in (self.view, self.view_key):
            shown.setVisible(on)

    def show_session(self, end_s: float, repetitions: Sequence[ShownRepetition], current: int) -> None:
        self._end_s = end_s
        self.scrubber.show_session(end_s, repetitions, current)

    def _show_time(self, time_s: float) -> None:
        self.time.setText(clock_words(time_s, self._end_s))
        self.scrubber.show_time(time_s)

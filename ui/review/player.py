"""The strip between picture and table: step, play, speed, time, and a scrubber with the repetitions."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QComboBox, QSizePolicy, QWidget

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.ui import numbers
from carpus.ui.controls.button import Button, icon_button
from carpus.ui.controls.card import Card
from carpus.ui.controls.key_caps import KeyCaps
from carpus.ui.controls.layouts import STRETCH, in_line
from carpus.ui.controls.text import MEDIUM, Text
from carpus.ui.theme import Theme

SPEEDS = ((0.25, "¼"), (0.5, "½"), (1.0, "1"), (2.0, "2"))


class Player(Card):
    """Emits ``stepped`` (frames), ``play_toggled`` and ``sought`` (seconds)."""

    stepped = Signal(int)
    play_toggled = Signal()
    sought = Signal(float)
    view_chosen = Signal(str)
    repetition_wanted = Signal()

    def __init__(self, theme: Theme, *, plays: bool = True) -> None:
        """``plays``: whether it can be played, not only stepped through."""
        super().__init__(theme, 0)
        self._research, self._plays = True, plays
        self._end_s = 1.0
        self._speed = 2
        self.back = icon_button(theme, "step-back", self.tr("Previous picture (←)"))
        self.play = icon_button(theme, "play", self.tr("Play (Space)"), "well")
        self.on = icon_button(theme, "step-forward", self.tr("Next picture (→)"))
        self.speed = Button(theme, "", "quiet", height_px=40)
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
            self.back,
            self.play,
            self.on,
            8,
            self.speed,
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
            gap=4,
            margins=(12, 7, 16, 7),
        )
        self.picture_hint = KeyCaps(theme, [("← →", self.tr("picture"))])
        row.addWidget(self.picture_hint)
        for shown in (self.play, self.speed, self.view, self.view_key, self.hints, self.repetition, self.picture_hint):
            shown.setVisible(plays)
        self.body.addLayout(row)
        self.back.clicked.connect(lambda: self.stepped.emit(-1))
        self.on.clicked.connect(lambda: self.stepped.emit(1))
        self.play.clicked.connect(self.play_toggled)
        self.speed.clicked.connect(self._next_speed)
        self.repetition.clicked.connect(self.repetition_wanted)
        self.view.currentIndexChanged.connect(lambda _: self.view_chosen.emit(self.view.currentData()))
        self.scrubber.sought.connect(self.sought)
        self._show_speed()

    @property
    def factor(self) -> float:
        """How fast time passes while playing."""
        return SPEEDS[self._speed][0]

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
            shown.setVisible(on and self._plays)

    def show_session(self, end_s: float, repetitions: Sequence[ShownRepetition], current: int) -> None:
        """Length and repetitions."""
        self._end_s = end_s
        self.scrubber.show_session(end_s, repetitions, current)

    def show_time(self, time_s: float) -> None:
        """Where the cursor is."""
        whole = numbers.clock(self._end_s + 0.5)
        self.time.setText(self.tr("{time} of {whole}").format(time=numbers.clock_tenths(time_s), whole=whole))
        self.scrubber.show_time(time_s)

    def show_playing(self, playing: bool) -> None:
        """The button's face."""
        self.play.set_face("", icon="pause" if playing else "play")
        self.play.setAccessibleName(self.tr("Stop") if playing else self.tr("Play"))

    def _next_speed(self) -> None:
        self._speed = (self._speed + 1) % len(SPEEDS)
        self._show_speed()

    def _show_speed(self) -> None:
        self.speed.set_face(self.tr("{factor}× speed").format(factor=SPEEDS[self._speed][1]))


class Scrubber(QWidget):
    """A line of time with a knob; repetitions are blocks, left-out ones are open."""

    sought = Signal(float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._end_s, self._time_s = 1.0, 0.0
        self._repetitions: tuple[ShownRepetition, ...] = ()
        self._current = -1
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName(self.tr("Time in the session"))

    def show_session(self, end_s: float, repetitions: Sequence[ShownRepetition], current: int) -> None:
        """Set what is drawn."""
        self._end_s, self._repetitions, self._current = end_s, tuple(repetitions), current
        self.update()

    def show_time(self, time_s: float) -> None:
        """Move the knob."""
        self._time_s = time_s
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(480, 40)

    def minimumSizeHint(self) -> QSize:
        return QSize(120, 32)

    def _x(self, time_s: float) -> float:
        return 10 + (self.width() - 20) * min(max(time_s / self._end_s, 0.0), 1.0)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.mouseMoveEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if event.buttons() & Qt.MouseButton.LeftButton:
            share = (event.position().x() - 10) / max(self.width() - 20, 1)
            self.sought.emit(min(max(share, 0.0), 1.0) * self._end_s)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        color, middle = self._theme.color, self.height() / 2
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color("sunken"))
        painter.drawRoundedRect(QRectF(10, middle - 4, self.width() - 20, 8), 4, 4)
        for number, repetition in enumerate(self._repetitions):
            left, right = self._x(repetition.start_s), self._x(repetition.end_s)
            block = QRectF(left + 1, middle - 4, max(right - left - 2, 1), 8)
            if repetition.counts:
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(color("accent" if number == self._current else "border"))
            else:
                painter.setPen(QPen(color("border"), 1))
                painter.setBrush(color("surface"))
            painter.drawRoundedRect(block, 2, 2)
        painter.setPen(QPen(color("text"), 2.5))
        painter.setBrush(color("surface"))
        painter.drawEllipse(QPointF(self._x(self._time_s), middle), 9, 9)

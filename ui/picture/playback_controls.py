"""Playback of a recording: clock, buttons, time slider."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QObject, QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.results.repetition_rows import RepetitionResult
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button, icon_button
from carpus.ui.kit.layouts import row_layout
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr

SPEEDS = ((0.25, "¼"), (0.5, "½"), (1.0, "1"), (2.0, "2"))


class PlaybackControls(QWidget):
    """Buttons for one frame back or forward (``stepped``); with a clock also play, stop and speed."""

    stepped = Signal(int)

    def __init__(self, theme: Theme, playing: PlaybackClock | None = None, before_speed_px: int = 8) -> None:
        super().__init__()
        back = icon_button(theme, "step-back", self.tr("Previous frame (←)"))
        on = icon_button(theme, "step-forward", self.tr("Next frame (→)"))
        parts: list[Button | int] = [back, on]
        if playing is not None:
            self._play_button = icon_button(theme, "play", self.tr("Play (Space)"), "well")
            self._speed_button = Button(theme, "", "quiet", height_px=40)
            parts = [back, self._play_button, on, before_speed_px, self._speed_button]
            self._play_button.clicked.connect(playing.toggle)
            playing.playing_changed.connect(self._show_playing)
            self._speed_button.clicked.connect(lambda: self._show_speed(playing, self._speed_index + 1))
            self._show_speed(playing, 2)
        for part in parts:
            if isinstance(part, Button):
                part.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the screen
        row_layout(*parts, gap=4, margins=(0, 0, 0, 0), parent=self)
        back.clicked.connect(lambda: self.stepped.emit(-1))
        on.clicked.connect(lambda: self.stepped.emit(1))

    def _show_playing(self, playing: bool) -> None:
        self._play_button.set_label("", icon="pause" if playing else "play")
        self._play_button.setAccessibleName(self.tr("Stop") if playing else self.tr("Play"))

    def _show_speed(self, playing: PlaybackClock, number: int) -> None:
        self._speed_index = number % len(SPEEDS)
        playing.factor, words = SPEEDS[self._speed_index]
        self._speed_button.set_label(self.tr("{factor}× speed").format(factor=words))


def clock_words(time_s: float, end_s: float) -> str:
    """Format a time and the whole duration: ``00:12.0 of 00:41``."""
    whole = numbers.format_clock(end_s + 0.5)
    return tr("{time} of {whole}").format(time=numbers.format_clock_tenths(time_s), whole=whole)


class TimeSlider(QWidget):
    """Time slider with repetitions as blocks; excluded ones are outlined."""

    time_chosen = Signal(float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._end_s, self._time_s = 1.0, 0.0
        self._repetitions: tuple[RepetitionResult, ...] = ()
        self._current = -1
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName(self.tr("Time in the session"))

    def show_session(self, end_s: float, repetitions: Sequence[RepetitionResult], current: int) -> None:
        self._end_s, self._repetitions, self._current = end_s, tuple(repetitions), current
        self.update()

    def show_time(self, time_s: float) -> None:
        self._time_s = time_s
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(480, 40)

    def minimumSizeHint(self) -> QSize:
        return QSize(120, 32)

    def _x(self, time_s: float) -> float:
        share = time_s / self._end_s if self._end_s > 0.0 else 0.0
        return 10 + (self.width() - 20) * min(max(share, 0.0), 1.0)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.mouseMoveEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if event.buttons() & Qt.MouseButton.LeftButton:
            share = (event.position().x() - 10) / max(self.width() - 20, 1)
            self.time_chosen.emit(min(max(share, 0.0), 1.0) * self._end_s)

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
            if repetition.is_counted:
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(color("accent" if number == self._current else "border"))
            else:
                painter.setPen(QPen(color("border"), 1))
                painter.setBrush(color("surface"))
            painter.drawRoundedRect(block, 2, 2)
        painter.setPen(QPen(color("text"), 2.5))
        painter.setBrush(color("surface"))
        painter.drawEllipse(QPointF(self._x(self._time_s), middle), 9, 9)


PLAY_STEP_MS = 40


class PlaybackClock(QObject):
    """Clock of the playback; ``playing_changed`` carries whether it runs."""

    time_changed = Signal(float)
    playing_changed = Signal(bool)

    def __init__(self, owner: QObject) -> None:
        super().__init__(owner)
        self.time_s = 0.0
        self.end_s = -1.0
        """Duration of the recording; below 0 without one."""
        self.factor = 1.0
        self._timer = QTimer(self, interval=PLAY_STEP_MS)
        self._timer.timeout.connect(self._advance)

    def open(self, end_s: float) -> None:
        """Stop, and set another recording; -1 while that is read."""
        self.stop()
        self.end_s = end_s

    def set_time(self, time_s: float) -> None:
        if self.end_s >= 0.0:
            self.time_s = min(max(time_s, 0.0), self.end_s)
            self.time_changed.emit(self.time_s)

    def toggle(self) -> None:
        if self._timer.isActive():
            self.stop()
        elif self.end_s >= 0.0:
            if self.time_s >= self.end_s - 1e-3:
                self.set_time(0.0)
            self._timer.start()
            self.playing_changed.emit(True)

    def stop(self) -> None:
        self._timer.stop()
        self.playing_changed.emit(False)

    def _advance(self) -> None:
        self.set_time(self.time_s + 0.001 * PLAY_STEP_MS * self.factor)
        if self.time_s >= self.end_s - 1e-6:
            self.stop()

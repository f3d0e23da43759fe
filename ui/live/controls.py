"""The bar below the live screen: what the camera sees, notes, pause, and the one button that matters."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.records.set_up import next_part
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Surface
from carpus.ui.controls.layouts import fill, in_line
from carpus.ui.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.icons import paint_state
from carpus.ui.live.light import Lamp
from carpus.ui.live.recording import Recording
from carpus.ui.theme import MARGIN_PX, Theme


class Controls(Surface):
    """Shows how the recording stands; buttons take no keyboard, for the space bar (or the pedal that sends it) stops
    whatever has it."""

    def __init__(self, theme: Theme, recording: Recording) -> None:
        super().__init__(theme)
        self._recording, self._tight = recording, False
        self.light = LightView(theme)
        self.note = Button(theme, self.tr("Note"), "quiet", icon="notebook-pen", hint="F5")
        self.pain = Button(theme, self.tr("Pain"), "quiet", hint="F6")
        self.pause = Button(theme, self.tr("Pause"), icon="pause", hint="F7", height_px=52)
        self.main = Button(theme, "", "primary", height_px=56)
        row = in_line(
            (self.light, 1), 8, self.note, self.pain, 8, self.pause, gap=4, margins=(0, 0, MARGIN_PX, 0), within=self
        )
        fill(row, 12, self.main)
        for button in (self.note, self.pain, self.pause, self.main):
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        recording.changed.connect(self.refresh)

    def fit(self, *, tight: bool, large: bool) -> None:
        """With large text on a small screen hints give way; beside one large figure all buttons but one, whose keys go
        on working."""
        self._tight = tight
        for button, hint in ((self.note, "F5"), (self.pain, "F6"), (self.pause, "F7")):
            button.setVisible(not large)
            button.set_face(button.text(), hint="" if tight else hint)
        self.refresh()

    def begin(self) -> None:
        self.pain.set_face(self.tr("Pain"), icon="")

    def noted_pain(self, score: int) -> None:
        self.pain.set_face(self.tr("Pain {score} noted").format(score=score), icon="check")

    def say_storing(self, words: str = "") -> None:
        """It was stopped: that it is stored, or how long it takes until all that waits is tracked."""
        self.main.set_face(words or self.tr("Storing…"), icon="", hint="")

    def refresh(self) -> None:
        recording = self._recording
        state = recording.state
        runs = state != "off" and not recording.storing  # what is stopped takes no more notes
        self.note.set_face(self.tr("Passive") if recording.passive else self.tr("Note"))
        self.note.setEnabled(runs)
        self.pain.setEnabled(runs)
        self.pause.setEnabled(runs and not recording.camera_lost)  # nothing can go on without pictures
        paused = state == "paused" and not recording.camera_lost
        self.pause.set_face(self.tr("Go on") if paused else self.tr("Pause"), icon="play" if paused else "pause")
        self.main.setEnabled(not recording.storing)
        if recording.under_way:
            return
        words = self.tr("Play and record") if recording.plays else self.tr("Record")
        if runs:
            follows = recording.set_up is not None and next_part(recording.set_up) is not None
            words = self.tr("Stop and go on") if follows else self.tr("Stop and review")
        elif recording.left_s:
            words = self.tr("Starts in {seconds}: not yet").format(seconds=recording.left_s)
        hint = self.tr("Space") if self._tight else self.tr("Space · pedal")
        self.main.set_face(words, icon="square" if runs else "", hint=hint)


HEIGHT_PX = 72
BANDS = {
    "good": ("good_soft", "good", "text", "good", "good_soft"),
    "warn": ("band_warn", "on_band_warn", "on_band_warn", "on_band_warn", "band_warn"),
    "bad": ("band_bad", "on_band_bad", "on_band_bad", "on_band_bad", "band_bad"),
    "idle": ("sunken", "text2", "text2", "border", "sunken"),
}
"""Ground, state word, remedy, icon body, icon sign."""


def _fitting(text: str, size: float, least: float, weight: int, room: float) -> QFont:
    """The largest font down to the unscaled size with which a text fits: it must be read whole."""
    while size > least and QFontMetricsF(font(size, weight)).horizontalAdvance(text) > room:
        size -= 1
    return font(size, weight)


class LightView(QWidget):
    """Shows a :class:`Lamp`."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.lamp = Lamp("idle", "", "")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_lamp(self, lamp: Lamp) -> None:
        """Change what is shown; screen readers get both lines."""
        if lamp != self.lamp:
            self.lamp = lamp
            self.setAccessibleName(f"{lamp.state}. {lamp.remedy}")
            self.update()

    def sizeHint(self) -> QSize:
        return QSize(620, self._theme.px(HEIGHT_PX))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        color, scale = self._theme.color, self._theme.text_scale
        ground, word, remedy, body, sign = BANDS[self.lamp.rank]
        painter.fillRect(self.rect(), color(ground))
        size = 36 * scale
        icon = QRectF(34, (self.height() - size) / 2, size, size)
        paint_state(painter, "open" if self.lamp.rank == "idle" else self.lamp.rank, icon, color(body), color(sign))
        left = icon.right() + 18
        room = self.width() - left - 12
        state_face = _fitting(self.lamp.state, 28 * scale, 22, SEMIBOLD, room)
        remedy_face = _fitting(self.lamp.remedy, 20 * scale, 16, MEDIUM, room)
        state_width = QFontMetricsF(state_face).horizontalAdvance(self.lamp.state)
        remedy_width = QFontMetricsF(remedy_face).horizontalAdvance(self.lamp.remedy)
        beside = left + state_width + 18 + remedy_width <= self.width() - 12
        middle = self.height() / 2
        baseline = middle + 10 * scale if beside else middle - 3 * scale
        remedy_at = QPointF(left + state_width + 18, baseline) if beside else QPointF(left, middle + 24 * scale)
        if not beside and remedy_width > room:  # what is to be done is read whole, on two lines
            large, high = QFontMetricsF(state_face), 2 * QFontMetricsF(remedy_face).lineSpacing()
            baseline = middle - (large.height() + high) / 2 + large.ascent()
            below = QRectF(left, baseline + large.descent(), room, high)
        else:
            below = QRectF()
        painter.setFont(state_face)
        painter.setPen(color(word))
        painter.drawText(QPointF(left, baseline), self.lamp.state)
        painter.setFont(remedy_face)
        painter.setPen(color(remedy))
        if below.isEmpty():
            painter.drawText(remedy_at, self.lamp.remedy)
        else:
            painter.drawText(below, int(Qt.TextFlag.TextWordWrap), self.lamp.remedy)

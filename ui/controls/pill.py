"""The recording pill: told by shape, word, colour and time at once."""

from __future__ import annotations

from typing import Literal

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui import numbers
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.theme import Theme

PillState = Literal["off", "recording", "paused"]


class RecordingPill(QWidget):
    """Hidden while nothing is recorded; as wide whatever the time. ``resized`` when it needs other room."""

    resized = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._state: PillState = "off"
        self._text = ""
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.hide()

    def show_state(self, state: PillState, seconds: float) -> None:
        """Set state and recorded time."""
        pattern = self.tr("Recording {time}") if state == "recording" else self.tr("Paused at {time}")
        text = pattern.format(time=numbers.clock(seconds)) if state != "off" else ""
        if (state, text) != (self._state, self._text):
            resize = state != self._state or len(text) != len(self._text)
            self._state, self._text = state, text
            self.setAccessibleName(text)
            self.setVisible(state != "off")
            if resize:
                self.updateGeometry()
                self.resized.emit()
            self.update()

    @property
    def state(self) -> PillState:
        """What is shown."""
        return self._state

    def sizeHint(self) -> QSize:
        width = QFontMetricsF(font(20 * self._theme.text_scale, SEMIBOLD)).horizontalAdvance(self._text)
        return QSize(round(width) + 54, self._theme.px(40))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        box = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        recording = self._state == "recording"
        color = self._theme.color
        painter.setPen(Qt.PenStyle.NoPen if recording else QPen(color("text"), 1.5))
        painter.setBrush(color("band_bad") if recording else color("surface"))
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        sign = color("on_band_bad") if recording else color("text")
        middle = box.center().y()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(sign)
        if recording:
            painter.drawEllipse(QPointF(22, middle), 6.5, 6.5)
        else:
            painter.drawRect(QRectF(17, middle - 6, 3, 12))
            painter.drawRect(QRectF(24, middle - 6, 3, 12))
        painter.setPen(sign)
        painter.setFont(font(20 * self._theme.text_scale, SEMIBOLD))
        painter.drawText(QRectF(36, 0, self.width(), self.height()), int(Qt.AlignmentFlag.AlignVCenter), self._text)

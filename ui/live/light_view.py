"""The tracking light as a wide band: icon, state in 28 px, remedy in 20 px."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.ui.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.icons import paint_state
from carpus.ui.live.light import Lamp
from carpus.ui.theme import Theme

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
        state_at = QPointF(left, middle + 10 * scale if beside else middle - 3 * scale)
        remedy_at = QPointF(left + state_width + 18, state_at.y()) if beside else QPointF(left, middle + 24 * scale)
        painter.setFont(state_face)
        painter.setPen(color(word))
        painter.drawText(state_at, self.lamp.state)
        painter.setFont(remedy_face)
        painter.setPen(color(remedy))
        room = self.width() - remedy_at.x() - 8
        painter.drawText(
            remedy_at, QFontMetricsF(remedy_face).elidedText(self.lamp.remedy, Qt.TextElideMode.ElideRight, room)
        )

"""One marker of the picture in the list: its name, and how far it is from where the others expect it."""

from __future__ import annotations

import math

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QKeyEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QAbstractButton, QSizePolicy

from carpus.ui import numbers
from carpus.ui.controls.text import paint_status
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.icons import State
from carpus.ui.theme import Theme

ROW_PX = 34
MOVES = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down)


class MarkerRow(QAbstractButton):
    """``nudged`` carries an arrow key, and whether Shift was held."""

    nudged = Signal(int, bool)

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme, self._name = theme, name
        self._value = ""
        self._state: State = "good"
        self._chosen = False
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        theme.changed.connect(self.updateGeometry)

    def show_line(
        self, off_mm: float, was_mm: float, *, seen: bool, changed: bool, chosen: bool, far_mm: float
    ) -> None:
        """``off_mm`` from its place now, ``was_mm`` before a change; NaN where nobody knows."""
        now = self.tr("{size} mm").format(size=numbers.fixed(off_mm, 1)) if math.isfinite(off_mm) else "–"
        if not seen:
            now = self.tr("hidden")
        if changed and math.isfinite(was_mm):
            now = self.tr("{now}, was {size} mm").format(now=now, size=f"{was_mm:.0f}")
        far = seen and math.isfinite(off_mm) and off_mm > far_mm
        self._value, self._chosen = now, chosen
        self._state = "warn" if far else "predicted" if changed else "partly" if not seen else "good"
        self.setAccessibleName(f"{self._name}, {now}")
        self.setToolTip(f"{self._name}, {now}")
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(300, self._theme.px(ROW_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, self._theme.px(ROW_PX))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in MOVES and self._chosen:
            self.nudged.emit(event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.ignore()  # Enter tracks again, wherever the keyboard is
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, color = QPainter(self), self._theme.color
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        scale = self._theme.text_scale
        if self._chosen:
            painter.fillRect(self.rect(), color("soft"))
            painter.fillRect(QRectF(0, 4, 3, self.height() - 8), color("accent"))
        painter.setPen(color("line"))
        painter.drawLine(0, self.height() - 1, self.width(), self.height() - 1)
        size = 18 * scale
        paint_status(painter, self._theme, self._state, QRectF(8, (self.height() - size) / 2, size, size))
        inside = QRectF(size + 18, 0, self.width() - size - 26, self.height())
        painter.setPen(color("text"))
        painter.setFont(font(14 * scale, SEMIBOLD if self._chosen else MEDIUM))
        value_px = QFontMetricsF(font(14 * scale, REGULAR)).horizontalAdvance(self._value)
        name = QFontMetricsF(painter.font()).elidedText(
            self._name, Qt.TextElideMode.ElideRight, inside.width() - value_px - 10
        )
        painter.drawText(inside, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft), name)
        painter.setPen(color("text2"))
        painter.setFont(font(14 * scale, REGULAR))
        painter.drawText(inside, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), self._value)

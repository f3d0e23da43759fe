"""Two maps of the picture: where the board has been, and where its corners land."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.calibration.camera.views import FIELDS
from carpus.core.types import FloatArray
from carpus.ui.fonts import MEDIUM, REGULAR, font
from carpus.ui.plot.axes import hatch
from carpus.ui.plot.style import screen_style
from carpus.ui.theme import Theme

ENLARGED = 50.0
_BOUNDS = ((1, ""), (25, "1"), (60, "2"), (10**9, "3+"))
"""Corners in a field below which its number of pictures is about so many."""


class FieldMap(QWidget):
    """The fields of the picture: hatched where nothing has been, the next one dashed; a number, not a shade."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.nothing: np.ndarray = np.zeros((FIELDS[1], FIELDS[0]), dtype=np.int64)
        self._corners = self.nothing
        self._next: tuple[int, int] | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Where the board has been"))
        theme.changed.connect(self.updateGeometry)

    def show_corners(self, corners: np.ndarray, following: tuple[int, int] | None) -> None:
        """Corners (4, 6) in each field, and the one that comes next."""
        self._corners, self._next = corners, following
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(self._theme.px(300), self._theme.px(4 * 30))

    def minimumSizeHint(self) -> QSize:
        return QSize(self._theme.px(200), self._theme.px(4 * 30))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        style, color = screen_style(self._theme), self._theme.color
        rows, columns = self._corners.shape
        width, height = (self.width() - 2) / columns, (self.height() - 2) / rows
        painter.setFont(font(12 * self._theme.text_scale, MEDIUM))
        for down in range(rows):
            for across in range(columns):
                box = QRectF(1 + across * width, 1 + down * height, width, height).adjusted(0.5, 0.5, -0.5, -0.5)
                count = int(self._corners[down, across])
                if count:
                    painter.fillRect(box, color("soft"))
                    painter.setPen(color("accent"))
                    words = next(text for bound, text in _BOUNDS if count < bound)
                    painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), words)
                else:
                    hatch(painter, style, box, "border", 90)
                painter.setPen(QPen(color("line"), 1.0))
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.drawRect(box)
        if self._next is not None:
            down, across = self._next
            pen = QPen(color("accent"), 2.0)
            pen.setDashPattern([3, 2])
            painter.setPen(pen)
            painter.drawRect(QRectF(1 + across * width, 1 + down * height, width, height))


class LandingMap(QWidget):
    """By how much corners land beside where they are, enlarged; hatched where there were none."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._off_px: FloatArray = np.full((9, 13, 2), np.nan)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Where lines land"))
        theme.changed.connect(self.update)

    def show_map(self, off_px: FloatArray) -> None:
        """Mean distance (rows, columns, 2) of the corners in each part of the picture; NaN for none."""
        self._off_px = off_px
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(self._theme.px(480), self._theme.px(300))

    def minimumSizeHint(self) -> QSize:
        return QSize(self._theme.px(280), self._theme.px(200))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        style, color = screen_style(self._theme), self._theme.color
        foot = self._theme.px(22)
        rows, columns = self._off_px.shape[:2]
        width, height = self.width() / columns, (self.height() - foot) / rows
        per_px = ENLARGED * self.width() / 640.0
        for down in range(rows):
            for across in range(columns):
                box = QRectF(across * width, down * height, width, height)
                at = box.center()
                off = self._off_px[down, across]
                if not np.isfinite(off).all():
                    hatch(painter, style, box.adjusted(3, 3, -3, -3), "border", 90)
                    continue
                painter.setPen(QPen(color("line"), 1.0))
                painter.drawLine(QPointF(box.left(), at.y()), QPointF(box.right(), at.y()))
                painter.drawLine(QPointF(at.x(), box.top()), QPointF(at.x(), box.bottom()))
                painter.setPen(QPen(color("accent"), 2.0))
                painter.drawLine(at, at + QPointF(float(off[0]), float(off[1])) * per_px)
                painter.setBrush(color("accent"))
                painter.setPen(Qt.PenStyle.NoPen)
                painter.drawEllipse(at, 2.0, 2.0)
        painter.setFont(font(12 * self._theme.text_scale, REGULAR))
        painter.setPen(color("text2"))
        line = QRectF(0, self.height() - foot, self.width(), foot)
        painter.drawText(line, int(Qt.AlignmentFlag.AlignVCenter), self.tr("hatched: no pictures there"))
        words = self.tr("0.5 px")
        painter.drawText(line, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), words)
        right = self.width() - painter.fontMetrics().horizontalAdvance(words) - 8
        painter.setPen(QPen(color("text"), 2.0))
        painter.drawLine(QPointF(right - 0.5 * per_px, line.center().y()), QPointF(right, line.center().y()))

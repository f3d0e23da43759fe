"""Path of the wrist and directions of its axes in three planes (figures 3 and 5 of the wrist paper)."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.output.exercises import STILL_RADIUS_MM
from core.types import FloatArray, Side
from ui import numbers
from ui.controls.card import paint_card
from ui.controls.text import paint_status
from ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from ui.live.history import History
from ui.plot.polygon import polygon, runs
from ui.theme import Theme

STILL_SPAN_MM, FREE_SPAN_MM = 60.0, 600.0
"""Side of the squares: for exercises with a still forearm, and for all others."""
AXIS_SHARE = 0.22
UP = (0, 2, 2)
ACROSS = (1, 0, 1)
ACROSS_SIGN = (-1.0, 1.0, -1.0)
"""From above and from the fingers Y of W0 points to the left of the picture, on both hands."""
AXIS_TOKENS = ("curve_c", "curve_a", "curve_b")
AXIS_LETTERS = ("X", "Y", "Z")
LEAST_LETTER_PX = 12.0
"""X turns pro/supination, Y flexion, Z deviation: each axis has the colour of its angle.

An axis that points at the viewer is too short for its letter.
"""


class PathView(QWidget):
    """A card with three squares of fixed size."""

    def __init__(self, theme: Theme, history: History) -> None:
        super().__init__()
        self._theme, self._history = theme, history
        self._side: Side = "right"
        self._pure = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Path of the wrist"))
        theme.changed.connect(self.update)

    def set_exercise(self, side: Side, pure_wrist: bool) -> None:
        """Which hand, and whether the forearm must lie still."""
        self._side, self._pure = side, pure_wrist
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(520, 242)

    def minimumSizeHint(self) -> QSize:
        return QSize(380, 180)

    def paintEvent(self, event: QPaintEvent) -> None:
        theme, scale = self._theme, self._theme.text_scale
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_card(painter, theme, QRectF(self.rect()))
        painter.setFont(font(14 * scale, SEMIBOLD))
        painter.setPen(theme.color("text"))
        head = QRectF(20, 12, self.width() - 40, 24 * scale)
        painter.drawText(head, int(Qt.AlignmentFlag.AlignVCenter), self.tr("Path of the wrist, last 10 s"))
        self._paint_forearm(painter, head)
        top = head.bottom() + 6
        under = 46 * scale
        size = min((self.width() - 40 - 2 * 15) / 3, self.height() - top - under)
        gap = (self.width() - 40 - 3 * size) / 2
        path, axes = self._history.path_mm(), self._history.axes()
        for plane in range(3):
            self._paint_plane(painter, QRectF(20 + plane * (size + gap), top, size, size), plane, path, axes)
        span = self._span_mm()
        painter.setFont(font(12 * scale, REGULAR))
        painter.setPen(theme.color("text2"))
        words = self.tr("{span} × {span} mm, fixed").format(span=f"{span:.0f}")
        painter.drawText(QPointF(20, top + size + 38 * scale), words)

    def _span_mm(self) -> float:
        return STILL_SPAN_MM if self._pure else FREE_SPAN_MM

    def _paint_forearm(self, painter: QPainter, head: QRectF) -> None:
        distance = self._history.from_home_mm()
        if not self._pure or not math.isfinite(distance):
            return
        moved = distance > STILL_RADIUS_MM
        pattern = self.tr("arm moved ({distance})") if moved else self.tr("forearm still ({distance})")
        words = pattern.format(distance=numbers.millimetres(distance))
        scale = self._theme.text_scale
        painter.setFont(font(12 * scale, MEDIUM))
        painter.setPen(self._theme.color("warn" if moved else "text2"))
        painter.drawText(head, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), words)
        size = 16 * scale
        left = head.right() - QFontMetricsF(painter.font()).horizontalAdvance(words) - size - 6
        box = QRectF(left, head.center().y() - size / 2, size, size)
        paint_status(painter, self._theme, "warn" if moved else "good", box)

    def _names(self, plane: int) -> tuple[str, str, str, str]:
        """Up, across, title, letters."""
        thumb = self.tr("thumb ←") if self._side == "right" else self.tr("thumb →")
        return (
            (self.tr("fingers ↑"), thumb, self.tr("From above"), "XY"),
            (self.tr("up ↑"), self.tr("fingers →"), self.tr("From the side"), "ZX"),
            (self.tr("up ↑"), thumb, self.tr("From the fingers"), "ZY"),
        )[plane]

    def _paint_plane(self, painter: QPainter, box: QRectF, plane: int, path: FloatArray, axes: FloatArray) -> None:
        theme, scale = self._theme, self._theme.text_scale
        up, across, title, letters = self._names(plane)
        painter.setPen(QPen(theme.color("line"), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRoundedRect(box, 4, 4)
        painter.drawLine(QPointF(box.center().x(), box.top()), QPointF(box.center().x(), box.bottom()))
        painter.drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()))
        painter.setFont(font(12 * scale, REGULAR))
        painter.setPen(theme.color("text2"))
        painter.drawText(QPointF(box.left() + 8, box.top() + 16 * scale), up)
        painter.drawText(QPointF(box.left() + 8, box.bottom() - 8), across)
        px_per_mm = box.width() / self._span_mm()
        if self._pure:
            ring = QPen(theme.color("border"), 1, Qt.PenStyle.CustomDashLine)
            ring.setDashPattern([4, 3])
            painter.setPen(ring)
            radius = STILL_RADIUS_MM * px_per_mm
            painter.drawEllipse(box.center(), radius, radius)
            if plane == 0:
                painter.setPen(theme.color("text2"))
                painter.drawText(QPointF(box.center().x() + 6, box.center().y() - radius - 4), self.tr("15 mm"))
        painter.save()
        painter.setClipRect(box.toAlignedRect())
        self._paint_path(painter, box, plane, path, axes, px_per_mm)
        painter.restore()
        painter.setFont(font(12 * scale, MEDIUM))
        painter.setPen(theme.color("text"))
        under = QRectF(box.left(), box.bottom() + 4, box.width(), 20 * scale)
        painter.drawText(under, int(Qt.AlignmentFlag.AlignVCenter), title)
        painter.setPen(theme.color("text2"))
        painter.drawText(under, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), letters)

    def _paint_path(
        self, painter: QPainter, box: QRectF, plane: int, path: FloatArray, axes: FloatArray, px_per_mm: float
    ) -> None:
        if not len(path):
            return
        x = box.center().x() + ACROSS_SIGN[plane] * path[:, ACROSS[plane]] * px_per_mm
        y = box.center().y() - path[:, UP[plane]] * px_per_mm
        known = np.isfinite(x) & np.isfinite(y)
        faint, strong = self._theme.color("accent", 110), self._theme.color("accent")
        half = len(path) // 2
        for first, last in runs(known):
            for start, stop, color in ((first, min(last, half + 1), faint), (max(first, half), last, strong)):
                if stop - start > 1:
                    painter.setPen(QPen(color, 1.5))
                    painter.drawPolyline(polygon(x[start:stop], y[start:stop]))
        if known[-1]:
            self._paint_axes(painter, QPointF(float(x[-1]), float(y[-1])), plane, axes[-1], box.width() * AXIS_SHARE)

    def _paint_axes(self, painter: QPainter, point: QPointF, plane: int, axes: FloatArray, length_px: float) -> None:
        scale = self._theme.text_scale
        letters: list[QPointF] = []
        named = self._names(plane)[3]
        # The plane's own axes first: where two letters would touch, the third axis goes without.
        for axis in sorted(range(3), key=lambda axis: AXIS_LETTERS[axis] not in named):
            direction = axes[:, axis]
            end = point + QPointF(
                ACROSS_SIGN[plane] * float(direction[ACROSS[plane]]) * length_px,
                -float(direction[UP[plane]]) * length_px,
            )
            painter.setPen(
                QPen(self._theme.color(AXIS_TOKENS[axis]), 2, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap)
            )
            painter.drawLine(point, end)
            away = end - point
            length = math.hypot(away.x(), away.y())
            center = end + away * (8.0 * scale / max(length, 1.0))
            free = all(math.hypot((center - other).x(), (center - other).y()) > 12.0 * scale for other in letters)
            if length >= LEAST_LETTER_PX * scale and free:
                letters.append(center)
                painter.setFont(font(12 * scale, SEMIBOLD))
                box = QRectF(center.x() - 12, center.y() - 12, 24, 24)
                painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), AXIS_LETTERS[axis])
        painter.setPen(QPen(QColor(self._theme.color("surface")), 1.5))
        painter.setBrush(self._theme.color("accent"))
        painter.drawEllipse(point, 4.5, 4.5)

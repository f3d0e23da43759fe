"""Path of the wrist and directions of its axes in three planes (figures 3 and 5 of the wrist paper)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.hand.exercises import STILL_RADIUS_MM
from carpus.core.rounding import written
from carpus.core.types import FloatArray, Side
from carpus.ui import numbers
from carpus.ui.controls.text import paint_status
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.plot import axes
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.card import PlotCard
from carpus.ui.plot.history import History
from carpus.ui.plot.marks import Mark, paint_dot
from carpus.ui.plot.polygon import polygon, runs
from carpus.ui.plot.style import RIGHT_MIDDLE, PlotStyle, dashed, screen_style, write
from carpus.ui.plot.ways import ACROSS, ACROSS_SIGN, AXIS_LETTERS, AXIS_TOKENS, UP, plane_names
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas, Layer

STILL_SPAN_MM, FREE_SPAN_MM = 60.0, 600.0
"""Side of the squares: for exercises with a still forearm, and for all others."""
AXIS_SHARE = 0.22
LEAST_LETTER_PX = 12.0
"""An axis that points at the viewer is too short for its letter."""


@dataclass(frozen=True, slots=True)
class Path:
    """A way in one plane and where the axes point at its end, ``up`` and ``across`` in mm: (n,) and (3,)."""

    across_mm: FloatArray
    up_mm: FloatArray
    axes_across: FloatArray
    axes_up: FloatArray
    named: str
    """Letters of the plane's own axes: where two would touch, the third goes without."""

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        painter.save()
        painter.setClipRect(panel.box, Qt.ClipOperation.IntersectClip)
        x = panel.x(self.across_mm)
        y = panel.box.center().y() - self.up_mm * panel.box.width() / (panel.end_s - panel.start_s)
        known = np.isfinite(self.across_mm) & np.isfinite(self.up_mm)
        half = len(x) // 2
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for first, last in runs(known):
            for start, stop, alpha in ((first, min(last, half + 1), 110), (max(first, half), last, 255)):
                if stop - start > 1:
                    painter.setPen(QPen(style.color("accent", alpha), 1.5 * style.unit))
                    painter.drawPolyline(polygon(x[start:stop], y[start:stop]))
        if known[-1]:
            self._paint_axes(painter, style, QPointF(float(x[-1]), float(y[-1])), panel.box)
        painter.restore()

    def _paint_axes(self, painter: QPainter, style: PlotStyle, point: QPointF, panel: QRectF) -> None:
        length_px = panel.width() * AXIS_SHARE
        scale = style.label.pixelSize() / 12.0
        letters: list[QPointF] = []
        for axis in sorted(range(3), key=lambda axis: AXIS_LETTERS[axis] not in self.named):
            end = point + QPointF(
                float(self.axes_across[axis]) * length_px,
                -float(self.axes_up[axis]) * length_px,
            )
            color = style.color(AXIS_TOKENS[axis])
            painter.setPen(QPen(color, 2 * style.unit, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
            painter.drawLine(point, end)
            away = end - point
            length = math.hypot(away.x(), away.y())
            center = end + away * (8.0 * scale / max(length, 1.0))
            free = all(math.hypot((center - other).x(), (center - other).y()) > 12.0 * scale for other in letters)
            # The words in the corners at the left keep their places; a letter that would touch them is left out.
            strip = 26.0 * scale
            inside = panel.adjusted(8, 8, -8, -8).contains(center)
            among_words = center.x() < panel.left() + 74 * scale and not (
                panel.top() + strip < center.y() < panel.bottom() - strip
            )
            if length >= LEAST_LETTER_PX * scale and free and inside and not among_words:
                letters.append(center)
                box, face = QRectF(center.x() - 12, center.y() - 12, 24, 24), font(12 * scale, SEMIBOLD)
                write(painter, box, AXIS_LETTERS[axis], face, color, Qt.AlignmentFlag.AlignCenter)
        paint_dot(painter, style, point, "accent", 4.5)


@dataclass(frozen=True, slots=True)
class Ball:
    """Where the point that the wrist turns about must stay, and where it is, ``across`` and ``up`` in mm."""

    home_mm: tuple[float, float]
    now_mm: tuple[float, float]
    words: str

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        scale = panel.box.width() / (panel.end_s - panel.start_s)

        def place(at_mm: tuple[float, float]) -> QPointF:
            return QPointF(float(panel.x(at_mm[0])), panel.box.center().y() - at_mm[1] * scale)

        if not np.isfinite((*self.home_mm, *self.now_mm)).all():
            return
        painter.save()
        painter.setClipRect(panel.box, Qt.ClipOperation.IntersectClip)
        home, now, radius = place(self.home_mm), place(self.now_mm), STILL_RADIUS_MM * scale
        painter.setPen(dashed(style.color("border"), style.unit, (4, 3)))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(home, radius, radius)
        painter.setPen(QPen(style.color("text"), 1.5 * style.unit))
        for dx, dy in ((4.0, 0.0), (0.0, 4.0)):
            arm = QPointF(dx * style.unit, dy * style.unit)
            painter.drawLine(now - arm, now + arm)
        if self.words:
            at = QPointF(home.x() + 6, home.y() - radius - 4)
            write(painter, at, self.words, style.label, style.color("text2"))
        painter.restore()


class PathView(PlotCard):
    """A card with three squares of fixed size."""

    usual_px, least_px = (520, 242), (380, 180)

    def __init__(self, theme: Theme, history: History) -> None:
        super().__init__(theme)
        self._history = history
        self._side: Side = "right"
        self._pure = True
        self.setAccessibleName(self.tr("Path of the wrist"))

    def set_exercise(self, side: Side, pure_wrist: bool) -> None:
        self._side, self._pure = side, pure_wrist
        self.forget()

    # --- places -------------------------------------------------------------------------------------------
    def _head(self) -> QRectF:
        return QRectF(20, 12, self.width() - 40, 24 * self._theme.text_scale)

    def panels(self) -> list[Panel]:
        """The squares of the three planes; both axes in millimetres from the forearm's place at rest."""
        scale, half = self._theme.text_scale, self._span_mm() / 2
        top = self._head().bottom() + 6
        size = min((self.width() - 40 - 2 * 15) / 3, self.height() - top - 46 * scale)
        gap = (self.width() - 40 - 3 * size) / 2
        boxes = [axes.crisp(QRectF(20 + plane * (size + gap), top, size, size)) for plane in range(3)]
        return [Panel(box, Scale(-half, half, (), ()), -half, half) for box in boxes]

    def _span_mm(self) -> float:
        return STILL_SPAN_MM if self._pure else FREE_SPAN_MM

    # --- what is in it ------------------------------------------------------------------------------------
    def furnish(self, canvas: Canvas) -> None:
        self._said: Layer = canvas.add_layer(self._paint_forearm)

    def lay_out(self, canvas: Canvas) -> None:
        canvas.lay_out(self.panels())
        self._said.cover(self._head())

    def show_marks(self, canvas: Canvas) -> None:
        way, turned = self._history.path_mm(), self._history.axes()
        canvas.show_marks([self._marks(plane, way, turned) if len(way) else [] for plane in range(3)])
        self._said.update()

    def _marks(self, plane: int, way: FloatArray, turned: FloatArray) -> list[Mark]:
        if not self._pure:
            return [self._path(plane, way, turned)]
        across, up, sign = ACROSS[plane], UP[plane], ACROSS_SIGN[plane]
        home, now = self._history.centre_home_mm(), self._history.centre_mm()
        words = self.tr("15 mm") if plane == 0 else ""
        ball = Ball((sign * home[across], home[up]), (sign * now[across], now[up]), words)
        return [ball, self._path(plane, way, turned)]

    def _path(self, plane: int, way_mm: FloatArray, turned: FloatArray) -> Path:
        across, up, sign = ACROSS[plane], UP[plane], ACROSS_SIGN[plane]
        newest = turned[-1]
        named = plane_names(self._side)[plane][3]
        return Path(sign * way_mm[:, across], way_mm[:, up], sign * newest[across], newest[up], named)

    def paint_ground(self, painter: QPainter) -> None:
        theme, scale = self._theme, self._theme.text_scale
        head = self.tr("Path of the wrist, last 10 s")
        write(painter, self._head(), head, font(14 * scale, SEMIBOLD), theme.color("text"))
        panels = self.panels()
        for plane, panel in enumerate(panels):
            self._paint_plane(painter, panel, plane)
        words = self.tr("{span} × {span} mm, fixed").format(span=written(self._span_mm()))
        if self._pure:
            words += self.tr(" · cross: where the wrist turns; it must stay in the ring")
        at = QPointF(20, panels[0].box.bottom() + 38 * scale)
        write(painter, at, words, font(12 * scale, REGULAR), theme.color("text2"))

    def _paint_plane(self, painter: QPainter, panel: Panel, plane: int) -> None:
        theme, style, scale, box = self._theme, screen_style(self._theme), self._theme.text_scale, panel.box
        up, across, title, letters = plane_names(self._side)[plane]
        painter.setPen(QPen(theme.color("line"), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRoundedRect(box, 4, 4)
        painter.drawLine(QPointF(box.center().x(), box.top()), QPointF(box.center().x(), box.bottom()))
        painter.drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()))
        weak = theme.color("text2")
        write(painter, QPointF(box.left() + 8, box.top() + 16 * scale), up, style.label, weak)
        beside = box.adjusted(0, 4 * scale, -8, -4 * scale)
        metrics = QFontMetricsF(style.label)
        fits = metrics.horizontalAdvance(up) + metrics.horizontalAdvance(across) + 24 <= box.width()
        edge = Qt.AlignmentFlag.AlignTop if fits else Qt.AlignmentFlag.AlignBottom  # below, the ring may lie
        write(painter, beside, across, style.label, weak, edge | Qt.AlignmentFlag.AlignRight)
        under = QRectF(box.left(), box.bottom() + 4, box.width(), 20 * scale)
        write(painter, under, title, style.end_label, theme.color("text"))
        write(painter, under, letters, style.end_label, weak, RIGHT_MIDDLE)

    def _paint_forearm(self, painter: QPainter) -> None:
        head, distance = self._head(), self._history.from_home_mm()
        if not self._pure or not math.isfinite(distance):
            return
        moved = distance > STILL_RADIUS_MM
        pattern = self.tr("arm moved ({distance})") if moved else self.tr("forearm still ({distance})")
        words = pattern.format(distance=numbers.millimetres(distance))
        scale = self._theme.text_scale
        face = font(12 * scale, MEDIUM)
        write(painter, head, words, face, self._theme.color("warn" if moved else "text2"), RIGHT_MIDDLE)
        size = 16 * scale
        left = head.right() - QFontMetricsF(face).horizontalAdvance(words) - size - 6
        box = QRectF(left, head.center().y() - size / 2, size, size)
        paint_status(painter, self._theme, "warn" if moved else "good", box)

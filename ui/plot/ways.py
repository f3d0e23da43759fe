"""Ways through the room in the three planes of the papers: of the wrist with the hand's axes, and of finger joints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.results.motion_curves import MotionCurves
from carpus.core.rounding import written
from carpus.core.types import FloatArray, Side
from carpus.ui import numbers
from carpus.ui.figures import FINGERS
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.marker_words import finger_name
from carpus.ui.plot.axes import Panel, Scale, crisp
from carpus.ui.plot.marks import Mark, paint_dot
from carpus.ui.plot.polygon import polygon, runs
from carpus.ui.plot.style import RIGHT_MIDDLE, PlotStyle, write
from carpus.ui.translate import tr

BARS_MM = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)
LEAST_SPAN_MM = 40.0
"""A hand that lies still is not looked at more closely."""
BAR_SHARE = 0.3
ROOMY_LINES = 8.0
"""Height of a panel, in lines of its words, from which it has its name under it."""
ROOM = 1.3
AXES_SHOWN = 9
"""The hand's axes are drawn so often along the whole way, evenly in time."""
AXIS_SHARE, NOW_SHARE = 0.075, 0.16
RECENT_S = 1.0
_OF_FINGER = ("MCP", "PIP", "DIP", "TIP")
_OF_THUMB = ("CMC", "MCP", "IP", "TIP")
_JOINT_TOKENS = ("curve_a", "curve_b", "curve_c", "accent")


@dataclass(frozen=True, slots=True)
class WayLine:
    """One line: ``place_mm`` (N, 3) in W0, its colour, what it is called at its end, and where it was not ``seen``."""

    place_mm: FloatArray
    token: str
    name: str
    seen: np.ndarray


@dataclass(frozen=True, slots=True)
class WayPlot:
    """All ways that are drawn together; ``axes`` (N, 3, 3) of the hand along the first one, None for none; ``low_mm``
    and ``high_mm`` (3,) what they need in W0."""

    time_s: FloatArray
    ways: Sequence[WayLine]
    axes: FloatArray | None
    side: Side
    low_mm: FloatArray
    high_mm: FloatArray

    def per_mm(self, box: QRectF) -> float:
        """Painter units for a millimetre in a panel of this size, the same in all three planes and in both
        directions."""
        needs = np.maximum(ROOM * (self.high_mm - self.low_mm), LEAST_SPAN_MM)
        fits = [(box.width() / needs[ACROSS[plane]], box.height() / needs[UP[plane]]) for plane in range(3)]
        return float(min(min(fit) for fit in fits))

    def bar_mm(self, box: QRectF) -> float:
        """Length of the scale bar: the longest round one that takes up a third of a panel at most."""
        most = BAR_SHARE * box.width() / self.per_mm(box)
        return max((length for length in BARS_MM if length <= most), default=BARS_MM[0])


def wrist_way(curves: MotionCurves) -> WayPlot:
    """The WRIST disc's way with the hand's axes (wrist paper, figures 3 and 5)."""
    way = WayLine(curves.position_mm, "accent", "", ~curves.predicted)
    return _plot(curves, [way], curves.axes)


def finger_ways(curves: MotionCurves, finger: int) -> WayPlot:
    """The ways of a finger's joints, or of finger 0 of all five tips (hand paper, figures 2 and 3)."""
    if finger:
        kinds = _OF_THUMB if finger == 1 else _OF_FINGER
        named = [(f"{kind}{finger}", token, kind) for kind, token in zip(kinds, _JOINT_TOKENS, strict=True)]
    else:
        named = [
            (f"TIP{k}", "text" if k == 1 else "curve_a" if k % 2 else "curve_b", finger_name(str(k))) for k in FINGERS
        ]
    there = curves.joint_names
    at = [(there.index(joint), token, words) for joint, token, words in named if joint in there]
    ways = [WayLine(curves.joint_mm[:, k], token, words, curves.joint_seen[:, k]) for k, token, words in at]
    return _plot(curves, ways, None)


def _plot(curves: MotionCurves, ways: Sequence[WayLine], axes: FloatArray | None) -> WayPlot:
    every = np.concatenate([np.empty((0, 3)), *(way.place_mm for way in ways)])
    known = every[np.isfinite(every).all(axis=1)]
    low, high = (known.min(axis=0), known.max(axis=0)) if len(known) else (np.zeros(3), np.zeros(3))
    return WayPlot(curves.time_s, ways, axes, curves.side, low, high)


def plane_names(side: Side) -> tuple[tuple[str, str, str, str], ...]:
    """Up, across, title and letters of the three planes."""
    thumb = tr("thumb ←") if side == "right" else tr("thumb →")
    return (
        (tr("fingers ↑"), thumb, tr("From above"), "XY"),
        (tr("up ↑"), tr("fingers →"), tr("From the side"), "ZX"),
        (tr("up ↑"), thumb, tr("From the fingers"), "ZY"),
    )


def side_by_side(style: PlotStyle, box: QRectF, gap: float) -> list[Panel]:
    """Three panels side by side in a box, none higher than wide, with a line of words over each and one under it
    where there is room."""
    width = max((box.width() - 2 * gap) / 3, 1.0)
    line = _line(style)
    below = line if box.height() >= ROOMY_LINES * line else 0.0
    height = max(min(width, box.height() - line - below), 1.0)
    if not below:
        height = min(height, (ROOMY_LINES - 2.0) * line - 2.0)  # so that no title is asked for
    top = box.top() + line + 0.5 * (box.height() - line - below - height)
    places = [crisp(QRectF(box.left() + plane * (width + gap), top, width, height)) for plane in range(3)]
    return [Panel(place, Scale(-1.0, 1.0, (), ()), -1.0, 1.0) for place in places]


@dataclass(frozen=True, slots=True)
class PlaneMark:
    """What is drawn in one plane up to ``until_s``, NaN for the whole way without an end."""

    plot: WayPlot
    plane: int
    until_s: float = math.nan

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        painter.save()
        painter.setClipRect(panel.box, Qt.ClipOperation.IntersectClip)
        if self.plot.axes is not None:
            self._paint_axes_along(painter, style, panel, self.plot.axes)
        taken = [_bar_room(style, panel.box)]
        row = self._row()
        for way in self.plot.ways:
            x, y = self._places(panel, way.place_mm)
            self._paint_way(painter, style, way, x, y)
            if row >= 0 and math.isfinite(float(x[row] + y[row])):
                self._paint_now(painter, style, way, QPointF(float(x[row]), float(y[row])))
        for way in self.plot.ways:
            self._paint_name(painter, style, panel, way, self._places(panel, way.place_mm), taken)
        if row >= 0 and self.plot.axes is not None:
            place = self._places(panel, self.plot.ways[0].place_mm[row : row + 1])
            at = QPointF(float(place[0][0]), float(place[1][0]))
            self._paint_axes(painter, style, at, self.plot.axes[row], panel.box.height() * NOW_SHARE, lettered=True)
        painter.restore()

    def _row(self) -> int:
        if not math.isfinite(self.until_s) or not len(self.plot.time_s):
            return -1
        return int(np.abs(self.plot.time_s - self.until_s).argmin())

    def _places(self, panel: Panel, place_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        away = place_mm - 0.5 * (self.plot.low_mm + self.plot.high_mm)
        scale = self.plot.per_mm(panel.box)
        across, up, sign = ACROSS[self.plane], UP[self.plane], ACROSS_SIGN[self.plane]
        center = panel.box.center()
        return center.x() + sign * away[:, across] * scale, center.y() - away[:, up] * scale

    def _paint_way(self, painter: QPainter, style: PlotStyle, way: WayLine, x: FloatArray, y: FloatArray) -> None:
        """Solid where it was seen, dashed where it was not; of a way with an end what lies ahead is faint."""
        painter.setBrush(Qt.BrushStyle.NoBrush)
        known = np.isfinite(x) & np.isfinite(y)
        row = self._row()
        for first, last in runs(known):
            for seen in (True, False):
                for start, stop in runs(way.seen[first:last] == seen):
                    begin, end = max(first + start - 1, first), first + stop
                    pen = QPen(style.color(way.token), style.line_width if row >= 0 else 0.5 * style.line_width)
                    if row >= 0:
                        pen.setColor(style.color(way.token, 120))
                    if not seen:
                        pen.setDashPattern([2.2, 2.2])
                    painter.setPen(pen)
                    painter.drawPolyline(polygon(x[begin:end], y[begin:end]))
        if row >= 0:
            recent = int(np.searchsorted(self.plot.time_s, self.plot.time_s[row] - RECENT_S))
            painter.setPen(QPen(style.color(way.token), 2.0 * style.line_width))
            for first, last in runs(known[recent : row + 1]):
                painter.drawPolyline(polygon(x[recent + first : recent + last], y[recent + first : recent + last]))

    def _paint_now(self, painter: QPainter, style: PlotStyle, way: WayLine, at: QPointF) -> None:
        paint_dot(painter, style, at, way.token, 4.5)

    def _paint_name(
        self, painter: QPainter, style: PlotStyle, panel: Panel, way: WayLine,
        places: tuple[FloatArray, FloatArray], taken: list[QRectF],
    ) -> None:  # fmt: skip
        """At the outermost point of the way that is free; none where there is no room."""
        x, y = places
        known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
        if not way.name or not len(known):
            return
        metrics = QFontMetricsF(style.end_label)
        width, height = metrics.horizontalAdvance(way.name), metrics.height()
        ends = (0, int(np.argmin(y[known])), int(np.argmax(y[known])), int(np.argmax(x[known])))
        for row in known[list(ends)].tolist():
            for left in (float(x[row]) + 5 * style.unit, float(x[row]) - width - 5 * style.unit):
                box = QRectF(left, float(y[row]) - height / 2, width, height)
                inside = panel.box.adjusted(2, 2, -2, -2).contains(box)
                if inside and not any(box.intersects(other) for other in taken):
                    taken.append(box)
                    painter.fillRect(box.adjusted(-1, 2, 1, -2), style.color("surface", 200))
                    color = style.color(way.token)
                    write(painter, box, way.name, style.end_label, color, Qt.AlignmentFlag.AlignCenter)
                    return

    def _paint_axes_along(self, painter: QPainter, style: PlotStyle, panel: Panel, axes: FloatArray) -> None:
        place_mm = self.plot.ways[0].place_mm
        known = np.flatnonzero(np.isfinite(place_mm).all(axis=1) & np.isfinite(axes).all(axis=(1, 2)))
        if not len(known):
            return
        rows = known[np.unique(np.linspace(0, len(known) - 1, AXES_SHOWN).round().astype(np.int64))]
        x, y = self._places(panel, place_mm[rows])
        for k, row in enumerate(rows.tolist()):
            at = QPointF(float(x[k]), float(y[k]))
            self._paint_axes(painter, style, at, axes[row], panel.box.height() * AXIS_SHARE, lettered=False)

    def _paint_axes(
        self, painter: QPainter, style: PlotStyle, at: QPointF, turned: FloatArray, length: float, *, lettered: bool
    ) -> None:
        across, up, sign = ACROSS[self.plane], UP[self.plane], ACROSS_SIGN[self.plane]
        letters: list[QPointF] = []
        for axis in range(3):
            away = QPointF(sign * float(turned[across, axis]) * length, -float(turned[up, axis]) * length)
            if not math.isfinite(away.x() + away.y()):
                return
            width = (2.0 if lettered else 1.0) * style.unit
            color = style.color(AXIS_TOKENS[axis], 255 if lettered else 170)
            painter.setPen(QPen(color, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
            painter.drawLine(at, at + away)
            reach = math.hypot(away.x(), away.y())
            size = style.label.pixelSize()
            center = at + away * (1.0 + 0.7 * size / max(reach, 1e-6))
            free = all(math.hypot((center - other).x(), (center - other).y()) > size for other in letters)
            edge = 0.6 * size
            shown = painter.clipBoundingRect().adjusted(edge, edge, -edge, -edge)
            inside = not painter.hasClipping() or shown.contains(center)
            if lettered and reach >= size and free and inside:
                letters.append(center)
                box = QRectF(center.x() - size, center.y() - size, 2 * size, 2 * size)
                face, middle = font(size, SEMIBOLD, display=False), Qt.AlignmentFlag.AlignCenter
                write(painter, box, AXIS_LETTERS[axis], face, color, middle)


def plane_marks(plot: WayPlot, until_s: float = math.nan) -> list[list[Mark]]:
    """What is drawn in each of the three squares."""
    return [[PlaneMark(plot, plane, until_s)] for plane in range(3)]


def paint_planes(painter: QPainter, style: PlotStyle, plot: WayPlot, panels: Sequence[Panel]) -> None:
    """Squares, their cross of axes and their words, behind the ways."""
    line = _line(style)
    for panel, (up, across, title, letters) in zip(panels, plane_names(plot.side), strict=True):
        box = panel.box
        painter.setPen(QPen(style.color("line"), style.grid_width))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(box)
        painter.drawLine(QPointF(box.center().x(), box.top()), QPointF(box.center().x(), box.bottom()))
        painter.drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()))
        over = QRectF(box.left(), box.top() - line, box.width(), line)
        write(painter, over, f"{letters} · {up}", style.label, style.color("text2"))
        write(painter, over, across, style.label, style.color("text2"), RIGHT_MIDDLE)
        if is_titled(style, panel):
            write(painter, over.translated(0.0, box.height() + line), title, style.end_label, style.color("text"))
        _paint_bar(painter, style, plot, box)


def is_titled(style: PlotStyle, panel: Panel) -> bool:
    """Whether there is a line of words under a square too."""
    return panel.box.height() > (ROOMY_LINES - 2.0) * _line(style) - 1.0


def _line(style: PlotStyle) -> float:
    return QFontMetricsF(style.label).height() + 4 * style.unit


def _bar_room(style: PlotStyle, box: QRectF) -> QRectF:
    """The corner that the scale bar takes."""
    return QRectF(box.left(), box.bottom() - 1.6 * _line(style), 0.32 * box.width(), 1.6 * _line(style))


def _paint_bar(painter: QPainter, style: PlotStyle, plot: WayPlot, box: QRectF) -> None:
    """How long so many millimetres are, in the lower left corner."""
    length = plot.bar_mm(box)
    left, y = box.left() + 8 * style.unit, box.bottom() - 8 * style.unit
    painter.setPen(QPen(style.color("border"), 1.5 * style.unit))
    painter.drawLine(QPointF(left, y), QPointF(left + length * plot.per_mm(box), y))
    words = f"{written(length)}{numbers.NARROW_GAP}mm"
    write(painter, QPointF(left, y - 4 * style.unit), words, style.label, style.color("text2"))


UP = (0, 2, 2)
ACROSS = (1, 0, 1)
ACROSS_SIGN = (-1.0, 1.0, -1.0)
"""From above and from the fingers Y of W0 points to the left of the picture, on both hands."""
AXIS_TOKENS = ("curve_c", "curve_a", "curve_b")
"""X turns pro/supination, Y flexion, Z deviation: each axis has the colour of its angle."""
AXIS_LETTERS = ("X", "Y", "Z")

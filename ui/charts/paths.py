"""Paths in the three planes of the papers: of the wrist with the hand's axes, and of finger joints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from pyqtgraph.functions import arrayToQPolygonF
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, Side
from carpus.core.results.motion_curves import MotionCurves
from carpus.ui.charts.axes import Panel, Scale, align_to_pixels
from carpus.ui.charts.chart import CURVES, GRID, LINES, Chart, PixelItem, Plot
from carpus.ui.charts.series import find_runs
from carpus.ui.charts.style import PlotStyle, dash_pen, draw_text
from carpus.ui.kit import numbers
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words.finger_angles import FINGERS
from carpus.ui.words.terms import finger_name

BAR_LENGTHS_MM = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)
# The view is never narrower, also of a still hand.
MIN_SPAN_MM = 40.0
MAX_BAR_FRACTION = 0.3
# Minimum height of a panel with a title below it, in lines of text.
MIN_LINES_WITH_TITLE = 8.0
VIEW_MARGIN = 1.3
# So many times the hand's axes are drawn along a path, evenly in time.
AXES_COUNT = 9
AXIS_FRACTION = 0.075
_FINGER_JOINTS = ("MCP", "PIP", "DIP", "TIP")
_THUMB_JOINTS = ("CMC", "MCP", "IP", "TIP")
_JOINT_TOKENS = ("flexion", "deviation", "rotation", "accent")
UP = (0, 2, 2)
ACROSS = (1, 0, 1)
# Seen from above and from the fingers, Y of W0 points to the left on both hands.
ACROSS_SIGN = (-1.0, 1.0, -1.0)
# Each axis has the colour of its angle: X pronation-supination, Y flexion, Z deviation.
AXIS_TOKENS = ("rotation", "flexion", "deviation")
AXIS_LETTERS = ("X", "Y", "Z")
PLANE_LETTERS = ("XY", "ZX", "ZY")


@dataclass(frozen=True, slots=True)
class PathLine:
    """One path: positions (N, 3) in W0, colour, name, and where its marker was visible (N,)."""

    position_mm: FloatArray
    token: str
    name: str
    is_visible: np.ndarray


@dataclass(frozen=True, slots=True)
class PathPlot:
    """Paths that are drawn together, with the hand's axes (N, 3, 3) along the first one.

    ``low_mm`` and ``high_mm`` (3,) are the bounds in W0.
    """

    time_s: FloatArray
    paths: Sequence[PathLine]
    axes: FloatArray | None
    side: Side
    low_mm: FloatArray
    high_mm: FloatArray

    def per_mm(self, box: QRectF) -> float:
        """Return painter units per millimetre, the same in all three planes."""
        needs = np.maximum(VIEW_MARGIN * (self.high_mm - self.low_mm), MIN_SPAN_MM)
        fits = [(box.width() / needs[ACROSS[plane]], box.height() / needs[UP[plane]]) for plane in range(3)]
        return float(min(min(fit) for fit in fits))

    def bar_mm(self, box: QRectF) -> float:
        """Return the length of the scale bar: the longest round one within a third of the panel."""
        maximum = MAX_BAR_FRACTION * box.width() / self.per_mm(box)
        return max((length for length in BAR_LENGTHS_MM if length <= maximum), default=BAR_LENGTHS_MM[0])


def wrist_path(curves: MotionCurves) -> PathPlot:
    """Return the path of the WRIST marker with the hand's axes (wrist paper, figures 3 and 5)."""
    way = PathLine(curves.position_mm, "accent", "", ~curves.is_predicted)
    return _plot(curves, [way], curves.axes)


def finger_paths(curves: MotionCurves, finger: int) -> PathPlot:
    """Return the paths of a finger's joints, or for finger 0 of all five tips (hand paper, figures 2 and 3)."""
    if finger:
        kinds = _THUMB_JOINTS if finger == 1 else _FINGER_JOINTS
        named = [(f"{kind}{finger}", token, kind) for kind, token in zip(kinds, _JOINT_TOKENS, strict=True)]
    else:
        named = [
            (f"TIP{k}", "text" if k == 1 else "flexion" if k % 2 else "deviation", finger_name(str(k))) for k in FINGERS
        ]
    there = curves.joint_names
    at = [(there.index(joint), token, words) for joint, token, words in named if joint in there]
    ways = [PathLine(curves.joint_mm[:, k], token, words, curves.is_joint_seen[:, k]) for k, token, words in at]
    return _plot(curves, ways, None)


def _plot(curves: MotionCurves, paths: Sequence[PathLine], axes: FloatArray | None) -> PathPlot:
    every = np.concatenate([np.empty((0, 3)), *(way.position_mm for way in paths)])
    known = every[np.isfinite(every).all(axis=1)]
    low, high = (known.min(axis=0), known.max(axis=0)) if len(known) else (np.zeros(3), np.zeros(3))
    return PathPlot(curves.time_s, paths, axes, curves.side, low, high)


def plane_names(side: Side) -> tuple[tuple[str, str, str, str], ...]:
    """Return upward label, horizontal label, title and letters of each plane."""
    thumb = tr("thumb ←") if side == "right" else tr("thumb →")
    return (
        (tr("fingers ↑"), thumb, tr("From above"), PLANE_LETTERS[0]),
        (tr("up ↑"), tr("fingers →"), tr("From the side"), PLANE_LETTERS[1]),
        (tr("up ↑"), thumb, tr("From the fingers"), PLANE_LETTERS[2]),
    )


def plane_panels(style: PlotStyle, box: QRectF, gap: float) -> list[Panel]:
    """Return three square panels side by side, with a line of text above and, if there is room, below."""
    width = max(math.floor((box.width() - 2 * gap) / 3), 1.0)
    line = _line_height(style)
    below = line if box.height() >= MIN_LINES_WITH_TITLE * line else 0.0
    height = max(min(width, box.height() - line - below), 1.0)
    if not below:
        height = min(height, (MIN_LINES_WITH_TITLE - 2.0) * line - 2.0)  # so that no title is asked for
    height = max(math.floor(height), 1.0)
    top = box.top() + line + 0.5 * (box.height() - line - below - height)
    places = [align_to_pixels(QRectF(box.left() + plane * (width + gap), top, width, height)) for plane in range(3)]
    return [Panel(place, Scale(-1.0, 1.0, (), ()), -1.0, 1.0) for place in places]


class PlaneItem(PixelItem):
    """Whole paths in one plane, with the hand's axes along the first."""

    def __init__(self, plot: Plot, plane: int, plot_data: PathPlot) -> None:
        super().__init__(plot, is_cached=False)
        self.plane, self.plot_data, self.occupied = plane, plot_data, list[QRectF]()

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        if self.plot_data.axes is not None:
            self._paint_axes_along(painter, style, panel, self.plot_data.axes)
        placed = [(way, *self._project_positions(panel, way.position_mm)) for way in self.plot_data.paths]
        for one in placed:
            self._paint_path(painter, style, *one)
        for one in placed:
            self._paint_name(painter, style, panel, *one)

    def _project_positions(self, panel: Panel, place_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        away = place_mm - 0.5 * (self.plot_data.low_mm + self.plot_data.high_mm)
        scale = self.plot_data.per_mm(panel.box)
        across, up, sign = ACROSS[self.plane], UP[self.plane], ACROSS_SIGN[self.plane]
        center = panel.box.center()
        return center.x() + sign * away[:, across] * scale, center.y() - away[:, up] * scale

    def _paint_path(self, painter: QPainter, style: PlotStyle, path: PathLine, x: FloatArray, y: FloatArray) -> None:
        """Paint a path: solid if visible, dashed if occluded."""
        painter.setBrush(Qt.BrushStyle.NoBrush)
        known = np.isfinite(x) & np.isfinite(y)
        for first, last in find_runs(known):
            for seen in (True, False):
                for start, stop in find_runs(path.is_visible[first:last] == seen):
                    begin, end = max(first + start - 1, first), first + stop
                    painter.setPen(
                        dash_pen(style.color(path.token), 0.5 * style.line_width, () if seen else (2.2, 2.2))
                    )
                    painter.drawPolyline(arrayToQPolygonF(x[begin:end], y[begin:end]))

    def _paint_name(
        self, painter: QPainter, style: PlotStyle, panel: Panel, path: PathLine, x: FloatArray, y: FloatArray
    ) -> None:
        """Write the name at the outermost free point of the path; omit it without room."""
        known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
        if not path.name or not len(known):
            return
        metrics = QFontMetricsF(style.end_label_font)
        width, height = metrics.horizontalAdvance(path.name), metrics.height()
        ends = (0, int(np.argmin(y[known])), int(np.argmax(y[known])), int(np.argmax(x[known])))
        for row in known[list(ends)].tolist():
            for left in (float(x[row]) + 5 * style.unit, float(x[row]) - width - 5 * style.unit):
                box = QRectF(left, float(y[row]) - height / 2, width, height)
                inside = panel.box.adjusted(2, 2, -2, -2).contains(box)
                if inside and not any(box.intersects(other) for other in self.occupied):
                    self.occupied.append(box)
                    painter.fillRect(box.adjusted(-1, 2, 1, -2), style.color("surface", 200))
                    color = style.color(path.token)
                    draw_text(painter, box, path.name, style.end_label_font, color, Qt.AlignmentFlag.AlignCenter)
                    return

    def _paint_axes_along(self, painter: QPainter, style: PlotStyle, panel: Panel, axes: FloatArray) -> None:
        place_mm = self.plot_data.paths[0].position_mm
        known = np.flatnonzero(np.isfinite(place_mm).all(axis=1) & np.isfinite(axes).all(axis=(1, 2)))
        if not len(known):
            return
        rows = known[np.unique(np.linspace(0, len(known) - 1, AXES_COUNT).round().astype(np.int64))]
        x, y = self._project_positions(panel, place_mm[rows])
        for k, row in enumerate(rows.tolist()):
            at = QPointF(float(x[k]), float(y[k]))
            self._paint_axes(painter, style, at, axes[row], panel.box.height() * AXIS_FRACTION)

    def _paint_axes(self, painter: QPainter, style: PlotStyle, at: QPointF, turned: FloatArray, length: float) -> None:
        across, up, sign = ACROSS[self.plane], UP[self.plane], ACROSS_SIGN[self.plane]
        for axis, token in enumerate(AXIS_TOKENS):
            away = QPointF(sign * float(turned[across, axis]) * length, -float(turned[up, axis]) * length)
            painter.setPen(QPen(style.color(token, 170), style.unit, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
            painter.drawLine(at, at + away)


def has_title(style: PlotStyle, panel: Panel) -> bool:
    """Return whether the panel is high enough for a title below it."""
    return panel.box.height() > (MIN_LINES_WITH_TITLE - 2.0) * _line_height(style) - 1.0


def _line_height(style: PlotStyle) -> float:
    return QFontMetricsF(style.label_font).height() + 4 * style.unit


class PathsChart(Chart):
    """The paths of a session on paper."""

    def __init__(self, theme: Theme, plot: PathPlot) -> None:
        super().__init__(theme)
        self._plot = plot

    def build(self) -> None:
        ways, look, line = self._plot, self.plot_style, _line_height(self.plot_style)
        panels = plane_panels(look, self.area, 16 * look.unit)
        for plane, (panel, (up, across, title, letters)) in enumerate(zip(panels, plane_names(ways.side), strict=True)):
            plot, box = self.add_plot(panel), panel.box
            pen = plot.pen("line", look.grid_width / look.unit)
            plot.setBorder(pen)
            for angle in (0, 90):
                plot.add_to_layer(pg.InfiniteLine(0.0, angle, pen), GRID)
            item = plot.add_to_layer(PlaneItem(plot, plane, ways), CURVES)
            above, below = box.top() - line / 2, box.bottom() + line / 2
            self.add_text(f"{letters} · {up}", look.label_font, "text2", (0.0, 0.5)).setPos(box.left(), above)
            self.add_text(across, look.label_font, "text2", (1.0, 0.5)).setPos(box.right(), above)
            if has_title(look, panel):
                self.add_text(title, look.end_label_font, "text", (0.0, 0.5)).setPos(box.left(), below)
            self._add_bar(item, ways)

    def _add_bar(self, item: PlaneItem, plot_data: PathPlot) -> None:
        """Add the scale bar in the lower left corner."""
        plot, look, unit = item.plot, self.plot_style, self.plot_style.unit
        box, line = plot.panel.box, _line_height(look)
        item.occupied.append(QRectF(0.0, box.height() - 1.6 * line, 0.32 * box.width(), 1.6 * line))
        length, across, up = plot_data.bar_mm(box), 2.0 / box.width(), 2.0 / box.height()  # a panel goes from -1 to 1
        start, y = -1.0 + 8 * unit * across, -1.0 + 8 * unit * up
        plot.add_line([start, start + length * plot_data.per_mm(box) * across], [y, y], "border", 1.5, layer=LINES)
        words = self.add_text(f"{format_rounded(length)}{numbers.NARROW_GAP}mm", look.label_font, "text2", (0.0, 1.0))
        words.setPos(box.left() + 8 * unit, box.bottom() - 10 * unit)


def paint_paths(painter: QPainter, style: PlotStyle, plot: PathPlot, box: QRectF) -> None:
    """Paint the chart into a box on paper."""
    chart = PathsChart(Theme("light"), plot)
    chart.render_on_paper(painter, style, box)
    chart.deleteLater()

"""Ways through the room in the three planes of the papers: of the wrist with the hand's axes, and of finger joints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from pyqtgraph.functions import arrayToQPolygonF
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.hand.exercises import STILL_RADIUS_MM
from carpus.core.results.motion_curves import MotionCurves
from carpus.core.rounding import written
from carpus.core.types import FloatArray, Side
from carpus.ui import numbers
from carpus.ui.controls.text import paint_status
from carpus.ui.figures import FINGERS
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.marker_words import finger_name
from carpus.ui.plot.axes import Panel, Scale, crisp
from carpus.ui.plot.chart import CURVES, FRONT, GRID, LINES, Chart, Layer, PixelItem, Plot
from carpus.ui.plot.history import SHOWN_S, History
from carpus.ui.plot.series import find_runs
from carpus.ui.plot.style import RIGHT_MIDDLE, PlotStyle, dashed, paint_dot, write
from carpus.ui.theme import Theme
from carpus.ui.translate import tr

EDGE_PX, HEAD_PX, BETWEEN_PX = 20, 34, 14
STILL_SPAN_MM, FREE_SPAN_MM = 60.0, 600.0
"""Side of the squares while it is measured: for exercises with a still forearm, and for all others."""
LIVE_SHARE = 0.22
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
UP = (0, 2, 2)
ACROSS = (1, 0, 1)
ACROSS_SIGN = (-1.0, 1.0, -1.0)
"""From above and from the fingers Y of W0 points to the left of the picture, on both hands."""
AXIS_TOKENS = ("curve_c", "curve_a", "curve_b")
"""X turns pro/supination, Y flexion, Z deviation: each axis has the colour of its angle."""
AXIS_LETTERS = ("X", "Y", "Z")
PLANE_LETTERS = ("XY", "ZX", "ZY")


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
    room: float = ROOM
    recent_s: float = RECENT_S
    """What is drawn strongly before the present place."""
    axis_share: float = NOW_SHARE
    """Length of the hand's axes at the present place, of the panel's height."""
    is_whole: bool = True
    """All of a session, with the hand's axes along it."""

    def per_mm(self, box: QRectF) -> float:
        """Painter units for a millimetre in a panel of this size, the same in all three planes and in both
        directions."""
        needs = np.maximum(self.room * (self.high_mm - self.low_mm), LEAST_SPAN_MM)
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
        (tr("fingers ↑"), thumb, tr("From above"), PLANE_LETTERS[0]),
        (tr("up ↑"), tr("fingers →"), tr("From the side"), PLANE_LETTERS[1]),
        (tr("up ↑"), thumb, tr("From the fingers"), PLANE_LETTERS[2]),
    )


def side_by_side(style: PlotStyle, box: QRectF, gap: float) -> list[Panel]:
    """Three panels side by side in a box, none higher than wide, with a line of words over each and one under it
    where there is room."""
    width = max(math.floor((box.width() - 2 * gap) / 3), 1.0)
    line = _line(style)
    below = line if box.height() >= ROOMY_LINES * line else 0.0
    height = max(min(width, box.height() - line - below), 1.0)
    if not below:
        height = min(height, (ROOMY_LINES - 2.0) * line - 2.0)  # so that no title is asked for
    height = max(math.floor(height), 1.0)
    top = box.top() + line + 0.5 * (box.height() - line - below - height)
    places = [crisp(QRectF(box.left() + plane * (width + gap), top, width, height)) for plane in range(3)]
    return [Panel(place, Scale(-1.0, 1.0, (), ()), -1.0, 1.0) for place in places]


class PlaneItem(PixelItem):
    """Ways in one plane up to ``until_s``, NaN for the whole way without an end, with the hand's axes as three lines:
    their letters and the names of the ways find room that pyqtgraph does not look for."""

    def __init__(self, plot: Plot, plane: int) -> None:
        super().__init__(plot, kept=False)
        self.plane, self.taken = plane, list[QRectF]()
        self.ways: WayPlot | None = None
        self.until_s = math.nan

    def show(self, ways: WayPlot | None, until_s: float) -> None:
        self.ways, self.until_s = ways, until_s
        self.update()

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        if self.ways is None:
            return
        if self.ways.axes is not None and self.ways.is_whole:
            self._paint_axes_along(painter, style, panel, self.ways.axes)
        taken = [*self.taken]
        row = self._row()
        for way in self.ways.ways:
            x, y = self._places(panel, way.place_mm)
            self._paint_way(painter, style, way, x, y)
            if row >= 0 and math.isfinite(float(x[row] + y[row])):
                paint_dot(painter, style, QPointF(float(x[row]), float(y[row])), way.token, 4.5)
        for way in self.ways.ways:
            self._paint_name(painter, style, panel, way, self._places(panel, way.place_mm), taken)
        if row >= 0 and self.ways.axes is not None:
            place = self._places(panel, self.ways.ways[0].place_mm[row : row + 1])
            at = QPointF(float(place[0][0]), float(place[1][0]))
            self._paint_axes(
                painter, style, at, self.ways.axes[row], panel.box.height() * self.ways.axis_share, lettered=True
            )

    def _row(self) -> int:
        assert self.ways is not None
        if not math.isfinite(self.until_s) or not len(self.ways.time_s):
            return -1
        return int(np.abs(self.ways.time_s - self.until_s).argmin())

    def _places(self, panel: Panel, place_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Where they are in the panel."""
        assert self.ways is not None
        away = place_mm - 0.5 * (self.ways.low_mm + self.ways.high_mm)
        scale = self.ways.per_mm(panel.box)
        across, up, sign = ACROSS[self.plane], UP[self.plane], ACROSS_SIGN[self.plane]
        center = panel.box.center()
        return center.x() + sign * away[:, across] * scale, center.y() - away[:, up] * scale

    def _paint_way(self, painter: QPainter, style: PlotStyle, way: WayLine, x: FloatArray, y: FloatArray) -> None:
        """Solid where it was seen, dashed where it was not; of a way with an end what lies ahead is faint."""
        assert self.ways is not None
        painter.setBrush(Qt.BrushStyle.NoBrush)
        known = np.isfinite(x) & np.isfinite(y)
        row = self._row()
        for first, last in find_runs(known):
            for seen in (True, False):
                for start, stop in find_runs(way.seen[first:last] == seen):
                    begin, end = max(first + start - 1, first), first + stop
                    pen = QPen(style.color(way.token), style.line_width if row >= 0 else 0.5 * style.line_width)
                    if row >= 0:
                        pen.setColor(style.color(way.token, 120))
                    if not seen:
                        pen.setDashPattern([2.2, 2.2])
                    painter.setPen(pen)
                    painter.drawPolyline(arrayToQPolygonF(x[begin:end], y[begin:end]))
        if row >= 0:
            recent = int(np.searchsorted(self.ways.time_s, self.ways.time_s[row] - self.ways.recent_s))
            painter.setPen(QPen(style.color(way.token), 2.0 * style.line_width))
            for first, last in find_runs(known[recent : row + 1]):
                painter.drawPolyline(
                    arrayToQPolygonF(x[recent + first : recent + last], y[recent + first : recent + last])
                )

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
        assert self.ways is not None
        place_mm = self.ways.ways[0].place_mm
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
        named = PLANE_LETTERS[self.plane]  # the plane's own first: where two would touch, the third goes without
        for axis in sorted(range(3), key=lambda axis: AXIS_LETTERS[axis] not in named):
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
            box = QRectF(center.x() - size, center.y() - size, 2 * size, 2 * size)
            small, edge = box.adjusted(size / 3, size / 3, -size / 3, -size / 3), 0.6 * size
            inside = QRectF(self.plot.rect()).adjusted(edge, edge, -edge, -edge).contains(center)
            inside = inside and not any(small.intersects(other) for other in self.taken)
            if lettered and reach >= size and free and inside:
                letters.append(center)
                face, middle = font(size, SEMIBOLD, display=False), Qt.AlignmentFlag.AlignCenter
                write(painter, box, AXIS_LETTERS[axis], face, color, middle)


class BallItem(PixelItem):
    """Where the point that the wrist turns about must stay, a ring, and where it is, a cross."""

    def __init__(self, plot: Plot, plane: int, words: str) -> None:
        super().__init__(plot, kept=False)
        self._plane, self._words = plane, words
        self._now: tuple[FloatArray, FloatArray, float] | None = None

    def show(self, home_mm: FloatArray, now_mm: FloatArray, per_mm: float) -> None:
        self._now = home_mm, now_mm, per_mm
        self.update()

    def paint_pixels(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        if self._now is None or not np.isfinite(self._now[0] + self._now[1]).all():
            return
        home, now = (panel.box.center() + _project_place(self._plane, place) * self._now[2] for place in self._now[:2])
        radius = STILL_RADIUS_MM * self._now[2]
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(dashed(style.color("border"), style.unit, (4, 3)))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(home, radius, radius)
        painter.setPen(QPen(style.color("text"), 1.5 * style.unit))
        for dx, dy in ((4.0, 0.0), (0.0, 4.0)):
            arm = QPointF(dx * style.unit, dy * style.unit)
            painter.drawLine(now - arm, now + arm)
        if self._words:
            at = QPointF(home.x() + 6, home.y() - radius - 4)
            write(painter, at, self._words, style.label, style.color("text2"))


def _project_place(plane: int, place: FloatArray) -> QPointF:
    """Of something in W0, as it goes on in the picture."""
    return QPointF(ACROSS_SIGN[plane] * float(place[ACROSS[plane]]), -float(place[UP[plane]]))


def is_titled(style: PlotStyle, panel: Panel) -> bool:
    """Whether there is a line of words under a square too."""
    return panel.box.height() > (ROOMY_LINES - 2.0) * _line(style) - 1.0


def _line(style: PlotStyle) -> float:
    return QFontMetricsF(style.label).height() + 4 * style.unit


class PlanesChart(Chart):
    """Three squares, each with its frame and a cross through its middle."""

    def add_planes(self, panels: Sequence[Panel]) -> list[PlaneItem]:
        out = []
        for plane, panel in enumerate(panels):
            plot = self.add_plot(panel)
            plot.setBorder(plot.pen("line", self.look.grid_width / self.look.unit))
            for angle in (0, 90):
                line = pg.InfiniteLine(0.0, angle, plot.pen("line", self.look.grid_width / self.look.unit))
                plot.add_to_layer(line, GRID)
            out.append(plot.add_to_layer(PlaneItem(plot, plane), CURVES))
        return out


class WaysChart(PlanesChart):
    """The card with the ways of a session, of the wrist with the hand's axes or of finger joints, up to the player's
    time; on paper all of them, without a title."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self._plot: WayPlot | None = None
        self._title = ""
        self._time_s = math.nan
        self._planes: list[PlaneItem] = []
        self.setAccessibleName(self.tr("Ways in three planes"))

    def show_plot(self, plot: WayPlot, title: str = "") -> None:
        self._plot, self._title = plot, title
        self.refresh()

    def set_time(self, time_s: float) -> None:
        self._time_s = time_s
        for item in self._planes:
            item.show(self._plot, self._time_s)

    def panels(self) -> list[Panel]:
        if self.on_paper:
            return side_by_side(self.look, self.area, 16 * self.look.unit)
        head = HEAD_PX * self._theme.text_scale
        box = QRectF(self.rect()).adjusted(EDGE_PX, head, -EDGE_PX, -10)
        return side_by_side(self.look, box, BETWEEN_PX)

    def build(self) -> None:
        ways, look, line = self._plot, self.look, _line(self.look)
        self._planes = []
        if ways is None:
            return
        if not self.on_paper:
            scale = self._theme.text_scale
            self.text(self._title, font(14 * scale, SEMIBOLD), "text", (0.0, 0.5)).setPos(EDGE_PX, 19 * scale)
        panels = self.panels()
        self._planes = self.add_planes(panels)
        for panel, item, (up, across, title, letters) in zip(panels, self._planes, plane_names(ways.side), strict=True):
            box = panel.box
            self.text(f"{letters} · {up}", look.label, "text2", (0.0, 0.5)).setPos(box.left(), box.top() - line / 2)
            self.text(across, look.label, "text2", (1.0, 0.5)).setPos(box.right(), box.top() - line / 2)
            if is_titled(look, panel):
                self.text(title, look.end_label, "text", (0.0, 0.5)).setPos(box.left(), box.bottom() + line / 2)
            self._add_bar(item, ways)
            item.show(ways, math.nan if self.on_paper else self._time_s)

    def _add_bar(self, item: PlaneItem, ways: WayPlot) -> None:
        """How long so many millimetres are, in the lower left corner."""
        plot, look, unit = item.plot, self.look, self.look.unit
        box, line = plot.panel.box, _line(look)
        item.taken.append(QRectF(0.0, box.height() - 1.6 * line, 0.32 * box.width(), 1.6 * line))
        length, across, up = ways.bar_mm(box), 2.0 / box.width(), 2.0 / box.height()  # a panel goes from -1 to 1
        start, y = -1.0 + 8 * unit * across, -1.0 + 8 * unit * up
        plot.add_line([start, start + length * ways.per_mm(box) * across], [y, y], "border", 1.5, layer=LINES)
        words = self.text(f"{written(length)}{numbers.NARROW_GAP}mm", look.label, "text2", (0.0, 1.0))
        words.setPos(box.left() + 8 * unit, box.bottom() - 10 * unit)


class PathView(PlanesChart):
    """The card with the path of the wrist and its axes over the last seconds, in three squares of fixed size (figures 3
    and 5 of the wrist paper)."""

    usual_px, least_px = (520, 242), (380, 180)

    def __init__(self, theme: Theme, history: History) -> None:
        super().__init__(theme)
        self._history = history
        self._side: Side = "right"
        self._pure = True
        self._planes: list[PlaneItem] = []
        self._balls: list[BallItem] = []
        self.setAccessibleName(self.tr("Path of the wrist"))

    def set_exercise(self, side: Side, pure_wrist: bool) -> None:
        self._side, self._pure = side, pure_wrist
        self.refresh()

    # --- places -------------------------------------------------------------------------------------------
    def _head(self) -> QRectF:
        return QRectF(20, 12, self.width() - 40, 24 * self._theme.text_scale)

    def panels(self) -> list[Panel]:
        """The squares of the three planes; both axes in millimetres from the forearm's place at rest."""
        scale = self._theme.text_scale
        top = self._head().bottom() + 6
        size = min((self.width() - 40 - 2 * 15) / 3, self.height() - top - 46 * scale)
        gap = (self.width() - 40 - 3 * size) / 2
        boxes = [crisp(QRectF(20 + plane * (size + gap), top, size, size)) for plane in range(3)]
        return [Panel(box, Scale(-1.0, 1.0, (), ()), -1.0, 1.0) for box in boxes]

    def _span_mm(self) -> float:
        return STILL_SPAN_MM if self._pure else FREE_SPAN_MM

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        look, scale = self.look, self._theme.text_scale
        self.text(self.tr("Path of the wrist, last 10 s"), font(14 * scale, SEMIBOLD), "text", (0.0, 0.5)).setPos(
            20, self._head().center().y()
        )
        self._planes = self.add_planes(self.panels())
        self._balls = []
        for plane, (item, (up, across, title, letters)) in enumerate(
            zip(self._planes, plane_names(self._side), strict=True)
        ):
            box, metrics = item.plot.panel.box, QFontMetricsF(look.label)
            fits = metrics.horizontalAdvance(up) + metrics.horizontalAdvance(across) + 24 <= box.width()
            height = metrics.height()
            over = box.top() + 4 * scale
            beside = over if fits else box.bottom() - 4 * scale - height  # below, the ring may lie
            for words, anchor, x, y in ((up, 0.0, box.left() + 8, over), (across, 1.0, box.right() - 8, beside)):
                self.text(words, look.label, "text2", (anchor, 0.0)).setPos(x, y)
                wide = metrics.horizontalAdvance(words)
                item.taken.append(QRectF(x - anchor * wide - box.left(), y - box.top(), wide, height))
            self.text(title, look.end_label).setPos(box.left(), box.bottom() + 4)
            self.text(letters, look.end_label, "text2", (1.0, 0.0)).setPos(box.right(), box.bottom() + 4)
            if self._pure:
                ball = item.plot.add_to_layer(BallItem(item.plot, plane, self.tr("15 mm") if plane == 0 else ""), FRONT)
                self._balls.append(ball)
        words = self.tr("{span} × {span} mm, fixed").format(span=written(self._span_mm()))
        if self._pure:
            words += self.tr(" · cross: where the wrist turns; it must stay in the ring")
        at = self._planes[0].plot.panel.box.bottom() + 26 * scale
        self.text(words, font(12 * scale, REGULAR), "text2").setPos(20, at)
        self._said = Layer(self, self._head(), self._paint_forearm)
        self.draw()

    def draw(self) -> None:
        """What moves has changed."""
        if not self.plots or not self.isVisible():
            return
        history = self._history
        way, turned, half = history.path_mm(), history.axes(), np.full(3, self._span_mm() / 2)
        line = WayLine(way, "accent", "", np.ones(len(way), dtype=bool))
        time_s = np.linspace(-SHOWN_S, 0.0, len(way))
        ways = WayPlot(time_s, [line], turned, self._side, -half, half, 1.0, SHOWN_S / 2, LIVE_SHARE, is_whole=False)
        for item in self._planes:
            item.show(ways if len(way) else None, 0.0)
        for ball in self._balls:
            ball.show(history.centre_home_mm(), history.centre_mm(), ways.per_mm(ball.plot.panel.box))
        self._said.update()

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


def paint_ways(painter: QPainter, look: PlotStyle, plot: WayPlot, box: QRectF) -> None:
    """The chart on paper, with its words, in a box."""
    chart = WaysChart(Theme("light"))
    chart.show_plot(plot)
    chart.render_on_paper(painter, look, box)
    chart.deleteLater()

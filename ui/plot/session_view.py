"""The card with the session's curves: cursor by mouse and keys, edges of a repetition by drag, zoom along the time."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from carpus.ui import numbers
from carpus.ui.figures import with_side
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.plot import axes
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.marks import NUMBERS_ABOVE, Cursor, Curves, Dot, Edges, MouseReadout, Target, fitted, room_at
from carpus.ui.plot.session import HandPlot, SessionPlot, Value, paint_behind, paint_session, session_table, with_edge
from carpus.ui.plot.style import PlotStyle, screen_style, write
from carpus.ui.plot.zoom_card import ZoomCard
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas, Layer

LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX, BETWEEN_PX = 122, 108, 38, 30, 18
HAND_BETWEEN_PX = 8
GRIP_PX = 16
"""Half the width of the target around an edge or the cursor: the grip is 8 px wide, the target 32."""
SHORTEST_S = 2.0
"""Shortest stretch of time that is shown."""


class CurveView(ZoomCard):
    """Emits ``cursor_moved`` (seconds) and ``edges_moved`` (repetition, start, end)."""

    usual_px, least_px = (736, 360), (420, 240)
    shortest = SHORTEST_S

    cursor_moved = Signal(float)
    edges_moved = Signal(int, float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "curves")
        self._plot: SessionPlot | None = None
        self._time_s = 0.0
        self._held = ""
        """What a drag has taken: an edge (``start``, ``end``), the ``cursor``, or nothing."""
        self._single = False
        self._mouse: QPointF | None = None
        self.setAccessibleName(self.tr("Curves of the session"))

    def show_plot(self, plot: SessionPlot) -> None:
        """Draw another session, or the same with other repetitions, where it was looked at."""
        self._plot = replace(plot, window_s=self._window)
        self.forget()

    def clear(self) -> None:
        self._plot = self._window = None
        self.forget()

    def show_single(self, on: bool) -> None:
        """Only the trained angle, where large text leaves no room for three."""
        if on != self._single:
            self._single = on
            self.forget()

    def set_time(self, time_s: float) -> None:
        """Put the cursor; what is shown goes on with it."""
        self._time_s = time_s
        if self._window is not None and self._plot is not None and not self._held:
            start_s, end_s = self._window
            if not start_s <= time_s <= end_s:
                begin_s = time_s - 0.1 * (end_s - start_s)
                self.show_window((begin_s, begin_s + end_s - start_s))
        if self._canvas is not None:
            self._over.update()

    # --- window -------------------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float] | None:
        return None if self._plot is None else (0.0, self._plot.end_s)

    def about(self) -> float:
        return self._time_s

    def show_window(self, window: tuple[float, float] | None) -> None:
        shown = self._canvas
        self._canvas = None  # laid out once, below
        super().show_window(window)
        self._canvas = shown
        if self._plot is not None:
            self.show_plot(self._plot)

    # --- places -------------------------------------------------------------------------------------------
    def panels(self) -> list[tuple[Panel, int]]:
        assert self._plot is not None
        scale = self._theme.text_scale
        box = QRectF(self.rect()).adjusted(LEFT_PX * scale, TOP_PX * scale, -RIGHT_PX * scale, -BOTTOM_PX * scale)
        between = HAND_BETWEEN_PX if isinstance(self._plot, HandPlot) else BETWEEN_PX
        placed = self._plot.panels(box, between * scale, single=self._single)
        return [(replace(panel, box=axes.crisp(panel.box)), key) for panel, key in placed]

    # --- what is in it ------------------------------------------------------------------------------------
    def furnish(self, canvas: Canvas) -> None:
        super().furnish(canvas)
        self._over: Layer = canvas.add_layer(self._paint_over)
        self._said: Layer = canvas.add_layer(self._paint_said)

    def lay_out(self, canvas: Canvas) -> None:
        self.more.setVisible(self._plot is not None)
        placed = [] if self._plot is None else [panel for panel, _ in self.panels()]
        canvas.lay_out(placed, self.extent(), self.shortest)
        for layer in (self._over, self._said):
            layer.cover(QRectF(self.rect()))
            layer.update()

    def show_marks(self, canvas: Canvas) -> None:
        plot = self._plot
        if plot is not None:
            canvas.show_marks([[Curves(plot.moving(key, int(panel.box.width() / 2)))] for panel, key in self.panels()])

    def paint_ground(self, painter: QPainter) -> None:
        plot, style, scale = self._plot, screen_style(self._theme), self._theme.text_scale
        if plot is None:
            return
        painter.setFont(style.label)
        painter.setPen(style.color("text2"))
        if plot.repetitions:
            painter.drawText(QPointF(20, TOP_PX * scale - NUMBERS_ABOVE), self.tr("Repetitions"))
        words, panels = self.tr("Ctrl+wheel: zoom"), self.panels()
        if 10 + painter.fontMetrics().horizontalAdvance(words + "0") < panels[-1][0].box.left():  # before the times
            painter.drawText(QPointF(10, self.height() - 10 * scale), words)
        paint_behind(painter, style, plot, panels)

    def _paint_over(self, painter: QPainter) -> None:
        plot = self._plot
        if plot is None:
            return
        style, panels = screen_style(self._theme), self.panels()
        if 0 <= plot.current < len(plot.repetitions):
            repetition = plot.repetitions[plot.current]
            Edges(repetition.start_s, repetition.end_s).paint(painter, style, panels[0][0])
            for mark in plot.still(0, panels[0][1]):
                if isinstance(mark, Target):
                    mark.paint_words(painter, style, panels[0][0], "surface")
        start_s, end_s = plot.shown_s
        if start_s <= self._time_s <= end_s:
            for panel, _ in panels:
                Cursor(self._time_s).paint(painter, style, panel)
            paint_readings(painter, style, plot, panels, self._time_s)

    # --- read-out -----------------------------------------------------------------------------------------
    def hover(self, at: QPointF | None) -> None:
        """What is under the mouse: a line through all panels, and the values of the panel it is in."""
        if self._plot is None:
            return
        inside = at is not None and any(panel.box.contains(at) for panel, _ in self.panels())
        self._mouse = at if inside and not self._held else None
        self._said.update()
        over_edge = at is not None and self._edge_at(at) != ""
        pans = inside and self._window is not None
        shape = Qt.CursorShape.SizeHorCursor if over_edge else Qt.CursorShape.OpenHandCursor
        self.face.setCursor(shape if over_edge or pans else Qt.CursorShape.ArrowCursor)

    def said_at(self, at: QPointF) -> list[str]:
        plot = self._plot
        assert plot is not None
        time_s = self.time_at(at.x())
        lines = [numbers.clock_tenths(time_s)]
        for panel, key in self.panels():
            if panel.box.contains(at):
                for value in plot.values(key, time_s):
                    hidden = self.tr("hidden") if value.hidden and math.isfinite(value.value_deg) else ""
                    named = value.name if not math.isfinite(value.value_deg) else f"{value.name} {value.words} {hidden}"
                    named = value.said or named
                    lines.append(named.strip())
        return lines

    def _paint_said(self, painter: QPainter) -> None:
        if self._mouse is None or self._plot is None:
            return
        style, time_s = screen_style(self._theme), self.time_at(self._mouse.x())
        for panel, _ in self.panels():
            Cursor(time_s, "text2", 1.0).paint(painter, style, panel)
        MouseReadout(self.said_at(self._mouse), self._mouse, QRectF(self.rect()).adjusted(4, 4, -4, -4)).paint(
            painter, style
        )

    # --- mouse --------------------------------------------------------------------------------------------
    def _edge_at(self, point: QPointF) -> str:
        """``start`` or ``end`` of the current repetition under the mouse, empty for none."""
        plot = self._plot
        if plot is None or not 0 <= plot.current < len(plot.repetitions):
            return ""
        panel = self.panels()[0][0]
        if not panel.box.top() <= point.y() <= panel.box.bottom():
            return ""
        repetition = plot.repetitions[plot.current]
        away = {
            "start": abs(point.x() - float(panel.x(repetition.start_s))),
            "end": abs(point.x() - float(panel.x(repetition.end_s))),
        }
        nearest = min(away, key=lambda edge: away[edge])
        return nearest if away[nearest] <= GRIP_PX else ""

    def time_at(self, x: float) -> float:
        panel = self.panels()[0][0]
        share = (x - panel.box.left()) / max(panel.box.width(), 1.0)
        return panel.start_s + min(max(share, 0.0), 1.0) * (panel.end_s - panel.start_s)

    def click(self, event: Any) -> None:
        """Once the cursor, twice the repetitions alone and the whole again."""
        if self._plot is None:
            return
        if event.double():
            self.show_window(self._plot.repetitions_s if self._plot.window_s is None else None)
        elif not self._edge_at(event.scenePos()):
            self.cursor_moved.emit(self.time_at(event.scenePos().x()))

    def drag(self, event: Any) -> bool:
        """An edge, the cursor, or with nothing to move along the cursor too; anything else moves along the time."""
        if self._plot is None or event.button() != Qt.MouseButton.LeftButton:
            return False
        if event.isStart():
            at = event.buttonDownScenePos()
            panel = self.panels()[0][0]
            at_cursor = abs(float(panel.x(self._time_s)) - at.x()) <= GRIP_PX
            self._held = self._edge_at(at) or ("cursor" if at_cursor or self._window is None else "")
            self._mouse = None
        held, time_s = self._held, self.time_at(event.scenePos().x())
        if held == "cursor":
            self.cursor_moved.emit(time_s)
        elif held:
            self._move_edge(held, time_s, over=event.isFinish())
        if event.isFinish():
            self._held = ""
        return bool(held)

    def _move_edge(self, edge: str, time_s: float, *, over: bool) -> None:
        plot = self._plot
        assert plot is not None
        moved = with_edge(plot.repetitions[plot.current], edge, time_s)
        shown = list(plot.repetitions)
        shown[plot.current] = moved
        self.show_plot(replace(plot, repetitions=shown))
        if over:
            self.edges_moved.emit(plot.current, moved.start_s, moved.end_s)

    # --- for other programs -------------------------------------------------------------------------------
    def paint_on(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        assert self._plot is not None
        unit = style.unit
        between = HAND_BETWEEN_PX if isinstance(self._plot, HandPlot) else BETWEEN_PX
        inner = box.adjusted(106 * unit, 26 * unit, -8 * unit, -22 * unit)
        paint_session(painter, style, self._plot, self._plot.panels(inner, between * unit, single=self._single))

    def table(self) -> tuple[Sequence[str], Iterable[Sequence[str]]]:
        assert self._plot is not None
        return session_table(self._plot, [key for _, key in self.panels()])


def paint_readings(
    painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[tuple[Panel, int]], time_s: float
) -> None:
    """Dots on the curves under the cursor and their numbers at the right; a hidden joint in the second colour."""
    shown = [plot.values(key, time_s) for _, key in panels]
    for (panel, _), values in zip(panels, shown, strict=True):
        for value in values:
            if not value.hidden and value.share == 1.0:
                Dot(time_s, value.value_deg, value.token).paint(painter, style, panel)
    if plot.has_readings:
        for (panel, _), values in zip(panels, shown, strict=True):
            _paint_in_rows(painter, style, panel, values, 18.0 * _scale(style), spreads=0)
        return
    if not isinstance(plot, HandPlot):
        for (panel, _), values in zip(panels, shown, strict=True):
            _paint_named(painter, style, panel, values[0])
        return
    scale, most = _scale(style), max(map(len, shown))
    for (panel, key), values in zip(panels, shown, strict=True):
        step = (20.0 if plot.finger else 15.0) * scale
        if not plot.finger and step * most > _pitch(panels):
            _paint_in_one_line(painter, style, panel, values)
        else:
            spreads = plot.finger if key == 1 else 0
            _paint_in_rows(painter, style, panel, values, step, spreads=spreads)


def _scale(style: PlotStyle) -> float:
    return style.end_label.pixelSize() / 12.0


def _pitch(panels: Sequence[tuple[Panel, int]]) -> float:
    return panels[1][0].box.top() - panels[0][0].box.top() if len(panels) > 1 else math.inf


def _paint_named(painter: QPainter, style: PlotStyle, panel: Panel, value: Value) -> None:
    scale = _scale(style)
    left, middle = panel.box.right() + 14 * scale, panel.box.center().y()
    face = fitted(font(14 * scale, REGULAR), value.name, room_at(painter, left))
    write(painter, QPointF(left, middle - 4 * scale), value.name, face, style.color("text2"))
    if not math.isfinite(value.value_deg):
        return
    angle, at, face = numbers.degrees(value.value_deg), QPointF(left, middle + 19 * scale), font(20 * scale, SEMIBOLD)
    write(painter, at, angle, face, style.color("text"))
    at += QPointF(QFontMetricsF(face).horizontalAdvance(angle) + 5, 0.0)
    write(painter, at, numbers.spread(value.sd_deg), font(14 * scale, MEDIUM), style.color("text2"))


def _paint_in_rows(
    painter: QPainter, style: PlotStyle, panel: Panel, values: Sequence[Value], step: float, *, spreads: int
) -> None:
    """One under the other, each after a stroke of its curve; ``spreads``: the finger whose spreading it is, or 0."""
    scale = _scale(style)
    left, line = panel.box.right() + 12 * scale, panel.box.center().y() - step * (len(values) - 1) / 2
    for value in values:
        painter.setPen(_stroke(style, value, 2.5))
        painter.drawLine(QPointF(left, line), QPointF(left + 12 * scale, line))
        face, color = _look(style, value, 14)
        at = QPointF(left + 18 * scale, line + 5 * scale)
        write(painter, at, with_side(value.value_deg, spreads) if spreads else value.words, face, color)
        if spreads and math.isfinite(value.value_deg):  # with its side, and so with no room beside it
            below = at + QPointF(0.0, 16 * scale)
            write(painter, below, numbers.spread(value.sd_deg), font(12 * scale, MEDIUM), color)
        line += step


def _paint_in_one_line(painter: QPainter, style: PlotStyle, panel: Panel, values: Sequence[Value]) -> None:
    """Side by side, each over a stroke of its curve, where there is no room for a row each."""
    scale = _scale(style)
    left, middle = panel.box.right() + 12 * scale, panel.box.center().y()
    for value in values:
        face, color = _look(style, value, 12)
        write(painter, QPointF(left, middle + 3 * scale), numbers.degrees(value.value_deg), face, color)
        painter.setPen(_stroke(style, value, 2.0))
        painter.drawLine(QPointF(left, middle + 8 * scale), QPointF(left + 22 * scale, middle + 8 * scale))
        left += 32.0 * scale


def _look(style: PlotStyle, value: Value, size: int) -> tuple[QFont, QColor]:
    """Face and colour of a number: one that was hidden is weaker."""
    weight, token = (MEDIUM, "text2") if value.hidden else (SEMIBOLD, "text")
    return font(size * _scale(style), weight), style.color(token)


def _stroke(style: PlotStyle, value: Value, width: float) -> QPen:
    pen = QPen(style.color(value.token), width * value.share * style.unit)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    if value.hidden:
        pen.setDashPattern([1.6, 1.4])
    return pen

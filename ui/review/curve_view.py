"""The card with the session's curves: cursor by mouse, edges of a repetition by drag."""

from __future__ import annotations

import math
from dataclasses import replace

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QFontMetricsF,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QResizeEvent,
    QWheelEvent,
)  # fmt: skip
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.output.exercises import SIDES
from ui import numbers, terms
from ui.controls.card import paint_card
from ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from ui.plot.axes import Panel
from ui.plot.series import paint_point
from ui.plot.style import CURVE_TOKENS, screen_style
from ui.review.curves import SessionPlot, paint_edges, paint_session, place_panels, value_at
from ui.review.hand_curves import HandPlot, paint_hand_cursor, paint_hand_session, place_hand_panels
from ui.theme import Theme

LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX, BETWEEN_PX = 122, 108, 38, 30, 18
HAND_BETWEEN_PX = 8
GRIP_PX = 16
"""Half the width of the target around an edge: the grip is 8 px wide, the target 32."""
SHORTEST_S, ZOOM_STEP = 2.0, 1.25
"""Shortest stretch of time that is shown, and how much a notch of the wheel changes it."""
EDGES_S = 0.2
"""Least length a repetition can be cut to."""


class CurveView(QWidget):
    """Emits ``cursor_moved`` (seconds) and ``edges_moved`` (repetition, start, end)."""

    cursor_moved = Signal(float)
    edges_moved = Signal(int, float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._plot: SessionPlot | None = None
        self._time_s = 0.0
        self._still: QPixmap | None = None
        self._window_s: tuple[float, float] | None = None
        self._dragged_edge = -1
        self._single = False
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMouseTracking(True)
        self.setAccessibleName(self.tr("Curves of the session"))
        theme.changed.connect(self._forget)

    def show_plot(self, plot: SessionPlot) -> None:
        """Draw another session, or the same with other repetitions, where it was looked at."""
        self._plot = replace(plot, window_s=self._window_s)
        self._forget()

    def clear(self) -> None:
        """Nothing, as before another session is there."""
        self._plot = self._window_s = None
        self._forget()

    def show_window(self, window_s: tuple[float, float] | None) -> None:
        """Show a part of the time axis, or all of it."""
        self._window_s = window_s
        if self._plot is not None:
            self.show_plot(self._plot)

    def show_single(self, on: bool) -> None:
        """Only the trained angle, where large text leaves no room for three."""
        if on != self._single:
            self._single = on
            self._forget()

    def set_time(self, time_s: float) -> None:
        """Put the cursor; what is shown goes on with it."""
        self._time_s = time_s
        if self._window_s is not None and self._plot is not None and not self._dragged_edge >= 0:
            start_s, end_s = self._window_s
            if not start_s <= time_s <= end_s:
                begin_s = min(max(time_s - 0.1 * (end_s - start_s), 0.0), self._plot.end_s - (end_s - start_s))
                self.show_window((begin_s, begin_s + end_s - start_s))
        self.update()

    def _forget(self) -> None:
        self._still = None
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(736, 360)

    def minimumSizeHint(self) -> QSize:
        return QSize(420, 240)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._forget()

    def panels(self) -> list[tuple[Panel, int]]:
        """Where the panels are."""
        assert self._plot is not None
        scale = self._theme.text_scale
        box = QRectF(self.rect()).adjusted(LEFT_PX * scale, TOP_PX * scale, -RIGHT_PX * scale, -BOTTOM_PX * scale)
        if isinstance(self._plot, HandPlot):
            return place_hand_panels(self._plot, box, HAND_BETWEEN_PX * scale, single=self._single)
        return place_panels(self._plot, box, BETWEEN_PX * scale, single=self._single)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        if self._still is None:
            self._still = self._paint_still()
        painter.drawPixmap(0, 0, self._still)
        if self._plot is None:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        style, panels = screen_style(self._theme), self.panels()
        paint_edges(painter, style, self._plot, panels)
        x = float(panels[0][0].x(self._time_s))
        if not panels[0][0].box.left() <= x <= panels[0][0].box.right():
            return
        painter.setPen(QPen(self._theme.color("text"), 1.5))
        for panel, _ in panels:
            painter.drawLine(QPointF(x, panel.box.top() - 2), QPointF(x, panel.box.bottom() + 2))
        if isinstance(self._plot, HandPlot):
            paint_hand_cursor(painter, style, self._plot, panels, self._time_s)
            return
        for panel, column in panels:
            value, sd = value_at(self._plot.curves, column, self._time_s)
            paint_point(painter, style, panel, self._time_s, value, CURVE_TOKENS[column])
            self._paint_value(painter, panel, column, value, sd)

    def _paint_value(self, painter: QPainter, panel: Panel, column: int, value: float, sd: float) -> None:
        theme, scale = self._theme, self._theme.text_scale
        left, middle = panel.box.right() + 14 * scale, panel.box.center().y()
        known = math.isfinite(value)
        name = terms.movement_name(SIDES[column][0 if value >= 0 else 1]) if known else self.tr("no value")
        painter.setFont(font(14 * scale, REGULAR))
        painter.setPen(theme.color("text2"))
        painter.drawText(QPointF(left, middle - 4 * scale), name)
        if known:
            painter.setFont(font(20 * scale, SEMIBOLD))
            painter.setPen(theme.color("text"))
            painter.drawText(QPointF(left, middle + 19 * scale), numbers.degrees(value))
            across = left + QFontMetricsF(painter.font()).horizontalAdvance(numbers.degrees(value)) + 5
            painter.setFont(font(14 * scale, MEDIUM))
            painter.setPen(theme.color("text2"))
            painter.drawText(QPointF(across, middle + 19 * scale), numbers.spread(sd))

    def _paint_still(self) -> QPixmap:
        ratio = self.devicePixelRatioF()
        picture = QPixmap(round(self.width() * ratio), round(self.height() * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(self._theme.color("canvas"))
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_card(painter, self._theme, QRectF(self.rect()))
        if self._plot is not None:
            style = screen_style(self._theme)
            if self._plot.repetitions:
                painter.setFont(style.label)
                painter.setPen(style.color("text2"))
                painter.drawText(QPointF(20, (TOP_PX - 7) * self._theme.text_scale), self.tr("Repetitions"))
            painter.setFont(style.label)
            painter.setPen(style.color("text2"))
            painter.drawText(QPointF(20, self.height() - 10 * self._theme.text_scale), self.tr("Wheel: zoom"))
            if isinstance(self._plot, HandPlot):
                paint_hand_session(painter, style, self._plot, self.panels())
            else:
                paint_session(painter, style, self._plot, self.panels())
        painter.end()
        return picture

    # --- mouse --------------------------------------------------------------------------------------------
    def _edge_at(self, point: QPointF) -> int:
        """0 for the start, 1 for the end of the current repetition under the mouse, -1 for none."""
        plot = self._plot
        if plot is None or not 0 <= plot.current < len(plot.repetitions):
            return -1
        panel = self.panels()[0][0]
        if not panel.box.top() <= point.y() <= panel.box.bottom():
            return -1
        repetition = plot.repetitions[plot.current]
        distances = [abs(point.x() - float(panel.x(time_s))) for time_s in (repetition.start_s, repetition.end_s)]
        nearest = 0 if distances[0] <= distances[1] else 1
        return nearest if distances[nearest] <= GRIP_PX else -1

    def _time_at(self, x: float) -> float:
        panel = self.panels()[0][0]
        share = (x - panel.box.left()) / max(panel.box.width(), 1.0)
        return panel.start_s + min(max(share, 0.0), 1.0) * (panel.end_s - panel.start_s)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Longer or shorter a time about the mouse; sideways, or with Shift, along the session."""
        plot = self._plot
        if plot is None:
            return
        start_s, end_s = plot.shown_s
        along, turn = event.angleDelta().x(), event.angleDelta().y()
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            along, turn = along or turn, 0
        span_s = min(max((end_s - start_s) * ZOOM_STEP ** (-turn / 120.0), min(SHORTEST_S, plot.end_s)), plot.end_s)
        at_s = self._time_at(event.position().x())
        begin_s = at_s - (at_s - start_s) / (end_s - start_s) * span_s - along / 120.0 * 0.1 * span_s
        begin_s = min(max(begin_s, 0.0), plot.end_s - span_s)
        whole = span_s >= plot.end_s - 1e-6
        self.show_window(None if whole else (begin_s, begin_s + span_s))
        event.accept()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """The repetitions alone, and the whole again."""
        if self._plot is not None:
            self.show_window(self._plot.repetitions_s if self._window_s is None else None)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if self._plot is None or event.button() != Qt.MouseButton.LeftButton:
            return
        self._dragged_edge = self._edge_at(event.position())
        if self._dragged_edge < 0:
            self.cursor_moved.emit(self._time_at(event.position().x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._plot is None:
            return
        if not event.buttons() & Qt.MouseButton.LeftButton:
            over = self._edge_at(event.position()) >= 0
            self.setCursor(Qt.CursorShape.SizeHorCursor if over else Qt.CursorShape.ArrowCursor)
        elif self._dragged_edge >= 0:
            self._drag(self._time_at(event.position().x()))
        else:
            self.cursor_moved.emit(self._time_at(event.position().x()))

    def _drag(self, time_s: float) -> None:
        plot = self._plot
        assert plot is not None
        repetition = plot.repetitions[plot.current]
        if self._dragged_edge == 0:
            moved = replace(repetition, start_s=min(time_s, repetition.end_s - EDGES_S))
        else:
            moved = replace(repetition, end_s=max(time_s, repetition.start_s + EDGES_S))
        shown = list(plot.repetitions)
        shown[plot.current] = moved
        self.show_plot(replace(plot, repetitions=shown))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._dragged_edge >= 0 and self._plot is not None:
            repetition = self._plot.repetitions[self._plot.current]
            self.edges_moved.emit(self._plot.current, repetition.start_s, repetition.end_s)
        self._dragged_edge = -1

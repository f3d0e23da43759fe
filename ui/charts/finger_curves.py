"""Live charts of the whole hand: flexion and spreading by finger over ten seconds, and every angle's value."""

from __future__ import annotations

import math
from dataclasses import replace

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPen

from carpus.ui.charts.chart import Chart, PaintedLayer, fit_font
from carpus.ui.charts.history import VISIBLE_S, History
from carpus.ui.charts.panel import Panel, Scale, draw_hatching, draw_text, positive_scale, screen_style
from carpus.ui.charts.series import Curve
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words.finger_angles import (
    ANGLE_KINDS,
    FINGER_ANGLES,
    FINGERS,
    AngleKind,
    FingerAngle,
    kind_name,
    spread_labels,
    spread_side,
)
from carpus.ui.words.terms import finger_name

LEFT_PX, RIGHT_PX, TOP_PX, BETWEEN_PX, ROW_PX = 112, 14, 44, 13, 31
BENDING = Scale(-15.0, 115.0, (90.0, 45.0, 0.0), ((90.0, "90°"), (45.0, "45°"), (0.0, "0°")))
SPREADING = Scale(-32.0, 32.0, (20.0, 0.0, -20.0), ())
BENDING_TOP_DEG_S, SPREADING_TOP_DEG_S = 400.0, 200.0
BENDING_ROWS: tuple[AngleKind, ...] = ("end", "middle", "knuckle")
SPREADING_ROWS: tuple[AngleKind, ...] = ("spread",)
MIN_HEIGHT_WITH_VALUES_PX, MIN_HEIGHT_WITH_SPREADING_PX = 290, 160
# From this standard deviation on an angle is marked as uncertain.
WEAK_SD_DEG = 10.0
_ANGLE_INDEX = {figure: number for number, figure in enumerate(FINGER_ANGLES)}


class FingerCurves(Chart):
    """Live curves and values by finger from a :class:`History`; ``angle_chosen`` when a value is clicked."""

    default_px = (776, 396)

    angle_chosen = Signal(FingerAngle)

    def __init__(self, theme: Theme, history: History) -> None:
        super().__init__(theme)
        self._history = history
        self._angle = FingerAngle(3, "middle")
        self._target_deg = math.nan
        self._is_waiting = False
        self._is_showing_speeds = False
        self._cells: PaintedLayer | None = None
        self._values: dict[FingerAngle, tuple[float, float, bool]] = {}
        self.scene().sigMouseClicked.connect(lambda click: self.select_angle(click.scenePos()))
        self.setAccessibleName(self.tr("Joint angles of the last ten seconds, by finger"))

    def set_angle(self, angle: FingerAngle, target_deg: float) -> None:
        self._angle, self._target_deg = angle, target_deg
        self.refresh()

    def set_waiting(self, is_waiting: bool) -> None:
        """Hide all values while no frames arrive, so that none looks current."""
        self._is_waiting = is_waiting
        self._update_cells()

    def show_speeds(self, on: bool) -> None:
        """Show the absolute speeds of the angles, or the angles."""
        self._is_showing_speeds = on
        self.refresh()

    def update_values(self) -> None:
        """Refresh the values below the curves; at most ten times a second."""
        self._values = {figure: self._history.angle_value(k) for k, figure in enumerate(FINGER_ANGLES)}
        self._update_cells()

    def _update_cells(self) -> None:
        if self._cells is not None:
            self._cells.update()

    def minimumSizeHint(self) -> QSize:
        return QSize(560, 165 if self._theme.text_scale > 1.0 else 220)  # the number above it gives way no further

    def _has_spreading(self) -> bool:
        return bool(self.height() >= MIN_HEIGHT_WITH_SPREADING_PX * self._theme.text_scale)

    # --- places -------------------------------------------------------------------------------------------
    def column(self, finger: int) -> QRectF:
        scale = self._theme.text_scale
        left, right = LEFT_PX * scale, self.width() - RIGHT_PX
        step = (right - left + BETWEEN_PX) / len(FINGERS)
        return QRectF(left + (finger - 1) * step, 8, step - BETWEEN_PX, self.height() - 16)

    def values_top(self) -> float:
        """Return the y at which the values begin; a low chart has curves only."""
        return float(self.height()) - 8 - len(self._visible_kinds()) * ROW_PX * self._theme.text_scale

    def _visible_kinds(self) -> tuple[AngleKind, ...]:
        return ANGLE_KINDS if self.height() >= MIN_HEIGHT_WITH_VALUES_PX * self._theme.text_scale else ()

    def panels(self, finger: int) -> tuple[Panel, Panel]:
        """Return the panels of flexion and of spreading of a finger."""
        scale, column = self._theme.text_scale, self.column(finger)
        top = TOP_PX * scale
        room, between = self.values_top() - 12 - top, 22 * scale
        if self._has_spreading():
            high = 0.62 * (room - between)
        else:  # the one that is large has all the room
            between, high = 0.0, 0.0 if self._angle.kind == "spread" else room
        boxes = (
            QRectF(column.left(), top, column.width(), high),
            QRectF(column.left(), top + high + between, column.width(), room - high - between),
        )
        bending, spreading = (
            Panel(QRectF(box.toRect()), own, -VISIBLE_S, 0.0) for box, own in zip(boxes, self._scales(), strict=True)
        )
        return bending, spreading

    def _scales(self) -> tuple[Scale, Scale]:
        if not self._is_showing_speeds:
            return BENDING, replace(SPREADING, labels=spread_labels(20.0))
        tops = (BENDING_TOP_DEG_S, 200.0), (SPREADING_TOP_DEG_S, 100.0)
        bending, spreading = (positive_scale(top, step, "°/s") for top, step in tops)
        return bending, spreading

    def cell(self, angle: FingerAngle) -> QRectF:
        column, height = self.column(angle.finger), ROW_PX * self._theme.text_scale
        return QRectF(column.left(), self.values_top() + ANGLE_KINDS.index(angle.kind) * height, column.width(), height)

    def select_angle(self, position: QPointF) -> None:
        """Choose the clicked value, or the same angle of the clicked finger."""
        for figure in FINGER_ANGLES:
            if figure.kind in self._visible_kinds() and self.cell(figure).contains(position):
                self.angle_chosen.emit(figure)
                return
        for finger in FINGERS:
            if self.column(finger).contains(position):
                self.angle_chosen.emit(FingerAngle(finger, self._angle.kind))

    # --- what is in it --------------------------------------------------------------------------------------
    def build(self) -> None:
        self._curves = []
        for finger in FINGERS:
            for panel, rows in zip(self.panels(finger), (BENDING_ROWS, SPREADING_ROWS), strict=True):
                if panel.box.height() <= 0.0:
                    continue
                own = self.add_plot(panel)
                own.add_grid(has_labels=finger == 1)
                is_chosen = finger == self._angle.finger and (self._angle.kind == "spread") == (rows == SPREADING_ROWS)
                has_target = (
                    math.isfinite(self._target_deg) and self._angle.kind != "tam" and not self._is_showing_speeds
                )
                if is_chosen and has_target:
                    own.add_horizontal_line(self._target_deg, "accent", (6.0, 4.0))
                self._curves.append((own.add_curves(is_cached=False), [FingerAngle(finger, row) for row in rows]))
        area = QRectF(0.0, self.values_top(), self.width(), self.height() - self.values_top() - 1)
        self._cells = PaintedLayer(self, area, self._paint_values)
        self.draw()

    def draw(self) -> None:
        """Redraw the curves of all panels."""
        if not self.plots or not self.isVisible():
            return
        series = self._history.finger_series(speeds=self._is_showing_speeds)
        for curves, angles in self._curves:
            curves.set_curves([Curve(series[_ANGLE_INDEX[one]], one.token) for one in angles])

    def _paint_values(self, painter: QPainter) -> None:
        scale = self._theme.text_scale
        number, words = font(16 * scale, SEMIBOLD), font(12 * scale, MEDIUM)
        shown_rows = self._visible_kinds()
        for figure in FINGER_ANGLES:
            if figure.kind in shown_rows:
                self._paint_value(painter, figure, number, words)

    def _paint_value(self, painter: QPainter, angle: FingerAngle, number: QFont, words: QFont) -> None:
        theme, cell = self._theme, self.cell(angle)
        value, sd, measured = self._values.get(angle, (math.nan, math.nan, False))
        is_known = math.isfinite(value) and not self._is_waiting
        inferred = self._history.is_inferred(_ANGLE_INDEX[angle])
        predicted = inferred or not measured
        middle = cell.center().y()
        if is_known:
            self._paint_line(painter, angle, cell, predicted=predicted)
        metrics, wide_px = QFontMetricsF(number), QFontMetricsF(words).horizontalAdvance
        left, baseline = cell.left() + 18, middle + metrics.capHeight() / 2
        text = numbers.format_degrees(value if is_known else math.nan)
        draw_text(painter, QPointF(left, baseline), text, number, theme.color("text2" if predicted else "text"))
        if not is_known:
            return
        left += metrics.horizontalAdvance(text) + 4
        beside = numbers.format_sd(sd)
        if inferred and beside:
            beside = self.tr("inferred from PIP")
            if wide_px(beside) > cell.right() - left:
                beside = self.tr("inferred")
        if name := angle_suffix(angle, value):
            both = f"{beside} {name}"
            # What an angle is goes before how sure it is.
            beside = both if wide_px(both) < cell.right() - left - 18 else name
        draw_text(painter, QPointF(left, baseline), beside, words, theme.color("text2"))
        left += wide_px(beside) + 5
        if not inferred and sd >= WEAK_SD_DEG and left + 13 < cell.right():
            box = QRectF(left, middle - 6.5, 13, 13)  # a triangle: the half disc is that of a marker seen now and then
            paint_state(painter, "warn", box, theme.color("warn"), theme.color("surface"))

    def _paint_line(self, painter: QPainter, angle: FingerAngle, cell: QRectF, *, predicted: bool) -> None:
        """Paint the legend of a curve: its colour, solid or dashed on hatching."""
        pen = QPen(self._theme.color(angle.token), 3)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        if predicted:
            draw_hatching(painter, screen_style(self._theme), cell.adjusted(14, 3, 0, -3), alpha=70)
            pen.setDashPattern([1.4, 1.0])
        painter.setPen(pen)
        middle = cell.center().y()
        painter.drawLine(QPointF(cell.left(), middle), QPointF(cell.left() + 11, middle))

    def paint_background(self, painter: QPainter) -> None:
        theme, scale = self._theme, self._theme.text_scale
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.color("soft"))
        painter.drawRoundedRect(self.column(self._angle.finger).adjusted(-6, 0, 6, 0), 8, 8)
        style = screen_style(theme)
        self._text(painter, self.tr("Last 10 s"), 20, 17 * scale, 12, REGULAR, "text2")
        for finger in FINGERS:
            bending = self.panels(finger)[0]
            face = font(16 * scale, SEMIBOLD)
            head = QFontMetricsF(face).elidedText(
                finger_name(str(finger)), Qt.TextElideMode.ElideRight, bending.box.width() + 4
            )
            self._text(painter, head, bending.box.left(), 13 * scale, 16, SEMIBOLD, "text")
        bending, spreading = self.panels(1)
        room_px = self.column(1).left() - 28
        if bending.box.height() > 0.0:
            labels_px = max(QFontMetricsF(style.label_font).horizontalAdvance(text) for _, text in bending.scale.labels)
            top = bending.box.top() - 4 * scale
            self._text(painter, self.tr("Flexion"), 20, top, 14, MEDIUM, "text", room_px - labels_px)
        if spreading.box.height() > 0.0:
            above = 17 if self._has_spreading() else 4
            self._text(
                painter, self.tr("Abduction"), 20, spreading.box.top() - above * scale, 14, MEDIUM, "text", room_px
            )
        for number, row in enumerate(self._visible_kinds()):
            top = self.values_top() + number * ROW_PX * scale
            painter.setPen(QPen(theme.color("line"), 1))
            painter.drawLine(QPointF(20, round(top) + 0.5), QPointF(self.width() - 14, round(top) + 0.5))
            self._text(painter, kind_name(row), 20, top + 7 * scale, 14, REGULAR, "text", room_px)

    def _text(
        self, painter: QPainter, text: str, left: float, top: float, size: int, weight: int, token: str,
        room_px: float = math.inf,
    ) -> None:  # fmt: skip
        """Draw text, smaller where a language needs a longer word."""
        face = fit_font(font(size * self._theme.text_scale, weight), text, room_px)
        draw_text(painter, QPointF(left, top + QFontMetricsF(face).ascent()), text, face, self._theme.color(token))


def angle_suffix(angle: FingerAngle, value_deg: float) -> str:
    """Return what the row's name does not say: palmar abduction of the thumb, or the side of spreading."""
    if angle.is_palmar_abduction:
        return tr("palm. abd.")
    return spread_side(value_deg, angle.finger) if angle.kind == "spread" else ""

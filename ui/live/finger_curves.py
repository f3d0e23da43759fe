"""Small multiples of the whole hand: bending and spreading by finger over ten seconds, and every angle in figures."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QMouseEvent, QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.types import FloatArray
from ui import numbers
from ui.figures import FIGURES, FINGERS, ROWS, Figure, Row, row_name, side_word, spread_labels
from ui.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from ui.icons import paint_state
from ui.live.curve_strips import CurveStrips, PanelCurves, Pens
from ui.live.history import SHOWN_S
from ui.live.joint_history import JointHistory
from ui.marker_words import finger_name
from ui.plot import axes
from ui.plot.axes import Panel, Scale
from ui.plot.series import LONGEST_STEP_S, paint_series
from ui.plot.style import screen_style
from ui.theme import BAND_ALPHA, CARD_RADIUS_PX, Theme
from ui.translate import tr

LEFT_PX, RIGHT_PX, TOP_PX, BETWEEN_PX, ROW_PX = 112, 14, 44, 13, 31
BENDING = Scale(-15.0, 115.0, (90.0, 45.0, 0.0), ((90.0, "90°"), (45.0, "45°"), (0.0, "0°")))
SPREADING = Scale(-32.0, 32.0, (20.0, 0.0, -20.0), ())
BENDING_ROWS: tuple[Row, ...] = ("end", "middle", "knuckle")
SPREADING_ROWS: tuple[Row, ...] = ("spread",)
ROOMY_FROM_PX = 290
WEAK_SD_DEG = 10.0
"""From this spread on a figure is marked as weak."""


class FingerCurves(QWidget):
    """Paints a :class:`JointHistory`; ``chosen`` tells that a figure was clicked."""

    chosen = Signal(Figure)

    def __init__(self, theme: Theme, history: JointHistory) -> None:
        super().__init__()
        self._theme, self._history = theme, history
        self._figure = Figure(3, "middle")
        self._target_deg = math.nan
        self._waiting = False
        self._still: QPixmap | None = None
        self._figures: QPixmap | None = None
        self._strips = CurveStrips()
        self._values: dict[Figure, tuple[float, float, bool]] = {}
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Joint angles of the last ten seconds, by finger"))
        theme.changed.connect(self._forget_still)

    def set_figure(self, figure: Figure, target_deg: float) -> None:
        """The figure that is large, and its target."""
        self._figure, self._target_deg = figure, target_deg
        self._forget_still()

    def set_waiting(self, waiting: bool) -> None:
        """Whether no pictures come: then no figure is shown as if it were now."""
        self._waiting = waiting
        self._figures = None
        self.update()

    def refresh_values(self) -> None:
        """Take the figures below the curves anew; called at most ten times a second."""
        self._values = {figure: self._history.value(k) for k, figure in enumerate(FIGURES)}
        self._figures = None

    def _forget_still(self) -> None:
        self._still = self._figures = None
        self._strips.forget()
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._forget_still()

    def sizeHint(self) -> QSize:
        return QSize(776, 396)

    def minimumSizeHint(self) -> QSize:
        return QSize(560, 300)

    # --- places -------------------------------------------------------------------------------------------
    def column(self, finger: int) -> QRectF:
        """The whole column of a finger."""
        scale = self._theme.text_scale
        left, right = LEFT_PX * scale, self.width() - RIGHT_PX
        step = (right - left + BETWEEN_PX) / len(FINGERS)
        return QRectF(left + (finger - 1) * step, 8, step - BETWEEN_PX, self.height() - 16)

    def rows_top(self) -> float:
        """Where the figures begin; without room for both, the curves stay."""
        return self.height() - 8 - len(self._rows()) * ROW_PX * self._theme.text_scale

    def _rows(self) -> tuple[Row, ...]:
        return ROWS if self.height() >= ROOMY_FROM_PX * self._theme.text_scale else ()

    def panels(self, finger: int) -> tuple[Panel, Panel]:
        """Bending and spreading of a finger."""
        scale, column = self._theme.text_scale, self.column(finger)
        now = self._history.now_s if math.isfinite(self._history.now_s) else 0.0
        top = TOP_PX * scale
        room = self.rows_top() - 12 - top - 22 * scale
        bending = QRectF(column.left(), top, column.width(), 0.62 * room)
        spreading = QRectF(column.left(), top + 0.62 * room + 22 * scale, column.width(), 0.38 * room)
        return Panel(bending, BENDING, now - SHOWN_S, now), Panel(spreading, SPREADING, now - SHOWN_S, now)

    def cell(self, figure: Figure) -> QRectF:
        """Where a figure's number stands."""
        column, height = self.column(figure.finger), ROW_PX * self._theme.text_scale
        return QRectF(column.left(), self.rows_top() + ROWS.index(figure.row) * height, column.width(), height)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        at = event.position()
        for figure in FIGURES:
            if figure.row in self._rows() and self.cell(figure).contains(at):
                self.chosen.emit(figure)
                return
        for finger in FINGERS:
            if self.column(finger).contains(at):
                self.chosen.emit(Figure(finger, self._figure.row))

    # --- painting -----------------------------------------------------------------------------------------
    def paintEvent(self, event: QPaintEvent) -> None:
        if self._still is None:
            self._still = self._paint_still()
        if self._figures is None:
            self._figures = self._paint_figures()
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._still)
        painter.drawPixmap(0, 0, self._figures)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        style = screen_style(self._theme)
        pens = {token: _pens(style.color(token), style.line_width) for token in ("curve_a", "curve_b", "curve_c")}
        block = self._history.block(self._history.now_s - SHOWN_S)
        even = bool(len(block.time_s)) and bool(np.all(np.diff(block.time_s) <= LONGEST_STEP_S))
        plain: list[PanelCurves] = []
        for finger in FINGERS:
            bending, spreading = self.panels(finger)
            for panel, rows in ((bending, BENDING_ROWS), (spreading, SPREADING_ROWS)):
                columns = [FIGURES.index(Figure(finger, row)) for row in rows]
                own = [k for k in columns if even and _stays_in(panel.scale, block.value_deg[:, k])]
                plain.append(PanelCurves(panel, [(k, pens[FIGURES[k].token]) for k in own]))
                numbered: list[QRectF] = []
                for k in columns:
                    if k not in own:  # gaps, or values beyond the scale, which are rare
                        painter.save()
                        painter.setClipRect(panel.box.adjusted(0, -1, 1, 1).toAlignedRect())
                        paint_series(painter, style, panel, self._history.series(k), FIGURES[k].token, numbered)
                        painter.restore()
        self._strips.paint(painter, plain, block, self._history.now_s)

    def _paint_figures(self) -> QPixmap:
        """The numbers below the curves; they change ten times a second at most."""
        ratio = self.devicePixelRatioF()
        picture = QPixmap(round(self.width() * ratio), round(self.height() * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for figure in FIGURES:
            if figure.row in self._rows():
                self._paint_figure(painter, figure)
        painter.end()
        return picture

    def _paint_figure(self, painter: QPainter, figure: Figure) -> None:
        theme, scale = self._theme, self._theme.text_scale
        cell, style = self.cell(figure), screen_style(self._theme)
        value, sd, measured = self._values.get(figure, (math.nan, math.nan, False))
        if self._waiting:
            value = math.nan
        predicted = not measured or self._history.inferred(FIGURES.index(figure))
        middle = cell.center().y()
        if predicted and math.isfinite(value):
            axes.hatch(painter, style, cell.adjusted(14, 3, 0, -3), alpha=70)
        pen = QPen(theme.color(figure.token), 3)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        if predicted:
            pen.setDashPattern([1.4, 1.0])
        painter.setPen(pen)
        if math.isfinite(value):
            painter.drawLine(QPointF(cell.left(), middle), QPointF(cell.left() + 11, middle))
        painter.setFont(font(16 * scale, SEMIBOLD))
        painter.setPen(theme.color("text2" if predicted else "text"))
        metrics = QFontMetricsF(painter.font())
        left, baseline = cell.left() + 18, middle + metrics.capHeight() / 2
        text = numbers.degrees(value)
        painter.drawText(QPointF(left, baseline), text)
        left += metrics.horizontalAdvance(text) + 4
        words = numbers.spread(sd) if math.isfinite(value) else ""
        painter.setFont(font(12 * scale, MEDIUM))
        inferred = self._history.inferred(FIGURES.index(figure))
        if inferred and words:
            words = self.tr("follows the middle joint")
            if QFontMetricsF(painter.font()).horizontalAdvance(words) > cell.right() - left:
                words = self.tr("follows")
        if math.isfinite(value) and (name := cell_word(figure, value)):
            both, room = f"{words} {name}", cell.right() - left - 18
            # What an angle is goes before how sure it is.
            words = both if QFontMetricsF(painter.font()).horizontalAdvance(both) < room else name
        painter.setPen(theme.color("text2"))
        painter.drawText(QPointF(left, baseline), words)
        left += QFontMetricsF(painter.font()).horizontalAdvance(words) + 5
        if math.isfinite(value) and not inferred and sd >= WEAK_SD_DEG and left + 13 < cell.right():
            box = QRectF(left, middle - 6.5, 13, 13)  # a triangle: the half disc is that of a marker seen now and then
            paint_state(painter, "warn", box, theme.color("warn"), theme.color("surface"))

    def _paint_still(self) -> QPixmap:
        ratio, theme, scale = self.devicePixelRatioF(), self._theme, self._theme.text_scale
        picture = QPixmap(round(self.width() * ratio), round(self.height() * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(theme.color("canvas"))
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(theme.color("line"))
        painter.setBrush(theme.color("surface"))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.color("soft"))
        painter.drawRoundedRect(self.column(self._figure.finger).adjusted(-6, 0, 6, 0), 8, 8)
        style = screen_style(theme)
        self._text(painter, self.tr("Last 10 s"), 20, 17 * scale, 12, REGULAR, "text2")
        for finger in FINGERS:
            bending, spreading = self.panels(finger)
            self._text(painter, finger_name(str(finger)), bending.box.left(), 13 * scale, 16, SEMIBOLD, "text")
            for panel in (bending, spreading):
                labels = spread_labels(20.0) if panel is spreading else panel.scale.labels
                shown = replace(panel.scale, labels=labels if finger == 1 else ())
                axes.paint_scale(painter, style, Panel(panel.box, shown, panel.start_s, panel.end_s))
            if finger == self._figure.finger and math.isfinite(self._target_deg) and self._figure.row != "tam":
                own = spreading if self._figure.row == "spread" else bending
                axes.paint_target(painter, style, own, self._target_deg, "")
        bending, spreading = self.panels(1)
        self._text(painter, self.tr("Bending"), 20, bending.box.top() - 4 * scale, 14, MEDIUM, "text")
        self._text(painter, self.tr("Spreading"), 20, spreading.box.top() - 17 * scale, 14, MEDIUM, "text")
        for number, row in enumerate(self._rows()):
            top = self.rows_top() + number * ROW_PX * scale
            painter.setPen(QPen(theme.color("line"), 1))
            painter.drawLine(QPointF(20, round(top) + 0.5), QPointF(self.width() - 14, round(top) + 0.5))
            self._text(painter, row_name(row), 20, top + 7 * scale, 14, REGULAR, "text")
        painter.end()
        return picture

    def _text(self, painter: QPainter, text: str, left: float, top: float, size: int, weight: int, token: str) -> None:
        painter.setFont(font(size * self._theme.text_scale, weight))
        painter.setPen(self._theme.color(token))
        painter.drawText(QPointF(left, top + QFontMetricsF(painter.font()).ascent()), text)


def cell_word(figure: Figure, value_deg: float) -> str:
    """What the row's name does not say: that the thumb's is its lift, and to which side a finger is spread."""
    if figure.is_lift:
        return tr("lift")
    return side_word(value_deg) if figure.row == "spread" else ""


def _stays_in(scale: Scale, value: FloatArray) -> bool:
    return bool(scale.low < value.min() and value.max() < scale.high)


def _pens(color: QColor, width: float) -> Pens:
    fill = QColor(color)
    fill.setAlpha(BAND_ALPHA)
    # Flat and bevelled: round joins double the cost of a curve and are not seen at this width.
    solid = QPen(color, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap, Qt.PenJoinStyle.BevelJoin)
    dashed = QPen(solid)
    dashed.setDashPattern([2.2, 2.2])
    return Pens(fill, solid, dashed)

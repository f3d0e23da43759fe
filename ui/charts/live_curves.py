"""Live chart of the three wrist angles, or of both speeds, over ten seconds."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.model.hand.exercises import PRONOSUPINATION, Exercise, get_exercise
from carpus.core.model.rounding import round_half_away
from carpus.ui.charts.chart import LINES, AxisLabel, Chart, Hatching, PaintedLayer, fit_font
from carpus.ui.charts.history import VISIBLE_S, History
from carpus.ui.charts.panel import Panel, draw_text, positive_scale, stack_boxes
from carpus.ui.charts.series import Curve
from carpus.ui.charts.session import add_limits, add_targets, wrist_panels
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.theme import CURVE_TOKENS, Theme
from carpus.ui.words import terms

LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX, BETWEEN_PX = 132, 112, 24, 28, 30
# Room for the dot of the newest value, which lies half outside the panel.
DOT_PX = 7
# Within this of zero the direction's name stays, so that it does not flicker.
ZERO_BAND_DEG = 0.5
SPEED_TOP_MM_S, SPEED_TOP_DEG_S = 400.0, 400.0
_SPEED_TOKEN = CURVE_TOKENS[PRONOSUPINATION]


class LiveCurves(Chart):
    """Live wrist curves from a :class:`History`, the newest value at the right; not moved by the mouse."""

    default_px, min_px = (696, 396), (420, 170)  # the number above it never gives way

    def __init__(self, theme: Theme, history: History) -> None:
        super().__init__(theme)
        self._history = history
        self._exercise = get_exercise("")
        self._targets_deg = (math.nan, math.nan)
        self._single = False
        self.is_showing_speeds = False
        self._values: list[tuple[str, str, str]] = []
        self._last_values = [1.0, 1.0, 1.0]
        self._values_layer: PaintedLayer | None = None
        self.setAccessibleName(self.tr("Curves of the last ten seconds"))

    def set_exercise(self, exercise: Exercise, target_positive_deg: float, target_negative_deg: float) -> None:
        """Set the trained angle, its targets and the limits of the others."""
        self._exercise = exercise
        self._targets_deg = (target_positive_deg, target_negative_deg)
        self.refresh()

    def show_speeds(self, on: bool) -> None:
        """Show linear and angular speed, or the angles."""
        self.is_showing_speeds = on
        self.update_values()
        self.refresh()

    def show_single(self, on: bool) -> None:
        """Show the trained angle alone, for large text."""
        if on != self._single:
            self._single = on
            self.refresh()

    def update_values(self) -> None:
        """Refresh the values at the right; at most ten times a second."""
        angles, sds = self._history.angles_deg, self._history.sds_deg
        self._values = []
        if self.is_showing_speeds:
            speeds = np.full(2, math.nan) if self._history.is_waiting else self._history.speeds
            units = ((self.tr("Speed"), f"{numbers.NARROW_GAP}mm/s"), (self.tr("Rotation"), "°/s"))
            for speed, (name, unit) in zip(speeds.tolist(), units, strict=True):
                words = f"{round_half_away(speed)}{unit}" if math.isfinite(speed) else numbers.UNKNOWN
                self._values.append((name, words, ""))
            angles = angles[:0]
        for k in range(len(angles)):
            if math.isfinite(angles[k]) and abs(angles[k]) > ZERO_BAND_DEG:
                self._last_values[k] = float(angles[k])
            known = math.isfinite(angles[k]) and not self._history.is_waiting
            name = terms.direction_name(k, self._last_values[k], self._exercise) if known else self.tr("no value")
            if known and abs(angles[k]) < ZERO_BAND_DEG:
                name = terms.neutral_name(k, self._exercise)
            self._values.append(
                (name, numbers.format_degrees(angles[k]) if known else "", numbers.format_sd(sds[k]) if known else "")
            )
        if self._values_layer is not None:
            self._values_layer.update()

    # --- places -------------------------------------------------------------------------------------------
    def panels(self) -> list[tuple[Panel, int]]:
        """Return the panels with the column of each; the trained angle is first and twice as high."""
        scale, span_s = self._theme.text_scale, (-VISIBLE_S, 0.0)
        left, top, right, bottom = (scale * margin for margin in (LEFT_PX, TOP_PX, RIGHT_PX, BOTTOM_PX))
        box, between = QRectF(self.rect()).adjusted(left, top, -right, -bottom), BETWEEN_PX * scale
        if not self.is_showing_speeds:
            return wrist_panels(self._exercise, box, between, span_s, single=self._single)
        scales = [
            (1, positive_scale(SPEED_TOP_DEG_S, 100.0, "°/s")),
            (0, positive_scale(SPEED_TOP_MM_S, 100.0, f"{numbers.NARROW_GAP}mm/s")),
        ][: 1 if self._single else 2]
        boxes = stack_boxes(box, [1.0] * len(scales), between)
        return [(Panel(area, one, *span_s), k) for area, (k, one) in zip(boxes, scales, strict=True)]

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        self._curves = []
        for place, (panel, column) in enumerate(self.panels()):
            own = self.add_plot(panel, column)
            if not self.is_showing_speeds:
                add_limits(own, self._exercise, column, is_first=place == 0)
            own.add_grid()
            if place == 0 and not self.is_showing_speeds:
                add_targets(own, *self._targets_deg)
            hatching = own.add_to_layer(Hatching(own, ()), LINES)
            self._curves.append((own.add_curves(is_cached=False), hatching))
        ago = [AxisLabel(-float(ago), str(ago)) for ago in (2, 4, 6, 8)]
        ends = [AxisLabel(0.0, self.tr("now")), AxisLabel(0.55 - VISIBLE_S, self.tr("10 s ago"))]
        self.add_axis(self.plots[-1], "bottom", [*ends, *ago], 9 * self._theme.text_scale)
        right, top = self.plots[0].panel.box.right(), self.plots[0].panel.box.top() - DOT_PX
        area = QRectF(right - DOT_PX, top, 2 * DOT_PX, self.plots[-1].panel.box.bottom() + DOT_PX - top)
        self._dots = PaintedLayer(self, area, self._paint_dots, is_cached=False)
        area = QRectF(right + DOT_PX, 0.0, self.width() - right - DOT_PX - 1, self.height())
        self._values_layer = PaintedLayer(self, area, self._paint_values)
        self.draw()

    def draw(self) -> None:
        """Redraw the curves."""
        history = self._history
        if not self.plots or not self.isVisible():
            return
        read = history.speed_series if self.is_showing_speeds else history.angle_series
        for own, (curves, hatching) in zip(self.plots, self._curves, strict=True):
            series = read(own.key).shift_time(history.end_s)
            curves.set_curves([Curve(series, self._curve_token(own.key))])
            is_late = history.is_waiting and len(series.value) > 0
            if is_late or hatching.stretches:
                low, high = own.panel.scale.low, own.panel.scale.high
                hatching.set_stretches([(float(series.time_s[-1]), 0.0, low, high)] if is_late else ())
        self._dots.update()

    def _paint_dots(self, painter: QPainter) -> None:
        """Paint a disc with a seam at the newest value of each panel."""
        history, look = self._history, self.plot_style
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(look.color("surface"), 1.5))
        for own in self.plots:
            value = float((history.speeds if self.is_showing_speeds else history.angles_deg)[own.key])
            if not history.is_waiting and math.isfinite(value):
                painter.setBrush(look.color(self._curve_token(own.key)))
                painter.drawEllipse(own.panel.point(0.0, value), 5.0, 5.0)

    def _curve_token(self, column: int) -> str:
        return _SPEED_TOKEN if self.is_showing_speeds else CURVE_TOKENS[column]

    def _paint_values(self, painter: QPainter) -> None:
        for own in self.plots if self._values else ():
            self._paint_value(painter, own.panel.box, *self._values[own.key])

    def _paint_value(self, painter: QPainter, box: QRectF, name: str, value: str, spread: str) -> None:
        theme, scale = self._theme, self._theme.text_scale
        left, middle = box.right() + 14 * scale, box.center().y()
        face = fit_font(font(14 * scale, REGULAR), name, self.width() - left - 4)
        draw_text(painter, QPointF(left, middle - 5 * scale), name, face, theme.color("text2"))
        at, face = QPointF(left, middle + 18 * scale), font(20 * scale, SEMIBOLD)
        draw_text(painter, at, value, face, theme.color("text"))
        at += QPointF(QFontMetricsF(face).horizontalAdvance(value) + 5 * scale, 0.0)
        draw_text(painter, at, spread, font(14 * scale, MEDIUM), theme.color("text2"))

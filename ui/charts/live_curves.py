"""Live chart of the three wrist angles, or of both speeds, over ten seconds."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise, get_exercise
from carpus.core.model.hand.forearm_rotation import axis_limits_deg
from carpus.core.model.rounding import round_half_away
from carpus.ui.charts import axes
from carpus.ui.charts.axes import Panel
from carpus.ui.charts.chart import LINES, AxisLabel, Chart, Hatching, PaintedLayer, fit_font, scale_labels
from carpus.ui.charts.history import VISIBLE_S, History
from carpus.ui.charts.series import Curve
from carpus.ui.charts.session import add_limits, add_targets
from carpus.ui.charts.style import draw_text, paint_dot
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
        self._is_showing_speeds = False
        self._values: list[tuple[str, str, str]] = []
        self._last_values = [1.0, 1.0, 1.0]
        self._values_layer: PaintedLayer | None = None
        self.setAccessibleName(self.tr("Curves of the last ten seconds"))

    def set_exercise(self, exercise: Exercise, target_positive_deg: float, target_negative_deg: float) -> None:
        """Set the trained angle, its targets and the limits of the others."""
        self._exercise = exercise
        self._targets_deg = (target_positive_deg, target_negative_deg)
        self.refresh()

    @property
    def is_showing_speeds(self) -> bool:
        return self._is_showing_speeds

    def show_speeds(self, on: bool) -> None:
        """Show linear and angular speed, or the angles."""
        self._is_showing_speeds = on
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
        if self._is_showing_speeds:
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
        scale = self._theme.text_scale
        left, right = LEFT_PX * scale, RIGHT_PX * scale
        width = self.width() - left - right
        if self._is_showing_speeds:
            scales = [
                (1, axes.positive_scale(SPEED_TOP_DEG_S, 100.0, "°/s")),
                (0, axes.positive_scale(SPEED_TOP_MM_S, 100.0, f"{numbers.NARROW_GAP}mm/s")),
            ][: 1 if self._single else 2]
            gap = BETWEEN_PX * scale
            height = (self.height() - (TOP_PX + BOTTOM_PX) * scale + gap) / len(scales) - gap
            tops = [TOP_PX * scale + number * (height + gap) for number in range(len(scales))]
            boxes = [axes.align_to_pixels(QRectF(left, top, width, height)) for top in tops]
            return [(Panel(box, one, -VISIBLE_S, 0.0), k) for box, (k, one) in zip(boxes, scales, strict=True)]
        main = FLEXION if self._exercise.angle is None else self._exercise.angle
        columns = [main, *(k for k in (FLEXION, 0, PRONOSUPINATION) if k != main)][: 1 if self._single else 3]
        between, top = BETWEEN_PX * scale, TOP_PX * scale
        height = self.height() - (TOP_PX + BOTTOM_PX) * scale - between * (len(columns) - 1)
        unit = height / (len(columns) + 1)
        out = []
        for k in columns:
            limits, names = axis_limits_deg(k, self._exercise), terms.direction_names(k, self._exercise)
            box = QRectF(left, top, width, unit * (2 if k == main else 1))
            scale_k = axes.angle_scale(*limits, *names, is_sparse=k != main)
            out.append((Panel(axes.align_to_pixels(box), scale_k, -VISIBLE_S, 0.0), k))
            top += box.height() + between
        return out

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        placed, scale = self.panels(), self._theme.text_scale
        self._curves = []
        for place, (panel, column) in enumerate(placed):
            own = self.add_plot(panel)
            if not self._is_showing_speeds:
                add_limits(own, self._exercise, column, is_first=place == 0)
            own.add_grid()
            if place == 0 and not self._is_showing_speeds:
                add_targets(own, *self._targets_deg)
            self.add_axis(own, "left", scale_labels(panel), 12)
            hatching = own.add_to_layer(Hatching(own, ()), LINES)
            self._curves.append((own.add_curves(is_cached=False), hatching, column))
        ago = [AxisLabel(-float(ago), str(ago)) for ago in (2, 4, 6, 8)]
        ends = [AxisLabel(0.0, self.tr("now")), AxisLabel(0.55 - VISIBLE_S, self.tr("10 s ago"))]
        self.add_axis(self.plots[-1], "bottom", [*ends, *ago], 9 * scale)
        right, top = placed[0][0].box.right(), placed[0][0].box.top() - DOT_PX
        area = QRectF(right - DOT_PX, top, 2 * DOT_PX, placed[-1][0].box.bottom() + DOT_PX - top)
        self._dots = PaintedLayer(self, area, self._paint_dots, is_cached=False)
        area = QRectF(right + DOT_PX, 0.0, self.width() - right - DOT_PX - 1, self.height())
        self._values_layer = PaintedLayer(self, area, self._paint_values)
        self.draw()

    def draw(self) -> None:
        """Redraw the curves."""
        history = self._history
        if not self.plots or not self.isVisible():
            return
        for own, (curves, hatching, column) in zip(self.plots, self._curves, strict=True):
            series = history.speed_series(column) if self._is_showing_speeds else history.angle_series(column)
            series = series.shift_time(history.end_s)
            curves.set_curves([Curve(series, self._curve_token(column))])
            panel = own.panel
            is_late = history.is_waiting and len(series.value) > 0
            if is_late or hatching.stretches:
                low, high = panel.scale.low, panel.scale.high
                hatching.set_stretches([(float(series.time_s[-1]), 0.0, low, high)] if is_late else ())
        self._dots.update()

    def _paint_dots(self, painter: QPainter) -> None:
        history = self._history
        for own, (_, _, column) in zip(self.plots, self._curves, strict=True):
            value = float((history.speeds if self._is_showing_speeds else history.angles_deg)[column])
            if not history.is_waiting and math.isfinite(value):
                paint_dot(painter, self.plot_style, own.panel.point(0.0, value), self._curve_token(column), 5.0)

    def _curve_token(self, column: int) -> str:
        return _SPEED_TOKEN if self._is_showing_speeds else CURVE_TOKENS[column]

    def _paint_values(self, painter: QPainter) -> None:
        for panel, column in self.panels():
            if self._values:
                self._paint_value(painter, panel, *self._values[column])

    def _paint_value(self, painter: QPainter, panel: Panel, name: str, value: str, spread: str) -> None:
        theme, scale = self._theme, self._theme.text_scale
        left = panel.box.right() + 14 * scale
        middle = panel.box.center().y()
        face = fit_font(font(14 * scale, REGULAR), name, self.width() - left - 4)
        draw_text(painter, QPointF(left, middle - 5 * scale), name, face, theme.color("text2"))
        at, face = QPointF(left, middle + 18 * scale), font(20 * scale, SEMIBOLD)
        draw_text(painter, at, value, face, theme.color("text"))
        at += QPointF(QFontMetricsF(face).horizontalAdvance(value) + 5 * scale, 0.0)
        draw_text(painter, at, spread, font(14 * scale, MEDIUM), theme.color("text2"))

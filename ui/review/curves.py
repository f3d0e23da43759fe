"""Curves of a whole session with repetitions, cursor and edge handles; painted for screen and page alike."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from core.output.exercises import AXIS_LIMIT_DEG, AXIS_TICK_DEG, FLEXION, PRONOSUPINATION, SIDES, Exercise
from core.output.report_content import Curves, ShownRepetition
from core.types import TrackStatus
from ui import numbers, terms
from ui.plot import axes
from ui.plot.axes import Panel
from ui.plot.series import LONGEST_STEP_S, Series, paint_series
from ui.plot.style import CURVE_TOKENS, PlotStyle
from ui.plot.thin import thinned, within
from ui.translate import tr

BESIDE_S = 1.0
"""Shown before the first and after the last repetition where the rest is left away."""


@dataclass(frozen=True, slots=True)
class SessionPlot:
    """What is drawn: curves, exercise, repetitions, and the current one (-1 for none)."""

    curves: Curves
    exercise: Exercise
    repetitions: Sequence[ShownRepetition]
    current: int = -1
    target_positive_deg: float = math.nan
    target_negative_deg: float = math.nan
    window_s: tuple[float, float] | None = None
    """The part of the time axis that is shown; None for all of it."""

    @property
    def shown_s(self) -> tuple[float, float]:
        """Left and right end of what is shown."""
        return self.window_s or (0.0, self.end_s)

    @property
    def repetitions_s(self) -> tuple[float, float]:
        """From shortly before the first repetition to shortly after the last; the whole where there is none."""
        if not self.repetitions:
            return 0.0, self.end_s
        start_s, end_s = self.repetitions[0].start_s, max(repetition.end_s for repetition in self.repetitions)
        return max(start_s - BESIDE_S, 0.0), min(end_s + BESIDE_S, self.end_s)

    @property
    def end_s(self) -> float:
        """Right end of the time axis."""
        return max(float(self.curves.time_s[-1]), 1.0) if len(self.curves.time_s) else 1.0

    def order(self) -> list[int]:
        """Angle columns from top to bottom, the trained one first."""
        first = FLEXION if self.exercise.angle is None else self.exercise.angle
        return [first, *[k for k in (FLEXION, 0, PRONOSUPINATION) if k != first]]

    def series(self, column: int) -> Series:
        """One angle as it is drawn."""
        curves = self.curves
        return Series(
            curves.time_s,
            curves.angles_deg[:, column],
            curves.sds_deg[:, column],
            curves.status == TrackStatus.PREDICTED,
        )


def place_panels(plot: SessionPlot, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
    """Three panels in a box, the trained angle twice as high; or that one alone."""
    order = plot.order()[: 1 if single else 3]
    unit = (box.height() - between * (len(order) - 1)) / (len(order) + 1)
    top, out = box.top(), []
    for place, column in enumerate(order):
        height = unit * (2 if place == 0 else 1)
        upper, lower = (terms.movement_name(name) for name in SIDES[column])
        scale = axes.angle_scale(AXIS_TICK_DEG[column], AXIS_LIMIT_DEG[column], upper, lower, tight=place > 0)
        out.append((Panel(QRectF(box.left(), top, box.width(), height), scale, *plot.shown_s), column))
        top += height + between
    return out


def paint_session(painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[tuple[Panel, int]]) -> None:
    """Everything that does not move: repetitions, grid, limits, target, curves, time axis."""
    paint_repetitions(painter, style, plot, [panel for panel, _ in panels])
    for place, (panel, column) in enumerate(panels):
        limit = plot.exercise.trick_limit_deg
        if place > 0 and math.isfinite(limit):
            words = tr("should stay within {angle}").format(angle=numbers.degrees(limit))
            axes.paint_stay_within(
                painter, style, panel, limit, words if column != PRONOSUPINATION else tr("0° = palm down")
            )
        axes.paint_scale(painter, style, panel)
        if place == 0:
            for value in (plot.target_positive_deg, plot.target_negative_deg):
                if math.isfinite(value):
                    axes.paint_target(
                        painter, style, panel, value, tr("Target {angle}").format(angle=numbers.degrees(value))
                    )
        painter.save()
        painter.setClipRect(panel.box.adjusted(0, -2, 0, 2).toAlignedRect(), Qt.ClipOperation.IntersectClip)
        series = thinned(within(plot.series(column), *plot.shown_s), max(200, int(panel.box.width() / style.unit)))
        paint_series(painter, style, panel, series, CURVE_TOKENS[column])
        painter.restore()
    last = panels[-1][0]
    axes.paint_times(painter, style, last, last.box.bottom() + 6 * style.unit, time_labels(*plot.shown_s))


def time_labels(start_s: float, end_s: float) -> list[tuple[float, str]]:
    """Round times along the axis, about six of them."""
    span_s = end_s - start_s
    step = next((step for step in (0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600) if span_s / step <= 7), 1200)
    ticks = step * np.arange(math.ceil(start_s / step - 1e-6), math.floor(end_s / step + 1e-6) + 1)
    return [(float(t), f"{t:g} s" if end_s <= 180 else numbers.clock(float(t))) for t in ticks]


def value_at(curves: Curves, column: int, time_s: float) -> tuple[float, float]:
    """Angle and its deviation in degrees at the frame nearest to a time; NaN in a gap."""
    if not len(curves.time_s):
        return math.nan, math.nan
    row = row_at(curves, time_s)
    if abs(float(curves.time_s[row]) - time_s) > LONGEST_STEP_S:
        return math.nan, math.nan
    return float(curves.angles_deg[row, column]), float(curves.sds_deg[row, column])


def row_at(curves: Curves, time_s: float) -> int:
    """Row of the frame nearest to a time."""
    return int(np.abs(curves.time_s - time_s).argmin())


def paint_repetitions(painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[Panel]) -> None:
    """Shading of the repetitions, with their numbers over the first panel."""
    for panel in panels:
        _paint_shading(painter, style, plot, panel)
    _paint_numbers(painter, style, plot, panels[0])


def _paint_shading(painter: QPainter, style: PlotStyle, plot: SessionPlot, panel: Panel) -> None:
    for number, repetition in enumerate(plot.repetitions):
        left, right = float(panel.x(repetition.start_s)), float(panel.x(repetition.end_s))
        box = QRectF(left + style.unit, panel.box.top(), right - left - 2 * style.unit, panel.box.height())
        box = box.intersected(panel.box)
        if box.isEmpty():
            continue
        painter.fillRect(box, style.color("soft" if number == plot.current else "sunken"))
        if not repetition.counts:
            axes.hatch(painter, style, box)


def _paint_numbers(painter: QPainter, style: PlotStyle, plot: SessionPlot, panel: Panel) -> None:
    metrics = QFontMetricsF(style.end_label)
    painter.setFont(style.end_label)
    baseline = panel.box.top() - 7 * style.unit
    taken = -math.inf
    for number, repetition in enumerate(plot.repetitions):
        text = str(number + 1) if repetition.counts else tr("{number} out").format(number=number + 1)
        middle = float(panel.x(0.5 * (repetition.start_s + repetition.end_s)))
        width = metrics.horizontalAdvance(text)
        if not panel.box.left() <= middle <= panel.box.right():
            continue
        if middle - width / 2 < taken and number != plot.current:
            continue
        taken = middle + width / 2 + 4 * style.unit
        token = "text" if number == plot.current else "warn" if not repetition.counts else "text2"
        painter.setPen(style.color(token))
        painter.drawText(QPointF(middle - width / 2, baseline), text)


def paint_edges(painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[tuple[Panel, int]]) -> None:
    """Lines and grips at the edges of the current repetition."""
    if not 0 <= plot.current < len(plot.repetitions):
        return
    panel = panels[0][0]
    repetition = plot.repetitions[plot.current]
    for time_s in (repetition.start_s, repetition.end_s):
        x = float(panel.x(time_s))
        if not panel.box.left() - 1 <= x <= panel.box.right() + 1:
            continue
        painter.setPen(QPen(style.color("accent"), 1.5))
        painter.drawLine(QPointF(x, panel.box.top()), QPointF(x, panel.box.bottom()))
        painter.setBrush(style.color("surface"))
        painter.drawRoundedRect(QRectF(x - 4, panel.box.center().y() - 12, 8, 24), 4, 4)

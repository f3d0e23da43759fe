"""Range over time: points with error bars, error band about the first session, norm band, other hand.

Painted by the same functions on the screen and on paper.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import datetime

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from core.output.exercises import Movement
from core.output.range_rows import RangeRow
from core.output.report_content import Progress, usual_deg
from ui import numbers, terms
from ui.fonts import SEMIBOLD, font
from ui.plot.axes import hatch
from ui.plot.polygon import polygon
from ui.plot.style import CURVE_TOKENS, PlotStyle
from ui.translate import tr

STEP_DEG = 30.0
DOT_RADIUS, CAP_REACH = 3.5, 7.0
"""The caps of an error bar reach beyond the dot, so that a spread of one or two degrees still shows."""
MOST_PANELS = 3


def panels_of(progress: Progress) -> list[tuple[Movement, int]]:
    """What is drawn, arc first; of free movement the three arcs."""
    if not progress.points:
        return []
    rows = progress.points[-1].figures.rows
    arcs = [(row.movement, row.angle) for row in rows if row.movement == "arc"]
    ends = [(row.movement, row.angle) for row in rows if row.movement != "arc"]
    return (arcs + ends if len(arcs) == 1 else arcs)[:MOST_PANELS]


def axis_top_deg(movement: Movement, angle: int) -> float:
    """Fixed top of the axis: the same for both ends, whatever was measured."""
    if movement == "arc":
        return {0: 90.0, 1: 180.0, 2: 180.0}[angle]
    return 60.0 if angle == 0 else 90.0


def paint_chart(painter: QPainter, style: PlotStyle, box: QRectF, progress: Progress) -> None:
    """All panels with one time axis under them, in any painter's unit."""
    panels = panels_of(progress)
    if not panels:
        return
    unit = style.unit
    line = QFontMetricsF(style.end_label).height()
    foot, title = line * 2 + 26 * unit, line + 14 * unit
    height = (box.height() - foot) / len(panels)
    # Room for the longest label beside a line; every panel has the same.
    words = max(
        QFontMetricsF(style.end_label).horizontalAdvance(tr("Usual, adults {span}").format(span="120–150°")), 1.0
    )
    left, right = box.left() + 56 * unit, box.right() - words - 16 * unit
    for place, (movement, angle) in enumerate(panels):
        area = QRectF(left, box.top() + place * height + title, right - left, height - title - 10 * unit)
        _paint_panel(painter, style, area, progress, movement, angle)
    _paint_dates(painter, style, QRectF(left, box.bottom() - foot + 4 * unit, right - left, line), progress)
    _paint_key(painter, style, QPointF(left - 20 * unit, box.bottom() - 6 * unit))


def _paint_panel(
    painter: QPainter, style: PlotStyle, area: QRectF, progress: Progress, movement: Movement, angle: int
) -> None:
    top_deg, unit = axis_top_deg(movement, angle), style.unit
    step = STEP_DEG if top_deg <= 90 else 2 * STEP_DEG

    def y(value_deg: float) -> float:
        return area.bottom() - min(max(value_deg / top_deg, 0.0), 1.0) * area.height()

    painter.setFont(font(style.end_label.pixelSize() * 1.25, SEMIBOLD, display=False))
    painter.setPen(style.color("text"))
    name = tr("Whole arc") if movement == "arc" else terms.movement_long_name(movement)
    if movement == "arc" and progress.points[-1].figures.exercise.angle is None:
        name = terms.arc_name(angle)
    painter.drawText(QPointF(area.left(), area.top() - 9 * unit), name)
    labels: list[tuple[float, str, str]] = []
    usual = usual_deg(movement, angle)
    if usual is not None:
        low, high = usual
        band_top, band_bottom = y(high), max(y(low), y(high) + 2 * unit)
        painter.fillRect(QRectF(area.left(), band_top, area.width(), band_bottom - band_top), style.color("norm"))
        span = f"{low:.0f}°" if low == high else f"{low:.0f}–{high:.0f}°"
        labels.append((0.5 * (band_top + band_bottom), tr("Usual, adults {span}").format(span=span), "text2"))
    first = progress.first.row(movement, angle) if progress.first else None
    limit = next((c.limit_deg for c in progress.comparisons if (c.movement, c.angle) == (movement, angle)), math.nan)
    if first is not None and math.isfinite(limit):
        band = QRectF(area.left(), y(first.mean_deg + limit), area.width(), 0)
        band.setBottom(y(first.mean_deg - limit))
        painter.fillRect(band, style.color("soft"))
        hatch(painter, style, band, "accent", 90)
        words = tr("Error band ±{gap}{limit}").format(gap=numbers.NARROW_GAP, limit=numbers.degrees(limit))
        labels.append((band.center().y(), words, "accent"))
    ticks = np.arange(0.0, top_deg + 1e-6, step)
    painter.setFont(style.label)
    for tick in ticks:
        painter.setPen(QPen(style.color("border" if tick == 0 else "line"), style.grid_width))
        painter.drawLine(QPointF(area.left(), y(tick)), QPointF(area.right(), y(tick)))
        painter.setPen(style.color("text2"))
        label = QRectF(area.left() - 60 * unit, y(tick) - 10 * unit, 48 * unit, 20 * unit)
        painter.drawText(label, int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter), f"{tick:.0f}°")
    other = progress.other_hand.row(movement, angle) if progress.other_hand else None
    if other is not None and progress.other_hand is not None:
        pen = QPen(style.color("text2"), 1.5 * unit)
        pen.setDashPattern([8, 6])
        painter.setPen(pen)
        painter.drawLine(QPointF(area.left(), y(other.mean_deg)), QPointF(area.right(), y(other.mean_deg)))
        words = f"{terms.hand_name(progress.other_hand.side)} {numbers.degrees(other.mean_deg)}"
        labels.append((y(other.mean_deg), words, "text2"))
    _paint_points(painter, style, area, progress, movement, angle, y)
    _paint_end_labels(painter, style, area, labels)


def _paint_points(
    painter: QPainter, style: PlotStyle, area: QRectF, progress: Progress, movement: Movement, angle: int,
    y: Callable[[float], float],
) -> None:  # fmt: skip
    unit, token = style.unit, "text" if movement == "arc" else CURVE_TOKENS[angle]
    rows: list[tuple[float, RangeRow, bool]] = []
    for x, point in zip(_places(area, progress, unit), progress.points, strict=True):
        row = point.figures.row(movement, angle)
        if row is not None:
            rows.append((x, row, point.fair))
    fair = [(x, row) for x, row, is_fair in rows if is_fair]
    painter.setPen(QPen(style.color(token), style.line_width))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if len(fair) > 1:
        painter.drawPolyline(polygon(np.array([x for x, _ in fair]), np.array([y(row.mean_deg) for _, row in fair])))
    for x, row, is_fair in rows:
        color = style.color(token if is_fair else "text2")
        sd = row.sd_deg if math.isfinite(row.sd_deg) else row.measurement_sd_deg
        if math.isfinite(sd):
            painter.setPen(QPen(color, 1.4 * unit))
            for edge in (y(row.mean_deg + sd), y(row.mean_deg - sd)):
                painter.drawLine(QPointF(x - CAP_REACH * unit, edge), QPointF(x + CAP_REACH * unit, edge))
            painter.drawLine(QPointF(x, y(row.mean_deg + sd)), QPointF(x, y(row.mean_deg - sd)))
        painter.setPen(QPen(color, 2 * unit) if not is_fair else Qt.PenStyle.NoPen)
        painter.setBrush(style.color("surface") if not is_fair else color)
        painter.drawEllipse(QPointF(x, y(row.mean_deg)), DOT_RADIUS * unit, DOT_RADIUS * unit)
    for x, row in fair[:1] + fair[-1:]:
        painter.setFont(font(style.end_label.pixelSize() * 1.17, SEMIBOLD, display=False))
        painter.setPen(style.color("text"))
        metrics = QFontMetricsF(painter.font())
        text = numbers.degrees(row.mean_deg)
        sd = row.sd_deg if math.isfinite(row.sd_deg) else 0.0
        baseline = y(row.mean_deg + sd) - 8 * unit
        other = progress.other_hand.row(movement, angle) if progress.other_hand else None
        if other is not None and baseline - metrics.ascent() < y(other.mean_deg) + 2 * unit < baseline + 4 * unit:
            baseline = y(row.mean_deg - sd) + 8 * unit + metrics.ascent()
        painter.drawText(QPointF(x - metrics.horizontalAdvance(text) / 2, baseline), text)


def _paint_end_labels(painter: QPainter, style: PlotStyle, area: QRectF, labels: list[tuple[float, str, str]]) -> None:
    """At the right ends of their lines, pushed apart where they would touch."""
    painter.setFont(style.end_label)
    height = QFontMetricsF(style.end_label).height()
    taken = -math.inf
    for middle, text, token in sorted(labels):
        top = max(middle - height / 2, taken)
        taken = top + height
        painter.setPen(style.color(token))
        box = QRectF(area.right() + 12 * style.unit, top, 200 * style.unit, height)
        painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter), text)


def _places(area: QRectF, progress: Progress, unit: float) -> list[float]:
    """X of every session, time to scale."""
    times = [point.figures.when.timestamp() for point in progress.points]
    span = (times[-1] - times[0]) or 1.0
    pad = min(24.0 * unit, area.width() / 12)
    if len(times) == 1:
        return [area.center().x()]
    return [area.left() + pad + (time - times[0]) / span * (area.width() - 2 * pad) for time in times]


def _paint_dates(painter: QPainter, style: PlotStyle, area: QRectF, progress: Progress) -> None:
    painter.setFont(style.end_label)
    metrics = QFontMetricsF(style.end_label)
    places = _places(area, progress, style.unit)
    days: list[datetime] = [point.figures.when for point in progress.points]
    taken: list[tuple[float, float]] = []
    ends = [0, len(days) - 1]
    for number in [*ends, *range(1, len(days) - 1)]:
        text = numbers.day_month(days[number])
        width = metrics.horizontalAdvance(text)
        left = places[number] - width / 2
        if any(left < right + 6 * style.unit and left + width > other - 6 * style.unit for other, right in taken):
            continue
        taken.append((left, left + width))
        painter.setPen(style.color("text" if number in ends else "text2"))
        painter.drawText(QPointF(left, area.top() + metrics.ascent()), text)


def _paint_key(painter: QPainter, style: PlotStyle, at: QPointF) -> None:
    unit = style.unit
    painter.setFont(style.end_label)
    metrics = QFontMetricsF(style.end_label)
    across = at.x()
    for filled, words in ((True, tr("mean, ± sd between repetitions")), (False, tr("other set-up: not compared"))):
        painter.setPen(QPen(style.color("text" if filled else "text2"), 2 * unit))
        painter.setBrush(style.color("text") if filled else style.color("surface"))
        painter.drawEllipse(QPointF(across + 5 * unit, at.y() - metrics.ascent() * 0.36), 4.5 * unit, 4.5 * unit)
        painter.setPen(style.color("text2"))
        painter.drawText(QPointF(across + 17 * unit, at.y()), words)
        across += 17 * unit + metrics.horizontalAdvance(words) + 30 * unit

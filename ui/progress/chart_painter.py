"""Range over time: points with error bars, error band about the first session, norm band, other hand.

Painted by the same functions on the screen and on paper.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import datetime

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen, QPolygonF

from core.output.exercises import Movement
from core.output.joint_content import USUAL_TOTAL_DEG
from core.output.range_rows import RangeRow, RowKey, is_total
from core.output.report_content import Progress, usual_deg
from ui import numbers, terms
from ui.figures import figure_of
from ui.fonts import SEMIBOLD, font
from ui.plot.axes import hatch
from ui.plot.polygon import polygon
from ui.plot.style import CURVE_TOKENS, PlotStyle
from ui.translate import tr

STEP_DEG = 30.0
DOT_RADIUS, CAP_REACH = 3.5, 7.0
"""The caps of an error bar reach beyond the dot, so that a spread of one or two degrees still shows."""
MOST_PANELS = 3


def panels_of(progress: Progress) -> list[RowKey]:
    """What is drawn, arc first; of free movement the three arcs; of the whole hand what was chosen and ever seen."""
    if not progress.points:
        return []
    if progress.keys:
        seen = {row.key for point in progress.points for row in point.figures.joint_rows if row.count}
        return [key for key in progress.keys if key in seen]
    rows = progress.points[-1].figures.rows
    arcs = [row.key for row in rows if row.movement == "arc"]
    ends = [row.key for row in rows if row.movement != "arc"]
    return (arcs + ends if len(arcs) == 1 else arcs)[:MOST_PANELS]


def axis_top_deg(movement: Movement, angle: int, joint: str = "") -> float:
    """Fixed top of the axis: the same for both ends, whatever was measured."""
    if joint:
        return 180.0 if joint == "TAM1" else 300.0 if is_total(joint) else 60.0 if _is_spread(joint) else 120.0
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
    columns = 1 if len(panels) <= MOST_PANELS else 2
    lines = math.ceil(len(panels) / columns)
    height = (box.height() - foot) / lines
    # Room for the longest label beside a line; every panel has the same.
    words = max(
        QFontMetricsF(style.end_label).horizontalAdvance(tr("Usual, adults {span}").format(span="120–150°")), 1.0
    )
    width = box.width() / columns
    for place, key in enumerate(panels):
        edge = box.left() + (place // lines) * width
        left, right = edge + 56 * unit, edge + width - words - 16 * unit
        top = box.top() + (place % lines) * height + title
        area = QRectF(left, top, right - left, height - title - 10 * unit)
        _paint_panel(painter, style, area, progress, key)
        if place % lines == 0:
            dates = QRectF(left, box.bottom() - foot + 4 * unit, right - left, line)
            _paint_dates(painter, style, dates, progress)
    left = box.left() + 56 * unit
    _paint_key(painter, style, progress, QPointF(left - 20 * unit, box.bottom() - 6 * unit))


def _paint_panel(painter: QPainter, style: PlotStyle, area: QRectF, progress: Progress, key: RowKey) -> None:
    joint, movement, angle = key
    top_deg, unit = axis_top_deg(movement, angle, joint), style.unit
    step = STEP_DEG if top_deg <= 90 else 2 * STEP_DEG if top_deg <= 180 else 100.0

    def y(value_deg: float) -> float:
        return area.bottom() - min(max(value_deg / top_deg, 0.0), 1.0) * area.height()

    painter.setFont(font(style.end_label.pixelSize() * 1.25, SEMIBOLD, display=False))
    painter.setPen(style.color("text"))
    name = tr("Whole arc") if movement == "arc" else terms.movement_long_name(movement)
    if joint:
        name = figure_of(joint).long_name
    elif movement == "arc" and progress.points[-1].figures.exercise.angle is None:
        name = terms.arc_name(angle)
    painter.drawText(QPointF(area.left(), area.top() - 9 * unit), name)
    labels: list[tuple[float, str, str]] = []
    total = USUAL_TOTAL_DEG[int(joint[-1])] if is_total(joint) else math.nan
    usual = (total, total) if is_total(joint) else None if joint else usual_deg(movement, angle)
    if usual is not None:
        low, high = usual
        band_top, band_bottom = y(high), max(y(low), y(high) + 2 * unit)
        painter.fillRect(QRectF(area.left(), band_top, area.width(), band_bottom - band_top), style.color("norm"))
        span = f"{low:.0f}°" if low == high else f"{low:.0f}–{high:.0f}°"
        labels.append((0.5 * (band_top + band_bottom), tr("Usual, adults {span}").format(span=span), "text2"))
    first = progress.first.row(movement, angle, joint) if progress.first else None
    limit = next((c.limit_deg for c in progress.comparisons if (c.joint, c.movement, c.angle) == key), math.nan)
    if first is not None and first.count and math.isfinite(limit):
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
    other = progress.other_hand.row(movement, angle, joint) if progress.other_hand else None
    if other is not None and other.count and progress.other_hand is not None:
        pen = QPen(style.color("text2"), 1.5 * unit)
        pen.setDashPattern([8, 6])
        painter.setPen(pen)
        painter.drawLine(QPointF(area.left(), y(other.mean_deg)), QPointF(area.right(), y(other.mean_deg)))
        words = f"{terms.hand_name(progress.other_hand.side)} {numbers.degrees(other.mean_deg)}"
        labels.append((y(other.mean_deg), words, "text2"))
    _paint_points(painter, style, area, progress, key, y)
    _paint_end_labels(painter, style, area, labels)


def _paint_points(
    painter: QPainter, style: PlotStyle, area: QRectF, progress: Progress, key: RowKey, y: Callable[[float], float]
) -> None:
    joint, movement, angle = key
    unit, token = style.unit, "text" if movement == "arc" else CURVE_TOKENS[angle]
    if joint and not is_total(joint):
        token = figure_of(joint).token
    rows: list[tuple[float, RangeRow, bool]] = []
    for x, point in zip(_places(area, progress, unit), progress.points, strict=True):
        row = point.figures.row(movement, angle, joint)
        if row is not None and row.count:
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
        if joint and row.limited:
            _paint_at_least(painter, x, y(row.mean_deg + (sd if math.isfinite(sd) else 0.0)) - 4 * unit, unit)
    for x, row in fair[:1] + fair[-1:]:
        painter.setFont(font(style.end_label.pixelSize() * 1.17, SEMIBOLD, display=False))
        painter.setPen(style.color("text"))
        metrics = QFontMetricsF(painter.font())
        text = numbers.degrees(row.mean_deg)
        sd = row.sd_deg if math.isfinite(row.sd_deg) else 0.0
        baseline = y(row.mean_deg + sd) - 8 * unit
        if joint and row.limited:
            baseline -= 10 * unit
            text = f"≥{numbers.NARROW_GAP}{text}"
        other = progress.other_hand.row(movement, angle, joint) if progress.other_hand else None
        if (
            other is not None
            and other.count
            and baseline - metrics.ascent() < y(other.mean_deg) + 2 * unit < baseline + 4 * unit
        ):
            baseline = y(row.mean_deg - sd) + 8 * unit + metrics.ascent()
        painter.drawText(QPointF(x - metrics.horizontalAdvance(text) / 2, baseline), text)


def _paint_at_least(painter: QPainter, x: float, y: float, unit: float) -> None:
    """An arrow upwards: the joint went out of sight, the true value may be larger."""
    painter.drawPolygon(QPolygonF([QPointF(x, y - 7 * unit), QPointF(x - 4.5 * unit, y), QPointF(x + 4.5 * unit, y)]))


def _is_spread(joint: str) -> bool:
    return figure_of(joint).row == "spread"


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


def _paint_key(painter: QPainter, style: PlotStyle, progress: Progress, at: QPointF) -> None:
    unit = style.unit
    painter.setFont(style.end_label)
    metrics = QFontMetricsF(style.end_label)
    across = at.x()
    entries = [(True, tr("mean, ± sd between repetitions")), (False, tr("other set-up: not compared"))]
    for filled, words in entries:
        painter.setPen(QPen(style.color("text" if filled else "text2"), 2 * unit))
        painter.setBrush(style.color("text") if filled else style.color("surface"))
        painter.drawEllipse(QPointF(across + 5 * unit, at.y() - metrics.ascent() * 0.36), 4.5 * unit, 4.5 * unit)
        painter.setPen(style.color("text2"))
        painter.drawText(QPointF(across + 17 * unit, at.y()), words)
        across += 17 * unit + metrics.horizontalAdvance(words) + 30 * unit
    if progress.keys:
        painter.setPen(QPen(style.color("text2"), 1.4 * unit))
        painter.setBrush(style.color("surface"))
        _paint_at_least(painter, across + 5 * unit, at.y() - 1 * unit, unit)
        painter.setPen(style.color("text2"))
        painter.drawText(QPointF(across + 17 * unit, at.y()), tr("at least: hidden in part"))

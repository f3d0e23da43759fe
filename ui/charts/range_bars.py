"""Bars from one end of a movement to the other: today, last time and the other hand over reference values."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from carpus.core.model.hand.exercises import AXIS_TICK_DEG, DIRECTIONS, PRONOSUPINATION, Exercise
from carpus.core.model.hand.forearm_rotation import is_counted_from_thumb_up
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.rounding import format_rounded
from carpus.core.results.norms import wrist_norm
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.style import PlotStyle, draw_text
from carpus.ui.kit import numbers
from carpus.ui.kit.theme import CURVE_TOKENS
from carpus.ui.kit.translate import tr
from carpus.ui.words import terms

# Height of a bar with its margin, and of the scale below, in design pixels.
BAR_PX, FOOT_PX = 20.0, 36.0
_CENTER = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignHCenter
_LEFT = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft
_RIGHT = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight


@dataclass(frozen=True, slots=True)
class RangeBar:
    """Range of one angle in one session."""

    name: str
    results: SessionResults
    angle: int
    thickness_px: float
    token: str


def range_bars(
    results: SessionResults, previous: SessionResults | None, other_hand: SessionResults | None
) -> list[RangeBar]:
    """Return a bar for each angle; of a single angle also last time's and the other hand's."""
    if results.exercise.angle is None:
        names = {1: tr("Flexion–extension"), 0: tr("Deviation"), 2: tr("Pronation–supination")}
        bars = [RangeBar(name, results, angle, 10.7, CURVE_TOKENS[angle]) for angle, name in names.items()]
    else:
        angle = results.exercise.angle
        bars = [RangeBar(tr("Today"), results, angle, 10.7, CURVE_TOKENS[angle])]
        if previous is not None:
            day = numbers.format_distinct_day(previous.when, results.when)
            bars.append(RangeBar(day, previous, angle, 8.0, "border"))
        if other_hand is not None:
            bars.append(RangeBar(terms.hand_name(other_hand.side), other_hand, angle, 4.0, "text2"))
    return [bar for bar in bars if any(row.wrist_angle == bar.angle for row in bar.results.wrist_ranges)]


def paint_range_bars(
    painter: QPainter, style: PlotStyle, box: QRectF, exercise: Exercise, bars: Sequence[RangeBar]
) -> None:
    """Paint the bars over the reference values into a box."""
    px = style.unit
    area = box.adjusted(104 * px, 0.0, -16 * px, -FOOT_PX * px)  # half of “120°” is right of the last line
    end_deg = 80.0 if exercise.angle is None else AXIS_TICK_DEG[exercise.angle]
    if is_counted_from_thumb_up(exercise) and any(bar.angle == PRONOSUPINATION for bar in bars):
        end_deg = 120.0

    def x(value_deg: float) -> float:
        return area.center().x() + max(-1.0, min(1.0, value_deg / end_deg)) * 0.5 * area.width()

    angle = bars[0].angle
    upper, lower = DIRECTIONS[angle]
    norms = {name: wrist_norm(name, angle, exercise) for name in (upper, lower)}
    for name, sign in ((upper, 1.0), (lower, -1.0)):
        if (norm := norms[name]) is not None:
            ends = sorted((x(sign * norm.low_deg), x(sign * norm.high_deg)))
            width = max(ends[1] - ends[0], 2 * px)
            painter.fillRect(QRectF(ends[0], area.top(), width, area.height()), style.color("norm"))
    for k in range(-4, 5):
        at = x(k * end_deg / 4)
        painter.setPen(QPen(style.color("line" if k else "border"), style.grid_width))
        painter.drawLine(QLineF(at, area.top(), at, area.bottom()))
        label = QRectF(at - 40 * px, area.bottom() + 3 * px, 80 * px, 16 * px)
        draw_text(
            painter, label, f"{format_rounded(abs(k) * end_deg / 4)}°", style.label_font, style.color("text2"), _CENTER
        )
    for place, bar in enumerate(bars):
        middle = area.top() + (place + 0.5) * area.height() / len(bars)
        name_box = QRectF(box.left(), middle - 10 * px, 100 * px, 20 * px)
        draw_text(painter, name_box, bar.name, style.end_label_font, style.color("text"))
        _paint_bar(painter, style, bar, middle, x)
    if exercise.angle is None:
        return
    foot = QRectF(area.left(), area.bottom() + 20 * px, area.width(), 16 * px)
    draw_text(painter, foot, terms.movement_name(lower), style.label_font, style.color("text2"), _LEFT)
    draw_text(painter, foot, terms.movement_name(upper), style.label_font, style.color("text2"), _RIGHT)
    if norms[upper] is not None:
        words = tr("grey: reference values of adults (AMA, AAOS)")
        draw_text(painter, foot, words, style.label_font, style.color("text2"), _CENTER)


def _paint_bar(painter: QPainter, style: PlotStyle, bar: RangeBar, middle: float, x) -> None:  # type: ignore[no-untyped-def]
    px = style.unit
    upper, lower = (bar.results.find(WRIST_ANGLES[bar.angle], movement) for movement in DIRECTIONS[bar.angle])
    high, low = upper.mean if upper else 0.0, -lower.mean if lower else 0.0
    box = QRectF(
        QPointF(x(low), middle - 0.5 * bar.thickness_px * px), QPointF(x(high), middle + 0.5 * bar.thickness_px * px)
    )
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(style.color(bar.token))
    painter.drawRoundedRect(box, 1.3 * px, 1.3 * px)
    if bar.thickness_px < 10.0:
        return
    painter.setPen(QPen(style.color("text"), 1.2 * px))
    for value, row in ((high, upper), (low, lower)):
        if row is not None and math.isfinite(row.sd):
            ends = x(value - row.sd), x(value + row.sd)
            painter.drawLine(QLineF(ends[0], middle, ends[1], middle))
            for end in ends:
                painter.drawLine(QLineF(end, middle - 4 * px, end, middle + 4 * px))

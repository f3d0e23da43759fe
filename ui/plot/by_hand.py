"""The course of one measure taken by hand: hollow squares, beside Carpus's own dots where it measures the same."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date, datetime, time

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPen, QPolygonF

from carpus.core.by_hand.measures import HandMeasure
from carpus.core.by_hand.values import HandValue
from carpus.ui import numbers
from carpus.ui.by_hand.names import measure_name, value_words
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.marks import EndLabels, Scales
from carpus.ui.plot.style import PlotStyle
from carpus.ui.translate import tr

HALF_PX = 4.5
DAY_S = 86_400.0


def day_s(day: date, sessions: Iterable[datetime] = ()) -> float:
    """Where a value known only by its day lies on an axis of time: at that day's session, whose time is known, else in
    the middle of the day."""
    same = [when for when in sessions if when.date() == day]
    return (same[0] if same else datetime.combine(day, time(12))).timestamp()


@dataclass(frozen=True, slots=True)
class Squares:
    """Values by hand of one way: hollow squares, diamonds where it was moved by somebody else; never joined with ours.

    ``joined``: a thin line between them, where nothing else is in the panel; ``sessions``: when ours were. What is
    beyond the axis of time is an arrow at its end.
    """

    values: Sequence[HandValue]
    joined: bool = False
    sessions: Sequence[datetime] = ()

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        times = [day_s(one.day, self.sessions) for one in self.values]
        places = [
            QPointF(float(panel.x(at)), float(panel.y(one.value))) for at, one in zip(times, self.values, strict=True)
        ]
        shown = [at for at in places if panel.box.left() - 1 <= at.x() <= panel.box.right() + 1]
        painter.setPen(QPen(style.color("text"), 1.6 * style.unit))
        if self.joined and len(shown) > 1:
            painter.drawPolyline(QPolygonF(shown))
        painter.setBrush(style.color("surface"))
        passive = bool(self.values) and self.values[0].way == "passive"
        for at in shown:
            paint_square(painter, at, style.unit, turned=passive)
        for edge, way in ((panel.box.left(), -1.0), (panel.box.right(), 1.0)):
            beyond = [at for at in places if (at.x() - edge) * way > 1]
            if beyond:
                nearest = min(beyond, key=lambda at, edge=edge: abs(at.x() - edge))  # type: ignore[misc]
                _paint_beyond(painter, QPointF(edge, nearest.y()), way * style.unit)


def _paint_beyond(painter: QPainter, at: QPointF, unit: float) -> None:
    """An arrow: there is more before or after what the axis of time shows."""
    reach = 2.0 * HALF_PX * unit
    corners = [QPointF(0, -abs(reach) / 2), QPointF(reach, 0), QPointF(0, abs(reach) / 2)]
    painter.drawPolygon(QPolygonF([at + corner for corner in corners]))


def paint_square(painter: QPainter, at: QPointF, unit: float, *, turned: bool = False) -> None:
    """The sign of what was entered by hand."""
    half = HALF_PX * unit
    if turned:
        half *= 1.3
        corners = [QPointF(0, -half), QPointF(half, 0), QPointF(0, half), QPointF(-half, 0)]
        painter.drawPolygon(QPolygonF([at + corner for corner in corners]))
    else:
        painter.drawRect(QRectF(at.x() - half, at.y() - half, 2 * half, 2 * half))


@dataclass(frozen=True, slots=True)
class OurDots:
    """What Carpus measured of the same, each session's mean."""

    points: Sequence[tuple[datetime, float]]

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        places = [QPointF(float(panel.x(when.timestamp())), float(panel.y(value))) for when, value in self.points]
        painter.setPen(QPen(style.color("curve_a"), style.line_width))
        painter.drawPolyline(QPolygonF(places))
        painter.setBrush(style.color("curve_a"))
        for at in places:
            painter.drawEllipse(at, 4 * style.unit, 4 * style.unit)


def scale_of(measure: HandMeasure, values: Sequence[float]) -> Scale:
    """From zero, or below it where something is, to the next round number above all there is."""
    top = max([*values, 0.5 * measure.usual[1] if measure.kind == "score" else 0.0, 1e-6])
    steps = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0, 500.0)
    step = next((one for one in steps if top / one <= 4.0), 500.0)
    low = step * math.floor(min([*values, 0.0]) / step)
    high = step * math.ceil(top / step + 1e-9)
    ticks = tuple(np.arange(low, high + step / 2, step).tolist())
    return Scale(low, high, ticks, tuple((tick, value_words(measure, tick)) for tick in ticks), strong_ends=False)


def paint_course(
    painter: QPainter,
    style: PlotStyle,
    box: QRectF,
    measure: HandMeasure,
    values: Sequence[HandValue],
    ours: Sequence[tuple[datetime, float]],
) -> None:
    """Title, axis, squares, dots and what they mean."""
    unit, metrics = style.unit, QFontMetricsF(style.end_label)
    painter.setFont(font(style.end_label.pixelSize() * 1.25, SEMIBOLD, display=False))
    painter.setPen(style.color("text"))
    title = QFontMetricsF(painter.font()).height()
    painter.drawText(QPointF(box.left(), box.top() + 0.8 * title), measure_name(measure))
    active = [one for one in values if one.way != "passive"]
    passive = [one for one in values if one.way == "passive"]
    when = [one for one, _ in ours]
    times = [day_s(one.day, when) for one in values] + [one.timestamp() for one in when]
    if not times:
        painter.setFont(style.end_label)
        painter.setPen(style.color("text2"))
        painter.drawText(QPointF(box.left(), box.top() + 2.2 * title), tr("Nothing measured by hand yet."))
        return
    pad = max(0.06 * (max(times) - min(times)), 2 * DAY_S)
    scale = scale_of(measure, [one.value for one in values] + [value for _, value in ours])
    left = max(metrics.horizontalAdvance(text) for _, text in scale.labels) + 14 * unit
    right = metrics.horizontalAdvance(tr("passive {value}").format(value="100°")) + 20 * unit
    area = QRectF(
        box.left() + left, box.top() + title + 12 * unit, box.width() - left - right,
        box.height() - title - 2 * metrics.height() - 34 * unit,
    )  # fmt: skip
    panel = Panel(area, scale, min(times) - pad, max(times) + pad)
    Scales().paint(painter, style, panel)
    if ours:
        OurDots(ours).paint(painter, style, panel)
    for some in (passive, active):
        Squares(some, joined=not ours, sessions=when).paint(painter, style, panel)
    labels = (
        [(ours[-1][1], tr("Carpus {value}").format(value=value_words(measure, ours[-1][1])), "curve_a")] if ours else []
    )
    for some in (passive, active):
        if some:
            pattern = {"passive": tr("passive {value}"), "active": tr("active {value}")}.get(some[-1].way, "{value}")
            words = pattern.format(value=value_words(measure, some[-1].value))
            labels.append((some[-1].value, words, "text"))
    EndLabels(labels).paint(painter, style, panel)
    _paint_days(painter, style, panel, [one.day for one in values] + [one.date() for one in when])
    _paint_meaning(painter, style, box, has_passive=bool(passive), has_ours=bool(ours), ways=len(measure.ways))


def _paint_days(painter: QPainter, style: PlotStyle, panel: Panel, days: Sequence[date]) -> None:
    """The first and the last day, and what fits between."""
    metrics, taken = QFontMetricsF(style.end_label), list[tuple[float, float]]()
    painter.setFont(style.end_label)
    painter.setPen(style.color("text2"))
    known = sorted(set(days))
    for day in [known[-1], known[0], *known[1:-1]]:
        text = numbers.day_month(day)
        width = metrics.horizontalAdvance(text)
        left = float(panel.x(day_s(day))) - width / 2
        if any(left < end + 6 * style.unit and left + width > start - 6 * style.unit for start, end in taken):
            continue
        taken.append((left, left + width))
        painter.drawText(QPointF(left, panel.box.bottom() + metrics.ascent() + 6 * style.unit), text)


def _paint_meaning(
    painter: QPainter, style: PlotStyle, box: QRectF, *, has_passive: bool, has_ours: bool, ways: int
) -> None:
    unit, metrics = style.unit, QFontMetricsF(style.end_label)
    baseline = box.bottom() - 5 * unit
    across = box.left() + 8 * unit
    signs = [("square", tr("by hand, active") if ways > 1 else tr("by hand"))]
    signs += [("diamond", tr("by hand, passive"))] if has_passive else []
    signs += [("dot", tr("Carpus, mean"))] if has_ours else []
    needed = sum(28 * unit + metrics.horizontalAdvance(words) for _, words in signs) + 8 * unit
    if needed > box.width():  # longer words are smaller
        face = QFont(style.end_label)
        face.setPixelSize(max(1, int(face.pixelSize() * max(0.6, (box.width() - 28 * unit * len(signs)) / needed))))
        painter.setFont(face)
        metrics = QFontMetricsF(face)
    for sign, words in signs:
        at = QPointF(across, baseline - 0.36 * metrics.ascent())
        painter.setPen(QPen(style.color("curve_a" if sign == "dot" else "text"), 1.6 * unit))
        painter.setBrush(style.color("curve_a" if sign == "dot" else "surface"))
        if sign == "dot":
            painter.drawEllipse(at, 4 * unit, 4 * unit)
        else:
            paint_square(painter, at, unit, turned=sign == "diamond")
        painter.setPen(style.color("text2"))
        painter.drawText(QPointF(across + 12 * unit, baseline), words)
        across += 28 * unit + metrics.horizontalAdvance(words)

"""The course of one measure taken by hand: hollow squares, beside Carpus's own dots where it measures the same."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date, datetime, time

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF, QPainter, QPen, QPolygonF

from carpus.core.measures.by_hand import HandMeasure, HandValue
from carpus.ui import numbers
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.marks import EndLabels, Scales, Times
from carpus.ui.plot.style import PlotStyle, write
from carpus.ui.translate import tr
from carpus.ui.words.by_hand import measure_name, value_words

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
        places = [panel.at(at, one.value) for at, one in zip(times, self.values, strict=True)]
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


def paint_at_least(painter: QPainter, x: float, y: float, unit: float) -> None:
    """An arrow upwards: the joint went out of sight, the true value may be larger."""
    painter.drawPolygon(QPolygonF([QPointF(x, y - 7 * unit), QPointF(x - 4.5 * unit, y), QPointF(x + 4.5 * unit, y)]))


@dataclass(frozen=True, slots=True)
class Key:
    """What the signs mean (sign, words, token), at the lower end of a box in as many lines as it needs."""

    entries: Sequence[tuple[str, str, str]]

    def lines(self, style: PlotStyle, box: QRectF) -> list[list[tuple[float, str, str, str]]]:
        metrics, unit = QFontMetricsF(style.end_label), style.unit
        lines: list[list[tuple[float, str, str, str]]] = [[]]
        across = 8 * unit
        for sign, words, token in self.entries:
            width = 17 * unit + metrics.horizontalAdvance(words)
            if lines[-1] and across + width > box.width():
                lines.append([])
                across = 8 * unit
            lines[-1].append((box.left() + across, sign, words, token))
            across += width + 18 * unit
        return lines

    def paint(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        unit, metrics = style.unit, QFontMetricsF(style.end_label)
        for number, entries in enumerate(reversed(self.lines(style, box))):
            baseline = box.bottom() - 6 * unit - number * metrics.height()
            for left, sign, words, token in entries:
                at = QPointF(left + 5 * unit, baseline - 0.36 * metrics.ascent())
                painter.setPen(QPen(style.color(token), 1.6 * unit))
                painter.setBrush(style.color(token if sign == "dot" else "surface"))
                if sign == "arrow":
                    paint_at_least(painter, at.x(), baseline - 1 * unit, unit)
                elif sign in ("square", "diamond"):
                    paint_square(painter, at, unit, turned=sign == "diamond")
                else:
                    painter.drawEllipse(at, HALF_PX * unit, HALF_PX * unit)
                write(painter, QPointF(left + 17 * unit, baseline), words, style.end_label, style.color("text2"))


@dataclass(frozen=True, slots=True)
class OurDots:
    """What Carpus measured of the same, each session's mean."""

    points: Sequence[tuple[datetime, float]]

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        places = [panel.at(when.timestamp(), value) for when, value in self.points]
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
    face = font(style.end_label.pixelSize() * 1.25, SEMIBOLD, display=False)
    title = QFontMetricsF(face).height()
    write(painter, QPointF(box.left(), box.top() + 0.8 * title), measure_name(measure), face, style.color("text"))
    active = [one for one in values if one.way != "passive"]
    passive = [one for one in values if one.way == "passive"]
    when = [one for one, _ in ours]
    times = [day_s(one.day, when) for one in values] + [one.timestamp() for one in when]
    if not times:
        at = QPointF(box.left(), box.top() + 2.2 * title)
        write(painter, at, tr("Nothing measured by hand yet."), style.end_label, style.color("text2"))
        return
    key = Key(
        [("square", tr("by hand, active") if len(measure.ways) > 1 else tr("by hand"), "text")]
        + ([("diamond", tr("by hand, passive"), "text")] if passive else [])
        + ([("dot", tr("Carpus, mean"), "curve_a")] if ours else [])
    )
    pad = max(0.06 * (max(times) - min(times)), 2 * DAY_S)
    scale = scale_of(measure, [one.value for one in values] + [value for _, value in ours])
    left = max(metrics.horizontalAdvance(text) for _, text in scale.labels) + 14 * unit
    right = metrics.horizontalAdvance(tr("passive {value}").format(value="100°")) + 20 * unit
    area = QRectF(
        box.left() + left, box.top() + title + 12 * unit, box.width() - left - right,
        box.height() - title - (1 + len(key.lines(style, box))) * metrics.height() - 34 * unit,
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
    days = sorted({one.day for one in values} | {one.date() for one in when})
    Times([(day_s(day), numbers.day_month(day)) for day in days], days=True).paint(painter, style, panel)
    key.paint(painter, style, box)

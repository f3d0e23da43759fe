"""Plots of an agreement: the differences against their mean (Bland and Altman), and both curves over time.

Along the panel runs the mean of both in
degrees, or time in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter

from carpus.core.hand.forearm_rotation import as_read_rad
from carpus.core.rounding import written
from carpus.core.types import FloatArray
from carpus.ui import numbers
from carpus.ui.plot.axes import Panel, Scale, hatch, time_labels
from carpus.ui.plot.marks import Curves, Level, Mark, Remark, Scales, Times
from carpus.ui.plot.series import Curve, Series
from carpus.ui.plot.style import PlotStyle, write
from carpus.ui.translate import tr
from carpus.ui.words.agreement import angle_token, ends, interval, signed

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.agreement.compare import Pairs

View = Literal["differences", "curves"]
POINT_EVERY_S = 0.2
"""Of the differences as many are drawn; the figures are of all."""
REACHES_DEG = (5.0, 10.0, 20.0, 40.0, 90.0, 180.0)
STEPS_DEG = (5.0, 10.0, 15.0, 30.0, 60.0, 90.0)
DOT_ALPHA = 140


@dataclass(frozen=True, slots=True)
class AgreementPlot:
    """One angle of a comparison; ``limit_deg`` set before, 0 for none; ``over_time`` unless they are readings."""

    pairs: Pairs
    limit_deg: float
    over_time: bool
    view: View = "differences"

    @property
    def measured_deg(self) -> FloatArray:
        return np.degrees(as_read_rad(self.pairs.name, self.pairs.measured_rad))

    @property
    def reference_deg(self) -> FloatArray:
        return np.degrees(as_read_rad(self.pairs.name, self.pairs.reference_rad))

    @property
    def mean_deg(self) -> FloatArray:
        return np.asarray(0.5 * (self.measured_deg + self.reference_deg))

    @property
    def drawn(self) -> np.ndarray:
        """Rows of which a difference is drawn: the first of every fifth of a second, or each reading."""
        if not self.over_time:
            return np.arange(len(self.pairs.time_s))
        return np.unique(np.floor(self.pairs.time_s / POINT_EVERY_S), return_index=True)[1]

    @property
    def along(self) -> FloatArray:
        """What runs along the panel, in the order of the pairs."""
        if self.view == "differences":
            return self.mean_deg
        return self.pairs.time_s if self.over_time else np.arange(1.0, len(self.pairs.time_s) + 1.0)

    def extent(self) -> tuple[float, float]:
        low, high = float(self.along.min()), float(self.along.max())
        if self.view == "curves" and self.over_time:
            return low, max(high, low + 1.0)
        pad = max(0.06 * (high - low), 1.0)
        return low - pad, high + pad

    def scale(self) -> Scale:
        """Of the differences symmetrical, and of the curves about what they reach; labels are the angle's words."""
        if self.view == "differences":
            figures = self.pairs.figures_deg
            values = [*(self.measured_deg - self.reference_deg), *figures.lower_interval, *figures.upper_interval]
            most = max((abs(value) for value in (*values, 1.5 * self.limit_deg) if math.isfinite(value)), default=5.0)
            reach = next((one for one in REACHES_DEG if most <= one), REACHES_DEG[-1])
            step = reach / 2
            ticks = tuple(step * k for k in (2, 1, 0, -1, -2))
            named = tuple((tick, f"{numbers.shortest(abs(tick))}°") for tick in ticks)
            return Scale(-1.04 * reach, 1.04 * reach, ticks, named, False)
        both = np.concatenate((self.measured_deg, self.reference_deg))
        step = _step(float(np.ptp(both)))
        low, high = step * math.floor(float(both.min()) / step), step * math.ceil(float(both.max()) / step)
        high = max(high, low + step)
        ticks = tuple(np.arange(low, high + step / 2, step).tolist())
        pad = 0.04 * (high - low)
        more, less = ends(self.pairs.name)
        labels = [(tick, f"{written(abs(tick))}°") for tick in ticks]
        for place, word in ((0, less), (-1, more)):
            if labels[place][0] * (1 if place else -1) > 0.0:
                labels[place] = (labels[place][0], f"{word} {labels[place][1]}")
        return Scale(low - pad, high + pad, ticks, tuple(labels), False)

    def panel(self, style: PlotStyle, box: QRectF) -> Panel:
        """Where the values are within a box; the words of the lines stand right of it."""
        metrics, unit = QFontMetricsF(style.end_label), style.unit
        right = max(metrics.horizontalAdvance(text) for texts in _line_words(self) for text in texts) + 20 * unit
        scale = self.scale()
        left = max(metrics.horizontalAdvance(text) for _, text in scale.labels) + 16 * unit
        foot = 2 * metrics.height() + 14 * unit
        area = box.adjusted(left, metrics.height() * 0.5, -right, -foot)
        return Panel(area, scale, *self.extent())

    # --- what is drawn ------------------------------------------------------------------------------------
    def ground(self) -> list[Mark]:
        if self.view == "curves":
            return [Scales(), _Along(self)]
        more, less = _shows(self.pairs.name)
        reach = max(self.scale().ticks)
        marks: list[Mark] = [_Limit(self.limit_deg)] if self.limit_deg > 0.0 else []
        return [
            *marks, Scales(), _Along(self), Remark(0.85 * reach, more),
            Remark(-reach, less),
        ]  # fmt: skip

    def moving(self) -> list[Mark]:
        token = angle_token(self.pairs.name)
        if self.view == "differences":
            rows = self.drawn
            values = (self.measured_deg - self.reference_deg)[rows]
            figures = self.pairs.figures_deg
            limits = [Level(value, "text", (7.0, 5.0)) for value in figures.limits]
            dots = _Dots(self.mean_deg[rows], values, token, 3.0 if self.over_time else 4.5)
            return [dots, Level(figures.bias, token, ()), *limits]
        if not self.over_time:
            return [
                _Dots(self.along, self.reference_deg, "border", 5.0),
                _Dots(self.along, self.measured_deg, token, 4.5),
            ]
        step_s = 3.0 * float(np.median(np.diff(self.along))) if len(self.along) > 1 else 1.0
        return [
            Curves(
                [
                    Curve(Series(self.along, values, None, np.full(len(values), dashed), step_s), own)
                    for values, own, dashed in (
                        (self.reference_deg, "curve_c" if token != "curve_c" else "border", True),
                        (self.measured_deg, token, False),
                    )
                ]
            )
        ]

    def beside(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        metrics, unit = QFontMetricsF(style.end_label), style.unit
        token, left = angle_token(self.pairs.name), panel.box.right() + 12 * unit
        if self.view == "curves":
            other = "curve_c" if token != "curve_c" and self.over_time else "border"
            top = panel.box.top() + metrics.ascent()
            for number, ((words,), color) in enumerate(zip(_line_words(self), (token, other), strict=True)):
                place = QPointF(left, top + number * 1.4 * metrics.height())
                write(painter, place, words, style.end_label, style.color("text2" if color == "border" else color))
            return
        figures = self.pairs.figures_deg
        at = [*figures.limits, figures.bias]
        height = 2 * metrics.height()
        taken = -math.inf
        rows = sorted(zip(at, _line_words(self), (False, False, True), strict=True), key=lambda row: -row[0])
        room = panel.box.bottom() + 0.5 * height - len(rows) * (height + 2 * unit)
        for value, (first, second), is_mean in rows:
            if not math.isfinite(value):
                continue
            top = min(max(float(panel.y(value)) - height / 2, taken), max(room, panel.box.top()))
            room += height + 2 * unit
            taken = top + height + 2 * unit
            place = QPointF(left, top + metrics.ascent())
            write(painter, place, first, style.end_label, style.color(token if is_mean else "text"))
            write(painter, place + QPointF(0.0, metrics.height()), second, style.label, style.color("text2"))

    def paint(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        panel = self.panel(style, box)
        for mark in (*self.ground(), *self.moving()):
            mark.paint(painter, style, panel)
        self.beside(painter, style, panel)

    def along_labels(self, start: float, end: float) -> list[tuple[float, str]]:
        """Round values along the panel; degrees have the angle's words at the ends."""
        if self.view == "curves" and self.over_time:
            return time_labels(start, end)
        step = _step(end - start) if self.view == "differences" else max(1.0, _step(end - start) // 5)
        ticks = step * np.arange(math.ceil(start / step), math.floor(end / step) + 1)
        if self.view == "curves":
            return [(float(tick), written(tick)) for tick in ticks]
        more, less = ends(self.pairs.name)
        labels = [(float(tick), f"{written(abs(tick))}°") for tick in ticks]
        for place, word in ((0, less), (-1, more)):
            if labels and labels[place][0] * (1 if place else -1) > 0.0:
                labels[place] = (labels[place][0], f"{word} {labels[place][1]}")
        return labels


def _line_words(plot: AgreementPlot) -> list[tuple[str, ...]]:
    """What stands at the lines: of both limits and the mean with their intervals, or the names of the curves."""
    if plot.view == "curves":
        return [(tr("Carpus"),), (tr("Reference"),)]
    name, figures = plot.pairs.name, plot.pairs.figures_deg
    pattern = tr("Limit {value}")
    out: list[tuple[str, ...]] = [
        (pattern.format(value=signed(value, name)), f"({interval(about, name)})")
        for value, about in zip(figures.limits, (figures.lower_interval, figures.upper_interval), strict=True)
    ]
    mean = tr("Mean {value}").format(value=signed(figures.bias, name))
    return [*out, (mean, f"({interval(figures.bias_interval, name)})")]


def _shows(name: str) -> tuple[str, str]:
    """``Carpus shows more flexion``, and the other way."""
    more, less = ends(name)
    words = tr("Carpus shows {what}") if more == tr("more") else tr("Carpus shows more {what}")
    return words.format(what=more), words.format(what=less)


def _hatched() -> str:
    return tr("hatched: within the limit you set")


def _foot(plot: AgreementPlot) -> str:
    """What runs along."""
    if plot.view == "curves":
        return tr("seconds after the first picture") if plot.over_time else tr("number of the reading")
    if plot.over_time:
        return tr("mean of both · one point each 0.2 s, {count} points").format(count=len(plot.drawn))
    return tr("mean of both · one point each reading, {count} readings").format(count=len(plot.drawn))


def _step(span: float) -> float:
    return next((step for step in STEPS_DEG if span / step <= 7.0), STEPS_DEG[-1])


@dataclass(frozen=True, slots=True)
class _Limit:
    """The limit set before, hatched about no difference."""

    limit_deg: float

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        top, bottom = float(panel.y(self.limit_deg)), float(panel.y(-self.limit_deg))
        hatch(painter, style, QRectF(panel.box.left(), top, panel.box.width(), bottom - top), "accent", 90)
        metrics = QFontMetricsF(style.label)
        words = _hatched()
        left = panel.box.right() - metrics.horizontalAdvance(words) - 6 * style.unit
        place = QPointF(left, bottom + metrics.ascent() + 2 * style.unit)
        write(painter, place, words, style.label, style.color("accent"))


@dataclass(frozen=True, slots=True)
class _Along:
    """Values under the panel, and what they are."""

    plot: AgreementPlot

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        labels = self.plot.along_labels(panel.start_s, panel.end_s)
        Times(labels).paint(painter, style, panel)
        height = QFontMetricsF(style.label).height()
        top = panel.box.bottom() + height + 8 * style.unit
        room = QRectF(panel.box.left() - 60 * style.unit, top, panel.box.width() + 120 * style.unit, height)
        side = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop
        write(painter, room, _foot(self.plot), style.label, style.color("text2"), side)


@dataclass(frozen=True, slots=True, eq=False)
class _Dots:
    """One value each, half clear."""

    x: FloatArray
    y: FloatArray
    token: str
    radius: float

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(style.color(self.token, DOT_ALPHA))
        reach = self.radius * style.unit
        for x, y in zip(panel.x(self.x), panel.y(self.y), strict=True):
            if math.isfinite(y) and panel.box.left() - 1 <= x <= panel.box.right() + 1:
                painter.drawEllipse(QPointF(float(x), float(y)), reach, reach)

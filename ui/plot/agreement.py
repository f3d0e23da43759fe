"""Plots of an agreement: the differences against their mean (Bland and Altman), and both curves over time.

Along the panel runs the mean of both in
degrees, or time in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF

from carpus.core.hand.forearm_rotation import as_read_rad
from carpus.core.rounding import written
from carpus.core.types import FloatArray
from carpus.ui import numbers
from carpus.ui.plot.axes import Panel, Scale, time_labels
from carpus.ui.plot.chart import BAND, Chart, Hatching, Label, Plot, scale_labels
from carpus.ui.plot.series import Curve, Series
from carpus.ui.plot.style import PlotStyle
from carpus.ui.theme import Theme
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


class AgreementChart(Chart):
    """One angle of a comparison, over time or as differences against the mean."""

    is_card = False

    def __init__(self, theme: Theme, plot: AgreementPlot) -> None:
        super().__init__(theme)
        self._plot = plot

    def build(self) -> None:
        shown, look = self._plot, self.look
        plot = self.add_plot(shown.panel(look, self.area))
        differences = shown.view == "differences"
        if differences and shown.limit_deg > 0.0:
            self._add_limit(plot)
        plot.add_grid()
        self.add_axis(plot, "left", scale_labels(plot.panel), 12)
        self.add_axis(plot, "bottom", lambda *ends: [Label(*one) for one in shown.along_labels(*ends)][::-1], 6)
        foot = self.text(_foot(shown), look.label, "text2", (0.5, 0.0))
        box = plot.panel.box
        foot.setPos(box.center().x(), box.bottom() + QFontMetricsF(look.label).height() + 8 * look.unit)
        (self._add_differences if differences else self._add_curves)(plot)

    def _add_limit(self, plot: Plot) -> None:
        """What was set before, hatched about no difference."""
        limit, box = self._plot.limit_deg, plot.panel.box
        plot.add_to_layer(Hatching(plot, [(-math.inf, math.inf, -limit, limit)], "accent", 90), BAND)
        words = self.text(_hatched(), self.look.label, "accent", (1.0, 0.0))
        words.setPos(box.right() - 6 * self.look.unit, float(plot.panel.y(-limit)) + 2 * self.look.unit)

    def _add_dots(self, plot: Plot, x: FloatArray, y: FloatArray, token: str, radius: float) -> None:
        """One value each, half clear."""
        at = [
            plot.panel.at(one, value) for one, value in zip(x.tolist(), y.tolist(), strict=True) if math.isfinite(value)
        ]
        self.add_symbols("o", 2.0 * radius, pg.mkPen(None), token, at, DOT_ALPHA)

    def _add_differences(self, plot: Plot) -> None:
        shown, figures = self._plot, self._plot.pairs.figures_deg
        token, unit, rows = angle_token(shown.pairs.name), self.look.unit, shown.drawn
        differences = (shown.measured_deg - shown.reference_deg)[rows]
        self._add_dots(plot, shown.mean_deg[rows], differences, token, 3.0 if shown.over_time else 4.5)
        for value in figures.limits:
            plot.add_level(value, "text", (7.0, 5.0))
        plot.add_level(figures.bias, token, ())
        reach = max(plot.panel.scale.ticks)
        for value, words in zip((0.85 * reach, -reach), _shows(shown.pairs.name), strict=True):
            plot.add_words(value, words, small=True)
        height, taken = 2 * QFontMetricsF(self.look.end_label).height(), -math.inf
        box, at = plot.panel.box, [*figures.limits, figures.bias]
        lines = sorted(zip(at, _line_words(shown), (False, False, True), strict=True), key=lambda row: -row[0])
        room = box.bottom() + 0.5 * height - len(lines) * (height + 2 * unit)
        for value, (first, second), is_mean in lines:
            if not math.isfinite(value):
                continue
            top = min(max(float(plot.panel.y(value)) - height / 2, taken), max(room, box.top()))
            room += height + 2 * unit
            taken = top + height + 2 * unit
            left = box.right() + 12 * unit
            self.text(first, self.look.end_label, token if is_mean else "text").setPos(left, top)
            self.text(second, self.look.label, "text2").setPos(left, top + height / 2)

    def _add_curves(self, plot: Plot) -> None:
        shown, token = self._plot, angle_token(self._plot.pairs.name)
        along, other = shown.along, "curve_c" if token != "curve_c" and shown.over_time else "border"
        if shown.over_time:
            step_s = 3.0 * float(np.median(np.diff(along))) if len(along) > 1 else 1.0
            both = ((shown.reference_deg, other, True), (shown.measured_deg, token, False))
            plot.add_curves().show([
                Curve(Series(along, values, None, np.full(len(values), dashed), step_s), own)
                for values, own, dashed in both
            ])  # fmt: skip
        else:
            self._add_dots(plot, along, shown.reference_deg, "border", 5.0)
            self._add_dots(plot, along, shown.measured_deg, token, 4.5)
        left, height = plot.panel.box.right() + 12 * self.look.unit, QFontMetricsF(self.look.end_label).height()
        for number, ((words,), color) in enumerate(zip(_line_words(shown), (token, other), strict=True)):
            item = self.text(words, self.look.end_label, "text2" if color == "border" else color)
            item.setPos(left, plot.panel.box.top() + 1.4 * number * height)

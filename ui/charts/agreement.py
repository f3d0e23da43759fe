"""Agreement charts: differences against their mean (Bland and Altman), and both curves over time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF

from carpus.core.model.hand.forearm_rotation import to_clinical_rad
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.ui.charts.axes import Panel, Scale, time_labels
from carpus.ui.charts.chart import BAND, AxisLabel, Chart, Hatching, Plot, scale_labels
from carpus.ui.charts.series import Curve, Series
from carpus.ui.charts.style import PlotStyle
from carpus.ui.kit import numbers
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words.agreement import angle_token, direction_names, format_difference, format_interval

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.research.agreement.compare import AnglePairs

View = Literal["differences", "curves"]
# One difference is drawn each 0.2 s; the statistics are of all samples.
POINT_INTERVAL_S = 0.2
AXIS_LIMITS_DEG = (5.0, 10.0, 20.0, 40.0, 90.0, 180.0)
TICK_STEPS_DEG = (5.0, 10.0, 15.0, 30.0, 60.0, 90.0)
DOT_ALPHA = 140


@dataclass(frozen=True, slots=True)
class AgreementPlot:
    """One angle of a comparison between Carpus and a reference measurement.

    Parameters
    ----------
    pairs
            Paired values and their statistics.
    limit_deg
            Acceptance limit set beforehand, 0 for none.
    is_time_series
            False where the reference is a list of single readings.
    view
            Differences against the mean of both, or both curves over time.
    """

    pairs: AnglePairs
    limit_deg: float
    is_time_series: bool
    view: View = "differences"

    @property
    def carpus_deg(self) -> FloatArray:
        return np.degrees(to_clinical_rad(self.pairs.name, self.pairs.measured_rad))

    @property
    def reference_deg(self) -> FloatArray:
        return np.degrees(to_clinical_rad(self.pairs.name, self.pairs.reference_rad))

    @property
    def mean_deg(self) -> FloatArray:
        return np.asarray(0.5 * (self.carpus_deg + self.reference_deg))

    @property
    def point_rows(self) -> np.ndarray:
        """Rows (K,) whose difference is drawn: one each 0.2 s, or each reading."""
        if not self.is_time_series:
            return np.arange(len(self.pairs.time_s))
        return np.unique(np.floor(self.pairs.time_s / POINT_INTERVAL_S), return_index=True)[1]

    @property
    def x_values(self) -> FloatArray:
        """Horizontal coordinate (N,) of each pair: mean of both in degrees, seconds, or number of the reading."""
        if self.view == "differences":
            return self.mean_deg
        return self.pairs.time_s if self.is_time_series else np.arange(1.0, len(self.pairs.time_s) + 1.0)

    def extent(self) -> tuple[float, float]:
        low, high = float(self.x_values.min()), float(self.x_values.max())
        if self.view == "curves" and self.is_time_series:
            return low, max(high, low + 1.0)
        pad = max(0.06 * (high - low), 1.0)
        return low - pad, high + pad

    def scale(self) -> Scale:
        """Return the vertical scale: symmetric for differences, else around both curves."""
        if self.view == "differences":
            agreement = self.pairs.figures_deg
            values = [*(self.carpus_deg - self.reference_deg), *agreement.lower_interval, *agreement.upper_interval]
            maximum = max(
                (abs(value) for value in (*values, 1.5 * self.limit_deg) if math.isfinite(value)), default=5.0
            )
            reach = next((one for one in AXIS_LIMITS_DEG if maximum <= one), AXIS_LIMITS_DEG[-1])
            step = reach / 2
            ticks = tuple(step * k for k in (2, 1, 0, -1, -2))
            named = tuple((tick, f"{numbers.format_shortest(abs(tick))}°") for tick in ticks)
            return Scale(-1.04 * reach, 1.04 * reach, ticks, named, False)
        both = np.concatenate((self.carpus_deg, self.reference_deg))
        step = _tick_step(float(np.ptp(both)))
        low, high = step * math.floor(float(both.min()) / step), step * math.ceil(float(both.max()) / step)
        high = max(high, low + step)
        ticks = tuple(np.arange(low, high + step / 2, step).tolist())
        pad = 0.04 * (high - low)
        more, less = direction_names(self.pairs.name)
        labels = [(tick, f"{format_rounded(abs(tick))}°") for tick in ticks]
        for place, word in ((0, less), (-1, more)):
            if labels[place][0] * (1 if place else -1) > 0.0:
                labels[place] = (labels[place][0], f"{word} {labels[place][1]}")
        return Scale(low - pad, high + pad, ticks, tuple(labels), False)

    def panel(self, style: PlotStyle, box: QRectF) -> Panel:
        """Return the panel inside ``box`` that leaves room for the labels at its right."""
        metrics, unit = QFontMetricsF(style.end_label_font), style.unit
        right = max(metrics.horizontalAdvance(text) for texts in _line_labels(self) for text in texts) + 20 * unit
        scale = self.scale()
        left = max(metrics.horizontalAdvance(text) for _, text in scale.labels) + 16 * unit
        foot = 2 * metrics.height() + 14 * unit
        area = box.adjusted(left, metrics.height() * 0.5, -right, -foot)
        return Panel(area, scale, *self.extent())

    def x_labels(self, start: float, end: float) -> list[tuple[float, str]]:
        """Return round values along the panel; the outermost degrees name their direction."""
        if self.view == "curves" and self.is_time_series:
            return time_labels(start, end)
        step = _tick_step(end - start) if self.view == "differences" else max(1.0, _tick_step(end - start) // 5)
        ticks = step * np.arange(math.ceil(start / step), math.floor(end / step) + 1)
        if self.view == "curves":
            return [(float(tick), format_rounded(tick)) for tick in ticks]
        more, less = direction_names(self.pairs.name)
        labels = [(float(tick), f"{format_rounded(abs(tick))}°") for tick in ticks]
        for place, word in ((0, less), (-1, more)):
            if labels and labels[place][0] * (1 if place else -1) > 0.0:
                labels[place] = (labels[place][0], f"{word} {labels[place][1]}")
        return labels


def _line_labels(plot: AgreementPlot) -> list[tuple[str, ...]]:
    if plot.view == "curves":
        return [(tr("Carpus"),), (tr("Reference"),)]
    name, agreement = plot.pairs.name, plot.pairs.figures_deg
    pattern = tr("Limit {value}")
    out: list[tuple[str, ...]] = [
        (pattern.format(value=format_difference(value, name)), f"({format_interval(about, name)})")
        for value, about in zip(agreement.limits, (agreement.lower_interval, agreement.upper_interval), strict=True)
    ]
    mean = tr("Mean {value}").format(value=format_difference(agreement.bias, name))
    return [*out, (mean, f"({format_interval(agreement.bias_interval, name)})")]


def _direction_labels(name: str) -> tuple[str, str]:
    """Return ``Carpus shows more flexion`` and the opposite."""
    more, less = direction_names(name)
    words = tr("Carpus shows {what}") if more == tr("more") else tr("Carpus shows more {what}")
    return words.format(what=more), words.format(what=less)


def _limit_label() -> str:
    return tr("hatched: within the limit you set")


def _axis_caption(plot: AgreementPlot) -> str:
    if plot.view == "curves":
        return tr("seconds after the first frame") if plot.is_time_series else tr("reading number")
    if plot.is_time_series:
        return tr("mean of Carpus and reference · one point every 0.2 s, {count} points").format(
            count=len(plot.point_rows)
        )
    return tr("mean of Carpus and reference · one point per reading, {count} readings").format(
        count=len(plot.point_rows)
    )


def _tick_step(span: float) -> float:
    return next((step for step in TICK_STEPS_DEG if span / step <= 7.0), TICK_STEPS_DEG[-1])


class AgreementChart(Chart):
    """Chart of one angle, over time or as differences against the mean."""

    is_card = False

    def __init__(self, theme: Theme, plot: AgreementPlot) -> None:
        super().__init__(theme)
        self._plot = plot

    def build(self) -> None:
        shown, look = self._plot, self.plot_style
        plot = self.add_plot(shown.panel(look, self.area))
        differences = shown.view == "differences"
        if differences and shown.limit_deg > 0.0:
            self._add_limit(plot)
        plot.add_grid()
        self.add_axis(plot, "left", scale_labels(plot.panel), 12)
        self.add_axis(plot, "bottom", lambda *ends: [AxisLabel(*one) for one in shown.x_labels(*ends)][::-1], 6)
        foot = self.add_text(_axis_caption(shown), look.label_font, "text2", (0.5, 0.0))
        box = plot.panel.box
        foot.setPos(box.center().x(), box.bottom() + QFontMetricsF(look.label_font).height() + 8 * look.unit)
        (self._add_differences if differences else self._add_curves)(plot)

    def _add_limit(self, plot: Plot) -> None:
        limit, box = self._plot.limit_deg, plot.panel.box
        plot.add_to_layer(Hatching(plot, [(-math.inf, math.inf, -limit, limit)], "accent", 90), BAND)
        words = self.add_text(_limit_label(), self.plot_style.label_font, "accent", (1.0, 0.0))
        words.setPos(box.right() - 6 * self.plot_style.unit, float(plot.panel.y(-limit)) + 2 * self.plot_style.unit)

    def _add_dots(self, plot: Plot, x: FloatArray, y: FloatArray, token: str, radius: float) -> None:
        at = [
            plot.panel.point(one, value)
            for one, value in zip(x.tolist(), y.tolist(), strict=True)
            if math.isfinite(value)
        ]
        self.add_symbols("o", 2.0 * radius, pg.mkPen(None), token, at, DOT_ALPHA)

    def _add_differences(self, plot: Plot) -> None:
        shown, agreement = self._plot, self._plot.pairs.figures_deg
        token, unit, rows = angle_token(shown.pairs.name), self.plot_style.unit, shown.point_rows
        differences = (shown.carpus_deg - shown.reference_deg)[rows]
        self._add_dots(plot, shown.mean_deg[rows], differences, token, 3.0 if shown.is_time_series else 4.5)
        for value in agreement.limits:
            plot.add_horizontal_line(value, "text", (7.0, 5.0))
        plot.add_horizontal_line(agreement.bias, token, ())
        reach = max(plot.panel.scale.ticks)
        for value, words in zip((0.85 * reach, -reach), _direction_labels(shown.pairs.name), strict=True):
            plot.add_label(value, words, small=True)
        height, occupied = 2 * QFontMetricsF(self.plot_style.end_label_font).height(), -math.inf
        box, at = plot.panel.box, [*agreement.limits, agreement.bias]
        lines = sorted(zip(at, _line_labels(shown), (False, False, True), strict=True), key=lambda row: -row[0])
        room = box.bottom() + 0.5 * height - len(lines) * (height + 2 * unit)
        for value, (first, second), is_mean in lines:
            if not math.isfinite(value):
                continue
            top = min(max(float(plot.panel.y(value)) - height / 2, occupied), max(room, box.top()))
            room += height + 2 * unit
            occupied = top + height + 2 * unit
            left = box.right() + 12 * unit
            self.add_text(first, self.plot_style.end_label_font, token if is_mean else "text").setPos(left, top)
            self.add_text(second, self.plot_style.label_font, "text2").setPos(left, top + height / 2)

    def _add_curves(self, plot: Plot) -> None:
        shown, token = self._plot, angle_token(self._plot.pairs.name)
        along = shown.x_values
        other = "rotation" if token != "rotation" and shown.is_time_series else "border"
        if shown.is_time_series:
            step_s = 3.0 * float(np.median(np.diff(along))) if len(along) > 1 else 1.0
            both = ((shown.reference_deg, other, True), (shown.carpus_deg, token, False))
            plot.add_curves().set_curves([
                Curve(Series(along, values, None, np.full(len(values), dashed), step_s), own)
                for values, own, dashed in both
            ])  # fmt: skip
        else:
            self._add_dots(plot, along, shown.reference_deg, "border", 5.0)
            self._add_dots(plot, along, shown.carpus_deg, token, 4.5)
        left, height = (
            plot.panel.box.right() + 12 * self.plot_style.unit,
            QFontMetricsF(self.plot_style.end_label_font).height(),
        )
        for number, ((words,), color) in enumerate(zip(_line_labels(shown), (token, other), strict=True)):
            item = self.add_text(words, self.plot_style.end_label_font, "text2" if color == "border" else color)
            item.setPos(left, plot.panel.box.top() + 1.4 * number * height)

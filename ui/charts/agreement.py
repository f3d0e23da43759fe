"""Charts of agreement: differences against their mean (Bland and Altman), and both curves over time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pyqtgraph as pg
from PySide6.QtGui import QFontMetricsF

from carpus.core.model.hand.forearm_rotation import to_clinical_rad
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.ui.charts.chart import BAND, AxisLabel, Chart, Hatching, Plot
from carpus.ui.charts.panel import Panel, Scale, time_labels
from carpus.ui.charts.series import Curve, Series
from carpus.ui.kit import numbers
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words.agreement import (
    angle_token,
    direction_names,
    format_difference,
    format_interval,
)

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.research.agreement.compare import AnglePairs

# One difference is drawn each 0.2 s; the statistics are of all samples.
POINT_INTERVAL_S = 0.2
AXIS_LIMITS_DEG = (5.0, 10.0, 20.0, 40.0, 90.0, 180.0)
TICK_STEPS_DEG = (5.0, 10.0, 15.0, 30.0, 60.0, 90.0)
DOT_ALPHA = 140


def _tick_step(span: float) -> float:
    return next((step for step in TICK_STEPS_DEG if span / step <= 7.0), TICK_STEPS_DEG[-1])


def _angle_labels(name: str, ticks: np.ndarray) -> list[tuple[float, str]]:
    """Return the labels of an angle's ticks; the outermost ones name their direction."""
    more, less = direction_names(name)
    labels = [(tick, f"{format_rounded(abs(tick))}°") for tick in ticks.tolist()]
    for place, word in ((0, less), (-1, more)):
        if labels and labels[place][0] * (1 if place else -1) > 0.0:
            labels[place] = (labels[place][0], f"{word} {labels[place][1]}")
    return labels


class AgreementChart(Chart):
    """Chart of one angle measured by Carpus and by a reference, a recording or a list of single readings."""

    is_card = False

    def __init__(self, theme: Theme, pairs: AnglePairs, *, is_time_series: bool) -> None:
        super().__init__(theme)
        self.pairs, self.is_time_series, self.token = pairs, is_time_series, angle_token(pairs.name)
        self.carpus_deg, self.reference_deg = (
            np.degrees(to_clinical_rad(pairs.name, rad)) for rad in (pairs.measured_rad, pairs.reference_rad)
        )

    # --- for a subclass -----------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float]:
        """Return the ends of the horizontal axis."""
        raise NotImplementedError

    def scale(self) -> Scale:
        raise NotImplementedError

    def x_labels(self, start: float, end: float) -> list[tuple[float, str]]:
        """Return round values along the panel."""
        raise NotImplementedError

    def caption(self) -> str:
        raise NotImplementedError

    def end_labels(self) -> list[tuple[str, ...]]:
        """Return the lines of each label at the right of the panel."""
        raise NotImplementedError

    def add_values(self, plot: Plot) -> None:
        raise NotImplementedError

    # --- what is in it ------------------------------------------------------------------------------------
    def build(self) -> None:
        look, scale, metrics = self.plot_style, self.scale(), QFontMetricsF(self.plot_style.end_label_font)
        unit, height = look.unit, metrics.height()
        right = max(metrics.horizontalAdvance(text) for texts in self.end_labels() for text in texts) + 20 * unit
        left = max(metrics.horizontalAdvance(text) for _, text in scale.labels) + 16 * unit
        box = self.area.adjusted(left, 0.5 * height, -right, -2 * height - 14 * unit)
        plot = self.add_plot(Panel(box, scale, *self.extent()))
        plot.add_grid()
        self.add_axis(plot, "bottom", lambda *ends: [AxisLabel(*one) for one in self.x_labels(*ends)][::-1], 6)
        foot = self.add_text(self.caption(), look.label_font, "text2", (0.5, 0.0))
        foot.setPos(box.center().x(), box.bottom() + QFontMetricsF(look.label_font).height() + 8 * unit)
        self.add_values(plot)

    def add_dots(self, plot: Plot, x: FloatArray, y: FloatArray, token: str, radius: float) -> None:
        at = [
            plot.panel.point(one, value)
            for one, value in zip(x.tolist(), y.tolist(), strict=True)
            if math.isfinite(value)
        ]
        self.add_symbols("o", 2.0 * radius, pg.mkPen(None), token, at, DOT_ALPHA)


class DifferenceChart(AgreementChart):
    """Differences against the mean of both, with the limits of agreement.

    ``limit_deg`` is the acceptance limit set beforehand, 0 for none.
    """

    def __init__(self, theme: Theme, pairs: AnglePairs, *, is_time_series: bool, limit_deg: float) -> None:
        super().__init__(theme, pairs, is_time_series=is_time_series)
        self.limit_deg, self.mean_deg = limit_deg, np.asarray(0.5 * (self.carpus_deg + self.reference_deg))

    @property
    def point_rows(self) -> np.ndarray:
        """Rows (K,) whose difference is drawn: one each 0.2 s, or each reading."""
        if not self.is_time_series:
            return np.arange(len(self.pairs.time_s))
        return np.unique(np.floor(self.pairs.time_s / POINT_INTERVAL_S), return_index=True)[1]

    def extent(self) -> tuple[float, float]:
        low, high = float(self.mean_deg.min()), float(self.mean_deg.max())
        pad = max(0.06 * (high - low), 1.0)
        return low - pad, high + pad

    def scale(self) -> Scale:
        agreement = self.pairs.figures_deg
        values = [*(self.carpus_deg - self.reference_deg), *agreement.lower_interval, *agreement.upper_interval]
        maximum = max((abs(value) for value in (*values, 1.5 * self.limit_deg) if math.isfinite(value)), default=5.0)
        reach = next((one for one in AXIS_LIMITS_DEG if maximum <= one), AXIS_LIMITS_DEG[-1])
        ticks = tuple(0.5 * reach * k for k in (2, 1, 0, -1, -2))
        named = tuple((tick, f"{numbers.format_shortest(abs(tick))}°") for tick in ticks)
        return Scale(-1.04 * reach, 1.04 * reach, ticks, named, False)

    def x_labels(self, start: float, end: float) -> list[tuple[float, str]]:
        step = _tick_step(end - start)
        return _angle_labels(self.pairs.name, step * np.arange(math.ceil(start / step), math.floor(end / step) + 1))

    def caption(self) -> str:
        words = tr("mean of Carpus and reference · one point per reading, {count} readings")
        if self.is_time_series:
            words = tr("mean of Carpus and reference · one point every 0.2 s, {count} points")
        return words.format(count=len(self.point_rows))

    def end_labels(self) -> list[tuple[str, ...]]:
        name, agreement = self.pairs.name, self.pairs.figures_deg
        return [
            (pattern.format(value=format_difference(value, name)), f"({format_interval(about, name)})")
            for pattern, value, about in (
                (tr("Limit {value}"), agreement.limits[0], agreement.lower_interval),
                (tr("Limit {value}"), agreement.limits[1], agreement.upper_interval),
                (tr("Mean {value}"), agreement.bias, agreement.bias_interval),
            )
        ]

    def add_values(self, plot: Plot) -> None:
        agreement, look, box, rows = self.pairs.figures_deg, self.plot_style, plot.panel.box, self.point_rows
        unit = look.unit
        if self.limit_deg > 0.0:
            hatching = Hatching(plot, [(-math.inf, math.inf, -self.limit_deg, self.limit_deg)], "accent", 90)
            plot.add_to_layer(hatching, BAND)
            words = self.add_text(tr("hatched: within the limit you set"), look.label_font, "accent", (1.0, 0.0))
            words.setPos(box.right() - 6 * unit, float(plot.panel.y(-self.limit_deg)) + 2 * unit)
        differences = (self.carpus_deg - self.reference_deg)[rows]
        self.add_dots(plot, self.mean_deg[rows], differences, self.token, 3.0 if self.is_time_series else 4.5)
        for value in agreement.limits:
            plot.add_horizontal_line(value, "text", (7.0, 5.0))
        plot.add_horizontal_line(agreement.bias, self.token, ())
        more, less = direction_names(self.pairs.name)
        pattern = tr("Carpus shows {what}") if more == tr("more") else tr("Carpus shows more {what}")
        reach = max(plot.panel.scale.ticks)
        plot.add_label(0.85 * reach, pattern.format(what=more), small=True)
        plot.add_label(-reach, pattern.format(what=less), small=True)
        height, occupied = 2 * QFontMetricsF(look.end_label_font).height(), -math.inf
        tokens, values = ("text", "text", self.token), (*agreement.limits, agreement.bias)
        lines = sorted(zip(values, self.end_labels(), tokens, strict=True), key=lambda row: -row[0])
        room = box.bottom() + 0.5 * height - len(lines) * (height + 2 * unit)
        for value, (first, second), token in lines:
            if not math.isfinite(value):
                continue
            top = min(max(float(plot.panel.y(value)) - height / 2, occupied), max(room, box.top()))
            room += height + 2 * unit
            occupied = top + height + 2 * unit
            self.add_text(first, look.end_label_font, token).setPos(box.right() + 12 * unit, top)
            self.add_text(second, look.label_font, "text2").setPos(box.right() + 12 * unit, top + height / 2)


class CurveChart(AgreementChart):
    """Both curves over time, or both values of each reading."""

    @property
    def x_values(self) -> FloatArray:
        """Seconds (N,), or numbers of the readings."""
        return self.pairs.time_s if self.is_time_series else np.arange(1.0, len(self.pairs.time_s) + 1.0)

    def extent(self) -> tuple[float, float]:
        low, high = float(self.x_values.min()), float(self.x_values.max())
        if self.is_time_series:
            return low, max(high, low + 1.0)
        pad = max(0.06 * (high - low), 1.0)
        return low - pad, high + pad

    def scale(self) -> Scale:
        both = np.concatenate((self.carpus_deg, self.reference_deg))
        step = _tick_step(float(np.ptp(both)))
        low, high = step * math.floor(float(both.min()) / step), step * math.ceil(float(both.max()) / step)
        high = max(high, low + step)
        ticks, pad = np.arange(low, high + step / 2, step), 0.04 * (high - low)
        return Scale(low - pad, high + pad, tuple(ticks.tolist()), tuple(_angle_labels(self.pairs.name, ticks)), False)

    def x_labels(self, start: float, end: float) -> list[tuple[float, str]]:
        if self.is_time_series:
            return time_labels(start, end)
        step = max(1.0, _tick_step(end - start) // 5)
        ticks = step * np.arange(math.ceil(start / step), math.floor(end / step) + 1)
        return [(tick, format_rounded(tick)) for tick in ticks.tolist()]

    def caption(self) -> str:
        return tr("seconds after the first frame") if self.is_time_series else tr("reading number")

    def end_labels(self) -> list[tuple[str, ...]]:
        return [(tr("Carpus"),), (tr("Reference"),)]

    def add_values(self, plot: Plot) -> None:
        look, along = self.plot_style, self.x_values
        other = "rotation" if self.token != "rotation" and self.is_time_series else "border"
        if self.is_time_series:
            step_s = 3.0 * float(np.median(np.diff(along))) if len(along) > 1 else 1.0
            both = ((self.reference_deg, other, True), (self.carpus_deg, self.token, False))
            plot.add_curves().set_curves([
                Curve(Series(along, values, None, np.full(len(values), dashed), step_s), own)
                for values, own, dashed in both
            ])  # fmt: skip
        else:
            self.add_dots(plot, along, self.reference_deg, "border", 5.0)
            self.add_dots(plot, along, self.carpus_deg, self.token, 4.5)
        height = QFontMetricsF(look.end_label_font).height()
        for number, ((words,), token) in enumerate(zip(self.end_labels(), (self.token, other), strict=True)):
            item = self.add_text(words, look.end_label_font, "text2" if token == "border" else token)
            item.setPos(plot.panel.box.right() + 12 * look.unit, plot.panel.box.top() + 1.4 * number * height)

"""Mean repetitions of two sessions over each other, drawn by any painter: first solid with its band, second dashed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from carpus.core.hand.exercises import AXIS_LIMIT_DEG, AXIS_TICK_DEG, SIDES
from carpus.core.results.motion_curves import MeanRepetition, Quantity
from carpus.core.types import FloatArray
from carpus.ui import numbers, terms
from carpus.ui.figures import figure_of, with_side
from carpus.ui.plot.axes import Panel, Scale, angle_scale, hatch
from carpus.ui.plot.marks import EndLabels, Scales, Times, paint_dot
from carpus.ui.plot.polygon import runs
from carpus.ui.plot.series import Curve, Series, paint_curves
from carpus.ui.plot.style import PlotStyle, write
from carpus.ui.translate import tr

STEPS_DEG = (5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 90.0)
MOST_TICKS = 5
TOKENS = ("curve_a", "text2")
"""Of the first and the second session."""


@dataclass(frozen=True, slots=True)
class BesidePlot:
    """One angle of both sessions; ``names`` as they stand at the ends of the curves, ``shares`` where the player is in
    the repetition of each, NaN between repetitions."""

    quantity: Quantity
    first: MeanRepetition
    second: MeanRepetition
    names: tuple[str, str]
    shares: tuple[float, float] = (math.nan, math.nan)

    @property
    def sign(self) -> float:
        """From the angle in every file to the one that is spoken of."""
        return figure_of(self.quantity[0]).sign if self.quantity[0] else 1.0

    def scale(self) -> Scale:
        """Of the wrist the usual one; of a joint what both reach."""
        joint, angle = self.quantity
        values = np.concatenate([self.sign * one.mean_deg for one in (self.first, self.second)])
        known = values[np.isfinite(values)]
        if not joint:
            more, less = (terms.movement_name(side) for side in SIDES[angle])
            return angle_scale(AXIS_TICK_DEG[angle], AXIS_LIMIT_DEG[angle], more, less)
        low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 90.0)
        low, high = min(low, 0.0), max(high, 10.0)
        step = next((one for one in STEPS_DEG if (high - low) / one <= MOST_TICKS - 1), STEPS_DEG[-1])
        ticks = step * np.arange(math.floor(low / step + 1e-6), math.ceil(high / step - 1e-6) + 1)[::-1]
        figure = figure_of(joint)
        write = (lambda value: with_side(value, figure.finger)) if figure.row == "spread" else numbers.signed_degrees
        pad = 0.05 * float(ticks[0] - ticks[-1])
        labels = tuple((float(tick), write(float(tick))) for tick in ticks)
        return Scale(float(ticks[-1]) - pad, float(ticks[0]) + pad, tuple(ticks.tolist()), labels, strong_ends=False)

    def panel(self, style: PlotStyle, box: QRectF) -> Panel:
        regular, medium = QFontMetricsF(style.label), QFontMetricsF(style.end_label)
        scale = self.scale()
        left = max(medium.horizontalAdvance(text) for _, text in scale.labels) + 14 * style.unit
        right = max(medium.horizontalAdvance(name) for name in self.names) + 14 * style.unit
        last = regular.horizontalAdvance(_ends()[2]) / 2
        foot, head = regular.height() + 8 * style.unit, regular.height() / 2
        return Panel(box.adjusted(left, head, -max(right, last), -foot), scale, 0.0, 1.0)

    def paint(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        panel = self.panel(style, box)
        Scales().paint(painter, style, panel)
        start, half, end = _ends()
        Times(((0.0, start), (0.5, half), (1.0, end))).paint(painter, style, panel)
        if not (self.first.known or self.second.known):
            middle = Qt.AlignmentFlag.AlignCenter
            write(painter, panel.box, _nothing(), style.label, style.color("text2"), middle)
            return
        painter.save()
        painter.setClipRect(panel.box.adjusted(-1, -2, 1, 2), Qt.ClipOperation.IntersectClip)
        self._paint_unseen(painter, style, panel)
        # A gap of one is no gap of the other: it stays open, not hatched.
        means = ((self.second, TOKENS[1], False), (self.first, TOKENS[0], True))
        paint_curves(
            painter, style, panel,
            [Curve(self._series(mean, with_band=band), token, hatched=False) for mean, token, band in means],
        )  # fmt: skip
        painter.restore()
        self._paint_names(painter, style, panel)
        self._paint_places(painter, style, panel)

    def _paint_unseen(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        neither = np.isnan(self.first.mean_deg) & np.isnan(self.second.mean_deg)
        for start, stop in runs(neither):
            left, right = (
                float(panel.x(self.first.share[k])) for k in (max(start - 1, 0), min(stop, len(neither) - 1))
            )
            hatch(painter, style, QRectF(left, panel.box.top(), right - left, panel.box.height()))

    def _series(self, mean: MeanRepetition, *, with_band: bool) -> Series:
        sd = mean.sd_deg if with_band else None
        dashed = np.full(len(mean.share), not with_band)
        step = 1.5 / max(len(mean.share) - 1, 1)
        return Series(mean.share, self.sign * mean.mean_deg, sd, dashed, step)

    def _paint_names(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        """At the ends of the curves, one below the other where they meet."""
        labels = []
        for mean, name, token in zip((self.first, self.second), self.names, TOKENS, strict=True):
            known = self.sign * mean.mean_deg[np.isfinite(mean.mean_deg)]
            if len(known):
                labels.append((float(known[-1]), name, token))
        EndLabels(labels).paint(painter, style, panel)

    def _paint_places(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        if math.isfinite(self.shares[0]):
            x = float(panel.x(self.shares[0]))
            painter.setPen(QPen(style.color("text"), 1.5 * style.grid_width))
            painter.drawLine(QPointF(x, panel.box.top()), QPointF(x, panel.box.bottom()))
        for mean, share, token in zip((self.second, self.first), self.shares[::-1], TOKENS[::-1], strict=True):
            value = self.sign * float(_value_at(mean, share))
            if math.isfinite(value):
                paint_dot(painter, style, panel.at(share, value), token, 5.5)

    def rows(self) -> list[tuple[float, float, float, int, float, float, int]]:
        """Share of the repetition, then mean, sd and how many were seen of each session, as in every file."""
        one, two = self.first, self.second
        return [
            (float(one.share[k]), float(one.mean_deg[k]), float(one.sd_deg[k]), int(one.seen[k]),
             float(two.mean_deg[k]), float(two.sd_deg[k]), int(two.seen[k]))
            for k in range(len(one.share))
        ]  # fmt: skip


def _value_at(mean: MeanRepetition, share: float) -> float:
    if not math.isfinite(share):
        return math.nan
    values: FloatArray = mean.mean_deg
    at = share * (len(values) - 1)
    low, high = math.floor(at), math.ceil(at)
    return float(values[low] + (at - low) * (values[high] - values[low])) if high > low else float(values[low])


def _nothing() -> str:
    return tr("No repetition was seen well enough.")


def _ends() -> tuple[str, str, str]:
    return tr("start"), tr("half"), tr("end")

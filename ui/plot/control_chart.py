"""A control chart: what each check of a camera found, the fixed limit, and what is usual with its calibration."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen, QPolygonF

from carpus.core.calibration.card.chart import CardCheck, Verdict, usual_of, verdict_of
from carpus.ui import numbers
from carpus.ui.icons import octagon
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.marks import EndLabels, Level, Times, paint_dot
from carpus.ui.plot.style import PlotStyle, dashed, write
from carpus.ui.translate import tr

MOST_SHOWN = 24
_ROOM = 1.5
"""The scale reaches this many times the limit, or further where a check does."""


@dataclass(frozen=True, slots=True)
class ControlPlot:
    """One followed figure of the last checks, oldest first; ``cut`` (C,) where another calibration begins; ``usual``
    highest usual value of the newest calibration, NaN while nobody knows, from check ``usual_from`` on."""

    title: str
    unit: str
    limit: float
    value: np.ndarray
    verdict: Sequence[Verdict]
    when: Sequence[datetime]
    cut: np.ndarray
    usual: float
    usual_from: int

    def scale(self) -> Scale:
        top = max(_ROOM * self.limit, 1.1 * float(self.value.max(initial=0.0)))
        step = next(step for step in (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 1e9) if top / step <= 5.0)
        ticks = tuple(float(one) for one in np.arange(0.0, top + 1e-9, step))
        return Scale(
            0.0, top, ticks, tuple((one, f"{numbers.figures(one, 6)}{self.unit}") for one in ticks), strong_ends=False
        )

    def panel(self, box: QRectF) -> Panel:
        return Panel(box, self.scale(), -0.5, max(len(self.value) - 0.5, 0.5))


def control_plots(checks: Sequence[CardCheck]) -> list[ControlPlot]:
    """Angles and lengths of the last checks; none where there was no check."""
    if not checks:
        return []
    first = max(len(checks) - MOST_SHOWN, 0)
    shown = checks[first:]
    usual = usual_of(checks[:-1], shown[-1].calibrated)
    since = next(k for k, one in enumerate(shown) if one.calibrated == shown[-1].calibrated)
    cut = np.array([k > 0 and one.calibrated != shown[k - 1].calibrated for k, one in enumerate(shown)])
    when = [datetime.fromisoformat(one.when) for one in shown]
    kinds = (
        (tr("Angles: largest error of three"), "°", shown[-1].most_angle_deg),
        (tr("Lengths: largest error of three"), f"{numbers.NARROW_GAP}mm", shown[-1].most_length_mm),
    )
    return [
        ControlPlot(
            title, unit, limit, np.array([one.values[k] for one in shown]),
            [_verdict(checks[: first + number], one, k) for number, one in enumerate(shown)], when, cut,
            float(usual.band[k, 1]) if usual is not None else math.nan, since,
        )
        for k, (title, unit, limit) in enumerate(kinds)
    ]  # fmt: skip


def _verdict(earlier: Sequence[CardCheck], check: CardCheck, kind: int) -> Verdict:
    """What is said of one figure of a check; a drift, which shows on none by itself, is said of both."""
    if not (check.angles_hold, check.lengths_hold)[kind]:
        return "out"
    whole, usual = verdict_of(earlier, check), usual_of(earlier, check.calibrated)
    if usual is None or whole == "right":
        return "right"
    beyond = [check.values[one] > usual.band[one, 1] for one in (0, 1)]
    return "unusual" if beyond[kind] or (whole == "unusual" and not any(beyond)) else "right"


def paint_control_ground(painter: QPainter, style: PlotStyle, plot: ControlPlot, panel: Panel) -> None:
    """What stays: the usual band, the limit, days, and the words at the right."""
    box, unit = panel.box, style.unit
    if math.isfinite(plot.usual):
        left = float(panel.x(plot.usual_from - 0.5))
        top = float(panel.y(plot.usual))
        painter.fillRect(QRectF(left, top, box.right() - left, box.bottom() - top), style.color("norm"))
    Level(plot.limit, "bad", (6.0, 4.0)).paint(painter, style, panel)
    last = float(plot.value[-1])
    token = {"right": "text", "unusual": "warn", "out": "bad"}[plot.verdict[-1]] if last > plot.limit else "text"
    said = [
        (plot.limit, tr("Limit {value}"), "bad"), (last, tr("newest {value}"), token),
        (plot.usual, tr("usual, up to {value}"), "text2"),
    ]  # fmt: skip
    EndLabels(
        [
            (value, words.format(value=f"{numbers.fixed(value, 1)}{plot.unit}"), token)
            for value, words, token in said
            if math.isfinite(value)
        ]
    ).paint(painter, style, panel)
    Times([(float(k), numbers.day_month(when)) for k, when in enumerate(plot.when)], 4.0, days=True).paint(
        painter, style, panel
    )
    for k in np.flatnonzero(plot.cut).tolist():
        x = float(panel.x(k - 0.5))
        painter.setPen(dashed(style.color("text2"), style.grid_width, (3, 3)))
        painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()))
        at = QPointF(x + 4 * unit, box.top() + QFontMetricsF(style.label).ascent())
        write(painter, at, tr("calibrated"), style.label, style.color("text2"))


@dataclass(frozen=True, slots=True)
class ControlMarks:
    """The checks, joined within a calibration: disc usual, triangle unusual, octagon out."""

    plot: ControlPlot

    def paint(self, painter: QPainter, style: PlotStyle, panel: Panel) -> None:
        plot = self.plot
        at = [panel.at(k, value) for k, value in enumerate(plot.value.tolist())]
        painter.setPen(QPen(style.color("text"), style.line_width))
        for k in range(1, len(at)):
            if not plot.cut[k]:
                painter.drawLine(at[k - 1], at[k])
        for place, verdict in zip(at, plot.verdict, strict=True):
            painter.setPen(QPen(style.color("surface"), 1.5 * style.unit))
            if verdict == "right":
                paint_dot(painter, style, place, "text", 4.5)
            elif verdict == "unusual":
                painter.setBrush(style.color("warn"))
                size = 7.0 * style.unit
                corners = [QPointF(0, -size), QPointF(size, 0.8 * size), QPointF(-size, 0.8 * size)]
                painter.drawPolygon(QPolygonF([place + corner for corner in corners]))
            else:
                painter.setBrush(style.color("bad"))
                painter.drawPolygon(octagon(place, 7.5 * style.unit))
        painter.setBrush(Qt.BrushStyle.NoBrush)

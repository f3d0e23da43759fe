"""One panel with a fixed scale: ticks are positive, the ends carry the words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QFontMetricsF, QPainter, QPen

from core.types import FloatArray
from ui.plot.style import PlotStyle


@dataclass(frozen=True, slots=True)
class Scale:
    """Values from ``low`` to ``high``; ``ticks`` get a line, ``labels`` (value, text) their text on the left."""

    low: float
    high: float
    ticks: tuple[float, ...]
    labels: tuple[tuple[float, str], ...]
    strong_ends: bool = True


def angle_scale(tick_deg: float, limit_deg: float, upper: str, lower: str, *, tight: bool = False) -> Scale:
    """An angle in degrees between two named directions; ``tight`` leaves out the ticks half-way."""
    half = tick_deg / 2
    inner = () if tight else (half, -half)
    labels = [(tick_deg, f"{upper} {tick_deg:.0f}°"), (0.0, "0°"), (-tick_deg, f"{lower} {tick_deg:.0f}°")]
    labels += [(value, f"{abs(value):.0f}°") for value in inner]
    return Scale(-limit_deg, limit_deg, (tick_deg, *inner[:1], 0.0, *inner[1:], -tick_deg), tuple(labels))


def rising_scale(top: float, step: float, unit: str, name: str) -> Scale:
    """A quantity that starts at zero, with its name at the upper end."""
    ticks = tuple(np.arange(0.0, top + step / 2, step).tolist())
    labels = tuple((value, f"{name} {value:.0f}{unit}" if value == ticks[-1] else f"{value:.0f}") for value in ticks)
    return Scale(-0.04 * top, 1.08 * top, ticks, labels)


@dataclass(frozen=True, slots=True)
class Panel:
    """A scale in a rectangle, with time from ``start_s`` on the left to ``end_s`` on the right."""

    box: QRectF
    scale: Scale
    start_s: float
    end_s: float

    def x(self, time_s: FloatArray | float) -> FloatArray:
        """Painter x of times."""
        share = (np.asarray(time_s, dtype=np.float64) - self.start_s) / (self.end_s - self.start_s)
        return self.box.left() + share * self.box.width()

    def y(self, value: FloatArray | float) -> FloatArray:
        """Painter y of values, kept inside the panel."""
        clipped = np.clip(np.asarray(value, dtype=np.float64), self.scale.low, self.scale.high)
        share = (self.scale.high - clipped) / (self.scale.high - self.scale.low)
        return self.box.top() + share * self.box.height()


def paint_scale(painter: QPainter, style: PlotStyle, panel: Panel) -> None:
    """Grid lines, zero line, and the labels left of the panel."""
    end_values = {max(panel.scale.ticks), min(panel.scale.ticks)}
    for value in panel.scale.ticks:
        y = float(panel.y(value))
        y = round(y) + 0.5 if style.unit == 1.0 else y
        painter.setPen(QPen(style.color("border" if value == 0.0 else "line"), style.grid_width))
        painter.drawLine(QPointF(panel.box.left(), y), QPointF(panel.box.right(), y))
    height = QFontMetricsF(style.label).height()
    for value, text in panel.scale.labels:
        strong = panel.scale.strong_ends and value in end_values and value != 0.0
        painter.setFont(style.end_label if strong else style.label)
        painter.setPen(style.color("text" if strong else "text2"))
        right = panel.box.left() - 12 * style.unit
        box = QRectF(right - 300 * style.unit, float(panel.y(value)) - height / 2, 300 * style.unit, height)
        painter.drawText(box, int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter), text)


def paint_times(
    painter: QPainter, style: PlotStyle, panel: Panel, top: float, labels: Sequence[tuple[float, str]]
) -> None:
    """Time labels under the panels, the last ones first; a label that would touch another is left out."""
    painter.setFont(style.label)
    painter.setPen(style.color("text2"))
    metrics = QFontMetricsF(style.label)
    taken: list[tuple[float, float]] = []
    for time_s, text in reversed(labels):
        width = metrics.horizontalAdvance(text)
        left = float(panel.x(time_s)) - width / 2
        if all(left > right + 6 * style.unit or left + width < other - 6 * style.unit for other, right in taken):
            taken.append((left, left + width))
            painter.drawText(QPointF(left, top + metrics.ascent()), text)


def paint_stay_within(painter: QPainter, style: PlotStyle, panel: Panel, limit: float, text: str) -> None:
    """The band a trick movement should stay in, with its words above it."""
    top, bottom = float(panel.y(limit)), float(panel.y(-limit))
    painter.fillRect(QRectF(panel.box.left(), top, panel.box.width(), bottom - top), style.color("norm"))
    _note(painter, style, panel, top, text, "text2")


def paint_target(painter: QPainter, style: PlotStyle, panel: Panel, value: float, text: str) -> None:
    """The target as a dashed, labelled line in the accent."""
    y = float(panel.y(value))
    pen = QPen(style.color("accent"), 1.5 * style.grid_width)
    pen.setDashPattern([6, 4])
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(pen)
    painter.drawLine(QPointF(panel.box.left(), y), QPointF(panel.box.right(), y))
    if text:
        height = QFontMetricsF(style.end_label).height()
        _note(painter, style, panel, y if value >= 0 else y + height + 4 * style.unit, text, "accent")


def _note(painter: QPainter, style: PlotStyle, panel: Panel, bottom: float, text: str, token: str) -> None:
    painter.setFont(style.end_label)
    painter.setPen(style.color(token))
    descent = QFontMetricsF(style.end_label).descent()
    painter.drawText(QPointF(panel.box.left() + 6 * style.unit, bottom - descent - 1 * style.unit), text)


def hatch(painter: QPainter, style: PlotStyle, box: QRectF, token: str = "border", alpha: int = 130) -> None:
    """Diagonal lines over a stretch that is not known; drawn as lines so that paper gets vectors too."""
    painter.save()
    painter.setClipRect(box, Qt.ClipOperation.IntersectClip)
    painter.setPen(QPen(style.color(token, alpha), style.grid_width))
    painter.setBrush(QBrush(Qt.BrushStyle.NoBrush))
    step = 5.0 * style.unit
    offset = box.height()
    start = np.floor((box.left() - offset) / step) * step
    for left in np.arange(start, box.right() + step, step):
        painter.drawLine(QPointF(left, box.bottom()), QPointF(left + offset, box.top()))
    painter.restore()

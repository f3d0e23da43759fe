"""Panels with a fixed scale, their tick labels, and hatching for missing data."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QPainter, QPen

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.ui.charts.style import PlotStyle
from carpus.ui.kit import numbers


@dataclass(frozen=True, slots=True)
class Scale:
    """Values from ``low`` to ``high``, the ``ticks`` with a grid line, and the ``labels`` (value, text) at the left."""

    low: float
    high: float
    ticks: tuple[float, ...]
    labels: tuple[tuple[float, str], ...]
    bold_ends: bool = True


def angle_scale(tick_deg: float, limit_deg: float, upper: str, lower: str, *, is_sparse: bool = False) -> Scale:
    """Return the scale of an angle between two named directions; ``is_sparse`` omits the ticks half-way."""
    half = tick_deg / 2
    inner = () if is_sparse else (half, -half)
    labels = [
        (tick_deg, f"{upper} {format_rounded(tick_deg)}°"),
        (0.0, "0°"),
        (-tick_deg, f"{lower} {format_rounded(tick_deg)}°"),
    ]
    labels += [(value, f"{format_rounded(abs(value))}°") for value in inner]
    return Scale(-limit_deg, limit_deg, (tick_deg, *inner[:1], 0.0, *inner[1:], -tick_deg), tuple(labels))


def positive_scale(top: float, step: float, unit: str) -> Scale:
    """Return the scale of a quantity that starts at zero, its unit at the upper end."""
    ticks = tuple(np.arange(0.0, top + step / 2, step).tolist())
    labels = tuple(
        (value, f"{format_rounded(value)}{unit}" if value == ticks[-1] else format_rounded(value)) for value in ticks
    )
    return Scale(-0.04 * top, 1.08 * top, ticks, labels)


@dataclass(frozen=True, slots=True)
class Panel:
    """Rectangle with a vertical scale and a time axis from ``start_s`` to ``end_s``."""

    box: QRectF
    scale: Scale
    start_s: float
    end_s: float

    def x(self, time_s: FloatArray | float) -> FloatArray:
        return x_px(np.asarray(time_s, dtype=np.float64), *self.x_parameters())

    def y(self, value: FloatArray | float) -> FloatArray:
        """Return painter y of values, clipped to the panel."""
        return y_px(np.asarray(value, dtype=np.float64), *self.y_parameters())

    def point(self, time_s: float, value: float) -> QPointF:
        return QPointF(float(self.x(time_s)), float(self.y(value)))

    def x_parameters(self) -> tuple[float, float, float, float]:
        """Return the arguments that :func:`x_px` needs after the times."""
        return self.box.left(), self.box.width(), self.start_s, self.end_s

    def y_parameters(self) -> tuple[float, float, float, float]:
        """Return the arguments that :func:`y_px` needs after the values."""
        return self.box.top(), self.box.height(), self.scale.low, self.scale.high


Bound = float | FloatArray


def x_px(time_s: FloatArray, left: Bound, width: Bound, start_s: Bound, end_s: Bound) -> FloatArray:
    """Return painter x of times in one panel, or each in a panel of its own."""
    return np.asarray(left + (time_s - start_s) / (end_s - start_s) * width)


def y_px(value: FloatArray, top: Bound, height: Bound, low: Bound, high: Bound) -> FloatArray:
    """Return painter y of values, clipped to one panel or each to a panel of its own."""
    return np.asarray(top + (high - np.minimum(np.maximum(value, low), high)) / (high - low) * height)


def time_labels(start_s: float, end_s: float) -> list[tuple[float, str]]:
    """Return about six round times along the axis."""
    span_s = end_s - start_s
    step = next((step for step in (0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600) if span_s / step <= 7), 1200)
    ticks = step * np.arange(math.ceil(start_s / step - 1e-6), math.floor(end_s / step + 1e-6) + 1)
    word = (lambda t: f"{numbers.format_shortest(t)} s") if end_s <= 180 else numbers.format_clock
    return [(t, word(t)) for t in ticks.tolist()]


def align_to_pixels(box: QRectF) -> QRectF:
    """Round a rectangle so that its edges lie between pixels."""
    return QRectF(box.toRect())


def draw_hatching(
    painter: QPainter, style: PlotStyle, box: QRectF, token: str = "border", alpha: int = 130, phase: float = 0.0
) -> None:
    """Draw diagonal lines over a stretch without data.

    They are lines and not a brush, so that paper gets vectors. ``phase`` shifts them by a share of their distance, so
    that overlapping areas stay distinct.
    """
    painter.setPen(QPen(style.color(token, alpha), style.grid_width))
    step, high = 5.0 * style.unit, box.height()
    first = (math.floor((box.left() - high) / step) + phase) * step
    lines = []
    for left in np.arange(first, box.right(), step).tolist():  # cut here: a drawing of lines forgets what is cut
        start, end = max(left, box.left()), min(left + high, box.right())
        if end > start:
            lines.append(QLineF(start, box.bottom() - (start - left), end, box.bottom() - (end - left)))
    painter.drawLines(lines)

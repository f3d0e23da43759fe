"""One panel with a fixed scale: ticks are positive, the ends carry the words. And the hatching of what is not known."""

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
    """Values from ``low`` to ``high``; ``ticks`` get a line, ``labels`` (value, text) their text on the left."""

    low: float
    high: float
    ticks: tuple[float, ...]
    labels: tuple[tuple[float, str], ...]
    bold_ends: bool = True


def angle_scale(tick_deg: float, limit_deg: float, upper: str, lower: str, *, is_sparse: bool = False) -> Scale:
    """An angle in degrees between two named directions; ``is_sparse`` leaves out the ticks half-way."""
    half = tick_deg / 2
    inner = () if is_sparse else (half, -half)
    labels = [
        (tick_deg, f"{upper} {format_rounded(tick_deg)}°"),
        (0.0, "0°"),
        (-tick_deg, f"{lower} {format_rounded(tick_deg)}°"),
    ]
    labels += [(value, f"{format_rounded(abs(value))}°") for value in inner]
    return Scale(-limit_deg, limit_deg, (tick_deg, *inner[:1], 0.0, *inner[1:], -tick_deg), tuple(labels))


def positive_scale(top: float, step: float, unit: str, name: str) -> Scale:
    """A quantity that starts at zero, with its name at the upper end."""
    ticks = tuple(np.arange(0.0, top + step / 2, step).tolist())
    labels = tuple(
        (value, f"{name} {format_rounded(value)}{unit}" if value == ticks[-1] else format_rounded(value))
        for value in ticks
    )
    return Scale(-0.04 * top, 1.08 * top, ticks, labels)


@dataclass(frozen=True, slots=True)
class Panel:
    """A scale in a rectangle, with time from ``start_s`` on the left to ``end_s`` on the right."""

    box: QRectF
    scale: Scale
    start_s: float
    end_s: float

    def x(self, time_s: FloatArray | float) -> FloatArray:
        return x_px(np.asarray(time_s, dtype=np.float64), *self.x_parameters())

    def y(self, value: FloatArray | float) -> FloatArray:
        """Painter y of values, kept inside the panel."""
        return y_px(np.asarray(value, dtype=np.float64), *self.y_parameters())

    def point(self, time_s: float, value: float) -> QPointF:
        """Where one value is."""
        return QPointF(float(self.x(time_s)), float(self.y(value)))

    def x_parameters(self) -> tuple[float, float, float, float]:
        """What :func:`x_px` takes."""
        return self.box.left(), self.box.width(), self.start_s, self.end_s

    def y_parameters(self) -> tuple[float, float, float, float]:
        """What :func:`y_px` takes."""
        return self.box.top(), self.box.height(), self.scale.low, self.scale.high


Bound = float | FloatArray


def x_px(time_s: FloatArray, left: Bound, width: Bound, start_s: Bound, end_s: Bound) -> FloatArray:
    """Painter x of times in a panel, or each in its own."""
    return np.asarray(left + (time_s - start_s) / (end_s - start_s) * width)


def y_px(value: FloatArray, top: Bound, height: Bound, low: Bound, high: Bound) -> FloatArray:
    """Painter y of values, kept inside the panel, or each inside its own."""
    return np.asarray(top + (high - np.minimum(np.maximum(value, low), high)) / (high - low) * height)


def time_labels(start_s: float, end_s: float) -> list[tuple[float, str]]:
    """Round times along the axis, about six of them."""
    span_s = end_s - start_s
    step = next((step for step in (0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600) if span_s / step <= 7), 1200)
    ticks = step * np.arange(math.ceil(start_s / step - 1e-6), math.floor(end_s / step + 1e-6) + 1)
    word = (lambda t: f"{numbers.format_shortest(t)} s") if end_s <= 180 else numbers.format_clock
    return [(t, word(t)) for t in ticks.tolist()]


def align_to_pixels(box: QRectF) -> QRectF:
    """The nearest rectangle with edges between pixels."""
    return QRectF(box.toRect())


def draw_hatching(
    painter: QPainter, style: PlotStyle, box: QRectF, token: str = "border", alpha: int = 130, phase: float = 0.0
) -> None:
    """Diagonal lines over a stretch that is not known; drawn as lines so that paper gets vectors too. What is over
    another one is seen by a ``phase``, as a share of their distance."""
    painter.setPen(QPen(style.color(token, alpha), style.grid_width))
    step, high = 5.0 * style.unit, box.height()
    first = (math.floor((box.left() - high) / step) + phase) * step
    lines = []
    for left in np.arange(first, box.right(), step).tolist():  # cut here: a drawing of lines forgets what is cut
        start, end = max(left, box.left()), min(left + high, box.right())
        if end > start:
            lines.append(QLineF(start, box.bottom() - (start - left), end, box.bottom() - (end - left)))
    painter.drawLines(lines)

"""One panel with a fixed scale: ticks are positive, the ends carry the words. And the hatching of what is not known."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QPainter, QPen

from carpus.core.rounding import written
from carpus.core.types import FloatArray
from carpus.ui import numbers
from carpus.ui.plot.style import PlotStyle


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
    labels = [(tick_deg, f"{upper} {written(tick_deg)}°"), (0.0, "0°"), (-tick_deg, f"{lower} {written(tick_deg)}°")]
    labels += [(value, f"{written(abs(value))}°") for value in inner]
    return Scale(-limit_deg, limit_deg, (tick_deg, *inner[:1], 0.0, *inner[1:], -tick_deg), tuple(labels))


def rising_scale(top: float, step: float, unit: str, name: str) -> Scale:
    """A quantity that starts at zero, with its name at the upper end."""
    ticks = tuple(np.arange(0.0, top + step / 2, step).tolist())
    labels = tuple(
        (value, f"{name} {written(value)}{unit}" if value == ticks[-1] else written(value)) for value in ticks
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
        return x_px(np.asarray(time_s, dtype=np.float64), *self.across())

    def y(self, value: FloatArray | float) -> FloatArray:
        """Painter y of values, kept inside the panel."""
        return y_px(np.asarray(value, dtype=np.float64), *self.down())

    def at(self, time_s: float, value: float) -> QPointF:
        """Where one value is."""
        return QPointF(float(self.x(time_s)), float(self.y(value)))

    def across(self) -> tuple[float, float, float, float]:
        """What :func:`x_px` takes."""
        return self.box.left(), self.box.width(), self.start_s, self.end_s

    def down(self) -> tuple[float, float, float, float]:
        """What :func:`y_px` takes."""
        return self.box.top(), self.box.height(), self.scale.low, self.scale.high


Edge = float | FloatArray


def x_px(time_s: FloatArray, left: Edge, width: Edge, start_s: Edge, end_s: Edge) -> FloatArray:
    """Painter x of times in a panel, or each in its own."""
    return np.asarray(left + (time_s - start_s) / (end_s - start_s) * width)


def y_px(value: FloatArray, top: Edge, height: Edge, low: Edge, high: Edge) -> FloatArray:
    """Painter y of values, kept inside the panel, or each inside its own."""
    return np.asarray(top + (high - np.minimum(np.maximum(value, low), high)) / (high - low) * height)


def time_labels(start_s: float, end_s: float) -> list[tuple[float, str]]:
    """Round times along the axis, about six of them."""
    span_s = end_s - start_s
    step = next((step for step in (0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600) if span_s / step <= 7), 1200)
    ticks = step * np.arange(math.ceil(start_s / step - 1e-6), math.floor(end_s / step + 1e-6) + 1)
    word = (lambda t: f"{numbers.shortest(t)} s") if end_s <= 180 else numbers.clock
    return [(t, word(t)) for t in ticks.tolist()]


def crisp(box: QRectF) -> QRectF:
    """The nearest rectangle with edges between pixels."""
    return QRectF(box.toRect())


def hatch(
    painter: QPainter, style: PlotStyle, box: QRectF, token: str = "border", alpha: int = 130, shift: float = 0.0
) -> None:
    """Diagonal lines over a stretch that is not known; drawn as lines so that paper gets vectors too. What is over
    another one is seen by a ``shift``, as a share of their distance."""
    painter.setPen(QPen(style.color(token, alpha), style.grid_width))
    step, high = 5.0 * style.unit, box.height()
    first = (math.floor((box.left() - high) / step) + shift) * step
    lines = []
    for left in np.arange(first, box.right(), step).tolist():  # cut here: a drawing of lines forgets what is cut
        start, end = max(left, box.left()), min(left + high, box.right())
        if end > start:
            lines.append(QLineF(start, box.bottom() - (start - left), end, box.bottom() - (end - left)))
    painter.drawLines(lines)

"""Panels of charts: their style, fixed scale and time axis, hatching where data are missing, and text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, REGULAR, font
from carpus.ui.kit.theme import LIGHT, Theme, Tokens


@dataclass(frozen=True, slots=True)
class PlotStyle:
    """Colours, fonts, and widths in the painter's unit (pixels on the screen, points on paper)."""

    tokens: Tokens
    label_font: QFont
    end_label_font: QFont
    line_width: float
    grid_width: float
    # One design pixel in the painter's unit; gaps and dashes are multiples of it.
    unit: float

    def color(self, token: str, alpha: int = 255) -> QColor:
        value = QColor(getattr(self.tokens, token))
        value.setAlpha(alpha)
        return value


def screen_style(theme: Theme) -> PlotStyle:
    """Return the style of the theme."""
    return _screen_style(theme.tokens, theme.text_scale)


@lru_cache(maxsize=8)
def _screen_style(tokens: Tokens, text_scale: float) -> PlotStyle:
    size = 12 * text_scale
    return PlotStyle(tokens, font(size, REGULAR), font(size, MEDIUM), 1.75, 1.0, 1.0)


def paper_style(point_px: float) -> PlotStyle:
    """Return the style of printed pages, always light, for ``point_px`` painter units per point."""
    regular, medium = (font(8.5 * point_px, weight, display=False) for weight in (REGULAR, MEDIUM))
    return PlotStyle(LIGHT, regular, medium, 1.2 * point_px, 0.6 * point_px, 0.75 * point_px)


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
        span_s = self.end_s - self.start_s
        return np.asarray(self.box.left() + (np.asarray(time_s) - self.start_s) / span_s * self.box.width())

    def y(self, value: FloatArray | float) -> FloatArray:
        """Return painter y of values, clipped to the panel."""
        low, high = self.scale.low, self.scale.high
        below = (high - np.minimum(np.maximum(value, low), high)) / (high - low)
        return np.asarray(self.box.top() + below * self.box.height())

    def point(self, time_s: float, value: float) -> QPointF:
        return QPointF(float(self.x(time_s)), float(self.y(value)))

    def to_time(self, x: float) -> float:
        """Return the time at a painter x, the nearest end beyond the panel."""
        share = (x - self.box.left()) / max(self.box.width(), 1.0)
        return self.start_s + min(max(share, 0.0), 1.0) * (self.end_s - self.start_s)


def stack_boxes(box: QRectF, weights: Sequence[float], between: float) -> list[QRectF]:
    """Divide a box into boxes one below the other, as high as their weights."""
    unit, top, boxes = (box.height() - between * (len(weights) - 1)) / sum(weights), box.top(), list[QRectF]()
    for weight in weights:
        boxes.append(QRectF(box.left(), top, box.width(), unit * weight))
        top += unit * weight + between
    return boxes


def time_labels(start_s: float, end_s: float) -> list[tuple[float, str]]:
    """Return about six round times along the axis."""
    span_s = end_s - start_s
    step = next((step for step in (0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600) if span_s / step <= 7), 1200)
    ticks = step * np.arange(math.ceil(start_s / step - 1e-6), math.floor(end_s / step + 1e-6) + 1)
    word = (lambda t: f"{numbers.format_shortest(t)} s") if end_s <= 180 else numbers.format_clock
    return [(t, word(t)) for t in ticks.tolist()]


def draw_text(
    painter: QPainter, place: QPointF | QRectF, words: str, face: QFont, color: QColor,
    side: Qt.AlignmentFlag = Qt.AlignmentFlag.AlignVCenter,
) -> None:  # fmt: skip
    """Write words from a baseline's left end, or in a box: left and vertically centred by default."""
    painter.setFont(face)
    painter.setPen(color)
    if isinstance(place, QPointF):
        painter.drawText(place, words)
    else:
        painter.drawText(place, int(side), words)


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

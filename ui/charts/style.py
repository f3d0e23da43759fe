"""Appearance of charts: from the theme on the screen, from the light tokens on paper."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

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


RIGHT_MIDDLE = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight


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


def dash_pen(color: QColor, width: float, dash: Sequence[float]) -> QPen:
    """Return a pen of dashes and gaps in widths of the line; solid if there are none."""
    pen = QPen(color, width)
    if dash:
        pen.setDashPattern(dash)
    return pen


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


def paint_dot(painter: QPainter, style: PlotStyle, position: QPointF, token: str, radius: float) -> None:
    """Paint a disc with a seam, ``radius`` in design pixels."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(style.color("surface"), 1.5 * style.unit))
    painter.setBrush(style.color(token))
    painter.drawEllipse(position, radius * style.unit, radius * style.unit)

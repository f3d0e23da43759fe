"""The way as a child sees it: a ladybird climbs along a stem to a flower, which opens when it is there.

The stem is the same way, of the same length in degrees, as an adult's: nothing is faster, higher or worth more.
"""

from __future__ import annotations

import math

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen

from carpus.ui.theme import Theme

PETALS = 7


def paint_stem(painter: QPainter, theme: Theme, way: QPainterPath, wide: float) -> None:
    """What has been climbed."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(theme.color("good"), wide, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
    painter.drawPath(way)


def paint_climber(painter: QPainter, theme: Theme, at: QPointF, ahead: QPointF, half: float) -> None:
    """A ladybird of twice ``half``, its head ahead."""
    painter.save()
    painter.translate(at)
    painter.rotate(math.degrees(math.atan2(ahead.y(), ahead.x())))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.color("text"))
    painter.drawEllipse(QPointF(0.85 * half, 0), 0.5 * half, 0.5 * half)
    painter.setBrush(theme.color("curve_b"))
    painter.setPen(QPen(theme.color("text"), 5))
    painter.drawEllipse(QPointF(0, 0), half, 0.9 * half)
    painter.drawLine(QPointF(-half, 0), QPointF(0.6 * half, 0))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.color("text"))
    for x, y in ((-0.45, 0.45), (-0.45, -0.45), (0.25, 0.48), (0.25, -0.48)):
        painter.drawEllipse(QPointF(x * half, y * half), 0.17 * half, 0.17 * half)
    painter.restore()


def paint_flower(painter: QPainter, theme: Theme, at: QPointF, half: float, *, open_share: float) -> None:
    """A flower about a point; closed petals stand nearer to its middle."""
    painter.save()
    painter.translate(at)
    painter.setPen(QPen(theme.color("surface"), max(2.0, 0.05 * half)))
    painter.setBrush(theme.color("curve_b" if open_share >= 1.0 else "border"))
    reach = half * (0.3 + 0.32 * open_share)
    for number in range(PETALS):
        painter.save()
        painter.rotate(360.0 * number / PETALS)
        painter.drawEllipse(QRectF(reach - 0.36 * half, -0.26 * half, 0.72 * half, 0.52 * half))
        painter.restore()
    painter.setBrush(theme.color("band_warn"))
    painter.drawEllipse(QPointF(0, 0), 0.3 * half, 0.3 * half)
    painter.restore()

"""What lies over the camera picture: corners found, and the outline where the board is wanted with an arrow to it."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from carpus.core.calibration.camera.board import FoundBoard
from carpus.core.types import FloatArray
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import PictureView
from carpus.ui.theme import ON_PICTURE_PROPOSED, Theme

_HALO = QColor(0, 0, 0, 150)
_NEAR_PX = 24.0
"""A board that is so near to where it is wanted needs no arrow."""


def paint_corners(painter: QPainter, view: PictureView, pixel: FloatArray) -> None:
    """A ring about each corner (K, 2), small where they lie close."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    radius = min(max(2.6 * view.scale, 2.5), 4.5)
    for color, width in ((_HALO, 4.0), (QColor(ON_PICTURE_PROPOSED), 2.0)):
        painter.setPen(QPen(color, width))
        for u, v in pixel.tolist():
            painter.drawEllipse(view.to_screen(u, v), radius, radius)


def paint_target(
    painter: QPainter, view: PictureView, theme: Theme, target: FloatArray, found: FoundBoard | None, words: str
) -> None:
    """The dashed outline (4, 2) with its words, and an arrow from the board to it."""
    corners = [view.to_screen(float(u), float(v)) for u, v in target]
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for pen in _pens():
        painter.setPen(pen)
        painter.drawPolygon(QPolygonF(corners))
    if found is not None:
        at, to = (view.to_screen(*map(float, one.mean(axis=0))) for one in (found.pixel, target))
        _paint_arrow(painter, at, to)
    if words:
        middle = np.mean([(corner.x(), corner.y()) for corner in corners], axis=0)
        size = label_size(theme, words)
        left = min(max(float(middle[0]) - size.width() / 2, 8.0), max(view.width() - size.width() - 8.0, 8.0))
        paint_label(painter, theme, words, left, max(min(corner.y() for corner in corners) + 6.0, 8.0))


def _pens() -> list[QPen]:
    halo, line = QPen(_HALO, 4.0), QPen(QColor(ON_PICTURE_PROPOSED), 2.0)
    line.setDashPattern([4.0, 3.0])
    return [halo, line]


def _paint_arrow(painter: QPainter, at: QPointF, to: QPointF) -> None:
    away = to - at
    length = math.hypot(away.x(), away.y())
    if length < _NEAR_PX:
        return
    along = away / length
    tip = at + along * min(0.6 * length, 110.0)
    across = QPointF(-along.y(), along.x())
    for color, width in ((_HALO, 6.0), (QColor(ON_PICTURE_PROPOSED), 3.0)):
        painter.setPen(QPen(color, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawLine(at, tip)
        for side in (1.0, -1.0):
            painter.drawLine(tip, tip - along * 18.0 + across * (9.0 * side))


def paint_discs(painter: QPainter, view: PictureView, theme: Theme, pixel: FloatArray) -> None:
    """A ring and a letter at each disc (6, 2) of the check card."""
    for letter, (u, v) in zip("ABCDEF", pixel.tolist(), strict=True):
        at = view.to_screen(u, v)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for color, width in ((_HALO, 4.0), (QColor(ON_PICTURE_PROPOSED), 2.0)):
            painter.setPen(QPen(color, width))
            painter.drawEllipse(at, 12.0, 12.0)
        paint_label(painter, theme, letter, at.x() + 12.0, at.y() - 26.0)

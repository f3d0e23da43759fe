"""Overlay of the tracked hand on the camera frame: white lines with a dark halo, in frame pixels."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from carpus.core.model.camera import Camera
from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.ui.kit.theme import ON_PICTURE_LINE

HALO = QColor(0, 0, 0, 150)

ToScreen = Callable[[float, float], QPointF]
"""Maps a pixel of the camera frame to the widget."""


def draw_with_halo(
    painter: QPainter, color: QColor | str, width: float, draw: Callable[[], object], dash: bool = False
) -> None:
    """Draw twice: a wider dark halo, then the line."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for pen in (QPen(HALO, width + 2), QPen(QColor(color), width)):
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        if dash:
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
            pen.setDashPattern([6 / pen.widthF(), 4 / pen.widthF()])
        painter.setPen(pen)
        draw()


def paint_markers(painter: QPainter, frame: TrackedFrame, to_screen: ToScreen) -> None:
    """Draw measured markers as dots, the others as dashed rings where they are predicted."""
    for measured, predicted in zip(frame.marker_measured_px, frame.marker_predicted_px, strict=True):
        if np.isfinite(measured).all():
            painter.setPen(QPen(HALO, 1.5))
            painter.setBrush(QColor(ON_PICTURE_LINE))
            painter.drawEllipse(to_screen(*map(float, measured)), 3.6, 3.6)
        elif np.isfinite(predicted).all():
            ring = partial(painter.drawEllipse, to_screen(*map(float, predicted)), 8.0, 8.0)
            draw_with_halo(painter, ON_PICTURE_LINE, 1.5, ring, dash=True)


def paint_palm_links(painter: QPainter, frame: TrackedFrame, camera: Camera, to_screen: ToScreen) -> None:
    """Draw thin lines from the wrist to the other palm markers of the model."""
    places = frame.marker_position_cam_m
    if frame.status == TrackStatus.LOST or not np.isfinite(places).all():
        return
    pixel = camera.distort(camera.project(places))
    wrist = to_screen(*map(float, pixel[0]))
    painter.setPen(QPen(QColor(255, 255, 255, 150), 1.2))
    for u, v in pixel[1:6]:
        painter.drawLine(wrist, to_screen(float(u), float(v)))

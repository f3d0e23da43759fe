"""Overlay of the tracked hand on the camera frame: white lines with a dark halo, in frame pixels."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.kit.theme import ON_PICTURE_LINE, ON_PICTURE_PARTLY

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


def paint_tracked_hand(
    painter: QPainter, frame: TrackedFrame, protocol: MarkerProtocol, camera: Camera, to_screen: ToScreen
) -> None:
    """Draw the markers of a frame, with the bones of the whole hand or lines from the wrist over the palm."""
    measured, places = frame.marker_measured_px, frame.marker_position_cam_m
    is_known = frame.status != TrackStatus.LOST and bool(np.isfinite(places).all())
    modelled = camera.distort(camera.project(places)) if is_known else np.full_like(measured, np.nan)
    if protocol.has_fingers and is_known:
        _paint_skeleton(painter, protocol, measured, modelled, to_screen)
    elif not protocol.has_fingers:
        painter.setPen(QPen(QColor(255, 255, 255, 150), 1.2))
        for u, v in modelled[1:6] if is_known else ():
            painter.drawLine(to_screen(*map(float, modelled[0])), to_screen(float(u), float(v)))
        _paint_markers(painter, measured, frame.marker_predicted_px, 8.0, ON_PICTURE_LINE, to_screen)


def _paint_skeleton(
    painter: QPainter, protocol: MarkerProtocol, measured: FloatArray, modelled: FloatArray, to_screen: ToScreen
) -> None:
    """Draw the bones of the model: solid between visible markers, dashed where predicted."""
    seen = np.isfinite(measured[:, 0])
    at = [to_screen(float(u), float(v)) for u, v in np.where(seen[:, None], measured, modelled)]
    bones = [ends for chain in protocol.chains.values() for ends in pairwise(chain)]
    for width, is_dashed in ((2.0, False), (1.5, True)):
        lines = [QLineF(at[a], at[b]) for a, b in bones if (seen[a] and seen[b]) != is_dashed]
        draw_with_halo(painter, ON_PICTURE_LINE, width, partial(painter.drawLines, lines), is_dashed)
    _paint_markers(painter, measured, modelled, 4.0, ON_PICTURE_PARTLY, to_screen)


def _paint_markers(
    painter: QPainter, measured: FloatArray, predicted: FloatArray, radius: float, color: str, to_screen: ToScreen
) -> None:
    """Draw measured markers as dots, the others as dashed rings where they are predicted."""
    for dot, ring in zip(measured, predicted, strict=True):
        if np.isfinite(dot).all():
            painter.setPen(QPen(HALO, 1.5))
            painter.setBrush(QColor(ON_PICTURE_LINE))
            painter.drawEllipse(to_screen(*map(float, dot)), 3.6, 3.6)
        elif np.isfinite(ring).all():
            at = to_screen(*map(float, ring))
            draw_with_halo(painter, color, 1.5, partial(painter.drawEllipse, at, radius, radius), dash=True)

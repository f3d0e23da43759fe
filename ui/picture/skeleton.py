"""Overlay of the whole hand's model: bones between markers."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np
from PySide6.QtGui import QColor, QPainter, QPen

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.ui.kit.theme import ON_PICTURE_LINE, ON_PICTURE_PARTLY
from carpus.ui.picture.overlay import HALO, ToScreen, draw_with_halo


def paint_skeleton(
    painter: QPainter, frame: TrackedFrame, protocol: MarkerProtocol, camera: Camera, to_screen: ToScreen
) -> None:
    """Draw the bones of the model: solid between visible markers, dashed where predicted."""
    places = frame.marker_position_cam_m
    if frame.status == TrackStatus.LOST or not np.isfinite(places).all():
        return
    pixel = camera.distort(camera.project(places))
    seen = np.isfinite(frame.marker_measured_px[:, 0])
    at = [to_screen(float(u), float(v)) for u, v in pixel]
    for k in np.flatnonzero(seen):
        u, v = frame.marker_measured_px[k]
        at[k] = to_screen(float(u), float(v))
    bones = [ends for chain in protocol.chains.values() for ends in pairwise(chain)]
    solid = [(at[a], at[b]) for a, b in bones if seen[a] and seen[b]]
    dashed = [(at[a], at[b]) for a, b in bones if not (seen[a] and seen[b])]
    draw_with_halo(painter, ON_PICTURE_LINE, 2.0, lambda: [painter.drawLine(a, b) for a, b in solid])
    draw_with_halo(painter, ON_PICTURE_LINE, 1.5, lambda: [painter.drawLine(a, b) for a, b in dashed], dash=True)
    for row, spot in enumerate(at):
        if seen[row]:
            painter.setPen(QPen(HALO, 1.5))
            painter.setBrush(QColor(ON_PICTURE_LINE))
            painter.drawEllipse(spot, 3.6, 3.6)
        else:
            draw_with_halo(painter, ON_PICTURE_PARTLY, 1.5, partial(painter.drawEllipse, spot, 4.0, 4.0), dash=True)

"""Overlay of the whole hand's model: bones between markers, and one finger from the side."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, Side, TrackedFrame, TrackStatus
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.theme import ON_PICTURE_LABEL, ON_PICTURE_LINE, ON_PICTURE_PARTLY, Theme
from carpus.ui.picture.overlay import HALO, MIN_RING_PX, ToScreen, covariance_ellipse, draw_with_halo

MAX_RING_PX = 26.0
"""Largest half axis drawn around the predicted position of an occluded marker."""
SIDE_SPAN_M = 0.105
"""Length of a straight long finger. A bent one comes back below its MCP joint, so there is room on the left."""
SIDE_WIDTH_PX, SIDE_HEIGHT_PX = 138, 126


def paint_skeleton(
    painter: QPainter, frame: TrackedFrame, protocol: MarkerProtocol, camera: Camera, to_screen: ToScreen, scale: float
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
            _paint_predicted(painter, frame.marker_predicted_cov_px2[row], spot, scale)


def _paint_predicted(painter: QPainter, covariance_px2: FloatArray, center: QPointF, scale: float) -> None:
    """Draw a dashed 2 SD ring where an occluded marker is expected."""
    longer, shorter, turn_deg = MIN_RING_PX, MIN_RING_PX, 0.0
    if np.isfinite(covariance_px2).all():
        longer, shorter, turn_deg = covariance_ellipse(covariance_px2)
    if longer * scale > MAX_RING_PX:
        return  # it may be anywhere about: the dashed bone says so, a large ring would cover the hand
    painter.save()
    painter.translate(center)
    painter.rotate(turn_deg)
    box = QPointF(0, 0), max(longer * scale, 4.0), max(shorter * scale, 4.0)
    draw_with_halo(painter, ON_PICTURE_PARTLY, 1.5, lambda: painter.drawEllipse(*box), dash=True)
    painter.restore()


def side_points_m(frame: TrackedFrame, protocol: MarkerProtocol, finger: int) -> FloatArray:
    """Return the joints (4, 2) of a finger from the side, in metres from its MCP joint.

    The first axis runs along the hand, the second out of its back.
    """
    joints = frame.kinematics.joint_position_m - frame.kinematics.position_m
    chain = (joints @ frame.kinematics.rotation_w2_w0)[list(protocol.chains[finger][1:])]
    along = np.array([1.0, 0.0]) if finger > 1 else chain[1, :2] - chain[0, :2]
    away = chain - chain[0]
    return np.stack((away[:, :2] @ along / max(float(np.linalg.norm(along)), 1e-9), away[:, 2]), axis=1)


def paint_finger_side(
    painter: QPainter,
    theme: Theme,
    frame: TrackedFrame,
    protocol: MarkerProtocol,
    finger: int,
    name: str,
    shown: QRectF,
    side: Side,
) -> None:
    """Draw one finger from the side in the lower corner on the ulnar side of the hand."""
    scale = theme.text_scale
    name_font = font(12 * scale, SEMIBOLD)
    metrics = QFontMetricsF(name_font)
    box = QRectF(0, 0, max(SIDE_WIDTH_PX, metrics.horizontalAdvance(name) + 20), SIDE_HEIGHT_PX)
    box.moveBottom(shown.bottom() - 12)
    box.moveLeft(shown.right() - box.width() - 12 if side == "right" else shown.left() + 12)
    ground = QColor(ON_PICTURE_LABEL)
    ground.setAlpha(225)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(ground)
    painter.drawRoundedRect(box, 8, 8)
    painter.setFont(name_font)
    painter.setPen(QColor(ON_PICTURE_LINE))
    painter.drawText(QPointF(box.left() + 10, box.top() + 6 + metrics.ascent()), name)
    if frame.status == TrackStatus.LOST or finger not in protocol.chains:
        return
    points = side_points_m(frame, protocol, finger)
    if not np.isfinite(points).all():
        return
    unit = (0.72 * SIDE_WIDTH_PX - 12) / SIDE_SPAN_M
    start = QPointF(box.left() + 0.28 * SIDE_WIDTH_PX, box.top() + 0.38 * box.height())
    at = [start + QPointF(float(x) * unit, -float(z) * unit) for x, z in points]
    seen = np.isfinite(frame.marker_measured_px[list(protocol.chains[finger][1:]), 0])
    painter.setPen(QPen(QColor(255, 255, 255, 110), 4))
    painter.drawLine(QPointF(box.left() + 8, start.y()), start)
    for row, (a, b) in enumerate(pairwise(at)):
        pen = QPen(QColor(ON_PICTURE_LINE), 2.0)
        if not seen[row + 1]:
            pen.setDashPattern([2.5, 2.0])
        painter.setPen(pen)
        painter.drawLine(a, b)
    for row, spot in enumerate(at):
        painter.setPen(QPen(QColor(ON_PICTURE_LINE), 1.5))
        painter.setBrush(QColor(ON_PICTURE_LINE) if seen[row] else QColor(ON_PICTURE_LABEL))
        painter.drawEllipse(spot, 3.6, 3.6)

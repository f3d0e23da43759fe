"""Overlay of the tracked hand on the camera frame: white lines with a dark halo, in frame pixels."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.kit.theme import DARK, ON_PICTURE_LINE, Theme
from carpus.ui.picture.photo import paint_label

HALO = QColor(0, 0, 0, 150)
AXIS_LENGTH_M = 0.045
AXES = ((0, "X", DARK.curve_c), (1, "Y", DARK.curve_a), (2, "Z", DARK.curve_b))
ELLIPSE_SDS = 2.0
MIN_RING_PX = 3.0

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


def covariance_ellipse(covariance_px2: FloatArray) -> tuple[float, float, float]:
    """Return half axes (px) and rotation (deg) of the 2 SD ellipse of a covariance (2, 2) in px².

    >>> covariance_ellipse(np.diag([25.0, 4.0]))
    (10.0, 4.0, 0.0)
    """
    a, b, c = float(covariance_px2[0, 0]), float(covariance_px2[0, 1]), float(covariance_px2[1, 1])
    mean, spread = (a + c) / 2.0, math.hypot((a - c) / 2.0, b)
    radii = (ELLIPSE_SDS * math.sqrt(max(value, 0.0)) for value in (mean + spread, mean - spread))
    longer, shorter = (max(radius, MIN_RING_PX) for radius in radii)
    return longer, shorter, math.degrees(0.5 * math.atan2(2.0 * b, a - c))


def paint_markers(painter: QPainter, frame: TrackedFrame, to_screen: ToScreen, scale: float) -> None:
    """Draw predicted positions as 2 SD ellipses (dashed if not measured) and measured markers as dots."""
    for k in range(len(frame.marker_predicted_px)):
        seen = bool(np.isfinite(frame.marker_measured_px[k]).all())
        covariance = frame.marker_predicted_cov_px2[k]
        if np.isfinite(covariance).all() and np.isfinite(frame.marker_predicted_px[k]).all():
            longer, shorter, turn_deg = covariance_ellipse(covariance)
            painter.save()
            painter.translate(to_screen(*map(float, frame.marker_predicted_px[k])))
            painter.rotate(turn_deg)
            box = QPointF(0, 0), longer * scale, shorter * scale
            draw_with_halo(painter, ON_PICTURE_LINE, 1.5, lambda box=box: painter.drawEllipse(*box), dash=not seen)  # type: ignore[misc]
            painter.restore()
        if seen:
            u, v = frame.marker_measured_px[k]
            painter.setPen(QPen(HALO, 1.5))
            painter.setBrush(QColor(ON_PICTURE_LINE))
            painter.drawEllipse(to_screen(float(u), float(v)), 3.2, 3.2)


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


def axis_pixels(frame: TrackedFrame, calibration: Calibration, camera: Camera) -> FloatArray:
    """Return the pixels (4, 2) of the wrist origin and the ends of its X, Y and Z axes."""
    origin = calibration.rotation_w0_cam @ frame.kinematics.position_m + calibration.translation_w0_cam_m
    ends = origin + AXIS_LENGTH_M * (calibration.rotation_w0_cam @ frame.kinematics.rotation_w2_w0).T
    return camera.distort(camera.project(np.vstack((origin, ends))))


def clamp_to_box(point: QPointF, box: QRectF) -> QPointF:
    """Return the point, or the nearest one inside the box."""
    return QPointF(
        min(max(point.x(), box.left()), max(box.left(), box.right())),
        min(max(point.y(), box.top()), max(box.top(), box.bottom())),
    )


def paint_axes(
    painter: QPainter, theme: Theme, frame: TrackedFrame, calibration: Calibration, camera: Camera,
    to_screen: ToScreen, shown: QRectF,
) -> None:  # fmt: skip
    """Draw the wrist axes with their letters, each in the colour of its angle.

    An axis may end outside the part that is ``shown``; its letter stays inside.
    """
    pixels = axis_pixels(frame, calibration, camera)
    if not np.isfinite(pixels).all():
        return
    origin = to_screen(*map(float, pixels[0]))
    for axis, letter, color in AXES:
        end = to_screen(*map(float, pixels[1 + axis]))
        draw_with_halo(painter, color, 3.0, lambda end=end: painter.drawLine(origin, end))  # type: ignore[misc]
        away = end - origin
        length = math.hypot(away.x(), away.y()) or 1.0
        place = clamp_to_box(end + away * (14.0 / length), shown.adjusted(16, 16, -16, -16))
        paint_label(painter, theme, letter, place.x() - 9, place.y() - 10)

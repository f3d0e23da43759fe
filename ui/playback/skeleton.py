"""The skeleton over the picture in review: what was seen solid, what was not dashed, and the way of the fingertips."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from carpus.core.camera import Camera
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.types import FloatArray
from carpus.ui.picture.overlay import haloed
from carpus.ui.picture.view import PictureView
from carpus.ui.plot.polygon import runs
from carpus.ui.theme import ON_PICTURE_LINE


def modelled_px(camera: Camera, position_cam_m: FloatArray) -> FloatArray:
    """Where the model has the markers (..., 2) in the picture; NaN while lost."""
    known = np.isfinite(position_cam_m).all(axis=-1)
    out = np.full((*position_cam_m.shape[:-1], 2), np.nan)
    if known.any():
        out[known] = camera.distort(camera.project(position_cam_m[known]))
    return out


def paint_palm(painter: QPainter, picture: PictureView, spots: FloatArray, seen: np.ndarray) -> None:
    """Lines from the wrist to the palm, and a ring about each disc; ``spots`` (M, 2) pixels, ``seen`` bool (M,)."""
    if np.isfinite(spots).all():
        wrist = picture.to_screen(*map(float, spots[0]))
        for u, v in spots[1:6]:
            end = picture.to_screen(float(u), float(v))
            haloed(painter, ON_PICTURE_LINE, 2.0, lambda end=end: painter.drawLine(wrist, end))  # type: ignore[misc]
    for spot, is_seen in zip(spots, seen, strict=True):
        if np.isfinite(spot).all():
            at = picture.to_screen(*map(float, spot))
            haloed(painter, ON_PICTURE_LINE, 2.0, lambda at=at: painter.drawEllipse(at, 10, 10), dash=not is_seen)  # type: ignore[misc]
            if is_seen:
                painter.setBrush(QColor(ON_PICTURE_LINE))
                painter.drawEllipse(at, 2.5, 2.5)


def paint_skeleton(
    painter: QPainter,
    picture: PictureView,
    protocol: MarkerProtocol,
    spots: FloatArray,
    seen: np.ndarray,
    finger: int = 0,
) -> None:
    """Bones and discs; ``spots`` (M, 2) pixels, ``seen`` bool (M,), ``finger`` 0 for all."""
    for number, chain in protocol.chains.items():
        for a, b in pairwise(chain):
            if np.isfinite(spots[[a, b]]).all():
                start, end = (picture.to_screen(float(u), float(v)) for u, v in spots[[a, b]])
                width = 2.5 if number == finger else 1.5
                line = lambda start=start, end=end: painter.drawLine(start, end)  # noqa: E731
                haloed(painter, ON_PICTURE_LINE, width, line, dash=not (seen[a] and seen[b]))
    for spot, is_seen in zip(spots, seen, strict=True):
        if np.isfinite(spot).all():
            at = picture.to_screen(float(spot[0]), float(spot[1]))
            ring = lambda at=at: painter.drawEllipse(at, 5.5, 5.5)  # noqa: E731
            haloed(painter, ON_PICTURE_LINE, 1.5, ring, dash=not is_seen)
            if is_seen:
                painter.setBrush(QColor(ON_PICTURE_LINE))
                painter.drawEllipse(at, 1.8, 1.8)


def paint_trails(
    painter: QPainter,
    picture: PictureView,
    protocol: MarkerProtocol,
    modelled: FloatArray,
    seen: np.ndarray,
    finger: int = 0,
) -> None:
    """Ways of the fingertips; ``modelled`` (n, M, 2) pixels of the frames shown, ``seen`` bool (n, M)."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for tip in (chain[-1] for number, chain in protocol.chains.items() if finger in (0, number)):
        known = np.isfinite(modelled[:, tip]).all(axis=1)
        for flag, dash in ((known & seen[:, tip], False), (known & ~seen[:, tip], True)):
            for first, last in runs(flag):
                # One sample of the other kind closes the join.
                part = modelled[max(0, first - 1) : last, tip]
                way = QPolygonF([picture.to_screen(float(u), float(v)) for u, v in part if np.isfinite(u)])
                haloed(painter, ON_PICTURE_LINE, 1.5, lambda way=way: painter.drawPolyline(way), dash=dash)  # type: ignore[misc]

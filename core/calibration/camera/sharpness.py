"""How sharp the edges of the board are in a picture."""

from __future__ import annotations

import math
from typing import Literal

import cv2
import numpy as np

from carpus.core.calibration.camera.find_board import FoundBoard
from carpus.core.types import ByteImage, FloatArray

MOST_EDGE_PX = 5.0
"""An edge of a moving or blurred board is wider; in good light and at rest it is about 3.5 wide."""
_REACH_SHARE, _REACH_PX = 0.3, (2, 6)
"""Half the window about the middle of an edge, over the distance between corners."""
_LEAST_CONTRAST = 20.0


def edge_px(color_rgb: ByteImage, found: FoundBoard) -> float:
    """Width of the edges between black and white, the contrast over its steepest rise; NaN where none can be told.

    Half-way between two neighbouring corners there is an edge and nothing else.
    """
    gray = np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2GRAY), dtype=np.float32)
    smooth = cv2.GaussianBlur(gray, (3, 3), 0.0)
    steep = np.hypot(cv2.Sobel(smooth, cv2.CV_32F, 1, 0, scale=0.125), cv2.Sobel(smooth, cv2.CV_32F, 0, 1, scale=0.125))
    widths = [_width(smooth, steep, *_middles(found, along)) for along in ("row", "column")]
    return max(widths) if not any(map(math.isnan, widths)) else math.nan


def _width(smooth: np.ndarray, steep: np.ndarray, middles: FloatArray, steps: FloatArray) -> float:
    """Median width of the edges at these places of a picture."""
    widths = []
    for (u, v), step in zip(middles, steps, strict=True):
        half = int(np.clip(_REACH_SHARE * step, *_REACH_PX))
        box = (slice(round(v) - half, round(v) + half + 1), slice(round(u) - half, round(u) + half + 1))
        if min(box[0].start, box[1].start) < 0 or smooth[box].shape != (2 * half + 1, 2 * half + 1):
            continue
        contrast = float(np.ptp(smooth[box]))
        if contrast >= _LEAST_CONTRAST:
            widths.append(contrast / max(float(steep[box].max()), 1e-6))
    return float(np.median(widths)) if widths else math.nan


def _middles(found: FoundBoard, along: Literal["row", "column"]) -> tuple[FloatArray, FloatArray]:
    """Middles (E, 2) between neighbouring corners of a row or a column, and how far these are apart (E,): a blur to
    the side shows on edges that stand upright alone."""
    across = found.board.columns - 1
    place = {int(corner): pixel for corner, pixel in zip(found.corner, found.pixel, strict=True)}
    step = 1 if along == "row" else across
    pairs = [
        (place[corner], place[corner + step])
        for corner in place
        if corner + step in place and (along == "column" or (corner + 1) % across)
    ]
    if not pairs:
        return np.empty((0, 2)), np.empty(0)
    one, other = np.array(pairs).transpose(1, 0, 2)
    return 0.5 * (one + other), np.asarray(np.linalg.norm(other - one, axis=1))

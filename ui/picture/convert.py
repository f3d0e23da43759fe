"""Conversion of camera arrays to Qt images."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QImage

from carpus.core.model.types import ByteImage


def to_qimage(color_rgb: ByteImage) -> QImage:
    """Return a QImage that owns its pixels; one over the array would outlive it."""
    picture = np.ascontiguousarray(color_rgb)
    height, width = picture.shape[:2]
    borrowed = QImage(picture.data, width, height, 3 * width, QImage.Format.Format_RGB888)
    # The other format makes it a copy, and is drawn three times as fast.
    return borrowed.convertToFormat(QImage.Format.Format_RGB32)

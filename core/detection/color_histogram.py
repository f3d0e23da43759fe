"""Histograms of hue and saturation, and how alike two of them are.

Hue and saturation hardly change when the light on a disc does; brightness does, and is left out.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.types import ByteImage, FloatArray

BINS = 32
"""Bins of hue (of 180) and of saturation (of 256)."""
_HUE_WIDTH = 180 / BINS
_RANGES = [0.0, 180.0, 0.0, 256.0]


def to_hsv(color_rgb: ByteImage) -> ByteImage:
    """Hue 0-179, saturation and value 0-255 of an RGB picture."""
    return np.asarray(cv2.cvtColor(color_rgb, cv2.COLOR_RGB2HSV), dtype=np.uint8)


def histogram(hsv: ByteImage, mask: NDArray[np.bool_], smooth_bins: float = 0.0) -> FloatArray:
    """Normalised histogram (BINS, BINS) of the masked pixels; hue wraps round when smoothed."""
    pixels = hsv[mask]
    hue = np.minimum((pixels[:, 0] / _HUE_WIDTH).astype(np.int64), BINS - 1)
    saturation = pixels[:, 1].astype(np.int64) * BINS // 256
    counts = np.bincount(hue * BINS + saturation, minlength=BINS * BINS).reshape(BINS, BINS).astype(np.float64)
    if smooth_bins > 0.0:
        wrapped = np.concatenate((counts[-4:], counts, counts[:4]))
        blurred = cv2.GaussianBlur(wrapped, (0, 0), smooth_bins, borderType=cv2.BORDER_REPLICATE)
        counts = np.asarray(blurred, dtype=np.float64)[4:-4]
    total = counts.sum()
    return np.asarray(counts / total if total > 0 else counts)


def back_project(hsv: ByteImage, lookup: NDArray[np.float32]) -> ByteImage:
    """Value 0-255 of the bin of every pixel; ``lookup`` (BINS, BINS) holds 0 to 255."""
    return np.asarray(cv2.calcBackProject([hsv], [0, 1], lookup, _RANGES, 1.0), dtype=np.uint8)


def bhattacharyya(a: FloatArray, b: FloatArray) -> FloatArray:
    """Bhattacharyya coefficient of normalised histograms (..., n), 0 for none in common, 1 for equal.

    >>> float(bhattacharyya(np.array([0.5, 0.5]), np.array([0.5, 0.5])))
    1.0
    """
    return np.asarray(np.sum(np.sqrt(a * b), axis=-1))

"""Arrays to Qt polygons without a Python object per point."""

from __future__ import annotations

from typing import Any

import numpy as np
import shiboken6
from PySide6.QtGui import QPolygonF

from carpus.core.types import FloatArray

BYTES_PER_POINT = 16
_memory: Any = shiboken6.VoidPtr
"""Takes an address, a size and whether it may be written; its stub knows the address only."""


def polygon(x_px: FloatArray, y_px: FloatArray) -> QPolygonF:
    """A polygon of the points (n,), written straight into Qt's memory: 300 points cost what 3 do."""
    out = QPolygonF()
    count = len(x_px)
    if count:
        out.resize(count)
        memory = _memory(out.data(), count * BYTES_PER_POINT, True)
        points = np.frombuffer(memory, np.float64).reshape(count, 2)
        points[:, 0] = x_px
        points[:, 1] = y_px
    return out


def runs(flag: np.ndarray) -> list[tuple[int, int]]:
    """First and one-past-last index of each stretch of True."""
    wide = np.zeros(len(flag) + 2, dtype=np.bool_)
    wide[1:-1] = flag
    edges = np.flatnonzero(wide[1:] != wide[:-1]).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))

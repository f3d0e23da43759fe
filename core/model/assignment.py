"""Who belongs to whom, one to one, nearest overall."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray


def assign_nearest(distance: FloatArray, max_distance: FloatArray) -> NDArray[np.int64]:
    """Column of every row (R,) by distances (R, C), each once and the nearest overall; -1 where none is within the
    row's ``max_distance`` (R,)."""
    from scipy.optimize import linear_sum_assignment  # a third of a second to load

    far = distance > max_distance[:, None]
    rows, columns = linear_sum_assignment(np.where(far, 1e6, distance))
    out = np.full(len(distance), -1, dtype=np.int64)
    near = ~far[rows, columns]
    out[rows[near]] = columns[near]
    return out

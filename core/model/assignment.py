"""One-to-one assignment of least total distance."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray


def assign_nearest(distance: FloatArray, max_distance: FloatArray) -> NDArray[np.int64]:
    """Return the column assigned to every row (R,), -1 for none.

    Parameters
    ----------
    distance : (R, C)
        Distance of every row from every column.
    max_distance : (R,)
        Assignments that are farther than the row's own are dropped.
    """
    from scipy.optimize import linear_sum_assignment  # a third of a second to load

    far = distance > max_distance[:, None]
    rows, columns = linear_sum_assignment(np.where(far, 1e6, distance))
    out = np.full(len(distance), -1, dtype=np.int64)
    near = ~far[rows, columns]
    out[rows[near]] = columns[near]
    return out

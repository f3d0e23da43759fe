"""Who belongs to whom, one to one, at the least cost."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.kernels.choice import in_c
from carpus.core.types import FloatArray


def linear_sum_assignment(cost: FloatArray, *, maximize: bool = False) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns (K,) of the assignment of least total ``cost`` (R, C), K = min(R, C), rows rising.

    SciPy's optimisers take half a second to load, which is a quarter of the program's start: only where there is no
    kernel in C. Raises ``ValueError`` where a cost is NaN or minus infinity, or every assignment costs infinitely much.
    """
    if (kernels := in_c()) is not None:
        is_tall = cost.shape[0] > cost.shape[1]
        wide = np.array(cost.T if is_tall else cost, dtype=np.float64, order="C")
        if maximize:
            np.negative(wide, out=wide)
        rows, columns = np.arange(len(wide)), np.empty(len(wide), dtype=np.int64)
        kernels.least_assignment(*wide.shape, wide, columns)
        if not is_tall:
            return rows, columns
        order = columns.argsort()
        return columns[order], rows[order]
    from scipy import optimize

    found: Any = optimize.linear_sum_assignment(cost, maximize=maximize)
    return found  # type: ignore[no-any-return]


def nearest_within(distance: FloatArray, reach: FloatArray) -> NDArray[np.int64]:
    """Column of every row (R,) by distances (R, C), each once and the nearest overall; -1 where none is within the
    row's ``reach`` (R,)."""
    far = distance > reach[:, None]
    rows, columns = linear_sum_assignment(np.where(far, 1e6, distance))
    out = np.full(len(distance), -1, dtype=np.int64)
    near = ~far[rows, columns]
    out[rows[near]] = columns[near]
    return out

"""Who belongs to whom, one to one, at the least cost."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.types import FloatArray


def linear_sum_assignment(cost: FloatArray, *, maximize: bool = False) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns (K,) of the assignment of least total ``cost`` (R, C), K = min(R, C), rows rising.

    SciPy's optimisers take half a second to load, which is a quarter of the program's start: loaded when first needed.
    """
    from scipy import optimize

    found: Any = optimize.linear_sum_assignment(cost, maximize=maximize)
    return found  # type: ignore[no-any-return]

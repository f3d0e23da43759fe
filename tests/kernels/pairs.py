"""The same step by NumPy and in C, and how far they are apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
import pytest

from carpus.core.kernels import choice

LEVELS = ("plain", "wide")
"""Where a processor is not wide, both are the plain one."""


def numbers(value: Any) -> list[np.ndarray]:
    """Every array and number of a result, in order."""
    if is_dataclass(value):
        return [one for field in fields(value) for one in numbers(getattr(value, field.name))]
    if isinstance(value, tuple | list):
        return [one for part in value for one in numbers(part)]
    return [np.asarray(np.nan if value is None else value)]


def both(step: Callable[[], Any], nearest: float = 1e-9) -> Any:
    """NumPy's result of a step, after those in C were found to be the same: to ``nearest``, NaN where NaN is."""
    with choice.forced(choice.NUMPY):
        expected = step()
    for level in LEVELS:
        with choice.forced(level) as kernels:
            if kernels is None:
                pytest.fail("no kernels here: python core/kernels/build.py says why")
            found = step()
        for one, other in zip(numbers(found), numbers(expected), strict=True):
            assert one.shape == other.shape
            assert one.dtype == other.dtype
            np.testing.assert_allclose(one, other, rtol=nearest, atol=nearest * _size(other) + 1e-15)
    return expected


def _size(value: np.ndarray) -> float:
    """What counts as large in it."""
    known = np.abs(value[np.isfinite(value)]) if value.dtype.kind == "f" else np.abs(value)
    return float(known.max()) if known.size else 0.0

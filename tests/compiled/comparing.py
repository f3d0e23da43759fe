"""A compiled function beside its oracle in NumPy, and arrays as no caller should have them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np


def numbers(value: Any) -> list[np.ndarray]:
    """Every array and number of a result, in order."""
    if is_dataclass(value):
        return [one for field in fields(value) for one in numbers(getattr(value, field.name))]
    if isinstance(value, tuple | list):
        return [one for part in value for one in numbers(part)]
    return [np.asarray(np.nan if value is None else value)]


def assert_same(found: Any, expected: Any, nearest: float = 1e-9) -> None:
    """The same shapes, types and numbers, to ``nearest`` of each array's largest; NaN where NaN is."""
    for one, other in zip(numbers(found), numbers(expected), strict=True):
        assert one.shape == other.shape
        assert one.dtype == other.dtype
        known = np.abs(other[np.isfinite(other)]) if other.dtype.kind == "f" else np.abs(other)
        size = float(known.max()) if known.size else 0.0
        np.testing.assert_allclose(one, other, rtol=nearest, atol=nearest * size + 1e-15)


def laid_out(value: Any, layout: Callable[[np.ndarray], np.ndarray]) -> Any:
    """A dataclass of arrays, or an array, stored otherwise."""
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{field.name: laid_out(getattr(value, field.name), layout) for field in fields(value)})
    return layout(value) if isinstance(value, np.ndarray) else value


def every_second(array: np.ndarray) -> np.ndarray:
    """The same numbers, every second of a larger array's; between them they stand in reverse."""
    wide = np.repeat(array[..., ::-1], 2, axis=-1)
    wide[..., ::2] = array
    return wide[..., ::2]


def read_only(array: np.ndarray) -> np.ndarray:
    """The same numbers, not to be written."""
    out = array.copy()
    out.flags.writeable = False
    return out


LAYOUTS: tuple[Callable[[np.ndarray], np.ndarray], ...] = (np.asfortranarray, every_second, read_only)

"""``core/compiled/samples.py`` in NumPy."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import DepthImage, FloatArray

Readings = tuple[FloatArray, FloatArray] | None


def sample_outline(
    raw: DepthImage,
    unit_m: float,
    corner_px: FloatArray,
    wider: float,
    margin_px: float,
    step: int,
    max_readings: int,
) -> Readings:
    if not np.isfinite(corner_px).all():
        return None
    height, width = raw.shape
    middle = corner_px.mean(axis=0)
    outline = middle + wider * (corner_px - middle)
    outline = outline[np.argsort(np.arctan2(outline[:, 1] - middle[1], outline[:, 0] - middle[0]))]
    left, top = np.maximum(outline.min(axis=0) - margin_px, 0.0).tolist()
    right, bottom = (outline.max(axis=0) + margin_px).tolist()
    first_u, first_v = step * math.ceil(left / step), step * math.ceil(top / step)
    last_u, last_v = min(math.floor(right), width - 1), min(math.floor(bottom), height - 1)
    if last_u < first_u or last_v < first_v:
        return None
    u, v = np.arange(first_u, last_u + 1, step), np.arange(first_v, last_v + 1, step)
    along = np.roll(outline, -1, axis=0) - outline
    least = margin_px * (np.hypot(along[:, 0], along[:, 1]) + 1e-9)
    by_row = along[:, :1] * (v - outline[:, 1:]) + least[:, None]
    by_column = along[:, 1:] * (u - outline[:, :1])
    inside = (by_row[:, :, None] >= by_column[:, None, :]).all(axis=0) & (raw[np.ix_(v, u)] > 0)
    row, column = inside.nonzero()
    if row.size > max_readings:
        thinned = (np.arange(max_readings) * ((row.size - 1) / max(max_readings - 1, 1))).astype(np.int64)
        thinned[-1] = row.size - 1
        row, column = row[thinned], column[thinned]
    return _readings(raw, unit_m, u[column], v[row])


def sample_discs(
    raw: DepthImage, unit_m: float, disc_px: FloatArray, margin_px: float, step: int, max_readings: int
) -> Readings:
    if not np.isfinite(disc_px).all():
        return None
    height, width = raw.shape
    low = np.maximum(np.floor((disc_px.min(axis=0) - margin_px) / step), 0)
    high = np.minimum(np.ceil((disc_px.max(axis=0) + margin_px) / step) * step, (width - 1, height - 1))
    u, v = (np.arange(step * start, min(end, 1e6) + 1, step).astype(int) for start, end in zip(low, high, strict=True))
    if not u.size or not v.size:
        return None
    row, column = np.nonzero(raw[np.ix_(v, u)])
    if row.size > max_readings:
        along, down = np.abs(u - disc_px[:, :1]), np.abs(v - disc_px[:, 1:])
        apart = (down[:, :, None] + along[:, None, :]).min(axis=0)[row, column]
        near = apart <= np.partition(apart, max_readings - 1)[max_readings - 1]
        row, column = row[near][:max_readings], column[near][:max_readings]
    return _readings(raw, unit_m, u[column], v[row]) if row.size else None


def _readings(raw: DepthImage, unit_m: float, u: NDArray[np.int64], v: NDArray[np.int64]) -> Readings:
    depth = (raw[v, u] * unit_m).astype(np.float32).astype(np.float64)
    return np.column_stack((u, v)).astype(np.float64), depth

"""Triangles into pixels: a z-buffer in NumPy, all triangles at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray


@dataclass(frozen=True, slots=True)
class Fragments:
    """The nearest surface at F samples: ``row``, ``column`` of the sample (F,), the ``triangle`` (F,) seen there,
    the ``share`` (F, 3) of its corners, ``depth_m`` (F,)."""

    row: NDArray[np.int64]
    column: NDArray[np.int64]
    triangle: NDArray[np.int64]
    share: FloatArray
    depth_m: FloatArray


def fragments(
    pixel: FloatArray, depth_m: FloatArray, triangle: NDArray[np.int64], shape: tuple[int, int], per_pixel: int = 1
) -> Fragments:
    """What is seen of triangles (T, 3) of corners at ``pixel`` (V, 2) and ``depth_m`` (V,), on a grid of ``per_pixel``
    samples each way in every pixel of a picture of ``shape``; those seen from behind are left out."""
    rows, columns = shape[0] * per_pixel, shape[1] * per_pixel
    spot = (pixel + 0.5) * per_pixel - 0.5
    a, b, c = (spot[triangle[:, i]] for i in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    low = np.ceil(np.minimum(np.minimum(a, b), c)).astype(np.int64)
    high = np.floor(np.maximum(np.maximum(a, b), c)).astype(np.int64)
    low, high = np.maximum(low, 0), np.minimum(high, [columns - 1, rows - 1])
    size = high - low + 1
    kept = np.flatnonzero((area < 0.0) & (size > 0).all(axis=1) & (depth_m[triangle] > 0.05).all(axis=1))
    low, size, area, a, b, c = low[kept], size[kept], area[kept], a[kept], b[kept], c[kept]
    count = size[:, 0] * size[:, 1]
    owner = np.repeat(np.arange(len(kept)), count)
    wide = size[owner, 0]
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    down = place // wide
    x = low[owner, 0] + place - down * wide
    y = low[owner, 1] + down
    # Shares of the corners, and one over the depth (not depth), are linear over the picture.
    near = 1.0 / depth_m[triangle[kept]]
    part_b = np.stack((c[:, 1] - a[:, 1], a[:, 0] - c[:, 0]), axis=1) / area[:, None]
    part_c = np.stack((a[:, 1] - b[:, 1], b[:, 0] - a[:, 0]), axis=1) / area[:, None]
    at_b, at_c = (-np.einsum("ti,ti->t", part, a) for part in (part_b, part_c))
    share_b = x * part_b[owner, 0] + y * part_b[owner, 1] + at_b[owner]
    share_c = x * part_c[owner, 0] + y * part_c[owner, 1] + at_c[owner]
    inside = np.flatnonzero((share_b >= -1e-9) & (share_c >= -1e-9) & (share_b + share_c <= 1.0 + 1e-9))
    owner, share_b, share_c = owner[inside], share_b[inside], share_c[inside]
    near_a, near_b, near_c = near[owner].T
    nearness = near_a + share_b * (near_b - near_a) + share_c * (near_c - near_a)
    sample = y[inside] * columns + x[inside]
    order = np.argsort(nearness)
    front = np.full(rows * columns, -1, dtype=np.int64)
    front[sample[order]] = order
    seen = front[front >= 0]
    owner, sample, share_b, share_c = owner[seen], sample[seen], share_b[seen], share_c[seen]
    share = np.stack((1.0 - share_b - share_c, share_b, share_c), axis=1) * near[owner] / nearness[seen, None]
    return Fragments(sample // columns, sample % columns, kept[owner], share, 1.0 / nearness[seen])

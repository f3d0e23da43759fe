"""Depth readings on the back of the hand, thinned out: thousands lie there, and neighbours share their errors."""

from __future__ import annotations

import math

import numpy as np

from carpus.core.kernels.choice import in_c
from carpus.core.types import (
    FINGER_READINGS,
    FINGER_STEP_PX,
    SURFACE_READINGS,
    FloatArray,
    Frame,
    Region,
    SurfaceSamples,
)

STEP_PX = 3
"""Between two readings."""
WIDER = 1.2
"""Readings are taken within so many times the outline of the discs that span the back."""
MARGIN_PX = 4.0
"""And so much about it."""
MAX_READINGS = SURFACE_READINGS // 2
"""On the back of the hand; more only cost time, since neighbours share their errors."""
FINGER_MARGIN_PX = 12.0
"""So far about the discs of fingers readings are taken."""
MAX_FINGER_READINGS = FINGER_READINGS
"""About the fingers."""


def part_read(region: Region, corner_px: FloatArray, disc_px: FloatArray) -> Region | None:
    """What of a picture holds ``region`` and all that the two functions below read; None where places are not known."""
    part = region
    for pixel, wider, margin_px in (
        (corner_px, WIDER - 1.0, MARGIN_PX),
        (disc_px, 0.0, FINGER_MARGIN_PX + FINGER_STEP_PX),
    ):
        if not np.isfinite(pixel).all():
            return None
        if len(pixel):
            low, high = pixel.min(axis=0), pixel.max(axis=0)
            reach = wider * (high - low) + margin_px + 1.0
            left, top = (low - reach).astype(int).tolist()
            right, bottom = (high + reach).astype(int).tolist()
            part = Region(
                min(part.left, left), min(part.top, top), max(part.right, right + 1), max(part.bottom, bottom + 1)
            )
    return part


def surface_samples(frame: Frame, corner_px: FloatArray) -> SurfaceSamples | None:
    """The readings within discs expected at ``corner_px`` (C, 2); None where there is no depth picture.

    Depths are rounded to single precision, as they are stored: tracked again from there they are the same.
    """
    if frame.depth_raw is None or not np.isfinite(corner_px).all():
        return None
    height, width = frame.depth_raw.shape
    if (kernels := in_c()) is not None:
        pixel, depth, found = np.empty((MAX_READINGS, 2)), np.empty(MAX_READINGS), np.empty(1, dtype=np.int32)
        kernels.readings_within(
            height, width, frame.depth_raw, frame.depth_unit_m, len(corner_px), corner_px,
            WIDER, MARGIN_PX, STEP_PX, MAX_READINGS, pixel, depth, found,
        )  # fmt: skip
        count = found.item()
        return None if count < 0 else SurfaceSamples(pixel[:count], depth[:count])
    middle = corner_px.mean(axis=0)
    outline = middle + WIDER * (corner_px - middle)
    outline = outline[np.argsort(np.arctan2(outline[:, 1] - middle[1], outline[:, 0] - middle[0]))]
    left, top = np.maximum(outline.min(axis=0) - MARGIN_PX, 0.0).tolist()
    right, bottom = (outline.max(axis=0) + MARGIN_PX).tolist()
    # The lattice stays where it is from picture to picture: the same errors then come again, and are not news.
    step = STEP_PX
    first_u, first_v = step * math.ceil(left / step), step * math.ceil(top / step)
    last_u, last_v = min(math.floor(right), width - 1), min(math.floor(bottom), height - 1)
    if last_u < first_u or last_v < first_v:
        return None
    raw = frame.depth_raw[first_v : last_v + 1 : step, first_u : last_u + 1 : step]
    # Twice the area of the triangle of an edge and a pixel, in parts that go with its row and its column.
    along = outline[np.arange(1, len(outline) + 1) % len(outline)] - outline
    least = MARGIN_PX * (np.hypot(along[:, 0], along[:, 1]) + 1e-9)
    u, v = np.arange(first_u, last_u + 1.0, step), np.arange(first_v, last_v + 1.0, step)
    by_row = along[:, :1] * (v - outline[:, 1:]) + least[:, None]
    by_column = along[:, 1:] * (u - outline[:, :1])
    inside = raw > 0
    for of_row, of_column in zip(by_row, by_column, strict=True):
        inside &= of_row[:, None] >= of_column
    row, column = inside.nonzero()
    if row.size > MAX_READINGS:
        thinned = (np.arange(MAX_READINGS) * ((row.size - 1) / (MAX_READINGS - 1))).astype(np.int64)
        thinned[-1] = row.size - 1
        row, column = row[thinned], column[thinned]
    depth = (raw[row, column] * frame.depth_unit_m).astype(np.float32).astype(np.float64)
    pixel = np.empty((row.size, 2))
    pixel[:, 0], pixel[:, 1] = u[column], v[row]
    return SurfaceSamples(pixel, depth)


def finger_samples(frame: Frame, disc_px: FloatArray) -> SurfaceSamples | None:
    """Readings on a wider lattice about the fingers' discs expected at ``disc_px`` (C, 2); None where there is no
    depth picture."""
    if frame.depth_raw is None or not np.isfinite(disc_px).all() or not len(disc_px):
        return None
    height, width = frame.depth_raw.shape
    step = FINGER_STEP_PX
    if (kernels := in_c()) is not None:
        most = MAX_FINGER_READINGS
        pixel, taken, found = np.empty((most, 2)), np.empty(most), np.empty(1, dtype=np.int32)
        kernels.readings_about(
            height, width, frame.depth_raw, frame.depth_unit_m, len(disc_px), disc_px, FINGER_MARGIN_PX, step,
            most, pixel, taken, found,
        )  # fmt: skip
        count = found.item()
        return None if count < 0 else SurfaceSamples(pixel[:count], taken[:count])
    low = np.maximum(np.floor((disc_px.min(axis=0) - FINGER_MARGIN_PX) / step), 0).astype(int)
    high = np.minimum(np.ceil((disc_px.max(axis=0) + FINGER_MARGIN_PX) / step) * step, (width - 1, height - 1))
    u, v = np.arange(step * low[0], int(high[0]) + 1, step), np.arange(step * low[1], int(high[1]) + 1, step)
    if not u.size or not v.size:
        return None
    raw = frame.depth_raw[v[0] : v[-1] + 1 : step, u[0] : u[-1] + 1 : step]
    row, column = np.nonzero(raw)
    if row.size > MAX_FINGER_READINGS:
        # Too many: those nearest to a disc tell most. How near goes with the column and with the row.
        along, down = np.abs(u - disc_px[:, :1]), np.abs(v - disc_px[:, 1:])
        apart = (down[:, :, None] + along[:, None, :]).min(axis=0)[row, column]
        near = apart <= np.partition(apart, MAX_FINGER_READINGS - 1)[MAX_FINGER_READINGS - 1]
        row, column = row[near][:MAX_FINGER_READINGS], column[near][:MAX_FINGER_READINGS]
    if not row.size:
        return None
    depth = (raw[row, column] * frame.depth_unit_m).astype(np.float32).astype(np.float64)
    return SurfaceSamples(np.column_stack((u[column], v[row])).astype(np.float64), depth)

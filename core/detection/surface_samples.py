"""Depth readings on the back of the hand, thinned out: thousands lie there, and neighbours share their errors."""

from __future__ import annotations

import numpy as np

from carpus.core.compiled.samples import sample_discs, sample_outline
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
    """The readings within discs expected at ``corner_px`` (C, 2); None where there is no depth picture."""
    if frame.depth_raw is None:
        return None
    found = sample_outline(frame.depth_raw, frame.depth_unit_m, corner_px, WIDER, MARGIN_PX, STEP_PX, MAX_READINGS)
    return None if found is None else SurfaceSamples(*found)


def finger_samples(frame: Frame, disc_px: FloatArray) -> SurfaceSamples | None:
    """Readings on a wider lattice about the fingers' discs expected at ``disc_px`` (C, 2); None where there is no
    depth picture."""
    if frame.depth_raw is None or not len(disc_px):
        return None
    found = sample_discs(
        frame.depth_raw, frame.depth_unit_m, disc_px, FINGER_MARGIN_PX, FINGER_STEP_PX, MAX_FINGER_READINGS
    )
    return None if found is None else SurfaceSamples(*found)

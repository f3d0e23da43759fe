"""Depth readings on the back of the hand and the fingers, thinned out.

Thousands lie there, and neighbours share their errors.
"""

from __future__ import annotations

import numpy as np

from carpus.core.compiled.samples import sample_discs, sample_outline
from carpus.core.model.types import (
    FINGER_SAMPLE_STEP_PX,
    MAX_FINGER_READINGS,
    MAX_SURFACE_READINGS,
    FloatArray,
    Frame,
    Region,
    SurfaceSamples,
)

SURFACE_SAMPLE_STEP_PX = 3  # between two readings
OUTLINE_SCALE = 1.2  # readings are taken within so many times the outline of the discs that span the back,
OUTLINE_MARGIN_PX = 4.0  # and so much about it
MAX_DORSAL_READINGS = MAX_SURFACE_READINGS // 2  # on the back of the hand; more only cost time
FINGER_MARGIN_PX = 12.0  # readings are taken so far about the discs of fingers


def compute_read_region(region: Region, outline_px: FloatArray, disc_px: FloatArray) -> Region | None:
    """Return the region that holds ``region`` and all that the two functions below read.

    None where positions are not known.
    """
    part = region
    for pixel, wider, margin_px in (
        (outline_px, OUTLINE_SCALE - 1.0, OUTLINE_MARGIN_PX),
        (disc_px, 0.0, FINGER_MARGIN_PX + FINGER_SAMPLE_STEP_PX),
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


def sample_surface(frame: Frame, outline_px: FloatArray) -> SurfaceSamples | None:
    """Return the readings within discs expected at ``outline_px`` (C, 2).

    None where there is no depth image.
    """
    if frame.depth_raw is None:
        return None
    found = sample_outline(
        frame.depth_raw,
        frame.depth_unit_m,
        outline_px,
        OUTLINE_SCALE,
        OUTLINE_MARGIN_PX,
        SURFACE_SAMPLE_STEP_PX,
        MAX_DORSAL_READINGS,
    )
    return None if found is None else SurfaceSamples(*found)


def sample_fingers(frame: Frame, disc_px: FloatArray) -> SurfaceSamples | None:
    """Return readings on a wider lattice about the fingers' discs expected at ``disc_px`` (C, 2).

    None where there is no depth image.
    """
    if frame.depth_raw is None or not len(disc_px):
        return None
    found = sample_discs(
        frame.depth_raw, frame.depth_unit_m, disc_px, FINGER_MARGIN_PX, FINGER_SAMPLE_STEP_PX, MAX_FINGER_READINGS
    )
    return None if found is None else SurfaceSamples(*found)

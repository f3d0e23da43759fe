"""Blobs of paper colour, touching discs separated, and the window of pixels about a blob: core, rim, neighbourhood."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.blobs import find_blobs
from carpus.core.model.types import ByteImage, FloatArray

WEDGES = 8
CORE_RADII = 0.62  # up to so many disc radii a window has the paper's own colour
REACH_RADII = 1.35  # up to here pixels may belong to the disc
RIM_INNER_RADII = 1.35  # what surrounds it lies between this
RIM_OUTER_RADII = 1.9  # and this
EDGE_PX = 6  # how far about an edge a sensor's readings are of neither side, by default


@dataclass(frozen=True, slots=True)
class Components:
    """Blobs of a mask.

    ``labels`` (H, W), 0 where there is no blob; per blob its ``label`` (B,), ``centre_px`` (B, 2) and ``area_px`` (B,)
    of whole pixels, and the ``radius_px`` (B,) of a disc at its depth.
    """

    labels: NDArray[np.int32]
    label: NDArray[np.int32]
    centre_px: FloatArray
    area_px: FloatArray
    radius_px: FloatArray

    def subset(self, indices: NDArray[np.int64]) -> Components:
        """Return the blobs at these indices."""
        return Components(
            self.labels, self.label[indices], self.centre_px[indices], self.area_px[indices], self.radius_px[indices]
        )


def find_components(
    mask: ByteImage,
    estimate_radius: Callable[[FloatArray], FloatArray],
    min_share: float = 0.0,
    max_share: float = math.inf,
) -> Components:
    """Find the blobs of a mask, touching discs separated.

    ``estimate_radius`` gives the radius (N,) in pixels of a disc facing the camera at pixels (N, 2). A blob has
    ``min_share`` to ``max_share`` of such a disc's area.
    """
    return Components(*find_blobs(mask, estimate_radius, min_share, max_share))


@dataclass(frozen=True, slots=True)
class Stencil:
    """A round window of P pixels about a blob, which depends on the disc's radius alone.

    The pixels are ordered from the centre outwards, so that core, neighbourhood and rim are each a run of them.
    ``offset`` (P, 2) v and u from the centre; ``core`` and ``near`` the first so many pixels: those of the disc's own
    colour, those within the sensor's window (at least the core); ``reach`` (P,) those that may belong to the disc;
    ``rim`` the R pixels around it, ``wedge`` (R, WEDGES) 1 for those that are seen in each of eight overlapping quarter
    circles; ``direction`` (P,) the quarter circle in whose middle each pixel lies.
    """

    offset: NDArray[np.int32]
    core: slice
    reach: NDArray[np.bool_]
    near: slice
    rim: slice
    wedge: NDArray[np.float64]
    direction: NDArray[np.uint8]


def get_stencil(radius_px: float, edge_px: int | None = None) -> Stencil:
    """Return the stencil of discs of about this radius (to a quarter of a pixel).

    ``edge_px`` is the width of edges in the sensor's depth images.
    """
    return _build_stencil(max(4, round(4.0 * radius_px)), EDGE_PX if edge_px is None else edge_px)


@lru_cache(maxsize=64)
def _build_stencil(quarters: int, edge_px: int) -> Stencil:
    radius = quarters / 4.0
    half = max(int(np.ceil(RIM_OUTER_RADII * radius)), edge_px)
    offset = np.arange(-half, half + 1)
    row, column = (grid.ravel() for grid in np.meshgrid(offset, offset, indexing="ij"))
    distance = np.hypot(row, column)
    core, reach, rim_from, rim_to = (
        CORE_RADII * radius + 0.25,
        REACH_RADII * radius + 0.5,
        RIM_INNER_RADII * radius,
        RIM_OUTER_RADII * radius,
    )
    used = distance <= max(reach, rim_to, edge_px)
    row, column, distance = row[used], column[used], distance[used]
    # Rings between the limits from the middle outwards, in each of them row by row.
    ring = sum((distance > limit).astype(np.int64) for limit in (core, reach, rim_to, edge_px))
    order = np.argsort(ring + (distance >= rim_from), kind="stable")
    row, column, distance = row[order], column[order], distance[order]

    def slice_below(reach_px: float) -> slice:
        return slice(int(np.count_nonzero(distance <= reach_px)))

    rim = slice(int(np.count_nonzero(distance < rim_from)), slice_below(rim_to).stop)
    angle = np.arctan2(row, column)
    width = 2.0 * np.pi / WEDGES
    middle = np.arange(WEDGES) * width
    angle_difference = np.abs((angle - middle[:, None] + np.pi) % (2.0 * np.pi) - np.pi)
    is_seen = width + 1e-9 >= angle_difference[:, rim].T
    return Stencil(
        np.stack((row, column), axis=1).astype(np.int32),
        slice_below(core),
        distance <= reach,
        slice_below(max(edge_px, core)),
        rim,
        np.ascontiguousarray(is_seen, dtype=np.float64),
        angle_difference.argmin(axis=0).astype(np.uint8),
    )

"""Where to look in the window around a blob: which pixels can be its core, its rim, its neighbourhood.

All of it depends on the disc's radius alone and is worked out once.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from core.types import FloatArray

EDGE_REACH_PX = 6
"""The sensor's matching window reaches this far."""
WEDGES = 8
_CORE, _REACH, _RIM_FROM, _RIM_TO = 0.62, 1.35, 1.35, 1.9
"""Radii, in disc radii: the paper's own colour, what may belong to the disc, what surrounds it."""


@dataclass(frozen=True, slots=True)
class Stencil:
    """A square window of P = (2 half + 1)^2 pixels, flattened.

    ``row`` and ``column`` (P,) offsets from the middle; ``core``, ``reach``, ``rim`` (P,) masks;
    ``moments`` (P, 3) the columns 1, u, v; ``wedge`` (WEDGES, P) the rim seen in eight overlapping quarter
    circles, 0 or 1; ``nearest`` (P,) the wedge in whose middle a pixel lies; ``core_at`` and ``near_at`` the
    pixels of the core and those within the sensor's window.
    """

    half: int
    row: NDArray[np.int64]
    column: NDArray[np.int64]
    core: NDArray[np.bool_]
    reach: NDArray[np.bool_]
    rim: NDArray[np.bool_]
    moments: NDArray[np.float32]
    wedge: NDArray[np.float32]
    nearest: NDArray[np.int64]
    core_at: NDArray[np.int64]
    near_at: NDArray[np.int64]


def stencil_for(radius_px: float) -> Stencil:
    """The stencil of discs of about this radius (to a quarter of a pixel)."""
    return _stencil(max(4, round(4.0 * radius_px)))


@lru_cache(maxsize=64)
def _stencil(quarters: int) -> Stencil:
    radius = quarters / 4.0
    half = max(int(np.ceil(_RIM_TO * radius)), EDGE_REACH_PX)
    offset = np.arange(-half, half + 1)
    row, column = (grid.ravel() for grid in np.meshgrid(offset, offset, indexing="ij"))
    distance = np.hypot(row, column)
    rim = (distance >= _RIM_FROM * radius) & (distance <= _RIM_TO * radius)
    angle = np.arctan2(row, column)
    middle = np.arange(WEDGES) * (2.0 * np.pi / WEDGES)
    apart = np.abs((angle - middle[:, None] + np.pi) % (2.0 * np.pi) - np.pi)
    wedge = (apart <= 2.0 * np.pi / WEDGES + 1e-9) & rim
    moments = np.stack((np.ones(row.size), column, row), axis=1)
    core = distance <= _CORE * radius + 0.25
    return Stencil(
        half,
        row,
        column,
        core,
        distance <= _REACH * radius + 0.5,
        rim,
        moments.astype(np.float32),
        wedge.astype(np.float32),
        apart.argmin(axis=0),
        np.flatnonzero(core),
        np.flatnonzero(distance <= EDGE_REACH_PX),
    )


def window_pixels(
    stencil: Stencil, centre_px: FloatArray, shape: tuple[int, ...]
) -> tuple[NDArray[np.int64], NDArray[np.bool_], FloatArray]:
    """Flat indices (B, P) into a picture of ``shape``, which of them are inside it, and the middles (B, 2)."""
    middle = np.rint(centre_px)
    column = middle[:, 0:1].astype(np.int64) + stencil.column
    row = middle[:, 1:2].astype(np.int64) + stencil.row
    inside = (column >= 0) & (column < shape[1]) & (row >= 0) & (row < shape[0])
    if inside.all():
        return row * shape[1] + column, inside, middle
    flat = np.clip(row, 0, shape[0] - 1) * shape[1] + np.clip(column, 0, shape[1] - 1)
    return flat, inside, middle

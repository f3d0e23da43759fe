"""Centres and depths of blobs, all of them at once.

Around each blob a small round window is cut out. Inside it the share of paper in every pixel follows from
unmixing its colour between the blob's own middle and its own rim, so that light, tilt and half covered
edge pixels do not pull the centre.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.depth_sensor import DepthSensor
from carpus.core.detection.settings import DetectionSettings
from carpus.core.detection.stencil import WEDGES, Stencil
from carpus.core.types import FloatArray

DEPTH_VALID_SHARE = 0.3
"""With fewer of its pixels read a blob's depth is not trusted (reference 7.2)."""
DEPTH_IQR_M = 0.008
"""Nor is one whose readings spread by more (reference 7.2)."""
SLOPE_SHARE = 0.35
"""On a steep surface half a pixel between the two pictures is a depth error of this share of the spread."""
EDGE_STEP_M = 0.015
"""A reading this far from the blob's is of another surface."""
EDGE_SD_M = 0.008
"""The depth's sd if all around were of another."""
MIN_READINGS = 3
"""So many make a depth."""
PAPER_LOW = 0.2
"""Shares of paper in a pixel below count as none; with :data:`PAPER_HIGH` symmetric, so an edge's centre stays."""
PAPER_HIGH = 0.8
"""Shares of paper in a pixel above count as all."""
MIN_RIM = 3.0
"""With fewer pixels in a direction of the rim all of the rim is taken."""
MIN_CORE = 4.0
"""With fewer pixels in the core all of the blob is taken."""

_QUARTERS = np.arange(1, 4)[:, None]
_BEYOND_M = 1e3
"""Stands for no reading among readings in order."""


@dataclass(frozen=True, slots=True)
class Outline:
    """Which pixels of its window belong to each blob: ``mine`` (B, P); ``counted`` (B, P) those that may hold some of
    it; ``rim`` (B, R) those of the stencil's rim that belong to no blob."""

    mine: NDArray[np.bool_]
    counted: NDArray[np.bool_]
    rim: NDArray[np.bool_]


def outlines(
    labels: NDArray[np.uint16], own: NDArray[np.uint16], inside: NDArray[np.bool_] | None, stencil: Stencil
) -> Outline:
    """Outlines from the windows (B, P) of the label picture and the blobs' own labels (B,)."""
    mine = labels == own[:, None]
    free = labels == 0
    if inside is not None:  # off the picture a window repeats its border
        mine &= inside
        free &= inside
    counted = free & stencil.reach
    counted |= mine
    return Outline(mine, counted, free[:, stencil.rim])


def refined_centres(
    color: NDArray[np.float32], outline: Outline, stencil: Stencil, settings: DetectionSettings
) -> tuple[FloatArray, FloatArray]:
    """Weighted centres (B, 2) from the middles of the windows, and areas (B,) in pixels.

    ``color`` (B, P, 4) windows of the picture: red, green, blue and 1. What surrounds a pixel's blob is looked up in
    the pixel's own direction: at the edge of the hand one side of a disc lies on skin and the other before the table.
    """
    total = _totals(color, outline, stencil)
    low, high = PAPER_LOW, PAPER_HIGH
    few = total[:, 3] < _fewest(MIN_RIM, MIN_CORE)
    if few.any():
        _fill_in(total, few, color, outline, stencil)
    mean = total[:, :3] / np.maximum(total[:, 3:], 1.0)
    ground = mean[..., :WEDGES]
    direction = mean[..., WEDGES:] - ground
    # Share of paper in a colour c, 0 for the ground's and 1 for the paper's, then stretched from low..high to 0..1:
    # direction (c - ground) / |direction|^2, in each direction one column of numbers for c and 1.
    direction /= (high - low) * np.maximum((direction * direction).sum(axis=1, keepdims=True), 1.0)
    unmix = np.empty((color.shape[0], 4, WEDGES), dtype=np.float32)
    unmix[:, :3] = direction
    np.subtract(-low / (high - low), (direction * ground).sum(axis=1), out=unmix[:, 3])
    share = (color @ unmix).reshape(color.shape[0], -1).take(stencil.pick, axis=1)
    np.maximum(share, 0.0, out=share)
    np.minimum(share, 1.0, out=share)
    share *= outline.counted
    moments = (share @ stencil.moments).astype(np.float64)
    area = np.maximum(moments[:, 0], 1e-9)
    return moments[:, 1:] / area[:, None], area


@lru_cache(maxsize=4)
def _fewest(rim: float, core: float) -> FloatArray:
    """Pixels (WEDGES + 1) that each direction of the rim and the core must have."""
    return np.array([rim] * WEDGES + [core])


def _totals(color: NDArray[np.float32], outline: Outline, stencil: Stencil) -> NDArray[np.float32]:
    """Sums (B, 4, WEDGES + 1) of red, green, blue and 1 over the rim in eight directions and over the core."""
    total = np.empty((color.shape[0], 4, WEDGES + 1), dtype=np.float32)
    rim, core = stencil.rim, stencil.core
    seen = outline.rim[:, :, None] * stencil.wedge
    np.matmul(color[:, rim].transpose(0, 2, 1), seen, out=total[..., :WEDGES])
    np.matmul(
        color[:, core].transpose(0, 2, 1), outline.mine[:, core, None].astype(np.float32), out=total[..., WEDGES:]
    )
    return total


def _fill_in(
    total: NDArray[np.float32], few: NDArray[np.bool_], color: NDArray[np.float32], outline: Outline, stencil: Stencil
) -> None:
    """Take the whole rim for a direction in which there is almost none of it, the whole blob for such a core."""
    channels = color.transpose(0, 2, 1)
    rim, blob = (part[:, :, None].astype(np.float32) for part in (outline.rim, outline.mine))
    whole = np.empty_like(total)
    whole[..., :WEDGES] = channels[..., stencil.rim] @ rim
    whole[..., WEDGES:] = channels @ blob
    np.copyto(total, whole, where=few[:, None])


def blob_depths(
    depth_raw: NDArray[np.uint16],
    core: NDArray[np.bool_],
    unit_m: float,
    settings: DetectionSettings,
    sensor: DepthSensor,
) -> tuple[FloatArray, FloatArray]:
    """Depth (B,) and its standard deviation (B,) in metres from the blobs' cores; NaN where not trusted.

    Median of the valid readings, then the mean of those near it. Not trusted: less than 30 % valid or an
    interquartile range above 8 mm (reference 7.2). ``depth_raw`` (B, N) windows as wide as the sensor's own, from
    the middle outwards; ``core`` (B, C) which of the first C pixels are the blob's.
    """
    metres = depth_raw * unit_m
    own, inner = core.T, metres[:, : core.shape[1]].T.copy()  # (C, B)
    valid = own & (inner > 0.0)
    count = valid.sum(axis=0)
    ordered = np.where(valid, inner, _BEYOND_M)
    ordered.sort(axis=0)
    rank = _QUARTERS * (count - 1) >> 2  # without any, the last
    low, middle, high = ordered[rank, np.arange(count.size)]
    near = valid & (np.abs(inner - middle) <= DEPTH_IQR_M)
    depth = (inner * near).sum(axis=0) / np.maximum(near.sum(axis=0), 1)
    iqr = high - low
    enough = np.maximum(DEPTH_VALID_SHARE * own.sum(axis=0), MIN_READINGS)
    trusted = (count >= enough) & (iqr <= DEPTH_IQR_M)
    # The sensor matches small windows: near an edge of the surface they hold two, and the depth is of neither.
    other = np.abs(metres - depth[:, None]) > EDGE_STEP_M
    edge = (EDGE_SD_M / metres.shape[1]) * other.sum(axis=1)
    slope = SLOPE_SHARE / 1.35 * iqr
    sd = np.sqrt(sensor.mean_sd_m(depth, near.sum(axis=0)) ** 2 + slope**2 + edge**2)
    if trusted.all():
        return depth, sd
    return np.where(trusted, depth, np.nan), np.where(trusted, sd, np.nan)

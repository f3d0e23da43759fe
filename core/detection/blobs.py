"""Centres and depths of blobs, all of them at once.

Around each blob a small square window is cut out. Inside it the share of paper in every pixel follows from
unmixing its colour between the blob's own middle and its own rim, so that light, tilt and half covered
edge pixels do not pull the centre.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.depth_noise import reading_sd_m
from core.detection.settings import DetectionSettings
from core.detection.stencil import Stencil
from core.types import FloatArray

_LOW, _HIGH = 0.2, 0.8
"""Shares of paper below and above these count as none and all; symmetric, so an edge's centre stays."""
_FEWEST_RIM = 3.0


@dataclass(frozen=True, slots=True)
class Outline:
    """Which pixels of its window belong to each blob: ``mine`` (B, P), ``foreign`` of another blob, ``rim`` of
    neither and in the ring around, ``core`` its own middle."""

    mine: NDArray[np.bool_]
    foreign: NDArray[np.bool_]
    rim: NDArray[np.bool_]
    core: NDArray[np.bool_]


def outlines(
    labels: NDArray[np.uint16], own: NDArray[np.int64], inside: NDArray[np.bool_], stencil: Stencil
) -> Outline:
    """Outlines from the windows (B, P) of the label picture and the blobs' own labels (B,)."""
    mine = labels == own[:, None]
    free = labels == 0
    foreign = ~(mine | free)
    core = mine & stencil.core
    few = core.sum(axis=1) < 4
    if few.any():
        core[few] = mine[few]
    return Outline(mine, foreign, free & stencil.rim & inside, core)


def refined_centres(
    color: NDArray[np.float32], outline: Outline, inside: NDArray[np.bool_], stencil: Stencil
) -> tuple[FloatArray, FloatArray]:
    """Weighted centres (B, 2) from the middles of the windows, and areas (B,) in pixels.

    ``color`` (B, P, 3) windows of the picture. What surrounds a pixel's blob is looked up in the pixel's own
    direction: at the edge of the hand one side of a disc lies on skin and the other before the table.
    """
    paper = _mean(color, outline.core)
    ground = _ground(color, outline.rim, stencil)
    direction = paper[:, None, :] - ground
    weight = direction / np.maximum((direction * direction).sum(axis=2, keepdims=True), 1.0)
    level = (weight * ground).sum(axis=2)
    nearest = stencil.nearest
    share = np.einsum("bpc,bpc->bp", color, weight[:, nearest]) - level[:, nearest]
    np.clip((share - _LOW) * (1.0 / (_HIGH - _LOW)), 0.0, 1.0, out=share)
    share *= (stencil.reach & inside & ~outline.foreign) | outline.mine
    moments = share @ stencil.moments
    area = np.maximum(moments[:, 0], 1e-9)
    return np.asarray(moments[:, 1:] / area[:, None], dtype=np.float64), np.asarray(area, dtype=np.float64)


def _ground(color: NDArray[np.float32], rim: NDArray[np.bool_], stencil: Stencil) -> NDArray[np.float32]:
    """Colour (B, WEDGES, 3) of the rim in eight directions; that of the whole rim where one is empty."""
    wedge = stencil.wedge * rim[:, None, :]
    count = wedge.sum(axis=2)[..., None]
    mean = (wedge @ color) / np.maximum(count, 1.0)
    if (count < _FEWEST_RIM).any():
        return np.where(count < _FEWEST_RIM, _mean(color, rim)[:, None, :], mean)
    return np.asarray(mean)


def _mean(color: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    weight = mask.astype(np.float32)
    total = (weight[:, None, :] @ color)[:, 0]
    return np.asarray(total / np.maximum(weight.sum(axis=1), 1.0)[:, None])


def blob_depths(
    depth_raw: NDArray[np.uint16], core: NDArray[np.bool_], unit_m: float, stencil: Stencil, settings: DetectionSettings
) -> tuple[FloatArray, FloatArray]:
    """Depth (B,) and its standard deviation (B,) in metres from the blobs' cores; NaN where not trusted.

    Median of the valid readings, then the mean of those near it. Not trusted: less than 30 % valid or an
    interquartile range above 8 mm (reference 7.2). ``depth_raw`` and ``core`` (B, P) windows.
    """
    metres = depth_raw * unit_m
    inner, own = metres[:, stencil.core_at], core[:, stencil.core_at]
    valid = own & (inner > 0.0)
    count = valid.sum(axis=1)
    ordered = np.sort(np.where(valid, inner, np.inf), axis=1)
    blob = np.arange(count.size)
    last = np.maximum(count - 1, 0)
    low, middle, high = ordered[blob, last // 4], ordered[blob, last // 2], ordered[blob, 3 * last // 4]
    some = count >= 3
    middle = np.where(some, middle, 0.0)
    near = valid & (np.abs(inner - middle[:, None]) <= settings.depth_iqr_m)
    depth = np.where(near, inner, 0.0).sum(axis=1) / np.maximum(near.sum(axis=1), 1)
    iqr = np.where(some, high, 0.0) - np.where(some, low, 0.0)
    trusted = some & (count >= settings.depth_valid_share * own.sum(axis=1)) & (iqr <= settings.depth_iqr_m)
    # The sensor matches small windows: near an edge of the surface they hold two, and the depth is of neither.
    other = np.abs(metres[:, stencil.near_at] - depth[:, None]) > settings.edge_step_m
    edge = settings.edge_sd_m * other.mean(axis=1)
    # Readings a few pixels apart share one correlation window of the sensor: together they count as one.
    slope = settings.slope_share / 1.35 * iqr
    sd = np.sqrt(reading_sd_m(depth) ** 2 + slope**2 + edge**2)
    return np.where(trusted, depth, np.nan), np.where(trusted, sd, np.nan)

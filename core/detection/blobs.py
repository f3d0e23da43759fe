"""Centres and depths of blobs, all of them at once.

Around each blob a small square window is cut out. Inside it the share of paper in every pixel follows from
unmixing its colour between the blob's own middle and its own rim, so that light, tilt and half covered
edge pixels do not pull the centre.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from core.depth_noise import reading_sd_m
from core.detection.settings import DetectionSettings
from core.types import FloatArray

_LOW, _HIGH = 0.2, 0.8
"""Shares of paper below and above these count as none and all; symmetric, so an edge's centre stays."""


EDGE_REACH_PX = 6
"""The sensor's matching window reaches this far, and windows are cut at least as wide."""


@dataclass(frozen=True, slots=True)
class Windows:
    """Square cut-outs of B blobs: rows and columns (B, w) in the picture, offsets (w,) from the middle."""

    rows: NDArray[np.int64]
    columns: NDArray[np.int64]
    inside: NDArray[np.bool_]
    middle_px: FloatArray

    def cut(self, picture: NDArray[np.generic]) -> NDArray[np.generic]:
        """The windows (B, w, w[, channels]) of a picture."""
        return picture[self.rows[:, :, None], self.columns[:, None, :]]


def windows_around(centre_px: FloatArray, half_px: int, shape: tuple[int, ...]) -> Windows:
    """Windows of 2 half + 1 pixels around rounded centres (B, 2); ``inside`` masks what is off the picture."""
    middle = np.rint(centre_px).astype(np.int64)
    offset = np.arange(-half_px, half_px + 1)
    rows = middle[:, 1:2] + offset
    columns = middle[:, 0:1] + offset
    row_in = (rows >= 0) & (rows < shape[0])
    column_in = (columns >= 0) & (columns < shape[1])
    return Windows(
        np.clip(rows, 0, shape[0] - 1),
        np.clip(columns, 0, shape[1] - 1),
        row_in[:, :, None] & column_in[:, None, :],
        middle.astype(np.float64),
    )


def refined_centres(
    color: NDArray[np.float32],
    labels: NDArray[np.int32],
    own: NDArray[np.int32],
    windows: Windows,
    centre_px: FloatArray,
    radius_px: float,
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
    """Weighted centres (B, 2), areas in pixels (B,), rim and core masks (B, w, w).

    ``color`` (B, w, w, 3) windows of the picture, ``labels`` (B, w, w) of the blobs, ``own`` (B,) their labels.
    """
    offset = np.arange(labels.shape[1], dtype=np.float64) - labels.shape[1] // 2
    u = offset[None, None, :] + windows.middle_px[:, 0, None, None] - centre_px[:, 0, None, None]
    v = offset[None, :, None] + windows.middle_px[:, 1, None, None] - centre_px[:, 1, None, None]
    distance2 = u * u + v * v
    mine = labels == own[:, None, None]
    foreign = (labels > 0) & ~mine
    # The paper's own colour: the blob's pixels away from its edge.
    core = mine & (distance2 <= (0.62 * radius_px) ** 2)
    few = core.sum(axis=(1, 2)) < 4
    core[few] = mine[few]
    rim = ~mine & ~foreign & windows.inside & (distance2 <= (1.9 * radius_px) ** 2)
    rim &= distance2 >= (1.35 * radius_px) ** 2
    paper = _mean_color(color, core)
    ground = _ground(color, rim)
    direction = paper[:, None, None, :] - ground
    scale = np.maximum(np.einsum("bvuc,bvuc->bvu", direction, direction), 1.0)
    share = np.einsum("bvuc,bvuc->bvu", color - ground, direction) / scale
    share = np.clip((share - _LOW) / (_HIGH - _LOW), 0.0, 1.0)
    reach = (distance2 <= (1.35 * radius_px + 0.5) ** 2) & ~foreign & windows.inside
    weight = share * (reach | mine)
    total = np.maximum(weight.sum(axis=(1, 2)), 1e-9)
    moved_u = (weight * u).sum(axis=(1, 2)) / total
    moved_v = (weight * v).sum(axis=(1, 2)) / total
    return centre_px + np.stack((moved_u, moved_v), axis=1), total, rim, core


def _ground(color: NDArray[np.float32], rim: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Colour (B, w, w, 3) of what surrounds each pixel's blob, looked up in the pixel's own direction.

    At the edge of the hand one side of a disc lies on skin and the other before the table.
    """
    blobs, width = color.shape[:2]
    wedge, nearest = _wedges(width)
    in_wedge = (rim.reshape(blobs, 1, -1) & wedge).astype(np.float32)
    count = in_wedge.sum(axis=2)
    total = in_wedge @ color.reshape(blobs, -1, 3)
    everywhere = _mean_color(color, rim)[:, None, :]
    seen = np.where(count[..., None] >= 3, total / np.maximum(count, 1.0)[..., None], everywhere)
    return np.asarray(seen[:, nearest], dtype=np.float64)


@lru_cache(maxsize=32)
def _wedges(width: int) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Eight overlapping quarter circles (8, w * w) of a window, and the one (w, w) in whose middle a pixel lies."""
    offset = np.arange(width) - width // 2
    angle = np.arctan2(offset[:, None], offset[None, :])
    middle = np.arange(8) * (np.pi / 4.0)
    apart = np.abs((angle[None] - middle[:, None, None] + np.pi) % (2.0 * np.pi) - np.pi)
    return (apart <= np.pi / 4.0 + 1e-9).reshape(8, -1), apart.argmin(axis=0)


def _mean_color(color: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    count = np.maximum(mask.sum(axis=(1, 2)), 1)
    return np.asarray(np.einsum("bvuc,bvu->bc", color, mask.astype(np.float32)) / count[:, None], dtype=np.float64)


def blob_depths(
    depth_raw: NDArray[np.uint16], core: NDArray[np.bool_], unit_m: float, settings: DetectionSettings
) -> tuple[FloatArray, FloatArray]:
    """Depth (B,) and its standard deviation (B,) in metres from the blobs' cores; NaN where not trusted.

    Median of the valid readings, then the mean of those near it. Not trusted: less than 30 % valid or an
    interquartile range above 8 mm (reference 7.2). ``depth_raw`` and ``core`` (B, w, w).
    """
    blobs, width = core.shape[:2]
    offset2 = (np.arange(width) - width // 2) ** 2
    near_by = offset2[:, None] + offset2[None, :] <= EDGE_REACH_PX**2
    valid = core & (depth_raw > 0)
    count = valid.sum(axis=(1, 2))
    metres = np.where(valid, depth_raw * unit_m, np.inf).reshape(blobs, -1)
    ordered = np.sort(metres, axis=1)[:, : max(1, int(count.max(initial=1)))]
    row = np.arange(blobs)
    safe = np.maximum(count, 1)
    low = ordered[row, (safe - 1) // 4]
    high = ordered[row, (3 * (safe - 1)) // 4]
    middle = ordered[row, (safe - 1) // 2]
    middle = np.where(np.isfinite(middle), middle, 0.0)  # a blob without any reading has no middle
    near = np.abs(metres - middle[:, None]) <= settings.depth_iqr_m
    near_count = np.maximum(near.sum(axis=1), 1)
    depth = np.where(near, metres, 0.0).sum(axis=1) / near_count
    trusted = (count >= 3) & (count >= settings.depth_valid_share * core.sum(axis=(1, 2)))
    with np.errstate(invalid="ignore"):
        trusted &= (high - low) <= settings.depth_iqr_m
        spread = np.where(trusted, (high - low) / 1.35, 0.0)
    # Readings a few pixels apart share one correlation window of the sensor: together they count as one.
    sd = np.sqrt(reading_sd_m(depth) ** 2 + (settings.slope_share * spread) ** 2)
    # The sensor matches small windows: near an edge of the surface they hold two, and the depth is of neither.
    everything = depth_raw * unit_m
    other = np.abs(everything - depth[:, None, None]) > settings.edge_step_m
    edge_share = (other & near_by).sum(axis=(1, 2)) / max(int(near_by.sum()), 1)
    sd = np.hypot(sd, settings.edge_sd_m * edge_share)
    return np.where(trusted, depth, np.nan), np.where(trusted, sd, np.nan)

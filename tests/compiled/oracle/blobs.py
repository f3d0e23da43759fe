"""``core/compiled/blobs.py`` in NumPy, all blobs at once."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.blobs import (
    BLURRED_EDGE_PX,
    DEPTH_IQR_M,
    DEPTH_VALID_SHARE,
    EDGE_SD_M,
    EDGE_STEP_M,
    LONG_AXIS_RADII,
    LONG_SIDE_RADII,
    MAX_PARTS,
    MIN_CORE,
    MIN_READINGS,
    MIN_RIM,
    PAPER_HIGH,
    PAPER_LOW,
    SLOPE_SHARE,
    SPLIT_ROUNDS,
)
from carpus.core.detection.components import Components
from carpus.core.detection.detector import ColorTable
from carpus.core.detection.stencil import WEDGES, Stencil
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.types import BoolArray, ByteImage, DepthImage, FloatArray

_QUARTERS = np.arange(1, 4)[:, None]
_BEYOND_M = 1e3
"""Stands for no reading among readings in order."""


def mask_paper(hsv: ByteImage, is_paper: NDArray[np.uint8], darkest: float) -> ByteImage:
    look = hsv[..., 0] + 256 * hsv[..., 1].astype(int)
    return np.where(hsv[..., 2] > darkest, is_paper[look], 0).astype(np.uint8)


def find_blobs(
    mask: ByteImage, radius_at: Callable[[FloatArray], FloatArray], min_share: float, max_share: float
) -> tuple[NDArray[np.int32], NDArray[np.int32], FloatArray, FloatArray, FloatArray]:
    count, labels = _labelled(mask)
    found = []
    for label in range(1, count + 1):
        row, column = np.nonzero(labels == label)
        found.append((column.mean(), row.mean(), float(row.size)))
    facts = np.array(found).reshape(count, 3)
    radius = radius_at(facts[:, :2])
    following = count + 1
    for label in range(1, count + 1):
        row, column = np.nonzero(labels == label)
        side = max(np.ptp(row), np.ptp(column)) + 1
        if not side > LONG_SIDE_RADII * (radius[label - 1] + BLURRED_EDGE_PX):
            continue
        part = parts_of(column - column.min(), row - row.min(), float(radius[label - 1]))
        if part is None:
            continue
        area = np.bincount(part)
        own = np.array([label, *range(following, following + area.size - 1)])
        following += area.size - 1
        labels[row, column] = own[part]
        new = np.stack((np.bincount(part, column) / area, np.bincount(part, row) / area, area), axis=1)
        facts[label - 1] = new[0]
        facts = np.concatenate((facts, new[1:]))
        radius = np.concatenate((radius, np.full(area.size - 1, radius[label - 1])))
    share = facts[:, 2] / (np.pi * radius**2)
    fits = np.flatnonzero((share >= min_share) & (share <= max_share))
    return labels, (fits + 1).astype(np.int32), facts[fits, :2], facts[fits, 2], radius[fits]


def _labelled(mask: ByteImage) -> tuple[int, NDArray[np.int32]]:
    """By OpenCV, numbered by the first pixel of each, row by row."""
    count, labels = cv2.connectedComponents(mask, connectivity=8, ltype=cv2.CV_32S)
    kept = np.flatnonzero(labels)
    own, first = np.unique(labels.ravel()[kept], return_index=True)
    number = np.zeros(count, dtype=np.int32)
    number[own[np.argsort(first)]] = np.arange(1, count)
    return count - 1, number[labels]


def parts_of(u: NDArray[np.int64], v: NDArray[np.int64], radius_px: float) -> NDArray[np.int64] | None:
    """Part of every pixel (P,), or None for a blob that is one disc or much more than a few of them."""
    count = u.size
    mean_u, mean_v = int(u.sum()) / count, int(v.sum()) / count
    xx, xy = int((u * u).sum()) / count - mean_u * mean_u, int((u * v).sum()) / count - mean_u * mean_v
    yy = int((v * v).sum()) / count - mean_v * mean_v
    half_gap = math.hypot(0.5 * (xx - yy), xy)
    if math.sqrt(0.5 * (xx + yy) + half_gap) <= LONG_AXIS_RADII * (radius_px + BLURRED_EDGE_PX):
        return None
    tilt = 0.5 * math.atan2(2.0 * xy, xx - yy)
    across, down = math.cos(tilt), math.sin(tilt)
    along = u * across + v * down
    low, high = float(along.min()), float(along.max())
    longest = max(2, round((high - low - 2.0 * radius_px) / (2.0 * radius_px)) + 1)
    if longest > MAX_PARTS + 1:
        return None
    best: NDArray[np.int64] | None = None
    least = math.inf
    for parts in range(max(2, longest - 1), min(longest, MAX_PARTS) + 1):
        if parts == 2:
            part: NDArray[np.int64] | None = np.asarray(along > 0.5 * (high + low), dtype=np.int64)
        else:
            gap = (high - low - 2.0 * radius_px) / (parts - 1)
            place = low + radius_px - (mean_u * across + mean_v * down) + gap * np.arange(parts)
            part = _about(u, v, np.array((mean_u + place * across, mean_v + place * down)))
        if part is not None and (elongation := _elongation(u, v, part)) < least:
            best, least = part, elongation
    return best


def _about(u: NDArray[np.int64], v: NDArray[np.int64], middle: FloatArray) -> NDArray[np.int64] | None:
    part: NDArray[np.int64] | None = None
    for _ in range(SPLIT_ROUNDS):
        across, down = u - middle[0][:, None], v - middle[1][:, None]
        before, part = part, np.sqrt(across * across + down * down).argmin(axis=0)
        area = np.bincount(part, minlength=middle.shape[1])
        if area.min() == 0:
            return None
        if before is not None and (part == before).all():
            break
        middle = np.array((np.bincount(part, u), np.bincount(part, v))) / area
    return part


def _elongation(u: NDArray[np.int64], v: NDArray[np.int64], part: NDArray[np.int64]) -> float:
    area = np.bincount(part)
    along, down, *squares = (np.bincount(part, each) for each in (u, v, u * u, v * v, u * v))
    uu, vv, uv = squares[0] - along * along / area, squares[1] - down * down / area, squares[2] - along * down / area
    return float(np.mean(np.hypot(uu - vv, 2.0 * uv) / np.maximum(uu + vv, 1e-12)))


@dataclass(frozen=True, slots=True)
class Windows:
    """``row`` and ``column`` (B, P) of windows that repeat the border off the picture; ``mine`` and ``free`` (B, P)
    which of their pixels are the blob's own and nobody's; ``middle`` (B, 2)."""

    row: NDArray[np.int64]
    column: NDArray[np.int64]
    mine: BoolArray
    free: BoolArray
    middle: FloatArray


def windows(blobs: Components, stencil: Stencil) -> Windows:
    height, width = blobs.labels.shape
    middle = np.rint(blobs.centre_px)
    at = middle.astype(np.int64)
    row, column = at[:, 1:] + stencil.offset[:, 0], at[:, :1] + stencil.offset[:, 1]
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    row, column = np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)
    labels = blobs.labels[row, column]
    return Windows(row, column, inside & (labels == blobs.label[:, None]), inside & (labels == 0), middle)


def compare_colors(
    hsv: ByteImage, blobs: Components, stencil: Stencil, table: ColorTable
) -> tuple[FloatArray, FloatArray]:
    seen = windows(blobs, stencil)
    look = hsv[seen.row, seen.column, 0] + 256 * hsv[seen.row, seen.column, 1].astype(int)
    rim = seen.free[:, stencil.rim]
    skin_share = (table.is_skin[look[:, stencil.rim]] * rim).sum(axis=1) / np.maximum(rim.sum(axis=1), 1)
    total, cells = len(blobs.label), table.root_of_share.size
    cell = table.cell[look] + cells * np.arange(total)[:, None]
    counts = np.bincount(cell.ravel(), seen.mine.ravel(), total * cells).reshape(total, cells)
    area = np.maximum(seen.mine.sum(axis=1), 1)
    return np.sqrt(counts) @ table.root_of_share / np.sqrt(area), skin_share


def locate_centres(color: ByteImage, blobs: Components, stencil: Stencil) -> tuple[FloatArray, FloatArray]:
    seen = windows(blobs, stencil)
    channels = np.ones((*seen.row.shape, 4))
    channels[..., :3] = color[seen.row, seen.column]
    rim, core = channels[:, stencil.rim] * seen.free[:, stencil.rim, None], channels[:, stencil.core]
    total = np.empty((len(blobs.label), 4, WEDGES + 1))
    total[..., :WEDGES] = rim.transpose(0, 2, 1) @ stencil.wedge
    total[..., WEDGES] = (core * seen.mine[:, stencil.core, None]).sum(axis=1)
    whole = np.empty_like(total)
    whole[..., :WEDGES] = rim.sum(axis=1)[..., None]
    whole[..., WEDGES] = (channels * seen.mine[..., None]).sum(axis=1)
    total = np.where(total[:, 3:] < np.array([MIN_RIM] * WEDGES + [MIN_CORE]), whole, total)
    mean = total[:, :3] / np.maximum(total[:, 3:], 1.0)
    ground = mean[..., :WEDGES]
    direction = mean[..., WEDGES:] - ground
    direction /= (PAPER_HIGH - PAPER_LOW) * np.maximum((direction * direction).sum(axis=1, keepdims=True), 1.0)
    level = -PAPER_LOW / (PAPER_HIGH - PAPER_LOW) - (direction * ground).sum(axis=1)
    every = channels[..., :3] @ direction + level[:, None]
    share = np.clip(every[:, np.arange(len(stencil.offset)), stencil.direction], 0.0, 1.0)
    share *= seen.mine | (seen.free & stencil.reach)
    area = np.maximum(share.sum(axis=1), 1e-9)
    return seen.middle + share @ stencil.offset[:, ::-1] / area[:, None], area


def read_depths(
    depth_raw: DepthImage, unit_m: float, blobs: Components, stencil: Stencil, sensor: DepthSensor
) -> tuple[FloatArray, FloatArray]:
    seen = windows(blobs, stencil)
    metres = depth_raw[seen.row, seen.column][:, stencil.near] * unit_m
    own, inner = seen.mine[:, stencil.core].T, metres[:, stencil.core].T  # (C, B)
    valid = own & (inner > 0.0)
    count = valid.sum(axis=0)
    ordered = np.sort(np.where(valid, inner, _BEYOND_M), axis=0)
    rank = _QUARTERS * (count - 1) >> 2  # without any, the last
    low, middle, high = ordered[rank, np.arange(count.size)]
    near = valid & (np.abs(inner - middle) <= DEPTH_IQR_M)
    depth = (inner * near).sum(axis=0) / np.maximum(near.sum(axis=0), 1)
    iqr = high - low
    enough = np.maximum(DEPTH_VALID_SHARE * own.sum(axis=0), MIN_READINGS)
    trusted = (count >= enough) & (iqr <= DEPTH_IQR_M)
    other = np.abs(metres - depth[:, None]) > EDGE_STEP_M
    edge = (EDGE_SD_M / metres.shape[1]) * other.sum(axis=1)
    slope = SLOPE_SHARE / 1.35 * iqr
    sd = np.sqrt(sensor.mean_sd_m(depth, near.sum(axis=0)) ** 2 + slope**2 + edge**2)
    return np.where(trusted, depth, np.nan), np.where(trusted, sd, np.nan)

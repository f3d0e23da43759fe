"""Connected components of paper colour, touching discs taken apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.types import ByteImage, FloatArray

LONG_SIDE_RADII = 2.8
"""A blob whose box is longer is more than one disc, facing any way."""
LONG_AXIS_RADII = 0.72
"""So is one whose pixels scatter more along their main axis; of a disc it is one half."""
BLURRED_EDGE_PX = 0.5
"""By so much a blurred edge widens every disc, large or small."""
SPLIT_ROUNDS = 6
"""A long blob is taken apart in so many rounds."""
MAX_PARTS = 4
"""At most, as a row of knuckles; what is longer than one more would be is none of discs."""


def split_touching(
    labels: NDArray[np.uint16], stats: NDArray[np.int32], radius_px: FloatArray
) -> list[tuple[int, NDArray[np.int64], FloatArray]]:
    """Take apart the blobs that are longer than a disc; ``labels`` (H, W) is changed in place.

    ``stats`` (L, 5) left, top, width, height, area of every label, ``radius_px`` (L,) of a disc at its depth.
    Returns per split blob its label, the parts' labels (P,) and their centres and areas (P, 3): u, v, area;
    the first part keeps the label.
    """
    out: list[tuple[int, NDArray[np.int64], FloatArray]] = []
    following = len(stats)
    is_long = np.maximum(stats[:, 2], stats[:, 3]) > LONG_SIDE_RADII * (radius_px + BLURRED_EDGE_PX)
    is_long[0] = False  # the background
    for label in np.flatnonzero(is_long).tolist():
        left, top, width, height, _ = stats[label].tolist()
        box = labels[top : top + height, left : left + width]
        row, column = np.nonzero(box == label)
        parts = _parts(column, row, float(radius_px[label]))
        if parts is None:
            continue
        area = np.bincount(parts)
        own = np.array([label, *range(following, following + area.size - 1)])
        following += area.size - 1
        box[row, column] = own[parts]
        facts = np.empty((area.size, 3))
        facts[:, 2] = area
        facts[:, 0] = np.bincount(parts, column + left) / area
        facts[:, 1] = np.bincount(parts, row + top) / area
        out.append((label, own, facts))
    return out


def _parts(u: NDArray[np.int64], v: NDArray[np.int64], radius_px: float) -> NDArray[np.int64] | None:
    """Part of every pixel (P,), or None for a blob that is one disc or much more than a few of them.

    Sums are of whole numbers, and all else is in the order of the kernel: a pixel just between two parts goes to the
    same one.
    """
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
    # Blurred edges make small discs larger than they are, so a row of them may hold one less than its length says.
    for parts in range(max(2, longest - 1), min(longest, MAX_PARTS) + 1):
        if parts == 2:
            # Two discs: the line between them crosses the main axis in the middle of the blob.
            part: NDArray[np.int64] | None = np.asarray(along > 0.5 * (high + low), dtype=np.int64)
        else:
            gap = (high - low - 2.0 * radius_px) / (parts - 1)
            place = low + radius_px - (mean_u * across + mean_v * down) + gap * np.arange(parts)
            part = _about(u, v, np.array((mean_u + place * across, mean_v + place * down)), SPLIT_ROUNDS)
        if part is not None and (elongation := _elongation(u, v, part)) < least:
            best, least = part, elongation
    return best


def _about(u: NDArray[np.int64], v: NDArray[np.int64], middle: FloatArray, rounds: int) -> NDArray[np.int64] | None:
    """Part of every pixel (P,), first about these middles (2, parts); None where one of them would have no pixel."""
    part: NDArray[np.int64] | None = None
    for _ in range(rounds):
        before, part = part, _nearest(u, v, middle)
        area = np.bincount(part, minlength=middle.shape[1])
        if area.min() == 0:
            return None
        if before is not None and (part == before).all():
            break
        middle = np.array((np.bincount(part, u), np.bincount(part, v))) / area
    return part


def _elongation(u: NDArray[np.int64], v: NDArray[np.int64], part: NDArray[np.int64]) -> float:
    """Of the parts in the mean: 0 for discs, 1 for lines."""
    area = np.bincount(part)
    along, down, *squares = (np.bincount(part, each) for each in (u, v, u * u, v * v, u * v))
    uu, vv, uv = squares[0] - along * along / area, squares[1] - down * down / area, squares[2] - along * down / area
    return float(np.mean(np.hypot(uu - vv, 2.0 * uv) / np.maximum(uu + vv, 1e-12)))


def _nearest(u: NDArray[np.int64], v: NDArray[np.int64], middle: FloatArray) -> NDArray[np.int64]:
    """Index of the middle (2, parts) nearest to every point (P,)."""
    across, down = u - middle[0][:, None], v - middle[1][:, None]
    across *= across
    down *= down
    across += down
    return np.asarray(np.sqrt(across, out=across).argmin(axis=0))


@dataclass(frozen=True, slots=True)
class Components:
    """``labels`` (H, W), 0 where there is no blob; per blob its ``label`` (B,), ``centre_px`` (B, 2) and
    ``area_px`` (B,) of whole pixels, and the ``radius_px`` (B,) of a disc at its depth."""

    labels: NDArray[np.uint16]
    label: NDArray[np.uint16]
    centre_px: FloatArray
    area_px: FloatArray
    radius_px: FloatArray


def components(mask: ByteImage, radius_at: Callable[[FloatArray], FloatArray]) -> Components:
    """Blobs of a mask; ``radius_at`` gives the radius (B,) of a disc facing the camera at pixels (B, 2)."""
    # 16-bit labels are three times quicker than the default.
    count, found, table, middle = cv2.connectedComponentsWithStats(mask, connectivity=8, ltype=cv2.CV_16U)
    labels = np.asarray(found, dtype=np.uint16)
    stats = np.asarray(table, dtype=np.int32)[:count]
    centre = np.asarray(middle, dtype=np.float64)[:count]
    centre[0] = 0.0  # the background has no place
    radius = radius_at(centre)
    label = np.arange(count, dtype=np.uint16)
    area = stats[:, cv2.CC_STAT_AREA].astype(np.float64)
    split = split_touching(labels, stats, radius)
    for whole, _, facts in split:
        centre[whole], area[whole] = facts[0, :2], facts[0, 2]
    if split:
        added = np.concatenate([facts[1:] for _, _, facts in split])
        centre, area = np.concatenate((centre, added[:, :2])), np.concatenate((area, added[:, 2]))
        radius = np.concatenate((radius, *(np.full(len(own) - 1, radius[whole]) for whole, own, _ in split)))
        label = np.arange(count + len(added), dtype=np.uint16)
    return Components(labels, label[1:], centre[1:], area[1:], radius[1:])

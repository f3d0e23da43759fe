"""Discs that touch in the picture and come out as one blob are taken apart again."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.types import FloatArray


@dataclass(frozen=True, slots=True)
class TouchingSettings:
    """A blob's box longer than ``long_side`` radii is more than one disc facing any way; so is one whose pixels scatter
    along their main axis by more than ``long_axis`` radii (a disc: one half). ``edge_px``: by so much a blurred edge
    widens every disc, large or small. It is taken apart in ``rounds``, into ``most_parts`` at most (a row of knuckles);
    what is longer than one more would be is none of discs."""

    long_side: float = 2.8
    long_axis: float = 0.72
    edge_px: float = 0.5
    rounds: int = 6
    most_parts: int = 4


def split_touching(
    labels: NDArray[np.uint16], stats: NDArray[np.int32], radius_px: FloatArray, settings: TouchingSettings
) -> list[tuple[int, NDArray[np.int64], FloatArray]]:
    """Take apart the blobs that are longer than a disc; ``labels`` (H, W) is changed in place.

    ``stats`` (L, 5) left, top, width, height, area of every label, ``radius_px`` (L,) of a disc at its depth.
    Returns per split blob its label, the parts' labels (P,) and their centres and areas (P, 3): u, v, area;
    the first part keeps the label.
    """
    out: list[tuple[int, NDArray[np.int64], FloatArray]] = []
    following = len(stats)
    is_long = np.maximum(stats[:, 2], stats[:, 3]) > settings.long_side * (radius_px + settings.edge_px)
    is_long[0] = False  # the background
    for label in np.flatnonzero(is_long).tolist():
        left, top, width, height, _ = stats[label].tolist()
        box = labels[top : top + height, left : left + width]
        row, column = np.nonzero(box == label)
        points = np.empty((row.size, 2))
        np.add(column, left, out=points[:, 0])
        np.add(row, top, out=points[:, 1])
        parts = _parts(points, float(radius_px[label]), settings)
        if parts is None:
            continue
        area = np.bincount(parts)
        own = np.array([label, *range(following, following + area.size - 1)])
        following += area.size - 1
        box[row, column] = own[parts]
        facts = np.empty((area.size, 3))
        facts[:, 2] = area
        for axis in (0, 1):
            facts[:, axis] = np.bincount(parts, points[:, axis]) / area
        out.append((label, own, facts))
    return out


def _parts(points: FloatArray, radius_px: float, settings: TouchingSettings) -> NDArray[np.int64] | None:
    """Part of every pixel (P, 2), or None for a blob that is one disc or much more than a few of them."""
    centre = points.sum(axis=0) / len(points)
    centred = points - centre
    (xx, xy), (_, yy) = (centred.T @ centred / len(points)).tolist()
    half_gap = math.hypot(0.5 * (xx - yy), xy)
    if math.sqrt(0.5 * (xx + yy) + half_gap) <= settings.long_axis * (radius_px + settings.edge_px):
        return None
    tilt = 0.5 * math.atan2(2.0 * xy, xx - yy)
    axis = np.array([math.cos(tilt), math.sin(tilt)])
    along = centred @ axis
    length = float(along.max() - along.min())
    count = max(2, round((length - 2.0 * radius_px) / (2.0 * radius_px)) + 1)
    if count > settings.most_parts + 1:
        return None
    # Blurred edges make small discs larger than they are, so a row of them may hold one less than its length says.
    tried = [
        _taken_apart(points, along, centre, axis, n, radius_px, settings)
        for n in range(max(2, count - 1), min(count, settings.most_parts) + 1)
    ]
    return min((part for part in tried if part is not None), key=lambda part: _elongation(points, part), default=None)


def _taken_apart(
    points: FloatArray,
    along: FloatArray,
    centre: FloatArray,
    axis: FloatArray,
    count: int,
    radius_px: float,
    settings: TouchingSettings,
) -> NDArray[np.int64] | None:
    """Part of every pixel (P, 2) of a row of ``count`` discs, or None where one of them would have no pixel."""
    low, high = float(along.min()), float(along.max())
    if count == 2:
        # Two discs: the line between them crosses the main axis in the middle of the blob.
        return np.asarray(along > 0.5 * (high + low), dtype=np.int64)
    gap = (high - low - 2.0 * radius_px) / (count - 1)
    middle = (centre + (low + radius_px + gap * np.arange(count))[:, None] * axis).T
    u, v = points.T.copy()
    part: NDArray[np.int64] | None = None
    for _ in range(settings.rounds):
        before, part = part, _nearest(u, v, middle)
        area = np.bincount(part, minlength=count)
        if area.min() == 0:
            return None
        if before is not None and (part == before).all():
            break
        middle = np.array((np.bincount(part, u), np.bincount(part, v))) / area
    return part


def _elongation(points: FloatArray, part: NDArray[np.int64]) -> float:
    """Of the parts in the mean: 0 for discs, 1 for lines."""
    area = np.bincount(part)
    mean = [np.bincount(part, points[:, axis]) / area for axis in (0, 1)]
    u, v = (points[:, axis] - mean[axis][part] for axis in (0, 1))
    uu, vv, uv = (np.bincount(part, product) for product in (u * u, v * v, u * v))
    return float(np.mean(np.hypot(uu - vv, 2.0 * uv) / np.maximum(uu + vv, 1e-12)))


def _nearest(u: FloatArray, v: FloatArray, middle: FloatArray) -> NDArray[np.int64]:
    """Index of the middle (2, count) nearest to every point (P,)."""
    across, down = u - middle[0][:, None], v - middle[1][:, None]
    across *= across
    down *= down
    across += down
    return np.asarray(np.sqrt(across, out=across).argmin(axis=0))

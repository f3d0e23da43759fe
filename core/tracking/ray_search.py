"""Finding a finger again without any prediction: which posture of it explains the blobs that nothing else does."""

from __future__ import annotations

from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from carpus.core.tracking.hand_geometry import DISCS, RAYS, SLOTS, ray_discs_m
from carpus.core.types import FloatArray

NEAR_M = 0.012
"""How far from a posture of the grid a disc may lie: half a step of it and the noise of a depth."""
LEAST_DISCS = 2
_REACH_M = 0.015
_BACK_M, _ACROSS_M, _ABOVE_M = -0.02, 0.03, 0.05
"""How far behind its root, for the thumb across the palm, and above the palm a disc may still be seen."""


def in_reach(point_m: FloatArray, root_disc_m: FloatArray, state: FloatArray) -> NDArray[np.bool_]:
    """Whether points (..., 3) in W2 may be discs of the rays with slots and constants ``state`` (5, 16)."""
    length = state[:, SLOTS : SLOTS + DISCS].sum(axis=1) + _REACH_M
    off = point_m[..., None, :] - root_disc_m
    ahead = off[..., 0] > _BACK_M
    ahead[..., 0] &= off[..., 0, 1] > -_ACROSS_M
    return np.asarray((ahead & ((off * off).sum(axis=-1) < length**2) & (off[..., 2] < _ABOVE_M)).any(axis=-1))


@lru_cache(maxsize=1)
def _grid() -> FloatArray:
    """Postures (5, S, 5) in slots, radians: all that a ray can do, in steps of about 15 degrees."""
    thumb = list(product((-25, -5, 15, 35), (-5, 15, 35, 55), (-5, 20, 45, 70), (0,), (-10, 20, 50, 80)))
    finger = list(product((-18, -6, 6, 18), (-30, -15, 0, 15, 30, 45, 60, 75, 90), (0, 20, 40, 60, 80, 100)))
    postures = np.zeros((RAYS, max(len(thumb), len(finger)), SLOTS))
    postures[0, : len(thumb)] = thumb
    postures[1:, : len(finger), :3] = finger
    return np.asarray(np.radians(postures))


def search_rays(
    rays: NDArray[np.int64], state: FloatArray, root_disc_m: FloatArray, point_m: FloatArray
) -> dict[int, FloatArray]:
    """Slots (5,) of each of the ``rays`` that explain at least two of the blobs at ``point_m`` (B, 3) in W2.

    ``state`` (5, 16) slots and constants of all rays; ``root_disc_m`` (5, 3) discs under which they begin. No blob is
    used by two rays: the ray that explains most comes first.
    """
    length = state[:, SLOTS : SLOTS + DISCS].sum(axis=1) + _REACH_M
    near = np.linalg.norm(point_m - root_disc_m[:, None], axis=-1) < length[:, None]
    waiting = [int(ray) for ray in rays if np.count_nonzero(near[ray]) >= LEAST_DISCS]
    if not waiting:
        return {}
    postures = _grid()
    points = np.repeat(state[waiting, None], postures.shape[1], axis=1)
    points[..., :SLOTS] = postures[waiting]
    disc = dict(zip(waiting, ray_discs_m(root_disc_m[waiting], points, waiting), strict=True))
    found: dict[int, FloatArray] = {}
    free = np.ones(len(point_m), dtype=bool)
    while waiting:
        best: tuple[float, int, int, NDArray[np.int64]] | None = None
        for ray in waiting:
            reached = np.flatnonzero(free & near[ray])
            if reached.size < LEAST_DISCS:
                continue
            score, posture, used = _best_posture(disc[ray], point_m[reached])
            if used.size >= LEAST_DISCS and (best is None or score > best[0]):
                best = score, ray, posture, reached[used]
        if best is None:
            break
        _, ray, posture, used = best
        found[ray] = postures[ray, posture]
        free[used] = False
        waiting.remove(ray)
    return found


def _best_posture(disc_m: FloatArray, point_m: FloatArray) -> tuple[float, int, NDArray[np.int64]]:
    """Score, index of the posture and blobs used, for discs (S, 3, 3) of postures and blobs (B, 3)."""
    gap2 = np.sum((disc_m[:, :, None] - point_m) ** 2, axis=-1)  # (S, 3, B)
    nearest = gap2.argmin(axis=-1)
    worth = np.maximum(1.0 - np.take_along_axis(gap2, nearest[..., None], axis=-1)[..., 0] / NEAR_M**2, 0.0)
    # A blob is one disc only: the second disc that takes it is worth nothing.
    for first, second in ((0, 1), (0, 2), (1, 2)):
        same = nearest[:, first] == nearest[:, second]
        lesser = same & (worth[:, first] < worth[:, second])
        worth[lesser, first] = 0.0
        worth[same & ~lesser, second] = 0.0
    score = np.count_nonzero(worth, axis=1) + 0.3 * worth.sum(axis=1)
    best = int(np.argmax(score))
    return float(score[best]), best, nearest[best][worth[best] > 0.0]

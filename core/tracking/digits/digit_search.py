"""Search of a finger without a prediction: the posture that explains the blobs left over."""

from __future__ import annotations

from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digits import place_discs
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_DISCS, N_SLOTS

MAX_GAP_M = 0.012  # of a disc from a posture of the grid: half a step of it and the noise of a depth
MIN_DIGIT_MARKERS = 2  # that determine a digit's posture
MAX_BEYOND_M = 0.015  # a disc may still be seen beyond the length of a digit,
MAX_BEHIND_M = 0.02  # behind its root,
MAX_ACROSS_M = 0.03  # for the thumb across the palm,
MAX_ABOVE_M = 0.05  # and above the palm
NEARNESS_WEIGHT = 0.3  # of postures that explain as many discs the nearer wins, by so much of a disc at most for each
# By slot: all that a thumb can do in steps of some 20 degrees.
THUMB_GRID_DEG: tuple[tuple[float, ...], ...] = (
    (-25.0, -5.0, 15.0, 35.0),
    (-5.0, 15.0, 35.0, 55.0),
    (-5.0, 20.0, 45.0, 70.0),
    (0.0,),
    (-10.0, 20.0, 50.0, 80.0),
)
# By its first three slots: all that a finger can do in steps of about 15 degrees.
FINGER_GRID_DEG: tuple[tuple[float, ...], ...] = (
    (-18.0, -6.0, 6.0, 18.0),
    (-30.0, -15.0, 0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0),
    (0.0, 20.0, 40.0, 60.0, 80.0, 100.0),
)


def is_in_reach(point_m: FloatArray, root_disc_m: FloatArray, state: FloatArray) -> NDArray[np.bool_]:
    """Return whether points (..., 3) in W2 may be discs of the digits.

    ``state`` (5, 16) slots and constants; ``root_disc_m`` (5, 3) discs under which they begin.
    """
    length = state[:, N_SLOTS : N_SLOTS + N_DISCS].sum(axis=1) + MAX_BEYOND_M
    offset = point_m[..., None, :] - root_disc_m
    is_ahead = offset[..., 0] > -MAX_BEHIND_M
    is_ahead[..., 0] &= offset[..., 0, 1] > -MAX_ACROSS_M
    return np.asarray(
        (is_ahead & ((offset * offset).sum(axis=-1) < length**2) & (offset[..., 2] < MAX_ABOVE_M)).any(axis=-1)
    )


@lru_cache(maxsize=2)
def _build_posture_grid() -> FloatArray:
    """Return postures (5, S, 5) in slots, radians."""
    thumb, finger = list(product(*THUMB_GRID_DEG)), list(product(*FINGER_GRID_DEG))
    postures = np.zeros((N_DIGITS, max(len(thumb), len(finger)), N_SLOTS))
    postures[0, : len(thumb)] = thumb
    postures[1:, : len(finger), : len(FINGER_GRID_DEG)] = finger
    return np.asarray(np.radians(postures))


def search_digits(
    chains: NDArray[np.int64],
    state: FloatArray,
    root_disc_m: FloatArray,
    point_m: FloatArray,
) -> dict[int, FloatArray]:
    """Return slots (5,) of each digit of ``chains`` that explains at least two of the blobs.

    No blob is used by two digits: the digit that explains most comes first.

    Parameters
    ----------
    chains : (C,)
        Digits to search.
    state : (5, 16)
        Slots and constants of all digits.
    root_disc_m : (5, 3)
        Discs under which they begin.
    point_m : (B, 3)
        Blobs in W2.
    """
    length = state[:, N_SLOTS : N_SLOTS + N_DISCS].sum(axis=1) + MAX_BEYOND_M
    near = np.linalg.norm(point_m - root_disc_m[:, None], axis=-1) < length[:, None]
    remaining = [int(chain) for chain in chains if np.count_nonzero(near[chain]) >= MIN_DIGIT_MARKERS]
    if not remaining:
        return {}
    postures = _build_posture_grid()
    points = np.repeat(state[remaining, None], postures.shape[1], axis=1)
    points[..., :N_SLOTS] = postures[remaining]
    disc = dict(zip(remaining, place_discs(points, root_disc_m[remaining], remaining), strict=True))
    found: dict[int, FloatArray] = {}
    free = np.ones(len(point_m), dtype=bool)
    while remaining:
        best: tuple[float, int, int, NDArray[np.int64]] | None = None
        for chain in remaining:
            reached = np.flatnonzero(free & near[chain])
            if reached.size < MIN_DIGIT_MARKERS:
                continue
            score, posture, blobs = _find_posture(disc[chain], point_m[reached])
            if blobs.size >= MIN_DIGIT_MARKERS and (best is None or score > best[0]):
                best = score, chain, posture, reached[blobs]
        if best is None:
            break
        _, chain, posture, blobs = best
        found[chain] = postures[chain, posture]
        free[blobs] = False
        remaining.remove(chain)
    return found


def _find_posture(disc_m: FloatArray, point_m: FloatArray) -> tuple[float, int, NDArray[np.int64]]:
    """Return score, index of the posture and blobs used, for discs (S, 3, 3) and blobs (B, 3)."""
    gap2 = np.sum((disc_m[:, :, None] - point_m) ** 2, axis=-1)  # (S, 3, B)
    nearest = gap2.argmin(axis=-1)
    score_by_disc = np.maximum(1.0 - np.take_along_axis(gap2, nearest[..., None], axis=-1)[..., 0] / MAX_GAP_M**2, 0.0)
    # A blob is one disc only: the second disc that takes it is worth nothing.
    for first, second in ((0, 1), (0, 2), (1, 2)):
        same = nearest[:, first] == nearest[:, second]
        lesser = same & (score_by_disc[:, first] < score_by_disc[:, second])
        score_by_disc[lesser, first] = 0.0
        score_by_disc[same & ~lesser, second] = 0.0
    score = np.count_nonzero(score_by_disc, axis=1) + NEARNESS_WEIGHT * score_by_disc.sum(axis=1)
    best = int(np.argmax(score))
    return float(score[best]), best, nearest[best][score_by_disc[best] > 0.0]

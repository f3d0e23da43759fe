"""A spot that is no disc, clicked as one: the palm it makes is no palm's, and often the true disc lies unnamed beside.

The five other discs say where the sixth belongs. A hand is as long as its breadth lets expect, within the variety of
hands and of the places where a therapist sticks the discs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.palm_names import average_palm, misfit
from carpus.core.types import FloatArray, Side


@dataclass(frozen=True, slots=True)
class OddDiscSettings:
    """When a disc is odd.

    ``questioned``: misfit, as a share of the palm's size, from which a spot without a name may stand in for a disc;
    what does must leave less than the share ``clearly`` of it. ``no_palm``: misfit that no palm has: hands differ by up
    to 0.05, discs stuck 4 mm off by up to 0.12. A spot as near to the palm's discs as ``beside``, a share of its
    length, lies on the palm: there is one disc too many. More than ``most_spare`` of these are the discs of a whole
    hand, or a pattern; nobody is asked of each. Spots within ``same_spot_px`` of a disc are that disc; one farther than
    ``of_the_hand_m`` from the depth of the palm lies on something else. One within ``near_radii`` of a disc's middle,
    in its radii, may be the disc itself.
    """

    questioned: float = 0.08
    clearly: float = 0.6
    no_palm: float = 0.17
    beside: float = 0.18
    most_spare: int = 2
    same_spot_px: float = 4.0
    of_the_hand_m: float = 0.06
    near_radii: float = 1.6


@dataclass(frozen=True, slots=True)
class OddDisc:
    """``marker`` the row of the palm's disc in question, -1 for none; ``spot`` the row of the spot that may be it, or
    that is one too many, -1 for none; ``fits`` whether the spot makes a better palm than the disc."""

    marker: int
    spot: int
    fits: bool


def odd_disc(side: Side, palm_plan: FloatArray, spots_plan: FloatArray, settings: OddDiscSettings) -> OddDisc | None:
    """What is odd about a palm (6, 2), seen from the camera with y up, among the spots (S, 2) that have no name."""
    average = average_palm(side)
    own = misfit(average, palm_plan)
    best = (own, -1, -1)
    if own >= settings.questioned:
        for marker in range(len(palm_plan)):
            for spot in range(len(spots_plan)):
                other = palm_plan.copy()
                other[marker] = spots_plan[spot]
                best = min(best, (misfit(average, other), marker, spot))
    if best[0] < settings.clearly * own:
        return OddDisc(best[1], best[2], fits=True)
    if own >= settings.no_palm:
        return OddDisc(_worst(average, palm_plan), -1, fits=False)
    spare = _beside(palm_plan, spots_plan, settings)
    if 0 < len(spare) <= settings.most_spare:
        return OddDisc(-1, int(spare[0]), fits=False)
    return None


def _beside(palm_plan: FloatArray, spots_plan: FloatArray, settings: OddDiscSettings) -> NDArray[np.int64]:
    if not len(spots_plan):
        return np.empty(0, dtype=np.int64)
    length = float(np.linalg.norm(palm_plan[3] - palm_plan[0]))
    distance = np.linalg.norm(spots_plan[:, None] - palm_plan[None], axis=-1).min(axis=1)
    inside = np.array([_is_inside(spot, palm_plan) for spot in spots_plan])
    return np.flatnonzero(inside | (distance < settings.beside * length))


def _is_inside(spot: FloatArray, corners: FloatArray) -> bool:
    """Whether a point lies inside the ring of points: seen from it they go all the way round."""
    angles = np.sort(np.arctan2(corners[:, 1] - spot[1], corners[:, 0] - spot[0]))
    gaps = np.diff(np.append(angles, angles[0] + 2.0 * np.pi))
    return bool(gaps.max() < np.pi)


def _worst(average: FloatArray, palm_plan: FloatArray) -> int:
    """The disc without which the five others make the best palm."""
    left = [misfit(np.delete(average, k, axis=0), np.delete(palm_plan, k, axis=0)) for k in range(len(palm_plan))]
    return int(np.argmin(left))

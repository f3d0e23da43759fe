"""Is the clicked constellation the hand it claims to be?"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np

from carpus.core.calibration.palm_names import misfit
from carpus.core.hand.anatomy import REFERENCE_LENGTH_M, anatomy_from_size
from carpus.core.hand.kinematics import disc_centres
from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.types import FloatArray, Side


@dataclass(frozen=True, slots=True)
class SideSettings:
    """``good_misfit``, as a share of the constellation's size, below which nothing is questioned; the other hand must
    leave less than the share ``clearly`` of it to be called the likelier one."""

    good_misfit: float = 0.05
    clearly: float = 0.6


@lru_cache(maxsize=4)
def _average_plan(protocol: MarkerProtocol, side: Side) -> FloatArray:
    discs = disc_centres(anatomy_from_size(REFERENCE_LENGTH_M), np.zeros(17))[list(protocol.sites)]
    plan = discs[:, :2].copy()
    if side == "left":
        plan[:, 1] = -plan[:, 1]
    return plan


def plan_view(point_cam_m: FloatArray) -> FloatArray:
    """Points (M, 3) of the camera as a drawing (M, 2) seen from the camera, y up."""
    return np.stack((point_cam_m[:, 0], -point_cam_m[:, 1]), axis=1)


def _best_swap(average: FloatArray, plan: FloatArray) -> float:
    """Least misfit that exchanging two places of a plan (M, 2) leaves."""
    best = np.inf
    for i, j in combinations(range(len(plan)), 2):
        other = plan.copy()
        other[[i, j]] = other[[j, i]]
        best = min(best, misfit(average, other))
    return best


def looks_like_other_side(protocol: MarkerProtocol, side: Side, plan: FloatArray, settings: SideSettings) -> bool:
    """Whether the constellation is clearly the other hand's, and not this one's with two names swapped."""
    other: Side = "left" if side == "right" else "right"
    average = _average_plan(protocol, side)
    own = misfit(average, plan)
    mirrored = misfit(_average_plan(protocol, other), plan)
    return own >= settings.good_misfit and mirrored < settings.clearly * own and mirrored < _best_swap(average, plan)

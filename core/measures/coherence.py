"""Whether the pose of a digit that the camera does not see holds together all the same (hand paper, figure 2)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.anatomy import HARD_LIMITS_RAD
from carpus.core.measures.signals import BoolArray, stretches
from carpus.core.types import FloatArray

KNOWN_SD_RAD = math.radians(15.0)
"""A hidden joint known worse than this is a guess."""
BEYOND_LIMITS_RAD = math.radians(5.0)
"""So far an error of tracking may carry a joint beyond what any hand does (clinical reference 4.1)."""
FASTEST_RAD_S = math.radians(1000.0)
"""No joint turns faster; a pose that does has jumped (clinical reference 4.4)."""
SHORTEST_HIDDEN_S = 0.1


@dataclass(frozen=True, slots=True)
class Coherence:
    """``hidden_share`` of the frames in which something is known of the hand at all; of those hidden ones
    ``coherent_share`` and ``known_share``; ``jumps_m`` of the digit's tip in the hand's own axes at each frame in which
    it was seen again."""

    hidden_share: float
    coherent_share: float
    known_share: float
    jumps_m: tuple[float, ...]


def digit_coherence(
    time_s: FloatArray,
    names: Sequence[str],
    angles_rad: FloatArray,
    sds_rad: FloatArray,
    tip_w2_m: FloatArray,
    hidden: BoolArray,
    known: BoolArray,
) -> Coherence:
    """Of joints ``names`` (J) with ``angles_rad`` and ``sds_rad`` (N, J) and a tip (N, 3) in the hand's axes.

    ``hidden`` (N,) where the camera does not see the digit, ``known`` (N,) where the hand is tracked. A frame is
    coherent whose joints stay in the limits of a hand and do not jump, and known whose joints are so to 15 degrees, by
    their own account. As the filter told it at the time: looking back knows already where the digit was seen again.
    """
    hidden = np.logical_and(hidden, known)
    limits = np.array([HARD_LIMITS_RAD[name] for name in names])
    step_s = np.diff(time_s, prepend=time_s[:1] - 1.0) if len(time_s) else np.empty(0)
    with np.errstate(invalid="ignore"):
        inside = (angles_rad >= limits[:, 0] - BEYOND_LIMITS_RAD) & (angles_rad <= limits[:, 1] + BEYOND_LIMITS_RAD)
        turned = np.abs(np.diff(angles_rad, axis=0, prepend=angles_rad[:1])) <= FASTEST_RAD_S * step_s[:, None]
        coherent: BoolArray = np.all(inside & turned, axis=1)
        sure: BoolArray = np.all(sds_rad <= KNOWN_SD_RAD, axis=1)
    jumps = []
    for part in stretches(hidden):
        back = part.stop
        long_enough = back < len(time_s) and time_s[back] - time_s[part.start] >= SHORTEST_HIDDEN_S
        if long_enough and known[back]:
            jumps.append(float(np.linalg.norm(tip_w2_m[back] - tip_w2_m[back - 1])))
    return Coherence(
        float(hidden.sum() / known.sum()) if known.any() else math.nan,
        float(coherent[hidden].mean()) if hidden.any() else math.nan,
        float(sure[hidden].mean()) if hidden.any() else math.nan,
        tuple(jump for jump in jumps if math.isfinite(jump)),
    )

"""How skin and relief of the back of the hand leave their calibrated places, and come back.

Every number relaxes towards zero and is pushed at random (an Ornstein-Uhlenbeck process): over ``lasts_s`` it may take
any value of its scatter. What no picture tells of it stays uncertain, and widens the angles' standard deviation
instead of turning the hand. Sizes from clinical reference 2 and 10: skin over knuckles glides 2 to 6 mm, mostly along
the ray; metacarpals 4 and 5 flex by 20 and 27 degrees at most, tied to each other; the wrist's and thumb's skin 2 to 5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from carpus.core.tracking.palm_state import PALM_DISCS, RELIEF, SIZE, SKIN
from carpus.core.types import FloatArray

_WRIST, _CMC1 = 0, 1
LOOSE = np.array([4, 5])
"""MCP4 and MCP5, whose metacarpals flex."""
_KNUCKLES = range(2, 6)


@dataclass(frozen=True, slots=True)
class SoftTissue:
    """Scatter of the discs' places on the fixed unit, metres, along X (distal), across (Y) and along the normal (Z).

    ``knuckle_*`` of MCP2 and MCP3, common to neighbours by the share ``glides_together``; ``wrist_*`` and ``thumb_*``
    of WRIST and CMC1; ``cupping_m`` how far MCP4 and MCP5 sink as the arch closes, both together by the share
    ``cups_together``; besides, these glide by ``loose_along_m`` and ``loose_across_m``. ``lasts_s``: how long a
    displacement lasts. ``relief_*``: turn about X and Y and height of the surface, and how long they last.
    """

    knuckle_along_m: float = 0.0020
    knuckle_across_m: float = 0.00035
    knuckle_up_m: float = 0.0006
    glides_together: float = 0.6
    wrist_along_m: float = 0.0015
    wrist_across_m: float = 0.0003
    wrist_up_m: float = 0.0005
    thumb_m: float = 0.0012
    cupping_m: tuple[float, float] = (0.0025, 0.0055)
    loose_along_m: tuple[float, float] = (0.0025, 0.003)
    loose_across_m: tuple[float, float] = (0.0008, 0.0012)
    cups_together: float = 0.9
    lasts_s: float = 1.5
    relief_turn_rad: tuple[float, float] = (0.015, 0.009)
    relief_up_m: float = 0.0004
    relief_lasts_s: float = 4.0


@lru_cache(maxsize=8)
def settled_covariance(tissue: SoftTissue) -> FloatArray:
    """Covariance (n, n) that skin and relief have when nothing was seen for long; zero elsewhere."""
    sd = np.zeros((PALM_DISCS, 3))
    sd[_WRIST] = tissue.wrist_along_m, tissue.wrist_across_m, tissue.wrist_up_m
    sd[_CMC1] = tissue.thumb_m
    sd[2:] = tissue.knuckle_along_m, tissue.knuckle_across_m, tissue.knuckle_up_m
    sd[LOOSE, 0], sd[LOOSE, 1] = tissue.loose_along_m, tissue.loose_across_m
    own = np.zeros((PALM_DISCS, 3, PALM_DISCS, 3))
    disc, axis = np.meshgrid(np.arange(PALM_DISCS), np.arange(3), indexing="ij")
    own[disc, axis, disc, axis] = sd**2
    for one in _KNUCKLES:
        for other in _KNUCKLES:
            if one != other:
                own[one, 0, other, 0] = tissue.glides_together * sd[one, 0] * sd[other, 0]
    down = np.array(tissue.cupping_m)
    own[LOOSE[:, None], 2, LOOSE, 2] += np.outer(down, down) * (
        tissue.cups_together + (1.0 - tissue.cups_together) * np.eye(2)
    )
    out = np.zeros((SIZE, SIZE))
    out[SKIN, SKIN] = own.reshape(3 * PALM_DISCS, -1)
    relief = np.arange(RELIEF.start, RELIEF.stop)
    out[relief, relief] = np.array([*tissue.relief_turn_rad, tissue.relief_up_m]) ** 2
    return out


def keeping(tissue: SoftTissue, dt_s: float) -> FloatArray:
    """Share (n,) of each number that is left after ``dt_s``: one but for skin and relief."""
    out = np.ones(SIZE)
    out[SKIN] = math.exp(-dt_s / tissue.lasts_s)
    out[RELIEF] = math.exp(-dt_s / tissue.relief_lasts_s)
    return out

"""Soft tissue of the back of the hand: how skin and relief leave their calibrated places.

Tissue rests most of the time, and moves as fingers, thumb or wrist do: what it does is a mode of the filter. *Home* it
lies as calibrated; *still* what was displaced stays where it is; as it moves, a part of it is driven at random (an
Ornstein-Uhlenbeck process): knuckles *glide*, the arch *cups*, the skin of *thumb* or *wrist* is drawn along. What no
frame tells of it stays uncertain, and widens the angles' standard deviation instead of turning the hand. Where the
fingers are seen it is known when tissue moves: home or not, it is driven as far as the joints beneath it turn, all of
it at once, as in a grasp. Where only blobs are seen tissue cannot be told from bone, and all of it is driven all the
time.

Sizes from clinical reference 2 and 10: skin over knuckles glides 2 to 6 mm, mostly along the digit; metacarpals 4 and 5
flex by 20 and 27 degrees at most, tied to each other; the wrist's and thumb's skin 2 to 5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.palm_state import N_PALM_DISCS, RELIEF, SIZE, SKIN, SOFT_TISSUE

CUPPING_DISCS = np.array([4, 5])  # MCP4 and MCP5, whose metacarpals flex
# Modes of the tissue: the first two are rest. Where joints say when it moves there is one beside home.
HOME, STILL, GLIDE, CUP, THUMB, WRIST = range(6)
_MOVING = np.array([GLIDE, CUP, THUMB, WRIST])
_WRIST_DISC, _CMC1 = 0, 1
_KNUCKLES = range(2, 6)
_SOFT = SOFT_TISSUE.stop - SOFT_TISSUE.start
_RELIEF = slice(RELIEF.start - SOFT_TISSUE.start, _SOFT)
_OF_WRIST, _OF_THUMB, _OF_KNUCKLES = slice(0, 3), slice(3, 6), slice(6, SKIN.stop - SKIN.start)
_AT_ONCE_S = 1e-9


@dataclass(frozen=True, slots=True)
class SoftTissue:
    """Scatter of the discs' places on the fixed unit, and how long it lasts.

    Metres, along X (distal), across (Y) and along the normal (Z). ``knuckle_*`` of MCP2 and MCP3, common to neighbours
    by the share ``glides_together``; ``wrist_*`` and ``thumb_*`` of WRIST and CMC1; ``cupping_m`` how far MCP4 and MCP5
    sink as the arch closes, both together by the share ``cups_together``; besides, these glide by ``loose_along_m`` and
    ``loose_across_m``. ``lasts_s``: how long a displacement lasts while tissue moves, ``rests_s`` while it rests, when
    smoothing ``creeps_s``, since what the filter took for rest may have been a slow motion; home it is within
    ``home_m``. ``looked_back``: factor on the variance of the smoothed estimate, at most the live one, since what
    displaced tissue and depth have wrong comes again in frame after frame, and is not averaged away.

    Per second: resting tissue begins to move at ``leaving_per_s``, the wrist's the more the faster the hand turns, by
    ``turning_rad_s``; a motion ends after ``dwell_s``, with the probability ``homing_share`` at home; what is displaced
    goes home at ``homing_per_s``, and home ends without a motion at ``home_ends_per_s``. Just calibrated, each other
    mode has the probability ``elsewhere_at_start``.

    Where the fingers are seen a displacement lasts as long as the joints beneath it turn by ``lasts_rad``, or creeps
    away as in smoothing, and home ends at ``leaving_per_rad``; no joint is taken to turn faster than ``fastest_rad_s``.

    ``relief_*`` scatter of the surface's turn about X and Y and height, and how long that lasts: home it is what the
    depth's errors make of it as they change with the place in the image.
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
    rests_s: float = 1e4
    creeps_s: float = 300.0
    looked_back: float = 1.35
    home_m: float = 1e-5
    leaving_per_s: float = 0.05
    turning_rad_s: float = 0.5
    dwell_s: float = 0.5
    homing_share: float = 0.1
    homing_per_s: float = 0.3
    home_ends_per_s: float = 0.01
    elsewhere_at_start: float = 0.02
    lasts_rad: float = 1.5
    leaving_per_rad: float = 0.3
    fastest_rad_s: float = 4.0
    relief_home: tuple[float, float, float] = (0.010, 0.005, 0.00015)
    relief_home_s: float = 1.0
    relief_still: tuple[float, float, float] = (0.015, 0.009, 0.0004)
    relief_still_s: float = 4.0
    relief_moving: tuple[float, float, float] = (0.015, 0.012, 0.0008)


class DigitSpeeds(NamedTuple):
    """Rates, in rad/s, of the thumb at its base and of the fingers at MCP; zero where not measured."""

    thumb: float = 0.0
    fingers: float = 0.0


ZERO_SPEEDS = DigitSpeeds()


@dataclass(frozen=True, slots=True)
class TissueModes:
    """J modes of skin and relief (r numbers), the first ``resting`` of them at rest.

    They settle at ``stationary`` (J, r, r), each number over ``lasts_s`` (J, r); ``rates`` (J, J) per second of going
    over from row to column, that to the wrist's by how fast the hand turns, in ``turning_rad_s``. For smoothing,
    resting skin is driven ``creep`` times as much, and the variance is ``variance_factor`` times as large;
    ``displaced_probability`` of each mode but home of tissue just calibrated. Where joints are measured, each number
    lasts besides for ``lasts_rad`` of them, and home ends at ``leaving_per_rad``.
    """

    stationary: FloatArray
    lasts_s: FloatArray
    rates: FloatArray
    resting: int
    turning_rad_s: float
    creep: float = 1.0
    variance_factor: float = 1.0
    displaced_probability: float = 0.0
    lasts_rad: float = np.inf
    leaving_per_rad: float = 0.0

    @property
    def count(self) -> int:
        return len(self.stationary)

    @property
    def is_joint_driven(self) -> bool:
        return math.isfinite(self.lasts_rad)

    @property
    def initial_probability(self) -> FloatArray:
        """Probability (J,) of tissue just calibrated."""
        out = np.full(self.count, self.displaced_probability)
        out[HOME] = 1.0 - self.displaced_probability * (self.count - 1)
        return out


@lru_cache(maxsize=8)
def single_moving_mode(tissue: SoftTissue) -> TissueModes:
    """Return one mode, in which all of it moves."""
    return TissueModes(
        _scatter_covariance(tissue)[None],
        np.full((1, _SOFT), tissue.lasts_s),
        np.zeros((1, 1)),
        1,
        tissue.turning_rad_s,
    )


@lru_cache(maxsize=8)
def joint_driven_modes(tissue: SoftTissue) -> TissueModes:
    """Return two modes, home or not; elsewhere it moves as the joints beneath it do."""
    stationary = np.repeat(_scatter_covariance(tissue)[None], 2, axis=0)
    lasts_s = np.full((2, _SOFT), tissue.creeps_s)
    lasts_s[1, _RELIEF] = tissue.relief_still_s
    stationary[HOME], lasts_s[HOME] = _home_mode(tissue)
    rates = np.array([[0.0, tissue.home_ends_per_s], [tissue.homing_per_s, 0.0]])
    return TissueModes(
        stationary,
        lasts_s,
        rates,
        2,
        tissue.turning_rad_s,
        displaced_probability=tissue.elsewhere_at_start,
        lasts_rad=tissue.lasts_rad,
        leaving_per_rad=tissue.leaving_per_rad,
    )


@lru_cache(maxsize=8)
def resting_and_moving_modes(tissue: SoftTissue) -> TissueModes:
    """Return the six modes."""
    stationary = np.repeat(_scatter_covariance(tissue)[None], 6, axis=0)
    lasts_s = np.full((6, _SOFT), tissue.rests_s)
    stationary[GLIDE, : _RELIEF.start, : _RELIEF.start] -= _cupping_covariance(tissue)
    for modes, numbers in (((GLIDE, CUP), _OF_KNUCKLES), ((THUMB,), _OF_THUMB), ((WRIST,), _OF_WRIST)):
        lasts_s[list(modes), numbers] = tissue.lasts_s
    lasts_s[_MOVING, _RELIEF] = tissue.lasts_s
    # The thumb's skin does not lie on the surface that is measured.
    for mode in (STILL, THUMB):
        stationary[mode, _RELIEF, _RELIEF] = np.diag(tissue.relief_still) ** 2
        lasts_s[mode, _RELIEF] = tissue.relief_still_s
    stationary[HOME], lasts_s[HOME] = _home_mode(tissue)
    rates = np.zeros((6, 6))
    rates[:GLIDE, _MOVING] = tissue.leaving_per_s / len(_MOVING)
    rates[STILL, HOME], rates[HOME, STILL] = tissue.homing_per_s, tissue.home_ends_per_s
    rates[_MOVING, STILL] = (1.0 - tissue.homing_share) / tissue.dwell_s
    rates[_MOVING, HOME] = tissue.homing_share / tissue.dwell_s
    creep = tissue.rests_s / tissue.creeps_s
    return TissueModes(
        stationary, lasts_s, rates, 2, tissue.turning_rad_s, creep, tissue.looked_back, tissue.elsewhere_at_start
    )


def _home_mode(tissue: SoftTissue) -> tuple[FloatArray, FloatArray]:
    """Return the covariance (r, r) of what lies as calibrated, and how long it lasts (r,)."""
    stationary, lasts_s = tissue.home_m**2 * np.eye(_SOFT), np.full(_SOFT, _AT_ONCE_S)
    stationary[_RELIEF, _RELIEF], lasts_s[_RELIEF] = np.diag(tissue.relief_home) ** 2, tissue.relief_home_s
    return stationary, lasts_s


@lru_cache(maxsize=8)
def stationary_covariance(tissue: SoftTissue) -> FloatArray:
    """Return the covariance (n, n) of skin and relief not measured for long; zero elsewhere."""
    out = np.zeros((SIZE, SIZE))
    out[SOFT_TISSUE, SOFT_TISSUE] = _scatter_covariance(tissue)
    return out


def _scatter_covariance(tissue: SoftTissue) -> FloatArray:
    """Return the covariance (r, r) of skin and relief that may have moved in any way."""
    sd = np.zeros((N_PALM_DISCS, 3))
    sd[_WRIST_DISC] = tissue.wrist_along_m, tissue.wrist_across_m, tissue.wrist_up_m
    sd[_CMC1] = tissue.thumb_m
    sd[2:] = tissue.knuckle_along_m, tissue.knuckle_across_m, tissue.knuckle_up_m
    sd[CUPPING_DISCS, 0], sd[CUPPING_DISCS, 1] = tissue.loose_along_m, tissue.loose_across_m
    own = np.zeros((N_PALM_DISCS, 3, N_PALM_DISCS, 3))
    disc, axis = np.meshgrid(np.arange(N_PALM_DISCS), np.arange(3), indexing="ij")
    own[disc, axis, disc, axis] = sd**2
    for one in _KNUCKLES:
        for other in _KNUCKLES:
            if one != other:
                own[one, 0, other, 0] = tissue.glides_together * sd[one, 0] * sd[other, 0]
    out = np.zeros((_SOFT, _SOFT))
    out[: _RELIEF.start, : _RELIEF.start] = own.reshape(3 * N_PALM_DISCS, -1) + _cupping_covariance(tissue)
    out[_RELIEF, _RELIEF] = np.diag(tissue.relief_moving) ** 2
    return out


def _cupping_covariance(tissue: SoftTissue) -> FloatArray:
    """Return the covariance (18, 18) of the discs' places by the closing arch alone."""
    out = np.zeros((N_PALM_DISCS, 3, N_PALM_DISCS, 3))
    together = tissue.cups_together + (1.0 - tissue.cups_together) * np.eye(2)
    out[CUPPING_DISCS[:, None], 2, CUPPING_DISCS, 2] = np.outer(tissue.cupping_m, tissue.cupping_m) * together
    return out.reshape(3 * N_PALM_DISCS, -1)

"""Do the six names of the palm's discs lie where a palm has them? Every other way to give them is tried.

Six discs are few: WRIST clicked on the little knuckle and every other name one disc further on is a palm to whoever
only asks whether two were exchanged, or whether they stay together. Of the 720 ways to give six names only one fits.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from carpus.core.hand.anatomy import REFERENCE_LENGTH_M, anatomy_from_size
from carpus.core.hand.sites import PALM_MARKERS
from carpus.core.types import FloatArray, Side

_ORDERS = np.array(list(permutations(range(len(PALM_MARKERS)))))


@dataclass(frozen=True, slots=True)
class PalmNameSettings:
    """``good_misfit``, as a share of the palm's size, below which nothing is questioned: hands differ from the average
    by up to 0.05, and the next best order of the names of a right palm leaves 0.25. The better order must leave less
    than the share ``clearly`` of the misfit of the names as clicked."""

    good_misfit: float = 0.08
    clearly: float = 0.6


def shifted_names(side: Side, palm_plan: FloatArray, settings: PalmNameSettings) -> tuple[str, ...]:
    """The wrong names among the palm's, empty when another order does not fit clearly better.

    ``palm_plan`` (6, 2) the discs in the order of ``PALM_MARKERS``, seen from the camera, y up. The first disc that
    was given a wrong name comes first, and after each name the one that its disc should have: WRIST, MCP5 say that
    the disc clicked as wrist is the little knuckle. Two names only are two that were exchanged.
    """
    misfits = _misfits(average_palm(side), palm_plan)
    best = int(misfits.argmin())
    if misfits[0] < settings.good_misfit or misfits[best] > settings.clearly * misfits[0]:
        return ()
    if misfits[best] > _misfits(average_palm("left" if side == "right" else "right"), palm_plan)[0]:
        return ()  # the names are in order, but on the other hand
    right_name = np.argsort(_ORDERS[best])  # of the disc clicked under each name
    return tuple(PALM_MARKERS[i] for i in _ring_by_ring(right_name))


def names_fit(side: Side, palm_plan: FloatArray, settings: PalmNameSettings) -> bool:
    """Whether six names, given by nobody yet, lie where a palm of this hand has them, and not better on the other
    hand. ``palm_plan`` as in :func:`shifted_names`."""
    misfits = _misfits(average_palm(side), palm_plan)
    other = _misfits(average_palm("left" if side == "right" else "right"), palm_plan)
    return bool(misfits[0] < settings.good_misfit and misfits[0] == misfits.min() < other.min())


@lru_cache(maxsize=2)
def average_palm(side: Side) -> FloatArray:
    """The discs (6, 2) of the average palm in the order of ``PALM_MARKERS``, seen from the camera, y up, in metres."""
    return anatomy_from_size(REFERENCE_LENGTH_M).palm_disc_m[:, :2] * (1.0, 1.0 if side == "right" else -1.0)


def misfit(average: FloatArray, plan: FloatArray) -> float:
    """Residual share of the best similarity (turn, scale, shift; no mirror) of discs (M, 2) as they were named."""
    axes = np.array([1.0, 1j])
    mine, theirs = (average - average.mean(axis=0)) @ axes, (plan - plan.mean(axis=0)) @ axes
    factor = np.vdot(mine, theirs) / np.vdot(mine, mine)
    return float(np.linalg.norm(theirs - factor * mine) / max(float(np.linalg.norm(theirs)), 1e-12))


def _misfits(average: FloatArray, plan: FloatArray) -> FloatArray:
    """Residual share (720,) of the best similarity (turn, scale, shift; no mirror) for every order of the names."""
    mine = (average - average.mean(axis=0)) @ np.array([1.0, 1j])
    theirs = ((plan - plan.mean(axis=0)) @ np.array([1.0, 1j]))[_ORDERS]
    factor = theirs @ mine.conj() / np.vdot(mine, mine)
    return np.asarray(
        np.linalg.norm(theirs - factor[:, None] * mine, axis=1) / max(float(np.linalg.norm(theirs[0])), 1e-12)
    )


def _ring_by_ring(right_name: NDArray[np.int64]) -> list[int]:
    """The wrong ones, each followed by what it should be."""
    out: list[int] = []
    for start in range(len(right_name)):
        while right_name[start] != start and start not in out:
            out.append(start)
            start = int(right_name[start])
    return out

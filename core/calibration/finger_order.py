"""Do the names of the whole hand's discs make fingers: lines that run outwards, side by side, and never cross?

A hand at its neutral pose has its fingers beside each other, straight or bent. Bending shortens a finger's line on the
picture but does not turn it aside; only wrong names let it turn back, cross another or jump to a neighbour.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from carpus.core.hand.protocols import HAND21, HAND21_CHAINS
from carpus.core.types import FloatArray, Side

_MOST_TURN_DEG = 50.0
_MOST_THUMB_TURN_DEG = 75.0
"""A line that turns aside by more at one disc is no finger; the thumb's base lies freely."""
_MOST_LENGTH = (1.25, 0.85, 0.62, 0.45)
"""Longest pieces of a finger's line, wrist to tip, over the length from WRIST to the middle knuckle."""
_MOST_THUMB_LENGTH = (0.6, 0.95, 0.75, 0.62)
_CLEARLY = 1.2
"""Above this sum of faults the names are doubted: two bent fingers may cross once (1) by themselves."""

_SEGMENTS = tuple((chain[i], chain[i + 1], finger) for finger, chain in enumerate(HAND21_CHAINS) for i in range(4))
_BESIDE = tuple(
    (i, j)
    for i, j in combinations(range(len(_SEGMENTS)), 2)
    # Pieces of one finger, and those that share the wrist, cannot be judged by crossing; a thumb may lie on the palm.
    if _SEGMENTS[i][2] != _SEGMENTS[j][2]
    and _SEGMENTS[i][0] != _SEGMENTS[j][0]
    and not (0 in (_SEGMENTS[i][2], _SEGMENTS[j][2]) and 0 in (_SEGMENTS[i][0], _SEGMENTS[j][0]))
)
_KNUCKLES = tuple(chain[1] for chain in HAND21_CHAINS[1:])


@dataclass(frozen=True, slots=True)
class Misnamed:
    """Names that stand in for each other (``swapped``, two of equal length), or one that fits nowhere (``alone``)."""

    swapped: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    alone: str = ""


def misnamed(side: Side, plan: FloatArray) -> Misnamed | None:
    """What is wrong with the names of a ``plan`` (21, 2) seen from the camera, y up; None when nothing is."""
    now = _faults(side, plan)
    if now < _CLEARLY:
        return None
    best = np.inf
    rows: tuple[tuple[int, ...], tuple[int, ...]] = ((0,), (0,))
    for one, other in _exchanges():
        trial = plan.copy()
        trial[[*one, *other]] = plan[[*other, *one]]
        value = _faults(side, trial)
        if value < best - 1e-9:
            best, rows = value, (one, other)
    names = HAND21.markers
    exchanged = Misnamed((tuple(names[i] for i in rows[0]), tuple(names[i] for i in rows[1])))
    if best < _CLEARLY:
        return exchanged
    alone, without = _worst(side, plan)  # no exchange mends it all: is it one disc that lies outside of the hand?
    return Misnamed(alone=names[alone]) if without < _CLEARLY or best >= now - _CLEARLY else exchanged


def _exchanges() -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Two discs, or two whole fingers."""
    fingers = [tuple(chain[1:]) for chain in HAND21_CHAINS[1:]]
    single = [((i,), (j,)) for i, j in combinations(range(len(HAND21.markers)), 2)]
    return [*single, *combinations(fingers, 2)]


def _worst(side: Side, plan: FloatArray) -> tuple[int, float]:
    """The disc without which least is wrong, and how much: laid between its neighbours on the line, as if it fitted."""
    left = np.full(len(plan), np.inf)
    for chain in HAND21_CHAINS:
        for place in range(1, len(chain)):
            trial = plan.copy()
            before = plan[chain[place - 1]]
            after = (
                plan[chain[place + 1]] if place + 1 < len(chain) else before + 0.5 * (before - plan[chain[place - 2]])
            )
            trial[chain[place]] = 0.5 * (before + after)
            left[chain[place]] = min(left[chain[place]], _faults(side, trial))
    return int(np.argmin(left)), float(left.min())


def _faults(side: Side, plan: FloatArray) -> float:
    """Sum of all that speaks against the names, 0 for a usual hand."""
    size = float(np.median([np.hypot(*(plan[k] - plan[0])) for k in _KNUCKLES]))
    if not size > 0.0:
        return 0.0
    faults = 0.0
    for finger, chain in enumerate(HAND21_CHAINS):
        steps = np.diff(plan[list(chain)], axis=0)
        length = np.hypot(steps[:, 0], steps[:, 1])
        most = np.array(_MOST_THUMB_LENGTH if finger == 0 else _MOST_LENGTH)
        faults += float(np.maximum(length / size - most, 0.0).sum()) * 4.0
        along = (steps[:-1] * steps[1:]).sum(axis=1)
        across = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
        turn_deg = np.degrees(np.abs(np.arctan2(across, along)))
        limit_deg = np.array([_MOST_THUMB_TURN_DEG] * 2 + [_MOST_TURN_DEG]) if finger == 0 else _MOST_TURN_DEG
        # A very short piece, as of a finger bent towards the camera's line of sight, has no direction worth judging.
        weight = np.clip(np.minimum(length[:-1], length[1:]) / (0.08 * size), 0.0, 1.0)
        faults += float((weight * np.maximum(turn_deg - limit_deg, 0.0)).sum()) / 45.0
    faults += float(_crossings(plan).sum())
    return faults + _knuckles_out_of_order(side, plan)


def _crossings(plan: FloatArray) -> NDArray[np.bool_]:
    """Which pieces of different fingers cut each other, of the pairs in ``_BESIDE``."""
    ends = np.array([(plan[a], plan[b]) for a, b, _ in _SEGMENTS])
    first, second = ends[[i for i, _ in _BESIDE]], ends[[j for _, j in _BESIDE]]

    def turn(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        return np.asarray((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))

    a, b, c, d = first[:, 0], first[:, 1], second[:, 0], second[:, 1]
    return np.asarray((turn(a, b, c) * turn(a, b, d) < 0.0) & (turn(c, d, a) * turn(c, d, b) < 0.0))


def _knuckles_out_of_order(side: Side, plan: FloatArray) -> float:
    """Neighbouring knuckles that follow each other the wrong way about the wrist."""
    ray = plan[list(_KNUCKLES)] - plan[0]
    turn = ray[:-1, 0] * ray[1:, 1] - ray[:-1, 1] * ray[1:, 0]
    onwards = turn < 0.0 if side == "right" else turn > 0.0
    return 1.5 * float(np.count_nonzero(~onwards))

"""Repetitions of an exercise in one angle, by hysteresis around its middle (clinical reference 5)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.measures.signals import Signal, low_pass
from core.types import FloatArray

COUNTING_CUTOFF_HZ = 4.0
LEAST_RANGE_RAD = math.radians(10.0)
LEAST_DURATION_S = 0.4
SHORTEST_RECORDING_S = 1.0
LARGEST_MISSING_SHARE = 0.3
_LEAST_AMPLITUDE_SHARE = 0.3
_HYSTERESIS_SHARE = 0.15
_LEAST_HYSTERESIS_RAD = math.radians(2.5)


@dataclass(frozen=True, slots=True)
class Repetition:
    """One repetition, there and back, from ``start_s`` to ``end_s``; ``valid_share`` of its samples are no gap."""

    start_s: float
    end_s: float
    valid_share: float


@dataclass(frozen=True, slots=True)
class Stroke:
    """One movement in one direction between two neighbouring turning points."""

    start_s: float
    end_s: float
    rising: bool


@dataclass(frozen=True, slots=True)
class Exercise:
    """What was found in one angle; both empty where nothing was repeated."""

    repetitions: tuple[Repetition, ...]
    strokes: tuple[Stroke, ...]


@dataclass(frozen=True, slots=True)
class _Visit:
    """A stay on one side of the middle; ``turn`` is the sample of its extreme, ``entry`` its first sample."""

    high: bool
    entry: int
    turn: int
    value: float


NOTHING = Exercise((), ())


def find_repetitions(angle: Signal) -> Exercise:
    """Repetitions and strokes in an angle (rad).

    The middle is (P5 + P95)/2; a side is entered beyond +-max(0.15 R, 2.5 degrees), R = P95 - P5. A repetition goes
    to the other side and back, over max(10 degrees, 0.3 R) or more and 0.4 s or longer. Motion that starts and ends on
    the same side is cut at the extremes of that side; motion to both sides from the middle is cut where it passes the
    middle. With R below 10 degrees, less than 1 s, or more than 30 % missing there are none.
    """
    known = angle.value[np.isfinite(angle.value)]
    if len(known) < 2 or angle.time_s[-1] - angle.time_s[0] < SHORTEST_RECORDING_S:
        return NOTHING
    if min(angle.valid_share, len(known) / len(angle.value)) < 1.0 - LARGEST_MISSING_SHARE:
        return NOTHING
    smooth = low_pass(angle, COUNTING_CUTOFF_HZ)
    low, high = np.nanpercentile(smooth.value, (5.0, 95.0))
    extent = float(high - low)
    if not extent >= LEAST_RANGE_RAD:
        return NOTHING
    middle = 0.5 * float(high + low)
    hysteresis = max(_HYSTERESIS_SHARE * extent, _LEAST_HYSTERESIS_RAD)
    visits = _visits(smooth.value, middle, hysteresis)
    least = max(LEAST_RANGE_RAD, _LEAST_AMPLITUDE_SHARE * extent)
    visits = _without_small_swings(visits, least)
    time = smooth.time_s
    strokes = tuple(Stroke(float(time[a.turn]), float(time[b.turn]), b.high) for a, b in pairwise(visits))
    repetitions = tuple(
        Repetition(float(time[start]), float(time[end]), float(np.isfinite(angle.value[start : end + 1]).mean()))
        for start, end in _bounds(visits, smooth.value, middle, hysteresis)
        if time[end] - time[start] >= LEAST_DURATION_S
    )
    return Exercise(repetitions, strokes)


def _visits(value: FloatArray, middle: float, hysteresis: float) -> list[_Visit]:
    """Stays on alternating sides, in order, each with its extreme, the first of several as far out."""
    known = np.flatnonzero(np.isfinite(value))
    offset = value[known] - middle
    beyond = np.flatnonzero(np.abs(offset) >= hysteresis)
    if not len(beyond):
        return []
    high = offset[beyond] > 0.0
    entries = beyond[np.concatenate(([True], high[1:] != high[:-1]))]
    visits = []
    for entry, following in pairwise((*entries.tolist(), len(known))):
        stay = value[known[entry:following]]
        is_high = bool(offset[entry] > 0.0)
        turn = known[entry + int(np.argmax(stay if is_high else -stay))]
        visits.append(_Visit(is_high, int(known[entry]), int(turn), float(value[turn])))
    return visits


def _without_small_swings(visits: list[_Visit], least: float) -> list[_Visit]:
    """Drops turns nearer than ``least`` to the turn before; of two stays then on one side the further out is kept."""
    kept: list[_Visit] = []
    for visit in visits:
        if kept and kept[-1].high == visit.high:
            if (visit.value > kept[-1].value) == visit.high:
                kept[-1] = visit
        elif not kept or abs(visit.value - kept[-1].value) >= least:
            kept.append(visit)
    return kept


def _bounds(visits: list[_Visit], value: FloatArray, middle: float, hysteresis: float) -> list[tuple[int, int]]:
    """First and last sample of each repetition; a last swing that never comes back is none."""
    came_back = _return_to_middle(value, middle, hysteresis, visits[-1]) if visits else None
    if len(visits) % 2 == 0 and came_back is None:
        visits = visits[:-1]
    if len(visits) % 2 == 1 or came_back is None:
        return [(a.turn, b.turn) for a, b in zip(visits[0:-2:2], visits[2::2], strict=True)]
    # The visit before began on the other side: nothing earlier needs to be looked at.
    since = [0, *(visit.turn for visit in visits[1::2])]
    firsts = [_last_on_other_side(value, middle, visit, k) for visit, k in zip(visits[::2], since, strict=False)]
    return list(zip(firsts, [*firsts[1:], came_back], strict=True))


def _last_on_other_side(value: FloatArray, middle: float, visit: _Visit, since: int) -> int:
    """The sample before a visit at which the middle was passed, not before ``since``; the first known one where it
    never was."""
    before = since + np.flatnonzero(np.isfinite(value[since : visit.entry + 1]))
    other = before[(value[before] - middle > 0.0) != visit.high]
    return int(other[-1]) if len(other) else int(before[0])


def _return_to_middle(value: FloatArray, middle: float, hysteresis: float, visit: _Visit) -> int | None:
    """The sample after a visit's extreme that is back at the middle, or the last one if that is near it."""
    after = visit.turn + np.flatnonzero(np.isfinite(value[visit.turn :]))
    other = after[(value[after] - middle > 0.0) != visit.high]
    if len(other):
        return int(other[0])
    return int(after[-1]) if abs(value[after[-1]] - middle) < hysteresis else None

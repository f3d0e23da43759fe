"""Repetitions of an exercise in one angle, by its turning points (clinical reference 5)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.measures.signals import Signal, low_pass, stretches
from carpus.core.types import FloatArray

COUNTING_CUTOFF_HZ = 4.0
LEAST_RANGE_RAD = math.radians(10.0)
LEAST_DURATION_S = 0.4
LONGEST_HIDDEN_S = 1.0
"""Who sees nothing for longer does not know what the hand did."""
SHORTEST_RECORDING_S = 1.0
_LEAST_AMPLITUDE_SHARE = 0.3
_HYSTERESIS_SHARE = 0.15
_NOISE_RANGE = 4.5
"""Range of what is left of white noise after the low-pass, in standard deviations of what the low-pass took away."""
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

    @property
    def toward(self) -> float:
        """1 for a rising angle, else -1."""
        return 1.0 if self.rising else -1.0


@dataclass(frozen=True, slots=True)
class Exercise:
    """What was found in one angle; both empty where nothing was repeated. ``unseen_s`` from when to when nothing was
    seen for so long that nothing is counted across it."""

    repetitions: tuple[Repetition, ...]
    strokes: tuple[Stroke, ...]
    unseen_s: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class _Turn:
    """A turning point: the sample ``turn`` of an extreme."""

    high: bool
    turn: int
    value: float


NOTHING = Exercise((), ())


def find_repetitions(angle: Signal) -> Exercise:
    """Repetitions and strokes in an angle (rad).

    A turning point is where the angle turns back over max(10 degrees, 0.3 R) or more, R being the usual swing: the
    median of the swings of 10 degrees or more, weighed by how long they take, so that neither a rest nor a hand taken
    away changes it. A repetition goes there and back and takes 0.4 s or longer. Motion that starts and ends on the same
    side is cut at the extremes of that side; motion to both sides from the middle where it passes the middle.

    What is missing makes nothing else vanish: a repetition in which something is missing has its ``valid_share``; what
    lies before and after a longer gap is counted by itself; :func:`what_was_not_counted` says why there is none.
    """
    known = np.flatnonzero(np.isfinite(angle.value))
    if len(known) < 2 or angle.time_s[-1] - angle.time_s[0] < SHORTEST_RECORDING_S:
        return NOTHING
    smooth = low_pass(angle, COUNTING_CUTOFF_HZ).value
    least = max(LEAST_RANGE_RAD, _NOISE_RANGE * _left_over(angle.value, smooth))
    parts = _parts(angle)
    extent = _usual_swing([_turning_points(smooth, least, part) for part in parts])
    unseen = tuple((float(start), float(end)) for start, end in angle.gaps_s if end - start > LONGEST_HIDDEN_S)
    if math.isnan(extent):
        return Exercise((), (), unseen)
    least = max(least, _LEAST_AMPLITUDE_SHARE * extent)
    turns_of_parts = [_turning_points(smooth, least, part) for part in parts]
    hysteresis = max(_HYSTERESIS_SHARE * extent, _LEAST_HYSTERESIS_RAD)
    middle = _middle([turn for turns in turns_of_parts for turn in turns])
    turns_of_parts = [_without_rest(turns, middle, hysteresis) for turns in turns_of_parts]
    time = angle.time_s
    strokes = tuple(
        Stroke(float(time[a.turn]), float(time[b.turn]), b.high) for turns in turns_of_parts for a, b in pairwise(turns)
    )
    repetitions = tuple(
        Repetition(float(time[start]), float(time[end]), float(np.isfinite(angle.value[start : end + 1]).mean()))
        for part, turns in zip(parts, turns_of_parts, strict=True)
        for start, end in _bounds(turns, smooth[: part.stop], middle, hysteresis, part.start)
        if time[end] - time[start] >= LEAST_DURATION_S
    )
    return Exercise(repetitions, strokes, unseen)


Uncounted = Literal["too_short", "nothing_seen", "small_range", "no_return", "too_quick"]
"""Why there is none: hardly a recording, hardly a frame seen, less than 10 degrees, never there and back, or each in
less than 0.4 s."""


def what_was_not_counted(angle: Signal, found: Exercise) -> Uncounted | None:
    """Why an angle has no repetition; None where it has some."""
    if found.repetitions:
        return None
    known = angle.value[np.isfinite(angle.value)]
    if len(known) < 2:
        return "nothing_seen"
    if angle.time_s[-1] - angle.time_s[0] < SHORTEST_RECORDING_S:
        return "too_short"
    if float(np.ptp(known)) < LEAST_RANGE_RAD:
        return "small_range"
    return "too_quick" if len(found.strokes) > 2 else "no_return"


def _parts(angle: Signal) -> list[slice]:
    """The samples between gaps that are too long to count across."""
    finite = angle.finite
    parts = stretches(finite)
    out: list[slice] = []
    for part in parts:
        if out and (part.start - out[-1].stop) / angle.rate_hz <= LONGEST_HIDDEN_S:
            out[-1] = slice(out[-1].start, part.stop)
        else:
            out.append(part)
    return out


def _left_over(value: FloatArray, smooth: FloatArray) -> float:
    """Robust standard deviation of what a low-pass took away."""
    rest = value - smooth
    rest = rest[np.isfinite(rest)]
    return 1.4826 * float(np.median(np.abs(rest))) if len(rest) else 0.0


def _turning_points(value: FloatArray, least: float, part: slice = slice(None)) -> list[_Turn]:
    """Where a curve (n,) turns back over ``least`` or more, highs and lows in turn; both ends are among them.

    Whatever comes later leaves a turning point as it is, once the curve has come back from it.
    """
    known = (part.start or 0) + np.flatnonzero(np.isfinite(value[part]))
    if len(known) < 2:
        return []
    curve = value[known]
    bends = np.flatnonzero(np.diff(np.sign(np.diff(curve)), prepend=2.0, append=2.0) != 0)
    bends = np.unique(np.concatenate(([0], bends, [len(curve) - 1])))
    turns: list[_Turn] = []
    low = high = int(bends[0])
    rising: bool | None = None
    for at in bends.tolist():
        if curve[at] > curve[high]:
            high = at
        if curve[at] < curve[low]:
            low = at
        if rising is not False and curve[high] - curve[at] >= least:
            turns.append(_turn(known, curve, high, high=True))
            rising, low = False, at
        elif rising is not True and curve[at] - curve[low] >= least:
            turns.append(_turn(known, curve, low, high=False))
            rising, high = True, at
    if rising is not None:
        turns.append(_turn(known, curve, high if rising else low, high=rising))
    return turns


def _turn(known: NDArray[np.intp], curve: FloatArray, at: int, *, high: bool) -> _Turn:
    return _Turn(high, int(known[at]), float(curve[at]))


def _usual_swing(turns_of_parts: list[list[_Turn]]) -> float:
    """Median size of the swings, each weighed by its samples; NaN without any."""
    pairs = (pair for turns in turns_of_parts for pair in pairwise(turns))
    swings = sorted((abs(b.value - a.value), b.turn - a.turn) for a, b in pairs)
    half, so_far = 0.5 * sum(length for _, length in swings), 0
    for size, length in swings:
        so_far += length
        if so_far >= half:
            return size
    return math.nan


def _middle(turns: list[_Turn]) -> float:
    """Half way between the usual high and the usual low."""
    sides = [[turn.value for turn in turns if turn.high is high] for high in (True, False)]
    return 0.5 * sum(float(np.median(side)) for side in sides if side) if all(sides) else 0.0


def _without_rest(turns: list[_Turn], middle: float, hysteresis: float) -> list[_Turn]:
    """Without a first and a last turning point at which the hand only rested in the middle."""
    begin = 1 if turns and abs(turns[0].value - middle) < hysteresis else 0
    end = len(turns) - 1 if len(turns) > begin and abs(turns[-1].value - middle) < hysteresis else len(turns)
    return turns[begin:end]


def _bounds(
    turns: list[_Turn], value: FloatArray, middle: float, hysteresis: float, begin: int
) -> list[tuple[int, int]]:
    """First and last sample of each repetition; a last swing that never comes back is none."""
    came_back = _return_to_middle(value, middle, hysteresis, turns[-1]) if turns else None
    if len(turns) % 2 == 0 and came_back is None:
        turns = turns[:-1]
    if len(turns) % 2 == 1 or came_back is None:
        return [(a.turn, b.turn) for a, b in zip(turns[0:-2:2], turns[2::2], strict=True)]
    # The turn before began on the other side: nothing earlier needs to be looked at.
    since = [begin, *(turn.turn for turn in turns[1::2])]
    firsts = [_last_on_other_side(value, middle, turn, k) for turn, k in zip(turns[::2], since, strict=False)]
    return list(zip(firsts, [*firsts[1:], came_back], strict=True))


def _last_on_other_side(value: FloatArray, middle: float, turn: _Turn, since: int) -> int:
    """The sample before a turn at which the middle was passed, not before ``since``; the first known one where it
    never was."""
    before = since + np.flatnonzero(np.isfinite(value[since : turn.turn + 1]))
    other = before[(value[before] - middle > 0.0) != turn.high]
    return int(other[-1]) if len(other) else int(before[0])


def _return_to_middle(value: FloatArray, middle: float, hysteresis: float, turn: _Turn) -> int | None:
    """The sample after a turn's extreme that is back at the middle, or the last one if that is near it."""
    after = turn.turn + np.flatnonzero(np.isfinite(value[turn.turn :]))
    other = after[(value[after] - middle > 0.0) != turn.high]
    if len(other):
        return int(other[0])
    return int(after[-1]) if abs(value[after[-1]] - middle) < hysteresis else None

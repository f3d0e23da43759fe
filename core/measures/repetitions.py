"""Repetitions of an exercise in one angle, by its turning points (clinical reference 5)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
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
_STILL_S, _STILL_SHARE = 0.3, 0.03
"""Who moves by no more of the usual swing for so long stands."""

Cut = Literal["", "cut_by_start", "cut_by_gap", "cut_by_end"]
"""What hid the rest of a repetition: the recording began or ended in it, or the hand was out of sight."""


@dataclass(frozen=True, slots=True)
class Repetition:
    """One repetition, there and back, from ``start_s`` to ``end_s``; ``valid_share`` of its samples are no gap.

    One that is ``cut``, at ``cut_s``, is the piece that was seen of it.
    """

    start_s: float
    end_s: float
    valid_share: float
    cut: Cut = ""
    cut_s: float = math.nan


@dataclass(frozen=True, slots=True)
class Stroke:
    """One movement in one direction between two neighbouring turning points; ``half``: of motion to both sides the way
    from the rest in the middle, or back to it."""

    start_s: float
    end_s: float
    rising: bool
    half: bool = False

    @property
    def toward(self) -> float:
        """1 for a rising angle, else -1."""
        return 1.0 if self.rising else -1.0


@dataclass(frozen=True, slots=True)
class FoundRepetitions:
    """What was found in one angle; all empty where nothing was repeated. ``cut`` are repetitions of which a piece was
    seen, which count nowhere; ``unseen_s`` from when to when nothing was seen for so long that nothing is counted
    across it."""

    repetitions: tuple[Repetition, ...]
    strokes: tuple[Stroke, ...]
    cut: tuple[Repetition, ...] = ()
    unseen_s: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class _Turn:
    """A turning point: the sample ``turn`` of an extreme. ``seen``: the angle came and went; else what was seen begins
    or ends there, ``still`` or moving."""

    high: bool
    turn: int
    value: float
    seen: bool = True
    still: bool = True

    def outwards(self, level: float) -> float:
        """How far it lies beyond a level, to its side."""
        return self.value - level if self.high else level - self.value


NOTHING = FoundRepetitions((), ())


def find_repetitions(angle: Signal) -> FoundRepetitions:
    """Repetitions and strokes in an angle (rad).

    A turning point is where the angle turns back over max(10 degrees, 0.3 R) or more, R being the usual swing: the
    median of the swings of 10 degrees or more, weighed by how long they take, so that neither a rest nor a hand taken
    away changes it. A repetition goes there and back and takes 0.4 s or longer: from one extreme to the next of the
    side on which the hand began, or ended; of motion to both sides from passing the middle to passing it that way
    again.

    What is missing makes nothing else vanish: a repetition in which something is missing has its ``valid_share``; what
    lies before and after a longer gap is counted by itself, what such a gap or an end of the recording left of a
    repetition is ``cut``; :func:`what_was_not_counted` says why there is none.
    """
    known = np.flatnonzero(np.isfinite(angle.value))
    if len(known) < 2 or angle.time_s[-1] - angle.time_s[0] < SHORTEST_RECORDING_S:
        return NOTHING
    smooth = low_pass(angle, COUNTING_CUTOFF_HZ).value
    noise = _NOISE_RANGE * _left_over(angle.value, smooth)
    least = max(LEAST_RANGE_RAD, noise)
    parts = _parts(angle)
    extent = _usual_swing([_turning_points(smooth, least, part) for part in parts])
    unseen = tuple((float(start), float(end)) for start, end in angle.gaps_s if end - start > LONGEST_HIDDEN_S)
    if math.isnan(extent):
        return FoundRepetitions((), (), unseen_s=unseen)
    least = max(least, _LEAST_AMPLITUDE_SHARE * extent)
    turned = [(part, _turning_points(smooth, least, part)) for part in parts]
    near = max(_HYSTERESIS_SHARE * extent, _LEAST_HYSTERESIS_RAD)
    still_rad = max(_STILL_SHARE * extent, noise)
    runs = [_Run.of(smooth, part, turns, near, still_rad, angle.rate_hz) for part, turns in turned if turns]
    home = _Home.of(runs, near)
    time = angle.time_s
    strokes: list[Stroke] = []
    whole: list[Repetition] = []
    cut: list[Repetition] = []
    for run in runs:
        strokes += _strokes(run, home, time, least)
        marks = home.marks(run, runs)
        whole += [_between(angle, a, b) for a, b in pairwise(marks) if time[b] - time[a] >= LEAST_DURATION_S]
        first, last = run.part.start, run.part.stop - 1
        if not home.rests(run.turns[0]) and run.turns[0].turn not in marks:
            cut.append(_between(angle, first, marks[0] if marks else last, first))
        end, before = run.turns[-1], run.turns[-2]
        # Who stops half way and stays there has not come back: what was seen ends in that repetition.
        left = home.side is not None and end.high is not home.side and abs(end.value - before.value) >= least
        if (left or not home.rests(end)) and marks and marks[-1] < run.turns[-1].turn:
            cut.append(_between(angle, marks[-1], last, last))
    return FoundRepetitions(tuple(whole), tuple(strokes), tuple(cut), unseen)


def _strokes(run: _Run, home: _Home, time_s: FloatArray, least_rad: float) -> list[Stroke]:
    return [
        Stroke(
            float(time_s[a.turn]),
            float(time_s[b.turn]),
            b.high,
            home.side is None and "middle" in map(home.place, (a, b)),
        )
        for a, b in pairwise(run.turns)
        if abs(b.value - a.value) >= least_rad
    ]


def _between(angle: Signal, start: int, end: int, cut_at: int | None = None) -> Repetition:
    """The repetition from one sample to another, cut at a sample where it is."""
    time = angle.time_s
    one = Repetition(float(time[start]), float(time[end]), float(np.isfinite(angle.value[start : end + 1]).mean()))
    if cut_at is None:
        return one
    by_gap = angle.beside_gap(float(time[cut_at]), 1.5 / angle.rate_hz)
    by: Cut = "cut_by_gap" if by_gap else "cut_by_start" if cut_at == start else "cut_by_end"
    return replace(one, cut=by, cut_s=float(time[cut_at]))


Uncounted = Literal["too_short", "nothing_seen", "small_range", "cut_by_gap", "no_return", "too_quick"]
"""Why there is none: hardly a recording, hardly a frame seen, less than 10 degrees, one with a piece out of
sight, never there and back, or each in less than 0.4 s."""


def what_was_not_counted(angle: Signal, found: FoundRepetitions) -> Uncounted | None:
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
    if any(one.cut == "cut_by_gap" for one in found.cut):
        return "cut_by_gap"
    # One slow stroke is enough to know that haste was not the reason.
    longest_s = max((one.end_s - one.start_s for one in found.strokes), default=0.0)
    return "too_quick" if len(found.strokes) > 2 and longest_s < LEAST_DURATION_S else "no_return"


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


@dataclass(frozen=True, slots=True)
class _Run:
    """What was seen without a long gap: the whole curve (n,), the run's part of it, and where that turns."""

    curve: FloatArray
    part: slice
    turns: list[_Turn]

    @classmethod
    def of(
        cls, curve: FloatArray, part: slice, turns: list[_Turn], near: float, still_rad: float, rate_hz: float
    ) -> _Run:
        """With the ends of what was seen, and whether the hand stood there: an end turn from which the angle came back,
        though by too little for another turn, was seen."""
        known = part.start + np.flatnonzero(np.isfinite(curve[part]))
        count = 1 + round(_STILL_S * rate_hz)
        for at, samples in ((0, known[:count]), (-1, known[: -count - 1 : -1])):
            end, edge = turns[at], int(samples[0])
            still = bool(np.ptp(curve[samples]) <= still_rad)
            if abs(float(curve[edge]) - end.value) <= near:
                turns[at] = replace(end, seen=False, still=still)
            else:
                one = _Turn(not end.high, edge, float(curve[edge]), seen=False, still=still)
                turns = [one, *turns] if at == 0 else [*turns, one]
        return cls(curve, part, turns)

    def passed(self, level: float, turn: _Turn, *, before: bool) -> int | None:
        """The sample nearest to a turn, before or after it, that is not beyond a level; None without one."""
        side = slice(self.part.start, turn.turn) if before else slice(turn.turn, self.part.stop)
        off = (self.curve[side] - level) * (1.0 if turn.high else -1.0)
        found = side.start + np.flatnonzero(off <= 0.0)
        return int(found[-1 if before else 0]) if len(found) else None


_Place = Literal["low", "high", "middle", "elsewhere"]


@dataclass(frozen=True, slots=True)
class _Home:
    """Where a motion turns, about ``low`` and ``high``, each ``near`` by so much, and from where it goes there and
    back: from its high or its low ``side``, or, to both sides, from the middle (None)."""

    low: float
    high: float
    near: float
    side: bool | None = None

    @classmethod
    def of(cls, runs: Sequence[_Run], near: float) -> _Home:
        """By where the hand stood at the beginning, or at the end; else by where it was."""
        usual = [_usual([turn for run in runs for turn in run.turns if turn.high is high]) for high in (False, True)]
        home = cls(usual[0], usual[1], near)
        ends = (runs[0].turns[0], runs[-1].turns[-1])
        for end in (*(end for end in ends if end.still), *ends):
            if home.place(end) != "elsewhere":
                return home if home.place(end) == "middle" else replace(home, side=end.high)
        return replace(home, side=ends[0].high)

    @property
    def middle(self) -> float:
        return 0.5 * (self.low + self.high)

    def place(self, turn: _Turn) -> _Place:
        """Where a turning point lies; one at which what was seen begins or ends may lie anywhere."""
        beyond_middle = turn.outwards(self.middle)
        if not turn.seen and abs(beyond_middle) < self.near:
            return "middle"
        there = turn.seen or turn.outwards(self.high if turn.high else self.low) > -self.near
        if there or (turn.still and beyond_middle > 0.0):
            return "high" if turn.high else "low"
        return "elsewhere"

    def rests(self, turn: _Turn) -> bool:
        """Whether no repetition is under way where what was seen begins or ends."""
        place = self.place(turn)
        if place in ("middle", "elsewhere"):
            return turn.still or (self.side is None and place == "middle")
        return turn.high is self.side

    def marks(self, run: _Run, runs: Sequence[_Run]) -> list[int]:
        """The samples at which a repetition begins or ends."""
        if self.side is not None:
            at_home = "high" if self.side else "low"
            return [turn.turn for turn in run.turns if self.place(turn) == at_home]
        outs = [turn for turn in run.turns if turn.seen or turn.outwards(self.middle) >= self.near]
        first_high = self._first_high([run, *runs])
        found: list[int] = []
        for k, turn in enumerate(outs):
            if turn.high is first_high:
                passed = run.passed(self.middle, turn, before=True)
                if k and passed is not None:
                    found.append(max(passed, outs[k - 1].turn))
                elif self.place(run.turns[0]) == "middle":
                    found.append(run.turns[0].turn if passed is None else passed)
        if outs and outs[-1].high is not first_high:
            passed = run.passed(self.middle, outs[-1], before=False)
            if passed is not None or self.place(run.turns[-1]) == "middle":
                found.append(run.turns[-1].turn if passed is None else passed)
        return found

    def _first_high(self, runs: Sequence[_Run]) -> bool:
        """To which side a repetition from the middle goes first; of several runs the first that shows it."""
        for run in runs:
            if self.place(run.turns[0]) == "middle":
                return run.turns[1].high
        for run in runs:
            if self.place(run.turns[-1]) == "middle":
                return not run.turns[-2].high
        return runs[0].turns[0].high


def _usual(turns: Sequence[_Turn]) -> float:
    """The median of the turning points of one side: of those that were seen, else at which the hand stood."""
    chosen = [turn for turn in turns if turn.seen] or [turn for turn in turns if turn.still]
    if chosen:
        return float(np.median([turn.value for turn in chosen]))
    return max(turns, key=lambda turn: turn.outwards(0.0)).value

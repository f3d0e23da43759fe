"""Repetitions and strokes of an exercise, from the turning points of one angle (clinical reference 5)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.measures.signals import Signal, find_runs, low_pass
from carpus.core.model.types import FloatArray

COUNTING_CUTOFF_HZ = 4.0
MIN_RANGE_RAD = math.radians(10.0)
MIN_DURATION_S = 0.4
MAX_OCCLUSION_S = 1.0
"""Nothing is counted across a longer occlusion."""
MIN_RECORDING_S = 1.0
_MIN_AMPLITUDE_SHARE = 0.3
_HYSTERESIS_SHARE = 0.15
_NOISE_RANGE = 4.5
"""Range of low-passed white noise, in standard deviations of what the low-pass removed."""
_MIN_HYSTERESIS_RAD = math.radians(2.5)
_STILL_S, _STILL_SHARE = 0.3, 0.03
"""The hand is still if it moves by no more than this share of the usual swing for so long."""

CutReason = Literal["", "cut_by_start", "cut_by_gap", "cut_by_end"]
"""What hid the rest of a repetition: the start or end of the recording, or an occlusion."""


@dataclass(frozen=True, slots=True)
class Repetition:
    """One repetition, there and back; ``valid_share`` is the share of its samples outside gaps.

    A partial repetition has a ``cut`` reason and the time ``cut_s`` at which it was cut.
    """

    start_s: float
    end_s: float
    valid_share: float
    cut: CutReason = ""
    cut_s: float = math.nan


@dataclass(frozen=True, slots=True)
class Stroke:
    """Movement in one direction between two neighbouring turning points.

    ``is_half``: in a motion to both sides, the way from the middle to one side or back.
    """

    start_s: float
    end_s: float
    is_rising: bool
    is_half: bool = False

    @property
    def direction(self) -> float:
        """1 for a rising angle, else -1."""
        return 1.0 if self.is_rising else -1.0


@dataclass(frozen=True, slots=True)
class RepetitionAnalysis:
    """Repetitions and strokes of one angle.

    Attributes
    ----------
    partial_repetitions : repetitions of which only a part was visible; they are not counted
    occluded_s : (start, end) of the occlusions across which nothing is counted
    """

    repetitions: tuple[Repetition, ...]
    strokes: tuple[Stroke, ...]
    partial_repetitions: tuple[Repetition, ...] = ()
    occluded_s: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class _TurningPoint:
    """Extreme of the curve at index ``sample``.

    ``is_seen``: the angle came and went there. Otherwise it is an end of the visible part, ``is_still`` or moving.
    """

    is_high: bool
    sample: int
    value: float
    is_seen: bool = True
    is_still: bool = True

    def distance_beyond(self, level: float) -> float:
        """Return how far the point lies beyond a level, to its own side."""
        return self.value - level if self.is_high else level - self.value


NO_REPETITIONS = RepetitionAnalysis((), ())


def find_repetitions(angle: Signal) -> RepetitionAnalysis:
    """Find the repetitions and strokes in an angle (rad).

    A turning point is where the angle turns back by max(10 degrees, 0.3 R) or more. R is the usual swing: the median of
    the swings of 10 degrees or more, weighted by their duration, so that neither rest nor an absent hand changes it. A
    repetition goes there and back and takes 0.4 s or longer: from one extreme to the next one on the side where the
    hand began or ended. In a motion to both sides it goes from passing the middle to passing it in that direction
    again.

    Gaps hide nothing else: a repetition with a gap has a lower ``valid_share``; the parts before and after a long
    occlusion are counted separately; what an occlusion or an end of the recording left of a repetition is partial.
    :func:`explain_no_repetitions` gives the reason where there is none.
    """
    known = np.flatnonzero(np.isfinite(angle.value))
    if len(known) < 2 or angle.time_s[-1] - angle.time_s[0] < MIN_RECORDING_S:
        return NO_REPETITIONS
    smooth = low_pass(angle, COUNTING_CUTOFF_HZ).value
    noise = _NOISE_RANGE * _residual_sd(angle.value, smooth)
    least = max(MIN_RANGE_RAD, noise)
    parts = _split_at_long_gaps(angle)
    extent = _median_swing([_find_turning_points(smooth, least, part) for part in parts])
    unseen = tuple((float(start), float(end)) for start, end in angle.gaps_s if end - start > MAX_OCCLUSION_S)
    if math.isnan(extent):
        return RepetitionAnalysis((), (), occluded_s=unseen)
    least = max(least, _MIN_AMPLITUDE_SHARE * extent)
    turned = [(part, _find_turning_points(smooth, least, part)) for part in parts]
    near = max(_HYSTERESIS_SHARE * extent, _MIN_HYSTERESIS_RAD)
    still_rad = max(_STILL_SHARE * extent, noise)
    runs = [
        _Segment.with_end_points(smooth, part, turns, near, still_rad, angle.rate_hz) for part, turns in turned if turns
    ]
    home = _RestPosition.from_segments(runs, near)
    time = angle.time_s
    strokes: list[Stroke] = []
    whole: list[Repetition] = []
    cut: list[Repetition] = []
    for run in runs:
        strokes += _find_strokes(run, home, time, least)
        marks = home.repetition_boundaries(run, runs)
        whole += [_make_repetition(angle, a, b) for a, b in pairwise(marks) if time[b] - time[a] >= MIN_DURATION_S]
        first, last = run.part.start, run.part.stop - 1
        if not home.is_at_rest(run.turning_points[0]) and run.turning_points[0].sample not in marks:
            cut.append(_make_repetition(angle, first, marks[0] if marks else last, first))
        end, before = run.turning_points[-1], run.turning_points[-2]
        # Who stops half way and stays there has not come back: what was seen ends in that repetition.
        left = home.side is not None and end.is_high is not home.side and abs(end.value - before.value) >= least
        if (left or not home.is_at_rest(end)) and marks and marks[-1] < run.turning_points[-1].sample:
            cut.append(_make_repetition(angle, marks[-1], last, last))
    return RepetitionAnalysis(tuple(whole), tuple(strokes), tuple(cut), unseen)


def _find_strokes(segment: _Segment, rest: _RestPosition, time_s: FloatArray, min_rad: float) -> list[Stroke]:
    return [
        Stroke(
            float(time_s[a.sample]),
            float(time_s[b.sample]),
            b.is_high,
            rest.side is None and "middle" in map(rest.classify, (a, b)),
        )
        for a, b in pairwise(segment.turning_points)
        if abs(b.value - a.value) >= min_rad
    ]


def _make_repetition(angle: Signal, start: int, end: int, cut_at: int | None = None) -> Repetition:
    """Build the repetition between two samples, cut at ``cut_at`` if given."""
    time = angle.time_s
    one = Repetition(float(time[start]), float(time[end]), float(np.isfinite(angle.value[start : end + 1]).mean()))
    if cut_at is None:
        return one
    by_gap = angle.is_near_gap(float(time[cut_at]), 1.5 / angle.rate_hz)
    by: CutReason = "cut_by_gap" if by_gap else "cut_by_start" if cut_at == start else "cut_by_end"
    return replace(one, cut=by, cut_s=float(time[cut_at]))


NoRepetitionReason = Literal["too_short", "nothing_seen", "small_range", "cut_by_gap", "no_return", "too_quick"]
"""Why there is no repetition.

Recording too short, hand hardly visible, range below 10 degrees, occluded, no return, or each quicker than 0.4 s.
"""


def explain_no_repetitions(angle: Signal, analysis: RepetitionAnalysis) -> NoRepetitionReason | None:
    """Return the reason why an angle has no repetition, None if it has some."""
    if analysis.repetitions:
        return None
    known = angle.value[np.isfinite(angle.value)]
    if len(known) < 2:
        return "nothing_seen"
    if angle.time_s[-1] - angle.time_s[0] < MIN_RECORDING_S:
        return "too_short"
    if float(np.ptp(known)) < MIN_RANGE_RAD:
        return "small_range"
    if any(one.cut == "cut_by_gap" for one in analysis.partial_repetitions):
        return "cut_by_gap"
    # One slow stroke is enough to know that haste was not the reason.
    longest_s = max((one.end_s - one.start_s for one in analysis.strokes), default=0.0)
    return "too_quick" if len(analysis.strokes) > 2 and longest_s < MIN_DURATION_S else "no_return"


def _split_at_long_gaps(angle: Signal) -> list[slice]:
    """Return the samples between gaps that are too long to count across."""
    finite = angle.is_finite
    parts = find_runs(finite)
    out: list[slice] = []
    for part in parts:
        if out and (part.start - out[-1].stop) / angle.rate_hz <= MAX_OCCLUSION_S:
            out[-1] = slice(out[-1].start, part.stop)
        else:
            out.append(part)
    return out


def _residual_sd(value: FloatArray, smooth: FloatArray) -> float:
    """Return the robust standard deviation of what a low-pass removed."""
    rest = value - smooth
    rest = rest[np.isfinite(rest)]
    return 1.4826 * float(np.median(np.abs(rest))) if len(rest) else 0.0


def _find_turning_points(value: FloatArray, min_swing: float, part: slice = slice(None)) -> list[_TurningPoint]:
    """Find where a curve (n,) turns back by ``min_swing`` or more, highs and lows in turn, with both ends.

    Later samples do not change a turning point once the curve has come back from it.
    """
    known = (part.start or 0) + np.flatnonzero(np.isfinite(value[part]))
    if len(known) < 2:
        return []
    curve = value[known]
    bends = np.flatnonzero(np.diff(np.sign(np.diff(curve)), prepend=2.0, append=2.0) != 0)
    bends = np.unique(np.concatenate(([0], bends, [len(curve) - 1])))
    turns: list[_TurningPoint] = []
    low = high = int(bends[0])
    rising: bool | None = None
    for at in bends.tolist():
        if curve[at] > curve[high]:
            high = at
        if curve[at] < curve[low]:
            low = at
        if rising is not False and curve[high] - curve[at] >= min_swing:
            turns.append(_turning_point(known, curve, high, is_high=True))
            rising, low = False, at
        elif rising is not True and curve[at] - curve[low] >= min_swing:
            turns.append(_turning_point(known, curve, low, is_high=False))
            rising, high = True, at
    if rising is not None:
        turns.append(_turning_point(known, curve, high if rising else low, is_high=rising))
    return turns


def _turning_point(known: NDArray[np.intp], curve: FloatArray, index: int, *, is_high: bool) -> _TurningPoint:
    return _TurningPoint(is_high, int(known[index]), float(curve[index]))


def _median_swing(turns_of_parts: list[list[_TurningPoint]]) -> float:
    """Return the median swing, weighted by its number of samples; NaN without any."""
    pairs = (pair for turns in turns_of_parts for pair in pairwise(turns))
    swings = sorted((abs(b.value - a.value), b.sample - a.sample) for a, b in pairs)
    half, so_far = 0.5 * sum(length for _, length in swings), 0
    for size, length in swings:
        so_far += length
        if so_far >= half:
            return size
    return math.nan


@dataclass(frozen=True, slots=True)
class _Segment:
    """Part of the curve (n,) without a long gap, with its turning points."""

    curve: FloatArray
    part: slice
    turning_points: list[_TurningPoint]

    @classmethod
    def with_end_points(
        cls, curve: FloatArray, part: slice, turns: list[_TurningPoint], near: float, still_rad: float, rate_hz: float
    ) -> _Segment:
        """Add the ends of the visible part, and whether the hand was still there.

        An end from which the angle came back by too little for a turning point replaces it.
        """
        known = part.start + np.flatnonzero(np.isfinite(curve[part]))
        count = 1 + round(_STILL_S * rate_hz)
        for at, samples in ((0, known[:count]), (-1, known[: -count - 1 : -1])):
            end, edge = turns[at], int(samples[0])
            still = bool(np.ptp(curve[samples]) <= still_rad)
            if abs(float(curve[edge]) - end.value) <= near:
                turns[at] = replace(end, is_seen=False, is_still=still)
            else:
                one = _TurningPoint(not end.is_high, edge, float(curve[edge]), is_seen=False, is_still=still)
                turns = [one, *turns] if at == 0 else [*turns, one]
        return cls(curve, part, turns)

    def find_crossing(self, level: float, point: _TurningPoint, *, before: bool) -> int | None:
        """Return the sample nearest to a turning point, before or after it, that is not beyond a level."""
        side = slice(self.part.start, point.sample) if before else slice(point.sample, self.part.stop)
        off = (self.curve[side] - level) * (1.0 if point.is_high else -1.0)
        found = side.start + np.flatnonzero(off <= 0.0)
        return int(found[-1 if before else 0]) if len(found) else None


_Position = Literal["low", "high", "middle", "elsewhere"]


@dataclass(frozen=True, slots=True)
class _RestPosition:
    """Where a motion turns (``low``, ``high``, each within ``tolerance``) and where it starts.

    ``side``: True from its high side, False from its low side, None to both sides from the middle.
    """

    low: float
    high: float
    tolerance: float
    side: bool | None = None

    @classmethod
    def from_segments(cls, segments: Sequence[_Segment], tolerance: float) -> _RestPosition:
        """Estimate from where the hand was still at the start or the end, else from where it was."""
        usual = [
            _typical_extreme([turn for run in segments for turn in run.turning_points if turn.is_high is high])
            for high in (False, True)
        ]
        home = cls(usual[0], usual[1], tolerance)
        ends = (segments[0].turning_points[0], segments[-1].turning_points[-1])
        for end in (*(end for end in ends if end.is_still), *ends):
            if home.classify(end) != "elsewhere":
                return home if home.classify(end) == "middle" else replace(home, side=end.is_high)
        return replace(home, side=ends[0].is_high)

    @property
    def middle(self) -> float:
        return 0.5 * (self.low + self.high)

    def classify(self, point: _TurningPoint) -> _Position:
        """Classify the position of a turning point; an end of the visible part may lie elsewhere."""
        beyond_middle = point.distance_beyond(self.middle)
        if not point.is_seen and abs(beyond_middle) < self.tolerance:
            return "middle"
        there = point.is_seen or point.distance_beyond(self.high if point.is_high else self.low) > -self.tolerance
        if there or (point.is_still and beyond_middle > 0.0):
            return "high" if point.is_high else "low"
        return "elsewhere"

    def is_at_rest(self, point: _TurningPoint) -> bool:
        """True if no repetition is under way at an end of the visible part."""
        place = self.classify(point)
        if place in ("middle", "elsewhere"):
            return point.is_still or (self.side is None and place == "middle")
        return point.is_high is self.side

    def repetition_boundaries(self, segment: _Segment, segments: Sequence[_Segment]) -> list[int]:
        """Return the samples at which a repetition begins or ends."""
        if self.side is not None:
            at_home = "high" if self.side else "low"
            return [turn.sample for turn in segment.turning_points if self.classify(turn) == at_home]
        outs = [
            turn
            for turn in segment.turning_points
            if turn.is_seen or turn.distance_beyond(self.middle) >= self.tolerance
        ]
        first_high = self._is_first_high([segment, *segments])
        found: list[int] = []
        for k, turn in enumerate(outs):
            if turn.is_high is first_high:
                passed = segment.find_crossing(self.middle, turn, before=True)
                if k and passed is not None:
                    found.append(max(passed, outs[k - 1].sample))
                elif self.classify(segment.turning_points[0]) == "middle":
                    found.append(segment.turning_points[0].sample if passed is None else passed)
        if outs and outs[-1].is_high is not first_high:
            passed = segment.find_crossing(self.middle, outs[-1], before=False)
            if passed is not None or self.classify(segment.turning_points[-1]) == "middle":
                found.append(segment.turning_points[-1].sample if passed is None else passed)
        return found

    def _is_first_high(self, segments: Sequence[_Segment]) -> bool:
        """True if repetitions from the middle go to the high side first."""
        for run in segments:
            if self.classify(run.turning_points[0]) == "middle":
                return run.turning_points[1].is_high
        for run in segments:
            if self.classify(run.turning_points[-1]) == "middle":
                return not run.turning_points[-2].is_high
        return segments[0].turning_points[0].is_high


def _typical_extreme(turns: Sequence[_TurningPoint]) -> float:
    """Return the median turning point of one side: of those seen, else those where the hand was still."""
    chosen = [turn for turn in turns if turn.is_seen] or [turn for turn in turns if turn.is_still]
    if chosen:
        return float(np.median([turn.value for turn in chosen]))
    return max(turns, key=lambda turn: turn.distance_beyond(0.0)).value

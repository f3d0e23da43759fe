"""Repetitions and strokes of an exercise, from the turning points of one angle (clinical reference 5)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from carpus.core.measures.signals import Signal, find_runs, low_pass
from carpus.core.model.types import FloatArray

COUNTING_CUTOFF_HZ = 4.0
MIN_AMPLITUDE_RAD = math.radians(10.0)
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
    residual = np.abs(angle.value - smooth)
    residual = residual[np.isfinite(residual)]
    noise = _NOISE_RANGE * (1.4826 * float(np.median(residual)) if len(residual) else 0.0)
    min_amplitude = max(MIN_AMPLITUDE_RAD, noise)
    parts = _split_at_long_gaps(angle)
    usual_swing = _median_swing([_find_turning_points(smooth, min_amplitude, part) for part in parts])
    occluded = tuple((float(start), float(end)) for start, end in angle.gaps_s if end - start > MAX_OCCLUSION_S)
    if math.isnan(usual_swing):
        return RepetitionAnalysis((), (), occluded_s=occluded)
    min_amplitude = max(min_amplitude, _MIN_AMPLITUDE_SHARE * usual_swing)
    tolerance = max(_HYSTERESIS_SHARE * usual_swing, _MIN_HYSTERESIS_RAD)
    still_rad = max(_STILL_SHARE * usual_swing, noise)
    segments = [
        _Segment.with_end_points(smooth, part, points, tolerance, still_rad, angle.rate_hz)
        for part in parts
        if (points := _find_turning_points(smooth, min_amplitude, part))
    ]
    rest, time_s = _RestPosition.from_segments(segments, tolerance), angle.time_s
    strokes: list[Stroke] = []
    whole: list[Repetition] = []
    partial: list[Repetition] = []
    for segment in segments:
        points = segment.turning_points
        for a, b in pairwise(points):
            if abs(b.value - a.value) >= min_amplitude:
                is_half = rest.side is None and "middle" in map(rest.classify, (a, b))
                strokes.append(Stroke(float(time_s[a.sample]), float(time_s[b.sample]), b.is_high, is_half))
        bounds = rest.repetition_boundaries(segment, segments)
        for start, end in pairwise(bounds):
            if time_s[end] - time_s[start] >= MIN_DURATION_S:
                whole.append(_make_repetition(angle, start, end))
        first, last = segment.part.start, segment.part.stop - 1
        if not rest.is_at_rest(points[0]) and points[0].sample not in bounds:
            partial.append(_make_repetition(angle, first, bounds[0] if bounds else last, first))
        # A hand that stops half way and stays there has not come back: the visible part ends in that repetition.
        has_left = rest.side is not None and points[-1].is_high is not rest.side
        has_left = has_left and abs(points[-1].value - points[-2].value) >= min_amplitude
        if (has_left or not rest.is_at_rest(points[-1])) and bounds and bounds[-1] < points[-1].sample:
            partial.append(_make_repetition(angle, bounds[-1], last, last))
    return RepetitionAnalysis(tuple(whole), tuple(strokes), tuple(partial), occluded)


def _make_repetition(angle: Signal, start: int, end: int, cut_at: int | None = None) -> Repetition:
    """Build the repetition between two samples, cut at ``cut_at`` if given."""
    time_s, valid_share = angle.time_s, float(np.isfinite(angle.value[start : end + 1]).mean())
    if cut_at is None:
        return Repetition(float(time_s[start]), float(time_s[end]), valid_share)
    is_gap = angle.is_near_gap(float(time_s[cut_at]), 1.5 / angle.rate_hz)
    reason: CutReason = "cut_by_gap" if is_gap else "cut_by_start" if cut_at == start else "cut_by_end"
    return Repetition(float(time_s[start]), float(time_s[end]), valid_share, reason, float(time_s[cut_at]))


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
    if float(np.ptp(known)) < MIN_AMPLITUDE_RAD:
        return "small_range"
    if any(one.cut == "cut_by_gap" for one in analysis.partial_repetitions):
        return "cut_by_gap"
    # One slow stroke shows that speed was not the reason.
    longest_s = max((one.end_s - one.start_s for one in analysis.strokes), default=0.0)
    return "too_quick" if len(analysis.strokes) > 2 and longest_s < MIN_DURATION_S else "no_return"


def _split_at_long_gaps(angle: Signal) -> list[slice]:
    """Return the samples between gaps that are too long to count across."""
    out: list[slice] = []
    for part in find_runs(angle.is_finite):
        if out and (part.start - out[-1].stop) / angle.rate_hz <= MAX_OCCLUSION_S:
            out[-1] = slice(out[-1].start, part.stop)
        else:
            out.append(part)
    return out


def _find_turning_points(value: FloatArray, min_amplitude: float, part: slice = slice(None)) -> list[_TurningPoint]:
    """Find where a curve (n,) turns back by ``min_amplitude`` or more, highs and lows in turn, with both ends.

    Later samples do not change a turning point once the curve has come back from it.
    """
    known = (part.start or 0) + np.flatnonzero(np.isfinite(value[part]))
    if len(known) < 2:
        return []
    curve = value[known]
    bends = np.flatnonzero(np.diff(np.sign(np.diff(curve)), prepend=2.0, append=2.0) != 0)
    bends = np.unique(np.concatenate(([0], bends, [len(curve) - 1])))

    def point(index: int, *, is_high: bool) -> _TurningPoint:
        return _TurningPoint(is_high, int(known[index]), float(curve[index]))

    turns: list[_TurningPoint] = []
    low = high = int(bends[0])
    rising: bool | None = None
    for at in bends.tolist():
        if curve[at] > curve[high]:
            high = at
        if curve[at] < curve[low]:
            low = at
        if rising is not False and curve[high] - curve[at] >= min_amplitude:
            turns.append(point(high, is_high=True))
            rising, low = False, at
        elif rising is not True and curve[at] - curve[low] >= min_amplitude:
            turns.append(point(low, is_high=False))
            rising, high = True, at
    if rising is not None:
        turns.append(point(high if rising else low, is_high=rising))
    return turns


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
        points = [point for segment in segments for point in segment.turning_points]
        low, high = (_typical_extreme([point for point in points if point.is_high is side]) for side in (False, True))
        rest = cls(low, high, tolerance)
        ends = (segments[0].turning_points[0], segments[-1].turning_points[-1])
        for end in (*(end for end in ends if end.is_still), *ends):
            if rest.classify(end) != "elsewhere":
                return rest if rest.classify(end) == "middle" else replace(rest, side=end.is_high)
        return replace(rest, side=ends[0].is_high)

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
        """Return whether no repetition is under way at an end of the visible part."""
        place = self.classify(point)
        if place in ("middle", "elsewhere"):
            return point.is_still or (self.side is None and place == "middle")
        return point.is_high is self.side

    def repetition_boundaries(self, segment: _Segment, segments: Sequence[_Segment]) -> list[int]:
        """Return the samples at which a repetition begins or ends."""
        if self.side is not None:
            side = "high" if self.side else "low"
            return [one.sample for one in segment.turning_points if self.classify(one) == side]
        points = segment.turning_points
        outer = [one for one in points if one.is_seen or one.distance_beyond(self.middle) >= self.tolerance]
        is_first_high = self._is_first_high([segment, *segments])
        bounds: list[int] = []
        for k, one in enumerate(outer):
            if one.is_high is is_first_high:
                crossing = segment.find_crossing(self.middle, one, before=True)
                if k and crossing is not None:
                    bounds.append(max(crossing, outer[k - 1].sample))
                elif self.classify(points[0]) == "middle":
                    bounds.append(points[0].sample if crossing is None else crossing)
        if outer and outer[-1].is_high is not is_first_high:
            crossing = segment.find_crossing(self.middle, outer[-1], before=False)
            if crossing is not None or self.classify(points[-1]) == "middle":
                bounds.append(points[-1].sample if crossing is None else crossing)
        return bounds

    def _is_first_high(self, segments: Sequence[_Segment]) -> bool:
        """Return whether repetitions from the middle go to the high side first."""
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

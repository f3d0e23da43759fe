"""Reaches of the hand: where each begins and ends, its path, its time, and how far thumb and index finger open.

Hand paper, figures 2 and 3; clinical reference 5 and 8.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.measures.noise import LOWEST_OF_JERKS_HZ, Noise, cutoff_for_speed, no_more_than_seen
from carpus.core.measures.path import QUIET, PathMeasures, measure_path, speed_of
from carpus.core.measures.repetitions import LEAST_RANGE_RAD, Stroke, find_repetitions
from carpus.core.measures.signals import Signal, low_pass
from carpus.core.measures.speed import MOVING_SHARE
from carpus.core.types import FloatArray

LEAST_REACH_M = 0.05
"""A shorter way is no reach (the chord that straightness asks for)."""
HOME_S = 0.5


@dataclass(frozen=True, slots=True)
class Reach:
    """One way out (``outward``) or back, from 5 % to 5 % of its peak speed, with its path.

    Of some no more is known than from which turning point to which they go: ``too_slow``, whose speed is lost in the
    noise, and ``hidden``, of which a part was not seen.
    """

    outward: bool
    start_s: float
    end_s: float
    path: PathMeasures
    too_slow: bool = False
    hidden: bool = False

    @property
    def movement_time_s(self) -> float:
        """NaN where the speed, and so its beginning and end, is not known."""
        return math.nan if self.too_slow or self.hidden else self.end_s - self.start_s


def find_reaches(
    position: Signal, towards: FloatArray | None = None, noise: Noise = QUIET, unseen_s: FloatArray | None = None
) -> tuple[Reach, ...]:
    """Ways out and back of a position (n, 3) as tracked, metres, from where it was in the first half second.

    How much each is smoothed the noise decides: at most ``noise``, and no more than is seen. With ``towards`` (3,), for
    a point that swings to both sides of where it was: to and fro along the line on which it moves most, out being the
    way that goes with that direction. ``unseen_s`` (g, 2) from when to when the point was hidden, though tracked.
    """
    unseen = position.gaps_s if unseen_s is None else np.vstack((position.gaps_s, unseen_s))
    smooth = low_pass(position)
    known = np.flatnonzero(smooth.finite)
    if len(known) < 2:
        return ()
    start_s = float(position.time_s[known[0]])
    home = np.nanmedian(smooth.between(start_s, start_s + HOME_S).value, axis=0)
    away_m = np.linalg.norm(smooth.value - home, axis=1)
    if towards is not None:
        places = smooth.value[known]
        line = np.linalg.svd(places - places.mean(axis=0), full_matrices=False)[2][0]
        away_m = (smooth.value - home) @ (line if float(line @ towards) >= 0.0 else -line)
    # Counted as an angle is, whose least range stands for the least reach.
    strokes = find_repetitions(replace(position, value=away_m * (LEAST_RANGE_RAD / LEAST_REACH_M))).strokes
    found = (_reach(position, smooth, stroke, noise, unseen) for stroke in strokes if not stroke.half)
    return tuple(reach for reach in found if reach is not None)


def _reach(position: Signal, smooth: Signal, stroke: Stroke, most: Noise, unseen_s: FloatArray) -> Reach | None:
    unknown = Reach(stroke.rising, stroke.start_s, stroke.end_s, PathMeasures())
    # A way may have a stop in it (reach, then lift): the part that counts is found in no more noise than it must be.
    rough = _from_rest_to_rest(low_pass(position, LOWEST_OF_JERKS_HZ), stroke)
    if rough is None:
        return None
    if _overlaps(unseen_s, *rough):
        return replace(unknown, hidden=True)
    part = smooth.between(*rough)
    duration_s = max(rough[1] - rough[0], 1.0 / position.rate_hz)
    chord = float(np.linalg.norm(part.value[-1] - part.value[0]))
    around = position.between(stroke.start_s - 0.5 * duration_s, stroke.end_s + 0.5 * duration_s)
    noise = no_more_than_seen(most, around, duration_s)
    # Half as much again as the mean is the least that a movement from rest to rest has for a peak.
    cutoff_hz = cutoff_for_speed(noise, 1.5 * chord / duration_s, duration_s)
    if math.isnan(cutoff_hz):
        return replace(unknown, too_slow=True)
    ends = _from_rest_to_rest(low_pass(position, cutoff_hz), stroke)
    if ends is None:
        return None
    if _overlaps(unseen_s, *ends):
        return replace(unknown, hidden=True)
    return Reach(stroke.rising, *ends, measure_path(position, *ends, cutoff_hz, noise))


def _overlaps(unseen_s: FloatArray, start_s: float, end_s: float) -> bool:
    return bool(((unseen_s[:, 0] <= end_s) & (unseen_s[:, 1] >= start_s)).any())


def _from_rest_to_rest(position: Signal, stroke: Stroke) -> tuple[float, float] | None:
    """When a stroke's speed leaves 5 % of its peak and comes back to it."""
    speed = speed_of(position)
    inside = (position.time_s >= stroke.start_s) & (position.time_s <= stroke.end_s) & np.isfinite(speed)
    if not inside.any():
        return None
    peak_at = int(np.argmax(np.where(inside, speed, -math.inf)))
    begin, end = (_slow_at(speed, peak_at, step, MOVING_SHARE * speed[peak_at]) for step in (-1, +1))
    # Who turns without stopping is never slow: the turning points end the way at the latest.
    return max(float(position.time_s[begin]), stroke.start_s), min(float(position.time_s[end]), stroke.end_s)


def _slow_at(speed: FloatArray, peak_at: int, step: int, level: float) -> int:
    k = peak_at
    while 0 <= k + step < len(speed) and math.isfinite(speed[k + step]) and speed[k] >= level:
        k += step
    return k


def distance_m(one_m: FloatArray, other_m: FloatArray) -> FloatArray:
    """Distances (N,) of two points (N, 3): the aperture of TIP1 and TIP2, the span of TIP1 and TIP5."""
    return np.asarray(np.linalg.norm(one_m - other_m, axis=-1), dtype=np.float64)

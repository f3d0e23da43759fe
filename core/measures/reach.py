"""Reaches of the hand: onset, offset, path and duration (hand paper, figures 2 and 3).

Clinical reference 5 and 8.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.measures.noise import (
    DIP_SDS,
    MAX_CUTOFF_HZ,
    MIN_SMOOTHNESS_CUTOFF_HZ,
    Noise,
    cutoff_for_smoothness,
    cutoff_for_speed,
    limit_noise,
)
from carpus.core.measures.repetitions import MIN_AMPLITUDE_RAD, Stroke, find_repetitions
from carpus.core.measures.signals import Signal, low_pass, rate_of_change
from carpus.core.measures.speed import MIN_PEAK_M_S, ONSET_SPEED_SHARE, count_speed_peaks, sparc
from carpus.core.model.types import FloatArray

MIN_CHORD_M = 0.050
MIN_PEAK_RISE_M_S = 0.020
WRIST_NOISE = {True: Noise(0.0005, 0.08), False: Noise(0.0007, 0.05)}
"""Largest noise of the WRIST marker's position, smoothed (True) and live (False).

Systematic error moves with the hand. Fitted to simulated reaches with truth at 0.65 to 0.75 m.
"""
TIP_NOISE = {True: Noise(0.0012, 0.12), False: Noise(0.0017, 0.08)}
"""The same for a fingertip in the hand's axes."""
NO_NOISE = Noise(0.0, 1.0)


@dataclass(frozen=True, slots=True)
class PathMeasures:
    """Measures of one path; all NaN if it has a gap.

    ``straightness`` is length over chord (1 is straight), NaN for a chord below 50 mm. ``peaks`` and ``sparc`` are NaN
    where noise would pass for jerk, ``peaks`` also if none rises by 20 mm/s. ``time_to_peak_share`` is 0 to 1.
    """

    length_m: float = math.nan
    straightness: float = math.nan
    peak_speed_m_s: float = math.nan
    time_to_peak_share: float = math.nan
    peaks: float = math.nan
    sparc: float = math.nan


def measure_path(
    position: Signal, start_s: float, end_s: float, cutoff_hz: float = math.inf, noise: Noise = NO_NOISE
) -> PathMeasures:
    """Measure a position (n, 3) in metres from onset ``start_s`` to offset ``end_s``.

    Noise lengthens a path, so it is low-passed at ``cutoff_hz``. Peaks and smoothness are low-passed as ``noise``
    requires.
    """
    smooth = low_pass(position, cutoff_hz)
    part = smooth.crop(start_s, end_s)
    if len(part.time_s) < 2 or not part.is_finite.all():
        return PathMeasures()
    length = float(np.linalg.norm(np.diff(part.value, axis=0), axis=1).sum())
    chord = float(np.linalg.norm(part.value[-1] - part.value[0]))
    speed = compute_speed(smooth, start_s, end_s)
    for_smoothness = cutoff_for_smoothness(noise, length, end_s - start_s)
    for_peaks = _cutoff_for_peaks(noise, cutoff_hz)
    peaks = spectrum = math.nan
    if not math.isnan(for_peaks):
        units = compute_speed(low_pass(position, for_peaks), start_s, end_s)
        dip = DIP_SDS * noise.speed_sd(min(for_peaks, MAX_CUTOFF_HZ))
        peaks = float(count_speed_peaks(units, part.rate_hz, MIN_PEAK_RISE_M_S, min_dip=dip)) or math.nan
    if not math.isnan(for_smoothness):
        whole = compute_speed(low_pass(position, for_smoothness), start_s, end_s)
        spectrum = sparc(whole, part.rate_hz, MIN_PEAK_M_S)
    return PathMeasures(
        length_m=length,
        straightness=length / chord if chord >= MIN_CHORD_M else math.nan,
        peak_speed_m_s=float(speed.max()),
        time_to_peak_share=float(np.argmax(speed)) / (len(speed) - 1),
        peaks=peaks,
        sparc=spectrum,
    )


def _cutoff_for_peaks(noise: Noise, max_hz: float) -> float:
    """Return the highest cut-off at which noise alone makes no peak; NaN if real peaks would be lost too."""
    if not noise.sd > 0.0:
        return max_hz
    top = min(max(max_hz, MIN_SMOOTHNESS_CUTOFF_HZ), MAX_CUTOFF_HZ)
    tried = np.geomspace(top, MIN_SMOOTHNESS_CUTOFF_HZ, 40)
    return float(next((hz for hz in tried if DIP_SDS * noise.speed_sd(hz) <= MIN_PEAK_RISE_M_S), math.nan))


def compute_speed(position: Signal, start_s: float = -math.inf, end_s: float = math.inf) -> FloatArray:
    """Return the speed (n,) of a position (n, 3) between two times, m/s."""
    return np.asarray(np.linalg.norm(rate_of_change(position).crop(start_s, end_s).value, axis=1))


MIN_REACH_M = 0.05
"""A shorter movement is no reach (the chord that straightness requires)."""
START_S = 0.5


@dataclass(frozen=True, slots=True)
class Reach:
    """One reach out or back, from 5 % to 5 % of its peak speed, with its path.

    ``is_too_slow`` (speed lost in noise) and ``is_occluded`` reaches have turning points as start and end, and no path.
    """

    is_outward: bool
    start_s: float
    end_s: float
    path: PathMeasures
    is_too_slow: bool = False
    is_occluded: bool = False

    @property
    def movement_time_s(self) -> float:
        """Movement time; NaN if onset and offset are unknown."""
        return math.nan if self.is_too_slow or self.is_occluded else self.end_s - self.start_s


def find_reaches(
    position: Signal, direction: FloatArray | None = None, noise: Noise = NO_NOISE, occluded_s: FloatArray | None = None
) -> tuple[Reach, ...]:
    """Find the reaches out and back of a position, starting from its place in the first half second.

    Parameters
    ----------
    position
        (n, 3) tracked position, m
    direction
        (3,) for a point that swings to both sides of its start: reaches go along its main axis, out is this way
    noise
        largest noise; less is assumed where the data are quieter
    occluded_s
        (g, 2) start and end of occlusions, although tracked
    """
    hidden_s = position.gaps_s if occluded_s is None else np.vstack((position.gaps_s, occluded_s))
    smooth = low_pass(position)
    known = np.flatnonzero(smooth.is_finite)
    if len(known) < 2:
        return ()
    start_s = float(position.time_s[known[0]])
    start = np.nanmedian(smooth.crop(start_s, start_s + START_S).value, axis=0)
    distance_from_start_m = np.linalg.norm(smooth.value - start, axis=1)
    if direction is not None:
        places = smooth.value[known]
        line = np.linalg.svd(places - places.mean(axis=0), full_matrices=False)[2][0]
        distance_from_start_m = (smooth.value - start) @ (line if float(line @ direction) >= 0.0 else -line)
    # Repetitions are found as in an angle, with its least range for the least reach.
    strokes = find_repetitions(
        replace(position, value=distance_from_start_m * (MIN_AMPLITUDE_RAD / MIN_REACH_M))
    ).strokes
    found = (_measure_reach(position, smooth, stroke, noise, hidden_s) for stroke in strokes if not stroke.is_half)
    return tuple(reach for reach in found if reach is not None)


def _measure_reach(
    position: Signal, smooth: Signal, stroke: Stroke, stated_noise: Noise, occluded_s: FloatArray
) -> Reach | None:
    unknown = Reach(stroke.is_rising, stroke.start_s, stroke.end_s, PathMeasures())
    # A reach may contain a stop (reach, then lift): a low cut-off finds the part that counts despite the noise.
    rough = _movement_interval(low_pass(position, MIN_SMOOTHNESS_CUTOFF_HZ), stroke)
    if rough is None:
        return None
    if _is_overlapping(occluded_s, *rough):
        return replace(unknown, is_occluded=True)
    part = smooth.crop(*rough)
    duration_s = max(rough[1] - rough[0], 1.0 / position.rate_hz)
    chord = float(np.linalg.norm(part.value[-1] - part.value[0]))
    around = position.crop(stroke.start_s - 0.5 * duration_s, stroke.end_s + 0.5 * duration_s)
    noise = limit_noise(stated_noise, around, duration_s)
    # The peak of a movement from rest to rest is at least 1.5 times its mean.
    cutoff_hz = cutoff_for_speed(noise, 1.5 * chord / duration_s, duration_s)
    if math.isnan(cutoff_hz):
        return replace(unknown, is_too_slow=True)
    ends = _movement_interval(low_pass(position, cutoff_hz), stroke)
    if ends is None:
        return None
    if _is_overlapping(occluded_s, *ends):
        return replace(unknown, is_occluded=True)
    return Reach(stroke.is_rising, *ends, measure_path(position, *ends, cutoff_hz, noise))


def _is_overlapping(occluded_s: FloatArray, start_s: float, end_s: float) -> bool:
    return bool(((occluded_s[:, 0] <= end_s) & (occluded_s[:, 1] >= start_s)).any())


def _movement_interval(position: Signal, stroke: Stroke) -> tuple[float, float] | None:
    """Return when the speed of a stroke leaves 5 % of its peak and comes back to it."""
    speed = compute_speed(position)
    inside = (position.time_s >= stroke.start_s) & (position.time_s <= stroke.end_s) & np.isfinite(speed)
    if not inside.any():
        return None
    peak_at = int(np.argmax(np.where(inside, speed, -math.inf)))
    begin, end = (_find_slow_sample(speed, peak_at, step, ONSET_SPEED_SHARE * speed[peak_at]) for step in (-1, +1))
    # A hand that turns without stopping is never slow: the turning points are the latest ends.
    return max(float(position.time_s[begin]), stroke.start_s), min(float(position.time_s[end]), stroke.end_s)


def _find_slow_sample(speed: FloatArray, peak_at: int, step: int, level: float) -> int:
    k = peak_at
    while 0 <= k + step < len(speed) and math.isfinite(speed[k + step]) and speed[k] >= level:
        k += step
    return k


def distance_m(one_m: FloatArray, other_m: FloatArray) -> FloatArray:
    """Return the distances (N,) of two points (N, 3): grip aperture (TIP1, TIP2), hand span (TIP1, TIP5)."""
    return np.asarray(np.linalg.norm(one_m - other_m, axis=-1), dtype=np.float64)

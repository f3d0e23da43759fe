"""Speed and timing of single strokes of an angle (clinical reference 5), smoothed as much as its noise asks for.

Never from the filter's own angular velocity noise: differentiate the smoothed angle (reference 4.5).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.noise import (
    DIP_IN_SDS,
    LOWEST_OF_JERKS_HZ,
    Noise,
    cutoff_for_jerk,
    cutoff_for_smoothness,
    cutoff_for_speed,
    moving_noise,
)
from carpus.core.measures.repetitions import LEAST_RANGE_RAD, Stroke
from carpus.core.measures.signals import Signal, low_pass, rate_of_change
from carpus.core.measures.smoothness import LEAST_PEAK_RAD_S, log_dimensionless_jerk, sparc, speed_peaks
from carpus.core.types import FloatArray

MOVING_SHARE = 0.05
"""Onset and offset are where the speed passes this share of the stroke's peak."""
_PEAK_RISE_SHARE = 0.10
_EDGE_SHARE, _EDGES_TO_REST = 0.1, 1.65
"""Of a minimum-jerk movement the way between both edges takes 0.507 of the time, and that above 5 % of the peak speed
0.836."""


@dataclass(frozen=True, slots=True)
class StrokeMeasures:
    """One stroke. Speeds in rad/s without sign; ``movement_time_s`` from onset to offset; smoothness dimensionless.

    ``peak_speed_sd_rad_s`` what noise leaves in the peak speed. ``too_slow``: the noise is too large for this speed,
    which is then unknown, and ``too_slow_to_be_smooth`` for its smoothness.
    """

    stroke: Stroke
    arc_rad: float
    peak_speed_rad_s: float = math.nan
    mean_speed_rad_s: float = math.nan
    movement_time_s: float = math.nan
    time_to_peak_share: float = math.nan
    peaks: float = math.nan
    sparc: float = math.nan
    ldlj: float = math.nan
    peak_speed_sd_rad_s: float = math.nan
    too_slow: bool = False
    too_slow_to_be_smooth: bool = False


def measure_stroke(angle: Signal, stroke: Stroke, sd: Signal | None = None, *, smoothed: bool = True) -> StrokeMeasures:
    """Speed, timing and smoothness of one stroke of an angle (rad) as tracked, with its stated ``sd``.

    How much it is smoothed the noise decides. Everything but the arc is NaN when the arc is below 10 degrees or the
    stroke has a gap; movement time and what follows from it also when the speed does not fall below 5 % of its peak on
    both sides. Movement time counts from 5 % to 5 % of the peak; smoothness is that of the whole stroke, from where the
    speed left zero, or its last minimum, to where it is back, as published figures have it.
    """
    part = angle.between(stroke.start_s, stroke.end_s)
    arc = float(np.nanmax(part.value) - np.nanmin(part.value)) if part.finite.any() else math.nan
    if not arc >= LEAST_RANGE_RAD or not part.finite.all():
        return StrokeMeasures(stroke, arc)
    toward = 1.0 if stroke.rising else -1.0
    duration_s = usual_duration_s(low_pass(angle).between(stroke.start_s, stroke.end_s).value, angle.rate_hz)
    noise, for_speed = _noise_and_cutoff(angle, stroke, sd, arc, duration_s, smoothed=smoothed)
    if math.isnan(for_speed):
        return StrokeMeasures(stroke, arc, too_slow=True, too_slow_to_be_smooth=True)
    moved = _moved(angle, stroke, toward, for_speed)
    if moved is None and _cut_short(angle, stroke):
        return StrokeMeasures(stroke, arc)
    if moved is None:
        # Never at rest on both sides: where the rough curve began and ended was noise, so the whole stroke decides.
        noise, for_speed = _noise_and_cutoff(angle, stroke, sd, arc, stroke.end_s - stroke.start_s, smoothed=smoothed)
        if math.isnan(for_speed):
            return StrokeMeasures(stroke, arc, too_slow=True, too_slow_to_be_smooth=True)
        velocity = toward * rate_of_change(low_pass(angle, for_speed).between(stroke.start_s, stroke.end_s)).value
        return StrokeMeasures(stroke, arc, _top(np.abs(velocity)), peak_speed_sd_rad_s=noise.speed_sd(for_speed))
    smooth = _moved(angle, stroke, toward, cutoff_for_smoothness(noise, arc, moved.duration_s))
    jerk = _moved(angle, stroke, toward, cutoff_for_jerk(noise, arc, moved.duration_s))
    least_rise = max(_PEAK_RISE_SHARE * moved.top, LEAST_PEAK_RAD_S)
    dip = DIP_IN_SDS * noise.speed_sd(for_speed)
    return StrokeMeasures(
        stroke=stroke,
        arc_rad=arc,
        peak_speed_rad_s=moved.peak,
        mean_speed_rad_s=arc / moved.duration_s,
        movement_time_s=moved.duration_s,
        time_to_peak_share=moved.to_peak_share,
        peaks=float(speed_peaks(moved.moving, angle.rate_hz, least_rise, least_dip=dip))
        if for_speed >= LOWEST_OF_JERKS_HZ and dip <= least_rise
        else math.nan,
        sparc=math.nan if smooth is None else sparc(smooth.whole, angle.rate_hz, LEAST_PEAK_RAD_S),
        ldlj=math.nan if jerk is None else log_dimensionless_jerk(jerk.whole, angle.rate_hz, LEAST_PEAK_RAD_S),
        peak_speed_sd_rad_s=noise.speed_sd(for_speed),
        too_slow_to_be_smooth=smooth is None,
    )


def usual_duration_s(way: FloatArray, rate_hz: float) -> float:
    """How long a way (n,), from one turning point to the next, takes from 5 % to 5 % of its peak speed, told from where
    it passes a tenth and nine tenths: a speed that is mostly noise would call its own quick waves the movement."""
    share = (way - way[0]) / (way[-1] - way[0]) if way[-1] != way[0] else np.linspace(0.0, 1.0, len(way))
    there = int(np.argmax(share >= 1.0 - _EDGE_SHARE))
    left = int(np.flatnonzero(share[: there + 1] <= _EDGE_SHARE)[-1])
    return max(there - left, 1) / rate_hz * _EDGES_TO_REST


def _cut_short(angle: Signal, stroke: Stroke) -> bool:
    """Whether a gap, and no turning point, ends the stroke: it may have been faster where it was not seen."""
    return any(angle.beside_gap(at, 1.5 / angle.rate_hz) for at in (stroke.start_s, stroke.end_s))


def _noise_and_cutoff(
    angle: Signal, stroke: Stroke, sd: Signal | None, arc: float, duration_s: float, *, smoothed: bool
) -> tuple[Noise, float]:
    """The noise around a stroke that took ``duration_s``, and the cut-off (Hz) for its speed, NaN when too slow."""
    noise = Noise(0.0, 1.0)
    if sd is not None:
        around = (stroke.start_s - 0.5 * duration_s, stroke.end_s + 0.5 * duration_s)
        noise = moving_noise(angle.between(*around), sd.between(*around), duration_s, smoothed=smoothed)
    # Half as much again as the mean is the least that a movement from rest to rest has for a peak.
    return noise, cutoff_for_speed(noise, 1.5 * arc / duration_s, duration_s)


@dataclass(frozen=True, slots=True)
class _Moved:
    """A stroke after a low-pass: speed above 5 % of the peak (``moving``), and from rest to rest (``whole``)."""

    peak: float
    top: float
    duration_s: float
    to_peak_share: float
    moving: FloatArray
    whole: FloatArray


def _moved(angle: Signal, stroke: Stroke, toward: float, cutoff_hz: float) -> _Moved | None:
    """None where the speed does not fall below 5 % of its peak on both sides, and where no cut-off will do (NaN)."""
    if math.isnan(cutoff_hz):
        return None
    velocity = toward * rate_of_change(low_pass(angle, cutoff_hz)).value
    first, last = np.searchsorted(angle.time_s, (stroke.start_s - 1e-9, stroke.end_s + 0.25 / angle.rate_hz))
    inside = velocity[first:last]
    if not np.isfinite(inside).any():
        return None
    peak_at = int(first) + int(np.nanargmax(inside))
    top = float(velocity[peak_at])
    onset = _crossing(velocity, peak_at, -1, MOVING_SHARE * top)
    offset = _crossing(velocity, peak_at, +1, MOVING_SHARE * top)
    if not offset > onset:
        return None
    begin, end = math.ceil(onset), math.floor(offset)
    from_rest, to_rest = _to_rest(velocity, begin, -1), _to_rest(velocity, end, +1)
    return _Moved(
        peak=_top(np.abs(inside)),
        top=top,
        duration_s=(offset - onset) / angle.rate_hz,
        to_peak_share=(peak_at - onset) / (offset - onset),
        moving=np.abs(velocity[begin : end + 1]),
        whole=np.abs(velocity[from_rest : to_rest + 1]),
    )


def _top(speed: FloatArray) -> float:
    return float(np.nanpercentile(speed, 99.0))


def _to_rest(velocity: FloatArray, sample: int, step: int) -> int:
    """The sample outwards of the movement at which the speed is at rest: zero, or no longer falling."""
    k = sample
    while 0 <= k + step < len(velocity) and 0.0 < velocity[k + step] < velocity[k]:
        k += step
    return k


def _crossing(velocity: FloatArray, peak_at: int, step: int, level: float) -> float:
    """Fractional sample at which the speed, walked from its peak, first falls below a level; NaN if it never does."""
    k = peak_at
    while 0 <= k + step < len(velocity) and math.isfinite(velocity[k + step]):
        if velocity[k + step] < level:
            return k + step * float((velocity[k] - level) / (velocity[k] - velocity[k + step]))
        k += step
    return math.nan

"""Speed and timing of single strokes of an angle (clinical reference 5), from the low-passed angle.

Never from the filter's own angular velocity noise: differentiate the smoothed angle (reference 4.5).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.measures.repetitions import LEAST_RANGE_RAD, Stroke
from core.measures.signals import Signal, rate_of_change
from core.measures.smoothness import LEAST_PEAK_RAD_S, log_dimensionless_jerk, sparc, speed_peaks
from core.types import FloatArray

MOVING_SHARE = 0.05
"""Onset and offset are where the speed passes this share of the stroke's peak."""
_PEAK_RISE_SHARE = 0.10


@dataclass(frozen=True, slots=True)
class StrokeMeasures:
    """One stroke. Speeds in rad/s without sign; ``movement_time_s`` from onset to offset; smoothness dimensionless."""

    stroke: Stroke
    arc_rad: float
    peak_speed_rad_s: float
    mean_speed_rad_s: float
    movement_time_s: float
    time_to_peak_share: float
    peaks: float
    sparc: float
    ldlj: float


def measure_stroke(angle: Signal, stroke: Stroke) -> StrokeMeasures:
    """Speed, timing and smoothness of one stroke of a low-passed angle (rad).

    Everything but the arc is NaN when the arc is below 10 degrees or the stroke has a gap; movement time and what
    follows from it also when the speed does not fall below 5 % of its peak on both sides.
    """
    part = angle.between(stroke.start_s, stroke.end_s)
    arc = float(np.nanmax(part.value) - np.nanmin(part.value)) if part.finite.any() else math.nan
    if not arc >= LEAST_RANGE_RAD or not part.finite.all():
        return StrokeMeasures(stroke, arc, *([math.nan] * 7))
    toward = 1.0 if stroke.rising else -1.0
    velocity = toward * rate_of_change(angle).value
    first = int(np.searchsorted(angle.time_s, part.time_s[0]))
    peak_at = first + int(np.argmax(velocity[first : first + len(part.time_s)]))
    top = float(velocity[peak_at])
    peak = float(np.percentile(np.abs(velocity[first : first + len(part.time_s)]), 99.0))
    onset = _crossing(velocity, peak_at, -1, MOVING_SHARE * top)
    offset = _crossing(velocity, peak_at, +1, MOVING_SHARE * top)
    duration = (offset - onset) / angle.rate_hz
    if not duration > 0.0:
        return StrokeMeasures(stroke, arc, peak, *([math.nan] * 6))
    moving = np.abs(velocity[math.ceil(onset) : math.floor(offset) + 1])
    return StrokeMeasures(
        stroke=stroke,
        arc_rad=arc,
        peak_speed_rad_s=peak,
        mean_speed_rad_s=arc / duration,
        movement_time_s=duration,
        time_to_peak_share=(peak_at - onset) / (offset - onset),
        peaks=float(speed_peaks(moving, angle.rate_hz, max(_PEAK_RISE_SHARE * top, LEAST_PEAK_RAD_S))),
        sparc=sparc(moving, angle.rate_hz, LEAST_PEAK_RAD_S),
        ldlj=log_dimensionless_jerk(moving, angle.rate_hz, LEAST_PEAK_RAD_S),
    )


def _crossing(velocity: FloatArray, peak_at: int, step: int, level: float) -> float:
    """Fractional sample at which the speed, walked from its peak, first falls below a level; NaN if it never does."""
    k = peak_at
    while 0 <= k + step < len(velocity) and math.isfinite(velocity[k + step]):
        if velocity[k + step] < level:
            return k + step * float((velocity[k] - level) / (velocity[k] - velocity[k + step]))
        k += step
    return math.nan

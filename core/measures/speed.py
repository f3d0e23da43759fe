"""Speed, timing and smoothness of strokes of an angle (clinical reference 5).

A stroke goes from leaving one turning point to reaching the next; pauses are part of it. Smoothness is SPARC
(Balasubramanian et al. 2012, doi 10.1109/TBME.2011.2179545; 2015, doi 10.1186/s12984-015-0090-9) and nothing else:
log dimensionless jerk needs the third derivative, in which the noise of a camera outweighs the movement. Speed profiles
(n,) are evenly sampled and low-passed as much as their noise requires. They come from the smoothed angle, never from
the filter's angular velocity (reference 4.5).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from carpus.core.measures.noise import (
    DIP_SDS,
    MAX_CUTOFF_HZ,
    MIN_SMOOTHNESS_CUTOFF_HZ,
    Noise,
    clean_cutoff_hz,
    cutoff_for_smoothness,
    cutoff_for_speed,
    estimate_extreme,
    max_cutoff_for_speed,
    moving_noise,
)
from carpus.core.measures.repetitions import MIN_AMPLITUDE_RAD, Stroke
from carpus.core.measures.signals import SPEED_CUTOFF_HZ, Signal, find_runs, low_pass, rate_of_change
from carpus.core.model.types import FloatArray

MIN_SAMPLES = 8
MIN_PEAK_RAD_S = math.radians(5.0)
MIN_PEAK_M_S = 0.010
_PAD_LEVEL = 4
_MAX_SPARC_HZ = 10.0
_MIN_SPARC_AMPLITUDE = 0.05


def sparc(speed: FloatArray, rate_hz: float, min_peak: float = 0.0) -> float:
    """Compute the spectral arc length, dimensionless and below 0; smoother movements are nearer to 0.

    ``-integral_0^wc sqrt((1/wc)^2 + (dV/dw)^2) dw`` of the normalised amplitude spectrum V, zero-padded to 2^(ceil(log2
    n) + 4), up to the last frequency of at most 10 Hz with V of 0.05 or more. NaN below 8 samples, with a gap, or with
    a peak below ``min_peak``.

    >>> t = np.arange(-100, 100) / 100
    >>> round(sparc(np.exp(-5 * t**2), 100.0), 5)
    -1.41403
    """
    peak = float(np.abs(speed).max()) if len(speed) >= MIN_SAMPLES else math.nan  # NaN with a gap
    if not (peak > 0.0 and peak >= min_peak):
        return math.nan
    length = 2 ** (math.ceil(math.log2(len(speed))) + _PAD_LEVEL)
    spectrum = np.abs(np.fft.rfft(speed, length))
    frequency = np.fft.rfftfreq(length, 1.0 / rate_hz)
    spectrum = spectrum / spectrum.max()
    kept = np.flatnonzero((frequency <= _MAX_SPARC_HZ) & (spectrum >= _MIN_SPARC_AMPLITUDE))
    curve = spectrum[kept[0] : kept[-1] + 1]
    if len(curve) < 2:
        return math.nan
    steps = len(curve) - 1
    return -float(np.sqrt(1.0 / steps**2 + np.diff(curve) ** 2).sum())


_MIN_PEAK_INTERVAL_S = 0.15


def count_speed_peaks(speed: FloatArray, rate_hz: float, min_rise: float, min_dip: float = 0.0) -> int:
    """Count movement units: maxima more than ``min_rise`` above the minimum before, at least 0.15 s apart.

    Reference: 20 mm/s for a position, the greater of 10 % of the peak and 5 degrees/s for an angle; 1 is ideal. A dip
    smaller than ``min_dip`` is noise and separates no maxima.
    """
    from scipy import signal as sps  # half a second to load, and not needed before something has been recorded

    count, last_counted, last_top = 0, -math.inf, 0
    for top in sps.find_peaks(speed, prominence=min_dip)[0].tolist():
        rise = speed[top] - speed[last_top : top + 1].min()
        if rise > min_rise and (top - last_counted) / rate_hz >= _MIN_PEAK_INTERVAL_S:
            count += 1
            last_counted = top
        last_top = top
    return count


ONSET_SPEED_SHARE = 0.05
"""Onset and offset are where the speed passes this share of the stroke's peak."""
TURNING_BAND_SHARE = 0.05
"""Within this share of the arc from its extreme the movement has arrived, even if it creeps on. Noise may need more."""
PAUSE_SPEED_SHARE, MIN_PAUSE_S = 0.10, 0.2
"""A pause is slower than this share of the peak for so long; turns between sub-movements are shorter."""
_PAUSE_SDS = 2.0
"""Pauses are unknown where noise alone passes the pause speed."""
_PEAK_RISE_SHARE = 0.10
_EDGE_SHARE, _EDGES_TO_DURATION = 0.1, 1.74
"""In a minimum-jerk movement 10 to 90 % of the way take 0.507 of the time, above 5 % of the peak 0.881."""
_HALF_HEIGHT_SHARE = 0.541
"""Share of the time that a minimum-jerk movement is above half its peak."""
_MAX_SUBMOVEMENT_SHARE, _SUBMOVEMENT_SDS = 0.6, 2.0
"""A shorter quickest part is a sub-movement, if it is so much above the noise."""
_NOISE_MARGIN_CYCLES = 3.0
"""Simulated noise is drawn so much longer at each end, where the low-pass differs."""
_NO_GAPS = np.empty((0, 2))
_FILTER_MARGIN_CYCLES, _FILTER_MARGIN_S = 8.0, 5.0
"""A low-pass forgets within so many cycles of its cut-off; movements end within so many seconds."""


@dataclass(frozen=True, slots=True)
class StrokeMeasures:
    """Measures of one stroke: unsigned speeds in rad/s, smoothness dimensionless.

    ``movement_time_s`` goes from ``onset_s`` to ``offset_s`` with pauses; ``pause_s`` is their total.
    ``peak_speed_sd_rad_s`` and ``sparc_sd()`` are what noise leaves in peak speed and SPARC. ``too_slow`` and
    ``too_slow_to_be_smooth``: speed or smoothness is unknown, because noise is too large for this speed.
    """

    stroke: Stroke
    peak_speed_rad_s: float = math.nan
    mean_speed_rad_s: float = math.nan
    movement_time_s: float = math.nan
    time_to_peak_share: float = math.nan
    peaks: float = math.nan
    pauses: float = math.nan
    pause_s: float = math.nan
    sparc: float = math.nan
    sparc_sd: Callable[[], float] = field(default=partial(float, "nan"), compare=False)
    """Of simulated noise, which takes its time: only where it is written."""
    peak_speed_sd_rad_s: float = math.nan
    onset_s: float = math.nan
    offset_s: float = math.nan
    too_slow: bool = False
    too_slow_to_be_smooth: bool = False


def measure_stroke(angle: Signal, stroke: Stroke, sd: Signal | None = None, *, smoothed: bool = True) -> StrokeMeasures:
    """Measure speed, timing and smoothness of one stroke of a tracked angle (rad) with its stated ``sd``.

    The noise decides how much the angle is low-passed. All is NaN if the arc is below 10 degrees or the stroke has a
    gap. Movement time counts from 5 % to 5 % of the peak speed; it and what follows from it are NaN if the speed does
    not fall so far on both sides. Smoothness is that of the whole stroke, from rest, or the last minimum of speed, to
    rest, as in published values. Movement units are NaN if none rises by 5 degrees/s.
    """
    part = _low_pass_stroke(angle, stroke, MAX_CUTOFF_HZ).crop(stroke.start_s, stroke.end_s)
    if not part.is_finite.all() or len(part.time_s) < 2:
        return StrokeMeasures(stroke)
    smooth_part = _low_pass_stroke(angle, stroke, SPEED_CUTOFF_HZ).crop(stroke.start_s, stroke.end_s)
    duration_s = estimate_duration_s(smooth_part.value, angle.rate_hz)
    noise = _stroke_noise(angle, stroke, sd, duration_s, smoothed=smoothed)
    clean = low_pass(part, clean_cutoff_hz(duration_s)).value
    high, low = (estimate_extreme(part.value, clean, noise, part.rate_hz, largest=end)[0] for end in (True, False))
    arc = high - low
    if not arc >= MIN_AMPLITUDE_RAD:
        return StrokeMeasures(stroke)
    speed_cutoff_hz, submovement_s = _find_quickest_part(angle, stroke, noise, arc, duration_s)
    if math.isnan(speed_cutoff_hz):
        return StrokeMeasures(stroke, too_slow=True, too_slow_to_be_smooth=True)
    motion = _measure_motion(angle, stroke, noise, speed_cutoff_hz)
    if motion is None:
        return _measure_without_rest(angle, stroke, sd, arc, smoothed=smoothed)
    measured = motion.measures
    cutoff_hz = cutoff_for_smoothness(noise, arc, measured.movement_time_s, submovement_s)
    smooth = _measure_motion(angle, stroke, noise, cutoff_hz)
    speed_sd, peak = noise.speed_sd(speed_cutoff_hz), measured.peak_speed_rad_s
    is_detailed = speed_cutoff_hz >= MIN_SMOOTHNESS_CUTOFF_HZ
    if not (is_detailed and _PAUSE_SDS * speed_sd <= PAUSE_SPEED_SHARE * peak):
        measured = replace(measured, pauses=math.nan, pause_s=math.nan)
    min_rise, min_dip = max(_PEAK_RISE_SHARE * peak, MIN_PEAK_RAD_S), DIP_SDS * speed_sd
    if is_detailed and min_dip <= min_rise:
        peaks = count_speed_peaks(motion.onset_to_offset, angle.rate_hz, min_rise, min_dip)
        measured = replace(measured, peaks=float(peaks) or math.nan)
    if smooth is not None:
        measured = replace(
            measured,
            sparc=sparc(smooth.rest_to_rest, angle.rate_hz, MIN_PEAK_RAD_S),
            sparc_sd=partial(_estimate_sparc_sd, smooth.rest_to_rest, angle.rate_hz, noise, cutoff_hz),
        )
    return replace(measured, peak_speed_sd_rad_s=speed_sd, too_slow_to_be_smooth=math.isnan(measured.sparc))


def _estimate_sparc_sd(speed: FloatArray, rate_hz: float, noise: Noise, cutoff_hz: float) -> float:
    """Estimate the standard deviation of the SPARC of a speed (n,) by adding simulated noise to it.

    The noise passes the low-pass and the derivative that the angle passed.
    """
    if not noise.sd > 0.0:
        return 0.0
    margin = math.ceil(_NOISE_MARGIN_CYCLES * rate_hz / cutoff_hz)
    drawn = noise.sample(len(speed) + 2 * margin, rate_hz).T
    added = rate_of_change(low_pass(Signal(np.arange(len(drawn)) / rate_hz, drawn, rate_hz, 1.0, _NO_GAPS), cutoff_hz))
    inside = added.value[margin : margin + len(speed)].T
    return float(np.std([sparc(np.abs(speed + one), rate_hz) for one in inside], ddof=1))


def _measure_without_rest(
    angle: Signal, stroke: Stroke, sd: Signal | None, arc: float, *, smoothed: bool
) -> StrokeMeasures:
    """Measure the peak speed of a stroke that was never at rest on both sides.

    Onset and offset of its rough curve were noise, so the whole stroke decides how much it is low-passed.
    """
    # Ended by a gap or by the recording, it may have been faster beyond.
    near_s = 1.5 / angle.rate_hz
    at_end = stroke.start_s - angle.time_s[0] < near_s or angle.time_s[-1] - stroke.end_s < near_s
    if at_end or any(angle.is_near_gap(time_s, near_s) for time_s in (stroke.start_s, stroke.end_s)):
        return StrokeMeasures(stroke)
    duration_s = stroke.end_s - stroke.start_s
    noise = _stroke_noise(angle, stroke, sd, duration_s, smoothed=smoothed)
    cutoff_hz = cutoff_for_speed(noise, _MIN_PEAK_TO_MEAN * arc / duration_s, duration_s)
    if math.isnan(cutoff_hz):
        return StrokeMeasures(stroke, too_slow=True, too_slow_to_be_smooth=True)
    speed = _stroke_speed(angle, stroke, cutoff_hz)
    return StrokeMeasures(stroke, float(speed.max()), peak_speed_sd_rad_s=noise.speed_sd(cutoff_hz))


def estimate_duration_s(angle: FloatArray, rate_hz: float) -> float:
    """Estimate the duration of a stroke (n,) from the times of 10 % and 90 % of its way.

    A speed that is mostly noise would give the duration of the noise.
    """
    share = (angle - angle[0]) / (angle[-1] - angle[0]) if angle[-1] != angle[0] else np.linspace(0.0, 1.0, len(angle))
    end = int(np.argmax(share >= 1.0 - _EDGE_SHARE))
    start = int(np.flatnonzero(share[: end + 1] <= _EDGE_SHARE)[-1])
    return max(end - start, 1) / rate_hz * _EDGES_TO_DURATION


def _stroke_noise(angle: Signal, stroke: Stroke, sd: Signal | None, duration_s: float, *, smoothed: bool) -> Noise:
    """Return the noise around a stroke whose movement takes ``duration_s``."""
    if sd is None:
        return Noise(0.0, 1.0)
    around = (stroke.start_s - 0.5 * duration_s, stroke.end_s + 0.5 * duration_s)
    return moving_noise(angle.crop(*around), sd.crop(*around), duration_s, smoothed=smoothed)


_MIN_PEAK_TO_MEAN = 1.5
"""Least peak over mean speed of a movement from rest to rest."""


def _find_quickest_part(
    angle: Signal, stroke: Stroke, noise: Noise, arc: float, duration_s: float
) -> tuple[float, float]:
    """Return the cut-off for a stroke's speed and the duration of its quickest part, infinite without stops.

    The cut-off is NaN if the stroke is too slow to assess. The mean over a stroke with stops tells little of its
    quickest part. Where more of the spectrum shows such parts above the noise, they decide the cut-off.
    """
    cutoff_hz = cutoff_for_speed(noise, _MIN_PEAK_TO_MEAN * arc / duration_s, duration_s)
    if math.isnan(cutoff_hz):
        return math.nan, math.inf
    smooth = _stroke_speed(angle, stroke, cutoff_hz)
    most_hz = max_cutoff_for_speed(noise, float(smooth.max()))
    for closer_hz in (cutoff_hz, *np.geomspace(cutoff_hz, max(most_hz, cutoff_hz), 5)[1:].tolist()):
        closer = _stroke_speed(angle, stroke, closer_hz)
        top = float(closer.max())
        part_s = math.inf
        if top > 0.0:
            half = next(run for run in find_runs(closer >= 0.5 * top) if run.start <= np.argmax(closer) < run.stop)
            part_s = (half.stop - half.start) / angle.rate_hz / _HALF_HEIGHT_SHARE
        added = noise.speed_sd(closer_hz) ** 2 - noise.speed_sd(cutoff_hz) ** 2
        is_visible = np.mean((closer - smooth) ** 2) >= _SUBMOVEMENT_SDS**2 * added
        if part_s < _MAX_SUBMOVEMENT_SHARE * duration_s and is_visible:
            return cutoff_for_speed(noise, top, part_s), part_s
    return cutoff_hz, math.inf


def _stroke_speed(angle: Signal, stroke: Stroke, cutoff_hz: float) -> FloatArray:
    """Return the speed (n,) in the direction of a stroke without gaps."""
    smooth = _low_pass_stroke(angle, stroke, cutoff_hz)
    return stroke.direction * rate_of_change(smooth).crop(stroke.start_s, stroke.end_s).value


def _low_pass_stroke(angle: Signal, stroke: Stroke, cutoff_hz: float) -> Signal:
    """Low-pass the time around a stroke only.

    Samples further away would change it by less than 1e-15, and filtering a whole long recording for each stroke would
    cost the square of its length.
    """
    reach_s = _FILTER_MARGIN_CYCLES / cutoff_hz + _FILTER_MARGIN_S
    return low_pass(angle.crop(stroke.start_s - reach_s, stroke.end_s + reach_s), cutoff_hz)


class _StrokeMotion(NamedTuple):
    """Low-passed stroke, and its speeds (n,) from onset to offset and from rest to rest."""

    measures: StrokeMeasures
    onset_to_offset: FloatArray
    rest_to_rest: FloatArray


def _measure_motion(angle: Signal, stroke: Stroke, noise: Noise, cutoff_hz: float) -> _StrokeMotion | None:
    """Measure the low-passed stroke; None without onset and offset, or without a cut-off (NaN)."""
    if math.isnan(cutoff_hz):
        return None
    smooth = _low_pass_stroke(angle, stroke, cutoff_hz)
    velocity = stroke.direction * rate_of_change(smooth).value
    first, last = np.searchsorted(smooth.time_s, (stroke.start_s - 1e-9, stroke.end_s + 0.25 / angle.rate_hz))
    inside = slice(int(first), int(last))
    if not np.isfinite(velocity[inside]).all() or not (velocity[inside] > 0.0).any():
        return None
    left, arrived = _find_turning_bands(stroke.direction * smooth.value[inside], noise)
    peak_at = int(first) + left + int(np.argmax(velocity[inside][left : arrived + 1]))
    level = ONSET_SPEED_SHARE * float(velocity[peak_at])
    onset = _find_movement_edge(velocity, int(first) + left, peak_at, -1, level)
    offset = _find_movement_edge(velocity, int(first) + arrived, peak_at, +1, level)
    if not offset > onset:
        return None
    begin, end = math.ceil(onset), math.floor(offset)
    at = np.concatenate(([onset], np.arange(begin, end + 1), [offset]))
    speeds = np.concatenate(([level], velocity[begin : end + 1], [level]))
    peak = float(speeds.max())
    from_rest, to_rest = _find_rest_sample(velocity, begin, -1), _find_rest_sample(velocity, end, +1)
    pauses_s = _pause_durations_s(at / angle.rate_hz, np.abs(speeds), PAUSE_SPEED_SHARE * peak)
    measured = StrokeMeasures(
        stroke,
        peak_speed_rad_s=peak,
        mean_speed_rad_s=min(float(np.trapezoid(speeds, at)) / (offset - onset), peak),
        movement_time_s=(offset - onset) / angle.rate_hz,
        time_to_peak_share=(peak_at - onset) / (offset - onset),
        pauses=float(len(pauses_s)),
        pause_s=math.fsum(pauses_s),
        onset_s=float(smooth.time_s[0]) + onset / angle.rate_hz,
        offset_s=float(smooth.time_s[0]) + offset / angle.rate_hz,
    )
    return _StrokeMotion(measured, np.abs(velocity[begin : end + 1]), np.abs(velocity[from_rest : to_rest + 1]))


def _find_turning_bands(angle: FloatArray, noise: Noise) -> tuple[int, int]:
    """Return the last sample of a rising angle in its first turning band and the first in the next."""
    low, high = float(angle.min()), float(angle.max())
    near = min(max(TURNING_BAND_SHARE * (high - low), 3.0 * noise.sd), _EDGE_SHARE * (high - low))
    there = int(np.argmax(angle >= high - near))
    before = np.flatnonzero(angle[: there + 1] <= low + near)
    return int(before[-1]) if len(before) else 0, there


def _find_movement_edge(velocity: FloatArray, sample: int, peak_at: int, step: int, level: float) -> float:
    """Return the fractional sample at which the speed is at the level, outwards from a turning band."""
    while velocity[sample] < level and sample != peak_at:
        sample -= step
    return _find_crossing(velocity, sample, step, level)


def _pause_durations_s(time_s: FloatArray, speed: FloatArray, level: float) -> tuple[float, ...]:
    """Return the duration of each pause: speed (n,) below the level, between two faster parts."""
    out = []
    for part in find_runs(speed < level):
        before, after = part.start - 1, part.stop
        if before < 0 or after == len(speed):
            continue  # onset or offset
        down = time_s[before] + (time_s[before + 1] - time_s[before]) * _crossing_share(speed, before, level)
        up = time_s[after - 1] + (time_s[after] - time_s[after - 1]) * _crossing_share(speed, after - 1, level)
        if up - down >= MIN_PAUSE_S:
            out.append(float(up - down))
    return tuple(out)


def _crossing_share(speed: FloatArray, k: int, level: float) -> float:
    """Return the share of the step from sample k to the next at which the speed passes a level."""
    return float((level - speed[k]) / (speed[k + 1] - speed[k]))


def _find_rest_sample(velocity: FloatArray, sample: int, step: int) -> int:
    """Return the sample, outwards of the movement, at which the speed is zero or stops falling."""
    k = sample
    while 0 <= k + step < len(velocity) and 0.0 < velocity[k + step] < velocity[k]:
        k += step
    return k


def _find_crossing(velocity: FloatArray, start: int, step: int, level: float) -> float:
    """Return the fractional sample at which the speed first falls below a level; NaN if never."""
    k = start
    while 0 <= k + step < len(velocity) and math.isfinite(velocity[k + step]):
        if velocity[k + step] < level:
            return k + step * float((velocity[k] - level) / (velocity[k] - velocity[k + step]))
        k += step
    return math.nan

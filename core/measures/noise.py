"""Effect of tracking noise on the measures, and the smoothing that it requires.

The varying part of a tracked angle's error (the calibration's is constant) is modelled as a first-order process: a
share of the stated standard deviation, with the correlation time of the filter or the smoother. Both were fitted to
simulated sessions with truth. Where the data are quieter, the data are believed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.signals import Signal, low_pass
from carpus.core.model.types import FloatArray

MOVING_SHARE_OF_SD = 0.5
"""Share of a stated standard deviation that varies over time; the rest is the calibration's."""
STATIC_SHARE_OF_SD = math.sqrt(1.0 - MOVING_SHARE_OF_SD**2)
FILTER_CORRELATION_S, SMOOTHER_CORRELATION_S = 0.06, 0.20
TARGET_SPEED_ERROR_SHARE = 0.01
"""Noise allowed in a speed, as a share of the peak; smoothing is increased until it is met."""
MAX_SPEED_ERROR_SHARE = 0.10
"""A stroke with more noise than this is too slow to assess."""
MAX_SPECTRUM_NOISE = 0.012
"""Noise allowed in the normalised speed spectrum, which SPARC follows down to 0.05."""
MAX_CUTOFF_HZ = 10.0
CYCLES_PER_STROKE = 3.0
"""A lower cut-off, in cycles per stroke, takes more than 1 % off a minimum-jerk peak."""
CYCLES_PER_SUBMOVEMENT = 2.0
"""At so many cycles per sub-movement its spectrum has fallen to zero."""
MIN_SMOOTHNESS_CUTOFF_HZ = 2.0
"""Sub-movements last up to half a second: a lower cut-off would hide a jerky movement."""
_DRAWS = 64
HOLD_BAND_SDS = 4.0
"""A noisy hold stays within so many standard deviations of its extreme."""
DIP_SDS = 4.0
"""Noise makes dips in a speed of up to so many standard deviations."""


@dataclass(frozen=True, slots=True)
class Noise:
    """First-order process: ``sd`` in the unit of the signal, ``correlation_s`` until it falls to 1/e."""

    sd: float
    correlation_s: float

    def speed_sd(self, cutoff_hz: float) -> float:
        """Return the standard deviation of its rate of change below a cut-off, unit per second."""
        turn = 2.0 * math.pi * cutoff_hz * self.correlation_s
        return self.sd / self.correlation_s * math.sqrt(2.0 / math.pi * max(turn - math.atan(turn), 0.0))

    def spectrum_share(self, frequency_hz: float, duration_s: float, arc: float) -> float:
        """Return its part in the normalised speed spectrum of a stroke of this duration and arc."""
        turn2 = (2.0 * math.pi * frequency_hz * self.correlation_s) ** 2
        density = 4.0 * self.sd**2 / self.correlation_s * turn2 / (1.0 + turn2)
        return math.sqrt(0.5 * density * duration_s) / arc

    def share_above_cutoff(self, cutoff_hz: float) -> float:
        """Return the share of its variance above a frequency."""
        return 1.0 - 2.0 / math.pi * math.atan(2.0 * math.pi * cutoff_hz * self.correlation_s)

    def sample(self, count: int, rate_hz: float) -> FloatArray:
        """Return reproducible samples (draws, count)."""
        chance = np.random.default_rng(0)
        kept = math.exp(-1.0 / (rate_hz * self.correlation_s))
        white = chance.standard_normal((_DRAWS, count))
        white[:, 1:] *= math.sqrt(1.0 - kept**2)
        for k in range(1, count):
            white[:, k] += kept * white[:, k - 1]
        return self.sd * white


def moving_noise(part: Signal, sd: Signal, stroke_s: float, *, smoothed: bool) -> Noise:
    """Return the noise of a part of an angle; ``stroke_s`` is the duration of one movement in it."""
    correlation_s = SMOOTHER_CORRELATION_S if smoothed else FILTER_CORRELATION_S
    known = sd.value[np.isfinite(sd.value)]
    stated = Noise(MOVING_SHARE_OF_SD * float(np.median(known)) if len(known) else 0.0, correlation_s)
    return limit_noise(stated, part, stroke_s)


def limit_noise(stated: Noise, part: Signal, stroke_s: float) -> Noise:
    """Limit the stated noise to what a part, (n,) or (n, k), shows above the band of its movement.

    The worst column counts. ``stroke_s`` is the duration of one movement.
    """
    split_hz = clean_cutoff_hz(stroke_s)
    if split_hz >= 0.4 * part.rate_hz:
        return stated
    left = part.value - low_pass(part, split_hz).value
    left = left[np.isfinite(left).all(axis=tuple(range(1, left.ndim)))]
    if not len(left):
        return stated
    seen = float(np.sqrt(np.mean(left**2, axis=0)).max()) / math.sqrt(stated.share_above_cutoff(split_hz))
    return Noise(min(stated.sd, seen), stated.correlation_s)


def clean_cutoff_hz(stroke_s: float) -> float:
    """Return the frequency below which all of a movement lies, with holds and hesitations."""
    return max(2.0 * CYCLES_PER_STROKE / max(stroke_s, 1e-3), 1.0)


def cutoff_for_speed(noise: Noise, peak_speed: float, stroke_s: float) -> float:
    """Return the low-pass cut-off (Hz) for a speed; NaN if the stroke is too slow to assess."""
    lowest = CYCLES_PER_STROKE / stroke_s
    if noise.speed_sd(lowest) > MAX_SPEED_ERROR_SHARE * peak_speed:
        return math.nan
    if lowest >= MAX_CUTOFF_HZ:
        return lowest
    tried = np.geomspace(MAX_CUTOFF_HZ, lowest, 40)
    return float(next((hz for hz in tried if noise.speed_sd(hz) <= TARGET_SPEED_ERROR_SHARE * peak_speed), lowest))


def max_cutoff_for_speed(noise: Noise, peak_speed: float) -> float:
    """Return the highest cut-off (Hz) at which the speed exceeds the noise; 0 if there is none."""
    tried = np.geomspace(MAX_CUTOFF_HZ, 0.1, 80)
    return float(next((hz for hz in tried if noise.speed_sd(hz) <= MAX_SPEED_ERROR_SHARE * peak_speed), 0.0))


def cutoff_for_smoothness(noise: Noise, arc: float, stroke_s: float, submovement_s: float = math.inf) -> float:
    """Return the low-pass cut-off (Hz) for the SPARC of a stroke; NaN where noise would pass for jerk.

    ``submovement_s`` is the duration of the quickest part of a stroke with stops. Its spectrum is long, so twice the
    noise is allowed.
    """
    lowest = max(CYCLES_PER_STROKE / stroke_s, CYCLES_PER_SUBMOVEMENT / submovement_s, MIN_SMOOTHNESS_CUTOFF_HZ)
    if lowest >= MAX_CUTOFF_HZ:
        return lowest
    tried = np.geomspace(MAX_CUTOFF_HZ, lowest, 40)
    most = MAX_SPECTRUM_NOISE * (2.0 if math.isfinite(submovement_s) else 1.0)
    return float(next((hz for hz in tried if noise.spectrum_share(hz, stroke_s, arc) <= most), math.nan))


def estimate_extreme(
    part: FloatArray, clean: FloatArray, noise: Noise, rate_hz: float, *, largest: bool
) -> tuple[float, float]:
    """Estimate the largest or smallest angle of a part (n,) without the bias of noise, with its standard deviation.

    The maximum of noisy values is biased outwards, the more the longer a hold. So the middle half of the time in which
    the ``clean`` curve stays within the noise of its extreme is averaged. A quick turn is flat there. Gaps are NaN.
    """
    sign = 1.0 if largest else -1.0
    curve = sign * np.where(np.isfinite(part) & np.isfinite(clean), clean, np.nan)
    if not np.isfinite(curve).any():
        curve = sign * part
    top = int(np.nanargmax(curve))
    with np.errstate(invalid="ignore"):
        near = curve >= curve[top] - HOLD_BAND_SDS * noise.sd
    first = top - int(np.argmin(near[top::-1])) + 1 if not near[: top + 1].all() else 0
    last = top + int(np.argmin(near[top:])) if not near[top:].all() else len(near)
    quarter = (last - first) // 4
    middle = part[first + quarter : last - quarter]
    return float(middle.mean()), float(noise.sample(len(middle), rate_hz).mean(axis=1).std())

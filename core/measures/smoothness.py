"""How smooth one movement in one direction is: SPARC, log dimensionless jerk, number of peaks.

Balasubramanian et al. 2015, doi 10.1186/s12984-015-0090-9; clinical reference 5. All take a speed profile (n,), evenly
sampled and low-passed; unit per second of whatever moved.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.types import FloatArray

FEWEST_SAMPLES = 8
LEAST_PEAK_RAD_S = math.radians(5.0)
LEAST_PEAK_M_S = 0.010
_PAD_LEVEL = 4
_HIGHEST_HZ = 10.0
_LEAST_AMPLITUDE = 0.05


def sparc(speed: FloatArray, rate_hz: float, least_peak: float = 0.0) -> float:
    """Spectral arc length, dimensionless, below 0; the nearer to 0 the smoother.

    ``-integral_0^wc sqrt((1/wc)^2 + (dV/dw)^2) dw`` of the normalised amplitude spectrum V, zero-padded to
    2^(ceil(log2 n) + 4), up to the last frequency of at most 10 Hz with V of 0.05 or more. NaN below 8 samples, with a
    gap, or with a peak below ``least_peak``.

    >>> t = np.arange(-100, 100) / 100
    >>> round(sparc(np.exp(-5 * t**2), 100.0), 5)
    -1.41403
    """
    if not _measurable(speed, least_peak):
        return math.nan
    length = 2 ** (math.ceil(math.log2(len(speed))) + _PAD_LEVEL)
    spectrum = np.abs(np.fft.rfft(speed, length))
    frequency = np.fft.rfftfreq(length, 1.0 / rate_hz)
    spectrum = spectrum / spectrum.max()
    kept = np.flatnonzero((frequency <= _HIGHEST_HZ) & (spectrum >= _LEAST_AMPLITUDE))
    curve = spectrum[kept[0] : kept[-1] + 1]
    if len(curve) < 2:
        return math.nan
    steps = len(curve) - 1
    return -float(np.sqrt(1.0 / steps**2 + np.diff(curve) ** 2).sum())


def log_dimensionless_jerk(speed: FloatArray, rate_hz: float, least_peak: float = 0.0) -> float:
    """LDLJ = -ln(T^3 / v_peak^2 * integral (d2v/dt2)^2 dt), T = n dt; the nearer to 0 the smoother.

    Very sensitive to noise: worth showing only beside SPARC. NaN as for :func:`sparc`.

    >>> t = np.arange(-100, 100) / 100
    >>> round(log_dimensionless_jerk(np.exp(-5 * t**2), 100.0), 5)
    -5.81636
    """
    if not _measurable(speed, least_peak):
        return math.nan
    dt = 1.0 / rate_hz
    jerk = np.diff(speed, 2) / dt**2
    total = (len(speed) * dt) ** 3 / float(np.abs(speed).max()) ** 2 * float((jerk**2).sum()) * dt
    return -math.log(total) if total > 0.0 else math.nan


def speed_peaks(
    speed: FloatArray, rate_hz: float, least_rise: float, apart_s: float = 0.15, least_dip: float = 0.0
) -> int:
    """Movement units: local maxima more than ``least_rise`` above the minimum just before, ``apart_s`` apart or more.

    Reference: 20 mm/s for a position, the greater of 10 % of the peak and 5 degrees/s for an angle. 1 is ideal. A dip
    smaller than ``least_dip``, what noise makes of itself, parts no maxima: one in the middle of a long rise would make
    two units of it, and a few of them none.
    """
    from scipy import signal as sps  # half a second to load, and not needed before something has been recorded

    count, last_counted, last_top = 0, -math.inf, 0
    for top in sps.find_peaks(speed, prominence=least_dip)[0].tolist():
        rise = speed[top] - speed[last_top : top + 1].min()
        if rise > least_rise and (top - last_counted) / rate_hz >= apart_s:
            count += 1
            last_counted = top
        last_top = top
    return count


def _measurable(speed: FloatArray, least_peak: float) -> bool:
    if len(speed) < FEWEST_SAMPLES or not np.isfinite(speed).all():
        return False
    peak = float(np.abs(speed).max())
    return peak > 0.0 and peak >= least_peak

"""Path of a point in space during one reach (clinical reference 5): length, straightness, speed, timing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.noise import DIP_IN_SDS, HIGHEST_CUTOFF_HZ, LOWEST_OF_JERKS_HZ, Noise, cutoff_for_smoothness
from carpus.core.measures.signals import Signal, low_pass, rate_of_change
from carpus.core.measures.smoothness import LEAST_PEAK_M_S, sparc, speed_peaks
from carpus.core.types import FloatArray

SHORTEST_CHORD_M = 0.050
LEAST_RISE_M_S = 0.020
WRIST_NOISE = {True: Noise(0.0005, 0.08), False: Noise(0.0007, 0.05)}
"""The most that the WRIST disc's place is off from frame to frame, looked back at (True) and live; what is systematic
of its error goes with the movement. Fitted to simulated reaches with truth, pictures included, at 0.65 to 0.75 m."""
TIP_NOISE = {True: Noise(0.0012, 0.12), False: Noise(0.0017, 0.08)}
"""The same of a tip of the fingers in the hand's own axes."""
QUIET = Noise(0.0, 1.0)


@dataclass(frozen=True, slots=True)
class PathMeasures:
    """``length_m`` along the path; ``straightness`` = length / chord, 1 is straight; ``time_to_peak_share`` 0 to 1.

    Straightness is NaN for a chord below 50 mm; ``peaks`` and ``sparc`` are where the noise would be taken for jerk,
    ``peaks`` also where nothing rises by 20 mm/s; all are NaN where the part has a gap.
    """

    length_m: float = math.nan
    straightness: float = math.nan
    peak_speed_m_s: float = math.nan
    time_to_peak_share: float = math.nan
    peaks: float = math.nan
    sparc: float = math.nan


def measure_path(
    position: Signal, start_s: float, end_s: float, cutoff_hz: float = math.inf, noise: Noise = QUIET
) -> PathMeasures:
    """Measures of a position (n, 3), metres, from onset ``start_s`` to offset ``end_s``.

    Noise lengthens a path, so it is low-passed at ``cutoff_hz``; smoothness and peaks as much as ``noise`` asks for.
    """
    smooth = low_pass(position, cutoff_hz)
    part = smooth.between(start_s, end_s)
    if len(part.time_s) < 2 or not part.finite.all():
        return PathMeasures()
    length = float(np.linalg.norm(np.diff(part.value, axis=0), axis=1).sum())
    chord = float(np.linalg.norm(part.value[-1] - part.value[0]))
    speed = speed_of(smooth, start_s, end_s)
    for_smoothness = cutoff_for_smoothness(noise, length, end_s - start_s)
    for_peaks = _cutoff_for_peaks(noise, cutoff_hz)
    peaks = spectrum = math.nan
    if not math.isnan(for_peaks):
        units = speed_of(low_pass(position, for_peaks), start_s, end_s)
        dip = DIP_IN_SDS * noise.speed_sd(min(for_peaks, HIGHEST_CUTOFF_HZ))
        peaks = float(speed_peaks(units, part.rate_hz, LEAST_RISE_M_S, least_dip=dip)) or math.nan
    if not math.isnan(for_smoothness):
        whole = speed_of(low_pass(position, for_smoothness), start_s, end_s)
        spectrum = sparc(whole, part.rate_hz, LEAST_PEAK_M_S)
    return PathMeasures(
        length_m=length,
        straightness=length / chord if chord >= SHORTEST_CHORD_M else math.nan,
        peak_speed_m_s=float(speed.max()),
        time_to_peak_share=float(np.argmax(speed)) / (len(speed) - 1),
        peaks=peaks,
        sparc=spectrum,
    )


def _cutoff_for_peaks(noise: Noise, most_hz: float) -> float:
    """The highest cut-off at which noise alone makes no unit; NaN where that would take units away too."""
    if not noise.sd > 0.0:
        return most_hz
    top = min(max(most_hz, LOWEST_OF_JERKS_HZ), HIGHEST_CUTOFF_HZ)
    tried = np.geomspace(top, LOWEST_OF_JERKS_HZ, 40)
    return float(next((hz for hz in tried if DIP_IN_SDS * noise.speed_sd(hz) <= LEAST_RISE_M_S), math.nan))


def speed_of(position: Signal, start_s: float = -math.inf, end_s: float = math.inf) -> FloatArray:
    """Speeds (n,) of a position (n, 3) between two times, metres per second."""
    return np.asarray(np.linalg.norm(rate_of_change(position).between(start_s, end_s).value, axis=1))

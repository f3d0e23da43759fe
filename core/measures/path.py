"""Path of a point in space during one reach (clinical reference 5): length, straightness, speed, timing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.measures.signals import Signal, rate_of_change
from core.measures.smoothness import LEAST_PEAK_M_S, log_dimensionless_jerk, sparc, speed_peaks

SHORTEST_CHORD_M = 0.050
LEAST_RISE_M_S = 0.020


@dataclass(frozen=True, slots=True)
class PathMeasures:
    """``length_m`` along the path; ``straightness`` = length / chord, 1 is straight; ``time_to_peak_share`` 0 to 1.

    Straightness is NaN for a chord below 50 mm; all are NaN where the part has a gap.
    """

    length_m: float
    straightness: float
    peak_speed_m_s: float
    time_to_peak_share: float
    peaks: float
    sparc: float
    ldlj: float


def measure_path(position: Signal, start_s: float, end_s: float) -> PathMeasures:
    """Measures of a low-passed position (n, 3), metres, from onset ``start_s`` to offset ``end_s``.

    Noise lengthens a path, so filter first.
    """
    part = position.between(start_s, end_s)
    if len(part.time_s) < 2 or not part.finite.all():
        return PathMeasures(*([math.nan] * 7))
    length = float(np.linalg.norm(np.diff(part.value, axis=0), axis=1).sum())
    chord = float(np.linalg.norm(part.value[-1] - part.value[0]))
    speed = np.linalg.norm(rate_of_change(position).between(start_s, end_s).value, axis=1)
    return PathMeasures(
        length_m=length,
        straightness=length / chord if chord >= SHORTEST_CHORD_M else math.nan,
        peak_speed_m_s=float(speed.max()),
        time_to_peak_share=float(np.argmax(speed)) / (len(speed) - 1),
        peaks=float(speed_peaks(speed, part.rate_hz, LEAST_RISE_M_S)),
        sparc=sparc(speed, part.rate_hz, LEAST_PEAK_M_S),
        ldlj=log_dimensionless_jerk(speed, part.rate_hz, LEAST_PEAK_M_S),
    )


def farthest_from_start_m(position_m: Signal) -> float:
    """Largest distance of a point from its middle over the first second seen: above 15 mm the forearm moved."""
    if not position_m.finite.any():
        return math.nan
    start_s = float(position_m.time_s[position_m.finite][0])
    first = position_m.between(start_s, start_s + 1.0)
    home = np.nanmedian(first.value, axis=0)
    return float(np.nanmax(np.linalg.norm(position_m.value - home, axis=1)))

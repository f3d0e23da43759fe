"""Speed and smoothness of a session's strokes in figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.motion_range import FEWEST_FOR_SPREAD
from carpus.core.measures.speed import StrokeMeasures


@dataclass(frozen=True, slots=True)
class StrokeSpread:
    """A quantity over strokes or repetitions; ``best`` the quickest or smoothest, NaN where neither way is better;
    ``measurement_sd`` of one of them by the tracker's noise, NaN unknown."""

    mean: float
    sd: float
    best: float
    count: int
    measurement_sd: float = math.nan


@dataclass(frozen=True, slots=True)
class SpeedFigures:
    """Strokes in figures: degrees per second, seconds, shares, dimensionless; ``smoothness`` is SPARC.

    ``too_slow`` strokes of ``count`` whose speed is lost in the tracker's noise, ``too_slow_to_be_smooth`` those whose
    smoothness is: of them nothing is said.
    """

    count: int
    too_slow: int
    too_slow_to_be_smooth: int
    peak_speed: StrokeSpread
    smoothness: StrokeSpread
    mean_speed: StrokeSpread
    movement_time: StrokeSpread
    time_to_peak: StrokeSpread
    peaks: StrokeSpread
    ldlj: StrokeSpread
    pauses: StrokeSpread
    pause_time: StrokeSpread

    @classmethod
    def of(cls, strokes: Sequence[StrokeMeasures]) -> SpeedFigures:
        """Of the strokes that count."""
        return cls(
            len(strokes),
            sum(stroke.too_slow for stroke in strokes),
            sum(stroke.too_slow_to_be_smooth for stroke in strokes),
            _spread(
                [math.degrees(stroke.peak_speed_rad_s) for stroke in strokes],
                [math.degrees(stroke.peak_speed_sd_rad_s) for stroke in strokes],
            ),
            _spread([stroke.sparc for stroke in strokes]),
            _spread([math.degrees(stroke.mean_speed_rad_s) for stroke in strokes]),
            _spread([stroke.movement_time_s for stroke in strokes], best=min),
            _spread([stroke.time_to_peak_share for stroke in strokes], best=None),
            _spread([stroke.peaks for stroke in strokes], best=min),
            _spread([stroke.ldlj for stroke in strokes]),
            _spread([stroke.pauses for stroke in strokes], best=min),
            _spread([stroke.pause_s for stroke in strokes], best=min),
        )


def _spread(
    values: Sequence[float], sds: Sequence[float] = (), best: Callable[[Sequence[float]], float] | None = max
) -> StrokeSpread:
    known = np.array([value for value in values if math.isfinite(value)])
    if not len(known):
        return StrokeSpread(math.nan, math.nan, math.nan, 0)
    stated = np.array([sd for value, sd in zip(values, sds, strict=False) if math.isfinite(value + sd)])
    sd = float(known.std(ddof=1)) if len(known) >= FEWEST_FOR_SPREAD else math.nan
    measurement_sd = float(np.sqrt(np.mean(stated**2))) if len(stated) else math.nan
    the_best = math.nan if best is None else float(best(known.tolist()))
    return StrokeSpread(float(known.mean()), sd, the_best, len(known), measurement_sd)

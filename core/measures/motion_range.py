"""Range of motion of one angle over its repetitions, with error bars (clinical reference 5 and 6)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.noise import STATIC_SHARE_OF_SD, clean_cutoff_hz, estimate_extreme, moving_noise
from carpus.core.measures.repetitions import Repetition
from carpus.core.measures.signals import Signal, low_pass
from carpus.core.model.types import FloatArray

MIN_REPETITIONS_FOR_SD = 3
"""Fewer repetitions have no standard deviation and are listed one by one."""
DEFAULT_STROKE_S = 1.5
"""Duration of one movement where nothing was repeated."""
MIN_VALID_SHARE = 0.7
"""Repetitions with a smaller visible share are not measured."""


@dataclass(frozen=True, slots=True)
class RangeStatistics:
    """One quantity over the repetitions: ``values`` (n,) in order, rad.

    ``measurement_sd`` is the filter's standard deviation of one value, calibration included.
    """

    values: FloatArray
    best: float
    measurement_sd: float

    @property
    def mean(self) -> float:
        """Mean over the repetitions, NaN if there is none."""
        return float(self.values.mean()) if len(self.values) else math.nan

    @property
    def spread_sd(self) -> float:
        """Standard deviation between repetitions, NaN below three."""
        return float(self.values.std(ddof=1)) if len(self.values) >= MIN_REPETITIONS_FOR_SD else math.nan


@dataclass(frozen=True, slots=True)
class MotionRange:
    """Range of motion of one angle; the arc does not depend on the day's neutral pose.

    ``repetitions`` is 0 if nothing was repeated; the values are then those of the whole recording. ``top_limited`` and
    ``bottom_limited``: the hand was occluded next to the extreme, so the true one may lie further out.
    """

    arc: RangeStatistics
    maximum: RangeStatistics
    minimum: RangeStatistics
    repetitions: int
    top_limited: bool
    bottom_limited: bool


def motion_range(
    angle: Signal, sd: Signal, repetitions: tuple[Repetition, ...], *, smoothed: bool | None = None
) -> MotionRange:
    """Measure maximum, minimum and arc of an angle in each repetition that was visible enough.

    Parameters
    ----------
    angle, sd
        low-passed angle and its standard deviation on the same time base, rad
    repetitions
        repetitions found in the angle
    smoothed
        True for the smoother's angle, False for the filter's: their noise bias of an extreme is removed; None without
    """
    usable = [rep for rep in repetitions if rep.valid_share >= MIN_VALID_SHARE]
    windows = [(rep.start_s, rep.end_s) for rep in usable]
    if not windows and angle.is_finite.any():
        windows = [(float(angle.time_s[0]), float(angle.time_s[-1]))]
    tops, bottoms, top_sds, bottom_sds = [], [], [], []
    top_limited = bottom_limited = False
    for start_s, end_s in windows:
        part, part_sd = angle.crop(start_s, end_s), sd.crop(start_s, end_s)
        if not part.is_finite.any():
            continue
        top, bottom = int(np.nanargmax(part.value)), int(np.nanargmin(part.value))
        highest, lowest = float(part.value[top]), float(part.value[bottom])
        highest_sd, lowest_sd = float(part_sd.value[top]), float(part_sd.value[bottom])
        if smoothed is not None:
            stroke_s = 0.5 * (end_s - start_s) if usable else DEFAULT_STROKE_S
            noise = moving_noise(part, part_sd, stroke_s, smoothed=smoothed)
            clean = low_pass(part, clean_cutoff_hz(stroke_s)).value
            highest, moving = estimate_extreme(part.value, clean, noise, part.rate_hz, largest=True)
            highest_sd = math.hypot(moving, STATIC_SHARE_OF_SD * highest_sd)
            lowest, moving = estimate_extreme(part.value, clean, noise, part.rate_hz, largest=False)
            lowest_sd = math.hypot(moving, STATIC_SHARE_OF_SD * lowest_sd)
        tops.append(highest)
        bottoms.append(lowest)
        top_sds.append(highest_sd)
        bottom_sds.append(lowest_sd)
        top_limited |= angle.is_near_gap(float(part.time_s[top]))
        bottom_limited |= angle.is_near_gap(float(part.time_s[bottom]))
    top_values, bottom_values = np.array(tops), np.array(bottoms)
    top_sd, bottom_sd = _rms(top_sds), _rms(bottom_sds)
    return MotionRange(
        arc=range_statistics(top_values - bottom_values, math.hypot(top_sd, bottom_sd), largest=True),
        maximum=range_statistics(top_values, top_sd, largest=True),
        minimum=range_statistics(bottom_values, bottom_sd, largest=False),
        repetitions=len(usable),
        top_limited=top_limited,
        bottom_limited=bottom_limited,
    )


def range_statistics(values: FloatArray, measurement_sd: float, *, largest: bool) -> RangeStatistics:
    """Return the statistics of values (n,) of which the largest or the smallest is the best."""
    best = float(values.max() if largest else values.min()) if len(values) else math.nan
    return RangeStatistics(values, best, measurement_sd)


_NOTHING = RangeStatistics(np.empty(0), math.nan, math.nan)
NO_RANGE = MotionRange(_NOTHING, _NOTHING, _NOTHING, 0, True, True)


def _rms(values: list[float]) -> float:
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan

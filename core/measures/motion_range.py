"""Active range of motion of one angle over its repetitions, with honest error bars (clinical reference 5 and 6)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.measures.repetitions import Repetition
from core.measures.signals import Signal
from core.types import FloatArray

FEWEST_FOR_SPREAD = 3
"""Fewer repetitions are listed one by one: they have no mean worth a spread."""
LEAST_VALID_SHARE = 0.7
"""A repetition seen for less than this is not measured."""


@dataclass(frozen=True, slots=True)
class Figure:
    """One quantity over the repetitions: ``values`` (n,), in order, rad.

    ``measurement_sd`` is the standard deviation of one value by the filter's own account, calibration included.
    """

    values: FloatArray
    best: float
    measurement_sd: float

    @property
    def mean(self) -> float:
        """Mean over the repetitions, NaN when there is none."""
        return float(self.values.mean()) if len(self.values) else math.nan

    @property
    def spread_sd(self) -> float:
        """Standard deviation between repetitions, NaN below three."""
        return float(self.values.std(ddof=1)) if len(self.values) >= FEWEST_FOR_SPREAD else math.nan

    @property
    def variation(self) -> float:
        """Coefficient of variation, NaN below three repetitions or about a mean of zero."""
        return abs(self.spread_sd / self.mean) if self.mean else math.nan

    @property
    def error_sd(self) -> float:
        """Standard deviation of the mean: the repetitions' spread averages out, the measurement's error may not."""
        spread = self.spread_sd
        between = 0.0 if math.isnan(spread) else spread**2 / len(self.values)
        return math.sqrt(between + self.measurement_sd**2)


@dataclass(frozen=True, slots=True)
class MotionRange:
    """Range of one angle. The arc comes first: it does not depend on the day's neutral pose.

    ``repetitions`` is 0 when nothing was repeated; the figures then hold the one range of the whole recording.
    ``top_limited`` and ``bottom_limited``: the hand went out of sight next to the extreme, so the true one may lie
    further out ("limited by camera view").
    """

    arc: Figure
    maximum: Figure
    minimum: Figure
    repetitions: int
    top_limited: bool
    bottom_limited: bool


def motion_range(angle: Signal, sd: Signal, repetitions: tuple[Repetition, ...]) -> MotionRange:
    """Maximum, minimum and arc of an angle (rad, low-passed) in each repetition that was seen well enough.

    ``sd`` has the angle's standard deviation on the same time base.
    """
    usable = [rep for rep in repetitions if rep.valid_share >= LEAST_VALID_SHARE]
    windows = [(rep.start_s, rep.end_s) for rep in usable]
    if not windows and angle.finite.any():
        windows = [(float(angle.time_s[0]), float(angle.time_s[-1]))]
    tops, bottoms, top_sds, bottom_sds = [], [], [], []
    top_limited = bottom_limited = False
    for start_s, end_s in windows:
        part, part_sd = angle.between(start_s, end_s), sd.between(start_s, end_s)
        if not part.finite.any():
            continue
        top, bottom = int(np.nanargmax(part.value)), int(np.nanargmin(part.value))
        tops.append(part.value[top])
        bottoms.append(part.value[bottom])
        top_sds.append(part_sd.value[top])
        bottom_sds.append(part_sd.value[bottom])
        top_limited |= angle.beside_gap(float(part.time_s[top]))
        bottom_limited |= angle.beside_gap(float(part.time_s[bottom]))
    top_values, bottom_values = np.array(tops), np.array(bottoms)
    top_sd, bottom_sd = _rms(top_sds), _rms(bottom_sds)
    return MotionRange(
        arc=_figure(top_values - bottom_values, math.hypot(top_sd, bottom_sd), largest=True),
        maximum=_figure(top_values, top_sd, largest=True),
        minimum=_figure(bottom_values, bottom_sd, largest=False),
        repetitions=len(usable),
        top_limited=top_limited,
        bottom_limited=bottom_limited,
    )


def _figure(values: FloatArray, measurement_sd: float, *, largest: bool) -> Figure:
    best = math.nan
    if len(values):
        best = float(values.max() if largest else values.min())
    return Figure(values, best, measurement_sd)


def _rms(values: list[float]) -> float:
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan

"""All measures of one angle of one session in one call; what review, report and progress show."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.motion_range import MotionRange, motion_range
from carpus.core.measures.repetitions import Repetition, find_repetitions
from carpus.core.measures.signals import BoolArray, even_signal, low_pass
from carpus.core.measures.speed import StrokeMeasures, measure_stroke
from carpus.core.types import FloatArray


@dataclass(frozen=True, slots=True)
class AngleSummary:
    """One angle over one recording. ``valid_share`` of all frames; strokes in order, both directions."""

    valid_share: float
    repetitions: tuple[Repetition, ...]
    range: MotionRange
    strokes: tuple[StrokeMeasures, ...]

    def stroke_mean(self, quantity: str, *, rising: bool | None = None) -> float:
        """Mean of a :class:`StrokeMeasures` field over the strokes (of one direction), NaN where none is known."""
        values = [getattr(m, quantity) for m in self.strokes if rising is None or m.stroke.rising == rising]
        known = [value for value in values if math.isfinite(value)]
        return sum(known) / len(known) if known else math.nan


def summarise_angle(
    timestamp_s: FloatArray,
    angle_rad: FloatArray,
    angle_sd_rad: FloatArray,
    valid: BoolArray,
    *,
    smoothed: bool | None = None,
) -> AngleSummary:
    """Measures of one angle; all arrays (N,), ``valid`` from :mod:`core.measures.validity`.

    Times are those of the session file. Repetitions are counted on the angle as it came, ranges are those after the
    6 Hz low-pass, and speeds are smoothed as much as their noise asks for. ``smoothed`` as in :func:`motion_range`.
    """
    both = even_signal(timestamp_s, np.column_stack((angle_rad, angle_sd_rad)), valid)
    raw, sd = both.column(0), both.column(1)
    exercise = find_repetitions(raw)
    angle = low_pass(raw)
    return AngleSummary(
        valid_share=raw.valid_share,
        repetitions=exercise.repetitions,
        range=motion_range(angle, sd, exercise.repetitions, smoothed=smoothed),
        strokes=tuple(
            measure_stroke(raw, stroke, None if smoothed is None else sd, smoothed=smoothed is not False)
            for stroke in exercise.strokes
        ),
    )

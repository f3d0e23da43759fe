"""Measure: a row of a session's one table of results, with how certain it is.

Ranges, speeds, task measures, shares of normal totals and angles that should stay still are all rows of it. Whatever is
shown, compared, stored or exported is a selection of these rows. Degrees, degrees per second, millimetres and seconds;
NaN is unknown.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from carpus.core.measures.motion_range import MIN_REPETITIONS_FOR_SD
from carpus.core.model.hand.protocols import WRIST_ANGLES

Group = Literal["range", "task", "share", "speed", "still"]
"""Ranges of motion; measures of the task; shares of normal totals; speed of single strokes; largest size of angles that
should stay still."""
UnknownReason = Literal["", "too_slow", "hidden", "few_frames", "failed"]
"""Why a value is unknown: slower than the tracker's noise shows, hidden from the camera, too few frames a second, or
the computation failed."""
Comparator = Literal["", ">=", "<="]
MeasureKey = tuple[str, str]


@dataclass(frozen=True, slots=True)
class Measure:
    """One quantity of one session.

    ``subject`` is an angle, joint, ``TAM3`` (total active motion of a finger), pair of markers or path, by its name in
    files. ``quantity`` is what was measured of it, for a range ``arc`` or one of its two ends. Ends of the wrist count
    in their own direction, below zero if neutral was not reached; ``flexion`` and ``extension`` of a joint are its
    largest and smallest signed angle. ``values`` has one value per repetition, stroke or path; ``best`` is NaN if
    neither direction is better; ``measurement_sd`` is that of one value by the tracker's noise.
    """

    group: Group
    subject: str
    quantity: str
    unit: str
    values: tuple[float, ...]
    mean: float
    sd: float = math.nan
    best: float = math.nan
    measurement_sd: float = math.nan
    is_lower_bound: bool = False
    """The view of the camera limits it."""
    seen_share: float = math.nan
    """Share of all frames in which the joint was seen."""
    is_inferred: bool = False
    """A DIP joint without a marker is part of it."""
    is_passive: bool = False
    """Of the repetitions in which somebody else moved the hand, which are in no other row."""
    unknown_reason: UnknownReason = ""

    @property
    def key(self) -> MeasureKey:
        return self.subject, self.quantity

    @property
    def comparator(self) -> Comparator:
        """Sign before a value that the view limits: a joint's smallest angle is at most so large, others at least."""
        if not self.is_lower_bound:
            return ""
        return "<=" if self.wrist_angle < 0 and self.quantity == "extension" else ">="

    @property
    def count(self) -> int:
        """Number of known values."""
        return sum(map(math.isfinite, self.values))

    @property
    def wrist_angle(self) -> int:
        """Column of the wrist angle, -1 for anything else."""
        return wrist_angle_index(self.subject)


def summarise_values(
    group: Group, subject: str, quantity: str, unit: str, values: Sequence[float], *, sds: Sequence[float] = (),
    best: Callable[[Sequence[float]], float] | None = None, unknown_reason: UnknownReason = "",
) -> Measure:  # fmt: skip
    """Summarise the known values of repetitions, strokes or paths.

    ``sds`` are the values' standard deviations by the tracker's noise; ``best`` chooses the best value (None if neither
    direction is better); ``unknown_reason`` is used if no value is known.
    """
    known = np.array([value for value in values if math.isfinite(value)])
    if not len(known):
        return Measure(group, subject, quantity, unit, tuple(values), math.nan, unknown_reason=unknown_reason)
    return Measure(
        group, subject, quantity, unit, tuple(values), float(known.mean()),
        sd=float(known.std(ddof=1)) if len(known) >= MIN_REPETITIONS_FOR_SD else math.nan,
        best=math.nan if best is None else float(best(known.tolist())),
        measurement_sd=root_mean_square(sd for value, sd in zip(values, sds, strict=False) if math.isfinite(value)),
    )  # fmt: skip


def root_mean_square(values: Iterable[float]) -> float:
    """Return the root mean square of the known values; NaN without any."""
    known = np.array([value for value in values if math.isfinite(value)])
    return float(np.sqrt(np.mean(known**2))) if len(known) else math.nan


def wrist_angle_index(subject: str) -> int:
    """Return the column of a wrist angle, -1 for anything else.

    >>> wrist_angle_index("flexion"), wrist_angle_index("PIP3_flexion")
    (1, -1)
    """
    return WRIST_ANGLES.index(subject) if subject in WRIST_ANGLES else -1


def is_total_active_motion(subject: str) -> bool:
    """Return whether a subject is the total active motion of a finger."""
    return subject.startswith("TAM")


def negate_measure(row: Measure) -> Measure:
    """Return the deficit of an end that was never reached, counted upwards."""
    return replace(row, mean=-row.mean, best=-row.best, values=tuple(-value for value in row.values))

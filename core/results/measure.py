"""A row of the one table of a session: what was measured of it, of what, how much, and how sure it is.

Ranges, speeds, what an exercise has beside them, shares of usual totals and what should have stayed still are all rows
of it; whatever is said, shown, compared, stored or exported is a choice of these rows. Degrees, degrees per second,
millimetres and seconds, since people read them. NaN is unknown.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from carpus.core.measures.motion_range import MIN_REPETITIONS_FOR_SD
from carpus.core.model.hand.protocols import WRIST_ANGLES

Group = Literal["range", "task", "share", "speed", "still"]
"""Ranges of motion; what an exercise has beside them; shares of usual totals; speed of single strokes; largest size of
what should have stayed still."""
UnknownReason = Literal["", "too_slow", "hidden", "few_frames", "failed"]
"""Why nothing is known: every movement was so slow that the tracker's noise hides it, the camera did not see what
decides it or gave too few frames a second for it, or it could not be computed."""
MeasureKey = tuple[str, str]
"""``subject`` and ``quantity`` of a measure."""


@dataclass(frozen=True, slots=True)
class Measure:
    """One quantity of one session.

    ``subject`` is an angle, joint, ``TAM3`` (total active motion of a finger), pair of discs or way by its name in
    every
    file; ``quantity`` is measured of it, for a range its movement: ``arc`` or one of its two ends. Of the wrist each
    end
    counts in its own direction, below zero where neutral was not reached; ``flexion`` and ``extension`` of a joint are
    its most and its least bent angle with their sign. ``values`` are one for each repetition, stroke or way;
    ``best`` is NaN where neither way is better, ``measurement_sd`` that of one value by the tracker's noise.
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
    """Whether it is a lower bound, since the camera's view limits it."""
    seen_share: float = math.nan
    """Share of all frames in which the joint was seen."""
    is_inferred: bool = False
    """Whether an end joint that no disc measures is part of it."""
    is_passive: bool = False
    """Whether it is of the repetitions in which somebody else moved the hand: they are in no other row."""
    unknown_reason: UnknownReason = ""

    @property
    def key(self) -> MeasureKey:
        return self.subject, self.quantity

    @property
    def count(self) -> int:
        """How many known values it has."""
        return sum(map(math.isfinite, self.values))

    @property
    def wrist_angle(self) -> int:
        """Column of the wrist's angle, -1 for anything else."""
        return wrist_angle_index(self.subject)


def summarise_values(
    group: Group, subject: str, quantity: str, unit: str, values: Sequence[float], *, sds: Sequence[float] = (),
    best: Callable[[Sequence[float]], float] | None = None, unknown_reason: UnknownReason = "",
) -> Measure:  # fmt: skip
    """Summarise values of repetitions, strokes or ways, of which unknown ones are left out.

    ``sds`` are the values' standard deviations by the tracker's noise, ``best`` chooses the best of them (None where
    neither way is better), ``unknown_reason`` says why there is none where none is known.
    """
    known = np.array([value for value in values if math.isfinite(value)])
    if not len(known):
        return Measure(group, subject, quantity, unit, tuple(values), math.nan, unknown_reason=unknown_reason)
    stated = np.array([sd for value, sd in zip(values, sds, strict=False) if math.isfinite(value + sd)])
    return Measure(
        group, subject, quantity, unit, tuple(values), float(known.mean()),
        sd=float(known.std(ddof=1)) if len(known) >= MIN_REPETITIONS_FOR_SD else math.nan,
        best=math.nan if best is None else float(best(known.tolist())),
        measurement_sd=float(np.sqrt(np.mean(stated**2))) if len(stated) else math.nan,
    )  # fmt: skip


def wrist_angle_index(subject: str) -> int:
    """Return the column of a wrist's angle, -1 for a joint or anything else.

    >>> wrist_angle_index("flexion"), wrist_angle_index("PIP3_flexion")
    (1, -1)
    """
    return WRIST_ANGLES.index(subject) if subject in WRIST_ANGLES else -1


def is_total_active_motion(subject: str) -> bool:
    """Whether it is the total active motion of a finger."""
    return subject.startswith("TAM")


def negate_measure(row: Measure) -> Measure:
    """Return a deficit of an end that was never reached, counted upwards."""
    return replace(row, mean=-row.mean, best=-row.best, values=tuple(-value for value in row.values))

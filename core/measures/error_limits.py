"""Error limits that a clinic has measured itself, by test and retest, in place of the default ones."""

from __future__ import annotations

import math
from dataclasses import dataclass

FEWEST_PEOPLE = 10
"""With fewer a study puts no limit in force (clinical reference 6)."""


@dataclass(frozen=True, slots=True)
class MeasuredLimit:
    """One figure of a study, degrees: ``movement`` of an angle or joint ``of``; ``sem_deg`` the standard error of
    measurement, ``mdc95_deg`` the smallest real change, with their 95 % intervals."""

    of: str
    movement: str
    people: int
    sem_deg: float
    sem_interval_deg: tuple[float, float]
    mdc95_deg: float
    mdc95_interval_deg: tuple[float, float]

    @property
    def limit_deg(self) -> float:
        """What a change must exceed: whole degrees, upwards."""
        return float(math.ceil(self.mdc95_deg - 1e-9))


@dataclass(frozen=True, slots=True)
class RetestStudy:
    """What a clinic found of one exercise with one set of discs; ``made`` the date as 2026-11-27."""

    protocol: str
    exercise: str
    angle_order: str
    made: str
    people: int
    sessions: int
    raters: int
    limits: tuple[MeasuredLimit, ...]

    @property
    def in_force(self) -> bool:
        """Whether enough people were measured for any of its limits."""
        return any(limit.people >= FEWEST_PEOPLE for limit in self.limits)

    def limit_deg(self, of: str, movement: str) -> float | None:
        """The clinic's limit of one figure, None where it has none of its own."""
        same = (one for one in self.limits if (one.of, one.movement) == (of, movement))
        return next((one.limit_deg for one in same if one.people >= FEWEST_PEOPLE), None)


@dataclass(frozen=True, slots=True)
class ErrorLimits:
    """The clinic's studies, one for each exercise and set of discs; none: the default limits hold everywhere."""

    studies: tuple[RetestStudy, ...] = ()

    def study(self, protocol: str, exercise: str, angle_order: str) -> RetestStudy | None:
        """The study in force for sessions of a kind."""
        wanted = (protocol, exercise, angle_order)
        same = (one for one in self.studies if (one.protocol, one.exercise, one.angle_order) == wanted)
        return next((one for one in same if one.in_force), None)


DEFAULT_LIMITS = ErrorLimits()

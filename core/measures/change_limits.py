"""What may be called a change between two sessions (clinical reference 6), by default limits or by those that a clinic
has measured itself, by test and retest."""

from __future__ import annotations

import math
from dataclasses import dataclass

MDC95_FACTOR = 1.96 * math.sqrt(2.0)
"""Minimal detectable change at 95 % per standard error of measurement: 2.77."""
TOTAL_ACTIVE_MOTION = "TAM"

_DEFAULT_LIMIT_DEG = {
    "flexion": 10.0,
    "deviation": 8.0,
    "pronosupination": 15.0,
    "MCP_flexion": 12.0,
    "PIP_flexion": 12.0,
    "DIP_flexion": 12.0,
    "MCP_abduction": 8.0,
    "CMC1": 15.0,
    "MCP1": 15.0,
    "IP1": 15.0,
    TOTAL_ACTIVE_MOTION: 22.0,
}

ARC_LIMIT_FACTOR = math.sqrt(2.0)
"""Error limit of an arc against that of one of its two ends, whose errors are independent; of TAM there is an own."""


def change_limit_rad(angle_name: str) -> float:
    """Difference of two sessions' means above which it exceeds measurement error, for an angle of the session file.

    Defaults of the reference, which are its authors' choice and no published figures, until a clinic has
    test-retest data of its own; the free DIP takes the PIP's. Raises KeyError for an unknown name.

    >>> round(math.degrees(change_limit_rad("MCP4_flexion")))
    12
    """
    joint, _, motion = angle_name.partition("_")
    for key in (angle_name, joint, f"{joint.rstrip('2345')}_{motion}"):
        if key in _DEFAULT_LIMIT_DEG:
            return math.radians(_DEFAULT_LIMIT_DEG[key])
    raise KeyError(angle_name)


MIN_PEOPLE = 10
"""With fewer a study puts no limit in force (clinical reference 6)."""


@dataclass(frozen=True, slots=True)
class MeasuredLimit:
    """One figure of a study, degrees: ``movement`` of an angle or joint ``angle_or_joint``; ``sem_deg`` the standard
    error of
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
    def is_in_force(self) -> bool:
        """Whether enough people were measured for any of its limits."""
        return any(limit.people >= MIN_PEOPLE for limit in self.limits)

    def limit_deg(self, angle_or_joint: str, movement: str) -> float | None:
        """The clinic's limit of one figure, None where it has none of its own."""
        same = (one for one in self.limits if (one.of, one.movement) == (angle_or_joint, movement))
        return next((one.limit_deg for one in same if one.people >= MIN_PEOPLE), None)


@dataclass(frozen=True, slots=True)
class ErrorLimits:
    """The clinic's studies, one for each exercise and set of discs; none: the default limits hold everywhere."""

    studies: tuple[RetestStudy, ...] = ()

    def study(self, protocol: str, exercise: str, angle_order: str) -> RetestStudy | None:
        """The study in force for sessions of a kind."""
        wanted = (protocol, exercise, angle_order)
        same = (one for one in self.studies if (one.protocol, one.exercise, one.angle_order) == wanted)
        return next((one for one in same if one.is_in_force), None)


DEFAULT_LIMITS = ErrorLimits()

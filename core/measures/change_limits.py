"""Limits of a change between two sessions (clinical reference 6): defaults, or a clinic's own test-retest study."""

from __future__ import annotations

import math
from dataclasses import dataclass

MDC95_FACTOR = 1.96 * math.sqrt(2.0)
"""MDC95 over the standard error of measurement: 2.77."""
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
"""Error limit of an arc over that of one end, whose errors are independent; TAM has its own."""


def change_limit_rad(angle_name: str) -> float:
    """Return the difference of two sessions' means above which it exceeds the measurement error.

    Defaults of the clinical reference, its authors' choice, until a clinic has test-retest data. A free DIP takes the
    limit of the PIP. Raises KeyError for an unknown angle.

    >>> round(math.degrees(change_limit_rad("MCP4_flexion")))
    12
    """
    joint, _, motion = angle_name.partition("_")
    for key in (angle_name, joint, f"{joint.rstrip('2345')}_{motion}"):
        if key in _DEFAULT_LIMIT_DEG:
            return math.radians(_DEFAULT_LIMIT_DEG[key])
    raise KeyError(angle_name)


MIN_PEOPLE = 10
"""A study with fewer people sets no limit (clinical reference 6)."""


@dataclass(frozen=True, slots=True)
class MeasuredLimit:
    """Measurement error of one movement of the angle or joint ``of``, in degrees.

    Standard error of measurement and MDC95 with their 95 % intervals.
    """

    of: str
    movement: str
    people: int
    sem_deg: float
    sem_interval_deg: tuple[float, float]
    mdc95_deg: float
    mdc95_interval_deg: tuple[float, float]

    @property
    def limit_deg(self) -> float:
        """What a change must exceed, rounded up to whole degrees."""
        return float(math.ceil(self.mdc95_deg - 1e-9))


@dataclass(frozen=True, slots=True)
class RetestStudy:
    """Test-retest study of one exercise with one marker protocol; ``made`` is its ISO date."""

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
        """True if enough people were measured for any of its limits."""
        return any(limit.people >= MIN_PEOPLE for limit in self.limits)

    def limit_deg(self, angle_or_joint: str, movement: str) -> float | None:
        """Return the clinic's limit of a movement, None if it has none."""
        same = (one for one in self.limits if (one.of, one.movement) == (angle_or_joint, movement))
        return next((one.limit_deg for one in same if one.people >= MIN_PEOPLE), None)


@dataclass(frozen=True, slots=True)
class ErrorLimits:
    """The clinic's studies, one for each exercise and marker protocol; default limits apply without."""

    studies: tuple[RetestStudy, ...] = ()

    def study(self, protocol: str, exercise: str, angle_order: str) -> RetestStudy | None:
        """Return the study in force for sessions of a kind."""
        wanted = (protocol, exercise, angle_order)
        same = (one for one in self.studies if (one.protocol, one.exercise, one.angle_order) == wanted)
        return next((one for one in same if one.is_in_force), None)


DEFAULT_LIMITS = ErrorLimits()

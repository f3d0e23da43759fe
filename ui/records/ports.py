"""What the screens about records show; ``app`` works it out."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime


@dataclass(frozen=True, slots=True)
class ErasureFacts:
    """What is said before a session, or with ``when`` None a patient, is erased.

    ``made``: reports and exports that Carpus saved elsewhere; they stay. ``others`` counts the patient's sessions that
    stay. ``kept_until`` None where no years are set, ``last_backup`` None before the first. ``by_hand``: values that a
    person measured, which go with a patient.
    """

    pseudonym: str
    when: datetime | None
    exercise: str
    side: str
    sessions: int
    files: int
    size_mb: float
    made: tuple[str, ...]
    others: int
    last_backup: datetime | None
    kept_until: date | None
    retention_years: int
    today: date
    by_hand: int = 0


@dataclass(frozen=True, slots=True)
class ListedRecord:
    """A line of what is due or archived: ``identity`` of what the buttons act on."""

    identity: str
    title: str
    detail: str
    archived: bool


@dataclass(frozen=True, slots=True)
class DeedLine:
    """A line of the log, in words."""

    number: int
    when: datetime
    who: str
    what: str
    of_whom: str
    detail: str

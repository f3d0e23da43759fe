"""How long records must be kept, and which need not be any more. The years are the clinic's to say: laws differ."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime

from sqlalchemy import func, select

from carpus.core.records.changes import PRACTICE
from carpus.core.records.schema import PATIENT, SESSION
from carpus.core.records.store import Store
from carpus.core.records.values import moment

RETENTION_YEARS = (0, 3, 5, 10, 15, 20, 30)
"""To choose from; 0 is not set."""


@dataclass(frozen=True, slots=True)
class Due:
    """A patient whose last session is so old that nothing of it need be kept; ``until`` when that day was."""

    patient_id: str
    pseudonym: str
    sessions: int
    last: date
    until: date
    archived: bool


def kept_until(recorded: datetime, years: int) -> date | None:
    """The last day on which a record of that day must be there; None where no years are set.

    >>> kept_until(datetime(2024, 2, 29), 10)
    datetime.date(2034, 3, 1)
    """
    if years <= 0:
        return None
    day = recorded.date()
    try:
        return day.replace(year=day.year + years)
    except ValueError:  # the 29th of February
        return date(day.year + years, 3, 1)


def due(store: Store, years: int, today: date) -> list[Due]:
    """Patients of whom nothing need be kept any more, the oldest first: their last session decides, also one that is
    archived or simulated."""
    last, last_s = (
        func.max(SESSION.c.recorded).label("last_of_all"),
        func.max(SESSION.c.recorded_s).label("last_of_all_s"),
    )
    recordings = func.count(SESSION.c.recording_id.distinct()).label("recordings")
    query = (
        select(PATIENT, last, last_s, recordings)
        .join(SESSION, SESSION.c.patient_id == PATIENT.c.id)
        .where(PATIENT.c.id != PRACTICE, PATIENT.c.erasing == 0, SESSION.c.erasing == 0)
        .group_by(PATIENT.c.id)
    )
    found = []
    for row in store.rows(query):
        recorded = moment(row.last_of_all, row.last_of_all_s)
        until = kept_until(recorded, years)
        if until is not None and until < today:
            found.append(Due(row.id, row.pseudonym, row.recordings, recorded.date(), until, bool(row.archived)))
    return sorted(found, key=lambda one: one.until)

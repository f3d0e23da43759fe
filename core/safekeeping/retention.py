"""How long records must be kept, and which need not be any more. The years are the clinic's to say: laws differ."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime

from carpus.core.session.register import PatientRegister

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


def due(register: PatientRegister, years: int, today: date) -> list[Due]:
    """Patients of whom nothing need be kept any more, the oldest first: their last session decides."""
    found = []
    hidden = register.archived()
    for record in register.patients(archived=True):
        entries = register.sessions(record.patient_id, archived=True)
        if not entries:
            continue
        last = max(entry.recorded for entry in entries)
        until = kept_until(last, years)
        if until is not None and until < today:
            recordings = len({entry.recording_id for entry in entries})
            pseudonym, is_hidden = record.entry.pseudonym, record.patient_id in hidden
            found.append(Due(record.patient_id, pseudonym, recordings, last.date(), until, is_hidden))
    return sorted(found, key=lambda one: one.until)

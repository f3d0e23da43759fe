"""Erasing, archiving, retention and the log of a data folder.

For how many years records must be kept is set by the clinic: laws differ.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime

from sqlalchemy import func, select

from carpus.core.records import erasure
from carpus.core.records.changes import fingerprint
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.log import AuditEntry, read_log
from carpus.core.records.schema import PATIENT, SESSION
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.store import Store
from carpus.core.records.values import parse_time

RETENTION_YEARS = (0, 3, 5, 10, 15, 20, 30)
"""Choices; 0 is not set."""


@dataclass(frozen=True, slots=True)
class DuePatient:
    """Patient whose records need no longer be kept, since ``keep_until``."""

    patient_id: str
    pseudonym: str
    sessions: int
    last_session: date
    keep_until: date
    is_archived: bool


def retention_end(recorded: datetime, years: int) -> date | None:
    """Return the last day on which a record must be kept, None if no years are set.

    >>> retention_end(datetime(2024, 2, 29), 10)
    datetime.date(2034, 3, 1)
    """
    if years <= 0:
        return None
    day = recorded.date()
    try:
        return day.replace(year=day.year + years)
    except ValueError:  # the 29th of February
        return date(day.year + years, 3, 1)


def find_due_patients(store: Store, years: int, today: date) -> list[DuePatient]:
    """Return patients whose last session, archived or not, need no longer be kept; oldest first."""
    last = func.max(SESSION.c.recorded).label("last_of_all")
    last_s = func.max(SESSION.c.recorded_s).label("last_of_all_s")
    recordings = func.count(SESSION.c.recording_id.distinct()).label("recordings")
    query = (
        select(PATIENT, last, last_s, recordings)
        .join(SESSION, SESSION.c.patient_id == PATIENT.c.id)
        .where(PATIENT.c.id != PRACTICE_PATIENT, PATIENT.c.erasing == 0, SESSION.c.erasing == 0)
        .group_by(PATIENT.c.id)
    )
    found = []
    for row in store.rows(query):
        recorded = parse_time(row.last_of_all, row.last_of_all_s)
        until = retention_end(recorded, years)
        if until is not None and until < today:
            found.append(DuePatient(row.id, row.pseudonym, row.recordings, recorded.date(), until, bool(row.archived)))
    return sorted(found, key=lambda one: one.keep_until)


@dataclass(frozen=True, slots=True)
class ArchivedItem:
    """Archived patient or session; ``recorded`` is None for a patient."""

    item_id: str
    pseudonym: str
    since: datetime
    sessions: int
    patient_id: str
    recorded: datetime | None = None
    session_id: str = ""


class RecordRetention:
    """Erasure, archive and log of a data folder."""

    def __init__(self, library: DataFolder) -> None:
        self._library, self._store = library, library.store

    def plan_session(self, session_id: str) -> ErasurePlan:
        return erasure.plan_session(self._store, session_id)

    def plan_patient(self, patient_id: str) -> ErasurePlan:
        return erasure.plan_patient(self._store, patient_id)

    def erase(self, plan: ErasurePlan) -> int:
        """Erase as planned. Raises what :func:`erasure.erase` does."""
        for one in plan.results:
            self._library.drop_cached_results(one.session_id)
        self._library.frame_cache.clear()
        return erasure.erase(self._store, plan, self._library.log_writer)

    def archive_session(self, session_id: str) -> None:
        self._library.session_list.archive(session_id)
        self._library.audit_log.log_session("archived", session_id)

    def archive_patient(self, patient_id: str) -> None:
        self._library.patients.archive(patient_id)
        self._library.audit_log.log_patient("archived", patient_id)

    def unarchive(self, item_id: str) -> None:
        """Restore a patient or session from the archive by its id."""
        if item_id in self._library.patients.archive_times():
            self._library.patients.unarchive(item_id)
            self._library.audit_log.log_patient("brought_back", item_id)
        else:
            self._library.session_list.unarchive(item_id)
            self._library.audit_log.log_session("brought_back", item_id)

    def list_archived(self) -> list[ArchivedItem]:
        """Return the archived patients and sessions, last archived first."""
        library, found = self._library, []
        for patient_id, since in library.patients.archive_times().items():
            entries = library.session_list.patient_sessions(patient_id, include_archived=True)
            pseudonym = library.patients.get(patient_id).pseudonym
            found.append(
                ArchivedItem(patient_id, pseudonym, since, len({one.recording_id for one in entries}), patient_id)
            )
        for entry, owner, since in library.session_list.list_archived():
            if owner:
                pseudonym, session_id = library.patients.get(owner).pseudonym, entry.session_id
                found.append(ArchivedItem(session_id, pseudonym, since, 1, owner, entry.recorded, session_id))
        return sorted(found, key=lambda one: one.since, reverse=True)

    def read_log(self) -> tuple[AuditEntry, ...]:
        """Return the log, then log that it was read."""
        found = read_log(self._store)
        self._library.audit_log.log_program("read_log")
        return found

    def subject_names(self) -> dict[str, str]:
        """Return names of patients and sessions by their fingerprint; erased ones have none."""
        known = {}
        for record in self._library.patients.search(include_archived=True):
            pseudonym = record.pseudonym
            known[fingerprint(record.patient_id)] = pseudonym
            for entry in self._library.session_list.patient_sessions(record.patient_id, include_archived=True):
                known[fingerprint(entry.session_id)] = f"{pseudonym}, {entry.recorded:%Y-%m-%d %H:%M}"
        known[fingerprint(PRACTICE_PATIENT)] = "practice"
        return known

"""Audit log: who opened, changed, exported or erased what, and when. A trigger allows insertion only.

That protects against mistakes of people and programs, not against the owner of the computer: a backup elsewhere shows
later changes. The log has no names and no ids. Patients and sessions are entered by a fingerprint of their id, so that
entries of erased ones belong to nobody. Facts are numbers and words of the program.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Literal, get_args

from sqlalchemy import select

from carpus.core.model.errors import CarpusFault, ServerUnavailable, SessionUnreadable
from carpus.core.records.changes import fingerprint, insert_row
from carpus.core.records.schema import AUDIT_LOG
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import MAX_INITIALS, parse_time

AuditAction = Literal[
    "opened", "recorded", "added", "changed", "exported", "reported", "set_aside", "taken_back", "moved", "renamed",
    "tracked_again", "recovered", "archived", "brought_back", "erase_begun", "erased", "backed_up", "backup_compared",
    "restored", "locked", "unlocked", "pin_refused", "pin_changed", "read_log", "entered_by_hand",
]  # fmt: skip
SubjectKind = Literal["session", "patient", "everything", "program"]
AuditSource = Literal["window", "command"]
Fact = int | str

_WORD = re.compile(r"[a-z0-9_.,-]{0,64}")
"""Words of the program have no capitals and no blanks, so that no name slips in by a path."""


@dataclass(frozen=True, slots=True)
class AuditEntry:
    """Entry of the log; ``subject`` is a :func:`fingerprint`."""

    number: int
    when: datetime
    initials: str
    source: AuditSource
    action: AuditAction
    kind: SubjectKind
    subject: str
    facts: Mapping[str, Fact] = field(default_factory=dict)


class AuditLogWriter:
    """Writer of a store's log."""

    def __init__(self, store: Store, source: AuditSource, get_initials: Callable[[], str] = lambda: "") -> None:
        self._store, self._source, self.get_initials = store, source, get_initials

    def write_entry(self, action: AuditAction, kind: SubjectKind, subject_id: str = "", **facts: Fact) -> None:
        """Write an entry. Raises the faults of writing, and ValueError for a fact that could be a name."""
        if action not in get_args(AuditAction) or kind not in get_args(SubjectKind):
            raise ValueError(f"{action} {kind} is not of the log")
        if not all(isinstance(fact, int) or _WORD.fullmatch(fact) for fact in facts.values()):
            raise ValueError(f"facts {facts} could name somebody")
        row = {
            "at": datetime.now(UTC).isoformat(timespec="seconds"), "at_ns": time.time_ns(),
            "who": self.get_initials()[:MAX_INITIALS], "by": self._source, "did": action, "kind": kind,
            "subject": fingerprint(subject_id), "facts": json.dumps(facts),
        }  # fmt: skip
        self._store.apply([insert_row(AUDIT_LOG, new_id(), **row)])


class AuditLog:
    """Log of what is done with sessions and patients, without the practice patient.

    Faults of writing go to ``on_fault`` and undo nothing. ``owner_id`` returns a session's patient or raises
    :class:`SessionUnreadable`.
    """

    def __init__(
        self, writer: AuditLogWriter, owner_id: Callable[[str], str], on_fault: Callable[[CarpusFault], None]
    ) -> None:
        self._writer, self._owner_id, self._on_fault = writer, owner_id, on_fault

    def log_session(self, action: AuditAction, session_id: str, **facts: Fact) -> None:
        with suppress(SessionUnreadable, ServerUnavailable):  # of a folder that went away: noted when it comes home
            if self._owner_id(session_id) != PRACTICE_PATIENT:
                self._write(action, "session", session_id, **facts)

    def log_patient(self, action: AuditAction, patient_id: str, **facts: Fact) -> None:
        """Log an action on a patient or on all of a patient's sessions."""
        if patient_id != PRACTICE_PATIENT:
            self._write(action, "patient", patient_id, **facts)

    def log_program(self, action: AuditAction, **facts: Fact) -> None:
        """Log an action on the program or on all data."""
        self._write(action, "program", "", **facts)

    def _write(self, action: AuditAction, kind: SubjectKind, subject_id: str, **facts: Fact) -> None:
        try:
            self._writer.write_entry(action, kind, subject_id, **facts)
        except CarpusFault as fault:
            if not isinstance(fault, ServerUnavailable):  # the window says so as long as it is away
                self._on_fault(fault)


def read_log(store: Store) -> tuple[AuditEntry, ...]:
    """Return the whole log, oldest first; the numbers of damaged entries are missing."""
    rows = store.rows(select(AUDIT_LOG).order_by(AUDIT_LOG.c.at_ns, AUDIT_LOG.c.id))
    numbers = {row.id: number for number, row in enumerate(rows, 1)}
    return tuple(
        store.valid_rows(
            rows,
            lambda row: AuditEntry(
                numbers[row.id], parse_time(row.at, row.at_ns / 1e9), row.who, row.by, row.did, row.kind, row.subject,
                dict(json.loads(row.facts)),
            ),
        )
    )  # fmt: skip

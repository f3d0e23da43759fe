"""Who opened, changed, exported or erased what, and when: rows that are only ever added to, by a trigger of the store.

That protects against mistakes of people and of programs, not against the owner of the computer, who can do with a file
as he likes: a back-up kept elsewhere is what shows a later change.

Nobody's name is in it, nor an identity: patients and sessions stand there by a fingerprint of the identity that the
program gave them, so that of what was erased nobody can say whose it was. Facts are numbers and words
of the program.
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

from carpus.core.errors import CarpusFault, ServerGone
from carpus.core.records.changes import PRACTICE, fingerprint, new
from carpus.core.records.schema import DEED
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import moment

MOST_INITIALS = 12

Deed = Literal[
    "opened", "recorded", "added", "changed", "exported", "reported", "set_aside", "taken_back", "moved", "renamed",
    "tracked_again", "recovered", "archived", "brought_back", "erase_begun", "erased", "backed_up", "backup_compared",
    "restored", "locked", "unlocked", "pin_refused", "pin_changed", "read_log", "entered_by_hand",
]  # fmt: skip
Kind = Literal["session", "patient", "everything", "program"]
By = Literal["window", "command"]
Fact = int | str

_WORD = re.compile(r"[a-z0-9_.,-]{0,64}")
"""A fact in words is one of the program's own: neither capitals nor blanks, so that no name slips in by a path."""


@dataclass(frozen=True, slots=True)
class LoggedDeed:
    """One deed. ``who`` the initials of the person, empty where none are set; ``subject`` as :func:`fingerprint`."""

    number: int
    when: datetime
    who: str
    by: By
    did: Deed
    kind: Kind
    subject: str
    facts: Mapping[str, Fact] = field(default_factory=dict)


class Log:
    """Adds to the log of one store."""

    def __init__(self, store: Store, by: By, who: Callable[[], str] = lambda: "") -> None:
        self._store, self._by, self.who = store, by, who

    def note(self, did: Deed, kind: Kind, identity: str = "", **facts: Fact) -> None:
        """Write a deed down. Raises the faults of writing; ValueError for a fact that could be a name: a mistake of
        the caller."""
        if did not in get_args(Deed) or kind not in get_args(Kind):
            raise ValueError(f"{did} {kind} is not of the log")
        if not all(isinstance(fact, int) or _WORD.fullmatch(fact) for fact in facts.values()):
            raise ValueError(f"facts {facts} could name somebody")
        row = {
            "at": datetime.now(UTC).isoformat(timespec="seconds"), "at_ns": time.time_ns(),
            "who": self.who()[:MOST_INITIALS], "by": self._by, "did": did, "kind": kind,
            "subject": fingerprint(identity), "facts": json.dumps(facts),
        }  # fmt: skip
        self._store.do([new(DEED, new_id(), **row)])


class Notes:
    """Takes down what is done with sessions and patients. The practice patient is nobody, and in no log; where the log
    cannot be written ``on_fault`` is told: what was done is done.

    ``owner`` says whose a session is, and raises KeyError for one that is not in the list.
    """

    def __init__(self, log: Log, owner: Callable[[str], str], on_fault: Callable[[CarpusFault], None]) -> None:
        self._log, self._owner, self._on_fault = log, owner, on_fault

    def session(self, did: Deed, session_id: str, **facts: Fact) -> None:
        with suppress(KeyError, ServerGone):  # of a folder that went away: noted when it comes home
            if self._owner(session_id) != PRACTICE:
                self._note(did, "session", session_id, **facts)

    def patient(self, did: Deed, patient_id: str, **facts: Fact) -> None:
        """What was done with a patient, or with all sessions of one."""
        if patient_id != PRACTICE:
            self._note(did, "patient", patient_id, **facts)

    def program(self, did: Deed, **facts: Fact) -> None:
        """What was done with the program or with everything."""
        self._note(did, "program", "", **facts)

    def _note(self, did: Deed, kind: Kind, identity: str, **facts: Fact) -> None:
        try:
            self._log.note(did, kind, identity, **facts)
        except CarpusFault as fault:
            if not isinstance(fault, ServerGone):  # the window says so as long as it is away
                self._on_fault(fault)


def was_erased(store: Store, patient_id: str) -> bool:
    """Whether a patient was erased, or is being erased: what is found of them later goes too."""
    erased = DEED.c.did.in_(("erase_begun", "erased")), DEED.c.kind == "patient"
    return store.row(select(DEED.c.id).where(*erased, DEED.c.subject == fingerprint(patient_id)).limit(1)) is not None


def read_log(store: Store) -> tuple[LoggedDeed, ...]:
    """The whole log, oldest first; of a line that is damaged the number is missing."""
    rows = store.rows(select(DEED).order_by(DEED.c.at_ns, DEED.c.id))
    numbers = {row.id: number for number, row in enumerate(rows, 1)}
    return tuple(
        store.sound(
            rows,
            lambda row: LoggedDeed(
                numbers[row.id], moment(row.at, row.at_ns / 1e9), row.who, row.by, row.did, row.kind, row.subject,
                dict(json.loads(row.facts)),
            ),
        )
    )  # fmt: skip

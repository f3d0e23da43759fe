"""Changes of the store: rows are inserted, updated and deleted together.

Each row has a version. An update made from an older version than the stored one is refused.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from sqlalchemy import Connection, Table, delete, func, insert, select, update
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.exc import IntegrityError

from carpus.core.model.errors import ConcurrentChange, PseudonymTaken
from carpus.core.records.schema import AUDIT_LOG, PATIENT, SESSION, TABLES
from carpus.core.records.session_setup import PRACTICE_PATIENT

LOST_FOLDER = "lost/"
"""Prefix of the path of a session whose file was replaced by another one and not found again."""

_IDENTITY = re.compile(r"[0-9a-f]{32}")
RowAction = Literal["new", "change", "keep", "drop"]


@dataclass(frozen=True, slots=True)
class RowChange:
    """Change of one row.

    ``new`` requires that the row does not exist, ``change`` that it does, in ``version`` unless that is 0; ``keep``
    inserts or updates; ``drop`` deletes the row and all that refers to it.
    """

    action: RowAction
    table: str
    id: str
    values: Mapping[str, Any]
    version: int = 0


ChangeSet = Sequence[RowChange]


def insert_row(table: Table, id: str, **values: Any) -> RowChange:
    """Return the insertion of a new row."""
    return RowChange("new", table.name, id, _sanitize_texts(values))


def update_row(table: Table, id: str, version: int = 0, **values: Any) -> RowChange:
    """Return the update of a row that was read in ``version``, 0 for any."""
    return RowChange("change", table.name, id, _sanitize_texts(values), version)


def upsert_row(table: Table, id: str, **values: Any) -> RowChange:
    """Return the insertion or update of a row."""
    return RowChange("keep", table.name, id, _sanitize_texts(values))


def delete_row(table: Table, id: str) -> RowChange:
    """Return the deletion of a row."""
    return RowChange("drop", table.name, id, {})


def _sanitize_texts(values: Mapping[str, Any]) -> Mapping[str, Any]:
    """Replace characters that no database stores: NUL and lone surrogates."""
    return {
        name: value.replace("\0", "\N{REPLACEMENT CHARACTER}").encode("utf-8", "replace").decode()
        if isinstance(value, str) else value
        for name, value in values.items()
    }  # fmt: skip


def apply_changes(connection: Connection, changes: ChangeSet) -> None:
    """Apply changes in an open transaction, which must be rolled back after a fault.

    Raises :class:`ConcurrentChange` for a row that was changed or deleted, :class:`PseudonymTaken`.
    """
    owners: set[str] = set()
    for row in changes:
        if row.table == SESSION.name:
            before = connection.execute(select(SESSION.c.patient_id).where(SESSION.c.id == row.id)).scalar()
            owners |= {one for one in (before, row.values.get("patient_id")) if one}
        try:
            table = TABLES[row.table]
            raised = {**row.values, "version": table.c.version + 1}
            if row.action == "new":
                connection.execute(insert(table).values(id=row.id, **row.values))
            elif row.action == "change":
                these = update(table).where(table.c.id == row.id).values(raised)
                if row.version:
                    these = these.where(table.c.version == row.version)
                if connection.execute(these).rowcount != 1:
                    raise ConcurrentChange(row.table)
            elif row.action == "keep":
                kind = sqlite if connection.dialect.name == "sqlite" else postgresql
                made = kind.insert(table).values(id=row.id, **row.values)
                connection.execute(made.on_conflict_do_update(index_elements=["id"], set_=raised))
            else:
                connection.execute(delete(table).where(table.c.id == row.id))
        except IntegrityError as cause:
            if "pseudonym_key" in str(cause.orig):
                raise PseudonymTaken(row.values.get("pseudonym", "")) from cause
            raise ConcurrentChange(row.table) from cause
    for patient_id in sorted(owners):
        update_session_counts(connection, patient_id)


def is_patient_id(text: str) -> bool:
    """Return whether a text has the form of a patient's id, which also names the patient's folder."""
    return text == PRACTICE_PATIENT or _IDENTITY.fullmatch(text) is not None


def fingerprint(identity: str) -> str:
    """Return what stands in the log for the id of a patient or session; empty for no id."""
    return hashlib.sha256(identity.encode("utf-8", "backslashreplace")).hexdigest()[:16] if identity else ""


ERASED_SUBJECTS = select(AUDIT_LOG.c.subject).where(AUDIT_LOG.c.did.in_(("erase_begun", "erased")))
"""Query of the fingerprints of patients and sessions that were, or are being, erased."""


def update_session_counts(connection: Connection, patient_id: str) -> None:
    """Update a patient's session counts and last session.

    A recording counts once, an archived or simulated one not at all.
    """
    mine = [SESSION.c.patient_id == patient_id, SESSION.c.archived == "", SESSION.c.erasing == 0]
    if patient_id != PRACTICE_PATIENT:
        mine.append(SESSION.c.simulated == 0)
    recordings, results = connection.execute(
        select(func.count(SESSION.c.recording_id.distinct()), func.count()).where(*mine)
    ).one()
    last = connection.execute(
        select(SESSION.c.recorded, SESSION.c.recorded_s, SESSION.c.exercise)
        .where(*mine)
        .order_by(SESSION.c.recorded_s.desc(), SESSION.c.created_s.desc())
        .limit(1)
    ).one_or_none() or ("", 0.0, "")
    last_columns = dict(zip(("last_session", "last_s", "last_exercise"), last, strict=True))
    connection.execute(
        update(PATIENT).where(PATIENT.c.id == patient_id).values(sessions=recordings, results=results, **last_columns)
    )

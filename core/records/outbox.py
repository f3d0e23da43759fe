"""Where changes wait for the clinic's server, in the file of the copy."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from sqlalchemy import Connection, delete, insert, select, update

from carpus.core.records.changes import Change, RowChange, read_back, told
from carpus.core.records.schema import OUTBOX, OWN, SESSION


def lay_out(connection: Connection, change: Change, change_id: str) -> None:
    """Lay a change into the outbox, in the transaction that makes it in the copy."""
    connection.execute(insert(OUTBOX).values(id=change_id, change=told(change)))


def is_shared(connection: Connection) -> bool:
    """Whether the copy has a server behind it."""
    return connection.execute(select(OWN.c.value).where(OWN.c.name == "server")).first() is not None


def forget(connection: Connection, ids: Collection[str]) -> None:
    """Take what is to go out of the changes that wait: rows of these identities and what belongs to them. Of a session
    that stays, since it was given to somebody else, only the former owner goes."""
    for waiting in connection.execute(select(OUTBOX)).all():
        change = read_back(waiting.change)
        left = [one for row in change if (one := _without(row, ids)) is not None]
        if left != change:
            these = OUTBOX.c.id == waiting.id
            rewritten = update(OUTBOX).where(these).values(change=told(left))
            connection.execute(rewritten if left else delete(OUTBOX).where(these))


def _without(row: RowChange, ids: Collection[str]) -> RowChange | None:
    if row.id in ids or row.values.get("session_id") in ids:
        return None
    if row.values.get("patient_id") not in ids:
        return row
    return replace(row, values={**row.values, "patient_id": None}) if row.table == SESSION.name else None

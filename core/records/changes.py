"""A change of the store: rows that come, change and go together, told so that it can wait and be made elsewhere.

The same change is made in the copy of this computer and on a clinic's server, and there once, however often it is
sent. Where two people change one row, the second change finds another version than the one it was made from, and is
refused.
"""

from __future__ import annotations

import json
import re
import secrets
from collections.abc import Collection, Mapping, Sequence
from dataclasses import astuple, dataclass, field, replace
from typing import Any, Literal

from sqlalchemy import Column, Connection, RowMapping, Table, delete, func, insert, select, update
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.exc import IntegrityError

from carpus.core.errors import CarpusFault, ChangedMeanwhile, PseudonymTaken
from carpus.core.records.schema import OUTBOX, OWN, PATIENT, SESSION, SHARED, TOMBSTONE

NOWHERE = "lost/"
"""Begins the path of a session in whose place a file of another lies, and whose own was not found."""
PRACTICE = "practice"
"""Identity of the practice patient, of whom simulated sessions count, and who is on no server."""

_MOST_VERSION = 1 << 30
_IDENTITY = re.compile(r"[0-9a-f]{32}")
Way = Literal["new", "change", "keep", "drop", "join"]


@dataclass(frozen=True, slots=True)
class RowChange:
    """What becomes of one row. ``new`` must not be there; ``change`` must be, in ``version`` unless that is 0; ``keep``
    makes it or changes it, whatever is there; ``drop`` takes it away with all that belongs to it; ``join`` makes it on
    a server, unless it is or was there.

    ``mark`` is the change's own by chance, and a version tells the changes that a row has seen: two rows that were
    changed equally often, but otherwise, are never taken for the same."""

    way: Way
    table: str
    id: str
    values: Mapping[str, Any]
    version: int = 0
    mark: int = field(default_factory=lambda: secrets.randbelow(_MOST_VERSION))

    def after(self, version: Any) -> Any:
        """The version that a row has then, which had ``version``; 0 for one that was not there."""
        return (version + self.mark) % _MOST_VERSION + 1


Change = Sequence[RowChange]


def new(table: Table, id: str, **values: Any) -> RowChange:
    """A row that is not there yet."""
    return RowChange("new", table.name, id, _storable(values))


def changed(table: Table, id: str, version: int = 0, **values: Any) -> RowChange:
    """A row that is there, as it was read."""
    return RowChange("change", table.name, id, _storable(values), version)


def kept(table: Table, id: str, **values: Any) -> RowChange:
    """A row as it is from now on."""
    return RowChange("keep", table.name, id, _storable(values))


def dropped(table: Table, id: str) -> RowChange:
    """A row that goes."""
    return RowChange("drop", table.name, id, {})


def _storable(values: Mapping[str, Any]) -> Mapping[str, Any]:
    """Texts without signs that no database takes: zeros, halves of a sign."""
    return {
        name: value.replace("\0", "\N{REPLACEMENT CHARACTER}").encode("utf-8", "replace").decode()
        if isinstance(value, str) else value
        for name, value in values.items()
    }  # fmt: skip


def joining(table: Table, rows: Sequence[RowMapping]) -> Change:
    """Rows of a copy, for a server that may know them."""
    return [
        RowChange("join", table.name, row["id"], {k: v for k, v in row.items() if k not in ("id", "step")})
        for row in rows
    ]


def told(change: Change) -> str:
    """As JSON."""
    return json.dumps([astuple(row) for row in change], ensure_ascii=False)


def read_back(text: str) -> Change:
    """What :func:`told` wrote."""
    return [RowChange(*row) for row in json.loads(text)]


def make(connection: Connection, change: Change) -> None:
    """Make a change in an open transaction.

    Raises :class:`ChangedMeanwhile` for a row that is another by now or gone, :class:`PseudonymTaken`; then the
    transaction must end without effect.
    """
    owners: set[str] = set()
    if change and change[0].way == "join":
        _join(connection, change)
        owners = {row.values["patient_id"] for row in change if row.table == "session" and row.values["patient_id"]}
        change = ()
    for row in change:
        if row.table == "session":
            before = connection.execute(select(SESSION.c.patient_id).where(SESSION.c.id == row.id)).scalar()
            owners |= {one for one in (before, row.values.get("patient_id")) if one}
        try:
            _MAKING[row.way](connection, SHARED[row.table], row)
        except IntegrityError as cause:
            raise _refused(row, cause) from cause
    for patient_id in sorted(owners):
        _count(connection, patient_id)


def _refused(row: RowChange, cause: IntegrityError) -> CarpusFault:
    if "folded" in str(cause.orig):
        return PseudonymTaken(row.values.get("pseudonym", ""))
    return ChangedMeanwhile(row.table)


def _new(connection: Connection, table: Table, row: RowChange) -> None:
    if table is PATIENT and _typed_after_file(connection, row):
        return
    connection.execute(insert(table).values(id=row.id, version=row.after(0), **row.values))


def _typed_after_file(connection: Connection, row: RowChange) -> bool:
    """A patient whom one computer has typed and another made of a file, by the identity that the folder says: what was
    typed holds, whichever comes first. Whether it was so."""
    added_s = connection.execute(select(PATIENT.c.added_s).where(PATIENT.c.id == row.id)).scalar()
    if added_s is None or (added_s and row.values.get("added_s")):
        return False
    if row.values.get("added_s"):
        _kept(connection, PATIENT, row)
    return True


def _changed(connection: Connection, table: Table, row: RowChange) -> None:
    these = update(table).where(table.c.id == row.id)
    if row.version:
        these = these.where(table.c.version == row.version)
    if connection.execute(these.values(version=row.after(table.c.version), **row.values)).rowcount != 1:
        raise ChangedMeanwhile(row.table)


def _kept(connection: Connection, table: Table, row: RowChange) -> None:
    kind = sqlite if connection.dialect.name == "sqlite" else postgresql
    these = kind.insert(table).values({**row.values, "id": row.id, "version": row.after(0)})
    then = {**row.values, "version": row.after(table.c.version)}
    connection.execute(these.on_conflict_do_update(index_elements=["id"], set_=then))


def _dropped(connection: Connection, table: Table, row: RowChange) -> None:
    connection.execute(delete(table).where(table.c.id == row.id))


_MAKING = {"new": _new, "change": _changed, "keep": _kept, "drop": _dropped}


def _join(connection: Connection, change: Change) -> None:
    """Rows of one table of a copy, those that a server has not and never had: what was erased does not come back by a
    copy that is older. A file of another name lies where such a path leads already."""
    table, ids = SHARED[change[0].table], [row.id for row in change]
    if table is PATIENT:
        change = [row for row in change if not _typed_after_file(connection, row)]
    known = {*_those(connection, TOMBSTONE.c.id, ids), *_those(connection, table.c.id, ids)}
    rows = [{"id": row.id, **row.values} for row in change if row.id not in known]
    for key in table.foreign_keys:
        of = key.parent.name
        there = _those(connection, key.column, [row[of] for row in rows if row[of]])
        rows = [row for row in rows if not row[of] or row[of] in there]
    if table is PATIENT and (taken := _those(connection, PATIENT.c.folded, [row["folded"] for row in rows])):
        raise PseudonymTaken(next(row["pseudonym"] for row in rows if row["folded"] in taken))
    if table is SESSION:
        taken = _those(connection, SESSION.c.path, [row["path"] for row in rows])
        rows = [row | {"path": f"{NOWHERE}{row['id']}"} if row["path"] in taken else row for row in rows]
    if rows:
        connection.execute(insert(table), rows)


def _those(connection: Connection, column: Column[Any], values: Sequence[Any]) -> set[Any]:
    return set(connection.scalars(select(column).where(column.in_(values))))


def is_identity(text: str) -> bool:
    """Whether this program gives such identities to patients, whose folders have them for names."""
    return text == PRACTICE or _IDENTITY.fullmatch(text) is not None


def is_practice(connection: Connection, row: RowChange) -> bool:
    """Whether a row is the practice patient's, and so of this computer alone."""
    if row.table == "patient":
        return row.id == PRACTICE
    owner = row.values.get("patient_id")
    session_id = row.id if row.table == "session" else row.values.get("session_id")
    if owner is None and row.table == "correction":
        session_id = row.id
    if owner is None and session_id is not None:
        owner = connection.execute(select(SESSION.c.patient_id).where(SESSION.c.id == session_id)).scalar()
    return bool(owner == PRACTICE)


def _count(connection: Connection, patient_id: str) -> None:
    """What a patient's row says of the sessions: a recording counts once, an archived or simulated one not."""
    mine = [SESSION.c.patient_id == patient_id, SESSION.c.archived == "", SESSION.c.erasing == 0]
    if patient_id != PRACTICE:
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
    said = dict(zip(("last", "last_s", "last_exercise"), last, strict=True))
    connection.execute(
        update(PATIENT).where(PATIENT.c.id == patient_id).values(sessions=recordings, results=results, **said)
    )


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

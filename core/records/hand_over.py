"""What a computer has of its own when it meets its clinic's server: the store that it had alone or, of Carpus 0.2.0, a
copy of the server's with changes that had not arrived. It goes to the server once."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

from sqlalchemy import Column, Connection, Table, insert, select, text
from sqlalchemy.exc import DBAPIError

from carpus.core.errors import CarpusFault, ChangedMeanwhile, PseudonymGiven, PseudonymTaken
from carpus.core.records.changes import ERASED, NOWHERE, PRACTICE, RowChange, count_sessions, fingerprint, make
from carpus.core.records.schema import PATIENT, SESSION, TABLES

AT_ONCE = 500
MOST_NAMESAKES = 99
_WHICH = text(
    "SELECT system_identifier || '/' || current_database() || '/' || coalesce(to_regclass('deed')::oid::text, '')"
    " FROM pg_control_system()"
)
_NEWLY_DELIVERED = text(
    "INSERT INTO delivered (id, at_s) VALUES (:id, extract(epoch from now())) ON CONFLICT DO NOTHING RETURNING id"
)


class HandOver:
    """What lies in the SQLite ``file`` is made on a server in the open transaction ``there``; ``faults`` tell what
    somebody else was quicker with, ``was_copy`` whether the server had all but the changes that waited.

    Nobody comes back who was erased there, as its log says.
    """

    def __init__(self, file: Path, there: Connection) -> None:
        self.faults: list[CarpusFault] = []
        self._there, self._brought = there, set[str]()
        self._gone = set(there.scalars(ERASED))
        with closing(sqlite3.connect(file)) as old:
            old.row_factory = sqlite3.Row
            tables = {str(name) for (name,) in old.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
            version = old.execute("SELECT version_num FROM alembic_version").fetchone()[0]
            server = old.execute("SELECT value FROM own WHERE name = 'server'").fetchone() if "own" in tables else None
            self.was_copy = version == "1" and server is not None and server[0] == str(there.execute(_WHICH).scalar())
            if not self.was_copy:
                for table in TABLES.values():
                    rows = old.execute(f"SELECT * FROM {table.name}")
                    while part := rows.fetchmany(AT_ONCE):
                        self._bring(table, [dict(row) for row in part])
            if "outbox" in tables:
                for row in old.execute("SELECT id, change FROM outbox WHERE refused = '' ORDER BY number"):
                    if there.execute(_NEWLY_DELIVERED, {"id": row["id"]}).first():
                        self._deliver(json.loads(row["change"]))

    def _bring(self, table: Table, rows: Sequence[Mapping[str, Any]]) -> None:
        """Rows that the server lacks. A name that is taken there gets a number; a file of another session lies where
        such a path leads already."""
        known = self._those(table.c.id, [row["id"] for row in rows])
        names = {column.name for column in table.c}
        mine = [
            {name: value for name, value in row.items() if name in names}
            for row in rows
            if row["id"] not in known and fingerprint(row["id"]) not in self._gone
            and PRACTICE not in (row["id"], row.get("patient_id"))
        ]  # fmt: skip
        for key in table.foreign_keys:
            of = key.parent.name
            there = self._those(key.column, [row[of] for row in mine if row[of]])
            mine = [row for row in mine if not row[of] or row[of] in there]
        if table is SESSION:
            taken = self._those(SESSION.c.path, [row["path"] for row in mine])
            mine = [row | {"path": f"{NOWHERE}{row['id']}"} if row["path"] in taken else row for row in mine]
        if table is PATIENT:
            taken = self._those(PATIENT.c.folded, [row["folded"] for row in mine])
            for row in (row for row in mine if row["folded"] in taken):
                self._make([RowChange("new", table.name, row["id"], {k: v for k, v in row.items() if k != "id"})])
            mine = [row for row in mine if row["folded"] not in taken]
            self._brought |= {row["id"] for row in mine}
        if mine:
            self._there.execute(insert(table), mine)
        if table is SESSION:
            for patient_id in {row["patient_id"] for row in mine if row["patient_id"]} - self._brought:
                count_sessions(self._there, patient_id)

    def _those(self, column: Column[Any], values: Sequence[Any]) -> set[Any]:
        return set(self._there.scalars(select(column).where(column.in_(values))))

    def _deliver(self, change: Sequence[Sequence[Any]]) -> None:
        """One that waited, as 0.2.0 wrote it down: way, table, identity, values, version, mark."""
        if change and change[0][0] == "join":
            self._bring(TABLES[change[0][1]], [{"id": row_id, **values} for _, _, row_id, values, *_ in change])
        else:
            self._make([RowChange(*row[:5]) for row in change])

    def _make(self, change: Sequence[RowChange]) -> None:
        for number in range(1, MOST_NAMESAKES):
            sent = [_numbered(row, number) for row in change]
            try:
                with self._there.begin_nested():
                    make(self._there, sent)
            except PseudonymTaken:
                continue
            except (CarpusFault, DBAPIError, KeyError):
                break
            named = [row for row, one in zip(change, sent, strict=True) if row != one]
            self.faults += [PseudonymGiven(row.values["pseudonym"], f"{number}") for row in named]
            return
        self.faults.append(ChangedMeanwhile(change[0].table if change else ""))


def _numbered(row: RowChange, number: int) -> RowChange:
    """A new patient with a number behind the pseudonym, from the second on."""
    if number == 1 or row.way != "new" or row.table != PATIENT.name:
        return row
    named = {name: f"{row.values[name]} ({number})" for name in ("pseudonym", "folded")}
    return replace(row, values={**row.values, **named})

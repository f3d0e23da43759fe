"""Import of a computer's own store into the clinic's server, once, when they first meet.

The store is one that the computer had alone or, of Carpus 0.2.0, a copy of the server's with queued changes.
"""

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

from carpus.core.model.errors import CarpusFault, ConcurrentChange, PseudonymNumbered, PseudonymTaken
from carpus.core.records.changes import (
    ERASED_SUBJECTS,
    LOST_FOLDER,
    RowChange,
    apply_changes,
    fingerprint,
    update_session_counts,
)
from carpus.core.records.schema import PATIENT, SESSION, TABLES, rename_former_columns
from carpus.core.records.session_setup import PRACTICE_PATIENT

BATCH_ROWS = 500
MAX_NAMESAKES = 99
_SERVER_ID_QUERY = text(
    "SELECT system_identifier || '/' || current_database() || '/' || coalesce(to_regclass('deed')::oid::text, '')"
    " FROM pg_control_system()"
)
_MARK_DELIVERED = text(
    "INSERT INTO delivered (id, at_s) VALUES (:id, extract(epoch from now())) ON CONFLICT DO NOTHING RETURNING id"
)


class LocalStoreImport:
    """Import of the SQLite file ``path`` into an open transaction of the server.

    ``faults`` report rows that somebody else changed first; ``was_server_copy``: the server had all but the queued
    changes. Patients erased on the server do not come back.
    """

    def __init__(self, path: Path, server: Connection) -> None:
        self.faults: list[CarpusFault] = []
        self._server, self._new_patients = server, set[str]()
        self._erased = set(server.scalars(ERASED_SUBJECTS))
        with closing(sqlite3.connect(path)) as old:
            old.row_factory = sqlite3.Row
            tables = {str(name) for (name,) in old.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
            version = old.execute("SELECT version_num FROM alembic_version").fetchone()[0]
            own_server = (
                old.execute("SELECT value FROM own WHERE name = 'server'").fetchone() if "own" in tables else None
            )
            self.was_server_copy = (
                version == "1"
                and own_server is not None
                and own_server[0] == str(server.execute(_SERVER_ID_QUERY).scalar())
            )
            if not self.was_server_copy:
                for table in (TABLES[name] for name in TABLES if name in tables):
                    rows = old.execute(f"SELECT * FROM {table.name}")
                    while part := rows.fetchmany(BATCH_ROWS):
                        self._import_rows(table, [dict(row) for row in part])
            if "outbox" in tables:
                for row in old.execute("SELECT id, change FROM outbox WHERE refused = '' ORDER BY number"):
                    if server.execute(_MARK_DELIVERED, {"id": row["id"]}).first():
                        # apply a queued change of 0.2.0: action, table, id, values, version, mark
                        change = json.loads(row["change"])
                        if change and change[0][0] == "join":
                            self._import_rows(
                                TABLES[change[0][1]], [{"id": row_id, **values} for _, _, row_id, values, *_ in change]
                            )
                        else:
                            self._apply(
                                [
                                    RowChange(
                                        action, name, row_id, rename_former_columns(TABLES[name], values), version
                                    )
                                    for action, name, row_id, values, version, *_ in change
                                ]
                            )

    def _import_rows(self, table: Table, rows: Sequence[Mapping[str, Any]]) -> None:
        """Insert rows that the server lacks.

        A pseudonym that is taken gets a number; a session whose path is taken goes to :data:`LOST_FOLDER`.
        """
        known = self._existing_values(table.c.id, [row["id"] for row in rows])
        mine = [
            rename_former_columns(table, row)
            for row in rows
            if row["id"] not in known and fingerprint(row["id"]) not in self._erased
            and PRACTICE_PATIENT not in (row["id"], row.get("patient_id"))
        ]  # fmt: skip
        for key in table.foreign_keys:
            of = key.parent.name
            there = self._existing_values(key.column, [row[of] for row in mine if row[of]])
            mine = [row for row in mine if not row[of] or row[of] in there]
        if table is SESSION:
            taken = self._existing_values(SESSION.c.path, [row["path"] for row in mine])
            mine = [row | {"path": f"{LOST_FOLDER}{row['id']}"} if row["path"] in taken else row for row in mine]
        if table is PATIENT:
            taken = self._existing_values(PATIENT.c.pseudonym_key, [row["pseudonym_key"] for row in mine])
            for row in (row for row in mine if row["pseudonym_key"] in taken):
                self._apply([RowChange("new", table.name, row["id"], {k: v for k, v in row.items() if k != "id"})])
            mine = [row for row in mine if row["pseudonym_key"] not in taken]
            self._new_patients |= {row["id"] for row in mine}
        if mine:
            self._server.execute(insert(table), mine)
        if table is SESSION:
            for patient_id in {row["patient_id"] for row in mine if row["patient_id"]} - self._new_patients:
                update_session_counts(self._server, patient_id)

    def _existing_values(self, column: Column[Any], values: Sequence[Any]) -> set[Any]:
        return set(self._server.scalars(select(column).where(column.in_(values))))

    def _apply(self, change: Sequence[RowChange]) -> None:
        for number in range(1, MAX_NAMESAKES):
            sent = [_with_number(row, number) for row in change]
            try:
                with self._server.begin_nested():
                    apply_changes(self._server, sent)
            except PseudonymTaken:
                continue
            except (CarpusFault, DBAPIError, KeyError):
                break
            named = [row for row, one in zip(change, sent, strict=True) if row != one]
            self.faults += [PseudonymNumbered(row.values["pseudonym"], f"{number}") for row in named]
            return
        self.faults.append(ConcurrentChange(change[0].table if change else ""))


def _with_number(row: RowChange, number: int) -> RowChange:
    """Put a number behind the pseudonym of a new patient, from the second on."""
    if number == 1 or row.action != "new" or row.table != PATIENT.name:
        return row
    named = {name: f"{row.values[name]} ({number})" for name in ("pseudonym", "pseudonym_key")}
    return replace(row, values={**row.values, **named})

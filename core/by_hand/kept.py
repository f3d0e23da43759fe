"""Where values by hand are kept: in the register of patients, only ever added to, so that what was stays readable."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable
from datetime import UTC, date, datetime

from carpus.core.by_hand.values import HandValue

MIGRATION = """
    CREATE TABLE by_hand (number INTEGER PRIMARY KEY AUTOINCREMENT, patient_id TEXT NOT NULL, measure TEXT NOT NULL,
                          way TEXT NOT NULL, side TEXT NOT NULL, day TEXT NOT NULL, tries TEXT NOT NULL,
                          place TEXT NOT NULL, initials TEXT NOT NULL, entered TEXT NOT NULL);
    CREATE INDEX by_hand_of_patient ON by_hand (patient_id, number);
"""
COLUMNS = "number, patient_id, measure, way, side, day, tries, place, initials, entered"


def enter(database: sqlite3.Connection, patient_id: str, values: Iterable[HandValue]) -> None:
    """Add entries, each with its own time or now."""
    now = datetime.now(UTC)
    rows = [
        (
            patient_id, one.measure, one.way, one.side, one.day.isoformat(), json.dumps(list(one.tries)), one.where,
            one.by, (one.entered or now).astimezone(UTC).isoformat(timespec="seconds"),
        )
        for one in values
    ]  # fmt: skip
    database.executemany(
        f"INSERT INTO by_hand ({COLUMNS.removeprefix('number, ')}) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", rows
    )


def entries_of(database: sqlite3.Connection, patient_id: str) -> list[HandValue]:
    """Everything that was ever entered of a patient, in order; rows that this program would not have written are left
    out, as those of a measure that it does not know."""
    found = []
    for row in database.execute("SELECT * FROM by_hand WHERE patient_id = ? ORDER BY number", (patient_id,)):
        try:
            tries = tuple(float(one) for one in json.loads(row["tries"]))
            value = HandValue(
                row["measure"], row["way"], row["side"], date.fromisoformat(row["day"]), tries, row["place"],
                row["initials"], datetime.fromisoformat(row["entered"]),
            )  # fmt: skip
        except (KeyError, ValueError, TypeError, RecursionError):
            continue
        found.append(value)
    return found


def forget(database: sqlite3.Connection, patient_id: str) -> None:
    """Of a patient who is erased."""
    if database.execute("SELECT 1 FROM sqlite_master WHERE name = 'by_hand'").fetchone():  # an older list has none
        database.execute("DELETE FROM by_hand WHERE patient_id = ?", (patient_id,))

"""To whom letters were written: kept in the register of patients like names, and nowhere else."""

from __future__ import annotations

import sqlite3
import time

MIGRATION = "CREATE TABLE recipient (address TEXT PRIMARY KEY, used_s REAL NOT NULL);"
COLUMNS = "address, used_s"
MOST = 50


def remember(database: sqlite3.Connection, address: str) -> None:
    """Take down an address; the oldest go when there are very many."""
    database.execute(f"INSERT OR REPLACE INTO recipient ({COLUMNS}) VALUES (?, ?)", (address, time.time()))
    newest = f"SELECT address FROM recipient ORDER BY used_s DESC LIMIT {MOST}"
    database.execute(f"DELETE FROM recipient WHERE address NOT IN ({newest})")


def known(database: sqlite3.Connection) -> list[str]:
    """All addresses, the last used first."""
    rows = database.execute("SELECT address FROM recipient ORDER BY used_s DESC")
    return [row["address"] for row in rows if isinstance(row["address"], str)]

"""What is in no list: patients and recordings in the archive, and files of an erasure that has not ended.

Kept in the register. What is archived can be brought back. What is being erased is written down before the first file
goes, so that an erasure that was cut short is finished when the register is opened next, and never half undone.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable
from datetime import datetime
from pathlib import Path

from carpus.core.encryption.content import PLACING

MIGRATION = """
    CREATE TABLE archived (identity TEXT PRIMARY KEY, since TEXT NOT NULL);
    CREATE TABLE erasing (path TEXT PRIMARY KEY);
"""
"""``identity`` of a patient or of a recording; ``path`` absolute, or relative to the folder of the sessions."""


def archive(database: sqlite3.Connection, identity: str, now: datetime) -> None:
    """Out of every list and count, until it is brought back."""
    database.execute("INSERT OR IGNORE INTO archived VALUES (?, ?)", (identity, now.isoformat(timespec="seconds")))


def bring_back(database: sqlite3.Connection, identities: Iterable[str]) -> None:
    """Into the lists again, or forgotten with what was erased."""
    database.executemany("DELETE FROM archived WHERE identity = ?", [(one,) for one in identities])


def begin_erasing(database: sqlite3.Connection, paths: Iterable[str]) -> None:
    """Files that must go, whatever happens to this program."""
    database.executemany("INSERT OR IGNORE INTO erasing VALUES (?)", [(path,) for path in paths])


def being_erased(database: sqlite3.Connection) -> set[str]:
    """Paths that are still written down."""
    return {str(path) for (path,) in database.execute("SELECT path FROM erasing")}


def go_on_erasing(database: sqlite3.Connection, folder: Path) -> tuple[int, list[Path]]:
    """Delete what is written down and still there; how many files are gone now, and those that could not be deleted."""
    gone: list[str] = []
    left: list[Path] = []
    for stored in sorted(being_erased(database)):
        path = folder / stored
        try:
            with PLACING:
                path.unlink(missing_ok=True)
        except OSError:
            left.append(path)
        else:
            gone.append(stored)
    database.executemany("DELETE FROM erasing WHERE path = ?", [(path,) for path in gone])
    return len(gone), left

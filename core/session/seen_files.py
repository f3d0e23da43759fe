"""Which session files of a folder were looked at: a file is read again only when its size or its time has changed.

Kept in the register. A file that cannot be a session is set apart: it stays where it is, is named once, and is not
opened again while it is the same. A copy of a session that is there already is set apart too, so that it counts once.
"""

from __future__ import annotations

import sqlite3
import stat
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

MIGRATION = """
    CREATE TABLE seen (
        path TEXT PRIMARY KEY,
        size INTEGER NOT NULL,
        changed_ns INTEGER NOT NULL,
        reason TEXT NOT NULL
    );
    INSERT INTO seen SELECT path, -1, -1, '' FROM session;
"""
"""``reason`` is empty for a session taken in. A size of -1 is that of a register from before: taken as unchanged."""

COPY = "a copy of "


@dataclass(frozen=True, slots=True)
class Seen:
    """A file as it was when it was looked at."""

    size: int
    changed_ns: int
    reason: str = ""

    def is_still(self, now: Seen) -> bool:
        """Whether a file that looks like ``now`` need not be read again."""
        return self.size == -1 or (self.size, self.changed_ns) == (now.size, now.changed_ns)


def files_there(folder: Path) -> dict[Path, Seen]:
    """Every file of a folder that is named like a session, as it looks now."""
    found: dict[Path, Seen] = {}
    for path in sorted(folder.rglob("*.h5")):
        try:
            state = path.lstat()
        except OSError:
            continue  # gone meanwhile
        found[path] = Seen(state.st_size, state.st_mtime_ns, "" if stat.S_ISREG(state.st_mode) else "not a plain file")
    return found


def stored(database: sqlite3.Connection) -> dict[str, Seen]:
    """What was looked at before, by path."""
    return {
        str(path): Seen(*rest) for path, *rest in database.execute("SELECT path, size, changed_ns, reason FROM seen")
    }


def store(database: sqlite3.Connection, seen: Mapping[str, Seen]) -> None:
    """Remember how files looked."""
    rows = [(path, one.size, one.changed_ns, one.reason) for path, one in seen.items()]
    database.executemany("INSERT OR REPLACE INTO seen VALUES (?, ?, ?, ?)", rows)


def forget(database: sqlite3.Connection, paths: Iterable[str]) -> None:
    """Files that are there no more."""
    database.executemany("DELETE FROM seen WHERE path = ?", [(path,) for path in paths])


def can_be_stored(path: str) -> bool:
    """Whether the register can hold a file's name; some systems have names that are no text."""
    try:
        path.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return "\0" not in path

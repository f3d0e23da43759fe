"""Which files outside the data folder Carpus made from a patient's sessions: reports, exports, tables, pictures.

Kept in the register, so that they can be named, and deleted, when the session is erased. A file is known again by its
content: what a person changed since, or put in its place, is left alone.
"""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

MIGRATION = """
    CREATE TABLE made (path TEXT NOT NULL, session_id TEXT NOT NULL, kind TEXT NOT NULL, content TEXT NOT NULL,
                       PRIMARY KEY (path, session_id));
"""
COLUMNS = "path, session_id, kind, content"

MadeKind = Literal["report", "export"]
State = Literal["as_made", "changed", "not_found"]


@dataclass(frozen=True, slots=True)
class MadeFile:
    """A file as it was made, and what has become of it."""

    path: Path
    kind: MadeKind
    state: State
    size_bytes: int


def remember(database: sqlite3.Connection, paths: Iterable[Path], kind: MadeKind, session_ids: Iterable[str]) -> None:
    """Take down files that were just made from these sessions; one that cannot be read is not there to be erased."""
    sessions = list(session_ids)
    for path in paths:
        content = content_of(path)
        if content:
            rows = [(str(path.absolute()), session, kind, content) for session in sessions]
            database.executemany("INSERT OR REPLACE INTO made VALUES (?, ?, ?, ?)", rows)


def made_from(database: sqlite3.Connection, session_ids: Iterable[str]) -> list[MadeFile]:
    """What was made from any of these sessions, alone or with others."""
    found: dict[str, MadeFile] = {}
    for session in session_ids:
        rows = database.execute("SELECT path, kind, content FROM made WHERE session_id = ?", (session,)).fetchall()
        for stored, kind, content in rows:
            path = Path(stored)
            now = content_of(path)
            state: State = "not_found" if not now else "as_made" if now == content else "changed"
            size = path.stat().st_size if now else 0
            found[stored] = MadeFile(path, "report" if kind == "report" else "export", state, size)
    return [found[path] for path in sorted(found)]


def forget(database: sqlite3.Connection, paths: Iterable[Path]) -> None:
    """Files that are gone, or are nobody's business any more."""
    database.executemany("DELETE FROM made WHERE path = ?", [(str(path),) for path in paths])


def content_of(path: Path) -> str:
    """SHA-256 of a plain file; empty where there is none that can be read."""
    try:
        if path.is_symlink() or not path.is_file():
            return ""
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""

"""Which session files of a folder were looked at: a file is read again only when its size or its time has changed.

A file that cannot be a session is set apart: it stays where it is, is named once, and is not opened again while it is
the same. A copy of a session that is there already is set apart too, so that it counts once.
"""

from __future__ import annotations

import stat
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import Insert, select
from sqlalchemy.dialects.sqlite import insert

from carpus.core.records.schema import SEEN
from carpus.core.records.store import Store

COPY = "a copy of "


@dataclass(frozen=True, slots=True)
class Seen:
    """A file as it was when it was looked at; ``reason`` why it is no session."""

    size: int
    changed_ns: int
    reason: str = ""

    def is_still(self, now: Seen) -> bool:
        """Whether a file that looks like ``now`` need not be read again."""
        return (self.size, self.changed_ns) == (now.size, now.changed_ns)


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


def remembered(store: Store) -> dict[str, Seen]:
    """What was looked at before, by path."""
    return {str(row.path): Seen(row.size, row.changed_ns, row.reason) for row in store.rows(select(SEEN))}


def stored(seen: Mapping[str, Seen]) -> Sequence[Insert]:
    """What :meth:`Store.own` does to remember how files looked."""
    out = []
    for path, one in seen.items():
        values = {"size": one.size, "changed_ns": one.changed_ns, "reason": one.reason}
        made = insert(SEEN).values(path=path, **values)
        out.append(made.on_conflict_do_update(index_elements=["path"], set_=values))
    return out


def can_be_stored(path: str) -> bool:
    """Whether the store can hold a file's name; some systems have names that are no text."""
    try:
        path.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return "\0" not in path

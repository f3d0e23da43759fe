"""What people write about a session: comments in all versions, what they left out or moved, what was made of it."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal

from sqlalchemy import Row, select

from carpus.core.records.changes import RowChange, changed, new
from carpus.core.records.schema import COMMENT, CORRECTION, MADE
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import moment
from carpus.core.results.repetition_rows import RepetitionChoices

MOST_CHARACTERS = 20_000
MadeKind = Literal["report", "export"]


@dataclass(frozen=True, slots=True)
class Comment:
    """What was written, by whose initials, and when; an empty text took the one before away."""

    text: str
    by: str
    entered: datetime


def comments(store: Store, session_id: str) -> tuple[Comment, ...]:
    """All of a session, oldest first; the last one holds."""
    query = select(COMMENT).where(COMMENT.c.session_id == session_id).order_by(COMMENT.c.entered_ns, COMMENT.c.id)
    return tuple(Comment(row.text, row.by, moment(row.entered, row.entered_ns / 1e9)) for row in store.rows(query))


def latest(written: Sequence[Comment]) -> str:
    """The comment that holds; empty where there is none."""
    return written[-1].text if written else ""


def add_comment(store: Store, session_id: str, text: str, by: str) -> None:
    """Add one, which holds from now on; what was written before stays readable."""
    entered = datetime.now(UTC).isoformat(timespec="seconds")
    row = {"session_id": session_id, "text": text, "by": by, "entered": entered, "entered_ns": time.time_ns()}
    store.do([new(COMMENT, new_id(), **row)])


def choices(store: Store, session_id: str) -> tuple[RepetitionChoices, int]:
    """What a person left out or moved, and its version; nothing and 0 where nothing is."""
    row = store.row(select(CORRECTION).where(CORRECTION.c.session_id == session_id))
    if row is None:
        return RepetitionChoices(), 0
    return next(iter(store.sound([row], _choices)), RepetitionChoices()), row.version


def _choices(row: Row[Any]) -> RepetitionChoices:
    left_out = {int(number): str(reason) for number, reason in json.loads(row.left_out).items()}
    edges_s = {int(number): (float(start), float(end)) for number, (start, end) in json.loads(row.edges_s).items()}
    return RepetitionChoices(left_out, edges_s, bool(row.not_counted), row.reason)


def keep_choices(store: Store, session_id: str, kept: RepetitionChoices, version: int) -> int:
    """Store them in place of the ``version`` that they were made from (0 for none); the version that they have now.

    Raises :class:`ChangedMeanwhile` where somebody else was quicker.
    """
    store.do([change_of(session_id, kept, version)])
    return version + 1


def change_of(session_id: str, kept: RepetitionChoices, version: int = 0) -> RowChange:
    """The change that stores them."""
    values = {
        "left_out": json.dumps(kept.left_out, ensure_ascii=False), "edges_s": json.dumps(kept.edges_s),
        "not_counted": int(kept.not_counted), "reason": kept.not_counted_reason,
    }  # fmt: skip
    if not version:
        return new(CORRECTION, session_id, session_id=session_id, **values)
    return changed(CORRECTION, session_id, version, **values)


def remember_made(store: Store, paths: Iterable[Path], kind: MadeKind, session_ids: Sequence[str]) -> None:
    """Take down files that were just made from these sessions, so that they can be named when one is erased."""
    store.do(
        [
            new(MADE, new_id(), session_id=session_id, path=str(path.absolute()), kind=kind)
            for path in paths
            for session_id in session_ids
        ]
    )


def made_from(store: Store, session_ids: Iterable[str]) -> list[Path]:
    """What was made from any of these sessions, alone or with others, and is still there."""
    rows = store.rows(select(MADE.c.path).where(MADE.c.session_id.in_(list(session_ids))).distinct())
    return [Path(path) for path in sorted(row.path for row in rows) if os.path.isfile(path)]  # noqa: PTH113  # also where nobody may look

"""Records of a session: comments in all versions, a person's choices, and files made from it."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal

from sqlalchemy import Row, select

from carpus.core.records.changes import RowChange, insert_row, update_row
from carpus.core.records.schema import COMMENT, CORRECTION, OUTPUT_FILE
from carpus.core.records.store import Store, new_id
from carpus.core.results.repetition_rows import RepetitionChoices

MAX_COMMENT_CHARACTERS = 20_000
OutputKind = Literal["report", "export"]


def read_comments(store: Store, session_id: str) -> list[str]:
    """Return all comments of a session, oldest first; an empty one deletes the one before."""
    query = select(COMMENT.c.text).where(COMMENT.c.session_id == session_id)
    return [str(row.text) for row in store.rows(query.order_by(COMMENT.c.entered_ns, COMMENT.c.id))]


def read_current_comment(store: Store, session_id: str) -> str:
    """Return the current comment, empty for none."""
    return next(reversed(read_comments(store, session_id)), "")


def add_comment(store: Store, session_id: str, text: str, initials: str) -> None:
    """Add a comment as the current one; earlier ones stay readable."""
    entered = datetime.now(UTC).isoformat(timespec="seconds")
    row = {"session_id": session_id, "text": text, "by": initials, "entered": entered, "entered_ns": time.time_ns()}
    store.apply([insert_row(COMMENT, new_id(), **row)])


def read_choices(store: Store, session_id: str) -> tuple[RepetitionChoices, int]:
    """Return a person's choices and their version; 0 where nothing was chosen."""
    row = store.row(select(CORRECTION).where(CORRECTION.c.session_id == session_id))
    if row is None:
        return RepetitionChoices(), 0
    return next(iter(store.valid_rows([row], _choices_from_row)), RepetitionChoices()), row.version


def _choices_from_row(row: Row[Any]) -> RepetitionChoices:
    left_out = {int(number): str(reason) for number, reason in json.loads(row.left_out).items()}
    edges_s = {int(number): (float(start), float(end)) for number, (start, end) in json.loads(row.edges_s).items()}
    return RepetitionChoices(left_out, edges_s, bool(row.not_counted), row.reason)


def save_choices(store: Store, session_id: str, choices: RepetitionChoices, version: int) -> int:
    """Store choices made from a ``version`` (0 for none); return the new version.

    Raises :class:`ConcurrentChange`.
    """
    store.apply([choices_change(session_id, choices, version)])
    return version + 1


def choices_change(session_id: str, choices: RepetitionChoices, version: int = 0) -> RowChange:
    """Return the change that stores choices."""
    values = {
        "left_out": json.dumps(choices.excluded, ensure_ascii=False), "edges_s": json.dumps(choices.edges_s),
        "not_counted": int(choices.is_session_excluded), "reason": choices.session_exclusion_reason,
    }  # fmt: skip
    if not version:
        return insert_row(CORRECTION, session_id, session_id=session_id, **values)
    return update_row(CORRECTION, session_id, version, **values)


def record_output_files(store: Store, paths: Iterable[Path], kind: OutputKind, session_ids: Sequence[str]) -> None:
    """Record files made from sessions, so that they can be named when one is erased."""
    store.apply(
        [
            insert_row(OUTPUT_FILE, new_id(), session_id=session_id, path=str(path.absolute()), kind=kind)
            for path in paths
            for session_id in session_ids
        ]
    )


def find_output_files(store: Store, session_ids: Iterable[str]) -> list[Path]:
    """Return existing files that were made from any of these sessions."""
    rows = store.rows(select(OUTPUT_FILE.c.path).where(OUTPUT_FILE.c.session_id.in_(list(session_ids))).distinct())
    return [Path(path) for path in sorted(row.path for row in rows) if os.path.isfile(path)]  # noqa: PTH113  # also where nobody may look

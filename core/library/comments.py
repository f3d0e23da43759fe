"""The therapist's comment on a session: kept beside it, only ever added to, so that what was written stays readable."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from carpus.core.encryption.content import read_kept
from carpus.core.errors import ContentDamaged, SessionUnreadable
from carpus.core.library.beside import COMMENTS_SUFFIX
from carpus.core.phrase import phrase

MOST_CHARACTERS = 20_000


@dataclass(frozen=True, slots=True)
class Comment:
    """What was written, by whose initials, and when; an empty text took the one before away."""

    text: str
    by: str
    entered: datetime


def read_comments(session_path: Path) -> tuple[Comment, ...]:
    """All of a session, oldest first; the last one holds. Raises :class:`SessionUnreadable`."""
    path = session_path.with_suffix(COMMENTS_SUFFIX)
    try:
        stored = json.loads(read_kept(path).decode("utf-8"))
        return tuple(
            Comment(str(one["text"]), str(one["by"]), datetime.fromisoformat(one["entered"]))
            for one in stored["comments"]
        )
    except FileNotFoundError:
        return ()
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, ContentDamaged) as cause:
        raise SessionUnreadable(path, phrase("the comment cannot be read")) from cause


def latest(comments: Sequence[Comment]) -> str:
    """The comment that holds; empty where there is none."""
    return comments[-1].text if comments else ""


def stored_form(comments: Sequence[Comment]) -> dict[str, list[dict[str, str]]]:
    """As it is written to the file."""
    return {
        "comments": [{"text": one.text, "by": one.by, "entered": one.entered.isoformat()} for one in comments],
    }

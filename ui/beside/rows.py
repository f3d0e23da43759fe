"""One row of the table of two sessions, in words."""

from __future__ import annotations

from dataclasses import dataclass

from carpus.ui.icons import State


@dataclass(frozen=True, slots=True)
class BesideRow:
    """Movement, both figures, their difference, the error it must exceed, and what may be said; ``strong`` where the
    difference is beyond error."""

    movement: str
    first: str
    second: str
    difference: str
    error: str
    words: str
    verdict: str
    token: str = ""
    state: State = "none"
    strong: bool = False

"""What a session that was tracked again says of that: from when on, which markers, by whom."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime

from carpus.core.session.marker_doubts import Correction
from carpus.core.session.values import Session

CORRECTED = "corrected"
"""The event of a corrected session: when, which markers, and who."""


@dataclass(frozen=True, slots=True)
class CorrectedFrom:
    """``when`` the session was tracked again, ``from_s`` seconds after its first frame the first picture that was put
    right, ``markers`` their names, ``by`` the initials of who did, empty for unknown."""

    when: datetime
    from_s: float
    markers: tuple[str, ...]
    by: str = ""


def said_of(correction: Correction, by: str) -> str:
    """The text of the event."""
    places = {
        name: None if place is None else [round(place[0], 1), round(place[1], 1)]
        for name, place in correction.places.items()
    }
    return json.dumps({"markers": places} | ({"by": by} if by else {}), sort_keys=True)


def corrections_in(session: Session) -> tuple[tuple[Correction, str], ...]:
    """All that was put right in a session, each with the initials of who did; a text that cannot be read says only
    when."""
    out = []
    for event in session.events:
        if event.kind != CORRECTED or not len(session):
            continue
        places: dict[str, tuple[float, float] | None] = {}
        by = ""
        with suppress(ValueError, TypeError, AttributeError, IndexError):
            told = json.loads(event.text)
            by = str(told.get("by", ""))
            places = {
                str(name): None if place is None else (float(place[0]), float(place[1]))
                for name, place in told.get("markers", {}).items()
            }
        row = int(abs(session.timestamp_s - event.time_s).argmin())
        out.append((Correction(row, places), by))
    return tuple(sorted(out, key=lambda one: one[0].row))


def corrected_from(session: Session) -> CorrectedFrom | None:
    """Since when a session stands corrected; None for one as measured."""
    said = corrections_in(session)
    if not said:
        return None
    names = dict.fromkeys(name for correction, _ in said for name in correction.places)
    people = dict.fromkeys(by for _, by in said if by)
    start_s = float(session.timestamp_s[0])
    return CorrectedFrom(
        datetime.fromisoformat(session.header.created),
        float(session.timestamp_s[said[0][0].row]) - start_s,
        tuple(names),
        ", ".join(people),
    )

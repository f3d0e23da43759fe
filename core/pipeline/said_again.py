"""What a person said while measuring, kept for whoever goes through the session anew."""

from __future__ import annotations

from carpus.core.session.values import Event, Session
from carpus.core.types import SPOT_SAID, SpotAnswer

NOT_LOOKED_BACK = "not_looked_back"
"""The event of a session that is stored as tracked, though looking back was asked for."""


def notes_in(session: Session) -> list[Event]:
    """Its events, but for what only that tracking of it met."""
    return [event for event in session.events if event.kind != NOT_LOOKED_BACK]


def answers_in(session: Session) -> dict[int, list[SpotAnswer]]:
    """What was said of blue spots, by the row of the picture that took it up."""
    out: dict[int, list[SpotAnswer]] = {}
    for event in session.events:
        if event.kind == SPOT_SAID and len(session):
            row = int(abs(session.timestamp_s - event.time_s).argmin())
            answer = SpotAnswer.of_text(event.text, row)
            if answer is not None:
                out.setdefault(row, []).append(answer)
    return out

"""A list of sessions without files; apart from the other fakes, which load no widgets."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

from carpus.core.records.values import SessionEntry
from carpus.ui.screens.sessions.session_list import SessionLine, SessionStore
from tests.ui.fakes import entered


class FakeStoredSessions(SessionStore):
    """A list of sessions that nobody measured."""

    def __init__(self, count: int = 6) -> None:
        start = datetime(2026, 11, 20, 11, 30)
        self.all = [
            SessionLine(SessionEntry(name, Path("s.h5"), when, when, name, "WRIST_FE", "right", 2520, 84.0))
            for number in range(count)
            for name, when in [(f"s{number}", start - timedelta(days=3 * number))]
        ]

    def list_sessions(self, patient_id: str) -> list[SessionLine]:
        return list(self.all)

    def with_figures(self, line: SessionLine) -> SessionLine:
        number = int(line.entry.session_id[1:])
        if number == 4:
            return replace(line, is_damaged=True)
        words = entered("mean of 9 repetitions; repetition 7 excluded: pain")
        return replace(
            line,
            main_value=f"{entered('Flexion')} {57 - 3 * number}° ± 2°",
            counted_repetitions="9 / 10",
            counted_words=words,
        )

    def count_archived(self, patient_id: str) -> int:
        return 0

    def exclude(self, session_id: str, reason: str) -> None:
        self.all = [
            replace(one, exclusion_reason=reason) if one.entry.session_id == session_id else one for one in self.all
        ]

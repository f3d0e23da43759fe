"""A list of sessions without files; apart from the other fakes, which load no widgets."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

from carpus.core.records.values import SessionEntry
from carpus.ui.screens.sessions.session_list import SessionLine
from carpus.ui.screens.sessions.session_store import SessionStore
from tests.ui.fakes import entered


class FakeStoredSessions(SessionStore):
    """A list of sessions that remembers what was done with it."""

    def __init__(self, count: int = 6) -> None:
        start = datetime(2026, 11, 20, 11, 30)
        self.all = [
            SessionLine(SessionEntry(name, Path("s.h5"), when, when, name, "WRIST_FE", "right", 2520, 84.0))
            for number in range(count)
            for name, when in [(f"s{number}", start - timedelta(days=3 * number))]
        ]
        self.done: list[tuple[str, ...]] = []

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

    def target_patients(self, patient_id: str) -> list[tuple[str, str]]:
        return [("heron", "Heron 17"), ("alder", "Alder 51")]

    def count_archived(self, patient_id: str) -> int:
        return 0

    def _change(self, session_id: str, **values: object) -> None:
        self.all = [replace(one, **values) if one.entry.session_id == session_id else one for one in self.all]  # type: ignore[arg-type]

    def exclude(self, session_id: str, reason: str) -> None:
        self.done.append(("aside", session_id, reason))
        self._change(session_id, exclusion_reason=reason)

    def move(self, session_id: str, patient_id: str) -> None:
        self.done.append(("move", session_id, patient_id))
        self.all = [one for one in self.all if one.entry.session_id != session_id]

    def rename_exercise(self, session_id: str, exercise: str) -> None:
        self.done.append(("rename", session_id, exercise))
        self.all = [
            replace(one, entry=replace(one.entry, exercise=exercise)) if one.entry.session_id == session_id else one
            for one in self.all
        ]

"""The same figures as of another day, or with other measures."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from datetime import timedelta
from typing import Any

from carpus.core.measures.repetitions import Repetition
from carpus.core.results.measure import Measure
from carpus.core.results.repetition_rows import RepetitionResult
from carpus.core.results.session_results import SessionResults
from carpus.core.session.values import RepetitionRow
from tests.ui.fakes import NOW


def days_ago(one: SessionResults, days: int, **changes: Any) -> SessionResults:
    """A session and recording of its own, called by its day, with other changes."""
    own = {"when": NOW - timedelta(days=days), "session_id": str(days), "recording_id": str(days)}
    return replace(one, **own | changes)


def with_ranges(one: SessionResults, change: Callable[[Measure], dict[str, Any]]) -> SessionResults:
    """Change every range by new values of its fields."""
    rows = (replace(row, **change(row)) if row.group == "range" else row for row in one.measures)
    return replace(one, measures=tuple(rows))


def repetition(start_s: float, end_s: float) -> RepetitionResult:
    """A counted repetition of which nothing but its time is known."""
    unknown = (math.nan,) * 10
    row = RepetitionRow(start_s, math.nan, end_s, *unknown, False, True, "")
    return RepetitionResult(start_s, end_s, Repetition(start_s, end_s, 1.0), row)

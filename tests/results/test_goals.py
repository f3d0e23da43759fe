"""Goals: proposed from the last sessions that compare, a small step, never above what measurement error can tell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import timedelta
from functools import cache

import pytest

from carpus.core.measures.change_limits import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.results.progress import propose_goals
from carpus.core.results.session_results import SessionResults
from tests.results.days import with_ranges
from tests.ui.fakes import NOW, figures_once, session

FLEXION = get_exercise("WRIST_FE")


@cache
def base() -> SessionResults:
    return figures_once(session(seconds=26.0))


def of_day(day: int, mean_deg: float, **changes: object) -> SessionResults:
    """The same session on another day, with another mean of flexion."""
    shown = with_ranges(base(), lambda row: {"mean": mean_deg} if row.quantity == "flexion" else {})
    return replace(shown, when=NOW + timedelta(days=day), **changes)  # type: ignore[arg-type]


def flexion(history: Sequence[SessionResults]) -> tuple[float, float, int, float]:
    found = next(one for one in propose_goals(history, FLEXION, "right", "wrist6") if one.direction == 1)
    return found.goal_deg, found.detectable_from_deg, found.sessions, found.basis_deg


def test_propose_goals_step_above_mean_of_last_three() -> None:
    history = [of_day(0, 20.0), of_day(7, 40.0), of_day(9, 44.4), of_day(14, 42.0)]
    assert flexion(history) == (47.0, 53.0, 3, pytest.approx(42.13, abs=0.01))
    assert flexion([*history, of_day(20, 80.0, is_excluded=True)]) == flexion(history)
    assert flexion([*history, of_day(20, 80.0, side="left")]) == flexion(history)
    assert flexion([of_day(0, 88.0)])[0] == 90.0
    assert not [one for one in propose_goals([of_day(0, 96.0)], FLEXION, "right", "wrist6") if one.direction == 1]
    assert propose_goals([], FLEXION, "right", "wrist6") == ()


def test_propose_goals_never_above_own_error_limit() -> None:
    limit = MeasuredLimit("flexion", "flexion", 12, 0.7, (0.5, 1.0), 2.0, (1.5, 3.0))
    study = RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-01", 12, 24, 2, (limit,))
    goal, told_from, _, basis = flexion([of_day(0, 40.0, error_limits=ErrorLimits((study,)))])
    assert (goal, told_from, basis) == (42.0, 42.0, 40.0)


def test_propose_goals_lower_bound_proposes_nothing() -> None:
    one = of_day(0, 40.0)
    hidden = with_ranges(one, lambda _: {"is_lower_bound": True})
    assert propose_goals([hidden], FLEXION, "right", "wrist6") == ()

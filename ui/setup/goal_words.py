"""How proposed goals are said: from what, how far, and from where on a gain can be told from measurement error."""

from __future__ import annotations

from collections.abc import Sequence

from carpus.core.hand.exercises import SIDES, Exercise
from carpus.core.results.goals import GoalProposal
from carpus.ui import numbers, terms
from carpus.ui.translate import inside, tr


def proposal_words(exercise: Exercise, proposed: Sequence[GoalProposal]) -> str:
    """``Proposed from the last 3 sessions: flexion 42° (mean 37°; a gain can be told from 47°).``"""
    if not proposed:
        return ""
    parts = [
        tr("{movement} {goal} (mean {mean}; a gain can be told from {told})")
        .format(
            movement=_name(exercise, one),
            goal=numbers.degrees(one.goal_deg),
            mean=numbers.degrees(one.basis_deg),
            told=numbers.degrees(one.told_from_deg),
        )
        .strip()
        for one in proposed
    ]
    sessions = max(one.sessions for one in proposed)
    head = tr("Proposed from the last session:") if sessions == 1 else tr("Proposed from the last {count} sessions:")
    return f"{head.format(count=sessions)} {', '.join(parts)}."


def _name(exercise: Exercise, one: GoalProposal) -> str:
    if exercise.angle is None:
        return ""
    return inside(terms.movement_name(SIDES[exercise.angle][0 if one.direction > 0 else 1]))

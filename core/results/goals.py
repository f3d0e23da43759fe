"""Goals over weeks: what the last sessions speak for, a small step at a time, and from where on a gain can be told.

A goal is proposed, never set: the therapist accepts or changes it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from carpus.core.hand.exercises import SIDES, Exercise
from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.measures.change import change_limit_rad
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import unfair_reasons
from carpus.core.results.ranges import RangeRow
from carpus.core.types import Side

Goals = Mapping[tuple[str, Side], tuple[float, float]]
"""What was accepted: exercise and hand to the targets of the positive and the negative direction, signed, NaN none."""

SESSIONS = 3
"""So many sessions back: enough that one good day is no goal, few enough that the hand is still the same."""
STEP_DEG = 5.0
"""At most so far above their mean: near enough to be reached on the same day."""
MOST_DEG = 90.0


@dataclass(frozen=True, slots=True)
class GoalProposal:
    """For one direction, degrees without sign: the mean of the last ``sessions``, the ``goal_deg`` proposed, whole
    degrees, and ``told_from_deg``, from where on a gain exceeds measurement error; the goal is never above it."""

    direction: int
    basis_deg: float
    sessions: int
    goal_deg: float
    told_from_deg: float


def proposals(
    history: Sequence[SessionFigures], exercise: Exercise, side: Side, protocol: str
) -> tuple[GoalProposal, ...]:
    """For both directions of the wrist, or the one of a joint, as far as sessions speak for any: of this exercise, hand
    and discs, which compare with the newest of them."""
    same = [one for one in history if (one.exercise.id, one.side, one.protocol) == (exercise.id, side, protocol)]
    newest_first = sorted(same, key=lambda one: one.when, reverse=True)
    sound = [one for one in newest_first if not unfair_reasons(one, one)]
    recent = [one for one in sound if not unfair_reasons(sound[0], one)][:SESSIONS]
    found = (_proposal(recent, exercise, direction) for direction in (1, -1))
    return tuple(one for one in found if one is not None)


def row_aimed_at(figures: SessionFigures, exercise: Exercise, direction: int) -> RangeRow | None:
    """The range whose end a target of a direction is, None where there is none."""
    if exercise.angle is not None:
        return figures.row(SIDES[exercise.angle][0 if direction > 0 else 1], exercise.angle)
    return figures.row("flexion", -1, exercise.joint) if exercise.joint and direction > 0 else None


def _proposal(recent: Sequence[SessionFigures], exercise: Exercise, direction: int) -> GoalProposal | None:
    rows = [(one, row_aimed_at(one, exercise, direction)) for one in recent]
    known = [(one, row) for one, row in rows if row is not None and row.count and not row.limited]
    means = [row.mean_deg for _, row in known if math.isfinite(row.mean_deg)]
    if not means:
        return None
    basis = sum(means) / len(means)
    limit = _limit_deg(known[0][0], known[0][1], exercise)
    told_from = math.ceil(basis + limit)
    goal = min(math.floor(basis + min(STEP_DEG, limit)), MOST_DEG)
    if goal < 1.0 or (goal == MOST_DEG and goal < basis):  # no step up is left
        return None
    return GoalProposal(direction, basis, len(means), float(goal), float(told_from))


def _limit_deg(newest: SessionFigures, row: RangeRow, exercise: Exercise) -> float:
    """What a gain must exceed: the clinic's own limit where it has one, else the default."""
    name = row.joint or WRIST_ANGLES[row.angle]
    own = newest.study.limit_deg(name, row.movement) if newest.study is not None else None
    return math.degrees(change_limit_rad(name)) if own is None else own

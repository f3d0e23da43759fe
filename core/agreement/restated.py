"""What limits about to be put into force would change in what is said of patients: today's verdicts, and those then."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime

from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.measures.error_limits import FEWEST_PEOPLE, ErrorLimits, RetestStudy
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Comparison, Verdict, progress
from carpus.core.results.ranges import RowKey


@dataclass(frozen=True, slots=True)
class Restated:
    """One statement of a patient's progress from the ``first`` to the ``last`` session that compare: ``now`` by the
    limits in force, ``then`` the verdict by the new ones."""

    pseudonym: str
    first: datetime
    last: datetime
    now: Comparison
    then: Verdict

    @property
    def is_changed(self) -> bool:
        return self.now.verdict != self.then


def as_if_complete(study: RetestStudy) -> RetestStudy:
    """The study with its figures of today, as if enough people had been measured for all of them."""
    limits = tuple(replace(limit, people=max(limit.people, FEWEST_PEOPLE)) for limit in study.limits)
    return replace(study, limits=limits)


def restated(pseudonym: str, sessions: Sequence[SessionFigures], study: RetestStudy) -> tuple[Restated, ...]:
    """All statements about one patient, either hand, that rest on figures of a study; none of simulated hands.

    ``sessions`` of any kind, in any order, judged by today's limits.
    """
    kind = (study.protocol, study.exercise, study.angle_order)
    alike = [one for one in sessions if (one.protocol, one.exercise.id, one.angle_order) == kind and not one.simulated]
    limits = ErrorLimits((study,))
    out: list[Restated] = []
    for side in ("right", "left"):
        own = [one for one in alike if one.side == side]
        for keys in _keys(own, study):
            today = progress(own, keys=keys)
            then = progress([replace(one, error_limits=limits) for one in own], keys=keys)
            if today.first is None or today.last is None:
                continue
            for now, new in zip(today.comparisons, then.comparisons, strict=True):
                of = now.joint or WRIST_ANGLES[now.angle]
                if now.verdict != "not_judged" and study.limit_deg(of, now.movement) is not None:
                    out.append(Restated(pseudonym, today.first.when, today.last.when, now, new.verdict))
    return tuple(out)


def _keys(own: Sequence[SessionFigures], study: RetestStudy) -> tuple[tuple[RowKey, ...], ...]:
    """What is followed: the wrist, then the joints of these sessions that the study has limits of."""
    there = (row for one in own for row in one.joint_rows if study.limit_deg(row.joint, row.movement) is not None)
    joints = tuple(dict.fromkeys(row.key for row in there))
    return ((), joints) if joints else ((),)


def changed_first(statements: Sequence[Restated]) -> tuple[Restated, ...]:
    """Those that change before those that stay, each by name and day."""
    return tuple(sorted(statements, key=lambda one: (not one.is_changed, one.pseudonym.casefold(), one.first)))

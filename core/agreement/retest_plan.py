"""A study of test and retest on its way: who was measured when, who is due, what is found so far, and what its limits,
put into force, would change in what is said of patients."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, timedelta
from typing import Literal

from carpus.core.agreement.retest import MOST_DAYS, StudyFigures, studies
from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.measures.change import FEWEST_PEOPLE, ErrorLimits, RetestStudy
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Comparison, Verdict, progress
from carpus.core.results.ranges import RowKey
from carpus.core.types import Side

State = Literal["complete", "due", "too_late", "missing"]
Blocked = Literal["", "few", "simulated", "nothing"]


@dataclass(frozen=True, slots=True)
class Mounting:
    """One session of a person; ``reason`` why it takes no part, empty where it does; ``rater`` initials if known."""

    session_id: str
    when: datetime
    rater: str
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Person:
    """One hand of one person. ``due_by`` until when a second time counts, None unless one is due."""

    patient_id: str
    pseudonym: str
    side: Side | None
    mountings: tuple[Mounting, ...]
    state: State
    due_by: date | None = None

    @property
    def counted(self) -> tuple[Mounting, ...]:
        """Those that take part, in order of time."""
        return tuple(one for one in self.mountings if not one.reason)

    @property
    def days_apart(self) -> int:
        """From the first to the last that takes part."""
        counted = self.counted
        return (counted[-1].when.date() - counted[0].when.date()).days if len(counted) > 1 else 0


@dataclass(frozen=True, slots=True)
class RetestPlan:
    """``study`` what is found so far, None before anybody was measured twice."""

    exercise: str
    people: tuple[Person, ...]
    study: StudyFigures | None

    @property
    def complete(self) -> int:
        """People measured twice."""
        return len({one.patient_id for one in self.people if one.state == "complete"})

    @property
    def next_due(self) -> Person | None:
        """Whose second time ends soonest; else somebody who has not begun, or begins again."""
        due = [one for one in self.people if one.state == "due" and one.due_by is not None]
        if due:
            return min(due, key=lambda one: one.due_by or date.max)
        return next((one for one in self.people if one.state in ("missing", "too_late")), None)

    @property
    def blocked(self) -> Blocked:
        """Why the limits may not be put into force; empty where they may."""
        if self.study is None or not self.study.found:
            return "nothing"
        if self.study.simulated:
            return "simulated"
        return "few" if self.study.people < FEWEST_PEOPLE else ""


def plan_of(
    people: Sequence[tuple[str, str, Sequence[SessionFigures]]],
    exercise: str,
    raters: Mapping[str, str],
    today: date,
) -> RetestPlan:
    """Of (identity, pseudonym, figures of all sessions) each: the study of one exercise as it stands ``today``."""
    own = {
        patient_id: [replace(one, subject_id=patient_id) for one in figures if one.exercise.id == exercise]
        for patient_id, _, figures in people
    }
    found = studies([one for figures in own.values() for one in figures], raters)
    study = max(found, key=lambda one: one.sessions, default=None)
    why = {left.session_id: left.reason for one in found for left in one.left_out}
    rows = [
        _person(patient_id, name, side, [one for one in own[patient_id] if one.side == side], raters, why, today)
        for patient_id, name, _ in people
        for side in sorted({one.side for one in own[patient_id]}) or (None,)
    ]
    return RetestPlan(exercise, tuple(rows), study if study is not None and study.people else None)


def _person(
    patient_id: str,
    pseudonym: str,
    side: Side | None,
    figures: Sequence[SessionFigures],
    raters: Mapping[str, str],
    why: Mapping[str, str],
    today: date,
) -> Person:
    mountings = tuple(
        Mounting(
            one.session_id,
            one.when,
            raters.get(one.session_id, ""),
            "" if why.get(one.session_id) == "once" else why.get(one.session_id, ""),
        )
        for one in sorted(figures, key=lambda one: one.when)
    )
    counted = [one for one in mountings if not one.reason]
    if not counted:
        return Person(patient_id, pseudonym, side, mountings, "missing")
    if len(counted) > 1:
        return Person(patient_id, pseudonym, side, mountings, "complete")
    by = counted[0].when.date() + timedelta(days=MOST_DAYS)
    if today > by:
        return Person(patient_id, pseudonym, side, mountings, "too_late")
    return Person(patient_id, pseudonym, side, mountings, "due", by)


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

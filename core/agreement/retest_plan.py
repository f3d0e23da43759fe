"""A study of test and retest on its way: who was measured when, who is due, and what is found so far."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, timedelta
from typing import Literal

from carpus.core.agreement.retest import MOST_DAYS, StudyFigures, studies
from carpus.core.measures.error_limits import FEWEST_PEOPLE
from carpus.core.results.figures import SessionFigures
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

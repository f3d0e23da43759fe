"""Test and retest: the error of measurement from people who were measured more than once, discs put on anew; and such a
study on its way: who is due, and what its limits, put into force, would change in what is said of patients.

Analysis of variance (McGraw and Wong 1996; Weir 2005). The standard error of measurement is of absolute agreement: what
differs between mountings, days and raters is all in it.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Literal

import numpy as np
import scipy

from carpus.core.agreement.statistics import Interval, icc_2_1, icc_3_1
from carpus.core.formats.new_output import cell, new_table
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.change import FEWEST_PEOPLE, MDC95_FACTOR, ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Comparison, Verdict, newest_results, progress, unfair_reasons
from carpus.core.results.ranges import RowKey
from carpus.core.types import FloatArray, Side

MOST_DAYS = 14.0
"""Two mountings further apart measure the person's change too."""
_UNKNOWN: Interval = (math.nan, math.nan)


@dataclass(frozen=True, slots=True)
class Retest:
    """``readings`` of ``people``, unit of the readings. ``icc`` ICC(2,1), ``icc_3_1`` ICC(3,1); ``sem`` with ``df``
    degrees of freedom; ``sem_same_rater`` of mountings by one rater alone, NaN where fewer than two raters are known
    (it would be ``sem`` again) or none measured twice; ``step`` mean of the last mountings less that of the first.
    Intervals of 95 %."""

    people: int
    readings: int
    icc: float
    icc_interval: Interval
    icc_3_1: float
    icc_3_1_interval: Interval
    sem: float
    sem_interval: Interval
    df: float
    mdc95: float
    mdc95_interval: Interval
    sem_same_rater: float
    step: float


def retest(readings: Sequence[Sequence[float]], raters: Sequence[Sequence[str]] = ()) -> Retest:
    """Of ``readings`` for each person in the order they were taken, and who took them; people with one are left out.

    >>> found = retest([[60.0, 62.0], [71.0, 70.0], [55.0, 58.0], [64.0, 64.0]])
    >>> round(found.sem, 3), round(found.mdc95, 3), round(found.icc, 3)
    (1.323, 3.667, 0.951)
    """
    names = raters or [[""] * len(one) for one in readings]
    kept = [
        [(value, who) for value, who in zip(one, of, strict=True) if math.isfinite(value)]
        for one, of in zip(readings, names, strict=True)
    ]
    kept = [one for one in kept if len(one) > 1]
    values = [np.array([value for value, _ in one]) for one in kept]
    n, total = len(values), sum(map(len, values))
    if n < 2:
        nan = math.nan
        return Retest(n, total, nan, _UNKNOWN, nan, _UNKNOWN, nan, _UNKNOWN, 0.0, nan, _UNKNOWN, nan, nan)
    within = sum(float(((one - one.mean()) ** 2).sum()) for one in values)
    df = float(total - n)
    variance = within / df
    each = min(map(len, values))
    if all(len(one) == each for one in values):
        df = _freedom(np.array(values), df)
    sem = math.sqrt(variance)
    interval = (math.sqrt(df * variance / _chi2(df, 0.975)), math.sqrt(df * variance / _chi2(df, 0.025)))
    table = np.array([one[:each] for one in values])
    mdc = (MDC95_FACTOR * interval[0], MDC95_FACTOR * interval[1])
    step = float(np.mean([one[-1] - one[0] for one in values]))
    return Retest(
        n, total, *icc_2_1(table), *icc_3_1(table), sem, interval, df, MDC95_FACTOR * sem, mdc, _same_rater(kept), step,
    )  # fmt: skip


def _freedom(table: FloatArray, most: float) -> float:
    """Degrees of freedom of the error of (people, mountings): fewer where the mountings differ as such, since then a
    few means make it (Satterthwaite 1946)."""
    n, k = table.shape
    rest = table - table.mean(axis=1, keepdims=True) - table.mean(axis=0, keepdims=True) + table.mean()
    ms_columns = n * float(((table.mean(axis=0) - table.mean()) ** 2).sum()) / (k - 1)
    ms_rest = float((rest**2).sum()) / ((n - 1) * (k - 1))
    a, b = ms_columns / n, ms_rest * (n - 1) / n
    below = a**2 / (k - 1) + b**2 / ((n - 1) * (k - 1))
    return min((a + b) ** 2 / below, most) if below > 0.0 else most


def _chi2(df: float, share: float) -> float:
    """The value that a chi-square of ``df`` stays below with a probability."""
    return float(scipy.special.chdtri(df, 1.0 - share))


def _same_rater(kept: Sequence[Sequence[tuple[float, str]]]) -> float:
    if len({who for one in kept for _, who in one if who}) < 2:
        return math.nan
    squares, df = 0.0, 0
    for one in kept:
        of = defaultdict(list)
        for value, who in one:
            if who:
                of[who].append(value)
        for same in of.values():
            squares += float(((np.array(same) - np.mean(same)) ** 2).sum())
            df += len(same) - 1
    return math.sqrt(squares / df) if df else math.nan


@dataclass(frozen=True, slots=True)
class LeftOut:
    """A session that takes no part, and why."""

    session_id: str
    reason: str


@dataclass(frozen=True, slots=True)
class StudyFigures:
    """A study of one exercise: ``found`` by angle or joint and movement, what the window and the file say of it."""

    protocol: str
    exercise: str
    angle_order: str
    people: int
    sessions: int
    raters: int
    simulated: bool
    found: Mapping[tuple[str, str], Retest]
    left_out: tuple[LeftOut, ...]

    def study(self, made: str) -> RetestStudy:
        """As it is stored, with its date."""
        limits = (
            MeasuredLimit(of, movement, one.people, one.sem, one.sem_interval, one.mdc95, one.mdc95_interval)
            for (of, movement), one in self.found.items()
            if math.isfinite(one.mdc95)
        )
        return RetestStudy(
            self.protocol, self.exercise, self.angle_order, made, self.people, self.sessions, self.raters, tuple(limits)
        )


def studies(sessions: Sequence[SessionFigures], raters: Mapping[str, str] | None = None) -> list[StudyFigures]:
    """One study for each exercise and set of discs. A person is a pseudonym and a hand; ``raters`` by session id."""
    groups: dict[tuple[str, str, str], list[SessionFigures]] = defaultdict(list)
    for figures in newest_results(sessions):
        groups[(figures.protocol, figures.exercise.id, figures.angle_order)].append(figures)
    return [_study(group, raters or {}) for _, group in sorted(groups.items())]


def _study(group: Sequence[SessionFigures], raters: Mapping[str, str]) -> StudyFigures:
    people: dict[tuple[str, str], list[SessionFigures]] = defaultdict(list)
    out: list[LeftOut] = []
    for figures in group:  # in order of time
        mine = people[(figures.subject_id.casefold(), figures.side)]
        reasons = unfair_reasons(mine[0] if mine else figures, figures)
        if not figures.counted:
            reasons = (*reasons, "few_repetitions_after")
        if reasons:
            out.append(LeftOut(figures.session_id, reasons[0]))
        elif mine and (figures.when - mine[0].when).total_seconds() > MOST_DAYS * 86400.0:
            out.append(LeftOut(figures.session_id, "too_late"))
        else:
            mine.append(figures)
    out += [LeftOut(one[0].session_id, "once") for one in people.values() if len(one) == 1]
    measured = [one for one in people.values() if len(one) > 1]
    keys = Counter(key for one in measured for figures in one for key in _readings(figures))
    found = {}
    for key in keys:
        values = [[_readings(figures).get(key, math.nan) for figures in one] for one in measured]
        named = [[raters.get(figures.session_id, "") for figures in one] for one in measured]
        found[key] = retest(values, named)
    first = group[0]
    kept = [figures for one in measured for figures in one]
    return StudyFigures(
        first.protocol, first.exercise.id, first.angle_order, len(measured), len(kept),
        len({raters[one.session_id] for one in kept if one.session_id in raters}),
        any(one.simulated for one in kept), found, tuple(out),
    )  # fmt: skip


def _readings(figures: SessionFigures) -> dict[tuple[str, str], float]:
    """Mean of every movement that was seen whole, degrees, by angle or joint and movement."""
    return {
        (row.joint or WRIST_ANGLES[row.angle], row.movement): row.mean_deg
        for row in (*figures.rows, *figures.joint_rows)
        if row.count and not (row.joint and row.limited)
    }


HEAD = (
    "protocol", "exercise", "of", "movement", "people", "readings", "icc_2_1", "icc_2_1_low", "icc_2_1_high",
    "icc_3_1", "icc_3_1_low", "icc_3_1_high", "sem_deg",
    "sem_low_deg", "sem_high_deg", "mdc95_deg", "mdc95_low_deg", "mdc95_high_deg",
    "sem_same_rater_deg", "last_less_first_deg",
)  # fmt: skip


def write_study(studies: Sequence[StudyFigures], path: Path) -> Path:
    """One line for each figure. Raises :class:`OutputExists` or :class:`OutputNotWritable`."""
    rows = []
    for one in studies:
        for (of, movement), f in one.found.items():
            values = (
                f.icc, *f.icc_interval, f.icc_3_1, *f.icc_3_1_interval, f.sem, *f.sem_interval, f.mdc95,
                *f.mdc95_interval, f.sem_same_rater, f.step,
            )  # fmt: skip
            counts = (str(f.people), str(f.readings))
            rows.append((one.protocol, one.exercise, of, movement, *counts, *map(cell, values)))
    return new_table(path, HEAD, rows)


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

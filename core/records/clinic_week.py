"""What the head of a clinic asks of the store: sessions by day and therapist, and who is due for a re-test.

Counts and dates alone: no measured value is read. A recording counts once, however often it was tracked; what was
archived, simulated or practised does not.
"""

from __future__ import annotations

import math
import statistics
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta
from typing import Any

from sqlalchemy import Row, func, select

from carpus.core.records.changes import PRACTICE
from carpus.core.records.schema import PATIENT, SESSION
from carpus.core.records.store import Store
from carpus.core.records.values import WEEKS, ClinicWeek, Counted, DueTest, moment
from carpus.core.types import Side

FEWEST_WEEKS = 4
"""With fewer weeks before nothing is called usual."""
SOON_DAYS = 7
GONE_DAYS = 182
"""Who was not here for half a year has finished, and is nobody's to remind of."""


@dataclass(frozen=True, slots=True)
class _Seen:
    day: date
    by: str
    patient_id: str
    pseudonym: str
    exercise: str
    hand: Side


def clinic_week(store: Store, day: date, today: date, after_days: int) -> ClinicWeek:
    """The week that has ``day`` in it; a re-test is due ``after_days`` after the last session, as of ``today``."""
    monday = day - timedelta(days=day.weekday())
    since = min(monday - timedelta(weeks=WEEKS - 1), today - timedelta(days=GONE_DAYS))
    seen = _seen(store, since)
    joined = select(SESSION.c.by, func.min(SESSION.c.recorded_s).label("first_s")).group_by(SESSION.c.by)
    names = [row.by for row in sorted(store.rows(joined), key=lambda row: (row.first_s, row.by))]
    of_week = [one for one in seen if monday <= one.day < monday + timedelta(days=7)]
    every = (_counted(name, [one for one in seen if one.by == name], monday) for name in names)
    return ClinicWeek(
        monday,
        _counted("", seen, monday),
        tuple(one for one in every if any(one.weeks)),
        len({one.patient_id for one in of_week}),
        _due(seen, today, after_days),
    )


def _seen(store: Store, since: date) -> list[_Seen]:
    """Every recording since a day that counts, in order of time."""
    # Days are those of the place where it was recorded.
    since_s = datetime.combine(since - timedelta(days=1), time(), UTC).timestamp()
    wanted = (
        SESSION.c.recording_id, SESSION.c.recorded, SESSION.c.recorded_s, SESSION.c.by, SESSION.c.exercise,
        SESSION.c.hand, PATIENT.c.id, PATIENT.c.pseudonym,
    )  # fmt: skip
    query = (
        select(*wanted)
        .join(PATIENT, PATIENT.c.id == SESSION.c.patient_id)
        .where(SESSION.c.archived == "", SESSION.c.erasing == 0, SESSION.c.simulated == 0)
        .where(SESSION.c.recorded_s >= since_s)
        .where(PATIENT.c.id != PRACTICE, PATIENT.c.archived == "", PATIENT.c.erasing == 0)
        .order_by(SESSION.c.recorded_s, SESSION.c.created_s)
    )
    first: dict[str, Row[Any]] = {}
    for row in store.rows(query):
        first.setdefault(row.recording_id, row)
    return [
        _Seen(moment(row.recorded, row.recorded_s).date(), row.by, row.id, row.pseudonym, row.exercise, row.hand)
        for row in first.values()
    ]


def _counted(by: str, seen: Sequence[_Seen], monday: date) -> Counted:
    days = Counter((one.day - monday).days for one in seen)
    weeks = Counter((one.day - monday).days // 7 for one in seen)
    last = tuple(weeks[number] for number in range(1 - WEEKS, 1))
    here = [count for count in last[:-1] if count]  # a week away is no usual week
    usual = float(statistics.median(here)) if len(here) >= FEWEST_WEEKS else math.nan
    return Counted(by, tuple(days[day] for day in range(7)), last, usual)


def _due(seen: Sequence[_Seen], today: date, after_days: int) -> tuple[DueTest, ...]:
    newest = {one.patient_id: one for one in seen}
    due = [
        DueTest(
            one.patient_id, one.pseudonym, one.exercise, one.hand, one.day, one.by,
            (today - one.day).days - after_days,
        )
        for one in newest.values()
        if (today - one.day).days <= GONE_DAYS
    ]  # fmt: skip
    return tuple(sorted((one for one in due if one.overdue_days >= -SOON_DAYS), key=lambda one: -one.overdue_days))

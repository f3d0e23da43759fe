"""The clinic's page against the store: each recording once, nobody's figures, who is due."""

from __future__ import annotations

import math
from datetime import date, datetime, timedelta
from pathlib import Path

from carpus.core.records.of_clinic import SOON_DAYS, clinic_week
from tests.records.samples import HERON, LINDEN, T0, House, measure, opened

AFTER_DAYS = 28
MONDAY = date(2026, 10, 5)


def met(house: House, patient_id: str, when: datetime, by: str) -> str:
    """A session that somebody recorded."""
    session_id = measure(house, patient_id, when)
    entry = house.index.one(session_id)
    house.index.enter(entry.path, patient_id, by)
    return session_id


def test_sessions_are_counted_by_day_and_therapist_as_the_store_has_them(tmp_path: Path) -> None:
    with opened(tmp_path) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        for weeks in range(1, 6):
            met(house, linden, T0 - timedelta(weeks=weeks), "AB")
        met(house, linden, T0, "AB")
        met(house, heron, T0 + timedelta(hours=1), "CD")
        gone = met(house, heron, T0 + timedelta(hours=2), "CD")
        week = clinic_week(house.store, T0.date(), T0.date(), AFTER_DAYS)
        assert week.monday == MONDAY
        assert [(one.by, sum(one.days)) for one in week.therapists] == [("AB", 1), ("CD", 2)]
        assert week.everybody.days[T0.weekday()] == sum(week.everybody.days) == 3
        assert week.everybody.weeks == (0, 0, 1, 1, 1, 1, 1, 3)
        assert week.everybody.usual == 1.0
        assert math.isnan(week.therapists[1].usual), "one week alone is no usual one"
        assert week.patients == 2
        assert sum(week.everybody.weeks) == sum(len(house.index.of_patient(one)) for one in (linden, heron))
        house.index.archive(gone)
        assert sum(clinic_week(house.store, T0.date(), T0.date(), AFTER_DAYS).everybody.days) == 2
        before = clinic_week(house.store, T0.date() - timedelta(days=7), T0.date(), AFTER_DAYS)
        assert sum(before.everybody.days) == 1


def test_who_is_due_stands_longest_first_until_the_next_session(tmp_path: Path) -> None:
    with opened(tmp_path) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        met(house, linden, T0 - timedelta(days=AFTER_DAYS + 9), "AB")
        met(house, heron, T0 - timedelta(days=AFTER_DAYS + 16), "CD")
        today = T0.date()
        due = clinic_week(house.store, today, today, AFTER_DAYS).due
        assert [(one.pseudonym, one.overdue_days, one.by) for one in due] == [
            ("Heron 17", 16, "CD"),
            ("Linden 42", 9, "AB"),
        ]
        met(house, heron, T0 - timedelta(days=AFTER_DAYS - SOON_DAYS), "CD")
        due = clinic_week(house.store, today, today, AFTER_DAYS).due
        assert [(one.pseudonym, one.overdue_days) for one in due] == [("Linden 42", 9), ("Heron 17", -SOON_DAYS)]
        house.patients.archive(linden)
        met(house, heron, T0, "CD")
        assert clinic_week(house.store, today, today, AFTER_DAYS).due == ()
        later = today + timedelta(days=400)
        assert clinic_week(house.store, later, later, AFTER_DAYS).due == (), "who has finished is not reminded of"

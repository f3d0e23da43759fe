"""The clinic's page in words, the same on the screen and on paper."""

from __future__ import annotations

import math
from datetime import date, timedelta
from pathlib import Path

from carpus.core.records.values import WEEKS, ClinicWeek, Counted, DueTest
from carpus.ui import language, numbers, terms
from carpus.ui.fonts import REGULAR, SEMIBOLD
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page
from carpus.ui.report.pdf import write_page
from carpus.ui.report.session_page import paint_head, paint_words
from carpus.ui.translate import inside, tr


def week_words(monday: date) -> str:
    """``Mon 16 Nov to Sun 22 Nov 2026``."""
    sunday = monday + timedelta(days=6)
    last = f"{language.locale().dayName(7, language.locale().FormatType.ShortFormat)} {numbers.day_of_year(sunday)}"
    return tr("{first} to {last}").format(first=numbers.short_date(monday), last=last)


def sessions_words(week: ClinicWeek) -> str:
    """``47 sessions of 29 patients``."""
    count = sum(week.everybody.days)
    if not count:
        return tr("No session this week")
    sessions = tr("1 session") if count == 1 else tr("{count} sessions").format(count=count)
    patients = tr("1 patient") if week.patients == 1 else tr("{count} patients").format(count=week.patients)
    return tr("{sessions} of {patients}").format(sessions=sessions, patients=patients)


def heads_of_days(*, has_usual: bool) -> tuple[str, ...]:
    """Therapist, the days of the week, the week, what is usual, the weeks before."""
    locale = language.locale()
    days = tuple(locale.dayName(day, locale.FormatType.ShortFormat) for day in range(1, 8))
    before = tr("{count} weeks before").format(count=WEEKS - 1)
    return (tr("Therapist"), *days, tr("Week"), *((tr("Usual"),) if has_usual else ()), before)


def session_rows(week: ClinicWeek) -> list[tuple[str, ...]]:
    """All together, then each therapist."""
    has_usual = not math.isnan(week.everybody.usual)
    rows = [_row(tr("All"), week.everybody, has_usual=has_usual)]
    return rows + [_row(one.by or tr("no initials"), one, has_usual=has_usual) for one in week.therapists]


def _row(name: str, one: Counted, *, has_usual: bool) -> tuple[str, ...]:
    usual = (numbers.UNKNOWN if math.isnan(one.usual) else numbers.fixed(one.usual, 0),) if has_usual else ()
    before = "  ".join(_count(count) for count in one.weeks[:-1])
    return (name, *(_count(count) for count in one.days), str(sum(one.days)), *usual, before)


def _count(count: int) -> str:
    return str(count) if count else numbers.UNKNOWN


def heads_of_due() -> tuple[str, ...]:
    """Who, what, when last, with whom, how long ago it was due."""
    return tr("Patient"), tr("What"), tr("Last test"), tr("With"), tr("Overdue")


def due_rows(week: ClinicWeek) -> list[tuple[str, ...]]:
    """Longest overdue first."""
    return [
        (
            one.pseudonym, f"{terms.exercise_name(one.exercise)}, {inside(terms.hand_name(one.hand))}",
            numbers.day_of_year(one.last), one.by or numbers.UNKNOWN, _overdue(one),
        )
        for one in week.due
    ]  # fmt: skip


def _overdue(one: DueTest) -> str:
    days = abs(one.overdue_days)
    if not days:
        return tr("today")
    if one.overdue_days < 0:
        return tr("in 1 day") if days == 1 else tr("in {count} days").format(count=days)
    return tr("1 day overdue") if days == 1 else tr("{count} days overdue").format(count=days)


def write_clinic_page(path: Path, week: ClinicWeek) -> Path:
    """The page as a PDF; faults as of :func:`write_page`."""
    return write_page(path, lambda page: _paint(page, week), tr("Carpus clinic"))


def _paint(page: Page, week: ClinicWeek) -> None:
    said = tr("Counts and dates only, without simulated sessions")
    y = paint_head(page, said, tr("The clinic"), week_words(week.monday)) + 22
    page.text(sessions_words(week), page.left, y, 12.0, SEMIBOLD)
    has_usual = not math.isnan(week.everybody.usual)
    y = paint_words(page, heads_of_days(has_usual=has_usual), session_rows(week), y + 4) + 26
    page.text(tr("Due for a re-test"), page.left, y, 12.0, SEMIBOLD)
    rows = due_rows(week)
    room = max(int((A4_PT[1] - MARGIN_PT - y - 4) / ROW_PT) - 2, 1)  # but for heads and the line below
    if rows:
        y = paint_words(page, heads_of_due(), rows[:room], y + 4)
    else:
        page.text(tr("Nobody is overdue"), page.left, y + 16, 9.0, REGULAR, "text2")
    if (more := len(rows) - room) > 0:
        said = tr("1 more on the screen") if more == 1 else tr("{count} more on the screen").format(count=more)
        page.text(said, page.left, y + 12, 9.0, REGULAR, "text2")


ROW_PT = 14.5
"""Of a table of words."""

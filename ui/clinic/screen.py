"""The clinic's page: sessions by day and therapist, and who is due for a re-test. Counts and dates, no figure."""

from __future__ import annotations

import math
from datetime import date, timedelta
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.core.records.values import WEEKS, ClinicWeek, Counted, DueTest
from carpus.ui import language, numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import STRETCH, fill, in_column, in_line, scrolled
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.controls.words_table import WordsTable
from carpus.ui.keys import Keys, bind
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page
from carpus.ui.report.pdf import write_page
from carpus.ui.report.session_page import paint_head, paint_words
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.translate import inside, tr


class ClinicScreen(QWidget):
    """``week`` asks for the week of another day, ``patient`` carries whom to open."""

    week = Signal(object)
    patient = Signal(str)

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self._theme = theme
        self.shown: ClinicWeek | None = None
        self._asked = date.min
        self.days = Text(theme, "", 16, REGULAR, "text2")
        self.before = Button(theme, self.tr("Week &before"), height_px=44)
        self.after = Button(theme, self.tr("Week &after"), height_px=44)
        self.save = Button(theme, self.tr("&Save page…"), "primary", hint="Ctrl+P", height_px=44)
        self.sessions_title = Text(theme, "", 20, SEMIBOLD)
        self.sessions = WordsTable(theme)
        self.due_title = Text(theme, "", 20, SEMIBOLD)
        self.due = WordsTable(theme)
        self._lay_out()
        self.before.clicked.connect(lambda: self._turn(-7))
        self.after.clicked.connect(lambda: self._turn(7))
        self.due.opened.connect(self.patient)
        bind(self, keys, "report", self.save.click)

    def _lay_out(self) -> None:
        theme = self._theme
        top = in_line(gap=GAP_PX)
        top.addLayout(in_column(heading(theme, self.tr("The clinic")), self.days), 1)
        for button in (self.before, self.after, self.save):
            top.addWidget(button)
        column = in_column(gap=GAP_PX)
        for title, table in ((self.sessions_title, self.sessions), (self.due_title, self.due)):
            card = Card(theme, 20)
            fill(card.body, title, table)
            column.addWidget(card)
        words = self.tr(
            "Counts and dates only, without simulated sessions: no measured value leaves a patient’s own record. "
            "Therapists stand in the order in which they joined and are never ranked."
        )
        fill(column, Text(theme, words, 12, REGULAR, "text2", wrap=True), STRETCH)
        in_column(top, (scrolled(column), 1), gap=GAP_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, 0), within=self)

    def first(self) -> QWidget:
        """What has the keyboard: the first who is due, else the page."""
        return next(iter(self.due.buttons), self.save)

    def show_week(self, week: ClinicWeek) -> None:
        self.shown = week
        self._asked = week.monday
        self.days.setText(week_words(week.monday))
        self.sessions_title.setText(sessions_words(week))
        self.sessions.show_rows(heads_of_days(has_usual=not math.isnan(week.everybody.usual)), session_rows(week))
        overdue = sum(one.overdue_days >= 0 for one in week.due)
        words = self.tr("Due for a re-test: {count}").format(count=overdue) if overdue else self.tr("Nobody is overdue")
        self.due_title.setText(words)
        self.due.setVisible(bool(week.due))
        self.due.show_rows(heads_of_due(), due_rows(week), [one.patient_id for one in week.due])

    def _turn(self, days: int) -> None:
        if self.shown is not None:
            self._asked += timedelta(days=days)  # also while the last one is read
            self.week.emit(self._asked)


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

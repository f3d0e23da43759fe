"""The clinic's page: sessions by day and therapist, and who is due for a re-test. Counts and dates, no figure."""

from __future__ import annotations

import math
from datetime import date, timedelta

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.core.records.values import ClinicWeek
from carpus.ui.clinic.words import due_rows, heads_of_days, heads_of_due, session_rows, sessions_words, week_words
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.column import scrolled
from carpus.ui.controls.layouts import in_column, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.controls.words_table import WordsTable
from carpus.ui.keys import Keys, bind
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme


class ClinicScreen(QWidget):
    """``week`` asks for the week of another day, ``patient`` carries whom to open, ``page`` asks for the page."""

    week = Signal(object)
    patient = Signal(str)
    page = Signal()

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
        self.save.clicked.connect(self.page)
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
            card.body.addWidget(title)
            card.body.addWidget(table)
            column.addWidget(card)
        words = self.tr(
            "Counts and dates only, without simulated sessions: no measured value leaves a patient’s own record. "
            "Therapists stand in the order in which they joined and are never ranked."
        )
        column.addWidget(Text(theme, words, 12, REGULAR, "text2", wrap=True))
        column.addStretch(1)
        in_column(top, (scrolled(column), 1), gap=GAP_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, 0), within=self)

    def first(self) -> QWidget:
        """What has the keyboard: the first who is due, else the page."""
        return next(iter(self.due.buttons), self.save)

    def show_week(self, week: ClinicWeek) -> None:
        """Show a week."""
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

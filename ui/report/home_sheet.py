"""What goes onto the sheet to take home: exercises, how often, when to come again, in which language."""

from __future__ import annotations

from datetime import date, timedelta

from PySide6.QtCore import QDate, Signal
from PySide6.QtWidgets import QDateEdit, QGridLayout, QHBoxLayout, QLineEdit, QSpinBox, QWidget

from carpus.core.output.exercises import Exercise
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Choices, Labelled, number_field
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.controls.tick import Tick
from carpus.ui.language import LANGUAGES, spoken
from carpus.ui.report.home_page import DRAWN, MOST_NOTE, MOST_TASKS, HomeReport, HomeTask
from carpus.ui.report.session_page import SessionReport
from carpus.ui.theme import Theme

USUAL_TIMES, USUAL_ROUNDS = 10, 3


class HomeSheet(Sheet):
    """``wanted`` carries the sheet for home, but for the patient's own way."""

    wanted = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 680)
        body = self.card.body
        body.setSpacing(8)
        body.addWidget(Text(theme, self.tr("Sheet for home"), 20, SEMIBOLD))
        words = self.tr("One page for the patient, without figures or diagnosis. Up to {count} exercises.")
        body.addWidget(Text(theme, words.format(count=MOST_TASKS), 14, REGULAR, "text2", wrap=True))
        grid = QGridLayout()
        self.ticks: dict[str, Tick] = {}
        for number, exercise in enumerate(DRAWN):
            tick = self.ticks[exercise.id] = Tick(theme, terms.exercise_name(exercise.id))
            tick.toggled.connect(self._check)
            grid.addWidget(tick, number // 3, number % 3)
        body.addLayout(grid)
        self.times, self.rounds = self._count(theme), self._count(theme)
        self.day = QDateEdit()
        self.day.setCalendarPopup(True)
        self.day.setDisplayFormat(numbers.day_format())
        self.at = QLineEdit()
        self.at.setMaxLength(12)
        fields = QHBoxLayout()
        fields.setSpacing(12)
        for words, field in (
            (self.tr("Times"), self.times), (self.tr("Rounds a day"), self.rounds),
            (self.tr("Next appointment"), self.day), (self.tr("Time"), self.at),
        ):  # fmt: skip
            fields.addWidget(Labelled(theme, words, field))
        body.addLayout(fields)
        self.open_day = Tick(theme, self.tr("No appointment yet: a line to write on"))
        self.open_day.toggled.connect(lambda on: self.day.setDisabled(on))
        body.addWidget(self.open_day)
        self.note = QLineEdit()
        self.note.setMaxLength(MOST_NOTE)
        body.addWidget(Labelled(theme, self.tr("A line for the patient, no names"), self.note))
        body.addWidget(Text(theme, self.tr("Language of the patient"), 14, REGULAR, "text2"))
        self.language = Choices(theme, list(LANGUAGES.items()), "en")
        body.addWidget(self.language)
        row = QHBoxLayout()
        row.setSpacing(10)
        row.addStretch(1)
        self.close_button = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=44)
        self.take = Button(theme, self.tr("Show the sheet"), "primary", height_px=44)
        row.addWidget(self.close_button)
        row.addWidget(self.take)
        body.addLayout(row)
        self._report: SessionReport | None = None
        self._today = date.min
        self._language = ""
        self.language.chosen.connect(self._take_language)
        self.close_button.clicked.connect(self.leave)
        self.take.clicked.connect(self._take)
        self.set_default(self.take)

    @staticmethod
    def _count(theme: Theme) -> QSpinBox:
        field = number_field(theme, 50)
        field.setMinimum(1)
        return field

    def begin(self, report: SessionReport, today: date) -> None:
        """Ask; what was trained today is ticked, and the appointment is in a week."""
        self._report, self._today = report, today
        for name, tick in self.ticks.items():
            tick.setEnabled(True)
            tick.setChecked(name == report.figures.exercise.id)
        self.times.setValue(USUAL_TIMES)  # of nobody who was here before
        self.rounds.setValue(USUAL_ROUNDS)
        week = today + timedelta(days=7)
        self.day.setMinimumDate(QDate(today.year, today.month, today.day).addDays(1))
        self.day.setDate(QDate(week.year, week.month, week.day))
        self.open_day.setChecked(False)
        self.at.clear()
        self.note.clear()
        self._language = self._language or spoken()
        self.language.choose(self._language)
        self._check()
        self.open()

    def chosen(self) -> list[Exercise]:
        """What is ticked."""
        return [exercise for exercise in DRAWN if self.ticks[exercise.id].isChecked()]

    def _check(self) -> None:
        """No more than there is room for, and not none."""
        count = len(self.chosen())
        for tick in self.ticks.values():
            tick.setEnabled(tick.isChecked() or count < MOST_TASKS)
        self.take.setEnabled(count > 0)

    def _take_language(self, code: object) -> None:
        self._language = str(code)

    def _take(self) -> None:
        if self._report is None:
            return
        self.close_sheet()
        tasks = tuple(HomeTask(one, self.times.value(), self.rounds.value()) for one in self.chosen())
        day = self.day.date()
        again = None if self.open_day.isChecked() else date(day.year(), day.month(), day.day())
        at, note = self.at.text().strip(), self.note.text().strip()
        self.wanted.emit(
            HomeReport(self._report, tasks, self._today, again, at if again else "", note, language=self._language)
        )

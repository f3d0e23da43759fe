"""What is asked before a sheet for home or a letter is made of a report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date, timedelta

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QGridLayout, QLineEdit, QPlainTextEdit, QWidget

from carpus.core.hand.exercises import Exercise
from carpus.core.records.values import HomePlan
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Choices, Combo, number_field
from carpus.ui.controls.layouts import fill
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.forms import Field, Form, length_rule
from carpus.ui.language import LANGUAGES, spoken
from carpus.ui.report.home_page import DRAWN, MOST_NOTE, MOST_TASKS, HomeReport, HomeTask
from carpus.ui.report.letter_page import MOST_ADDRESS_LINES, address_lines
from carpus.ui.report.session_page import SessionReport
from carpus.ui.theme import Theme

USUAL_TIMES, USUAL_ROUNDS = 10, 3
LISTED_DAYS, MOST_OF_TIME = 56, 12


class DayBox(Combo):
    """The next appointment: one of the days to come, or typed; none is guessed."""

    def __init__(self) -> None:
        super().__init__()
        self._today = date.min
        self.setEditable(True)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)

    def begin(self, today: date) -> None:
        """Offer the days after this one."""
        self._today = today
        days = [today + timedelta(days=number + 1) for number in range(LISTED_DAYS)]
        self.offer([(None, self.tr("No appointment yet")), *((day, numbers.short_date(day)) for day in days)])
        self.setCompleter(None)  # type: ignore[arg-type]  # it would put a day in place of one that is typed

    def _day(self) -> date | None:
        listed = self.findText(self.currentText().strip())
        return self.itemData(listed) if listed >= 0 else numbers.day_typed(self.currentText())

    def value(self) -> date | None:
        """None for none, and for what is no day to come."""
        day = self._day()
        return day if day is not None and day > self._today else None

    def set_value(self, day: date | None) -> None:
        self.setCurrentIndex(max(self.findData(day), 0))
        if day is not None and self.currentData() is None:
            self.setEditText(numbers.day_of_year(day))

    def fault(self) -> str:
        """What is asked where something else is typed than a day to come."""
        if self.value() is not None or self.currentText().strip() in ("", self.itemText(0)):
            return ""
        return self.tr("When next? Day, month, year") if self._day() is None else self.tr("When next? That day is over")


class HomeSheet(Sheet):
    """``wanted`` carries the sheet for home, but for the patient's own way. What a patient was last given is proposed
    again, day and line until that day has come."""

    wanted = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 680)
        words = self.tr("One page for the patient, without figures or diagnosis. Up to {count} exercises.")
        self.head(self.tr("Sheet for home"), words.format(count=MOST_TASKS), gap=8)
        grid = QGridLayout()
        self.ticks: dict[str, Tick] = {}
        for number, exercise in enumerate(DRAWN):
            tick = self.ticks[exercise.id] = Tick(theme, terms.exercise_name(exercise.id))
            tick.toggled.connect(self._check)
            grid.addWidget(tick, number // 3, number % 3)
        self.day = DayBox()
        self.asked = Form(
            theme,
            [
                Field("times", self.tr("&Times"), number_field(theme, 50, least=1)),
                Field("rounds", self.tr("&Rounds a day"), number_field(theme, 50, least=1), follows=True),
                Field(
                    "again", self.tr("Ne&xt appointment"), self.day, lambda _: self.day.fault(), follows=True, share=1,
                    tells="editTextChanged",
                ),
                Field(
                    "at", self.tr("T&ime"), QLineEdit(),
                    length_rule(MOST_OF_TIME, self.tr("Time: {count} letters too many")), follows=True, share=1,
                ),
                Field(
                    "note", self.tr("A &line for the patient, no names"), QLineEdit(),
                    length_rule(MOST_NOTE, self.tr("Line: {count} letters too many")),
                ),
                Field("language", self.tr("Language of the patient"), Choices(theme, list(LANGUAGES.items()))),
            ],
        )  # fmt: skip
        fill(self.card.body, grid, *self.asked.lines())
        self.take = Button(theme, self.tr("Show the sheet"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take)
        self._report: SessionReport | None = None
        self._today = date.min
        self.asked.changed.connect(self._check)
        self.take.clicked.connect(self._take)

    def begin(self, report: SessionReport, today: date, last: HomePlan | None = None) -> None:
        """Ask; ``last`` what the patient was given before, without which what was trained today is ticked.
        No appointment is guessed."""
        self._report, self._today = report, today
        trained = (report.figures.exercise.id,)
        plan = last or HomePlan(trained, USUAL_TIMES, USUAL_ROUNDS, today, None, "", "", spoken())
        if not (plan.made == today if plan.again is None else plan.again > today):
            plan = replace(plan, again=None, at="", note="")
        for name, tick in self.ticks.items():
            tick.setEnabled(True)
            tick.setChecked(name in plan.exercises)
        self.day.begin(today)
        self.asked.fill(plan if plan.language in LANGUAGES else replace(plan, language=spoken()))
        self._check()
        self.open()

    def chosen(self) -> list[Exercise]:
        return [exercise for exercise in DRAWN if self.ticks[exercise.id].isChecked()]

    def _check(self, *_: object) -> None:
        """No more than there is room for, and not none; what is still to be said stands on the button."""
        count, asked = len(self.chosen()), self.asked.fault()[1]
        for tick in self.ticks.values():
            tick.setEnabled(tick.isChecked() or count < MOST_TASKS)
        self.take.set_face(asked or self.tr("Show the sheet"))
        self.take.setEnabled(count > 0 and not asked)

    def _take(self) -> None:
        if self._report is None:
            return
        self.close_sheet()
        now = self.asked.values()
        tasks = tuple(HomeTask(one, now["times"], now["rounds"]) for one in self.chosen())
        at = now["at"] if now["again"] is not None else ""
        self.wanted.emit(
            HomeReport(self._report, tasks, self._today, now["again"], at, now["note"], language=now["language"])
        )


ADDRESS_PX = 84


class LetterSheet(Sheet):
    """``wanted`` carries the recipient, the language by two letters, and whether the real name is printed."""

    wanted = Signal(str, str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        words = self.tr("One page, with the figures of this session and your comment. Addresses stay in your list.")
        self.head(self.tr("Letter to the doctor"), words, gap=8)
        self.known = Combo()
        self.known.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.known.setPlaceholderText(self.tr("Written to before"))
        self.known.setAccessibleName(self.tr("Written to before"))
        lines = self.tr("Name and address, up to {count} lines").format(count=MOST_ADDRESS_LINES)
        self.names = Tick(theme, self.tr("Print the patient’s real name"))
        self.asked = Form(
            theme,
            [
                Field(
                    "recipient", lines, QPlainTextEdit(tabChangesFocus=True),
                    lambda text: lines if len([one for one in text.splitlines() if one.strip()]) > MOST_ADDRESS_LINES
                    else "",
                ),
                Field("language", self.tr("Language of the letter"), Choices(theme, list(LANGUAGES.items()))),
                Field("names", "", self.names),
            ],
        )  # fmt: skip
        recipient = self.asked["recipient"]
        theme.follow(recipient, lambda: recipient.setFixedHeight(theme.px(ADDRESS_PX)))
        self.too_long = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.too_long.hide()
        words = self.tr("The name goes into this letter only. Anybody who gets the file can read it.")
        self.names_note = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        parts = self.asked.parts
        fill(
            self.card.body, self.known, parts["recipient"], self.too_long, parts["language"], self.names,
            self.names_note,
        )  # fmt: skip
        self.take = Button(theme, self.tr("Show the letter"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take)
        self._language = ""
        self.known.activated.connect(lambda _: recipient.setPlainText(self.known.currentData()))
        self.asked.changed.connect(lambda: self.too_long.say(self.asked.fault()[1]))
        self.names.toggled.connect(self.names_note.setVisible)
        self.take.clicked.connect(self._take)

    def begin(self, known: Sequence[str], *, has_name: bool) -> None:
        """Ask; the name is never ticked by itself."""
        self.known.offer([(one, ", ".join(address_lines(one))) for one in known])
        self.known.setCurrentIndex(-1)
        self.known.setVisible(bool(known))
        self.names.setChecked(False)
        self.names.setVisible(has_name)
        self.names_note.hide()
        self._language = self._language or spoken()
        self.asked["language"].choose(self._language)
        self.open(self.asked["recipient"])

    def _take(self) -> None:
        self.close_sheet()
        now = self.asked.values()
        self._language = now["language"]
        text = "\n".join(address_lines(now["recipient"]))
        self.wanted.emit(text, self._language, now["names"] and not self.names.isHidden())

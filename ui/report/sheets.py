"""What is asked before a sheet for home or a letter is made of a report."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date, timedelta

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QGridLayout, QLineEdit, QPlainTextEdit, QSpinBox, QWidget

from carpus.core.hand.exercises import Exercise
from carpus.core.records.values import HomePlan
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Choices, Combo, Labelled, number_field
from carpus.ui.controls.layouts import fill, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.language import LANGUAGES, spoken
from carpus.ui.report.home_page import DRAWN, MOST_NOTE, MOST_TASKS, HomeReport, HomeTask
from carpus.ui.report.letter_page import MOST_ADDRESS_LINES, address_lines
from carpus.ui.report.session_page import SessionReport
from carpus.ui.theme import Theme

USUAL_TIMES, USUAL_ROUNDS = 10, 3
LISTED_DAYS, MOST_OF_TIME = 56, 12


class HomeSheet(Sheet):
    """``wanted`` carries the sheet for home, but for the patient's own way. What a patient was last given is proposed
    again, day and line until that day has come."""

    wanted = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 680)
        body = self.card.body
        words = self.tr("One page for the patient, without figures or diagnosis. Up to {count} exercises.")
        self.head(self.tr("Sheet for home"), words.format(count=MOST_TASKS), gap=8)
        grid = QGridLayout()
        self.ticks: dict[str, Tick] = {}
        for number, exercise in enumerate(DRAWN):
            tick = self.ticks[exercise.id] = Tick(theme, terms.exercise_name(exercise.id))
            tick.toggled.connect(self._check)
            grid.addWidget(tick, number // 3, number % 3)
        body.addLayout(grid)
        self.times, self.rounds = self._count(theme), self._count(theme)
        self.day = Combo()
        self.day.setEditable(True)
        self.day.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.at = QLineEdit()
        fields = in_line(gap=12)
        for words, field in (
            (self.tr("&Times"), self.times), (self.tr("&Rounds a day"), self.rounds),
            (self.tr("Ne&xt appointment"), self.day), (self.tr("T&ime"), self.at),
        ):  # fmt: skip
            fields.addWidget(Labelled(theme, words, field), 1 if field in (self.day, self.at) else 0)
        body.addLayout(fields)
        self.note = QLineEdit()
        body.addWidget(Labelled(theme, self.tr("A &line for the patient, no names"), self.note))
        body.addWidget(Text(theme, self.tr("Language of the patient"), 14, REGULAR, "text2"))
        self.language = Choices(theme, list(LANGUAGES.items()), "en")
        body.addWidget(self.language)
        self.take = Button(theme, self.tr("Show the sheet"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take)
        self._report: SessionReport | None = None
        self._today = date.min
        self._days: dict[str, date] = {}
        for changed in (self.day.editTextChanged, self.at.textChanged, self.note.textChanged):
            changed.connect(lambda _: self._check())
        self.take.clicked.connect(self._take)

    @staticmethod
    def _count(theme: Theme) -> QSpinBox:
        field = number_field(theme, 50)
        field.setMinimum(1)
        return field

    def begin(self, report: SessionReport, today: date, last: HomePlan | None = None) -> None:
        """Ask; ``last`` what the patient was given before, without which what was trained today is ticked.
        No appointment is guessed."""
        self._report, self._today = report, today
        trained = last.exercises if last is not None else (report.figures.exercise.id,)
        for name, tick in self.ticks.items():
            tick.setEnabled(True)
            tick.setChecked(name in trained)
        self.times.setValue(last.times if last is not None else USUAL_TIMES)
        self.rounds.setValue(last.rounds if last is not None else USUAL_ROUNDS)
        self._days = {
            numbers.short_date(day): day for day in (today + timedelta(days=n + 1) for n in range(LISTED_DAYS))
        }
        self.day.clear()
        self.day.addItems([self.tr("No appointment yet"), *self._days])
        self.day.setCompleter(None)  # type: ignore[arg-type]  # it would put a day in place of one that is typed
        holds = last is not None and (last.made == today if last.again is None else last.again > today)
        again = last.again if holds and last is not None else None
        self.day.setCurrentIndex(0)
        if again is not None:
            words = numbers.short_date(again)
            self.day.setEditText(words if words in self._days else numbers.day_of_year(again))
        self.at.setText(last.at if holds and last is not None else "")
        self.note.setText(last.note if holds and last is not None else "")
        self.language.choose(last.language if last is not None and last.language in LANGUAGES else spoken())
        self._check()
        self.open()

    def chosen(self) -> list[Exercise]:
        return [exercise for exercise in DRAWN if self.ticks[exercise.id].isChecked()]

    def _again(self) -> date | None:
        """The day that is chosen or typed; None for none, and for what is no day to come."""
        typed = self.day.currentText().strip()
        day = self._days.get(typed) or numbers.day_typed(typed)
        return day if day is not None and day > self._today else None

    def _asked(self) -> str:
        """What stands in the way, as it stands on the button."""
        typed = self.day.currentText().strip()
        if typed not in ("", self.day.itemText(0)) and self._again() is None:
            past = numbers.day_typed(typed) is not None
            return self.tr("When next? That day is over") if past else self.tr("When next? Day, month, year")
        for line, most, words in (
            (self.at, MOST_OF_TIME, self.tr("Time: {count} letters too many")),
            (self.note, MOST_NOTE, self.tr("Line: {count} letters too many")),
        ):
            if (count := len(line.text().strip()) - most) > 0:
                return words.format(count=count)
        return ""

    def _check(self, *_: object) -> None:
        """No more than there is room for, and not none; what is still to be said stands on the button."""
        count = len(self.chosen())
        for tick in self.ticks.values():
            tick.setEnabled(tick.isChecked() or count < MOST_TASKS)
        asked = self._asked()
        self.take.set_face(asked or self.tr("Show the sheet"))
        self.take.setEnabled(count > 0 and not asked)

    def _take(self) -> None:
        if self._report is None:
            return
        self.close_sheet()
        tasks = tuple(HomeTask(one, self.times.value(), self.rounds.value()) for one in self.chosen())
        again, code = self._again(), str(self.language.value())
        at = self.at.text().strip() if again is not None else ""
        self.wanted.emit(
            HomeReport(self._report, tasks, self._today, again, at, self.note.text().strip(), language=code)
        )


ADDRESS_PX = 84


class LetterSheet(Sheet):
    """``wanted`` carries the recipient, the language by two letters, and whether the real name is printed."""

    wanted = Signal(str, str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        words = self.tr("One page, with the figures of this session and your comment. Addresses stay in your list.")
        self.head(self.tr("Letter to the doctor"), words, gap=8)
        self.known = Combo()
        self.known.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.known.setPlaceholderText(self.tr("Written to before"))
        self.known.setAccessibleName(self.tr("Written to before"))
        body.addWidget(self.known)
        self.recipient = QPlainTextEdit()
        self.recipient.setTabChangesFocus(True)
        self.recipient.textChanged.connect(self._check)
        theme.follow(self.recipient, lambda: self.recipient.setFixedHeight(theme.px(ADDRESS_PX)))
        caption = self.tr("Name and address, up to {count} lines").format(count=MOST_ADDRESS_LINES)
        body.addWidget(Labelled(theme, caption, self.recipient))
        words = self.tr("Name and address, up to {count} lines").format(count=MOST_ADDRESS_LINES)
        self.too_long = Text(theme, words, 14, SEMIBOLD, "bad", wrap=True)
        self.too_long.hide()
        fill(body, self.too_long, Text(theme, self.tr("Language of the letter"), 14, REGULAR, "text2"))
        self.language = Choices(theme, list(LANGUAGES.items()), "en")
        body.addWidget(self.language)
        self.names = Tick(theme, self.tr("Print the patient’s real name"))
        body.addWidget(self.names)
        words = self.tr("The name goes into this letter only. Anybody who gets the file can read it.")
        self.names_note = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        body.addWidget(self.names_note)
        self.take = Button(theme, self.tr("Show the letter"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take)
        self._language = ""
        self._addresses: Sequence[str] = ()
        self.known.activated.connect(lambda place: self.recipient.setPlainText(self._addresses[place]))
        self.language.chosen.connect(self._take_language)
        self.names.toggled.connect(self.names_note.setVisible)
        self.take.clicked.connect(self._take)

    def begin(self, known: Sequence[str], *, has_name: bool) -> None:
        """Ask; the name is never ticked by itself."""
        self._addresses = known
        self.known.clear()
        self.known.addItems([", ".join(address_lines(one)) for one in known])
        self.known.setCurrentIndex(-1)
        self.known.setVisible(bool(known))
        self.names.setChecked(False)
        self.names.setVisible(has_name)
        self.names_note.hide()
        self._language = self._language or spoken()
        self.language.choose(self._language)
        self.open(self.recipient)

    def _check(self) -> None:
        lines = [line for line in self.recipient.toPlainText().splitlines() if line.strip()]
        self.too_long.setVisible(len(lines) > MOST_ADDRESS_LINES)

    def _take_language(self, code: object) -> None:
        self._language = str(code)

    def _take(self) -> None:
        self.close_sheet()
        text = "\n".join(address_lines(self.recipient.toPlainText()))
        self.wanted.emit(text, self._language, self.names.isChecked() and not self.names.isHidden())

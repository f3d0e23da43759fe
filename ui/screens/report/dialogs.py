"""Dialogs before a home exercise sheet or a letter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date, timedelta

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QGridLayout, QLineEdit, QPlainTextEdit, QWidget

from carpus.core.model.hand.exercises import Exercise
from carpus.core.model.phrase import LANGUAGES
from carpus.core.records.values import HomePlan
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import ChoiceRow, Combo, number_field
from carpus.ui.kit.forms import Field, Form, limit_length
from carpus.ui.kit.language import current_language
from carpus.ui.kit.layouts import fill
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.report.home_page import DRAWABLE_EXERCISES, MAX_NOTE_LENGTH, MAX_TASKS, HomeReport, HomeTask
from carpus.ui.report.letter_page import MAX_ADDRESS_LINES, address_lines
from carpus.ui.report.session_page import SessionReport
from carpus.ui.words import terms

DEFAULT_TIMES, DEFAULT_ROUNDS = 10, 3
LISTED_DAYS, MAX_TIME_LENGTH = 56, 12


class AppointmentBox(Combo):
    """Next appointment: one of the coming days, or a typed one; none is preselected."""

    def __init__(self) -> None:
        super().__init__()
        self._today = date.min
        self.setEditable(True)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)

    def set_today(self, today: date) -> None:
        """Offer the days after ``today``."""
        self._today = today
        days = [today + timedelta(days=number + 1) for number in range(LISTED_DAYS)]
        self.set_choices(
            [(None, self.tr("No appointment yet")), *((day, numbers.format_short_date(day)) for day in days)]
        )
        self.setCompleter(None)  # type: ignore[arg-type]  # it would put a day in place of one that is typed

    def _day(self) -> date | None:
        listed = self.findText(self.currentText().strip())
        return self.itemData(listed) if listed >= 0 else numbers.parse_date(self.currentText())

    def value(self) -> date | None:
        """Return the day, None for none and for anything but a coming day."""
        day = self._day()
        return day if day is not None and day > self._today else None

    def set_value(self, day: date | None) -> None:
        self.setCurrentIndex(max(self.findData(day), 0))
        if day is not None and self.currentData() is None:
            self.setEditText(numbers.format_date(day))

    def error_text(self) -> str:
        """Return what is wrong with the typed day."""
        if self.value() is not None or self.currentText().strip() in ("", self.itemText(0)):
            return ""
        return (
            self.tr("Next appointment: day, month, year")
            if self._day() is None
            else self.tr("Next appointment: this day has passed")
        )


class HomeDialog(Dialog):
    """Form of the home exercise sheet; ``requested`` carries the sheet without the patient's progress.

    The patient's last plan is proposed again; appointment and note until that day.
    """

    requested = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 680)
        words = self.tr("One page for the patient, without values or diagnosis. Up to {count} exercises.")
        self.add_heading(self.tr("Home exercise sheet"), words.format(count=MAX_TASKS), gap=8)
        grid = QGridLayout()
        self.exercise_checks: dict[str, QCheckBox] = {}
        for number, exercise in enumerate(DRAWABLE_EXERCISES):
            tick = self.exercise_checks[exercise.id] = QCheckBox(terms.exercise_name(exercise.id))
            tick.toggled.connect(self._check)
            grid.addWidget(tick, number // 3, number % 3)
        self.appointment = AppointmentBox()
        self.form = Form(
            theme,
            [
                Field("times", self.tr("&Repetitions"), number_field(theme, 50, minimum=1)),
                Field("rounds", self.tr("Times a &day"), number_field(theme, 50, minimum=1), continues_row=True),
                Field(
                    "again",
                    self.tr("Ne&xt appointment"),
                    self.appointment,
                    lambda _: self.appointment.error_text(),
                    continues_row=True,
                    stretch=1,
                    change_signal="editTextChanged",
                ),
                Field(
                    "at",
                    self.tr("T&ime"),
                    QLineEdit(),
                    limit_length(MAX_TIME_LENGTH, self.tr("Time: {count} characters too long")),
                    continues_row=True,
                    stretch=1,
                ),
                Field(
                    "note",
                    self.tr("&Message to the patient (no names)"),
                    QLineEdit(),
                    limit_length(MAX_NOTE_LENGTH, self.tr("Message: {count} characters too long")),
                ),
                Field("language", self.tr("Language of the patient"), ChoiceRow(theme, list(LANGUAGES.items()))),
            ],
        )
        fill(self.card.body, grid, *self.form.layout_rows())
        self.accept_button = Button(theme, self.tr("Show the sheet"), "primary", height_px=44)
        self.close_button = self.add_buttons(self.accept_button)
        self._report: SessionReport | None = None
        self._today = date.min
        self.form.changed.connect(self._check)
        self.accept_button.clicked.connect(self._accept)

    def open_form(self, report: SessionReport, today: date, last_plan: HomePlan | None = None) -> None:
        """Show the form for ``last_plan``, or without one for today's exercise."""
        self._report, self._today = report, today
        trained = (report.results.exercise.id,)
        plan = last_plan or HomePlan(trained, DEFAULT_TIMES, DEFAULT_ROUNDS, today, None, "", "", current_language())
        if not (plan.made == today if plan.again is None else plan.again > today):
            plan = replace(plan, again=None, at="", note="")
        for name, tick in self.exercise_checks.items():
            tick.setEnabled(True)
            tick.setChecked(name in plan.exercises)
        self.appointment.set_today(today)
        self.form.fill(plan if plan.language in LANGUAGES else replace(plan, language=current_language()))
        self._check()
        self.open()

    def selection(self) -> list[Exercise]:
        return [exercise for exercise in DRAWABLE_EXERCISES if self.exercise_checks[exercise.id].isChecked()]

    def _check(self, *_: object) -> None:
        """Limit the number of exercises; the button says what is still missing."""
        count, asked = len(self.selection()), self.form.find_error()[1]
        for tick in self.exercise_checks.values():
            tick.setEnabled(tick.isChecked() or count < MAX_TASKS)
        self.accept_button.set_label(asked or self.tr("Show the sheet"))
        self.accept_button.setEnabled(count > 0 and not asked)

    def _accept(self) -> None:
        if self._report is None:
            return
        self.close_dialog()
        now = self.form.values()
        tasks = tuple(HomeTask(one, now["times"], now["rounds"]) for one in self.selection())
        at = now["at"] if now["again"] is not None else ""
        self.requested.emit(
            HomeReport(self._report, tasks, self._today, now["again"], at, now["note"], language=now["language"])
        )


ADDRESS_PX = 84


class LetterDialog(Dialog):
    """Form of the letter; ``requested`` carries recipient, language, and whether to print the real name."""

    requested = Signal(str, str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        words = self.tr("One page with the values of this session and your comment. Addresses stay in your list.")
        self.add_heading(self.tr("Letter to the doctor"), words, gap=8)
        self.recipients = Combo()
        self.recipients.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.recipients.setPlaceholderText(self.tr("Previous recipients"))
        self.recipients.setAccessibleName(self.tr("Previous recipients"))
        lines = self.tr("Name and address, up to {count} lines").format(count=MAX_ADDRESS_LINES)
        self.name_check = QCheckBox(self.tr("Print the patient’s real name"))
        self.form = Form(
            theme,
            [
                Field(
                    "recipient", lines, QPlainTextEdit(tabChangesFocus=True),
                    lambda text: lines if len([one for one in text.splitlines() if one.strip()]) > MAX_ADDRESS_LINES
                    else "",
                ),
                Field("language", self.tr("Language of the letter"), ChoiceRow(theme, list(LANGUAGES.items()))),
                Field("names", "", self.name_check),
            ],
        )  # fmt: skip
        recipient = self.form["recipient"]
        theme.on_change(recipient, lambda: recipient.setFixedHeight(theme.px(ADDRESS_PX)))
        self.length_warning = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.length_warning.hide()
        words = self.tr("The name appears in this letter only. Anyone who has the file can read it.")
        self.name_warning = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        parts = self.form.labelled_widgets
        fill(
            self.card.body,
            self.recipients,
            parts["recipient"],
            self.length_warning,
            parts["language"],
            self.name_check,
            self.name_warning,
        )
        self.accept_button = Button(theme, self.tr("Show the letter"), "primary", height_px=44)
        self.close_button = self.add_buttons(self.accept_button)
        self._language = ""
        self.recipients.activated.connect(lambda _: recipient.setPlainText(self.recipients.currentData()))
        self.form.changed.connect(lambda: self.length_warning.show_text(self.form.find_error()[1]))
        self.name_check.toggled.connect(self.name_warning.setVisible)
        self.accept_button.clicked.connect(self._accept)

    def open_form(self, recipients: Sequence[str], *, has_name: bool, prints_name: bool = False) -> None:
        """Show the form; the real name is preselected where reports print it."""
        self.recipients.set_choices([(one, ", ".join(address_lines(one))) for one in recipients])
        self.recipients.setCurrentIndex(-1)
        self.recipients.setVisible(bool(recipients))
        self.name_check.setChecked(has_name and prints_name)
        self.name_check.setVisible(has_name)
        self.name_warning.setVisible(self.name_check.isChecked())
        self._language = self._language or current_language()
        self.form["language"].choose(self._language)
        self.open(self.form["recipient"])

    def _accept(self) -> None:
        self.close_dialog()
        now = self.form.values()
        self._language = now["language"]
        text = "\n".join(address_lines(now["recipient"]))
        self.requested.emit(text, self._language, now["names"] and not self.name_check.isHidden())

"""Form for a new or an existing patient: pseudonym first, real name optional."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QStringListModel, Qt, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QCompleter, QLineEdit, QPlainTextEdit, QWidget

from carpus.core.model.errors import NameUnsuited
from carpus.core.model.names import MAX_NAME_CHARACTERS, fold_name, normalize_name
from carpus.core.records.values import Patient
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button, CheckButton, is_enter_key
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import ChoiceRow, DateField
from carpus.ui.kit.forms import Field, Form, limit_length, require_choice
from carpus.ui.kit.layouts import STRETCH, ScrollArea, column_layout, fill, require_parent, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.words import terms
from carpus.ui.words.fault_words import fault_words

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.records.patients import Patients

NOTE_HEIGHT_PX = 84
COMPLETE_DATE = re.compile(r"\d\d?\D+\d\d?\D+(?:(?:19|20)\d\d|\d\d)|(?:19|20)\d\d\D+\d\d?\D+\d\d?")
"""Day, month and year are present, so an invalid date does not exist."""
MONTH_FIRST = re.compile(r"(?:0?\d|1[0-2])\D+(?:1[3-9]|[2-9]\d)\D")
"""Day and month are swapped: the order is wrong."""

GENERATED_PSEUDONYM = re.compile(r"\w+ \d+")
"""A pseudonym as Carpus proposes it; any other searched name may be a real one."""


class PatientForm(Dialog):
    """Form of a patient.

    Enter saves, Esc closes. The clinic's list of diagnoses changes at once. Signals: ``saved`` with the patient's id.
    """

    saved = Signal(str)

    def __init__(self, host: QWidget, theme: Theme, register: Patients, today: Callable[[], date]) -> None:
        super().__init__(host, theme, 740)
        self._register, self._today = register, today
        self.patient = Patient("?", "both")
        self._taken_names: frozenset[str] = frozenset()
        self._save_words = ""
        self._title = Text(theme, "", 20, SEMIBOLD)
        self.listed_tick = CheckButton(theme, self.tr("In the clinic’s &list"))
        self.weeks_text = Text(theme, "", 14, token="text2")
        self._error_text = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.remove_button = Button(theme, self.tr("Archi&ve or delete…"), "quiet", icon="trash-2", height_px=40)
        self.save_button = Button(theme, "", "primary")
        self.fields = Form(theme, self._make_fields(theme))
        self._known_diagnoses = QStringListModel(self)
        completer = QCompleter(self._known_diagnoses, self.fields["diagnosis"])
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.fields["diagnosis"].setCompleter(completer)
        self.listed_tick.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # its letter leads to it; Tab goes on to the next fact
        self.fields["note"].setTabChangesFocus(True)
        self.fields["note"].setFixedHeight(theme.px(NOTE_HEIGHT_PX))
        self._build_layout(theme)
        self._connect()
        theme.changed.connect(self._fit)

    def _make_fields(self, theme: Theme) -> list[Field]:
        """Return the fields in order; each is an attribute of a patient."""
        another = Button(theme, self.tr("&Another"), "plain", height_px=40)
        another.clicked.connect(lambda: self.fields["pseudonym"].setText(self._register.suggest_pseudonym()))
        return [
            Field(
                "pseudonym",
                self.tr("&Name in Carpus"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Name: {count} characters too long")),
                (another,),
            ),
            Field(
                "name",
                self.tr("&Real name, optional (stays in this list, never in a session or report)"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Real name: {count} characters too long")),
            ),
            Field(
                "side",
                self.tr("Affected hand"),
                ChoiceRow(theme, [(side, terms.side_name(side)) for side in ("right", "left", "both")]),
                require_choice(self.tr("Which hand is affected?")),
            ),
            Field(
                "dominance",
                self.tr("Writes with"),
                ChoiceRow(
                    theme, [("right", self.tr("Right")), ("left", self.tr("Left")), ("unknown", self.tr("Not known"))]
                ),
                lambda hand: self.tr("Which hand writes?") if hand is None and self.patient.dominance != "both" else "",
                continues_row=True,
            ),
            Field(
                "diagnosis",
                self.tr("&Diagnosis or operation (stays in this list, never in a session)"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Diagnosis: {count} characters too long")),
                (self.listed_tick,),
            ),
            Field(
                "onset_day",
                self.tr("&Since"),
                DateField(placeholderText=self.tr("day month year")),
                lambda _: self._onset_day_error(),
                (self.weeks_text,),
            ),
            Field(
                "onset",
                "",
                ChoiceRow(theme, [("operation", self.tr("Operation")), ("injury", self.tr("Injury"))]),
                lambda onset: (
                    self.tr("Operation or injury?") if self._onset_day() is not None and onset is None else ""
                ),
                continues_row=True,
            ),
            Field("note", self.tr("N&ote (no names)"), QPlainTextEdit()),
        ]

    def _build_layout(self, theme: Theme) -> None:
        cancel = Button(theme, self.tr("Close without saving"), "plain", hint=self.tr("Esc"), height_px=52)
        cancel.clicked.connect(self.close_dialog)
        rule = self.tr("A made-up name that can be spoken aloud. No real name, no initials, no date of birth.")
        self._form_page = QWidget()
        column_layout(*self.fields.layout_rows(), gap=14, margins=(0, 0, 0, 0), parent=self._form_page)
        self._scroll = ScrollArea(self._form_page)  # large text on a small screen: the fields scroll, the buttons stay
        body = self.card.body
        body.setSpacing(16)
        rule_line = Text(theme, rule, 14, token="text2", wrap=True)
        fill(
            body,
            self._title,
            rule_line,
            self._scroll,
            self._error_text,
            row_layout(self.remove_button, STRETCH, cancel, self.save_button),
        )

    def _connect(self) -> None:
        self.remove_button.clicked.connect(self.close_dialog)
        self.save_button.clicked.connect(self._accept)
        self.fields.changed.connect(self._validate)
        for name in ("pseudonym", "name", "diagnosis", "onset_day"):
            self.fields[name].textEdited.connect(lambda _: self._error_text.hide())
        self.fields["onset_day"].editingFinished.connect(lambda: self._error_text.show_text(self._onset_day_error()))
        self.fields["diagnosis"].textChanged.connect(lambda _: self._show_diagnosis_listed())
        self.listed_tick.clicked.connect(self._set_diagnosis_listed)
        self.set_default(self.save_button)

    def edit_patient(self, patient: Patient | None, taken_names: frozenset[str], name: str = "") -> None:
        """Open for a new patient (None) or an existing one.

        A searched ``name`` becomes the real name, which no session or report contains, unless it is a generated
        pseudonym.
        """
        self._taken_names = taken_names
        self._title.setText(self.tr("New patient") if patient is None else self.tr("Edit patient"))
        self._save_words = self.tr("Add patient") if patient is None else self.tr("Save changes")
        self.remove_button.setVisible(patient is not None)
        is_made_up = bool(GENERATED_PSEUDONYM.fullmatch(name.strip()))
        pseudonym = name if is_made_up else self._register.suggest_pseudonym() if patient is None else ""
        self.patient = patient or Patient(pseudonym, "right", name="" if is_made_up else name)
        self._known_diagnoses.setStringList(list(self._register.diagnoses()))
        self.fields.fill(self.patient)
        if patient is None:  # a hand that nobody chose would be a wrong record
            self.fields["side"].choose(None)
            self.fields["dominance"].choose(None)
        self._show_diagnosis_listed()
        self._validate()
        self._error_text.hide()
        self._fit()
        self._scroll.verticalScrollBar().setValue(0)
        self.open(self.fields["pseudonym"])
        self.fields["pseudonym"].selectAll()

    def _fit(self) -> None:
        room = require_parent(self).height() - self._theme.px(250)
        self._scroll.setFixedHeight(min(self._form_page.sizeHint().height() + 2, max(room, 160)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the focus to the first missing field on Enter."""
        wrong, _ = self.fields.find_error()
        if is_enter_key(event) and wrong is not None:
            first = wrong.buttons()[0] if isinstance(wrong, ChoiceRow) else wrong
            first.setFocus(Qt.FocusReason.TabFocusReason)
            event.accept()
        else:
            super().keyPressEvent(event)

    def _validate(self) -> None:
        """Show what is missing on the save button."""
        day = self._onset_day()
        self.weeks_text.setText(numbers.format_weeks_since(day, self._today()) if day is not None else "")
        if self._onset_day_error() and re.search(
            r"\D\d{4}$|^\d{4}\D+\d+\D+\d\d$", self.fields["onset_day"].text().strip()
        ):
            self._error_text.show_text(self._onset_day_error())  # a complete date is checked at once
        _, asked = self.fields.find_error()
        self.save_button.set_label(asked or self._save_words)
        self.save_button.setEnabled(not asked)

    def _onset_day(self) -> date | None:
        day: date | None = self.fields["onset_day"].value()
        return day if day is not None and day <= self._today() else None

    def _onset_day_error(self) -> str:
        """Return the message for an invalid or future date."""
        typed = self.fields["onset_day"].text().strip()
        if not typed or self._onset_day() is not None:
            return ""
        if numbers.parse_date(typed) is not None:
            return self.tr("Since when? The date is in the future")
        if COMPLETE_DATE.fullmatch(typed) and not MONTH_FIRST.match(typed):
            return self.tr("Since when? This date does not exist")
        return self.tr("Since when? Day, month, year")

    def _show_diagnosis_listed(self) -> None:
        words = fold_name(self.fields.values()["diagnosis"])
        self.listed_tick.setVisible(bool(words))
        self.listed_tick.setChecked(words in map(fold_name, self._known_diagnoses.stringList()))

    def _set_diagnosis_listed(self, is_listed: bool) -> None:
        try:
            self._register.set_diagnosis_listed(normalize_name(self.fields.values()["diagnosis"]), is_listed=is_listed)
        except NameUnsuited as fault:
            self._show_error(fault)
        self._known_diagnoses.setStringList(list(self._register.diagnoses()))
        self._show_diagnosis_listed()

    def _accept(self) -> None:
        values = self.fields.values()
        name = values["pseudonym"]
        if not name or name.casefold() in self._taken_names:
            words = (
                self.tr("Enter a name.")
                if not name
                else self.tr("“{name}” is already in use. Choose another name.").format(name=name)
            )
            self._error_text.show_text(words)
            self.fields["pseudonym"].setFocus(Qt.FocusReason.OtherFocusReason)
            return
        try:
            values |= {"onset": values["onset"] or "", "dominance": values["dominance"] or self.patient.dominance}
            patient = replace(self.patient, **values)
            patient.with_normalized_names()
        except NameUnsuited as fault:  # shown here, so that the entries stay
            self._show_error(fault)
        else:
            self.close_dialog()
            self.saved.emit(self._register.save(patient))

    def _show_error(self, fault: NameUnsuited) -> None:
        words = fault_words(fault)
        self._error_text.show_text(f"{words.summary} {words.remedy}")

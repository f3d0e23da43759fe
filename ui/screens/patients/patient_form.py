"""Form for a new or an existing patient: pseudonym first, all that names a person optional."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QStringListModel, Qt, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QCheckBox, QCompleter, QLineEdit, QPlainTextEdit, QWidget

from carpus.core.model.errors import CarpusFault, NameUnsuited, PseudonymTaken
from carpus.core.model.names import MAX_NAME_CHARACTERS, fold_name, normalize_name
from carpus.core.records.values import Patient
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button, is_enter_key
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
        self.listed_tick = QCheckBox(self.tr("Save in diagnosis &list"))
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
        born, since = DateField(self._today), DateField(self._today)
        another = Button(theme, self.tr("&Another"), "plain", height_px=40)
        another.clicked.connect(lambda: self.fields["pseudonym"].setText(self._register.suggest_pseudonym()))
        return [
            Field(
                "pseudonym",
                self.tr("Pseudo&nym"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Pseudonym: {count} characters too long")),
                (another,),
                stretch=1,
            ),
            Field(
                "name",
                self.tr("&Real name"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Real name: {count} characters too long")),
                continues_row=True,
                stretch=1,
            ),
            Field("birth_day", self.tr("&Birth date"), born, lambda _: self._date_error("birth_day"), stretch=1),
            Field(
                "record_number",
                self.tr("Record nu&mber"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Record number: {count} characters too long")),
                continues_row=True,
                stretch=1,
            ),
            Field(
                "sex",
                self.tr("Sex"),
                ChoiceRow(
                    theme, [("female", self.tr("Female")), ("male", self.tr("Male")), ("diverse", self.tr("Other"))]
                ),
                continues_row=True,
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
                self.tr("&Diagnosis or operation"),
                QLineEdit(),
                limit_length(MAX_NAME_CHARACTERS, self.tr("Diagnosis: {count} characters too long")),
                (self.listed_tick,),
            ),
            Field(
                "onset_day",
                self.tr("&Since"),
                since,
                lambda _: self._date_error("onset_day"),
                (self.weeks_text,),
            ),
            Field(
                "onset",
                "",
                ChoiceRow(theme, [("operation", self.tr("Operation")), ("injury", self.tr("Injury"))]),
                lambda onset: self.tr("Operation or injury?") if since.value() is not None and onset is None else "",
                continues_row=True,
            ),
            Field("note", self.tr("N&ote (no names)"), QPlainTextEdit()),
        ]

    def _build_layout(self, theme: Theme) -> None:
        cancel = Button(theme, self.tr("Close without saving"), "plain", hint=self.tr("Esc"), height_px=52)
        cancel.clicked.connect(self.close_dialog)
        rule = self.tr(
            "The pseudonym is shown on all screens and can be spoken aloud: no real name, no initials, no birth "
            "date. Real name, birth date, record number, sex and diagnosis are optional. They stay in the patient "
            "list and are never in a session file or an export."
        )
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
        for name in ("pseudonym", "name", "record_number", "diagnosis", "birth_day", "onset_day"):
            self.fields[name].textEdited.connect(lambda _: self._clear_errors())
        for name in ("birth_day", "onset_day"):
            self.fields[name].textEdited.connect(lambda _, name=name: self._check_date(name))
            self.fields[name].editingFinished.connect(lambda name=name: self._check_date(name, is_finished=True))
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
        self._clear_errors()
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
        day = self.fields["onset_day"].value()
        self.weeks_text.setText(numbers.format_weeks_since(day, self._today()) if day is not None else "")
        _, asked = self.fields.find_error()
        self.save_button.set_label(asked or self._save_words)
        self.save_button.setEnabled(not asked)

    def _date_error(self, name: str) -> str:
        labels = {"birth_day": self.tr("Birth date: {problem}"), "onset_day": self.tr("Since: {problem}")}
        problem = self.fields[name].error
        return labels[name].format(problem=problem) if problem else ""

    def _check_date(self, name: str, *, is_finished: bool = False) -> None:
        """Show a wrong date below its field: a complete one at once, others when the field is left."""
        if is_finished or self.fields[name].is_complete:
            self._show_error(name, self._date_error(name))

    def _clear_errors(self) -> None:
        self._show_error("", "")

    def _show_error(self, name: str, message: str) -> None:
        """Show a message below its field, or above the buttons if it is of no field."""
        self.fields.show_error(name, message)
        self._error_text.show_text("" if name else message)

    def _show_diagnosis_listed(self) -> None:
        words = fold_name(self.fields.values()["diagnosis"])
        self.listed_tick.setVisible(bool(words))
        self.listed_tick.setChecked(words in map(fold_name, self._known_diagnoses.stringList()))

    def _set_diagnosis_listed(self, is_listed: bool) -> None:
        try:
            self._register.set_diagnosis_listed(normalize_name(self.fields.values()["diagnosis"]), is_listed=is_listed)
        except CarpusFault as fault:
            self._show_error("diagnosis", _fault_message(fault))
        self._known_diagnoses.setStringList(list(self._register.diagnoses()))
        self._show_diagnosis_listed()

    def _accept(self) -> None:
        """Save, and close only what was saved."""
        values = self.fields.values()
        name = values["pseudonym"]
        if not name or name.casefold() in self._taken_names:
            words = (
                self.tr("Enter a pseudonym.")
                if not name
                else self.tr("The pseudonym “{name}” is already in use. Choose another one.").format(name=name)
            )
            self._show_error("pseudonym", words)
            self.fields["pseudonym"].setFocus(Qt.FocusReason.OtherFocusReason)
            return
        values |= {field: values[field] or getattr(self.patient, field) for field in ("onset", "dominance", "sex")}
        field = ""
        try:
            for field in ("pseudonym", "name", "record_number", "diagnosis"):
                normalize_name(values[field])
            field = "pseudonym"  # what only the store knows: it is taken
            patient_id = self._register.save(replace(self.patient, **values))
        except (NameUnsuited, PseudonymTaken) as fault:
            self._show_error(field, _fault_message(fault))
        except CarpusFault as fault:
            self._show_error("", _fault_message(fault))
        else:
            self.close_dialog()
            self.saved.emit(patient_id)


def _fault_message(fault: CarpusFault) -> str:
    words = fault_words(fault)
    return f"{words.summary} {words.remedy}"

"""The form for a new patient, or for changing one: a made-up name first, the real one only if wanted."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QStringListModel, Qt, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QCompleter, QLineEdit, QPlainTextEdit, QWidget

from carpus.core.errors import NameUnsuited
from carpus.core.names import MOST_CHARACTERS, folded, name_of
from carpus.core.records.values import Patient
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button, Tick, is_enter
from carpus.ui.controls.field import Choices, DayField
from carpus.ui.controls.layouts import STRETCH, ScrollArea, fill, host_of, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.fault_words import fault_words
from carpus.ui.forms import Field, Form, choice_rule, length_rule
from carpus.ui.theme import Theme

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.records.patients import Patients

NOTE_HEIGHT_PX = 84
WHOLE_DAY = re.compile(r"\d\d?\D+\d\d?\D+(?:(?:19|20)\d\d|\d\d)|(?:19|20)\d\d\D+\d\d?\D+\d\d?")
"""Day, month and year are there: where that is no day, there is none such."""
MONTH_FIRST = re.compile(r"(?:0?\d|1[0-2])\D+(?:1[3-9]|[2-9]\d)\D")
"""A day stands where the month should, and the other way round: what is wrong is the order."""

MADE_UP_NAME = re.compile(r"\w+ \d+")
"""A made-up name as Carpus proposes it; any other name that was searched for may be a person's real one."""


class PatientForm(Sheet):
    """Enter in any line keeps the patient, and ``kept`` carries the identity; Esc closes. The clinic's list of
    diagnoses is changed at once."""

    kept = Signal(str)

    def __init__(self, host: QWidget, theme: Theme, register: Patients, today: Callable[[], date]) -> None:
        super().__init__(host, theme, 740)
        self._register, self._today = register, today
        self.patient = Patient("?", "both")
        self._taken: frozenset[str] = frozenset()
        self._words = ""
        self._title = Text(theme, "", 20, SEMIBOLD)
        self.listed = Tick(theme, self.tr("In the clinic’s &list"))
        self.since = Text(theme, "", 14, token="text2")
        self._fault = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.remove = Button(theme, self.tr("Archi&ve or delete…"), "quiet", icon="trash-2", height_px=40)
        self.save = Button(theme, "", "primary")
        self.fields = Form(theme, self._table(theme))
        self._known = QStringListModel(self)
        completer = QCompleter(self._known, self.fields["diagnosis"])
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.fields["diagnosis"].setCompleter(completer)
        self.listed.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # its letter leads to it; Tab goes on to the next fact
        self.fields["note"].setTabChangesFocus(True)
        self.fields["note"].setFixedHeight(theme.px(NOTE_HEIGHT_PX))
        self._lay_out(theme)
        self._connect()
        theme.changed.connect(self._fit)

    def _table(self, theme: Theme) -> list[Field]:
        """What is asked, in order; each field an attribute of a patient."""
        another = Button(theme, self.tr("&Another"), "plain", height_px=40)
        another.clicked.connect(lambda: self.fields["pseudonym"].setText(self._register.suggest_pseudonym()))
        return [
            Field(
                "pseudonym", self.tr("&Name in Carpus"), QLineEdit(),
                length_rule(MOST_CHARACTERS, self.tr("Name: {count} letters too many")), (another,),
            ),
            Field(
                "name", self.tr("&Real name, if wanted (stays in this list, never in a session or report)"),
                QLineEdit(), length_rule(MOST_CHARACTERS, self.tr("Real name: {count} letters too many")),
            ),
            Field(
                "side", self.tr("Affected hand"),
                Choices(theme, [(side, terms.side_name(side)) for side in ("right", "left", "both")]),
                choice_rule(self.tr("Which hand is affected?")),
            ),
            Field(
                "dominance", self.tr("Writes with"),
                Choices(
                    theme, [("right", self.tr("Right")), ("left", self.tr("Left")), ("unknown", self.tr("Not known"))]
                ),
                lambda hand: self.tr("Which hand writes?") if hand is None and self.patient.dominance != "both" else "",
                follows=True,
            ),
            Field(
                "diagnosis", self.tr("&Diagnosis or operation (stays in this list, in no session)"), QLineEdit(),
                length_rule(MOST_CHARACTERS, self.tr("Diagnosis: {count} letters too many")), (self.listed,),
            ),
            Field(
                "onset_day", self.tr("&Since"), DayField(placeholderText=self.tr("day month year")),
                lambda _: self._wrong_day(), (self.since,),
            ),
            Field(
                "onset", "", Choices(theme, [("operation", self.tr("Operation")), ("injury", self.tr("Injury"))]),
                lambda onset: self.tr("Operation or injury?") if self._day() is not None and onset is None else "",
                follows=True,
            ),
            Field("note", self.tr("N&ote (no names)"), QPlainTextEdit()),
        ]  # fmt: skip

    def _lay_out(self, theme: Theme) -> None:
        cancel = Button(theme, self.tr("Close without saving"), "plain", hint=self.tr("Esc"), height_px=52)
        cancel.clicked.connect(self.close_sheet)
        rule = self.tr("A made-up name that can be spoken aloud. No real name, no initials, no date of birth.")
        self._asked = QWidget()
        in_column(*self.fields.lines(), gap=14, margins=(0, 0, 0, 0), within=self._asked)
        self._scroll = ScrollArea(self._asked)  # large text on a small screen: the fields scroll, the buttons stay
        body = self.card.body
        body.setSpacing(16)
        rule_line = Text(theme, rule, 14, token="text2", wrap=True)
        fill(body, self._title, rule_line, self._scroll, self._fault, in_line(self.remove, STRETCH, cancel, self.save))

    def _connect(self) -> None:
        self.remove.clicked.connect(self.close_sheet)
        self.save.clicked.connect(self._accept)
        self.fields.changed.connect(self._judge)
        for name in ("pseudonym", "name", "diagnosis", "onset_day"):
            self.fields[name].textEdited.connect(lambda _: self._fault.hide())
        self.fields["onset_day"].editingFinished.connect(lambda: self._fault.say(self._wrong_day()))
        self.fields["diagnosis"].textChanged.connect(lambda _: self._look_into_list())
        self.listed.clicked.connect(self._list)
        self.set_default(self.save)

    def begin(self, patient: Patient | None, taken: frozenset[str], name: str = "") -> None:
        """Open for a new patient or with one to change.

        A name that was searched for becomes the real name, which no file and no report holds, unless it is made up.
        """
        self._taken = taken
        self._title.setText(self.tr("New patient") if patient is None else self.tr("Change patient"))
        self._words = self.tr("Add patient") if patient is None else self.tr("Keep changes")
        self.remove.setVisible(patient is not None)
        is_made_up = bool(MADE_UP_NAME.fullmatch(name.strip()))
        pseudonym = name if is_made_up else self._register.suggest_pseudonym() if patient is None else ""
        self.patient = patient or Patient(pseudonym, "right", name="" if is_made_up else name)
        self._known.setStringList(list(self._register.diagnoses()))
        self.fields.fill(self.patient)
        if patient is None:  # a hand that nobody chose would be a wrong record
            self.fields["side"].choose(None)
            self.fields["dominance"].choose(None)
        self._look_into_list()
        self._judge()
        self._fault.hide()
        self._fit()
        self._scroll.verticalScrollBar().setValue(0)
        self.open(self.fields["pseudonym"])
        self.fields["pseudonym"].selectAll()

    def _fit(self) -> None:
        room = host_of(self).height() - self._theme.px(250)
        self._scroll.setFixedHeight(min(self._asked.sizeHint().height() + 2, max(room, 160)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter leads to what is still to be said."""
        wrong, _ = self.fields.fault()
        if is_enter(event) and wrong is not None:
            first = wrong.buttons()[0] if isinstance(wrong, Choices) else wrong
            first.setFocus(Qt.FocusReason.TabFocusReason)
            event.accept()
        else:
            super().keyPressEvent(event)

    def _judge(self) -> None:
        """What is still to be said stands on the button."""
        day = self._day()
        self.since.setText(numbers.weeks_since(day, self._today()) if day is not None else "")
        if self._wrong_day() and re.search(r"\D\d{4}$|^\d{4}\D+\d+\D+\d\d$", self.fields["onset_day"].text().strip()):
            self._fault.say(self._wrong_day())  # written to its end: told at once, not when the field is left
        _, asked = self.fields.fault()
        self.save.set_face(asked or self._words)
        self.save.setEnabled(not asked)

    def _day(self) -> date | None:
        day: date | None = self.fields["onset_day"].value()
        return day if day is not None and day <= self._today() else None

    def _wrong_day(self) -> str:
        """What is asked where something is typed that is no day, or one to come."""
        typed = self.fields["onset_day"].text().strip()
        if not typed or self._day() is not None:
            return ""
        if numbers.day_typed(typed) is not None:
            return self.tr("Since when? It is yet to come")
        if WHOLE_DAY.fullmatch(typed) and not MONTH_FIRST.match(typed):
            return self.tr("Since when? There is no such day")
        return self.tr("Since when? Day, month, year")

    def _look_into_list(self) -> None:
        words = folded(self.fields.values()["diagnosis"])
        self.listed.setVisible(bool(words))
        self.listed.setChecked(words in map(folded, self._known.stringList()))

    def _list(self, wanted: bool) -> None:
        try:
            self._register.list_diagnosis(name_of(self.fields.values()["diagnosis"]), listed=wanted)
        except NameUnsuited as fault:
            self._say(fault)
        self._known.setStringList(list(self._register.diagnoses()))
        self._look_into_list()

    def _accept(self) -> None:
        values = self.fields.values()
        name = values["pseudonym"]
        if not name or name.casefold() in self._taken:
            words = (
                self.tr("Give the patient a name.")
                if not name
                else self.tr("“{name}” is taken. Choose another name.").format(name=name)
            )
            self._fault.say(words)
            self.fields["pseudonym"].setFocus(Qt.FocusReason.OtherFocusReason)
            return
        try:
            values |= {"onset": values["onset"] or "", "dominance": values["dominance"] or self.patient.dominance}
            patient = replace(self.patient, **values)
            patient.as_kept()
        except NameUnsuited as fault:  # told here: what was typed stays
            self._say(fault)
        else:
            self.close_sheet()
            self.kept.emit(self._register.keep(patient))

    def _say(self, fault: NameUnsuited) -> None:
        words = fault_words(fault)
        self._fault.say(f"{words.happened} {words.do}")

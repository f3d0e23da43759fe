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
from carpus.ui.controls.field import Choices, Labelled
from carpus.ui.controls.layouts import STRETCH, ScrollArea, fill, host_of, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.fault_words import fault_words
from carpus.ui.theme import Theme

if TYPE_CHECKING:  # it reads and writes files
    from carpus.ui.patients.stored import StoredPatients

NOTE_HEIGHT_PX = 84
WHOLE_DAY = re.compile(r"\d\d?\D+\d\d?\D+(?:(?:19|20)\d\d|\d\d)|(?:19|20)\d\d\D+\d\d?\D+\d\d?")
"""Day, month and year are there: where that is no day, there is none such."""
MONTH_FIRST = re.compile(r"(?:0?\d|1[0-2])\D+(?:1[3-9]|[2-9]\d)\D")
"""A day stands where the month should, and the other way round: what is wrong is the order."""

MADE_UP_NAME = re.compile(r"\w+ \d+")
"""A made-up name as Carpus proposes it; any other name that was searched for may be a person's real one."""


class PatientForm(Sheet):
    """Emits ``accepted`` with the patient; Enter in any line accepts, Esc closes. The clinic's list of
    diagnoses is changed at once."""

    accepted = Signal(Patient)

    def __init__(self, host: QWidget, theme: Theme, store: StoredPatients, today: Callable[[], date]) -> None:
        super().__init__(host, theme, 740)
        self._store, self._today = store, today
        self.patient = Patient("?", "both")
        self._taken: frozenset[str] = frozenset()
        self._asked: Choices | None = None
        self._words = ""
        self._title = Text(theme, "", 20, SEMIBOLD)
        self.name = QLineEdit()
        self.side = Choices(theme, [(side, terms.side_name(side)) for side in ("right", "left", "both")])
        self.dominance = Choices(
            theme, [("right", self.tr("Right")), ("left", self.tr("Left")), ("unknown", self.tr("Not known"))]
        )
        self.real_name = QLineEdit()
        self.diagnosis = QLineEdit()
        self._known = QStringListModel(self)
        completer = QCompleter(self._known, self.diagnosis)
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.diagnosis.setCompleter(completer)
        self.listed = Tick(theme, self.tr("In the clinic’s &list"))
        self.listed.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # its letter leads to it; Tab goes on to the next fact
        self.onset_day = QLineEdit(placeholderText=self.tr("day month year"))
        self.onset = Choices(theme, [("operation", self.tr("Operation")), ("injury", self.tr("Injury"))])
        self.since = Text(theme, "", 14, token="text2")
        self.note = QPlainTextEdit()
        self.note.setTabChangesFocus(True)
        self.note.setFixedHeight(theme.px(NOTE_HEIGHT_PX))
        self._fault = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.remove = Button(theme, self.tr("Archi&ve or delete…"), "quiet", icon="trash-2", height_px=40)
        self.save = Button(theme, "", "primary")
        self._lay_out(theme)
        self._connect()
        theme.changed.connect(self._fit)

    def _lay_out(self, theme: Theme) -> None:
        another = Button(theme, self.tr("&Another"), "plain", height_px=40)
        another.clicked.connect(lambda: self.name.setText(self._store.suggest_pseudonym()))
        cancel = Button(theme, self.tr("Close without saving"), "plain", hint=self.tr("Esc"), height_px=52)
        cancel.clicked.connect(self.close_sheet)
        rule = self.tr("A made-up name that can be spoken aloud. No real name, no initials, no date of birth.")
        kept = self.tr("&Real name, if wanted (stays in this list, never in a session or report)")
        why = self.tr("&Diagnosis or operation (stays in this list, in no session)")
        hands = in_line(
            Labelled(theme, self.tr("Affected hand"), self.side),
            Labelled(theme, self.tr("Writes with"), self.dominance),
            STRETCH,
            gap=24,
        )
        self._fields = QWidget()
        in_column(
            Labelled(theme, self.tr("&Name in Carpus"), self.name, another),
            Labelled(theme, kept, self.real_name),
            hands,
            Labelled(theme, why, self.diagnosis, self.listed),
            Labelled(theme, self.tr("&Since"), self.onset_day, self.since, self.onset),
            Labelled(theme, self.tr("N&ote (no names)"), self.note),
            gap=14,
            margins=(0, 0, 0, 0),
            within=self._fields,
        )
        self._scroll = ScrollArea(self._fields)  # large text on a small screen: the fields scroll, the buttons stay
        body = self.card.body
        body.setSpacing(16)
        rule_line = Text(theme, rule, 14, token="text2", wrap=True)
        fill(body, self._title, rule_line, self._scroll, self._fault, in_line(self.remove, STRETCH, cancel, self.save))

    def _connect(self) -> None:
        self.remove.clicked.connect(self.close_sheet)
        self.save.clicked.connect(self._accept)
        for chips in (self.side, self.dominance, self.onset):
            chips.chosen.connect(lambda _: self._judge())
        for line in (self.name, self.real_name, self.diagnosis, self.onset_day):
            line.textChanged.connect(lambda _: self._judge())
            line.textEdited.connect(lambda _: self._fault.hide())
        self.onset_day.editingFinished.connect(lambda: self._show_fault(self._wrong_day()))
        self.diagnosis.textChanged.connect(lambda _: self._look_into_list())
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
        is_new = patient is None
        if patient is None:
            is_made_up = bool(MADE_UP_NAME.fullmatch(name.strip()))
            pseudonym = name if is_made_up else self._store.suggest_pseudonym()
            patient = Patient(pseudonym, "right", "unknown", name="" if is_made_up else name)
        self.patient = patient
        self.name.setText(patient.pseudonym)
        self.side.choose(patient.side)
        self.dominance.choose(patient.dominance if patient.dominance != "both" else "unknown")
        self._known.setStringList(list(self._store.diagnoses()))
        self.diagnosis.setText(patient.diagnosis)
        self._look_into_list()
        self.onset_day.setText(numbers.day_of_year(patient.onset_day) if patient.onset_day is not None else "")
        self.onset.choose_nothing()
        if patient.onset:
            self.onset.choose(patient.onset)
        if is_new:  # a hand that nobody chose would be a wrong record
            self.side.choose_nothing()
            self.dominance.choose_nothing()
        self._judge()
        self.real_name.setText(patient.name)
        self.note.setPlainText(patient.note)
        self._fault.hide()
        self._fit()
        self._scroll.verticalScrollBar().setValue(0)
        self.open(self.name)
        self.name.selectAll()

    def _fit(self) -> None:
        room = host_of(self).height() - self._theme.px(250)
        self._scroll.setFixedHeight(min(self._fields.sizeHint().height() + 2, max(room, 160)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if is_enter(event) and not self.save.isEnabled() and self._asked is not None:
            self._asked.buttons()[0].setFocus(Qt.FocusReason.TabFocusReason)
            event.accept()
        else:
            super().keyPressEvent(event)

    def _judge(self) -> None:
        """What is still to be said stands on the button."""
        self._asked = None
        day = self._day()
        self.since.setText(numbers.weeks_since(day, self._today()) if day is not None else "")
        asked = self._too_long() or self._wrong_day()
        if self.side.value() is None:
            asked, self._asked = self.tr("Which hand is affected?"), self.side
        elif self.dominance.value() is None:
            asked, self._asked = self.tr("Which hand writes?"), self.dominance
        elif day is not None and self.onset.value() is None:
            asked = asked or self.tr("Operation or injury?")
            self._asked = self.onset
        if self._wrong_day() and re.search(r"\D\d{4}$|^\d{4}\D+\d+\D+\d\d$", self.onset_day.text().strip()):
            self._show_fault(self._wrong_day())  # written to its end: told at once, not when the field is left
        self.save.set_face(asked or self._words)
        self.save.setEnabled(not asked)

    def _day(self) -> date | None:
        day = numbers.day_typed(self.onset_day.text())
        return day if day is not None and day <= self._today() else None

    def _wrong_day(self) -> str:
        """What is asked where something is typed that is no day, or one to come."""
        typed = self.onset_day.text().strip()
        if not typed or self._day() is not None:
            return ""
        if numbers.day_typed(typed) is not None:
            return self.tr("Since when? It is yet to come")
        if WHOLE_DAY.fullmatch(typed) and not MONTH_FIRST.match(typed):
            return self.tr("Since when? There is no such day")
        return self.tr("Since when? Day, month, year")

    def _too_long(self) -> str:
        """Which line has no room in the store; nothing that is typed is ever cut."""
        for line, words in (
            (self.name, self.tr("Name: {count} letters too many")),
            (self.real_name, self.tr("Real name: {count} letters too many")),
            (self.diagnosis, self.tr("Diagnosis: {count} letters too many")),
        ):
            if (count := len(" ".join(line.text().split())) - MOST_CHARACTERS) > 0:
                return words.format(count=count)
        return ""

    def _why(self) -> str:
        return " ".join(self.diagnosis.text().split())

    def _look_into_list(self) -> None:
        words = folded(self._why())
        self.listed.setVisible(bool(words))
        self.listed.setChecked(words in map(folded, self._known.stringList()))

    def _list(self, wanted: bool) -> None:
        try:
            self._store.list_diagnosis(name_of(self._why()), listed=wanted)
        except NameUnsuited as fault:
            self._say(fault)
        self._known.setStringList(list(self._store.diagnoses()))
        self._look_into_list()

    def _accept(self) -> None:
        name = " ".join(self.name.text().split())
        if not name or name.casefold() in self._taken:
            words = (
                self.tr("Give the patient a name.")
                if not name
                else self.tr("“{name}” is taken. Choose another name.").format(name=name)
            )
            self._show_fault(words)
            self.name.setFocus(Qt.FocusReason.OtherFocusReason)
            return
        patient = replace(
            self.patient, pseudonym=name, name=" ".join(self.real_name.text().split()),
            side=self.side.value(), dominance=self.dominance.value(),  # type: ignore[arg-type]
            diagnosis=self._why(), onset=self.onset.value() or "", onset_day=self._day(),  # type: ignore[arg-type]
            note=self.note.toPlainText().strip(),
        )  # fmt: skip
        try:
            patient.as_kept()
        except NameUnsuited as fault:  # told here: what was typed stays
            self._say(fault)
        else:
            self.close_sheet()
            self.accepted.emit(patient)

    def _say(self, fault: NameUnsuited) -> None:
        words = fault_words(fault)
        self._show_fault(f"{words.happened} {words.do}")

    def _show_fault(self, words: str) -> None:
        self._fault.say(words)

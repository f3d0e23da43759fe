"""The guided test and retest: people and their two times, the smallest real change so far, putting it into force."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QComboBox, QGridLayout, QWidget

from carpus.core.agreement.retest import Restated, RetestPlan, changed_first
from carpus.core.measures.change import DEFAULT_LIMITS, FEWEST_PEOPLE, ErrorLimits
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.layouts import STRETCH, ScrolledColumn, empty, in_column, in_line, scroll_area
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, Text, caption, heading
from carpus.ui.keys import Keys, bind
from carpus.ui.retest.words import (
    figure_name,
    headline,
    limit_now_deg,
    mounting_words,
    new_limit_deg,
    person_words,
    restated_state,
    restated_title,
    restated_words,
    second_words,
    state_words,
    statement_words,
    tenths,
    verdict_change,
)
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.verdicts import difference

MOST_RESTATED = 12
"""So many statements are shown, those that change first; the sentence above counts all."""


class RetestScreen(QWidget):
    """``exercise_chosen`` carries an exercise, ``people`` asks who takes part, ``measure`` carries a person's identity,
    ``use`` asks for the limits to be put into force, ``save`` for the table."""

    exercise_chosen = Signal(str)
    people = Signal()
    measure = Signal(str)
    use = Signal()
    save = Signal()

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self._theme = theme
        self.plan = RetestPlan("", (), None)
        self._limits: ErrorLimits = DEFAULT_LIMITS
        self.exercise = QComboBox()
        self.exercise.setAccessibleName(self.tr("Exercise"))
        self.exercise.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.people_button = Button(theme, self.tr("&People…"))
        self.save_button = Button(theme, self.tr("Save table…"), hint="Ctrl+E")
        self.use_button = Button(theme, self.tr("&Use these limits…"))
        self.measure_button = Button(theme, "", "primary", icon="play", height_px=44)
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self._people_card = Card(theme, 20)
        self._figures_card = Card(theme, 20)
        self._restated_card = Card(theme, 20)
        self._lay_out()
        self.exercise.activated.connect(lambda _: self.exercise_chosen.emit(str(self.exercise.currentData())))
        self.people_button.clicked.connect(self.people)
        self.save_button.clicked.connect(self.save)
        self.use_button.clicked.connect(self.use)
        self.measure_button.clicked.connect(self._measure)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        bind(self, keys, "export", self.save_button.click)
        self.show_plan(self.plan, DEFAULT_LIMITS)

    def _lay_out(self) -> None:
        head = in_line(
            self.exercise, self.people_button, STRETCH, self.save_button, self.use_button, self.measure_button, gap=12
        )
        host = ScrolledColumn()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight, host)
        self._columns.setContentsMargins(0, 0, 0, 0)
        self._columns.setSpacing(GAP_PX)
        self._columns.addWidget(self._people_card, 1, Qt.AlignmentFlag.AlignTop)
        self._columns.addLayout(in_column(self._figures_card, self._restated_card, STRETCH, gap=GAP_PX), 1)
        in_column(
            head,
            12,
            self.answer,
            2,
            self.basis,
            12,
            (scroll_area(host), 1),
            gap=0,
            margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX),
            within=self,
        )
        self._theme.changed.connect(self._fit)

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit(self) -> None:
        """With large text what stood at the right goes below."""
        tight = is_tight(self, self._theme) or self.width() < 1180 * self._theme.text_scale
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if tight else directions.LeftToRight)
        self.save_button.setVisible(not is_tight(self, self._theme))

    # --- states -------------------------------------------------------------------------------------------
    def show_exercises(self, exercises: Sequence[str], chosen: str) -> None:
        """Those that were measured of anybody who takes part."""
        self.exercise.clear()
        for exercise in exercises:
            self.exercise.addItem(terms.exercise_name(exercise), exercise)
        self.exercise.setCurrentIndex(max(0, self.exercise.findData(chosen)))
        self.exercise.setVisible(bool(exercises))

    def reading(self) -> None:
        """The sessions are being read, which takes a second each."""
        self.basis.setText(self.tr("Reading the sessions…"))
        for button in (self.measure_button, self.use_button, self.save_button):
            button.setEnabled(False)

    def show_plan(self, plan: RetestPlan, limits: ErrorLimits) -> None:
        """How the study of one exercise stands; ``limits`` in force today."""
        self.plan, self._limits = plan, limits
        answer, basis = headline(plan, limits)
        self.answer.setText(answer)
        self.basis.setText(basis)
        due = plan.next_due
        words = self.tr("Nobody is due")
        if due is not None:
            pattern = self.tr("Measure {name}, second time") if due.state == "due" else self.tr("Measure {name}")
            words = pattern.format(name=due.pseudonym).replace("&", "&&")
        self.measure_button.set_face(words)
        self.measure_button.setEnabled(due is not None)
        self.use_button.setEnabled(not plan.blocked)
        self.use_button.setToolTip("" if not plan.blocked else answer)
        self.save_button.setEnabled(plan.study is not None)
        self._fill_people()
        self._fill_figures()
        self._restated_card.hide()

    def show_restated(self, statements: Sequence[Restated], done: int, patients: int) -> None:
        """What the new limits would change in what is said of patients, of whom so many were looked at."""
        body, theme = self._restated_card.body, self._theme
        empty(self._restated_card.body)
        self._restated_card.show()
        body.addWidget(Text(theme, restated_title(self.plan), 16, SEMIBOLD, wrap=True))
        body.addWidget(caption(theme, restated_words(statements, done, patients), wrap=True))
        shown = changed_first(statements)[:MOST_RESTATED]
        table = QWidget()
        grid = QGridLayout(table)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(6)
        for column, stretch in enumerate((0, 50, 16, 34)):
            grid.setColumnStretch(column, stretch)
        for number, one in enumerate(shown):
            row = 2 * number
            grid.addWidget(Line(theme), row, 0, 1, 4)
            grid.addWidget(Sign(theme, restated_state(one)), row + 1, 0)
            weight, token = (SEMIBOLD, "accent") if one.is_changed else (REGULAR, "text2")
            grid.addWidget(Text(theme, statement_words(one), 14, REGULAR, wrap=True), row + 1, 1)
            grid.addWidget(Text(theme, difference(one.now.shown_difference_deg), 14, MEDIUM, wrap=True), row + 1, 2)
            grid.addWidget(Text(theme, verdict_change(one), 14, weight, token, wrap=True), row + 1, 3)
        body.addWidget(table)
        table.setVisible(bool(shown))

    def first(self) -> QWidget:
        return self.measure_button if self.measure_button.isEnabled() else self.people_button

    def _measure(self) -> None:
        if self.plan.next_due is not None:
            self.measure.emit(self.plan.next_due.patient_id)

    def _fill_people(self) -> None:
        body, theme = self._people_card.body, self._theme
        empty(self._people_card.body)
        body.addWidget(Text(theme, self.tr("People"), 16, SEMIBOLD))
        words = self.tr("all discs taken off and put on anew before each time, within 14 days")
        body.addWidget(caption(theme, words, wrap=True))
        heads = (
            self.tr("Person"), self.tr("First time"), self.tr("Second time"), self.tr("Apart"), self.tr("State"),
        )  # fmt: skip
        table, grid = self._table(heads, (18, 25, 25, 7, 0, 26))
        for number, person in enumerate(self.plan.people):
            row = 2 * number + 1
            grid.addWidget(Line(theme), row, 0, 1, 6)
            counted = person.counted
            state, words = state_words(person)
            apart = self.tr("{days} d").format(days=person.days_apart) if len(counted) > 1 else ""
            first = mounting_words(counted[0]) if counted else ""
            texts = (person_words(person), first, second_words(person), apart)
            for column, text in enumerate(texts):
                weight = MEDIUM if column == 0 else REGULAR
                grid.addWidget(Text(theme, text, 14, weight, wrap=True), row + 1, column)
            grid.addWidget(Sign(theme, state), row + 1, 4)
            grid.addWidget(Text(theme, words, 14, MEDIUM, wrap=True), row + 1, 5)
        body.addWidget(table)
        table.setVisible(bool(self.plan.people))

    def _table(self, heads: Sequence[str], stretches: Sequence[int]) -> tuple[QWidget, QGridLayout]:
        """An empty table with its heads; the last spans what further columns there are."""
        table = QWidget()
        grid = QGridLayout(table)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(6)
        last = len(heads) - 1
        for column, head in enumerate(heads):
            span = len(stretches) - last if column == last else 1
            grid.addWidget(caption(self._theme, head, wrap=True), 0, column, 1, span)
        for column, stretch in enumerate(stretches):
            grid.setColumnStretch(column, stretch)
        return table, grid

    def _fill_figures(self) -> None:
        body, theme, study = self._figures_card.body, self._theme, self.plan.study
        empty(self._figures_card.body)
        body.addWidget(Text(theme, self.tr("Smallest real change, so far"), 16, SEMIBOLD))
        if study is None or not study.found:
            words = self.tr("There is nothing yet: two people measured twice give the first figures.")
            body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
            return
        words = self.tr("from {people} people, {sessions} sessions")
        if study.raters:
            words = self.tr("from {people} people, {sessions} sessions, {raters} raters")
        if study.raters == 1:
            words = self.tr("from {people} people, {sessions} sessions, 1 rater")
        said = words.format(people=study.people, sessions=study.sessions, raters=study.raters)
        body.addWidget(caption(theme, said, wrap=True))
        heads = (
            self.tr("Movement"), self.tr("SEM"), self.tr("Real change (MDC95), 95 % interval"), self.tr("Today"),
            self.tr("New limit"),
        )  # fmt: skip
        table, grid = self._table(heads, (30, 10, 30, 10, 10))
        for number, ((of, movement), found) in enumerate(study.found.items()):
            row = 2 * number + 1
            grid.addWidget(Line(theme), row, 0, 1, len(heads))
            low, high = found.mdc95_interval
            change = f"{tenths(found.mdc95)} ({tenths(low)} – {tenths(high)})"
            few = found.people < FEWEST_PEOPLE
            today = numbers.degrees(limit_now_deg(self.plan, of, movement, self._limits))
            texts = (figure_name(of, movement), tenths(found.sem), change, today, numbers.degrees(new_limit_deg(found)))
            for column, text in enumerate(texts):
                weight = SEMIBOLD if column == 2 else REGULAR
                token = "text2" if column == 4 and few else "text"
                grid.addWidget(Text(theme, text, 14, weight, token, wrap=True), row + 1, column)
        body.addWidget(table)
        words = self.tr(
            "Grey = not yet usable. Reports then say whose limits they are, with date and number of people. A new "
            "camera, exercise or way of mounting needs its own study."
        )
        body.addWidget(caption(theme, words, wrap=True))

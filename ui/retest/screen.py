"""The guided test and retest: people and their two times, the smallest real change so far, putting it into force."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import date

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QGridLayout, QWidget

from carpus.core.agreement.retest import Mounting, Person, Restated, Retest, RetestPlan, changed_first
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.change import ARC_LIMIT_FACTOR, DEFAULT_LIMITS, FEWEST_PEOPLE, ErrorLimits, change_limit_rad
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import STRETCH, Fitted, ScrollArea, ScrolledColumn, empty, in_column, in_grid, in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, Text, caption, heading
from carpus.ui.figures import figure_of
from carpus.ui.icons import State
from carpus.ui.keys import Keys, bind_screen
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.translate import inside, tr
from carpus.ui.verdicts import difference, reason_words, verdict_word

MOST_RESTATED = 12
"""So many statements are shown, those that change first; the sentence above counts all."""


class RetestScreen(Fitted):
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
        self.exercise = Combo()
        self.exercise.setAccessibleName(self.tr("Exercise"))
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
        bind_screen(self, keys, {"export": self.save_button.click})
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
            (ScrollArea(host), 1),
            gap=0,
            margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX),
            within=self,
        )
        self._theme.changed.connect(self._fit)

    def _fit(self) -> None:
        """With large text what stood at the right goes below."""
        tight = is_tight(self, self._theme) or self.width() < 1180 * self._theme.text_scale
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if tight else directions.LeftToRight)
        self.save_button.setVisible(not is_tight(self, self._theme))

    # --- states -------------------------------------------------------------------------------------------
    def show_exercises(self, exercises: Sequence[str], chosen: str) -> None:
        """Those that were measured of anybody who takes part."""
        self.exercise.offer([(one, terms.exercise_name(one)) for one in exercises], chosen)
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
        grid = in_grid(12, 6, shares=(0, 50, 16, 34), margins=(0, 0, 0, 0), within=table)
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
        grid = in_grid(12, 6, margins=(0, 0, 0, 0), within=table)
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


def headline(plan: RetestPlan, limits: ErrorLimits) -> tuple[str, str]:
    """How far the study is, and what holds until then."""
    complete = plan.complete
    if not plan.people:
        return tr("Nobody takes part yet."), tr("Choose volunteers or staff, never patients, by “People…”.")
    if plan.blocked == "simulated":
        return tr("These are simulated hands."), tr("Limits of a simulated hand are never put into force.")
    lacking = FEWEST_PEOPLE - complete
    counted = tr("1 person is measured twice.") if complete == 1 else tr("{count} people are measured twice.")
    if lacking > 0:
        more = tr("{count} more make it usable.").format(count=lacking)
        basis = tr(
            "Until then progress and reports use the limits of before. {least} people are the least; 20 are better."
        )
        return f"{counted.format(count=complete)} {more}", basis.format(least=FEWEST_PEOPLE)
    study = plan.study
    own = limits.study(study.protocol, study.exercise, study.angle_order) if study is not None else None
    if own is not None:
        words = tr("Limits of {day} with {count} people are in force. “Use these limits” puts these in their place.")
        day = numbers.day_of_year(date.fromisoformat(own.made))
        return counted.format(count=complete), words.format(day=day, count=own.people)
    basis = tr("“Use these limits” puts them into force in progress and reports. Reports already made keep theirs.")
    return counted.format(count=complete), basis


def mounting_words(mounting: Mounting) -> str:
    """``Mon 2 Nov · MK``."""
    return " · ".join(part for part in (numbers.short_date(mounting.when), mounting.rater) if part)


def person_words(person: Person) -> str:
    """Pseudonym, and the hand where one was measured."""
    return person.pseudonym if person.side is None else f"{person.pseudonym}, {inside(terms.side_name(person.side))}"


def second_words(person: Person) -> str:
    """The last time that counts, or until when it must be."""
    counted = person.counted
    if len(counted) > 2:
        return tr("{last}, {count} times").format(last=mounting_words(counted[-1]), count=len(counted))
    if len(counted) == 2:
        return mounting_words(counted[-1])
    if person.due_by is not None:
        return tr("due by {day}").format(day=numbers.short_date(person.due_by))
    return ""


def state_words(person: Person) -> tuple[State, str]:
    """Sign and word; a session that takes no part says why."""
    why = [one.reason for one in person.mountings if one.reason]
    if person.state == "complete":
        return "good", tr("complete")
    if why:
        words = tr("more than 14 days later") if "too_late" in why else reason_words(why[:1])
        return "warn", tr("measure again: {reason}").format(reason=words)
    if person.state == "due":
        return "partly", tr("second due")
    if person.state == "too_late":
        return "warn", tr("too late: measure both again")
    return "open", tr("missing")


def figure_name(of: str, movement: str) -> str:
    """``Flexion``, ``Bending arc``, ``Middle finger, middle joint``."""
    if of in WRIST_ANGLES:
        return terms.arc_name(WRIST_ANGLES.index(of)) if movement == "arc" else terms.movement_name(movement)
    name = figure_of(of).long_name
    return name if movement == "arc" else f"{name}, {inside(terms.movement_name(movement))}"


def limit_now_deg(plan: RetestPlan, of: str, movement: str, limits: ErrorLimits) -> float:
    """What a change must exceed today: the clinic's own limit in force, else the usual one."""
    if plan.study is not None:
        own = limits.study(plan.study.protocol, plan.study.exercise, plan.study.angle_order)
        mine = own.limit_deg(of, movement) if own is not None else None
        if mine is not None:
            return mine
    usual = math.degrees(change_limit_rad("TAM" if of.startswith("TAM") else of))
    return usual * (ARC_LIMIT_FACTOR if movement == "arc" and not of.startswith("TAM") else 1.0)


def new_limit_deg(found: Retest) -> float:
    """What it would become: whole degrees, upwards."""
    return float(math.ceil(found.mdc95 - 1e-9)) if math.isfinite(found.mdc95) else math.nan


def restated_title(plan: RetestPlan) -> str:
    """Over what the limits would change."""
    if plan.blocked == "few":
        return tr("What changes in reports, once complete")
    return tr("What would change in today's reports")


def restated_words(statements: Sequence[Restated], done: int, patients: int) -> str:
    """How many of the statements about patients change, or how far the look at them is."""
    if done < patients:
        return tr("Looking at the sessions of {done} of {count} patients…").format(done=done + 1, count=patients)
    if not statements:
        return tr("Nobody else has two sessions of this exercise that compare.")
    changed = sum(one.is_changed for one in statements)
    pattern = tr("{changed} of {count} statements change. Reports already made keep theirs.")
    return pattern.format(changed=changed, count=len(statements))


def restated_state(one: Restated) -> State:
    """Sign of what is said of a patient then."""
    if one.is_changed:
        return "partly"
    return "good" if one.then == "improved" else "warn" if one.then == "worse" else "open"


def statement_words(one: Restated) -> str:
    """``Otter 29, extension, 6 Oct → 17 Nov``."""
    of = one.now.joint or WRIST_ANGLES[one.now.angle]
    name = figure_name(of, one.now.movement)
    days = f"{numbers.day_month(one.first)} → {numbers.day_month(one.last)}"
    return f"{one.pseudonym}, {inside(name)}, {days}"


def verdict_change(one: Restated) -> str:
    """``no change → improved``, or ``improved, as now``."""
    if one.is_changed:
        return f"{verdict_word(one.now.verdict)} → {verdict_word(one.then)}"
    return tr("{verdict}, as now").format(verdict=verdict_word(one.then))


def tenths(size_deg: float) -> str:
    """``6.6°``; a dash where it is not known."""
    return f"{numbers.fixed(size_deg, 1)}°" if math.isfinite(size_deg) else numbers.UNKNOWN

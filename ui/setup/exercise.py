"""First step: which exercise, which hand, how often, how far."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.hand.exercises import PRONOSUPINATION, SIDES, Exercise, exercise_named, exercises_of
from carpus.core.hand.protocols import PROTOCOLS, MarkerProtocol, protocol_named
from carpus.core.records.set_up import PRACTICE_PATIENT, ExerciseSet, SetUp, begun
from carpus.core.records.values import Patient
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import GoalProposal, Goals, proposals
from carpus.core.rounding import written
from carpus.core.types import Side
from carpus.ui import numbers, terms
from carpus.ui.controls.button import ENTER, Button, is_enter, press
from carpus.ui.controls.card import Card
from carpus.ui.controls.field import Choices, DegreesField, number_field
from carpus.ui.controls.layouts import STRETCH, fill, in_column, in_line, scrolled
from carpus.ui.controls.text import SEMIBOLD, Text, caption, heading
from carpus.ui.figures import figure_of
from carpus.ui.forms import Field, Form, choice_rule
from carpus.ui.setup.option import Options
from carpus.ui.setup.set_words import set_words
from carpus.ui.theme import MARGIN_PX, Theme
from carpus.ui.translate import inside, say, tr

MOST_REPETITIONS, MOST_TARGET_DEG = 50, 90
_NONE = (math.nan, math.nan)
_TARGETS = ("target_positive_deg", "target_negative_deg")


class ExerciseScreen(QWidget):
    """``ready`` carries the :class:`SetUp`."""

    ready = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._row: Patient | None = None
        self._goals: Goals = {}
        self._history: tuple[SessionFigures, ...] = ()
        self._proposed: tuple[GoalProposal, ...] = ()
        self.protocol = Choices(theme, [(one.name, terms.protocol_name(one)) for one in PROTOCOLS])
        self._sets: tuple[ExerciseSet, ...] = ()
        self.lists: dict[str, Options] = {}
        self._offered = QVBoxLayout()
        self._offer()
        self.sets_button = Button(theme, self.tr("Sets of exercises…"), "plain", height_px=40)
        self.problem = Text(theme, "", 14, token="bad", wrap=True)
        self.view = Text(theme, "", 14, token="text2", wrap=True)
        self.proposal = Text(theme, "", 14, token="text2", wrap=True)
        self.accept = Button(theme, self.tr("Use as targets"), "plain", height_px=36)
        self.pictures_cost = caption(theme, wrap=True)
        self.primary = Button(theme, self.tr("Next: the camera"), "primary", icon="arrow-right", hint=ENTER)
        self.targets = tuple(
            DegreesField(theme, MOST_TARGET_DEG, self.tr("no target"), direction) for direction in (1.0, -1.0)
        )
        self.asked = Form(theme, self._table(theme))
        self._lay_out()
        self.protocol.chosen.connect(self._show_protocol)
        self.primary.clicked.connect(self._go_on)
        self.asked["side"].chosen.connect(lambda _: self._show_goals())
        self.accept.clicked.connect(self._use_proposal)
        self.asked.changed.connect(self._judge)
        theme.changed.connect(self._fit)
        self._fit()

    def _table(self, theme: Theme) -> list[Field]:
        """What is chosen beside the exercise; each field an attribute of a :class:`SetUp`."""
        up, down = self.targets
        return [
            Field(
                "side", self.tr("Hand that is measured"),
                Choices(theme, [(side, terms.side_name(side)) for side in ("right", "left")]),
                choice_rule(self.tr("Which hand is measured?")),
            ),
            Field(
                "repetitions", self.tr("Repetitions"), number_field(theme, MOST_REPETITIONS, nothing=self.tr("none"))
            ),
            Field("target_positive_deg", " ", up, lambda _: up.problem if up.isVisibleTo(self) else ""),
            Field(
                "target_negative_deg", " ", down, lambda _: down.problem if down.isVisibleTo(self) else "",
                follows=True,
            ),
            Field(
                "ends_free", self.tr("End joints of the fingers"),
                Choices(theme, [(False, self.tr("Inferred")), (True, self.tr("Measured"))]),
            ),
            Field(
                "for_child", self.tr("The patient’s view is for"),
                Choices(theme, [(False, self.tr("Adult")), (True, self.tr("Child"))]),
            ),
            Field(
                "keep_pictures", self.tr("Keep the pictures too"),
                Choices(theme, [(False, self.tr("No")), (True, self.tr("Yes"))]),
            ),
        ]  # fmt: skip

    def _lay_out(self) -> None:
        theme = self._theme
        left = in_column(heading(theme, self.tr("Which exercise?")), self.protocol, gap=16)
        fill(left, (scrolled(self._offered), 1), (self.sets_button, 0, Qt.AlignmentFlag.AlignLeft))
        self._card = Card(theme, 24)
        self._card.body.setSpacing(12)
        self._card.body.addWidget(Text(theme, self.tr("This set"), 20, SEMIBOLD))
        side, repetitions, targets, *others = self.asked.lines()
        body = in_column(
            side, repetitions, targets, self.problem, self.view, self.proposal,
            (self.accept, 0, Qt.AlignmentFlag.AlignLeft), *others, self.pictures_cost, STRETCH, gap=16,
        )  # fmt: skip
        fill(self._card.body, (scrolled(body), 1), self.primary)
        columns = in_line(
            (left, 1), gap=MARGIN_PX, margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4), within=self
        )
        columns.addWidget(self._card)

    def _offer(self) -> None:
        """A list for each set of discs: its exercises, then the sets of them."""
        for old in self.lists.values():
            self._offered.removeWidget(old)
            old.hide()
            old.deleteLater()
        self.lists = {one.name: Options(self._theme, _rows(one, self._sets)) for one in PROTOCOLS}
        for options in self.lists.values():
            self._offered.addWidget(options, 1)
            options.chosen.connect(self._show_exercise)
            options.accepted.connect(self._go_on)

    def show_sets(self, sets: Sequence[ExerciseSet], chosen_id: str = "") -> None:
        """What is offered beside the single exercises, and which one is chosen from now on."""
        chosen = _set_id(chosen_id) if chosen_id else self.exercises.value()
        count = self.asked["repetitions"].value()
        self._sets = tuple(sets)
        self._offer()
        known = [name for name, _, _ in _rows(protocol_named(str(self.protocol.value())), self._sets)]
        if chosen in known:
            self.exercises.choose(chosen)
        self._show_protocol()
        if chosen == self.exercises.value() and self._set(chosen) is None:
            self.asked["repetitions"].setValue(count)

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(376))

    def begin(
        self, row: Patient, last: SetUp | None, side: Side | None, keep_pictures: bool,
        mb_per_minute: float = math.nan, room_minutes: float = math.nan, goals: Goals | None = None,
    ) -> None:  # fmt: skip
        """Show for a patient, with the last set-up or the usual one; ``side`` None must be chosen by the person.

        ``mb_per_minute`` is what pictures cost, ``room_minutes`` for how long there is room for them."""
        if math.isfinite(mb_per_minute):
            pattern = self.tr("Needed to see and correct markers later: {size} MB a minute, room for {time}.")
            self.pictures_cost.setText(
                pattern.format(size=written(mb_per_minute), time=numbers.room_left(room_minutes))
            )
        self._row, self._goals, self._history = row, goals or {}, ()
        first = exercises_of(PROTOCOLS[0])[0]
        start = last or SetUp(row.patient_id, row.pseudonym, "right", first, first.repetitions, *_NONE)
        self.choose(start.exercise, start.protocol)
        if start.course is not None and self._set(_set_id(start.course.set_id)) is not None:
            self.exercises.choose(_set_id(start.course.set_id))
            self._show_protocol()
        self.asked.fill(replace(start, keep_pictures=keep_pictures))
        self.asked["side"].choose(side)
        self._judge()

    @property
    def exercises(self) -> Options:
        return self.lists[str(self.protocol.value())]

    def choose(self, exercise: Exercise, protocol: MarkerProtocol | None = None) -> None:
        self.protocol.choose((protocol or exercise.protocol).name)
        self.exercises.choose(exercise.id)
        self._show_protocol()

    def first(self) -> QWidget:
        """What takes the keyboard: Enter alone goes on with what is shown."""
        return self.exercises.current()

    def set_up(self) -> SetUp:
        assert self._row is not None
        exercise, now = self._exercise(), self.asked.values()
        if exercise.angle is None:
            now["target_negative_deg"] = math.nan
        if not exercise.counts:
            now |= {"repetitions": 0, "target_positive_deg": math.nan}
        now["ends_free"] = now["ends_free"] and self._discs().has_fingers
        now["side"] = now["side"] or "right"
        single = SetUp(self._row.patient_id, self._row.pseudonym, exercise=exercise, discs=self._discs().name, **now)
        chosen = self._set(self.exercises.value())
        return begun(chosen, single, self._goals) if chosen is not None else single

    def _set(self, value: object) -> ExerciseSet | None:
        """The set of an entry of the list, None for an exercise."""
        return next((one for one in self._sets if _set_id(one.set_id) == value), None)

    def _discs(self) -> MarkerProtocol:
        return protocol_named(str(self.protocol.value()))

    def _exercise(self) -> Exercise:
        chosen = self._set(self.exercises.value())
        return chosen.parts[0].exercise if chosen is not None else exercise_named(str(self.exercises.value()))

    def _show_exercise(self, exercise_id: object) -> None:
        chosen = self._set(exercise_id)
        exercise = chosen.parts[0].exercise if chosen is not None else exercise_named(str(exercise_id))
        if not exercise.is_allowed_by(self._discs()):
            return  # the list that is not shown
        single, parts = chosen is None, self.asked.parts  # a set brings its own counts; targets come from the goals
        parts["repetitions"].setVisible(single and exercise.counts)
        names = [terms.movement_name(one) for one in SIDES[exercise.angle]] if exercise.angle is not None else []
        names = names or ([figure_of(exercise.joint).long_name] if exercise.joint else [])
        for number, (field, part) in enumerate(zip(self.targets, _TARGETS, strict=True)):
            parts[part].setVisible(single and number < len(names))
            if number < len(names):
                words = self.tr("Target, {movement}").format(movement=inside(names[number]))
                parts[part].name.setText(words)
                field.setAccessibleName(words)
                field.set_least(-MOST_TARGET_DEG if exercise.angle == PRONOSUPINATION else 0)
        if single and exercise.counts:
            self.asked["repetitions"].setValue(exercise.repetitions)
        self._show_goals()
        parts["ends_free"].setVisible(self._discs().has_fingers)
        exercises = [part.exercise for part in chosen.parts] if chosen is not None else [exercise]
        self.asked["ends_free"].choose(any(one.ends_free for one in exercises))
        self.view.say(say(exercise.unseen) if single else "")
        self._judge()

    def show_history(self, patient_id: str, history: Sequence[SessionFigures]) -> None:
        """What was measured before, by which goals are proposed; of somebody else it is not shown."""
        if self._row is not None and self._row.patient_id == patient_id:
            practises = patient_id == PRACTICE_PATIENT  # of anybody else a simulated hand says nothing
            self._history = tuple(one for one in history if practises or not one.simulated)
            self._show_proposal()

    def _side(self) -> Side | None:
        side: Side | None = self.asked["side"].value()
        return side

    def _show_goals(self) -> None:
        """The targets that were last set for this exercise and hand; none leaves the fields empty."""
        side = self._side()
        if self._set(self.exercises.value()) is None and side is not None:
            goals_deg = self._goals.get((self._exercise().id, side), _NONE)
            for field, value in zip(self.targets, goals_deg, strict=True):
                field.set_value(value)
        self._show_proposal()

    def _show_proposal(self) -> None:
        """What the last sessions speak for, in one sentence, and a button that takes it over."""
        side, single = self._side(), self._set(self.exercises.value()) is None
        self._proposed = ()
        if side is not None and single and self._exercise().counts:
            self._proposed = proposals(self._history, self._exercise(), side, self._discs().name)
        self.proposal.setText(proposal_words(self._exercise(), self._proposed))
        self.proposal.setVisible(bool(self._proposed))
        self.accept.setVisible(bool(self._proposed))

    def _use_proposal(self) -> None:
        for one in self._proposed:
            field = self.targets[0 if one.direction > 0 else 1]
            field.set_value(field.direction * one.goal_deg)
        self.primary.setFocus(Qt.FocusReason.OtherFocusReason)  # where Enter stands

    def _show_protocol(self, *_: object) -> None:
        for name, options in self.lists.items():
            options.setVisible(name == self.protocol.value())
        self._show_exercise(self.exercises.value())

    def _judge(self) -> None:
        """What is wrong with a target stands below them, and that a hand is to be chosen on the button."""
        wrong, words = self.asked.fault()
        of_side = wrong is self.asked["side"]
        self.problem.say("" if of_side else words)
        self.primary.setEnabled(not words)
        self.primary.set_face(words if of_side else self.tr("Next: the camera"))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not (is_enter(event) and press(self.primary)):
            super().keyPressEvent(event)

    def _go_on(self) -> None:
        if self.primary.isEnabled():
            self.ready.emit(self.set_up())


def _rows(protocol: MarkerProtocol, sets: Sequence[ExerciseSet]) -> list[tuple[str, str, str]]:
    """What a list offers: the exercises, then the sets of the same discs; value, name and sentence."""
    single = [(item.id, terms.exercise_name(item.id), say(item.asked)) for item in exercises_of(protocol)]
    several = [
        (_set_id(one.set_id), tr("Set: {name}").format(name=say(one.name)), set_words(one))
        for one in sets
        if one.discs == protocol.name
    ]
    return single + several


def _set_id(set_id: str) -> str:
    return f"set:{set_id}"


def proposal_words(exercise: Exercise, proposed: Sequence[GoalProposal]) -> str:
    """Say ``Proposed from the last 3 sessions: flexion 42° (mean 37°; a gain can be told from 47°)``."""
    if not proposed:
        return ""
    parts = [
        tr("{movement} {goal} (mean {mean}; a gain can be told from {told})")
        .format(
            movement=_name(exercise, one),
            goal=numbers.signed_degrees(one.goal_deg),
            mean=numbers.signed_degrees(one.basis_deg),
            told=numbers.signed_degrees(one.told_from_deg),
        )
        .strip()
        for one in proposed
    ]
    sessions = max(one.sessions for one in proposed)
    head = tr("Proposed from the last session:") if sessions == 1 else tr("Proposed from the last {count} sessions:")
    return f"{head.format(count=sessions)} {', '.join(parts)}."


def _name(exercise: Exercise, one: GoalProposal) -> str:
    if exercise.angle is None:
        return ""
    return inside(terms.movement_name(SIDES[exercise.angle][0 if one.direction > 0 else 1]))

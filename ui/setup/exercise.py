"""First step: which exercise, which hand, how often, how far."""

from __future__ import annotations

import math
from collections.abc import Sequence

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
from carpus.ui.controls.field import Choices, DegreesField, Labelled, number_field
from carpus.ui.controls.layouts import STRETCH, fill, in_column, in_line, scrolled
from carpus.ui.controls.text import SEMIBOLD, Text, caption, heading
from carpus.ui.figures import figure_of
from carpus.ui.setup.option import Options
from carpus.ui.setup.set_words import set_words
from carpus.ui.theme import MARGIN_PX, Theme
from carpus.ui.translate import inside, say, tr

MOST_REPETITIONS, MOST_TARGET_DEG = 50, 90
_NONE = (math.nan, math.nan)


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
        self.side = Choices(theme, [(side, terms.side_name(side)) for side in ("right", "left")])
        self.repetitions = number_field(theme, MOST_REPETITIONS, nothing=self.tr("none"))
        self.targets = tuple(DegreesField(theme, MOST_TARGET_DEG, self.tr("no target")) for _ in range(2))
        self.problem = Text(theme, "", 14, token="bad", wrap=True)
        self.proposal = Text(theme, "", 14, token="text2", wrap=True)
        self.accept = Button(theme, self.tr("Use as targets"), "plain", height_px=36)
        self._target_fields = tuple(Labelled(theme, "", field) for field in self.targets)
        self._target_names = tuple(_caption(field) for field in self._target_fields)
        self.ends = Choices(theme, [(False, self.tr("Inferred")), (True, self.tr("Measured"))])
        self._ends_field = Labelled(theme, self.tr("End joints of the fingers"), self.ends)
        self.view = Text(theme, "", 14, token="text2", wrap=True)
        self.audience = Choices(theme, [(False, self.tr("Adult")), (True, self.tr("Child"))])
        self.pictures = Choices(theme, [(False, self.tr("No")), (True, self.tr("Yes"))])
        self.primary = Button(theme, self.tr("Next: the camera"), "primary", icon="arrow-right", hint=ENTER)
        self._lay_out()
        self.protocol.chosen.connect(self._show_protocol)
        self.primary.clicked.connect(self._go_on)
        self.side.chosen.connect(lambda _: self._show_side())
        self.accept.clicked.connect(self._use_proposal)
        for field in self.targets:
            field.textChanged.connect(lambda _: self._show_problem())
        self.problem.hide()
        theme.changed.connect(self._fit)
        self._fit()

    def _lay_out(self) -> None:
        theme = self._theme
        left = in_column(heading(theme, self.tr("Which exercise?")), self.protocol, gap=16)
        fill(left, (scrolled(self._offered), 1), (self.sets_button, 0, Qt.AlignmentFlag.AlignLeft))
        self._card = Card(theme, 24)
        self._card.body.setSpacing(12)
        self._card.body.addWidget(Text(theme, self.tr("This set"), 20, SEMIBOLD))
        body = in_column(Labelled(theme, self.tr("Hand that is measured"), self.side), gap=16)
        self._repetition_field = Labelled(theme, self.tr("Repetitions"), self.repetitions)
        body.addWidget(self._repetition_field)
        row = in_line(gap=16)
        for field in self._target_fields:
            row.addWidget(field)
        fill(
            body,
            row,
            self.problem,
            self.view,
            self.proposal,
            (self.accept, 0, Qt.AlignmentFlag.AlignLeft),
            self._ends_field,
        )
        body.addWidget(Labelled(theme, self.tr("The patient’s view is for"), self.audience))
        body.addWidget(Labelled(theme, self.tr("Keep the pictures too"), self.pictures))
        self.pictures_cost = caption(theme, wrap=True)
        fill(body, self.pictures_cost, STRETCH)
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
        count = self.repetitions.value()
        self._sets = tuple(sets)
        self._offer()
        known = [name for name, _, _ in _rows(protocol_named(str(self.protocol.value())), self._sets)]
        if chosen in known:
            self.exercises.choose(chosen)
        self._show_protocol()
        if chosen == self.exercises.value() and self._set(chosen) is None:
            self.repetitions.setValue(count)

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
        if last is not None:
            self.choose(last.exercise, last.protocol)
            if last.course is not None and self._set(_set_id(last.course.set_id)) is not None:
                self.exercises.choose(_set_id(last.course.set_id))
                self._show_protocol()
        else:
            self.choose(exercises_of(PROTOCOLS[0])[0])
        if side is None:
            self.side.choose(None)
        else:
            self.side.choose(side)
        self.pictures.choose(keep_pictures)
        self.audience.choose(last is not None and last.for_child)
        if last is not None:
            self.repetitions.setValue(last.repetitions)
            self.ends.choose(last.ends_free)
            self._show_targets((last.target_positive_deg, last.target_negative_deg))
        else:
            self._show_targets(_NONE)
        self._show_problem()

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
        exercise = self._exercise()
        side: Side = "left" if self.side.value() == "left" else "right"
        positive, negative = (field.value() for field in self.targets)
        negative = -negative  # the angle's sign, which the person never sees
        if exercise.angle is None:
            negative = math.nan
        if not exercise.counts:
            positive = math.nan
        single = SetUp(
            self._row.patient_id,
            self._row.pseudonym,
            side,
            exercise,
            self.repetitions.value() if exercise.counts else 0,
            positive,
            negative,
            bool(self.pictures.value()),
            self._discs().has_fingers and bool(self.ends.value()),
            self._discs().name,
            bool(self.audience.value()),
        )
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
        if chosen is not None:
            self._show_set(chosen)
            return
        self._repetition_field.setVisible(exercise.counts)
        for number, (field, name) in enumerate(zip(self._target_fields, self._target_names, strict=True)):
            field.setVisible(exercise.angle is not None or (bool(exercise.joint) and number == 0))
            if exercise.joint and number == 0:
                movement = figure_of(exercise.joint).long_name
            elif exercise.angle is not None:
                movement = terms.movement_name(SIDES[exercise.angle][number])
            else:
                continue
            words = self.tr("Target, {movement}").format(movement=inside(movement))
            name.setText(words)
            self.targets[number].setAccessibleName(words)
            self.targets[number].set_least(-MOST_TARGET_DEG if exercise.angle == PRONOSUPINATION else 0)
        if exercise.counts:
            self.repetitions.setValue(exercise.repetitions)
        self._show_goals()
        self._ends_field.setVisible(self._discs().has_fingers)
        self.ends.choose(exercise.ends_free)
        words = say(exercise.unseen)
        self.view.say(words)
        self._show_problem()

    def _show_set(self, chosen: ExerciseSet) -> None:
        """A set brings its own counts; targets come from the goals."""
        for field in (self._repetition_field, *self._target_fields):
            field.hide()
        self._show_proposal()
        self._ends_field.setVisible(self._discs().has_fingers)
        self.ends.choose(any(part.exercise.ends_free for part in chosen.parts))
        self.view.hide()
        self._show_problem()

    def show_history(self, patient_id: str, history: Sequence[SessionFigures]) -> None:
        """What was measured before, by which goals are proposed; of somebody else it is not shown."""
        if self._row is not None and self._row.patient_id == patient_id:
            practises = patient_id == PRACTICE_PATIENT  # of anybody else a simulated hand says nothing
            self._history = tuple(one for one in history if practises or not one.simulated)
            self._show_proposal()

    def _side(self) -> Side | None:
        value = self.side.value()
        return None if value is None else "left" if value == "left" else "right"

    def _show_side(self) -> None:
        self._show_goals()
        self._show_problem()

    def _show_goals(self) -> None:
        """The targets that were last set for this exercise and hand; none leaves the fields empty."""
        side = self._side()
        if self._set(self.exercises.value()) is None and side is not None:
            self._show_targets(self._goals.get((self._exercise().id, side), _NONE))
        self._show_proposal()

    def _show_targets(self, targets_deg: tuple[float, float]) -> None:
        """Each in its own direction, of supination below 0 where it stops short of thumb up."""
        for field, direction, value in zip(self.targets, (1.0, -1.0), targets_deg, strict=True):
            field.set_value(direction * value)

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
            self.targets[0 if one.direction > 0 else 1].set_value(one.goal_deg)
        self._show_problem()
        self.primary.setFocus(Qt.FocusReason.OtherFocusReason)  # where Enter stands

    def _show_protocol(self, *_: object) -> None:
        for name, options in self.lists.items():
            options.setVisible(name == self.protocol.value())
        self._show_exercise(self.exercises.value())

    def _show_problem(self) -> None:
        words = next((field.problem for field in self.targets if field.isVisibleTo(self) and field.problem), "")
        self.problem.say(words)
        to_choose = self.side.value() is None
        self.primary.setEnabled(not words and not to_choose)
        self.primary.set_face(self.tr("Which hand is measured?") if to_choose else self.tr("Next: the camera"))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not (is_enter(event) and press(self.primary)):
            super().keyPressEvent(event)

    def _go_on(self) -> None:
        if self.primary.isEnabled():
            self.ready.emit(self.set_up())


def _caption(field: Labelled) -> Text:
    return next(child for child in field.findChildren(Text))


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

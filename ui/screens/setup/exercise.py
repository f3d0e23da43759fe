"""First step: exercise, hand, repetitions, goals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.model.hand.exercises import (
    DIRECTIONS,
    PRONOSUPINATION,
    Exercise,
    exercises_for_protocol,
    get_exercise,
)
from carpus.core.model.hand.protocols import PROTOCOLS, MarkerProtocol, get_protocol
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import Side
from carpus.core.records.session_setup import PRACTICE_PATIENT, ExerciseSet, SessionSetup, start_set
from carpus.core.records.values import Patient
from carpus.core.results.progress import GoalProposal, Goals, propose_goals
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.button import ENTER_KEY, Button, is_enter_key, press_default
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import ChoiceRow, DegreesField, number_field
from carpus.ui.kit.forms import Field, Form, require_choice
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, row_layout, scroll_column
from carpus.ui.kit.text import SEMIBOLD, Text, caption, heading
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.screens.setup.option import Options
from carpus.ui.screens.setup.set_dialog import part_words
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle

MAX_REPETITIONS, MAX_TARGET_DEG = 50, 90
_NO_GOALS = (math.nan, math.nan)
_TARGET_FIELDS = ("target_positive_deg", "target_negative_deg")


class ExerciseScreen(QWidget):
    """Choice of the exercise; ``set_up_chosen`` carries the :class:`SessionSetup`."""

    set_up_chosen = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._patient: Patient | None = None
        self._goals: Goals = {}
        self._history: tuple[SessionResults, ...] = ()
        self._proposals: tuple[GoalProposal, ...] = ()
        self.protocol = ChoiceRow(theme, [(one.name, terms.protocol_name(one)) for one in PROTOCOLS])
        self._sets: tuple[ExerciseSet, ...] = ()
        self.exercise_lists: dict[str, Options] = {}
        self._list_layout = QVBoxLayout()
        self._build_lists()
        self.sets_button = Button(theme, self.tr("Exercise sets…"), "plain", height_px=40)
        self.problem_label = Text(theme, "", 14, token="bad", wrap=True)
        self.proposal_label = Text(theme, "", 14, token="text2", wrap=True)
        self.proposal_button = Button(theme, self.tr("Use as goals"), "plain", height_px=36)
        self.disk_space_label = caption(theme, wrap=True)
        self.primary_button = Button(theme, self.tr("Next"), "primary", icon="arrow-right", hint=ENTER_KEY)
        self.target_fields = tuple(
            DegreesField(theme, MAX_TARGET_DEG, self.tr("no goal"), direction) for direction in (1.0, -1.0)
        )
        self.form = Form(theme, self._form_fields(theme))
        self._build_layout()
        self.protocol.chosen.connect(self._show_protocol)
        self.primary_button.clicked.connect(self._confirm)
        self.form["side"].chosen.connect(lambda _: self._show_goals())
        self.proposal_button.clicked.connect(self._use_proposal)
        self.form.changed.connect(self._validate)
        theme.changed.connect(self._fit)
        self._fit()

    def _form_fields(self, theme: Theme) -> list[Field]:
        """Return the fields beside the exercise; each is an attribute of :class:`SessionSetup`."""
        up, down = self.target_fields
        return [
            Field(
                "side", self.tr("Hand to measure"),
                ChoiceRow(theme, [(side, terms.side_name(side)) for side in ("right", "left")]),
                require_choice(self.tr("Which hand is measured?")),
            ),
            Field(
                "repetitions", self.tr("Repetitions"), number_field(theme, MAX_REPETITIONS, empty_text=self.tr("none"))
            ),
            Field("target_positive_deg", " ", up, lambda _: up.error if up.isVisibleTo(self) else ""),
            Field(
                "target_negative_deg", " ", down, lambda _: down.error if down.isVisibleTo(self) else "",
                continues_row=True,
            ),
            Field(
                "is_dip_free", self.tr("DIP joints of the fingers"),
                ChoiceRow(theme, [(False, self.tr("Inferred")), (True, self.tr("Measured"))]),
            ),
            Field(
                "for_child", self.tr("The patient’s view is for"),
                ChoiceRow(theme, [(False, self.tr("Adult")), (True, self.tr("Child"))]),
            ),
            Field(
                "stores_frames", self.tr("Also save video"),
                ChoiceRow(theme, [(False, self.tr("No")), (True, self.tr("Yes"))]),
            ),
        ]  # fmt: skip

    def _build_layout(self) -> None:
        theme = self._theme
        left = column_layout(heading(theme, self.tr("Which exercise?")), self.protocol, gap=16)
        fill(left, (scroll_column(self._list_layout), 1), (self.sets_button, 0, Qt.AlignmentFlag.AlignLeft))
        self._card = Card(theme, 24)
        self._card.body.setSpacing(12)
        self._card.body.addWidget(Text(theme, self.tr("This recording"), 20, SEMIBOLD))
        side, repetitions, targets, *others = self.form.layout_rows()
        body = column_layout(
            side, repetitions, targets, self.problem_label, self.proposal_label,
            (self.proposal_button, 0, Qt.AlignmentFlag.AlignLeft), *others, self.disk_space_label, STRETCH, gap=16,
        )  # fmt: skip
        fill(self._card.body, (scroll_column(body), 1), self.primary_button)
        columns = row_layout(
            (left, 1), gap=MARGIN_PX, margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4), parent=self
        )
        columns.addWidget(self._card)

    def _build_lists(self) -> None:
        """Build a list for each protocol: exercises, then sets of exercises."""
        for old in self.exercise_lists.values():
            self._list_layout.removeWidget(old)
            old.hide()
            old.deleteLater()
        self.exercise_lists = {one.name: Options(self._theme, _list_options(one, self._sets)) for one in PROTOCOLS}
        for options in self.exercise_lists.values():
            self._list_layout.addWidget(options, 1)
            options.chosen.connect(self._show_exercise)
            options.accepted.connect(self._confirm)

    def show_sets(self, sets: Sequence[ExerciseSet], chosen_id: str = "") -> None:
        """Show the sets of exercises and choose one."""
        chosen = _set_option_id(chosen_id) if chosen_id else self.exercises.value()
        count = self.form["repetitions"].value()
        self._sets = tuple(sets)
        self._build_lists()
        known = [name for name, _, _ in _list_options(get_protocol(str(self.protocol.value())), self._sets)]
        if chosen in known:
            self.exercises.choose(chosen)
        self._show_protocol()
        if chosen == self.exercises.value() and self._find_set(chosen) is None:
            self.form["repetitions"].setValue(count)

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(376))

    def show_patient(
        self, patient: Patient, last: SessionSetup | None, side: Side | None, keep_pictures: bool,
        mb_per_minute: float = math.nan, room_minutes: float = math.nan, goals: Goals | None = None,
    ) -> None:  # fmt: skip
        """Show a patient with the last set-up or the default one; without a ``side`` a person must choose.

        ``mb_per_minute`` is the size of video, ``room_minutes`` the time for which the disk has space.
        """
        if math.isfinite(mb_per_minute):
            pattern = self.tr("Needed to see and correct markers later. Uses {size} MB per minute; space for {time}.")
            self.disk_space_label.setText(
                pattern.format(size=format_rounded(mb_per_minute), time=numbers.format_recording_time(room_minutes))
            )
        self._patient, self._goals, self._history = patient, goals or {}, ()
        first = exercises_for_protocol(PROTOCOLS[0])[0]
        start = last or SessionSetup(
            patient.patient_id, patient.pseudonym, "right", first, first.repetitions, *_NO_GOALS
        )
        self.choose_exercise(start.exercise, start.protocol)
        if start.set_run is not None and self._find_set(_set_option_id(start.set_run.set_id)) is not None:
            self.exercises.choose(_set_option_id(start.set_run.set_id))
            self._show_protocol()
        self.form.fill(replace(start, stores_frames=keep_pictures))
        self.form["side"].choose(side)
        self._validate()

    @property
    def exercises(self) -> Options:
        return self.exercise_lists[str(self.protocol.value())]

    def choose_exercise(self, exercise: Exercise, protocol: MarkerProtocol | None = None) -> None:
        self.protocol.choose((protocol or exercise.protocol).name)
        self.exercises.choose(exercise.id)
        self._show_protocol()

    def initial_focus(self) -> QWidget:
        """Return the chosen exercise: Enter alone continues with what is shown."""
        return self.exercises.current()

    def set_up(self) -> SessionSetup:
        assert self._patient is not None
        exercise, now = self._find_exercise(), self.form.values()
        if exercise.angle is None:
            now["target_negative_deg"] = math.nan
        if not exercise.has_repetitions:
            now |= {"repetitions": 0, "target_positive_deg": math.nan}
        now["is_dip_free"] = now["is_dip_free"] and self._find_protocol().has_fingers
        now["side"] = now["side"] or "right"
        single = SessionSetup(
            self._patient.patient_id,
            self._patient.pseudonym,
            exercise=exercise,
            protocol_name=self._find_protocol().name,
            **now,
        )
        chosen = self._find_set(self.exercises.value())
        return start_set(chosen, single, self._goals) if chosen is not None else single

    def _find_set(self, value: object) -> ExerciseSet | None:
        """Return the set of a list entry, None for an exercise."""
        return next((one for one in self._sets if _set_option_id(one.set_id) == value), None)

    def _find_protocol(self) -> MarkerProtocol:
        return get_protocol(str(self.protocol.value()))

    def _find_exercise(self) -> Exercise:
        chosen = self._find_set(self.exercises.value())
        return chosen.parts[0].exercise if chosen is not None else get_exercise(str(self.exercises.value()))

    def _show_exercise(self, exercise_id: object) -> None:
        chosen = self._find_set(exercise_id)
        exercise = chosen.parts[0].exercise if chosen is not None else get_exercise(str(exercise_id))
        if not exercise.is_allowed_by(self._find_protocol()):
            return  # the list that is not shown
        # A set brings its own counts; targets come from the goals.
        single, parts = chosen is None, self.form.labelled_widgets
        parts["repetitions"].setVisible(single and exercise.has_repetitions)
        names = [terms.movement_name(one) for one in DIRECTIONS[exercise.angle]] if exercise.angle is not None else []
        names = names or ([find_finger_angle(exercise.joint).long_name] if exercise.joint else [])
        for number, (field, part) in enumerate(zip(self.target_fields, _TARGET_FIELDS, strict=True)):
            parts[part].setVisible(single and number < len(names))
            if number < len(names):
                words = self.tr("Goal, {movement}").format(movement=to_mid_sentence(names[number]))
                parts[part].name.setText(words)
                field.setAccessibleName(words)
                field.set_minimum(-MAX_TARGET_DEG if exercise.angle == PRONOSUPINATION else 0)
        if single and exercise.has_repetitions:
            self.form["repetitions"].setValue(exercise.repetitions)
        self._show_goals()
        parts["is_dip_free"].setVisible(self._find_protocol().has_fingers)
        exercises = [part.exercise for part in chosen.parts] if chosen is not None else [exercise]
        self.form["is_dip_free"].choose(any(one.has_free_dip for one in exercises))
        self._validate()

    def show_history(self, patient_id: str, history: Sequence[SessionResults]) -> None:
        """Propose goals from earlier sessions, if the patient is still the same."""
        if self._patient is not None and self._patient.patient_id == patient_id:
            practises = patient_id == PRACTICE_PATIENT  # of anybody else a simulated hand says nothing
            self._history = tuple(one for one in history if practises or not one.is_simulated)
            self._show_proposal()

    def _find_side(self) -> Side | None:
        side: Side | None = self.form["side"].value()
        return side

    def _show_goals(self) -> None:
        """Show the last goals for this exercise and hand."""
        side = self._find_side()
        if self._find_set(self.exercises.value()) is None and side is not None:
            goals_deg = self._goals.get((self._find_exercise().id, side), _NO_GOALS)
            for field, value in zip(self.target_fields, goals_deg, strict=True):
                field.set_value(value)
        self._show_proposal()

    def _show_proposal(self) -> None:
        side, single = self._find_side(), self._find_set(self.exercises.value()) is None
        self._proposals = ()
        if side is not None and single and self._find_exercise().has_repetitions:
            self._proposals = propose_goals(self._history, self._find_exercise(), side, self._find_protocol().name)
        self.proposal_label.setText(proposal_words(self._find_exercise(), self._proposals))
        self.proposal_label.setVisible(bool(self._proposals))
        self.proposal_button.setVisible(bool(self._proposals))

    def _use_proposal(self) -> None:
        for one in self._proposals:
            field = self.target_fields[0 if one.direction > 0 else 1]
            field.set_value(field.direction * one.goal_deg)
        self.primary_button.setFocus(Qt.FocusReason.OtherFocusReason)  # where Enter stands

    def _show_protocol(self, *_: object) -> None:
        for name, options in self.exercise_lists.items():
            options.setVisible(name == self.protocol.value())
        self._show_exercise(self.exercises.value())

    def _validate(self) -> None:
        """Show a wrong goal below the fields, and a missing hand on the button."""
        wrong, words = self.form.find_error()
        of_side = wrong is self.form["side"]
        self.problem_label.show_text("" if of_side else words)
        self.primary_button.setEnabled(not words)
        self.primary_button.set_label(words if of_side else self.tr("Next"))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not (is_enter_key(event) and press_default(self.primary_button)):
            super().keyPressEvent(event)

    def _confirm(self) -> None:
        if self.primary_button.isEnabled():
            self.set_up_chosen.emit(self.set_up())


def _list_options(protocol: MarkerProtocol, sets: Sequence[ExerciseSet]) -> list[tuple[str, str, str]]:
    """Return value, name and description of each exercise and set of a protocol."""
    single = [
        (item.id, terms.exercise_name(item.id), "\n".join(map(translate_phrase, (item.instruction, item.limit))))
        for item in exercises_for_protocol(protocol)
    ]
    several = [
        (
            _set_option_id(one.set_id),
            tr("Exercise set: {name}").format(name=translate_phrase(one.name)),
            " → ".join(map(part_words, one.parts)),
        )
        for one in sets
        if one.protocol_name == protocol.name
    ]
    return single + several


def _set_option_id(set_id: str) -> str:
    return f"set:{set_id}"


def proposal_words(exercise: Exercise, proposed: Sequence[GoalProposal]) -> str:
    """Format proposed goals, with the mean and the detectable change."""
    if not proposed:
        return ""
    parts = [
        tr("{movement} {goal} (mean {mean}; beyond measurement error from {limit})")
        .format(
            movement=_movement_words(exercise, one),
            goal=numbers.format_signed_degrees(one.goal_deg),
            mean=numbers.format_signed_degrees(one.basis_deg),
            limit=numbers.format_signed_degrees(one.detectable_from_deg),
        )
        .strip()
        for one in proposed
    ]
    sessions = max(one.sessions for one in proposed)
    head = tr("Proposed from the last session:") if sessions == 1 else tr("Proposed from the last {count} sessions:")
    return f"{head.format(count=sessions)} {', '.join(parts)}."


def _movement_words(exercise: Exercise, one: GoalProposal) -> str:
    if exercise.angle is None:
        return ""
    return to_mid_sentence(terms.movement_name(DIRECTIONS[exercise.angle][0 if one.direction > 0 else 1]))

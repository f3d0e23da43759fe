"""First step: which exercise, which hand, how often, how far."""

from __future__ import annotations

import math

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from core.hand.protocols import HAND21, WRIST6
from core.output.exercises import EXERCISES, SIDES, Exercise, exercise_named
from core.types import Side
from ui import terms
from ui.controls.button import Button
from ui.controls.card import Card
from ui.controls.field import Choices, Labelled, number_field
from ui.controls.text import SEMIBOLD, Text, heading
from ui.figures import figure_of
from ui.ports import PatientRow, SetUp
from ui.setup.option import Options
from ui.theme import MARGIN_PX, Theme

MOST_REPETITIONS, MOST_TARGET_DEG = 50, 90


class ExerciseScreen(QWidget):
    """``ready`` carries the :class:`SetUp`."""

    ready = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._row: PatientRow | None = None
        protocols: list[tuple[object, str]] = [
            (WRIST6.name, self.tr("Wrist · 6 markers")),
            (HAND21.name, self.tr("Whole hand · 21 markers")),
        ]
        self.protocol = Choices(theme, protocols)
        self.lists = {str(name): _exercises_of(theme, str(name)) for name, _ in protocols}
        sides: list[tuple[object, str]] = [("right", terms.side_name("right")), ("left", terms.side_name("left"))]
        self.side = Choices(theme, sides)
        self.repetitions = number_field(theme, MOST_REPETITIONS, nothing=self.tr("none"))
        self.targets = tuple(number_field(theme, MOST_TARGET_DEG, "°", self.tr("none")) for _ in range(2))
        self._target_fields = tuple(Labelled(theme, "", field) for field in self.targets)
        self._target_names = tuple(_caption(field) for field in self._target_fields)
        keep: list[tuple[object, str]] = [(False, self.tr("No")), (True, self.tr("Yes, 600 MB a minute"))]
        self.pictures = Choices(theme, keep)
        self.primary = Button(theme, self.tr("Next: the camera"), "primary", icon="arrow-right", hint=self.tr("Enter"))
        self._lay_out()
        for options in self.lists.values():
            options.chosen.connect(self._show_exercise)
            options.accepted.connect(self._go_on)
        self.protocol.chosen.connect(self._show_protocol)
        self.primary.clicked.connect(self._go_on)
        theme.changed.connect(self._fit)
        self._fit()

    def _lay_out(self) -> None:
        theme = self._theme
        left = QVBoxLayout()
        left.setSpacing(16)
        left.addWidget(heading(theme, self.tr("Which exercise?")))
        left.addWidget(self.protocol)
        for options in self.lists.values():
            left.addWidget(options, 1)
        self._card = Card(theme, 24)
        body = self._card.body
        body.setSpacing(16)
        body.addWidget(Text(theme, self.tr("This set"), 20, SEMIBOLD))
        body.addWidget(Labelled(theme, self.tr("Hand that is measured"), self.side))
        self._repetition_field = Labelled(theme, self.tr("Repetitions"), self.repetitions)
        body.addWidget(self._repetition_field)
        row = QHBoxLayout()
        row.setSpacing(16)
        for field in self._target_fields:
            row.addWidget(field)
        body.addLayout(row)
        body.addWidget(Labelled(theme, self.tr("Keep the pictures too"), self.pictures))
        body.addStretch(1)
        body.addWidget(self.primary)
        columns = QHBoxLayout(self)
        columns.setContentsMargins(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4)
        columns.setSpacing(MARGIN_PX)
        columns.addLayout(left, 1)
        columns.addWidget(self._card)

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(376))

    def begin(self, row: PatientRow, last: SetUp | None, side: Side, keep_pictures: bool) -> None:
        """Show for a patient, with the last set-up or the usual one."""
        self._row = row
        exercise = last.exercise if last is not None else EXERCISES[0]
        self.choose(exercise)
        self.side.choose(side)
        self.pictures.choose(keep_pictures)
        if last is not None:
            self.repetitions.setValue(last.repetitions)
            for field, value in zip(self.targets, (last.target_positive_deg, last.target_negative_deg), strict=True):
                field.setValue(round(abs(value)) if math.isfinite(value) else 0)

    @property
    def exercises(self) -> Options:
        """The exercises of the markers chosen."""
        return self.lists[str(self.protocol.value())]

    def choose(self, exercise: Exercise) -> None:
        """Show an exercise as the chosen one."""
        self.protocol.choose(exercise.protocol.name)
        self.exercises.choose(exercise.id)
        self._show_protocol()

    def first(self) -> QWidget:
        """What takes the keyboard: Enter alone goes on with what is shown."""
        return self.exercises.current()

    def set_up(self) -> SetUp:
        """What is chosen."""
        assert self._row is not None
        exercise = self._exercise()
        side: Side = "left" if self.side.value() == "left" else "right"
        positive, negative = (float(field.value()) or math.nan for field in self.targets)
        negative = -negative  # the angle's sign, which the person never sees
        if exercise.angle is None:
            negative = math.nan
        if not exercise.counts:
            positive = math.nan
        return SetUp(
            self._row.patient_id,
            self._row.pseudonym,
            side,
            exercise,
            self.repetitions.value() if exercise.counts else 0,
            positive,
            negative,
            bool(self.pictures.value()),
        )

    def _exercise(self) -> Exercise:
        return exercise_named(str(self.exercises.value()))

    def _show_exercise(self, exercise_id: object) -> None:
        exercise = exercise_named(str(exercise_id))
        if exercise.protocol.name != self.protocol.value():
            return  # the list that is not shown
        self._repetition_field.setVisible(exercise.counts)
        for number, (field, name) in enumerate(zip(self._target_fields, self._target_names, strict=True)):
            field.setVisible(exercise.angle is not None or (bool(exercise.joint) and number == 0))
            if exercise.joint and number == 0:
                words = self.tr("Target, {movement}").format(movement=_lower(figure_of(exercise.joint).long_name))
                name.setText(words)
                self.targets[number].setAccessibleName(words)
            elif exercise.angle is not None:
                words = self.tr("Target, {movement}").format(
                    movement=terms.movement_name(SIDES[exercise.angle][number]).lower()
                )
                name.setText(words)
                self.targets[number].setAccessibleName(words)
        if exercise.counts:
            self.repetitions.setValue(exercise.repetitions)

    def _show_protocol(self, *_: object) -> None:
        for name, options in self.lists.items():
            options.setVisible(name == self.protocol.value())
        self._show_exercise(self.exercises.value())

    def _go_on(self) -> None:
        self.ready.emit(self.set_up())


def _caption(field: Labelled) -> Text:
    return next(child for child in field.findChildren(Text))


def _exercises_of(theme: Theme, protocol: str) -> Options:
    rows = [item for item in EXERCISES if item.protocol.name == protocol]
    return Options(
        theme, [(item.id, terms.exercise_name(item.id), terms.exercise_instruction(item.id)) for item in rows]
    )


def _lower(words: str) -> str:
    return words[:1].lower() + words[1:]

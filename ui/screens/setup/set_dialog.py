"""Sets of exercises: their words, and the dialog for name, exercises, repetitions or time, rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import zip_longest
from uuid import uuid4

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.core.model.hand.exercises import exercises_for_protocol, get_exercise
from carpus.core.model.hand.protocols import get_protocol
from carpus.core.records.session_setup import (
    MAX_NAME_CHARACTERS,
    MAX_PARTS,
    MAX_REPETITIONS,
    MAX_REST_S,
    MAX_SECONDS,
    ExerciseSet,
    SetPart,
)
from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import Combo, LabelledField, number_field
from carpus.ui.kit.layouts import STRETCH, column_layout, grid_layout, row_layout, scroll_column
from carpus.ui.kit.text import Text, caption
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.words import terms

DEFAULT_SECONDS = 60


def part_words(part: SetPart) -> str:
    """Format a part: ``Full fist, 10 times``; ``Free movement, 60 s``."""
    if part.repetitions:
        pattern = tr("{exercise}, {count} times")
        return pattern.format(exercise=terms.exercise_name(part.exercise.id), count=part.repetitions)
    return tr("{exercise}, {count} s").format(exercise=terms.exercise_name(part.exercise.id), count=part.seconds)


class PartRow(QObject):
    """One exercise of the set, with repetitions or time, and the rest after it."""

    def __init__(self, theme: Theme, parent: QObject) -> None:
        super().__init__(parent)
        self.exercise, self.unit = Combo(), Combo()
        self.unit.set_choices([(False, self.tr("times")), (True, self.tr("seconds"))])
        self.count = number_field(theme, MAX_SECONDS, minimum=1)
        self.rest = number_field(theme, MAX_REST_S, " s", self.tr("no rest"))
        self.move_up_button = Button(theme, self.tr("Earlier"), "plain", height_px=36)
        self.remove_button = Button(theme, self.tr("Remove"), "plain", height_px=36)
        self.widgets = (self.exercise, self.count, self.unit, self.rest, self.move_up_button, self.remove_button)
        names = (
            self.tr("Exercise"),
            self.tr("How often or how long"),
            self.tr("Times or seconds"),
            self.tr("Rest after it"),
        )
        for widget, name in zip(self.widgets, names, strict=False):
            widget.setAccessibleName(name)
        self.exercise.currentIndexChanged.connect(lambda _: self._restrict_unit())
        self.unit.currentIndexChanged.connect(lambda _: self._restrict_unit())
        self.show_part(None)

    @property
    def is_shown(self) -> bool:
        return not self.exercise.isHidden()

    def show_part(self, part: SetPart | None, discs: str = "") -> None:
        """Show a part with the exercises of a protocol; None hides the row."""
        for widget in self.widgets:
            widget.setVisible(part is not None)
        if part is None:
            return
        exercises = [(one.id, terms.exercise_name(one.id)) for one in exercises_for_protocol(get_protocol(discs))]
        self.exercise.set_choices(exercises, part.exercise.id)
        self.unit.choose(not part.repetitions)
        self._restrict_unit()
        self.count.setValue(part.repetitions or part.seconds)
        self.rest.setValue(part.rest_s)

    def part(self) -> SetPart:
        exercise = get_exercise(str(self.exercise.currentData()))
        timed, count = bool(self.unit.currentData()), self.count.value()
        return SetPart(exercise, 0 if timed else count, count if timed else 0, self.rest.value())

    def _restrict_unit(self) -> None:
        counts = get_exercise(str(self.exercise.currentData())).has_repetitions
        if not counts and not self.unit.currentData():
            self.unit.setCurrentIndex(1)
            self.count.setValue(max(self.count.value(), DEFAULT_SECONDS))
        self.unit.setEnabled(counts)
        self.count.setRange(1, MAX_SECONDS if self.unit.currentData() else MAX_REPETITIONS)


class SetDialog(Dialog):
    """Edits the sets; ``sets_saved`` carries all sets and the id of the one that was changed."""

    sets_saved = Signal(object, str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 920)
        self._sets: list[ExerciseSet] = []
        self._edited_set: ExerciseSet | None = None
        self._protocol_name = ""
        self._is_delete_confirmed = False
        self.rows = [PartRow(theme, self) for _ in range(MAX_PARTS)]
        self.set_choice = Combo()
        self.set_choice.setAccessibleName(self.tr("Exercise set"))
        self.name_field = QLineEdit(maxLength=MAX_NAME_CHARACTERS, placeholderText=self.tr("No patient names"))
        self.name_field.setAccessibleName(self.tr("Name of the set"))
        self.add_button = Button(theme, self.tr("Add an exercise"), "plain", icon="plus", height_px=40)
        self.delete_button = Button(theme, self.tr("Delete this set"), "quiet", icon="trash-2", height_px=40)
        self.problem_label = Text(theme, "", 14, token="bad", wrap=True)
        self.save_button = Button(theme, self.tr("Save the set"), "primary", height_px=44)
        self._grid = grid_layout(8, 8, stretches=(1,))
        self._build_layout()
        self.set_choice.currentIndexChanged.connect(lambda _: self._load_chosen())
        self.name_field.textEdited.connect(lambda _: self._validate())
        self.add_button.clicked.connect(self._add_part)
        self.delete_button.clicked.connect(self._delete_set)
        self.save_button.clicked.connect(self._save)

    def _build_layout(self) -> None:
        theme, body = self._theme, self.card.body
        words = self.tr(
            "Exercises that run one after the other with the same markers. Each is saved as its own session."
        )
        self.add_heading(self.tr("Exercise sets"), words)
        top = row_layout((LabelledField(theme, self.tr("Exercise set"), self.set_choice), 1), gap=16)
        top.addWidget(LabelledField(theme, self.tr("Name of the set"), self.name_field), 1)
        body.addLayout(top)
        for column, head in enumerate((self.tr("Exercise"), self.tr("How much"), "", self.tr("Rest after it"))):
            self._grid.addWidget(caption(theme, head), 0, column)
        for number, row in enumerate(self.rows):
            for column, widget in enumerate(row.widgets):
                self._grid.addWidget(widget, number + 1, column)
            row.move_up_button.setEnabled(number > 0)
            row.move_up_button.clicked.connect(partial(self._move_up, number))
            row.remove_button.clicked.connect(partial(self._remove_part, number))
        rows = column_layout(self._grid, STRETCH)
        area = scroll_column(rows)
        area.setMinimumHeight(theme.px(190))
        body.addWidget(area, 1)
        body.addWidget(self.problem_label)
        self.close_button = self.add_buttons(
            self.save_button, self.add_button, self.delete_button, cancel_text=self.tr("Close"), gap=None
        )

    def open_sets(self, sets: Sequence[ExerciseSet], discs: str, chosen_id: str = "") -> None:
        """Open with the sets of one protocol; the others stay as they are."""
        self._sets, self._protocol_name = list(sets), discs
        self._fill_choice(chosen_id)
        self.open(self.set_choice)

    def _sets_of_protocol(self) -> list[ExerciseSet]:
        return [one for one in self._sets if one.protocol_name == self._protocol_name]

    def _fill_choice(self, chosen_id: str) -> None:
        own = [(one.set_id, translate_phrase(one.name)) for one in self._sets_of_protocol()]
        self.set_choice.set_choices([*own, ("", self.tr("New set"))], chosen_id or None)
        self._load_chosen()

    def _load_chosen(self) -> None:
        known = next((one for one in self._sets_of_protocol() if one.set_id == self.set_choice.currentData()), None)
        first = exercises_for_protocol(get_protocol(self._protocol_name))[0]
        self._edited_set = known or ExerciseSet(str(uuid4()), "", self._protocol_name, (SetPart(first),))
        self._is_delete_confirmed = False
        self.delete_button.set_label(self.tr("Delete this set"))
        self.delete_button.setEnabled(known is not None)
        self.name_field.setText(translate_phrase(self._edited_set.name))
        self._show_parts(self._edited_set.parts)

    def _show_parts(self, parts: Sequence[SetPart]) -> None:
        for row, part in zip_longest(self.rows, parts):
            row.show_part(part, self._protocol_name)
        self.add_button.setEnabled(len(parts) < MAX_PARTS)
        self._validate()

    def _parts(self) -> list[SetPart]:
        return [row.part() for row in self.rows if row.is_shown]

    def _move_up(self, number: int, *_: object) -> None:
        parts = self._parts()
        parts.insert(number - 1, parts.pop(number))
        self._show_parts(parts)
        self.rows[number - 1].exercise.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remove_part(self, number: int, *_: object) -> None:
        parts = self._parts()
        del parts[number]
        self._show_parts(parts)
        first = self.rows[min(number, len(parts) - 1)].exercise if parts else self.add_button
        first.setFocus(Qt.FocusReason.OtherFocusReason)

    def _add_part(self) -> None:
        parts = self._parts()
        last = parts[-1] if parts else SetPart(exercises_for_protocol(get_protocol(self._protocol_name))[0])
        self._show_parts([*parts, last])
        self.rows[len(parts)].exercise.setFocus(Qt.FocusReason.OtherFocusReason)

    def _read_set(self) -> ExerciseSet:
        assert self._edited_set is not None
        return replace(self._edited_set, name=self.name_field.text().strip(), parts=tuple(self._parts()))

    def _validate(self) -> None:
        shown = self._read_set()
        words = {"name": self.tr("Enter a name for the set."), "parts": self.tr("Add an exercise to the set."), "": ""}
        taken = any(one.name == shown.name and one.set_id != shown.set_id for one in self._sets_of_protocol())
        problem = words[shown.problem] or (self.tr("Another set has this name.") if taken else "")
        self.problem_label.setText(problem)
        self.save_button.setEnabled(not problem)

    def _save(self) -> None:
        shown = self._read_set()
        known = [one.set_id for one in self._sets]
        if shown.set_id in known:
            self._sets[known.index(shown.set_id)] = shown
        else:
            self._sets.append(shown)
        self.close_dialog()
        self.sets_saved.emit(tuple(self._sets), shown.set_id)

    def _delete_set(self) -> None:
        assert self._edited_set is not None
        if not self._is_delete_confirmed:
            self._is_delete_confirmed = True
            self.delete_button.set_label(
                self.tr("Delete “{name}”? Press again").format(name=translate_phrase(self._edited_set.name))
            )
            return
        self._sets = [one for one in self._sets if one.set_id != self._edited_set.set_id]
        self.sets_saved.emit(tuple(self._sets), "")
        self._fill_choice("")

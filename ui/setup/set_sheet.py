"""Where a therapist puts sets of exercises together: name, exercises, how often or how long, rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import zip_longest

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.core.hand.exercises import exercise_named, exercises_of
from carpus.core.hand.protocols import protocol_named
from carpus.core.records.set_up import (
    MOST_NAME,
    MOST_PARTS,
    MOST_REPETITIONS,
    MOST_REST_S,
    MOST_SECONDS,
    CoursePart,
    ExerciseSet,
    new_set_id,
)
from carpus.ui import terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.field import Combo, Labelled, number_field
from carpus.ui.controls.layouts import STRETCH, in_column, in_grid, in_line, scrolled
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import Text, caption
from carpus.ui.theme import Theme
from carpus.ui.translate import say

USUAL_SECONDS = 60


class PartRow(QObject):
    """One exercise of the set: which, how often or how long, rest after it, earlier, away."""

    def __init__(self, theme: Theme, parent: QObject) -> None:
        super().__init__(parent)
        self.exercise, self.unit = Combo(), Combo()
        self.unit.offer([(False, self.tr("times")), (True, self.tr("seconds"))])
        self.count = number_field(theme, MOST_SECONDS, least=1)
        self.rest = number_field(theme, MOST_REST_S, " s", self.tr("no rest"))
        self.earlier = Button(theme, self.tr("Earlier"), "plain", height_px=36)
        self.remove = Button(theme, self.tr("Remove"), "plain", height_px=36)
        self.widgets = (self.exercise, self.count, self.unit, self.rest, self.earlier, self.remove)
        names = (
            self.tr("Exercise"),
            self.tr("How often or how long"),
            self.tr("Times or seconds"),
            self.tr("Rest after it"),
        )
        for widget, name in zip(self.widgets, names, strict=False):
            widget.setAccessibleName(name)
        self.exercise.currentIndexChanged.connect(lambda _: self._keep_possible())
        self.unit.currentIndexChanged.connect(lambda _: self._keep_possible())
        self.show(None)

    @property
    def is_shown(self) -> bool:
        return not self.exercise.isHidden()

    def show(self, part: CoursePart | None, discs: str = "") -> None:
        """An exercise of those for these discs; nothing hides the row."""
        for widget in self.widgets:
            widget.setVisible(part is not None)
        if part is None:
            return
        exercises = [(one.id, terms.exercise_name(one.id)) for one in exercises_of(protocol_named(discs))]
        self.exercise.offer(exercises, part.exercise.id)
        self.unit.choose(not part.repetitions)
        self._keep_possible()
        self.count.setValue(part.repetitions or part.seconds)
        self.rest.setValue(part.rest_s)

    def part(self) -> CoursePart:
        exercise = exercise_named(str(self.exercise.currentData()))
        timed, count = bool(self.unit.currentData()), self.count.value()
        return CoursePart(exercise, 0 if timed else count, count if timed else 0, self.rest.value())

    def _keep_possible(self) -> None:
        counts = exercise_named(str(self.exercise.currentData())).counts
        if not counts and not self.unit.currentData():
            self.unit.setCurrentIndex(1)
            self.count.setValue(max(self.count.value(), USUAL_SECONDS))
        self.unit.setEnabled(counts)
        self.count.setRange(1, MOST_SECONDS if self.unit.currentData() else MOST_REPETITIONS)


class SetSheet(Sheet):
    """``kept`` carries all sets as they are to be from now on, and the one that was made or changed."""

    kept = Signal(object, str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 900)
        self._sets: list[ExerciseSet] = []
        self._now: ExerciseSet | None = None
        self._discs = ""
        self._sure = False
        self.rows = [PartRow(theme, self) for _ in range(MOST_PARTS)]
        self.which = Combo()
        self.which.setAccessibleName(self.tr("Set"))
        self.name = QLineEdit(maxLength=MOST_NAME, placeholderText=self.tr("No names of patients"))
        self.name.setAccessibleName(self.tr("Name of the set"))
        self.add = Button(theme, self.tr("Add an exercise"), "plain", icon="plus", height_px=40)
        self.delete = Button(theme, self.tr("Delete this set"), "quiet", icon="trash-2", height_px=40)
        self.problem = Text(theme, "", 14, token="bad", wrap=True)
        self.keep = Button(theme, self.tr("Keep the set"), "primary", height_px=44)
        self._grid = in_grid(8, 8, shares=(1,))
        self._lay_out()
        self.which.currentIndexChanged.connect(lambda _: self._choose())
        self.name.textEdited.connect(lambda _: self._judge())
        self.add.clicked.connect(self._add)
        self.delete.clicked.connect(self._delete)
        self.keep.clicked.connect(self._keep)

    def _lay_out(self) -> None:
        theme, body = self._theme, self.card.body
        words = self.tr(
            "Exercises that run one after the other with the same markers. Each becomes a session of its own."
        )
        self.head(self.tr("Sets of exercises"), words)
        top = in_line((Labelled(theme, self.tr("Set"), self.which), 1), gap=16)
        top.addWidget(Labelled(theme, self.tr("Name of the set"), self.name), 1)
        body.addLayout(top)
        for column, head in enumerate((self.tr("Exercise"), self.tr("How much"), "", self.tr("Rest after it"))):
            self._grid.addWidget(caption(theme, head), 0, column)
        for number, row in enumerate(self.rows):
            for column, widget in enumerate(row.widgets):
                self._grid.addWidget(widget, number + 1, column)
            row.earlier.setEnabled(number > 0)
            row.earlier.clicked.connect(partial(self._earlier, number))
            row.remove.clicked.connect(partial(self._remove, number))
        rows = in_column(self._grid, STRETCH)
        area = scrolled(rows)
        area.setMinimumHeight(theme.px(190))
        body.addWidget(area, 1)
        body.addWidget(self.problem)
        self.close_button = self.answer_row(self.keep, self.add, self.delete, words=self.tr("Close"), gap=None)

    def begin(self, sets: Sequence[ExerciseSet], discs: str, chosen_id: str = "") -> None:
        """Open with the sets of these discs; the others are kept as they are."""
        self._sets, self._discs = list(sets), discs
        self._fill(chosen_id)
        self.open(self.which)

    def _own(self) -> list[ExerciseSet]:
        return [one for one in self._sets if one.discs == self._discs]

    def _fill(self, chosen_id: str) -> None:
        own = [(one.set_id, say(one.name)) for one in self._own()]
        self.which.offer([*own, ("", self.tr("New set"))], chosen_id or None)
        self._choose()

    def _choose(self) -> None:
        known = next((one for one in self._own() if one.set_id == self.which.currentData()), None)
        first = exercises_of(protocol_named(self._discs))[0]
        self._now = known or ExerciseSet(new_set_id(), "", self._discs, (CoursePart(first),))
        self._sure = False
        self.delete.set_face(self.tr("Delete this set"))
        self.delete.setEnabled(known is not None)
        self.name.setText(say(self._now.name))
        self._show_parts(self._now.parts)

    def _show_parts(self, parts: Sequence[CoursePart]) -> None:
        for row, part in zip_longest(self.rows, parts):
            row.show(part, self._discs)
        self.add.setEnabled(len(parts) < MOST_PARTS)
        self._judge()

    def _parts(self) -> list[CoursePart]:
        return [row.part() for row in self.rows if row.is_shown]

    def _earlier(self, number: int, *_: object) -> None:
        parts = self._parts()
        parts.insert(number - 1, parts.pop(number))
        self._show_parts(parts)
        self.rows[number - 1].exercise.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remove(self, number: int, *_: object) -> None:
        parts = self._parts()
        del parts[number]
        self._show_parts(parts)
        first = self.rows[min(number, len(parts) - 1)].exercise if parts else self.add
        first.setFocus(Qt.FocusReason.OtherFocusReason)

    def _add(self) -> None:
        parts = self._parts()
        last = parts[-1] if parts else CoursePart(exercises_of(protocol_named(self._discs))[0])
        self._show_parts([*parts, last])
        self.rows[len(parts)].exercise.setFocus(Qt.FocusReason.OtherFocusReason)

    def _shown(self) -> ExerciseSet:
        assert self._now is not None
        return replace(self._now, name=self.name.text().strip(), parts=tuple(self._parts()))

    def _judge(self) -> None:
        shown = self._shown()
        words = {"name": self.tr("The set needs a name."), "parts": self.tr("The set needs an exercise."), "": ""}
        taken = any(one.name == shown.name and one.set_id != shown.set_id for one in self._own())
        said = words[shown.problem] or (self.tr("Another set has this name.") if taken else "")
        self.problem.setText(said)
        self.keep.setEnabled(not said)

    def _keep(self) -> None:
        shown = self._shown()
        known = [one.set_id for one in self._sets]
        if shown.set_id in known:
            self._sets[known.index(shown.set_id)] = shown
        else:
            self._sets.append(shown)
        self.close_sheet()
        self.kept.emit(tuple(self._sets), shown.set_id)

    def _delete(self) -> None:
        assert self._now is not None
        if not self._sure:
            self._sure = True
            self.delete.set_face(self.tr("Delete “{name}”? Press again").format(name=say(self._now.name)))
            return
        self._sets = [one for one in self._sets if one.set_id != self._now.set_id]
        self.kept.emit(tuple(self._sets), "")
        self._fill("")

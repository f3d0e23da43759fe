"""Rows of the form: one per measure, grouped, with the previous value and that of the other hand."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from datetime import date

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QComboBox, QGridLayout, QLineEdit, QWidget

from carpus.core.measures.manual_measurements import (
    KAPANDJI,
    MAX_LOCATION_LENGTH,
    MEASURES,
    QUESTIONNAIRES,
    ManualMeasure,
    ManualValue,
    MeasureKey,
    Mode,
    find_latest_entries,
    find_manual_measure,
    previous_value,
    value_on_day,
)
from carpus.core.model.types import Side
from carpus.core.results.manual_proposals import CellKey
from carpus.core.results.measure import Measure
from carpus.ui.kit import numbers
from carpus.ui.kit.card import Separator
from carpus.ui.kit.field import SHOWN_DIGITS, Combo, NumberField, add_inside
from carpus.ui.kit.layouts import grid_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Text, caption
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.by_hand.finger_grid import FingerGrid
from carpus.ui.words import terms
from carpus.ui.words.manual_values import (
    direction_words,
    entry_error,
    entry_warning,
    group_names,
    history_words,
    kapandji_stages,
    measure_name,
    mode_name,
    unit_name,
    value_words,
)
from carpus.ui.words.ranges import LOWER_BOUND

FIELD_PX = {"angle": 84, "force": 84, "size": 104, "score": 104}
CARPUS_COLUMN, OTHER_HAND_COLUMN, LAST_COLUMN = 4, 5, 6
"""Columns after the name and up to three fields."""


class MeasureRow(QObject):
    """Fields of one measure and the texts next to them.

    Signals: ``edited``.
    """

    edited = Signal()

    def __init__(self, theme: Theme, measure: ManualMeasure) -> None:
        super().__init__()
        self.measure = measure
        name = measure_name(measure)
        direction = direction_words(measure) if measure.kind == "score" else ""
        self.name = Text(theme, f"{name}, {direction}" if direction else name, 14, REGULAR, wrap=True)
        fields: list[tuple[Mode, int]] = [
            (way, number) for way in measure.modes for number in range(measure.trial_count)
        ]
        self.fields: list[tuple[Mode, ValueField | KapandjiChoice]] = []
        for way, number in fields:
            which = mode_name(way) or (f"{number + 1}" if measure.trial_count > 1 else "")
            field = (
                KapandjiChoice(theme, name) if measure.id == KAPANDJI
                else ValueField(theme, measure, f"{name} {which}".strip(), FIELD_PX[measure.kind])
            )  # fmt: skip
            field.textChanged.connect(lambda _: self._on_edited())
            field.textEdited.connect(lambda _, field=field: self._keep_typed_value(field))
            self.fields.append((way, field))
        self.location_field = QLineEdit(maxLength=MAX_LOCATION_LENGTH, placeholderText=self.tr("location"))
        self.location_field.setAccessibleName(self.tr("{name}: location of the measurement").format(name=name))
        self.location_field.textChanged.connect(lambda _: self._on_edited())
        self._questionnaire = QUESTIONNAIRES.get(measure.id)
        self.answers_field = QLineEdit()
        self.answers_field.textChanged.connect(lambda _: self._count_answers())
        self._answers_error = ""
        """Why the answers typed give no score."""
        self.widgets: list[QWidget] = []
        self.side_text = Text(theme, "", 14, SEMIBOLD)
        self.other_hand_text = Text(theme, "", 14, REGULAR, "text2")
        self.last_text = Text(theme, "", 14, REGULAR, "text2")
        self._carpus_measure: Measure | None = None
        self._value_before = math.nan

    def add_to_grid(self, theme: Theme, grid: QGridLayout, grid_row: int) -> None:
        shown: list[tuple[int, int, QWidget]] = [(0, 1, self.name)]
        if self.measure.id == KAPANDJI:
            shown.append((1, OTHER_HAND_COLUMN, self.fields[0][1]))
        else:
            shown += [(1 + number, 1, field) for number, (_, field) in enumerate(self.fields)]
            shown += [(CARPUS_COLUMN, 1, self.side_text), (OTHER_HAND_COLUMN, 1, self.other_hand_text)]
        if self.measure.kind == "size":
            shown.append((2, 2, self.location_field))
        if self._questionnaire is not None:
            words = self.tr("or {count} answers, {least}–{most}")
            facts = self._questionnaire
            self.answers_field.setPlaceholderText(
                words.format(count=facts.item_count, least=facts.min_answer, most=facts.max_answer)
            )
            self.answers_field.setAccessibleName(
                self.tr("{name}: answers by number").format(name=measure_name(self.measure))
            )
            self.answers_field.setToolTip(
                self.tr("Enter the answers of the paper form in order, with - for no answer. Only the score is saved.")
            )
            shown.append((2, 2, self.answers_field))
        for column, columns, widget in shown:
            grid.addWidget(widget, grid_row, column, 1, columns)
        grid.addWidget(self.last_text, grid_row, LAST_COLUMN, Qt.AlignmentFlag.AlignRight)
        self.widgets = [self.last_text, *(widget for _, _, widget in shown)]

    def _count_answers(self) -> None:
        """Put the score of the answers typed into the field once they are complete, until then the value of before."""
        facts, text = self._questionnaire, self.answers_field.text()
        if facts is None:
            return
        answers = facts.parse_answers(text)
        score = math.nan if answers is None else facts.compute_score(answers)
        known = math.isfinite(score)
        self.fields[0][1].set_value(round(score, self.measure.decimals) if known else self._value_before)
        self.side_text.setText("")
        self._answers_error = ""
        if answers is None:
            self._answers_error = self.tr("not a valid answer")
            self.side_text.setText(self._answers_error)
        elif answers and not known:
            given = [number for number, answer in enumerate(answers, 1) if math.isfinite(answer)]
            missing = _format_runs(sorted({*range(1, facts.item_count + 1)}.difference(given)))
            self._answers_error = self.tr("unanswered questions {numbers}").format(numbers=missing)
            self.side_text.setText(self.tr("{count} of {all}").format(count=len(given), all=facts.item_count))
        self.edited.emit()

    def _keep_typed_value(self, field: ValueField | KapandjiChoice) -> None:
        """Let answers that are not complete bring back the score typed last, as they do a saved one."""
        self._value_before = field.value()

    def keys(self, side: Side) -> list[MeasureKey]:
        return [(self.measure.id, way, side if self.measure.is_per_hand else "") for way in self.measure.modes]

    def show_values(self, values: Sequence[ManualValue], side: Side, day: date, carpus_measure: Measure | None) -> None:
        self._carpus_measure = carpus_measure
        fields = [field for _, field in self.fields]
        for field in (*fields, self.location_field):
            field.blockSignals(True)
        stored = [value_on_day(values, key, day) for key in self.keys(side)]
        none = [math.nan] * self.measure.trial_count
        shown = [
            number for one in stored for number in [*(one.trials if one else ()), *none][: self.measure.trial_count]
        ]
        for field, number in zip(fields, shown, strict=True):
            field.set_value(number)
        self._value_before = shown[0]
        last = [previous_value(values, key, day) for key in self.keys(side)]
        where = stored[0] or last[0]
        self.location_field.setText(where.location if where else "")
        if not self._answers_error:  # while the others were being saved
            self.answers_field.clear()
        for field in (*fields, self.location_field):
            field.blockSignals(False)
        words = " / ".join(value_words(self.measure, one.value) if one else "–" for one in last)
        known = [one for one in last if one]
        self.last_text.setText(f"{numbers.format_day_month(max(one.day for one in known))}: {words}" if known else "")
        history = history_words(values, self.keys(side), day)
        if history:
            self.last_text.setText(" · ".join(filter(None, (self.tr("changed"), self.last_text.text()))))
        self.last_text.setToolTip(history)
        self.last_text.setAccessibleDescription(history)
        self.other_hand_text.setText("")
        if self.measure.is_per_hand and self.measure.kind != "angle":
            other: Side = "left" if side == "right" else "right"
            found = value_on_day(values, self.keys(other)[0], day) or previous_value(values, self.keys(other)[0], day)
            if found:
                pattern = self.tr("{side} {value}")
                value = value_words(self.measure, found.value)
                self.other_hand_text.setText(pattern.format(side=terms.side_name(other), value=value))
        self._update_side_text()

    def read_values(self, side: Side, day: date) -> list[ManualValue]:
        """Return one value per mode, without tries if empty.

        Raises ValueError for an invalid entry.
        """
        found = []
        for key in self.keys(side):
            tries = tuple(f.value() for way, f in self.fields if way == key[1] and not f.is_empty)
            where = self.location_field.text().strip() if self.measure.kind == "size" and tries else ""
            found.append(ManualValue(key[0], key[1], key[2], day, tries, where))  # type: ignore[arg-type]
        return found

    def list_errors(self) -> list[str]:
        errors = [(field.accessibleName(), field.error) for _, field in self.fields]
        errors.append((measure_name(self.measure), self._answers_error))
        return [f"{name}: {error}" for name, error in errors if error]

    def list_warnings(self) -> list[str]:
        return [f"{field.accessibleName()}: {field.warning}" for _, field in self.fields if field.warning]

    def _on_edited(self) -> None:
        self._update_side_text()
        self.edited.emit()

    def _update_side_text(self) -> None:
        """Show the mean of the tries, or Carpus's value.

        Carpus's value appears only after the manual one is entered, so that it does not bias it.
        """
        values = [field.value() for _, field in self.fields if not (field.is_empty or field.error)]
        if self.measure.trial_count > 1:
            mean = sum(values) / len(values) if values else math.nan
            words = value_words(self.measure, mean) if values else ""
            self.side_text.setText(self.tr("mean {value}").format(value=words) if values else "")
        elif self.measure.kind == "angle":
            row, active = self._carpus_measure, self.fields[0][1]
            words = numbers.UNKNOWN
            if row is not None and row.count and not (active.is_empty or active.error):
                words = numbers.format_with_sd(row.mean, row.sd)
                words = words if row.wrist_angle < 0 else terms.end_words(row.mean, row.quantity, row.sd)
            self.side_text.setText(words)


class ManualForm(QWidget):
    """All rows by group.

    Signals: ``edited``, ``measure_edited`` with the measure's name.
    """

    edited = Signal()
    measure_edited = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._grid = grid_layout(12, 6, stretches=(1,), margins=(0, 0, 0, 0), parent=self)
        self.rows: dict[str, MeasureRow] = {}
        """Visible rows from top to bottom."""
        self.fingers = FingerGrid(theme)
        self._rows_by_measure: dict[str, MeasureRow] = {}
        self._grid_rows: dict[str, int] = {}
        """Grid row of each measure, visible or not."""
        self._headings: dict[str, tuple[list[QWidget], int]] = {}
        """Headings of each kind, and the grid row below its measures."""
        for kind, heading in group_names().items():
            line = self._grid.rowCount()
            measures = [one.id for one in MEASURES if one.kind == kind and kind != "finger"]
            self._grid_rows |= {name: line + 2 + number for number, name in enumerate(measures)}
            self._headings[kind] = self._make_heading(kind, heading, line), line + 2 + len(measures)
            if kind == "finger":
                self._add_fingers(line + 2)
            self._grid.setRowMinimumHeight(self._headings[kind][1], 12)

    def _make_heading(self, kind: str, heading: str, line: int) -> list[QWidget]:
        heads = [(0, heading, SEMIBOLD, "text")]
        if kind == "angle":
            heads += [(1, self.tr("Active"), MEDIUM, "text2"), (2, self.tr("Passive"), MEDIUM, "text2")]
            heads += [(CARPUS_COLUMN, self.tr("Carpus"), MEDIUM, "text2")]
        heads += [(LAST_COLUMN, self.tr("previous"), MEDIUM, "text2")] if not self._headings else []
        shown: list[QWidget] = [Separator(self._theme)]
        self._grid.addWidget(shown[0], line + 1, 0, 1, LAST_COLUMN + 1)
        for column, words, weight, token in heads:
            place = Qt.AlignmentFlag.AlignRight if column == LAST_COLUMN else Qt.AlignmentFlag.AlignLeft
            shown.append(Text(self._theme, words, 14 if weight == SEMIBOLD else 12, weight, token))
            self._grid.addWidget(shown[-1], line, column, place)
        return shown

    def _add_fingers(self, line: int) -> None:
        words = self.tr(
            "Extension: − is a deficit, + is hyperextension. Values in italics were measured by Carpus on this day "
            "({sign} = minimum) and are not saved here. Type over them to enter goniometer values."
        )
        legend = Text(self._theme, words.format(sign=LOWER_BOUND), 12, REGULAR, "text2", wrap=True)
        self._headings["finger"][0].extend((self.fingers, legend))
        self._grid.addWidget(self.fingers, line, 0, 1, LAST_COLUMN + 1)
        self._grid.addWidget(legend, line + 1, 0, 1, LAST_COLUMN + 1)
        self._headings["finger"] = self._headings["finger"][0], line + 2
        self.fingers.edited.connect(self.edited)
        self.fingers.edited.connect(self.measure_edited)

    @property
    def has_fingers(self) -> bool:
        """True if the grid of finger joints is shown."""
        return not self.fingers.isHidden()

    @property
    def _entries(self) -> list[MeasureRow | FingerGrid]:
        return [*self.rows.values(), *([self.fingers] if self.has_fingers else [])]

    def keys(self, side: Side) -> list[MeasureKey]:
        """Return the keys of all visible entries of a hand."""
        return [key for entry in self._entries for key in entry.keys(side)]

    def set_measures(self, wanted: set[str]) -> None:
        """Show these measures; rows that stay keep their entries."""
        self.rows = {
            name: self._rows_by_measure.get(name) or self._make_row(name) for name in self._grid_rows if name in wanted
        }
        for name, row in self._rows_by_measure.items():
            for widget in row.widgets:
                widget.setVisible(name in wanted)
        kinds = {find_manual_measure(name).kind for name in wanted}
        for kind, (heads, end) in self._headings.items():
            self._grid.setRowMinimumHeight(end, 12 if kind in kinds else 0)
            for head in heads:
                head.setVisible(kind in kinds)
        for one, following in itertools.pairwise(self.input_fields()):
            QWidget.setTabOrder(one, following)

    def _make_row(self, name: str) -> MeasureRow:
        row = self._rows_by_measure[name] = MeasureRow(self._theme, find_manual_measure(name))
        row.add_to_grid(self._theme, self._grid, self._grid_rows[name])
        row.edited.connect(self.edited)
        for _, field in row.fields:
            field.next_requested.connect(lambda field=field: self._focus_next(field))
            field.textEdited.connect(lambda _: self.measure_edited.emit(name))
        return row

    def input_fields(self) -> list[QWidget]:
        """Return all fields from top to bottom; the grid of the fingers is one of them."""
        fields: list[QWidget] = []
        rows = list(self.rows.values())
        for row in rows:
            fields += (field for _, field in row.fields)
            fields += [row.location_field] if row.measure.kind == "size" else []
            fields += [row.answers_field] if row.measure.id in QUESTIONNAIRES else []
        if self.has_fingers:
            fields.insert(sum(len(row.fields) for row in rows if row.measure.kind == "angle"), self.fingers)
        return fields

    def _focus_next(self, field: QWidget) -> None:
        """Move the focus to the next field; after the last one it stays."""
        fields = self.input_fields()
        following = fields[min(fields.index(field) + 1, len(fields) - 1)]
        following.setFocus(Qt.FocusReason.TabFocusReason)

    def show_values(
        self, values: Sequence[ManualValue], side: Side, day: date, measured: Mapping[CellKey, Measure]
    ) -> None:
        for name, row in self.rows.items():
            row.show_values(values, side, day, measured.get((name, "active")))
        self.fingers.show_values(values, side, day, measured)

    def clear_answers(self) -> None:
        for row in self.rows.values():
            row.answers_field.clear()

    def initial_focus(self) -> QWidget:
        return self.input_fields()[0]

    def list_errors(self) -> list[str]:
        return [words for entry in self._entries for words in entry.list_errors()]

    def list_warnings(self) -> list[str]:
        """Return unusual values to check, such as ``Flexion, passive: 180°? …``."""
        return [words for entry in self._entries for words in entry.list_warnings()]

    def find_changes(self, values: Sequence[ManualValue], side: Side, day: date) -> list[ManualValue]:
        """Return entries that differ from the saved values."""
        found, kept = [], find_latest_entries(values)
        for one in (one for entry in self._entries for one in entry.read_values(side, day)):
            stored = kept.get((one.key, day))
            if not (_is_shown_alike(stored, one) if stored else not one.trials):
                found.append(one)
        return found


def _is_shown_alike(stored: ManualValue, shown: ManualValue) -> bool:
    """Return whether an entry is the stored one, which the form shows with so many digits only."""
    texts = [[numbers.format_significant(value, SHOWN_DIGITS) for value in one.trials] for one in (stored, shown)]
    return texts[0] == texts[1] and stored.location == shown.location


def _format_runs(numbers: Sequence[int]) -> str:
    """Return rising numbers as ``3, 7–11``."""
    runs = [[one for _, one in run] for _, run in itertools.groupby(enumerate(numbers), lambda pair: pair[1] - pair[0])]
    return ", ".join(f"{run[0]}–{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs)


class KapandjiChoice(Combo):
    """Choice of a Kapandji score by what the thumb reaches; empty if not measured."""

    textChanged, textEdited, next_requested = Signal(str), Signal(str), Signal()
    error = warning = ""

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self.setAccessibleName(name)
        self._half_score = math.nan
        """Score between two stages, as it could be typed once; kept until another is chosen."""
        self.set_proposal("")
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.currentTextChanged.connect(self.textChanged)
        self.textActivated.connect(self.textEdited)

    def set_proposal(self, words: str) -> None:
        """Show what a session proposes as long as nothing is chosen."""
        self._proposal = words
        stages = ((score, f"{score}: {stage}") for score, stage in enumerate(kapandji_stages()))
        half = [(self._half_score, numbers.format_fixed(self._half_score, 1))] if self._half_score > 0.0 else []
        self.set_choices([(None, words), *stages, *half], self.currentData())
        self.setToolTip(words)

    @property
    def is_empty(self) -> bool:
        return self.currentData() is None

    def value(self) -> float:
        return math.nan if self.is_empty else float(self.currentData())

    def set_value(self, value: float) -> None:
        """Choose a score; NaN chooses none."""
        if math.isfinite(value) and not value.is_integer():
            self._half_score = value
            self.set_proposal(self._proposal)
            self.setCurrentIndex(self.count() - 1)
        else:
            self.setCurrentIndex(1 + int(value) if math.isfinite(value) else 0)


class ValueField(NumberField):
    """Field for one value, empty if not measured; Enter moves to the next field."""

    next_requested = Signal()

    def __init__(self, theme: Theme, measure: ManualMeasure, name: str, width_px: int) -> None:
        super().__init__(theme, width_px, max_length=8)
        self._measure = measure
        add_inside(self, None, caption(theme, unit_name(measure)), edge_px=9)
        self.setAccessibleName(name)
        self._apply_theme()

    @property
    def error(self) -> str:
        return "" if self.is_empty else entry_error(self._measure, self.value())

    @property
    def warning(self) -> str:
        return "" if self.is_empty else entry_warning(self._measure, self.value())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        plain = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier == Qt.KeyboardModifier.NoModifier
        if plain and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.next_requested.emit()
        else:
            super().keyPressEvent(event)

    def _apply_theme(self) -> None:
        self.setTextMargins(0, 0, self._theme.px(46 if self._measure.unit == "points" else 26), 0)
        super()._apply_theme()

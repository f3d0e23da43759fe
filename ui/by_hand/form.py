"""The rows of the form: one for each measure, in groups, with what was measured last and on the other hand."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from datetime import date

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QGridLayout, QLineEdit, QWidget

from carpus.core.measures.by_hand import (
    MEASURES,
    MOST_WHERE,
    HandMeasure,
    HandValue,
    Key,
    Way,
    before,
    is_unusual,
    measure_named,
    newest,
    on_day,
    replaced,
)
from carpus.core.results.measure import Measure
from carpus.core.types import Side
from carpus.ui import numbers, terms
from carpus.ui.controls.card import Line
from carpus.ui.controls.field import NumberField, lay_inside
from carpus.ui.controls.layouts import in_grid
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Text, caption
from carpus.ui.theme import Theme
from carpus.ui.words.by_hand import direction_words, group_names, measure_name, unit_name, value_words, way_name

FIELD_PX = {"angle": 84, "force": 84, "size": 104, "score": 104}
CARPUS, OTHER, LAST = 4, 5, 6
"""Columns behind the name and up to three fields."""


class MeasureRow(QObject):
    """The fields of one measure and what stands beside them. ``edited`` whenever a field changes."""

    edited = Signal()

    def __init__(self, theme: Theme, measure: HandMeasure) -> None:
        super().__init__()
        self.measure = measure
        name = measure_name(measure)
        self.name = Text(theme, name, 14, REGULAR, wrap=True)
        fields: list[tuple[Way, int]] = [(way, number) for way in measure.ways for number in range(measure.tries)]
        self.fields: list[tuple[Way, ValueField]] = []
        for way, number in fields:
            which = way_name(way) or (f"{number + 1}" if measure.tries > 1 else "")
            field = ValueField(theme, measure, f"{name} {which}".strip(), FIELD_PX[measure.kind])
            field.textChanged.connect(lambda _: self._changed())
            self.fields.append((way, field))
        self.where = QLineEdit(maxLength=MOST_WHERE, placeholderText=self.tr("where"))
        self.where.setAccessibleName(self.tr("{name}: where it was taken").format(name=name))
        self.where.textChanged.connect(lambda _: self._changed())
        self.widgets: list[QWidget] = []
        self.beside = Text(theme, "", 14, SEMIBOLD)
        self.other = Text(theme, "", 14, REGULAR, "text2")
        self.last = Text(theme, "", 14, REGULAR, "text2")
        self._of_carpus: Measure | None = None

    def place(self, theme: Theme, grid: QGridLayout, line: int) -> None:
        aside: dict[str, QWidget] = {
            "size": self.where,
            "score": Text(theme, direction_words(self.measure), 12, MEDIUM, "text2"),
        }
        shown = [(0, self.name), *((1 + number, field) for number, (_, field) in enumerate(self.fields))]
        shown += [(CARPUS, self.beside), (OTHER, self.other)]
        for column, widget in shown:
            grid.addWidget(widget, line, column)
        grid.addWidget(self.last, line, LAST, Qt.AlignmentFlag.AlignRight)
        self.widgets = [self.last, *(widget for _, widget in shown)]
        if self.measure.kind in aside:
            self.widgets.append(aside[self.measure.kind])
            grid.addWidget(self.widgets[-1], line, 2, 1, 2)

    def keys(self, side: Side) -> list[Key]:
        return [(self.measure.id, way, side if self.measure.of_hand else "") for way in self.measure.ways]

    def show(self, values: Sequence[HandValue], side: Side, day: date, of_carpus: Measure | None) -> None:
        self._of_carpus = of_carpus
        fields = [field for _, field in self.fields]
        for field in (*fields, self.where):
            field.blockSignals(True)
        stored = [on_day(values, key, day) for key in self.keys(side)]
        none = [math.nan] * self.measure.tries
        shown = [number for one in stored for number in [*(one.tries if one else ()), *none][: self.measure.tries]]
        for field, number in zip(fields, shown, strict=True):
            field.set_value(number)
        last = [before(values, key, day) for key in self.keys(side)]
        where = stored[0] or last[0]
        self.where.setText(where.where if where else "")
        for field in (*fields, self.where):
            field.blockSignals(False)
        words = " / ".join(value_words(self.measure, one.value) if one else "–" for one in last)
        known = [one for one in last if one]
        self.last.setText(f"{numbers.day_month(max(one.day for one in known))}: {words}" if known else "")
        self._say_earlier(values, side, day)
        self.other.setText("")
        if self.measure.of_hand and self.measure.kind != "angle":
            other: Side = "left" if side == "right" else "right"
            found = on_day(values, self.keys(other)[0], day) or before(values, self.keys(other)[0], day)
            if found:
                pattern = self.tr("{side} {value}")
                value = value_words(self.measure, found.value)
                self.other.setText(pattern.format(side=terms.side_name(other), value=value))
        self._say_beside()

    def _say_earlier(self, values: Sequence[HandValue], side: Side, day: date) -> None:
        """What was entered before for the same day, and by whom."""
        lines = []
        for key in self.keys(side):
            for one in replaced(values, key, day):
                when = numbers.report_date(one.entered.astimezone()) if one.entered else ""
                said = (value_words(self.measure, one.value) if one.tries else self.tr("taken back"), way_name(one.way))
                lines.append(" · ".join(filter(None, (" ".join(filter(None, said)), one.by, when))))
        if lines:
            changed = self.tr("changed")
            self.last.setText(f"{changed} · {self.last.text()}" if self.last.text() else changed)
        self.last.setToolTip(self.tr("Entered before for this day:") + "\n" + "\n".join(lines) if lines else "")
        self.last.setAccessibleDescription(self.last.toolTip())

    def entered(self, side: Side, day: date) -> list[HandValue]:
        """What is written, one for each way, without tries where nothing is. Raises ValueError for what cannot be."""
        found = []
        for key in self.keys(side):
            tries = tuple(f.value() for way, f in self.fields if way == key[1] and not f.is_empty)
            where = self.where.text().strip() if self.measure.kind == "size" and tries else ""
            found.append(HandValue(key[0], key[1], key[2], day, tries, where))  # type: ignore[arg-type]
        return found

    def _changed(self) -> None:
        self._say_beside()
        self.edited.emit()

    def _say_beside(self) -> None:
        """The mean of the tries; Carpus's own value, but only once the hand's is there: nobody shall be led."""
        values = [field.value() for _, field in self.fields if not (field.is_empty or field.problem)]
        if self.measure.tries > 1:
            mean = sum(values) / len(values) if values else math.nan
            words = value_words(self.measure, mean) if values else ""
            self.beside.setText(self.tr("mean {value}").format(value=words) if values else "")
        elif self.measure.kind == "angle":
            row, active = self._of_carpus, self.fields[0][1]
            words = numbers.UNKNOWN
            if row is not None and row.count and not (active.is_empty or active.problem):
                words = numbers.with_spread(row.mean, row.sd)
                words = words if row.angle < 0 else terms.end_words(row.mean, row.what, row.sd)
            self.beside.setText(words)


class HandForm(QWidget):
    """All rows, group by group. ``edited`` whenever something changes, ``chosen`` carries the measure written in."""

    edited = Signal()
    chosen = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._grid = in_grid(12, 6, shares=(1,), margins=(0, 0, 0, 0), within=self)
        self.rows: dict[str, MeasureRow] = {}
        """Those that are shown, from top to bottom."""
        self._made: dict[str, MeasureRow] = {}
        self._places: dict[str, int] = {}
        """Of each measure, shown or not, the line of the grid."""
        self._heads: dict[str, tuple[list[QWidget], int]] = {}
        """Of each kind what stands above its rows, and the line below them."""
        for kind, heading in group_names().items():
            line = self._grid.rowCount()
            measures = [one.id for one in MEASURES if one.kind == kind]
            self._places |= {name: line + 2 + number for number, name in enumerate(measures)}
            self._heads[kind] = self._head(kind, heading, line), line + 2 + len(measures)
            self._grid.setRowMinimumHeight(self._heads[kind][1], 12)

    def _head(self, kind: str, heading: str, line: int) -> list[QWidget]:
        heads = [(0, heading, SEMIBOLD, "text")]
        if kind == "angle":
            heads += [(1, self.tr("Active"), MEDIUM, "text2"), (2, self.tr("Passive"), MEDIUM, "text2")]
            heads += [(CARPUS, self.tr("Carpus"), MEDIUM, "text2")]
        heads += [(LAST, self.tr("last time"), MEDIUM, "text2")] if not self._heads else []
        shown: list[QWidget] = [Line(self._theme)]
        self._grid.addWidget(shown[0], line + 1, 0, 1, LAST + 1)
        for column, words, weight, token in heads:
            place = Qt.AlignmentFlag.AlignRight if column == LAST else Qt.AlignmentFlag.AlignLeft
            shown.append(Text(self._theme, words, 14 if weight == SEMIBOLD else 12, weight, token))
            self._grid.addWidget(shown[-1], line, column, place)
        return shown

    def set_measures(self, wanted: set[str]) -> None:
        """Show these; what is written in rows that stay is kept."""
        self.rows = {name: self._made.get(name) or self._make(name) for name in self._places if name in wanted}
        for name, row in self._made.items():
            for widget in row.widgets:
                widget.setVisible(name in wanted)
        kinds = {row.measure.kind for row in self.rows.values()}
        for kind, (heads, end) in self._heads.items():
            self._grid.setRowMinimumHeight(end, 12 if kind in kinds else 0)
            for head in heads:
                head.setVisible(kind in kinds)
        for one, following in itertools.pairwise(self._entries()):
            QWidget.setTabOrder(one, following)

    def _make(self, name: str) -> MeasureRow:
        row = self._made[name] = MeasureRow(self._theme, measure_named(name))
        row.place(self._theme, self._grid, self._places[name])
        row.edited.connect(self.edited)
        for _, field in row.fields:
            field.onward.connect(lambda field=field: self._go_on(field))
            field.textEdited.connect(lambda _: self.chosen.emit(name))
        return row

    def _entries(self) -> list[QWidget]:
        """What is typed in, line by line."""
        return [
            entry
            for row in self.rows.values()
            for entry in (*(field for _, field in row.fields), *([row.where] if row.measure.kind == "size" else []))
        ]

    def _go_on(self, field: ValueField) -> None:
        """Enter goes to the next field; after the last one it stays."""
        fields = self._entries()
        following = fields[min(fields.index(field) + 1, len(fields) - 1)]
        following.setFocus(Qt.FocusReason.TabFocusReason)

    def show_values(self, values: Sequence[HandValue], side: Side, day: date, of_carpus: Mapping[str, Measure]) -> None:
        for name, row in self.rows.items():
            row.show(values, side, day, of_carpus.get(name))

    def first(self) -> QWidget:
        return next(iter(self.rows.values())).fields[0][1]

    def problems(self) -> list[tuple[ValueField, str]]:
        return [(f, f.problem) for row in self.rows.values() for _, f in row.fields if f.problem]

    def doubts(self) -> list[str]:
        """What should be looked at again: ``Flexion, passive: 180°? …``."""
        return [f"{f.accessibleName()}: {f.warning}" for row in self.rows.values() for _, f in row.fields if f.warning]

    def differing(self, values: Sequence[HandValue], side: Side, day: date) -> list[HandValue]:
        """What is written otherwise than it is stored, to be entered; nothing of what is the same."""
        found, kept = [], newest(values)
        for row in self.rows.values():
            for one in row.entered(side, day):
                stored = kept.get((one.key, day))
                same = (stored.tries, stored.where) == (one.tries, one.where) if stored else not one.tries
                if not same:
                    found.append(one)
        return found


class ValueField(NumberField):
    """A value of a measure, empty for not measured. Enter goes to the next field."""

    onward = Signal()

    def __init__(self, theme: Theme, measure: HandMeasure, name: str, width_px: int) -> None:
        super().__init__(theme, width_px, letters=8)
        self._measure = measure
        lay_inside(self, None, caption(theme, unit_name(measure)), edge_px=9)
        self.setAccessibleName(name)
        self._take_theme()

    @property
    def problem(self) -> str:
        of = self._measure
        if self.is_empty or of.least <= self.value() <= of.most:
            return ""
        pattern = self.tr("A number from {least} to {most}, or empty")
        return pattern.format(least=numbers.figures(of.least, 6), most=value_words(of, of.most))

    @property
    def warning(self) -> str:
        """``180°? Usual is up to 100°``."""
        of, value = self._measure, self.value()
        if self.problem or not math.isfinite(value) or not is_unusual(of, value):
            return ""
        low, high = (value_words(of, end) for end in of.usual)
        return self.tr("{value}? Usual is {low} to {high}").format(value=value_words(of, value), low=low, high=high)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        plain = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier == Qt.KeyboardModifier.NoModifier
        if plain and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.onward.emit()
        else:
            super().keyPressEvent(event)

    def _take_theme(self) -> None:
        self.setTextMargins(0, 0, self._theme.px(46 if self._measure.unit == "points" else 26), 0)
        super()._take_theme()

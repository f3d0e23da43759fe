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
    newest,
    on_day,
    replaced,
)
from carpus.core.results.ranges import RangeRow
from carpus.core.types import Side
from carpus.ui import numbers, terms
from carpus.ui.controls.card import Line
from carpus.ui.controls.field import lay_inside
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
        self.beside = Text(theme, "", 14, SEMIBOLD)
        self.other = Text(theme, "", 14, REGULAR, "text2")
        self.last = Text(theme, "", 14, REGULAR, "text2")
        self._of_carpus: RangeRow | None = None

    def place(self, theme: Theme, grid: QGridLayout, line: int) -> None:
        grid.addWidget(self.name, line, 0)
        for number, (_, field) in enumerate(self.fields):
            grid.addWidget(field, line, 1 + number)
        if self.measure.kind == "size":
            grid.addWidget(self.where, line, 2, 1, 2)
        elif self.measure.kind == "score":
            grid.addWidget(Text(theme, direction_words(self.measure), 12, MEDIUM, "text2"), line, 2, 1, 2)
        grid.addWidget(self.beside, line, CARPUS)
        grid.addWidget(self.other, line, OTHER)
        grid.addWidget(self.last, line, LAST, Qt.AlignmentFlag.AlignRight)

    def keys(self, side: Side) -> list[Key]:
        return [(self.measure.id, way, side if self.measure.of_hand else "") for way in self.measure.ways]

    def show(self, values: Sequence[HandValue], side: Side, day: date, of_carpus: RangeRow | None) -> None:
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
                words = numbers.with_spread(row.mean_deg, row.sd_deg)
                words = words if row.joint else terms.end_words(row.mean_deg, row.movement, row.sd_deg)
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

    def set_measures(self, wanted: set[str]) -> None:
        """Rows for these, in the order of the table of measures; what is written in rows that stay is kept."""
        self.rows = {one.id: self.rows.get(one.id) or self._made(one) for one in MEASURES if one.id in wanted}
        self._empty()
        line = 0
        for kind, heading in group_names().items():
            rows = [row for row in self.rows.values() if row.measure.kind == kind]
            if not rows:
                continue
            heads = [(0, heading, SEMIBOLD, "text")]
            if kind == "angle":
                heads += [(1, self.tr("Active"), MEDIUM, "text2"), (2, self.tr("Passive"), MEDIUM, "text2")]
                heads += [(CARPUS, self.tr("Carpus"), MEDIUM, "text2")]
            heads += [(LAST, self.tr("last time"), MEDIUM, "text2")] if line == 0 else []
            for column, words, weight, token in heads:
                place = Qt.AlignmentFlag.AlignRight if column == LAST else Qt.AlignmentFlag.AlignLeft
                size = 14 if weight == SEMIBOLD else 12
                self._grid.addWidget(Text(self._theme, words, size, weight, token), line, column, place)
            self._grid.addWidget(Line(self._theme), line + 1, 0, 1, LAST + 1)
            line += 2
            for row in rows:
                row.place(self._theme, self._grid, line)
                line += 1
            self._grid.setRowMinimumHeight(line, 12)
            line += 1
        self._chain()

    def _made(self, measure: HandMeasure) -> MeasureRow:
        row = MeasureRow(self._theme, measure)
        row.edited.connect(self.edited)
        for _, field in row.fields:
            field.onward.connect(lambda field=field: self._go_on(field))
            field.textEdited.connect(lambda _, name=measure.id: self.chosen.emit(name))
        return row

    def _empty(self) -> None:
        """Take everything out of the grid; what belongs to no row any more goes."""
        kept = {widget for row in self.rows.values() for widget in self._widgets(row)}
        while (item := self._grid.takeAt(0)) is not None:
            widget = item.widget()
            if widget is not None and widget not in kept:
                widget.hide()
                widget.deleteLater()

    @staticmethod
    def _widgets(row: MeasureRow) -> list[QWidget]:
        return [row.name, row.where, row.beside, row.other, row.last, *(field for _, field in row.fields)]

    def _chain(self) -> None:
        """Tab goes through the fields line by line."""
        fields = [w for row in self.rows.values() for w in self._entries(row)]
        for one in fields:
            one.show()  # now, not when the layout comes to it: the keyboard may be wanted there at once
        for one, following in itertools.pairwise(fields):
            QWidget.setTabOrder(one, following)

    def _go_on(self, field: ValueField) -> None:
        """Enter goes to the next field; after the last one it stays."""
        fields = [w for row in self.rows.values() for w in self._entries(row)]
        following = fields[min(fields.index(field) + 1, len(fields) - 1)]
        following.setFocus(Qt.FocusReason.TabFocusReason)

    @staticmethod
    def _entries(row: MeasureRow) -> list[QWidget]:
        entries: list[QWidget] = [field for _, field in row.fields]
        return [*entries, row.where] if row.measure.kind == "size" else entries

    def show_values(
        self, values: Sequence[HandValue], side: Side, day: date, of_carpus: Mapping[str, RangeRow]
    ) -> None:
        for name, row in self.rows.items():
            row.show(values, side, day, of_carpus.get(name))

    def first(self) -> QWidget:
        return next(iter(self.rows.values())).fields[0][1]

    def problems(self) -> list[tuple[ValueField, str]]:
        return [(f, f.problem) for row in self.rows.values() for _, f in row.fields if f.problem]

    def doubts(self) -> list[str]:
        """What should be looked at again: ``Flexion, passive: 180°? …``."""
        return [f"{f.accessibleName()}: {f.doubt}" for row in self.rows.values() for _, f in row.fields if f.doubt]

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


class ValueField(QLineEdit):
    """A number with a decimal comma or point, empty for not measured. Enter goes to the next field.

    ``problem`` says what cannot be kept, ``doubt`` what should be looked at again; both mark the edge and stand in the
    tooltip."""

    onward = Signal()

    def __init__(self, theme: Theme, measure: HandMeasure, name: str, width_px: int) -> None:
        super().__init__()
        self._theme, self._measure, self._width_px = theme, measure, width_px
        lay_inside(self, None, caption(theme, unit_name(measure)), edge_px=9)
        self.setAccessibleName(name)
        self.setMaxLength(8)
        self.textChanged.connect(lambda _: self._take_theme())
        theme.changed.connect(self._take_theme)
        self._take_theme()

    def value(self) -> float:
        """In the measure's unit; NaN where nothing, or no number, is written."""
        text = self.text().strip().removesuffix("°").strip().replace(",", ".").replace("−", "-")
        try:
            value = float(text)
        except ValueError:
            return math.nan
        return value if math.isfinite(value) else math.nan

    def set_value(self, value: float) -> None:
        """Show a number; NaN empties the field."""
        self.setText(numbers.figures(value, 6) if math.isfinite(value) else "")

    @property
    def is_empty(self) -> bool:
        return not self.text().strip()

    @property
    def problem(self) -> str:
        """Why it cannot be kept; empty when it can."""
        of, value = self._measure, self.value()
        if self.is_empty or of.least <= value <= of.most:
            return ""
        pattern = self.tr("A number from {least} to {most}, or empty")
        return pattern.format(least=numbers.figures(of.least, 6), most=value_words(of, of.most))

    @property
    def doubt(self) -> str:
        """``180°? Usual is up to 100°``; empty where nothing is unusual."""
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
        unit_px = 46 if self._measure.unit == "points" else 26
        self.setTextMargins(0, 0, self._theme.px(unit_px), 0)
        self.setFixedWidth(self._theme.px(self._width_px))
        token = "bad" if self.problem else "warn" if self.doubt else ""
        edge = getattr(self._theme.tokens, token) if token else ""
        self.setStyleSheet(f"QLineEdit {{ border: 2px solid {edge}; }}" if edge else "")
        self.setToolTip(self.problem or self.doubt)
        self.setAccessibleDescription(self.problem or self.doubt)

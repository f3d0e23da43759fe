"""Form for values measured by hand on one day, with their chart."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date, datetime

from PySide6.QtCore import QDate, Qt, QTimer, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QBoxLayout, QDateEdit, QWidget

from carpus.core.measures.manual_measurements import (
    KAPANDJI,
    MEASURES,
    ManualMeasure,
    ManualValue,
    MeasureKey,
    current_values,
    find_manual_measure,
)
from carpus.core.model.types import Side
from carpus.core.records.values import Patient
from carpus.core.results.manual_proposals import CellKey, find_measured_values, propose_kapandji
from carpus.core.results.measure import Measure
from carpus.core.results.norms import GRIP_SOURCE, grip_norm_kg
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.manual_values import ManualValueChart
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import ChoiceRow, Combo, ignore_wheel
from carpus.ui.kit.layouts import (
    STRETCH,
    FittedWidget,
    ScrollArea,
    ScrolledColumn,
    clear_layout,
    column_layout,
    fill,
    row_layout,
)
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.screens.by_hand.form import KapandjiChoice, ManualForm
from carpus.ui.screens.progress.screen import add_change_rows
from carpus.ui.words import terms
from carpus.ui.words.manual_values import find_changes, group_names, measure_name
from carpus.ui.words.terms import to_person

FINGER_MEASURES = {one.id for one in MEASURES if one.kind == "finger"}
_FINGERS = "MCP2_FLEXION"
"""Any of them: all stand in one grid."""


@dataclass(frozen=True, slots=True)
class ManualRecord:
    """Data of a patient for this screen: ``values`` as entered, ``figures`` of the sessions in order of time."""

    patient_id: str
    side: Side
    values: tuple[ManualValue, ...]
    figures: tuple[SessionResults, ...]
    initials: str
    patient: Patient | None = None


class ManualMeasurementsScreen(FittedWidget):
    """Form and chart.

    Signals: ``save_requested`` with the values to save and their warnings.
    """

    save_requested = Signal(object, object)

    def __init__(self, theme: Theme, today: Callable[[], date]) -> None:
        super().__init__()
        self._theme, self._today = theme, today
        day = today()
        self.record = ManualRecord("", "right", (), (), "")
        self._added_measures: set[str] = set()
        self._unsaved: dict[tuple[MeasureKey, date], ManualValue] = {}
        """Unsaved values of other days and the other hand."""
        self._shown: tuple[Side, date] = ("right", day)
        self.title = heading(theme, wrap=True)
        self.basis_text = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.day_field = QDateEdit(QDate(day.year, day.month, day.day))
        ignore_wheel(self.day_field)
        self.day_field.setCalendarPopup(True)
        self.day_field.setDisplayFormat(numbers.qt_date_format())
        self.day_field.setMaximumDate(self.day_field.date())
        self.day_field.setAccessibleName(self.tr("Date of measurement"))
        self.hand_choice = ChoiceRow(theme, [(side, terms.hand_name(side)) for side in ("right", "left")])
        self.form = ManualForm(theme)
        self.measure_choice = Combo()
        self.measure_choice.setAccessibleName(self.tr("Other measures"))
        self.status_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.close_button = Button(theme, self.tr("Close"), "quiet", hint="Esc")
        self.save_button = Button(
            theme, self.tr("Save values"), "primary", icon="check", hint="Ctrl+Enter", height_px=44
        )
        self.chart = ManualValueChart(theme)
        self._changes = Card(theme, 20)
        host = ScrolledColumn()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight, host)
        self._scroll = ScrollArea(host)
        self._build_layout()
        self.day_field.dateChanged.connect(lambda _: self._switch_day_or_hand())
        self.hand_choice.chosen.connect(lambda _: self._switch_day_or_hand())
        self.form.edited.connect(self._on_edited)
        self.form.measure_edited.connect(self._show_course)
        self.form.fingers.currentCellChanged.connect(lambda *_: self._show_current_cell())
        self.measure_choice.activated.connect(self._add_measure)
        self.save_button.clicked.connect(self._request_save)
        for keys in ("Ctrl+Return", "Ctrl+Enter"):
            QShortcut(QKeySequence(keys), self, self.save_button.click)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)

    def _build_layout(self) -> None:
        head = row_layout((self.title, 1), self.day_field, self.hand_choice, gap=12)
        entries = Card(self._theme, 20)
        entries.body.addWidget(self.form)
        course = Card(self._theme, 20)
        course.body.addWidget(self.chart)
        right = column_layout(course, self._changes, STRETCH, gap=GAP_PX)
        self._columns.setContentsMargins(0, 0, 0, 0)
        self._columns.setSpacing(GAP_PX)
        fill(self._columns, (entries, 5, Qt.AlignmentFlag.AlignTop), (right, 4))
        foot = row_layout(self.measure_choice, (self.status_text, 1), self.close_button, self.save_button, gap=12)
        column_layout(
            head,
            2,
            self.basis_text,
            14,
            (self._scroll, 1),
            12,
            foot,
            gap=0,
            margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX),
            parent=self,
        )
        self._theme.changed.connect(self._fit)

    def _fit(self) -> None:
        """Stack the columns with large text."""
        tight = is_tight(self, self._theme) or self.width() < 1180 * self._theme.text_scale
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if tight else directions.LeftToRight)

    # --- what is shown ------------------------------------------------------------------------------------
    @property
    def side(self) -> Side:
        return "left" if self.hand_choice.value() == "left" else "right"

    @property
    def current_day(self) -> date:
        return date(self.day_field.date().year(), self.day_field.date().month(), self.day_field.date().day())

    @property
    def has_unsaved(self) -> bool:
        return bool(self.form.list_errors() or self.list_unsaved())

    def list_unsaved(self) -> list[ManualValue]:
        """Return all unsaved values of every day and hand.

        Raises ValueError for an invalid entry.
        """
        side, day = self._shown
        here = self.form.find_changes(self.record.values, side, day)
        shown = {(key, day) for key in self.form.keys(side)}
        return [*(one for at, one in self._unsaved.items() if at not in shown), *here]

    def restore_unsaved(self, values: Sequence[ManualValue]) -> None:
        """Show unsaved values of before as if just entered."""
        self._unsaved = {(one.key, one.day): one for one in values}
        self._fill()

    def _switch_day_or_hand(self) -> None:
        """Show another day or hand and keep unsaved values; invalid ones must be corrected first."""
        if self.form.list_errors():
            self._select(*self._shown)
            return
        self._unsaved = {(one.key, one.day): one for one in self.list_unsaved()}
        self._fill()

    def _select(self, side: Side, day: date) -> None:
        for widget in (self.day_field, self.hand_choice):
            widget.blockSignals(True)
        self.day_field.setDate(QDate(day.year, day.month, day.day))
        self.hand_choice.choose(side)
        for widget in (self.day_field, self.hand_choice):
            widget.blockSignals(False)

    def show_record(self, record: ManualRecord, *, is_refresh: bool = False) -> None:
        """Show a patient's data; ``is_refresh`` after saving keeps day and hand."""
        self.record = record
        self._unsaved = {}
        if not is_refresh:
            self._added_measures = set()
            self.form.clear_answers()
            today = self._today()  # the program may have stood open over night
            self.day_field.setMaximumDate(QDate(today.year, today.month, today.day))
            self._select(record.side, today)
        self._fill()
        if is_refresh:
            self.status_text.setText(self.tr("Saved."))

    def initial_focus(self) -> QWidget:
        return self.form.initial_focus() if self.form.rows else self

    def _fill(self) -> None:
        self._shown = (self.side, self.current_day)
        usual = {one.id for one in MEASURES if one.is_default}
        if any(figures.joint_ranges for figures in self.record.figures):
            usual.add(_FINGERS)
        if propose_kapandji(self.record.figures, self.side, self.current_day):
            usual.add(KAPANDJI)
        self.form.set_measures(usual | {one.measure for one in self.record.values} | self._added_measures)
        self.form.show_values(self._all_values(), self.side, self.current_day, self._find_measured_values())
        self._fill_more()
        self._show_proposal()
        day = numbers.format_short_date(self.current_day)
        self.title.setText(self.tr("Manual measurements, {day}").format(day=day))
        self._show_basis()
        shown = self.chart.measure.id if self.chart.measure else ""
        is_shown = shown in self.form.rows or (shown in FINGER_MEASURES and self.form.has_fingers)
        self._show_course(shown if is_shown else next(iter(self.form.rows)))
        self._fill_changes()
        self._on_edited()

    def _all_values(self) -> tuple[ManualValue, ...]:
        return (*self.record.values, *self._unsaved.values())

    def _fill_more(self) -> None:
        others = [
            (one.id, measure_name(one))
            for one in MEASURES
            if one.id not in self.form.rows and one.id not in FINGER_MEASURES
        ]
        fingers = [] if self.form.has_fingers else [(_FINGERS, group_names()["finger"])]
        self.measure_choice.set_choices([("", self.tr("Other measures…")), *fingers, *others])
        following = [self.form.input_fields()[-1], self.measure_choice, self.close_button, self.save_button]
        for one, after in itertools.pairwise(following):
            QWidget.setTabOrder(one, after)

    def _show_basis(self) -> None:
        by = self.tr("Entered by {initials}.").format(initials=self.record.initials) if self.record.initials else ""
        words = self.tr("Leave empty what was not measured. These entries do not change values measured by Carpus.")
        simulated = any(one.is_simulated and (one.side, one.when.date()) == self._shown for one in self.record.figures)
        why = self.tr("The Carpus session of this day is simulated and not shown.") if simulated else ""
        zero = terms.thumb_up_words() if {"PRONATION", "SUPINATION"} & set(self.form.rows) else ""
        grip, norm = "", grip_norm_kg(to_person(self.record.patient, self.current_day))
        if norm is not None:
            grip = self.tr(
                "Reference grip strength for this age and sex: {mean} ± {sd} kg ({source}, Smedley dynamometer)."
            )
            mean, sd = (numbers.format_fixed(value, 1) for value in norm)
            grip = grip.format(mean=mean, sd=sd, source=GRIP_SOURCE)
        self.basis_text.setText(" ".join(filter(None, (by, words, zero, why, grip))))

    def _add_measure(self, _number: int) -> None:
        name = str(self.measure_choice.currentData())
        if not name:
            return
        self._added_measures.add(name)
        form, values, side, day = self.form, self._all_values(), self.side, self.current_day
        form.set_measures({*form.rows, *([_FINGERS] if form.has_fingers else []), name})
        field: QWidget = form.fingers
        if name == _FINGERS:
            form.fingers.show_values(values, side, day, self._find_measured_values())
        else:
            form.rows[name].show_values(values, side, day, self._find_measured_values().get((name, "active")))
            field = form.rows[name].fields[0][1]
        self._fill_more()
        self._show_proposal()
        self._show_basis()
        self._show_course(name)
        field.setFocus(Qt.FocusReason.OtherFocusReason)
        QTimer.singleShot(0, self, lambda: self._scroll.ensureWidgetVisible(field))  # laid out only then

    def _show_proposal(self) -> None:
        """Propose a Kapandji score where an opposition was recorded."""
        row = self.form.rows.get(KAPANDJI)
        choice = None if row is None else row.fields[0][1]
        if not isinstance(choice, KapandjiChoice):
            return
        found = propose_kapandji(self.record.figures, self.side, self.current_day)
        words = self.tr("At least {score}: proposed from the recording of {day}")
        choice.set_proposal(
            "" if found is None else words.format(day=numbers.format_day_month(found[1]), score=found[0])
        )

    def _find_measured_values(self) -> dict[CellKey, Measure]:
        return find_measured_values(self.record.figures, self.side, self.current_day)

    def _show_current_cell(self) -> None:
        """Scroll to the grid's current cell, which is no widget that the page would follow."""
        grid = self.form.fingers
        cell = grid.visualRect(grid.currentIndex())
        bottom = grid.viewport().mapTo(self._scroll.widget(), cell.bottomLeft())  # type: ignore[arg-type]
        self._scroll.ensureVisible(bottom.x(), bottom.y(), 0, 2 * cell.height())

    def _find_session_values(self, measure: ManualMeasure) -> list[tuple[datetime, float]]:
        """Return when Carpus measured the same, and its mean."""
        if measure.session_measure is None:
            return []
        counted = (
            one for one in self.record.figures if one.side == self.side and not (one.is_simulated or one.is_excluded)
        )
        found = ((one.when, one.find(*measure.session_measure)) for one in counted)
        return [(when, row.mean) for when, row in found if row is not None and row.count]

    def _show_course(self, name: str) -> None:
        measure = find_manual_measure(name)
        side = self.side if measure.is_per_hand else ""
        values = [one for one in current_values(self.record.values) if (one.measure, one.side) == (name, side)]
        self.chart.show_values(measure, values, self._find_session_values(measure))

    def _fill_changes(self) -> None:
        body, theme = self._changes.body, self._theme
        clear_layout(body)
        body.addWidget(Text(theme, self.tr("Manual and Carpus values are kept separate"), 16, SEMIBOLD, wrap=True))
        words = self.tr(
            "The two kinds of values are neither averaged nor subtracted. Change is assessed within one method only."
        )
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        mine = [one for one in current_values(self.record.values) if one.side in (self.side, "")]
        add_change_rows(body, theme, find_changes(mine))

    # --- entering -----------------------------------------------------------------------------------------
    def _on_edited(self) -> None:
        problems = self.form.list_errors()
        elsewhere = [one for (_, day), one in self._unsaved.items() if (one.side, day) != self._shown and one.side]
        doubts = self.form.list_warnings()
        self.status_text.setText(
            problems[0] if problems
            else doubts[0] if doubts
            else self.tr("Some values of this or another hand or day are not saved yet.") if elsewhere
            else self.tr("Values are saved with initials and time. Later changes stay visible.")
        )  # fmt: skip
        can_save = not problems and self.has_unsaved
        if not can_save and self.save_button.hasFocus():
            self.close_button.setFocus(Qt.FocusReason.OtherFocusReason)  # Qt would go on to the top bar
        self.save_button.setEnabled(can_save)

    def _request_save(self) -> None:
        if not self.form.list_errors():
            self.save_requested.emit(self.list_unsaved(), self.form.list_warnings())

"""The form for what was measured by hand on a day, with its course beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date, datetime

from PySide6.QtCore import QDate, Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QBoxLayout, QDateEdit, QWidget

from carpus.core.measures.by_hand import MEASURES, HandMeasure, HandValue, Key, counted, measure_named
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import Measure
from carpus.core.types import Side
from carpus.ui import numbers, terms
from carpus.ui.by_hand.change_rows import add_changes
from carpus.ui.by_hand.form import HandForm
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.field import Choices, Combo, leave_wheel
from carpus.ui.controls.layouts import STRETCH, Fitted, ScrollArea, ScrolledColumn, empty, fill, in_column, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.plot.by_hand import HandValueChart
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.words.by_hand import changes, measure_name


@dataclass(frozen=True, slots=True)
class HandRecord:
    """All of a patient that the screen shows: ``values`` as entered, ``figures`` of the sessions in order of time."""

    patient_id: str
    side: Side
    values: tuple[HandValue, ...]
    figures: tuple[SessionFigures, ...]
    initials: str


class ByHandScreen(Fitted):
    """``save`` carries what is to be entered and words of what is unusual in it."""

    save = Signal(object, object)

    def __init__(self, theme: Theme, today_is: Callable[[], date]) -> None:
        super().__init__()
        self._theme, self._today_is = theme, today_is
        today = today_is()
        self.record = HandRecord("", "right", (), (), "")
        self._more: set[str] = set()
        self._written: dict[tuple[Key, date], HandValue] = {}
        """Of other days and the other hand, not kept yet: it stays written until it is saved or let go."""
        self._shown: tuple[Side, date] = ("right", today)
        self.title = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.day = QDateEdit(QDate(today.year, today.month, today.day))
        leave_wheel(self.day)
        self.day.setCalendarPopup(True)
        self.day.setDisplayFormat(numbers.day_format())
        self.day.setMaximumDate(self.day.date())
        self.day.setAccessibleName(self.tr("Day of measuring"))
        self.hand = Choices(theme, [(side, terms.hand_name(side)) for side in ("right", "left")])
        self.form = HandForm(theme)
        self.more = Combo()
        self.more.setAccessibleName(self.tr("Other measures"))
        self.state = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.cancel = Button(theme, self.tr("Close"), "quiet", hint="Esc")
        self.save_button = Button(
            theme, self.tr("Save values"), "primary", icon="check", hint="Ctrl+Enter", height_px=44
        )
        self.chart = HandValueChart(theme)
        self._changes = Card(theme, 20)
        self._lay_out()
        self.day.dateChanged.connect(lambda _: self._turn())
        self.hand.chosen.connect(lambda _: self._turn())
        self.form.edited.connect(self._edited)
        self.form.chosen.connect(self._show_course)
        self.more.activated.connect(self._add)
        self.save_button.clicked.connect(self._save)
        for keys in ("Ctrl+Return", "Ctrl+Enter"):
            QShortcut(QKeySequence(keys), self, self.save_button.click)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)

    def _lay_out(self) -> None:
        head = in_line((self.title, 1), self.day, self.hand, gap=12)
        entries = Card(self._theme, 20)
        entries.body.addWidget(self.form)
        course = Card(self._theme, 20)
        course.body.addWidget(self.chart)
        right = in_column(course, self._changes, STRETCH, gap=GAP_PX)
        host = ScrolledColumn()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight, host)
        self._columns.setContentsMargins(0, 0, 0, 0)
        self._columns.setSpacing(GAP_PX)
        fill(self._columns, (entries, 5, Qt.AlignmentFlag.AlignTop), (right, 4))
        foot = in_line(self.more, (self.state, 1), self.cancel, self.save_button, gap=12)
        in_column(
            head,
            2,
            self.basis,
            14,
            (ScrollArea(host), 1),
            12,
            foot,
            gap=0,
            margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX),
            within=self,
        )
        self._theme.changed.connect(self._fit)

    def _fit(self) -> None:
        """With large text what stood at the right goes below."""
        tight = is_tight(self, self._theme) or self.width() < 1180 * self._theme.text_scale
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if tight else directions.LeftToRight)

    # --- what is shown ------------------------------------------------------------------------------------
    @property
    def side(self) -> Side:
        return "left" if self.hand.value() == "left" else "right"

    @property
    def day_shown(self) -> date:
        return date(self.day.date().year(), self.day.date().month(), self.day.date().day())

    @property
    def has_unsaved(self) -> bool:
        try:
            return bool(self.unsaved())
        except ValueError:
            return True

    def unsaved(self) -> list[HandValue]:
        """All that is written and not kept, of every day and hand. Raises ValueError for what cannot be kept."""
        side, day = self._shown
        here = self.form.differing(self.record.values, side, day)
        shown = {(key, day) for row in self.form.rows.values() for key in row.keys(side)}
        return [*(one for at, one in self._written.items() if at not in shown), *here]

    def write_again(self, values: Sequence[HandValue]) -> None:
        """What was written of this patient before and not kept, as if it had just been written."""
        self._written = {(one.key, one.day): one for one in values}
        self._fill()

    def _turn(self) -> None:
        """To another day or hand; what is written stays written. What cannot be kept is put right first."""
        if self.form.problems():
            self._choose(*self._shown)
            return
        self._written = {(one.key, one.day): one for one in self.unsaved()}
        self._fill()

    def _choose(self, side: Side, day: date) -> None:
        for widget in (self.day, self.hand):
            widget.blockSignals(True)
        self.day.setDate(QDate(day.year, day.month, day.day))
        self.hand.choose(side)
        for widget in (self.day, self.hand):
            widget.blockSignals(False)

    def show_record(self, record: HandRecord, *, again: bool = False) -> None:
        """Everything of one patient; ``again`` after saving, where day and hand stay."""
        self.record = record
        self._written = {}
        if not again:
            self._more = set()
            today = self._today_is()  # the program may have stood open over night
            self.day.setMaximumDate(QDate(today.year, today.month, today.day))
            self._choose(record.side, today)
        self._fill()
        if again:
            self.state.setText(self.tr("Kept."))

    def first(self) -> QWidget:
        return self.form.first() if self.form.rows else self

    def _fill(self) -> None:
        self._shown = (self.side, self.day_shown)
        usual = {one.id for one in MEASURES if one.usual_form}
        self.form.set_measures(usual | {one.measure for one in self.record.values} | self._more)
        self.form.show_values(self._with_written(), self.side, self.day_shown, self._of_carpus())
        self._fill_more()
        self.title.setText(self.tr("Measured by hand, {day}").format(day=numbers.short_date(self.day_shown)))
        self._say_basis()
        shown = self.chart.measure.id if self.chart.measure else ""
        self._show_course(shown if shown in self.form.rows else next(iter(self.form.rows)))
        self._fill_changes()
        self._edited()

    def _with_written(self) -> tuple[HandValue, ...]:
        return (*self.record.values, *self._written.values())

    def _fill_more(self) -> None:
        others = [(one.id, measure_name(one)) for one in MEASURES if one.id not in self.form.rows]
        self.more.offer([("", self.tr("Other measures…")), *others])

    def _say_basis(self) -> None:
        """Who enters it, what it means, and where the forearm is counted from."""
        by = self.tr("By {initials}.").format(initials=self.record.initials) if self.record.initials else ""
        words = self.tr("Empty means not measured. Nothing here changes a figure of Carpus.")
        simulated = any(one.simulated and (one.side, one.when.date()) == self._shown for one in self.record.figures)
        why = self.tr("What Carpus has of this day is simulated, and no value.") if simulated else ""
        zero = terms.thumb_up_words() if {"PRONATION", "SUPINATION"} & set(self.form.rows) else ""
        self.basis.setText(" ".join(filter(None, (by, words, zero, why))))

    def _add(self, _number: int) -> None:
        name = str(self.more.currentData())
        if not name:
            return
        self._more.add(name)
        self.form.set_measures({*self.form.rows, name})
        self.form.rows[name].show(self._with_written(), self.side, self.day_shown, self._of_carpus().get(name))
        self._fill_more()
        self._say_basis()
        self._show_course(name)
        self.form.rows[name].fields[0][1].setFocus(Qt.FocusReason.OtherFocusReason)

    def _of_carpus(self) -> dict[str, Measure]:
        """What Carpus measured of the same on that day: the last session that did."""
        found: dict[str, Measure] = {}
        for measure in MEASURES:
            for _, row in self._sessions_of(measure):
                if _.date() == self.day_shown:
                    found[measure.id] = row
        return found

    def _sessions_of(self, measure: HandMeasure) -> list[tuple[datetime, Measure]]:
        if measure.figure is None:
            return []
        out = []
        for figures in self.record.figures:
            if figures.side != self.side or figures.simulated or figures.not_counted:
                continue
            row = figures.find(*measure.figure)
            if row is not None and row.count:
                out.append((figures.when, row))
        return out

    def _show_course(self, name: str) -> None:
        measure = measure_named(name)
        side = self.side if measure.of_hand else ""
        values = [one for one in counted(self.record.values) if (one.measure, one.side) == (name, side)]
        self.chart.show_course(measure, values, [(when, row.mean) for when, row in self._sessions_of(measure)])

    def _fill_changes(self) -> None:
        body, theme = self._changes.body, self._theme
        empty(body)
        body.addWidget(Text(theme, self.tr("By hand and by Carpus are never joined"), 16, SEMIBOLD, wrap=True))
        words = self.tr("Neither averaged nor subtracted. A change is judged within one way of measuring.")
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        mine = [one for one in counted(self.record.values) if one.side in (self.side, "")]
        add_changes(body, theme, changes(mine))

    # --- entering -----------------------------------------------------------------------------------------
    def _edited(self) -> None:
        problems = self.form.problems()
        elsewhere = [one for (_, day), one in self._written.items() if (one.side, day) != self._shown and one.side]
        doubts = self.form.doubts()
        self.state.setText(
            f"{problems[0][0].accessibleName()}: {problems[0][1]}" if problems
            else doubts[0] if doubts
            else self.tr("Written and not kept yet: also the other hand or another day.") if elsewhere
            else self.tr("Kept with initials and time; every later change stays readable.")
        )  # fmt: skip
        self.save_button.setEnabled(not problems and self.has_unsaved)

    def _save(self) -> None:
        if not self.form.problems():
            self.save.emit(self.unsaved(), self.form.doubts())

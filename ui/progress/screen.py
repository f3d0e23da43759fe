"""The progress screen: filters, the answer, the chart, the table in words, fairness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QWidget

from carpus.core.measures.by_hand import HandValue, counted
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Comparison, Progress, other_hand_of, progress
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.by_hand.change_rows import add_changes
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import (
    NO_LIMIT_PX,
    STRETCH,
    Fitted,
    ScrollArea,
    ScrolledColumn,
    empty,
    fill,
    in_column,
    in_line,
    page,
)
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, StateText, Text, caption, heading
from carpus.ui.keys import bind_screen, letter_key
from carpus.ui.plot.course import ProgressChart
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.verdicts import counted_once_words, limit_words, verdict_token, verdict_word
from carpus.ui.words.by_hand import changes, day_words
from carpus.ui.words.fingers import followed_keys, followed_kinds
from carpus.ui.words.progress import before_after, change_line, comparison_name, doubt_words, headline, unfair_words
from carpus.ui.words.ranges import mean_speed_words

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.records.library import Library

LEAST_LETTERS = 14
LEAST_CHART_PX, SIDE_PX = 360, 380
FILTERS_PX = 1180
"""What the row above the sentence needs with everything in it."""


class ProgressScreen(Fitted):
    """``report`` carries the sessions shown; ``session`` one that was chosen; ``told`` a fault."""

    report = Signal(object)
    told = Signal(object)
    table_wanted = Signal(object)
    session = Signal(str)
    by_hand_wanted = Signal()

    def __init__(self, theme: Theme, background: Background, store: Library) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self._patient_id = ""
        self._all: tuple[SessionFigures, ...] = ()
        self._kinds: list[tuple[str, str]] = []
        self._by_hand: list[HandValue] = []
        self.progress = Progress((), (), None)
        self.exercise = Combo()
        self.followed = Combo()
        self.span = Text(theme, "", 14, REGULAR, "text2")
        self.report_button = Button(
            theme, self.tr("Progress report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44
        )
        self.picture_button = Button(theme, self.tr("Save picture…"), "plain")
        self.table_button = Button(theme, self.tr("Save table…"), "plain", hint="Ctrl+E")
        self.by_hand_button = Button(theme, self.tr("Values by &hand…"), "plain")
        self.by_hand_button.set_face(self.by_hand_button.text(), hint=letter_key(self.by_hand_button.text()))
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.chart = ProgressChart(theme)
        self._table = Card(theme, 20)
        self._fair = Card(theme, 20)
        self._hand = Card(theme, 20)
        self._lay_out()
        self.exercise.currentIndexChanged.connect(lambda _: self._choose_exercise())
        self.followed.currentIndexChanged.connect(lambda _: self._choose())
        self.report_button.clicked.connect(lambda: self.report.emit([point.figures for point in self.progress.points]))
        self.picture_button.clicked.connect(self.chart.menu.save_picture)
        self.chart.menu.told.connect(self.told)
        self.chart.opened.connect(self.session)
        self.by_hand_button.clicked.connect(self.by_hand_wanted)
        self.table_button.clicked.connect(lambda: self.table_wanted.emit(self.progress))
        actions = {
            "plot_in": self.chart.zoom_in, "plot_out": self.chart.zoom_out, "plot_all": self.chart.show_all,
            "point_back": lambda: self.chart.step(-1), "point_on": lambda: self.chart.step(1),
            "point_open": self.chart.open_current, "report": self.report_button.click,
            "export": self.table_button.click,
        }  # fmt: skip
        bind_screen(self, actions)

    def _lay_out(self) -> None:
        self._filters = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._filters.setSpacing(12)
        self.exercise.setAccessibleName(self.tr("Exercise and hand"))
        self.exercise.setMinimumContentsLength(LEAST_LETTERS)
        self.followed.setAccessibleName(self.tr("What is followed"))
        self.followed.hide()  # until a session of the whole hand is shown
        what = in_line(self.exercise, self.followed, self.span, STRETCH, gap=12)
        made = in_line(STRETCH, self.table_button, self.picture_button, self.report_button, gap=12)
        fill(self._filters, (what, 1), made)
        right = in_column(self._table, self._hand, self._fair, STRETCH, gap=GAP_PX, margins=(0, 0, 0, 0))
        host = ScrolledColumn()
        host.setLayout(right)
        self._side = ScrollArea(host)
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._columns.setSpacing(GAP_PX)
        fill(self._columns, (self.chart, 1), self._side)
        self._theme.changed.connect(self._fit)
        self._fit()
        whole = in_column(self._filters, 18, gap=0, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX))
        whole.addLayout(in_line((self.answer, 1), (self.by_hand_button, 0, Qt.AlignmentFlag.AlignBottom), gap=12))
        fill(whole, 2, self.basis, 16, (self._columns, 1))
        in_column(page(whole), margins=(0, 0, 0, 0), within=self)

    def _fit(self) -> None:
        """Where there is little room, everything one below the other on a page that scrolls."""
        narrow = is_tight(self, self._theme) or self.width() < FILTERS_PX * self._theme.text_scale
        direction = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
        self._filters.setDirection(direction)
        self._columns.setDirection(direction)
        self._side.unroll(on=narrow)
        self._side.setMinimumWidth(0 if narrow else self._theme.px(SIDE_PX))
        self._side.setMaximumWidth(NO_LIMIT_PX if narrow else self._theme.px(SIDE_PX))
        self.chart.setMinimumHeight(self._theme.px(LEAST_CHART_PX) if narrow else 0)
        self.span.setVisible(not narrow)
        self.report_button.set_face(self.report_button.text(), hint="" if narrow else "Ctrl+P")
        self.table_button.set_face(self.table_button.text(), hint="" if narrow else "Ctrl+E")

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, patient_id: str, session_id: str = "") -> None:
        """Read all sessions of a patient; the kind of the given or newest session is shown."""
        store, self._patient_id = self._store, patient_id
        self._show_none(self.tr("Reading the sessions…"))

        def read(found: tuple[Sequence[SessionFigures], Sequence[HandValue]]) -> None:
            if patient_id == self._patient_id:  # else that of another patient is awaited by now
                self._show(*found, session_id)

        def failed(fault: Exception) -> None:
            if patient_id == self._patient_id:
                self._show_none(self.tr("The sessions cannot be read."))
            self.told.emit(fault)

        self._background.run(lambda: (store.history(patient_id), store.by_hand(patient_id)), read, failed, self)
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_none(self, words: str) -> None:
        """Nothing of the sessions before, which may be another patient's, and nothing to be made of them."""
        self.exercise.hide()
        self.followed.hide()
        self._show_course(Progress((), (), None), [])
        self.answer.setText(words)

    def _show(self, found: Sequence[SessionFigures], by_hand: Sequence[HandValue], session_id: str) -> None:
        self._by_hand = counted(by_hand)
        self._all = tuple(sorted(found, key=lambda figures: figures.when))
        asked = next((f for f in self._all if f.session_id == session_id), self._all[-1] if self._all else None)
        self._kinds = list(dict.fromkeys((figures.exercise.id, figures.side) for figures in reversed(self._all)))
        self.exercise.offer(
            [(one, f"{terms.exercise_name(one[0])} · {terms.hand_name(one[1])}") for one in self._kinds],
            None if asked is None else (asked.exercise.id, asked.side),
        )
        self.exercise.setVisible(bool(self._kinds))
        self._choose_exercise()

    def _alike(self) -> list[SessionFigures]:
        kind = self._kinds[self.exercise.currentIndex()] if self._kinds else ("", "")
        return [figures for figures in self._all if (figures.exercise.id, figures.side) == kind]

    def _choose_exercise(self) -> None:
        """Offer what can be followed of the whole hand; what the exercise trains comes first."""
        alike = self._alike()
        kinds = followed_kinds(alike[-1]) if alike else []
        self.followed.offer(kinds)
        self.followed.setVisible(bool(kinds))
        self._choose()

    def _choose(self) -> None:
        alike = self._alike()
        other = other_hand_of(self._all, alike[-1]) if alike else None
        what = self.followed.currentData()
        course = progress(alike, other, followed_keys(what) if isinstance(what, str) and what else ())
        sides = [one.side for one in self._by_hand if one.side]
        side = alike[-1].side if alike else sides[-1] if sides else ""
        mine = tuple(one for one in self._by_hand if one.side in (side, ""))
        self._show_course(replace(course, by_hand=mine), alike)

    def _show_course(self, course: Progress, alike: Sequence[SessionFigures]) -> None:
        self.progress = course
        self.chart.show_progress(course)
        answer, basis = headline(self.progress)
        self.answer.setText(answer)
        if any(figures.simulated for figures in alike):
            practice = self.tr("Simulated sessions are drawn and compared for practice only: they count nowhere.")
            basis = f"{practice} {basis}"
        self.basis.say(basis.rstrip())
        words = ""
        if alike:
            first, last = numbers.day_month(alike[0].when), numbers.day_month(alike[-1].when)
            pattern = self.tr("{count} sessions, {first} – {last}")
            if alike[0].when.date() == alike[-1].when.date():
                pattern = self.tr("1 session, {last}") if len(alike) == 1 else self.tr("{count} sessions, {last}")
            words = pattern.format(count=len(alike), first=first, last=last)
        self.span.setText(words)
        for button in (self.report_button, self.picture_button, self.table_button):
            button.setEnabled(bool(alike))
        self._fill_table()
        self._fill_by_hand()
        self._fill_fairness()

    def _fill_table(self) -> None:
        empty(self._table.body)
        body, theme = self._table.body, self._theme
        first, last = self.progress.first, self.progress.last
        self._table.setVisible(bool(self.progress.comparisons))
        if first is None or last is None or not self.progress.comparisons:
            return
        body.addWidget(Text(theme, self.tr("First to last session"), 16, SEMIBOLD))
        days = self.tr("{first} and {last}").format(
            first=numbers.day_beside(first.when, last.when), last=numbers.day_beside(last.when, first.when)
        )
        counts = self.tr("{before} and {after} repetitions").format(before=first.counted, after=last.counted)
        body.addWidget(caption(theme, f"{days} · {counts}", wrap=True))
        for item in self.progress.comparisons:
            body.addWidget(Line(theme))
            body.addWidget(_ComparisonRow(theme, item, self.progress.comparisons))
        body.addWidget(Line(theme))
        if not self.progress.keys:
            body.addWidget(self._speed_row(first, last))

    def _speed_row(self, first: SessionFigures, last: SessionFigures) -> QWidget:
        before, after = mean_speed_words(first), mean_speed_words(last)
        return _Row(
            self._theme, self.tr("Peak speed"), f"{before} → {after}", "not_judged", self.tr("error not yet known")
        )

    def _fill_by_hand(self) -> None:
        """What was measured by hand, each way for itself."""
        empty(self._hand.body)
        values, theme = self.progress.by_hand, self._theme
        self._hand.setVisible(bool(values))
        if not values:
            return
        body, changed = self._hand.body, changes(values)
        body.addWidget(Text(theme, self.tr("Measured by hand"), 16, SEMIBOLD))
        add_changes(body, theme, changed)
        known = {key for key, _ in changed}
        once = [one for one in values if one.key not in known]
        for day in sorted({one.day for one in once}):
            words = f"{numbers.day_month(day)}: {day_words([one for one in once if one.day == day])}"
            body.addWidget(Text(theme, words, 14, wrap=True))

    def _fill_fairness(self) -> None:
        empty(self._fair.body)
        body, theme = self._fair.body, self._theme
        unfair = [point for point in self.progress.points if not point.fair]
        doubts = [words for point in self.progress.points if (words := doubt_words(point, self.progress))]
        self._fair.setVisible(len(self.progress.points) > 1 or bool(unfair or doubts))
        title = StateText(theme, 16, SEMIBOLD, 20)
        title.show_state("warn" if unfair or doubts else "good", self.tr("Fair comparison"), token="text")
        body.addWidget(title)
        for point in unfair:
            body.addWidget(Text(theme, unfair_words(point, self.progress), 14, wrap=True))
        for words in doubts:
            body.addWidget(Text(theme, words, 14, REGULAR, "warn", wrap=True))
        if not unfair:
            body.addWidget(Text(theme, self.tr("All sessions were set up alike."), 14, wrap=True))
        if once := counted_once_words(self.progress.earlier_results):
            body.addWidget(Text(theme, once, 14, wrap=True))
        body.addWidget(Text(theme, limit_words(self.progress.study), 14, REGULAR, "text2", wrap=True))


class _Row(QWidget):
    def __init__(self, theme: Theme, name: str, figures: str, verdict: str, small: str) -> None:
        super().__init__()
        column = in_column(gap=0, margins=(0, 3, 0, 3), within=self)
        top, below = QHBoxLayout(), QHBoxLayout()
        top.addWidget(Text(theme, name, 14, REGULAR, "text2"))
        top.addSpacing(8)
        top.addStretch(1)
        word = StateText(theme, 14, SEMIBOLD, 16)
        state = {"improved": "good", "worse": "bad"}.get(verdict, "none")
        word.show_state(state, verdict_word(verdict), token=verdict_token(verdict))  # type: ignore[arg-type]
        top.addWidget(word)
        below.addWidget(Text(theme, figures, 16, SEMIBOLD))
        below.addSpacing(8)
        words = Text(theme, small, 12, MEDIUM, "text2", wrap=True)  # two lines where the text is large
        words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        below.addWidget(words, 1)
        fill(column, top, below)


class _ComparisonRow(_Row):
    def __init__(self, theme: Theme, item: Comparison, among: Sequence[Comparison]) -> None:
        super().__init__(theme, comparison_name(item, among), before_after(item), item.verdict, change_line(item))

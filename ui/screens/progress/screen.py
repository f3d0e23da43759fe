"""Progress screen: choices, answer, chart, changes and comparability."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QWidget

from carpus.core.measures.manual_measurements import ManualValue, current_values
from carpus.core.results.progress import Comparison, Progress, compute_progress, find_other_hand
from carpus.core.results.ranges import progress_keys
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.progress import ProgressChart
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.field import Combo
from carpus.ui.kit.keys import bind_screen_keys, mnemonic_key
from carpus.ui.kit.layouts import (
    NO_LIMIT_PX,
    STRETCH,
    FittedWidget,
    ScrollArea,
    ScrolledColumn,
    clear_layout,
    column_layout,
    fill,
    row_layout,
    scroll_page,
)
from carpus.ui.kit.table import VERDICT_TOKENS
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, StateText, Text, caption, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.words import terms
from carpus.ui.words.fingers import progress_choices
from carpus.ui.words.manual_values import day_words, find_changes, list_other_values
from carpus.ui.words.progress import (
    change_line,
    comparability_lines,
    compared_words,
    comparison_name,
    error_limit_words,
    headline,
    uncertainty_words,
    value_pair,
    verdict_word,
)

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.records.data_folder import DataFolder
from collections.abc import Iterable

from PySide6.QtWidgets import QVBoxLayout

from carpus.core.measures.manual_measurements import ManualChange, MeasureKey
from carpus.ui.words.manual_values import change_words, full_name, verdict_words

MIN_LETTERS = 14
MIN_CHART_PX, SIDE_PX = 360, 380
# What the row above the answer needs.
MIN_FILTERS_PX = 1180


class ProgressScreen(FittedWidget):
    """Emits ``report_requested`` (results), ``table_requested``, ``session_chosen`` and ``fault_raised``."""

    report_requested = Signal(object)
    fault_raised = Signal(object)
    table_requested = Signal(object)
    session_chosen = Signal(str)
    manual_values_requested = Signal()

    def __init__(self, theme: Theme, background: Background, store: DataFolder) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self._patient_id = ""
        self._sessions: tuple[SessionResults, ...] = ()
        self._kinds: list[tuple[str, str]] = []
        self._manual_values: list[ManualValue] = []
        self.progress = Progress((), (), None)
        self.exercise_choice = Combo()
        self.measure_choice = Combo()
        self.span_text = Text(theme, "", 14, REGULAR, "text2")
        self.report_button = Button(
            theme, self.tr("Progress report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44
        )
        self.picture_button = Button(theme, self.tr("Save image…"), "plain")
        self.table_button = Button(theme, self.tr("Save table…"), "plain", hint="Ctrl+E")
        self.manual_values_button = Button(theme, self.tr("&Manual values…"), "plain")
        self.manual_values_button.set_label(
            self.manual_values_button.text(), hint=mnemonic_key(self.manual_values_button.text())
        )
        self.answer_text = heading(theme, wrap=True)
        self.basis_text = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.chart = ProgressChart(theme)
        self._change_card = Card(theme, 20)
        self._comparability_card = Card(theme, 20)
        self._manual_card = Card(theme, 20)
        self._build_layout()
        self.exercise_choice.currentIndexChanged.connect(lambda _: self._choose_exercise())
        self.measure_choice.currentIndexChanged.connect(lambda _: self._show_choice())
        self.report_button.clicked.connect(
            lambda: self.report_requested.emit([point.results for point in self.progress.points])
        )
        self.picture_button.clicked.connect(self.chart.menu.save_picture)
        self.chart.menu.fault_raised.connect(self.fault_raised)
        self.chart.session_chosen.connect(self.session_chosen)
        self.manual_values_button.clicked.connect(self.manual_values_requested)
        self.table_button.clicked.connect(lambda: self.table_requested.emit(self.progress))
        actions = {
            "plot_in": self.chart.zoom_in, "plot_out": self.chart.zoom_out, "plot_all": self.chart.show_all,
            "point_back": lambda: self.chart.step(-1), "point_on": lambda: self.chart.step(1),
            "point_open": self.chart.choose_current, "report": self.report_button.click,
            "export": self.table_button.click,
        }  # fmt: skip
        bind_screen_keys(self, actions)

    def _build_layout(self) -> None:
        self._filters = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._filters.setSpacing(12)
        self.exercise_choice.setAccessibleName(self.tr("Exercise and hand"))
        self.exercise_choice.setMinimumContentsLength(MIN_LETTERS)
        self.measure_choice.setAccessibleName(self.tr("Value shown"))
        self.measure_choice.hide()  # until a session of the whole hand is shown
        what = row_layout(self.exercise_choice, self.measure_choice, self.span_text, STRETCH, gap=12)
        made = row_layout(STRETCH, self.table_button, self.picture_button, self.report_button, gap=12)
        fill(self._filters, (what, 1), made)
        right = column_layout(
            self._change_card, self._manual_card, self._comparability_card, STRETCH, gap=GAP_PX, margins=(0, 0, 0, 0)
        )
        host = ScrolledColumn()
        host.setLayout(right)
        self._side = ScrollArea(host)
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._columns.setSpacing(GAP_PX)
        fill(self._columns, (self.chart, 1), self._side)
        self._theme.changed.connect(self._fit)
        self._fit()
        whole = column_layout(self._filters, 18, gap=0, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX))
        whole.addLayout(
            row_layout((self.answer_text, 1), (self.manual_values_button, 0, Qt.AlignmentFlag.AlignBottom), gap=12)
        )
        fill(whole, 2, self.basis_text, 16, (self._columns, 1))
        column_layout(scroll_page(whole), margins=(0, 0, 0, 0), parent=self)

    def _fit(self) -> None:
        """Stack everything on a scrolling page if there is little room."""
        narrow = is_tight(self, self._theme) or self.width() < MIN_FILTERS_PX * self._theme.text_scale
        direction = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
        self._filters.setDirection(direction)
        self._columns.setDirection(direction)
        self._side.expand(on=narrow)
        self._side.setMinimumWidth(0 if narrow else self._theme.px(SIDE_PX))
        self._side.setMaximumWidth(NO_LIMIT_PX if narrow else self._theme.px(SIDE_PX))
        self.chart.setMinimumHeight(self._theme.px(MIN_CHART_PX) if narrow else 0)
        self.span_text.setVisible(not narrow and self.measure_choice.isHidden())  # room for one of the two
        self.report_button.set_label(self.report_button.text(), hint="" if narrow else "Ctrl+P")
        self.table_button.set_label(self.table_button.text(), hint="" if narrow else "Ctrl+E")

    # --- life ---------------------------------------------------------------------------------------------
    def load_patient(self, patient_id: str, session_id: str = "") -> None:
        """Read all sessions of a patient and show the exercise of the given or newest one."""
        store, self._patient_id = self._store, patient_id
        self._show_empty(self.tr("Reading the sessions…"))

        def show_sessions(found: tuple[Sequence[SessionResults], Sequence[ManualValue]]) -> None:
            if patient_id == self._patient_id:  # else that of another patient is awaited by now
                self._show(*found, session_id)

        def report_failure(fault: Exception) -> None:
            if patient_id == self._patient_id:
                self._show_empty(self.tr("The sessions cannot be read."))
            self.fault_raised.emit(fault)

        self._background.run(
            lambda: (store.history(patient_id), store.manual_measurements(patient_id)),
            show_sessions,
            report_failure,
            self,
        )
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_empty(self, words: str) -> None:
        """Hide the previous sessions, which may be another patient's."""
        self.exercise_choice.hide()
        self.measure_choice.hide()
        self._show_course(Progress((), (), None), [])
        self.answer_text.setText(words)

    def _show(self, found: Sequence[SessionResults], manual_values: Sequence[ManualValue], session_id: str) -> None:
        self._manual_values = current_values(manual_values)
        self._sessions = tuple(sorted(found, key=lambda results: results.when))
        asked = next(
            (f for f in self._sessions if f.session_id == session_id), self._sessions[-1] if self._sessions else None
        )
        self._kinds = list(dict.fromkeys((results.exercise.id, results.side) for results in reversed(self._sessions)))
        self.exercise_choice.set_choices(
            [(one, f"{terms.exercise_name(one[0])} · {terms.hand_name(one[1])}") for one in self._kinds],
            None if asked is None else (asked.exercise.id, asked.side),
        )
        self.exercise_choice.setVisible(bool(self._kinds))
        self._choose_exercise()

    def _current_sessions(self) -> list[SessionResults]:
        kind = self._kinds[self.exercise_choice.currentIndex()] if self._kinds else ("", "")
        return [results for results in self._sessions if (results.exercise.id, results.side) == kind]

    def _choose_exercise(self) -> None:
        """Offer what can be followed of a whole hand, the trained measure first."""
        alike = self._current_sessions()
        kinds = progress_choices(alike[-1]) if alike else []
        self.measure_choice.set_choices(kinds)
        self.measure_choice.setVisible(bool(kinds))
        self._fit()
        self._show_choice()

    def _show_choice(self) -> None:
        alike = self._current_sessions()
        other = find_other_hand(self._sessions, alike[-1]) if alike else None
        what = self.measure_choice.currentData()
        course = compute_progress(alike, other, progress_keys(what) if isinstance(what, str) and what else ())
        sides = [one.side for one in self._manual_values if one.side]
        side = alike[-1].side if alike else sides[-1] if sides else ""
        mine = tuple(one for one in self._manual_values if one.side in (side, ""))
        self._show_course(replace(course, manual_measurements=mine), alike)

    def _show_course(self, course: Progress, alike: Sequence[SessionResults]) -> None:
        self.progress = course
        self.chart.show_progress(course)
        answer, basis = headline(self.progress)
        self.answer_text.setText(answer)
        if any(results.is_simulated for results in alike):
            practice = self.tr("Simulated sessions are shown for practice only and excluded from analysis.")
            basis = f"{practice} {basis}"
        self.basis_text.show_text(basis.rstrip())
        words = ""
        if alike:
            first, last = numbers.format_day_month(alike[0].when), numbers.format_day_month(alike[-1].when)
            pattern = self.tr("{count} sessions, {first} – {last}")
            if alike[0].when.date() == alike[-1].when.date():
                pattern = self.tr("1 session, {last}") if len(alike) == 1 else self.tr("{count} sessions, {last}")
            words = pattern.format(count=len(alike), first=first, last=last)
        self.span_text.setText(words)
        for button in (self.report_button, self.picture_button, self.table_button):
            button.setEnabled(bool(alike))
        self._fill_table()
        self._fill_manual_values()
        self._fill_comparability()
        cards = (self._change_card, self._manual_card, self._comparability_card)
        self._side.setVisible(not all(card.isHidden() for card in cards))

    def _fill_table(self) -> None:
        clear_layout(self._change_card.body)
        body, theme = self._change_card.body, self._theme
        words = compared_words(self.progress)
        self._change_card.setVisible(bool(words))
        if not words:
            return
        body.addWidget(Text(theme, self.tr("First to last session"), 16, SEMIBOLD))
        body.addWidget(caption(theme, words, wrap=True))
        for item in self.progress.comparisons:
            body.addWidget(Separator(theme))
            body.addWidget(_ComparisonRow(theme, item, self.progress.comparisons))

    def _fill_manual_values(self) -> None:
        clear_layout(self._manual_card.body)
        values, theme = self.progress.manual_measurements, self._theme
        self._manual_card.setVisible(bool(values))
        if not values:
            return
        body, changed = self._manual_card.body, find_changes(values)
        body.addWidget(Text(theme, self.tr("Manual measurements"), 16, SEMIBOLD))
        add_change_rows(body, theme, changed)
        once = list_other_values(values, (key for key, _ in changed))
        for day in sorted({one.day for one in once}):
            words = f"{numbers.format_day_month(day)}: {day_words([one for one in once if one.day == day])}"
            body.addWidget(Text(theme, words, 14, wrap=True))

    def _fill_comparability(self) -> None:
        clear_layout(self._comparability_card.body)
        body, theme = self._comparability_card.body, self._theme
        points = self.progress.points
        is_fair = all(point.is_comparable and not uncertainty_words(point, self.progress) for point in points)
        self._comparability_card.setVisible(len(points) > 1 or not is_fair)
        title = StateText(theme, 16, SEMIBOLD, 20)
        title.show_state("good" if is_fair else "warn", self.tr("Comparability"), token="text")
        body.addWidget(title)
        for words, token in comparability_lines(self.progress):
            body.addWidget(Text(theme, words, 14, REGULAR, token, wrap=True))
        body.addWidget(Text(theme, error_limit_words(self.progress.study), 14, REGULAR, "text2", wrap=True))


class _ComparisonRow(QWidget):
    def __init__(self, theme: Theme, item: Comparison, comparisons: Sequence[Comparison]) -> None:
        super().__init__()
        word = StateText(theme, 14, SEMIBOLD, 16)
        state = {"improved": "good", "worse": "bad"}.get(item.verdict, "none")
        word.show_state(state, verdict_word(item.verdict), token=VERDICT_TOKENS.get(item.verdict, "text2"))  # type: ignore[arg-type]
        words = Text(theme, change_line(item), 12, MEDIUM, "text2", wrap=True)  # two lines where the text is large
        words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        top = row_layout(Text(theme, comparison_name(item, comparisons), 14, REGULAR, "text2"), STRETCH, word, gap=8)
        below = row_layout(Text(theme, value_pair(item), 16, SEMIBOLD), (words, 1), gap=8)
        column_layout(top, below, gap=0, margins=(0, 3, 0, 3), parent=self)


def add_change_rows(body: QVBoxLayout, theme: Theme, found: Iterable[tuple[MeasureKey, ManualChange]]) -> None:
    """Add each change with its assessment, then both values."""
    for key, change in found:
        body.addWidget(Separator(theme))
        state, verdict = verdict_words(change)
        sign = StateText(theme, 14, SEMIBOLD, 16)
        sign.show_state(state, f"{full_name(key)}: {verdict}", token="text")  # type: ignore[arg-type]
        body.addWidget(sign)
        body.addWidget(Text(theme, change_words(change), 14, REGULAR, "text2", wrap=True))

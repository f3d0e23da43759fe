"""Card of results: title, buttons and tables."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QLayout, QWidget

from carpus.core.records.values import Patient, SessionEntry
from carpus.core.results.progress import find_other_hand, find_previous
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import find_partner
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.layouts import (
    NO_LIMIT_PX,
    STRETCH,
    ScrollArea,
    ScrolledColumn,
    clear_layout,
    column_layout,
    fill,
    row_layout,
)
from carpus.ui.kit.table import Table
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Text, plain_tooltip
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence
from carpus.ui.screens.review.reviewed_session import ReviewedSession
from carpus.ui.words import terms
from carpus.ui.words.active_passive import build_active_passive
from carpus.ui.words.fingers import finger_table, limitation_words, main_result_words
from carpus.ui.words.progress import correction_words
from carpus.ui.words.ranges import range_table, reference_words, repetition_words
from carpus.ui.words.task_measures import task_table, task_title
from carpus.ui.words.terms import to_person

# The head of the table and two rows.
MIN_TABLE_PX = 84


class ReviewCard(Card):
    """Title, buttons and tables of a session."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self.partner_id = ""
        """The session that is best compared with this one."""
        self.title = Text(theme, self.tr("Range of motion"), 16, SEMIBOLD)
        self.title.setMinimumWidth(1)
        self.count_text = ElidedText(
            theme, "", 14, REGULAR, "text2"
        )  # one line: what it says comes when all has its place
        self.repeat_button = Button(theme, self.tr("Measure again"), "quiet", icon="rotate-ccw")
        self.include_button = Button(theme, self.tr("Exclude"), "quiet")
        self.include_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # Space stays with the player after a click
        self.include_button.setToolTip(self.tr("The session is kept but not analysed. It can be included again."))
        self.compare_button = Button(theme, self.tr("Side by side…"), "quiet")
        self.compare_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.export_button = Button(theme, self.tr("Export…"), hint="Ctrl+E")
        self.report_button = Button(
            theme, self.tr("Make report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44
        )
        self.tables = ResultTables(theme)
        text = self._heading = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        text.setSpacing(12)
        fill(text, self.title, (self.count_text, 1))
        buttons = (self.include_button, self.compare_button, self.repeat_button, self.export_button, self.report_button)
        self.body.setContentsMargins(24, 4, 16, 4)
        self.body.setSpacing(4)
        fill(self.body, text, row_layout(STRETCH, *buttons, gap=12), self.tables)
        self._session_widgets = (self.title, self.count_text, self.tables)
        for widget in self._session_widgets:
            policy = widget.sizePolicy()
            policy.setRetainSizeWhenHidden(True)
            widget.setSizePolicy(policy)
        self._session_buttons = (self.include_button, self.compare_button, self.export_button, self.report_button)

    def show_reading(self, *, on: bool) -> None:
        """Hide the session and disable its buttons while another one is read, without moving anything."""
        for widget in self._session_widgets:
            widget.setVisible(not on)
        for button in self._session_buttons:
            button.setEnabled(not on)

    def show_session(self, reviewed: ReviewedSession) -> None:
        """Show exercise, hand, time, main result and tables."""
        results = reviewed.results
        self.show_reading(on=False)
        self.tables.show_session(reviewed)
        hand = to_mid_sentence(terms.hand_name(results.side))
        when = f"{numbers.format_short_date(results.when)} {results.when:%H:%M}"
        what = f"{terms.exercise_name(results.exercise.id)}, {hand} · {when}"
        self.title.setText(" · ".join(filter(None, (what, main_result_words(results)))))
        older = self.tr("older result, excluded") if reviewed.is_older else ""
        text = " · ".join(filter(None, (older, repetition_words(results), correction_words(results).rstrip("."))))
        self.count_text.setText(text)
        self.count_text.setToolTip(plain_tooltip(text))
        self._show_partner(reviewed)
        counts = self.tr("Include again") if results.is_excluded else self.tr("Exclude")
        self.include_button.set_label(counts)

    def _show_partner(self, reviewed: ReviewedSession) -> None:
        """Enable the comparison if there is a session to compare with."""
        partner = find_partner(reviewed.history, reviewed.results)
        self.partner_id = "" if partner is None else partner.session_id
        self.compare_button.setEnabled(partner is not None)
        words = self.tr("No other session of this exercise yet.")
        if partner is not None:
            words = self.tr("Compare with {hand}, {day} (B)").format(
                hand=terms.hand_name(partner.side).lower(),
                day=numbers.format_distinct_day(partner.when, reviewed.results.when),
            )
        self.compare_button.setToolTip(words)

    def fit(self, page: QLayout, height_px: int, *, tight: bool, whole_hand: bool) -> None:
        """Give the tables the rows they need, or let them scroll so that the curves keep their height."""
        self.report_button.set_label(self.report_button.text(), hint="" if tight else "Ctrl+P")
        self.export_button.set_label(self.export_button.text(), hint="" if tight else "Ctrl+E")
        self.repeat_button.set_label(self.repeat_button.text(), icon="" if tight else "rotate-ccw")
        # With large text what was left out, and why, has a line of its own.
        direction = QBoxLayout.Direction
        self._heading.setDirection(direction.TopToBottom if tight else direction.LeftToRight)
        self.tables.expand(on=tight)
        if tight:
            self.tables.setMinimumHeight(0)
            self.tables.setMaximumHeight(NO_LIMIT_PX)
            return
        if whole_hand:
            self.tables.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        maximum = height_px * (0.42 if whole_hand else 0.48)
        # Of the whole hand always more than there is room for: its place is known before it is read.
        needed = maximum if whole_hand else self.tables.content_height_px() + 2
        fewest = MIN_TABLE_PX * self._theme.text_scale
        self.tables.setFixedHeight(round(max(min(needed, maximum, self._room_px(page, height_px)), fewest)))

    def _room_px(self, page: QLayout, height_px: int) -> int:
        """Return the height left for the tables when all else has its minimum."""
        page.invalidate()  # the text may just have become larger
        width = page.geometry().width()
        least = page.minimumHeightForWidth(width) if page.hasHeightForWidth() else page.minimumSize().height()
        return height_px - (least - self.tables.minimumHeight())


class ResultTables(ScrollArea):
    """Range of motion, active and passive range, task measures, notes and result versions."""

    def __init__(self, theme: Theme) -> None:
        column = ScrolledColumn()
        super().__init__(column)
        self.patient: Patient | None = None
        """Whose age and sex choose the reference range."""
        self.range_table = Table(theme)
        self.hand_table = Table(theme, gap=10, pitch=1)
        self.task_title = Text(theme, "", 14, SEMIBOLD)
        self.task_table = Table(theme, gap=20, pitch=3)
        self.passive_text = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self.passive_table = Table(theme)
        self.passive_note = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self._passive_widgets = (self.passive_text, self.passive_table, self.passive_note)
        self.limitations = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self.notes = Text(theme, "", 14, REGULAR, wrap=True)
        self.versions = VersionChoice(theme)
        self._column = column_layout(gap=4, margins=(0, 0, 0, 0), parent=column)
        self._task_section = QWidget()
        column_layout(self.task_title, self.task_table, gap=0, margins=(0, 0, 0, 0), parent=self._task_section)
        for widget in (
            self.range_table,
            self.hand_table,
            *self._passive_widgets,
            self._task_section,
            self.limitations,
            self.notes,
            self.versions,
        ):
            self._column.addWidget(widget)
        self._column.addStretch(1)
        for hidden in (self.hand_table, self.limitations, self._task_section, *self._passive_widgets):
            hidden.hide()  # until there is a session that has it

    def show_layout(self, *, whole_hand: bool) -> None:
        self.hand_table.setVisible(whole_hand)
        self.limitations.setVisible(whole_hand)
        self.range_table.setVisible(not whole_hand)

    def content_height_px(self) -> int:
        width, needed = self.viewport().width(), 0
        for widget in (self.range_table, *self._passive_widgets, self._task_section, self.versions):
            if not widget.isHidden():
                high = widget.heightForWidth(width) if widget.hasHeightForWidth() else widget.sizeHint().height()
                needed += high + self._column.spacing()
        # A line for notes, also while nobody knows yet whether there are any: nothing jumps when they are read.
        return needed + self.notes.fontMetrics().height() + self._column.spacing()

    def show_session(self, reviewed: ReviewedSession) -> None:
        results = reviewed.results
        previous, other = find_previous(reviewed.history, results), find_other_hand(reviewed.history, results)
        if reviewed.is_hand:
            self.hand_table.show_rows(*finger_table(results, previous, other))
            self.limitations.setText(limitation_words(results))
        else:
            person = to_person(self.patient, results.when.date())
            self.range_table.show_rows(*range_table(results, previous, other, person=person))
            self.range_table.setToolTip(reference_words(results, person))
        self.range_table.setVisible(not reviewed.is_hand and bool(self.range_table.rows))
        self._show_active_passive(reviewed)
        self._show_task_measures(results, previous, is_hand=reviewed.is_hand)
        self._show_notes(results)

    def _show_active_passive(self, reviewed: ReviewedSession) -> None:
        found = build_active_passive(reviewed.results, reviewed.manual_values)
        if found is not None:
            self.passive_text.setText(found.sentence)
            self.passive_table.show_rows(*found.table)
            self.passive_note.setText(found.note)
        for place, widget in enumerate(self._passive_widgets):
            self._column.removeWidget(widget)  # what was done both ways is the first to be read
            self._column.insertWidget(place if reviewed.results.has_passive else place + 2, widget)
        self.passive_table.setVisible(found is not None)
        self.passive_text.setVisible(found is not None and bool(found.sentence))
        self.passive_note.setVisible(found is not None and bool(found.note))

    def _show_task_measures(self, results: SessionResults, previous: SessionResults | None, *, is_hand: bool) -> None:
        found = task_table(results, previous, is_for_research=False)
        self.task_title.setText(task_title(results))
        self.task_table.show_rows(*found)
        self._task_section.setVisible(bool(found.rows))
        if found.rows and is_hand:  # what the exercise is about comes first
            self._column.removeWidget(self._task_section)
            last = self._column.count() - 1  # before the stretch, after what explains the table
            self._column.insertWidget(0 if results.exercise.is_task else last, self._task_section)

    def _show_notes(self, results: SessionResults) -> None:
        sentence = "  ".join(f"{numbers.format_clock(time_s)} “{text}”" for time_s, text in results.notes)
        words = [self.tr("Notes: {notes}").format(notes=sentence)] if sentence else []
        if results.pain_scores:
            pains = ", ".join(str(pain) for pain in results.pain_scores)
            words.append(self.tr("Pain (0–10): {pains}").format(pains=pains))
        self.notes.setText("  ".join(words))
        self.notes.setVisible(bool(words))


class VersionChoice(QWidget):
    """Buttons for the result versions of a recording, hidden if there is one only.

    Emits ``chosen`` (session id), and ``restore_requested`` for an older version to become the newest.
    """

    chosen = Signal(str)
    restore_requested = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._row = row_layout(gap=8, margins=(0, 0, 0, 0), parent=self)
        self.buttons: list[Button] = []
        self.hide()

    def show_versions(self, results: Sequence[SessionEntry], current: str) -> None:
        """Show all versions, oldest first."""
        clear_layout(self._row)
        self.buttons = []
        if len(results) > 1:
            self._row.addWidget(Text(self._theme, self.tr("Results of this recording"), 14, MEDIUM))
            made = [result.created for result in results]
            for number, result in enumerate(results, 1):
                day = numbers.format_distinct_day(result.created, *made)
                words = self.tr("{number} · {day}").format(number=number, day=day)
                if number == len(results):
                    words = self.tr("{result}, in use").format(result=words)
                button = Button(self._theme, words, "well", height_px=32)
                button.setCheckable(True)
                button.setChecked(result.session_id == current)
                button.setEnabled(result.session_id != current)
                button.clicked.connect(lambda _=False, one=result: self.chosen.emit(one.session_id))
                self._row.addWidget(button)
                self.buttons.append(button)
            if results[-1].session_id != current:
                again = Button(self._theme, self.tr("Use this result"), "quiet", height_px=32)
                again.clicked.connect(lambda: again.setEnabled(False))  # once
                again.clicked.connect(lambda: self.restore_requested.emit(current))
                self._row.addWidget(again)
            self._row.addStretch(1)
        self.setVisible(len(results) > 1)

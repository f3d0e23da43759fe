"""The card of results: what was done, what can be made of it, and its tables."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QLayout, QWidget

from carpus.core.records.values import SessionEntry
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import other_hand_of, previous_of
from carpus.core.results.side_by_side import partner_of
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import NO_LIMIT_PX, STRETCH, ScrollArea, ScrolledColumn, empty, fill, in_column, in_line
from carpus.ui.controls.table import Table
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Text, plain_tooltip
from carpus.ui.review.reviewed import Reviewed
from carpus.ui.theme import Theme
from carpus.ui.translate import inside
from carpus.ui.words.active_passive import active_passive
from carpus.ui.words.fingers import finger_table, limits_words, main_figure
from carpus.ui.words.further import further_table, further_title
from carpus.ui.words.progress import corrected_words
from carpus.ui.words.ranges import range_table, repetition_words

LEAST_TABLE_PX = 84
"""The head of the table and two rows."""


class ReviewCard(Card):
    """``beside_wanted`` carries the session that this one is best held against."""

    beside_wanted = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self._partner_id = ""
        self.title = Text(theme, self.tr("Range of motion"), 16, SEMIBOLD)
        self.title.setMinimumWidth(1)
        self.count = ElidedText(theme, "", 14, REGULAR, "text2")  # one line: what it says comes when all has its place
        self.again_button = Button(theme, self.tr("Another set"), "quiet", icon="plus")
        self.count_button = Button(theme, self.tr("Do not count"), "quiet")
        self.count_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # Space stays with the player after a click
        self.count_button.setToolTip(self.tr("The session stays, and is compared with none. Can be taken back."))
        self.beside_button = Button(theme, self.tr("Side by side…"), "quiet")
        self.beside_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.export_button = Button(theme, self.tr("Export…"), hint="Ctrl+E")
        self.report_button = Button(
            theme, self.tr("Make report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44
        )
        self.beside_button.clicked.connect(lambda: self.beside_wanted.emit(self._partner_id))
        self.tables = ResultTables(theme)
        said = self._said = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        said.setSpacing(12)
        fill(said, self.title, (self.count, 1))
        buttons = (self.count_button, self.beside_button, self.again_button, self.export_button, self.report_button)
        self.body.setContentsMargins(24, 4, 16, 4)
        self.body.setSpacing(4)
        fill(self.body, said, in_line(STRETCH, *buttons, gap=12), self.tables)
        self._of_a_session = (self.title, self.count, self.tables)
        for widget in self._of_a_session:
            policy = widget.sizePolicy()
            policy.setRetainSizeWhenHidden(True)
            widget.setSizePolicy(policy)
        self._acts = (self.count_button, self.beside_button, self.export_button, self.report_button)

    def show_reading(self, *, on: bool) -> None:
        """While a session is read nothing is seen of the one before, which may be another patient's, and nothing can be
        made of it; everything keeps its place."""
        for widget in self._of_a_session:
            widget.setVisible(not on)
        for button in self._acts:
            button.setEnabled(not on)

    def show_session(self, reviewed: Reviewed) -> None:
        """What was done, with which hand and when, the figure that the list of sessions names, and the tables."""
        figures = reviewed.figures
        self.show_reading(on=False)
        self.tables.show_session(reviewed)
        hand = inside(terms.hand_name(figures.side))
        when = f"{numbers.short_date(figures.when)} {figures.when:%H:%M}"
        what = f"{terms.exercise_name(figures.exercise.id)}, {hand} · {when}"
        self.title.setText(" · ".join(filter(None, (what, main_figure(figures)))))
        older = self.tr("older result, does not count") if reviewed.is_older else ""
        said = " · ".join(filter(None, (older, repetition_words(figures), corrected_words(figures).rstrip("."))))
        self.count.setText(said)
        self.count.setToolTip(plain_tooltip(said))
        self._show_partner(reviewed)
        counts = self.tr("Let it count again") if figures.not_counted else self.tr("Do not count")
        self.count_button.set_face(counts)

    def _show_partner(self, reviewed: Reviewed) -> None:
        """What the session is best held against; without one the button says so."""
        partner = partner_of(reviewed.history, reviewed.figures)
        self._partner_id = "" if partner is None else partner.session_id
        self.beside_button.setEnabled(partner is not None)
        words = self.tr("No other session of this exercise yet.")
        if partner is not None:
            words = self.tr("Beside the {hand} of {day} (B)").format(
                hand=terms.hand_name(partner.side).lower(),
                day=numbers.day_beside(partner.when, reviewed.figures.when),
            )
        self.beside_button.setToolTip(words)

    def fit(self, page: QLayout, height_px: int, *, tight: bool, whole_hand: bool) -> None:
        """The tables take the rows they have, or scroll so that the curves keep their panels; with large text the page
        scrolls with all of them."""
        self.report_button.set_face(self.report_button.text(), hint="" if tight else "Ctrl+P")
        self.export_button.set_face(self.export_button.text(), hint="" if tight else "Ctrl+E")
        self.again_button.set_face(self.again_button.text(), icon="" if tight else "plus")
        # With large text what was left out, and why, has a line of its own.
        direction = QBoxLayout.Direction
        self._said.setDirection(direction.TopToBottom if tight else direction.LeftToRight)
        self.tables.unroll(on=tight)
        if tight:
            self.tables.setMinimumHeight(0)
            self.tables.setMaximumHeight(NO_LIMIT_PX)
            return
        if whole_hand:
            self.tables.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        most = height_px * (0.42 if whole_hand else 0.48)
        # Of the whole hand always more than there is room for: its place is known before it is read.
        needed = most if whole_hand else self.tables.needed_px() + 2
        fewest = LEAST_TABLE_PX * self._theme.text_scale
        self.tables.setFixedHeight(round(max(min(needed, most, self._room_px(page, height_px)), fewest)))

    def _room_px(self, page: QLayout, height_px: int) -> int:
        """What is left for the tables when all else keeps its least height; the card must not be pushed together."""
        page.invalidate()  # the text may just have become larger
        width = page.geometry().width()
        least = page.minimumHeightForWidth(width) if page.hasHeightForWidth() else page.minimumSize().height()
        return height_px - (least - self.tables.minimumHeight())


class ResultTables(ScrollArea):
    """Range of motion, active and passive, further measures, notes, and other results of the recording."""

    def __init__(self, theme: Theme) -> None:
        column = ScrolledColumn()
        super().__init__(column)
        self.range = Table(theme)
        self.hand = Table(theme, gap=10, pitch=1)
        self.further_title = Text(theme, "", 14, SEMIBOLD)
        self.further = Table(theme, gap=20, pitch=3)
        self.ways_said = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self.ways = Table(theme)
        self.ways_note = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self._ways = (self.ways_said, self.ways, self.ways_note)
        self.limits = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self.notes = Text(theme, "", 14, REGULAR, wrap=True)
        self.results = ResultChoice(theme)
        self._column = in_column(gap=4, margins=(0, 0, 0, 0), within=column)
        self._further = QWidget()
        in_column(self.further_title, self.further, gap=0, margins=(0, 0, 0, 0), within=self._further)
        for widget in (self.range, self.hand, *self._ways, self._further, self.limits, self.notes, self.results):
            self._column.addWidget(widget)
        self._column.addStretch(1)
        for hidden in (self.hand, self.limits, self._further, *self._ways):
            hidden.hide()  # until there is a session that has it

    def show_places(self, *, whole_hand: bool) -> None:
        self.hand.setVisible(whole_hand)
        self.limits.setVisible(whole_hand)
        self.range.setVisible(not whole_hand)

    def needed_px(self) -> int:
        width, needed = self.viewport().width(), 0
        for widget in (self.range, *self._ways, self._further, self.results):
            if not widget.isHidden():
                high = widget.heightForWidth(width) if widget.hasHeightForWidth() else widget.sizeHint().height()
                needed += high + self._column.spacing()
        # A line for notes, also while nobody knows yet whether there are any: nothing jumps when they are read.
        return needed + self.notes.fontMetrics().height() + self._column.spacing()

    def show_session(self, reviewed: Reviewed) -> None:
        figures = reviewed.figures
        previous, other = previous_of(reviewed.history, figures), other_hand_of(reviewed.history, figures)
        if reviewed.is_hand:
            self.hand.show_rows(*finger_table(figures, previous, other))
            self.limits.setText(limits_words(figures))
        else:
            self.range.show_rows(*range_table(figures, previous, other))
        self.range.setVisible(not reviewed.is_hand and bool(self.range.rows))
        self._show_active_passive(reviewed)
        self._show_further(figures, previous, is_hand=reviewed.is_hand)
        self._show_notes(figures)

    def _show_active_passive(self, reviewed: Reviewed) -> None:
        """The table of what was active, passive and measured by hand, where there is more than the first."""
        found = active_passive(reviewed.figures, reviewed.by_hand)
        if found is not None:
            self.ways_said.setText(found.said)
            self.ways.show_rows(*found.table)
            self.ways_note.setText(found.note)
        for place, widget in enumerate(self._ways):
            self._column.removeWidget(widget)  # what was done both ways is the first to be read
            self._column.insertWidget(place if reviewed.figures.has_passive else place + 2, widget)
        self.ways.setVisible(found is not None)
        self.ways_said.setVisible(found is not None and bool(found.said))
        self.ways_note.setVisible(found is not None and bool(found.note))

    def _show_further(self, figures: SessionFigures, previous: SessionFigures | None, *, is_hand: bool) -> None:
        found = further_table(figures, previous)
        self.further_title.setText(further_title(figures))
        self.further.show_rows(*found)
        self._further.setVisible(bool(found.rows))
        if found.rows and is_hand:  # what the exercise is about comes first
            self._column.removeWidget(self._further)
            last = self._column.count() - 1  # before the stretch, after what explains the table
            self._column.insertWidget(0 if figures.exercise.is_task else last, self._further)

    def _show_notes(self, figures: SessionFigures) -> None:
        said = "  ".join(f"{numbers.clock(time_s)} “{text}”" for time_s, text in figures.notes)
        words = [self.tr("Notes: {notes}").format(notes=said)] if said else []
        if figures.pain:
            pains = ", ".join(str(pain) for pain in figures.pain)
            words.append(self.tr("Pain (0–10): {pains}").format(pains=pains))
        self.notes.setText("  ".join(words))
        self.notes.setVisible(bool(words))


class ResultChoice(QWidget):
    """``chosen`` carries the identity of another result, ``wanted`` that of an older one that is to count again. Hidden
    while there is one only; the newest counts."""

    chosen = Signal(str)
    wanted = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._row = in_line(gap=8, margins=(0, 0, 0, 0), within=self)
        self.buttons: list[Button] = []
        self.hide()

    def show_results(self, results: Sequence[SessionEntry], current: str) -> None:
        """All results of the recording, the first one first."""
        empty(self._row)
        self.buttons = []
        if len(results) > 1:
            self._row.addWidget(Text(self._theme, self.tr("Results of this recording"), 14, MEDIUM))
            made = [result.created for result in results]
            for number, result in enumerate(results, 1):
                day = numbers.day_beside(result.created, *made)
                words = self.tr("{number} · {day}").format(number=number, day=day)
                if number == len(results):
                    words = self.tr("{result}, counts").format(result=words)
                button = Button(self._theme, words, "well", height_px=32)
                button.setCheckable(True)
                button.setChecked(result.session_id == current)
                button.setEnabled(result.session_id != current)
                button.clicked.connect(lambda _=False, one=result: self.chosen.emit(one.session_id))
                self._row.addWidget(button)
                self.buttons.append(button)
            if results[-1].session_id != current:
                again = Button(self._theme, self.tr("Let this one count"), "quiet", height_px=32)
                again.clicked.connect(lambda: again.setEnabled(False))  # once
                again.clicked.connect(lambda: self.wanted.emit(current))
                self._row.addWidget(again)
            self._row.addStretch(1)
        self.setVisible(len(results) > 1)
